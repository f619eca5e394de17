#pragma once

#include <vector>

#include "framework/dynamics/model/system.h"
#include "framework/scene/scene.h"

/// What a clearance joint would carry if it were ideal: by this a massless link is laid at the start, and a spring and
/// damper are matched to a contact. Theory: docs/theory/contact.md.
namespace pintle {

/// Where each journal would press on its bearing at the start, unit vectors, world axes; where it would not, gravity's
/// direction, else x. Zeros where the system has no massless link.
/// @throws AssemblyError  as assemble
std::vector<Eigen::Vector2d> pressed_directions(const Scene&, const System&);

/// Of one clearance joint.
struct IdealPin {
  double force = 0;  ///< that the ideal joint carries: root mean square over a short run, without `run` at the start [N]
  double mass = 0;   ///< that the bodies, held by the other joints, set against a push along `force` at the start [kg]
};
/// One a clearance joint; none of them held where it is not ideal.
/// @throws AssemblyError  as assemble
std::vector<IdealPin> ideal_pins(const Scene&, const System&);

}  // namespace pintle
