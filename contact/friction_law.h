#pragma once

namespace pintle {

/// Regularised Coulomb friction of Ambrósio: |f| = μ c_d(v) N against the sliding speed, with
/// c_d = 0 below v0, (|v| − v0)/(v1 − v0) between, 1 above v1. No stiction: it creeps below v0.
/// Source: Flores and Ambrósio (2004), as in Eqs. (16)–(17) of Ebrahimi, Salahshoor, Moradi (2017),
/// where the interval of the middle branch is printed reversed.
struct Ambrosio {
  double mu = 0;     ///< –
  double v0 = 1e-3;  ///< [m/s], ≥ 0
  double v1 = 1e-2;  ///< [m/s], > v0
};

struct FrictionForce {
  double force = 0;     ///< along the sliding direction; opposes v [N]
  double d_speed = 0;   ///< ∂force/∂v [N s/m]
  double d_normal = 0;  ///< ∂force/∂N, –
};

/// Odd in v, within μN, power ≤ 0. Cannot fail.
/// @param v  signed sliding speed [m/s]   @param normal  N ≥ 0 [N]
FrictionForce evaluate(const Ambrosio&, double v, double normal);

}  // namespace pintle
