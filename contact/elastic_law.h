#pragma once

#include <array>
#include <limits>
#include <string_view>
#include <variant>

#include "contact/normal_law.h"

/// Normal laws whose elastic force is not a stiffness times a power: conforming cylinders and tables.
/// Theory: docs/theory/contact.md.
namespace pintle {

/// Elastic response of a law at a depth > 0.
struct ElasticForce {
  double force = 0;      ///< [N]
  double stored = 0;     ///< its integral over the depth [J]
  double stiffness = 0;  ///< its derivative [N/m]
};

/// k δⁿ
struct PowerForce {
  double k;  ///< [N/mⁿ]
  double n;
};
/// δ = (F/S) ln(G/F), the force of a line contact, for u = ln(G/F) ≥ 2; beyond that linear, with the slope S at u = 2.
struct LogarithmicForce {
  double S;  ///< [N/m]
  double G;  ///< [N]
};
/// k δ √(δ/(ΔR + δ)) of a pin in a hole.
struct WideningForce {
  double k;          ///< [N/m]
  double clearance;  ///< ΔR [m]
};
/// ½ k e (w − sin w), e = ΔR + δ, cos ½w = ΔR/e: of a pin in a hole lined with an elastic layer.
struct FoundationForce {
  double k;          ///< stiffness of the layer [N/m³] times length and radius [N/m]
  double clearance;  ///< ΔR [m]
};
/// Through given points, the first with zero depth and force, by monotone cubics (Fritsch and Butland 1984) with continuous slope; beyond
/// the last point linear, with the slope there.
struct ForceTable {
  struct Knot {
    double depth, force, slope, stored;  ///< [m], [N], [N/m], [J]
  };
  std::vector<Knot> knots;
};
/// @param points  depth and force [m, N]
/// @throws std::invalid_argument  fewer than two points; first one not (0, 0); depth or force not rising
ForceTable force_table(const std::vector<std::array<double, 2>>& points);

using ElasticLaw = std::variant<PowerForce, LogarithmicForce, WideningForce, ForceTable, FoundationForce>;
/// No allocation. @param depth  > 0 [m]
ElasticForce evaluate(const ElasticLaw&, double depth);
/// Half the angle spanned by a pin at a depth, where its cosine is ΔR/(ΔR + δ) [rad].
double half_angle(const FoundationForce&, double depth);

/// f = F(δ)(1 + χ δ̇/δ̇₀), never below zero.
struct DampedLaw {
  ElasticLaw elastic;
  double chi = 0;                                            ///< hysteresis factor, –
  double deepest = std::numeric_limits<double>::infinity();  ///< limit of its author's assumptions, or end of a table [m]
  std::string_view name = {};                                ///< name in scene files
  std::string_view limit = {};                               ///< why it ends there, and what to do
};
NormalForce evaluate(const DampedLaw&, const Approach&);

using NormalLaw = std::variant<ImpactLaw, DampedLaw>;
inline NormalForce evaluate(const NormalLaw& law, const Approach& at) {
  if (const auto* impact = std::get_if<ImpactLaw>(&law)) return evaluate(*impact, at);
  return evaluate(*std::get_if<DampedLaw>(&law), at);
}

// The functions of normal_law.h.
double depth_storing(const NormalLaw&, double energy);
double stiffness_of_equal_energy(const NormalLaw&, double depth);
double stiffness_at(const NormalLaw&, double depth);
inline bool begins_with_jump(const NormalLaw& law) {
  const auto* impact = std::get_if<ImpactLaw>(&law);
  return impact && begins_with_jump(*impact);
}
double damping_share(const NormalLaw&, double rate, double impact_rate);
double viscous_damping(const NormalLaw&);
double depth_reached(const NormalLaw&, double lightness, double speed);
double speed_to_reach(const NormalLaw&, double lightness, double depth);
double part_of_depth(const NormalLaw&, double tolerance, double missed);
double restitution_of(const NormalLaw&, double mass);
/// "2.1e+09 N/m (johnson, at 1e-05 m)": the secant stiffness where the law ends.
std::string stiffness_text(const NormalLaw&, int digits = 6);
std::vector<std::pair<std::string, double>> constants_of(const NormalLaw&);

/// Why the law is not reliable at a depth [m]; empty: it is.
std::string range_warning(const NormalLaw&, double depth);

}  // namespace pintle
