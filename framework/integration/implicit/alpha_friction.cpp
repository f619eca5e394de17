// Generalised-α with dry friction that the accelerations determine: added as a border to the factor of Newton's matrix.
#include <algorithm>

#include "framework/common/worse.h"
#include "framework/dynamics/equations/sticking.h"
#include "framework/integration/implicit/alpha.h"

namespace pintle {

using Eigen::Index;
using Eigen::VectorXd;

// Response to 1 N of each friction force that the accelerations determine, in addition to the rows in the factor.
void Alpha::border(const System& system, Equations& eq) {
  const auto count = static_cast<Index>(eq.sticking.of.size());
  border_.resize(system.n(), count), border_lambda_.resize(system.n_rows(), count), W_.resize(count, count);
  if (count == 0) return;
  const Eigen::MatrixXd& J = eq.sticking.J;
  for (Index i = 0; i < J.cols(); ++i) {
    work_ = J.col(i);
    mu_.setZero();
    solve(work_, mu_);
    border_.col(i) = work_, border_lambda_.col(i) = mu_;
  }
  W_ = J.transpose() * border_;
}

// The forces that, together with Newton's change of speeds and multipliers, leave no slip of sticking friction, and match sliding friction
// to its normal force.
bool Alpha::correct_friction(const System& system, double weight, State& state, Memory& memory, Equations& eq) {
  if (border_.cols() == 0) return true;
  const VectorXd before = forces(state, eq), asked = -slips(system, eq) / weight - eq.sticking.J.transpose() * dv_;
  const VectorXd change = friction_change(system, state, eq, {W_, border_lambda_}, Shares::change, asked, memory.lambda, before);
  if (!change.allFinite()) return false;
  dv_ += border_ * change;
  memory.lambda += border_lambda_ * change;
  put_forces(system, eq, before + change, memory.lambda, state);
  return true;
}

// Largest slip that sticking forces could remove, relative to the mechanism's length and fastest angular rate.
double Alpha::slip_violation(const System& system, const State& state, const Equations& eq) const {
  if (border_.cols() == 0) return 0;
  return largest(W_ * holding_forces(system, eq, W_, slips(system, eq))) / (system.length * fastest_rate(system, state.y));
}

// Corrects x so that sticking friction has these slips.
void Alpha::keep_slip(const System& system, const Equations& eq, const VectorXd& slips, VectorXd& x) const {
  x -= border_ * holding_forces(system, eq, W_, eq.sticking.J.transpose() * x - slips);
}

// Redistributes, as share_out does, forces that can replace one another.
void Alpha::share_out_friction(const System& system, Instant& to, Equations& eq) {
  if (std::ranges::count(eq.sticking.of, true, &Sticking::Column::holds) < 2) return;
  const VectorXd before = forces(to.state, eq), change = friction_change(system, to.state, eq, {W_, border_lambda_}, Shares::all,
                                                                         VectorXd::Zero(before.size()), to.memory.lambda, before);
  if (!change.allFinite()) return;
  put_forces(system, eq, before + change, to.memory.lambda, to.state);
  apply_forces(system, to.state, eq);
}

}  // namespace pintle
