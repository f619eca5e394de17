// Flexible bodies in their steady-motion deformation, before an integration starts.

#include "framework/analysis/kinematics/inverse.h"
#include "framework/common/dense.h"
#include "framework/configuration/row_solver.h"
#include "framework/dynamics/equations/internal.h"
#include "framework/dynamics/model/signal_values.h"
#include "framework/dynamics/newton/kkt.h"

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_dense = 600;

/// The frames' speeds and accelerations without motion of the shapes.
class FrameMotion {
 public:
  explicit FrameMotion(const System& system) : system_(system), Cq_(system.n_rows(), system.n_rigid()) {}

  /// After pose, at y: fills the speeds in y and a. @returns false if drivers do not determine all frames
  bool fill(VectorXd& y, Equations& eq, VectorXd& a) {
    const Index n = system_.n(), r = system_.n_rigid();
    Cq_.setZero();
    visit_jacobian(eq, [&](int row, int column, double value) {
      if (column < r) Cq_(row, column) += system_.row_scale[row] * value * system_.scale[column];
    });
    Eigen::CompleteOrthogonalDecomposition<MatrixXd> rows;
    rows.setThreshold(RowSolver::singular);
    rows.compute(Cq_);
    if (rows.rank() < r) return false;
    const auto solve = [&](const VectorXd& right) {
      return VectorXd(system_.scale.head(r).cwiseProduct(rows.solve(system_.row_scale.cwiseProduct(right))));
    };
    y.segment(n, n).setZero();
    speed(system_, 0, y, eq);
    y.segment(n, r) = -solve(eq.Cdot);
    speed(system_, 0, y, eq);
    VectorXd gamma(system_.n_rows());
    acceleration_side(eq, gamma);
    a.setZero(n);
    a.head(r) = solve(gamma);
    return true;
  }

 private:
  const System& system_;
  MatrixXd Cq_;
};

}  // namespace

Assembly steady_start(const Model& model, const Assembly& assembly) {
  constexpr double balanced = 1e-12, nearly = 1e-9;
  constexpr int most = 60;
  const System& system = model.system;
  const Index n = system.n();
  if (n == system.n_rigid() || n > most_dense) return assembly;
  Assembly out = assembly;
  State& state = out.start;
  Equations eq(system);
  Tangent tangent(system);
  Kkt kkt(system, eq, tangent);
  FrameMotion frames(system);
  std::vector<double> values(tangent.places().size());
  VectorXd a(n), r(n), lambda = VectorXd::Zero(system.n_rows());
  double before = 0;
  for (int i = 0; i < most; ++i) {
    pose(system, 0, state.y, eq);
    if (!frames.fill(state.y, eq, a)) return assembly;
    update_mass(system, state.y, eq);
    follow_internal_states(system, eq, state, internal_at_rest, nullptr, state.y.data() + system.x_begin());
    start_own_states(system, state.y);
    apply_forces(system, state, eq);
    r = eq.f;
    add_mass_times(system, eq, -a, r);
    const double most_force = r.cwiseProduct(system.scale).lpNorm<Eigen::Infinity>();
    add_reaction(eq, -lambda, r);
    const double left = r.cwiseProduct(system.scale).lpNorm<Eigen::Infinity>() / std::max(most_force, 1e-300);
    if (!std::isfinite(left)) return assembly;
    if (i > 1 && position_violation(system, eq) <= 1e-13 && (left <= balanced || (left <= nearly && left > 0.5 * before))) return out;
    before = left;
    tangent.evaluate(system, state, eq, a, lambda, {.q = 1, .s = 0, .a = 0, .x = internal_at_rest}, values);
    if (!kkt.factor(system, eq, values)) return assembly;
    VectorXd y = -eq.C;
    kkt.solve(r, y);
    state.y.head(n) += r;
    lambda += y;
  }
  return assembly;
}

}  // namespace pintle
