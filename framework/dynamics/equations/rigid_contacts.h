#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contact/complementarity.h"
#include "framework/dynamics/equations/equations.h"

/// Rigid contacts: what an impact does to the speeds, and which contacts stay closed, stick and slide after it. Theory: docs/theory/impact.md.
namespace pintle {

/// The closed rigid contacts, their forces or impulses by the columns of eq.sticking. After list_sticking.
struct Closed {
  std::vector<UnilateralContact> unknowns;
  std::vector<int> contact;
};
Closed closed_contacts(const System&, const State&, const Equations&);
/// Impulses by Newton's law of restitution: a gap that closed at −v⁻ opens at −e v⁻ or more, and of a slip that friction stops −e_T times
/// it is left. Unknowns as the columns of W.
/// @param e  restitution of each contact now   @param before, free  v⁻, and what the speeds would be without impulses
/// @returns nothing where none are found
std::optional<Eigen::VectorXd> newton_impulses(const System&, const Closed&, std::span<const double> e, const Eigen::MatrixXd& W,
                                               const Eigen::VectorXd& before, const Eigen::VectorXd& free);
/// Books what impulses x take out of the motion, at the mean of the speeds before and after.
void book_impulses(const System&, const Closed&, const Eigen::VectorXd& x, const Eigen::VectorXd& mean, State&);
/// Books what drivers put in by impulses of the joints.
void book_driver_impulses(const System&, const Equations&, const Eigen::VectorXd& impulses, State&);

/// What an impact does at one contact.
struct Blow {
  int contact;
  double approach;                     ///< speed before it [m/s]
  double separation;                   ///< speed after it; 0: it stays closed [m/s]
  double impulse;                      ///< normal [N s]
  std::optional<double> at_rest = {};  ///< where it would go on to bounce, lower than speeds and places are known: when it rests [s]
};

/// The impact at one instant of contacts that touch and of the rigid ones that are closed: changes the speeds, books what is lost, and
/// closes those that do not part. What all closed and dry contacts and joints do then is undecided.
/// @returns nothing at a singular pose or where no impulses are found; the state is then of no use
std::optional<std::vector<Blow>> strike(const System&, std::span<const int> touching, State&, Equations&);

/// Of the closed rigid contacts, which stay closed and of these which stick: under their forces no gap closes further, and none pulls.
/// Those that the state has as sliding slide on; all other friction goes on as it is. @returns false where there are no such forces
bool decide_rigid(const System&, State&, Equations&);

}  // namespace pintle
