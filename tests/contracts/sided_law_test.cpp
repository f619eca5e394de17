// The exam of laws that are held on their sides: a new one joins by one line in `laws`.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "framework/scene/units/sided_formula.h"
#include "framework/scene/units/signal_law.h"

namespace pintle::sided_law_test {
namespace {

using Numbers = std::array<double, 2>;

SignalFormula formula(std::vector<Program::Instruction> code) { return SignalFormula(Program{std::move(code)}); }
const Program::Instruction p{Op::input, 0}, q{Op::input, 1};
const SignalFormula of_p = formula({p}), of_q = formula({q}), bent = formula({p, {Op::abs}, q, {Op::add}});
const Samples peaks{{-4, -1, 0, 2, 4}, {1, -2, 5, 0, 3}}, round_trip{{0, 1, 2}, {1, 3, 1}};
const Bilinear hills({{-4, -1, 2, 4}, {-4, 0.5, 4}, {1, 2, 9, -3, 5, 0, 4, 4, -6, 8, 1, 2}});

struct Named {
  const char* name;
  SignalFunction law;
  int switches;
};
void PrintTo(const Named& n, std::ostream* out) { *out << n.name; }
const std::vector<Named> laws{
    {"Formula", formula({p, {Op::abs}, q, p, {Op::max}, {Op::add}, p, q, {Op::less}, {Op::add}}), 3},
    {"Polyline", SignalTable{.table = Polyline(peaks), .over = of_p}, 2},
    {"Spline", SignalTable{.table = Spline(peaks), .over = of_p}, 2},
    {"PeriodicPolyline", periodic_table(round_trip, true, of_p), 2},
    {"PeriodicSpline", periodic_table(round_trip, false, of_p), 2},
    {"TableOverABend", SignalTable{.table = Polyline(peaks), .over = bent}, 3},
    {"RefusingTable", SignalTable{.table = Polyline(peaks), .over = of_p, .outside = Outside::rejected}, 2},
    {"Map", SignalMap{hills, {of_p, of_q}, Outside::holds}, 2},
    {"MapOverBends", SignalMap{hills, {bent, formula({q, p, {Op::min}})}, Outside::holds}, 4},
    {"RefusingMap", SignalMap{hills, {of_p, of_q}, Outside::rejected}, 2},
};

class SidedLaws : public testing::TestWithParam<Named> {
 protected:
  void SetUp() override { ASSERT_NE(law, nullptr); }
  /// Within the tables and outside.
  Numbers drawn() { return {std::uniform_real_distribution(-6.0, 6.0)(random), std::uniform_real_distribution(-6.0, 6.0)(random)}; }
  std::vector<int> sides_at(const Numbers& in) const {
    std::vector<int> side(static_cast<std::size_t>(law->switches()));
    law->find(0, in.data(), side.data());
    return side;
  }
  std::vector<double> left_at(const Numbers& in, const std::vector<int>& side) const {
    std::vector<double> left(side.size());
    law->left(0, in.data(), side.data(), left.data());
    return left;
  }
  std::shared_ptr<const SidedLaw> law = sided(GetParam().law);
  std::mt19937 random{7};
};

// Values up to 30 made of some ten sums.
TEST_P(SidedLaws, AreTheLawOnTheSidesWhereItIs) {
  ASSERT_EQ(law->switches(), GetParam().switches);
  for (int n = 0; n < 300; ++n) {
    const Numbers in = drawn();
    const std::vector<int> side = sides_at(in);
    for (const double left : left_at(in, side)) EXPECT_GT(left, 0);
    Numbers slope{}, plain{};
    const double value = law->value(0, in.data(), slope.data(), side.data()), of_law = GetParam().law(0, in.data(), plain.data());
    ASSERT_EQ(std::isnan(value), std::isnan(of_law)) << in[0] << " " << in[1];
    if (std::isnan(value)) continue;
    EXPECT_NEAR(value, of_law, 1e-12);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(slope[k], plain[k], 1e-10) << in[0] << " " << in[1];
  }
}

// Of a step of 1e-5 from anywhere, the sides of before: on them nothing bends, so differences are derivatives there too.
TEST_P(SidedLaws, GoOnSmoothlyPastTheEndsOfTheirSides) {
  for (int n = 0; n < 300; ++n) {
    const Numbers from = drawn();
    const std::vector<int> side = sides_at(from);
    const Numbers in{from[0] + 0.3, from[1] - 0.2};
    Numbers slope{};
    if (std::isnan(law->value(0, in.data(), slope.data(), side.data()))) continue;
    for (std::size_t k = 0; k < 2; ++k) {
      Numbers more = in, less = in;
      more[k] += 1e-5, less[k] -= 1e-5;
      const double rise = law->value(0, more.data(), nullptr, side.data()) - law->value(0, less.data(), nullptr, side.data());
      EXPECT_NEAR(rise / 2e-5, slope[k], 1e-7);
    }
  }
}

// One switch at a time, the motion crosses its end: then it is as far on its new side, and a law without jumps has the same value.
TEST_P(SidedLaws, SwitchToTheSideBeyond) {
  int crossed = 0;
  for (int n = 0; n < 300; ++n) {
    const Numbers from = drawn(), by{drawn()[0] / 6, drawn()[1] / 6};
    std::vector<int> side = sides_at(from);
    double low = 0, high = 1;
    const auto at = [&](double x) { return Numbers{from[0] + x * by[0], from[1] + x * by[1]}; };
    const auto first_past = [&](double x) {
      const std::vector<double> left = left_at(at(x), side);
      for (std::size_t k = 0; k < left.size(); ++k)
        if (left[k] < 0) return static_cast<int>(k);
      return -1;
    };
    if (first_past(1) < 0) continue;
    for (int i = 0; i < 50; ++i) (first_past((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
    const Numbers there = at(high);
    const int k = first_past(high);
    side[static_cast<std::size_t>(k)] = law->beyond(k, 0, there.data(), side.data());
    EXPECT_EQ(side[static_cast<std::size_t>(k)], sides_at(there)[static_cast<std::size_t>(k)]);
    ++crossed;
  }
  EXPECT_GT(crossed, 30);
}
INSTANTIATE_TEST_SUITE_P(Each, SidedLaws, testing::ValuesIn(laws), [](const auto& named) { return std::string(named.param.name); });

}  // namespace
}  // namespace pintle::sided_law_test
