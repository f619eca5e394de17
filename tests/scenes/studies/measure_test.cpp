// What a measure's words mean, against closed forms and hand-derived models.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "framework/common/result_columns.h"
#include "framework/study/case.h"
#include "framework/study/measures/measure_words.h"
#include "tests/oracles/pendulum.h"
#include "tests/oracles/slider_crank_clearance.h"
#include "tests/unit/worn_slider_crank.h"
#include "tests/refusal.h"

namespace pintle::measure_test {
namespace {

namespace po = pintle_oracle;
constexpr double pi = std::numbers::pi;

Outcome outcome(const std::string& scene, const std::vector<std::string>& words, const Overrides& overrides = {}) {
  std::vector<Measure> measures;
  for (const std::string& w : words) measures.push_back({w, w});
  Outcome out = run_case({"scene.yaml", scene}, overrides, measures);
  EXPECT_EQ(out.status, "finished") << out.reason;
  return out;
}
double value(const std::string& scene, const std::string& words, const Overrides& overrides = {}) {
  return outcome(scene, {words}, overrides).values[0];
}

// A point mass of 2 kg at the tip of a massless rod of 0.7 m, released from rest 1 rad from straight down.
const std::string pendulum = R"(
gravity: [0, -9.81]
bodies:
  bob: {rigid: {mass: 2 kg, inertia: 1e-12, center: [0.7 m, 0]}, points: {tip: [0.7 m, 0]}, pose: {angle: 1 rad - pi/2}}
joints:
  pivot: {revolute: [ground, bob]}
start: {bob: {angle: 1 rad - pi/2, speed: 0}}
run: {until: 4 s, tolerance: 1e-11}
)";
const po::Pendulum swinging{0.7, 9.81, 1};
constexpr double mass = 2;

TEST(Measure, OfAPendulumAgreesWithItsClosedForm) {
  const double T = po::period(swinging), g = 9.81, l = 0.7;
  struct Claim {
    std::string words;
    double expected, tolerance;  ///< relative
  };
  // Tolerances: of instants the run's, 1e-9 after some ten thousand local errors of 1e-11; of peaks between rows the fourth power of pi
  // times the rows' share of a period, (pi/1000)^4 ~ 1e-10; of trapezoids its square, 3e-6.
  constexpr double run = 1e-9, peak = 1e-9, trapezoid = 3e-6;
  const po::Swing odd = po::evaluate(swinging, 1.2345);
  double squares = 0, heights = 0;
  constexpr int n = 20'000;  // midpoints of the oracle, whose own error is 1e-9
  for (int k = 0; k < n; ++k) {
    const po::Swing s = po::evaluate(swinging, 0.5 + 2 * (k + 0.5) / n);
    squares += s.rate * s.rate / n, heights += s.y / n;
  }
  const std::vector<Claim> claims{{"y of bob.tip at 1.2345 s", odd.y, run},
                                  {"vx of bob.tip at 1234.5 ms", l * std::cos(odd.angle) * odd.rate, run},
                                  {"force at pivot at 1.2345 s", mass * odd.tension, run},
                                  {"force x at pivot at 1.2345 s", -mass * odd.tension * std::sin(odd.angle), run},
                                  {"alpha of bob at 1.2345 s", odd.acceleration, run},
                                  {"bob.speed at 1.2345 s", odd.rate, run},
                                  {"peak force at pivot", mass * g * (3 - 2 * std::cos(1.0)), peak},
                                  {"least force at pivot", mass * g * std::cos(1.0), peak},
                                  {"peak speed of bob", std::sqrt(2 * g / l * (1 - std::cos(1.0))), peak},
                                  {"greatest speed of bob.tip", std::sqrt(2 * g * l * (1 - std::cos(1.0))), peak},
                                  {"range of angle of bob", 2, peak},
                                  {"lowest y of bob.tip", -l, peak},
                                  {"time of peak angular velocity of bob before 0.7 s", T / 4, peak},
                                  {"time of least x of the bob.tip from 0.5 s to 1 s", T / 2, peak},
                                  {"frequency of angle of bob", 1 / T, 1e-4},
                                  {"frequency of y of bob.tip", 2 / T, 1e-4},
                                  {"rms angular speed of bob from 0.5 s to 2.5 s", std::sqrt(squares), trapezoid},
                                  {"mean y of bob.tip between 0.5 s and 2.5 s", heights, trapezoid},
                                  {"greatest kinetic energy", mass * g * l * (1 - std::cos(1.0)), peak},
                                  {"range of potential energy", mass * g * l * (1 - std::cos(1.0)), peak},
                                  {"distance between bob and bob.tip at 1 s", l, run},
                                  {"angle of bob at the start", 1 - pi / 2, run}};
  std::vector<std::string> words;
  for (const Claim& c : claims) words.push_back(c.words);
  const Outcome together = outcome(pendulum, words);
  for (std::size_t i = 0; i < claims.size(); ++i) {
    const double near = claims[i].tolerance * std::max(std::abs(claims[i].expected), 0.1);
    EXPECT_NEAR(together.values[i], claims[i].expected, near) << claims[i].words;
    EXPECT_NEAR(value(pendulum, claims[i].words), claims[i].expected, near) << claims[i].words << ", alone";
  }
}

// The paper's slider-crank, driven at 150 rad/s.
const std::string driven = worn_slider_crank + R"(drivers: {motor: {angle: [ground, crank], law: 150 rad/s*t}}
run: {until: 50 ms, tolerance: 1e-10}
)";
const Overrides ideal{{"joints.gudgeon pin.clearance", "null"}};

TEST(Measure, OfADrivenSliderCrankAgreesWithMinimalCoordinates) {
  po::Params p;
  p.driven = true;
  constexpr int n = 50'000;
  double torque2 = 0, force = 0, fx = 0, drive = 0;
  for (int k = 0; k < n; ++k) {
    const po::Ideal at = po::evaluate_ideal(p, 150 * 0.05 * (k + 0.5) / n, 150);
    const double F = std::hypot(at.pin_force[0], at.pin_force[1]);
    torque2 += at.torque * at.torque / n, force = std::max(force, F), fx += std::abs(at.pin_force[0]) / n;
    drive = std::max(drive, std::abs(at.torque));
  }
  const po::Ideal end = po::evaluate_ideal(p, 7.5, 150), start = po::evaluate_ideal(p, 0, 150),
                  mid = po::evaluate_ideal(p, 150 * 0.0123, 150);
  const Outcome got = outcome(driven,
                              {"x of slider at 12.3 ms", "rms torque of motor", "peak force at gudgeon pin", "peak torque of the motor",
                               "work of motor", "energy lost", "work of motor after 12.3 ms", "impacts", "peak eccentricity at gudgeon pin",
                               "longest free flight at gudgeon pin", "vx of slider at 12.3 ms", "force x at gudgeon pin at 12.3 ms"},
                              ideal);
  const std::vector<double> expected{mid.x,      std::sqrt(torque2),      force, drive, end.energy - start.energy,
                                     0,          end.energy - mid.energy, 0,     0,     0,
                                     mid.x_rate, -mid.pin_force[0]};
  // Rows are a 2000th of the run apart, 1/2400 of a turn: trapezoids to 1e-6, peaks far nearer; harmonics count four to eight times as
  // much.
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(got.values[i], expected[i], 1e-5 * std::max(std::abs(expected[i]), 1e-3)) << i;
}

TEST(Measure, OfAClearanceMissesNoImpactHoweverFewTheRows) {
  const std::vector<std::string> words{"peak force at gudgeon pin", "peak depth at gudgeon pin", "impacts at gudgeon pin",
                                       "time in contact at gudgeon pin", "longest free flight at gudgeon pin"};
  const Overrides brief{{"run.until", "8 ms"}};
  Overrides fine = brief;
  fine.emplace_back("output.every", "0.5 us");
  CaseLimits keep;
  keep.keep_run = true;
  const Outcome rows = run_case({"scene.yaml", driven}, fine, {}, keep);
  ASSERT_EQ(rows.status, "finished");
  const std::vector<double> depth = rows.run->trajectory.column("gudgeon pin.depth [m]"),
                            normal = rows.run->trajectory.column("gudgeon pin.normal [N]"), t = rows.run->trajectory.column("t [s]");
  double begun = 0, touching = 0, flight = 0, since = 0;
  for (std::size_t k = 1; k < t.size(); ++k) {
    if (depth[k] > 0 && depth[k - 1] <= 0) begun += 1, flight = std::max(flight, t[k] - since);
    if (depth[k] > 0) touching += t[k] - t[k - 1];
    if (depth[k] <= 0 && depth[k - 1] > 0) since = t[k];
  }
  ASSERT_GE(begun, 2) << "the test asks for impacts";
  const Outcome coarse = outcome(driven, words, brief);
  // The integrator reads peaks off between its steps, second order in the change over a step; times to a row.
  EXPECT_NEAR(coarse.values[0], *std::ranges::max_element(normal), 2e-3 * coarse.values[0]);
  EXPECT_NEAR(coarse.values[1], *std::ranges::max_element(depth), 2e-3 * coarse.values[1]);
  EXPECT_EQ(coarse.values[2], begun);
  EXPECT_NEAR(coarse.values[3], touching, 0.5e-6 * 2 * (begun + 1));
  EXPECT_NEAR(coarse.values[4], flight, 2 * 0.5e-6);
}

TEST(Measure, OfAMasslessLinkHasNoFlightAndItsEccentricityIsTheClearance) {
  const Outcome got = outcome(driven,
                              {"impacts at gudgeon pin", "longest free flight at gudgeon pin", "time in contact at gudgeon pin",
                               "mean eccentricity at gudgeon pin", "energy lost", "peak force at gudgeon pin"},
                              {{"joints.gudgeon pin.clearance.model", "massless link"}, {"run.until", "8 ms"}});
  EXPECT_EQ(got.values[0], 0);
  EXPECT_EQ(got.values[1], 0);
  EXPECT_NEAR(got.values[2], 8e-3, 1e-15);
  EXPECT_NEAR(got.values[3], 1e-4, 1e-9);
  EXPECT_EQ(got.values[4], 0);
  EXPECT_GT(got.values[5], 100) << "what the slider's inertia asks for";
}

TEST(Measure, EnergyLostIsTheSumOfItsParts) {
  const Outcome got = outcome(driven,
                              {"energy lost", "energy lost at gudgeon pin", "energy lost to hysteresis", "energy lost to friction",
                               "energy lost before 20 ms", "energy lost after 20 ms", "energy lost at gudgeon pin to friction at 50 ms"},
                              {{"joints.gudgeon pin.clearance.friction", "{ambrosio: {coefficient: 0.1}}"}});
  EXPECT_GT(got.values[2], 0);
  EXPECT_GT(got.values[3], 0);
  EXPECT_NEAR(got.values[1], got.values[2] + got.values[3], 1e-12);
  EXPECT_NEAR(got.values[0], got.values[4] + got.values[5], 1e-12);
  EXPECT_EQ(got.values[3], got.values[6]);
}

// A cantilever of steel, 1 m long, loaded at its tip by a force that comes on slowly and stays, over-critically damped.
const std::string cantilever = R"yaml(
bodies:
  rod:
    beam: {from: root, to: tip, section: {rectangle: [20 mm, 10 mm]}, theory: euler, young: 200 GPa, poisson: 0.3, density: 7800 kg/m^3, elements: 8}
    points: {root: [0, 0], middle: [0.5 m, 0], tip: [1 m, 0]}
    modes: {frame: tangent, craig-bampton: {count: 3}}
    damping: {ratios: 1}
joints: {wall: {weld: [ground, rod.root]}}
forces: {load: {force: [0, "-10 N*step(t, 0, 0.5 s)"], at: rod.tip}}
run: {until: 1.5 s, tolerance: 1e-9}
)yaml";

TEST(Measure, OfAFlexibleBodyAgreesWithTheLoadedCantilever) {
  const double F = 10, L = 1, height = 0.02, width = 0.01;
  double I = width * height * height * height / 12;
  const Outcome whole = outcome(cantilever, {"final deflection of rod", "final displacement of rod.tip", "final stress at rod.root",
                                             "uy of rod.tip at the end", "final displacement of rod.middle", "final strain energy"});
  // The section's height may lie either way: told by the stress, which is far off otherwise.
  if (whole.values[0] > 1.5 * F * L * L * L / (3 * 200e9 * I)) I = height * width * width * width / 12;
  const double c = I < 1e-8 * 0.5 ? width / 2 : height / 2, tip = F * L * L * L / (3 * 200e9 * I);
  EXPECT_NEAR(whole.values[0], tip, 2e-3 * tip) << "three modes and the static shape";
  EXPECT_NEAR(whole.values[1], tip, 2e-3 * tip);
  EXPECT_NEAR(whole.values[3], -tip, 2e-3 * tip);
  EXPECT_NEAR(whole.values[4], F * 0.25 * (3 - 0.5) / (6 * 200e9 * I), 5e-3 * tip);
  EXPECT_NEAR(whole.values[2], F * L * c / I, 0.05 * F * L * c / I);
  EXPECT_NEAR(whole.values[5], F * tip / 2, 5e-3 * F * tip / 2);
}

TEST(Measure, OfARigidBodyHasNoStressAndNoDeflection) {
  const Overrides rigid{{"bodies.rod.modes", "null"}, {"bodies.rod.damping", "null"}, {"forces.load", "null"}};
  const Outcome out = outcome(cantilever,
                              {"peak deflection of rod", "peak displacement of rod.tip", "final strain energy", "peak stress at rod.root",
                               "peak force of load", "work of load"},
                              rigid);
  for (const std::size_t zero : {0u, 1u, 2u}) EXPECT_EQ(out.values[zero], 0);
  for (const std::size_t lacking : {3u, 4u, 5u}) EXPECT_TRUE(std::isnan(out.values[lacking])) << lacking;
  EXPECT_EQ(out.units[3], "Pa");
  EXPECT_EQ(out.units[4], "N") << "the unit is that of the study's scene";
}

TEST(Measure, KeepsItsPointsWhenABeamIsCutIntoPieces) {
  const Overrides cut{{"bodies.rod.beam.pieces", "2"},
                      {"bodies.rod.modes", "{frame: tangent, count: 1}"},
                      {"run.until", "20 ms"},
                      {"run.tolerance", "1e-6"}};
  const Outcome got = outcome(
      cantilever,
      {"y of rod.tip at the end", "y of rod 2.tip at the end", "peak displacement of rod.middle", "peak displacement of rod 1.middle"},
      cut);
  EXPECT_LT(got.values[0], 0);
  EXPECT_EQ(got.values[0], got.values[1]);
  EXPECT_GT(got.values[2], 0);
  EXPECT_EQ(got.values[2], got.values[3]);
}

TEST(Measure, OfARunThatEndedEarlyIsEmptyUnlessItsWindowWasPassed) {
  std::vector<Measure> measures;
  for (const char* words : {"x of slider at 5 ms", "peak force at gudgeon pin before 5 ms", "peak force at gudgeon pin",
                            "final x of slider", "energy lost", "x of slider at 45 ms"})
    measures.push_back({words, words});
  CaseLimits limits;
  int asked = 0;
  limits.go_on = [&] { return ++asked < 120; };  // of steps, 64 for each
  const Outcome out = run_case({"scene.yaml", driven}, {{"run.max step", "2 us"}}, measures, limits);
  EXPECT_EQ(out.status, "interrupted");
  ASSERT_GT(out.t_end, 5e-3);
  ASSERT_LT(out.t_end, 45e-3);
  for (const std::size_t there : {0u, 1u}) EXPECT_FALSE(std::isnan(out.values[there])) << there;
  for (const std::size_t missing : {2u, 3u, 4u, 5u}) EXPECT_TRUE(std::isnan(out.values[missing])) << missing;
}

TEST(Measure, ReadsTheSameInManyWords) {
  const Scene scene = read_scene_text(driven, "scene.yaml");
  const auto read = [&](const std::string& words) { return read_measure({words, words}, scene); };
  const auto same = [](const Asked& a, const Asked& b) {
    return a.statistic == b.statistic && a.what == b.what && a.owner == b.owner && a.part == b.part && a.from == b.from && a.to == b.to &&
           a.instant == b.instant && a.unit == b.unit && a.frequency == b.frequency && a.time_of == b.time_of;
  };
  for (const auto& [one, other] : {std::pair{"peak force at gudgeon pin", "The  PEAK force of the Gudgeon Pin"},
                                   {"x of slider at 5 ms", "slider.x at 0.005 s"},
                                   {"max speed of crank", "greatest angular velocity of the crank"},
                                   {"greatest crank.speed [rad/s]", "highest crank.speed"},
                                   {"rms torque of motor after 10 ms", "root mean square moment of motor since 0.01"},
                                   {"mean eccentricity in gudgeon pin", "average eccentricity at the gudgeon pin"},
                                   {"energy lost at gudgeon pin to hysteresis", "energy lost to hysteresis at the gudgeon pin"},
                                   {"energy lost at gudgeon pin to hysteresis", "gudgeon pin.lost to hysteresis [J]"},
                                   {"mean y force at crank pin before 10 ms", "mean fy at crank pin until 10 ms"},
                                   {"kinetic energy at 1 ms", "kinetic [J] at 1 ms"},
                                   {"final vx of slider", "vx of slider at the end"},
                                   {"x of slider at 0 s", "x of slider at the start"},
                                   {"work of motor", "motor.work in"},
                                   {"peak acceleration of slider from 40 ms", "peak acceleration of slider in the last 10 ms"}})
    EXPECT_TRUE(same(read(one), read(other))) << one << " / " << other;
}

TEST(Measure, EveryAccountOfTheLedgerHasItsWord) {
  constexpr std::string_view lost = ".lost to ";
  const Scene scene = read_scene_text(driven, "scene.yaml");
  for (const Column& column : column::joined(column::transfers, column::body_transfers))
    if (const std::string_view name = column.name; name.starts_with(lost)) {
      const std::string account(name.substr(lost.size())), words = "energy lost to " + account;
      EXPECT_EQ(read_measure({words, words}, scene).part, account);
    }
}

TEST(Measure, ThatCannotBeReadSaysWhatTheSceneHas) {
  const Scene scene = read_scene_text(driven, "scene.yaml");
  struct Bad {
    std::string words;
    std::vector<std::string> says;
  };
  for (const Bad& b : std::vector<Bad>{
           {"peak force at gudgon pin",
            {"Did you mean \"gudgeon pin\"?", "the joints main bearing, crank pin, gudgeon pin and guide", "the driver motor"}},
           {"force at gudgeon pin", {"write peak, greatest, least"}},
           {"peak force", {"does not say of which joint"}},
           {"peak force at gudgeon pin at 1 ms", {"an instant has one value"}},
           {"wobble of crank", {"\"wobble of crank\" cannot be measured", "peak force at JOINT"}},
           {"paek force at gudgeon pin after 1 ms", {"Did you mean \"peak force at gudgeon pin after 1 ms\"?"}},
           {"peak foce at gudgeon pin", {"\"foce at gudgeon pin\" cannot be measured. Did you mean \"force at gudgeon pin\"?"}},
           {"rms angular veloctiy of crank", {"Did you mean \"angular velocity of crank\"?"}},
           {"final enrgy lost to friction", {"Did you mean \"energy lost to friction\"?"}},
           {"x of slider at 3 kg", {"a mass [kg]", "after 10 ms"}},
           {"x of slider at noon", {"noon"}},
           {"x of slider someday", {"\"someday\" is not understood"}},
           {"rms x of slider from 5 ms to 1 ms", {"empty"}},
           {"energy lost to heat", {"friction, hysteresis"}},
           {"peak impacts at gudgeon pin", {"one number of a run"}},
           {"peak stress at coupler.M", {"begins with no point", "coupler.A"}},
           {"time of mean x of slider", {"time of peak WHAT"}},
           {"", {"cannot be measured"}},
           {"mean x of slider before 0 s", {"empty"}},
           {"x of slider at -1 s", {"is negative"}}}) {
    SCOPED_TRACE(b.words);
    const Measure measure{"name", b.words, Place{7, "measure.name"}, "study.yaml"};
    const std::string said = pintle_test::refusal_by([&] { read_measure(measure, scene); });
    EXPECT_TRUE(said.starts_with("study.yaml:7: measure.name: ")) << said;
    pintle_test::expect_says(said, b.says);
  }
  Measure mode{"name", "natural frequncy of mode 1"};
  mode.question.analysis = Analysis::linearize;
  pintle_test::expect_says(pintle_test::refusal_by([&] { validate({mode}, scene); }), {"Did you mean \"natural frequency of mode 1\"?"});
  EXPECT_THROW(validate({{"late", "x of slider at 51 ms"}}, scene), SceneError);
  EXPECT_NO_THROW(validate({{"in time", "x of slider at 50 ms"}}, scene));
}

TEST(Measure, PreparesRowsForItsWindow) {
  const auto every = [&](const std::vector<std::string>& words, const Overrides& overrides = {}) {
    Scene scene = read_scene_text(driven, "scene.yaml", overrides);
    std::vector<Measure> measures;
    for (const std::string& w : words) measures.push_back({w, w});
    prepare(scene, measures);
    return scene.output.every > 0 ? scene.output.every : scene.run.until / 1000;
  };
  EXPECT_EQ(every({"final x of slider", "energy lost"}), 50e-6) << "the scene's own";
  EXPECT_NEAR(every({"peak force at gudgeon pin"}), 25e-6, 1e-15);
  EXPECT_LE(every({"rms x of slider from 1 ms to 2 ms"}), 0.5e-6 * (1 + 1e-12));
  EXPECT_EQ(every({"peak force at gudgeon pin"}, {{"output.every", "1 us"}}), 1e-6) << "never coarser";
}

// Instants that have no interval in common, each as exact as alone.
TEST(Measure, AtManyInstantsAgreesWithTheClosedForm) {
  std::vector<double> instants;
  for (int k = 1; k <= 12; ++k) instants.push_back(0.31928 * k - 0.0137 * std::sqrt(k));
  std::vector<std::string> words;
  for (const double t : instants) {
    const std::string at = " at " + std::to_string(t) + " s";
    words.insert(words.end(), {"y of bob.tip" + at, "force at pivot" + at, "kinetic energy" + at});
  }
  const Outcome found = outcome(pendulum, words, {{"output.every", "0.5 s"}});
  for (std::size_t k = 0; k < instants.size(); ++k) {
    const po::Swing s = po::evaluate(swinging, std::stod(std::to_string(instants[k])));
    EXPECT_NEAR(found.values[3 * k], s.y, 1e-9) << instants[k];
    EXPECT_NEAR(found.values[3 * k + 1], mass * s.tension, 1e-8 * mass * 9.81) << instants[k];
    EXPECT_NEAR(found.values[3 * k + 2], mass * 0.49 * s.rate * s.rate / 2, 1e-8 * mass * 9.81) << instants[k];
  }
}

}  // namespace
}  // namespace pintle::measure_test
