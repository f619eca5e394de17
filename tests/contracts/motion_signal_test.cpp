// The exam every signal sits: a new one joins by one line in `kinds`.
#include "framework/dynamics/model/signals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <set>

#include "framework/dynamics/model/signal_values.h"
#include "framework/scene/units/signal_law.h"
#include "tests/contracts/moving_bodies.h"

namespace pintle::motion_signal_test {
namespace {

using Kind = MotionSignal::Kind;
using Vector12 = Eigen::Matrix<double, 12, 1>;  // poses and rates of a, of b

struct Named {
  const char* name;
  Kind kind;
  Kind place = Kind::state;  ///< of which it is the rate
};
void PrintTo(const Named& n, std::ostream* out) { *out << n.name; }
const Named kinds[] = {{"X", Kind::x},
                       {"VX", Kind::vx, Kind::x},
                       {"Y", Kind::y},
                       {"VY", Kind::vy, Kind::y},
                       {"Angle", Kind::angle},
                       {"Speed", Kind::speed, Kind::angle},
                       {"Length", Kind::length},
                       {"LengthRate", Kind::length_rate, Kind::length},
                       {"Twist", Kind::relative_angle},
                       {"TwistRate", Kind::relative_speed, Kind::relative_angle},
                       {"Along", Kind::along},
                       {"Across", Kind::across}};

MovingPoint part(const Vector12& z, Eigen::Index from) { return {z.segment<2>(from), z.segment<2>(from + 3), z[from + 5], z[from + 2]}; }
double value(Kind kind, const Vector12& z) { return signal_value({kind, 0, 1, 0.4}, part(z, 0), part(z, 6)); }
Vector12 drawn(Draw& draw) {
  Vector12 z;
  do z << draw.pose(), draw.rates(), draw.pose(), draw.rates();
  while ((z.segment<2>(0) - z.segment<2>(6)).norm() < 0.3);
  return z;
}
Vector12 slope(Kind kind, const Vector12& z) {
  const SignalSlope s = signal_slope({kind, 0, 1}, part(z, 0), part(z, 6));
  Vector12 out;
  out << s.pose_a, s.rate_a, s.pose_b, s.rate_b;
  return out;
}

class Signals : public testing::TestWithParam<Named> {};

// Central differences over 1e-5: 1e-10 of third derivatives up to 1e3 (lengths of 0.3), rounding 1e-11 of values up to 10.
TEST_P(Signals, DerivativesAreDifferences) {
  Draw draw(11);
  for (int n = 0; n < 50; ++n) {
    const Vector12 z = drawn(draw), ours = slope(GetParam().kind, z);
    for (int i = 0; i < 12; ++i) {
      const Vector12 by = 1e-5 * Vector12::Unit(i);
      EXPECT_NEAR(ours[i], (value(GetParam().kind, z + by) - value(GetParam().kind, z - by)) / 2e-5, 1e-7 * (1 + ours.norm())) << n;
    }
  }
}

// A rate is what the derivatives of its place make of the rates.
TEST_P(Signals, RatesFollowFromPlaces) {
  const Kind place = GetParam().place;
  if (place == Kind::state) return;
  Draw draw(12);
  for (int n = 0; n < 50; ++n) {
    const Vector12 z = drawn(draw), of_place = slope(place, z);
    const double rate = of_place.segment<3>(0).dot(z.segment<3>(3)) + of_place.segment<3>(6).dot(z.segment<3>(9));
    EXPECT_NEAR(value(GetParam().kind, z) + 0.4, rate, 1e-13 * (1 + std::abs(rate)));
  }
}
INSTANTIATE_TEST_SUITE_P(Each, Signals, testing::ValuesIn(kinds), [](const auto& one) { return one.param.name; });

TEST(Signals, EveryKindSitsTheExam) {
  std::set<Kind> seen;
  for (const Named& n : kinds) seen.insert(n.kind);
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(Kind::state));  // which has no markers
}

TEST(SignalTable, OfOnePeriodComesAgainAndIsSmoothWhereItCloses) {
  Samples samples;
  const double pi = std::acos(-1.0);
  for (int i = 0; i <= 72; ++i) samples.t.push_back(2 * pi * i / 72), samples.value.push_back(std::sin(samples.t.back()));
  samples.value.back() = samples.value.front();
  Formula formula(Dimension{});
  const SignalTable table = periodic_table(samples, false, SignalFormula(formula.program(formula.input("angle", Dimension{}))));
  // A cubic spline of step h errs by 5/384 h⁴ of the fourth derivative, its slope by h³/24.
  const double h = 2 * pi / 72;
  for (const double x : {-1e4, -7.0, -1e-9, 0.0, 1e-9, 3.3, 2 * pi - 1e-9, 6.5, 1e4}) {
    double slope = 0;
    EXPECT_NEAR(table(0, &x, &slope), std::sin(x), 1.1 * 5.0 / 384 * std::pow(h, 4) + 1e-11) << x;
    EXPECT_NEAR(slope, std::cos(x), 1.1 * std::pow(h, 3) / 24 + 1e-11) << x;
  }
}

}  // namespace
}  // namespace pintle::motion_signal_test
