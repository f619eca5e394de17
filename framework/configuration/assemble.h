#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/configuration/redundancy.h"
#include "framework/mechanism/model.h"

namespace pintle {

struct Assembly {
  State start;                        ///< satisfies C = 0 and Ċ = 0; journals where the scene puts them
  int rank = 0;                       ///< of Cq at the start
  std::vector<Redundancy> redundant;  ///< rows that others imply at the start
  std::vector<bool> shared;           ///< per row: its force is not unique; the solution of least norm is used
  double moved = 0;                   ///< largest change of a coordinate from the rough pose [m or rad]
  int iterations = 0;
  std::vector<std::string> doubts = {};  ///< where the start deviates from the drawn pose, in words
};

/// Assembles the mechanism at t = 0: the configuration nearest to the rough one that closes every joint and keeps what `start` fixes, then
/// the speeds of least kinetic energy that do the same. A clearance joint is closed as if ideal, with its journal at the eccentricity that
/// the scene gives; a massless link without a direction in the scene gets the direction of the force in the ideal joint. Redundant joints
/// are allowed. In a singular configuration, where motions branch, the speeds are those of the branch nearest to the least kinetic energy.
/// docs/theory/constraints.md
/// @throws AssemblyError  naming the joint that stays open, by how much, and what it contradicts; or the drivers that contradict each
/// other, now or later in the run
Assembly assemble(const Scene&, const Model&);
Assembly assemble(const Scene&, const System&);

/// The first half of it: the initial coordinates, with the speeds of the scene.
/// @param bent  bodies that start deformed, and their modal coordinates   @throws AssemblyError  as assemble
Eigen::VectorXd closed_pose(const Scene&, const System&, const std::vector<std::pair<int, Eigen::VectorXd>>& bent);

/// Properties of an assembly that make the results of a run doubtful, in words: non-unique joint forces, a start in a singular
/// configuration.
std::vector<std::string> warnings_of(const Model&, const Assembly&);

/// @throws AssemblyError  where a contact is rigid: `what`, a linearisation, needs contacts with a finite stiffness
void refuse_rigid_contacts(const Scene&, const System&, const std::string& what);

}  // namespace pintle
