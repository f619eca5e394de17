#include "framework/mechanism/drawing.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <variant>

#include "framework/common/index.h"
#include "framework/mechanism/drawn_symbols.h"
#include "framework/mechanism/drawn_wheels.h"
#include "framework/scene/colour.h"

namespace pintle {

namespace {

using Eigen::Vector2d;

std::vector<Vector2d> circle(const Vector2d& center, double radius, int points = 48) {
  std::vector<Vector2d> out;
  for (int i = 0; i < points; ++i) {
    const double a = 2 * std::numbers::pi * i / points;
    out.emplace_back(center + radius * Vector2d(std::cos(a), std::sin(a)));
  }
  return out;
}

// Andrew's monotone chain.
std::vector<Vector2d> convex_hull(std::vector<Vector2d> p) {
  std::sort(p.begin(), p.end(), [](const Vector2d& a, const Vector2d& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  p.erase(std::unique(p.begin(), p.end()), p.end());
  if (p.size() < 3) return p;
  std::vector<Vector2d> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t begin = hull.size();
    for (const Vector2d& q : p) {
      while (hull.size() >= begin + 2 && cross(hull.back() - hull[hull.size() - 2], q - hull.back()) <= 0) hull.pop_back();
      hull.push_back(q);
    }
    hull.pop_back();
    std::reverse(p.begin(), p.end());
  }
  return hull;
}

// A link's outline: the convex hull of its points, offset by `width`, with round corners.
std::vector<Vector2d> outline(const std::vector<Vector2d>& points, double width) {
  std::vector<Vector2d> cloud;
  for (const Vector2d& p : points)
    for (const Vector2d& q : circle(p, width, 32)) cloud.push_back(q);
  return convex_hull(std::move(cloud));
}

std::vector<Vector2d> block(double half_length, double half_width) {
  return {{-half_length, -half_width}, {half_length, -half_width}, {half_length, half_width}, {-half_length, half_width}};
}

}  // namespace

Drafting::Drafting(const Scene& scene, const Model& model) {
  const System& system = model.system;
  pin = 0.03 * system.length;
  double half = 1.6 * pin;  // of a block, large enough for its bearings
  for (const ContactPair& c : system.contacts) {
    if (c.profiles) break;
    pin = std::min(pin, bearing_radius(c.gap));
    half = std::max(half, bearing_radius(c.gap));
  }
  const double width = 1.6 * pin;
  if (std::ranges::any_of(scene.bodies, [](const SceneBody& b) { return !b.colour.empty(); }))
    for (const SceneBody& b : scene.bodies) colours.push_back(rgb_of(b.colour));
  deformation = scene.output.deformation;
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    owners.push_back(system.bodies[b].name);
    if (system.bodies[b].flex) {  // drawn as it is meshed
      links.emplace_back();
      continue;
    }
    const auto of_body = [b](const DrawnProfile& p) { return p.body == static_cast<int>(b); };
    if (std::ranges::any_of(model.profiles, of_body)) {  // its surface is drawn
      links.emplace_back();
      continue;
    }
    std::vector<Vector2d> points = model.outlines[b];
    if (!points.empty()) points.emplace_back(0, 0);  // a link includes its mass centre
    double span = 0;
    for (const Vector2d& p : points) span = std::max(span, (p - points[0]).norm());
    if (span > 0) {
      links.push_back(outline(points, width));
    } else {  // a body with a single point: a block around it
      auto box = block(2 * half, 1.4 * half);
      const Vector2d center = model.outlines[b].empty() ? Vector2d(0, 0) : model.outlines[b][0];
      for (Vector2d& p : box) p += center;
      links.push_back(std::move(box));
    }
  }
  for (const auto& name : system.joint_names) owners.push_back(name);
  for (const auto& name : system.contact_names) owners.push_back(name);
  for (const auto& name : system.force_names) owners.push_back(name);
  owners.emplace_back("ground");
  if (scene.output.exaggerate > 0)
    exaggeration = scene.output.exaggerate;
  else
    for (const ContactPair& c : std::span(system.contacts).first(at(n_clearances(system))))
      exaggeration = std::max(exaggeration, 0.3 * bearing_radius(c.gap) / c.gap.clearance());
}

namespace {

// Bearing and journal of each clearance, the gap between them exaggerated, and the force that results give.
void draw_clearances(const System& system, const Drafting& drafting, const Equations& eq, Drawing& out) {
  const int first = static_cast<int>(system.bodies.size() + system.joints.size());
  for (std::size_t c = 0; c < at(n_clearances(system)); ++c) {
    const ContactPair& pair = system.contacts[c];
    const int owner = first + static_cast<int>(c);
    const Vector2d center = eq.motion[at(pair.b)].r;
    const ContactEffect now = clearance_effect(system, eq, c);
    const double s = drafting.exaggeration;
    out.lines.push_back({Part::bearing, owner, true, circle(center, bearing_radius(pair.gap))});
    out.lines.push_back(
        {Part::journal, owner, true,
         circle(center + s * now.gap.e, std::max(bearing_radius(pair.gap) - s * pair.gap.clearance(), 0.05 * bearing_radius(pair.gap)))});
    out.forces.push_back({center + bearing_radius(pair.gap) * now.gap.n, written_force(pair, now).head<2>(), owner, Giver::contact});
  }
}

// Surfaces, and the force of each pair that touches.
void draw_profiles(const Model& model, const Equations& eq, Drawing& out) {
  const System& system = model.system;
  const int first = static_cast<int>(system.bodies.size() + system.joints.size()), of_ground = static_cast<int>(out.owners.size()) - 1;
  for (const DrawnProfile& p : model.profiles) {
    DrawnLine line{p.body == ground ? Part::guide : Part::link, p.body == ground ? of_ground : p.body, p.solid, p.points};
    const MarkerMotion& carrier = eq.motion[at(p.marker)];
    const Eigen::Rotation2Dd A(carrier.angle);
    for (Vector2d& x : line.points) x = carrier.r + A * x;
    out.lines.push_back(std::move(line));
  }
  for (std::size_t c = at(n_clearances(system)); c < system.contacts.size(); ++c) {
    const ContactEffect& now = eq.contact[c];
    if (now.normal.force == 0) continue;
    const ContactPair& pair = system.contacts[c];
    const Vector2d middle = eq.motion[at(pair.b)].r + now.gap.arm_b;
    out.forces.push_back({touched(pair.gap.b, middle, -now.gap.n, now.gap.across), written_force(pair, now).head<2>(),
                          first + static_cast<int>(c), Giver::contact});
  }
}

/// Removes forces and couples that are rounding beside the others and the inertia of the bodies.
void leave_out_rounding(const System& system, const Equations& eq, Drawing& out) {
  double largest = 0;
  for (std::size_t b = 0; b < system.bodies.size(); ++b)
    largest = std::max(largest, system.bodies[b].m * eq.a.segment<2>(static_cast<Eigen::Index>(3 * b)).norm());
  for (const DrawnForce& f : out.forces) largest = std::max({largest, f.force.norm(), std::abs(f.couple) / system.length});
  const double rounding = 1e-11 * largest;
  for (DrawnForce& f : out.forces) {
    if (f.force.norm() <= rounding) f.force.setZero();
    if (std::abs(f.couple) <= rounding * system.length) f.couple = 0;
  }
  std::erase_if(out.forces, [](const DrawnForce& f) { return f.force.isZero(0) && f.couple == 0; });
}

}  // namespace

Drawing draw(const Model& model, const Drafting& drafting, const State& state, const Equations& eq) {
  const System& system = model.system;
  Drawing out;
  out.t = state.t;
  out.exaggeration = drafting.exaggeration;
  out.owners = drafting.owners;
  out.colours = drafting.colours;
  const int bodies = static_cast<int>(system.bodies.size()), joints = static_cast<int>(system.joints.size());
  out.deformation = drafting.deformation;
  auto flexible = model.drawings.begin();
  for (int b = 0; b < bodies; ++b) {
    const double* q = state.y.data() + 3 * b;
    if (system.bodies[at(b)].flex) {
      if (flexible == model.drawings.end()) continue;
      const double* s = q + system.n();
      const int begin = system.eta_begin[at(b)], n = system.bodies[at(b)].modes();
      out.bodies.push_back(flexible++->at(
          {Vector2d(q[0], q[1]), Vector2d(s[0], s[1]), q[2], s[2], state.y.segment(begin, n), state.y.segment(system.n() + begin, n)},
          drafting.deformation));
      continue;
    }
    const Eigen::Rotation2Dd A(q[2]);
    if (drafting.links[at(b)].empty()) continue;
    DrawnLine line{Part::link, b, true, {}};
    for (const Vector2d& x : drafting.links[at(b)]) line.points.emplace_back(Vector2d(q[0], q[1]) + A * x);
    out.lines.push_back(std::move(line));
  }
  for (int joint = 0; joint < joints; ++joint) {
    if (is_link(system, joint)) continue;  // drawn as its clearance
    const JointEnds ends = ends_of(system.joints[at(joint)]);
    const MarkerMotion &a = eq.motion[at(ends.marker[0])], &b = eq.motion[at(ends.marker[1])];
    const auto pin = [&] { out.lines.push_back({Part::joint, bodies + joint, true, circle(b.r, 0.6 * drafting.pin)}); };
    const auto guide = [&] {  // a segment of the line
      const Vector2d foot = a.r + a.u * a.u.dot(b.r - a.r);
      out.lines.push_back({Part::guide, bodies + joint, false, {foot - 0.5 * system.length * a.u, foot + 0.5 * system.length * a.u}});
    };
    switch (properties_of(system.joints[at(joint)]).symbol) {
      case JointSymbol::none: break;
      case JointSymbol::pin: pin(); break;
      case JointSymbol::guide: guide(); break;
      case JointSymbol::pin_in_guide: guide(), pin(); break;
      case JointSymbol::rod: out.lines.push_back({Part::joint, bodies + joint, false, {a.r, b.r}}); break;
    }
  }
  draw_ground(model, drafting, eq, out);
  draw_wheels(system, eq, out);
  draw_clearances(system, drafting, eq, out);
  draw_bars(model, eq, out);
  draw_profiles(model, eq, out);
  draw_actuators(system, drafting, eq, out);
  draw_reactions_and_loads(system, eq, out);
  leave_out_rounding(system, eq, out);
  follow_points(model, state, eq, out);
  return out;
}

std::vector<DrawnImpact> drawn_impacts(const std::vector<Impact>& impacts) {
  std::vector<DrawnImpact> out;
  for (const Impact& i : impacts) out.push_back({i.contact, i.begin, i.approach, i.peak_force});
  return out;
}

std::vector<std::string> pose_columns(const Model& model) {
  std::vector<std::string> out;
  for (const Body& body : model.system.bodies) {
    for (const char* const column : {".x", ".y", ".angle"}) out.push_back(body.name + column);
    for (int i = 1; i <= body.modes(); ++i) out.push_back(body.name + ".mode " + std::to_string(i));
  }
  return out;
}

}  // namespace pintle
