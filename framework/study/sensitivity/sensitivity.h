#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/study/sensitivity/derivative.h"
#include "framework/study/sensitivity/sobol.h"
#include "framework/study/sweep/sweep.h"

/// Dependence of measures on parameters, and their scatter: docs/studies.md.
namespace pintle {

/// A parameter near its nominal value.
struct Scattered {
  std::string name;
  double at = 0;  ///< nominal, SI
  Dimension dimension;
  double step = 0;  ///< of the largest difference
  enum class Spread { none, uniform, normal } spread = Spread::none;
  double width = 0;  ///< half the width of a uniform spread, or the standard deviation

  double drawn(double u) const;  ///< value at u in [0, 1) of its distribution
  double reach() const;          ///< distance of the worst value from the nominal one: the width, or three standard deviations
};

/// Cases in their order: the nominal one; for each parameter and level x + h/2ᵏ and x − h/2ᵏ; corners; the random sample; A, B and AB.
struct SensitivityPlan {
  Sweep sweep;
  std::vector<Scattered> parameters;
  std::size_t levels = 3;
  std::size_t corners = 0;  ///< all, or none
  std::size_t random = 0;   ///< number of cases of the Monte Carlo sample
  std::size_t sobol = 0;    ///< points of each of A and B
  std::uint64_t seed = 1, sobol_seed = 1;

  std::size_t first_difference() const { return 1; }
  std::size_t first_corner() const { return first_difference() + 2 * levels * parameters.size(); }
  std::size_t first_random() const { return first_corner() + corners; }
  std::size_t first_sobol() const { return first_random() + random; }
  std::size_t cases() const { return first_sobol() + sobol * (sobol > 0 ? parameters.size() + 2 : 0); }
};

/// Reads a study with a section `sensitivity`. @throws SceneError
SensitivityPlan read_sensitivity(const std::filesystem::path&, const Overrides& set = {});

/// Results for one measure.
struct MeasureSensitivity {
  std::string header;  ///< with its unit
  double nominal = 0;
  std::vector<Derivative> slopes;  ///< per parameter, in the measure's unit over the parameter's
  double linear_worst = 0;         ///< Σ |slope| · reach
  struct Range {
    double least = 0, greatest = 0;
  };
  std::optional<Range> corners = {};  ///< range of the values there
  struct Scatter {
    std::size_t cases = 0;
    double mean = 0, deviation = 0, low = 0, high = 0;  ///< 95 % lie between low and high
  };
  std::optional<Scatter> scatter = {};
  std::vector<SobolIndex> shares = {};  ///< per parameter
};

/// Evaluates the rows of the sweep. @pre rows in the order of their numbers
std::vector<MeasureSensitivity> sensitivities(const SensitivityPlan&, const std::vector<Row>& rows);

std::string parameter_header(const Scattered&);
std::string sensitivity_csv(const SensitivityPlan&, const std::vector<MeasureSensitivity>&);
std::string sensitivity_json(const SensitivityPlan&, const std::vector<MeasureSensitivity>&);

}  // namespace pintle
