#pragma once

#include <array>
#include <string>
#include <vector>

/// How far the curve of a point passes from the points that it is to pass.
namespace pintle {

/// The order in which the curve passes the points of a target.
enum class Passing { along, either_way, any };

/// Points of the plane [m] that a point of a body is to pass, at given times or whenever it is nearest.
struct PathTarget {
  std::string point;  ///< BODY.POINT
  std::vector<std::array<double, 2>> through;
  std::vector<double> times = {};  ///< one for each, or none [s]
  Passing order = Passing::either_way;

  double extent() const;  ///< diagonal of the box about `through` [m]
};

/// A curve as rows of a run give it: places and velocities. Between rows it is their cubic.
struct Curve2 {
  std::vector<double> t, x, y, vx, vy;
  std::size_t size() const { return t.size(); }
};

/// Where the curve passes a point of the target.
struct Passage {
  double t = 0, x = 0, y = 0;
  double distance = 0;
};

/// For each point of the target the place of the curve that belongs to it: so that they stand in the target's order and the sum of
/// squared distances is least. A closed curve may begin at any of the points. Empty where the curve does not cover the times.
std::vector<Passage> passages(const PathTarget&, const Curve2&);

/// Root of the mean squared distance [m]; NaN without passages.
double rms_distance(const std::vector<Passage>&);

}  // namespace pintle
