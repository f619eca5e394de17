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

/// Reads lines `t value`, separated by comma, semicolon or white space. Lines after # are comments;
/// the first line may be a header.
/// @param time_unit, value_unit  factors to SI
/// @param key  where the scene names the file, for messages   @param first  what its first column is, likewise
/// @throws SceneError  naming file, line and remedy
Samples read_samples(const std::filesystem::path&, double time_unit = 1, double value_unit = 1, const std::string& key = {},
                     const std::string& first = "time");

/// Pairs from lines `x y`, in a file written likewise, x in any order.
/// @param unit  factor to SI   @param key  as above   @throws SceneError  likewise
std::vector<std::array<double, 2>> read_pairs(const std::filesystem::path&, double unit, const std::string& key);

/// Values over two numbers; at least two of each, strictly increasing, all finite.
struct Grid {
  std::vector<double> a, b;
  std::vector<double> value;  ///< a by a: value[i*b.size() + j]
};

/// Reads a grid: the first line the numbers of b, behind a word or nothing; each further line a number of a and its values.
/// Separators and comments as above.
/// @param units  factors to SI of a, b and the values   @param names  what a and b are, for messages
/// @throws SceneError  naming file, line and remedy
Grid read_grid(const std::filesystem::path&, const std::array<double, 3>& units, const std::string& key,
               const std::array<std::string, 2>& names);

/// Bilinear between the values of a grid; outside it holds those at its border.
class Bilinear {
 public:
  explicit Bilinear(Grid grid) : grid_(std::move(grid)) {}
  struct Value {
    double value, by_a, by_b;
  };
  Value operator()(double a, double b) const;
  /// On the cell that begins at the numbers i and j, and on past its ends; before the first and from the last on a border is held.
  Value on_cell(int i, int j, double a, double b) const;
  const Grid& grid() const { return grid_; }

 private:
  Grid grid_;
};

/// Cubic spline through samples, two continuous derivatives; a cubic is met exactly (not-a-knot
/// ends; two samples give a line, three a parabola). Outside the samples it holds the end value.
class Spline {
 public:
  explicit Spline(Samples);  ///< @pre samples as above
  Jet operator()(double t) const;
  const Samples& samples() const { return samples_; }

 private:
  Samples samples_;
  std::vector<double> curvature_;  ///< second derivative at each sample
};

/// Where a spline goes beyond the two samples beside it though the samples there rise, fall or stay: it swings.
struct Swing {
  double begin, end;  ///< between these two
  double by;          ///< so far beyond, at the most of all
};
/// The worst of more than a hundredth of the samples' range.
std::optional<Swing> worst_swing(const Spline&);

/// Straight lines between samples; the rate jumps at each. Outside it holds the end value.
class Polyline {
 public:
  explicit Polyline(Samples samples) : samples_(std::move(samples)) {}
  Jet operator()(double t) const;
  const Samples& samples() const { return samples_; }

 private:
  Samples samples_;
};

}  // namespace pintle
