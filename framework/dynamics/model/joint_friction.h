#pragma once

#include <array>

#include "contact/friction_law.h"
#include "framework/dynamics/model/joints.h"

namespace pintle {

/// Dry friction in an ideal joint, pressed by what the joint itself bears: of a pin on its radius, of a block in its guide, of a pin
/// along its slot. Theory: docs/theory/friction.md.
struct JointFriction {
  int joint;  ///< revolute, prismatic or slot
  Coulomb law;
  double radius = 0;   ///< of a revolute's pin [m]
  double length = 0;   ///< over which a prismatic's block bears couples at its two ends [m]
  double preload = 0;  ///< what presses it without load [N]
};

/// What friction of 1 N does to a and to b, b being rubbed along the slip: by power, the slip of unit rates.
std::array<Wrench, 2> unit_friction(const Joint&, const JointFriction&, const MarkerMotion& a, const MarkerMotion& b);
/// Speed of b's surface over a's [m/s], and its rate where no coordinate is accelerated [m/s²].
double slip(const Joint&, const JointFriction&, const MarkerMotion& a, const MarkerMotion& b);
double slip_acceleration(const Joint&, const JointFriction&, const MarkerMotion& a, const MarkerMotion& b);
/// The force that presses, N: preload and what the joint bears. Of a guide the force across it or, where that is more, what its two ends
/// bear of the couple. @param on_b  the joint's reaction on b
double load(const Joint&, const JointFriction&, const MarkerMotion& a, const Wrench& on_b);

/// What it does at an instant.
struct JointFrictionEffect {
  double force = 0;  ///< on b along the slip [N]
  double load = 0;   ///< N [N]
  double slip = 0;   ///< [m/s]
  bool sticks = false;
};

}  // namespace pintle
