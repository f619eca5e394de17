#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/configuration/redundancy.h"
#include "framework/mechanism/model.h"

namespace pintle {

struct Assembly {
  State start;                        ///< on C = 0 and Ċ = 0; journals where the scene puts them
  int rank = 0;                       ///< of Cq at the start
  std::vector<Redundancy> redundant;  ///< rows that others imply there
  std::vector<bool> shared;           ///< per row: its force is not unique; the least norm shares it out
  double moved = 0;                   ///< how far the worst coordinate went from the rough pose [m or rad]
  int iterations = 0;
  std::vector<std::string> doubts = {};  ///< where it does not follow the drawn pose, in words
};

/// Puts the mechanism together at t = 0: the pose nearest to the rough one that closes every joint and
/// keeps what `start` pins down, then the speeds of least kinetic energy that do the same. A clearance
/// joint is closed as if ideal, its journal at the eccentricity that the scene gives; a massless link whose
/// direction the scene does not give stands as its joint, were it ideal, would press. Redundant joints are
/// no obstacle. In a singular pose, where motions branch, the speeds are those of a branch: the nearest one
/// to the least kinetic energy. docs/theory/constraints.md
/// @throws AssemblyError  naming the joint that stays open, by how much, and what it contradicts; or the
///                        drivers that contradict each other, now or later in the run
Assembly assemble(const Scene&, const Model&);
Assembly assemble(const Scene&, const System&);

/// The first half of it: where coordinates begin, speeds are as the scene says.
/// @param bent  bodies that start bent, and their modal coordinates   @throws AssemblyError  as assemble
Eigen::VectorXd closed_pose(const Scene&, const System&, const std::vector<std::pair<int, Eigen::VectorXd>>& bent);

/// What of an assembly makes a run's numbers doubtful, in words: joint forces shared out by convention, a start in a singular pose.
std::vector<std::string> warnings_of(const Model&, const Assembly&);

/// @throws AssemblyError  where a contact is rigid: `what`, a linearisation, needs contacts that give way
void refuse_rigid_contacts(const Scene&, const System&, const std::string& what);

}  // namespace pintle
