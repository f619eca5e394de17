#include <array>
#include <cmath>

#include "framework/common/nearest.h"
#include "framework/scene/colour.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

// A point in the middle of a hole; only plates have holes.
void read_hole(const Node& node, bool plate, ScenePoint& point) {
  if (!plate) node.at("hole").fail("is for plates only: no other body has a hole; write [x, y]");
  if (node.has("at")) node.at("at").fail("cannot be combined with hole, whose centre is the position; keep one of them");
  point.hole = node.at("hole").text("the name of a hole of the mesh");
  point.coupling = RimCoupling::rigid;
  if (node.has("coupling") && node.at("coupling").one_of(choices("bodies.*.points.*", "coupling")) == "average")
    point.coupling = RimCoupling::average;
}

/// A position in the world for the drawn pose, converted to the body's axes; a direction given with it is in the world too.
void read_world(const Node& node, const SceneBody& body, ScenePoint& point) {
  for (const char* key : {"at", "hole"})
    if (node.has(key)) node.at(key).fail("cannot be combined with world, which gives the position; keep one of them");
  const Pair world = node.at("world").pair(dimension::length);
  const double c = std::cos(body.angle), s = std::sin(body.angle), x = world[0] - body.at[0], y = world[1] - body.at[1];
  point.at = {c * x + s * y, c * y - s * x};
  if (node.has("angle")) point.angle -= body.angle;
}

/// Axes of a body drawn only by positions in the world: origin in the middle of the first two, x axis from one to the other.
void read_drawn_pose(const Node& points, SceneBody& body) {
  std::vector<Pair> world;
  for (const Node& point : points.entries("names and places: {A: [10 mm, 0]}"))
    if (point.is_map() && point.has("world") && world.size() < 2) world.push_back(point.at("world").pair(dimension::length));
  if (world.empty()) return;
  body.drawn_at = true;
  body.drawn_angle = world.size() > 1;
  const Pair a = world.front(), b = world.back();
  body.at = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
  body.angle = std::atan2(b[1] - a[1], b[0] - a[0]);
}

void read_pose(const Node& node, SceneBody& body) {
  if (node.has("pose")) {
    const Node pose = node.at("pose");
    check_keys(pose, "bodies.*.pose");
    body.drawn_at = pose.has("at");
    body.drawn_angle = pose.has("angle");
    if (pose.has("at")) body.at = pose.at("at").pair(dimension::length);
    read_optional(pose, "angle", dimension::angle, rule::any, body.angle);
  } else if (node.has("points")) {
    read_drawn_pose(node.at("points"), body);
  }
}

/// @param body  the owner of the point; nullptr: the ground
ScenePoint read_point(const Node& node, std::string_view keys, bool plate, const SceneBody* body) {
  ScenePoint point;
  point.name = checked_name(node);
  point.place = node.place();
  if (node.is_list()) {
    point.at = node.pair(dimension::length);
    return point;
  }
  if (!node.is_map())
    node.fail("is " + node.shown() + "; write [x, y] or {at: [x, y], angle: 0}" + (plate ? ", or {hole: …, coupling: rigid}" : ""));
  check_keys(node, keys);
  read_optional(node, "angle", dimension::angle, rule::any, point.angle);
  if (body && node.has("world")) {
    read_world(node, *body, point);
    return point;
  }
  if (node.has("hole")) {
    read_hole(node, plate, point);
    return point;
  }
  if (node.has("coupling")) node.at("coupling").fail("is for hole only; add hole, or leave it out");
  if (!node.has("at")) node.fail(std::string("lacks a required key; add for example at: [10 mm, 0]") + (plate ? ", or hole: bore" : ""));
  point.at = node.at("at").pair(dimension::length);
  return point;
}

std::vector<ScenePoint> read_points(const Node& owner, std::string_view keys, bool plate, const SceneBody* body) {
  std::vector<ScenePoint> points;
  if (!owner.has("points")) return points;
  for (const Node& node : owner.at("points").entries("names and places: {A: [10 mm, 0]}"))
    points.push_back(read_point(node, keys, plate, body));
  return points;
}

void read_rigid(const Node& node, SceneBody& body) {
  check_keys(node, "bodies.*.rigid");
  read_optional(node, "mass", dimension::mass, rule::positive, body.mass);
  read_optional(node, "inertia", dimension::inertia, rule::positive, body.inertia);
  if (node.has("center")) body.center = node.at("center").pair(dimension::length);
}

const std::vector<std::string> beside_elements{"points",     "profiles",    "pose",  "modes",    "damping",
                                               "stiffening", "mass matrix", "lumps", "supports", "colour"};
const std::array<KindKeys, 3> body_kinds{
    {{"rigid", {"points", "profiles", "pose", "colour"}}, {"beam", beside_elements}, {"plate", beside_elements}}};

std::string read_colour(const Node& node) {
  std::string colour = node.text("a colour such as steelblue or \"#4682b4\"");
  const std::vector<std::string> known = colour_names();
  if (rgb_of(colour)) return colour;
  const std::string near = nearest(colour, known);
  node.fail(node.shown() + " is not a colour; write a name of CSS such as steelblue, or \"#4682b4\" in quotes." +
            (near.empty() ? "" : " Did you mean \"" + near + "\"?"));
}

SceneBody read_body(const Node& node, const std::vector<SceneMaterial>& materials) {
  SceneBody body;
  body.name = checked_name(node);
  body.place = node.place();
  if (body.name == "ground") node.fail("\"ground\" is always there and has no mass; put its points under the key ground");
  check_keys(node, "bodies.*");
  const std::size_t kind = which_kind(node, body_kinds);
  read_pose(node, body);
  body.points = read_points(node, "bodies.*.points.*", kind == 2, &body);
  if (kind == 0)
    read_rigid(node.at("rigid"), body);
  else
    body.elastic = read_elastic(node, body, materials);
  body.profiles = read_profiles(node, "bodies.*.profiles.*", body.points, body.name);
  if (node.has("colour")) body.colour = read_colour(node.at("colour"));
  return body;
}

}  // namespace

void read_bodies(const Node& root, Scene& scene) {
  if (root.has("ground")) {
    check_keys(root.at("ground"), "ground");
    scene.ground = read_points(root.at("ground"), "ground.points.*", false, nullptr);
    scene.ground_profiles = read_profiles(root.at("ground"), "ground.profiles.*", scene.ground, "ground");
  }
  const Node bodies = root.at("bodies");
  for (const Node& node : bodies.entries("names and bodies: {crank: {rigid: {…}}}"))
    scene.bodies.push_back(read_body(node, scene.materials));
  if (scene.bodies.empty()) bodies.fail("contains no body; add one");
}

}  // namespace pintle
