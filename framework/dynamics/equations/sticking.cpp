#include "framework/dynamics/equations/sticking.h"

#include <cmath>
#include <variant>

#include "framework/dynamics/equations/sticking_columns.h"

// Which forces the accelerations determine, and the condition for each: the rate of its gap or slip.
namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using namespace sticking_columns;

double sticking_columns::load_of(const System& system, const Equations& eq, std::size_t k, const VectorXd& lambda) {
  const JointFriction& rub = system.frictions[k];
  const std::size_t joint = at(rub.joint);
  const int row = system.row_begin[joint], m = system.row_begin[joint + 1] - row;
  const Wrench on_b = -eq.L[at(system.end_begin[joint]) + 1].topRows(m).transpose() * lambda.segment(row, m);
  return load(system.joints[joint], rub, eq.motion[at(ends_of(system.joints[joint]).marker[0])], on_b);
}

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

// The two markers that one of these forces acts on, and the wrench of 1 N there.
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

// The rate of its opening speed or slip with all coordinate accelerations zero.
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
