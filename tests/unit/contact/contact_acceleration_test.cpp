// The accelerations of a contact's opening and slip that moving bodies alone make, against differences of their rates.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <random>
#include <string>

#include "contact/profile.h"
#include "framework/dynamics/model/contact_pair.h"

namespace pintle::contact_acceleration_test {
namespace {

using Eigen::Vector2d;

struct Kind {
  const char* name;
  Piece a, b;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

const Piece disc{.radius = 0.07, .centre = {0.02, -0.03}}, hole{.radius = -0.3, .centre = {-0.04, 0.05}},
    flat{.centre = {-0.02, 0.06}, .normal = -0.7, .half = 0.5, .straight = true};
// Of an egg, or of the hole of its shape.
Piece span(bool inside, std::size_t which, double size = 0.3) {
  std::vector<Vector2d> rim;
  for (int i = 0; i < 12; ++i) {
    const double angle = (inside ? 2 : -2) * M_PI * i / 12, r = size + 0.02 * std::cos(angle);
    rim.emplace_back(0.03 + r * std::cos(angle), -0.02 + r * std::sin(angle));
  }
  return profile_through(rim, true).pieces[which];
}
const Piece egg = span(true, 1), other_egg = span(true, 4), egg_hole = span(false, 2), small_egg = span(true, 1, 0.1);

class ContactAcceleration : public testing::TestWithParam<Kind> {
 protected:
  double unit() { return std::uniform_real_distribution<double>(-1, 1)(generator_); }
  MarkerMotion any() {
    MarkerMotion m{.r = {unit(), unit()}, .d = {0, 0}};
    m.angle = 3 * unit(), m.v = {unit(), unit()}, m.w = 3 * unit(), m.a0 = {unit(), unit()}, m.alpha0 = unit();
    return m;
  }
  static MovingPoint at(const MarkerMotion& m, double t) {
    return {m.r + t * m.v + t * t / 2 * m.a0, m.v + t * m.a0, m.w + t * m.alpha0, m.angle + t * m.w + t * t / 2 * m.alpha0};
  }
  std::mt19937 generator_{5};
};

// Central differences err by h²/6 of third derivatives of the rates, which are 1e5 at most, and by rounding over h: 1e-3 and 1e-9.
TEST_P(ContactAcceleration, IsTheRateOfItsSpeeds) {
  constexpr double h = 1e-6;
  ContactPair pair{};
  pair.gap = {GetParam().a, GetParam().b};
  pair.profiles = true;
  const bool curved = pair.gap.curved();
  int seen = 0;
  for (int draw = 0; draw < (curved ? 2000 : 50); ++draw) {
    MarkerMotion a = any();
    const MarkerMotion b = any();
    const Gap apart = evaluate(pair.gap, at(a, 0), at(b, 0));
    a.r += (1e-3 - apart.depth) * apart.n;
    const Gap gap = evaluate(pair.gap, at(a, 0), at(b, 0));
    if (std::abs(gap.on_a.at) > 1.2 || std::abs(gap.on_b.at) > 1.2) continue;  // where a curve is straight or a corner
    ++seen;
    const Gap after = evaluate(pair.gap, at(a, h), at(b, h)), before = evaluate(pair.gap, at(a, -h), at(b, -h));
    const double opens = -(after.rate - before.rate) / (2 * h), slips = (after.material_slip - before.material_slip) / (2 * h);
    EXPECT_NEAR(opening_acceleration(pair, gap, a, b), opens, 1e-5 * (1 + std::abs(opens))) << draw;
    EXPECT_NEAR(slip_acceleration(pair, gap, a, b), slips, 1e-5 * (1 + std::abs(slips))) << draw;
  }
  EXPECT_GT(seen, 10);
}

// Teeth have no slip, and a depth anywhere.
class ContactAccelerationOfTeeth : public ContactAcceleration {};
TEST_F(ContactAccelerationOfTeeth, IsTheRateOfTheirSpeed) {
  constexpr double h = 1e-6;
  for (const Flank::Teeth& teeth : {Flank::Teeth(RollsOnDisc{{0, 1, 0.3, 0.5}}), Flank::Teeth(RollsOnDisc{{0, 1, 0.3, -0.7}}),
                                    Flank::Teeth(RollsOnDisc{{0, 1, 0.7, -0.3}}), Flank::Teeth(RollsOnLine{{0, 1, -0.3}})})
    for (int draw = 0; draw < 40; ++draw) {
      ContactPair pair{};
      pair.profiles = true;
      pair.flank = Flank{teeth, draw % 2 == 0 ? 1.0 : -1.0, 0.01, draw % 4 < 2 ? 0 : 0.35};
      const MarkerMotion a = any(), b = any();
      if ((b.r - a.r).norm() < 0.3) continue;
      const Gap gap = gap_between(pair, at(a, 0), at(b, 0)), after = gap_between(pair, at(a, h), at(b, h)),
                before = gap_between(pair, at(a, -h), at(b, -h));
      const double closes = (after.depth - before.depth) / (2 * h), opens = -(after.rate - before.rate) / (2 * h);
      if (std::abs(closes) < 100) {  // else the line of centres has gone round
        EXPECT_NEAR(gap.rate, closes, 1e-5 * (1 + std::abs(closes))) << draw;
      }
      EXPECT_NEAR(opening_acceleration(pair, gap, a, b), opens, 1e-5 * (1 + std::abs(opens))) << draw;
      const std::array<Wrench, 2> unit = unit_normal(pair, gap);
      const double power = unit[0].dot(Wrench(a.v.x(), a.v.y(), a.w)) + unit[1].dot(Wrench(b.v.x(), b.v.y(), b.w));
      EXPECT_NEAR(power, -gap.rate, 1e-13 * (1 + std::abs(gap.rate))) << draw;
      EXPECT_NEAR((unit[0] + unit[1]).head<2>().norm(), 0, 1e-14) << draw;
      EXPECT_NEAR(cross(a.r, Vector2d(unit[0].head<2>())) + unit[0][2] + cross(b.r, Vector2d(unit[1].head<2>())) + unit[1][2], 0, 1e-13)
          << draw;
    }
}

INSTANTIATE_TEST_SUITE_P(Every, ContactAcceleration,
                         testing::Values(Kind{"DiscDisc", disc, disc}, Kind{"DiscHole", disc, hole}, Kind{"DiscLine", disc, flat},
                                         Kind{"LineDisc", flat, disc}, Kind{"CurveDisc", egg, disc}, Kind{"DiscCurve", disc, egg},
                                         Kind{"DiscHollowCurve", disc, egg_hole}, Kind{"CurveCurve", egg, other_egg},
                                         Kind{"CurveLine", egg, flat}, Kind{"LineCurve", flat, egg},
                                         Kind{"CurveHollowCurve", small_egg, egg_hole}),
                         [](const auto& p) { return std::string(p.param.name); });

}  // namespace
}  // namespace pintle::contact_acceleration_test
