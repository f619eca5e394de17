// What frames hold of a mechanism: every force, the ground, cylinders; and what pictures of them show.
#include "framework/mechanism/drawing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "app/film.h"
#include "app/rounded.h"
#include "app/survey.h"
#include "framework/build/build.h"
#include "framework/configuration/assemble.h"
#include "framework/dynamics/equations/equations.h"
#include "framework/scene/yaml/reader.h"

namespace pintle {
namespace {

using Eigen::Vector2d;

/// The scene as it starts.
Drawing drawn(const std::string& text) {
  const Scene scene = read_scene_text(text, "scene.yaml", {}, ".");
  const Model model = build(scene);
  const Assembly assembly = assemble(scene, model);
  Equations eq(model.system);
  Eigen::VectorXd dy(model.system.n_y());
  evaluate(model.system, assembly.start, eq, dy);
  return draw(model, Drafting(scene, model), assembly.start, eq);
}

std::vector<DrawnForce> forces_of(const Drawing& drawing, const std::string& owner) {
  std::vector<DrawnForce> out;
  for (const DrawnForce& f : drawing.forces)
    if (drawing.owners.at(static_cast<std::size_t>(f.owner)) == owner) out.push_back(f);
  return out;
}

long lines_of(const Drawing& drawing, Part part, const std::string& owner) {
  return std::ranges::count_if(
      drawing.lines, [&](const DrawnLine& l) { return l.part == part && drawing.owners.at(static_cast<std::size_t>(l.owner)) == owner; });
}

/// A rod of 2 kg hangs at rest; a force pulls its tip sideways at a lever of 3 m, which a couple at the hinge's height balances.
constexpr const char* hanging = R"(
gravity: [0, -10]
bodies: {rod: {rigid: {mass: 2, inertia: 0.1, center: [0, -1]}, points: {O: [0, 0], tip: [0, -3]}}}
joints: {hinge: {revolute: [ground, rod.O]}}
forces: {pull: {force: [7, 0], at: rod.tip}, twist: {torque: -21, on: rod}}
run: {until: 1}
)";

TEST(DrawnForces, AreThoseOfEveryJointAndLoadWhereTheyAct) {
  const Drawing drawing = drawn(hanging);
  const auto hinge = forces_of(drawing, "hinge"), pull = forces_of(drawing, "pull"), twist = forces_of(drawing, "twist");
  ASSERT_EQ(hinge.size(), 1U);
  EXPECT_EQ(hinge[0].giver, Giver::joint);
  EXPECT_NEAR((hinge[0].force - Vector2d(-7, 20)).norm(), 0, 1e-9);  // the rod is in balance
  EXPECT_NEAR(hinge[0].at.norm(), 0, 1e-9);
  ASSERT_EQ(pull.size(), 1U);
  EXPECT_EQ(pull[0].giver, Giver::load);
  EXPECT_NEAR((pull[0].at - Vector2d(0, -3)).norm(), 0, 1e-9);
  EXPECT_NEAR((pull[0].force - Vector2d(7, 0)).norm(), 0, 1e-12);
  ASSERT_EQ(twist.size(), 1U);
  EXPECT_NEAR(twist[0].couple, -21, 1e-12);
}

TEST(DrawnForces, OfSpringsPointAlongThem) {
  const Drawing drawing = drawn(R"(
bodies: {mass: {rigid: {mass: 1, inertia: 1}, pose: {at: [2, 0]}}}
joints: {guide: {prismatic: [ground, mass]}}
forces: {spring: {spring: [ground, mass], stiffness: 100, free length: 1.5}}
run: {until: 1}
)");
  const auto spring = forces_of(drawing, "spring");
  ASSERT_EQ(spring.size(), 1U);
  EXPECT_EQ(spring[0].giver, Giver::spring);
  EXPECT_NEAR((spring[0].force - Vector2d(-50, 0)).norm(), 0, 1e-9);
  EXPECT_EQ(lines_of(drawing, Part::spring, "spring"), 1);
}

TEST(DrawnSpirals, OfSpringsBetweenBodiesAreAtTheirPin) {
  for (const std::string play : {"", ", clearance: {radial: 1 mm, bearing radius: 20 mm, bearing: ground, model: massless link}"}) {
    const Drawing drawing = drawn(R"(
bodies: {rod: {rigid: {mass: 1, inertia: 1}, points: {O: [-2, 0], free: [1, 0]}}}
joints: {hinge: {revolute: [rod.O, ground.P])" +
                                  play + R"(}}
ground: {points: {P: [-2, 0]}}
forces:
  at pin: {torsion spring: [ground, rod], stiffness: 1, free angle: 0.5}
  at point: {torsion spring: [ground, rod.free], stiffness: 1}
run: {until: 1}
)");
    for (const auto& [owner, x] : {std::pair("at pin", -2.0), std::pair("at point", 1.0)}) {
      ASSERT_EQ(lines_of(drawing, Part::spring, owner), 1);
      const auto is = [&, owner = owner](const DrawnLine& l) {
        return l.part == Part::spring && drawing.owners.at(static_cast<std::size_t>(l.owner)) == owner;
      };
      for (const Vector2d& p : std::ranges::find_if(drawing.lines, is)->points) EXPECT_LT((p - Vector2d(x, 0)).norm(), 0.5) << owner;
    }
    EXPECT_LT((forces_of(drawing, "at pin").at(0).at - Vector2d(-2, 0)).norm(), 0.01);
  }
}

TEST(DrawnGround, StandsUnderItsPinsAndAlongItsGuides) {
  const Drawing drawing = drawn(hanging);
  long triangles = 0;
  for (const DrawnLine& line : drawing.lines)
    if (line.part == Part::hatch && line.closed) {
      ++triangles;
      EXPECT_NEAR(line.points.front().norm(), 0, 1e-9);
      for (std::size_t i = 1; i < line.points.size(); ++i) EXPECT_LT(line.points[i].y(), 0);
    }
  EXPECT_EQ(triangles, 1);
  EXPECT_GT(lines_of(drawing, Part::hatch, "ground"), 3);
}

TEST(DrawnCylinders, ReachFromTheOneEndToTheOther) {
  const Drawing drawing = drawn(R"(
ground: {points: {A: [0, 0], B: [3, 0]}}
bodies: {arm: {rigid: {mass: 1, inertia: 0.1}, points: {O: [0, 0], E: [0, 4]}, pose: {at: [3, 0]}}}
joints: {pivot: {revolute: [ground.B, arm.O]}}
drivers: {ram: {distance: [ground.A, arm.E], law: present}}
run: {until: 1}
)");
  ASSERT_EQ(lines_of(drawing, Part::cylinder, "ram"), 2);
  Vector2d low(1e9, 1e9), high = -low;
  for (const DrawnLine& line : drawing.lines)
    if (line.part == Part::cylinder && !line.closed) low = line.points.front(), high = line.points.back();
  EXPECT_NEAR((high - Vector2d(3, 4)).norm(), 0, 1e-6);       // the rod ends at the arm
  EXPECT_NEAR(std::abs(low.x() * 4 - low.y() * 3), 0, 1e-6);  // and lies on the line between both ends
}

/// Of a thing's closed lines radius and centre, from their extremes.
std::vector<std::pair<double, Vector2d>> circles_of(const Drawing& drawing, const std::string& owner) {
  std::vector<std::pair<double, Vector2d>> out;
  for (const DrawnLine& line : drawing.lines) {
    if (!line.closed || drawing.owners.at(static_cast<std::size_t>(line.owner)) != owner) continue;
    Vector2d low = line.points[0], high = low;
    for (const Vector2d& p : line.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
    out.emplace_back((high - low).x() / 2, (low + high) / 2);
  }
  return out;
}

constexpr const char* two_wheels = R"(
ground: {points: {A: [0, 0], B: [%B, 0]}}
bodies:
  small: {rigid: {mass: 1, inertia: 1}, points: {O: [0, 0]}}
  large: {rigid: {mass: 1, inertia: 1}, points: {O: [0, 0]}, pose: {at: [%B, 0]}}
joints: {a: {revolute: [ground.A, small.O]}, b: {revolute: [ground.B, large.O]}, %JOINT}
run: {until: 1}
)";
Drawing wheels(std::string apart, const std::string& joint) {
  std::string scene = two_wheels;
  for (const auto& [mark, text] : {std::pair(std::string("%B"), apart), std::pair(std::string("%JOINT"), joint)})
    for (std::size_t at; (at = scene.find(mark)) != std::string::npos;) scene.replace(at, mark.size(), text);
  return drawn(scene);
}

TEST(DrawnWheels, OfGearsTouchAndHaveNoBelt) {
  const Drawing drawing = wheels("3", "mesh: {gear: [small.O, large.O], radii: [1, 2]}");
  const auto circles = circles_of(drawing, "mesh");
  ASSERT_EQ(circles.size(), 2U);
  EXPECT_NEAR(circles[0].first + circles[1].first, 3, 1e-9);
  EXPECT_NEAR((circles[1].second - Vector2d(3, 0)).norm(), 0, 1e-9);
  EXPECT_EQ(lines_of(drawing, Part::joint, "mesh"), 4);  // and a spoke each
}

TEST(DrawnWheels, OfABeltAreTouchedByBothItsSpans) {
  const Drawing drawing = wheels("5", "belt: {belt: [small.O, large.O], radii: [1, 2]}");
  long spans = 0;
  for (const DrawnLine& line : drawing.lines) {
    if (line.closed || line.part != Part::joint || (line.points[1] - line.points[0]).norm() < 3) continue;
    ++spans;
    const bool begins_at_small = line.points[0].norm() < line.points[1].norm();
    const Vector2d at_small = line.points[begins_at_small ? 0 : 1], at_large = line.points[begins_at_small ? 1 : 0] - Vector2d(5, 0);
    EXPECT_NEAR(at_small.norm(), 1, 1e-9);
    EXPECT_NEAR(at_large.norm(), 2, 1e-9);
    for (const Vector2d& radius : {at_small, at_large}) EXPECT_NEAR(radius.dot(line.points[1] - line.points[0]), 0, 1e-9);
    EXPECT_GT(at_small.y() * at_large.y(), 0);  // an open belt
  }
  EXPECT_EQ(spans, 2);
}

TEST(DrawnWheels, OfARackRollOnItsLine) {
  const Drawing drawing = drawn(R"(
ground: {points: {A: [0, 0]}}
bodies: {pinion: {rigid: {mass: 1, inertia: 1}, points: {O: [0, 0]}, pose: {at: [0, 0.5]}}}
joints: {way: {rack: [ground.A, pinion.O], radius: 0.5}}
run: {until: 1}
)");
  ASSERT_EQ(circles_of(drawing, "way").size(), 1U);
  EXPECT_NEAR(circles_of(drawing, "way")[0].first, 0.5, 1e-9);
  ASSERT_EQ(lines_of(drawing, Part::guide, "way"), 1);
  for (const DrawnLine& line : drawing.lines)
    for (const Vector2d& p : line.points) EXPECT_TRUE(line.part != Part::guide || std::abs(p.y()) < 1e-12);
}

// A body with a surface is drawn as bars between its pins and its surface, whether a pin has play or not.
TEST(DrawnBars, ReachPinsWithAndWithoutPlay) {
  const auto jaw = [](const std::string& clearance) {
    return drawn(R"(
ground: {points: {P: [0, 0.5]}, profiles: {wall: {path: [[1, 1], [1, -1]], material: left}}}
bodies:
  rod: {rigid: {mass: 1, inertia: 1e-2}, points: {B: [0.3, 0]}}
  jaw: {rigid: {mass: 1, inertia: 1e-2}, points: {P: [0, 0.5], B: [0.3, 0]}, profiles: {tooth: {disc: [0.4, 0.1], radius: 0.02}}}
contacts: {hit: {between: [jaw.tooth, ground.wall], model: impact, restitution: 0}}
joints:
  bearing: {revolute: [ground, rod]}
  top: {revolute: [ground.P, jaw.P]}
  pin: {revolute: [rod.B, jaw.B])" +
                 clearance + "}\nrun: {until: 1}\n");
  };
  const auto bars = [](const Drawing& drawing) { return lines_of(drawing, Part::link, "jaw"); };
  const long without = bars(jaw(""));
  EXPECT_EQ(without, 3);  // the tooth, and bars from the top to the pin and to the tooth
  EXPECT_EQ(bars(jaw(", clearance: {radial: 0.1 mm, bearing radius: 10 mm, bearing: rod, normal: {hertz: {stiffness: 1e9}}}")), without);
}

TEST(DrawnPoints, AreFollowedAsTheOutputNamesThem) {
  std::string scene = hanging;
  scene += "output: {points: [rod.tip]}\n";
  const Drawing drawing = drawn(scene);
  ASSERT_EQ(drawing.followed.size(), 1U);
  EXPECT_EQ(drawing.followed[0].name, "rod.tip");
  EXPECT_NEAR((drawing.followed[0].at - Vector2d(0, -3)).norm(), 0, 1e-9);
}

TEST(DrawnContacts, AreWhereTheSurfacesAreNearest) {
  const Drawing drawing = drawn(R"(
ground: {profiles: {floor: {path: [[1, 0], [-1, 0]], material: left}}}
bodies: {ball: {rigid: {mass: 1, inertia: 1}, profiles: {rim: {disc: [0, 0], radius: 0.05}}, pose: {at: [0.3, 0.25]}}}
contacts: {hit: {between: [ball.rim, ground.floor], model: impact, restitution: 0}}
run: {until: 1}
)");
  // Of the pairs with the floor and its two ends, that with the floor: the lowest point of the ball, far above the floor.
  EXPECT_TRUE(std::ranges::any_of(drawing.touching, [](const FollowedPoint& p) { return (p.at - Vector2d(0.3, 0.2)).norm() < 1e-12; }));
}

// --- pictures ---

Drawing beside_a_wall() {
  Drawing d;
  d.owners = {"block", "ground"};
  d.lines = {{Part::link, 0, true, {{-1, 0}, {1, 0}, {1, 1}, {-1, 1}}}, {Part::guide, 1, false, {{-100, 0}, {100, 0}}}};
  d.forces = {{{0, 0}, {0, 5}, 0, Giver::joint, 0}};
  return d;
}

std::vector<Vector2d> polygon(int corners, double width, double height) {
  std::vector<Vector2d> out;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    out.emplace_back(300 + width * std::cos(angle), 200 + height * std::sin(angle));
  }
  return out;
}

TEST(Rounded, CirclesHaveChordsWithinHalfAPixel) {
  for (const double radius : {20.0, 300.0, 1e5}) {
    const std::vector<Vector2d> circle = rounded(polygon(48, radius, radius));
    for (std::size_t i = 0; i < circle.size(); ++i) {
      const Vector2d middle = (circle[i] + circle[(i + 1) % circle.size()]) / 2;
      EXPECT_NEAR((circle[i] - Vector2d(300, 200)).norm(), radius, 1e-9 * radius);
      EXPECT_GT((middle - Vector2d(300, 200)).norm(), radius - 0.5);
    }
  }
  for (const std::vector<Vector2d>& other : {polygon(6, 300, 300), polygon(48, 300, 290), polygon(48, 20, 20)})
    EXPECT_EQ(rounded(other), other);
}

TEST(Survey, ShowsWhatMovesAndNotAWallOfTwoHundredMetres) {
  Survey survey("", "");
  survey.add(beside_a_wall());
  const Eigen::AlignedBox2d world = survey.world();
  EXPECT_TRUE(world.contains(Vector2d(-1, 0)) && world.contains(Vector2d(1, 1)));
  EXPECT_LT(world.sizes().x(), 2 * 1.3);  // what moves, and an eighth of it on both sides
  EXPECT_GT(world.sizes().x(), 2);
}

TEST(Survey, ShowsAllPlacesOfAFilmAndScalesArrowsByTheUsualForce) {
  Survey survey("", "");
  for (int i = 0; i < 20; ++i) {
    Drawing d = beside_a_wall();
    for (Vector2d& r : d.lines[0].points) r.y() += i;
    if (i == 7) d.forces[0].force *= 1000;  // an impact
    survey.add(d);
  }
  EXPECT_TRUE(survey.world().contains(Vector2d(0, 20)));
  EXPECT_EQ(survey.usual_force(), 5);
}

TEST(Survey, OfOneBodyShowsThatAlone) {
  Survey survey("ground", "");
  survey.add(beside_a_wall());
  EXPECT_EQ(survey.world().sizes().x(), 200);
  Survey nothing("nobody", "");
  nothing.add(beside_a_wall());
  EXPECT_THROW(nothing.world(), std::invalid_argument);
}

/// A ball of 0.1 m that lies in half a circle of 1 m, and one on a ramp as long.
TEST(Survey, ShowsTheWholeBowlThatABallIsInAndOfARampWhatIsNear) {
  Drawing d;
  d.owners = {"ball", "ground"};
  DrawnLine ball{Part::link, 0, true, {}}, bowl{Part::guide, 1, false, {}};
  for (int i = 0; i < 24; ++i) {
    const double turn = 0.2617993877991494 * i;
    ball.points.emplace_back(0.3 + 0.05 * std::cos(turn), -0.3 + 0.05 * std::sin(turn));
    if (i >= 12) bowl.points.emplace_back(0.5 * std::cos(turn), 0.5 * std::sin(turn));
  }
  d.lines = {ball, bowl};
  Survey in_bowl("", "");
  in_bowl.add(d);
  for (const Vector2d& r : bowl.points) EXPECT_TRUE(in_bowl.world().contains(r)) << r.transpose();
  d.lines[1].points = {{-0.5, 0.45}, {0.6, -0.65}};
  Survey on_ramp("", "");
  on_ramp.add(d);
  EXPECT_LT(on_ramp.world().sizes().maxCoeff(), 0.1 * 1.3);
}

/// A couple has a place and no size.
TEST(Survey, OfACoupleShowsWhereItActs) {
  Survey survey("twist", "");
  survey.add(drawn(hanging));
  const Eigen::AlignedBox2d world = survey.world();
  EXPECT_NEAR(world.center().norm(), 0, 1e-9);  // on the rod's origin
  EXPECT_GT(world.sizes().minCoeff(), 0.1);
  EXPECT_LT(world.sizes().maxCoeff(), 3);
}

}  // namespace
}  // namespace pintle
