#pragma once

#include <variant>

#include "framework/common/time_law.h"
#include "framework/dynamics/model/marker.h"

namespace pintle {

/// One joint's share of the constraints, written in the poses p = (r, angle) of its two markers, so
/// that no joint knows what a body is:
///   C(p_a, p_b, t) = 0,   La ṗ_a + Lb ṗ_b + Ct = 0,   La p̈_a + Lb p̈_b + kappa = 0.
/// The first m rows are used. The joint acts on marker b with the wrench −Lbᵀλ, on a with −Laᵀλ.
struct ConstraintRows {
  using Block = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  Eigen::Vector3d C = Eigen::Vector3d::Zero();      ///< violation [m or rad]
  Block La = Block::Zero(), Lb = Block::Zero();     ///< ∂C/∂p_a, ∂C/∂p_b
  Eigen::Vector3d Ct = Eigen::Vector3d::Zero();     ///< ∂C/∂t; zero unless driven [m/s or rad/s]
  Eigen::Vector3d kappa = Eigen::Vector3d::Zero();  ///< what C̈ holds besides accelerations
};

/// Pin: the two points coincide. λ is the force of b on a [N], world axes.
///   C = r_b − r_a
struct Revolute {
  int a, b;  ///< markers
  static constexpr int rows = 2;
};
/// Pin in slot: point b rides the line through a along a's direction u, n = Zu.
///   C = n·(r_b − r_a)      λ: push of b on a along n [N]
struct Slot {
  int a, b;
  static constexpr int rows = 1;
};
/// Guide: the slot, and b's direction keeps `angle` to a's.
///   C = [n·(r_b − r_a); φ_b − φ_a − angle]      λ: push along n [N], couple of b on a [N m]
struct Prismatic {
  int a, b;
  double angle = 0;
  static constexpr int rows = 2;
};
/// Clamp: the points coincide and b's direction keeps `angle` to a's.
///   C = [r_b − r_a; φ_b − φ_a − angle]          λ in N, N, N m
struct Weld {
  int a, b;
  double angle = 0;
  static constexpr int rows = 3;
};
/// Massless rigid link between two points.
///   C = |r_b − r_a| − length                    λ: tension is negative, thrust positive −λ [N]
struct Distance {
  int a, b;
  double length;  ///< > 0 [m]
  static constexpr int rows = 1;
};
/// Imposed angle.   C = φ_b − φ_a − law(t)        −λ is the driving torque on b [N m]
struct AngleDriver {
  int a, b;
  TimeLaw law;
  static constexpr int rows = 1;
};
/// Imposed distance.   C = |r_b − r_a| − law(t)   −λ is the thrust that parts a and b [N]
struct DistanceDriver {
  int a, b;
  TimeLaw law;  ///< > 0 [m]
  static constexpr int rows = 1;
};

using Joint = std::variant<Revolute, Slot, Prismatic, Weld, Distance, AngleDriver, DistanceDriver>;

inline int rows(const Joint& j) {
  return std::visit([](const auto& k) { return k.rows; }, j);
}
inline int marker_a(const Joint& j) {
  return std::visit([](const auto& k) { return k.a; }, j);
}
inline int marker_b(const Joint& j) {
  return std::visit([](const auto& k) { return k.b; }, j);
}
bool is_driver(const Joint&);
/// How the joint's row is called in messages: "x", "y", "across", "angle", "length".
const char* row_name(const Joint&, int row);

bool is_angle_row(const Joint&, int row);
/// Can turning a marker change its rows?
bool feels_angle(const Joint&);

/// Position level: C, La, Lb. Cannot fail; a distance of zero has no direction and gives x.
void evaluate_pose(const Joint&, const MarkerMotion& a, const MarkerMotion& b, double t,
                   ConstraintRows& out);
/// Velocity level: Ct and kappa, from markers whose speeds are known. After evaluate_pose.
void evaluate_speed(const Joint&, const MarkerMotion& a, const MarkerMotion& b, double t,
                    ConstraintRows& out);

}  // namespace pintle
