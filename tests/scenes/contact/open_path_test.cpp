// Bodies that come from behind an open path, which has a face and no back.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/scenes/text_runs.h"

namespace pintle::open_path_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::run, pintle_scenes::Whole;

// A disc on an arm swings in from the back of an anvil. Open, the anvil has no back, and the disc is 10 cm behind its face when it comes to
// face it: a force of that depth must not begin. Closed, it strikes the back.
TEST(OpenPath, AForceDoesNotBeginDeepBehindIt) {
  const auto swing = [](const std::string& anvil, const std::string& method) {
    return run(
        "ground: {points: {O: [0, 0]}, profiles: {anvil: {" + anvil +
        "}}}\n"
        "bodies:\n"
        "  hammer:\n"
        "    rigid: {mass: 4 kg, inertia: 0.06 kg m^2, center: [-200 mm, 0]}\n"
        "    points: {O: [0, 0], head: [-300 mm, -20 mm]}\n"
        "    profiles: {face: {disc: head, radius: 30 mm}}\n"
        "joints: {pivot: {revolute: [ground.O, hammer.O]}}\n"
        "contacts: {blow: {between: [hammer.face, ground.anvil], normal: {hunt-crossley: {restitution: 0.3, stiffness: 1e8 N/m^1.5}}}}\n"
        "start: {hammer: {angle: 100 deg, speed: -12 rad/s}}\n"
        "run: {until: 0.16 s, tolerance: 1e-7, method: " +
        method + "}\noutput: {every: 1 ms, frames: 0}\n");
  };
  for (const std::string method : {"rkf45", "dopri5", "verner87", "{generalized-alpha: {rho: 0.8}}"}) {
    SCOPED_TRACE(method);
    const Whole open = swing("path: [[-400 mm, -55 mm], [-200 mm, -55 mm]], material: right", method);
    EXPECT_EQ(open.run.status, Status::failed);
    EXPECT_NE(open.run.reason.find("\"blow\""), std::string::npos) << open.run.reason;
    EXPECT_NE(open.run.reason.find("closed: true"), std::string::npos) << open.run.reason;
    EXPECT_LT(std::abs(open.run.unexplained), 1e-3 * open.run.energy_in_play);
  }
  const Whole closed =
      swing("path: [[-400 mm, -55 mm], [-400 mm, -155 mm], [-200 mm, -155 mm], [-200 mm, -55 mm]], closed: true, round: 1 mm", "dopri5");
  expect_sound(closed);
  EXPECT_EQ(closed.run.impacts.size(), 1u);
}

}  // namespace
}  // namespace pintle::open_path_test
