#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "framework/scene/error.h"
#include "framework/study/case.h"

namespace pintle {

/// A signal that is recorded at each return.
struct Recorded {
  std::string name, expression;
};

/// Where the motion is looked at. Texts are expressions of the scene, times in its parameters.
struct SectionQuestion {
  std::string every;  ///< a time; or
  std::string when;   ///< a condition that turns true
  std::vector<Recorded> record;
  int transient = 100, returns = 100;
  double tolerance = 1e-4;  ///< of a period, next to the largest magnitude of each signal
};

/// What is asked of the growth of small distances.
struct LyapunovQuestion {
  int exponents = 1;
  std::string every, over;
  std::string transient;  ///< empty: a tenth of `over`
  double distance = 1e-6;
};

/// Which periodic orbit is sought near the motion.
struct CycleQuestion {
  int period = 1;        ///< returns
  double tolerance = 0;  ///< of a point that comes again, in coordinates over their scales; 0: a hundred times that of the run
  double distance = 0;   ///< of neighbours, likewise; 0: the best of several
};

struct OrbitQuestion {
  std::optional<SectionQuestion> section;
  std::optional<CycleQuestion> cycle = {};
  std::optional<LyapunovQuestion> lyapunov;
};

/// Overrides by which a scene records what a section asks for, and finds when.
Overrides recording(const OrbitQuestion&);

/// Contacts in the time of the returns that are recorded, of all contacts together.
struct ImpactFigures {
  double count = 0;                                          ///< that began in it
  double interval = 0;                                       ///< between beginnings, mean [s]
  double least_approach = 0, median = 0, most_approach = 0;  ///< [m/s]
  double grazing = 0;                                        ///< of them, slower than grazing_share of the median
  double contact_share = 0;                                  ///< of the time, summed over contacts
};
inline constexpr double grazing_share = 0.05;

/// An exponent, and its error [1/s]: the greater of the standard error of the mean over batches of the intervals, and what the beginning
/// and the end of the time leave. Of fewer intervals than batches it is NaN.
struct Exponent {
  double value = 0, error = 0;
};
inline constexpr int exponent_batches = 20;

/// A periodic orbit, stable or not.
struct Cycle {
  std::vector<double> point;                 ///< coordinates, speeds and states at a return; empty: none was found
  double x = 0;                              ///< the parameter that it is of
  std::vector<std::vector<double>> signals;  ///< at each of its returns, from the point on
  double period = 0;                         ///< [s]
  double least = 0;                          ///< returns after which it closes first
  std::vector<double> re, im;                ///< of its Floquet multipliers, the greatest modulus first
  std::vector<double> error;                 ///< of each, how far it may be off; NaN: not known
  double continued = 0;                      ///< 1: from the orbits of the values before; 0: from the motion
  std::vector<double> point_before;          ///< of the value before, if continued from it, with its parameter
  double x_before = 0;

  bool found() const { return !point.empty(); }
  double modulus(std::size_t j) const;
  double argument(std::size_t j) const;  ///< [rad]
};

enum class OrbitStability { stable, neutral, unstable };
/// Neutral: the greatest modulus is 1 as closely as differences tell. @pre it was found
OrbitStability stability(const Cycle&);
std::string stability_word(OrbitStability);

/// What one value of the parameter has come to.
struct Orbit {
  std::vector<double> t;                     ///< of each return recorded [s]
  std::vector<std::vector<double>> signals;  ///< of each
  ImpactFigures impacts;
  double zero_one = std::numeric_limits<double>::quiet_NaN();   ///< K of the first signal; NaN: too few returns
  double dimension = std::numeric_limits<double>::quiet_NaN();  ///< of the section, by its correlations; likewise
  Cycle cycle;
  std::vector<Exponent> exponents;
  std::vector<double> running_t;             ///< [s]
  std::vector<std::vector<double>> running;  ///< the exponents as they have come to by then
  double interval = 0;                       ///< of a section by time [s]
  double end_t = 0;                          ///< the state to go on from
  std::vector<double> end;                   ///< coordinates, speeds, states; none: there is none

  /// All of it as numbers, which a journal keeps to the bit.
  std::vector<double> numbers() const;
  /// @throws std::invalid_argument  these are no orbit
  static Orbit of(const std::vector<double>& numbers);
};

/// How following an orbit ended.
struct OrbitEnd {
  std::string status, reason;  ///< as of a case; "too few returns"
  Orbit orbit;
  std::vector<std::string> units;  ///< of the signals recorded
  long steps = 0, impacts = 0;
};

/// Times of the growth of distances, in the scene's parameters.
struct LyapunovTimes {
  double every = 0;                   ///< [s]
  long transient = 0, intervals = 0;  ///< whole ones
  double whole() const { return every * static_cast<double>(transient + intervals); }
};
/// @throws std::invalid_argument  `over` is less than `every`
LyapunovTimes lyapunov_times(const CaseSource&, const Overrides&, const LyapunovQuestion&);

/// What one value is followed within.
struct OrbitLimits {
  double seconds = 0;  ///< of computing; 0: none
  /// Told now and then which share of the value is done, and in words what is; false interrupts.
  std::function<bool(double share, const std::string& at)> go_on = {};
};

/// Follows one value of the parameter, from the scene's start or from where another has ended. Never throws but for want of memory.
/// @param x  the parameter, along which periodic orbits are continued
OrbitEnd follow_orbit(const CaseSource&, const Overrides&, const OrbitQuestion&, const Orbit* before, double x, BodyStore&,
                      const OrbitLimits&);

/// The least number of returns after which all signals come again within `tolerance`, next to the largest magnitude of each; 0: none up to
/// half of the returns.
std::size_t period_of(const std::vector<std::vector<double>>& signals, double tolerance);

}  // namespace pintle
