#include "framework/scene/units/table.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "framework/scene/error.h"
#include "tests/refusal.h"

namespace pintle::table_test {
namespace {

using pintle_test::expect_says;

namespace fs = std::filesystem;

// A table file that lives as long as the test.
struct TableFile {
  explicit TableFile(const std::string& text)
      : path(fs::temp_directory_path() /
             (std::string("pintle_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv")) {
    std::ofstream(path, std::ios::binary) << text;
  }
  ~TableFile() { fs::remove(path); }
  TableFile(const TableFile&) = delete;
  TableFile& operator=(const TableFile&) = delete;
  fs::path path;
};

std::string refusal(const std::string& text) {
  const TableFile file(text);
  return pintle_test::refusal_by([&] { read_samples(file.path, 1, 1, "drivers.motor.law"); });
}

Samples sampled(double (*f)(double), int n, double end) {
  Samples s;
  for (int i = 0; i <= n; ++i) {
    // Uneven on purpose.
    const double t = end * (i + 0.3 * std::sin(2.0 * i) * (i > 0 && i < n)) / n;
    s.t.push_back(t);
    s.value.push_back(f(t));
  }
  return s;
}

TEST(Table, ReadsCommasBlanksHeaderAndComments) {
  const TableFile file("time [s], torque [N m]\r\n# measured\n0, 1\n0.5;\t2  # half\n\n+1.0 3e0\n");
  const Samples s = read_samples(file.path);
  EXPECT_EQ(s.t, (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(s.value, (std::vector<double>{1, 2, 3}));
}

TEST(Table, UnitsScaleTheColumns) {
  const TableFile file("0 1\n2 3\n");
  const Samples s = read_samples(file.path, 1e-3, 10);
  EXPECT_EQ(s.t[1], 2e-3);
  EXPECT_EQ(s.value[1], 30);
}

TEST(Table, NamesFileLineKeyAndRemedy) {
  expect_says(refusal("0 1\n1 nan\n"), {".csv:2: drivers.motor.law:", "not finite", "correct"});
  expect_says(refusal("0 1\n1 inf\n"), {".csv:2:", "not finite"});
  expect_says(refusal("nan 1\n1 2\n"), {".csv:1:", "not finite"});
  expect_says(refusal("0 1\n1 2\n1 3\n"), {".csv:3:", "times must increase"});
  expect_says(refusal("0 1\n1 2 3\n"), {".csv:2:", "3 columns", "write two"});
  expect_says(refusal("0 1\n1 two\n"), {".csv:2:", "\"two\" is not a number"});
  expect_says(refusal("0 1\n"), {"at least two"});
  expect_says(refusal("\n \n"), {"is empty"});
  expect_says(refusal(std::string("0 1\n1 \0 2\n", 9)), {".csv:2:", "is not text"});
}

TEST(Table, MissingFileIsNamed) {
  pintle_test::expect_refused([] { read_samples("no/such/table.csv", 1, 1, "drivers.motor.law"); },
                              {"no/such/table.csv", "drivers.motor.law", "no such file"});
}

TEST(Spline, MeetsACubicExactlyWithBothDerivatives) {
  const auto cubic = [](double t) { return 2 - 3 * t + 0.5 * t * t + 4 * t * t * t; };
  for (const int n : {3, 4, 7, 20}) {
    const Spline spline(sampled(cubic, n, 2.0));
    for (double t = 0; t <= 2; t += 0.0625) {
      const Jet jet = spline(t);
      EXPECT_NEAR(jet.value, cubic(t), 1e-11) << n << " samples, t = " << t;
      EXPECT_NEAR(jet.rate, -3 + t + 12 * t * t, 1e-10) << n << " samples, t = " << t;
      EXPECT_NEAR(jet.accel, 1 + 24 * t, 1e-9) << n << " samples, t = " << t;
    }
  }
}

TEST(Spline, TwoSamplesAreALineAndThreeAParabola) {
  const Jet line = Spline(Samples{{0, 2}, {1, 5}})(0.5);
  EXPECT_DOUBLE_EQ(line.value, 2);
  EXPECT_DOUBLE_EQ(line.rate, 2);
  EXPECT_EQ(line.accel, 0);
  const Jet parabola = Spline(Samples{{0, 1, 3}, {0, 1, 9}})(2);
  EXPECT_NEAR(parabola.value, 4, 1e-14);
  EXPECT_NEAR(parabola.rate, 4, 1e-14);
  EXPECT_NEAR(parabola.accel, 2, 1e-14);
}

TEST(Spline, PassesThroughItsSamplesWithTwoContinuousDerivatives) {
  const Samples samples = sampled([](double t) { return std::sin(3 * t); }, 12, 3.0);
  const Spline spline(samples);
  constexpr double near = 1e-9;  // accel changes by less than 1e2 · near across it
  for (std::size_t i = 1; i + 1 < samples.t.size(); ++i) {
    const Jet left = spline(samples.t[i] - near), right = spline(samples.t[i] + near);
    EXPECT_NEAR(spline(samples.t[i]).value, samples.value[i], 1e-15);
    EXPECT_NEAR(left.rate, right.rate, 1e2 * near);
    EXPECT_NEAR(left.accel, right.accel, 1e3 * near);
  }
}

// Theory: value order 4, rate 3, accel 2. Slope of log error over halving.
TEST(Spline, ConvergesAtItsOrder) {
  const auto errors = [](int n) {
    Samples samples;
    for (int i = 0; i <= n; ++i) {
      samples.t.push_back(3.0 * i / n);
      samples.value.push_back(std::sin(9.0 * i / n));
    }
    const Spline spline(samples);
    std::array<double, 3> worst{};
    for (double t = 0; t <= 3; t += 0.001) {
      const Jet jet = spline(t);
      worst[0] = std::max(worst[0], std::abs(jet.value - std::sin(3 * t)));
      worst[1] = std::max(worst[1], std::abs(jet.rate - 3 * std::cos(3 * t)));
      worst[2] = std::max(worst[2], std::abs(jet.accel + 9 * std::sin(3 * t)));
    }
    return worst;
  };
  const auto coarse = errors(200), fine = errors(800);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(std::log2(coarse[k] / fine[k]) / 2, 4.0 - static_cast<double>(k), 0.1) << k;
}

TEST(Spline, HoldsItsEndValuesOutside) {
  const Spline spline(sampled([](double t) { return std::exp(t); }, 9, 1.0));
  for (const double t : {-5.0, -1e-12}) {
    EXPECT_EQ(spline(t).value, 1);
    EXPECT_EQ(spline(t).rate, 0);
  }
  EXPECT_EQ(spline(1 + 1e-12).value, std::exp(1.0));
  EXPECT_EQ(spline(2).accel, 0);
}

TEST(Polyline, JoinsSamplesByStraightLines) {
  const Polyline line(Samples{{0, 1, 3}, {0, 2, 0}});
  EXPECT_DOUBLE_EQ(line(0.25).value, 0.5);
  EXPECT_DOUBLE_EQ(line(0.25).rate, 2);
  EXPECT_DOUBLE_EQ(line(2).value, 1);
  EXPECT_DOUBLE_EQ(line(2).rate, -1);
  EXPECT_EQ(line(2).accel, 0);
  EXPECT_EQ(line(9).value, 0);
}

}  // namespace
}  // namespace pintle::table_test
