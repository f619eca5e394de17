#pragma once

#include <variant>

#include "contact/cylinder_law.h"

/// Pressure between cylinders and the angle of their contact, in addition to the force and depth of their normal law.
/// Theory: docs/theory/contact.md.
namespace pintle {

/// State of a contact at rest under a force.
struct Pressure {
  double greatest = 0;    ///< in the middle [Pa]
  double half_angle = 0;  ///< half the angle of contact on the smaller cylinder [rad]
};

/// Hertz: two half-spaces, bent to parabolas.
struct HertzLine {
  double modulus, length, radius, smaller;  ///< E* [Pa], L, R and the smaller radius [m]
};
/// Persson (1964): a pin in a hole of nearly the same size and the same material, at any angle below 85°.
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

/// The theory for cylinders with one of their laws: for a layer its own, otherwise Persson's for a pin in a hole and Hertz's for two round
/// ones.
PressureTheory pressure_theory(const CylinderLaw&, const Cylinders&);
/// @param force  ≥ 0 [N]
Pressure pressure_under(const PressureTheory&, double force);
/// The half-angle beyond which its assumptions do not hold; infinite: no limit [rad].
double widest(const PressureTheory&);

}  // namespace pintle
