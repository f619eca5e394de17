#pragma once

/// One-sided impact of a mass m at speed v₀ under F = K δⁿ (1 + χ δ̇/v₀), without gravity.
/// Separation of variables, u = δ̇/v₀:  δⁿ⁺¹ = (n + 1) m v₀²/K · G(u),  G = ∫ᵤ¹ s/(1 + χ s) ds, and
/// dt = −m v₀ du/F. The rebound is at u = −e, where G vanishes again.
namespace pintle_oracle {

struct Bounce {
  double mass = 1, speed = 1;              ///< [kg], [m/s]
  double stiffness = 1e9, exponent = 1.5;  ///< K [N/mⁿ], n
  double chi = 0;                          ///< ≥ 0
};

double restitution(double chi);            ///< root of χ(1 + e) = ln[(1 + χ)/(1 − χ e)] in (0, 1]
double depth_at(const Bounce&, double u);  ///< −e ≤ u ≤ 1 [m]
double deepest(const Bounce&);             ///< [m]
double peak_force(const Bounce&);          ///< [N]
double time_to_deepest(const Bounce&);     ///< by quadrature [s]
double duration(const Bounce&);            ///< of the whole contact [s]
double loss(const Bounce&);                ///< ½ m v₀² (1 − e²) [J]

}  // namespace pintle_oracle
