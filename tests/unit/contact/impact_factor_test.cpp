// What the family of impact laws shares: its factors by name, the restitution they deliver, the stiffness.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "contact/normal_law.h"

namespace pintle::impact_factor_test {
namespace {

// A handful of operations on numbers of one size, relative.
constexpr double rounding = 1e-12;

TEST(ImpactFactors, AreFoundByTheirNamesOnly) {
  for (const ImpactFactor& factor : impact_factors()) {
    EXPECT_EQ(find_impact_factor(factor.name), &factor) << factor.name;
    EXPECT_FALSE(factor.source.empty()) << factor.name;
  }
  EXPECT_EQ(find_impact_factor("lankarani"), nullptr);
  EXPECT_EQ(find_impact_factor(""), nullptr);
}

TEST(ExactFactor, DeliversTheRestitutionItIsGiven) {
  const ImpactFactor& exact = *find_impact_factor("exact");
  // From almost plastic (1 − χe underflows) to almost elastic (χ itself is as small as 1 − e).
  for (double e : {1e-6, 1e-3, 0.02, 0.05, 0.3, 0.6, 0.8, 0.85, 0.9, 0.999, 1 - 1e-9})
    EXPECT_NEAR(effective_restitution(exact.chi(e)), e, rounding * e) << "e = " << e;
}

TEST(ExactFactor, MeetsHuntCrossleyWhereLittleIsLost) {
  // χ = 3(1 − e)/2 · (1 + O(1 − e)): the leading term of the impact's balance.
  const ImpactFactor& exact = *find_impact_factor("exact");
  for (double loss : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const double e = 1 - loss;
    EXPECT_NEAR(exact.chi(e) / (1.5 * (1 - e)), 1, 2 * loss + rounding) << "1 - e = " << loss;
  }
}

TEST(EffectiveRestitution, IsOneWithoutLossAndFallsWithChi) {
  EXPECT_EQ(effective_restitution(0), 1);
  double before = 1;
  for (double chi = 1e-12; chi < 1e9; chi *= 1.25) {
    const double e = effective_restitution(chi);
    EXPECT_LT(e, before) << "chi = " << chi;
    EXPECT_GT(e, 0) << "chi = " << chi;
    before = e;
  }
}

TEST(EffectiveRestitution, SolvesTheBalanceOfAnImpact) {
  // Judged as 1 − χe = (1 + χ) exp[−χ(1 + e)]; both sides lie in (0, 1].
  for (double chi = 1e-3; chi < 1e4; chi *= 1.1) {
    const double e = effective_restitution(chi);
    EXPECT_NEAR(1 - chi * e, (1 + chi) * std::exp(-chi * (1 + e)), rounding) << "chi = " << chi;
  }
}

TEST(EffectiveRestitution, HasTheKnownLimits) {
  for (double chi : {1e-4, 1e-8, 1e-12})  // 1 − 2χ/3, next term of order χ²
    EXPECT_NEAR(effective_restitution(chi), 1 - 2 * chi / 3, chi * chi + rounding) << chi;
  for (double chi : {50.0, 1e3, 1e6, 1e12})  // 1/χ, next term of order exp(−χ)
    EXPECT_NEAR(effective_restitution(chi) * chi, 1, rounding) << chi;
}

TEST(EffectiveRestitution, IsContinuousWhereTheMethodChanges) {
  for (double chi = 0.299; chi < 0.301; chi += 1e-5) {
    const double h = 1e-7;
    const double jump = effective_restitution(chi + h) - effective_restitution(chi - h);
    // |de/dχ| is below 2/3 everywhere and about 0.45 here.
    EXPECT_LT(jump, -0.3 * 2 * h) << "chi = " << chi;
    EXPECT_GT(jump, -0.7 * 2 * h) << "chi = " << chi;
  }
}

TEST(NormalLaw, SquareRootShortcutAgreesWithThePower) {
  const double nearly = std::nextafter(1.5, 2.0);
  for (double depth : {1e-9, 1e-7, 1e-5, 1e-3, 1e-2}) {  // [m]
    const Approach at{depth, 0.1, 0.2};
    const NormalForce fast = evaluate(ImpactLaw{.k = 1e9, .n = 1.5, .chi = 0.4}, at);
    const NormalForce slow = evaluate(ImpactLaw{.k = 1e9, .n = nearly, .chi = 0.4}, at);
    EXPECT_NEAR(fast.force / slow.force, 1, rounding);
    EXPECT_NEAR(fast.stored / slow.stored, 1, rounding);
    EXPECT_NEAR(fast.d_depth / slow.d_depth, 1, rounding);
  }
}

TEST(HertzStiffness, OfASteelJournalInItsBearingIsThePublishedOne) {
  // 6.61e10 N/m^1.5 for a 10 mm bearing with 0.5 mm clearance; printed to three digits.
  const double half_digit = 0.005e10;
  EXPECT_NEAR(hertz_stiffness(9.5e-3, 10e-3, 207e9, 0.3, 207e9, 0.3, true), 6.61e10, half_digit);
}

TEST(HertzStiffness, OfASphereOnAPlaneIsReachedFromBothSides) {
  const double radius = 0.02, young = 70e9, nu = 0.33, flat = 1e12;  // [m], [Pa], –, [m]
  const double on_plane = 2 * young / (3 * (1 - nu * nu)) * std::sqrt(radius);
  for (bool internal : {true, false}) EXPECT_NEAR(hertz_stiffness(radius, flat, young, nu, young, nu, internal) / on_plane, 1, rounding);
}

TEST(HertzStiffness, OfEqualSpheresIsThatOfHalfTheRadius) {
  const double radius = 0.02, young = 70e9, nu = 0.33;
  EXPECT_NEAR(hertz_stiffness(radius, radius, young, nu, young, nu, false) / (2 * young / (3 * (1 - nu * nu)) * std::sqrt(radius / 2)), 1,
              rounding);
}

TEST(HertzStiffness, GrowsAsTheBearingCloses) {
  double before = 0;
  for (double c : {5e-3, 5e-4, 5e-5, 5e-6}) {
    const double inside = hertz_stiffness(0.01 - c, 0.01, 207e9, 0.3, 207e9, 0.3, true);
    EXPECT_GT(inside, before);
    EXPECT_GT(inside, hertz_stiffness(0.01 - c, 0.01, 207e9, 0.3, 207e9, 0.3, false));
    before = inside;
  }
}

TEST(HertzStiffness, PutsTheTwoSolidsInSeries) {
  const double rigid = std::numeric_limits<double>::infinity();
  const auto stiffness = [](double young_i, double nu_i, double young_j, double nu_j) {
    return hertz_stiffness(9e-3, 10e-3, young_i, nu_i, young_j, nu_j, true);
  };
  const double both = stiffness(207e9, 0.3, 70e9, 0.33);
  const double first = stiffness(207e9, 0.3, rigid, 0.3), second = stiffness(rigid, 0.3, 70e9, 0.33);
  EXPECT_NEAR(both * (1 / first + 1 / second), 1, rounding);
}

}  // namespace
}  // namespace pintle::impact_factor_test
