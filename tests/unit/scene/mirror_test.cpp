// An instance that is mirrored, turned and moved: every place, direction and load in the world is the image of what the assembly draws,
// by a map that is written here again.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/unit/scene_text.h"

namespace pintle::mirror_test {
namespace {

constexpr double pi = 3.14159265358979323846;

/// p is mirrored, then turned, then moved.
struct Map {
  std::string words;
  double x, y, angle;  ///< signs of the coordinates; [rad]
  Pair at;
  Pair vector(const Pair& v) const {
    return {std::cos(angle) * x * v[0] - std::sin(angle) * y * v[1], std::sin(angle) * x * v[0] + std::cos(angle) * y * v[1]};
  }
  Pair point(const Pair& p) const { return {at[0] + vector(p)[0], at[1] + vector(p)[1]}; }
  double turns() const { return x * y; }
};
const std::array<Map, 6> maps{{{"mirror: x", -1, 1, 0, {0, 0}},
                               {"mirror: y", 1, -1, 0, {0, 0}},
                               {"at: [3, 4]", 1, 1, 0, {3, 4}},
                               {"mirror: y, angle: 90 deg", 1, -1, pi / 2, {0, 0}},
                               {"angle: 30 deg, at: [1, 2]", 1, 1, pi / 6, {1, 2}},
                               {"mirror: x, at: [1, 2], angle: 30 deg", -1, 1, pi / 6, {1, 2}}}};

const std::string parts = R"(
    ground:
      points: {G: [1, 2], S: {at: [0, 1], angle: 20 deg}}
      profiles: {wall: {path: [[1, 0], {arc: 3}, [2, 1], S]}, knob: {disc: [1, 1], radius: 0.5}, cam: {polar: [[0, 1], [1, 2], [2, 1.5]], about: G}}
    bodies:
      rigid:
        rigid: {mass: 1, inertia: 1, center: [0.1, 0.2]}
        points: {A: [1, 0.5], B: {at: [0, 1], angle: 40 deg}, W: {world: [5, 6]}}
        pose: {at: [1, 2], angle: 25 deg}
        profiles:
          open: {path: [[0, 0], {arc: 2}, [1, 1], B]}
          closed: {path: [[0, 0], [1, 0], [0, 1]], closed: true, material: outside}
          smooth: {spline: [[0, 0], [1, 1], [2, 0.5], [3, 0.7]], material: right}
          cam: {polar: [[0, 1], [1, 2], [2, 1.5]], about: [0.1, 0.2]}
      leaf: {beam: {from: A, to: B, section: {circle: 0.1}, orthotropic: {young: [1e9, 1e8], poisson: 0.3, shear: 1e8, angle: 30 deg}, density: 1}, points: {A: [0, 0], B: [1, 0.5]}}
      drawn: {rigid: {mass: 1, inertia: 1, center: [0, 0.3]}, points: {A: {world: [1, 1]}, B: {world: [3, 2]}, C: {world: [2, 2]}}}
    joints:
      guide: {prismatic: [ground.S, rigid.B], angle: 15 deg}
      foot: {revolute: [ground, leaf.A]}
    drivers: {motor: {angle: [ground, rigid], law: 3*t + 1}}
    forces:
      push: {force: [1 N*t/(1 s), 2 N], at: rigid.A}
      thrust: {force: [1 N, 2 N], at: rigid.A, follows: true}
      twist: {torque: 3 N m, on: rigid}
      hair: {torsion spring: [rigid, leaf], stiffness: 1, free angle: 20 deg}
    start: {rigid: {at: [1, 2], velocity: [3, 4], angle: 35 deg, speed: 5}}
)";

Scene placed(const Map& map) {
  return read_scene_text("assemblies:\n  it:" + parts + "instances: {i: {of: it, " + map.words + "}}\nrun: {until: 1 s}\n", "scene.yaml");
}
/// As it is drawn: a map that changes nothing.
Scene drawn() { return placed({"at: [0, 0]", 1, 1, 0, {0, 0}}); }

Pair in_world(const SceneBody& body, const Pair& p) {
  const double c = std::cos(body.angle), s = std::sin(body.angle);
  return {body.at[0] + c * p[0] - s * p[1], body.at[1] + s * p[0] + c * p[1]};
}
Pair along(double angle) { return {std::cos(angle), std::sin(angle)}; }

void expect_near(const Pair& found, const Pair& expected, const std::string& what) {
  EXPECT_NEAR(found[0], expected[0], 1e-13) << what;
  EXPECT_NEAR(found[1], expected[1], 1e-13) << what;
}

struct Mirror : testing::TestWithParam<Map> {};

TEST_P(Mirror, PlacesBodiesTheirPointsAndMassCentres) {
  const Map& map = GetParam();
  const Scene is = placed(map), was = drawn();
  for (std::size_t b = 0; b < was.bodies.size(); ++b) {
    const SceneBody &now = is.bodies[b], &before = was.bodies[b];
    expect_near(in_world(now, now.center), map.point(in_world(before, before.center)), now.name);
    for (std::size_t p = 0; p < before.points.size(); ++p) {
      expect_near(in_world(now, now.points[p].at), map.point(in_world(before, before.points[p].at)), now.name + "." + now.points[p].name);
      if (before.points[p].name != "B") continue;
      expect_near(along(now.angle + now.points[p].angle), map.vector(along(before.angle + before.points[p].angle)), "direction of B");
    }
  }
}

TEST_P(Mirror, PlacesTheGround) {
  const Map& map = GetParam();
  const Scene is = placed(map), was = drawn();
  for (const ScenePoint& before : was.ground) {
    const auto now = std::ranges::find(is.ground, before.name, &ScenePoint::name);
    ASSERT_NE(now, is.ground.end());
    expect_near(now->at, map.point(before.at), before.name);
    expect_near(along(now->angle), map.vector(along(before.angle)), before.name);
  }
  EXPECT_EQ(is.joints[1].a.point, "i");
  const auto origin = std::ranges::find(is.ground, "i", &ScenePoint::name);
  ASSERT_NE(origin, is.ground.end());
  expect_near(origin->at, map.point({0, 0}), "ground");
  expect_near(along(origin->angle), map.vector({1, 0}), "ground");
}

/// A profile's places in the world, arcs and side of the material.
void expect_image(const Map& map, const SceneProfile& now, const SceneProfile& before, const SceneBody& now_on,
                  const SceneBody& before_on) {
  ASSERT_EQ(now.points.size(), before.points.size()) << now.name;
  const std::size_t n = now.points.size();
  const auto place = [](const SceneProfile& p, std::size_t k, const SceneBody& on) {
    if (p.kind != SceneProfile::polar) return in_world(on, p.points[k].at);
    const auto [angle, radius] = p.points[k].at;
    return in_world(on, {p.centre.at[0] + radius * std::cos(angle), p.centre.at[1] + radius * std::sin(angle)});
  };
  const bool backwards = now.kind == SceneProfile::polar && map.turns() < 0;
  for (std::size_t k = 0; k < n; ++k) {
    if (!before.points[k].point.empty()) {
      EXPECT_EQ(now.points[k].point.empty(), false);
      continue;
    }
    expect_near(place(now, backwards ? n - 1 - k : k, now_on), map.point(place(before, k, before_on)), now.name);
    EXPECT_EQ(now.points[k].arc, map.turns() * before.points[k].arc);
  }
  const bool sides = before.material == SceneProfile::left || before.material == SceneProfile::right;
  EXPECT_EQ(now.material != before.material, sides && map.turns() < 0) << now.name;
}

TEST_P(Mirror, PlacesProfiles) {
  const Map& map = GetParam();
  const Scene is = placed(map), was = drawn();
  for (std::size_t p = 0; p < was.bodies[0].profiles.size(); ++p)
    expect_image(map, is.bodies[0].profiles[p], was.bodies[0].profiles[p], is.bodies[0], was.bodies[0]);
  const SceneBody world;
  expect_image(map, is.ground_profiles[0], was.ground_profiles[0], world, world);
  expect_near(is.ground_profiles[1].centre.at, map.point({1, 1}), "knob");
}

TEST_P(Mirror, TurnsLoadsStartsAndAngles) {
  const Map& map = GetParam();
  const Scene is = placed(map), was = drawn();
  const auto force = [](const Scene& s, std::size_t i, double t) {
    const auto& f = std::get<SceneForce>(s.loads[i].what);
    return Pair{f.x.at(t).value, f.y.at(t).value};
  };
  expect_near(force(is, 0, 0.7), map.vector({0.7, 2}), "push");
  expect_near(force(is, 1, 0), {1, map.turns() * 2}, "thrust");
  EXPECT_EQ(std::get<SceneTorque>(is.loads[2].what).law.at(0).value, map.turns() * 3);
  EXPECT_EQ(std::get<SceneTorsionSpring>(is.loads[3].what).free_angle,
            map.turns() * std::get<SceneTorsionSpring>(was.loads[3].what).free_angle);
  EXPECT_EQ(is.joints[0].angle, map.turns() * was.joints[0].angle);
  EXPECT_EQ(is.drivers[0].law.at(2).value, map.turns() * 7);
  const StartBody &now = is.start_bodies[0], &before = was.start_bodies[0];
  expect_near({*now.x, *now.y}, map.point({1, 2}), "at");
  expect_near({*now.vx, *now.vy}, map.vector({3, 4}), "velocity");
  EXPECT_EQ(*now.speed, map.turns() * 5);
  EXPECT_NEAR(*now.angle - is.bodies[0].angle, map.turns() * (*before.angle - was.bodies[0].angle), 1e-14);
  const auto grain = [](const Scene& s) {
    return std::get<Orthotropic>(std::get<SceneBeam>(s.bodies[1].elastic->shape).material.material.elastic).angle;
  };
  EXPECT_EQ(grain(is), map.turns() * grain(was));
}

TEST_P(Mirror, IsReadBackTheSameFromWhatIsKept) {
  const std::string kept = placed(GetParam()).filled_in;
  EXPECT_EQ(read_scene_text(kept, "again.json").filled_in, kept);
}

INSTANTIATE_TEST_SUITE_P(, Mirror, testing::ValuesIn(maps));

TEST(MirrorTwice, IsNoMirror) {
  const Scene is = read_scene_text(
                  "assemblies:\n  it:" + parts +
                      "  both: {instances: {j: {of: it, mirror: x}}}\ninstances: {i: {of: both, mirror: x}}\nrun: {until: 1 s}\n",
                  "scene.yaml"),
              was = drawn();
  for (std::size_t p = 0; p < was.bodies[0].points.size(); ++p)
    expect_near(in_world(is.bodies[0], is.bodies[0].points[p].at), in_world(was.bodies[0], was.bodies[0].points[p].at), "twice");
  EXPECT_EQ(is.joints[0].angle, was.joints[0].angle);
}

TEST(MirrorRefusals, NameWhatHasNoMirrorImage) {
  const auto refused = [](const std::string& it) {
    return refusal_of("assemblies: {it: {" + it + "}}\ninstances: {i: {of: it, mirror: x, angle: 30 deg}}\nrun: {until: 1 s}\n");
  };
  const std::string body = "bodies: {a: {rigid: {mass: 1, inertia: 1}}}";
  expect_one_line(refused("bodies: {a: {plate: {file: a.geo, thickness: 1 mm, young: 1, poisson: 0.3, density: 1}}}"),
                  "scene.yaml:1: bodies.i a.plate.file: ", {"cannot be mirrored", "in the instance \"i\""});
  expect_says(refused("bodies: {a: {rigid: {mass: 1, inertia: 1}, profiles: {c: {spline: {file: c.csv}}}}}"),
              {"bodies.i a.profiles.c.spline", "file"});
  expect_says(refused(body + ", start: {a: {modes: [1]}}"), {"start.i a.modes", "deflection"});
  expect_says(refused(body + ", start: {a: {x: 1}}"), {"start.i a.x", "at: [x, y]"});
  for (const char* of_signals :
       {"events: {e: {when: a.vx > 1 m/s, do: {row: true}}}", "states: {s: {rate: a.vx/(1 m)}}", "outputs: {o: a.vx}"})
    expect_says(refused(body + ", " + of_signals), {"cannot be mirrored; signals", "for each side"});
  expect_says(refused(body + ", forces: {f: {force: [{table: a.csv}, 0], at: a}}"), {"forces.i f.force", "follows: true"});
}

}  // namespace
}  // namespace pintle::mirror_test
