#pragma once

#include <cstddef>
#include <vector>

namespace pintle {

struct Run;

/// What successive refinements of one number say about the last of them.
struct Ladder {
  std::vector<double> differences;  ///< magnitudes, of neighbours
  double ratio = 0;                 ///< by which they fall a step, geometric mean; 0: they do not fall
  double error = 0;                 ///< estimate of the last value's own
  bool falling = false;             ///< they fall by half or more a step, on the whole and in the last step
  bool rounding = false;            ///< the last two are of the order of rounding
};

/// @param values  coarse to fine, at least two
/// @param cap  no faster fall than this a step is counted on, whatever is observed
/// @param scale  of the value, for what counts as rounding
/// The error is three times what a geometric series leaves beyond the last difference (the larger of it and of what the one before it
/// foretells), so that a lucky small difference does not make it small. Where differences do not fall it is the largest of the last two.
Ladder validate_ladder(const std::vector<double>& values, double cap, double scale);

/// Mean, standard deviation of a single value and standard error of the mean.
struct Sample {
  double mean = 0, deviation = 0, error = 0;
  std::size_t count = 0;
};
Sample sample_of(const std::vector<double>& values);

/// How two runs of nearly the same problem part. Compares the columns in m and rad of their trajectories.
struct Parting {
  double first = 0, last = 0;  ///< largest difference over a column's range: early (first twentieth of the rows), and ever
  double rate = 0;             ///< exponential growth [1/s], fitted below saturation; 0: too few points
  /// They begin close and end far apart, as disturbances do that grow exponentially and not with a power of time.
  bool chaotic() const { return last > 1e-3 && last > 1e3 * first && rate > 0; }
};
Parting parting(const Run&, const Run&);

}  // namespace pintle
