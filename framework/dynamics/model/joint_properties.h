#pragma once

#include <array>

#include "framework/dynamics/model/marker.h"
#include "framework/dynamics/model/wrench_tangent.h"

namespace pintle {

/// One joint's share of the constraints, written in terms of the poses p_i = (r, angle) of its markers, so that joints are independent of
/// the kinds of bodies:
///   C(p, t) = 0,   Σ L_i ṗ_i + Ct = 0,   Σ L_i p̈_i + kappa = 0,   L_i = ∂C/∂p_i.
/// The first m rows are used. The joint acts on marker i with the wrench −L_iᵀλ.
struct ConstraintRows {
  using Block = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;  ///< L_i; one per end of the joint
  Eigen::Vector3d C = Eigen::Vector3d::Zero();                 ///< violation [m or rad]
  Eigen::Vector3d Ct = Eigen::Vector3d::Zero();                ///< ∂C/∂t; zero unless driven [m/s or rad/s]
  Eigen::Vector3d kappa = Eigen::Vector3d::Zero();             ///< terms of C̈ without accelerations
};

/// The markers that a joint joins, in order.
struct JointEnds {
  std::array<int, most_ends> marker;
  int n;
  const int* begin() const { return marker.data(); }
  const int* end() const { return marker.data() + n; }
};

/// How a joint is drawn at its marker b. A new one needs a case in mechanism/drawing.cpp and report/drawn_model.cpp, and in
/// app/report/drawing.js.
enum class JointSymbol { none, pin, guide, pin_in_guide, rod };

/// Properties common to all joints of a kind.
struct JointProperties {
  /// Names of its constraint equations in messages. One called "angle" is in radians, others in metres.
  std::array<const char*, 3> equations = {};
  bool force = true, couple = false;            ///< which parts of its reaction are written
  bool angles = true;                           ///< rotation of a marker can change its rows
  std::array<bool, most_ends> directions = {};  ///< the markers whose direction u it uses
  JointSymbol symbol = JointSymbol::none;
  WrenchPattern curvature = {};  ///< of its wrenches for given λ
  /// Name of −λ of each equation in results, ".force", where it is written besides the wrench. [N]
  std::array<const char*, 3> efforts = {};
  constexpr int rows() const { return (equations[0] != nullptr) + (equations[1] != nullptr) + (equations[2] != nullptr); }
};

namespace joint_curvature {
inline constexpr WrenchPattern along_a_line{{{{true, true}, {true, false}}}}, all_blocks{{{{true, true}, {true, true}}}};
}

}  // namespace pintle
