#include "framework/mechanism/drawn_symbols.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "framework/common/index.h"
#include "framework/mechanism/profile_contact.h"
#include "framework/mechanism/result_tables.h"

namespace pintle {

namespace {

using Eigen::Vector2d;

bool on_ground(const System& system, int marker) { return system.markers[at(marker)].body == ground; }

Vector2d turned_left(const Vector2d& u) { return {-u.y(), u.x()}; }

}  // namespace

FirstOwners::FirstOwners(const System& s)
    : joint(static_cast<int>(s.bodies.size())),
      contact(joint + static_cast<int>(s.joints.size())),
      force(contact + static_cast<int>(s.contacts.size())),
      of_ground(force + static_cast<int>(s.forces.size())) {}

// Ground ------------------------------------------------------------------------------------------

namespace {

/// Short strokes to the left of a line, on the side of the ground, where `near` is true.
template <class Near>
void hatch(const Vector2d& from, const Vector2d& to, double spacing, int owner, const Near& near, Drawing& out) {
  const double length = (to - from).norm();
  if (!(length > 0)) return;
  const Vector2d u = (to - from) / length, stroke = 0.6 * spacing * (turned_left(u) - u);
  constexpr double most = 1e6;  // number of strokes examined
  const auto strokes = static_cast<int>(std::min(most, std::ceil(length / spacing - 0.5)));
  for (int k = 0; k < strokes; ++k) {
    const Vector2d foot = from + (k + 0.5) * spacing * u;
    if (near(foot)) out.lines.push_back({Part::hatch, owner, false, {foot, foot + stroke}});
  }
}

constexpr auto everywhere = [](const Vector2d&) { return true; };

/// A triangle standing on the ground below a pin.
void draw_support(const Vector2d& pin, double size, int owner, Drawing& out) {
  const Vector2d left = pin + Vector2d(-size, -1.6 * size), right = pin + Vector2d(size, -1.6 * size), beyond(0.6 * size, 0);
  out.lines.push_back({Part::hatch, owner, true, {pin, left, right}});
  out.lines.push_back({Part::hatch, owner, false, {left - beyond, right + beyond}});
  hatch(right + beyond, left - beyond, 0.64 * size, owner, everywhere, out);
}

void draw_supports(const System& system, const Drafting& drafting, const Equations& eq, int owner, Drawing& out) {
  for (int k = 0; k < static_cast<int>(system.joints.size()); ++k) {
    if (is_link(system, k) || properties_of(system.joints[at(k)]).symbol != JointSymbol::pin) continue;
    const JointEnds ends = ends_of(system.joints[at(k)]);
    const int a = ends.marker[0], b = ends.marker[1];
    if (on_ground(system, a) || on_ground(system, b))
      draw_support(eq.motion[at(on_ground(system, a) ? a : b)].r, 1.8 * drafting.pin, owner, out);
  }
  for (std::size_t c = 0; c < at(n_clearances(system)); ++c) {
    const ContactPair& pair = system.contacts[c];
    if (on_ground(system, pair.a) || on_ground(system, pair.b))
      draw_support(eq.motion[at(pair.b)].r, 1.6 * std::max(bearing_radius(pair.gap), drafting.pin), owner, out);
  }
}

void draw_ground_guides(const System& system, const Equations& eq, int owner, Drawing& out) {
  for (const Joint& joint : system.joints) {
    const JointSymbol symbol = properties_of(joint).symbol;
    if (symbol != JointSymbol::guide && symbol != JointSymbol::pin_in_guide) continue;
    const JointEnds ends = ends_of(joint);
    if (!on_ground(system, ends.marker[0])) continue;
    const MarkerMotion &a = eq.motion[at(ends.marker[0])], &b = eq.motion[at(ends.marker[1])];
    const Vector2d foot = a.r + a.u * a.u.dot(b.r - a.r), half = 0.5 * system.length * a.u;
    hatch(foot + half, foot - half, system.length / 25, owner, everywhere, out);
  }
}

}  // namespace

void draw_ground(const Model& model, const Drafting& drafting, const Equations& eq, Drawing& out) {
  const System& system = model.system;
  const int owner = FirstOwners(system).of_ground;
  draw_supports(system, drafting, eq, owner, out);
  draw_ground_guides(system, eq, owner, out);
  std::vector<Vector2d> moving;
  for (const Marker& m : system.markers)
    if (m.body != ground) moving.push_back(eq.motion[at(static_cast<int>(&m - system.markers.data()))].r);
  const auto near = [&](const Vector2d& foot) {
    return std::ranges::any_of(moving, [&](const Vector2d& r) { return (r - foot).norm() < system.length; });
  };
  for (const DrawnProfile& p : model.profiles) {
    if (p.body != ground) continue;
    const MarkerMotion& carrier = eq.motion[at(p.marker)];
    const Eigen::Rotation2Dd A(carrier.angle);
    const auto place = [&](std::size_t i) -> Vector2d { return carrier.r + A * p.points[i % p.points.size()]; };
    for (std::size_t i = 0; i + (p.solid ? 0 : 1) < p.points.size(); ++i)
      hatch(place(i), place(i + 1), system.length / 25, owner, near, out);
  }
}

// Bars of bodies with surfaces --------------------------------------------------------------------

void draw_bars(const Model& model, const Equations& eq, Drawing& out) {
  const System& system = model.system;
  std::vector<std::vector<Vector2d>> held(system.bodies.size());  // by body
  const auto hold = [&](int a, int b) {
    for (const int marker : {a, b})
      if (!on_ground(system, marker)) held[at(system.markers[at(marker)].body)].push_back(eq.motion[at(marker)].r);
  };
  for (std::size_t k = 0; k < system.joints.size(); ++k) {
    const JointEnds ends = ends_of(system.joints[k]);
    if (properties_of(system.joints[k]).symbol != JointSymbol::none) hold(ends.marker[0], ends.marker[1]);
  }
  for (std::size_t c = 0; c < at(n_clearances(system)); ++c) hold(system.contacts[c].a, system.contacts[c].b);
  std::vector<bool> has_surface(system.bodies.size(), false);
  for (const DrawnProfile& p : model.profiles) {
    if (p.body == ground || p.points.empty()) continue;
    const MarkerMotion& carrier = eq.motion[at(p.marker)];
    Vector2d middle(0, 0);
    for (const Vector2d& x : p.points) middle += x / static_cast<double>(p.points.size());
    held[at(p.body)].emplace_back(carrier.r + Eigen::Rotation2Dd(carrier.angle) * middle);
    has_surface[at(p.body)] = true;
  }
  for (std::size_t b = 0; b < held.size(); ++b)
    for (std::size_t i = 1; has_surface[b] && i < held[b].size(); ++i)
      if ((held[b][i] - held[b][0]).norm() > 1e-3 * system.length)
        out.lines.push_back({Part::link, static_cast<int>(b), false, {held[b][0], held[b][i]}});
}

// Cylinders and springs ---------------------------------------------------------------------------

namespace {

/// A barrel at a, and a rod from b into it.
void draw_cylinder(const Vector2d& a, const Vector2d& b, double half_width, int owner, Drawing& out) {
  const Vector2d d = b - a;
  if (!(d.norm() > 0)) return;
  const Vector2d side = half_width * turned_left(d.normalized()), mouth = a + 0.55 * d;
  out.lines.push_back({Part::cylinder, owner, false, {a + 0.4 * d, b}});
  out.lines.push_back({Part::cylinder, owner, true, {a - side, mouth - side, mouth + side, a + side}});
}

void draw_coil(const Vector2d& a, const Vector2d& b, double width, int owner, Drawing& out) {
  constexpr int turns = 12;
  const Vector2d d = b - a;
  const Vector2d side = d.norm() > 0 ? Vector2d(width * turned_left(d.normalized())) : Vector2d(0, 0);
  DrawnLine line{Part::spring, owner, false, {a}};
  for (int i = 1; i < turns; ++i) {
    const double out_of_line = i == 1 || i == turns - 1 ? 0 : i % 2 ? 1 : -1;
    line.points.emplace_back(a + d * i / turns + out_of_line * side);
  }
  line.points.push_back(b);
  out.lines.push_back(std::move(line));
}

/// Two turns around b, from the direction of one body to that of the other.
void draw_spiral(const MarkerMotion& a, const MarkerMotion& b, double radius, int owner, Drawing& out) {
  constexpr int points = 65;
  DrawnLine line{Part::spring, owner, false, {}};
  for (int i = 0; i < points; ++i) {
    const double share = i / (points - 1.0), angle = a.angle + share * (4 * std::numbers::pi + b.angle - a.angle);
    line.points.emplace_back(b.r + radius * (1 + 1.2 * share) * Vector2d(std::cos(angle), std::sin(angle)));
  }
  out.lines.push_back(std::move(line));
}

bool is_angular_spring(const Force& force) {
  const auto* sized = std::get_if<SizedForce>(&force);
  return std::holds_alternative<TorsionSpring>(force) || (sized && sized->way == SizedForce::restoring);
}

/// Where angular springs are drawn.
class TurningEnds {
 public:
  explicit TurningEnds(const System& system) : system_(system) {
    if (std::ranges::none_of(system.forces, is_angular_spring)) return;
    for (std::size_t c = 0; c < at(n_clearances(system)); ++c) add_pin(system.contacts[c].a, system.contacts[c].b);
    for (const Joint& joint : system.joints)
      if (properties_of(joint).symbol == JointSymbol::pin) add_pin(ends_of(joint).marker[0], ends_of(joint).marker[1]);
  }

  /// The markers of an angular spring; or if they are the origins of two bodies that a pin joins, those of the first such pin, in the same
  /// order.
  std::array<int, 2> of(const Force& spring) const {
    const std::array<int, 2> ends{marker_a(spring), marker_b(spring)};
    if (!is_origin(ends[0]) || !is_origin(ends[1])) return ends;
    const auto pin = pins_.find({body_of(ends[0]), body_of(ends[1])});
    return pin == pins_.end() ? ends : pin->second;
  }

 private:
  void add_pin(int a, int b) {
    pins_.try_emplace({body_of(a), body_of(b)}, std::array{a, b});
    pins_.try_emplace({body_of(b), body_of(a)}, std::array{b, a});
  }
  int body_of(int marker) const { return system_.markers[at(marker)].body; }
  bool is_origin(int marker) const {
    const Marker& m = system_.markers[at(marker)];
    return m.x_BP == (m.body == ground ? Vector2d::Zero() : system_.bodies[at(m.body)].x_BO);
  }

  const System& system_;
  std::map<std::pair<int, int>, std::array<int, 2>> pins_;  ///< by the bodies that they join
};

}  // namespace

std::vector<DrawnActuator> actuators_of(const System& system, const Drafting& drafting) {
  const FirstOwners first(system);
  const TurningEnds turning(system);
  std::vector<DrawnActuator> out;
  for (std::size_t k = 0; k < system.joints.size(); ++k)
    if (const auto* driver = std::get_if<DistanceDriver>(&system.joints[k]))
      out.push_back({DrawnActuator::cylinder, driver->a, driver->b, first.joint + static_cast<int>(k), drafting.pin});
  for (std::size_t f = 0; f < system.forces.size(); ++f) {
    const Force& force = system.forces[f];
    const auto* sized = std::get_if<SizedForce>(&force);
    const auto add = [&](DrawnActuator::Kind kind, double width) {
      const auto [a, b] = kind == DrawnActuator::spiral ? turning.of(force) : std::array{marker_a(force), marker_b(force)};
      out.push_back({kind, a, b, first.force + static_cast<int>(f), width});
    };
    if (std::holds_alternative<Spring>(force) || std::holds_alternative<Maxwell>(force)) add(DrawnActuator::coil, drafting.pin);
    if (sized && sized->way == SizedForce::pull) add(DrawnActuator::cylinder, 0.7 * drafting.pin);
    if (is_angular_spring(force)) add(DrawnActuator::spiral, drafting.pin);
  }
  return out;
}

void draw_actuators(const System& system, const Drafting& drafting, const Equations& eq, Drawing& out) {
  for (const DrawnActuator& one : actuators_of(system, drafting)) {
    const MarkerMotion &a = eq.motion[at(one.a)], &b = eq.motion[at(one.b)];
    switch (one.kind) {
      case DrawnActuator::cylinder: draw_cylinder(a.r, b.r, one.width, one.owner, out); break;
      case DrawnActuator::coil: draw_coil(a.r, b.r, one.width, one.owner, out); break;
      case DrawnActuator::spiral: draw_spiral(a, b, one.width, one.owner, out); break;
    }
  }
}

// Forces and points -------------------------------------------------------------------------------

void draw_reactions_and_loads(const System& system, const Equations& eq, Drawing& out) {
  const FirstOwners first(system);
  const auto add = [&](const Vector2d& at, const Wrench& w, int owner, Giver giver) {
    if (w.allFinite()) out.forces.push_back({at, w.head<2>(), owner, giver, w[2]});
  };
  if (eq.lambda.size() == system.n_rows())
    for (int k = 0; k < static_cast<int>(system.joints.size()); ++k) {
      if (is_link(system, k)) continue;  // its clearance shows the force
      const JointEnds ends = ends_of(system.joints[at(k)]);
      const int marker = ends.marker[on_ground(system, ends.marker[1]) ? 0 : 1];
      add(eq.motion[at(marker)].r, joint_wrench(system, eq, k), first.joint + k, Giver::joint);
    }
  const TurningEnds turning(system);
  for (std::size_t f = 0; f < std::min(system.forces.size(), eq.force.size()); ++f) {
    const Force& force = system.forces[f];
    const auto* sized = std::get_if<SizedForce>(&force);
    const bool load = std::holds_alternative<PointForce>(force) || std::holds_alternative<Torque>(force) ||
                      (sized && sized->way != SizedForce::pull && sized->way != SizedForce::restoring);
    const int marker = is_angular_spring(force) ? turning.of(force)[1] : marker_b(force);
    add(eq.motion[at(marker)].r, eq.force[f].on_b, first.force + static_cast<int>(f), load ? Giver::load : Giver::spring);
  }
}

void follow_points(const Model& model, const State& state, const Equations& eq, Drawing& out) {
  const System& system = model.system;
  for (const RecordedPoint& p : model.points) {
    if (p.marker.body == ground) continue;
    const double* q = state.y.data() + 3 * p.marker.body;
    Vector2d x = p.marker.x_BP;
    if (const Eigen::Index n = p.marker.shape.cols(); n > 0) x += p.marker.shape * state.y.segment(system.eta_begin[at(p.marker.body)], n);
    out.followed.push_back({p.name, Vector2d(q[0], q[1]) + Eigen::Rotation2Dd(q[2]) * x});
  }
  constexpr std::size_t most_pins = 12;  // with more, their paths would hide the mechanism
  if (model.points.empty() && system.joints.size() <= 2 * most_pins)
    for (int k = 0; k < static_cast<int>(system.joints.size()); ++k) {
      if (is_link(system, k) || properties_of(system.joints[at(k)]).symbol != JointSymbol::pin) continue;
      const JointEnds ends = ends_of(system.joints[at(k)]);
      if (!on_ground(system, ends.marker[0]) && !on_ground(system, ends.marker[1]))
        out.followed.push_back({system.joint_names[at(k)], eq.motion[at(ends.marker[1])].r});
    }
  if (model.points.empty() && out.followed.size() > most_pins) out.followed.clear();
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    const ContactPair& pair = system.contacts[c];
    const Vector2d centre = eq.motion[at(pair.b)].r;
    Vector2d touch = centre;
    if (pair.profiles)
      touch = contact_place(system, c, state, eq);
    else
      touch += bearing_radius(pair.gap) * clearance_effect(system, eq, c).gap.n;
    out.touching.push_back({system.contact_names[c], touch.allFinite() ? touch : centre});
  }
}

}  // namespace pintle
