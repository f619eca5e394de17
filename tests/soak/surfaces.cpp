#include "tests/soak/surfaces.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "contact/normal_law.h"

namespace soak {

using Eigen::Vector2d;

namespace {

constexpr double turn = 2 * std::numbers::pi;

// A disc, or a polygon with sharp or round corners, about the origin of the body.
std::string shape(double radius, Chance& chance) {
  std::ostringstream s;
  s.precision(17);
  if (chance.one_in(2)) {
    s << "{disc: [0, 0], radius: " << radius << "}";
    return s.str();
  }
  const int corners = chance.from_to(3, 6);
  const double first = chance.either_way(turn / 2);
  s << "{path: [";
  for (int i = 0; i < corners; ++i) {
    const double angle = first + turn * (i + 0.3 * chance.either_way(1)) / corners;
    s << (i ? ", [" : "[") << radius * std::cos(angle) << ", " << radius * std::sin(angle) << "]";
  }
  s << "], closed: true";
  if (chance.one_in(2)) s << ", round: " << radius * chance.between(0.02, 0.1);
  s << "}";
  return s.str();
}

std::string laws(const Drawn& drawn, Chance& chance) {
  if (drawn.rigid) return rigid_laws(drawn, chance);
  const auto& all = pintle::impact_factors();
  const auto& law = all[static_cast<std::size_t>(chance.below(static_cast<int>(all.size())))];
  std::ostringstream s;
  s.precision(17);
  if (chance.one_in(6)) {
    s << "normal: {spring-damper: {stiffness: " << chance.decades(3, 7) << ", damping: " << chance.decades(-1, 2) << "}}";
  } else {
    s << "normal: {" << law.name << ": {";
    if (law.name != "hertz") s << "restitution: " << chance.between(0.05, 1) << ", ";
    s << "stiffness: " << chance.decades(5, 9) << ", exponent: " << (chance.one_in(2) ? 1.5 : chance.between(1, 2)) << "}}";
  }
  if (!chance.one_in(2)) return s.str();
  const double coefficient = chance.between(0, 0.6);
  s << ", friction: {";
  if (chance.one_in(2)) {
    s << "ambrosio: {coefficient: " << coefficient << ", v0: " << 1e-3 * drawn.size << ", v1: " << 1e-2 * drawn.size << "}}";
  } else {
    const double holds = coefficient * (chance.one_in(2) ? 1 : chance.between(1, 2));
    s << "coulomb: {coefficient: " << coefficient << ", static: " << holds;
    if (holds > coefficient && chance.one_in(3)) s << ", stribeck speed: " << drawn.size * chance.decades(-3, 0);
    s << "}}";
  }
  return s.str();
}

// Dry friction in some of the ideal joints.
void rub_joints(Drawn& drawn, Chance& chance) {
  for (std::string& joint : drawn.joints) {
    const auto is = [&](const char* kind) { return joint.find(std::string("{") + kind + ": ") != std::string::npos; };
    if (joint.find("clearance") != std::string::npos || !(is("revolute") || is("prismatic") || is("slot")) || !chance.one_in(4)) continue;
    std::ostringstream s;
    s.precision(17);
    const double coefficient = chance.between(0, 0.4);
    s << ", friction: {coulomb: {coefficient: " << coefficient
      << ", static: " << coefficient * (chance.one_in(2) ? 1 : chance.between(1, 2)) << "}";
    if (is("revolute")) s << ", radius: " << drawn.size * chance.decades(-3, -1);
    if (is("prismatic")) s << ", length: " << drawn.size * chance.between(0.3, 2);
    if (chance.one_in(3)) s << ", preload: " << chance.decades(-2, 2);
    joint.insert(joint.size() - 1, s.str() + "}");
  }
}

}  // namespace

std::string rigid_laws(const Drawn& drawn, Chance& chance) {
  std::ostringstream s;
  s.precision(17);
  s << "model: impact, restitution: " << (chance.one_in(4) ? 0.0 : chance.one_in(6) ? 1.0 : chance.between(0, 1));
  const bool poisson = !drawn.in_steps && chance.one_in(6);
  if (poisson) s << ", restitution law: poisson";
  if (chance.one_in(2)) return s.str();
  const double coefficient = chance.between(0, chance.one_in(6) ? 3 : 0.6);
  s << ", friction: {coulomb: {coefficient: " << coefficient << "}}";
  if (!poisson && chance.one_in(6)) s << ", tangential restitution: " << chance.unit();
  return s.str();
}

void add_surfaces(Drawn& drawn, Chance& chance) {
  double lowest = 0, left = 0, right = 0;
  for (Link& l : drawn.links) {
    if (l.beam) continue;
    double radius = drawn.size * chance.between(0.05, 0.3);
    for (const Link& other : drawn.links)
      if (&other != &l && (other.r - l.r).norm() > 0) radius = std::min(radius, 0.45 * (other.r - l.r).norm());
    l.profile = shape(radius, chance);
    lowest = std::min(lowest, l.r.y() - radius);
    left = std::min(left, l.r.x()), right = std::max(right, l.r.x());
  }
  std::ostringstream floor;
  floor.precision(17);
  const double depth = lowest - drawn.size * chance.between(0.01, 0.5), wide = 20 * drawn.size;
  floor << "{path: [[" << left - wide << ", " << depth << "], [" << right + wide << ", " << depth + chance.either_way(0.1 * drawn.size)
        << "]], material: right}";
  drawn.ground.profile = floor.str();
  const auto between = [&](const std::string& a, const std::string& b) {
    drawn.contacts.push_back("wall" + std::to_string(drawn.contacts.size()) + ": {between: [" + a + ".skin, " + b + ".skin], " +
                             laws(drawn, chance) + "}");
  };
  for (std::size_t i = 0; i < drawn.links.size(); ++i) {
    if (drawn.links[i].profile.empty()) continue;
    if (chance.one_in(1.3)) between(drawn.links[i].name, "ground");
    for (std::size_t j = 0; j < i; ++j)
      if (!drawn.links[j].profile.empty() && chance.one_in(4)) between(drawn.links[i].name, drawn.links[j].name);
  }
  if (!drawn.in_steps && chance.one_in(2)) rub_joints(drawn, chance);
}

}  // namespace soak
