#include "rotating_beam.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace pintle_oracle {
namespace {

using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

constexpr int shapes = 10, points = 24;

/// Gauss' rule on (0, 1), by Golub and Welsch.
struct Rule {
  VectorXd s, weight;
  Rule() {
    MatrixXd T = MatrixXd::Zero(points, points);
    for (int i = 1; i < points; ++i) T(i, i - 1) = T(i - 1, i) = i / std::sqrt(4.0 * i * i - 1);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solved(T);
    s = (solved.eigenvalues().array() + 1) / 2;
    weight = solved.eigenvectors().row(0).transpose().cwiseAbs2();
  }
};

/// s^m P_k(2s − 1) and two derivatives, a column each k.
Eigen::Matrix3Xd functions(double s, int m) {
  Eigen::Matrix3Xd P(3, shapes), out(3, shapes);
  const double x = 2 * s - 1;
  P.col(0) << 1, 0, 0;
  P.col(1) << x, 2, 0;
  for (int k = 1; k + 1 < shapes; ++k) {
    const Eigen::Vector3d times{x * P(0, k), 2 * P(0, k) + x * P(1, k), 4 * P(1, k) + x * P(2, k)};
    P.col(k + 1) = ((2 * k + 1) * times - k * P.col(k - 1)) / (k + 1);
  }
  const double a = std::pow(s, m), b = m * std::pow(s, m - 1), c = m > 1 ? m * (m - 1) : 0;
  out.row(0) = a * P.row(0);
  out.row(1) = a * P.row(1) + b * P.row(0);
  out.row(2) = a * P.row(2) + 2 * b * P.row(1) + c * P.row(0);
  return out;
}

RowVectorXd lean_of(const RotatingBeam& beam, const Rule& rule) {
  RowVectorXd lean = beam.lean_tip * functions(1, 2).row(0);
  if (beam.lean)
    for (int i = 0; i < points; ++i) lean += rule.weight[i] * beam.lean(rule.s[i]) * functions(rule.s[i], 2).row(0);
  return lean;
}

MatrixXd product(double factor, const RowVectorXd& a, const RowVectorXd& b) { return factor * a.transpose() * b; }

/// Of v, then u.
struct Matrices {
  MatrixXd M = MatrixXd::Zero(2 * shapes, 2 * shapes), K = M, G = M;
};
Matrices matrices(const RotatingBeam& beam) {
  const Rule rule;
  const RowVectorXd lean = lean_of(beam, rule);
  const double w2 = beam.w * beam.w;
  Matrices out;
  for (int i = 0; i < points; ++i) {
    const double s = rule.s[i], ds = rule.weight[i];
    const double pull = w2 * (beam.hub * (1 - s) + (1 - s * s) / 2);
    const Eigen::Matrix3Xd v = functions(s, 2), u = functions(s, 1);
    const MatrixXd mass = product(ds, v.row(0), v.row(0)), along = product(ds, u.row(0), u.row(0));
    out.M.topLeftCorner(shapes, shapes) += mass;
    out.M.bottomRightCorner(shapes, shapes) += along;
    auto K = out.K.topLeftCorner(shapes, shapes);
    K += product(ds, v.row(2), v.row(2)) + product(ds * pull, v.row(1), v.row(1)) - w2 * mass;
    if (beam.lacking) K -= product(ds * beam.lacking(s), v.row(1) - lean, v.row(1) - lean);
    out.K.bottomRightCorner(shapes, shapes) += product(ds * beam.EA, u.row(1), u.row(1)) - w2 * along;
    const MatrixXd coriolis = product(2 * beam.w * ds, v.row(0), u.row(0));
    out.G.topRightCorner(shapes, shapes) += coriolis;
    out.G.bottomLeftCorner(shapes, shapes) -= coriolis.transpose();
  }
  return out;
}

}  // namespace

VectorXd squares(const RotatingBeam& beam) {
  const Matrices m = matrices(beam);
  if (!(beam.EA > 0))
    return Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(m.K.topLeftCorner(shapes, shapes), m.M.topLeftCorner(shapes, shapes),
                                                              Eigen::EigenvaluesOnly)
        .eigenvalues();
  const Eigen::Index n = 2 * shapes;
  const Eigen::LLT<MatrixXd> mass(m.M);
  MatrixXd first(2 * n, 2 * n);
  first << MatrixXd::Zero(n, n), MatrixXd::Identity(n, n), -mass.solve(m.K), -mass.solve(m.G);
  const Eigen::VectorXcd exponents = Eigen::EigenSolver<MatrixXd>(first, false).eigenvalues();
  std::vector<double> found;
  for (const std::complex<double>& z : exponents)
    if (z.imag() > 0) found.push_back(z.imag() * z.imag());
  std::ranges::sort(found);
  return Eigen::Map<VectorXd>(found.data(), static_cast<Eigen::Index>(found.size()));
}

namespace {

// ∫ (s − ½) v ds over the moment of inertia, 1/12.
double mean_turn(double s) { return 12 * (s - 0.5); }

}  // namespace

RotatingBeam without_stiffening(RotatingBeam beam, BeamFrameTie conditions) {
  const double w2 = beam.w * beam.w, hub = beam.hub;
  beam.lacking = [=](double s) { return w2 * (hub * (1 - s) + (1 - s * s) / 2); };
  if (conditions == BeamFrameTie::chord) beam.lean_tip = 1;
  if (conditions == BeamFrameTie::mean_axes) beam.lean = mean_turn;
  return beam;
}

// The clamp pulls with the mass times its centre's acceleration; that pull falls linearly to the
// tip.
RotatingBeam without_pull_of_clamp(RotatingBeam beam) {
  const double acceleration = beam.w * beam.w * (beam.hub + 0.5);
  beam.lacking = [=](double s) { return acceleration * (1 - s); };
  beam.lean = mean_turn;
  return beam;
}

}  // namespace pintle_oracle
