#pragma once

#include "framework/dynamics/equations/equations.h"

/// Forces that the accelerations determine. A force keeps the gap of a closed rigid contact, or the slip of a contact that sticks, at 0, as
/// the multiplier of a constraint equation Jᵀs = 0 does. Sliding friction in a joint is T = −d μ N with N from the joint's own multipliers;
/// in a rigid contact N is its own normal force. These forces come and go, so they are added to the solution without them as a border
/// instead of as rows of Cq. Theory: docs/theory/friction.md, docs/theory/impact.md.
namespace pintle {

/// Whether the friction at this index of State::friction sticks.
bool sticks(const System&, const State&, std::size_t at);
/// Whether it is friction in a released joint, which has no effect.
bool rubs_in_released_joint(const System&, const State&, std::size_t at);
/// Whether this contact is rigid and closed, and the accelerations determine its normal force.
bool holds_gap(const System&, const State&, std::size_t contact);
/// The law of the friction at this index; nullptr if it is not dry.
const Coulomb* dry_law(const System&, std::size_t at);
/// State of the friction at this index, in evaluated equations: force, slip, and the most it can hold, μ_s N; 0 without friction.
struct FrictionNow {
  double force, slip, holds;
};
FrictionNow friction_now(const System&, const Equations&, std::size_t at);

/// Friction in joints due to the forces in the state: fills eq.friction and adds to f. Called by `apply_forces`.
void add_joint_friction(const System&, const State&, Equations&);
/// Fills `of` and J of eq.sticking. After speed, contacts evaluated.
void list_sticking(const System&, const State&, Equations&);
/// Evaluates what is closed or sticks, and lists it. After speed.
void evaluate_held(const System&, const State&, Equations&);
/// a and λ of eq.sticking. After list_sticking. @returns W = Jᵀ a
Eigen::MatrixXd respond_to_sticking(const System&, Equations&);
/// Rates of the opening speeds and slips of eq.sticking for the accelerations eq.a.
Eigen::VectorXd sticking_accelerations(const System&, const Equations&);
/// Updates λ, a, f, contacts and joints to the forces under which no closed gap opens, no sticking contact accelerates along its slip, and
/// sliding friction matches its normal force. Called by `accelerate`. @returns false if no such forces are found
bool hold_sticking(const System&, const State&, Equations&);
/// Closes the gaps of closed rigid contacts, and removes their opening speeds and the slips of sticking contacts from the speeds; leaves
/// `speed` as for the corrected state. After `project`. @returns false if the joints do not let a gap close
bool remove_slip(const System&, State&, Equations&);
/// Stores the forces determined in the state. After accelerate.
void keep_friction(const System&, const Equations&, State&);

/// Effect of 1 N of each column of eq.sticking on the slips and on λ.
struct FrictionResponse {
  const Eigen::MatrixXd &W, &lambda;
};
/// Whether a change of forces redistributes the whole load among the contacts, or only the change, which is then accurate to rounding.
enum class Shares { all, change };
/// Change of the forces T of eq.sticking from `before`: W δT = slips where it holds, T = −d μ N where it slides, with N from the
/// multipliers λ + response δT or from its own contact. If several forces can hold, as at two corners of a box on the ground, each bears a
/// share according to the most it can hold: Σ T²/(μ_s N) is least, among forces that rigid contacts can exert. Nearly equal slips count as
/// one. Not finite where no solution is found.
Eigen::VectorXd friction_change(const System&, const State&, const Equations&, const FrictionResponse&, Shares,
                                const Eigen::VectorXd& slips, const Eigen::VectorXd& lambda, const Eigen::VectorXd& before);
/// Holding forces that remove these slips; 0 for sliding friction.
Eigen::VectorXd holding_forces(const System&, const Equations&, const Eigen::MatrixXd& W, const Eigen::VectorXd& slips);
/// Forces and slips of eq.sticking, in the state and as last evaluated [N], [m/s].
Eigen::VectorXd forces(const State&, const Equations&);
Eigen::VectorXd slips(const System&, const Equations&);
/// Stores the forces, and the joint loads that follow from these multipliers, in the state.
void put_forces(const System&, const Equations&, const Eigen::VectorXd& forces, const Eigen::VectorXd& lambda, State&);

}  // namespace pintle
