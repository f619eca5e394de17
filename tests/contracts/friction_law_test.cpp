// The exam every friction law sits. A new law joins by a line in `Laws` and its parameters in
// `over_decades`.

#include "contact/friction_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

namespace pintle::friction_law_test {
namespace {

// Tolerances, relative to μN.
// A handful of operations.
constexpr double rounding = 1e-12;
// Central difference over 1e-5 of the ramp: 1e-11 of rounding, no cut-off on a straight line.
constexpr double difference = 1e-7;

const std::array coefficients{0.0, 0.01, 0.1, 1.5};
const std::array speeds{1e-5, 1e-2, 1.0};  // [m/s]

template <class Law>
std::vector<Law> over_decades();
template <>
std::vector<Ambrosio> over_decades<Ambrosio>() {
  std::vector<Ambrosio> laws;
  for (double mu : coefficients)
    for (double v1 : speeds)
      for (double start : {0.0, 0.1, 0.9}) laws.push_back({.mu = mu, .v0 = start * v1, .v1 = v1});
  return laws;
}
template <class Law>
std::vector<Law> curves() {
  std::vector<Law> laws;
  for (double mu : coefficients)
    for (double v1 : speeds) laws.push_back({.mu = mu, .v1 = v1});
  return laws;
}
template <>
std::vector<Threlfall> over_decades<Threlfall>() {
  return curves<Threlfall>();
}
template <>
std::vector<HyperbolicTangent> over_decades<HyperbolicTangent>() {
  return curves<HyperbolicTangent>();
}
template <>
std::vector<BengisuAkay> over_decades<BengisuAkay>() {
  std::vector<BengisuAkay> laws;
  for (double mu : coefficients)
    for (double more : {1.0, 2.0})
      for (double v0 : speeds)
        for (double v1 : speeds) laws.push_back({.mu = mu, .mu_static = more * mu, .v0 = v0, .v1 = v1});
  return laws;
}
template <>
std::vector<Coulomb> over_decades<Coulomb>() {
  std::vector<Coulomb> laws;
  for (double mu : coefficients)
    for (double more : {1.0, 2.0})
      for (double stribeck : {0.0, 1e-5, 1e-2, 1.0}) laws.push_back({.mu = mu, .mu_static = more * mu, .stribeck = stribeck});
  return laws;
}

template <>
std::vector<LuGre> over_decades<LuGre>() {
  std::vector<LuGre> laws;
  for (double mu : {0.01, 0.1, 1.5})
    for (double more : {1.0, 2.0})
      for (double stribeck : speeds) laws.push_back({.mu = mu, .mu_static = more * mu, .stribeck = stribeck, .damping = 100});
  return laws;
}
template <>
std::vector<Gonthier> over_decades<Gonthier>() {
  std::vector<Gonthier> laws;
  for (double mu : {0.01, 0.1, 1.5})
    for (double more : {1.0, 2.0})
      for (double stribeck : speeds)
        for (double damping : {1e-2, 1.0, 300.0})
          laws.push_back({.mu = mu, .mu_static = more * mu, .stribeck = stribeck, .damping = damping});
  return laws;
}

// A law as the exam sees it: a speed that scales it; the least speed over which it changes by its whole; from where it is μN; the
// largest coefficient; where it has kinks.
struct Shape {
  double scale, ramp, whole, most;
  std::vector<double> kinks = {};
};
Shape shape(const Ambrosio& l) { return {l.v1, l.v1 - l.v0, l.v1, l.mu, {l.v0, l.v1}}; }
Shape shape(const Threlfall& l) { return {l.v1, l.v1 / 3, 12 * l.v1, l.mu, {0}}; }
Shape shape(const HyperbolicTangent& l) { return {l.v1, l.v1, 20 * l.v1, l.mu}; }
Shape shape(const BengisuAkay& l) { return {l.v0, std::min(l.v0, l.v1) / 2, l.v0 + 40 * l.v1, l.mu_static, {0, l.v0}}; }
Shape shape(const Coulomb& l) {
  const double v = l.stribeck > 0 ? l.stribeck : 1e-3;
  return {v, v, 7 * l.stribeck, l.mu_static};
}

Shape shape(const LuGre& l) { return {l.stribeck, l.stribeck, 7 * l.stribeck, l.mu_static}; }
// Where damping and what the bristles hold at most cross: σ1 v = (μ_s − μ)(1 − exp(−(v/v_s)²)), twice or never.
Shape shape(const Gonthier& l) {
  Shape out{l.stribeck, l.stribeck / 2, 7 * l.stribeck, l.mu_static};
  const auto free = [&](double x) { return l.damping * x * l.stribeck < (l.mu_static - l.mu) * -std::expm1(-x * x); };
  constexpr double lowest = 1.1209;  // of x/(1 − exp(−x²))
  if (!free(lowest)) return out;
  for (const double end : {0.0, (l.mu_static - l.mu) / (l.damping * l.stribeck)}) {
    double in = lowest, beyond = end;
    for (int i = 0; i < 100; ++i) (free((in + beyond) / 2) ? in : beyond) = (in + beyond) / 2;
    out.kinks.push_back(in * l.stribeck);
  }
  return out;
}

const std::array normals{0.0, 1e-6, 1.0, 1e5};  // [N]
// |v| over the law's speed: at rest, creeping, on the ramp, at its ends, sliding.
const std::array speed_ratios{0.0, 1e-6, 0.05, 0.1, 0.2, 0.5, 0.9, 0.95, 1.0, 1.1, 30.0, 1e6};

template <class Law>
std::string describe(const Law& law, double v, double normal) {
  return "mu " + std::to_string(law.mu) + ", v over its speed " + std::to_string(v / shape(law).scale) + ", N " + std::to_string(normal);
}

template <class Law, class F>
void for_slips_over_decades(F exam) {
  for (const Law& law : over_decades<Law>())
    for (double normal : normals)
      for (double ratio : speed_ratios)
        for (double v : {ratio * shape(law).scale, -ratio * shape(law).scale}) exam(law, v, normal);
}

template <class Law>
struct FrictionLawContract : testing::Test {};
template <class Law>
struct FrictionCurveContract : testing::Test {};
template <class Law>
struct GrowingFrictionContract : testing::Test {};
using Laws = testing::Types<Ambrosio, Threlfall, HyperbolicTangent, BengisuAkay, Coulomb, LuGre, Gonthier>;  // a new law joins here
using Curves = testing::Types<Ambrosio, Threlfall, HyperbolicTangent, BengisuAkay>;  // … and here, if it goes through 0
using Growing = testing::Types<Ambrosio, Threlfall, HyperbolicTangent>;              // … and here, if it has no peak
TYPED_TEST_SUITE(FrictionLawContract, Laws);
TYPED_TEST_SUITE(FrictionCurveContract, Curves);
TYPED_TEST_SUITE(GrowingFrictionContract, Growing);

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
    ASSERT_LE(std::abs(evaluate(law, v, normal).force), shape(law).most * normal * (1 + rounding)) << describe(law, v, normal);
  });
}

TYPED_TEST(FrictionLawContract, ReachesTheConeWhenSliding) {
  for_slips_over_decades<TypeParam>([](const TypeParam& law, double v, double normal) {
    if (v == 0 || std::abs(v) < shape(law).whole) return;
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
    for (double ratio : speed_ratios) EXPECT_EQ(evaluate(law, ratio * shape(law).scale, 0).force, 0);
  }
}

TYPED_TEST(FrictionCurveContract, IsContinuousInSpeed) {
  for_slips_over_decades<TypeParam>([](const TypeParam& law, double v, double normal) {
    const auto [scale, ramp, whole, most, kinks] = shape(law);
    const double h = 1e-9 * ramp;
    const double jump = evaluate(law, v + h, normal).force - evaluate(law, v - h, normal).force;
    // The steepest slope allowed is the cone's width over the ramp; near |v| >> v1, h may round to
    // 0.
    const double steepest = 2 * h * most * normal / ramp;
    ASSERT_LE(std::abs(jump), steepest * (1 + difference) + rounding * most * normal) << describe(law, v, normal);
  });
}

TYPED_TEST(FrictionLawContract, DerivativesAreDifferencesOfTheForce) {
  int judged = 0;
  for_slips_over_decades<TypeParam>([&](const TypeParam& law, double v, double normal) {
    const Shape known = shape(law);
    const double ramp = known.ramp, h = 1e-5 * ramp;
    const FrictionForce f = evaluate(law, v, normal);

    const double dn = normal == 0 ? 1.0 : normal / 2;
    const double by_normal = (evaluate(law, v, normal + dn).force - evaluate(law, v, normal).force) / dn;
    ASSERT_NEAR(f.d_normal, by_normal, difference * known.most) << describe(law, v, normal);

    const bool jumps = (std::is_same_v<TypeParam, Coulomb> || std::is_same_v<TypeParam, LuGre> ||
                        std::is_same_v<TypeParam, Gonthier>)&&std::abs(v) < 2 * h;
    const bool at_kink = std::ranges::any_of(known.kinks, [&](double kink) { return std::abs(std::abs(v) - kink) < 2 * h; });
    const bool unresolved = std::abs(v) > 1e3 * ramp;  // v ± h differs from v by rounding alone
    if (jumps || at_kink || unresolved) return;
    ++judged;
    const double by_speed = (evaluate(law, v + h, normal).force - evaluate(law, v - h, normal).force) / (2 * h);
    ASSERT_NEAR(f.d_speed, by_speed, difference * known.most * normal / ramp) << describe(law, v, normal);
  });
  EXPECT_GT(judged, 0);
}

TYPED_TEST(GrowingFrictionContract, NeverWeakensWithSpeedOrLoad) {
  for_slips_over_decades<TypeParam>([](const TypeParam& law, double v, double normal) {
    const FrictionForce f = evaluate(law, v, normal);
    ASSERT_LE(f.d_speed, 0) << describe(law, v, normal);
    ASSERT_LE(f.d_normal * v, 0) << describe(law, v, normal);
  });
}

// Past the point where the slip turns, sliding goes on as before it.
TEST(Coulomb, OfADirectionIsSmoothWhereTheSlipTurns) {
  for (const Coulomb& law : over_decades<Coulomb>()) {
    const double v = 1e-6 * shape(law).scale;
    for (double direction : {-1.0, 1.0}) {
      EXPECT_EQ(evaluate(law, direction * v, 10, direction).force, evaluate(law, direction * v, 10).force);
      EXPECT_EQ(evaluate(law, -direction * v, 10, direction).force, evaluate(law, direction * v, 10, direction).force);
      EXPECT_EQ(evaluate(law, 0, 10, direction).force, -direction * (law.stribeck > 0 ? law.mu_static : law.mu) * 10);
    }
  }
}

TEST(Coulomb, IsWhatTheVariantIs) {
  const FrictionLaw law = Coulomb{0.2, 0.3, 0.1};
  EXPECT_EQ(evaluate(law, 0.05, 7).force, evaluate(Coulomb{0.2, 0.3, 0.1}, 0.05, 7).force);
  EXPECT_EQ(coefficient_of(law), 0.2);
}

// The peak of a parabola, then a fall by 1/e in v1.
TEST(BengisuAkay, PeaksAtItsFirstSpeed) {
  const BengisuAkay law{.mu = 0.2, .mu_static = 0.5, .v0 = 1e-3, .v1 = 1e-2};
  EXPECT_NEAR(evaluate(law, 1e-3, 10).force, -5, 1e-12);
  EXPECT_NEAR(evaluate(law, 0.5e-3, 10).force, -0.75 * 5, 1e-12);
  EXPECT_NEAR(evaluate(law, 11e-3, 10).force, -(2 + 3 * std::exp(-1.0)), 1e-12);
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
