#pragma once

#include <string>
#include <vector>

#include "framework/run/build.h"

namespace pintle {

/// A constraint row that others already imply at the starting pose.
struct Redundancy {
  int joint, row;
  std::vector<int> implied_by;  ///< joints whose rows combine to it
};

struct Assembly {
  State start;                ///< on C = 0 and Ċ = 0; journals where the scene puts them
  int rank = 0;               ///< of Cq at the start
  std::vector<Redundancy> redundant;
  double moved = 0;           ///< how far the worst coordinate went from the rough pose [m or rad]
  int iterations = 0;
};

/// Puts the mechanism together at t = 0: the pose nearest to the rough one that closes every joint and
/// keeps what `start` pins down, then the speeds of least kinetic energy that do the same. A clearance
/// joint is closed as if ideal, its journal at the eccentricity that the scene gives.
/// @throws AssemblyError  naming the joint that stays open, by how much, and what it contradicts
Assembly assemble(const Scene&, const Model&);

/// @throws AssemblyError  the assembly found a redundant row; names the joint and what implies it
void refuse_redundancy(const Scene&, const Model&, const Assembly&);

/// The rows of Cq at a state that depend on rows before them.
std::vector<Redundancy> redundant_rows(const System&, const Equations&);

/// `joint "crank pin", x`
std::string row_text(const System&, int joint, int row);

}  // namespace pintle
