#pragma once

#include "contact/gap.h"
#include "framework/dynamics/model/system.h"

/// Markers on bodies that bend: docs/theory/motion.md.
namespace pintle {

/// Pose of a marker on a flexible body whose frame is turned by (cos, sin): d = A(x + Φη + ½ηᵀΨη), its
/// derivative by η in `flex`, and the angle turned by the slope; u is not touched.
void pose_on_flexible(const System&, const Marker&, const Eigen::VectorXd& y, double cos, double sin, MarkerMotion&);
/// Adds what deformation does to v, w and a0. @pre they are those of a point of the frame
void move_on_flexible(const System&, const Marker&, const Eigen::VectorXd& y, double cos, double sin, MarkerMotion&);

/// Place, velocity and spin of a marker's point, on any body, from the coordinates alone.
MovingPoint moving_point(const System&, int marker, const Eigen::VectorXd& y);

}  // namespace pintle
