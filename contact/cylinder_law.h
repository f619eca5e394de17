#pragma once

#include <span>
#include <string_view>

#include "contact/elastic_law.h"

namespace pintle {

/// Two parallel cylinders that touch along a line.
struct Cylinders {
  double a, b;     ///< radii; that of a hole < 0 [m]
  double length;   ///< of the line [m]
  double modulus;  ///< E*, 1/E* = Σ(1 − ν²)/E [Pa]
  bool internal() const { return a < 0 || b < 0; }
};

/// A published force of cylinders.
struct CylinderLaw {
  std::string_view name;                   ///< as a scene file says it
  bool external;                           ///< its author gives it for two round cylinders too
  double least_clearance, most_clearance;  ///< of a pin in a hole, for which its author gives constants [m]
  DampedLaw (*law)(const Cylinders&);      ///< without damping
  std::string_view source;                 ///< author and year
};
/// All known: johnson, radzimovsky, goldsmith, esdu, liu, pereira.
std::span<const CylinderLaw> cylinder_laws();
/// @returns nullptr if there is none of that name
const CylinderLaw* find_cylinder_law(std::string_view name);

}  // namespace pintle
