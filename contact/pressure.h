#pragma once

#include <variant>

#include "contact/cylinder_law.h"

/// How hard cylinders press on each other and how far round they touch, beside what their normal law says of force and depth.
/// Theory: docs/theory/contact.md.
namespace pintle {

/// Of a contact at rest under a force.
struct Pressure {
  double greatest = 0;    ///< in its middle [Pa]
  double half_angle = 0;  ///< half of what it spans of the smaller cylinder [rad]
};

/// Hertz: two half-spaces, bent to parabolas.
struct HertzLine {
  double modulus, length, radius, smaller;  ///< E* [Pa], L, R and the smaller radius [m]
};
/// Persson (1964): a pin in a hole nearly as large, of the same material, at any angle below 85°.
struct ConformingPin {
  double modulus, length, radius, clearance;  ///< E* [Pa], L, √(R_i R_j), ΔR [m]
};
/// An elastic layer that lines the hole.
struct LinedHole {
  FoundationForce force;
  double foundation;  ///< [N/m³]
};
/// An elastic layer between parabolas.
struct LayeredLine {
  PowerForce force;
  double foundation, radius, smaller;  ///< [N/m³], R and the smaller radius [m]
};
using PressureTheory = std::variant<HertzLine, ConformingPin, LinedHole, LayeredLine>;

/// The theory for cylinders under a law of theirs: of a layer its own, else Persson's of a pin in a hole and Hertz's of two round ones.
PressureTheory pressure_theory(const CylinderLaw&, const Cylinders&);
/// @param force  ≥ 0 [N]
Pressure pressure_under(const PressureTheory&, double force);
/// The half-angle beyond which its assumptions do not hold; infinite: none [rad].
double widest(const PressureTheory&);

}  // namespace pintle
