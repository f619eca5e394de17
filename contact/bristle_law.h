#pragma once

#include <array>

namespace pintle {

/// Friction by bristles that the sliding speed v bends: a law with internal states, which holds like a spring before it slides. All
/// quantities are per unit of normal force. Theory and sources: docs/theory/friction.md.

inline constexpr int most_bristle_states = 2;

/// ż = v − σ0 |v| z/g(v),  f = σ0 z + σ1(v) ż + σ2 v,  g = μ + (μ_s − μ) exp(−(v/v_s)²),  σ1(v) = σ1 exp(−(v/v_d)²).
/// State: the deflection z [m]. Source: Canudas de Wit, Olsson, Åström and Lischinsky (1995); the falling damping is Olsson's (1996).
struct LuGre {
  double mu = 0;                ///< while sliding, > 0, –
  double mu_static = 0;         ///< ≥ mu, –
  double stribeck = 1e-3;       ///< v_s [m/s], > 0
  double stiffness = 1e5;       ///< σ0 [1/m], > 0
  double damping = 0;           ///< σ1 [s/m], ≥ 0
  double viscous = 0;           ///< σ2 [s/m], ≥ 0
  double damping_speed = 1e-3;  ///< v_d [m/s], > 0; infinite: σ1 at all speeds
};

/// With s = exp(−(v/v_s)²), the degree to which the surfaces stick:
///   ż = s v + (1 − s)(μ sgn v − σ0 z)/σ1,   f = clip(σ0 z + σ1 ż, μ + (μ_s − μ) d) + σ2 v,
///   ḋ = (s − d)/τ while d grows, (s − d) σ0/σ1 while it falls.
/// States: the deflection z [m] and the dwell state d, 0 to 1: the holding force grows with it during sticking. Source: Gonthier, McPhee,
/// Lange and Piedboeuf (2004); they smooth the sign function, which the factor 1 − s does here.
struct Gonthier {
  double mu = 0;           ///< while sliding, > 0, –
  double mu_static = 0;    ///< after long rest, ≥ mu, –
  double stribeck = 1e-3;  ///< v_s [m/s], > 0
  double stiffness = 1e5;  ///< σ0 [1/m], > 0
  double damping = 300;    ///< σ1 [s/m], > 0
  double viscous = 0;      ///< σ2 [s/m], ≥ 0
  double dwell = 1;        ///< τ [s], > 0
};

/// Per unit of normal force, with derivatives with respect to v and to the states x. Independent of the normal force.
struct BristleForce {
  using States = std::array<double, most_bristle_states>;
  double force = 0;    ///< along the sliding direction; opposes v unless the bristles are bent the other way, –
  double d_speed = 0;  ///< [s/m]
  States d_state{};
  States rate{};  ///< ẋ
  States rate_d_speed{};
  std::array<States, most_bristle_states> rate_d_state{};  ///< [i][j]: of ẋᵢ with respect to xⱼ
};

/// @param v  signed sliding speed [m/s]   @param x  as many states as the law has. Cannot fail.
BristleForce bend(const LuGre&, double v, const double* x);
BristleForce bend(const Gonthier&, double v, const double* x);

/// |f|/N during steady sliding, with constant states, and its derivative with respect to |v|.
struct SteadyFriction {
  double coefficient = 0;  ///< –
  double slope = 0;        ///< [s/m]
};
SteadyFriction steady_friction(const LuGre&, double speed);
SteadyFriction steady_friction(const Gonthier&, double speed);

/// The σ1 for critical damping of a body that its own weight presses on and only bristles hold: 2 √(σ0/g), g = 9.81 m/s² [s/m].
double critical_damping(double stiffness);
/// The largest v_d for which the damping of undeflected bristles is at most μ at any speed: √(2e) μ/σ1 [m/s]. This limits the friction of a
/// contact that begins while sliding. Up to four times this value would still be passive.
double gentle_damping_speed(double mu, double damping);

}  // namespace pintle
