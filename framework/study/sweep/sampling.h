#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "framework/scene/yaml/reader.h"
#include "framework/scene/yaml/yaml_node.h"

/// Which cases a sweep has: docs/studies.md. The same study gives the same cases on every machine, to the bit: random
/// numbers, powers and rounding here use nothing that the C++ standard or IEEE 754 leaves open.
namespace pintle {

/// What varies, and its value in each case. Numbers are SI, as the shortest decimal of twelve digits.
struct Cases {
  std::vector<std::string> names;                               ///< parameters or paths, in the order written
  std::vector<std::vector<std::optional<std::string>>> values;  ///< per case, per name; none: as the scene has it
  std::vector<Place> places = {};                               ///< per name: where the study has it first

  std::size_t size() const { return values.size(); }
  Overrides overrides(std::size_t k) const;  ///< of case k, from 0
  /// The value of name i in case k, if it has one that is a number, with or without a unit, and no formula of parameters.
  std::optional<Quantity> quantity(std::size_t k, std::size_t i) const;
};

inline constexpr std::size_t most_cases = 1'000'000;

/// Reads the section `sweep` of a study: `grid`, `list`, `random` or `latin hypercube`.
/// @throws SceneError  naming file, line, key, value and remedy
Cases read_cases(const Node& sweep);
/// All combinations of the values that a group gives for each name, as under `grid`. @throws SceneError
Cases read_grid(const Node& group);

/// Where u ∈ [0, 1] lies between two values: evenly, or evenly in the logarithm. Rounded to twelve digits.
struct Span {
  double from = 0, to = 1;
  bool logarithmic = false;
  double at(double u) const;
  double where(double x) const;  ///< its inverse, not rounded
};

/// A span as a study writes it, {from: 1 mm, to: 2 mm, scale: log}, with its unit.
struct ValueSpan {
  Span span;
  Dimension dimension;
  std::string text(double u) const;  ///< in SI with its unit
  double where(double value) const;  ///< u, from 0 to 1 inside
};
/// @throws SceneError  the ends are of different kinds, or not above 0 on a logarithmic scale
ValueSpan read_span(const Node& group);
/// A value with its unit. @throws SceneError
Quantity read_value(const Node&);
/// A number in SI with its unit, so that a header can name it.
std::string with_unit(double x, const Dimension&);

/// A stream of numbers for one name, the same whatever else varies.
class Stream {
 public:
  Stream(std::uint64_t seed, std::string_view name);
  double uniform();                      ///< in [0, 1), a multiple of 2⁻⁵³
  std::uint64_t below(std::uint64_t n);  ///< 0 … n − 1, each as likely as the next. @pre n > 0
  /// n points of [0, 1), one in each stratum [k/n, (k + 1)/n), in random order.
  std::vector<double> strata(std::size_t n);

 private:
  std::mt19937_64 numbers_;
};

}  // namespace pintle
