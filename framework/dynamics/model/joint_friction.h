#pragma once

#include <array>

#include "contact/friction_law.h"
#include "framework/dynamics/model/internal_states.h"
#include "framework/dynamics/model/joints.h"

namespace pintle {

/// Friction in an ideal joint, dry or of bristles, pressed by what the joint itself bears: of a pin on its radius, of a block in its guide, of a pin
/// along its slot. Theory: docs/theory/friction.md.
struct JointFriction {
  int joint;           ///< revolute, prismatic or slot
  FrictionLaw law;     ///< Coulomb's, or one of bristles
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
  double per_load = 0;  ///< of bristles: force over N, –
  double d_slip = 0;    ///< of force over N, in the slip [s/m]
  std::array<double, most_internal> x_rate{};
};

/// How the force answers to the rates of the two markers, N, bristles and place held.
WrenchTangent wrench_tangent(const std::array<Wrench, 2>& unit, const JointFrictionEffect& now);
/// How the force and bristles answer to each other and to the rates. @pre the law is one of bristles
InternalTangent internal_tangent(const std::array<Wrench, 2>& unit, const JointFriction&, const JointFrictionEffect& now, const double* x);

}  // namespace pintle
