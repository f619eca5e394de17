// Bodies that press in a clearance joint with a massless boundary, against closed forms of a uniform bar and beam.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>

#include "framework/analysis/linearize/linearize.h"
#include "framework/configuration/equilibrium.h"
#include "tests/scenes/flexible/unit_beam.h"

namespace pintle::massless_boundary_test {
namespace {

using namespace unit_beam_scenes;

// A bar of ρA = L = 1, EA = 1e4 and EI = 1 whose end B is the journal of a bearing on the ground, 0.01 wide, of stiffness 3e4.
constexpr double EA = 1e4, stiffness = 3e4, clearance = 0.01;
std::string pair(double x, double y) {
  std::ostringstream out;
  out.precision(17);
  out << "[" << x << ", " << y << "]";
  return out.str();
}
std::string bar(const std::string& modes, const std::string& rest, const std::string& more = "", double turned = 0) {
  return unit_beam("{" + modes + "}",
                   "ground: {points: {W: " + pair(std::cos(turned), std::sin(turned)) +
                       "}}\njoints: {end: {revolute: [beam.B, ground.W], clearance: {radial: 0.01, bearing radius: 0.1, bearing: ground, "
                       "normal: {hertz: {stiffness: 3e4, exponent: 1}}" +
                       more + "}}}\n" + rest,
                   EA);
}
const std::string massless = "boundary: massless, frame: mean axes, count: 4";  // four of bending, none of stretch

Eigen::Matrix2d flexibility(const std::string& modes, const std::string& rest = "") {
  const Model model = build(scene_of(bar(modes, rest)));
  return model.system.contacts[0].massless.value().a;
}

// Free of inertia, a force at the end of a free bar stretches it by L/3EA and bends it by L³/105EI there; a bending mode β has 4/β⁴ of it.
// The squares of the frequencies of 20 cubic elements are high by (βh)⁴/720, those of their ends' displacements wrong by no more; the mean
// stretch of linear elements is wrong by the share h².
TEST(MasslessBoundary, IsWhatTheModesLeaveOut) {
  constexpr std::array beta{4.730040745, 7.853204624, 10.99560784, 14.13716549};
  constexpr double h = 0.05;
  double left = 1.0 / 105, error = 0;
  for (const double b : beta) left -= 4 / std::pow(b, 4), error += 2 * 4 * std::pow(h, 4) / 720;
  for (const char* frame : {"mean axes", "chord", "tangent"}) {
    const Eigen::Matrix2d G = flexibility("boundary: massless, frame: " + std::string(frame) + ", free: {count: 4}");
    EXPECT_NEAR(G(0, 0), 1 / (3 * EA), h * h / (3 * EA)) << frame;
    EXPECT_NEAR(G(0, 1), 0, 1e-12) << frame;
  }
  const Eigen::Matrix2d G = flexibility(massless);
  EXPECT_NEAR(G(0, 0), 1 / (3 * EA), h * h / (3 * EA));
  EXPECT_NEAR(G(1, 1), left, error);
  // Held at A the bar is a cantilever: L/EA and L³/3EI. A force there makes A a point in use.
  const Eigen::Matrix2d held =
      flexibility("boundary: massless, craig-bampton: {count: 2}", "forces: {none: {force: [0, 0], at: beam.A}}\n");
  EXPECT_NEAR(held(0, 0), 1 / EA, 1e-9 / EA);
  EXPECT_NEAR(held(1, 1), 1.0 / 3 - 4 / std::pow(1.875104069, 4) - 4 / std::pow(4.694091133, 4), 2 * 8 * std::pow(h, 4) / 720);
  EXPECT_LT(flexibility("boundary: massless, frame: mean axes, keep: all").norm(), 1e-12);
}

// Half a period of the mass 1 on the spring of the contact and the bar, one behind the other; turned, and by a scheme of either kind.
TEST(MasslessBoundary, ABarBouncesOffTwoSpringsInSeries) {
  const double G = flexibility(massless)(0, 0), k = 1 / (1 / stiffness + G), v = 0.1;
  for (const std::string& method : {std::string("dopri5, tolerance: 1e-11"), std::string("generalized-alpha, tolerance: 1e-8")}) {
    const double near = method[0] == 'd' ? 1e-7 : 1e-3, turned = method[0] == 'd' ? 0.7 : 0;
    const std::string start = "start: {beam: {angle: " + std::to_string(turned) +
                              ", speed: 0}, end: {speed: " + pair(v * std::cos(turned), v * std::sin(turned)) + "}}\n";
    const Ran r = ran(bar(massless, start + "run: {until: 0.3, method: " + method + "}\n", "", turned));
    ASSERT_EQ(r.run.status, Status::finished) << r.run.reason;
    ASSERT_EQ(r.run.impacts.size(), 1U);
    const Impact& impact = r.run.impacts[0];
    EXPECT_NEAR(impact.end - impact.begin, pi / std::sqrt(k), 2 * near * pi / std::sqrt(k));
    EXPECT_NEAR(impact.peak_force, v * std::sqrt(k), 2 * near * v * std::sqrt(k));
    EXPECT_NEAR(impact.separation, v, 2 * near * v);
    EXPECT_LT(std::abs(r.run.unexplained), near * v * v);
  }
}

// Hanging at its end, its mass centre is lower by its weight 1 over the contact's stiffness and by the stretch L/3EA, and bobs on both.
TEST(MasslessBoundary, ABarHangsAndBobs) {
  const double G = flexibility(massless)(0, 0), weight = 1, soft = 1 / stiffness + G;
  const Scene scene = scene_of(bar(massless, "gravity: [-1, 0]\nrun: {until: 1}\n"));
  const Model model = build(scene);
  const Equilibrium rest = find_equilibrium(scene, model, assemble(scene, model));
  ASSERT_TRUE(rest.found) << rest.reason;
  EXPECT_NEAR(rest.state.y[0], 0.5 - clearance - weight * soft, 1e-10);
  const Linearization lin = linearize(scene, model, rest.state, Laws::hold);
  const double bobs = 1 / std::sqrt(soft);
  double nearest = 0;
  for (const LinearMode& m : lin.modes)
    if (std::abs(m.root.imag() - bobs) < std::abs(nearest - bobs)) nearest = m.root.imag();
  EXPECT_NEAR(nearest, bobs, 1e-6 * bobs);
}

// An oblique blow, that also bends, slides and turns the bar, without loss.
TEST(MasslessBoundary, KeepsTheEnergyOfAnObliqueBlow) {
  const Ran r = ran(bar(massless,
                        "start: {beam: {angle: 0.4, speed: 0.3}, end: {speed: [0.1, 0.07]}}\n"
                        "run: {until: 1, method: dopri5, tolerance: 1e-11}\n"));
  ASSERT_EQ(r.run.status, Status::finished) << r.run.reason;
  EXPECT_GE(r.run.impacts.size(), 2U);
  EXPECT_LT(std::abs(r.run.unexplained), 1e-8 * r.run.energy_in_play);
}

TEST(MasslessBoundary, SaysWhereItDoesNotServe) {
  const auto said = [](const std::string& more) { return complaint(bar(massless, "", more)); };
  pintle_test::expect_one_line(said(", friction: {coulomb: {coefficient: 0.2}}"),
                               "scene.yaml:", {"boundary: massless", "serves only friction", "ambrosio"});
  pintle_test::expect_one_line(complaint(unit_beam("{boundary: massless, count: 4}")),
                               "scene.yaml:", {"model: contact", "\"beam\" has none", "leave it out"});
  pintle_test::expect_one_line(complaint(bar("boundary: massless, frame: chord, count: 4", "")), "scene.yaml:", {"\"B\"", "mean axes"});
  EXPECT_EQ(said(", friction: {ambrosio: {coefficient: 0.2}}"), "accepted");
}

}  // namespace
}  // namespace pintle::massless_boundary_test
