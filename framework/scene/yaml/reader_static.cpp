#include <algorithm>
#include <array>

#include "framework/common/nearest.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

using Kind = SceneStaticLoad::Kind;

const std::array<KindKeys, 7> load_kinds{{{"force", {"at"}},
                                          {"torque", {"at"}},
                                          {"traction", {"on"}},
                                          {"pressure", {"on"}},
                                          {"line load", {}},
                                          {"acceleration", {}},
                                          {"spin", {"about"}}}};
constexpr std::array kinds{Kind::force, Kind::torque, Kind::traction, Kind::pressure, Kind::line, Kind::acceleration, Kind::spin};

// The body named, or the only one of elements.
const SceneBody& body_of(const Node& node, const Scene& scene) {
  std::vector<std::string> elastic;
  for (const SceneBody& b : scene.bodies)
    if (b.elastic) elastic.push_back(b.name);
  if (elastic.empty()) node.fail("needs a body of elements, but all are rigid; give one a beam or a plate");
  if (!node.has("body") && elastic.size() > 1) node.fail("does not say which body is loaded; add body: " + listed(elastic));
  const std::string name = node.has("body") ? node.at("body").text("the name of a body of elements") : elastic.front();
  const auto found = std::ranges::find(scene.bodies, name, &SceneBody::name);
  if (found != scene.bodies.end() && !found->elastic)
    node.at("body").fail("\"" + name + "\" is rigid and does not deform; give it a beam or a plate");
  if (found == scene.bodies.end()) node.at("body").fail("there is no body \"" + name + "\"." + did_you_mean(name, elastic));
  return *found;
}

void must_have(const Node& node, const char* key, const std::string& example) {
  if (!node.has(key)) node.fail(std::string("lacks a required key; add for example ") + key + ": " + example);
}

// What the load takes hold of: a point is known here, a group only to the mesh.
void read_place(const Node& node, const SceneBody& body, SceneStaticLoad& load) {
  switch (load.kind) {
    case Kind::force:
    case Kind::torque:
      must_have(node, "at", body.points.empty() ? "B" : body.points.back().name);
      load.at = read_own_point(node.at("at"), body);
      break;
    case Kind::traction:
    case Kind::pressure:
      must_have(node, "on", "the name of an edge or hole");
      load.at = node.at("on").text("the name of an edge or hole");
      break;
    case Kind::spin:
      if (node.has("about")) load.at = read_own_point(node.at("about"), body);
      break;
    case Kind::line:
    case Kind::acceleration: break;
  }
}

SceneStaticLoad read_load(const Node& node, const SceneBody& body) {
  check_keys(node, "static.loads.*");
  const std::size_t which = which_kind(node, load_kinds);
  SceneStaticLoad load;
  load.kind = kinds[which];
  load.name = checked_name(node);
  load.place = node.place();
  read_place(node, body, load);
  const Node value = node.at(load_kinds[which].kind);
  switch (load.kind) {
    case Kind::force: load.vector = value.pair(dimension::force); break;
    case Kind::torque: load.value = value.quantity(dimension::torque); break;
    case Kind::traction: load.vector = value.pair(dimension::stress); break;
    case Kind::pressure: load.value = value.quantity(dimension::stress); break;
    case Kind::line: load.vector = value.pair(dimension::line_load); break;
    case Kind::acceleration: load.vector = value.pair(dimension::acceleration); break;
    case Kind::spin: load.value = value.quantity(dimension::angular_speed); break;
  }
  const bool beam = std::holds_alternative<SceneBeam>(body.elastic->shape);
  if (beam && (load.kind == Kind::traction || load.kind == Kind::pressure))
    value.fail("is for the edge of a plate, but " + body.name + " is a beam; write line load: [0, -100 N/m]");
  if (!beam && load.kind == Kind::line)
    value.fail("is for beams, but " + body.name + " is a plate; write traction: [0, -1 MPa] and on: an edge");
  return load;
}

}  // namespace

void read_static(const Node& root, Scene& scene) {
  if (!root.has("static")) return;
  const Node node = root.at("static");
  check_keys(node, "static");
  const SceneBody& body = body_of(node, scene);
  SceneStatic& statics = scene.statics.emplace();
  statics.place = node.place();
  statics.body = body.name;
  const Node loads = node.at("loads");
  for (const Node& load : loads.entries("names and loads: {pull: {at: B, force: [1 kN, 0]}}"))
    statics.loads.push_back(read_load(load, body));
  if (statics.loads.empty()) loads.fail("holds no load; add one");
}

}  // namespace pintle
