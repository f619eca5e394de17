// What a scene says once for many: repeat, assemblies, instances. Each is the scene that one would write by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/scene_text.h"

namespace pintle::instances_test {
namespace {

/// What is read, whatever parameters there were to write it with.
std::string read_whole(const std::string& text, const Overrides& overrides = {}) {
  Scene scene = read_scene_text(text, "scene.yaml", overrides);
  const std::size_t begin = scene.filled_in.find("\"parameters\""), end = scene.filled_in.find("\"materials\"");
  return scene.filled_in.erase(begin, end - begin);
}

void expect_same(const std::string& written, const std::string& by_hand) { EXPECT_EQ(read_whole(written), read_whole(by_hand)); }

TEST(Repeat, IsTheEntryWrittenOutWithItsIndex) {
  expect_same(R"(
parameters: {n: 3, half: 25 mm}
ground: {points: {rest: {repeat: n, at: [10 mm*index, 0]}}}
bodies: {link: {repeat: n, rigid: {mass: 1 g*index, inertia: 1}, points: {A: [-half, 0], B: [half, 0]}, pose: {at: [(index - 0.5)*50 mm, 0]}}}
joints:
  hook: {revolute: [ground, link 1.A]}
  pin: {repeat: n - 1, revolute: ["link {index}.B", "link {index + 1}.A"]}
forces: {pull: {repeat: n, force: [1 N, index*1 N*sin(t/(1 s))], at: "link {index}.B"}, rest: {spring: ["link {n}", "ground.rest {n}"], damping: 1}}
start: {link: {repeat: 2, angle: index*10 deg}}
run: {until: 1 s}
output: {points: ["link {n}.B"]}
)",
              R"(
ground: {points: {rest 1: {at: [10 mm, 0]}, rest 2: {at: [20 mm, 0]}, rest 3: {at: [30 mm, 0]}}}
bodies:
  link 1: {rigid: {mass: 1 g, inertia: 1}, points: {A: [-25 mm, 0], B: [25 mm, 0]}, pose: {at: [0.5*50 mm, 0]}}
  link 2: {rigid: {mass: 2 g, inertia: 1}, points: {A: [-25 mm, 0], B: [25 mm, 0]}, pose: {at: [1.5*50 mm, 0]}}
  link 3: {rigid: {mass: 3 g, inertia: 1}, points: {A: [-25 mm, 0], B: [25 mm, 0]}, pose: {at: [2.5*50 mm, 0]}}
joints: {hook: {revolute: [ground, link 1.A]}, pin 1: {revolute: [link 1.B, link 2.A]}, pin 2: {revolute: [link 2.B, link 3.A]}}
forces:
  pull 1: {force: [1 N, (1)*1 N*sin(t/(1 s))], at: link 1.B}
  pull 2: {force: [1 N, (2)*1 N*sin(t/(1 s))], at: link 2.B}
  pull 3: {force: [1 N, (3)*1 N*sin(t/(1 s))], at: link 3.B}
  rest: {spring: [link 3, ground.rest 3], damping: 1}
start: {link 1: {angle: 10 deg}, link 2: {angle: 20 deg}}
run: {until: 1 s}
output: {points: [link 3.B]}
)");
}

const std::string legs = R"(
parameters: {turn: 2 s, far: 120 mm}
ground: {points: {O: [0, 1 m]}, profiles: {floor: {path: [[-1 m, 0], [1 m, 0]], material: right}}}
bodies: {frame: {rigid: {mass: 1 kg, inertia: 1}, points: {L: [-far, 0], R: [far, 0]}}}
assemblies:
  leg:
    parameters: {phase: 0 deg, length: 80 mm}
    ports: [hip]
    materials: {steel: {young: 1 GPa, poisson: 0.3, density: 1}}
    ground: {points: {O: [1 mm, 2 mm]}}
    bodies:
      thigh: {rigid: {mass: 1 kg, inertia: 1}, points: {H: [0, 0], K: [length, 0]}, pose: {at: [0, -length], angle: phase}}
      shin: {beam: {from: K, to: F, section: {circle: 10 mm}, material: steel}, points: {K: [0, 0], F: [length, 0]}}
    joints:
      hip: {revolute: [hip, thigh.H]}
      knee: {revolute: [thigh.K, shin.K], clearance: {radial: 1 um, bearing radius: 1 mm, bearing: thigh, model: massless link}}
    drivers: {motor: {angle: [frame, thigh], law: phase + 360 deg*t/turn}}
    forces: {back: {spring: [ground.O, shin.F], damping: 1}, weight: {torque: 1 N m, on: shin}}
    start: {thigh: {angle: phase}, knee: {eccentricity: [1 um, 0]}}
    output: {points: [thigh.K]}
instances:
  left: {of: leg, at: [-far, 10 mm], ports: {hip: frame.L}}
  right: {of: leg, at: [far, 10 mm], with: {phase: 90 deg, length: 70}, ports: {hip: frame.R}}
run: {until: 1 s}
output: {points: [frame.L]}
)";

std::string leg(const std::string& name, const std::string& x, const std::string& phase, const std::string& length,
                const std::string& what) {
  if (what == "materials") return name + " steel: {young: 1 GPa, poisson: 0.3, density: 1}";
  if (what == "points") return name + " O: [1 mm + " + x + ", 2 mm + 10 mm]";
  if (what == "bodies")
    return name + " thigh: {rigid: {mass: 1 kg, inertia: 1}, points: {H: [0, 0], K: [" + length + ", 0]}, pose: {at: [" + x + ", 10 mm - " +
           length + "], angle: " + phase + "}}, " + name + " shin: {beam: {from: K, to: F, section: {circle: 10 mm}, material: " + name +
           " steel}, points: {K: [0, 0], F: [" + length + ", 0]}, pose: {at: [" + x + ", 10 mm]}}";
  if (what == "joints")
    return name + " hip: {revolute: [frame." + (name == "left" ? "L" : "R") + ", " + name + " thigh.H]}, " + name + " knee: {revolute: [" +
           name + " thigh.K, " + name + " shin.K], clearance: {radial: 1 um, bearing radius: 1 mm, bearing: " + name +
           " thigh, model: massless link}}";
  if (what == "drivers") return name + " motor: {angle: [frame, " + name + " thigh], law: (" + phase + ") + 360 deg*t/turn}";
  if (what == "forces")
    return name + " back: {spring: [ground." + name + " O, " + name + " shin.F], damping: 1}, " + name +
           " weight: {torque: 1 N m, on: " + name + " shin}";
  return name + " thigh: {angle: " + phase + "}, " + name + " knee: {eccentricity: [1 um, 0]}";
}

std::string legs_by_hand() {
  const auto both = [](const std::string& what) {
    return "{" + leg("left", "-120 mm", "0 rad", "80 mm", what) + ", " + leg("right", "120 mm", "90 deg", "70 m", what) + "}";
  };
  const auto with_own = [&](const std::string& own, const std::string& what) { return "{" + own + ", " + both(what).substr(1); };
  return "parameters: {turn: 2 s, far: 120 mm}\nmaterials: " + both("materials") +
         "\nground: {points: " + with_own("O: [0, 1 m]", "points") +
         ", profiles: {floor: {path: [[-1 m, 0], [1 m, 0]], material: right}}}\nbodies: " +
         with_own("frame: {rigid: {mass: 1 kg, inertia: 1}, points: {L: [-far, 0], R: [far, 0]}}", "bodies") +
         "\njoints: " + both("joints") + "\ndrivers: " + both("drivers") + "\nforces: " + both("forces") + "\nstart: " + both("start") +
         "\nrun: {until: 1 s}\noutput: {points: [frame.L, left thigh.K, right thigh.K]}\n";
}

TEST(Instances, AreTheirPartsWrittenOutUnderTheirNames) {
  std::string hand = legs_by_hand();
  const std::string degrees = "(90 deg) + 360", radians = "(1.5707963267948966 rad) + 360";
  hand.replace(hand.find(degrees), degrees.size(), radians);
  expect_same(legs, hand);
}

TEST(Instances, AreReadBackTheSameFromWhatIsKept) {
  const std::string kept = read_scene_text(legs, "scene.yaml").filled_in;
  EXPECT_EQ(read_scene_text(kept, "again.json").filled_in, kept);
}

TEST(Instances, AreReachedByOverrides) {
  std::string text = legs;
  text.replace(text.find("phase: 90 deg"), 13, "phase: 45 deg");
  EXPECT_EQ(read_whole(legs, {{"instances.right.with.phase", "45 deg"}}), read_whole(text));
  EXPECT_EQ(read_scene_text(legs, "scene.yaml", {{"bodies.right thigh.rigid.mass", "7 kg"}}).bodies[3].mass, 7);
  EXPECT_EQ(read_scene_text(legs, "scene.yaml", {{"bodies.right thigh.rigid.mass", "length/(1 m)*1 kg"}}).bodies[3].mass, 70);
  expect_says(refusal_of(legs, {{"bodies.right thing.rigid.mass", "7 kg"}}),
              {"there is no body \"right thing\"", "Did you mean \"right thigh\"?"});
  expect_says(refusal_of(legs, {{"instances.rigth.at", "[0, 0]"}}), {"there is no instance \"rigth\"", "Did you mean \"right\"?"});
}

/// Assemblies within assemblies, with a repeat inside: names and parameters of what holds them are known within.
TEST(Instances, MayHoldInstances) {
  expect_same(R"(
assemblies:
  wheel:
    parameters: {r: 1 m}
    bodies: {rim: {rigid: {mass: 1, inertia: 1}, points: {P: [r, width]}}}
    joints: {axle: {revolute: [beam.E, rim]}}
  cart:
    parameters: {width: 2 m}
    bodies: {beam: {rigid: {mass: 2, inertia: 1}, points: {E: [0, 0]}}}
    instances: {wheel: {of: wheel, repeat: 2, at: [index*1 m, 0], with: {r: 1 m + index*1 mm}}}
    joints: {tie: {weld: [beam, ground]}, link: {repeat: 2, distance: ["wheel {index} rim", beam], length: 1}}
instances: {train: {of: cart, at: [10 m, 0]}}
)",
              R"(
ground: {points: {train: {at: [10 m, 0]}}}
bodies:
  train beam: {rigid: {mass: 2, inertia: 1}, points: {E: [0, 0]}, pose: {at: [10 m, 0]}}
  train wheel 1 rim: {rigid: {mass: 1, inertia: 1}, points: {P: [1.001, 2 m]}, pose: {at: [11 m, 0]}}
  train wheel 2 rim: {rigid: {mass: 1, inertia: 1}, points: {P: [1.002, 2 m]}, pose: {at: [12 m, 0]}}
joints:
  train tie: {weld: [train beam, ground.train]}
  train link 1: {distance: [train wheel 1 rim, train beam], length: 1}
  train link 2: {distance: [train wheel 2 rim, train beam], length: 1}
  train wheel 1 axle: {revolute: [train beam.E, train wheel 1 rim]}
  train wheel 2 axle: {revolute: [train beam.E, train wheel 2 rim]}
)");
}

TEST(Instances, OfTenThousandPartsAreRead) {
  const Scene scene = read_scene_text(R"(
assemblies: {cell: {bodies: {a: {rigid: {mass: 1, inertia: 1}}}, joints: {j: {revolute: [ground, a]}}, start: {a: {angle: 1}}}}
instances: {cell: {of: cell, repeat: 10000, at: [index*1 mm, 0]}}
)",
                                      "scene.yaml");
  ASSERT_EQ(scene.bodies.size(), 10000u);
  EXPECT_EQ(scene.joints.back().a.point, "cell 10000");
  EXPECT_EQ(scene.start_bodies.back().body, "cell 10000 a");
}

TEST(Instances, AreRefusedWithLineAndInstance) {
  const auto in_legs = [](const std::string& from, const std::string& to) {
    std::string text = legs;
    return text.replace(text.find(from), from.size(), to);
  };
  const std::vector<Spoiled> all{
      {"of: leg, at: [-far",
       "of: lag, at: [-far",
       "scene.yaml:22: instances.left.of: ",
       {"there is no assembly \"lag\"", "Did you mean \"leg\"?"}},
      {"phase: 90 deg, length: 70}",
       "phas: 90 deg}",
       "scene.yaml:23: instances.right.with.phas: ",
       {"has no such parameter", "Did you mean \"phase\"?"}},
      {"phase: 90 deg, length: 70}", "phase: 90 mm}", "scene.yaml:23: instances.right.with.phase: ", {"a length", "an angle"}},
      {", ports: {hip: frame.L}", "", "scene.yaml:22: instances.left: ", {"port \"hip\"", "add ports: {hip: body.A}"}},
      {"ports: {hip: frame.L}",
       "ports: {hip: frame.L, knee: frame}",
       "scene.yaml:22: instances.left.ports.knee: ",
       {"no such port", "hip"}},
      {"mass: 1 kg, inertia: 1}, points: {H",
       "mas: 1 kg, inertia: 1}, points: {H",
       "scene.yaml:12: bodies.left thigh.rigid.mas: ",
       {"Did you mean \"mass\"?", "(in the instance \"left\", scene.yaml:22)"}},
      {"young: 1 GPa", "young: 1 mm", "scene.yaml:9: materials.left steel.young: ", {"a length", "in the instance \"left\""}},
      {"section: {circle: 10 mm}, material: steel",
       "section: {circle: 10 mm}, material: steal",
       "scene.yaml:13: bodies.left shin.beam.material: ",
       {"\"steal\"", "left steel"}},
      {"length: 80 mm}", "length: longth}", "scene.yaml:7: assemblies.leg.parameters.length: ", {"\"longth\"", "in the instance \"left\""}},
      {"    ports: [hip]", "    gravity: [0, 1]\n    ports: [hip]", "scene.yaml:8: assemblies.leg.gravity: ", {"unknown key"}},
      {"output: {points: [thigh.K]}", "output: {frames: 3}", "scene.yaml:20: assemblies.leg.output.frames: ", {"is for the scene only"}},
      {"bodies: {frame:",
       "bodies: {left shin: {rigid: {mass: 1}}, frame:",
       "scene.yaml:13: bodies.left shin: ",
       {"the name is also used at scene.yaml:4", "rename"}},
      {"instances:\n",
       "instances:\n  many: {of: leg, repeat: 1e9, ports: {hip: frame.L}}\n",
       "scene.yaml:22: instances.many.repeat: ",
       {"more than a hundred thousand"}},
      {"instances:\n",
       "instances:\n  many: {of: leg, repeat: 1e5, ports: {hip: frame.L}}\n",
       "scene.yaml:",
       {"more than a million values"}},
      {"instances:\n",
       "instances:\n  many: {of: leg, repeat: 1.5, ports: {hip: frame.L}}\n",
       "scene.yaml:22: instances.many.repeat: ",
       {"whole number"}},
      {"frame.L}}\n", "\"frame {1.5}.L\"}}\n", "scene.yaml:22: instances.left.ports.hip: ", {"1.5", "whole number"}},
      {"frame.L}}\n", "\"frame {1.L\"}}\n", "scene.yaml:22: instances.left.ports.hip: ", {"a brace is not closed"}}};
  expect_each_refused(all, in_legs);
}

TEST(Instances, ThatHoldThemselvesAreRefusedByName) {
  expect_one_line(refusal_of(R"(
assemblies: {a: {instances: {x: {of: b}}}, b: {instances: {y: {of: a}}}}
instances: {top: {of: a}}
)"),
                  "scene.yaml:2: ", {"contain itself: a > b > a"});
}

TEST(Instances, ThatMultiplyAreRefused) {
  expect_says(refusal_of(R"(
assemblies:
  a: {bodies: {m: {rigid: {mass: 1, inertia: 1}}}}
  b: {instances: {x: {of: a, repeat: 1000}}}
  c: {instances: {x: {of: b, repeat: 1000}}}
instances: {top: {of: c, repeat: 1000}}
)"),
              {"more than a million values"});
}

TEST(Angles, BareBeyondATurnAreDoubted) {
  const auto warned = [](const std::string& text) { return read_scene_text(text, "scene.yaml").warnings; };
  const auto body = [](const std::string& angle) { return "bodies:\n  a: {rigid: {mass: 1, inertia: 1}, pose: {angle: " + angle + "}}\n"; };
  ASSERT_EQ(warned(body("45")).size(), 1u);
  expect_one_line(warned(body("45")).front(), "scene.yaml:2: bodies.a.pose.angle: ", {"\"45\"", "7.16 turns", "\"45 deg\""});
  for (const char* honest : {"6.28", "45 deg", "45 rad", "-6.28", "2*pi", "9 rad"}) EXPECT_TRUE(warned(body(honest)).empty()) << honest;
  const std::string kept = read_scene_text(body("45 rad"), "scene.yaml").filled_in;
  EXPECT_TRUE(warned(kept).empty());
  EXPECT_EQ(read_scene_text(kept, "again").bodies[0].angle, 45);
}

TEST(WorldPoints, AreTakenIntoTheBodysAxes) {
  const Scene scene = read_scene_text(R"(
bodies:
  posed: {rigid: {mass: 1, inertia: 1}, pose: {at: [1, 2], angle: 90 deg}, points: {A: {world: [1, 5]}, B: {world: [0, 2], angle: 120 deg}}}
  drawn: {rigid: {mass: 1, inertia: 1}, points: {A: {world: [1, 1]}, B: {world: [1, 3]}, C: {world: [0, 2]}}}
  one: {rigid: {mass: 1, inertia: 1}, points: {A: {world: [4, 5]}}}
)",
                                      "scene.yaml");
  const auto near = [](const Pair& p, double x, double y) { return std::abs(p[0] - x) < 1e-15 && std::abs(p[1] - y) < 1e-15; };
  const SceneBody &posed = scene.bodies[0], &drawn = scene.bodies[1], &one = scene.bodies[2];
  EXPECT_TRUE(near(posed.points[0].at, 3, 0) && near(posed.points[1].at, 0, 1));
  EXPECT_NEAR(posed.points[1].angle, 0.5235987755982988, 1e-15);
  EXPECT_TRUE(near(drawn.at, 1, 2) && near(drawn.points[0].at, -1, 0) && near(drawn.points[1].at, 1, 0) && near(drawn.points[2].at, 0, 1));
  EXPECT_NEAR(drawn.angle, 1.5707963267948966, 1e-15);
  EXPECT_TRUE(near(one.at, 4, 5) && near(one.points[0].at, 0, 0));
}

TEST(Colours, AreNamesOfCssOrNumbers) {
  const auto text = [](const std::string& colour) { return "bodies: {a: {rigid: {mass: 1, inertia: 1}, colour: " + colour + "}}"; };
  EXPECT_EQ(read_scene_text(text("steelblue"), "scene.yaml").bodies[0].colour, "steelblue");
  EXPECT_EQ(read_scene_text(text("\"#4682b4\""), "scene.yaml").bodies[0].colour, "#4682b4");
  expect_says(refusal_of(text("steelblu")), {"not a colour", "Did you mean \"steelblue\"?"});
  expect_says(refusal_of(text("\"#46g2b4\"")), {"not a colour"});
}

}  // namespace
}  // namespace pintle::instances_test
