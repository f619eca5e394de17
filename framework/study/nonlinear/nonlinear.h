#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/study/nonlinear/orbit.h"
#include "framework/study/sweep/sweep.h"

/// Poincaré sections, bifurcation diagrams, periodic orbits, basins of attraction and Lyapunov exponents of a scene: docs/nonlinear.md
namespace pintle {

/// The state from which each value of the parameter is started.
enum class Order { forwards, backwards, both, from_start };

/// Which motions end alike, of starts that differ.
struct BasinsQuestion {
  double tolerance = 0.01;  ///< within which returns are those of one attractor, as a share of the range of each signal
  bool random = false;      ///< the starts are a random sample
};

struct Nonlinear {
  Sweep sweep;  ///< its cases are the values of the parameter, or the starts; a single one without a value if none varies
  OrbitQuestion question;
  Order order = Order::forwards;
  std::optional<BasinsQuestion> basins = {};

  bool varies() const { return !sweep.cases.names.empty(); }
  /// Number of runs: twice the values if both directions are followed.
  std::size_t size() const { return sweep.cases.size() * (order == Order::both ? 2 : 1); }
  /// The case, from 0, and the direction that belong to a number in the journal, from 1.
  std::size_t case_of(std::size_t number) const { return (number - 1) % sweep.cases.size(); }
  bool backwards(std::size_t number) const { return order == Order::backwards || number > sweep.cases.size(); }
  /// Numbers in the order of the runs. Each run starts from the end of the previous one; the first of a list from the scene's start.
  std::vector<std::vector<std::size_t>> chains() const;
};

/// Reads a study with a `section` or `lyapunov`. `set` applies to all values, after the study's own overrides.
/// @throws SceneError  naming file, line, key, value and remedy
Nonlinear read_nonlinear(const std::filesystem::path&, const Overrides& set = {});

/// The values being computed.
struct Underway {
  std::size_t values = 0;
  double share = 0;  ///< sum of their finished shares
  std::string at;    ///< progress of the last of these: "return 37 of 200"
};

/// Computes the values missing in `folder` and writes section.csv, values.csv, orbits.csv, attractors.csv and lyapunov.csv beside the files of a sweep.
/// They are identical to the bit for any number of workers and interruptions; those of an interrupted session have the values so far.
/// @param far  called with the progress, before the settings' progress
/// @throws as run_sweep
SweepEnd run_nonlinear(const Nonlinear&, const std::filesystem::path& folder, const SweepSettings&,
                       const std::function<void(const Underway&)>& far = {});

/// Results of one value.
struct FollowedValue {
  std::vector<std::string> parameters;  ///< of what varies, in SI, or as written
  std::vector<double> at;               ///< as numbers; of one that is none, its position in the list
  bool backwards = false;
  std::string status, reason;
  std::vector<std::string> units;  ///< of the signals recorded
  Orbit orbit;
  std::size_t period = 0;     ///< in returns; 0: none was found
  std::size_t attractor = 0;  ///< from 1, the most frequent first; 0: not asked for, or there are no returns
};
/// @pre rows are of this study
std::vector<FollowedValue> followed(const Nonlinear&, const std::vector<Row>& rows);
/// "omega [rad/s]" for each name that varies.
std::vector<std::string> parameter_headers(const Nonlinear&);
/// "x0 = 1, v0 [m/s] = 2"; empty if nothing varies.
std::string place_words(const Nonlinear&, const FollowedValue&);
/// What varies, of each case, as numbers; of one that is none, its position in the list.
std::vector<std::vector<double>> parameter_numbers(const Nonlinear&);
/// "height [m]"
std::vector<std::string> signal_headers(const Nonlinear&, const std::vector<FollowedValue>&);

/// The starts whose motions end on one attractor.
struct Basin {
  std::size_t starts = 0, first = 0;  ///< how many, and the index of the first
  double share = 0;                   ///< of all starts
};
/// By the numbers of their attractors.
std::vector<Basin> basins(const std::vector<FollowedValue>&);

/// Where multipliers leave the unit circle.
enum class Crossing { plus_one, minus_one, pair };
struct LossOfStability {
  Crossing through;
  std::size_t before, after;  ///< indices of values, neighbours along a branch
  double x;                   ///< estimated parameter, by linear interpolation of a product of their multipliers
};
/// Where along branches of periodic orbits the number of multipliers outside the unit circle changes.
std::vector<LossOfStability> losses_of_stability(const std::vector<FollowedValue>&);
/// "period doubling (multiplier -1)"
std::string crossing_words(Crossing);

/// Headings of the tables that the study writes; units of recorded signals are known only with its rows.
std::vector<std::vector<std::string>> headings_of_tables(const Nonlinear&);
/// A row for each return; for each value; for each return of a periodic orbit; for each attractor; for each value and time.
std::string section_csv(const Nonlinear&, const std::vector<FollowedValue>&);
std::string values_csv(const Nonlinear&, const std::vector<FollowedValue>&);
std::string orbits_csv(const Nonlinear&, const std::vector<FollowedValue>&);
std::string attractors_csv(const Nonlinear&, const std::vector<FollowedValue>&);
std::string lyapunov_csv(const Nonlinear&, const std::vector<FollowedValue>&);
/// The results of each value, for programs.
std::string nonlinear_json(const Nonlinear&, const std::vector<FollowedValue>&);

}  // namespace pintle
