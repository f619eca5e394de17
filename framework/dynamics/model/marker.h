#pragma once

#include <array>

#include <Eigen/Core>

#include "contact/plane.h"
#include "eigen_layout.h"

namespace pintle {

inline constexpr int ground = -1;

/// A material point of a body with a direction fixed to it. Joints, springs, loads, contacts and drawings access bodies only through
/// markers, and do not depend on the kind of body.
struct Marker {
  int body = ground;                               ///< index into System::bodies, or `ground`
  Eigen::Vector2d x_BP = Eigen::Vector2d::Zero();  ///< position from the mass centre, body axes [m]
  double angle = 0;                                ///< direction, body axes [rad]
  Eigen::Matrix2Xd shape = {};                     ///< of a flexible body: displacement per modal coordinate, 2 × n
  Eigen::RowVectorXd slope = {};                   ///< … and rotation of the direction, 1 × n
  /// For a body with geometric stiffness from loads at its points: second-order displacement along x and along y, n × n each; otherwise
  /// empty.
  std::array<Eigen::MatrixXd, 2> second = {};
};

/// Motion of a marker, world axes. Its pose is p = (r, angle), three numbers, and
/// ṗ = J s,  p̈ = J ṡ + (a0, alpha0)  with s its body's speeds:  J = [1 Zd flex; 0 1 slope].
struct MarkerMotion {
  Eigen::Vector2d r;                             ///< position [m]
  Eigen::Vector2d d;                             ///< from the point of the body's coordinates to P [m]
  Eigen::Vector2d u = Eigen::Vector2d::Zero();   ///< unit vector along the direction, where needed
  double angle = 0;                              ///< direction, unwrapped [rad]
  Eigen::Vector2d v = Eigen::Vector2d::Zero();   ///< velocity [m/s]
  Eigen::Vector2d a0 = Eigen::Vector2d::Zero();  ///< acceleration when ṡ = 0 [m/s²]
  double w = 0;                                  ///< angular velocity [rad/s]
  double alpha0 = 0;                             ///< angular acceleration when ṡ = 0 [rad/s²]
  Eigen::Matrix2Xd flex = {};                    ///< velocity per modal speed, 2 × n; rigid: 2 × 0
};

/// A force and a couple at a marker, world axes, conjugate to ṗ. [N, N, N m]
using Wrench = Eigen::Vector3d;

}  // namespace pintle
