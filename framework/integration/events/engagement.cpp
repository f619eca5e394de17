#include "framework/integration/events/engagement.h"

#include <algorithm>
#include <cmath>

#include "framework/common/index.h"
#include "framework/common/text.h"
#include "framework/dynamics/equations/internal.h"
#include "framework/dynamics/equations/rigid_contacts.h"
#include "framework/integration/events/impact_log.h"

namespace pintle {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double meets = 1e-6;   // of the mechanism's length, or radians: largest gap of a joint at engagement
constexpr double agrees = 1e-9;  // relative to the fastest speed

double& released(const System& system, int k, VectorXd& y) { return y[system.switch_begin() + 2 * k]; }
double& offset(const System& system, int k, VectorXd& y) { return y[system.switch_begin() + 2 * k + 1]; }
double& lost(const System& system, int k, VectorXd& y) {
  const auto z = std::ranges::find_if(system.integrals, [&](const Integral& i) { return i.account == Account::switching && i.index == k; });
  return y[system.z_begin() + (z - system.integrals.begin())];
}

double stored(const System& system, const Switch& s, const Equations& eq) {
  if (s.of == Switch::force) return eq.force[at(s.index)].stored;
  double sum = 0;
  for (int c = s.index; s.of == Switch::contact && c < s.index + system.contacts[at(s.index)].pairs; ++c)
    sum += eq.contact[at(c)].normal.stored;
  return sum;
}

// The energy [J] stored in a contact that is engaged while its surfaces overlap: it begins now, as an impact that has reached this depth.
double stored_at_onset(const System& system, const Switch& s, const State& state) {
  double sum = 0;
  for (int c = s.index; s.of == Switch::contact && c < s.index + system.contacts[at(s.index)].pairs; ++c) {
    const ContactPair& pair = system.contacts[at(c)];
    if (is_rigid(pair) || !(onset_of(system, c, state).value > 0)) continue;
    const Guard gap = gap_of(system, c, state);
    const double latched = std::max({gap.rate, pair.slowest_impact, pair.profiles ? latched_at(system, pair, gap.value) : 0});
    sum += normal_force(system, c, state, latched).stored;
  }
  return sum;
}

void evaluate_forces(const System& system, const State& state, Equations& eq) {
  pose(system, state.t, state.y, eq);
  update_mass(system, state.y, eq);
  speed(system, state.t, state.y, eq);
  apply_forces(system, state, eq);
}

// Discards its memory of the motion before.
void release(const System& system, const Switch& s, State& state) {
  if (s.of == Switch::contact)
    for (int c = s.index; c < s.index + system.contacts[at(s.index)].pairs; ++c) {
      state.impact_rate[at(c)] = 0;
      straighten_bristles(system, c, state);
      if (!state.friction.empty()) state.friction[at(c)] = {};
    }
  for (std::size_t k = 0; k < system.frictions.size(); ++k) {
    if (s.of != Switch::joint || system.frictions[k].joint != s.index) continue;
    state.y.segment(system.x_begin() + system.friction_x[k], bristle_states(system.frictions[k].law)).setZero();
    state.friction[system.contacts.size() + k] = {};
  }
}

// Its own states start at rest.
void rest_states(const System& system, int force, State& state) {
  const Index n = static_cast<Index>(internal_states(system.forces[at(force)]).size());
  if (n == 0) return;
  VectorXd at_rest = state.y;
  relax_internal_states(system, state.t, at_rest);
  const Index begin = system.x_begin() + system.force_x[at(force)];
  state.y.segment(begin, n) = at_rest.segment(begin, n);
}

// Sets the offset of the angle or length that the joint holds to its present value. @returns why it cannot be engaged
std::string latch(const System& system, int k, State& state, Equations& eq) {
  const Switch& s = system.switches[at(k)];
  const Joint& joint = system.joints[at(s.index)];
  pose(system, state.t, state.y, eq);
  const int latched = latched_row(joint), begin = system.row_begin[at(s.index)];
  for (int row = 0; row < rows(joint); ++row) {
    const double left = eq.C[begin + row];
    if (row == latched)
      offset(system, k, state.y) = left;
    else if (!(std::abs(left) * system.row_scale[begin + row] <= meets))
      return "cannot be engaged: its points are " + number_text(std::abs(left), 6) + " m apart (" + row_name(joint, row) + "), and " +
             number_text(meets * system.length, 3) +
             " m is the largest gap that is closed; engage it where they meet, or pull them together by a spring";
  }
  return "";
}

// Teeth mesh in their present gap. Their slip follows from the difference of the depths of their two flanks in the gap at the start.
void mesh(const System& system, const SwitchOver& one, State& state) {
  const int first = system.switches[at(one.at)].index;
  const std::optional<Flank>& flank = system.contacts[at(first)].flank;
  if (!flank || !(one.pitch > 0)) return;
  const double slip =
      flank->side * (gap_of(system, first, state).value - gap_of(system, first + 1, state).value) / (2 * std::cos(flank->angle));
  offset(system, one.at, state.y) = one.pitch * std::round(slip / one.pitch);
}

std::string too_deep(const System& system, const SwitchOver& one, const State& state) {
  const Switch& s = system.switches[at(one.at)];
  for (int c = s.index; c < s.index + system.contacts[at(s.index)].pairs; ++c) {
    if (!(onset_of(system, c, state).value > 0)) continue;
    const double depth = gap_of(system, c, state).value;
    const ContactPair& pair = system.contacts[at(c)];
    const auto overlap = [&](const char* most, const char* remedy) {
      return "cannot be engaged: its surfaces overlap by " + number_text(depth, 6) + " m there, more than " + most + "; " + remedy;
    };
    if (!pair.flank && depth > deepest_valid * contact_size(pair, system.length))
      return overlap("a tenth of their smallest radius", "engage it while they are apart");
    if (pair.flank && depth > pair.flank->half)
      return one.pitch > 0 ? overlap("half the backlash of its teeth, in the nearest gap too",
                                     "engage it where tooth faces gap, by a condition on its column `travel`")
                           : overlap("half the backlash of its teeth, in the gap of the start, which is the only known one",
                                     "give its `teeth`, for all other gaps");
  }
  return "";
}

// Projects the speeds onto the joints; records the energy this removes, joint by joint, and the work of drivers.
void share_impulse(const System& system, std::span<const SwitchOver> changes, State& state, Equations& eq, Engagement& out) {
  VectorXd impulse = eq.Cdot;
  eq.schur.solve(impulse);
  for (const SwitchOver& change : changes) {
    const Switch& s = system.switches[at(change.at)];
    if (s.of != Switch::joint || !change.engage) continue;
    const int row = system.row_begin[at(s.index)], m = system.row_begin[at(s.index) + 1] - row;
    const double gone = impulse.segment(row, m).dot(eq.Cdot.segment(row, m)) / 2;
    lost(system, change.at, state.y) += gone;
    out.lost += gone;
  }
  for (std::size_t j = 0; j < system.joints.size(); ++j)
    if (system.joint_z[j] >= 0) out.work += impulse[system.row_begin[j]] * eq.rows[j].Ct[0];
  book_driver_impulses(system, eq, impulse, state);
}

std::string of_rigid_contacts(const System& system, const State& state) {
  for (std::size_t c = 0; c < system.contacts.size(); ++c)
    if (is_rigid(system.contacts[c]) && state.impact_rate[c] > 0 &&
        gap_of(system, static_cast<int>(c), state).rate > agrees * fastest_rate(system, state.y) * system.length)
      return "cannot be engaged: the impulse would drive the closed rigid contact \"" + system.contact_names[c] +
             "\" together; give that contact a law with a stiffness";
  return "";
}

std::string strike_joints(const System& system, std::span<const SwitchOver> changes, State& state, Equations& eq, Engagement& out) {
  pose(system, state.t, state.y, eq);
  factor(system, state.y, eq);
  if (!eq.regular) return "cannot be engaged in a singular configuration";
  speed(system, state.t, state.y, eq);
  share_impulse(system, changes, state, eq, out);
  if (!project(system, state.t, state.y, eq)) return "cannot be engaged: other joints do not let it close";
  if (!(velocity_violation(system, state.y, eq) <= agrees))
    return "cannot be engaged: it requires speeds that other joints or drivers do not allow";
  return of_rigid_contacts(system, state);
}

}  // namespace

Engagement switch_over(const System& system, std::span<const SwitchOver> asked, State& state, Equations& eq) {
  Engagement out;
  std::vector<SwitchOver> changes;
  for (const SwitchOver& one : asked)
    if ((released(system, one.at, state.y) > 0.5) == one.engage) changes.push_back(one);
  if (changes.empty()) return out;
  out.changed = true;
  const auto fail = [&](int k, const std::string& why) {
    out.trouble = "\"" + switch_name(system, system.switches[at(k)]) + "\" " + why;
    return out;
  };

  evaluate_forces(system, state, eq);
  for (const SwitchOver& one : changes) lost(system, one.at, state.y) += stored(system, system.switches[at(one.at)], eq);
  int engaged = -1;  // last of the engaged joints
  for (const SwitchOver& one : changes) {
    const Switch& s = system.switches[at(one.at)];
    released(system, one.at, state.y) = one.engage ? 0 : 1;
    offset(system, one.at, state.y) = 0;
    if (!one.engage) release(system, s, state);
    if (one.engage && s.of == Switch::force) rest_states(system, s.index, state);
    if (one.engage && s.of == Switch::contact) {
      mesh(system, one, state);
      if (const std::string why = too_deep(system, one, state); !why.empty()) return fail(one.at, why);
    }
    if (one.engage && s.of == Switch::joint) engaged = one.at;
  }
  for (const SwitchOver& one : changes)
    if (one.engage && system.switches[at(one.at)].of == Switch::joint)
      if (const std::string why = latch(system, one.at, state, eq); !why.empty()) return fail(one.at, why);
  if (engaged >= 0)
    if (const std::string why = strike_joints(system, changes, state, eq, out); !why.empty()) return fail(engaged, why);
  for (std::size_t k = 0; k < state.friction.size(); ++k)  // whether it slides or sticks is decided again
    if (k >= system.contacts.size() || state.impact_rate[k] > 0) state.friction[k] = {};
  evaluate_forces(system, state, eq);
  for (const SwitchOver& one : changes) {
    const Switch& s = system.switches[at(one.at)];
    lost(system, one.at, state.y) -= stored(system, s, eq) + stored_at_onset(system, s, state);
  }
  return out;
}

}  // namespace pintle
