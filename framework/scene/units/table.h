#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/common/time_law.h"

namespace pintle {

/// Samples of a law of time; t strictly increasing, at least two, all finite.
struct Samples {
  std::vector<double> t, value;
};

/// Reads lines `t value`, separated by comma, semicolon or white space. Text after # is a comment; the first line may be a header.
/// @param time_unit, value_unit  factors to SI
/// @param key  where the scene names the file, for messages   @param first  meaning of its first column, likewise
/// @throws SceneError  naming file, line and remedy
Samples read_samples(const std::filesystem::path&, double time_unit = 1, double value_unit = 1, const std::string& key = {},
                     const std::string& first = "time");

/// Pairs from lines `x y` in a file of the same format, with x in any order.
/// @param unit  factor to SI   @param key  as above   @throws SceneError  likewise
std::vector<std::array<double, 2>> read_pairs(const std::filesystem::path&, double unit, const std::string& key);

/// Values as a function of two numbers; at least two of each, strictly increasing, all finite.
struct Grid {
  std::vector<double> a, b;
  std::vector<double> value;  ///< row by row of a: value[i*b.size() + j]
};

/// Reads a grid: the first line has the values of b, optionally after a word; each further line has a value of a and its row. Separators
/// and comments as above.
/// @param units  factors to SI of a, b and the values   @param names  meaning of a and b, for messages
/// @throws SceneError  naming file, line and remedy
Grid read_grid(const std::filesystem::path&, const std::array<double, 3>& units, const std::string& key,
               const std::array<std::string, 2>& names);

/// Bilinear between the values of a grid; outside it holds the border values.
class Bilinear {
 public:
  explicit Bilinear(Grid grid) : grid_(std::move(grid)) {}
  struct Value {
    double value, by_a, by_b;
  };
  Value operator()(double a, double b) const;
  /// Evaluated on the cell that begins at indices i and j, and extrapolated past its ends; before the first and after the last index the
  /// border value is held.
  Value on_cell(int i, int j, double a, double b) const;
  const Grid& grid() const { return grid_; }

 private:
  Grid grid_;
};

/// Cubic spline through samples, with two continuous derivatives; a cubic is reproduced exactly (not-a-knot ends; two samples give a line,
/// three a parabola). Outside the samples it holds the end value.
class Spline {
 public:
  explicit Spline(Samples);  ///< @pre samples as above
  Jet operator()(double t) const;
  const Samples& samples() const { return samples_; }

 private:
  Samples samples_;
  std::vector<double> curvature_;  ///< second derivative at each sample
};

/// Overshoot: a spline exceeds the two adjacent samples although the samples there rise, fall or are constant.
struct Overshoot {
  double begin, end;  ///< between these two
  double by;          ///< largest overshoot
};
/// The largest overshoot above a hundredth of the samples' range.
std::optional<Overshoot> worst_overshoot(const Spline&);

/// Linear between samples; the rate jumps at each. Outside it holds the end value.
class Polyline {
 public:
  explicit Polyline(Samples samples) : samples_(std::move(samples)) {}
  Jet operator()(double t) const;
  const Samples& samples() const { return samples_; }

 private:
  Samples samples_;
};

}  // namespace pintle
