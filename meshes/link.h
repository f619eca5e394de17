#pragma once

#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"

/// Links that need no drawing. All lengths in m; body axes as described for each.
namespace pintle {

/// A round hole surrounded by material.
struct Eye {
  double bore, outer;
};  ///< diameters

/// Rectangle from (0, −width/2) to (length, width/2). Edges "left", "right", "top", "bottom".
struct StraightBar {
  double length, width;
};
/// Two eyes `length` apart, the first at (0, 0), the second at (length, 0), connected by a shank that is not wider than either. Holes "eye
/// 1", "eye 2"; the outline is "outline".
struct EyeBar {
  double length, width;
  Eye first, second;
};
/// Trapezium from x = 0 to `length`, symmetric about the x axis. Edges as for a straight bar.
struct TaperedBar {
  double length, width_left, width_right;
};
/// Three eyes at the given centres, connected by the tangents of their outer circles (the convex hull). Holes "eye 1", "eye 2", "eye 3";
/// the outline is "outline".
struct Triangle {  // NOLINT(bugprone-reserved-identifier): a false positive of the check
  Eigen::Vector2d center[3];
  Eye eye[3];
};
/// Round disc about (0, 0). Hole "bore", edge "outline".
struct Disc {
  double diameter, bore;
};

using Link = std::variant<StraightBar, EyeBar, TaperedBar, Triangle, Disc>;
/// @throws std::invalid_argument  a size is not positive or not finite; a bore is not inside its eye; the outer circles of two eyes
/// overlap; a shank is wider than an eye; an eye of a triangle does not reach its outline
void validate(const Link&);

/// A straight edge, or an arc about `center` of less than half a turn.
struct Edge {
  Eigen::Vector2d from, to;
  bool arc = false;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
};
/// Edges in sequence; `names` are their groups, one each.
struct Loop {
  std::vector<Edge> edges;
  std::vector<std::string> names;
};
/// The outline, counter-clockwise, then the holes.  @pre validate(link) has passed
std::vector<Loop> drawing(const Link&);

}  // namespace pintle
