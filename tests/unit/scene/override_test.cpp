// Any key of a scene by its path: what stands there gives way before the scene is read.
#include <gtest/gtest.h>

#include <algorithm>

#include "framework/scene/yaml/keys.h"
#include "framework/scene/yaml/override.h"
#include "tests/unit/scene_text.h"

namespace pintle::override_test {
namespace {

Scene scene_with(const Overrides& overrides) { return read_scene_text(slider_crank, "scene.yaml", overrides); }

/// What is read must not tell whether a value was written in the file or put in by its path.
TEST(Override, IsTheSameAsWritingItInTheFile) {
  struct Case {
    std::string path, value, from, to;
  };
  const std::vector<Case> cases{
      {"run.tolerance", "1e-6", "tolerance: 1e-9", "tolerance: 1e-6"},
      {"joints.pin.clearance.radial", "2*clearance + 1 um", "radial: clearance", "radial: 2*clearance + 1 um"},
      {"joints.pin.clearance.normal", "{lankarani-nikravesh: {restitution: 0.5, stiffness: 1e10}}",
       "normal: {lankarani-nikravesh: {restitution: 0.8, young: 207 GPa, poisson: 0.3}}",
       "normal: {lankarani-nikravesh: {restitution: 0.5, stiffness: 1e10}}"},
      {"joints.pin.clearance.friction", "null", "      friction: {ambrosio: {coefficient: 0.1, v0: 1 mm/s, v1: 10 mm/s}}\n", ""},
      {"joints.guide.angle", "null", "[ground, slider], angle: 90 deg", "[ground, slider]"},
      {"drivers.motor.law", "60 deg + speed*if(t < 1 s, t, 2 s - t)", "law: speed*t", "law: \"60 deg + speed*if(t < 1 s, t, 2 s - t)\""},
      {"forces.push.force.2", "7 N", "5 N*sin(10*t)]", "7 N]"},
      {"forces.push.force[2]", "7 N", "5 N*sin(10*t)]", "7 N]"},
      {"bodies.crank.points.A.at.1", "30 mm", "at: [25 mm, 0], angle", "at: [30 mm, 0], angle"},
      {"bodies.crank.points.B", "[0, 5 mm]", "angle: 30 deg}}\n    pose", "angle: 30 deg}, B: [0, 5 mm]}\n    pose"},
      {"bodies.rod", "{rigid: {mass: 1 kg, inertia: 1}}", "joints:", "  rod: {rigid: {mass: 1 kg, inertia: 1}}\njoints:"},
      {"start.slider.x", "5 mm", "start:\n", "start:\n  slider: {x: 5 mm}\n"},
      {"parameters.speed", "20 rad/s", "speed: 150 rad/s", "speed: 20 rad/s"},
      {"gravity.2", "-1.62 m/s^2", "[0, -9.81]", "[0, -1.62 m/s^2]"},
      {"gravity", "[1, -2]", "gravity: [0, -9.81]", "gravity: [1, -2]"},
      {"title", "\"A: title, # with signs\"", "title: Slider-crank", "title: \"A: title, # with signs\""},
      {"forces", "null", slider_crank.substr(slider_crank.find("forces:"), slider_crank.find("start:") - slider_crank.find("forces:")),
       ""}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.path);
    std::string expected = read_scene_text(with(c.from, c.to), "scene.yaml").filled_in, got = scene_with({{c.path, c.value}}).filled_in;
    // The order of entries follows where they were put.
    std::ranges::sort(expected), std::ranges::sort(got);
    EXPECT_EQ(got, expected);
    EXPECT_NE(scene_with({}).filled_in, scene_with({{c.path, c.value}}).filled_in);
  }
}

TEST(Override, MakesTheGroupsOnItsWay) {
  std::string bare = slider_crank.substr(0, slider_crank.find("output:"));
  const Scene scene =
      read_scene_text(bare, "scene.yaml", {{"output.frames", "7"}, {"start.slider.velocity.1", "3"}, {"start.slider.velocity", "[1, 2]"}});
  EXPECT_EQ(scene.output.frames, 7);
  ASSERT_EQ(scene.start_bodies.size(), 2u);
  EXPECT_EQ(scene.start_bodies.back().vy, 2);
}

TEST(Override, MayBringTheFirstCopies) {
  const std::string one = "bodies: {rod: {rigid: {mass: 1, inertia: 1}}}\nrun: {until: 1}\n";
  EXPECT_EQ(read_scene_text(one, "scene.yaml", {{"bodies.rod.repeat", "3"}}).bodies.size(), 3u);
}

TEST(Override, AppliesInOrderAndBesideParameters) {
  const Scene scene =
      scene_with({{"run.until", "1 s"}, {"clearance", "0.3 mm"}, {"run.until", "2 s"}, {"joints.pin.clearance.radial", "clearance/3"}});
  EXPECT_EQ(scene.run.until, 2);
  EXPECT_DOUBLE_EQ(scene.joints[1].clearance->radial, 1e-4);
}

TEST(Override, TakesAwayWhatIsNotThereWithoutAWord) {
  EXPECT_EQ(scene_with({{"bodies.slider.points", "null"}, {"output.stress", "null"}, {"start.slider.x", "null"}}).filled_in,
            scene_with({}).filled_in);
}

TEST(Override, ParameterOfTheNameOfAKeyStaysAParameter) {
  const Scene scene = read_scene_text(with("  speed: 150 rad/s", "  speed: 150 rad/s\n  title: 3 mm"), "scene.yaml", {{"title", "4 mm"}});
  EXPECT_EQ(scene.title, "Slider-crank");
  EXPECT_EQ(scene.parameters.back().value, 4e-3);
}

TEST(Override, ThatLeadsNowhereSaysWhereAndWhatToDo) {
  struct Bad {
    std::string path, value;
    std::vector<std::string> says;
  };
  const std::vector<Bad> all{
      {"rum.until", "1 s", {"no key \"rum\"", "Did you mean \"run\"?"}},
      {"joints.pim.clearance.radial", "1 mm", {"there is no joint \"pim\"", "Did you mean \"pin\"?"}},
      {"bodies.crnk.points", "null", {"there is no body \"crnk\"", "Did you mean \"crank\"?"}},
      {"bodies.crnk", "null", {"there is no body \"crnk\"", "\"crank\""}},
      {"drivers.moter.law", "t", {"there is no driver \"moter\"", "\"motor\""}},
      {"run.until.long", "1 s", {"run.until is \"0.05 s\", not a group", "run.until={long: …}"}},
      {"gravity.4", "1", {"gravity is a list of 2", "from 1 to 3"}},
      {"gravity.x.1", "1", {"gravity is a list of 2", "not \"x\""}},
      {"run..until", "1 s", {"between two dots"}},
      {"run.until", "  ", {"write null to remove the key"}},
      {"run.until", "{a", {"run.until:1: ", "',' or '}' while parsing"}},
      {"run.until", "{[a]: 1}", {"a key must be a word"}},
      {"run.until", "'1 s", {"not YAML"}},
      {"run.until", "&a 1", {"anchor"}},
      {"run.untill", "1 s", {"unknown key \"untill\"", "Did you mean \"until\"?"}},
      {"run.until", "1 kg", {"\"1 kg\" is a mass [kg]; expected a time [s]"}},
      {"joints.pin.clearance.normal", "{lankarani-nikravesh: {restitutoin: 1}}", {".lankarani-nikravesh.restitutoin: unknown key"}},
      {"bodies.slider.rigid", "{mass: 1 kg, inertia: -1}", {"bodies.slider.rigid.inertia: \"-1\" must"}}};
  for (const Bad& b : all) {
    SCOPED_TRACE(b.path + "=" + b.value);
    const std::string place = "scene.yaml: --set " + b.path.substr(0, b.path.find(".."));
    expect_one_line(refusal_of(slider_crank, {{b.path, b.value}}), place, b.says);
  }
  // What is then missing in a group of the file is said with the file's line.
  expect_says(refusal_of(slider_crank, {{"run.until", "null"}}), {"scene.yaml:34: run: ", "until: 0.1 s"});
}

TEST(Override, TextOfATreeIsReadBackToTheSameTree) {
  const auto same = [](const Yaml& a, const Yaml& b, const auto& again) -> bool {
    return a.kind == b.kind && a.key == b.key && a.text == b.text &&
           std::ranges::equal(a.items, b.items, [&](const Yaml& x, const Yaml& y) { return again(x, y, again); });
  };
  const std::vector<std::string> texts{
      "a: 1 mm",
      "[1, 2 kg, {x: y}]",
      "\"a, b: {c} # d\"",
      "{law: \"30 deg*step(t, 0, 0.1 s)\", 'it''s': \"say \\\"so\\\"\"}",
      "[~, null, '~', \"\", ' x ']",
      "{a: [], b: {}, c: \"two\\nlines\", -5 mm: -5 mm, d: '- 5', e: '*x', f: a:b, g: '#1', h: back\\slash}",
      "60 deg + speed*t",
      "'null'",
      "-9.81"};
  for (const std::string& text : texts) {
    const Yaml tree = parse_yaml(text, "text");
    const std::string written = override_text(tree);
    EXPECT_TRUE(same(parse_yaml(written, "again"), tree, same)) << text << " → " << written;
  }
  EXPECT_EQ(override_text(parse_yaml("60 deg + min(speed*t, 1)", "")), "60 deg + min(speed*t, 1)")
      << "an expression stays as it is: a parameter's text is not YAML";
}

}  // namespace
}  // namespace pintle::override_test
