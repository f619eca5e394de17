#include <algorithm>
#include <array>

#include "framework/common/nearest.h"
#include "framework/common/some_of.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

using Kind = SceneStaticLoad::Kind;

const std::array<KindKeys, 7> load_kinds{{{"force", {"at", "body"}},
                                          {"torque", {"at", "body"}},
                                          {"traction", {"on", "body"}},
                                          {"pressure", {"on", "body"}},
                                          {"line load", {"body"}},
                                          {"acceleration", {"body"}},
                                          {"spin", {"about", "body"}}}};
constexpr std::array kinds{Kind::force, Kind::torque, Kind::traction, Kind::pressure, Kind::line, Kind::acceleration, Kind::spin};

// A body of elements by its name.
const SceneBody& elastic_named(const Node& node, const std::string& name, const Scene& scene) {
  std::vector<std::string> elastic;
  for (const SceneBody& b : scene.bodies)
    if (b.elastic) elastic.push_back(b.name);
  const auto found = std::ranges::find(scene.bodies, name, &SceneBody::name);
  if (found == scene.bodies.end()) node.fail("there is no body \"" + name + "\"." + did_you_mean(name, elastic));
  if (!found->elastic) node.fail("\"" + name + "\" is rigid and does not deform; give it a beam or a plate");
  return *found;
}

// The body named, or the only one of elements.
const SceneBody& body_of(const Node& node, const Scene& scene) {
  if (node.has("body")) return elastic_named(node.at("body"), node.at("body").text("the name of a body of elements"), scene);
  std::vector<std::string> elastic;
  for (const SceneBody& b : scene.bodies)
    if (b.elastic) elastic.push_back(b.name);
  if (elastic.empty()) node.fail("needs a flexible body, but all are rigid; give one a beam or a plate");
  if (elastic.size() > 1) node.fail("does not say which body is loaded; add body: one of " + some_of(elastic, false));
  return elastic_named(node, elastic.front(), scene);
}

// Whether a body is loaded or in contact in the case.
bool takes_part(const SceneStatic& statics, const std::string& body, bool as_loaded = true) {
  return (as_loaded && statics.body == body) ||
         std::ranges::any_of(statics.contacts, [&](const SceneStaticContact& c) { return c.first.body == body || c.second.body == body; });
}

void must_have(const Node& node, const char* key, const std::string& example) {
  if (!node.has(key)) node.fail(std::string("lacks a required key; add for example ") + key + ": " + example);
}

// The place where the load acts: points are known here, groups only to the mesh.
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

// "pin.outline": a group is known only to the mesh.
SceneStaticContact::Side read_side(const Node& node, const Scene& scene) {
  const std::string text = node.text("a body and its edge or hole, such as pin.outline");
  const std::size_t dot = text.find('.');
  if (dot == 0 || dot == std::string::npos || dot + 1 == text.size())
    node.fail(node.shown() + " names no edge; write body.group, such as pin.outline");
  const SceneBody& body = elastic_named(node, text.substr(0, dot), scene);
  if (std::holds_alternative<SceneBeam>(body.elastic->shape))
    node.fail("\"" + body.name + "\" is a beam, which has no edge to touch; contacts are between plates");
  return {body.name, text.substr(dot + 1)};
}

void read_contacts_of(const Node& node, const Scene& scene, SceneStatic& statics) {
  for (const Node& contact : node.entries("names and pairs: {pin in hole: {between: [pin.outline, rocker.bore]}}")) {
    check_keys(contact, "static.contacts.*");
    const std::vector<Node> two = contact.at("between").items(2, "two edges or holes such as [pin.outline, rocker.bore]");
    SceneStaticContact c{checked_name(contact), read_side(two[0], scene), read_side(two[1], scene), contact.place()};
    if (c.first.body == c.second.body) two[1].fail("is of the same body as the other; name an edge of another body");
    statics.contacts.push_back(c);
  }
  if (statics.contacts.empty()) node.fail("contains no contact; add one, or leave contacts out");
  if (!takes_part(statics, statics.body, false))
    node.fail("do not involve the body of the case, " + statics.body + "; name another body under body");
}

void read_places(const Node& node, SceneStatic& statics) {
  for (const Node& place : node.entries("bodies and places: {pin: [0, -20 um]}")) {
    if (!takes_part(statics, place.name()))
      place.fail("\"" + place.name() + "\" is not part of the case; add it under contacts, or remove this");
    statics.at.push_back({place.name(), place.pair(dimension::length), place.place()});
  }
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
  if (node.has("contacts")) read_contacts_of(node.at("contacts"), scene, statics);
  if (node.has("at")) read_places(node.at("at"), statics);
  const Node loads = node.at("loads");
  for (const Node& load : loads.entries("names and loads: {pull: {at: B, force: [1 kN, 0]}}")) {
    const bool other = load.is_map() && load.has("body");
    const SceneBody& of = other ? elastic_named(load.at("body"), load.at("body").text("the name of a body of elements"), scene) : body;
    statics.loads.push_back(read_load(load, of));
    if (!other) continue;
    if (!takes_part(statics, of.name))
      load.at("body").fail("\"" + of.name + "\" is not the body of the case, " + body.name +
                           ", and has no contact in it; add it under contacts");
    statics.loads.back().body = of.name;
  }
  if (statics.loads.empty()) loads.fail("contains no load; add one");
}

}  // namespace pintle
