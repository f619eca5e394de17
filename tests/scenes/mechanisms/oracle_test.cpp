// The framework against models written by hand in minimal coordinates (tests/oracles).
#include <cmath>
#include <ostream>
#include <tuple>

#include <gtest/gtest.h>

#include "tests/scenes/mechanisms.h"

namespace pintle_scenes::oracle_test {
namespace {

namespace po = pintle_oracle;

// Demanded of the framework: what a first few impacts, each of which magnifies what came before it
// by a factor of order 10, leave of the two integrators' tolerances of 1e-12.
constexpr double motion = 1e-7;        // of the largest value in the run
constexpr double impact_time = 1e-9;   // [s]
constexpr double impact_speed = 1e-6;  // relative
// Peak and depth are read off between steps by a parabola, the loss off the ledger; both second
// order in the relative change over a step or better.
constexpr double impact_shape = 1e-4;  // relative

/// The oracle at the instants t, and its impacts up to the last one.
struct Expected {
  std::vector<po::Sample> samples;
  std::vector<po::Impact> impacts;
};

Expected expected(const SliderCrank& o, const std::vector<double>& times) {
  const po::Params p = oracle(o);
  po::Options options;
  options.tolerance = 1e-12;
  Expected out;
  po::State state = po::start(p), whole = state;
  for (const double t : times) {
    if (t > state.t) po::simulate(p, options, t, state);
    out.samples.push_back(po::evaluate(p, state));
  }
  po::simulate(p, options, times.back(), whole, [&](const po::Impact& i) { out.impacts.push_back(i); });
  return out;
}

template <class Value>
std::vector<double> series(const Expected& e, Value value) {
  std::vector<double> out;
  for (const po::Sample& s : e.samples) out.push_back(value(s));
  return out;
}

struct Case {
  const char* name;
  std::size_t impacts;  // at least so many begin in the time given
  SliderCrank options;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

// Spans end soon after the first impacts, before the journal stays at the wall, where there is such
// an end.
const Case cases[] = {
    {"Table2At50", 4, {.speed = 50, .until = 4e-3}},
    {"Table2At100", 4, {.speed = 100, .until = 2e-3}},
    {"Table2At150", 4, {.speed = 150, .until = 1.5e-3}},
    {"Table2At200", 4, {.speed = 200, .until = 1e-3}},
    {"HalfMillimetre", 4, {.clearance = 0.5e-3, .until = 10e-3}},
    {"TwoMillimetres", 4, {.clearance = 2e-3, .speed = 300, .restitution = 0.9, .until = 8e-3}},
    {"MaterialFriction", 4, {.clearance = 2e-3, .speed = 300, .restitution = 0.9, .friction = 0.1, .until = 8e-3}},
    {"GeometricFriction", 4, {.clearance = 2e-3, .speed = 300, .restitution = 0.9, .friction = 0.1, .geometric = true, .until = 6e-3}},
    {"BearingOnCoupler", 4, {.clearance = 0.5e-3, .friction = 0.05, .bearing_on_slider = false, .until = 8e-3}},
    {"EccentricStart", 3, {.clearance = 0.5e-3, .angle = 0.7, .friction = 0.02, .eccentricity = {-2e-4, 3e-4}, .until = 8e-3}},
    {"DrivenAt5000rpm", 3, {.clearance = 0.5e-3, .speed = 5000 * M_PI / 30, .friction = 0.1, .driven = true, .until = 1.5e-3}},
};

class PaperSliderCrank : public testing::TestWithParam<std::tuple<Case, const char*, const char*>> {};

TEST_P(PaperSliderCrank, MovesAndStrikesAsInMinimalCoordinates) {
  auto [c, method, constraints] = GetParam();
  SliderCrank& o = c.options;
  o.tolerance = 1e-12, o.method = method, o.constraints = constraints, o.outputs = 40;
  pintle::Scene made = scene(o);
  // The paper's sliding speed leaves friction's work unexplained; that is for ledger_test.
  if (o.geometric) made.run.ledger_bound = 1;
  const Whole w = run(made);
  ASSERT_EQ(w.run.status, pintle::Status::finished) << w.run.reason;
  const Expected e = expected(o, w.column("t [s]"));

  const auto check = [&](const char* name, auto value) {
    const double d = relative_difference(w.column(name), series(e, value));
    EXPECT_LT(d, motion) << name;
    RecordProperty(name, std::to_string(std::log10(d)));
  };
  check("crank.angle [rad]", [](const po::Sample& s) { return s.state.y[0]; });
  check("coupler.angle [rad]", [](const po::Sample& s) { return s.state.y[1]; });
  check("slider.x [m]", [](const po::Sample& s) { return s.state.y[2]; });
  check("crank.speed [rad/s]", [](const po::Sample& s) { return s.state.y[3]; });
  check("coupler.speed [rad/s]", [](const po::Sample& s) { return s.state.y[4]; });
  check("slider.vx [m/s]", [](const po::Sample& s) { return s.state.y[5]; });

  ASSERT_GE(e.impacts.size(), c.impacts);
  ASSERT_EQ(w.run.impacts.size(), e.impacts.size());
  for (std::size_t i = 0; i < e.impacts.size(); ++i) {
    const pintle::Impact& ours = w.run.impacts[i];
    const po::Impact& theirs = e.impacts[i];
    SCOPED_TRACE("impact " + std::to_string(i));
    EXPECT_NEAR(ours.begin, theirs.begin, impact_time);
    EXPECT_NEAR(ours.approach, theirs.approach, impact_speed * theirs.approach);
    EXPECT_NEAR(ours.deepest, theirs.deepest, impact_shape * theirs.deepest);
    EXPECT_NEAR(ours.peak_force, theirs.peak_force, impact_shape * theirs.peak_force);
    EXPECT_EQ(std::isnan(ours.end), !theirs.finished);
    const double lost = theirs.loss + theirs.friction_loss;
    if (!o.geometric) {
      EXPECT_NEAR(ours.lost, lost, impact_shape * lost);
    }
    if (!theirs.finished) continue;
    EXPECT_NEAR(ours.end, theirs.end, impact_time);
    EXPECT_NEAR(ours.separation, theirs.separation, impact_speed * theirs.approach);
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, PaperSliderCrank,
                         testing::Combine(testing::ValuesIn(cases), testing::Values("dopri5", "rkf45"),
                                          testing::Values("projection", "partitioning")),
                         [](const auto& i) {
                           return std::string(std::get<0>(i.param).name) + "_" + std::get<1>(i.param) + "_" + std::get<2>(i.param);
                         });

// Through a dozen impacts a run errs by no more than a few tolerances, whatever the order of its scheme: the kinks where forces
// begin are not stepped over.
class Impacts : public testing::TestWithParam<const char*> {};

TEST_P(Impacts, AreFollowedToTheToleranceAsked) {
  for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
    const SliderCrank o{.clearance = 5e-4, .restitution = 0.9, .until = 0.02, .tolerance = tolerance, .method = GetParam(), .outputs = 1};
    const Whole w = run(scene(o));
    const Expected e = expected(o, w.column("t [s]"));
    ASSERT_EQ(w.run.impacts.size(), e.impacts.size());
    EXPECT_NEAR(w.column("crank.angle [rad]").back(), e.samples.back().state.y[0], 10 * tolerance) << tolerance;
    EXPECT_NEAR(w.column("crank.speed [rad/s]").back() / o.speed, e.samples.back().state.y[3] / o.speed, 10 * tolerance) << tolerance;
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, Impacts, testing::Values("dopri5", "rkf45", "verner87"));

// A loss found to rounding must not be taken back by rounding: no stay of no depth and no length.
TEST(PaperSliderCrank, LossOfContactIsNotFollowedByAnOnsetAtOnce) {
  for (const char* method : {"dopri5", "rkf45"})
    for (const char* constraints : {"projection", "partitioning"})
      for (const double tolerance : {1e-8, 1e-9, 1e-10, 1e-11, 1e-12}) {
        const Whole w =
            run(scene(SliderCrank{.speed = 50, .until = 4e-3, .tolerance = tolerance, .method = method, .constraints = constraints}));
        SCOPED_TRACE(std::string(method) + ", " + constraints + ", " + std::to_string(tolerance));
        for (const pintle::Impact& i : w.run.impacts) EXPECT_FALSE(i.end - i.begin < 1e-12) << "begins " << i.begin;
        EXPECT_EQ(w.run.impacts.size(), 8u);  // of the independent model, converged
      }
}

// Contact forces are stiff: K δ^1.5 turns a difference in place of 1e-11 of the clearance into one
// of force that is some 1e-7 of its peak; the driving torque inherits it over the lever.
constexpr double force_in_contact = 1e-5;

TEST(PaperSliderCrank, DrivingTorqueWithClearanceIsThatOfMinimalCoordinates) {
  SliderCrank o{.clearance = 0.5e-3, .speed = 5000 * M_PI / 30, .friction = 0.1, .driven = true, .until = 1.5e-3, .tolerance = 1e-11};
  const Whole w = run(scene(o));
  const Expected e = expected(o, w.column("t [s]"));
  EXPECT_LT(relative_difference(w.column("motor.torque on crank [N m]"), series(e, [](const po::Sample& s) { return s.torque; })),
            force_in_contact);
  EXPECT_LT(relative_difference(w.column("gudgeon pin.normal [N]"), series(e, [](const po::Sample& s) { return s.normal; })),
            force_in_contact);
  EXPECT_NEAR(w.ledger("motor.work in [J]"), e.samples.back().state.y[9], force_in_contact * std::abs(e.samples.back().state.y[9]));
}

TEST(PaperSliderCrank, EccentricityAndSlidingAreThoseOfMinimalCoordinates) {
  SliderCrank o{.clearance = 2e-3, .speed = 300, .restitution = 0.9, .friction = 0.1, .until = 6e-3, .tolerance = 1e-11};
  const Whole w = run(scene(o));
  const Expected e = expected(o, w.column("t [s]"));
  EXPECT_LT(relative_difference(w.column("gudgeon pin.ex [m]"), series(e, [](const po::Sample& s) { return s.e[0]; })), motion);
  EXPECT_LT(relative_difference(w.column("gudgeon pin.ey [m]"), series(e, [](const po::Sample& s) { return s.e[1]; })), motion);
  EXPECT_LT(relative_difference(w.column("gudgeon pin.sliding [m/s]"), series(e, [](const po::Sample& s) { return s.slip; })), motion);
  EXPECT_LT(relative_difference(w.column("gudgeon pin.friction [N]"), series(e, [](const po::Sample& s) { return s.friction; })),
            force_in_contact);
}

// --- without clearance: one dof, no impacts to magnify anything ---

constexpr double smooth = 1e-9;  // a hundred times the tolerance below, over some revolutions

class IdealSliderCrank : public testing::TestWithParam<bool> {};

TEST_P(IdealSliderCrank, MotionJointForceAndTorqueAreThoseOfOneFreedom) {
  const SliderCrank o{.clearance = 0, .angle = 0.3, .driven = GetParam(), .until = 0.1, .tolerance = 1e-12, .outputs = 50};
  const Whole w = run(scene(o));
  ASSERT_EQ(w.run.status, pintle::Status::finished) << w.run.reason;
  std::vector<po::Ideal> ideal;
  for (const double t : w.column("t [s]")) ideal.push_back(po::ideal_at(oracle(o), t, 1e-14));
  const auto check = [&](const char* name, auto value) {
    std::vector<double> want;
    for (const po::Ideal& i : ideal) want.push_back(value(i));
    EXPECT_LT(relative_difference(w.column(name), want), smooth) << name;
  };
  check("crank.angle [rad]", [](const po::Ideal& i) { return i.angle; });
  check("crank.speed [rad/s]", [](const po::Ideal& i) { return i.speed; });
  check("coupler.angle [rad]", [](const po::Ideal& i) { return i.phi; });
  check("coupler.speed [rad/s]", [](const po::Ideal& i) { return i.phi_rate; });
  check("slider.x [m]", [](const po::Ideal& i) { return i.x; });
  check("slider.vx [m/s]", [](const po::Ideal& i) { return i.x_rate; });
  check("slider.ax [m/s^2]", [](const po::Ideal& i) { return i.x_acceleration; });
  check("gudgeon pin.fx on slider [N]", [](const po::Ideal& i) { return -i.pin_force[0]; });
  check("gudgeon pin.fy on slider [N]", [](const po::Ideal& i) { return -i.pin_force[1]; });
  if (o.driven)
    check("motor.torque on crank [N m]", [](const po::Ideal& i) { return i.torque; });
  else
    check("crank.alpha [rad/s^2]", [](const po::Ideal& i) { return i.acceleration; });
}

INSTANTIATE_TEST_SUITE_P(FreeAndDriven, IdealSliderCrank, testing::Bool(), [](const auto& i) { return i.param ? "Driven" : "Free"; });

// --- pendulums ---

struct PendulumRun {
  Hanging hanging;
  const char *method, *constraints;
};
void PrintTo(const PendulumRun& r, std::ostream* out) { *out << r.method; }
class OnePendulum : public testing::TestWithParam<PendulumRun> {};

// The body's turn of a pendulum held by a link is not that of the rod: take the place of its end.
TEST_P(OnePendulum, IsWherePublishedAndHasTheForceOfTheClosedForm) {
  const auto [hanging, method, constraints] = GetParam();
  pintle::Scene s = pendulum(hanging, -M_PI / 2);
  s.run.until = 10, s.run.tolerance = 1e-13, s.output.every = 0.25;
  s.run.method = method, s.run.constraints = constraints;
  const Whole w = run(s);
  ASSERT_EQ(w.run.status, pintle::Status::finished) << w.run.reason;
  const auto t = w.column("t [s]"), x = w.column("bob.x [m]"), y = w.column("bob.y [m]"), angle = w.column("bob.angle [rad]"),
             fx = w.column("rod.fx on bob [N]"), fy = w.column("rod.fy on bob [N]");
  constexpr double published = 1e-9;  // as the benchmark's values are asked for
  for (std::size_t i = 0; i < t.size(); ++i) {
    const po::Swing swing = po::evaluate(po::Pendulum{.release = -M_PI / 2}, t[i]);
    const bool by_pin = hanging == Hanging::by_pin;  // then the body's origin is the pivot
    EXPECT_NEAR(by_pin ? std::cos(angle[i]) : x[i], swing.x, published);
    EXPECT_NEAR(by_pin ? std::sin(angle[i]) : y[i], swing.y, published);
    if (!by_pin) {
      EXPECT_NEAR(-fx[i] * swing.x - fy[i] * swing.y, swing.tension, 10 * published);
      EXPECT_NEAR(fx[i] * swing.y - fy[i] * swing.x, 0, 10 * published);
    }
    const double end[2] = {by_pin ? std::cos(angle[i]) : x[i], by_pin ? std::sin(angle[i]) : y[i]};
    if (t[i] == 1) {
      EXPECT_NEAR(end[0], 0.9862917511318754, published);
      EXPECT_NEAR(end[1], -0.16501085312554079, published);
    }
  }
  const bool by_pin = hanging == Hanging::by_pin;
  EXPECT_NEAR(by_pin ? std::cos(angle.back()) : x.back(), -0.27508746257612204, published);
  EXPECT_NEAR(by_pin ? std::sin(angle.back()) : y.back(), -0.9614192050991237, published);
}

INSTANTIATE_TEST_SUITE_P(
    Held, OnePendulum,
    testing::Values(PendulumRun{Hanging::by_link, "dopri5", "projection"}, PendulumRun{Hanging::by_link, "rkf45", "partitioning"},
                    PendulumRun{Hanging::by_pin, "dopri5", "partitioning"}, PendulumRun{Hanging::by_pin, "rkf45", "projection"}),
    [](const auto& i) {
      return std::string(i.param.hanging == Hanging::by_link ? "Link" : "Pin") + "_" + i.param.method + "_" + i.param.constraints;
    });

TEST(DoublePendulum, SwingsAsInItsTwoAngles) {
  // Not chaotic in so short a time: neighbouring motions part by less than a hundred times.
  po::DoublePendulum p;
  p.mass[0] = 1.3, p.mass[1] = 0.7;
  p.centre[0] = 0.5, p.centre[1] = 0.4;
  p.inertia[0] = 0.1, p.inertia[1] = 0.05;
  const po::Vec<4> start{2.0, -1.0, 0.5, -2.0};
  for (const char* constraints : {"projection", "partitioning"}) {
    pintle::Scene s = double_pendulum(p, start);
    s.run.until = 3, s.run.tolerance = 1e-12, s.output.every = 0.1;
    s.run.constraints = constraints;
    const Whole w = run(s);
    ASSERT_EQ(w.run.status, pintle::Status::finished) << w.run.reason;
    const auto t = w.column("t [s]"), upper = w.column("upper.angle [rad]"), lower = w.column("lower.angle [rad]"),
               rate = w.column("lower.speed [rad/s]");
    for (std::size_t i = 0; i < t.size(); ++i) {
      const po::Vec<4> y = po::evaluate(p, start, t[i]);
      EXPECT_NEAR(upper[i], y[0] - M_PI / 2, 1e-8);
      EXPECT_NEAR(lower[i], y[1] - M_PI / 2, 1e-8);
      EXPECT_NEAR(rate[i], y[3], 1e-7);
    }
  }
}

// --- four-bar: nothing is integrated, so that only rounding and the closure's tolerance remain ---

class FourBarByDriver : public testing::TestWithParam<const char*> {};

TEST_P(FourBarByDriver, HasTheKinematicsAndTorqueOfTheClosedForm) {
  const po::LinkMass links[3] = {{1.0, 0.01, 0.5}, {2.0, 0.1, 0.4}, {1.5, 0.05, 0.6}};
  for (const bool open : {true, false}) {
    const po::FourBar f{1.0, 0.3, 0.9, 0.7, open};
    const double start = 0.4, rate = 5, accel = 3;
    pintle::Scene s = four_bar(f, links, 9.81, start, rate, accel);
    s.run.until = 2, s.run.tolerance = 1e-10, s.output.every = 0.05;
    s.run.constraints = GetParam();
    const Whole w = run(s);
    ASSERT_EQ(w.run.status, pintle::Status::finished) << w.run.reason;
    const auto t = w.column("t [s]");
    std::vector<po::FourBarMotion> m;
    std::vector<double> torque;
    for (const double at : t) {
      const po::Turn crank{start + rate * at + accel * at * at / 2, rate + accel * at, accel};
      m.push_back(po::evaluate(f, crank));
      ASSERT_TRUE(m.back().closes);
      torque.push_back(po::crank_torque(f, crank, links, 9.81));
    }
    // C = 0 holds to 1e-10 at worst, Ċ = 0 likewise; accelerations multiply by the rate.
    const auto check = [&](const std::string& name, auto value, double tolerance) {
      std::vector<double> want;
      for (const auto& i : m) want.push_back(value(i));
      EXPECT_LT(relative_difference(w.column(name), want), tolerance) << name;
    };
    const double two_pi = 2 * M_PI;
    const auto wrapped = [&](double a) { return std::remainder(a, two_pi); };
    const auto c = w.column("coupler.angle [rad]"), r = w.column("rocker.angle [rad]");
    for (std::size_t i = 0; i < t.size(); ++i) {
      EXPECT_NEAR(wrapped(c[i] - m[i].coupler.angle), 0, 1e-9);
      EXPECT_NEAR(wrapped(r[i] - m[i].rocker.angle), 0, 1e-9);
    }
    check(
        "coupler.speed [rad/s]", [](const auto& i) { return i.coupler.rate; }, 1e-9);
    check(
        "rocker.speed [rad/s]", [](const auto& i) { return i.rocker.rate; }, 1e-9);
    check(
        "coupler.alpha [rad/s^2]", [](const auto& i) { return i.coupler.acceleration; }, 1e-8);
    check(
        "rocker.alpha [rad/s^2]", [](const auto& i) { return i.rocker.acceleration; }, 1e-8);
    EXPECT_LT(relative_difference(w.column("motor.torque on crank [N m]"), torque), 1e-8);
  }
}

INSTANTIATE_TEST_SUITE_P(Constraints, FourBarByDriver, testing::Values("projection", "partitioning"),
                         [](const auto& i) { return std::string(i.param); });

}  // namespace
}  // namespace pintle_scenes::oracle_test
