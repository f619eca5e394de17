#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/configuration/rest.h"
#include "framework/scene/units/unlimited.h"

/// Common equilibrium of own states and mechanism: g = 0 with f − Cqᵀλ = 0. Theory: docs/theory/signals.md, "Rest".
namespace pintle {

/// How the own states are treated where a mechanism rests.
struct RestingStates {
  std::vector<int> kept;    ///< held at their start values: their rates depend on nothing that can rest, or they act on nothing
  std::vector<int> sought;  ///< the others
};
RestingStates resting_states(const System&);

/// The system without the limits of the rates of sought states, or of all laws of signals: beyond a limit a law has zero slope, which
/// Newton's method cannot follow. A rate that is 0 within its limits is also 0 without them. Kept states count as fixed. @returns nothing
/// if there are no limits
std::optional<System> without_limits(const System&, const RestingStates&, Limits);

/// Whether the configuration determines the sought states, through their rates. @pre rest was projected onto the joints
bool follow_the_pose(const System&, const RestingStates&, const Rest&, double t);

/// Newton's method, damped as by Levenberg and Marquardt, on the free directions of the joints and the sought states.
/// @pre rest keeps every state at `own`, and was projected at `state`
struct JointRest {
  bool found = false;
  int iterations = 0;
  std::string reason;                     ///< why it failed, in words; empty: forces are out of balance
  std::vector<std::string> undetermined;  ///< states that are not determined: other values are also possible
};
JointRest find_joint_rest(const System&, Rest&, Eigen::VectorXd& own, const RestingStates&, State&);

/// Describes a sought state that rests only without the limits of its rate; empty if there is none.
std::string beyond_its_limit(const System&, const System& unlimited, const RestingStates&, const State&);

/// Describes a held state whose rate is not 0 there; empty if there is none. Other held states are reported in `notes`.
std::string moving_state(const System&, const RestingStates&, const State&, std::vector<std::string>& notes);

}  // namespace pintle
