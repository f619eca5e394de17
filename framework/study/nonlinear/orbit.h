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

/// Where the motion is sampled. Texts are expressions of the scene; times may use its parameters.
struct SectionQuestion {
  std::string every;  ///< a time; or
  std::string when;   ///< a condition that becomes true
  std::vector<Recorded> record;
  int transient = 100, returns = 100;
  double tolerance = 1e-4;  ///< of a period, relative to the largest magnitude of each signal
};

/// Settings for Lyapunov exponents.
struct LyapunovQuestion {
  int exponents = 1;
  std::string every, over;
  std::string transient;  ///< empty: a tenth of `over`
  double distance = 1e-6;
};

/// Settings for the periodic orbit near the motion.
struct CycleQuestion {
  int period = 1;        ///< returns
  double tolerance = 0;  ///< of the residual, in scaled coordinates; 0: a hundred times that of the run
  double distance = 0;   ///< of neighbours, likewise; 0: the best of several
};

struct OrbitQuestion {
  std::optional<SectionQuestion> section;
  std::optional<CycleQuestion> cycle = {};
  std::optional<LyapunovQuestion> lyapunov;
};

/// Overrides with which a scene records the signals of a section and finds its returns.
Overrides recording(const OrbitQuestion&);

/// Statistics of impacts in the time of the recorded returns, over all contacts.
struct ImpactFigures {
  double count = 0;                                          ///< that began in that time
  double interval = 0;                                       ///< between beginnings, mean [s]
  double least_approach = 0, median = 0, most_approach = 0;  ///< [m/s]
  double grazing = 0;                                        ///< number of those slower than grazing_share of the median
  double contact_share = 0;                                  ///< share of the time in contact, summed over contacts
};
inline constexpr double grazing_share = 0.05;

/// An exponent and its error [1/s]: the larger of the standard error from the means of batches of intervals and the error due to the ends
/// of the time. NaN with fewer intervals than batches.
struct Exponent {
  double value = 0, error = 0;
};
inline constexpr int exponent_batches = 20;

/// A periodic orbit, stable or not.
struct Cycle {
  std::vector<double> point;                 ///< coordinates, speeds and states at a return; empty if none was found
  double x = 0;                              ///< value of the parameter
  std::vector<std::vector<double>> signals;  ///< at each of its returns, from the point on
  double period = 0;                         ///< [s]
  double least = 0;                          ///< smallest number of returns after which it closes
  std::vector<double> re, im;                ///< of its Floquet multipliers, largest modulus first
  std::vector<double> error;                 ///< error bound of each; NaN: not known
  double continued = 0;                      ///< 1: found from the orbits of previous values; 0: from the motion
  std::vector<double> point_before;          ///< orbit of the previous value, if continued from it
  double x_before = 0;

  bool found() const { return !point.empty(); }
  double modulus(std::size_t j) const;
  double argument(std::size_t j) const;  ///< [rad]
};

enum class OrbitStability { stable, neutral, unstable };
/// Neutral: the largest modulus is 1 within the accuracy of differences. @pre it was found
OrbitStability stability(const Cycle&);
std::string stability_word(OrbitStability);

/// Results at one value of the parameter.
struct Orbit {
  std::vector<double> t;                     ///< of each recorded return [s]
  std::vector<std::vector<double>> signals;  ///< of each
  std::vector<double> largest;               ///< magnitude of each signal at all returns, the skipped ones too
  ImpactFigures impacts;
  double zero_one = std::numeric_limits<double>::quiet_NaN();   ///< K of the first signal; NaN: too few returns
  double dimension = std::numeric_limits<double>::quiet_NaN();  ///< correlation dimension of the section; likewise
  Cycle cycle;
  std::vector<Exponent> exponents;
  std::vector<double> running_t;             ///< [s]
  std::vector<std::vector<double>> running;  ///< estimates of the exponents at these times
  double interval = 0;                       ///< of a section by time [s]
  double end_t = 0;                          ///< time of the final state [s]
  std::vector<double> end;                   ///< final coordinates, speeds and states; empty if there are none

  /// All members as numbers, which a journal stores exactly.
  std::vector<double> numbers() const;
  /// @throws std::invalid_argument  the numbers are not those of an orbit
  static Orbit of(const std::vector<double>& numbers);
};

/// How the computation of a value ended.
struct OrbitEnd {
  std::string status, reason;  ///< as of a case; also "too few returns" and "no periodic orbit"
  Orbit orbit;
  std::vector<std::string> units;     ///< of the signals recorded
  std::vector<std::string> warnings;  ///< of its scene, one line each
  long steps = 0, impacts = 0;
};

/// Times of the computation of Lyapunov exponents, evaluated with the scene's parameters.
struct LyapunovTimes {
  double every = 0;                   ///< [s]
  long transient = 0, intervals = 0;  ///< whole intervals
  double whole() const { return every * static_cast<double>(transient + intervals); }
};
/// @throws std::invalid_argument  `over` is less than `every`
LyapunovTimes lyapunov_times(const CaseSource&, const Overrides&, const LyapunovQuestion&);

/// Limits of one value.
struct OrbitLimits {
  double seconds = 0;  ///< of computing [s]; 0: unlimited
  /// Called from time to time with the finished share and the progress in words; returns false to interrupt.
  std::function<bool(double share, const std::string& at)> go_on = {};
};

/// Computes one value of the parameter, from the scene's start or from the end of another value. Throws only std::bad_alloc.
/// @param x  the parameter, along which periodic orbits are continued
OrbitEnd follow_orbit(const CaseSource&, const Overrides&, const OrbitQuestion&, const Orbit* before, double x, BodyStore&,
                      const OrbitLimits&);

/// The smallest number of returns after which all signals repeat within `tolerance`, relative to the largest magnitude of each, the skipped
/// returns included; 0 if none does up to half of the returns. A signal smaller than a millionth of another with its unit counts as that
/// large, since it may be only rounding.
std::size_t period_of(const Orbit&, const std::vector<std::string>& units, double tolerance);

}  // namespace pintle
