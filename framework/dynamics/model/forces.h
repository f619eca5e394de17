#pragma once

#include <array>
#include <span>
#include <tuple>
#include <variant>

#include "framework/common/time_law.h"
#include "framework/dynamics/model/belt_span.h"
#include "framework/dynamics/model/internal_states.h"
#include "framework/dynamics/model/marker.h"
#include "framework/dynamics/model/wrench_tangent.h"

namespace pintle {

/// Effect of a force element at an instant: wrenches on its two markers, and the power balance.
/// It satisfies wrench_a·ṗ_a + wrench_b·ṗ_b = input − dissipation − d(stored)/dt.
struct ForceEffect {
  Wrench on_a = Wrench::Zero(), on_b = Wrench::Zero();
  double stored = 0;                           ///< recoverable energy [J]
  double dissipation = 0;                      ///< power lost, never negative [W]
  double input = 0;                            ///< power supplied from outside [W]
  std::array<double, most_internal> x_rate{};  ///< rates of its internal states
};

/// A force on b, in world axes or, if `follows`, turning with b's direction. a is unused (ground).
struct PointForce {
  int a, b;      ///< markers
  TimeLaw x, y;  ///< [N]
  bool follows = false;
  auto members() const { return std::tie(a, b, x, y, follows); }
};
/// A torque on b, its opposite on a.
struct Torque {
  int a, b;
  TimeLaw law;  ///< [N m]
  auto members() const { return std::tie(a, b, law); }
};
/// f = k(ℓ − ℓ₀) + c ℓ̇ along the line from a to b, pulling when positive.
struct Spring {
  int a, b;
  double k, c, free_length;  ///< [N/m], [N s/m], [m]
  auto members() const { return std::tie(a, b, k, c, free_length); }
};
/// τ = k(φ − φ₀) + c φ̇, φ = φ_b − φ_a; restoring torque on b.
struct TorsionSpring {
  int a, b;
  double k, c, free_angle;  ///< [N m/rad], [N m s/rad], [rad]
  auto members() const { return std::tie(a, b, k, c, free_angle); }
};

/// A spring and a damper in series along the line from a to b [Maxwell1867]. Its internal state x is the damper's length:
/// f = k(ℓ − x), ẋ = f/c.
struct Maxwell {
  int a, b;
  double k, c;  ///< [N/m], [N s/m]
  auto members() const { return std::tie(a, b, k, c); }
};

/// Forces whose components are laws of signals, System::laws[size …]: on b in world axes or turning with b's direction (x, y), a couple on
/// b and its opposite on a, a pull along the line from a to b, a couple that turns b back. [N] or [N m]
struct SizedForce {
  enum Way { world, follows, couple, pull, restoring } way;
  int a, b;
  int size, other = -1;  ///< for forces x and y; otherwise the only one
  auto members() const { return std::tie(way, a, b, size, other); }
};

using Force = std::variant<PointForce, Torque, Spring, TorsionSpring, Maxwell, SizedForce, BeltSpan>;

/// The internal states of a force element, in order.
std::span<const InternalState> internal_states(const Force&);

/// Cannot fail. A spring of zero length has no direction and exerts no force.
/// @param x  the internal states, if it has any   @param laws  values of the system's laws, if it uses any
ForceEffect evaluate(const Force&, const MarkerMotion& a, const MarkerMotion& b, double t, const double* x, const double* laws = nullptr);

WrenchPattern wrench_pattern(const Force&);
/// How the wrenches depend on the motion, with internal states held. @param now  effect of the force in this state
WrenchTangent wrench_tangent(const Force&, const ForceEffect& now, const MarkerMotion& a, const MarkerMotion& b);
/// Wrenches of a unit of its size, or of its other size.
struct UnitWrenches {
  Wrench on_a = Wrench::Zero(), on_b = Wrench::Zero();
};
UnitWrenches unit_wrenches(const SizedForce&, bool other, const MarkerMotion& a, const MarkerMotion& b);

/// How wrenches and internal states depend on each other and on the motion.
InternalTangent internal_tangent(const Force&, const ForceEffect& now, const MarkerMotion& a, const MarkerMotion& b);

/// Whether it needs b's direction u.
inline bool turns_with_b(const Force& f) {
  const auto* point = std::get_if<PointForce>(&f);
  const auto* sized = std::get_if<SizedForce>(&f);
  return (point && point->follows) || (sized && sized->way == SizedForce::follows);
}
inline int marker_a(const Force& f) {
  return std::visit([](const auto& k) { return k.a; }, f);
}
inline int marker_b(const Force& f) {
  return std::visit([](const auto& k) { return k.b; }, f);
}

}  // namespace pintle
