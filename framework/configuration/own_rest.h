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

/// The system without limits of the rates of sought states, which are 0 within these limits as without them; or without the limits of all
/// laws of signals. Beyond a limit a law has no slope to follow. Kept states count as fixed. @returns nothing where there are none
std::optional<System> without_limits(const System&, const RestingStates&, Limits);

/// Are the sought states determined by the configuration, through their rates? @pre rest was projected onto the joints
bool follow_the_pose(const System&, const RestingStates&, const Rest&, double t);

/// Newton's method, damped as by Levenberg and Marquardt, on the free directions of the joints and the sought states.
/// @pre rest keeps every state at `own`, and was projected at `state`
struct JointRest {
  bool found = false;
  int iterations = 0;
  std::string reason;                     ///< why it failed, in words; empty: forces are out of balance
  std::vector<std::string> undetermined;  ///< states that are not determined: other values would do as well
};
JointRest find_joint_rest(const System&, Rest&, Eigen::VectorXd& own, const RestingStates&, State&);

/// Describes a sought state that rests only without the limits of its rate; empty if there is none.
std::string beyond_its_limit(const System&, const System& unlimited, const RestingStates&, const State&);

/// Describes a held state whose rate is not 0 there; empty if there is none. Other held states are reported in `notes`.
std::string moving_state(const System&, const RestingStates&, const State&, std::vector<std::string>& notes);

}  // namespace pintle
