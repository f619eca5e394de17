#include "framework/scene/yaml/placing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/scene/yaml/placing_parts.h"

namespace pintle {

using namespace placing_parts;

Pair Placing::turn() const {
  const double quarters = angle / (std::numbers::pi / 2), whole = std::round(quarters);
  if (std::abs(quarters - whole) > 1e-15 * std::max(1.0, std::abs(whole))) return {std::cos(angle), std::sin(angle)};
  constexpr std::array<Pair, 4> right{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  return right[static_cast<std::size_t>(std::fmod(std::fmod(whole, 4) + 4, 4))];
}

Pair Placing::vector(const Pair& v) const {
  const auto [c, s] = turn();
  const double y = sign() * v[1];
  return {c * v[0] - s * y, s * v[0] + c * y};
}

Pair Placing::point(const Pair& p) const {
  const Pair v = vector(p);
  return {at[0] + v[0], at[1] + v[1]};
}

Placing operator*(const Placing& outer, const Placing& inner) {
  return {outer.point(inner.at), outer.direction(inner.angle), outer.mirrored != inner.mirrored};
}

namespace {

/// In axes with the y axis reversed.
Pair flipped(const Pair& p) { return {p[0], -p[1]}; }

/// Points of a body are mirrored with its axes; points of the ground are moved.
struct PlacesOf {
  const Placing& placing;
  bool ground;
  Pair point(const Pair& p) const { return ground ? placing.point(p) : placing.mirrored ? flipped(p) : p; }
  double direction(double a) const { return ground ? placing.direction(a) : placing.sign() * a; }
  bool stays() const { return ground ? placing.stays() : !placing.mirrored; }
};

void place_spot(const Spot& spot, const PlacesOf& places) {
  if (spot.node.is_list()) set(spot, places.point(spot.node.pair(dimension::length)));
}

void place_origin(Spot profile, std::string_view key, const PlacesOf& places) {
  if (profile.has(key)) return place_spot(profile.at(key), places);
  if (places.ground && key == "about") put(profile.yaml, pair_like(profile.yaml, "about", places.point({0, 0})));
}

void place_polar(const Spot& polar, const PlacesOf& places) {
  if (polar.node.is_map()) polar.node.fail("is a file, which cannot be mirrored or turned; write its points, or attach it to a body");
  for (const Spot& point : polar.list("angles and radii")) {
    const std::vector<Spot> two = point.list("[angle, radius]");
    if (!two.empty()) set_angle(two[0], places.direction(two[0].node.quantity(dimension::angle)));
  }
  if (places.placing.mirrored) std::ranges::reverse(polar.yaml.items);
}

/// The material of an open profile changes sides when it is mirrored.
void swap_side(const Spot& profile) {
  const bool closed = profile.has("polar") || (profile.has("closed") && profile.at("closed").node.yes());
  if (closed) return;
  const bool right = profile.has("material") && profile.at("material").node.text("left or right") == "right";
  if (profile.has("material") && !right && profile.at("material").yaml.text != "left") return;  // reported by the reader
  put(profile.yaml, scalar_like(profile.yaml, "material", right ? "left" : "right"));
}

void place_profile(const Spot& profile, const PlacesOf& places) {
  if (places.stays()) return;
  const bool mirrored = places.placing.mirrored;
  for (const char* key : {"disc", "hole"}) place_origin(profile, key, places);
  const bool surface = profile.has("path") || profile.has("spline");
  if (profile.has("path"))
    for (const Spot& item : profile.at("path").list("points and arcs")) {
      place_spot(item, places);
      if (mirrored && item.node.is_map() && item.has("arc")) set(item.at("arc"), -item.at("arc").node.quantity(dimension::length));
    }
  if (profile.has("spline")) {
    const Spot spline = profile.at("spline");
    if (spline.node.is_map()) spline.node.fail("is a file, which cannot be mirrored or turned; write its points, or attach it to a body");
    for (const Spot& item : spline.list("points")) place_spot(item, places);
  }
  if (profile.has("polar")) {
    place_polar(profile.at("polar"), places);
    place_origin(profile, "about", places);
  }
  if (mirrored && surface) swap_side(profile);
}

void place_point(const Spot& point, const PlacesOf& places, const Placing& placing) {
  if (point.node.is_list()) return place_spot(point, places);
  if (!point.node.is_map()) return;
  const PlacesOf world{placing, true};
  const bool drawn = point.has("world");
  if (drawn) place_spot(point.at("world"), world);
  if (point.has("at")) place_spot(point.at("at"), places);
  const PlacesOf& of = drawn ? world : places;
  if (point.has("angle"))
    set_angle(point.at("angle"), of.direction(point.at("angle").node.quantity(dimension::angle)));
  else if (places.ground)
    put(point.yaml, angle_like(point.yaml, "angle", of.direction(0)));
}

/// A ground point given only by its position gets a direction if the ground is rotated.
void place_ground_point(Spot point, const Placing& placing) {
  if (point.node.is_list() && placing.direction(0) != 0) {
    const Pair p = placing.point(point.node.pair(dimension::length));
    Yaml with{Yaml::Kind::map, point.yaml.line, point.yaml.key, {}, {}, point.yaml.file, point.yaml.scope};
    with.items = {pair_like(with, "at", p), angle_like(with, "angle", placing.direction(0))};
    point.yaml = std::move(with);
    return;
  }
  place_point(point, {placing, true}, placing);
}

void mirror_elastic(const Spot& made) {
  if (made.has("orthotropic")) negate(made.at("orthotropic"), "angle", dimension::angle);
  if (made.has("file")) cannot_mirror(made.at("file").node, "draw the other side in a separate file, and give it to a separate body");
  if (made.has("link") && made.at("link").has("triangle") && made.at("link").at("triangle").has("centers"))
    for (const Spot& center : made.at("link").at("triangle").at("centers").list("centres [x, y]"))
      set(center, flipped(center.node.pair(dimension::length)));
  if (!made.has("grid") || !made.at("grid").has("corners")) return;
  const Spot corners = made.at("grid").at("corners");
  for (const Spot& corner : corners.list("corners [x, y]")) set(corner, flipped(corner.node.pair(dimension::length)));
  std::ranges::reverse(corners.yaml.items);
}

void mirror_body(const Spot& body) {
  if (body.has("rigid") && body.at("rigid").has("center")) {
    const Spot center = body.at("rigid").at("center");
    set(center, flipped(center.node.pair(dimension::length)));
  }
  for (const char* made : {"beam", "plate"})
    if (body.has(made)) mirror_elastic(body.at(made));
  if (!body.has("plate") || !body.has("supports")) return;
  for (Yaml& place : body.at("supports").yaml.items) place.key = place.key == "top" ? "bottom" : place.key == "bottom" ? "top" : place.key;
}

void place_body(Spot body, const Placing& placing) {
  const PlacesOf places{placing, false};
  bool drawn = false;
  if (body.has("points"))
    for (const Spot& point : body.at("points").entries("names and places")) {
      drawn = drawn || (point.node.is_map() && point.has("world"));
      place_point(point, places, placing);
    }
  if (body.has("profiles"))
    for (const Spot& profile : body.at("profiles").entries("names and profiles")) place_profile(profile, places);
  if (placing.mirrored) mirror_body(body);
  Pair at{0, 0};
  double angle = 0;
  const bool posed = body.has("pose");
  if (posed && body.at("pose").has("at")) at = body.at("pose").at("at").node.pair(dimension::length);
  if (posed && body.at("pose").has("angle")) angle = body.at("pose").at("angle").node.quantity(dimension::angle);
  if (drawn && !posed) return;  // the points give its position
  Yaml pose{Yaml::Kind::map, body.yaml.line, "pose", {}, {}, body.yaml.file, body.yaml.scope};
  pose.items = {pair_like(pose, "at", placing.point(at))};
  if (placing.direction(angle) != 0 || (posed && body.at("pose").has("angle")))
    pose.items.push_back(angle_like(pose, "angle", placing.direction(angle)));
  put(body.yaml, std::move(pose));
}

/// x and y, or one of them if the other does not affect it.
void place_plane(const Spot& start, const char* both, const char* x, const char* y, const Dimension& of, const Placing& placing) {
  const auto placed = [&](const Pair& p) { return of.time == 0 ? placing.point(p) : placing.vector(p); };
  if (start.has(both)) set(start.at(both), placed(start.at(both).node.pair(of)));
  const bool has_x = start.has(x), has_y = start.has(y);
  if (!has_x && !has_y) return;
  const Pair p{has_x ? start.at(x).node.quantity(of) : 0, has_y ? start.at(y).node.quantity(of) : 0}, out = placed(p);
  const auto [c, s] = placing.turn();
  if (has_x && has_y) return set(start.at(x), out[0]), set(start.at(y), out[1]);
  if (c != 0 && s != 0)
    start.at(has_x ? x : y).node.fail(std::string("is not enough on its own if the instance is turned; write ") + both + ": [x, y]");
  const std::size_t which = (has_x ? 0U : 1U) ^ (c == 0 ? 1U : 0U);
  const Spot old = start.at(has_x ? x : y);
  old.yaml = number_like(old.yaml, which == 0 ? x : y, out[which]);
}

void place_start(const Spot& start, const Placing& placing) {
  if (!start.node.is_map()) return;
  if (start.has("modes") && placing.mirrored) cannot_mirror(start.at("modes").node, "give the deflection of the body with deflection");
  place_plane(start, "at", "x", "y", dimension::length, placing);
  place_plane(start, "velocity", "vx", "vy", dimension::speed, placing);
  if (start.has("angle")) set_angle(start.at("angle"), placing.direction(start.at("angle").node.quantity(dimension::angle)));
  if (start.has("eccentricity")) set(start.at("eccentricity"), placing.vector(start.at("eccentricity").node.pair(dimension::length)));
  if (start.has("speed") && start.at("speed").node.is_list())
    set(start.at("speed"), placing.vector(start.at("speed").node.pair(dimension::speed)));
  else if (start.has("speed") && placing.mirrored)
    negate(start, "speed", dimension::angular_speed);
  if (start.has("deflection") && placing.mirrored)
    for (const Spot& point : start.at("deflection").entries("points and displacements"))
      set(point, flipped(point.node.pair(dimension::length)));
}

constexpr const char* signals_turn = "signals in it may change their sign when mirrored: write it into the scene for each side";

}  // namespace

void place(Yaml& entry, const std::string& section, const std::string& path, const Placing& placing, const Source& source) {
  const Spot spot{entry, {entry, source, {entry.line, path, source.file_of(entry.file)}, entry.key}};
  if (section == "ground.points") return place_ground_point(spot, placing);
  if (!spot.node.is_map()) {
    if (placing.mirrored) cannot_mirror(spot.node, signals_turn);
    return;
  }
  if (section == "ground.profiles") return place_profile(spot, {placing, true});
  if (section == "bodies") return place_body(spot, placing);
  if (section == "start") return place_start(spot, placing);
  if (section == "forces") return place_force(spot, placing);
  if (section == "joints") return place_joint(spot, placing);
  if (!placing.mirrored || section == "contacts" || section == "materials") return;
  if (section == "drivers") return mirror_driver(spot);
  cannot_mirror(spot.node, signals_turn);
}

}  // namespace pintle
