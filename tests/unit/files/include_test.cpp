// Scene files that read others into them: as if their text stood there, with their own lines in messages, and nothing from outside the folder.
#include <gtest/gtest.h>

#include "files/trust.h"
#include "tests/unit/scene_text.h"

namespace pintle::include_test {
namespace {

struct Include : testing::Test {
  std::string refusal(const std::string& text) const {
    return refusal_by([&] { read_scene(folder.write("scene.yaml", text)); });
  }
  Scene read(const std::string& text) const { return read_scene(folder.write("scene.yaml", text)); }
  void put(const std::string& name, const std::string& text) const {
    fs::create_directories((folder.path / name).parent_path());
    folder.write(name, text);
  }
  Folder folder;
};

TEST_F(Include, ReadsPartsAsIfTheyStoodThere) {
  put("parts/wheel.yaml",
      "include: steel.yaml\nparameters: {r: 1 m, w: 2*r}\nbodies: {wheel: {rigid: {mass: 1, inertia: 1}, points: {P: [w, 0]}}}\n"
      "ground: {points: {A: [0, 0]}}\nrun: {until: 5 s}\n");
  put("parts/steel.yaml", "materials: {steel: {young: 1 GPa, poisson: 0.3, density: 1}}\n");
  const Scene is = read(
      "include: [parts/wheel.yaml, parts/steel.yaml]\nparameters: {r: 3 m}\nground: {points: {B: [1, 0]}}\nrun: {until: 1 s}\n"
      "joints: {axle: {revolute: [ground.A, wheel.P]}}\n");
  const Scene hand = read(
      "materials: {steel: {young: 1 GPa, poisson: 0.3, density: 1}}\nparameters: {r: 3 m, w: 2*r}\n"
      "bodies: {wheel: {rigid: {mass: 1, inertia: 1}, points: {P: [w, 0]}}}\nground: {points: {A: [0, 0], B: [1, 0]}}\nrun: {until: 1 s}\n"
      "joints: {axle: {revolute: [ground.A, wheel.P]}}\n");
  EXPECT_EQ(is.filled_in, hand.filled_in);
}

TEST_F(Include, MakesAnAssemblyOfAScene) {
  put("engine.yaml",
      "title: engine\ngravity: [0, 1]\nparameters: {heavy: 1 kg}\nbodies: {rod: {rigid: {mass: heavy, inertia: 1}}}\nrun: {until: 1 s}\n");
  const Scene is = read(
      "assemblies: {engine: {include: engine.yaml, ports: [on], joints: {hold: {revolute: [on, rod]}}}}\n"
      "instances: {left: {of: engine, with: {heavy: 2 kg}, ports: {on: ground}}, right: {of: engine, ports: {on: ground}}}\n");
  EXPECT_EQ(is.gravity[1], 0);
  ASSERT_EQ(is.bodies.size(), 2u);
  EXPECT_EQ(is.bodies[0].mass, 2);
  EXPECT_EQ(is.joints[1].b.body, "right rod");
}

TEST_F(Include, TellsTheFileAndLineOfAMistake) {
  put("parts/wheel.yaml", "bodies:\n  wheel: {rigid: {mass: 1 kg, inertia: 1},\n    points: {P: [1 s, 0]}}\n");
  expect_one_line(refusal("include: parts/wheel.yaml\n"),
                  (folder.path / "parts/wheel.yaml").string() + ":3: bodies.wheel.points.P[1]: ", {"a time"});
  put("parts/wheel.yaml", "bodies:\n  wheel: {rigid: {mass: 1 kg, inertia: 1\n");
  expect_says(refusal("include: parts/wheel.yaml\n"), {"parts/wheel.yaml:", "this is not YAML"});
  put("parts/wheel.yaml", "bodies: {wheel: {rigid: {mass: 1 kg, inertia: 1}}}\n");
  expect_one_line(refusal("include: parts/wheel.yaml\nbodies:\n  wheel: {rigid: {mass: 1}}\n"),
                  (folder.path / "scene.yaml").string() + ":3: bodies.wheel: ", {"is also in ", "parts/wheel.yaml:1; rename"});
}

TEST_F(Include, FindsTablesBesideTheFileThatNamesThem) {
  put("parts/load.csv", "0 1\n1 2\n");
  put("parts/load.yaml", "forces: {load: {torque: {table: load.csv}, on: a}}\n");
  const Scene is = read("include: parts/load.yaml\nbodies: {a: {rigid: {mass: 1, inertia: 1}}}\nrun: {until: 1 s}\n");
  EXPECT_NE(is.filled_in.find("parts/load.csv"), std::string::npos);
  EXPECT_EQ(read_scene(folder.write("kept.json", is.filled_in)).filled_in, is.filled_in);
}

TEST_F(Include, RefusesCirclesByName) {
  put("a.yaml", "include: b.yaml\n");
  put("b.yaml", "include: a.yaml\n");
  expect_says(refusal("include: a.yaml\nbodies: {a: {rigid: {mass: 1}}}\n"), {"b.yaml:1: include: ", "a.yaml > b.yaml > a.yaml"});
  expect_says(refusal("include: scene.yaml\nbodies: {a: {rigid: {mass: 1}}}\n"), {"scene.yaml:1: include: ", "scene.yaml > scene.yaml"});
}

TEST_F(Include, ReadsNothingFromOutside) {
  put("inner/scene.yaml", "include: ../secret.yaml\nbodies: {a: {rigid: {mass: 1, inertia: 1}}}\n");
  put("secret.yaml", "bodies: {b: {rigid: {mass: 1, inertia: 1}}}\n");
  const auto read_inner = [&] { return read_scene(folder.path / "inner/scene.yaml"); };
  expect_says(refusal_by(read_inner), {"inner/scene.yaml:1: include: ", "--allow-path"});
  put("inner/parts/deep.yaml", "include: ../../secret.yaml\n");
  put("inner/scene.yaml", "include: parts/deep.yaml\nbodies: {a: {rigid: {mass: 1, inertia: 1}}}\n");
  expect_says(refusal_by(read_inner), {"parts/deep.yaml:1: include: ", "--allow-path"});
  set_trust({.folders = {folder.path}});
  EXPECT_EQ(read_inner().bodies.size(), 2u);
  set_trust({});
}

TEST_F(Include, RefusesWhatIsNoPart) {
  expect_says(refusal("include: parts/none.yaml\n"), {"scene.yaml:1: include: ", "there is no file \"parts/none.yaml\""});
  put("list.yaml", "[1, 2]\n");
  expect_says(refusal("include: list.yaml\n"), {"list.yaml:1: ", "contains no keys of a scene"});
  expect_says(refusal("include: {a: b}\n"), {"include: ", "write the name of a scene file"});
}

}  // namespace
}  // namespace pintle::include_test
