#pragma once

#include <vector>

#include <Eigen/Core>

#include "contact/gap.h"
#include "eigen_layout.h"

namespace pintle {

/// A point of a path, and the line to the next one.
struct PathPoint {
  Eigen::Vector2d at;  ///< [m]
  double arc = 0;      ///< radius of the arc to the next point, less than a half turn: > 0 turning left, < 0 right; 0: a straight line [m]
};

/// The surface of a body: pieces in order, with the material to their left.
struct Profile {
  std::vector<Piece> pieces;
  std::vector<bool> goes_on;    ///< whether each continues into the next, the last into the first, without a gap between their normals
  std::vector<double> deepest;  ///< of each, half the material behind it [m]; infinite: unlimited
  bool closed = false;
};

/// A whole circle: a disc of radius > 0, a hole of radius < 0.
Profile circle(const Eigen::Vector2d& centre, double radius);

/// Straight lines and arcs along a path. Between pieces that do not meet smoothly, there is a corner of radius 0 where the path turns left;
/// an open path also has one at each end, of a quarter turn.
/// @param closed  returns to its first point   @param round  radius of the arc at corners between straight lines [m]
/// @throws std::invalid_argument  what is impossible: too few points, pieces without length, arcs too small for their chord, a path that
/// turns back on itself or crosses itself, corners without room for `round`; with the numbers of the points, from 1
Profile profile_along(std::vector<PathPoint> path, bool closed, double round = 0);
/// The spline through points, divided into spans of a curve.
/// @throws std::invalid_argument  fewer than three points, or four for an open curve; two at one place; a curve with a cusp or that crosses
/// itself
Profile profile_through(const std::vector<Eigen::Vector2d>& points, bool closed);
/// Computes `deepest` of all its pieces.
void measure_material(Profile&);
/// The same path with the material on the other side.
std::vector<PathPoint> reversed(std::vector<PathPoint> path, bool closed);
/// Area inside a closed path; negative if it runs clockwise [m²].
double area(const std::vector<PathPoint>& path);
double area(const std::vector<Eigen::Vector2d>& polygon);

/// Points along a piece or along all pieces, including both ends, arcs in steps of a few degrees [m].
std::vector<Eigen::Vector2d> drawn(const Piece&);
std::vector<Eigen::Vector2d> drawn(const Profile&);
/// Whether it is closed and encloses the material.
bool solid(const Profile&);

}  // namespace pintle
