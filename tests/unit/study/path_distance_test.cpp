// The distance of a curve to points, against circles and lines by hand.
#include "framework/study/measures/path_distance.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace pintle::path_distance_test {
namespace {

constexpr double pi = std::numbers::pi;

/// One turn of a circle of radius 2 about (1, 0), from its angle `from` on, in one second.
Curve2 circle(double from = 0, int rows = 400, double turns = 1) {
  Curve2 c;
  for (int k = 0; k <= rows; ++k) {
    const double t = static_cast<double>(k) / rows, rate = 2 * pi * turns, a = from + rate * t;
    c.t.push_back(t), c.x.push_back(1 + 2 * std::cos(a)), c.y.push_back(2 * std::sin(a));
    c.vx.push_back(-2 * rate * std::sin(a)), c.vy.push_back(2 * rate * std::cos(a));
  }
  return c;
}

/// On the ray from the circle's centre at an angle, so far from the centre.
std::array<double, 2> on_ray(double angle, double radius) { return {1 + radius * std::cos(angle), radius * std::sin(angle)}; }

// A cubic through values and rates of a circle in 400 pieces is off by (2π/400)⁴/384 · 2 < 4e-10.
constexpr double cubic = 4e-10;

TEST(PathDistance, IsThatToTheNearestPlaceOfTheCurve) {
  const PathTarget target{"a.b", {on_ray(0.3, 2.5), on_ray(1.1, 1.5), on_ray(2.9, 2)}};
  const std::vector<Passage> p = passages(target, circle());
  ASSERT_EQ(p.size(), 3u);
  const double distances[] = {0.5, 0.5, 0}, angles[] = {0.3, 1.1, 2.9};
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(p[static_cast<std::size_t>(k)].distance, distances[k], cubic);
    EXPECT_NEAR(p[static_cast<std::size_t>(k)].t, angles[k] / (2 * pi), 1e-4);  // a distance is flat where it is least
  }
  EXPECT_NEAR(rms_distance(p), std::sqrt(0.5 / 3), cubic);
}

TEST(PathDistance, AtGivenTimesIsThatToThePlaceThen) {
  PathTarget target{"a.b", {on_ray(0, 2), on_ray(0, 2)}, {0, 0.25}};
  const std::vector<Passage> p = passages(target, circle());
  EXPECT_NEAR(p[0].distance, 0, cubic);
  EXPECT_NEAR(p[1].distance, 2 * std::numbers::sqrt2, cubic);
  target.times[1] = 1.5;
  EXPECT_TRUE(passages(target, circle()).empty()) << "after the end of the curve";
  EXPECT_TRUE(std::isnan(rms_distance({})));
}

TEST(PathDistance, KeepsTheOrderOfThePoints) {
  // Half a turn: 0.2, 1.0, 2.0 stand in order; swapped, two of them must share a place or move.
  const Curve2 half = circle(0, 400, 0.5);
  PathTarget target{"a.b", {on_ray(0.2, 2), on_ray(2.0, 2), on_ray(1.0, 2)}};
  target.order = Passing::any;
  EXPECT_NEAR(rms_distance(passages(target, half)), 0, cubic);
  target.order = Passing::along;
  const std::vector<Passage> p = passages(target, half);
  EXPECT_LE(p[1].t, p[2].t + 2.0 / 400);
  EXPECT_GT(rms_distance(p), 0.1);
  target.through = {on_ray(2.0, 2), on_ray(1.0, 2), on_ray(0.2, 2)};
  EXPECT_GT(rms_distance(passages(target, half)), 0.1) << "against the curve";
  target.order = Passing::either_way;
  EXPECT_NEAR(rms_distance(passages(target, half)), 0, cubic);
}

TEST(PathDistance, OfAClosedCurveDoesNotDependOnWhereTheCurveBegins) {
  PathTarget target{"a.b", {on_ray(0.2, 2.1), on_ray(1.0, 1.9), on_ray(2.0, 2), on_ray(4.5, 2.2)}, {}, Passing::along};
  for (const double from : {0.0, 0.7, 1.5, 3.0, 5.0})
    EXPECT_NEAR(rms_distance(passages(target, circle(from))), std::sqrt((0.01 + 0.01 + 0.04) / 4), cubic) << from;
}

}  // namespace
}  // namespace pintle::path_distance_test
