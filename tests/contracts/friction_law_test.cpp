// The exam every friction law sits. A new law joins by a line in `Laws` and its parameters in
// `over_decades`.

#include "contact/friction_law.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace pintle::friction_law_test {
namespace {

// Tolerances, relative to μN.
// A handful of operations.
constexpr double rounding = 1e-12;
// Central difference over 1e-5 of the ramp: 1e-11 of rounding, no cut-off on a straight line.
constexpr double difference = 1e-7;

template <class Law>
std::vector<Law> over_decades();
template <>
std::vector<Ambrosio> over_decades<Ambrosio>() {
  std::vector<Ambrosio> laws;
  for (double mu : {0.0, 0.01, 0.1, 1.5})
    for (double v1 : {1e-5, 1e-2, 1.0})
      for (double start : {0.0, 0.1, 0.9}) laws.push_back({.mu = mu, .v0 = start * v1, .v1 = v1});
  return laws;
}

const std::array normals{0.0, 1e-6, 1.0, 1e5};  // [N]
// |v| / v1: at rest, creeping, on the ramp, at its ends, sliding.
const std::array speed_ratios{0.0, 1e-6, 0.05, 0.1, 0.2, 0.5, 0.9, 0.95, 1.0, 1.1, 30.0, 1e6};

std::string describe(const Ambrosio& law, double v, double normal) {
  return "mu " + std::to_string(law.mu) + ", v0/v1 " + std::to_string(law.v0 / law.v1) + ", v/v1 " + std::to_string(v / law.v1) + ", N " +
         std::to_string(normal);
}

template <class Law, class F>
void for_slips_over_decades(F exam) {
  for (const Law& law : over_decades<Law>())
    for (double normal : normals)
      for (double ratio : speed_ratios)
        for (double v : {ratio * law.v1, -ratio * law.v1}) exam(law, v, normal);
}

template <class Law>
struct FrictionLawContract : testing::Test {};
using Laws = testing::Types<Ambrosio>;  // a new law joins here
TYPED_TEST_SUITE(FrictionLawContract, Laws);

TYPED_TEST(FrictionLawContract, OpposesSlip) {
  int pulled = 0;
  for_slips_over_decades<TypeParam>([&](const TypeParam& law, double v, double normal) {
    const double force = evaluate(law, v, normal).force;
    ASSERT_LE(force * v, 0) << describe(law, v, normal);
    if (force != 0) ++pulled;
  });
  EXPECT_GT(pulled, 0) << "a law without any force passes no exam";
}

TYPED_TEST(FrictionLawContract, StaysInsideTheCone) {
  for_slips_over_decades<TypeParam>([](const TypeParam& law, double v, double normal) {
    ASSERT_LE(std::abs(evaluate(law, v, normal).force), law.mu * normal * (1 + rounding)) << describe(law, v, normal);
  });
}

TYPED_TEST(FrictionLawContract, ReachesTheConeWhenSliding) {
  for_slips_over_decades<TypeParam>([](const TypeParam& law, double v, double normal) {
    if (std::abs(v) < law.v1) return;
    ASSERT_NEAR(std::abs(evaluate(law, v, normal).force), law.mu * normal, rounding * law.mu * normal) << describe(law, v, normal);
  });
}

TYPED_TEST(FrictionLawContract, IsOddInSpeed) {
  for_slips_over_decades<TypeParam>([](const TypeParam& law, double v, double normal) {
    const FrictionForce there = evaluate(law, v, normal), back = evaluate(law, -v, normal);
    ASSERT_EQ(there.force, -back.force) << describe(law, v, normal);
    ASSERT_EQ(there.d_speed, back.d_speed) << describe(law, v, normal);
    ASSERT_EQ(there.d_normal, -back.d_normal) << describe(law, v, normal);
  });
}

TYPED_TEST(FrictionLawContract, IsNothingAtRestAndWithoutLoad) {
  for (const TypeParam& law : over_decades<TypeParam>()) {
    for (double normal : normals) EXPECT_EQ(evaluate(law, 0, normal).force, 0);
    for (double ratio : speed_ratios) EXPECT_EQ(evaluate(law, ratio * law.v1, 0).force, 0);
  }
}

TYPED_TEST(FrictionLawContract, IsContinuousInSpeed) {
  for_slips_over_decades<TypeParam>([](const TypeParam& law, double v, double normal) {
    const double h = 1e-9 * (law.v1 - law.v0);
    const double jump = evaluate(law, v + h, normal).force - evaluate(law, v - h, normal).force;
    // The steepest slope allowed is the cone's width over the ramp; near |v| >> v1, h may round to
    // 0.
    const double steepest = 2 * h * law.mu * normal / (law.v1 - law.v0);
    ASSERT_LE(std::abs(jump), steepest * (1 + difference) + rounding * law.mu * normal) << describe(law, v, normal);
  });
}

TYPED_TEST(FrictionLawContract, DerivativesAreDifferencesOfTheForce) {
  int judged = 0;
  for_slips_over_decades<TypeParam>([&](const TypeParam& law, double v, double normal) {
    const double ramp = law.v1 - law.v0, h = 1e-5 * ramp;
    const FrictionForce f = evaluate(law, v, normal);

    const double dn = normal == 0 ? 1.0 : normal / 2;
    const double by_normal = (evaluate(law, v, normal + dn).force - evaluate(law, v, normal).force) / dn;
    ASSERT_NEAR(f.d_normal, by_normal, difference * law.mu) << describe(law, v, normal);

    const bool at_kink = std::abs(std::abs(v) - law.v0) < 2 * h || std::abs(std::abs(v) - law.v1) < 2 * h;
    const bool unresolved = std::abs(v) > 1e3 * law.v1;  // v ± h differs from v by rounding alone
    if (at_kink || unresolved) return;
    ++judged;
    const double by_speed = (evaluate(law, v + h, normal).force - evaluate(law, v - h, normal).force) / (2 * h);
    ASSERT_NEAR(f.d_speed, by_speed, difference * law.mu * normal / ramp) << describe(law, v, normal);
  });
  EXPECT_GT(judged, 0);
}

TYPED_TEST(FrictionLawContract, NeverWeakensWithSpeedOrLoad) {
  for_slips_over_decades<TypeParam>([](const TypeParam& law, double v, double normal) {
    const FrictionForce f = evaluate(law, v, normal);
    ASSERT_LE(f.d_speed, 0) << describe(law, v, normal);
    ASSERT_LE(f.d_normal * v, 0) << describe(law, v, normal);
  });
}

TEST(Ambrosio, CreepsFreelyBelowItsFirstSpeed) {
  const Ambrosio law{.mu = 0.3, .v0 = 1e-3, .v1 = 1e-2};
  for (double v : {1e-6, 5e-4, 1e-3}) {
    EXPECT_EQ(evaluate(law, v, 100).force, 0);
    EXPECT_EQ(evaluate(law, v, 100).d_normal, 0);
  }
}

TEST(Ambrosio, RisesInAStraightLineBetweenItsSpeeds) {
  const Ambrosio law{.mu = 0.3, .v0 = 1e-3, .v1 = 1e-2};
  const double normal = 100;
  for (double part : {0.1, 0.25, 0.5, 0.75, 0.99}) {
    const double v = law.v0 + part * (law.v1 - law.v0);
    EXPECT_NEAR(evaluate(law, v, normal).force, -part * law.mu * normal, rounding * law.mu * normal);
  }
}

}  // namespace
}  // namespace pintle::friction_law_test
