#pragma once

#include <string>
#include <vector>

#include "framework/configuration/row_space.h"

namespace pintle {

/// A constraint row that others already imply.
struct Redundancy {
  int joint, row;
  std::vector<int> implied_by;  ///< joints whose rows combine to it
  bool permanent = true;        ///< false: at this pose only, a singular one
};

/// What a pose says of the joints, by rows.
struct RowReport {
  int rank = 0;
  std::vector<Redundancy> redundant;  ///< in the order of rows
  std::vector<bool> shared;           ///< per row: its force is not unique, others may bear a part of it [Wojtyra]
};

/// Judges the rows at a pose y and, where some are redundant, at poses reached from it by small motions that the
/// joints allow (drivers let go). As many rows as are redundant there too are permanently so, those whose null vectors are
/// nearest to the ones there; a force is shared if it is at any of these poses.
RowReport validate_rows(const System&, double t, const Eigen::VectorXd& y);

/// The dependences that hold at a pose and not near it: it is singular, motions branch there.
std::vector<Dependence> singular_dependences(const System&, double t, const Eigen::VectorXd& y);

/// `"crank pin" (x)`
std::string row_text(const System&, int joint, int row);

/// The rows that are (or, `which` false, are not) marked, by joint: `"hinge" x, y; "second hinge" y`.
std::string rows_text(const System&, const std::vector<bool>& marked, bool which = true);

/// Two drivers, or more, that ask different things of one freedom, at time t in state y or at a later time up to
/// `until` where their laws alone can tell. @returns in words, with their names; empty if they agree
std::string contradiction(const System&, double t, const Eigen::VectorXd& y, double until);

/// Why a run cannot go on from a state, if its pose tells: a dead centre of a driver, joints that contradict each other,
/// rows become dependent. @returns in words, with names; empty if the pose is a regular one
std::string explain_pose(const System&, double t, const Eigen::VectorXd& y);

}  // namespace pintle
