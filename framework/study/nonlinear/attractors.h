#pragma once

#include <cstddef>
#include <vector>

/// Groups motions by the attractor that they have settled to: docs/nonlinear.md
namespace pintle {

/// A motion's recorded returns, each with the same signals.
using Returns = std::vector<std::vector<double>>;

/// The attractor of each motion, from 1, that of most motions first; 0 for motions without returns.
///
/// Two motions are on one attractor if their returns are as near to each other as returns of one motion are among themselves: the mean
/// distance from a return of one to the nearest of the other (Dubuisson & Jain 1994, both ways) is at most `tolerance` and twice the mean
/// distance from a return to the nearest other of its own motion. Returns that repeat have no distance of their own. Distances are the
/// greatest of all signals, each divided by its range over all motions.
std::vector<std::size_t> attractors(const std::vector<Returns>& motions, double tolerance);

/// Bounds of 95 % on the share of a whole, of which n were drawn at random and k have a property (Wilson 1927).
struct ShareBounds {
  double least = 0, most = 1;
};
ShareBounds share_bounds(std::size_t k, std::size_t n);

}  // namespace pintle
