#pragma once

#include <array>
#include <string>
#include <vector>

/// Distance between the path of a point of a body and the points that it should pass.
namespace pintle {

/// The order in which the curve passes the points of a target.
enum class Passing { along, either_way, any };

/// Points in the plane [m] that a point of a body should pass, at given times or at any time.
struct PathTarget {
  std::string point;  ///< BODY.POINT
  std::vector<std::array<double, 2>> through;
  std::vector<double> times = {};  ///< one for each point, or none [s]
  Passing order = Passing::either_way;

  double extent() const;  ///< diagonal of the bounding box of `through` [m]
};

/// A curve from the rows of a run: positions and velocities. Between rows it is their cubic.
struct Curve2 {
  std::vector<double> t, x, y, vx, vy;
  std::size_t size() const { return t.size(); }
};

/// Where the curve passes a point of the target.
struct Passage {
  double t = 0, x = 0, y = 0;
  double distance = 0;
};

/// The position on the curve for each point of the target, such that they follow the target's order and the sum of squared distances is
/// least. A closed curve may begin at any of the points. Empty where the curve does not cover the times.
std::vector<Passage> passages(const PathTarget&, const Curve2&);

/// Root of the mean squared distance [m]; NaN without passages.
double rms_distance(const std::vector<Passage>&);

}  // namespace pintle
