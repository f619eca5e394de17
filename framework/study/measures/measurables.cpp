#include "framework/study/measures/measurables.h"

#include <algorithm>
#include <span>

#include "framework/common/nearest.h"

namespace pintle {

namespace {

/// Name of the body before it was divided: "coupler" for "coupler 2", if there is a weld "coupler 1-2".
std::string whole_of(const Scene& scene, const std::string& piece) {
  const auto space = piece.rfind(' ');
  if (space == std::string::npos || piece.find_first_not_of("0123456789", space + 1) != std::string::npos) return "";
  std::string whole = piece.substr(0, space);
  return joint_named(scene, whole + " 1-2") && !body_named(scene, whole) ? whole : "";
}

std::string said(const Names& names, const char* one, const char* many) {
  if (names.empty()) return "";
  constexpr std::size_t most = 12;
  const auto shown = std::span(names).first(std::min(names.size(), most));
  return std::string(names.size() == 1 ? one : many) + " " + listed(shown, names.size() > most ? "," : "and") +
         (names.size() > most ? ", …" : "");
}

}  // namespace

Measurables measurables_of(const Scene& scene) {
  Measurables o;
  for (const SceneJoint& j : scene.joints) o.joints.push_back(j.name);
  for (const SceneContact& c : scene.contacts) o.contacts.push_back(c.name);
  for (const SceneDriver& d : scene.drivers) o.drivers.push_back(d.name);
  for (const SceneLoad& l : scene.loads) o.loads.push_back(l.name);
  for (const SceneBody& b : scene.bodies) {
    o.bodies.push_back(b.name);
    const std::string whole = whole_of(scene, b.name);
    for (const ScenePoint& p : b.points) {
      o.points.push_back(b.name + "." + p.name);
      if (!whole.empty()) o.points.push_back(whole + "." + p.name);
    }
  }
  for (const SceneOutput& output : scene.outputs) o.written.push_back(output.name);
  for (const SceneState& state : scene.states) o.written.push_back(state.name);
  for (const Names* names : {&o.joints, &o.contacts}) o.walls.insert(o.walls.end(), names->begin(), names->end());
  for (const Names* names : {&o.joints, &o.contacts, &o.drivers, &o.loads}) o.actors.insert(o.actors.end(), names->begin(), names->end());
  return o;
}

std::string described(const Measurables& o) {
  std::string out;
  for (const std::string& part :
       {said(o.joints, "the joint", "the joints"), said(o.contacts, "the contact", "the contacts"),
        said(o.drivers, "the driver", "the drivers"), said(o.loads, "the force", "the forces"), said(o.bodies, "the body", "the bodies"),
        said(o.written, "the output or state", "the outputs and states")})
    if (!part.empty()) out += (out.empty() ? " The scene has " : "; ") + part;
  return out + ".";
}

const SceneBody* body_named(const Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.bodies, name, &SceneBody::name);
  return found == scene.bodies.end() ? nullptr : &*found;
}

const SceneJoint* joint_named(const Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.joints, name, &SceneJoint::name);
  return found == scene.joints.end() ? nullptr : &*found;
}

PointRef point_named(const Scene& scene, const std::string& name) {
  const auto dot = name.find('.');
  if (dot == std::string::npos) return {};
  const std::string body = name.substr(0, dot), point = name.substr(dot + 1);
  const auto has = [&](const SceneBody& b) { return std::ranges::find(b.points, point, &ScenePoint::name) != b.points.end(); };
  for (const SceneBody& b : scene.bodies)
    if (has(b) && (b.name == body || whole_of(scene, b.name) == body)) return {b.name, point, {}};
  return {};
}

}  // namespace pintle
