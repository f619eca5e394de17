#pragma once

#include <span>
#include <string_view>

namespace pintle {

/// All a normal law may know. Overlap is positive; rate = d(depth)/dt, positive while approaching.
struct Approach {
  double depth;        ///< [m]
  double rate;         ///< [m/s]
  double impact_rate;  ///< the rate when this contact began; held fixed until it ends [m/s], > 0
};

/// All it must answer. At every instant  d(stored)/dt + dissipation = force · rate,
/// which is what lets the energy ledger close through an impact.
struct NormalForce {
  double force = 0;        ///< never negative: no adhesion [N]
  double stored = 0;       ///< recoverable energy [J]
  double dissipation = 0;  ///< power lost, never negative [W]
  double d_depth = 0;      ///< ∂force/∂depth [N/m]
  double d_rate = 0;       ///< ∂force/∂rate [N s/m]
};

/// f = k δⁿ (1 + χ δ̇/δ̇₀) + d δ̇, never below zero. The laws of impact differ in χ(e) alone and have
/// d = 0; n = 1, χ = 0 is Kelvin and Voigt's spring and damper, which begins with a jump d δ̇.
/// Theory: docs/theory/contact.md.
struct ImpactLaw {
  double k = 0;    ///< [N/mⁿ]
  double n = 1.5;  ///< –
  double chi = 0;  ///< hysteresis factor χ, – ; 0: Hertz without loss
  double d = 0;    ///< viscous damping [N s/m]
};
/// All zero before touch, at it too unless d > 0 and it approaches. Stored energy released while the
/// force is clamped counts as lost.
/// No allocation. @pre impact_rate > 0 where depth > 0
NormalForce evaluate(const ImpactLaw&, const Approach&);

/// A published factor χ(e).
struct ImpactFactor {
  std::string_view name;    ///< as a scene file says it
  double (*chi)(double e);  ///< e in (0, 1] or [0, 1]
  bool zero_allowed;        ///< χ(0) is finite
  std::string_view source;  ///< author and year
};
/// All factors known: hertz, hunt-crossley, herbert-mcwhannell, lee-wang, lankarani-nikravesh,
/// gonthier, zhiying-qishao, flores, hu-guo, exact.
std::span<const ImpactFactor> impact_factors();
/// @returns nullptr if there is none of that name
const ImpactFactor* find_impact_factor(std::string_view name);

/// The restitution that a one-sided impact under χ delivers, the root in (0, 1] of
/// χ(1 + e) = ln[(1 + χ)/(1 − χ e)]; 1 for χ = 0. Independent of k, n, mass and speed.
double effective_restitution(double chi);

/// The restitution that a mass m delivers at a spring and damper that does not pull,
/// ζ = d/(2√(k m)): it parts when the force has fallen to zero. In [0, 1], 1 for ζ = 0.
/// Source: derived in docs/theory/contact.md.
double linear_restitution(double zeta);
/// Its inverse. @pre 0 < e ≤ 1
double damping_ratio(double e);

/// Hertz-type stiffness K = 4/(3(hᵢ + hⱼ)) √R, h = (1 − ν²)/E  [N/m^1.5].
/// Internal contact (journal in bearing): R = RᵢRⱼ/(Rⱼ − Rᵢ); external: R = RᵢRⱼ/(Rᵢ + Rⱼ).
double hertz_stiffness(double journal_radius, double bearing_radius, double young_i, double nu_i, double young_j, double nu_j,
                       bool internal);

}  // namespace pintle
