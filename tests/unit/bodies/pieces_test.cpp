// A beam cut into pieces: where the cuts are, that nothing of the whole is lost, and what becomes
// of all that named it.
#include <algorithm>
#include <cmath>

#include "framework/bodies/elastic_body.h"
#include "framework/bodies/segments.h"
#include "framework/component/reduction/modal_model.h"
#include "tests/unit/scene_text.h"
#include "tests/refusal.h"

namespace pintle::pieces_test {
namespace {

// Places and sums of some ten terms near 1: rounding.
constexpr double rounding = 1e-13;

// Line numbers below count from the line after R"(.
const std::string cut_scene = R"(bodies:
  crank: {rigid: {mass: 1, inertia: 1}, points: {A: [1, 0]}}
  coupler:
    beam: {through: [A, K, B], section: {rectangle: [40 mm, 10 mm]}, taper to: {rectangle: [20 mm, 5 mm]},
           young: 2e11, poisson: 0.3, mass: 3 kg, elements: 14, pieces: 4, theory: euler, rotary inertia: false}
    points: {A: [0, 0], K: [3, 0], B: [3, 4], M: {at: [2, 0], angle: 30 deg}, Q: {at: [3, 0.5], angle: 90 deg}}
    pose: {at: [1, 2], angle: 10 deg}
    modes: {frame: {chord: [A, B]}, craig-bampton: {count: 2}}
    stiffening: axial
    damping: {ratios: 0.01}
    mass matrix: lumped
    lumps: {M: {mass: 0.1}, B: {mass: 0.2}}
    supports: {A: fixed, B: [y]}
  slider: {rigid: {mass: 1, inertia: 1}}
joints:
  knee: {revolute: [crank.A, coupler.A]}
  pin: {revolute: [coupler.B, slider], clearance: {radial: 1 mm, bearing radius: 1 cm, bearing: coupler,
        normal: {hertz: {stiffness: 1e9}}}}
  guide: {prismatic: [ground, slider]}
drivers: {lift: {distance: [ground, coupler.M], law: 2}}
forces:
  push: {force: [0, 1], at: coupler.Q}
  turn: {torque: 1, on: coupler.Q}
  coil: {spring: [coupler.K, ground], damping: 1}
  hair: {torsion spring: [crank, coupler.M], damping: 1}
start:
  coupler: {angle: 10 deg, speed: 3, x: 1}
  crank: {speed: 1}
static: {body: coupler, loads: {snow: {line load: [0, -1]}}}
run: {until: 1}
output: {points: [crank.A, coupler.M, ground], stress: [coupler.Q]}
)";

std::string cut_with(const std::string& from, const std::string& to) {
  std::string text = cut_scene;
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("no \"" + from + "\" in the scene");
  return text.replace(at, from.size(), to);
}
Scene pieces_of(const std::string& text) { return with_pieces(read_scene_text(text, "scene.yaml")); }
std::string rejected(const std::string& text) {
  return pintle_test::refusal_by([&] { pieces_of(text); });
}
const Scene& cut() {
  static const Scene scene = pieces_of(cut_scene);
  return scene;
}
const SceneBody& body(const Scene& scene, const std::string& name) { return *std::ranges::find(scene.bodies, name, &SceneBody::name); }
const SceneBeam& beam(const Scene& scene, const std::string& name) { return std::get<SceneBeam>(body(scene, name).elastic->shape); }
const ScenePoint& point(const SceneBody& b, const std::string& name) { return *std::ranges::find(b.points, name, &ScenePoint::name); }
const SceneJoint& joint(const Scene& scene, const std::string& name) { return *std::ranges::find(scene.joints, name, &SceneJoint::name); }
std::string shown(const PointRef& ref) { return ref.body + "." + ref.point; }
using Names = std::vector<std::string>;

TEST(Pieces, StandWhereTheBeamStood) {
  Names names;
  for (const SceneBody& b : cut().bodies) names.push_back(b.name);
  EXPECT_EQ(names, (Names{"crank", "coupler 1", "coupler 2", "coupler 3", "coupler 4", "slider"}));
  for (int k = 1; k <= 4; ++k) {
    const SceneBody& b = body(cut(), "coupler " + std::to_string(k));
    EXPECT_EQ(b.at, (Pair{1, 2}));
    EXPECT_EQ(b.angle, body(read_scene_text(cut_scene, ""), "coupler").angle);
    EXPECT_EQ(b.place.line, 3);
    EXPECT_TRUE(b.elastic->lumped);
    EXPECT_EQ(b.elastic->stiffening, Stiffening::axial);
    EXPECT_EQ(b.elastic->damping->ratios, (std::vector<double>{0.01}));
    EXPECT_EQ(b.elastic->modes->method, SceneModes::Method::craig_bampton);
    EXPECT_EQ(b.elastic->modes->keep.count, 2);
    EXPECT_EQ(beam(cut(), b.name).pieces, 1);
    EXPECT_EQ(beam(cut(), b.name).theory, BeamTheory::euler);
    EXPECT_FALSE(beam(cut(), b.name).rotary);
  }
}

// The axis is 3 m along x, then 4 m along y: cuts at 1.75, 3.5 and 5.25 m, the second at point Q.
TEST(Pieces, AreOfEqualLengthAndKeepCornersAndNamedPoints) {
  EXPECT_EQ(beam(cut(), "coupler 1").through, (Names{"A", "cut 1"}));
  EXPECT_EQ(beam(cut(), "coupler 2").through, (Names{"cut 1", "K", "Q"}));
  EXPECT_EQ(beam(cut(), "coupler 3").through, (Names{"cut 2", "cut 3"}));
  EXPECT_EQ(beam(cut(), "coupler 4").through, (Names{"cut 3", "B"}));
  const auto expect_at = [](int k, const char* name, double x, double y) {
    const Pair& at = point(body(cut(), "coupler " + std::to_string(k)), name).at;
    EXPECT_NEAR(at[0], x, rounding) << name;
    EXPECT_NEAR(at[1], y, rounding) << name;
  };
  expect_at(1, "cut 1", 1.75, 0);
  expect_at(2, "cut 1", 1.75, 0);
  expect_at(2, "M", 2, 0);
  expect_at(2, "Q", 3, 0.5);
  expect_at(3, "cut 2", 3, 0.5);
  expect_at(4, "cut 3", 3, 2.25);
  EXPECT_EQ(body(cut(), "coupler 1").points.size(), 2u);
  EXPECT_EQ(body(cut(), "coupler 2").points.size(), 4u);
  EXPECT_EQ(body(cut(), "coupler 3").points.size(), 2u);
}

TEST(Pieces, AreWeldedWithoutATurn) {
  ASSERT_EQ(cut().joints.size(), 6u);
  const auto expect_weld = [](const char* name, const char* a, const char* b) {
    const SceneJoint& j = joint(cut(), name);
    EXPECT_EQ(j.kind, JointKind::weld);
    EXPECT_EQ(shown(j.a), a);
    EXPECT_EQ(shown(j.b), b);
    const double turn = point(body(cut(), j.b.body), j.b.point).angle - point(body(cut(), j.a.body), j.a.point).angle;
    EXPECT_EQ(j.angle, turn);
    EXPECT_EQ(j.place.line, 3);
  };
  expect_weld("coupler 1-2", "coupler 1.cut 1", "coupler 2.cut 1");
  expect_weld("coupler 2-3", "coupler 2.Q", "coupler 3.cut 2");
  expect_weld("coupler 3-4", "coupler 3.cut 3", "coupler 4.cut 3");
  EXPECT_LT(joint(cut(), "coupler 2-3").angle, -1.5) << "Q's own direction is taken back";
}

TEST(Pieces, ShareTheTaper) {
  for (int k = 0; k < 4; ++k) {
    const SceneBeam& b = beam(cut(), "coupler " + std::to_string(k + 1));
    const auto& from = std::get<RectangleSection>(b.section);
    const auto& to = std::get<RectangleSection>(b.taper_to.value());
    EXPECT_NEAR(from.height, 0.04 - 0.005 * k, rounding);
    EXPECT_NEAR(to.height, 0.04 - 0.005 * (k + 1), rounding);
    EXPECT_NEAR(to.width, to.height / 4, rounding);
  }
}

// The area falls as (1 − t/2)², whose integral from a to b is 2/3 ((1 − a/2)³ − (1 − b/2)³).
TEST(Pieces, ShareTheMassByVolume) {
  const auto cube = [](double t) { return std::pow(1 - t / 2, 3); };
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    const double mass = beam(cut(), "coupler " + std::to_string(k + 1)).mass.value();
    EXPECT_NEAR(mass, 3 * (cube(k / 4.0) - cube((k + 1) / 4.0)) / (1 - cube(1)), rounding);
    sum += mass;
  }
  EXPECT_NEAR(sum, 3, rounding);
}

TEST(Pieces, ShareTheElements) {
  const auto shares = [](const std::string& text) {
    std::vector<int> out;
    const Scene scene = pieces_of(text);
    for (int k = 1; k <= 4; ++k) out.push_back(beam(scene, "coupler " + std::to_string(k)).elements);
    return out;
  };
  EXPECT_EQ(shares(cut_scene), (std::vector<int>{4, 3, 4, 3}));
  EXPECT_EQ(shares(cut_with("elements: 14, ", "")), (std::vector<int>{5, 5, 5, 5}));
  EXPECT_EQ(shares(cut_with("elements: 14", "elements: 2")), (std::vector<int>{1, 1, 1, 1}));
}

TEST(Pieces, CarryTheLumpsAndSupportsOfTheirPoints) {
  const auto lumps = [](int k) { return body(cut(), "coupler " + std::to_string(k)).elastic->lumps; };
  EXPECT_TRUE(lumps(1).empty());
  EXPECT_EQ(lumps(2).at(0).mass, 0.1);
  EXPECT_EQ(lumps(4).at(0).at, "B");
  EXPECT_EQ(body(cut(), "coupler 1").elastic->supports.size(), 1u);
  EXPECT_TRUE(body(cut(), "coupler 3").elastic->supports.empty());
}

TEST(Pieces, TieTheirFramesToTheirOwnEnds) {
  using Frame = SceneModes::Frame;
  const auto ties = [](const std::string& frame, int k) {
    const Scene scene = pieces_of(cut_with("{chord: [A, B]}", frame));
    return body(scene, "coupler " + std::to_string(k)).elastic->modes.value();
  };
  EXPECT_EQ(ties("{chord: [A, B]}", 1).b, "cut 1");
  EXPECT_EQ(ties("{chord: [A, B]}", 2).a, "cut 1");
  EXPECT_EQ(ties("{chord: [A, B]}", 2).b, "Q");
  EXPECT_EQ(ties("{chord: [M, K]}", 2).a + ties("{chord: [M, K]}", 2).b, "MK");
  EXPECT_EQ(ties("chord", 4).a + " " + ties("chord", 4).b, "cut 3 B");
  EXPECT_EQ(ties("{tangent: K}", 2).a, "K");
  EXPECT_EQ(ties("{tangent: K}", 3).a, "cut 2");
  EXPECT_EQ(ties("mean axes", 3).frame, Frame::mean_axes);
  EXPECT_EQ(ties("mean axes", 3).a, "");
}

TEST(Pieces, AreWhatNamedPointsNameFromThenOn) {
  EXPECT_EQ(shown(joint(cut(), "knee").b), "coupler 1.A");
  EXPECT_EQ(shown(joint(cut(), "pin").a), "coupler 4.B");
  EXPECT_EQ(joint(cut(), "pin").clearance->bearing, "coupler 4");
  EXPECT_EQ(shown(joint(cut(), "guide").b), "slider.");
  EXPECT_EQ(shown(cut().drivers[0].b), "coupler 2.M");
  EXPECT_EQ(shown(std::get<SceneForce>(cut().loads[0].what).at), "coupler 2.Q");
  EXPECT_EQ(shown(std::get<SceneTorque>(cut().loads[1].what).b), "coupler 2.Q");
  EXPECT_EQ(shown(std::get<SceneSpring>(cut().loads[2].what).a), "coupler 2.K");
  EXPECT_EQ(shown(std::get<SceneTorsionSpring>(cut().loads[3].what).b), "coupler 2.M");
  EXPECT_EQ(shown(cut().output.points[0]), "crank.A");
  EXPECT_EQ(shown(cut().output.points[1]), "coupler 2.M");
  EXPECT_EQ(shown(cut().output.stress[0]), "coupler 2.Q");
  EXPECT_FALSE(cut().statics.has_value());
}

TEST(Pieces, StartAsPartsOfOneBody) {
  ASSERT_EQ(cut().start_bodies.size(), 5u);
  for (std::size_t k = 0; k < 4; ++k) {
    const StartBody& s = cut().start_bodies[k];
    EXPECT_EQ(s.body, "coupler " + std::to_string(k + 1));
    EXPECT_EQ(s.speed, 3);
    EXPECT_EQ(s.x, 1);
    EXPECT_FALSE(s.y.has_value());
  }
  EXPECT_EQ(cut().start_bodies[4].body, "crank");
}

struct Sum {
  double mass = 0, inertia = 0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  std::vector<double> areas;
};
Sum sum_of(const Scene& scene) {
  Sum sum;
  for (const SceneBody& b : scene.bodies) {
    if (!b.elastic) continue;
    const ElasticBody e = elastic_body(scene, b);
    const RigidInertia inertia = rigid_inertia(e.model, e.M);
    sum.mass += inertia.m;
    sum.inertia += inertia.J;
    sum.moment += inertia.c;
    for (const Fibre& f : e.fibres) sum.areas.push_back(f.A);
  }
  return sum;
}

// Cuts on nodes of the whole beam (elements of a quarter of a metre) leave the same elements.
TEST(Pieces, MakeTheSameBodyElementByElement) {
  const std::string text = cut_with("elements: 14", "elements: 28");
  const Sum parts = sum_of(pieces_of(text)), whole = sum_of(read_scene_text(text, "scene.yaml"));
  ASSERT_EQ(parts.areas.size(), whole.areas.size());
  for (std::size_t i = 0; i < whole.areas.size(); ++i) EXPECT_NEAR(parts.areas[i], whole.areas[i], rounding * whole.areas[i]);
  EXPECT_NEAR(parts.mass, whole.mass, rounding * whole.mass);
  EXPECT_NEAR(whole.mass, 3.3, rounding * 3.3) << "3 kg of beam and two lumps";
}

TEST(Pieces, OfAnEvenBeamHaveItsInertia) {
  std::string text = cut_with("elements: 14", "elements: 28");
  const std::string taper = "taper to: {rectangle: [20 mm, 5 mm]},";
  text.erase(text.find(taper), taper.size());
  const Sum parts = sum_of(pieces_of(text)), whole = sum_of(read_scene_text(text, "scene.yaml"));
  EXPECT_NEAR(parts.mass, whole.mass, rounding * whole.mass);
  EXPECT_NEAR(parts.inertia, whole.inertia, rounding * whole.inertia);
  EXPECT_NEAR((parts.moment - whole.moment).norm(), 0, rounding * whole.moment.norm());
}

TEST(Pieces, OfACutBeamKeepItsDensity) {
  const Scene scene = pieces_of(cut_with("mass: 3 kg", "density: 7800"));
  for (int k = 1; k <= 4; ++k) {
    const SceneBeam& b = beam(scene, "coupler " + std::to_string(k));
    EXPECT_FALSE(b.mass.has_value());
    EXPECT_EQ(b.material.material.density, 7800);
  }
}

TEST(Pieces, GiveCutsNamesThatNoPointHas) {
  const Scene scene = pieces_of(cut_with("M: {at", "cut 1: [1, 0], M: {at"));
  EXPECT_EQ(beam(scene, "coupler 2").through.front(), "cut 1'");
  EXPECT_EQ(point(body(scene, "coupler 1"), "cut 1").at, (Pair{1, 0}));
}

TEST(Pieces, LeaveASceneWithoutThemAlone) {
  for (const std::string& text : {cut_with("pieces: 4", "pieces: 1"), slider_crank}) {
    const Scene before = read_scene_text(text, "scene.yaml"), after = with_pieces(before);
    EXPECT_EQ(after.bodies.size(), before.bodies.size());
    EXPECT_EQ(after.joints.size(), before.joints.size());
    EXPECT_EQ(after.start_bodies.size(), before.start_bodies.size());
    EXPECT_EQ(after.statics.has_value(), before.statics.has_value());
    EXPECT_EQ(after.bodies[1].name, before.bodies[1].name);
  }
}

TEST(BadPieces, AreRefusedWithPlaceAndRemedy) {
  struct Case {
    std::string from, to, place;
    Names says;
  };
  const std::vector<Case> cases{
      {"at: coupler.Q", "at: coupler.QQ", "scene.yaml:22: forces.push.at: ", {"has no point \"QQ\"", "\"Q\""}},
      {"[coupler.K, ground]", "[coupler.K, coupler.A]", "scene.yaml:24: forces.coil: ", {"both ends are on \"coupler\""}},
      {"M: {at: [2, 0]", "M: {at: [2, 0.001]", "scene.yaml:6: bodies.coupler.points.M: ", {"off the axis", "(2, 0.001) m"}},
      {"[A, K, B]", "[A, K, B, A]", "scene.yaml:3: bodies.coupler: ", {"passes A twice"}},
      {"  slider: {rigid",
       "  coupler 3: {rigid: {mass: 1, inertia: 1}}\n  slider: {rigid",
       "scene.yaml:14: bodies.coupler 3: ",
       {"\"coupler 3\" is the name of a piece"}},
      {"drivers: {lift",
       "drivers: {coupler 1-2",
       "scene.yaml:20: drivers.coupler 1-2: ",
       {"\"coupler 1-2\" is the name of a weld", "another name"}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.to);
    const std::string said = rejected(cut_with(c.from, c.to));
    EXPECT_TRUE(said.starts_with(c.place)) << said;
    expect_says(said, c.says);
  }
}

TEST(Pieces, MeanTheirPointAtTheOriginByTheBodyAlone) {
  const auto piece = [](const std::string& text) {
    const Scene scene = pieces_of(text);
    return shown(std::get<SceneTorque>(scene.loads[1].what).b);
  };
  EXPECT_EQ(piece(cut_with("on: coupler.Q", "on: coupler")), "coupler 1.");
  std::string moved = cut_with("{A: [0, 0], K: [3, 0], B: [3, 4], M: {at: [2, 0]", "{A: [-2, 0], K: [1, 0], B: [1, 4], M: {at: [0, 0]");
  moved.replace(moved.find("[3, 0.5]"), 8, "[1, 0.5]").replace(moved.find("on: coupler.Q"), 13, "on: coupler");
  EXPECT_EQ(piece(moved), "coupler 2.");
}

TEST(BadPieces, WithoutAPointAtTheOriginMustBeMetAtAPoint) {
  std::string off = cut_with("{A: [0, 0], K: [3, 0], B: [3, 4], M: {at: [2, 0]", "{A: [0, 1], K: [3, 1], B: [3, 5], M: {at: [2, 1]");
  off.replace(off.find("[3, 0.5]"), 8, "[3, 1.5]");
  EXPECT_EQ(rejected(off), "accepted");
  const auto said = [&](const std::string& from, const std::string& to) {
    std::string text = off;
    return rejected(text.replace(text.find(from), from.size(), to));
  };
  const Names remedy{"the origin of its axes", "name one of its points: A, K, B, M or Q"};
  const auto expect = [&](const std::string& message, const std::string& place) {
    EXPECT_TRUE(message.starts_with(place)) << message;
    expect_says(message, remedy);
  };
  expect(said("on: coupler.Q", "on: coupler"), "scene.yaml:23: forces.turn.on: ");
  expect(said("[ground, coupler.M]", "[ground, coupler]"), "scene.yaml:20: drivers.lift.distance[2]: ");
  expect(said("coupler.M, ground]", "coupler, ground]"), "scene.yaml:31: output.points[2]: ");
}

TEST(BadPieces, OfASceneMadeByHandAreJudgedToo) {
  const auto said = [](auto&& spoil) {
    Scene scene = read_scene_text(cut_scene, "scene.yaml");
    spoil(*scene.bodies[1].elastic);
    return pintle_test::refusal_by([&] { with_pieces(scene); });
  };
  expect_says(said([](SceneElastic& e) { e.modes.reset(); }), {"bodies.coupler", "add modes"});
  expect_says(said([](SceneElastic& e) { std::get<SceneBeam>(e.shape).bar = true; }), {"bodies.coupler", "euler or timoshenko"});
  expect_says(said([](SceneElastic& e) { std::get<SceneBeam>(e.shape).through = {"A"}; }), {"bodies.coupler", "fewer than two points"});
}

}  // namespace
}  // namespace pintle::pieces_test
