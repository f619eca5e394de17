// Every way to get a scene wrong, and the one line that says where and what to do.
#include <gtest/gtest.h>

#include "framework/common/nearest.h"
#include "framework/scene/joint_words.h"
#include "tests/unit/scene_text.h"

namespace pintle::bad_scene_test {
namespace {

std::vector<std::string> joint_keys() {
  std::vector<std::string> out;
  for (const JointWord& word : joint_words()) out.emplace_back(word.word);
  return out;
}

void expect_refused(const std::vector<Spoiled>& all) { expect_each_refused(all, with); }

TEST(BadScene, OverrideOfAnUnknownParameterSuggestsTheNearest) {
  expect_says(refusal_of(slider_crank, {{"clearence", "1 mm"}}), {"scene.yaml: --set clearence", "Did you mean \"clearance\"?"});
  expect_says(refusal_of(slider_crank, {{"clearance", "1 kg"}}), {"--set clearance", "a mass [kg]", "a length [m]"});
}

TEST(BadScene, MisspeltKeySuggestsTheNearest) {
  expect_refused({
      {"gravity:", "gravty:", "scene.yaml:2: gravty: ", {"Did you mean \"gravity\"?"}},
      {"mass: 0.30 kg", "mas: 0.30 kg", "scene.yaml:8: bodies.crank.rigid.mas: ", {"unknown key \"mas\"", "\"mass\""}},
      {"bearing radius", "bearing raduis", "scene.yaml:18: joints.pin.clearance.bearing raduis: ", {"Did you mean \"bearing radius\"?"}},
      {"revolute: [ground", "revolut: [ground", "scene.yaml:13: joints.main.revolut: ", {"Did you mean \"revolute\"?"}},
      {"tolerance", "zzz", "scene.yaml:34: run.zzz: ", {"Known here: until, method"}},
      {"rkf45", "rk45", "scene.yaml:34: run.method: ", {"\"rk45\"", "dopri5", "generalized-alpha", "mean"}},
      {"title:", "Title:", "scene.yaml:1: Title: ", {"Did you mean \"title\"?"}},
      {"  crank: {angle", "  krank: {angle", "scene.yaml:32: start.krank: ", {"Did you mean \"crank\"?"}},
  });
}

constexpr const char* normal_law = "      normal: {lankarani-nikravesh: {restitution: 0.8, young: 207 GPa, poisson: 0.3}}\n";

TEST(BadScene, ModelsOfAClearanceAreThree) {
  expect_refused({
      {"bearing: slider",
       "bearing: slider\n      model: masless link",
       "scene.yaml:20: joints.pin.clearance.model: ",
       {"\"masless link\"", "massless link", "spring-damper"}},
      {"bearing: slider",
       "bearing: slider\n      stiffness: 3 N",
       "scene.yaml:20: joints.pin.clearance.stiffness: ",
       {"\"3 N\" is a force [N]"}},
      {"bearing: slider", "bearing: slider\n      damping: -1", "scene.yaml:20: joints.pin.clearance.damping: ", {"negative"}},
  });
}

// The advice is such that who takes it gets on.
TEST(BadScene, ASpringDamperIsAModelOfAClearanceNotALaw) {
  const char* place = "scene.yaml:20: joints.pin.clearance.normal: ";
  const std::string advice = "model: spring-damper, stiffness: 1e6 N/m, damping: 100 N s/m";
  expect_refused({
      {normal_law, "      normal: spring-damper\n", place, {advice}},
      {normal_law, "      normal: {spring-damper: {stiffness: 1e6 N/m, damping: 100 N s/m}}\n", place, {advice}},
      {normal_law, "      normal: {spring-damper: {restitution: 0.8}}\n", place, {advice}},
  });
  std::string taken = advice;
  for (std::size_t at = 0; (at = taken.find(", ", at)) != std::string::npos;) taken.replace(at, 2, "\n      ");
  std::string text = slider_crank;
  text.replace(text.find(normal_law), std::string(normal_law).size(), "      " + taken + "\n");
  EXPECT_EQ(refusal_of(text), "accepted");
}

TEST(BadScene, MissingKeyIsNamedWithAnExample) {
  expect_refused({
      {"until: 0.05 s, ", "", "scene.yaml:34: run: ", {"until: 0.1 s"}},
      {", length: 120 mm", "", "scene.yaml:23: joints.rod: ", {"length: 120 mm"}},
      {normal_law, "", "scene.yaml:16: joints.pin.clearance: ", {"normal: {lankarani-nikravesh:"}},
      {normal_law,
       "      model: spring-damper\n      stiffness: 1 kN/mm\n",
       "scene.yaml:16: joints.pin.clearance: ",
       {"normal: {lankarani-nikravesh:", "or both stiffness and damping"}},
      {"restitution: 0.8, ", "", "scene.yaml:20: joints.pin.clearance.normal.lankarani-nikravesh: ", {"restitution: 0.8"}},
      {", young: 207 GPa", "", "scene.yaml:20: ", {"add young and poisson, or stiffness"}},
      {", free length: 50 mm", "", "scene.yaml:29: forces.coil: ", {"free length: 50 mm"}},
      {"{revolute: [ground, crank.O]}", "{}", "scene.yaml:13: joints.main: ", {"add one of " + listed(joint_keys(), "or")}},
  });
}

TEST(BadScene, WrongDimensionNamesBoth) {
  expect_refused({
      {"radial: clearance",
       "radial: 2 kg",
       "scene.yaml:17: joints.pin.clearance.radial: ",
       {"\"2 kg\" is a mass [kg]; expected a length [m]"}},
      {"[-25 mm, 0]", "[-25 s, 0]", "scene.yaml:9: bodies.crank.points.O[1]: ", {"a time [s]; expected a length [m]"}},
      {"law: speed*t", "law: 5 mm", "scene.yaml:25: drivers.motor.law: ", {"a length [m]; expected an angle [rad]"}},
      {"2*pi/3", "2*pi/3 s", "scene.yaml:10: bodies.crank.pose.angle: ", {"two ways"}},
  });
}

TEST(BadScene, ValuesOutOfRangeAreRefusedWithTheRule) {
  expect_refused({
      {"0.30 kg", "-0.30 kg", "scene.yaml:8: bodies.crank.rigid.mass: ", {"\"-0.30 kg\" must be greater than 0"}},
      {"1.0e-4}\n", "0}\n", "scene.yaml:8: bodies.crank.rigid.inertia: ", {"greater than 0"}},
      {"0.30 kg", ".nan", "scene.yaml:8: bodies.crank.rigid.mass: ", {"\".nan\""}},
      {"0.30 kg", "1e999 kg", "scene.yaml:8: bodies.crank.rigid.mass: ", {"too large"}},
      {"radial: clearance",
       "radial: 10 mm",
       "scene.yaml:17: joints.pin.clearance.radial: ",
       {"must be less than the bearing radius \"10 mm\""}},
      {"radial: clearance", "radial: 0", "scene.yaml:17: joints.pin.clearance.radial: ", {"greater than 0"}},
      {"restitution: 0.8", "restitution: 1.2", "scene.yaml:20: ", {"between 0 and 1"}},
      {"poisson: 0.3", "poisson: 0.7", "scene.yaml:20: ", {"between -1 and 0.5"}},
      {"v1: 10 mm/s", "v1: 1 mm/s", "scene.yaml:21: ", {"v0 must be less than v1"}},
      {"3 N/mm", "0 N/mm", "scene.yaml:29: forces.coil.stiffness: ", {"greater than 0"}},
      {"until: 0.05 s", "until: 0", "scene.yaml:34: run.until: ", {"greater than 0"}},
      {"tolerance: 1e-9", "tolerance: 1", "scene.yaml:34: run.tolerance: ", {"between 0 and 1"}},
      {"frames: 200", "frames: 2.5", "scene.yaml:35: output.frames: ", {"whole number"}},
      {"every: 10 us", "every: 1 s", "scene.yaml:35: output.every: ", {"longer than the run"}},
      {"length: 120 mm", "length: -1", "scene.yaml:23: joints.rod.length: ", {"greater than 0"}},
  });
}

TEST(BadScene, KeysThatDoNotBelongTogetherAreRefused) {
  expect_refused({
      {"crank.O]}", "crank.O], angle: 0}", "scene.yaml:13: joints.main.angle: ", {"does not belong to revolute but to prismatic or weld"}},
      {"crank.O]}", "crank.O], slot: [ground, crank]}", "scene.yaml:13: joints.main: ", {"revolute and slot at once"}},
      {"on: crank}", "on: crank, at: crank.A}", "scene.yaml:28: forces.brake.at: ", {"belong to torque but to force"}},
      {"pin: {ecc", "guide: {ecc", "scene.yaml:33: start.guide: ", {"has no clearance"}},
      {"x: 1 mm}", "x: 1 mm, at: [0, 0]}", "scene.yaml:32: start.crank.x: ", {"given twice"}},
      {"x: 1 mm}", "eccentricity: [0, 0]}", "scene.yaml:32: start.crank.eccentricity: ", {"is for a joint"}},
      {"bearing: slider", "bearing: ground", "scene.yaml:19: joints.pin.clearance.bearing: ", {"write crank or slider"}},
      {"poisson: 0.3}", "poisson: 0.3, stiffness: 1e9}", "scene.yaml:20: ", {"give either"}},
      {"lankarani-nikravesh", "hertz", "scene.yaml:20: ", {"leave restitution out"}},
  });
}

TEST(BadScene, ShapesOfValuesAreExplained) {
  expect_refused({
      {"[0, -9.81]", "-9.81", "scene.yaml:2: gravity: ", {"two values [x, y]"}},
      {"[0, -9.81]", "[0, -9.81, 0]", "scene.yaml:2: gravity: ", {"a list of 3", "[x, y]"}},
      {"[ground, crank.O]", "ground", "scene.yaml:13: joints.main.revolute: ", {"two points"}},
      {"crank.O]", "crank.]", "scene.yaml:13: joints.main.revolute[2]: ", {"body.point"}},
      {"0.30 kg", "", "scene.yaml:8: bodies.crank.rigid.mass: ", {"is nothing"}},
      {"follows: true", "follows: yes", "scene.yaml:27: forces.push.follows: ", {"true or false"}},
      {"  slider: {", "  ground: {", "scene.yaml:11: bodies.ground: ", {"always there"}},
      {"  slider: {", "  a.b: {", "scene.yaml:11: ", {"cannot be a name"}},
      {"onset: {cut: 1e-8 m}", "onset: later", "scene.yaml:34: run.onset: ", {"locate or {cut"}},
  });
}

TEST(BadScene, ParametersAreJudged) {
  expect_refused({
      {"clearance: 0.01", "mm: 0.01", "scene.yaml:4: parameters.mm: ", {"is a unit"}},
      {"clearance: 0.01", "t: 0.01", "scene.yaml:4: parameters.t: ", {"is the time"}},
      {"clearance: 0.01 mm", "clearance: speed*1 s", "scene.yaml:4: parameters.clearance: ", {"write speed above clearance"}},
      {"radial: clearance", "radial: clarance", "scene.yaml:17: joints.pin.clearance.radial: ", {"Did you mean \"clearance\"?"}},
  });
}

TEST(BadScene, LawsMustBeFiniteThroughoutTheRun) {
  expect_refused({
      {"law: speed*t", "law: 1/(t - 0.025)", "scene.yaml:25: drivers.motor.law: ", {"not a finite number at t = 0.025 s"}},
      {"law: speed*t", "law: sqrt(t)", "scene.yaml:25: drivers.motor.law: ", {"no finite speed and acceleration at t = 0 s"}},
  });
}

TEST(BadScene, YamlItselfIsJudged) {
  expect_refused({
      {"speed: 150 rad/s", "clearance: 2 mm", "scene.yaml:5: ", {"second time", "keep one"}},
      {"[ground, crank.O]", "[ground, crank.O", "scene.yaml:", {"not YAML", "brackets"}},
      {"  clearance: 0.01 mm", "\tclearance: 0.01 mm", "scene.yaml:", {"not YAML", "tabs"}},
      {"0.01 mm", "&c 0.01 mm", "scene.yaml:4: ", {"anchor &c", "parameters"}},
      {"0.01 mm", "!!float 0.01", "scene.yaml:4: ", {"tag"}},
      {"law: speed*t", "law: if(t<1, 0, 1)", "scene.yaml:25: ", {"in quotes"}},
      {"run:", "---\nrun:", "scene.yaml:", {"second document"}},
      {"title: Slider-crank", "title: \"\\x01\"", "scene.yaml:1: ", {"control character number 1"}},
      {"run:", "output: {points: [\"\\e\"]}\nrun:", "scene.yaml:", {"control character number 27"}},
      {"title: Slider-crank", "title: \x01", "scene.yaml:1: ", {"control character number 1;"}},
      {"0.01 mm", "0.01 mm  # gr\xfc\xdf", "scene.yaml:4: ", {"not UTF-8"}},
  });
  EXPECT_EQ(refusal_of(with("title: Slider-crank", "title: \"a\\tb\\nc\"")), "accepted");
}

// Also where the parser notices the fault only in the next line, or at the end of the text.
TEST(BadScene, WhatIsNoYamlIsNamedByItsLine) {
  expect_says(refusal_of("title: a\nbodies: {crank: {}\n"), {"scene.yaml:2: this is not YAML", "flow mapping that begins in line 2"});
  expect_says(refusal_of("title: a\nbodies: {crank: {}"), {"scene.yaml:2: this is not YAML"});
  expect_says(refusal_of("title: a\nbodies\ncrank: {}\n"), {"scene.yaml:2: this is not YAML", "':'"});
  expect_says(refusal_of("title: \"a\nbodies: {}\n"), {"scene.yaml:2: this is not YAML", "begins in line 1"});
  expect_says(refusal_of("title: a: b\n"), {"scene.yaml:1: this is not YAML"});
  std::string deep;
  for (int i = 0; i < 501; ++i) deep += "{a: ";
  expect_says(refusal_of("title: " + deep), {"scene.yaml:1: more than 500 lists and groups inside one another"});
}

TEST(BadScene, ExpressionWithCommasInBracesIsToldToUseQuotes) {
  expect_says(refusal_of(with("law: speed*t", "law: step(t, 0, 1)")), {"quotes"});
  expect_says(refusal_of(with("5 N*sin(10*t)", "5 N*step(t, 0, 1)")), {"a list of 4", "quotes"});
  EXPECT_EQ(refusal_of(with("law: speed*t", "law: \"step(t, 0, 1)\"")), "accepted");
}

TEST(BadScene, BombsAndDepthDoNotHang) {
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 40; ++i) {
    const std::string n = std::to_string(i);
    bomb.append("a").append(n).append(": &a").append(n).append(" [");
    for (int k = 0; k < 10; ++k) bomb.append(k ? ", *a" : "*a").append(std::to_string(i - 1));
    bomb += "]\n";
  }
  expect_says(refusal_of(bomb), {"scene.yaml:1:", "anchor"});
  expect_says(refusal_of(std::string(200'000, '[')), {"scene.yaml:1:"});
  expect_says(refusal_of(std::string(200'000, '{')), {"scene.yaml:1:"});
}

TEST(BadScene, PointsOfTheOutputMustBeThere) {
  const std::string place = "scene.yaml:35: output.points[2]: ";
  const std::string whole = "frames: 200";
  expect_refused({
      {whole, "points: [ground, crank.AA]", place, {"crank has no point \"AA\"", "\"A\""}},
      {whole, "points: [ground, cranc.A]", place, {"no body \"cranc\"", "\"crank\""}},
      {whole, "points: [ground, slider.A]", place, {"slider has none", "points: {A: [0, 0]}"}},
      {whole, "points: [ground, ground.A]", place, {"ground has none"}},
      {whole, "points: [crank.A, crank.A]", place, {"is listed twice"}},
      {whole, "points: crank.A", "scene.yaml:35: output.points: ", {"a list of points"}},
      {whole, "points: []", "scene.yaml:35: output.points: ", {"a list of points"}},
      {whole, "deformation: 0", "scene.yaml:35: output.deformation: ", {"greater than 0"}},
      {whole, "deformation: 2 mm", "scene.yaml:35: output.deformation: ", {"a length [m]"}},
  });
}

std::string refusal_of_file(const fs::path& file) {
  return refusal_by([&] { read_scene(file); });
}

TEST(BadFile, ThatIsNoSceneIsRefusedAtOnce) {
  const Folder folder;
  expect_says(refusal_of_file(folder.write("empty.yaml", "")), {"empty.yaml: is empty", "docs"});
  expect_says(refusal_of_file(folder.write("notes.yaml", "# nothing\n---\n")), {"is empty"});
  expect_says(refusal_of_file(folder.path), {"is a directory"});
  expect_says(refusal_of_file(folder.path / "none.yaml"), {"none.yaml: there is no such file"});
  expect_says(refusal_of_file(folder.write("bin.yaml", std::string("a: 1\nb\0c", 8))), {"bin.yaml:2: is not text"});
  expect_says(refusal_of_file(folder.write("latin.yaml", "title: caf\xe9\n")), {":1: is not text"});
  expect_says(refusal_of_file("/dev/zero"), {"not an ordinary file"});
  const fs::path big = folder.write("big.yaml", "title: big\n");
  fs::resize_file(big, 500u << 20);  // sparse
  expect_says(refusal_of_file(big), {"has 500 MB", "at most 100 MB"});
}

TEST(BadFile, TableIsJudgedAgainstTheRun) {
  const Folder folder;
  folder.write("short.csv", "0 0\n0.01 1\n0.02 2\n");
  folder.write("nan.csv", "0 0\n0.01 nan\n");
  const auto with_law = [&](const std::string& law) {
    return refusal_of_file(folder.write("s.yaml", with("law: speed*t", "law: " + law)));
  };
  expect_says(with_law("{table: short.csv}"), {"s.yaml:25: drivers.motor.law", "0.02 s", "0.05 s", "shorten run.until"});
  expect_says(with_law("{table: nan.csv}"), {"nan.csv:2: drivers.motor.law", "not finite"});
  expect_says(with_law("{table: none.csv}"), {"none.csv", "drivers.motor.law", "no such file"});
  expect_says(with_law("{table: short.csv, interpolation: linear}"), {"drivers.motor.law.interpolation", "write spline"});
  expect_says(with_law("{table: short.csv, time unit: mm}"), {"time unit", "a length [m]"});
}

}  // namespace
}  // namespace pintle::bad_scene_test
