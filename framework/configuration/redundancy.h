#pragma once

#include <string>
#include <vector>

#include "framework/configuration/row_space.h"

namespace pintle {

/// A constraint row that others already imply.
struct Redundancy {
  int joint, row;
  std::vector<int> implied_by;  ///< joints whose rows combine to it
  bool permanent = true;        ///< false: only in this configuration, a singular one
};

/// Properties of the rows in a configuration.
struct RowReport {
  int rank = 0;
  std::vector<Redundancy> redundant;  ///< in the order of rows
  std::vector<bool> shared;           ///< per row: its force is not unique, others may carry a part of it [Wojtyra]
};

/// Analyses the rows in the configuration y and, if some are redundant, in configurations reached from it by small motions that the joints
/// allow (with drivers released). As many rows as are redundant there too are permanently redundant: those whose null vectors are nearest
/// to the ones there. A force counts as shared if it is so in any of these configurations.
RowReport validate_rows(const System&, double t, const Eigen::VectorXd& y);

/// The dependences that hold in a configuration but not near it: it is singular, and motions branch there.
std::vector<Dependence> singular_dependences(const System&, double t, const Eigen::VectorXd& y);

/// `"crank pin" (x)`
std::string row_text(const System&, int joint, int row);

/// The rows that are marked (with `which` false: not marked), by joint: `"hinge" x, y; "second hinge" y`.
std::string rows_text(const System&, const std::vector<bool>& marked, bool which = true);

/// Describes two or more drivers that impose different values on one degree of freedom, at time t in state y or later, up to `until`, where
/// their laws alone show this. @returns in words, with their names; empty if they agree
std::string contradiction(const System&, double t, const Eigen::VectorXd& y, double until);

/// Why a run cannot continue from a state, if the configuration shows it: a dead centre of a driver, joints that contradict each other,
/// rows that become dependent. @returns in words, with names; empty in a regular configuration
std::string explain_pose(const System&, double t, const Eigen::VectorXd& y);

}  // namespace pintle
