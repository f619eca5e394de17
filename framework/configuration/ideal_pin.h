#pragma once

#include <vector>

#include "framework/dynamics/model/system.h"
#include "framework/scene/scene.h"

/// The load that a clearance joint would carry if it were ideal: it determines the initial direction of a massless link, and the spring and
/// damper equivalent to a contact. Theory: docs/theory/contact.md.
namespace pintle {

/// Direction in which each journal would press on its bearing at the start, unit vectors, world axes; if there is no force, gravity's
/// direction, otherwise x. Zeros where the system has no massless link.
/// @throws AssemblyError  as assemble
std::vector<Eigen::Vector2d> pressed_directions(const Scene&, const System&);

/// Data of one clearance joint.
struct IdealPin {
  double force = 0;  ///< force in the ideal joint: root mean square over a short run, without `run` at the start [N]
  double mass = 0;   ///< effective mass of the bodies, held by the other joints, against a push along `force` at the start [kg]
};
/// One per clearance joint; for `mass`, no clearance joint holds the bodies.
/// @throws AssemblyError  as assemble
std::vector<IdealPin> ideal_pins(const Scene&, const System&);

}  // namespace pintle
