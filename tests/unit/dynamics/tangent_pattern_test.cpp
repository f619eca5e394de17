// Which entries the tangent has, before any has a value.
#include "framework/dynamics/equations/tangent.h"

#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "tests/contracts/moving_bodies.h"

namespace pintle::tangent_pattern_test {
namespace {

System chain(int links, const std::function<void(System&, int a, int b)>& join) {
  System s;
  s.markers.push_back({});
  for (int i = 0; i < links; ++i) {
    s.bodies.push_back({"link", 0.2, 1e-3});
    s.markers.push_back({i, {-0.5, 0}, 0});
    s.markers.push_back({i, {0.5, 0}, 0});
    join(s, 2 * i, 2 * i + 1);
  }
  s.joint_names.assign(s.joints.size(), "joint");
  s.force_names.assign(s.forces.size(), "force");
  number(s);
  return s;
}

TEST(TangentPattern, PinnedLinksHaveTheirDiagonalOnly) {
  const System s = chain(50, [](System& system, int a, int b) { system.joints.emplace_back(Revolute{a, b}); });
  const Tangent tangent(s);
  EXPECT_EQ(tangent.places().size(), 150u);
  for (const Tangent::Place& p : tangent.places()) EXPECT_EQ(p.row, p.column);
}

TEST(TangentPattern, NeighboursCoupleWhereTheirInteractionAnswersToBoth) {
  constexpr int links = 20;
  const System s = chain(links, [](System& system, int a, int b) {
    system.joints.emplace_back(Revolute{a, b});
    system.forces.emplace_back(TorsionSpring{a, b, 1, 0, 0});
    system.forces.emplace_back(Spring{a, b, 1, 0.1, 0});  // no block of its own beside the other's
  });
  const Tangent tangent(s);
  EXPECT_EQ(tangent.places().size(), 9u * (links + 2 * (links - 1)));
  for (const Tangent::Place& p : tangent.places()) EXPECT_LE(std::abs(p.row / 3 - p.column / 3), 1);
}

// Also where several interactions share a block.
TEST(TangentPattern, NamesEachPlaceOnce) {
  for (const Carriers& carriers : all_carriers()) {
    System s = two_bodies(carriers);
    s.joints = {Slot{0, 1}, Revolute{1, 0}};
    s.forces = {Spring{1, 0, 40, 3, 0.5}, TorsionSpring{0, 1, 25, 2, -0.8}};
    s.joint_names.assign(2, "joint"), s.force_names.assign(2, "force");
    number(s);
    const Tangent tangent(s);
    std::set<std::pair<int, int>> seen;
    for (const Tangent::Place& p : tangent.places()) EXPECT_TRUE(seen.insert({p.row, p.column}).second);
    for (const auto& [row, column] : seen) EXPECT_TRUE(seen.count({column, row}));
  }
}

// A guide on the ground pushes across the line that the ground draws: the slider's turning does not matter
// to it, so nothing but the slider's own diagonal is left.
TEST(TangentPattern, AGuideOnTheGroundAddsNothing) {
  System s = chain(1, [](System& system, int a, int b) { system.joints.emplace_back(Prismatic{a, b, 0}); });
  EXPECT_EQ(Tangent(s).places().size(), 3u);
  s.joints = {Prismatic{1, 0, 0}};  // the guide's line on the body
  EXPECT_EQ(Tangent(s).places().size(), 9u);
}

}  // namespace
}  // namespace pintle::tangent_pattern_test
