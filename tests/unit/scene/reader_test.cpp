#include "framework/scene/yaml/reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/scene_text.h"

namespace pintle::reader_test {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Reader, FillsBodiesAndPointsInSI) {
  const Scene scene = read_scene_text(slider_crank, "scene.yaml");
  EXPECT_EQ(scene.title, "Slider-crank");
  EXPECT_EQ(scene.gravity, (Pair{0, -9.81}));
  ASSERT_EQ(scene.bodies.size(), 2u);
  const SceneBody& crank = scene.bodies[0];
  EXPECT_EQ(crank.name, "crank");
  EXPECT_EQ(crank.mass, 0.3);
  EXPECT_EQ(crank.inertia, 1e-4);
  EXPECT_EQ(crank.points[0].at, (Pair{-0.025, 0}));
  EXPECT_DOUBLE_EQ(crank.points[1].angle, pi / 6);
  EXPECT_EQ(crank.at, (Pair{0.01, 0}));
  EXPECT_DOUBLE_EQ(crank.angle, 2 * pi / 3);
  EXPECT_EQ(scene.bodies[1].center, (Pair{0.001, 0.002}));
  EXPECT_EQ(crank.place.line, 7);
  EXPECT_EQ(crank.place.key, "bodies.crank");
}

TEST(Reader, FillsJointsWithTheirClearance) {
  const Scene scene = read_scene_text(slider_crank, "scene.yaml");
  ASSERT_EQ(scene.joints.size(), 4u);
  EXPECT_EQ(scene.joints[0].a.body, "ground");
  EXPECT_EQ(scene.joints[0].a.point, "");
  EXPECT_EQ(scene.joints[0].b.point, "O");
  EXPECT_DOUBLE_EQ(scene.joints[2].angle, pi / 2);
  EXPECT_EQ(scene.joints[3].length, 0.12);
  ASSERT_TRUE(scene.joints[1].clearance.has_value());
  const SceneClearance& gap = *scene.joints[1].clearance;
  EXPECT_EQ(gap.radial, 1e-5);
  EXPECT_EQ(gap.bearing_radius, 0.01);
  EXPECT_EQ(gap.bearing, "slider");
  EXPECT_EQ(gap.normal.law, "lankarani-nikravesh");
  EXPECT_EQ(gap.normal.restitution, 0.8);
  EXPECT_EQ(gap.normal.journal.young, 207e9);
  EXPECT_EQ(gap.normal.radii, RadiusConvention::internal);
  ASSERT_TRUE(gap.friction.has_value());
  EXPECT_EQ(gap.friction->v1, 0.01);
  EXPECT_EQ(gap.place.line, 16);
  EXPECT_EQ(gap.place.key, "joints.pin.clearance");
}

TEST(Reader, FillsTheModelOfAClearance) {
  const auto with = [](const std::string& keys) {
    std::string text = slider_crank;
    const std::string radial = "      radial: clearance\n";
    return *read_scene_text(text.replace(text.find(radial), radial.size(), radial + keys), "scene.yaml").joints[1].clearance;
  };
  EXPECT_EQ(with("").model, ClearanceModel::contact);
  EXPECT_EQ(with("      model: contact\n").model, ClearanceModel::contact);
  EXPECT_EQ(with("      model: massless link\n").model, ClearanceModel::massless_link);
  const SceneClearance spring = with("      model: spring-damper\n      stiffness: 3 kN/mm\n      damping: 20 N s/m\n");
  EXPECT_EQ(spring.model, ClearanceModel::spring_damper);
  EXPECT_EQ(*spring.stiffness, 3e6);
  EXPECT_EQ(*spring.damping, 20);
  EXPECT_EQ(spring.normal.restitution, 0.8);  // stays
}

TEST(Reader, AsksForNoLawThatAClearanceDoesNotUse) {
  const auto with = [](const std::string& keys) {
    return read_scene_text(
        "bodies: {bob: {rigid: {mass: 1, inertia: 1}}}\n"
        "joints: {pin: {revolute: [ground, bob], clearance: {radial: 1 mm, bearing radius: 1 cm, bearing: bob, " +
            keys + "}}}\n",
        "scene.yaml");
  };
  const Scene link = with("model: massless link");
  EXPECT_EQ(link.joints[0].clearance->normal.bearing.young, 0);
  EXPECT_EQ(read_scene_text(link.filled_in, "again.yaml").filled_in, link.filled_in);
  const Scene spring = with("model: spring-damper, stiffness: 1 kN/mm, damping: 0");
  EXPECT_EQ(*spring.joints[0].clearance->damping, 0);
  EXPECT_EQ(read_scene_text(spring.filled_in, "again.yaml").filled_in, spring.filled_in);
}

TEST(Reader, FillsDriversAndLoads) {
  const Scene scene = read_scene_text(slider_crank, "scene.yaml");
  EXPECT_DOUBLE_EQ(scene.drivers[0].law.at(0.1).value, 15);
  EXPECT_DOUBLE_EQ(scene.drivers[0].law.at(0.1).rate, 150);
  EXPECT_EQ(scene.drivers[0].law.text, "speed*t");
  ASSERT_EQ(scene.loads.size(), 4u);
  const auto& push = std::get<SceneForce>(scene.loads[0].what);
  EXPECT_TRUE(push.follows);
  EXPECT_TRUE(push.x.constant);
  EXPECT_DOUBLE_EQ(push.y.at(0.1).value, 5 * std::sin(1.0));
  const auto& brake = std::get<SceneTorque>(scene.loads[1].what);
  EXPECT_EQ(brake.law.at(0).value, -2);
  EXPECT_EQ(brake.a.body, "ground");
  EXPECT_EQ(brake.b.body, "crank");
  EXPECT_DOUBLE_EQ(std::get<SceneSpring>(scene.loads[2].what).stiffness, 3000);
  EXPECT_DOUBLE_EQ(std::get<SceneTorsionSpring>(scene.loads[3].what).free_angle, pi / 18);
}

TEST(Reader, FillsStartRunAndOutput) {
  const Scene scene = read_scene_text(slider_crank, "scene.yaml");
  ASSERT_EQ(scene.start_bodies.size(), 1u);
  EXPECT_EQ(scene.start_bodies[0].speed, 150);
  EXPECT_EQ(scene.start_bodies[0].x, 1e-3);
  EXPECT_FALSE(scene.start_bodies[0].y.has_value());
  ASSERT_EQ(scene.start_journals.size(), 1u);
  EXPECT_EQ(scene.start_journals[0].eccentricity, (Pair{1e-6, 0}));
  EXPECT_EQ(scene.run.until, 0.05);
  EXPECT_EQ(scene.run.method, "rkf45");
  EXPECT_EQ(scene.run.constraints, "projection");
  EXPECT_EQ(scene.run.onset_cut, 1e-8);
  EXPECT_EQ(scene.run.max_step, 1e-3);
  EXPECT_EQ(scene.output.every, 1e-5);
  EXPECT_EQ(scene.output.frames, 200);
}

TEST(Reader, FillsWhatIsDrawnAndRecorded) {
  const Scene plain = read_scene_text(slider_crank, "scene.yaml");
  EXPECT_EQ(plain.output.deformation, 1);
  EXPECT_TRUE(plain.output.points.empty());
  const auto output = [](const std::string& keys) {
    const Scene scene = read_scene_text(with("frames: 200", keys), "scene.yaml");
    const Scene again = read_scene_text(scene.filled_in, "again.json");
    EXPECT_EQ(again.filled_in, scene.filled_in);
    return again.output;
  };
  EXPECT_EQ(output("deformation: 100").deformation, 100);
  EXPECT_EQ(output("deformation: auto").deformation, 0);
  const auto points = output("points: [crank.A, ground, slider]").points;
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[0].body + "." + points[0].point, "crank.A");
  EXPECT_EQ(points[1].body + points[2].body, "groundslider");
  EXPECT_TRUE(points[1].point.empty() && points[2].point.empty());
}

TEST(Reader, FilledInSceneReadsBackToTheSameScene) {
  const Scene scene = read_scene_text(slider_crank, "scene.yaml");
  const Scene again = read_scene_text(scene.filled_in, "again.json");
  EXPECT_EQ(again.filled_in, scene.filled_in);
  EXPECT_DOUBLE_EQ(again.drivers[0].law.at(0.1).rate, 150);
}

TEST(Reader, DeletingTheClearanceLeavesAnIdealJoint) {
  std::string text = slider_crank;
  const std::size_t begin = text.find("    clearance:\n"), end = text.find("  guide:");
  text.erase(begin, end - begin);
  text.erase(text.find("  pin: {ecc"), text.find("run:") - text.find("  pin: {ecc"));
  EXPECT_FALSE(read_scene_text(text, "scene.yaml").joints[1].clearance.has_value());
}

TEST(Reader, OverrideReplacesAParameterEverywhere) {
  const Scene scene = read_scene_text(slider_crank, "scene.yaml", {{"clearance", "0.1mm"}});
  EXPECT_EQ(scene.joints[1].clearance->radial, 1e-4);
  EXPECT_EQ(scene.parameters[0].value, 1e-4);
  const Scene bare = read_scene_text(slider_crank, "scene.yaml", {{"clearance", "2e-4"}});
  EXPECT_EQ(bare.joints[1].clearance->radial, 2e-4);
}

TEST(SceneFile, ReadsAsTheSameText) {
  const Folder folder;
  const Scene scene = read_scene(folder.write("s.yaml", slider_crank));
  EXPECT_EQ(scene.bodies.size(), 2u);
  EXPECT_EQ(scene.filled_in, read_scene_text(slider_crank, "scene.yaml").filled_in);
}

TEST(SceneFile, FindsItsTableBesideIt) {
  const Folder folder;
  folder.write("motion.csv", "t, angle\n0, 0\n25, 90\n60, 180\n");
  const Scene scene = read_scene(folder.write("s.yaml", with("law: speed*t", "law: {table: motion.csv, time unit: ms, value unit: deg}")));
  EXPECT_DOUBLE_EQ(scene.drivers[0].law.at(0.025).value, pi / 2);
  const Scene again = read_scene(folder.write("again.json", scene.filled_in));
  EXPECT_DOUBLE_EQ(again.drivers[0].law.at(0.025).value, pi / 2);
}

}  // namespace
}  // namespace pintle::reader_test
