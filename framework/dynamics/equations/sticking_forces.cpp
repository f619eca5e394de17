#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "framework/common/dense.h"
#include "framework/common/worse.h"
#include "framework/dynamics/equations/sharing.h"
#include "framework/dynamics/equations/sticking_columns.h"

// The forces themselves, and the speeds and gaps that result.
namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using namespace sticking_columns;

namespace {

// The columns that hold, or those that slide.
Places those(const Sticking& s, bool that_hold) {
  Places out;
  for (Index i = 0; i < count(s); ++i)
    if (s.of[place(i)].holds == that_hold) out.push_back(i);
  return out;
}

VectorXd part(const VectorXd& v, const Places& of) {
  VectorXd out(static_cast<Index>(of.size()));
  for (Index i = 0; i < out.size(); ++i) out[i] = v[of[place(i)]];
  return out;
}
MatrixXd part(const MatrixXd& A, const Places& rows, const Places& columns) {
  MatrixXd out(static_cast<Index>(rows.size()), static_cast<Index>(columns.size()));
  for (Index j = 0; j < out.cols(); ++j)
    for (Index i = 0; i < out.rows(); ++i) out(i, j) = A(rows[place(i)], columns[place(j)]);
  return out;
}
void put(const VectorXd& values, const Places& at, VectorXd& v) {
  for (Index i = 0; i < values.size(); ++i) v[at[place(i)]] = values[i];
}

// Sliding friction under this load.
double sliding_force(const System& system, const State& state, const Equations& eq, std::size_t k, double load) {
  const Coulomb* dry = dry_law(system, k);
  if (!dry) return eq.friction[joint_friction(system, k)].per_load * load;
  return evaluate(*dry, friction_now(system, eq, k).slip, load, state.friction[k].direction).force;
}

double force_of(const System& system, const Equations& eq, const Sticking::Column& c) {
  return c.normal ? eq.contact[c.at].normal.force : friction_now(system, eq, c.at).force;
}

// The most that each can hold, for normal forces as for friction.
VectorXd capacity(const System& system, const Equations& eq, const Places& of) {
  VectorXd out(static_cast<Index>(of.size()));
  const auto column = [&](Index i) -> const Sticking::Column& { return eq.sticking.of[place(of[place(i)])]; };
  for (Index i = 0; i < out.size(); ++i) out[i] = column(i).normal ? 0 : friction_now(system, eq, column(i).at).holds;
  const double most = out.size() > 0 ? out.maxCoeff() : 0;
  for (Index i = 0; i < out.size(); ++i)
    if (column(i).normal) out[i] = most;
  return out;
}

// The rigid contacts among the holding forces, by their indices there.
std::vector<UnilateralContact> rigid_among(const System& system, const Sticking& s, const Places& hold) {
  std::vector<UnilateralContact> out;
  for (std::size_t i = 0; i < hold.size(); ++i) {
    const auto& [k, normal, holds] = s.of[place(hold[i])];
    if (!normal) continue;
    out.push_back({.normal = static_cast<int>(i)});
    if (i + 1 < hold.size() && s.of[place(hold[i + 1])].at == k)
      out.back().tangent = static_cast<int>(i + 1), out.back().mu = dry_law(system, k)->mu_static;
  }
  return out;
}

// Sliding friction in a rigid contact follows its own normal force, T = c N: response to 1 N of the normal force with this friction.
struct Coupled {
  MatrixXd W, lambda, by_friction;     ///< by_friction: response of the multipliers to its friction alone
  Places normal, friction, of_joints;  ///< columns of such contacts, and of sliding friction in joints
  VectorXd c;
};
Coupled couple(const System& system, const State& state, const Equations& eq, const FrictionResponse& by) {
  Coupled out{by.W, by.lambda, {}, {}, {}, {}, {}};
  for (const Index i : those(eq.sticking, false))
    if (of_contact(system, eq.sticking.of[place(i)].at))
      out.friction.push_back(i), out.normal.push_back(i - 1);
    else
      out.of_joints.push_back(i);
  out.c.resize(static_cast<Index>(out.friction.size()));
  out.by_friction.resize(by.lambda.rows(), out.c.size());
  for (Index i = 0; i < out.c.size(); ++i) {
    const Index N = out.normal[place(i)], T = out.friction[place(i)];
    out.c[i] = sliding_force(system, state, eq, eq.sticking.of[place(T)].at, 1);
    out.W.col(N) += out.c[i] * by.W.col(T);
    out.lambda.col(N) += out.c[i] * by.lambda.col(T);
    out.by_friction.col(i) = by.lambda.col(T);
  }
  return out;
}

}  // namespace

VectorXd holding_forces(const System& system, const Equations& eq, const MatrixXd& W, const VectorXd& slip) {
  const Places hold = those(eq.sticking, true);
  VectorXd out = VectorXd::Zero(slip.size());
  const bool gaps = std::ranges::find(eq.sticking.of, true, &Sticking::Column::normal) != eq.sticking.of.end();
  put(share_out(part(W, hold, hold), part(slip, hold), capacity(system, eq, hold), gaps ? one_gap : one_give), hold, out);
  return out;
}

namespace {

// Whether there is but one force that holds, with or without the sliding friction that follows it.
bool is_of_one_contact(const Sticking& s) {
  const std::size_t n = s.of.size();
  const bool slides = n == 2 && s.of[0].normal && s.of[1].at == s.of[0].at && !s.of[1].holds;
  return (n == 1 || slides) && s.of[0].holds;
}

// The general solution below, written out for it.
VectorXd change_of_one_contact(const System& system, const State& state, const Equations& eq, const FrictionResponse& by, Shares shares,
                               const VectorXd& slips, const VectorXd& before) {
  const bool slides = before.size() == 2;
  const double c = slides ? sliding_force(system, state, eq, eq.sticking.of[1].at, 1) : 0;
  const double off = slides ? c * before[0] - before[1] : 0, W_friction = slides ? by.W(0, 1) : 0;
  const double W = by.W(0, 0) + c * W_friction, held = shares == Shares::all ? before[0] : 0;
  VectorXd change(before.size());
  change[0] = (W == 0 ? 0 : (W * held + slips[0] - W_friction * off) / W) - held;
  if (slides) change[1] = c * change[0] + off;
  return change;
}

}  // namespace

// Sliding friction in joints makes this nonlinear, since N is a norm of λ: Newton's method on T_i + d_i μ_i N_i = 0, solving for the
// holding forces in each iteration.
VectorXd friction_change(const System& system, const State& state, const Equations& eq, const FrictionResponse& by, Shares shares,
                         const VectorXd& slips, const VectorXd& lambda, const VectorXd& before) {
  constexpr int most = 30;
  constexpr double enough = 1e-13, little = 1e-6, rounding = 4e-16;
  const Sticking& s = eq.sticking;
  if (is_of_one_contact(s)) return change_of_one_contact(system, state, eq, by, shares, slips, before);
  const Coupled with = couple(system, state, eq, by);
  const Places hold = those(s, true), &slide = with.of_joints;
  const MatrixXd W_hold = part(with.W, hold, hold), W_slide = part(by.W, hold, slide);
  const VectorXd off = with.c.cwiseProduct(part(before, with.normal)) - part(before, with.friction);  // for the present normal forces
  const VectorXd holds = capacity(system, eq, hold), held = shares == Shares::all ? part(before, hold) : VectorXd::Zero(W_hold.rows()),
                 asked = W_hold * held + part(slips, hold) - part(by.W, hold, with.friction) * off,
                 lambda_off = lambda + with.by_friction * off;
  const std::vector<UnilateralContact> rigid = rigid_among(system, s, hold);
  const double one = rigid.empty() ? one_give : one_force;
  VectorXd change = VectorXd::Zero(before.size()), loads(static_cast<Index>(slide.size()));
  const auto missed = [&](const VectorXd& sliding) {  // of a change of the sliding forces
    put(sliding, slide, change);
    put(share_out(W_hold, asked - W_slide * sliding, holds, one, rigid) - held, hold, change);
    const VectorXd now = lambda_off + with.lambda * change;
    VectorXd out = part(before, slide) + sliding;
    for (Index i = 0; i < out.size(); ++i) {
      const std::size_t k = s.of[place(slide[place(i)])].at;
      loads[i] = load_of(system, eq, joint_friction(system, k), now);
      if (state.friction[k].direction != DryFriction::undecided || !dry_law(system, k))
        out[i] -= sliding_force(system, state, eq, k, loads[i]);
    }
    return out;
  };
  VectorXd sliding = VectorXd::Zero(loads.size()), left = missed(sliding);
  const double others = largest(before) + largest(lambda) + largest(eq.f);  // a load that is tiny relative to these is rounding
  double left_before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most && slide.size() > 0; ++i) {
    const double scale = largest(loads) + largest(left), error = largest(left);
    const bool stagnates = error <= enough * (scale + others) && error > std::exchange(left_before, error) / 2;
    const bool balanced = error <= rounding * (largest(sliding) + largest(part(before, slide)));
    if (error <= enough * scale || balanced || stagnates) break;
    if (i + 1 == most) return VectorXd::Constant(before.size(), std::numeric_limits<double>::quiet_NaN());
    MatrixXd slope(sliding.size(), sliding.size());
    const double h = little * std::max(scale, largest(sliding));  // the load may have vanished
    for (Index j = 0; j < sliding.size(); ++j) slope.col(j) = (missed(sliding + h * VectorXd::Unit(sliding.size(), j)) - left) / h;
    sliding -= slope.partialPivLu().solve(left);
    left = missed(sliding);
  }
  put(with.c.cwiseProduct(part(change, with.normal)) + off, with.friction, change);
  return change;
}

namespace {

// For each force, the greatest of all forces coupled with it: solving for them together loses the last digits of that one.
VectorXd greatest_together(const MatrixXd& W, VectorXd force) {
  constexpr double coupled = 1e-12;
  const VectorXd own = W.diagonal().cwiseAbs().cwiseSqrt();
  for (bool grows = true; grows;) {
    grows = false;
    for (Index j = 0; j < force.size(); ++j)
      for (Index i = 0; i < force.size(); ++i)
        if (force[i] < force[j] && std::abs(W(i, j)) > coupled * own[i] * own[j]) force[i] = force[j], grows = true;
  }
  return force;
}

// Rounding left by balanced forces of rigid contacts is set to zero: otherwise a body at rest would be treated as moving.
void add_accelerations(const VectorXd& change, const VectorXd& before, const MatrixXd& W, Equations& eq) {
  const Sticking& s = eq.sticking;
  eq.a += s.a * change;
  if (std::ranges::find(s.of, true, &Sticking::Column::normal) == s.of.end()) return;
  const double rounding = 2e-15 * (5 + static_cast<double>(count(s)));  // rounding of sums of so many terms
  const VectorXd force = greatest_together(W, before.cwiseAbs() + change.cwiseAbs());
  for (Index i = 0; i < eq.a.size(); ++i)
    if (std::abs(eq.a[i]) <= rounding * s.a.row(i).cwiseAbs().dot(force)) eq.a[i] = 0;
}

}  // namespace

bool hold_sticking(const System& system, const State& state, Equations& eq) {
  list_sticking(system, state, eq);
  const Sticking& s = eq.sticking;
  if (s.of.empty()) return true;
  const MatrixXd W = respond_to_sticking(system, eq);
  VectorXd before(count(s));
  for (Index i = 0; i < count(s); ++i) before[i] = force_of(system, eq, s.of[place(i)]);
  const VectorXd change =
      friction_change(system, state, eq, {W, s.lambda}, Shares::all, -sticking_accelerations(system, eq), eq.lambda, before);
  if (!change.allFinite()) return false;
  add_accelerations(change, before, W, eq);
  eq.lambda += s.lambda * change;
  eq.f += s.J * change;
  for (Index i = 0; i < count(s); ++i) {
    const auto& [k, normal, holds] = s.of[place(i)];
    if (of_contact(system, k)) {
      ContactEffect& now = eq.contact[k];
      (normal ? add_normal : add_friction)(system.contacts[k], change[i], now);
      if (!normal && !holds) now.friction_loss = -now.friction * now.gap.material_slip;
    } else {
      JointFrictionEffect& now = eq.friction[joint_friction(system, k)];
      now.force += change[i];
      now.load = load_of(system, eq, joint_friction(system, k), eq.lambda);
    }
  }
  return true;
}

namespace {

// Overlaps of closed rigid contacts.
VectorXd overlaps(const Equations& eq) {
  VectorXd out = VectorXd::Zero(count(eq.sticking));
  for (Index i = 0; i < out.size(); ++i)
    if (const Sticking::Column& c = eq.sticking.of[place(i)]; c.normal) out[i] = eq.contact[c.at].gap.depth;
  return out;
}

}  // namespace

bool remove_slip(const System& system, State& state, Equations& eq) {
  constexpr double closed = 1e-14;
  constexpr int most = 4;
  if (state.friction.empty()) return true;
  evaluate_held(system, state, eq);
  const Sticking& s = eq.sticking;
  if (std::ranges::find(s.of, true, &Sticking::Column::holds) == s.of.end()) return true;
  VectorXd gaps = overlaps(eq);
  for (int i = 0; i < most && largest(gaps) > closed * system.length; ++i) {
    const MatrixXd W = respond_to_sticking(system, eq);
    state.y.head(system.n()) += s.a * holding_forces(system, eq, W, gaps);
    if (!project(system, state.t, state.y, eq)) return false;
    evaluate_held(system, state, eq);
    gaps = overlaps(eq);
  }
  const MatrixXd W = respond_to_sticking(system, eq);
  auto speeds = state.y.segment(system.n(), system.n());
  speeds -= s.a * holding_forces(system, eq, W, s.J.transpose() * speeds);
  speed(system, state.t, state.y, eq);
  return true;
}

}  // namespace pintle
