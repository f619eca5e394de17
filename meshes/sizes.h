#pragma once

#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"

namespace pintle {

/// Sides round a hole, and round a full circle of the outline, unless sizes say otherwise.
inline constexpr double sides_round_hole = 24, sides_round_arc = 12;

/// How large cells are to be: `largest`, or less near places that ask for it.
struct SizeField {
  struct Source {
    Eigen::Vector2d at;
    double size;
  };
  double largest = 0;
  std::vector<Source> sources;
  /// Sizes grow by this much per length away from a source: neighbours differ by about a quarter.
  static constexpr double growth = 0.25;
  double at(double x, double y) const;
};

/// A closed run of boundary curves, drawn as a polygon.
struct Contour {
  std::vector<Eigen::Vector2d> points;
  std::vector<double> curvature;  ///< at each [1/m]
  std::vector<int> curves;
  double length() const;
  double area() const;  ///< never negative
};
/// Whether p lies inside the polygon.
bool inside(const Contour&, const Eigen::Vector2d& p);

/// What a mesh is allowed to become before it is taken for a slip of the pen.
inline constexpr double most_cells = 2e7;
/// @throws std::invalid_argument  more than that
void validate_count(double cells, double size);

/// @param contours   the outline first, then the holes
/// @param size       0: a tenth of the square root of the area
/// @param hole_size  0: 24 sides round each hole, if that is smaller
/// @throws std::invalid_argument  far too many cells come of it
SizeField size_field(const std::vector<Contour>&, double size, double hole_size);

}  // namespace pintle
