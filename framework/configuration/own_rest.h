#pragma once

#include <string>
#include <vector>

#include "framework/configuration/rest.h"

/// Where own states and the mechanism rest together: g = 0 with f − Cqᵀλ = 0. Theory: docs/theory/signals.md, "Rest".
namespace pintle {

/// What becomes of the own states where a mechanism rests.
struct RestingStates {
  std::vector<int> kept;    ///< as they start: their rates see nothing that can rest, or they act on nothing
  std::vector<int> sought;  ///< the others
};
RestingStates resting_states(const System&);

/// Do the sought states follow from each pose, their rates depending on them? @pre rest was projected onto the joints
bool follow_the_pose(const System&, const RestingStates&, const Rest&, double t);

/// Newton's method, damped after Levenberg and Marquardt, on the open directions of the joints and the sought states.
/// @pre rest keeps every state at `own`, and was projected at `state`
struct JointRest {
  bool found = false;
  int iterations = 0;
  std::string reason;                     ///< why not, in words; empty: forces are out of balance
  std::vector<std::string> undetermined;  ///< states for which other values would do as well
};
JointRest find_joint_rest(const System&, Rest&, Eigen::VectorXd& own, const RestingStates&, State&);

/// Of a kept state whose rate is not 0 there, in words; empty if there is none. What stays otherwise goes to `notes`.
std::string moving_state(const System&, const RestingStates&, const State&, std::vector<std::string>& notes);

}  // namespace pintle
