#pragma once

#include "framework/dynamics/equations/equations.h"

/// Forces that the accelerations decide. A closed rigid contact holds its gap, and what sticks its slip, at 0 by a force, as a constraint
/// equation Jᵀs = 0 does by its multiplier; what slides in a joint has T = −d μ N with N of the joint's own multipliers, what slides in a
/// rigid contact with its own normal force. These come and go, so they are bordered onto the solution without them instead of being rows of
/// Cq. Theory: docs/theory/friction.md, docs/theory/impact.md.
namespace pintle {

/// The friction at this place of State::friction sticks.
bool sticks(const System&, const State&, std::size_t at);
/// It is friction in a joint that is released: it does nothing.
bool rubs_in_released_joint(const System&, const State&, std::size_t at);
/// This contact is rigid and closed, and its normal force is for the accelerations to decide.
bool holds_gap(const System&, const State&, std::size_t contact);
/// The law of the friction at this place; nullptr where that is not dry.
const Coulomb* dry_law(const System&, std::size_t at);
/// What it says of the friction at this place, in evaluated equations: force, slip, and the most that it holds, μ_s N; 0 without friction.
struct FrictionNow {
  double force, slip, holds;
};
FrictionNow friction_now(const System&, const Equations&, std::size_t at);

/// What friction in joints does with the forces that the state has: eq.friction, and their share of f. In `apply_forces`.
void add_joint_friction(const System&, const State&, Equations&);
/// Fills `of` and J of eq.sticking. After speed, contacts evaluated.
void list_sticking(const System&, const State&, Equations&);
/// Evaluates what is closed or sticks, and lists it. After speed.
void evaluate_held(const System&, const State&, Equations&);
/// a and λ of eq.sticking. After list_sticking. @returns W = Jᵀ a
Eigen::MatrixXd respond_to_sticking(const System&, Equations&);
/// Rates of the opening speeds and slips of eq.sticking under the accelerations eq.a.
Eigen::VectorXd sticking_accelerations(const System&, const Equations&);
/// Brings λ, a, f, contacts and joints to the forces under which no closed gap opens, nothing that sticks is accelerated along its slip,
/// and what slides rubs as it is pressed. In `accelerate`. @returns false where no such forces are found
bool hold_sticking(const System&, const State&, Equations&);
/// Closes the gaps of closed rigid contacts, and takes their opening speeds, and slips of what sticks, out of the speeds; leaves `speed`
/// as for the corrected state. After `project`. @returns false where the joints do not let a gap close
bool remove_slip(const System&, State&, Equations&);
/// What was decided, kept in the state. After accelerate.
void keep_friction(const System&, const Equations&, State&);

/// Of the columns of eq.sticking, what 1 N of each does to the slips and to λ.
struct FrictionResponse {
  const Eigen::MatrixXd &W, &lambda;
};
/// Does a change of forces share out again what several could hold, or only what it changes, to its own last digits?
enum class Shares { all, change };
/// Change of the forces T of eq.sticking from `before`: W δT = slips for what holds, T = −d μ N for what slides, N of the multipliers
/// λ + response δT or of its own contact. Where others could hold as well, as at two corners of a box on one ground, each bears a part after what it
/// holds at most: Σ T²/(μ_s N) is least, among forces that rigid contacts can give. Slips that hardly differ count as one. Not finite where
/// nothing is found.
Eigen::VectorXd friction_change(const System&, const State&, const Equations&, const FrictionResponse&, Shares,
                                const Eigen::VectorXd& slips, const Eigen::VectorXd& lambda, const Eigen::VectorXd& before);
/// Of what holds alone: forces that take away these slips, 0 for what slides.
Eigen::VectorXd holding_forces(const System&, const Equations&, const Eigen::MatrixXd& W, const Eigen::VectorXd& slips);
/// Of eq.sticking, in the state and as last evaluated [N], [m/s].
Eigen::VectorXd forces(const State&, const Equations&);
Eigen::VectorXd slips(const System&, const Equations&);
/// Puts forces, and the loads of joints that go with these multipliers, into the state.
void put_forces(const System&, const Equations&, const Eigen::VectorXd& forces, const Eigen::VectorXd& lambda, State&);

}  // namespace pintle
