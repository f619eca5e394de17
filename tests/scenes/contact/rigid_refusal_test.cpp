// What rigid contacts refuse, in one line with key and remedy.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "framework/analysis/linearize/linearize.h"
#include "framework/build/build.h"
#include "framework/configuration/equilibrium.h"
#include "framework/scene/yaml/reader.h"
#include "tests/refusal.h"
#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::rigid_refusal_test {
namespace {

using pintle_scenes::disc, pintle_scenes::floor_under, pintle_scenes::number, pintle_scenes::struck;

Scene scene(const std::string& laws, double y = 0.1, const std::string& method = "auto") {
  std::string contact = struck("foot", "ball.rim", "ground.floor", laws);
  if (laws.find("normal") != std::string::npos) contact.replace(contact.find("model: impact, "), 15, "");
  return read_scene_text(floor_under() + "bodies:\n" + disc("ball") + "contacts:\n" + contact + "start: {ball: {at: [0, " + number(y) +
                             "]}}\nrun: {until: 1, method: " + method + "}\n",
                         "scene.yaml");
}
Scene bearing(const std::string& laws) {
  return read_scene_text(
      "bodies: {rod: {rigid: {mass: 1, inertia: 1}}}\njoints: {pin: {revolute: [ground, rod], clearance: {radial: 1 mm, bearing radius: 10 "
      "mm, bearing: rod, " +
          laws + "}}}\nrun: {until: 1}\n",
      "scene.yaml");
}
template <class Make>
void expect_refused(const Make& make, const std::string& place, const std::string& says) {
  pintle_test::expect_one_line(pintle_test::refusal_by<std::exception>([&] {
                                 const Scene s = make();
                                 assemble(s, build(s));
                               }),
                               place, {says});
}

TEST(BadRigid, IsRefusedInOneLineWithKeyAndRemedy) {
  struct Bad {
    std::string laws, place, says;
  };
  const std::string spring = "normal: {hertz: {stiffness: 1e9}}", place = "scene.yaml:6: contacts.foot";
  for (const Bad& bad : std::vector<Bad>{
           {spring + ", restitution: 0.5", place + ".restitution", "is for model: impact only"},
           {spring + ", restitution law: poisson", place + ".restitution law", "is for model: impact only"},
           {spring + ", tangential restitution: 0.5", place + ".tangential restitution", "is for model: impact only"},
           {"restitution law: newton", place, "add for example restitution: 0.8"},
           {"restitution: 1.5", place + ".restitution", "1"},
           {"restitution: -0.1", place + ".restitution", "0"},
           {"restitution: 0.5, restitution law: moreau", place + ".restitution law", "newton"},
           {"restitution: 0.5, friction: {ambrosio: {coefficient: 0.1}}", place + ".friction", "coulomb: {coefficient: 0.1}"},
           {"restitution: 0.5, restitution law: poisson, tangential restitution: 0.5", place + ".tangential restitution",
            "is for Newton's law"},
       }) {
    SCOPED_TRACE(bad.laws);
    expect_refused([&] { return scene(bad.laws); }, bad.place, bad.says);
  }
}

TEST(BadRigid, ClearanceIsRefusedTheSameWay) {
  const std::string place = "scene.yaml:2: joints.pin.clearance";
  expect_refused([] { return bearing("model: impact"); }, place, "add for example restitution: 0.8");
  expect_refused([] { return bearing("model: massless link, restitution: 0.5"); }, place + ".restitution", "is for model: impact only");
  expect_refused([] { return bearing("model: impact, restitution: 0.5, friction: {tanh: {coefficient: 0.1, v1: 1}}"); }, place,
                 "coulomb: {coefficient: 0.1}");
}

TEST(BadRigid, GeneralizedAlphaTakesNoImpacts) {
  expect_refused([] { return scene("restitution: 0.5", 0.1, "{generalized-alpha: {rho: 0.8}}"); }, "scene.yaml",
                 "use auto, dopri5 or moreau, or give the contacts a law with a stiffness");
}

TEST(BadRigid, AStartInOverlapSaysHowDeepAndWhatToDo) {
  expect_refused([] { return scene("restitution: 0.5", 0.09); }, "scene.yaml:6: contacts.foot",
                 "overlap by 0.01 m at the start, which is impossible for rigid bodies; move a body with `start` or `pose`");
}

TEST(BadRigid, EquilibriumAndLinearisationNeedContactsThatGiveWay) {
  const Scene s = scene("restitution: 0.5");
  const Model model = build(s);
  const Assembly start = assemble(s, model);
  const std::string place = "scene.yaml:6: contacts.foot", remedy = "instead of model: impact, give it a normal law with a stiffness";
  pintle_test::expect_one_line(pintle_test::refusal_by<std::exception>([&] { find_equilibrium(s, model, start); }), place,
                               {"an equilibrium needs compliant contacts", remedy});
  pintle_test::expect_one_line(pintle_test::refusal_by<std::exception>([&] { linearize(s, model, start.start); }), place,
                               {"a linearisation needs compliant contacts", remedy});
}

}  // namespace
}  // namespace pintle::rigid_refusal_test
