// What rigid bodies leave open is warned of, once and with its place: normal forces that share a load, and Painlevé's rod where it may as
// well part.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::undecided_contacts_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::floor_under, pintle_scenes::number, pintle_scenes::run, pintle_scenes::struck,
    pintle_scenes::Whole;

std::vector<std::string> warnings_with(const Whole& w, const std::string& words) {
  std::vector<std::string> out;
  std::ranges::copy_if(w.run.warnings, std::back_inserter(out),
                       [&](const std::string& said) { return said.find(words) != std::string::npos; });
  return out;
}
std::vector<std::string> shares(const Whole& w) { return warnings_with(w, "more are closed than the motion can tell apart"); }
std::vector<std::string> two_motions(const Whole& w) { return warnings_with(w, "can either be pressed there or part (Painlevé)"); }

// A bar that falls 1 mm onto feet 0.1 m apart and stays.
Whole bar_on(int feet, double friction, const std::string& method) {
  std::string profiles, contacts;
  for (int i = 0; i < feet; ++i) {
    const std::string k = std::to_string(i);
    profiles += (i ? ", f" : "f") + k + ": {disc: [" + number(0.1 * i - 0.05 * (feet - 1)) + ", 0], radius: 0.01}";
    contacts += struck("foot" + k, "bar.f" + k, "ground.floor",
                       "restitution: 0" + (friction > 0 ? ", friction: {coulomb: {coefficient: " + number(friction) + "}}" : ""));
  }
  return run(floor_under() + "bodies: {bar: {rigid: {mass: 1, inertia: 0.1}, profiles: {" + profiles + "}}}\ncontacts:\n" + contacts +
             "start: {bar: {at: [0, 0.011]}}\nrun: {until: 0.1, method: " + method + "}\noutput: {every: 0.01, frames: 0}\n");
}

TEST(UndecidedContacts, AThirdFootSharesALoadThatTwoWouldBear) {
  for (const char* method : {"dopri5", "{moreau: {step: 1e-3}}"})
    for (const double friction : {0.0, 0.5}) {
      SCOPED_TRACE(std::string(method) + ", friction " + number(friction));
      const Whole two = bar_on(2, friction, method), three = bar_on(3, friction, method);
      expect_sound(two);
      expect_sound(three);
      EXPECT_TRUE(shares(two).empty());
      ASSERT_EQ(shares(three).size(), 1u);
      for (const char* says : {"\"foot0\"", "\"foot1\"", "\"foot2\"", "from t = 0.01", "a law with a stiffness"})
        EXPECT_NE(shares(three).front().find(says), std::string::npos) << says << " in " << shares(three).front();
    }
}

// Where corners meet corners, two pairs of pieces stand for one force.
TEST(UndecidedContacts, AlignedBoxesAreNoSuchCase) {
  std::string bodies, contacts;
  for (int i = 0; i < 2; ++i) {
    const std::string k = std::to_string(i);
    bodies += "  b" + k + ": {rigid: {mass: 1, inertia: 1e-3}, profiles: {o: {path: [[-0.05, -0.025], [0.05, -0.025], [0.05, 0.025], " +
              "[-0.05, 0.025]], closed: true}}, pose: {at: [0, " + number(0.025 + 0.05 * i) + "]}}\n";
    contacts += struck("c" + k, "b" + k + ".o", i > 0 ? "b0.o" : "ground.floor", "restitution: 0");
  }
  const Whole w = run(floor_under() + "bodies:\n" + bodies + "contacts:\n" + contacts + "run: {until: 0.1}\n");
  expect_sound(w, 1e-9);
  EXPECT_TRUE(shares(w).empty());
}

// Painlevé's rod, steep and with μ = 2, where its spin lifts its tip: without force it parts at ω² sin 1 − g; a force, with its friction,
// presses it down harder than it pushes it up, and so can hold it as well.
Whole spinning_rod(double friction, double spin) {
  const double s = std::sin(1.0), c = std::cos(1.0);
  return run(floor_under() + "bodies: {rod: {rigid: {mass: 1, inertia: " + number(1.0 / 3) +
             "}, profiles: {tip: {path: [[1, 0], [0.9, 1 mm], [0.9, -1 mm]], closed: true}}}}\ncontacts:\n" +
             struck("tip", "rod.tip", "ground.floor", "restitution: 0, friction: {coulomb: {coefficient: " + number(friction) + "}}") +
             "start: {rod: {at: [0, " + number(s) + "], angle: -1, speed: " + number(spin) + ", velocity: [" + number(1 - spin * s) + ", " +
             number(-spin * c) + "]}}\nrun: {until: 1e-3, method: dopri5}\noutput: {every: 1e-3, frames: 0}\n");
}

TEST(UndecidedContacts, PainlevesRodMayPartOrBePressed) {
  const Whole w = spinning_rod(2, 5);
  ASSERT_EQ(two_motions(w).size(), 1u);
  for (const char* says : {"\"tip\": at t = 0 s", "a law with a stiffness, or less friction"})
    EXPECT_NE(two_motions(w).front().find(says), std::string::npos) << says << " in " << two_motions(w).front();
  for (const auto& [friction, spin] : {std::pair(0.5, 5.0), std::pair(0.5, 0.0), std::pair(1.0, 0.0)})
    EXPECT_TRUE(two_motions(spinning_rod(friction, spin)).empty()) << friction << " " << spin;
}

}  // namespace
}  // namespace pintle::undecided_contacts_test
