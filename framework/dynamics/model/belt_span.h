#pragma once

#include <tuple>

#include "framework/dynamics/model/marker.h"
#include "framework/dynamics/model/wrench_tangent.h"

namespace pintle {

struct ForceEffect;

/// An elastic belt between two pulleys, on which it does not slip. A radius is > 0 if the belt, running from a to b, passes around its
/// pulley counter-clockwise. With d = r_b − r_a, δ = radius_b − radius_a and the angle τ of the span
///   |d| sin(ψ − τ) = δ,  ℓ = √(|d|² − δ²),  e = ℓ − δ τ + radius_b φ_b − radius_a φ_a,
///   tension = max(0, k (e − loose) + c ė) while e > loose, else 0.
/// Theory: docs/theory/gears.md.
struct BeltSpan {
  int a, b;                   ///< markers
  double radius_a, radius_b;  ///< not 0 [m]
  double k, c;                ///< [N/m], [N s/m]
  double loose = 0;           ///< e without tension [m]
  double turn = 0;            ///< τ at the start; it stays within half a turn of this [rad]
  auto members() const { return std::tie(a, b, radius_a, radius_b, k, c, loose, turn); }
};

/// e, and its rate.
struct Elongation {
  double value, rate;
};
Elongation elongation(const BeltSpan&, const MarkerMotion& a, const MarkerMotion& b);
/// [N]
double tension(const BeltSpan&, const MarkerMotion& a, const MarkerMotion& b);

/// Same functions as for every force: forces.h.
ForceEffect effect(const BeltSpan&, const MarkerMotion& a, const MarkerMotion& b, double t, const double* x);
WrenchPattern pattern(const BeltSpan&);
void curve(const BeltSpan&, const ForceEffect& now, const MarkerMotion& a, const MarkerMotion& b, WrenchTangent&);

}  // namespace pintle
