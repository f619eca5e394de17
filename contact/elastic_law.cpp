#include "contact/elastic_law.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace pintle {

namespace {

ElasticForce elastic(const PowerForce& law, double depth) {
  const double force = law.k * std::pow(depth, law.n);
  return {force, force * depth / (law.n + 1), law.n * force / depth};
}

/// The root u ≥ 2 of u − ln u = L. The function is convex, so Newton's method converges to the root from above; after a step of 1e-8 the
/// next is only rounding.
double logarithm_of_force(double L) {
  double u = L + std::log(L + std::log(L) + 1);
  for (;;) {
    const double next = u * (L - 1 + std::log(u)) / (u - 1);
    if (!(u - next > 1e-8 * u)) return next;
    u = next;
  }
}

// With F = G e⁻ᵘ: Sδ/G = u e⁻ᵘ, dF/dδ = S/(u − 1), ∫F dδ = F²(2u − 1)/(4S).
ElasticForce elastic(const LogarithmicForce& law, double depth) {
  const double straight = law.G * std::exp(-2.0), begin = 2 * straight / law.S;
  if (depth >= begin) {
    const double more = depth - begin, force = straight + law.S * more;
    return {force, 3 * straight * straight / (4 * law.S) + more * (straight + force) / 2, law.S};
  }
  const double u = logarithm_of_force(-std::log(law.S / law.G * depth)), force = law.S * depth / u;
  return {force, force * force * (2 * u - 1) / (4 * law.S), law.S / (u - 1)};
}

// With y = δ/(ΔR + δ): ∫F dδ = ⅖ Fδ ₂F₁(½, 1; 7/2; y), in closed form for y above a few tenths.
ElasticForce elastic(const WideningForce& law, double depth) {
  constexpr double series_below = 0.2;
  const double c = law.clearance, y = depth / (c + depth), force = law.k * depth * std::sqrt(y);
  const double stiffness = force / depth * (1.5 - y / 2);
  if (y > series_below) {
    const double z = depth / c, s = std::sqrt(z);
    return {force, law.k * c * c / 4 * (s * std::sqrt(1 + z) * (2 * z - 3) + 3 * std::asinh(s)), stiffness};
  }
  double sum = 0, term = 1;
  for (int m = 0; term > std::numeric_limits<double>::epsilon() / 8; ++m) {
    sum += term;
    term *= y * (m + 0.5) / (m + 3.5);
  }
  return {force, 0.4 * force * depth * sum, stiffness};
}

// With w = 2φ₀: F = ½ k e (w − sin w), ∫F dδ = ¼ k e² (w (2 + cos w) − 3 sin w), dF/dδ = ½ k (w + sin w); for small w by the series of both
// brackets, Σ (−1)ⁿ⁺¹ w²ⁿ⁺¹/(2n + 1)! and Σ (−1)ⁿ (2n − 2) w²ⁿ⁺¹/(2n + 1)!.
ElasticForce elastic(const FoundationForce& law, double depth) {
  constexpr double series_below = 2;
  const double e = law.clearance + depth, w = 2 * half_angle(law, depth);
  double segment = w - std::sin(w), moment = w * (2 + std::cos(w)) - 3 * std::sin(w);
  if (w < series_below) {
    segment = moment = 0;
    double term = w;
    for (int n = 1; n < 3 || 2 * n * std::abs(term) > std::numeric_limits<double>::epsilon() / 8 * moment; ++n) {
      term *= -w * w / (2 * n * (2 * n + 1));
      segment -= term, moment += (2 * n - 2) * term;
    }
  }
  return {law.k / 2 * e * segment, law.k / 4 * e * e * moment, law.k / 2 * (w + std::sin(w))};
}

// Cubic between two knots in t, 0 to 1: force f + h t (d + t (c + t b)).
ElasticForce elastic(const ForceTable& law, double depth) {
  const auto above = std::upper_bound(law.knots.begin() + 1, law.knots.end(), depth,
                                      [](double x, const ForceTable::Knot& knot) { return x < knot.depth; });
  const ForceTable::Knot& from = *(above - 1);
  const double x = depth - from.depth;
  if (above == law.knots.end()) return {from.force + from.slope * x, from.stored + x * (from.force + from.slope * x / 2), from.slope};
  const double h = above->depth - from.depth, t = x / h, secant = (above->force - from.force) / h;
  const double c = 3 * secant - 2 * from.slope - above->slope, b = from.slope + above->slope - 2 * secant;
  return {from.force + x * (from.slope + t * (c + t * b)), from.stored + x * (from.force + x * (from.slope / 2 + t * (c / 3 + t * b / 4))),
          from.slope + t * (2 * c + 3 * t * b)};
}

double exponent_at_touch(const ElasticLaw& law) {
  if (const auto* power = std::get_if<PowerForce>(&law)) return power->n;
  return std::holds_alternative<WideningForce>(law) || std::holds_alternative<FoundationForce>(law) ? 1.5 : 1;
}

/// Slope at an end whose next two intervals have lengths h0, h1 and secant slopes s0, s1: that of the parabola, limited so that the cubic
/// rises.
double end_slope(double h0, double h1, double s0, double s1) { return std::clamp(((2 * h0 + h1) * s0 - h0 * s1) / (h0 + h1), 0.0, 3 * s0); }

}  // namespace

ForceTable force_table(const std::vector<std::array<double, 2>>& points) {
  if (points.size() < 2) throw std::invalid_argument("needs at least two points");
  if (points[0] != std::array{0.0, 0.0}) throw std::invalid_argument("must begin with depth 0 and force 0");
  const std::size_t n = points.size();
  std::vector<double> h, s;
  for (std::size_t i = 1; i < n; ++i) {
    h.push_back(points[i][0] - points[i - 1][0]);
    s.push_back((points[i][1] - points[i - 1][1]) / h.back());
    if (!(h.back() > 0 && s.back() > 0 && std::isfinite(s.back())))
      throw std::invalid_argument("must increase from point to point, in depth and in force; point " + std::to_string(i + 1) + " does not");
  }
  ForceTable out;
  for (std::size_t i = 0; i < n; ++i) {
    double slope = s[0];
    if (n > 2 && i == 0) slope = end_slope(h[0], h[1], s[0], s[1]);
    if (n > 2 && i == n - 1) slope = end_slope(h[n - 2], h[n - 3], s[n - 2], s[n - 3]);
    if (i > 0 && i < n - 1) {
      const double a = h[i - 1] + 2 * h[i], b = 2 * h[i - 1] + h[i];
      slope = (a + b) / (a / s[i - 1] + b / s[i]);
    }
    out.knots.push_back({points[i][0], points[i][1], slope, 0});
  }
  for (std::size_t i = 1; i < n; ++i) {  // ∫ of the cubic
    const ForceTable::Knot& from = out.knots[i - 1];
    ForceTable::Knot& to = out.knots[i];
    to.stored = from.stored + h[i - 1] * ((from.force + to.force) / 2 + h[i - 1] * (from.slope - to.slope) / 12);
  }
  return out;
}

double half_angle(const FoundationForce& law, double depth) { return 2 * std::atan(std::sqrt(depth / (2 * law.clearance + depth))); }

ElasticForce evaluate(const ElasticLaw& law, double depth) {
  return std::visit([depth](const auto& one) { return elastic(one, depth); }, law);
}

NormalForce evaluate(const DampedLaw& law, const Approach& at) {
  if (at.depth <= 0) return {};
  assert(at.impact_rate > 0);
  const ElasticForce now = evaluate(law.elastic, at.depth);
  const double loss = law.chi / at.impact_rate, factor = 1 + loss * at.rate;
  if (factor <= 0) return {.stored = now.stored, .dissipation = -now.force * at.rate};
  return {.force = now.force * factor,
          .stored = now.stored,
          .dissipation = now.force * loss * at.rate * at.rate,
          .d_depth = now.stiffness * factor,
          .d_rate = now.force * loss};
}

namespace {

// The same functions for a law that is not a power. Newton's method in ln δ, ln E, where d ln E/d ln δ = Fδ/E is nearly constant; bisection
// where a step would leave the bracket of the root.
double depth_storing(const DampedLaw& law, double energy) {
  if (!(energy > 0)) return 0;
  double low = 0, high = std::numeric_limits<double>::infinity();
  double depth = law.deepest < high ? law.deepest : 1e-6;
  for (int i = 0; i < 200; ++i) {
    const ElasticForce now = evaluate(law.elastic, depth);
    const double miss = std::log(now.stored / energy);
    (miss > 0 ? high : low) = depth;
    double next = depth * std::exp(-miss * now.stored / (now.force * depth));
    if (!(next > low && next < high)) next = std::isinf(high) ? 2 * depth : low > 0 ? std::sqrt(low * high) : high / 2;
    const bool found = std::abs(next - depth) <= 2 * std::numeric_limits<double>::epsilon() * depth;
    depth = next;
    if (found) break;
  }
  return depth;
}
double stored(const DampedLaw& law, double depth) { return evaluate(law.elastic, depth).stored; }

double stiffness_of_equal_energy(const DampedLaw& law, double depth) { return 2 * stored(law, depth) / (depth * depth); }
double stiffness_at(const DampedLaw& law, double depth) { return evaluate(law.elastic, depth).stiffness; }
double damping_share(const DampedLaw& law, double rate, double impact_rate) { return law.chi * rate / impact_rate; }
double viscous_damping(const DampedLaw&) { return 0; }
double depth_reached(const DampedLaw& law, double lightness, double speed) { return depth_storing(law, speed * speed / (2 * lightness)); }
double speed_to_reach(const DampedLaw& law, double lightness, double depth) {
  return depth > 0 ? std::sqrt(2 * lightness * stored(law, depth)) : 0;
}
double part_of_depth(const DampedLaw& law, double tolerance, double missed) {
  return std::pow(tolerance / (missed * (1 + law.chi)), 1 / (exponent_at_touch(law.elastic) + 1));
}
double restitution_of(const DampedLaw& law, double) { return effective_restitution(law.chi); }

std::string stiffness_text(const DampedLaw& law, int digits) {
  char text[96];
  std::snprintf(text, sizeof text, "%.*g N/m (%.*s, at %.3g m)", digits, evaluate(law.elastic, law.deepest).force / law.deepest,
                static_cast<int>(law.name.size()), law.name.data(), law.deepest);
  return text;
}

std::vector<std::pair<std::string, double>> constants_of(const DampedLaw& law) {
  std::vector<std::pair<std::string, double>> out{{"hysteresis factor", law.chi}, {"law holds to a depth of [m]", law.deepest}};
  const auto add = [&](const char* name, double value) { out.emplace_back(name, value); };
  if (const auto* power = std::get_if<PowerForce>(&law.elastic)) add("stiffness [N/m^n]", power->k), add("exponent", power->n);
  if (const auto* line = std::get_if<LogarithmicForce>(&law.elastic)) add("S of depth = F/S ln(G/F) [N/m]", line->S), add("G [N]", line->G);
  if (const auto* pin = std::get_if<WideningForce>(&law.elastic)) add("k of k depth sqrt(depth/(clearance + depth)) [N/m]", pin->k);
  if (const auto* lined = std::get_if<FoundationForce>(&law.elastic)) add("stiffness of layer, length and radius [N/m]", lined->k);
  if (const auto* table = std::get_if<ForceTable>(&law.elastic)) add("points", static_cast<double>(table->knots.size()));
  return out;
}

}  // namespace

double depth_storing(const NormalLaw& law, double energy) {
  return std::visit([&](const auto& one) { return depth_storing(one, energy); }, law);
}
double stiffness_of_equal_energy(const NormalLaw& law, double depth) {
  return std::visit([&](const auto& one) { return stiffness_of_equal_energy(one, depth); }, law);
}
double stiffness_at(const NormalLaw& law, double depth) {
  return std::visit([&](const auto& one) { return stiffness_at(one, depth); }, law);
}
double damping_share(const NormalLaw& law, double rate, double impact_rate) {
  return std::visit([&](const auto& one) { return damping_share(one, rate, impact_rate); }, law);
}
double viscous_damping(const NormalLaw& law) {
  return std::visit([&](const auto& one) { return viscous_damping(one); }, law);
}
double depth_reached(const NormalLaw& law, double lightness, double speed) {
  return std::visit([&](const auto& one) { return depth_reached(one, lightness, speed); }, law);
}
double speed_to_reach(const NormalLaw& law, double lightness, double depth) {
  return std::visit([&](const auto& one) { return speed_to_reach(one, lightness, depth); }, law);
}
double part_of_depth(const NormalLaw& law, double tolerance, double missed) {
  return std::visit([&](const auto& one) { return part_of_depth(one, tolerance, missed); }, law);
}
double restitution_of(const NormalLaw& law, double mass) {
  return std::visit([&](const auto& one) { return restitution_of(one, mass); }, law);
}
std::string stiffness_text(const NormalLaw& law, int digits) {
  return std::visit([&](const auto& one) { return stiffness_text(one, digits); }, law);
}
std::vector<std::pair<std::string, double>> constants_of(const NormalLaw& law) {
  return std::visit([&](const auto& one) { return constants_of(one); }, law);
}

std::string range_warning(const NormalLaw& law, double depth) {
  const auto* damped = std::get_if<DampedLaw>(&law);
  if (!damped || !(depth > damped->deepest)) return {};
  char text[96];
  std::snprintf(text, sizeof text, "its depth reached %.3g m, beyond %.3g m where its law, ", depth, damped->deepest);
  return text + std::string(damped->name) + ", ends: " + std::string(damped->limit);
}

}  // namespace pintle
