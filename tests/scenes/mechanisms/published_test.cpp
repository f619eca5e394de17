// Whole runs against published numbers: Andrews' mechanism, SUNDIALS' slider-crank, the paper's
// Table 2.
#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/scenes/mechanisms.h"

namespace pintle_scenes::published_test {
namespace {

struct Combination {
  const char *method, *constraints;
};
const Combination combinations[] = {
    {"dopri5", "projection"}, {"dopri5", "partitioning"}, {"rkf45", "projection"}, {"rkf45", "partitioning"}};
void PrintTo(const Combination& c, std::ostream* out) { *out << c.method << " " << c.constraints; }
std::string name_of(const testing::TestParamInfo<Combination>& i) { return std::string(i.param.method) + "_" + i.param.constraints; }

// --- Andrews ---

class Andrews : public testing::TestWithParam<Combination> {
 protected:
  static const nlohmann::json& data() {
    static const nlohmann::json all = [] {
      std::ifstream file(PINTLE_SOURCE_DIR "/tests/data/andrews.json");
      return nlohmann::json::parse(file);
    }();
    return all;
  }
  // Numbers kept as text for their digits.
  static std::vector<double> precise(const char* key) {
    std::vector<double> out;
    for (const auto& x : data()["high_precision_t0.03"][key])
      out.push_back(x.is_string() ? std::stod(x.get<std::string>()) : x.get<double>());
    return out;
  }
  // beta, Theta, gamma, phi, delta, Omega, epsilon from the bodies' angles, or their derivatives.
  static std::vector<double> published_order(const Whole& w, const std::string& of) {
    const auto k = [&](int i) { return w.last(std::string("K").append(std::to_string(i)).append(of)); };
    return {k(1), k(2) - k(1), k(3), k(4) - k(5), k(5), k(6) - k(7), k(7)};
  }
  static void expect_near(const std::vector<double>& got, const std::vector<double>& want, double relative, const char* what) {
    double worst = 0;
    for (std::size_t i = 0; i < want.size(); ++i) {
      EXPECT_NEAR(got[i], want[i], relative * std::abs(want[i])) << what << " " << i;
      worst = std::max(worst, std::abs(got[i] / want[i] - 1));
    }
    RecordProperty(what, std::to_string(std::log10(worst)));
  }
};

TEST_P(Andrews, EndsWhereTheHighPrecisionSolutionDoes) {
  pintle::Scene s = andrews();
  s.run.tolerance = 1e-12, s.run.method = GetParam().method;
  s.run.constraints = GetParam().constraints;
  s.output.every = 0.03;
  const Whole w = run(s);
  ASSERT_EQ(w.run.status, pintle::Status::finished) << w.run.reason;
  expect_near(published_order(w, ".angle [rad]"), precise("q"), 1e-9, "q");
  expect_near(published_order(w, ".speed [rad/s]"), precise("v"), 1e-7, "v");
  // Accelerations are linear in forces, as the multipliers are.
  expect_near(published_order(w, ".alpha [rad/s^2]"), precise("a"), 5e-6, "a");

  constexpr double multipliers = 5e-6;
  const char* key =
      "joint_reactions_t0.03_Cartesian_model_N(lambda of constraint pos_a-pos_b=0; force on body "
      "of "
      "a = J^T lam)";
  double worst = 0;
  for (std::size_t k = 0; k < w.model.system.joints.size(); ++k) {
    const std::string name = w.model.system.joint_names[k];
    const auto lambda = data()[key][name].get<std::vector<double>>();
    // Our table names the force on b, the opposite of that on a, unless b is the ground.
    const std::string subject = pintle::joint_subject(w.model.system, static_cast<int>(k));
    const bool on_b = name.substr(name.find('-') + 1) == subject;
    const double sign = on_b ? -1 : 1, size = std::hypot(lambda[0], lambda[1]);
    const double fx = sign * w.last(name + ".fx on " + subject + " [N]");
    const double fy = sign * w.last(name + ".fy on " + subject + " [N]");
    EXPECT_NEAR(fx, lambda[0], multipliers * size) << name;
    EXPECT_NEAR(fy, lambda[1], multipliers * size) << name;
    worst = std::max(worst, std::hypot(fx - lambda[0], fy - lambda[1]) / size);
  }
  RecordProperty("multipliers", std::to_string(std::log10(worst)));
}

TEST_P(Andrews, StartsWithThePublishedAccelerations) {
  pintle::Scene s = andrews();
  s.run.constraints = GetParam().constraints, s.run.method = GetParam().method;
  s.run.until = 1e-5;
  const Whole w = run(s);
  const auto a = data()["initial"]["a"].get<std::vector<double>>();
  const auto first = [&](int i) { return w.column(std::string("K").append(std::to_string(i)).append(".alpha [rad/s^2]")).front(); };
  const double got[7] = {first(1), first(2) - first(1), first(3), first(4) - first(5), first(5), first(6) - first(7), first(7)};
  // The published start closes the loops to 1e-16; the equations' condition takes some digits.
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(got[i], a[i], 1e-9 * std::abs(a[0])) << i;
}

INSTANTIATE_TEST_SUITE_P(Schemes, Andrews, testing::ValuesIn(combinations), name_of);

// --- SUNDIALS' slider-crank ---

/// ∫ y dt by Boole's rule over groups of four intervals; at() each `group` rows.
std::vector<double> integral(const std::vector<double>& y, double h, std::size_t rows_between) {
  std::vector<double> out{0};
  double sum = 0;
  for (std::size_t i = 0; i + 4 < y.size(); i += 4) {
    sum += 2 * h / 45 * (7 * y[i] + 32 * y[i + 1] + 12 * y[i + 2] + 32 * y[i + 3] + 7 * y[i + 4]);
    if ((i + 4) % rows_between == 0) out.push_back(sum);
  }
  return out;
}

class Sundials : public testing::TestWithParam<Combination> {};

// G = ∫ kinetic energy dt: by quadrature of order 6 over the ledger's rows, 1/320 s apart. They are
// dense output; the motion's fastest time scale is about 0.3 s, so that h⁶ is below 1e-11.
TEST_P(Sundials, SliderCrankFollowsThePublishedTable) {
  constexpr double published = 1e-8;
  constexpr std::size_t between = 80;  // rows between two of the table
  pintle::Scene s = sundials_slider_crank();
  s.run.tolerance = 1e-12, s.run.method = GetParam().method;
  s.run.constraints = GetParam().constraints;
  s.output.every = 0.25 / between;
  const Whole w = run(s);
  ASSERT_EQ(w.run.status, pintle::Status::finished) << w.run.reason;

  const std::vector<std::vector<double>> ours = {w.column("t [s]"),
                                                 w.column("crank.angle [rad]"),
                                                 w.column("rod.x [m]"),
                                                 w.column("rod.angle [rad]"),
                                                 w.column("crank.speed [rad/s]"),
                                                 w.column("rod.vx [m/s]"),
                                                 w.column("rod.speed [rad/s]")};
  const auto G = integral(w.run.ledger.column("kinetic [J]"), s.output.every, between);
  std::ifstream file(PINTLE_SOURCE_DIR "/tests/data/sundials_slider_crank.csv");
  std::string line;
  std::getline(file, line);
  ASSERT_EQ(line, "t,q,x,p,qd,xd,pd,G");
  std::size_t rows = 0;
  double worst = 0;
  for (; std::getline(file, line); ++rows) {
    std::istringstream in(line);
    std::string word;
    for (std::size_t c = 0; std::getline(in, word, ','); ++c) {
      const double want = std::stod(word);
      const double got = c < 7 ? ours[c].at(rows * between) : G.at(rows);
      EXPECT_NEAR(got, want, published) << "row " << rows << ", column " << c;
      worst = std::max(worst, std::abs(got - want));
    }
  }
  EXPECT_EQ(rows, 41u);
  RecordProperty("worst", std::to_string(std::log10(worst)));
  EXPECT_NEAR(G.back(), 3.336606799483, published);
}

INSTANTIATE_TEST_SUITE_P(Schemes, Sundials, testing::ValuesIn(combinations), name_of);

// --- the paper's Table 2 ---

struct Row {
  double speed;       // [rad/s]
  double energy;      // at the start, as printed [J]
  double loss;        // in 0.05 s, as printed [J]
  double half_digit;  // of the printed loss [J]
};

TEST(Table2, InitialEnergiesAreThePrintedOnesToAllDigits) {
  for (const auto& [speed, energy] : {std::pair{50.0, 0.5777}, {100.0, 2.3108}, {150.0, 5.1992}, {200.0, 9.2431}}) {
    pintle::Scene s = scene(SliderCrank{.speed = speed, .until = 1e-5});
    EXPECT_NEAR(run(s).run.first.stored(), energy, 0.5e-4) << speed << " rad/s";
  }
}

TEST(Table2, InitialEnergiesAreThoseOfTheFormula) {
  for (const double w : {50.0, 100.0, 150.0, 200.0}) {
    // ½(I₁ + m₁L₁²/4 + m₂L₁²/4 + I₂L₁²/L₂²) ω²
    const double l1 = 0.05, l2 = 0.12, m1 = 0.3, m2 = 0.21, i1 = 1e-4, i2 = 2.5e-4;
    const double inertia = i1 + (m1 + m2) * l1 * l1 / 4 + i2 * l1 * l1 / (l2 * l2);
    const Whole run_ = run(scene(SliderCrank{.speed = w, .until = 1e-5}));
    EXPECT_NEAR(run_.run.first.stored(), inertia * w * w / 2, 1e-12 * inertia * w * w);
  }
}

class Table2At : public testing::TestWithParam<Row> {};
void PrintTo(const Row& r, std::ostream* out) { *out << r.speed << " rad/s"; }

// Losses are printed with one or two digits; 15 per cent or the rounding of the print, whichever is
// more. What the paper calls energy leaves out what the contact stores.
TEST_P(Table2At, LossIsWithinFifteenPerCentOfThePrintedOne) {
  const Row& row = GetParam();
  const Whole w = run(scene(SliderCrank{.speed = row.speed, .tolerance = 1e-9}));
  ASSERT_EQ(w.run.status, pintle::Status::finished) << w.run.reason;
  const auto energy = [](const pintle::Energies& e) { return e.kinetic + e.gravity; };
  const double loss = energy(w.run.first) - energy(w.run.last);
  EXPECT_NEAR(loss, row.loss, std::max(0.15 * row.loss, row.half_digit));
  RecordProperty("loss", std::to_string(loss));
  // Against the independent model, which has no such rounding: the loss of each case converges.
  pintle_oracle::Options tight;
  tight.tolerance = 1e-11;
  const auto p = oracle(SliderCrank{.speed = row.speed});
  pintle_oracle::State state = pintle_oracle::start(p);
  const double before = pintle_oracle::evaluate(p, state).energy;
  const auto stats = pintle_oracle::simulate(p, tight, 0.05, state);
  const double converged = before - pintle_oracle::evaluate(p, state).energy;
  EXPECT_NEAR(loss, converged, 1e-4 * converged);  // energies differ in their last ten digits
  EXPECT_EQ(w.run.impacts.size(), static_cast<std::size_t>(stats.impacts));
}

INSTANTIATE_TEST_SUITE_P(Speeds, Table2At,
                         testing::Values(Row{50, 0.5777, 0.0002, 0.5e-4}, Row{100, 2.3108, 0.0008, 0.5e-4},
                                         Row{150, 5.1992, 0.0019, 0.5e-4}, Row{200, 9.2431, 0.0038, 0.5e-4}),
                         [](const auto& i) { return std::string("RadPerSecond").append(std::to_string(static_cast<int>(i.param.speed))); });

}  // namespace
}  // namespace pintle_scenes::published_test
