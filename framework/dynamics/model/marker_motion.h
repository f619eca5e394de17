#pragma once

#include "contact/gap.h"
#include "framework/dynamics/model/system.h"

/// Markers on flexible bodies: docs/theory/motion.md.
namespace pintle {

/// Pose of a marker on a flexible body whose frame is rotated by (cos, sin): d = A(x + Φη + ½ηᵀΨη), its derivative with respect to η in
/// `flex`, and the angle including the slope; u is not changed.
void pose_on_flexible(const System&, const Marker&, const Eigen::VectorXd& y, double cos, double sin, MarkerMotion&);
/// Adds the effect of deformation to v, w and a0. @pre they are those of a point fixed in the frame
void move_on_flexible(const System&, const Marker&, const Eigen::VectorXd& y, double cos, double sin, MarkerMotion&);

/// Position, velocity and spin of a marker's point, on any body, from the coordinates alone.
MovingPoint moving_point(const System&, int marker, const Eigen::VectorXd& y);

}  // namespace pintle
