#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "framework/study/nonlinear/orbit.h"
#include "framework/study/sweep/sweep.h"

/// Poincaré sections, bifurcation diagrams, periodic orbits and Lyapunov exponents of a scene: docs/nonlinear.md
namespace pintle {

/// The state from which each value of the parameter is started.
enum class Order { forwards, backwards, both, from_start };

struct Nonlinear {
  Sweep sweep;  ///< its cases are the values of the parameter; a single one without a value if none varies
  OrbitQuestion question;
  Order order = Order::forwards;

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

/// Computes the values missing in `folder` and writes section.csv, values.csv, orbits.csv and lyapunov.csv beside the files of a sweep.
/// They are identical to the bit for any number of workers and interruptions.
/// @param far  called with the progress, before the settings' progress
/// @throws as run_sweep
SweepEnd run_nonlinear(const Nonlinear&, const std::filesystem::path& folder, const SweepSettings&,
                       const std::function<void(const Underway&)>& far = {});

/// Results of one value.
struct FollowedValue {
  std::string parameter;  ///< in SI, or as written; empty if none varies
  double x = 0;           ///< as a number; if it is none, its position in the list
  bool backwards = false;
  std::string status, reason;
  Orbit orbit;
  std::size_t period = 0;  ///< in returns; 0: none was found
};
/// @pre rows are of this study
std::vector<FollowedValue> followed(const Nonlinear&, const std::vector<Row>& rows);
std::string parameter_header(const Nonlinear&);
/// The parameter of each case as a number; if it is none, its position in the list.
std::vector<double> parameter_numbers(const Nonlinear&);
/// "height [m]"
std::vector<std::string> signal_headers(const Nonlinear&, const std::vector<Row>& rows);

/// Where multipliers leave the unit circle.
enum class Crossing { plus_one, minus_one, pair };
struct LossOfStability {
  Crossing through;
  std::size_t before, after;  ///< indices of values, neighbours along a branch
  double x;                   ///< estimated parameter, by linear interpolation of their multipliers
};
/// Where along branches of periodic orbits the number of multipliers outside the unit circle changes.
std::vector<LossOfStability> losses_of_stability(const std::vector<FollowedValue>&);
/// "period doubling (multiplier -1)"
std::string crossing_words(Crossing);

/// Headings of the tables that the study writes; units of recorded signals are known only with its rows.
std::vector<std::vector<std::string>> headings_of_tables(const Nonlinear&);
/// A row for each return; for each value; for each return of a periodic orbit; for each value and time.
std::string section_csv(const Nonlinear&, const std::vector<Row>& rows);
std::string values_csv(const Nonlinear&, const std::vector<Row>& rows);
std::string orbits_csv(const Nonlinear&, const std::vector<Row>& rows);
std::string lyapunov_csv(const Nonlinear&, const std::vector<Row>& rows);
/// The results of each value, for programs.
std::string nonlinear_json(const Nonlinear&, const std::vector<Row>& rows);

}  // namespace pintle
