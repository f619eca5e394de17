#pragma once

#include <cstddef>
#include <vector>

namespace pintle {

struct Run;

/// Convergence of a number under successive refinements.
struct Ladder {
  std::vector<double> differences;  ///< magnitudes, of neighbours
  double ratio = 0;                 ///< by which they fall per step, geometric mean; 0: they do not fall
  double error = 0;                 ///< error estimate of the last value
  bool falling = false;             ///< they fall at least by half per step, on average and in the last step
  bool rounding = false;            ///< the last two are of the size of rounding
};

/// @param values  coarse to fine, at least two
/// @param cap  upper limit of the ratio per step, even if the observed one is larger
/// @param scale  of the value, to identify rounding
/// The error is three times the remainder of a geometric series beyond the last difference (the larger of it and the one predicted from the
/// difference before), so that a difference small by chance does not reduce it. Where differences do not fall, it is the largest of the
/// last two.
Ladder validate_ladder(const std::vector<double>& values, double cap, double scale);

/// Mean, standard deviation of a single value and standard error of the mean.
struct Sample {
  double mean = 0, deviation = 0, error = 0;
  std::size_t count = 0;
};
Sample sample_of(const std::vector<double>& values);

/// Divergence of two runs of nearly the same problem. Compares the columns in m and rad of their trajectories.
struct Parting {
  double first = 0, last = 0;  ///< largest difference relative to a column's range: early (first twentieth of the rows), and overall
  double rate = 0;             ///< exponential growth [1/s], fitted below saturation; 0: too few points
  /// Whether they begin close and end far apart, as with a disturbance that grows exponentially, not as a power of time.
  bool chaotic() const { return last > 1e-3 && last > 1e3 * first && rate > 0; }
};
Parting parting(const Run&, const Run&);

}  // namespace pintle
