// The exam every law of bristles sits, as states at a speed. A new law joins by a line in `BristleLaws`, its parameters in `all_of`, and
// what it says steadily sits the exam of friction laws.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "contact/friction_law.h"

namespace pintle::bristle_law_test {
namespace {

using States = BristleForce::States;

constexpr double infinite = std::numeric_limits<double>::infinity();

template <class Law>
std::vector<Law> all_of();
template <>
std::vector<LuGre> all_of<LuGre>() {
  std::vector<LuGre> laws;
  for (const double mu : {0.05, 0.6})
    for (const double more : {1.0, 1.5, 3.0})
      for (const double stiffness : {1e3, 1e6})
        for (const double damping : {0.0, 20.0, 500.0})
          laws.push_back({mu, more * mu, 1e-3, stiffness, damping, 0.4, gentle_damping_speed(mu, damping)});
  return laws;
}
template <>
std::vector<Gonthier> all_of<Gonthier>() {
  std::vector<Gonthier> laws;
  for (const double mu : {0.05, 0.6})
    for (const double more : {1.0, 1.5, 3.0})
      for (const double stiffness : {1e3, 1e6})
        for (const double damping : {20.0, 500.0}) laws.push_back({mu, more * mu, 1e-3, stiffness, damping, 0.4, 2.0});
  return laws;
}

// Speeds over v_s, deflections over μ_s/σ0, dwells.
constexpr double speeds[] = {0.013, 0.31, 0.97, 1.9, 5.3, 80}, deflections[] = {-1, -0.57, -0.02, 0, 0.11, 0.73, 1},
                 dwells[] = {0, 0.043, 0.52, 1};

template <class Law, class Exam>
void each(Exam exam) {
  for (const Law& law : all_of<Law>())
    for (const double v : speeds)
      for (const double side : {-1.0, 1.0})
        for (const double z : deflections)
          for (const double d : dwells) exam(law, side * v * law.stribeck, States{z * law.mu_static / law.stiffness, d});
}

BristleForce bent(const auto& law, double v, const States& x) { return bend(law, v, x.data()); }

// What force and rates are sums of, at most.
struct Terms {
  double force, rate[2];
};
template <class Law>
Terms terms(const Law& l, double v) {
  const double most = 4 * std::abs(v) + 2 * l.mu_static / std::max(l.damping, 1.0);
  return {2 * l.mu_static + l.damping * most + l.viscous * std::abs(v), {most, 2 + 2 * l.stiffness / std::max(l.damping, 1.0)}};
}

template <class Law>
struct BristleContract : testing::Test {};
using BristleLaws = testing::Types<LuGre, Gonthier>;  // a new law joins here
TYPED_TEST_SUITE(BristleContract, BristleLaws);

TYPED_TEST(BristleContract, IsOdd) {
  each<TypeParam>([](const TypeParam& law, double v, const States& x) {
    const BristleForce there = bent(law, v, x), back = bent(law, -v, {-x[0], x[1]});
    ASSERT_EQ(there.force, -back.force);
    ASSERT_EQ(there.rate[0], -back.rate[0]);
    ASSERT_EQ(there.rate[1], back.rate[1]);
    ASSERT_EQ(there.d_speed, back.d_speed);
  });
}

// Away from where a clip or a change of pace makes a kink: there the two sides differ.
TYPED_TEST(BristleContract, DerivativesAreDifferences) {
  int judged = 0;
  each<TypeParam>([&](const TypeParam& law, double v, const States& x) {
    const BristleForce now = bent(law, v, x);
    const auto differences = [&](double scale, auto moved, double by_force, const States& by_rate, int states) {
      const double h = 1e-6 * scale;
      const BristleForce up = moved(h), down = moved(-h);
      const auto one = [&](double plus, double here, double minus, double slope, double sum) {
        const double forth = plus - here, back = here - minus, rounding = 1e-15 * sum;
        if (std::abs(forth - back) > 1e-4 * (std::abs(forth) + std::abs(back)) + 4 * rounding) return;  // a kink
        ++judged;
        ASSERT_NEAR((plus - minus) / (2 * h), slope, 1e-7 * std::abs(slope) + 1e-11 * sum / scale + rounding / h);
      };
      const Terms sums = terms(law, v);
      one(up.force, now.force, down.force, by_force, sums.force);
      for (std::size_t i = 0; i < static_cast<std::size_t>(states); ++i)
        one(up.rate[i], now.rate[i], down.rate[i], by_rate[i], sums.rate[i]);
    };
    const int states = bristle_states(law);
    differences(
        law.stribeck * std::min(1.0, std::abs(v) / law.stribeck), [&](double h) { return bent(law, v + h, x); }, now.d_speed,
        now.rate_d_speed, states);
    for (std::size_t j = 0; j < static_cast<std::size_t>(states); ++j) {
      const auto moved = [&](double h) {
        States to = x;
        to[j] += h;
        return bent(law, v, to);
      };
      differences(j == 0 ? law.mu_static / law.stiffness : 1, moved, now.d_state[j], {now.rate_d_state[0][j], now.rate_d_state[1][j]},
                  states);
    }
  });
  EXPECT_GT(judged, 5000);
}

// Followed by Euler's implicit steps until they stay, the states give what the law says of steady sliding.
TYPED_TEST(BristleContract, ComesToItsSteadyCurve) {
  for (const TypeParam& law : all_of<TypeParam>())
    for (const double part : speeds) {
      const double v = part * law.stribeck;
      States x{};
      for (int i = 0; i < 200; ++i)
        for (int k = bristle_states(law) - 1; k >= 0; --k) {
          const auto at = static_cast<std::size_t>(k);
          const BristleForce now = bent(law, v, x);
          if (now.rate_d_state[at][at] != 0) x[at] -= now.rate[at] / now.rate_d_state[at][at];
        }
      EXPECT_NEAR(bent(law, v, x).force, evaluate(law, v, 1).force, 1e-9 * law.mu_static) << part;
      EXPECT_EQ(evaluate(FrictionLaw(law), v, 2).force, 2 * evaluate(law, v, 1).force);
    }
}

TYPED_TEST(BristleContract, AtRestIsASpring) {
  for (const TypeParam& law : all_of<TypeParam>()) {
    const States x{0.3 * law.mu / law.stiffness, 1};
    const BristleForce now = bent(law, 0, x);
    EXPECT_NEAR(now.force, -0.3 * law.mu, 1e-15);
    EXPECT_EQ(now.rate[0], 0);
    EXPECT_EQ(now.rate_d_speed[0], 1);
    EXPECT_DOUBLE_EQ(now.d_state[0], -law.stiffness);
    EXPECT_DOUBLE_EQ(now.d_speed, -(law.damping + law.viscous));
  }
}

TEST(LuGre, BendsNoFurtherThanItsBreakaway) {
  each<LuGre>([](const LuGre& law, double v, const States& x) {
    const double most = law.mu_static / law.stiffness;
    if (std::abs(x[0]) < most) return;
    ASSERT_LE(bent(law, v, x).rate[0] * x[0], 1e-12 * std::abs(v) * most);
  });
}

// With what bends the bristles counted as stored, ½ σ0 z², nothing is won, at any speed and deflection that it comes to.
TEST(LuGre, IsPassive) {
  each<LuGre>([](const LuGre& law, double v, const States& x) {
    const BristleForce now = bent(law, v, x);
    const double taken = -now.force * v, stored = law.stiffness * x[0] * now.rate[0];
    ASSERT_GE(taken - stored, -1e-12 * (std::abs(taken) + std::abs(stored)));
  });
}

// With the same damping at all speeds it is so where σ2 ≥ σ1 (μ_s − μ)/μ, and not below, however little below.
TEST(LuGre, OfConstantDampingIsPassiveAboveALeastViscosity) {
  constexpr double mu = 0.2, holds = 0.3, damping = 100, least = damping * (holds - mu) / mu, v = 1e4;
  for (const double part : {1.001, 0.999}) {
    const LuGre law{mu, holds, 1e-3, 1e5, damping, part * least, infinite};
    const States x{holds / law.stiffness};  // just before it broke away
    const BristleForce now = bent(law, v, x);
    EXPECT_EQ(-now.force * v - law.stiffness * x[0] * now.rate[0] > 0, part > 1);
  }
}

// A contact begins with straight bristles.
TEST(LuGre, MeetsWhatSlidesWithNoMoreThanItsCoefficient) {
  for (const LuGre& law : all_of<LuGre>()) {
    double most = 0;
    const double peak = law.damping > 0 ? law.damping_speed / std::numbers::sqrt2 : 1;
    for (const double part : {0.03, 0.5, 0.9, 1.0, 1.1, 2.0, 30.0}) {
      const double v = part * peak;
      most = std::max(most, std::abs(bent(law, v, {}).force) - law.viscous * v);
    }
    EXPECT_NEAR(most, law.damping > 0 ? law.mu : 0, 1e-12);
  }
}

TEST(Gonthier, HoldsNoMoreThanItsDwellAllows) {
  each<Gonthier>([](const Gonthier& law, double v, const States& x) {
    const double most = law.mu + (law.mu_static - law.mu) * x[1] + law.viscous * std::abs(v);
    ASSERT_LE(std::abs(bent(law, v, x).force), most * (1 + 1e-12));
  });
}

}  // namespace
}  // namespace pintle::bristle_law_test
