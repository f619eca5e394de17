#pragma once

#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"

namespace pintle {

/// Number of sides around a hole, and around a full circle of the outline, unless sizes are given.
inline constexpr double sides_round_hole = 24, sides_round_arc = 12;

/// Desired cell size: `largest`, or less near sources.
struct SizeField {
  struct Source {
    Eigen::Vector2d at;
    double size;
  };
  double largest = 0;
  std::vector<Source> sources;
  /// Growth of sizes per distance from a source: neighbours differ by about a quarter.
  static constexpr double growth = 0.25;
  double at(double x, double y) const;
};

/// A closed loop of boundary curves, as a polygon.
struct Contour {
  std::vector<Eigen::Vector2d> points;
  std::vector<double> curvature;  ///< at each point [1/m]
  std::vector<int> curves;
  double length() const;
  double area() const;  ///< never negative
};
/// Whether p is inside the polygon.
bool inside(const Contour&, const Eigen::Vector2d& p);

/// Largest number of cells; more is taken as a typing error.
inline constexpr double most_cells = 2e7;
/// @throws std::invalid_argument  more than that
void validate_count(double cells, double size);

/// @param contours   the outline first, then the holes
/// @param size       0: a tenth of the square root of the area
/// @param hole_size  0: 24 sides round each hole, if that is smaller
/// @throws std::invalid_argument  there would be far too many cells
SizeField size_field(const std::vector<Contour>&, double size, double hole_size);

}  // namespace pintle
