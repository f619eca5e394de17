#include "framework/dynamics/equations/sticking.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "framework/common/dense.h"
#include "framework/common/index.h"
#include "framework/common/worse.h"
#include "framework/dynamics/equations/sharing.h"

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Places = std::vector<Index>;

namespace {

bool of_contact(const System& system, std::size_t k) { return k < system.contacts.size(); }
std::size_t joint_friction(const System& system, std::size_t k) { return k - system.contacts.size(); }
Index count(const Sticking& s) { return static_cast<Index>(s.of.size()); }
std::size_t place(Index i) { return static_cast<std::size_t>(i); }

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

// N of a friction in a joint, of any multipliers.
double load_of(const System& system, const Equations& eq, std::size_t k, const VectorXd& lambda) {
  const JointFriction& rub = system.frictions[k];
  const std::size_t joint = at(rub.joint);
  const int row = system.row_begin[joint], m = system.row_begin[joint + 1] - row;
  const Wrench on_b = -eq.L[at(system.end_begin[joint]) + 1].topRows(m).transpose() * lambda.segment(row, m);
  return load(system.joints[joint], rub, eq.motion[at(ends_of(system.joints[joint]).marker[0])], on_b);
}

}  // namespace

const Coulomb* dry_law(const System& system, std::size_t k) {
  return of_contact(system, k) ? dry_friction(system.contacts[k]) : std::get_if<Coulomb>(&system.frictions[joint_friction(system, k)].law);
}

bool rubs_in_released_joint(const System& system, const State& state, std::size_t k) {
  return !of_contact(system, k) && is_released(system, Switch::joint, system.frictions[joint_friction(system, k)].joint, state.y);
}

bool sticks(const System& system, const State& state, std::size_t k) {
  if (rubs_in_released_joint(system, state, k)) return false;
  if (state.friction.empty() || state.friction[k].direction != 0 || !dry_law(system, k)) return false;
  return !of_contact(system, k) || state.impact_rate[k] > 0;
}

bool holds_gap(const System& system, const State& state, std::size_t contact) {
  return is_rigid(system.contacts[contact]) && state.impact_rate[contact] > 0 && state.friction[contact].direction != DryFriction::given;
}

FrictionNow friction_now(const System& system, const Equations& eq, std::size_t k) {
  const Coulomb* law = dry_law(system, k);
  const double static_part = law ? law->mu_static : 0;
  if (of_contact(system, k)) {
    const ContactEffect& now = eq.contact[k];
    return {now.friction, now.gap.material_slip, static_part * now.normal.force};
  }
  const JointFrictionEffect& now = eq.friction[joint_friction(system, k)];
  return {now.force, now.slip, static_part * now.load};
}

namespace {

// Of what slides, under this load.
double sliding_force(const System& system, const State& state, const Equations& eq, std::size_t k, double load) {
  const Coulomb* dry = dry_law(system, k);
  if (!dry) return eq.friction[joint_friction(system, k)].per_load * load;
  return evaluate(*dry, friction_now(system, eq, k).slip, load, state.friction[k].direction).force;
}

// The two markers that one of these forces acts on, and what 1 N of it does there.
struct Acting {
  std::array<int, 2> marker;
  std::array<Wrench, 2> unit;
};
Acting acting(const System& system, const Equations& eq, const Sticking::Column& c) {
  if (of_contact(system, c.at)) {
    const ContactPair& pair = system.contacts[c.at];
    const Gap& gap = eq.contact[c.at].gap;
    return {{pair.a, pair.b}, c.normal ? unit_normal(pair, gap) : unit_friction(pair, gap)};
  }
  const JointFriction& rub = system.frictions[joint_friction(system, c.at)];
  const Joint& joint = system.joints[at(rub.joint)];
  const JointEnds ends = ends_of(joint);
  return {{ends.marker[0], ends.marker[1]}, unit_friction(joint, rub, eq.motion[at(ends.marker[0])], eq.motion[at(ends.marker[1])])};
}

// The rate of its opening speed or slip where no coordinate is accelerated.
double own_acceleration(const System& system, const Equations& eq, const Sticking::Column& c) {
  if (of_contact(system, c.at)) {
    const ContactPair& pair = system.contacts[c.at];
    const MarkerMotion &a = eq.motion[at(pair.a)], &b = eq.motion[at(pair.b)];
    const Gap& gap = eq.contact[c.at].gap;
    return c.normal ? opening_acceleration(pair, gap, a, b) : slip_acceleration(pair, gap, a, b);
  }
  const JointFriction& rub = system.frictions[joint_friction(system, c.at)];
  const Joint& joint = system.joints[at(rub.joint)];
  const JointEnds ends = ends_of(joint);
  return slip_acceleration(joint, rub, eq.motion[at(ends.marker[0])], eq.motion[at(ends.marker[1])]);
}

double force_of(const System& system, const Equations& eq, const Sticking::Column& c) {
  return c.normal ? eq.contact[c.at].normal.force : friction_now(system, eq, c.at).force;
}

}  // namespace

void list_sticking(const System& system, const State& state, Equations& eq) {
  Sticking& s = eq.sticking;
  s.of.clear();
  for (std::size_t k = 0; k < state.friction.size(); ++k) {
    if (rubs_in_released_joint(system, state, k)) continue;
    const bool holds = sticks(system, state, k), in_contact = of_contact(system, k), rigid = in_contact && holds_gap(system, state, k);
    if (rigid) s.of.push_back({k, true, true});
    if (holds || !in_contact || (rigid && std::abs(state.friction[k].direction) == 1 && dry_law(system, k)))
      s.of.push_back({k, false, holds});
  }
  s.J.resize(system.n(), count(s));
  VectorXd column(system.n());
  for (Index i = 0; i < count(s); ++i) {
    const Acting on = acting(system, eq, s.of[place(i)]);
    column.setZero();
    for (std::size_t end = 0; end < 2; ++end) add_wrench(system, eq, on.marker[end], on.unit[end], column);
    s.J.col(i) = column;
  }
}

MatrixXd respond_to_sticking(const System& system, Equations& eq) {
  Sticking& s = eq.sticking;
  s.a.resize(s.J.rows(), s.J.cols());
  s.lambda.resize(system.n_rows(), s.J.cols());
  VectorXd a, lambda;
  for (Index i = 0; i < s.J.cols(); ++i) {
    a = s.J.col(i);
    respond(system, eq, a, lambda);
    s.a.col(i) = a;
    s.lambda.col(i) = lambda;
  }
  return s.J.transpose() * s.a;
}

VectorXd sticking_accelerations(const System& system, const Equations& eq) {
  VectorXd out = eq.sticking.J.transpose() * eq.a;
  for (Index i = 0; i < out.size(); ++i) out[i] += own_acceleration(system, eq, eq.sticking.of[place(i)]);
  return out;
}

namespace {

// What each holds at most, of a normal force as much as any friction.
VectorXd capacity(const System& system, const Equations& eq, const Places& of) {
  VectorXd out(static_cast<Index>(of.size()));
  const auto column = [&](Index i) -> const Sticking::Column& { return eq.sticking.of[place(of[place(i)])]; };
  for (Index i = 0; i < out.size(); ++i) out[i] = column(i).normal ? 0 : friction_now(system, eq, column(i).at).holds;
  const double most = out.size() > 0 ? out.maxCoeff() : 0;
  for (Index i = 0; i < out.size(); ++i)
    if (column(i).normal) out[i] = most;
  return out;
}

// The rigid contacts among what holds, by their places there.
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

// What slides in a rigid contact rubs as its own normal force presses it, T = c N: what 1 N of that does, with its friction.
struct Coupled {
  MatrixXd W, lambda, by_friction;     ///< the last: of the multipliers, what its friction does alone
  Places normal, friction, of_joints;  ///< columns of such contacts, and of what slides in joints
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

// What slides in joints makes this nonlinear, for N is a norm of λ: Newton's method on T_i + d_i μ_i N_i = 0, what holds solved for in each.
VectorXd friction_change(const System& system, const State& state, const Equations& eq, const FrictionResponse& by, Shares shares,
                         const VectorXd& slips, const VectorXd& lambda, const VectorXd& before) {
  constexpr int most = 30;
  constexpr double enough = 1e-13, little = 1e-6;
  const Sticking& s = eq.sticking;
  const Coupled with = couple(system, state, eq, by);
  const Places hold = those(s, true), &slide = with.of_joints;
  const MatrixXd W_hold = part(with.W, hold, hold), W_slide = part(by.W, hold, slide);
  const VectorXd off = with.c.cwiseProduct(part(before, with.normal)) - part(before, with.friction);  // as they press now
  const VectorXd holds = capacity(system, eq, hold), held = shares == Shares::all ? part(before, hold) : VectorXd::Zero(W_hold.rows()),
                 asked = W_hold * held + part(slips, hold) - part(by.W, hold, with.friction) * off,
                 lambda_off = lambda + with.by_friction * off;
  const std::vector<UnilateralContact> rigid = rigid_among(system, s, hold);
  const double one = rigid.empty() ? one_give : one_force;
  VectorXd change = VectorXd::Zero(before.size()), loads(static_cast<Index>(slide.size()));
  const auto missed = [&](const VectorXd& sliding) {  // a change of what slides
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
  const double others = largest(before) + largest(lambda) + largest(eq.f);  // beside which a load that vanishes is rounding
  double left_before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most && slide.size() > 0; ++i) {
    const double scale = largest(loads) + largest(left), error = largest(left);
    const bool stagnates = error <= enough * (scale + others) && error > std::exchange(left_before, error) / 2;
    if (error <= enough * scale || stagnates) break;
    if (i + 1 == most) return VectorXd::Constant(before.size(), std::numeric_limits<double>::quiet_NaN());
    MatrixXd slope(sliding.size(), sliding.size());
    const double h = little * scale;
    for (Index j = 0; j < sliding.size(); ++j) slope.col(j) = (missed(sliding + h * VectorXd::Unit(sliding.size(), j)) - left) / h;
    sliding -= slope.partialPivLu().solve(left);
    left = missed(sliding);
  }
  put(with.c.cwiseProduct(part(change, with.normal)) + off, with.friction, change);
  return change;
}

namespace {

// Of each force the greatest of all that press on each other with it: of that, solving for them at once loses the last digits.
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

// What balanced forces of rigid contacts leave in the last digits is none: a body at rest would else be followed as if it moved.
void add_accelerations(const VectorXd& change, const VectorXd& before, const MatrixXd& W, Equations& eq) {
  const Sticking& s = eq.sticking;
  eq.a += s.a * change;
  if (std::ranges::find(s.of, true, &Sticking::Column::normal) == s.of.end()) return;
  const double rounding = 2e-15 * (5 + static_cast<double>(count(s)));  // of sums of so many terms
  const VectorXd terms = s.a.cwiseAbs() * greatest_together(W, before.cwiseAbs() + change.cwiseAbs());
  eq.a = (eq.a.array().abs() > rounding * terms.array()).select(eq.a, 0);
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

void keep_friction(const System& system, const Equations& eq, State& state) {
  if (state.friction.empty()) return;
  for (const auto& [k, normal, holds] : eq.sticking.of) {
    if (normal)
      state.friction[k].load = eq.contact[k].normal.force;
    else
      state.friction[k].force = friction_now(system, eq, k).force;
    if (!of_contact(system, k)) state.friction[k].load = eq.friction[joint_friction(system, k)].load;
  }
}

void evaluate_held(const System& system, const State& state, Equations& eq) {
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    const ContactPair& pair = system.contacts[c];
    if (sticks(system, state, c) || holds_gap(system, state, c))
      eq.contact[c] = evaluate(pair, eq.motion[at(pair.a)], eq.motion[at(pair.b)], state.impact_rate[c], state.friction[c]);
  }
  list_sticking(system, state, eq);
}

namespace {

// By how far closed rigid contacts overlap.
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

VectorXd forces(const State& state, const Equations& eq) {
  VectorXd out(count(eq.sticking));
  for (Index i = 0; i < out.size(); ++i) out[i] = state.friction[eq.sticking.of[place(i)].at].force;
  return out;
}

VectorXd slips(const System& system, const Equations& eq) {
  VectorXd out(count(eq.sticking));
  for (Index i = 0; i < out.size(); ++i) out[i] = friction_now(system, eq, eq.sticking.of[place(i)].at).slip;
  return out;
}

void put_forces(const System& system, const Equations& eq, const VectorXd& force, const VectorXd& lambda, State& state) {
  for (Index i = 0; i < force.size(); ++i) {
    const std::size_t k = eq.sticking.of[place(i)].at;
    state.friction[k].force = force[i];
    if (!of_contact(system, k)) state.friction[k].load = load_of(system, eq, joint_friction(system, k), lambda);
  }
}

}  // namespace pintle
