#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contact/complementarity.h"
#include "framework/dynamics/equations/equations.h"

/// Rigid contacts: the effect of an impact on the speeds, and which contacts stay closed, stick and slide after it. Theory:
/// docs/theory/impact.md.
namespace pintle {

/// The closed rigid contacts, with their forces or impulses as columns of eq.sticking. After list_sticking.
struct Closed {
  std::vector<UnilateralContact> unknowns;
  std::vector<int> contact;
};
Closed closed_contacts(const System&, const State&, const Equations&);
/// Cause and remedy where nothing keeps rigid bodies apart.
inline constexpr const char* pressed_together =
    "a driver may press them together, or they are wedged between others; leave a clearance, or give the contact a law with a stiffness";
/// The fastest speed of bodies at the contacts in eq.sticking, at which approaching speeds do not cancel. @param speeds  their magnitudes
double fastest_there(const Equations&, const Eigen::VectorXd& speeds);
/// Impulses by Newton's law of restitution: a gap that closed at speed −v⁻ opens at −e v⁻ or more; a slip that friction stops continues at
/// −e_T times its speed. Unknowns are the columns of W.
/// @param e  effective restitution of each contact   @param before, free  v⁻, and the speeds without impulses
/// @param fastest  speed of the bodies that meet [m/s]: if a gap closes further by more than a thousandth of it, nothing stops them
/// @returns nothing if none are found that stop all bodies
std::optional<Eigen::VectorXd> newton_impulses(const System&, const Closed&, std::span<const double> e, const Eigen::MatrixXd& W,
                                               const Eigen::VectorXd& before, const Eigen::VectorXd& free, double fastest);
/// Records the energy that impulses x remove from the motion, computed with the mean of the speeds before and after.
void book_impulses(const System&, const Closed&, const Eigen::VectorXd& x, const Eigen::VectorXd& mean, State&);
/// Records the energy that drivers put in by impulses of the joints.
void book_driver_impulses(const System&, const Equations&, const Eigen::VectorXd& impulses, State&);

/// Result of an impact at one contact.
struct Blow {
  int contact;
  double approach;                     ///< speed before it [m/s]
  double separation;                   ///< speed after it; 0: it stays closed [m/s]
  double impulse;                      ///< normal [N s]
  std::optional<double> at_rest = {};  ///< when it comes to rest, if its further bounces are too low to be resolved [s]
};

/// The impact, at one instant, of contacts that touch and of the rigid contacts that are closed: changes the speeds, records the energy
/// lost, and closes the contacts that do not separate. Whether closed contacts, dry contacts and joints stick or slide afterwards is left
/// undecided.
/// @returns nothing in a singular configuration or if no impulses are found; the state is then invalid
std::optional<std::vector<Blow>> strike(const System&, std::span<const int> touching, State&, Equations&);

/// Decides which closed rigid contacts stay closed and which of these stick: under their forces no gap closes further, and no contact
/// pulls. Contacts that slide in the given state continue to slide; all other friction is unchanged. @returns false if there are no such
/// forces
bool decide_rigid(const System&, State&, Equations&);

}  // namespace pintle
