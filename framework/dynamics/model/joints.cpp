#include "framework/dynamics/model/joints.h"

#include <cmath>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "framework/common/index.h"
#include "framework/dynamics/model/joint_parts.h"

namespace pintle {

namespace {

using Eigen::Vector2d;
using Block = ConstraintRows::Block;
using M = const MarkerMotion&;
using namespace joint_parts;

void coincide(M a, M b, ConstraintRows& out, Block* L) {
  out.C.head<2>() = b.r - a.r;
  L[0].row(0) << -1, 0, 0;
  L[0].row(1) << 0, -1, 0;
  L[1].row(0) << 1, 0, 0;
  L[1].row(1) << 0, 1, 0;
}

// Across a's direction u: n·d, n = Zu.
void ride_line(M a, M b, ConstraintRows& out, Block* L) { project(a, b, perp(a.u), 0, out, L); }
double ride_line_kappa(M a, M b) { return project_kappa(a, b, perp(a.u)); }
void ride_line_tangent(M a, M b, double lambda, WrenchTangent& out) { project_tangent(a, b, perp(a.u), lambda, out); }

void keep_angle(M a, M b, double angle, int row, ConstraintRows& out, Block* L) {
  out.C[row] = b.angle - a.angle - angle;
  L[0].row(row) << 0, 0, -1;
  L[1].row(row) << 0, 0, 1;
}

void keep_length_tangent(M a, M b, double lambda, WrenchTangent& out) { oppose(lambda * length_curvature(a, b), out.pose); }

// For each joint: `pose` gives C and L; `speed` gives Ct and kappa, where nonzero; `curve` gives the tangent of its wrenches, where
// nonzero. m: all markers.

void pose(const Revolute& j, const MarkerMotion* m, double, ConstraintRows& out, Block* L) { coincide(m[j.a], m[j.b], out, L); }

void pose(const Slot& j, const MarkerMotion* m, double, ConstraintRows& out, Block* L) { ride_line(m[j.a], m[j.b], out, L); }
void speed(const Slot& j, const MarkerMotion* m, double, ConstraintRows& out) { out.kappa[0] = ride_line_kappa(m[j.a], m[j.b]); }
void curve(const Slot& j, const MarkerMotion* m, const double* lambda, WrenchTangent& out) {
  ride_line_tangent(m[j.a], m[j.b], lambda[0], out);
}

void pose(const Prismatic& j, const MarkerMotion* m, double, ConstraintRows& out, Block* L) {
  ride_line(m[j.a], m[j.b], out, L);
  keep_angle(m[j.a], m[j.b], j.angle, 1, out, L);
}
void speed(const Prismatic& j, const MarkerMotion* m, double, ConstraintRows& out) { out.kappa[0] = ride_line_kappa(m[j.a], m[j.b]); }
void curve(const Prismatic& j, const MarkerMotion* m, const double* lambda, WrenchTangent& out) {
  ride_line_tangent(m[j.a], m[j.b], lambda[0], out);
}

void pose(const Weld& j, const MarkerMotion* m, double, ConstraintRows& out, Block* L) {
  coincide(m[j.a], m[j.b], out, L);
  keep_angle(m[j.a], m[j.b], j.angle, 2, out, L);
}

void pose(const Distance& j, const MarkerMotion* m, double, ConstraintRows& out, Block* L) {
  keep_length(m[j.a], m[j.b], j.length, 0, out, L);
}
void speed(const Distance& j, const MarkerMotion* m, double, ConstraintRows& out) { out.kappa[0] = keep_length_kappa(m[j.a], m[j.b]); }
void curve(const Distance& j, const MarkerMotion* m, const double* lambda, WrenchTangent& out) {
  keep_length_tangent(m[j.a], m[j.b], lambda[0], out);
}

void pose(const AngleDriver& j, const MarkerMotion* m, double t, ConstraintRows& out, Block* L) {
  keep_angle(m[j.a], m[j.b], j.law(t).value, 0, out, L);
}
void speed(const AngleDriver& j, const MarkerMotion*, double t, ConstraintRows& out) {
  const Jet law = j.law(t);
  out.Ct[0] = -law.rate;
  out.kappa[0] = -law.accel;
}

void pose(const DistanceDriver& j, const MarkerMotion* m, double t, ConstraintRows& out, Block* L) {
  keep_length(m[j.a], m[j.b], j.law(t).value, 0, out, L);
}
void speed(const DistanceDriver& j, const MarkerMotion* m, double t, ConstraintRows& out) {
  const Jet law = j.law(t);
  out.Ct[0] = -law.rate;
  out.kappa[0] = keep_length_kappa(m[j.a], m[j.b]) - law.accel;
}
void curve(const DistanceDriver& j, const MarkerMotion* m, const double* lambda, WrenchTangent& out) {
  keep_length_tangent(m[j.a], m[j.b], lambda[0], out);
}

template <class Kind>
concept HasSpeed = requires(const Kind& j, const MarkerMotion* m, ConstraintRows& out) {
  speed(j, m, 0.0, out);
};
template <class Kind>
concept Curves = requires(const Kind& j, const MarkerMotion* m, WrenchTangent& out) {
  curve(j, m, nullptr, out);
};
template <class Kind>
concept IsDriver = requires(const Kind& j) {
  j.law;
};

}  // namespace

namespace {

// The markers are the leading members of type int.
template <class... Member>
JointEnds leading_ints(const std::tuple<Member&...>& members) {
  static_assert((0 + ... + std::is_same_v<Member, const int>) <= most_ends);
  JointEnds out{{}, 0};
  bool leading = true;
  const auto see = [&](const auto& member) {
    if constexpr (std::is_same_v<decltype(member), const int&>) {
      if (leading) out.marker[at(out.n++)] = member;
    } else {
      leading = false;
    }
  };
  std::apply([&](const auto&... each) { (see(each), ...); }, members);
  return out;
}

}  // namespace

JointEnds ends_of(const Joint& joint) {
  const auto listed = [](const auto& j) {
    if constexpr (requires { j.ends; })
      return j.ends;
    else
      return leading_ints(j.members());
  };
  return std::visit(listed, joint);
}

const TimeLaw* driver_law(const Joint& joint) {
  const auto law = []<class Kind>(const Kind& j) -> const TimeLaw* {
    if constexpr (IsDriver<Kind>)
      return &j.law;
    else
      return nullptr;
  };
  return std::visit(law, joint);
}
TimeLaw* driver_law(Joint& joint) { return const_cast<TimeLaw*>(driver_law(std::as_const(joint))); }

bool is_angle_row(const Joint& j, int row) { return std::string_view(row_name(j, row)) == "angle"; }

namespace {

// Called at every evaluation: a switch, because std::visit uses a table of pointers for so many kinds.
template <std::size_t kind = 0, class F>
void of_its_kind(const Joint& joint, const F& f) {
  if constexpr (kind < std::variant_size_v<Joint>) {
    if (joint.index() == kind)
      f(*std::get_if<kind>(&joint));
    else
      of_its_kind<kind + 1>(joint, f);
  }
}

}  // namespace

void evaluate_pose(const Joint& joint, const MarkerMotion* markers, double t, ConstraintRows& out, Block* L) {
  of_its_kind(joint, [&](const auto& j) { pose(j, markers, t, out, L); });
}

void evaluate_speed(const Joint& joint, const MarkerMotion* markers, double t, ConstraintRows& out) {
  const auto evaluate = [&]<class Kind>(const Kind& j) {
    if constexpr (HasSpeed<Kind>) speed(j, markers, t, out);
  };
  of_its_kind(joint, evaluate);
}

WrenchTangent wrench_tangent(const Joint& joint, const MarkerMotion* markers, const double* lambda) {
  WrenchTangent out(ends_of(joint).n);
  const auto evaluate = [&]<class Kind>(const Kind& j) {
    if constexpr (Curves<Kind>) curve(j, markers, lambda, out);
  };
  std::visit(evaluate, joint);
  return out;
}

}  // namespace pintle
