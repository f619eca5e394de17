#pragma once

#include <span>
#include <string>

#include "framework/dynamics/equations/equations.h"

/// Joints, drivers, forces and contacts that are taken out of the mechanism and put back. Theory: docs/theory/events.md.
namespace pintle {

struct SwitchOver {
  int at;            ///< index into System::switches
  bool engage;       ///< false: release
  double pitch = 0;  ///< of teeth with backlash, from one to the next along their pitch circles; 0: not known [m]
};

/// What a change of the mechanism has done, or why it cannot be.
struct Engagement {
  std::string trouble = {};   ///< empty: it is done. Else the state is of no use
  bool changed = false;       ///< something has been released or engaged that was not so before
  double lost = 0, work = 0;  ///< to the engaging of joints, and what drivers put in as they were engaged [J]
};

/// Releases and engages elements, all at one instant. Places stay; speeds go, by the shortest way in the metric of M, to what the joints that
/// are engaged allow: an impact without restitution. What is lost is booked, and what forces and contacts held in store. A joint's angle, and
/// what a driver imposes, go on from what they are; a joint whose points must meet is engaged only where they do.
Engagement switch_over(const System&, std::span<const SwitchOver>, State&, Equations&);

}  // namespace pintle
