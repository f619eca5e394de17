#include "contact/pressure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pintle {

namespace {

using std::numbers::pi;

Pressure under(const HertzLine& line, double force) {
  const double half_width = 2 * std::sqrt(force * line.radius / (pi * line.modulus * line.length));
  return {2 * force / (pi * half_width * line.length), half_width / line.smaller};
}

// With t = tan²(ε/2): E*ΔR L/F = [2 − ln(1 + t) − 2t²]/(2π t (1 + t)). Multiplied by t this gives a concave function that falls from a
// positive value: after the first step from t = 0 Newton converges monotonically to the root. In the middle p R L/F = [2 √t/√(1 + t) +
// asinh(√t)/(t (1 + t))]/π.
Pressure under(const ConformingPin& pin, double force) {
  const double q = force / (pin.modulus * pin.clearance * pin.length);
  double t = 2 * q / (q + 2 * pi);
  for (int i = 0; i < 100; ++i) {
    const double step = (q * (2 - std::log1p(t) - 2 * t * t) - 2 * pi * t * (1 + t)) / (q * (1 / (1 + t) + 4 * t) + 2 * pi * (1 + 2 * t));
    t += step;
    if (!(std::abs(step) > 1e-14 * t)) break;
  }
  const double r = std::sqrt(t), s = std::sqrt(1 + t);
  const double middle = 2 * r / s + std::asinh(r) / (t * s * s);  // ln((s + r)/(s − r)) = 2 asinh r
  return {force / (pi * pin.radius * pin.length) * middle, 2 * std::atan(r)};
}

Pressure under(const LinedHole& hole, double force) {
  double depth = hole.force.clearance;
  for (int i = 0; i < 100; ++i) {  // Newton in the logarithms of both, which are nearly proportional
    const ElasticForce now = evaluate(ElasticLaw(hole.force), depth);
    const double step = -std::log(now.force / force) * now.force / (now.stiffness * depth);
    depth *= std::exp(step);
    if (!(std::abs(step) > 1e-14)) break;
  }
  return {hole.foundation * depth, half_angle(hole.force, depth)};
}

Pressure under(const LayeredLine& line, double force) {
  const double depth = std::pow(force / line.force.k, 1 / line.force.n);
  return {line.foundation * depth, std::sqrt(2 * line.radius * depth) / line.smaller};
}

}  // namespace

PressureTheory pressure_theory(const CylinderLaw& law, const Cylinders& c) {
  const double R = 1 / std::abs(1 / c.a + 1 / c.b), smaller = std::min(std::abs(c.a), std::abs(c.b));
  if (law.of_a_layer) {
    const ElasticLaw elastic = law.law(c).elastic;
    if (const auto* hole = std::get_if<FoundationForce>(&elastic)) return LinedHole{*hole, c.foundation};
    return LayeredLine{std::get<PowerForce>(elastic), c.foundation, R, smaller};
  }
  if (c.internal()) return ConformingPin{c.modulus, c.length, std::sqrt(std::abs(c.a * c.b)), std::abs(c.a + c.b)};
  return HertzLine{c.modulus, c.length, R, smaller};
}

Pressure pressure_under(const PressureTheory& theory, double force) {
  if (!(force > 0)) return {};
  return std::visit([force](const auto& one) { return under(one, force); }, theory);
}

double widest(const PressureTheory& theory) {
  return std::holds_alternative<HertzLine>(theory)     ? pi / 6
         : std::holds_alternative<LayeredLine>(theory) ? 0.5
                                                       : std::numeric_limits<double>::infinity();
}

}  // namespace pintle
