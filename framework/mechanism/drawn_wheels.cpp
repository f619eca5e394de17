#include "framework/mechanism/drawn_wheels.h"

#include <cmath>
#include <numbers>
#include <type_traits>
#include <variant>

#include "framework/common/index.h"
#include "framework/mechanism/drawn_symbols.h"

namespace pintle {

namespace {

using Eigen::Vector2d;

void add_teeth(const Joint& joint, int owner, DrawnWheels& out) {
  const auto of_kind = [&]<class Kind>(const Kind& j) {
    if constexpr (std::is_base_of_v<Rack, Kind>) {
      out.wheels.push_back({j.b, std::abs(j.radius), Part::joint, owner});
      out.lines.push_back({j.a, j.b, owner});
    }
    if constexpr (std::is_base_of_v<Gear, Kind>) {
      out.wheels.push_back({j.a, std::abs(j.radius_a), Part::joint, owner});
      out.wheels.push_back({j.b, std::abs(j.radius_b), Part::joint, owner});
      out.spans.push_back({j.a, j.b, j.radius_a, -j.radius_b, Part::joint, owner});
      out.spans.push_back({j.b, j.a, -j.radius_b, j.radius_a, Part::joint, owner});
    }
  };
  std::visit(of_kind, joint);
}

void add_flank(const ContactPair& pair, int owner, DrawnWheels& out) {
  const std::array<double, 2> radius = pitch_radii(*pair.flank);
  if (radius[0] != 0)
    out.wheels.push_back({pair.a, std::abs(radius[0]), Part::joint, owner});
  else
    out.lines.push_back({pair.a, pair.b, owner});
  out.wheels.push_back({pair.b, std::abs(radius[1]), Part::joint, owner});
}

void draw_wheel(const MarkerMotion& m, const DrawnWheels::Wheel& wheel, bool turns, Drawing& out) {
  constexpr int points = 48;
  const auto rim = [&](double angle) -> Vector2d { return m.r + wheel.radius * Vector2d(std::cos(angle), std::sin(angle)); };
  DrawnLine circle{wheel.part, wheel.owner, true, {}};
  for (int i = 0; i < points; ++i) circle.points.push_back(rim(2 * std::numbers::pi * i / points));
  out.lines.push_back(std::move(circle));
  if (turns) out.lines.push_back({wheel.part, wheel.owner, false, {m.r, rim(m.angle)}});
}

void draw_span(const MarkerMotion& a, const MarkerMotion& b, const DrawnWheels::Span& span, Drawing& out) {
  constexpr double touching = 1e-2;  // relative to a radius
  const Vector2d d = b.r - a.r;
  const double delta = span.radius_b - span.radius_a;
  if (!(d.norm() - std::abs(delta) >= touching * std::abs(span.radius_a))) return;
  const double angle = std::atan2(d.y(), d.x()) - std::asin(delta / d.norm());
  const Vector2d normal(-std::sin(angle), std::cos(angle));
  out.lines.push_back({span.part, span.owner, false, {a.r - span.radius_a * normal, b.r - span.radius_b * normal}});
}

}  // namespace

DrawnWheels wheels_of(const System& system) {
  const FirstOwners first(system);
  DrawnWheels out;
  for (std::size_t k = 0; k < system.joints.size(); ++k) add_teeth(system.joints[k], first.joint + static_cast<int>(k), out);
  for (std::size_t c = 0; c < system.contacts.size(); ++c)
    if (const ContactPair& pair = system.contacts[c]; pair.flank && pair.pair == 0)
      add_flank(pair, first.contact + static_cast<int>(c), out);
  for (std::size_t f = 0; f < system.forces.size(); ++f)
    if (const auto* belt = std::get_if<BeltSpan>(&system.forces[f])) {
      const int owner = first.force + static_cast<int>(f);
      out.wheels.push_back({belt->b, std::abs(belt->radius_b), Part::spring, owner});
      out.spans.push_back({belt->a, belt->b, belt->radius_a, belt->radius_b, Part::spring, owner});
    }
  return out;
}

void draw_wheels(const System& system, const Equations& eq, Drawing& out) {
  const DrawnWheels all = wheels_of(system);
  for (const auto& line : all.lines) {
    const MarkerMotion& a = eq.motion[at(line.a)];
    const Vector2d u(std::cos(a.angle), std::sin(a.angle)), foot = a.r + u * u.dot(eq.motion[at(line.b)].r - a.r);
    out.lines.push_back({Part::guide, line.owner, false, {foot - 0.5 * system.length * u, foot + 0.5 * system.length * u}});
  }
  for (const auto& wheel : all.wheels) draw_wheel(eq.motion[at(wheel.marker)], wheel, system.markers[at(wheel.marker)].body != ground, out);
  for (const auto& span : all.spans) draw_span(eq.motion[at(span.a)], eq.motion[at(span.b)], span, out);
}

}  // namespace pintle
