#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pintle {

/// Input of a normal law. Overlap is positive; rate = d(depth)/dt, positive while approaching.
struct Approach {
  double depth;        ///< [m]
  double rate;         ///< [m/s]
  double impact_rate;  ///< the rate at the start of this contact; constant until it ends [m/s], > 0
};

/// Output of a normal law. At every instant  d(stored)/dt + dissipation = force · rate, so that the energy balance holds through an impact.
struct NormalForce {
  double force = 0;        ///< never negative: no adhesion [N]
  double stored = 0;       ///< recoverable energy [J]
  double dissipation = 0;  ///< power lost, never negative [W]
  double d_depth = 0;      ///< ∂force/∂depth [N/m]
  double d_rate = 0;       ///< ∂force/∂rate [N s/m]
};

/// f = k δⁿ (1 + χ δ̇/δ̇₀) + d δ̇, never negative. The impact laws differ only in χ(e) and have d = 0; n = 1, χ = 0 is Kelvin and Voigt's
/// spring and damper, which begins with a jump d δ̇.
/// Theory: docs/theory/contact.md.
struct ImpactLaw {
  double k = 0;    ///< [N/mⁿ]
  double n = 1.5;  ///< –
  double chi = 0;  ///< hysteresis factor χ, – ; 0: Hertz without loss
  double d = 0;    ///< viscous damping [N s/m]
};
/// All zero without contact, and at zero depth unless d > 0 and it approaches. Stored energy released while the force is limited to zero
/// counts as lost.
/// No allocation. @pre impact_rate > 0 if depth > 0
NormalForce evaluate(const ImpactLaw&, const Approach&);

// Functions for other code: only this file and its implementation know the constants of a law.

/// The depth at which it stores an energy ≥ 0 [m], and the stiffness of the linear spring that stores the same energy at a depth > 0 [N/m].
double depth_storing(const ImpactLaw&, double energy);
double stiffness_of_equal_energy(const ImpactLaw&, double depth);
/// ∂f/∂δ of the elastic force at a depth > 0 [N/m].
double stiffness_at(const ImpactLaw&, double depth);
/// Whether its force begins with the jump d δ̇.
bool begins_with_jump(const ImpactLaw&);
/// Ratio of its damping to its elastic force, at a rate [m/s] in a contact that began at impact_rate; 0 for a law whose damping does not
/// depend on how the contact began.
double damping_share(const ImpactLaw&, double rate, double impact_rate);
/// Damping constant of a spring and damper, independent of the impact [N s/m].
double viscous_damping(const ImpactLaw&);
/// From ½ v² = lightness · stored, 1/lightness being the reduced mass: the depth that an approach at v reaches without loss [m], and the
/// approach speed that reaches a depth [m/s]. @param lightness  > 0 [1/kg]
double depth_reached(const ImpactLaw&, double lightness, double speed);
double speed_to_reach(const ImpactLaw&, double lightness, double depth);
/// The fraction x of an impact's depth up to which the error of a scheme equals the tolerance, if that error is the share `missed` of
/// the change of speed there: missed (1 + χ) xⁿ⁺¹ = tolerance, with the initial growth of the force.
double part_of_depth(const ImpactLaw&, double tolerance, double missed);
/// The restitution that it produces for a reduced mass [kg].
double restitution_of(const ImpactLaw&, double mass);
/// "1e+10 N/m^1.5"
std::string stiffness_text(const ImpactLaw&, int digits = 6);
/// Its constants: name with unit, value.
std::vector<std::pair<std::string, double>> constants_of(const ImpactLaw&);

/// A published hysteresis factor χ(e).
struct ImpactFactor {
  std::string_view name;    ///< name in scene files
  double (*chi)(double e);  ///< e in (0, 1] or [0, 1]
  bool zero_allowed;        ///< χ(0) is finite
  std::string_view source;  ///< author and year
};
/// All known factors: hertz, hunt-crossley, herbert-mcwhannell, lee-wang, lankarani-nikravesh,
/// gonthier, zhiying-qishao, flores, hu-guo, exact.
std::span<const ImpactFactor> impact_factors();
/// @returns nullptr if there is none of that name
const ImpactFactor* find_impact_factor(std::string_view name);

/// The restitution that a one-sided impact with χ produces, the root in (0, 1] of χ(1 + e) = ln[(1 + χ)/(1 − χ e)]; 1 for χ = 0.
/// Independent of k, n, mass and speed.
double effective_restitution(double chi);

/// The restitution of a mass m on a spring and damper that does not pull, ζ = d/(2√(k m)): contact ends when the force has fallen to zero.
/// In [0, 1], 1 for ζ = 0.
/// Source: derived in docs/theory/contact.md.
double linear_restitution(double zeta);
/// Its inverse. @pre 0 < e ≤ 1
double damping_ratio(double e);

/// Hertz-type stiffness K = 4/(3(hᵢ + hⱼ)) √R, h = (1 − ν²)/E  [N/m^1.5].
/// Internal contact (journal in bearing): R = RᵢRⱼ/(Rⱼ − Rᵢ); external: R = RᵢRⱼ/(Rᵢ + Rⱼ).
double hertz_stiffness(double R, double young_i, double nu_i, double young_j, double nu_j);
double hertz_stiffness(double journal_radius, double bearing_radius, double young_i, double nu_i, double young_j, double nu_j,
                       bool internal);

}  // namespace pintle
