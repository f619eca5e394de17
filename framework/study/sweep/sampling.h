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

/// The cases of a sweep: docs/studies.md. The same study gives the same cases on every machine, to the bit: random numbers, powers and
/// rounding here use only operations that the C++ standard and IEEE 754 define exactly.
namespace pintle {

/// The varied quantities and their values in each case. Numbers are in SI, as the shortest decimal of twelve digits.
struct Cases {
  std::vector<std::string> names;                               ///< parameters or paths, in the order written
  std::vector<std::vector<std::optional<std::string>>> values;  ///< per case, per name; none: as in the scene
  std::vector<Place> places = {};                               ///< per name: its first place in the study

  std::size_t size() const { return values.size(); }
  Overrides overrides(std::size_t k) const;  ///< of case k, from 0
  /// The value of name i in case k, if it is a number, with or without a unit, and not a formula of parameters.
  std::optional<Quantity> quantity(std::size_t k, std::size_t i) const;
};

inline constexpr std::size_t most_cases = 1'000'000;

/// Reads a section with `grid`, `list`, `random` or `latin hypercube`.
/// @param table  of its keys, which may have others
/// @throws SceneError  naming file, line, key, value and remedy
Cases read_cases(const Node& section, const char* table = "study.sweep");
/// All combinations of the values given in a group for each name, as under `grid`. @throws SceneError
Cases read_grid(const Node& group);

/// Interpolates between two values with u ∈ [0, 1], linearly or logarithmically. Rounded to twelve digits.
struct Span {
  double from = 0, to = 1;
  bool logarithmic = false;
  double at(double u) const;
  double where(double x) const;  ///< the inverse, not rounded
};

/// A span as written in a study, {from: 1 mm, to: 2 mm, scale: log}, with its unit.
struct ValueSpan {
  Span span;
  Dimension dimension;
  std::string text(double u) const;  ///< in SI with its unit
  double where(double value) const;  ///< u, from 0 to 1 within the span
};
/// @throws SceneError  the ends have different dimensions, or are not positive on a logarithmic scale
ValueSpan read_span(const Node& group);
/// A value with its unit. @throws SceneError
Quantity read_value(const Node&);
/// A number in SI with its unit, for use in a header.
std::string with_unit(double x, const Dimension&);

/// A stream of random numbers for one name, independent of what else varies.
class Stream {
 public:
  Stream(std::uint64_t seed, std::string_view name);
  double uniform();                      ///< in [0, 1), a multiple of 2⁻⁵³
  std::uint64_t below(std::uint64_t n);  ///< 0 … n − 1, equally likely. @pre n > 0
  /// n points of [0, 1), one in each stratum [k/n, (k + 1)/n), in random order.
  std::vector<double> strata(std::size_t n);

 private:
  std::mt19937_64 numbers_;
};

}  // namespace pintle
