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

/// From where each value of the parameter is followed.
enum class Order { forwards, backwards, both, from_start };

struct Nonlinear {
  Sweep sweep;  ///< its cases are the values of the parameter; one without any where none varies
  OrbitQuestion question;
  Order order = Order::forwards;

  bool varies() const { return !sweep.cases.names.empty(); }
  /// How often a value is followed in all: of both ways each twice.
  std::size_t size() const { return sweep.cases.size() * (order == Order::both ? 2 : 1); }
  /// Of a number in the journal, from 1: the case, from 0; and which way it is come to.
  std::size_t case_of(std::size_t number) const { return (number - 1) % sweep.cases.size(); }
  bool backwards(std::size_t number) const { return order == Order::backwards || number > sweep.cases.size(); }
  /// Numbers in the order in which they are followed, each from the end of the one before; each list begins at the scene's start.
  std::vector<std::vector<std::size_t>> chains() const;
};

/// Reads a study with a `section` or `lyapunov`. `set` holds for all values, after the study's own.
/// @throws SceneError  naming file, line, key, value and remedy
Nonlinear read_nonlinear(const std::filesystem::path&, const Overrides& set = {});

/// The values that are being followed.
struct Underway {
  std::size_t values = 0;
  double share = 0;  ///< of these, the shares that are done, summed
  std::string at;    ///< of the last of these: "return 37 of 200"
};

/// Follows what has not been followed yet, and leaves in `folder` section.csv, values.csv, orbits.csv and lyapunov.csv beside what a sweep leaves:
/// the same to the bit whatever the number of workers and however often it was killed.
/// @param far  told how far it is, before the settings' progress is
/// @throws as run_sweep
SweepEnd run_nonlinear(const Nonlinear&, const std::filesystem::path& folder, const SweepSettings&,
                       const std::function<void(const Underway&)>& far = {});

/// A value that was followed, as it is told.
struct FollowedValue {
  std::string parameter;  ///< in SI, or as written; empty where none varies
  double x = 0;           ///< as a number; its place in the order where it is none
  bool backwards = false;
  std::string status, reason;
  Orbit orbit;
  std::size_t period = 0;  ///< in returns; 0: none was found
};
/// @pre rows are of this study
std::vector<FollowedValue> followed(const Nonlinear&, const std::vector<Row>& rows);
std::string parameter_header(const Nonlinear&);
/// Of each case the parameter as a number, or its place in the order where it is none.
std::vector<double> parameter_numbers(const Nonlinear&);
/// "height [m]"
std::vector<std::string> signal_headers(const Nonlinear&, const std::vector<Row>& rows);

/// Through what multipliers leave the unit circle.
enum class Crossing { plus_one, minus_one, pair };
struct LossOfStability {
  Crossing through;
  std::size_t before, after;  ///< of the values, next to each other along a branch
  double x;                   ///< about where, by the straight line between their multipliers
};
/// Where along branches of periodic orbits the number of multipliers outside the unit circle changes.
std::vector<LossOfStability> losses_of_stability(const std::vector<FollowedValue>&);
/// "period doubling (multiplier -1)"
std::string crossing_words(Crossing);

/// A row for each return; for each value; for each return of a periodic orbit; for each value and time.
std::string section_csv(const Nonlinear&, const std::vector<Row>& rows);
std::string values_csv(const Nonlinear&, const std::vector<Row>& rows);
std::string orbits_csv(const Nonlinear&, const std::vector<Row>& rows);
std::string lyapunov_csv(const Nonlinear&, const std::vector<Row>& rows);
/// What is told of each value, for programs.
std::string nonlinear_json(const Nonlinear&, const std::vector<Row>& rows);

}  // namespace pintle
