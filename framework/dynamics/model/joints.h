#pragma once

#include <array>
#include <tuple>
#include <variant>

#include "framework/common/time_law.h"
#include "framework/dynamics/model/couplings.h"

namespace pintle {

/// Pin: the two points coincide. λ is the force of b on a [N], world axes.
///   C = r_b − r_a
struct Revolute {
  int a, b;  ///< markers
  auto members() const { return std::tie(a, b); }
  static constexpr JointProperties properties{.equations = {"x", "y"}, .angles = false, .symbol = JointSymbol::pin};
};
/// Pin in slot: point b stays on the line through a along a's direction u, n = Zu.
///   C = n·(r_b − r_a)      λ: push of b on a along n [N]
struct Slot {
  int a, b;
  auto members() const { return std::tie(a, b); }
  static constexpr JointProperties properties{
      .equations = {"across"}, .directions = {true}, .symbol = JointSymbol::pin_in_guide, .curvature = joint_curvature::along_a_line};
};
/// Guide: the slot, with b's direction at `angle` to a's.
///   C = [n·(r_b − r_a); φ_b − φ_a − angle]      λ: push along n [N], couple of b on a [N m]
struct Prismatic {
  int a, b;
  double angle = 0;
  auto members() const { return std::tie(a, b, angle); }
  static constexpr JointProperties properties{.equations = {"across", "angle"},
                                              .couple = true,
                                              .directions = {true},
                                              .symbol = JointSymbol::guide,
                                              .curvature = joint_curvature::along_a_line};
};
/// Clamp: the points coincide, with b's direction at `angle` to a's.
///   C = [r_b − r_a; φ_b − φ_a − angle]          λ in N, N, N m
struct Weld {
  int a, b;
  double angle = 0;
  auto members() const { return std::tie(a, b, angle); }
  static constexpr JointProperties properties{.equations = {"x", "y", "angle"}, .couple = true, .symbol = JointSymbol::pin};
};
/// Massless rigid link between two points.
///   C = |r_b − r_a| − length                    λ: tension is negative, thrust positive −λ [N]
struct Distance {
  int a, b;
  double length;  ///< > 0 [m]
  auto members() const { return std::tie(a, b, length); }
  static constexpr JointProperties properties{
      .equations = {"length"}, .angles = false, .symbol = JointSymbol::rod, .curvature = joint_curvature::all_blocks};
};
/// Imposed angle.   C = φ_b − φ_a − law(t)        −λ is the driving torque on b [N m]
struct AngleDriver {
  int a, b;
  TimeLaw law;
  auto members() const { return std::tie(a, b, law); }
  static constexpr JointProperties properties{.equations = {"angle"}, .force = false, .couple = true};
};
/// Imposed distance.   C = |r_b − r_a| − law(t)   −λ is the thrust that pushes a and b apart [N]
struct DistanceDriver {
  int a, b;
  TimeLaw law;  ///< > 0 [m]
  auto members() const { return std::tie(a, b, law); }
  static constexpr JointProperties properties{.equations = {"length"}, .angles = false, .curvature = joint_curvature::all_blocks};
};

using Joint =
    std::variant<Revolute, Slot, Prismatic, Weld, Distance, AngleDriver, DistanceDriver, Gear, Rack, RollsOnDisc, RollsOnLine, Relation>;

inline const JointProperties& properties_of(const Joint& joint) {
  return std::visit([](const auto& j) -> const JointProperties& { return j.properties; }, joint);
}
inline int rows(const Joint& j) { return properties_of(j).rows(); }

/// The markers that a joint connects, in order: its ends. They are the first members of the joint and its only ones of type int; a relation
/// stores them in a list.
JointEnds ends_of(const Joint&);

/// The law of a driver, nullptr for other joints.
const TimeLaw* driver_law(const Joint&);
TimeLaw* driver_law(Joint&);
inline bool is_driver(const Joint& j) { return driver_law(j) != nullptr; }

inline const char* row_name(const Joint& j, int row) { return properties_of(j).equations[static_cast<std::size_t>(row)]; }
bool is_angle_row(const Joint&, int row);

/// Position level: C, and L of each end. Cannot fail; a distance of zero has no direction, and the x axis is used.
/// @param markers  of the whole system
void evaluate_pose(const Joint&, const MarkerMotion* markers, double t, ConstraintRows& out, ConstraintRows::Block* L);
/// Velocity level: Ct and kappa, from markers with known speeds. After evaluate_pose.
void evaluate_speed(const Joint&, const MarkerMotion* markers, double t, ConstraintRows& out);

/// How the wrenches −L_iᵀλ depend on the poses, with λ held. @param lambda  the joint's own multipliers, rows(joint) of them
WrenchTangent wrench_tangent(const Joint&, const MarkerMotion* markers, const double* lambda);

}  // namespace pintle
