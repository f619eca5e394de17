#pragma once

#include <span>
#include <string>

#include "framework/dynamics/equations/equations.h"

/// Releasing and engaging joints, drivers, forces and contacts. Theory: docs/theory/events.md.
namespace pintle {

struct SwitchOver {
  int at;            ///< index into System::switches
  bool engage;       ///< false: release
  double pitch = 0;  ///< of teeth with backlash, along their pitch circles; 0: unknown [m]
};

/// Result of a change of the mechanism, or why it is impossible.
struct Engagement {
  std::string trouble = {};   ///< empty: done. Otherwise the state is invalid
  bool changed = false;       ///< something changed: not all elements were already released or engaged
  double lost = 0, work = 0;  ///< energy lost by engaging joints, and work of drivers during this [J]
};

/// Releases and engages elements at one instant. Positions are unchanged; speeds are projected, in the metric of M, onto what the engaged
/// joints allow: an impact without restitution. The energy lost is recorded, including that stored in released forces and contacts. A
/// joint's angle, and what a driver imposes, continue from their present values; a joint whose points must coincide is engaged only if they
/// do.
Engagement switch_over(const System&, std::span<const SwitchOver>, State&, Equations&);

}  // namespace pintle
