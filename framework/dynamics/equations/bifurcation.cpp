#include "framework/dynamics/equations/bifurcation.h"

#include <algorithm>
#include <cmath>

#include "framework/common/dense.h"
#include "framework/dynamics/equations/inverse_mass.h"

namespace pintle {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Index = Eigen::Index;

constexpr int most = 300;  ///< more lost rows than this are taken as permanently redundant

VectorXd product(const System& system, const Equations& eq, const VectorXd& v) {
  VectorXd out = VectorXd::Zero(system.n_rows());
  visit_jacobian(eq, [&](int row, int column, double value) { out[row] += value * v[column]; });
  return out;
}

VectorXd transposed(const System& system, const Equations& eq, const VectorXd& x) {
  VectorXd out = VectorXd::Zero(system.n());
  add_reaction(eq, x, out);
  return out;
}

/// Basis of the null space, one vector per lost row: the part of random vectors that S S⁺ removes.
MatrixXd null_vectors(const System& system, Equations& eq) {
  MatrixXd N(system.n_rows(), eq.schur.lost());
  for (Index k = 0; k < N.cols(); ++k) {
    for (Index i = 0; i < N.rows(); ++i)
      N(i, k) = system.row_scale[i] * std::sin(1.3 + 78.233 * static_cast<double>(i + 1) + 3.7 * static_cast<double>(k * k + k));
    VectorXd g = transposed(system, eq, N.col(k));
    multiply_inverse_mass(system, eq, g, g);
    VectorXd x = product(system, eq, g);
    eq.schur.solve(x);
    N.col(k) -= x;
  }
  return N;
}

/// sᵀH for each null vector, and the third derivative of Nᵀ C along s without accelerations.
struct Bend {
  MatrixXd G;
  VectorXd third;
};
Bend bend(const System& system, const State& state, const VectorXd& way, double rate, const MatrixXd& N) {
  const Index n = system.n();
  const double step = 2e-4 / rate;
  Equations eq(system);
  Bend out{MatrixXd::Zero(N.cols(), n), VectorXd::Zero(N.cols())};
  for (int k : {-1, 0, 1}) {
    VectorXd y = state.y;
    y.head(n) += k * step * way;
    y.segment(n, n) = way;
    pose(system, state.t + k * step, y, eq);
    speed(system, state.t + k * step, y, eq);
    for (Index d = 0; d < N.cols() && k != 0; ++d) out.G.row(d) += k / (2 * step) * transposed(system, eq, N.col(d)).transpose();
    out.third += (k == 0 ? -2 : 1) / (step * step) * (N.transpose() * eq.Cdot);
  }
  return out;
}

/// The rows of G projected onto the directions that the joints leave free, (I − M⁻¹CqᵀS⁺Cq) M⁻¹Gᵀ. `X` receives the part that the joints
/// take up, S⁺Cq M⁻¹Gᵀ.
MatrixXd free_part(const System& system, Equations& eq, const MatrixXd& G, MatrixXd& X) {
  X.resize(system.n_rows(), G.rows());
  MatrixXd out(G.cols(), G.rows());
  for (Index d = 0; d < G.rows(); ++d) {
    VectorXd v = G.row(d).transpose();
    multiply_inverse_mass(system, eq, v, v);
    VectorXd x = product(system, eq, v);
    eq.schur.solve(x);
    VectorXd held = transposed(system, eq, x);
    multiply_inverse_mass(system, eq, held, held);
    out.col(d) = v - held;
    X.col(d) = x;
  }
  return out;
}

/// Size in the metric of M⁻¹ that a combination of rows would have if its terms did not cancel: Σ|N| (Cq M⁻¹ Cqᵀ)^½ over the rows.
double uncancelled(const System& system, const Equations& eq, const VectorXd& N) {
  VectorXd square = VectorXd::Zero(system.n_rows());
  visit_jacobian(eq,
                 [&](int row, int column, double value) { square[row] += value * value * (column < system.n_rigid() ? eq.W[column] : 1); });
  return N.cwiseAbs().dot(square.cwiseSqrt());
}

}  // namespace

bool follow_bifurcation_branch(const System& system, const State& state, Equations& eq) {
  constexpr double nothing = 1e-8, rounding = 1e-5;
  constexpr double balanced = 1e-9;  // relative to the accelerations without joints: below this only rounding remains
  const int lost = eq.schur.lost();
  if (lost <= eq.permanent) return true;
  if (lost > most) {
    eq.permanent = lost;
    return true;
  }
  const Index n = system.n();
  const VectorXd s = state.y.segment(n, n);
  const auto size = [&](const VectorXd& v) { return v.cwiseQuotient(system.scale).lpNorm<Eigen::Infinity>(); };
  const double rate = size(s), pull = size(eq.a);
  const auto free_pull = [&] {
    VectorXd free = eq.f;
    multiply_inverse_mass(system, eq, free, free);
    return size(free);
  };
  const bool rests = !(rate > 1e-6 * std::sqrt(pull));
  if (rests && pull <= balanced * free_pull()) return true;
  const MatrixXd N = null_vectors(system, eq);
  const VectorXd way = rests ? VectorXd(eq.a / pull) : s;  // direction of the motion; at rest, of the acceleration
  const Bend b = bend(system, state, way, rests ? 1 : rate, N);
  MatrixXd X;
  const MatrixXd V = free_part(system, eq, b.G, X);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> K(b.G * V);
  // G V is compared with G M⁻¹Gᵀ, which ignores the joints, and with the rounding of differences of terms that cancel.
  double whole = 0;
  for (Index d = 0; d < N.cols(); ++d)
    whole = std::max(whole, std::pow(rounding * (rests ? 1 : rate) * uncancelled(system, eq, N.col(d)), 2));
  for (Index d = 0; d < b.G.rows(); ++d) {
    VectorXd v = b.G.row(d).transpose();
    multiply_inverse_mass(system, eq, v, v);
    whole = std::max(whole, b.G.row(d).dot(v));
  }
  const VectorXd rest = -(b.third / 3 + b.G * eq.a);
  int singular = 0;
  VectorXd mu = VectorXd::Zero(rest.size());
  for (Index k = 0; k < mu.size(); ++k)
    if (K.eigenvalues()[k] > nothing * whole) {
      ++singular;
      mu += K.eigenvectors().col(k) * (K.eigenvectors().col(k).dot(rest) / K.eigenvalues()[k]);
    }
  if (singular == 0) eq.permanent = lost;
  if (singular == 0) return true;
  if (rests)  // at rest the accelerations must lie along a branch: aᵀH a = 0
    return (b.G * eq.a).lpNorm<Eigen::Infinity>() <= 1e-6 * (b.G.cwiseAbs() * eq.a.cwiseAbs()).lpNorm<Eigen::Infinity>();
  eq.a += V * mu;
  eq.lambda += X * mu;
  return true;
}

}  // namespace pintle
