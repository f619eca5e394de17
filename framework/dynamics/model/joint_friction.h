#pragma once

#include <array>

#include "contact/friction_law.h"
#include "framework/dynamics/model/internal_states.h"
#include "framework/dynamics/model/joints.h"

namespace pintle {

/// Friction in an ideal joint, dry or with bristles, under the load of the joint itself: of a pin on its radius, of a block in its guide,
/// of a pin along its slot. Theory: docs/theory/friction.md.
struct JointFriction {
  int joint;           ///< revolute, prismatic or slot
  FrictionLaw law;     ///< Coulomb's, or one of bristles
  double radius = 0;   ///< of a revolute's pin [m]
  double length = 0;   ///< length of a prismatic joint's block, which bears couples at its two ends [m]
  double preload = 0;  ///< normal force without load [N]
};

/// Wrenches on a and b of 1 N of friction along the slip of b; their power is the slip.
std::array<Wrench, 2> unit_friction(const Joint&, const JointFriction&, const MarkerMotion& a, const MarkerMotion& b);
/// Speed of b's surface relative to a's [m/s], and its rate with all coordinate accelerations zero [m/s²].
double slip(const Joint&, const JointFriction&, const MarkerMotion& a, const MarkerMotion& b);
double slip_acceleration(const Joint&, const JointFriction&, const MarkerMotion& a, const MarkerMotion& b);
/// The normal force N: preload plus the load of the joint. In a guide, the force across it or, if that is larger, the forces at its two
/// ends that balance the couple. @param on_b  the joint's reaction on b
double load(const Joint&, const JointFriction&, const MarkerMotion& a, const Wrench& on_b);

/// Its effect at an instant.
struct JointFrictionEffect {
  double force = 0;  ///< on b along the slip [N]
  double load = 0;   ///< N [N]
  double slip = 0;   ///< [m/s]
  bool sticks = false;
  double per_load = 0;  ///< with bristles: force over N, –
  double d_slip = 0;    ///< derivative of force over N with respect to the slip [s/m]
  std::array<double, most_internal> x_rate{};
};

/// How the force depends on the rates of the two markers, with N, bristles and poses held.
WrenchTangent wrench_tangent(const std::array<Wrench, 2>& unit, const JointFrictionEffect& now);
/// How the force and bristles depend on each other and on the rates. @pre the law has bristles
InternalTangent internal_tangent(const std::array<Wrench, 2>& unit, const JointFriction&, const JointFrictionEffect& now, const double* x);

}  // namespace pintle
