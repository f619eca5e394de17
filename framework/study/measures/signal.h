#pragma once

#include <vector>

/// A quantity over time, from the rows of a run.
namespace pintle {

struct Signal {
  std::vector<double> t, y;        ///< t strictly increasing
  std::vector<double> rate = {};   ///< dy/dt at each row, if known
  bool smooth = true;              ///< a peak between rows can be found with a parabola through three rows
  bool magnitude = false;          ///< never negative
  std::vector<double> jumps = {};  ///< times at which the rate may jump, in order: blows of rigid bodies
};

struct Extreme {
  double value = 0, at = 0;
};

/// The value between rows: by the cubic that fits values and rates, or else by four rows; at a row the row itself.
/// @pre the rows cover t, up to rounding
double value_at(const Signal&, double t);
/// The part from `from` to `to`, with values at both ends. @pre the rows cover it
Signal between(const Signal&, double from, double to);
/// Largest value and its time: between rows by cubics where rates are known, or by lines from the rows beside a known jump of the rate, or
/// by a parabola where the signal is smooth; where neighbouring rows show that it is not, the largest row. With n ≥ 6 rows per period the
/// error of the sampled peak of a sine, (pi/n)^2/2 of its amplitude, is thus reduced to less than (pi/n)^4.
Extreme greatest(const Signal&);
Extreme least(const Signal&);
double mean(const Signal&);  ///< by the trapezoidal rule
double rms(const Signal&);
/// Frequency of the strongest tone: the peak of the Hann-windowed transform with the trend removed, then the tone near it that fits best
/// under this window together with a mean and a trend, so that a single tone is found exactly. NaN with fewer than 1.5 periods, fewer than
/// 16 rows, or a constant signal. @pre rows equally spaced except the last
double dominant_frequency(const Signal&);  ///< [Hz]

}  // namespace pintle
