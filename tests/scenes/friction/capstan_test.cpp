// Chains round drums, and brakes: what friction makes of a tension, in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::capstan_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::number, pintle_scenes::run, pintle_scenes::Whole;

constexpr double R = 0.2, pull = 50, pi = std::numbers::pi;
const std::string rigid = "model: impact, restitution: 0";

std::string pair(double x, double y) { return "[" + number(x) + ", " + number(y) + "]"; }

/// n pins on a drum of radius R, links between them, a link to an anchor before and one that is pulled behind; at each pin the chain turns
/// by φ/n. The drum slides under it towards the pulled end. No gravity.
std::string chain(int n, double wrap, double mu, const std::string& laws, double until) {
  const double alpha = wrap / n, length = 2 * R * std::sin(alpha / 2);
  const auto angle_of = [&](int pin) { return pi / 2 + wrap / 2 - (pin - 0.5) * alpha; };
  const auto place = [&](int pin) { return pair(R * std::cos(angle_of(pin)), R * std::sin(angle_of(pin))); };
  const auto along = [&](int link) { return angle_of(link) - alpha / 2 - pi / 2; };
  std::string bodies, joints, contacts, start;
  for (int i = 0; i <= n; ++i) {
    const std::string link = "link" + number(i), end = ", points: {end: " + pair(length, 0) + "}";
    const std::string tip = i == 0 ? "" : ", profiles: {tip: {path: [[0, 0], [5 mm, 5 mm], [-5 mm, 5 mm]], closed: true}}";
    bodies += "  " + link + ": {rigid: {mass: 0.1, inertia: 1e-4, center: " + pair(length / 2, 0) + "}" + end + tip + "}\n";
    joints += "  pin" + number(i) + ": {revolute: [" + (i == 0 ? "ground.anchor" : "link" + number(i - 1) + ".end") + ", " + link + "]}\n";
    start += "  " + link + ": {at: " + place(i) + ", angle: " + number(along(i)) + "}\n";
    if (i > 0)
      contacts += "  c" + number(i) + ": {between: [" + link + ".tip, drum.rim], " + laws +
                  ", friction: {coulomb: {coefficient: " + number(mu) + "}}}\n";
  }
  return "ground: {points: {anchor: " + place(0) +
         "}}\nbodies:\n  drum: {rigid: {mass: 5, inertia: 0.1}, profiles: {rim: {disc: [0, 0], radius: " + number(R) + "}}}\n" + bodies +
         "joints:\n  axle: {revolute: [ground, drum]}\n" + joints +
         "drivers: {motor: {angle: [ground, drum], law: -10 rad/s*t}}\nforces: {pull: {force: " +
         pair(pull * std::cos(along(n)), pull * std::sin(along(n))) + ", at: link" + number(n) + ".end}}\ncontacts:\n" + contacts +
         "start:\n" + start + "run: {until: " + number(until) + ", tolerance: 1e-9}\noutput: {every: " + number(until / 10) +
         ", frames: 0}\n";
}
double anchored(const Whole& w) { return std::hypot(w.last("pin0.fx on link0 [N]"), w.last("pin0.fy on link0 [N]")) / pull; }
/// (T' + T) sin α/2 = N and (T' − T) cos α/2 = μ N at each pin.
double ratio(int n, double wrap, double mu) {
  const double t = mu * std::tan(wrap / n / 2);
  return std::pow((1 + t) / (1 - t), n);
}

TEST(Capstan, AChainOfRigidContactsMultipliesItsTensionPinByPin) {
  for (const double mu : {0.1, 0.4})
    for (const double wrap : {pi / 2, pi})
      for (const int n : {2, 5, 16}) {
        SCOPED_TRACE(number(mu) + ", " + number(wrap) + ", " + number(n));
        const Whole w = run(chain(n, wrap, mu, rigid, 0.01));
        ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
        EXPECT_NEAR(anchored(w) / ratio(n, wrap, mu), 1, 1e-11);
        for (int i = 1; i <= n; ++i) {  // from the anchor on
          const double behind = pull * std::pow(ratio(n, wrap, mu), 1 - static_cast<double>(i) / n), t = mu * std::tan(wrap / n / 2);
          const double N = behind * (1 + (1 + t) / (1 - t)) * std::sin(wrap / n / 2);
          EXPECT_NEAR(w.last("c" + number(i) + ".normal [N]"), N, 1e-10 * pull) << i;
        }
      }
}
// ln of the ratio is μφ + φ³ μ (1 + μ²)/12n² + …
TEST(Capstan, ManyPinsTendToABeltBySecondOrder) {
  const double mu = 0.3, wrap = pi;
  const auto off = [&](int n) { return std::log(anchored(run(chain(n, wrap, mu, rigid, 0.01)))) - mu * wrap; };
  const double first = wrap * wrap * wrap * mu * (1 + mu * mu) / 12;
  for (const int n : {8, 16, 32}) EXPECT_NEAR(off(n) * n * n / first, 1, std::pow(wrap / n, 2)) << n;
}
// With a stiffness the pins sink in by N/k, which turns the links by as much of their length.
TEST(Capstan, AChainOfSpringyContactsComesToTheSame) {
  const double mu = 0.3, wrap = pi / 2;
  constexpr int n = 4;
  double before = 1;
  for (const double k : {1e5, 1e6, 1e7}) {
    const Whole w = run(
        chain(n, wrap, mu, "normal: {spring-damper: {stiffness: " + number(k) + ", damping: " + number(std::sqrt(0.4 * k)) + "}}", 0.5));
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    const double off = std::abs(anchored(w) / ratio(n, wrap, mu) - 1), turned = pull * wrap / k / (2 * R * std::sin(wrap / n / 2));
    EXPECT_LT(off, turned);
    EXPECT_LT(off, before / 5);
    before = off;
  }
}

// ---- a shoe on a lever: the friction that turns with its hinge presses it on, N (a ∓ μ h) = F l --------------

TEST(Brake, AShoePressesItselfOnOrLiftsItselfOff) {
  const double a = 0.3, l = 0.6, F = 200, drum = 0.15;
  for (const std::string& laws : {rigid, std::string("normal: {spring-damper: {stiffness: 1e8, damping: 1e4}}")})
    for (const double mu : {0.2, 0.5})
      for (const double h : {0.1, 0.4})
        for (const double speed : {60.0, -60.0}) {
          SCOPED_TRACE(laws + number(mu) + ", " + number(h) + ", " + number(speed));
          const double N = F * l / (a - (speed > 0 ? 1 : -1) * mu * h);
          const Whole w = run("ground: {points: {P: " + pair(-a, drum + h) +
                              "}}\nbodies:\n  drum: {rigid: {mass: 8, inertia: 0.5}, profiles: {rim: {disc: [0, 0], "
                              "radius: 0.15}}}\n  lever: {rigid: {mass: 1, inertia: 0.03}, points: {pivot: " +
                              pair(-a, h) + ", end: " + pair(l - a, 0) + "}, profiles: {shoe: {path: [[-5 cm, 0], [5 cm, 0]]}}}\n" +
                              "joints: {axle: {revolute: [ground, drum]}, hinge: {revolute: [ground.P, lever.pivot]}}\n"
                              "forces: {hand: {force: [0, " +
                              number(-F) + "], at: lever.end}}\ncontacts: {brake: {between: [lever.shoe, drum.rim], " + laws +
                              ", friction: {coulomb: {coefficient: " + number(mu) + "}}}}\nstart: {drum: {speed: " + number(speed) +
                              "}, lever: {angle: 0}}\nrun: {until: 0.1, tolerance: 1e-9}\noutput: {every: 10 ms, frames: 0}\n");
          ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
          const double sunk = laws == rigid ? 0 : N / 1e8;  // which turns the lever by sunk/a
          EXPECT_NEAR(w.last("brake.normal [N]") / N, 1, 1e-11 + 10 * sunk / a);
          const double slower = mu * N * drum / 0.5, slides = std::abs(w.last("drum.speed [rad/s]"));
          if (laws == rigid) {
            EXPECT_NEAR(slides, 60 - slower * 0.1, 1e-9);
          }
        }
}

}  // namespace
}  // namespace pintle::capstan_test
