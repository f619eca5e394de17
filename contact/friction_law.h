#pragma once

#include <variant>

#include "contact/bristle_law.h"

namespace pintle {

/// Friction against the sliding speed v under a normal force N. Coulomb's sticks; laws of bristles (bristle_law.h) hold like springs; all others
/// are curves of v through 0, of which none holds: under a load they creep. Theory and sources: docs/theory/friction.md.

/// |f| = μ c N with c = 0 below v0, (|v| − v0)/(v1 − v0) between, 1 above v1. It creeps freely below v0.
/// Source: Flores and Ambrósio (2004), as in Eqs. (16)–(17) of Ebrahimi, Salahshoor, Moradi (2017),
/// where the interval of the middle branch is printed reversed.
struct Ambrosio {
  double mu = 0;     ///< –
  double v0 = 1e-3;  ///< [m/s], ≥ 0
  double v1 = 1e-2;  ///< [m/s], > v0
};

/// |f| = μ (1 − exp(−3|v|/v1)) N. Source: Threlfall (1978), who ends at 0.95 μN from v1 on; here the curve goes on to μN.
struct Threlfall {
  double mu = 0;     ///< –
  double v1 = 1e-2;  ///< [m/s], > 0
};

/// |f| = μ tanh(|v|/v1) N.
struct HyperbolicTangent {
  double mu = 0;     ///< –
  double v1 = 1e-2;  ///< [m/s], > 0
};

/// |f| rises along a parabola to μ_s N at v0 and falls to μN over the speed v1: μ + (μ_s − μ) exp(−(|v| − v0)/v1).
/// Source: Bengisu and Akay (1994), ξ = 1/v1.
struct BengisuAkay {
  double mu = 0;         ///< while sliding, –
  double mu_static = 0;  ///< ≥ mu, –
  double v0 = 1e-3;      ///< [m/s], > 0
  double v1 = 1e-2;      ///< [m/s], > 0
};

/// Dry friction: the surfaces stick, without slip, while the force that this takes is at most μ_s N; else they slide under
/// |f| = μ + (μ_s − μ) exp(−(v/v_s)²) times N, v_s Stribeck's speed, or μN if that is 0. Stick and slip are events: integration/events/friction_events.h.
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

/// Odd in v, within μN (μ_s N where a law has it), power ≤ 0. Cannot fail.
/// @param v  signed sliding speed [m/s]   @param normal  N ≥ 0 [N]
FrictionForce evaluate(const Ambrosio&, double v, double normal);
FrictionForce evaluate(const Threlfall&, double v, double normal);
FrictionForce evaluate(const HyperbolicTangent&, double v, double normal);
FrictionForce evaluate(const BengisuAkay&, double v, double normal);
FrictionForce evaluate(const FrictionLaw&, double v, double normal);
/// Of surfaces that slide steadily, their bristles bent as they stay: no force at v = 0. μ_s and μN are without the viscous part.
FrictionForce evaluate(const LuGre&, double v, double normal);
FrictionForce evaluate(const Gonthier&, double v, double normal);
/// Of surfaces that slide: no force at v = 0.
FrictionForce evaluate(const Coulomb&, double v, double normal);
/// Of surfaces that slide towards `direction`, −1 or 1: smooth where v passes 0.
FrictionForce evaluate(const Coulomb&, double v, double normal, double direction);

/// How many internal states a law has; 0: it is none of bristles.
int bristle_states(const FrictionLaw&);
/// Per normal force. @pre it is one of bristles
BristleForce bend(const FrictionLaw&, double v, const double* x);
/// The greatest deflection of steady bristles, μ_s/σ0 [m]; 0 without.
double breakaway_deflection(const FrictionLaw&);
/// σ0, σ1 [1/m], [s/m]; 0 without.
struct BristleConstants {
  double stiffness = 0, damping = 0;
};
BristleConstants bristle_constants(const FrictionLaw&);

/// The coefficient while sliding.
double coefficient_of(const FrictionLaw&);

}  // namespace pintle
