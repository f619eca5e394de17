#pragma once

#include <limits>
#include <span>
#include <string_view>

#include "contact/elastic_law.h"

namespace pintle {

/// Two parallel cylinders that touch along a line; one of them may be flat, of infinite radius.
struct Cylinders {
  double a, b;     ///< radii; that of a hole < 0 [m]
  double length;   ///< of the line [m]
  double modulus;  ///< E*, 1/E* = Σ(1 − ν²)/E [Pa]
  // For an elastic layer between two rigid cylinders:
  double foundation = 0;                                   ///< pressure over local depth [N/m³]
  double layer = std::numeric_limits<double>::infinity();  ///< thickness; infinite: unknown [m]
  bool internal() const { return a < 0 || b < 0; }
};

/// A published force law of cylinders.
struct CylinderLaw {
  std::string_view name;                   ///< name in scene files
  bool external;                           ///< its author also gives it for two round cylinders
  double least_clearance, most_clearance;  ///< clearances of a pin in a hole for which its author gives constants [m]
  DampedLaw (*law)(const Cylinders&);      ///< without damping
  std::string_view source;                 ///< author and year
  bool of_a_layer = false;                 ///< deformation of an elastic layer, which may also lie on a flat surface; false: of both bodies
};
/// Pressure over compression of a layer bonded to a rigid body, (1 − ν)E/((1 + ν)(1 − 2ν)h) [N/m³]. @pre poisson < ½
double foundation_modulus(double young, double poisson, double thickness);
/// All known: johnson, radzimovsky, goldsmith, esdu, liu, pereira, winkler.
std::span<const CylinderLaw> cylinder_laws();
/// @returns nullptr if there is none of that name
const CylinderLaw* find_cylinder_law(std::string_view name);

}  // namespace pintle
