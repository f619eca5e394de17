// The spring and damper that does not pull, beside the exam of the laws of impact in normal_law_test.cpp.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/normal_law.h"

namespace pintle::spring_damper_law_test {
namespace {

// Relative: a handful of operations on numbers of one size; RK4 over one impact.
constexpr double rounding = 1e-12, integration = 1e-6;

const std::array stiffnesses{1e3, 1e7, 1e11};           // [N/m]
const std::array depths{1e-9, 1e-7, 1e-5, 1e-3, 1e-2};  // [m]
// d = 2 ζ √(k m), from light damping to more than critical.
const std::array damping_ratios{0.0, 1e-3, 0.1, 0.5, 0.99, 1.0, 1.01, 4.0};

ImpactLaw spring_damper(double k, double mass, double zeta) { return {.k = k, .n = 1, .chi = 0, .d = 2 * zeta * std::sqrt(k * mass)}; }

TEST(SpringDamperLaw, IsASpringAndADamperThatDoNotPull) {
  for (double k : stiffnesses)
    for (double d : {0.0, 1e-2, 10.0, 1e4})
      for (double depth : depths)
        for (double rate : {-10.0, -1e-2, -1e-6, 0.0, 1e-6, 1e-2, 10.0}) {
          const ImpactLaw law{.k = k, .n = 1, .chi = 0, .d = d};
          const NormalForce f = evaluate(law, {depth, rate, 1});
          const double terms = k * depth + d * std::abs(rate), push = k * depth + d * rate;
          ASSERT_NEAR(f.force, std::max(push, 0.0), rounding * terms)
              << "k " << k << ", d " << d << ", depth " << depth << ", rate " << rate;
          ASSERT_NEAR(f.stored, k * depth * depth / 2, rounding * f.stored);
          ASSERT_GE(f.dissipation, 0);
          ASSERT_NEAR(k * depth * rate + f.dissipation, f.force * rate, rounding * terms * std::abs(rate));
          if (std::abs(push) < rounding * terms) continue;
          ASSERT_NEAR(f.d_depth, push > 0 ? k : 0, rounding * k);
          ASSERT_NEAR(f.d_rate, push > 0 ? d : 0, rounding * d);
        }
}

TEST(SpringDamperLaw, BeginsWithItsDamperAndEndsWithNothing) {
  const ImpactLaw law{.k = 1e6, .n = 1, .chi = 0, .d = 30};
  for (double depth : {0.0, -1e-12}) {
    EXPECT_EQ(evaluate(law, {depth, 0.2, 0.2}).force, 6);
    EXPECT_EQ(evaluate(law, {depth, -0.2, 0.2}).force, 0);
    EXPECT_EQ(evaluate(law, {depth, 0.2, 0.2}).stored, 0);
  }
}

// Until its force has fallen to zero, not until it has come back to the wall.
TEST(SpringDamperLaw, ImpactReboundsWithTheLinearRestitution) {
  for (double zeta : damping_ratios) {
    constexpr double mass = 0.14, speed = 0.3;
    const ImpactLaw law = spring_damper(3e6, mass, zeta);
    double depth = 0, rate = speed;
    const double h = 1e-3 * std::sqrt(mass / law.k) / std::max(1.0, zeta);
    const auto accel = [&](double x, double v) { return -(law.k * x + law.d * v) / mass; };
    while (accel(depth, rate) <= 0) {
      const double a1 = accel(depth, rate), v2 = rate + h / 2 * a1, a2 = accel(depth + h / 2 * rate, v2), v3 = rate + h / 2 * a2,
                   a3 = accel(depth + h / 2 * v2, v3), v4 = rate + h * a3, a4 = accel(depth + h * v3, v4);
      depth += h / 6 * (rate + 2 * v2 + 2 * v3 + v4);
      rate += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    EXPECT_NEAR(-rate / speed, linear_restitution(zeta), integration) << "zeta " << zeta;
  }
}

TEST(SpringDamperLaw, AnswersForItself) {
  const ImpactLaw law{.k = 4e5, .n = 1, .d = 30};
  EXPECT_TRUE(begins_with_jump(law));
  EXPECT_EQ(viscous_damping(law), 30);
  EXPECT_EQ(damping_share(law, 0.4, 0.1), 0);
  EXPECT_DOUBLE_EQ(restitution_of(law, 2), linear_restitution(30 / (2 * std::sqrt(4e5 * 2))));
  EXPECT_EQ(stiffness_text(law), "400000 N/m");
  EXPECT_EQ(stiffness_text({.k = 1e10, .n = 1.5}), "1e+10 N/m^1.5");
}

TEST(SpringDamperLaw, DampingRatioIsTheInverseOfTheRestitution) {
  for (double e : {1e-8, 1e-3, 0.05, std::exp(-2.0), 0.3, 0.7, 0.9, 0.999, 1.0})
    EXPECT_NEAR(linear_restitution(damping_ratio(e)), e, rounding * e) << e;
  EXPECT_EQ(damping_ratio(1), 0);
  EXPECT_EQ(linear_restitution(0), 1);
}

}  // namespace
}  // namespace pintle::spring_damper_law_test
