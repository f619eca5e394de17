// Cams given by points of their surfaces, against the closed forms of their followers: Norton, Cam Design and Manufacturing Handbook.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/refusal.h"
#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::cam_test {
namespace {

using Eigen::Vector2d;
using pintle_scenes::expect_sound, pintle_scenes::impacts, pintle_scenes::Method, pintle_scenes::name_of, pintle_scenes::number,
    pintle_scenes::run, pintle_scenes::struck_by, pintle_scenes::Whole;

constexpr double g = 9.81, base = 0.03, roller = 0.01, rise = 0.01, quarter = M_PI / 2;
constexpr double mass = 0.3, stiffness = 500, preload = 30;

/// Lift and its derivatives in the cam's angle: a dwell, a rise by the polynomial 3-4-5, a dwell, a return, a quarter turn each.
struct Lift {
  double s = 0, v = 0, a = 0;
};
Lift lift(double angle) {
  const double x = std::fmod(angle, 2 * M_PI) / quarter;
  const auto polynomial = [](double p) {
    return Lift{rise * p * p * p * (10 + p * (-15 + 6 * p)), rise / quarter * 30 * p * p * (1 + p * (-2 + p)),
                rise / (quarter * quarter) * 60 * p * (1 + p * (-3 + 2 * p))};
  };
  if (x < 1) return {};
  if (x < 2) return polynomial(x - 1);
  if (x < 3) return {rise};
  const Lift down = polynomial(x - 3);
  return {rise - down.s, -down.v, -down.a};
}

/// Points of the surface in the cam's axes; the follower is at the angle a quarter turn − `angle` there.
/// The pitch curve less the roller's radius along its normal.
Vector2d under_roller(double angle) {
  const Lift l = lift(angle);
  const double r = base + roller + l.s, along = std::sin(angle), across = std::cos(angle);
  const Vector2d out(along, across), around(-across, along);
  return r * out - roller * (r * out + l.v * around).normalized();
}
/// The envelope of the flat face.
Vector2d under_plate(double angle) {
  const Lift l = lift(angle);
  const Vector2d out(std::sin(angle), std::cos(angle)), around(-std::cos(angle), std::sin(angle));
  return (base + l.s) * out - l.v * around;
}
std::string spline(int n) {
  std::string out = "{spline: [";
  for (int i = 0; i < n; ++i) {
    const Vector2d p = under_roller(2 * M_PI * i / n);
    out += (i == 0 ? "[" : ", [") + number(p.x()) + ", " + number(p.y()) + "]";
  }
  return out + "], closed: true}";
}
std::string polar(int n) {
  std::string out = "{polar: [";
  for (int i = n; i >= 0; --i) {
    const double at = 2 * M_PI * i / n;
    const Vector2d p = under_plate(at);
    const double beside = std::asin(-lift(at).v / p.norm());
    out += (i == n ? "[" : ", [") + number(quarter - at + beside) + ", " + number(p.norm()) + "]";
  }
  return out + "]}";
}

constexpr double high = 0.2;  // of the spring's upper end
/// @param first  height of the follower's axes over the shaft on the dwell
std::string cam(const std::string& rim, const std::string& face, double first, const std::string& laws, double speed, double turns) {
  const double length = high - first + preload / stiffness;
  return "gravity: [0, -9.81]\nground: {points: {guide: {at: [0, 0], angle: 90 deg}, top: [0, " + number(high) +
         "]}}\nbodies:\n  cam: {rigid: {mass: 1, inertia: 1e-3}, profiles: {rim: " + rim +
         "}}\n  follower: {rigid: {mass: " + number(mass) + ", inertia: 1e-4}, profiles: {face: " + face + "}, pose: {at: [0, " +
         number(first) + "]}}\njoints: {shaft: {revolute: [ground, cam]}, slide: {prismatic: [ground.guide, follower], angle: -90 deg}}\n" +
         "drivers: {motor: {angle: [ground, cam], law: " + number(speed) + "*t}}\nforces: {spring: {spring: [ground.top, follower], " +
         "stiffness: " + number(stiffness) + ", free length: " + number(length) +
         "}}\ncontacts: {lift: {between: [cam.rim, follower.face], " + laws + "}}\nstart: {follower: {y: " + number(first) +
         "}}\nrun: {until: " + number(2 * M_PI * turns / speed) + ", tolerance: 1e-9}\noutput: {every: " + number(2 * M_PI / speed / 500) +
         ", frames: 0}\n";
}
const std::string rigid = "model: impact, restitution: 0",
                  compliant = "normal: {hunt-crossley: {restitution: 0.5, stiffness: 1e10 N/m^1.5}}",
                  disc_face = "{disc: [0, 0], radius: " + number(roller) + "}", plate = "{path: [[-0.03, 0], [0.03, 0]]}";
std::string with_roller(int points, const std::string& laws, double speed, double turns = 1) {
  return cam(spline(points), disc_face, base + roller, laws, speed, turns);
}
std::string with_plate(int points, const std::string& laws, double speed, double turns = 1) {
  return cam(polar(points), plate, base, laws, speed, turns);
}

/// The greatest differences from the closed form, in the cam's angle: of lift [m], of its derivatives [m], of the contact's place or of
/// the tangent of the pressure angle.
struct Error {
  double s = 0, v = 0, a = 0, where = 0;
};
Error error(const Whole& w, double first, double speed, bool flat) {
  const auto t = w.column("t [s]"), y = w.column("follower.y [m]"), vy = w.column("follower.vy [m/s]"),
             ay = w.column("follower.ay [m/s^2]"), fx = w.column("lift.fx on follower [N]"), fy = w.column("lift.fy on follower [N]"),
             x = w.column("lift.x [m]");
  Error out;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const Lift l = lift(speed * t[i]);
    out.s = std::max(out.s, std::abs(y[i] - first - l.s));
    out.v = std::max(out.v, std::abs(vy[i] / speed - l.v));
    out.a = std::max(out.a, std::abs(ay[i] / (speed * speed) - l.a));
    out.where = std::max(out.where, flat ? std::abs(x[i] - l.v) : std::abs(-fx[i] / fy[i] - l.v / (first + l.s)));
  }
  return out;
}

// A spline of points h of the cam's angle apart errs by 5/384 h⁴ of the fourth derivative, its first derivatives by h³/24, its second by
// h²/12 of that. The lift's is 360 rise/β⁴ = 0.59 m at most; that of the surface is not more than three times as much.
Error bound(int points) {
  const double h = 2 * M_PI / points, fourth = 3 * 360 * rise / std::pow(quarter, 4);
  return {5 * std::pow(h, 4) / 384 * fourth, std::pow(h, 3) / 24 * fourth, h * h / 12 * fourth, 0};
}

class Cam : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(All, Cam, testing::ValuesIn(struck_by), name_of);

TEST_P(Cam, LiftsARollerAsItsPitchCurveSays) {
  constexpr double speed = 30;
  Error before;
  for (const int points : {240, 360}) {
    SCOPED_TRACE(points);
    const Whole w = run(with_roller(points, rigid, speed), GetParam());
    expect_sound(w);
    const Error e = error(w, base + roller, speed, false), most = bound(points);
    EXPECT_LT(e.s, most.s + 1e-9);
    EXPECT_LT(e.v, most.v + 1e-8);
    EXPECT_LT(e.a, most.a + 1e-8);
    EXPECT_LT(e.where, most.v / base + 1e-8);  // the direction of the normal
    EXPECT_EQ(w.run.impacts.size(), 1u);       // over all spans it is the same contact
    if (points == 360) {
      EXPECT_GT(std::log(before.a / e.a) / std::log(1.5), 1.5);  // of order 2, at the places of the outputs
    }
    before = e;
  }
}

TEST(CamRun, LiftsAFlatFaceAndTouchesItBesideTheAxisByTheVelocity) {
  constexpr double speed = 30;
  const Whole w = run(with_plate(360, rigid, speed));
  expect_sound(w);
  const Error e = error(w, base, speed, true), most = bound(360);
  EXPECT_LT(e.s, most.s + 1e-9);
  EXPECT_LT(e.v, most.v + 1e-8);
  EXPECT_LT(e.a, most.a + 1e-8);
  EXPECT_LT(e.where, most.v + 1e-8);
  EXPECT_EQ(w.run.impacts.size(), 1u);
}

// Where the follower's inertia is more than spring and weight: m(g + s″ω²) + preload + k s = 0 [N].
double pressing(double angle, double speed) {
  const Lift l = lift(angle);
  return mass * (g + l.a * speed * speed) + preload + stiffness * l.s;
}
double least_pressing(double speed) {
  double out = pressing(0, speed);
  for (int i = 0; i < 20000; ++i) out = std::min(out, pressing(2 * M_PI * i / 20000, speed));
  return out;
}
double speed_of_loss() {
  double low = 10, high_speed = 1000;
  for (int i = 0; i < 60; ++i) (least_pressing((low + high_speed) / 2) > 0 ? low : high_speed) = (low + high_speed) / 2;
  return low;
}
double first_loss(double speed) {
  double angle = 0;
  while (pressing(angle, speed) > 0) angle += 1e-5;
  return angle;
}

// The acceleration is right to h²/12 of the fourth derivative, 1e-3 of its greatest: that is what the speed is known to, twice over.
TEST(CamRun, IsLeftByARollerAtTheSpeedOfTheory) {
  const double critical = speed_of_loss();
  const Whole below = run(with_roller(360, rigid, 0.998 * critical));
  expect_sound(below);
  EXPECT_EQ(below.run.impacts.size(), 1u);
  const std::vector<double> normal = below.column("lift.normal [N]");
  EXPECT_GT(*std::ranges::min_element(normal), 0);
  const Whole above = run(with_roller(360, rigid, 1.05 * critical));
  expect_sound(above);
  ASSERT_GE(above.run.impacts.size(), 2u);
  const double angle = 1.05 * critical * above.run.impacts[0].end, expected = first_loss(1.05 * critical);
  const double slope = (pressing(expected, 1.05 * critical) - pressing(expected - 1e-3, 1.05 * critical)) / 1e-3;
  EXPECT_NEAR(angle, expected, mass * bound(360).a * std::pow(1.05 * critical, 2) / std::abs(slope));
  EXPECT_GT(angle, quarter * 1.5);  // after the middle of the rise
  EXPECT_LT(angle, quarter * 2);
}

TEST(CamRun, IsLeftByAFlatFaceAtTheSpeedOfTheory) {
  const double critical = speed_of_loss();
  EXPECT_EQ(run(with_plate(360, rigid, 0.998 * critical)).run.impacts.size(), 1u);
  EXPECT_GE(run(with_plate(360, rigid, 1.002 * critical)).run.impacts.size(), 2u);
}

// A stiff contact gives way by its depth, k δ^1.5 of the normal force; what it loses on the way is booked.
TEST_P(Cam, OfAStiffContactClosesItsBooks) {
  constexpr double speed = 30;
  for (const bool flat : {false, true}) {
    SCOPED_TRACE(flat);
    const Whole w = run(flat ? with_plate(360, compliant, speed) : with_roller(360, compliant, speed), GetParam());
    expect_sound(w);
    EXPECT_LT(error(w, flat ? base : base + roller, speed, flat).s, std::pow(2 * preload / 1e10, 2.0 / 3));
    EXPECT_EQ(w.run.impacts.size(), 1u);
  }
}

TEST(CamRun, RunsBySteppersOfOtherKinds) {
  constexpr double speed = 30;
  for (const Method& method :
       {Method{"alpha", "{generalized-alpha: {rho: 0.8}}", 1e-7, 0}, Method{"moreau", "{moreau: {step: 0.05 ms}}", 1e-6, 0}}) {
    SCOPED_TRACE(method.name);
    const bool stepping = std::string(method.name) == "moreau";
    std::string text = with_roller(360, stepping ? rigid : compliant, speed);
    Scene s = read_scene_text(text.replace(text.find("tolerance: 1e-9"), 15, "method: " + method.words), "scene.yaml");
    const Whole w = run(s);
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    EXPECT_LT(error(w, base + roller, speed, false).s, stepping ? 5e-5 * speed * 0.012 + 1e-8 : 4e-6)
        << method.name;  // one step; its depth
  }
}

// ---- what is refused ----------------------------------------------------------------------------

std::string refused(const std::string& rim) {
  return pintle_test::refusal_by([&] { run(cam(rim, disc_face, base + roller, rigid, 1, 1)); });
}
void expect_words(const std::string& said, const std::string& words) { EXPECT_NE(said.find(words), std::string::npos) << said; }

TEST(CamInput, RefusesWhatIsNoCam) {
  expect_words(refused("{spline: [[0, 0], [1, 0]], closed: true}"), "has 2 points; a spline takes 3");
  expect_words(refused("{spline: [[0, 0], [1, 1], [2, 0], [2, 1], [1, 0], [0, 1]], closed: true}"), "crosses itself");
  expect_words(refused("{polar: [[0, 1], [2, 0], [4, 1]]}"), "radius 0 m; it must be above 0");
  expect_words(refused("{polar: [[0, 1], [2, 1], [1, 1]]}"), "is not greater than the one before; angles must increase");
  expect_words(refused("{polar: [[0, 1], [2, 1], [7, 1]]}"), "leave out the points beyond a turn");
  expect_words(refused("{polar: [[0 deg, 1], [120 deg, 1], [240 deg, 1], [360 deg, 1.1]]}"),
               "make them equal, or leave out the last point");
  expect_words(refused("{polar: [[0, 1], [2, 1], [4, 1]], closed: true}"), "does not belong to polar");
  expect_words(refused("{spline: {file: ../cam.csv}, closed: true}"), "scene.yaml");
  expect_words(refused("{spline: {file: cam.csv, angle unit: deg}, closed: true}"), "unknown key");
}

TEST(CamInput, AsksForAStiffness) {
  const std::string young = "normal: {hertz: {young: 2e11, poisson: 0.3}}";
  expect_words(pintle_test::refusal_by([&] { run(cam(spline(36), disc_face, base + roller, young, 1, 1)); }), "give `stiffness`");
}

}  // namespace
}  // namespace pintle::cam_test
