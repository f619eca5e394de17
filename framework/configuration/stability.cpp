// Response of a mechanism at rest to a small disturbance: the reduced stiffness and its eigenvalues.
#include <algorithm>
#include <cmath>

#include "framework/common/dense.h"
#include "framework/configuration/equilibrium.h"
#include "framework/configuration/rest.h"

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_dense = 1200;  // larger dense matrices take minutes

std::string most_moved(const System& system, const VectorXd& scaled) {
  double most = -1;
  std::size_t which = 0;
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const double bends = scaled.segment(system.eta_begin[b], system.bodies[b].modes()).norm();
    const double moved = std::max(scaled.segment<3>(static_cast<Index>(3 * b)).norm(), bends);
    if (moved > most * (1 + 1e-9)) most = moved, which = b;
  }
  return system.bodies[which].name;
}

// Acting forces times lengths: the scale below which a stiffness is rounding.
double at_work(const System& system, const Equations& eq, const VectorXd& lambda) {
  double most = lambda.size() > 0 ? lambda.cwiseQuotient(system.row_scale).lpNorm<Eigen::Infinity>() : 0;
  for (const Body& b : system.bodies) most = std::max(most, b.m * system.gravity.norm() * system.length);
  for (const ForceEffect& f : eq.force) most = std::max({most, f.on_b.head<2>().norm() * system.length, std::abs(f.on_b[2])});
  return most;
}

}  // namespace

Stability stability_of(const System& system, const State& state, const Equations& eq, const VectorXd& lambda, VectorXd* direction) {
  Stability out;
  if (direction) direction->resize(0);
  if (system.n() > most_dense) return out;
  const MatrixXd Z = open_directions(system, eq);
  out.judged = true;
  out.dofs = static_cast<int>(Z.cols());
  if (out.dofs == 0) return out;
  Tangent tangent(system);
  std::vector<double> values(tangent.places().size());
  tangent.evaluate(system, state, eq, VectorXd::Zero(system.n()), lambda, {.q = 1, .s = 0, .a = 0, .x = internal_at_rest}, values);
  const MatrixXd K = system.scale.asDiagonal() * dense(system, tangent, values) * system.scale.asDiagonal();
  const MatrixXd H = Z.transpose() * K * Z;
  const double size = H.cwiseAbs().maxCoeff(), zero = std::max(1e-13 * size, 1e-9 * at_work(system, eq, lambda));
  VectorXd real(H.rows());
  MatrixXd shapes;
  if ((H - H.transpose()).cwiseAbs().maxCoeff() <= std::max(1e-9 * size, zero)) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(MatrixXd(0.5 * (H + H.transpose())));
    real = solver.eigenvalues();
    shapes = solver.eigenvectors();
  } else {
    const Eigen::EigenSolver<MatrixXd> solver(H);
    real = solver.eigenvalues().real();
    shapes = solver.eigenvectors().real();
    out.circulatory = solver.eigenvalues().imag().cwiseAbs().maxCoeff() > zero;
  }
  for (int pass = 0; pass < 2; ++pass)
    for (Index i = 0; i < real.size(); ++i)
      if (pass == 0 ? real[i] < -zero : std::abs(real[i]) <= zero) {
        ++(pass == 0 ? out.unstable : out.neutral);
        const VectorXd moved = Z * shapes.col(i);
        out.moving.push_back(most_moved(system, moved));
      }
  if (direction && out.unstable > 0) {
    Index lowest = 0;
    real.minCoeff(&lowest);
    const VectorXd moved = Z * shapes.col(lowest);
    *direction = system.scale.cwiseProduct(moved) / moved.cwiseAbs().maxCoeff();
  }
  return out;
}

}  // namespace pintle
