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
