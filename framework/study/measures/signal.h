#pragma once

#include <vector>

/// A quantity over time, as the rows of a run give it.
namespace pintle {

struct Signal {
  std::vector<double> t, y;       ///< t strictly increasing
  std::vector<double> rate = {};  ///< dy/dt at each row, if known
  bool smooth = true;             ///< a parabola through three rows finds a peak between them
  bool magnitude = false;         ///< never negative
};

struct Extreme {
  double value = 0, at = 0;
};

/// At a time between the rows: by the cubic that fits values and rates, or else four rows; at a row the row itself.
/// @pre the rows cover t, but for rounding
double value_at(const Signal&, double t);
/// The part from `from` to `to`, with values at both ends. @pre the rows cover it
Signal between(const Signal&, double from, double to);
/// Greatest value and its time: between rows by cubics where rates are known, by a parabola where the signal is smooth. Of
/// an error of the sampled peak of a sine, (pi/n)^2/2 of its amplitude at n rows a period, that leaves less than (pi/n)^4.
Extreme greatest(const Signal&);
Extreme least(const Signal&);
double mean(const Signal&);  ///< trapezoids
double rms(const Signal&);
/// Of the strongest tone: the peak of the Hann-windowed transform, trend taken away, then the tone near it that fits best
/// under that window together with a mean and a trend, so that a tone alone is found exactly. NaN with fewer than 1.5
/// periods, fewer than 16 rows, or nothing that changes. @pre rows equally far apart but for the last
double dominant_frequency(const Signal&);  ///< [Hz]

}  // namespace pintle
