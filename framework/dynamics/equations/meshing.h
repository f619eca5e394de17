#pragma once

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/dynamics/model/system.h"

/// Teeth with backlash that an event engages mesh in the gap in which they are at that time. The offset of their switch is the distance of
/// this gap from the one at the start; C is replaced by C − offset. Theory: docs/theory/gears.md.
namespace pintle {

/// The wheel b, rotated as if it meshed in the gap at the start.
template <class Moving>
Moving in_its_gap(const System& system, const ContactPair& pair, int contact, const Eigen::VectorXd& y, Moving b) {
  const int k = system.switches.empty() ? -1 : system.contact_switch[static_cast<std::size_t>(contact)];
  if (k >= 0) b.angle -= y[system.switch_begin() + 2 * k + 1] / pitch_radii(*pair.flank)[1];
  return b;
}

}  // namespace pintle
