#pragma once

#include <array>
#include <variant>

#include "contact/gap.h"
#include "contact/normal_law.h"
#include "framework/dynamics/model/couplings.h"

namespace pintle {

/// One of the two sides on which teeth with backlash meet: of two wheels, or of a pinion and its rack. Without backlash the pitch line or
/// circles would roll on each other, C = [apart; slip]; with backlash the slip is free up to half the backlash in each direction. With the
/// pressure angle α,
///   depth = side cos α C[1] − sin α C[0] − half,
/// and the force N of the contact acts on the two with −∂depth/∂p N. Theory: docs/theory/gears.md
struct Flank {
  using Teeth = std::variant<RollsOnDisc, RollsOnLine>;
  Teeth teeth;       ///< between markers 0 and 1, those of the contact
  double side;       ///< 1: contact as C[1] rises, −1: as C[1] falls
  double half;       ///< of the backlash, along the line of action [m]
  double angle = 0;  ///< α, 0 to below a quarter turn [rad]
};

/// Pitch radii of a and b, 0 for a rack; negative: teeth inside a ring, or to the right of the line [m].
std::array<double, 2> pitch_radii(const Flank&);

/// Both middles are the pitch point; N pushes b along n.
Gap evaluate(const Flank&, const MovingPoint& a, const MovingPoint& b);
/// The second time derivative of the depth where the poses of a and b have no second derivative [m/s²].
double closing_acceleration(const Flank&, const MovingPoint& a, const MovingPoint& b);
/// How its wrenches on a and b depend on their motion.
WrenchTangent wrench_tangent(const Flank&, const NormalForce&, const MovingPoint& a, const MovingPoint& b);

}  // namespace pintle
