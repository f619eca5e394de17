#include "contact/normal_law.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

namespace pintle {

NormalForce evaluate(const ImpactLaw& law, const Approach& at) {
  if (at.depth <= 0) {
    if (!(law.d > 0 && at.rate > 0)) return {};
    return {.force = law.d * at.rate, .dissipation = law.d * at.rate * at.rate, .d_depth = law.n == 1 ? law.k : 0, .d_rate = law.d};
  }
  assert(at.impact_rate > 0);
  const double power = law.n == 1.5 ? at.depth * std::sqrt(at.depth) : std::pow(at.depth, law.n);
  const double elastic = law.k * power;
  const double loss = law.chi / at.impact_rate;  // [s/m]
  const double factor = 1 + loss * at.rate, damper = law.d * at.rate;

  NormalForce out;
  out.stored = elastic * at.depth / (law.n + 1);
  if (elastic * factor + damper <= 0) {  // clamped: the stored energy released here is lost
    out.dissipation = -elastic * at.rate;
    return out;
  }
  out.force = elastic * factor + damper;
  out.dissipation = (elastic * loss + law.d) * at.rate * at.rate;
  out.d_depth = law.n * (elastic / at.depth) * factor;
  out.d_rate = elastic * loss + law.d;
  return out;
}

double depth_storing(const ImpactLaw& law, double energy) { return std::pow((law.n + 1) * energy / law.k, 1 / (law.n + 1)); }
double stiffness_of_equal_energy(const ImpactLaw& law, double depth) { return 2 * law.k * std::pow(depth, law.n - 1) / (law.n + 1); }
double stiffness_at(const ImpactLaw& law, double depth) { return law.n * law.k * std::pow(depth, law.n - 1); }
bool begins_with_jump(const ImpactLaw& law) { return law.d > 0; }
double damping_share(const ImpactLaw& law, double rate, double impact_rate) { return law.chi * rate / impact_rate; }
double viscous_damping(const ImpactLaw& law) { return law.d; }
double depth_reached(const ImpactLaw& law, double lightness, double speed) {
  return std::pow((law.n + 1) * speed * speed / (2 * lightness * law.k), 1 / (law.n + 1));
}
double speed_to_reach(const ImpactLaw& law, double lightness, double depth) {
  return std::sqrt(2 * lightness * law.k * std::pow(depth, law.n + 1) / (law.n + 1));
}
double part_of_depth(const ImpactLaw& law, double tolerance, double missed) {
  return std::pow(tolerance / (missed * (1 + law.chi)), 1 / (law.n + 1));
}

double restitution_of(const ImpactLaw& law, double mass) {
  return law.d > 0 ? linear_restitution(law.d / (2 * std::sqrt(law.k * mass))) : effective_restitution(law.chi);
}

std::string stiffness_text(const ImpactLaw& law, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, law.n == 1 ? "%.*g N/m" : "%.*g N/m^%.*g", digits, law.k, digits, law.n);
  return text;
}

std::vector<std::pair<std::string, double>> constants_of(const ImpactLaw& law) {
  return {{"stiffness [N/m^n]", law.k}, {"exponent", law.n}, {"hysteresis factor", law.chi}, {"damping [N s/m]", law.d}};
}

namespace {

/// Has the sign of  ln[(1 + χ)/(1 − χe)] − χ(1 + e)  for χ > 0, 0 < χe ≤ 1. It increases with e; as a function of χ it changes once from
/// negative to positive.
double impact_balance(double chi, double e) {
  constexpr double series_below = 0.3;  // above it the logarithms lose less than two digits
  if (chi > series_below) return std::log1p(chi) - std::log1p(-chi * e) - chi * (1 + e);
  // Divided by χ², with the leading term in a form that keeps its accuracy as e approaches 1:
  //   −(1 − e)(1 + e)/2 + χ(1 + e³)/3 − χ²(1 − e⁴)/4 + χ³(1 + e⁵)/5 − …
  double sum = -(1 - e) * (1 + e) / 2;
  double chi_power = 1, e_power = e * e, sign = -1;
  for (int k = 3; chi_power > std::numeric_limits<double>::epsilon() * chi; ++k) {
    chi_power *= chi;
    e_power *= e;
    sign = -sign;
    sum += chi_power * (sign + e_power) / k;
  }
  return sum;
}

/// The point where `balance` changes from negative to positive, to the last bit. Bisection: only a few roots are needed when a scene is
/// built, and Newton's method fails because of the logarithm's pole at χe = 1.
template <class F>
double sign_change(double low, double high, F balance) {
  for (;;) {
    const double middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) return middle;
    (balance(middle) < 0 ? low : high) = middle;
  }
}

double exact_chi(double e) {
  if (e >= 1) return 0;
  if (e <= 0) return std::numeric_limits<double>::infinity();
  return sign_change(0, 1 / e, [e](double chi) { return impact_balance(chi, e); });
}

constexpr std::array factors{
    ImpactFactor{"hertz", [](double) { return 0.0; }, true, "Hertz 1881"},
    ImpactFactor{"hunt-crossley", [](double e) { return 3 * (1 - e) / 2; }, true, "Hunt and Crossley 1975"},
    ImpactFactor{"herbert-mcwhannell", [](double e) { return 6 * (1 - e) / ((2 * e - 1) * (2 * e - 1) + 3); }, true,
                 "Herbert and McWhannell 1977"},
    ImpactFactor{"lee-wang", [](double e) { return 3 * (1 - e) / 4; }, true, "Lee and Wang 1983"},
    ImpactFactor{"lankarani-nikravesh", [](double e) { return 3 * (1 - e) * (1 + e) / 4; }, true, "Lankarani and Nikravesh 1990"},
    ImpactFactor{"gonthier", [](double e) { return (1 - e) * (1 + e) / e; }, false, "Gonthier et al. 2004, as usually simplified"},
    ImpactFactor{"zhiying-qishao", [](double e) { return 3 * (1 - e) * (1 + e) * std::exp(2 * (1 - e)) / 4; }, true,
                 "Zhiying and Qishao 2006"},
    ImpactFactor{"flores", [](double e) { return 8 * (1 - e) / (5 * e); }, false, "Flores et al. 2011"},
    ImpactFactor{"hu-guo", [](double e) { return 3 * (1 - e) / (2 * e); }, false, "Hu and Guo 2015"},
    ImpactFactor{"exact", exact_chi, false, "solved from the impact: docs/theory/contact.md"},
};

}  // namespace

std::span<const ImpactFactor> impact_factors() { return factors; }

const ImpactFactor* find_impact_factor(std::string_view name) {
  const auto found = std::find_if(factors.begin(), factors.end(), [name](const ImpactFactor& f) { return f.name == name; });
  return found == factors.end() ? nullptr : &*found;
}

double effective_restitution(double chi) {
  assert(chi >= 0);
  if (chi <= 0) return 1;
  return sign_change(0, std::min(1.0, 1 / chi), [chi](double e) { return impact_balance(chi, e); });
}

// δ̈ = 0 ends the contact: with ζ = sin a at ωt = π − 2a, where −δ̇/δ̇₀ is the decay so far; likewise with ζ = cosh b at Ωt = 2b.
double linear_restitution(double zeta) {
  assert(zeta >= 0);
  if (zeta < 1) {
    const double a = std::asin(zeta);
    return std::exp(-std::tan(a) * (std::numbers::pi - 2 * a));
  }
  const double b = std::acosh(zeta);
  return b > 0 ? std::exp(-2 * b / std::tanh(b)) : std::exp(-2.0);
}

double damping_ratio(double e) {
  assert(e > 0 && e <= 1);
  if (e >= 1) return 0;
  // For e ≪ 1, e → 1/(4ζ²), so 1/√e is an upper bound.
  return sign_change(0, std::max(1.0, 1 / std::sqrt(e)), [e](double zeta) { return e - linear_restitution(zeta); });
}

double hertz_stiffness(double R, double young_i, double nu_i, double young_j, double nu_j) {
  const double h = (1 - nu_i * nu_i) / young_i + (1 - nu_j * nu_j) / young_j;
  return 4 / (3 * h) * std::sqrt(R);
}

double hertz_stiffness(double journal_radius, double bearing_radius, double young_i, double nu_i, double young_j, double nu_j,
                       bool internal) {
  const double signed_sum = internal ? bearing_radius - journal_radius : bearing_radius + journal_radius;
  return hertz_stiffness(journal_radius * bearing_radius / signed_sum, young_i, nu_i, young_j, nu_j);
}

}  // namespace pintle
