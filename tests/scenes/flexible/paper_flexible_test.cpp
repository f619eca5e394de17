// The paper's flexible cases, as examples/paper has them, against the independent model of
// tests/oracles, whose coupler is the same one beam element in coordinates of its own.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>

#include <gtest/gtest.h>

#include "framework/scene/yaml/reader.h"
#include "tests/oracles/flexible_slider_crank.h"
#include "tests/scenes/mechanisms.h"

namespace pintle_scenes::paper_flexible_test {
namespace {

namespace po = pintle_oracle;
namespace pf = pintle_oracle::flexible;
using pintle::Scene;

// Both integrators work to 1e-12 of their scales. Between the first impacts an error grows by a
// factor of order 10 each, and there are up to six.
constexpr double motion = 1e-6;        // of the largest value in the run
constexpr double impact_time = 1e-9;   // [s]
constexpr double impact_speed = 1e-6;  // relative to the first approach
// Depth is read off between steps by a parabola, the loss off the ledger; both second order in the
// relative change over a step or better.
constexpr double impact_shape = 1e-4;  // relative
// Without impacts nothing magnifies an error; the speeds are some 1e4 radians of the coupler's
// fastest vibration long, of which each adds its own.
constexpr double smooth = 1e-8;

struct Case {
  const char* name;
  const char* scene;  // of examples/paper
  double until;       // soon after the first impacts, before the journal stays at the wall [s]
  std::size_t impacts;
  double clearance, mu, zeta;
  bool geometric = false, bearing_on_slider = true;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

const Case cases[] = {
    {"Fig12Flexible", "fig12_flexible", 0.7e-3, 5, 1e-5, 0, 0.04},
    {"Table3Case1", "table3_case1", 0.6e-3, 5, 1e-5, 0, 0},
    {"Table3Case2", "table3_case2", 0.64e-3, 5, 1e-5, 0.1, 0},
    {"Table3Case3", "table3_case3", 0.75e-3, 5, 1e-5, 0.1, 0.04},
    {"Table3Case2Geometric", "table3_case2_geometric", 0.6e-3, 5, 1e-5, 0.1, 0, true},
    {"Table3Case3Geometric", "table3_case3_geometric", 0.7e-3, 5, 1e-5, 0.1, 0.04, true},
    {"BearingOnCoupler", "table3_case3", 0.75e-3, 5, 1e-5, 0.1, 0.04, false, false},
    {"HalfMillimetre", "table3_case3", 4e-3, 4, 5e-4, 0.05, 0.04},
};

Scene scene(const Case& c) {
  Scene s = pintle::read_scene(std::filesystem::path(PINTLE_SOURCE_DIR) / "examples/paper" / (std::string(c.scene) + ".yaml"),
                               {{"zeta", std::to_string(c.zeta)}});
  s.run.until = c.until, s.run.tolerance = 1e-12;
  s.output.every = c.until / 60, s.output.frames = 0;
  if (c.geometric) s.run.ledger_bound = 1;  // its work is not that of its force
  for (pintle::SceneJoint& j : s.joints) {
    if (!j.clearance) continue;
    j.clearance->radial = c.clearance;
    j.clearance->bearing = c.bearing_on_slider ? "slider" : "coupler";
    if (j.clearance->friction) j.clearance->friction->coefficient = c.mu;
  }
  return s;
}

pf::Params oracle(const Case& c) {
  return {.zeta = {c.zeta, c.zeta},
          .clearance = c.clearance,
          .mu = c.mu,
          .slip = c.geometric ? po::Slip::geometric : po::Slip::material,
          .bearing_on_slider = c.bearing_on_slider};
}

pf::Result expected(const Case& c, const std::vector<double>& times) {
  const pf::Params p = oracle(c);
  pf::Options options;
  options.tolerance = 1e-12;
  return pf::simulate(p, options, pf::start(p), times);
}

/// Largest difference over the largest value of a column that the oracle has as `value`.
template <class Value>
double difference(const pintle::Table& ours, const char* name, const pf::Result& theirs, Value value) {
  std::vector<double> want;
  for (const pf::Sample& s : theirs.samples) want.push_back(value(s));
  return relative_difference(ours.column(name), want);
}

void expect_motion(const Whole& w, const pf::Result& e, double within) {
  const std::pair<const char*, std::size_t> coordinates[] = {
      {"crank.angle [rad]", 0},    {"coupler.angle [rad]", 1},   {"coupler.B.ux [m]", 2},
      {"coupler.A.turn [rad]", 3}, {"coupler.B.turn [rad]", 4},  {"slider.x [m]", 5},
      {"crank.speed [rad/s]", 6},  {"coupler.speed [rad/s]", 7}, {"slider.vx [m/s]", 11}};
  for (const auto& [name, i] : coordinates)
    EXPECT_LT(difference(w.run.trajectory, name, e, [i = i](const pf::Sample& s) { return s.state.y[i]; }), within) << name;
}

void expect_energies(const Whole& w, const pf::Result& e, double within) {
  const pintle::Table& ledger = w.run.ledger;
  const auto check = [&](const char* name, auto value) {
    if (std::ranges::find(ledger.header, name) == ledger.header.end()) return;
    EXPECT_LT(difference(ledger, name, e, value), within) << name;
  };
  check("kinetic [J]", [](const pf::Sample& s) { return s.kinetic; });
  check("gravity [J]", [](const pf::Sample& s) { return s.gravity; });
  check("strain [J]", [](const pf::Sample& s) { return s.strain; });
  check("gudgeon pin.lost to hysteresis [J]", [](const pf::Sample& s) { return s.state.y[12]; });
  check("coupler.lost to damping [J]", [](const pf::Sample& s) { return s.state.y[14]; });
}

/// Taken from the bodies: friction's own account, and what its own speed does not show.
void expect_friction(const Whole& w, const pf::Result& e, double within) {
  std::vector<double> ours = w.run.ledger.column("gudgeon pin.lost to friction [J]"), theirs;
  const std::vector<double> unexplained = w.run.ledger.column("unexplained [J]");
  for (std::size_t i = 0; i < ours.size(); ++i) ours[i] -= unexplained[i];
  for (const pf::Sample& s : e.samples) theirs.push_back(s.state.y[13]);
  EXPECT_LT(relative_difference(ours, theirs), within);
}

class PaperFlexible : public testing::TestWithParam<Case> {};

TEST_P(PaperFlexible, MovesBendsAndLosesAsTheIndependentModel) {
  const Case c = GetParam();
  const Whole w = run(scene(c));
  ASSERT_EQ(w.run.status, pintle::Status::finished) << w.run.reason;
  const pf::Result e = expected(c, w.column("t [s]"));
  expect_motion(w, e, motion);
  expect_energies(w, e, motion);
  if (c.mu > 0) expect_friction(w, e, motion);
  EXPECT_LT(difference(w.run.trajectory, "gudgeon pin.ex [m]", e, [](const pf::Sample& s) { return s.e.x(); }), motion);
  EXPECT_LT(difference(w.run.trajectory, "gudgeon pin.ey [m]", e, [](const pf::Sample& s) { return s.e.y(); }), motion);
}

TEST_P(PaperFlexible, StrikesAsTheIndependentModel) {
  const Case c = GetParam();
  const Whole w = run(scene(c));
  const pf::Result e = expected(c, {c.until});
  ASSERT_GE(e.impacts.size(), c.impacts);
  ASSERT_EQ(w.run.impacts.size(), e.impacts.size());
  const double first = e.impacts[0].approach;
  for (std::size_t i = 0; i < e.impacts.size(); ++i) {
    const pintle::Impact& ours = w.run.impacts[i];
    const pf::Impact& theirs = e.impacts[i];
    SCOPED_TRACE("impact " + std::to_string(i));
    EXPECT_NEAR(ours.begin, theirs.begin, impact_time);
    EXPECT_NEAR(ours.approach, theirs.approach, impact_speed * first);
    EXPECT_NEAR(ours.deepest, theirs.deepest, impact_shape * theirs.deepest);
    EXPECT_EQ(std::isnan(ours.end), !theirs.finished);
    const double lost = theirs.loss + theirs.friction_loss;
    if (!c.geometric) {
      EXPECT_NEAR(ours.lost, lost, impact_shape * lost);
    }
    if (!theirs.finished) continue;
    EXPECT_NEAR(ours.end, theirs.end, impact_time);
    EXPECT_NEAR(ours.separation, theirs.separation, impact_speed * first);
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, PaperFlexible, testing::ValuesIn(cases), [](const auto& i) { return std::string(i.param.name); });

TEST(PaperFlexibleIdeal, MovesBendsAndLosesAsTheIndependentModel) {
  for (const double zeta : {0.0, 0.04}) {
    SCOPED_TRACE(zeta);
    const Case c{"", "fig12_flexible_ideal", 0.03, 0, 0, 0, zeta};
    const Whole w = run(scene(c));
    ASSERT_EQ(w.run.status, pintle::Status::finished) << w.run.reason;
    const pf::Result e = expected(c, w.column("t [s]"));
    expect_motion(w, e, smooth);
    expect_energies(w, e, smooth);
    for (const auto& [name, k] : {std::pair{"gudgeon pin.fx on slider [N]", 0}, std::pair{"gudgeon pin.fy on slider [N]", 1}})
      EXPECT_LT(difference(w.run.trajectory, name, e, [k = k](const pf::Sample& x) { return -x.pin_force[k]; }), smooth) << name;
  }
}

TEST(PaperFlexible, LedgerClosesInEveryCaseButThatOfThePlaceOfContact) {
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const pintle::Run r = run(scene(c)).run;
    const double open = std::abs(r.worst_unexplained) / r.energy_in_play;
    if (c.geometric)
      EXPECT_GT(open, 1e-7);  // friction does work that its own speed does not show
    else
      EXPECT_LT(open, 1e-10);  // a hundred times the tolerance, over some thousand steps
  }
}

}  // namespace
}  // namespace pintle_scenes::paper_flexible_test
