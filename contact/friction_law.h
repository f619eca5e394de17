#pragma once

#include <variant>

#include "contact/bristle_law.h"

namespace pintle {

/// Friction against the sliding speed v under a normal force N. Coulomb friction sticks; bristle laws (bristle_law.h) hold like springs;
/// all others are curves through v = 0, which cannot hold: under a load they creep. Theory and sources: docs/theory/friction.md.

/// |f| = μ c N with c = 0 below v0, (|v| − v0)/(v1 − v0) between v0 and v1, 1 above v1. It creeps freely below v0. Source: Flores and
/// Ambrósio (2004), as in Eqs. (16)–(17) of Ebrahimi, Salahshoor, Moradi (2017), where the interval of the middle branch is printed
/// reversed.
struct Ambrosio {
  double mu = 0;     ///< –
  double v0 = 1e-3;  ///< [m/s], ≥ 0
  double v1 = 1e-2;  ///< [m/s], > v0
};

/// |f| = μ (1 − exp(−3|v|/v1)) N. Source: Threlfall (1978), whose curve ends at 0.95 μN for v ≥ v1; here it continues to μN.
struct Threlfall {
  double mu = 0;     ///< –
  double v1 = 1e-2;  ///< [m/s], > 0
};

/// |f| = μ tanh(|v|/v1) N.
struct HyperbolicTangent {
  double mu = 0;     ///< –
  double v1 = 1e-2;  ///< [m/s], > 0
};

/// |f| rises along a parabola to μ_s N at v0 and falls towards μN with the speed scale v1: μ + (μ_s − μ) exp(−(|v| − v0)/v1). Source:
/// Bengisu and Akay (1994), ξ = 1/v1.
struct BengisuAkay {
  double mu = 0;         ///< while sliding, –
  double mu_static = 0;  ///< ≥ mu, –
  double v0 = 1e-3;      ///< [m/s], > 0
  double v1 = 1e-2;      ///< [m/s], > 0
};

/// Dry friction: the surfaces stick, without slip, while the required force is at most μ_s N; otherwise they slide with |f| = μ + (μ_s − μ)
/// exp(−(v/v_s)²) times N, where v_s is the Stribeck speed, or with μN if that is 0. Stick and slip are events:
/// integration/events/friction_events.h.
struct Coulomb {
  double mu = 0;         ///< while sliding, –
  double mu_static = 0;  ///< ≥ mu, –
  double stribeck = 0;   ///< v_s [m/s], ≥ 0
};

using FrictionLaw = std::variant<Ambrosio, Threlfall, HyperbolicTangent, BengisuAkay, Coulomb, LuGre, Gonthier>;

struct FrictionForce {
  double force = 0;     ///< along the sliding direction; opposes v [N]
  double d_speed = 0;   ///< ∂force/∂v [N s/m]
  double d_normal = 0;  ///< ∂force/∂N, –
};

/// Odd in v, at most μN (μ_s N where a law has it), power ≤ 0. Cannot fail.
/// @param v  signed sliding speed [m/s]   @param normal  N ≥ 0 [N]
FrictionForce evaluate(const Ambrosio&, double v, double normal);
FrictionForce evaluate(const Threlfall&, double v, double normal);
FrictionForce evaluate(const HyperbolicTangent&, double v, double normal);
FrictionForce evaluate(const BengisuAkay&, double v, double normal);
FrictionForce evaluate(const FrictionLaw&, double v, double normal);
/// For steady sliding, with constant bristle deflection: no force at v = 0. The bounds μ_s and μN exclude the viscous part.
FrictionForce evaluate(const LuGre&, double v, double normal);
FrictionForce evaluate(const Gonthier&, double v, double normal);
/// For sliding surfaces: no force at v = 0.
FrictionForce evaluate(const Coulomb&, double v, double normal);
/// For surfaces that slide towards `direction`, −1 or 1: smooth where v passes 0.
FrictionForce evaluate(const Coulomb&, double v, double normal, double direction);

/// Number of internal states of a law; 0: it has no bristles.
int bristle_states(const FrictionLaw&);
/// Per unit of normal force. @pre the law has bristles
BristleForce bend(const FrictionLaw&, double v, const double* x);
/// The greatest steady deflection of bristles, μ_s/σ0 [m]; 0 without bristles.
double breakaway_deflection(const FrictionLaw&);
/// σ0, σ1 [1/m], [s/m]; 0 without bristles.
struct BristleConstants {
  double stiffness = 0, damping = 0;
};
BristleConstants bristle_constants(const FrictionLaw&);

/// The coefficient of sliding friction.
double coefficient_of(const FrictionLaw&);

}  // namespace pintle
