#pragma once

#include "framework/dynamics/equations/equations.h"

/// Contacts of dry friction that stick: each holds its slip σ at 0 by a force T along Zn, as a constraint equation Jᵀs = 0 does by
/// its multiplier. They come and go, so they are bordered onto the solution without them instead of being rows of Cq.
/// Theory: docs/theory/friction.md.
namespace pintle {

bool sticks(const System&, const State&, std::size_t contact);
/// The most that friction holds, μ_s N [N]. @pre dry_friction(system.contacts[contact]), evaluated
double holds_at_most(const System&, const Equations&, std::size_t contact);

/// Notes in eq.sticking which contacts stick, and J. After speed, contacts evaluated.
void list_sticking(const System&, const State&, Equations&);
/// Adds to λ, a, f and the contacts the forces under which nothing that sticks is accelerated along its slip. In `accelerate`.
void hold_sticking(const System&, const State&, Equations&);
/// Takes out of the speeds what slip there is of contacts that stick; leaves `speed` as for the corrected state. After `project`.
void remove_slip(const System&, State&, Equations&);
/// The forces that hold, kept in the state. After accelerate.
void keep_holding_forces(const Equations&, State&);

/// T of W T = rhs. Where others could hold as well, as at two corners of a box on one ground, each bears a part after what it
/// holds at most: Σ T²/(μ_s N) is least. Slips that hardly differ count as one.
Eigen::VectorXd share_out_friction(const System&, const Equations&, const Eigen::MatrixXd& W, const Eigen::VectorXd& rhs);
/// Of what sticks, as contacts were last evaluated [m/s].
Eigen::VectorXd slips(const Equations&);

}  // namespace pintle
