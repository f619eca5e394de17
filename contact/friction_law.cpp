#include "contact/friction_law.h"

#include <algorithm>
#include <cmath>

namespace pintle {

namespace {

// Force from |f| = c(|v|) N and the slope dc/d|v|.
FrictionForce against(double v, double normal, double c, double slope) {
  return {std::copysign(c, -v) * normal, -slope * normal, std::copysign(c, -v)};
}

}  // namespace

FrictionForce evaluate(const Ambrosio& law, double v, double normal) {
  const double speed = std::abs(v);
  if (speed <= law.v0) return {};
  const double against = std::copysign(law.mu, -v);
  const double ramp = law.v1 - law.v0;
  const double cd = std::min((speed - law.v0) / ramp, 1.0);

  FrictionForce out;
  out.force = against * cd * normal;
  out.d_speed = speed < law.v1 ? -law.mu * normal / ramp : 0;
  out.d_normal = against * cd;
  return out;
}

FrictionForce evaluate(const Threlfall& law, double v, double normal) {
  const double x = 3 * std::abs(v) / law.v1;
  return against(v, normal, -law.mu * std::expm1(-x), 3 * law.mu / law.v1 * std::exp(-x));
}

FrictionForce evaluate(const HyperbolicTangent& law, double v, double normal) {
  const double c = std::tanh(std::abs(v) / law.v1);
  return against(v, normal, law.mu * c, law.mu * (1 - c * c) / law.v1);
}

FrictionForce evaluate(const BengisuAkay& law, double v, double normal) {
  const double speed = std::abs(v);
  if (speed < law.v0) {
    const double x = speed / law.v0;
    return against(v, normal, law.mu_static * x * (2 - x), 2 * law.mu_static * (1 - x) / law.v0);
  }
  const double more = (law.mu_static - law.mu) * std::exp(-(speed - law.v0) / law.v1);
  return against(v, normal, law.mu + more, -more / law.v1);
}

FrictionForce evaluate(const Coulomb& law, double v, double normal, double direction) {
  if (law.stribeck == 0) return {-direction * law.mu * normal, 0, -direction * law.mu};
  const double x = v / law.stribeck, more = (law.mu_static - law.mu) * std::exp(-x * x);
  return {-direction * (law.mu + more) * normal, 2 * direction * more * x / law.stribeck * normal, -direction * (law.mu + more)};
}

FrictionForce evaluate(const Coulomb& law, double v, double normal) {
  return v == 0 ? FrictionForce{} : evaluate(law, v, normal, std::copysign(1.0, v));
}

namespace {

template <class Law>
FrictionForce slides_steadily(const Law& law, double v, double normal) {
  if (v == 0) return {};
  const SteadyFriction now = steady_friction(law, std::abs(v));
  return against(v, normal, now.coefficient, now.slope);
}

}  // namespace

FrictionForce evaluate(const LuGre& law, double v, double normal) { return slides_steadily(law, v, normal); }
FrictionForce evaluate(const Gonthier& law, double v, double normal) { return slides_steadily(law, v, normal); }

FrictionForce evaluate(const FrictionLaw& law, double v, double normal) {
  return std::visit([&](const auto& l) { return evaluate(l, v, normal); }, law);
}

int bristle_states(const FrictionLaw& law) {
  return std::holds_alternative<LuGre>(law) ? 1 : std::holds_alternative<Gonthier>(law) ? 2 : 0;
}

BristleForce bend(const FrictionLaw& law, double v, const double* x) {
  if (const auto* lugre = std::get_if<LuGre>(&law)) return bend(*lugre, v, x);
  return bend(*std::get_if<Gonthier>(&law), v, x);
}

double breakaway_deflection(const FrictionLaw& law) {
  if (const auto* lugre = std::get_if<LuGre>(&law)) return lugre->mu_static / lugre->stiffness;
  const auto* gonthier = std::get_if<Gonthier>(&law);
  return gonthier ? gonthier->mu_static / gonthier->stiffness : 0;
}

BristleConstants bristle_constants(const FrictionLaw& law) {
  if (const auto* lugre = std::get_if<LuGre>(&law)) return {lugre->stiffness, lugre->damping};
  const auto* gonthier = std::get_if<Gonthier>(&law);
  return gonthier ? BristleConstants{gonthier->stiffness, gonthier->damping} : BristleConstants{};
}

double coefficient_of(const FrictionLaw& law) {
  return std::visit([](const auto& l) { return l.mu; }, law);
}

}  // namespace pintle
