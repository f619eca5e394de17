#include "framework/scene/reader_parts.h"

namespace pintle {

namespace {

ScenePoint read_point(const Node& node, std::string_view keys) {
  ScenePoint point;
  point.name = checked_name(node);
  point.place = node.place();
  if (node.is_list()) {
    point.at = node.pair(dimension::length);
    return point;
  }
  if (!node.is_map()) node.fail("is " + node.shown() + "; write [x, y] or {at: [x, y], angle: 0}");
  check_keys(node, keys);
  point.at = node.at("at").pair(dimension::length);
  read_optional(node, "angle", dimension::angle, rule::any, point.angle);
  return point;
}

std::vector<ScenePoint> read_points(const Node& owner, std::string_view keys) {
  std::vector<ScenePoint> points;
  if (!owner.has("points")) return points;
  for (const Node& node : owner.at("points").entries("names and places: {A: [10 mm, 0]}"))
    points.push_back(read_point(node, keys));
  return points;
}

void read_rigid(const Node& node, SceneBody& body) {
  check_keys(node, "bodies.*.rigid");
  body.mass = node.at("mass").quantity(dimension::mass, rule::positive);
  body.inertia = node.at("inertia").quantity(dimension::inertia, rule::positive);
  if (node.has("center")) body.center = node.at("center").pair(dimension::length);
}

SceneBody read_body(const Node& node) {
  SceneBody body;
  body.name = checked_name(node);
  body.place = node.place();
  if (body.name == "ground")
    node.fail("\"ground\" is always there and has no mass; put its points under the key ground");
  check_keys(node, "bodies.*");
  read_rigid(node.at("rigid"), body);
  body.points = read_points(node, "bodies.*.points.*");
  if (node.has("pose")) {
    const Node pose = node.at("pose");
    check_keys(pose, "bodies.*.pose");
    if (pose.has("at")) body.at = pose.at("at").pair(dimension::length);
    read_optional(pose, "angle", dimension::angle, rule::any, body.angle);
  }
  return body;
}

}  // namespace

void read_bodies(const Node& root, Scene& scene) {
  if (root.has("ground")) {
    check_keys(root.at("ground"), "ground");
    scene.ground = read_points(root.at("ground"), "ground.points.*");
  }
  const Node bodies = root.at("bodies");
  for (const Node& node : bodies.entries("names and bodies: {crank: {rigid: {…}}}"))
    scene.bodies.push_back(read_body(node));
  if (scene.bodies.empty()) bodies.fail("holds no body; add one");
}

}  // namespace pintle
