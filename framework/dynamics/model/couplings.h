#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "framework/common/time_law.h"
#include "framework/dynamics/model/joint_properties.h"

/// Joints that couple the motion of bodies: gears, racks, rolling discs, and relations of angles and lengths. They start from the assembled
/// configuration: `phase` and `constant` are what C would be there without them. Theory: docs/theory/gears.md.
namespace pintle {

/// Two pitch circles that roll without slip, with their centres held by other joints; or two pulleys on a belt. ψ is the angle of r_b −
/// r_a. Teeth push where the circles touch; a belt pulls along its spans.
///   C = radius_a φ_a + radius_b φ_b − (radius_a + radius_b) ψ − phase    −λ: force on the rim of a, counter-clockwise [N]
struct Gear {
  int a, b;
  double radius_a, radius_b;  ///< > 0, not 0; negative: both turn in the same direction, as in a ring gear or on an open belt [m]
  double phase = 0;           ///< [m]
  auto members() const { return std::tie(a, b, radius_a, radius_b, phase); }
  static constexpr JointProperties properties{
      .equations = {"teeth"}, .couple = true, .curvature = joint_curvature::all_blocks, .efforts = {".force"}};
};
/// A pinion b on a rack, the line through a along a's direction u; other joints keep it on the rack.
///   C = u·(r_b − r_a) + radius (φ_b − φ_a) − phase    −λ: force on the pinion along u, at the line [N]
struct Rack {
  int a, b;
  double radius;     ///< > 0 of a pinion to the left of the line [m]
  double phase = 0;  ///< [m]
  auto members() const { return std::tie(a, b, radius, phase); }
  static constexpr JointProperties properties{.equations = {"teeth"},
                                              .couple = true,
                                              .directions = {true},

                                              .curvature = joint_curvature::along_a_line,
                                              .efforts = {".force"}};
};
/// A disc a that rolls without slip on or inside a disc b: the gear equation, plus the distance of the centres.
///   C = [± (|r_b − r_a| − |radius_a + radius_b|); as for the gear]    the sign is that of radius_b; −λ: force that presses a on b, …  [N]
struct RollsOnDisc : Gear {
  static constexpr JointProperties properties{.equations = {"contact", "slip"},
                                              .couple = true,

                                              .curvature = joint_curvature::all_blocks,
                                              .efforts = {".normal", ".force"}};
};
/// A disc b that rolls without slip on the line through a along a's direction, n = Zu.
///   C = [± (n·(r_b − r_a) − radius); as for the rack]    the sign is that of the radius
struct RollsOnLine : Rack {
  static constexpr JointProperties properties{.equations = {"contact", "slip"},
                                              .couple = true,
                                              .directions = {true},

                                              .curvature = joint_curvature::along_a_line,
                                              .efforts = {".normal", ".force"}};
};

/// A coordinate of a relation, between two of its ends: φ_b − φ_a, u_a·(r_b − r_a) or |r_b − r_a|.
struct Coordinate {
  enum Kind { angle, displacement, distance } kind;
  int a, b;      ///< indices into the relation's ends
  double ratio;  ///< [1], [rad/m] or [m/rad]
};
inline constexpr std::size_t most_terms = most_ends / 2;

/// A linear relation of coordinates, plus a curve as a function of the first of them: a differential, a screw, a cam.
///   C = Σ ratio_i c_i − curve(c_0) − constant    −λ ∂C/∂c_i is the force or couple along c_i
struct Relation {
  JointEnds ends;  ///< each on a different body
  std::vector<Coordinate> coordinates;
  TimeLaw curve = {};  ///< a function of c_0 instead of time; empty: none
  JointProperties properties = {};
  double constant = 0;
};
/// @param of_angles  C is an angle, otherwise a length   @param coordinates  at most most_terms
Relation relation(bool of_angles, const JointEnds&, std::vector<Coordinate> coordinates, TimeLaw curve = {});

/// Same functions as for every joint: joints.h.
void pose(const Gear&, const MarkerMotion* m, double, ConstraintRows&, ConstraintRows::Block* L);
void speed(const Gear&, const MarkerMotion* m, double, ConstraintRows&);
void curve(const Gear&, const MarkerMotion* m, const double* lambda, WrenchTangent&);
void pose(const Rack&, const MarkerMotion* m, double, ConstraintRows&, ConstraintRows::Block* L);
void speed(const Rack&, const MarkerMotion* m, double, ConstraintRows&);
void curve(const Rack&, const MarkerMotion* m, const double* lambda, WrenchTangent&);
void pose(const RollsOnDisc&, const MarkerMotion* m, double, ConstraintRows&, ConstraintRows::Block* L);
void speed(const RollsOnDisc&, const MarkerMotion* m, double, ConstraintRows&);
void curve(const RollsOnDisc&, const MarkerMotion* m, const double* lambda, WrenchTangent&);
void pose(const RollsOnLine&, const MarkerMotion* m, double, ConstraintRows&, ConstraintRows::Block* L);
void speed(const RollsOnLine&, const MarkerMotion* m, double, ConstraintRows&);
void curve(const RollsOnLine&, const MarkerMotion* m, const double* lambda, WrenchTangent&);
void pose(const Relation&, const MarkerMotion* m, double, ConstraintRows&, ConstraintRows::Block* L);
void speed(const Relation&, const MarkerMotion* m, double, ConstraintRows&);
void curve(const Relation&, const MarkerMotion* m, const double* lambda, WrenchTangent&);

}  // namespace pintle
