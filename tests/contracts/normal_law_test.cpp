// The exam every normal law sits. A new factor χ(e) joins by being in impact_factors(), and owes
// one line in `published` below: its curve in tests/data/contact_restitution.json. A law of cylinders owes one line in
// elastic_samples.h, and is damped by every factor.

#include "contact/normal_law.h"
#include "tests/contracts/elastic_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace pintle {

inline void PrintTo(const ImpactFactor& factor, std::ostream* out) { *out << factor.name; }

}  // namespace pintle

namespace pintle::normal_law_test {
namespace {

// Tolerances, all relative.
// A handful of operations on numbers of one size.
constexpr double rounding = 1e-12;
// Central difference: 1e-10 cut-off and 1e-11 rounding at the step below, and room for n.
constexpr double difference = 1e-7;
// The table's χ: one formula in double precision.
constexpr double tabulated = 1e-13;
// The table's roots: its own lose digits as e nears 1, 4e-11 of χ at e = 0.99.
constexpr double table_root = 1e-10;
// RK4 over one impact. δ^1.5 is not smooth at touch, so the step gives 5e-7 instead of 1e-11.
constexpr double integration = 1e-6;

constexpr double step_of_difference = 1e-5;  // relative

// ---- parameters over decades ----------------------------------------------------------------

const std::array stiffnesses{1e3, 1e7, 1e11};           // [N/mⁿ]
const std::array exponents{1.0, 10.0 / 9, 1.5, 2.0};    // –
const std::array depths{1e-9, 1e-7, 1e-5, 1e-3, 1e-2};  // [m]
const std::array impact_rates{1e-6, 1e-2, 10.0};        // [m/s]
// rate / impact_rate: beyond −1/χ the force is clamped, and beyond 1 the contact was driven deeper.
const std::array rate_ratios{-30.0, -1.3, -0.9, -0.3, -0.01, 0.0, 0.02, 0.5, 1.0, 1.7};
const std::array restitutions{0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0};

/// A law and what the exam knows of it.
struct Candidate {
  NormalLaw law;
  std::string name;
  double chi, n;                                  ///< exponent at touch
  std::function<double(double)> published_force;  ///< of a depth, without damping [N]
  operator const NormalLaw&() const { return law; }
};

template <class F>
void for_laws(double chi, F exam) {
  for (double k : stiffnesses)
    for (double n : exponents)
      exam(Candidate{ImpactLaw{.k = k, .n = n, .chi = chi}, "k " + std::to_string(k) + ", n " + std::to_string(n), chi, n,
                     [k, n](double depth) { return k * std::pow(depth, n); }});
  for (const elastic_samples::Sample& sample : elastic_samples::all()) {
    DampedLaw law = sample.law;
    law.chi = chi;
    exam(Candidate{law, sample.name, chi, sample.exponent, sample.force});
  }
}

template <class F>
void for_approaches_over_decades(const ImpactFactor& factor, F exam) {
  for (double e : restitutions)
    for_laws(factor.chi(e), [&](const Candidate& law) {
      for (double depth : depths)
        for (double impact_rate : impact_rates)
          for (double ratio : rate_ratios) exam(law, Approach{depth, ratio * impact_rate, impact_rate});
    });
}

std::string describe(const Candidate& law, const Approach& at) {
  return law.name + ", chi " + std::to_string(law.chi) + ", depth " + std::to_string(at.depth * 1e9) + " nm, rate " +
         std::to_string(at.rate / at.impact_rate) + " of " + std::to_string(at.impact_rate);
}

double elastic_force(const Candidate& law, double depth) { return law.published_force(depth); }
double damping_factor(const Candidate& law, const Approach& at) { return 1 + law.chi * at.rate / at.impact_rate; }

// ---- an impact of a free mass, integrated here -----------------------------------------------

struct Impact {
  double mass, speed;  // [kg], [m/s]
};
struct Rebound {
  double restitution;  // rebound speed over impact speed, –
  double deepest;      // [m]
  double duration;     // [s]
  double lost;         // ∫ dissipation dt [J]
};

// m δ̈ = −f from touch to the next crossing of δ = 0, classical Runge–Kutta on (δ, δ̇, ∫
// dissipation).
Rebound integrate(const NormalLaw& law, const Impact& impact) {
  using Y = std::array<double, 3>;
  const auto rates = [&](const Y& y) {
    const NormalForce f = evaluate(law, {y[0], y[1], impact.speed});
    return Y{y[1], -f.force / impact.mass, f.dissipation};
  };
  const auto plus = [](const Y& y, double h, const Y& d) { return Y{y[0] + h * d[0], y[1] + h * d[1], y[2] + h * d[2]}; };
  const double length = depth_reached(law, 1 / impact.mass, impact.speed);
  constexpr double step = 1.8e-3;  // in units of length / speed
  Rebound out{0, 0, 0, 0};
  for (Y y{0, impact.speed, 0};;) {
    const double h = step * length / impact.speed;
    const Y a = rates(y), b = rates(plus(y, h / 2, a)), c = rates(plus(y, h / 2, b)), d = rates(plus(y, h, c));
    Y next;
    for (std::size_t i = 0; i < y.size(); ++i) next[i] = y[i] + h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    if (next[0] <= 0) {
      const double part = y[0] / (y[0] - next[0]);
      out.restitution = -(y[1] + part * (next[1] - y[1])) / impact.speed;
      out.duration += part * h;
      out.lost = next[2];
      return out;
    }
    y = next;
    out.deepest = std::max(out.deepest, y[0]);
    out.duration += h;
  }
}

// ---- the exam ---------------------------------------------------------------------------------

struct NormalLawContract : testing::TestWithParam<ImpactFactor> {};

TEST_P(NormalLawContract, IsZeroAtAndBeforeTouch) {
  for_approaches_over_decades(GetParam(), [](const Candidate& law, Approach at) {
    for (double depth : {-at.depth, -0.0, 0.0}) {
      at.depth = depth;
      const NormalForce f = evaluate(law, at);
      ASSERT_EQ(f.force, 0) << describe(law, at);
      ASSERT_EQ(f.stored, 0) << describe(law, at);
      ASSERT_EQ(f.dissipation, 0) << describe(law, at);
      ASSERT_EQ(f.d_rate, 0) << describe(law, at);
      ASSERT_EQ(f.d_depth, 0) << describe(law, at);
    }
  });
}

TEST_P(NormalLawContract, NeverPulls) {
  int clamped = 0;
  for_approaches_over_decades(GetParam(), [&](const Candidate& law, const Approach& at) {
    const NormalForce f = evaluate(law, at);
    ASSERT_GE(f.force, 0) << describe(law, at);
    if (damping_factor(law, at) < 0) {
      ++clamped;
      ASSERT_EQ(f.force, 0) << describe(law, at);
      ASSERT_EQ(f.d_depth, 0) << describe(law, at);
      ASSERT_EQ(f.d_rate, 0) << describe(law, at);
    }
  });
  const bool can_clamp = GetParam().chi(0.5) > 0;
  EXPECT_EQ(clamped > 0, can_clamp) << "did the exam reach the clamp?";
}

TEST_P(NormalLawContract, PushesAsItsFormulaSays) {
  for_approaches_over_decades(GetParam(), [](const Candidate& law, const Approach& at) {
    const double size = elastic_force(law, at.depth);
    const double factor = std::max(damping_factor(law, at), 0.0);
    // The damping factor is a sum of two terms: rounding counts against the larger.
    const double terms = 1 + std::abs(law.chi * at.rate / at.impact_rate);
    ASSERT_NEAR(evaluate(law, at).force, size * factor, rounding * size * terms) << describe(law, at);
  });
}

TEST_P(NormalLawContract, DerivativesAreDifferencesOfTheForce) {
  int judged = 0;
  for_approaches_over_decades(GetParam(), [&](const Candidate& law, const Approach& at) {
    const double h = step_of_difference;
    const double margin = law.chi * std::abs(at.rate) / at.impact_rate + law.chi;
    if (std::abs(damping_factor(law, at)) < 2 * h * (margin + 1)) return;  // at the clamp's kink
    ++judged;
    const NormalForce f = evaluate(law, at);
    const double size = elastic_force(law, at.depth) * (1 + margin);

    const double dd = h * at.depth;
    const double by_depth =
        (evaluate(law, {at.depth + dd, at.rate, at.impact_rate}).force - evaluate(law, {at.depth - dd, at.rate, at.impact_rate}).force) /
        (2 * dd);
    ASSERT_NEAR(f.d_depth, by_depth, difference * size / at.depth) << describe(law, at);

    const double dr = h * at.impact_rate;
    const double by_rate =
        (evaluate(law, {at.depth, at.rate + dr, at.impact_rate}).force - evaluate(law, {at.depth, at.rate - dr, at.impact_rate}).force) /
        (2 * dr);
    ASSERT_NEAR(f.d_rate, by_rate, difference * size / at.impact_rate) << describe(law, at);
  });
  EXPECT_GT(judged, 0);
}

TEST_P(NormalLawContract, StoredPlusLostIsWorkDone) {
  for_approaches_over_decades(GetParam(), [](const Candidate& law, const Approach& at) {
    const NormalForce f = evaluate(law, at);
    const double dd = step_of_difference * at.depth;
    const double stored_rate =
        (evaluate(law, {at.depth + dd, at.rate, at.impact_rate}).stored - evaluate(law, {at.depth - dd, at.rate, at.impact_rate}).stored) /
        (2 * dd) * at.rate;
    const double size = std::abs(stored_rate) + std::abs(f.dissipation);
    ASSERT_NEAR(stored_rate + f.dissipation, f.force * at.rate, difference * size) << describe(law, at);
  });
}

// What callers ask instead of constants, against the force itself.
TEST_P(NormalLawContract, AnswersAgreeWithItsForce) {
  for_laws(GetParam().chi(0.7), [](const Candidate& law) {
    for (const double depth : depths) {
      SCOPED_TRACE(law.name + " at " + std::to_string(depth * 1e9) + " nm");
      const NormalForce still = evaluate(law, {depth, 0, 1});
      const auto near = [](double a, double b) { EXPECT_NEAR(a, b, rounding * std::abs(b)); };
      near(depth_storing(law, still.stored), depth);
      near(stiffness_of_equal_energy(law, depth) * depth * depth / 2, still.stored);
      near(stiffness_at(law, depth), still.d_depth);
      for (const double lightness : {1e-3, 40.0}) {
        const double speed = speed_to_reach(law, lightness, depth);
        near(speed * speed / 2, lightness * still.stored);
        near(depth_reached(law, lightness, speed), depth);
      }
      const NormalForce moving = evaluate(law, {depth, 0.3, 0.2});
      near(moving.force, still.force * (1 + damping_share(law, 0.3, 0.2)));
      EXPECT_FALSE(begins_with_jump(law));
      near(restitution_of(law, 3), effective_restitution(law.chi));
      const double part = part_of_depth(law, 1e-9, 1e-3);
      near(1e-3 * (1 + law.chi) * std::pow(part, law.n + 1), 1e-9);
    }
  });
}

TEST_P(NormalLawContract, NeverReturnsMoreThanItTook) {
  for_approaches_over_decades(GetParam(), [](const Candidate& law, const Approach& at) {
    const NormalForce f = evaluate(law, at);
    ASSERT_GE(f.dissipation, 0) << describe(law, at);
    ASSERT_GT(f.stored, 0) << describe(law, at);
    ASSERT_EQ(f.dissipation > 0, law.chi > 0 && at.rate != 0) << describe(law, at);
  });
}

TEST_P(NormalLawContract, FactorIsDefinedOnItsDomain) {
  const ImpactFactor& factor = GetParam();
  EXPECT_EQ(factor.chi(1), 0) << "e = 1 loses nothing";
  EXPECT_EQ(std::isfinite(factor.chi(0)), factor.zero_allowed);
  for (double e : restitutions) {
    EXPECT_TRUE(std::isfinite(factor.chi(e))) << "e = " << e;
    EXPECT_GE(factor.chi(e), 0) << "e = " << e;
  }
}

TEST_P(NormalLawContract, AsksForMoreLossWhereLessRestitutionIsAsked) {
  const ImpactFactor& factor = GetParam();
  for (std::size_t i = 1; i < restitutions.size(); ++i)
    EXPECT_GE(factor.chi(restitutions[i - 1]), factor.chi(restitutions[i])) << "e = " << restitutions[i];
}

TEST_P(NormalLawContract, ImpactReboundsWithTheEffectiveRestitution) {
  const ImpactFactor& factor = GetParam();
  for (double e : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const ImpactLaw law{.k = 6.6e10, .n = 1.5, .chi = factor.chi(e)};
    const Rebound rebound = integrate(law, {.mass = 0.14, .speed = 0.3});
    EXPECT_NEAR(rebound.restitution, effective_restitution(law.chi), integration) << "nominal e = " << e << ", chi = " << law.chi;
  }
}

TEST_P(NormalLawContract, RestitutionDependsOnNothingButChi) {
  for_laws(GetParam().chi(0.6), [](const Candidate& law) {
    for (const Impact& impact : {Impact{1e-4, 5.0}, Impact{20.0, 1e-3}})
      EXPECT_NEAR(integrate(law, impact).restitution, effective_restitution(law.chi), integration)
          << law.name << ", mass " << impact.mass << ", speed " << impact.speed;
  });
}

TEST_P(NormalLawContract, EnergyBooksCloseThroughAnImpact) {
  const Impact impact{.mass = 0.14, .speed = 0.3};
  const double brought = impact.mass * impact.speed * impact.speed / 2;
  for (double e : {0.2, 0.8}) {
    const Rebound r = integrate(ImpactLaw{.k = 6.6e10, .n = 1.5, .chi = GetParam().chi(e)}, impact);
    EXPECT_NEAR(r.lost / brought, 1 - r.restitution * r.restitution, integration) << "e = " << e;
  }
}

// ---- published curves -------------------------------------------------------------------------

// Every factor's line: its name in the table, or nothing if it loses nothing at any e.
const std::map<std::string_view, std::optional<std::string>> published{
    {"hertz", std::nullopt},
    {"hunt-crossley", "Hunt-Crossley 1975"},
    {"herbert-mcwhannell", "Herbert-McWhannell 1977"},
    {"lee-wang", "Lee-Wang 1983"},
    {"lankarani-nikravesh", "Lankarani-Nikravesh 1990"},
    {"gonthier", "Gonthier et al 2004 (approx)"},
    {"zhiying-qishao", "Zhiying-Qishao 2006"},
    {"flores", "Flores et al 2011"},
    {"hu-guo", "Hu-Guo 2015"},
    {"exact", "chi_exact"},
};

const nlohmann::json& table() {
  static const nlohmann::json data = [] {
    std::ifstream file(PINTLE_SOURCE_DIR "/tests/data/contact_restitution.json");
    return nlohmann::json::parse(file);
  }();
  return data;
}

TEST_P(NormalLawContract, FollowsItsPublishedCurve) {
  const ImpactFactor& factor = GetParam();
  ASSERT_TRUE(published.contains(factor.name)) << "add a line for it to `published`";
  const std::optional<std::string>& key = published.at(factor.name);
  if (!key) {
    for (double e : restitutions) EXPECT_EQ(factor.chi(e), 0) << "nominal e = " << e;
    return;
  }

  const bool exact = *key == "chi_exact";
  const auto nominal = table().at("e_in").get<std::vector<double>>();
  const auto chi = (exact ? table().at(*key) : table().at(*key).at("chi")).get<std::vector<double>>();
  const auto effective = exact ? nominal : table().at(*key).at("e_out").get<std::vector<double>>();
  ASSERT_EQ(chi.size(), nominal.size());
  ASSERT_EQ(effective.size(), nominal.size());
  for (std::size_t i = 0; i < nominal.size(); ++i) {
    EXPECT_NEAR(factor.chi(nominal[i]), chi[i], (exact ? table_root : tabulated) * chi[i]) << "nominal e = " << nominal[i];
    EXPECT_NEAR(effective_restitution(factor.chi(nominal[i])), effective[i], table_root * effective[i]) << "nominal e = " << nominal[i];
  }
}

std::string test_name(const testing::TestParamInfo<ImpactFactor>& info) {
  std::string name(info.param.name);
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
}
INSTANTIATE_TEST_SUITE_P(EveryFactor, NormalLawContract, testing::ValuesIn(impact_factors().begin(), impact_factors().end()), test_name);

TEST(ImpactFactors, EveryTableRowIsSatFor) {
  for (const auto& [name, key] : published) EXPECT_NE(find_impact_factor(name), nullptr) << name << " is judged but not offered";
}

TEST(HertzImpact, DepthAndDurationAreTheClosedForms) {
  const double k = 6.6e10, mass = 0.14, speed = 0.3;
  const double deepest = std::pow(5 * mass * speed * speed / (4 * k), 0.4);
  // 2 ∫₀¹ dx/√(1 − x^{5/2}) = (4/5) √π Γ(2/5)/Γ(9/10)
  const double quadrature = 0.8 * std::sqrt(std::acos(-1.0)) * std::tgamma(0.4) / std::tgamma(0.9);
  const Rebound r = integrate(ImpactLaw{.k = k, .n = 1.5, .chi = 0}, {mass, speed});
  EXPECT_NEAR(r.deepest / deepest, 1, integration);
  EXPECT_NEAR(r.duration / (quadrature * deepest / speed), 1, integration);
}

}  // namespace
}  // namespace pintle::normal_law_test
