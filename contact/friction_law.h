#pragma once

namespace pintle {

/// Regularised Coulomb friction of Ambrósio: |f| = μ c_d(v) N against the sliding speed, with
/// c_d = 0 below v0, (|v| − v0)/(v1 − v0) between, 1 above v1. No stiction: it creeps below v0.
struct Ambrosio {
  double mu = 0;      ///< –
  double v0 = 1e-3;   ///< [m/s]
  double v1 = 1e-2;   ///< [m/s], > v0
};

struct FrictionForce {
  double force = 0;    ///< along the sliding direction; opposes v [N]
  double d_speed = 0;  ///< ∂force/∂v [N s/m]
  double d_normal = 0; ///< ∂force/∂N, –
};

/// @param v  signed sliding speed [m/s]   @param normal  N ≥ 0 [N]
FrictionForce evaluate(const Ambrosio&, double v, double normal);

}  // namespace pintle
