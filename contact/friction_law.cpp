#include "contact/friction_law.h"

#include <algorithm>
#include <cmath>

namespace pintle {

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

}  // namespace pintle
