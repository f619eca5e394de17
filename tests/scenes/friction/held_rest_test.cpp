// What rests, held by friction or on a rigid contact, is pushed by a force that is nothing at the start and at the end of the run: then
// nothing but the law of the force says that a step may not be as long as the run.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle_scenes::held_rest_test {
namespace {

constexpr double pi = M_PI, g = 9.81, mu = 0.5;
constexpr double little = 1e-9;  // [J]

/// Of 1 kg under A sin(πt + b) less a force c: where it is let go, and its speed and way from there, as long as it does not stop.
struct Pushed {
  double A, b, c;
  double begin() const { return (std::asin(c / A) - b) / pi; }
  double speed(double t) const { return A / pi * (std::cos(pi * begin() + b) - std::cos(pi * t + b)) - c * (t - begin()); }
  double way(double t) const {
    const double s = t - begin();
    return A / pi * (std::cos(pi * begin() + b) * s - (std::sin(pi * t + b) - std::sin(pi * begin() + b)) / pi) - c * s * s / 2;
  }
  /// The way to where it stops, before t.
  double way_to_stop(double t) const {
    double low = 1 - 2 * b / pi - begin(), high = t;  // sin comes down to c / A there: from then on it slows
    for (int i = 0; i < 100; ++i) (speed((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
    return way(low);
  }
  std::string law() const { return "\"" + number(A) + "*sin(pi*t + " + number(b) + ")\""; }
};

const std::vector<Method> of_rigid_contacts{{"dopri5", "dopri5", 1e-10, 1e-7},
                                            {"rkf45", "rkf45", 1e-10, 1e-7},
                                            {"verner87", "verner87", 1e-10, 1e-7},
                                            {"auto", "auto", 1e-10, 1e-7}};
const std::vector<Method> of_joints = [] {
  std::vector<Method> out = of_rigid_contacts;
  out.push_back({"alpha", "generalized-alpha", 1e-8, 1e-5});
  return out;
}();

class HeldByAJoint : public testing::TestWithParam<Method> {
 protected:
  double way_of(const Pushed& push) const {
    const Whole w =
        run("gravity: [0, " + number(-g) +
                "]\nbodies: {drawer: {rigid: {mass: 1, inertia: 1e-3}}}\njoints: {guide: {prismatic: [ground, drawer], friction: "
                "{coulomb: {coefficient: " +
                number(mu) + "}, length: 0.1}}}\nforces: {push: {force: [" + push.law() + ", 0], at: drawer}}\n" + run_for(1, 0.1),
            GetParam());
    expect_sound(w, little);
    return w.last("drawer.x [m]");
  }
};

TEST_P(HeldByAJoint, ADrawerThatIsPushedOnceGivesWay) {
  const Pushed push{10, 0, mu * g};
  EXPECT_NEAR(way_of(push), push.way(1), GetParam().near * push.way(1));
}

// By one part in a hundred, and in a thousand, more than what holds it, at no simple part of the run.
TEST_P(HeldByAJoint, ADrawerThatIsPushedHardlyMoreThanItHoldsGivesWay) {
  const bool fine = std::string(GetParam().name) != "alpha";  // which knows forces at the ends of its steps alone
  for (const double more : fine ? std::vector{1e-2, 1e-3} : std::vector{2e-2}) {
    const Pushed push{mu * g * (1 + more), 0.3, mu * g};
    const double way = push.way_to_stop(1);
    EXPECT_NEAR(way_of(push), way, (fine ? 1e-3 : 0.1) * way) << more;
  }
}

TEST_P(HeldByAJoint, ADrawerThatIsPushedLessThanItHoldsStays) { EXPECT_NEAR(way_of({mu * g * (1 - 1e-3), 0.3, 1}), 0, 1e-9); }

INSTANTIATE_TEST_SUITE_P(Methods, HeldByAJoint, testing::ValuesIn(of_joints), name_of);

class HeldByAFloor : public testing::TestWithParam<Method> {};

TEST_P(HeldByAFloor, ADiscThatIsPulledUpOnceLifts) {
  const Pushed pull{20, 0, g};
  const Whole w =
      run(floor_under() + "bodies:\n" + disc("disc") + "contacts:\n" + struck("rest", "disc.rim", "ground.floor", "restitution: 0") +
              "forces: {pull: {force: [0, " + pull.law() + "], at: disc}}\nstart: {disc: {at: [0, 0.1]}}\n" + run_for(1, 0.1),
          GetParam());
  expect_sound(w, little);
  EXPECT_NEAR(w.last("disc.y [m]") - 0.1, pull.way(1), GetParam().near * pull.way(1));
}

// It touches and nothing presses it: any pull lifts it. Of 1 kg under sin(2πt): ∫∫ is t/2π − sin(2πt)/4π².
TEST_P(HeldByAFloor, ADiscThatNothingPressesIsLiftedByAnyPull) {
  const Whole w = run("ground: {profiles: {floor: {path: [[-50, 0], [50, 0]], material: right}}}\nbodies:\n" + disc("disc") +
                          "contacts:\n" + struck("rest", "disc.rim", "ground.floor", "restitution: 0") +
                          "forces: {pull: {force: [0, \"sin(2*pi*t)\"], at: disc}}\nstart: {disc: {at: [0, 0.1]}}\n" + run_for(1, 0.1),
                      GetParam());
  expect_sound(w, little);
  EXPECT_NEAR(w.last("disc.y [m]") - 0.1, 1 / (2 * pi), 1e-7);
}

TEST_P(HeldByAFloor, ABoxThatIsPushedOnceSlides) {
  const Pushed push{10, 0, mu * g};
  const Whole w =
      run(floor_under() +
              "bodies: {box: {rigid: {mass: 1, inertia: 0.1}, profiles: {o: {path: [[-1, -0.01], [1, -0.01], [1, 0.01], [-1, 0.01]], "
              "closed: true}}}}\ncontacts:\n" +
              struck("rest", "box.o", "ground.floor", "restitution: 0, friction: {coulomb: {coefficient: " + number(mu) + "}}") +
              "forces: {push: {force: [" + push.law() + ", 0], at: box}}\nstart: {box: {at: [0, 0.01]}}\n" + run_for(1, 0.1),
          GetParam());
  expect_sound(w, little);
  EXPECT_NEAR(w.last("box.x [m]"), push.way(1), GetParam().near * push.way(1));
}

INSTANTIATE_TEST_SUITE_P(Methods, HeldByAFloor, testing::ValuesIn(of_rigid_contacts), name_of);

}  // namespace
}  // namespace pintle_scenes::held_rest_test
