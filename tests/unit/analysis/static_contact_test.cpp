// The static case of bodies that touch, from its words to its files.

#include "framework/analysis/static_case/contact_case.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "framework/scene/yaml/reader.h"
#include "tests/refusal.h"

namespace pintle {

namespace {

std::string pin_in_eye(const std::string& statics) {
  const std::string steel = "thickness: 10 mm, plane: strain, young: 207 GPa, poisson: 0.3, density: 7800 kg/m^3, element: quadrilateral8";
  return "bodies:\n"
         "  pin:\n    plate: {link: {disc: {diameter: 19.8 mm, bore: 4 mm}}, size: 1 mm, " +
         steel +
         "}\n"
         "    points: {middle: {hole: bore, coupling: rigid}}\n    supports: {middle: [x, rotation]}\n"
         "  eye:\n    plate: {link: {disc: {diameter: 40 mm, bore: 20 mm}}, size: 1 mm, " +
         steel +
         "}\n"
         "    supports: {outline: fixed}\n"
         "static:\n  body: pin\n" +
         statics;
}
const std::string pressed =
    "  contacts: {pin in eye: {between: [pin.outline, eye.bore]}}\n  at: {pin: [0, -0.1 mm]}\n"
    "  loads: {push: {force: [0, -20 kN], at: middle}}\n";

struct Solved {
  Scene scene;
  std::vector<ElasticBody> made;
  std::vector<const ElasticBody*> bodies;
  ContactCase answer;
  explicit Solved(const std::string& text) : scene(read_scene_text(text, "pin.yaml")) {
    for (const std::string& name : bodies_of(*scene.statics)) made.push_back(elastic_body(scene, elastic_of(scene, name)));
    for (const ElasticBody& e : made) bodies.push_back(&e);
    answer = solve_contact_case(scene, bodies);
  }
};

}  // namespace

TEST(StaticContact, APinPressesItsEye) {
  const Solved s(pin_in_eye(pressed));
  ASSERT_EQ(s.answer.contacts.size(), 1u);
  const ContactReport& c = s.answer.contacts[0];
  EXPECT_NEAR(c.force.y(), 20e3, 1e-6);
  EXPECT_NEAR(c.force.x(), 0, 0.01 * 20e3);  // eccentricity over radius: the mesh is not the same on both sides
  EXPECT_NEAR(s.answer.bodies[1].reactions[0].resultant.y(), 20e3, 1e-5);
  // Hertz's half-width is 26 degrees; the contact lies on both sides of straight down, within a side of the mesh.
  EXPECT_NEAR((c.from + c.to) / 2, -M_PI / 2, 0.05);
  EXPECT_NEAR((c.to - c.from) / 2, 0.46, 0.12);
  const nlohmann::json out = nlohmann::json::parse(contact_json(s.scene, s.bodies, s.answer));
  EXPECT_NEAR(out["contacts"]["pin in eye"]["force on the first body [N, N]"][1].get<double>(), 20e3, 1e-3);
  EXPECT_LT(out["bodies"]["pin"]["residual"].get<double>(), 1e-9);
}

TEST(StaticContact, TheFirstOrTheSecondSurfaceMayBearThePressure) {
  const Solved one(pin_in_eye(pressed));
  std::string turned = pressed;
  turned.replace(turned.find("[pin.outline, eye.bore]"), 23, "[eye.bore, pin.outline]");
  const Solved other(pin_in_eye(turned));
  EXPECT_NEAR(other.answer.contacts[0].force.y(), -20e3, 1e-6);
  const double depth = one.answer.bodies[0].ports[0].u.y();
  EXPECT_NEAR(other.answer.bodies[0].ports[0].u.y(), depth, 0.01 * std::abs(depth));
  EXPECT_NEAR((other.answer.contacts[0].from + other.answer.contacts[0].to) / 2, -M_PI / 2, 0.05);
}

TEST(StaticContact, SaysWhatIsWrong) {
  const auto refused = [](const std::string& statics, const std::string& words) {
    pintle_test::expect_refused([&] { Solved{pin_in_eye(statics)}; }, {words});
  };
  const std::string loads = "  loads: {push: {force: [0, -1 kN], at: middle}}\n";
  refused("  contacts: {c: {between: [pin.outline, eye]}}\n" + loads, "body.group");
  refused("  contacts: {c: {between: [pin.outline, pin.bore]}}\n" + loads, "same body");
  refused("  contacts: {c: {between: [pin.outline, eye.boer]}}\n" + loads, "bore");
  refused("  contacts: {c: {between: [pin.outline, rye.bore]}}\n" + loads, "eye");
  refused("  contacts: {c: {between: [pin.bore, eye.bore]}}\n" + loads, "coupling: average");
  refused("  at: {eye: [0, 0]}\n" + loads, "is not part of the case");
  refused("  loads: {push: {pressure: 1 MPa, on: bore, body: eye}}\n", "has no contact in it");
}

}  // namespace pintle
