#pragma once

#include <cstddef>
#include <vector>

/// Groups motions by the attractor that they have settled to: docs/nonlinear.md
namespace pintle {

/// A motion's recorded returns, each with the same signals.
using Returns = std::vector<std::vector<double>>;

inline constexpr double least_motion = 1e-12;  ///< in SI: less than any motion of a mechanism

struct SettledMotion {
  Returns returns;
  std::vector<double> largest;  ///< magnitude of each signal in the whole motion
};

/// What makes returns equal or near.
struct Nearness {
  double tolerance = 0.01;  ///< distance at which motions are on one attractor
  double equal = 1e-4;      ///< difference that counts as none, as a share of the largest magnitude of the signal in both motions
};

/// The attractor of each motion, from 1, that of most motions first; 0 for motions without returns.
///
/// Two motions are on one attractor if their returns are as near to each other as returns of one motion are among themselves: the mean
/// distance from a return of one to the nearest of the other (Dubuisson & Jain 1994, both ways) is at most `tolerance` and twice the mean
/// distance from a return to the nearest other of its own motion. Returns that repeat have no distance of their own. The distance of two
/// returns is the greatest of all signals: the difference, divided by the range over all motions or, if that is less, by the largest
/// magnitude in both motions.
std::vector<std::size_t> attractors(const std::vector<SettledMotion>& motions, const Nearness&);

/// Bounds of 95 % on the share of a whole, of which n were drawn at random and k have a property (Wilson 1927).
struct ShareBounds {
  double least = 0, most = 1;
};
ShareBounds share_bounds(std::size_t k, std::size_t n);

}  // namespace pintle
