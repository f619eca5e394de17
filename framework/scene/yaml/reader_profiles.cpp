#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "files/files.h"
#include "framework/common/nearest.h"
#include "framework/common/text.h"
#include "framework/scene/units/table.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

ScenePathPoint read_place(const Node& node, const std::vector<ScenePoint>& points, const std::string& body) {
  ScenePathPoint out;
  out.place = node.place();
  if (node.is_list()) {
    out.at = node.pair(dimension::length);
    return out;
  }
  out.point = node.text("a point of the body, or [x, y]");
  if (body == "ground") out.point = resolved(node.source(), node.yaml().scope, {"ground", out.point}).point;
  std::vector<std::string> known;
  for (const ScenePoint& p : points) known.push_back(p.name);
  if (std::ranges::find(known, out.point) == known.end())
    node.fail(
        "\"" + body + "\" has no point \"" + out.point + "\"" +
        (known.empty() ? "; write a position such as [10 mm, 0], or add the point under points" : "." + did_you_mean(out.point, known)));
  return out;
}

// Points and arcs between them.
std::vector<ScenePathPoint> read_path(const Node& node, std::string_view keys, const std::vector<ScenePoint>& points,
                                      const std::string& body) {
  std::vector<ScenePathPoint> out;
  bool arc = false;
  for (const Node& item : node.list(2, "points and arcs: [A, B, {arc: 20 mm}, C]")) {
    if (!item.is_map()) {
      out.push_back(read_place(item, points, body));
      arc = false;
      continue;
    }
    check_keys(item, std::string(keys) + ".path.*");
    if (out.empty() || arc) item.fail("is an arc where a point is needed; an arc leads from the point before it to the point after it");
    out.back().arc = item.at("arc").quantity(dimension::length);
    if (out.back().arc == 0) item.fail("must not be 0: a positive radius turns left, a negative one right");
    arc = true;
  }
  return out;
}

// A two-column file next to the scene.
std::filesystem::path file_of(const Node& group) {
  const Node file = group.at("file");
  try {
    return contained_file(file.file("the name of a file beside the scene"), group.source().folder);
  } catch (const FileRejected& rejected) {
    file.fail(rejected.what());
  }
}

std::vector<ScenePathPoint> read_spline(const Node& node, std::string_view keys, const std::vector<ScenePoint>& points,
                                        const std::string& body) {
  std::vector<ScenePathPoint> out;
  if (!node.is_map()) {
    for (const Node& item : node.list(2, "points along the surface, or {file: cam.csv, length unit: mm}"))
      out.push_back(read_place(item, points, body));
    return out;
  }
  check_keys(node, std::string(keys) + ".spline");
  const double unit = unit_factor(node, "length unit", dimension::length);
  for (const Pair& at : read_pairs(file_of(node), unit, node.at("file").place().key)) out.push_back({"", at, 0, node.at("file").place()});
  return out;
}

// Angles and radii, in `at`; the angles increase over at most one turn.
std::vector<ScenePathPoint> read_polar(const Node& node, std::string_view keys) {
  std::vector<ScenePathPoint> out;
  const auto add = [&](double angle, double radius, const Node& where) {
    const std::string which = "point " + std::to_string(out.size() + 1);
    if (!(radius > 0)) where.fail(which + " has the radius " + number_text(radius) + " m; it must be above 0");
    if (!out.empty() && !(angle > out.back().at[0]))
      where.fail(which + " at the angle " + number_text(angle) + " rad is not greater than the one before; angles must increase");
    out.push_back({"", {angle, radius}, 0, where.place()});
  };
  if (node.is_map()) {
    check_keys(node, std::string(keys) + ".polar");
    const double angle_unit = unit_factor(node, "angle unit", dimension::angle),
                 radius_unit = unit_factor(node, "radius unit", dimension::length);
    const Node file = node.at("file");
    const Samples samples = read_samples(file_of(node), angle_unit, radius_unit, file.place().key, "angle");
    for (std::size_t i = 0; i < samples.t.size(); ++i) add(samples.t[i], samples.value[i], file);
  } else {
    const char* remedy = "angles and radii: [[0 deg, 20 mm], [10 deg, 20.1 mm], [20 deg, 20.5 mm]], or {file: cam.csv, angle unit: deg}";
    for (const Node& point : node.list(2, remedy)) {
      const std::vector<Node> numbers = point.items(2, remedy);
      add(numbers[0].quantity(dimension::angle), numbers[1].quantity(dimension::length), point);
    }
  }
  constexpr double once = 2 * std::numbers::pi, same = 1e-9;
  const double turn = out.back().at[0] - out.front().at[0];
  if (turn > once * (1 + same))
    node.fail("covers " + number_text(turn) + " rad from its first point, more than one turn; leave out the points beyond a turn");
  if (turn > once * (1 - same)) {
    if (std::abs(out.back().at[1] - out.front().at[1]) > same * out.front().at[1])
      node.fail("has the radius " + number_text(out.front().at[1]) + " m at its first point and " + number_text(out.back().at[1]) +
                " m a turn later; make them equal, or leave out the last point");
    out.pop_back();
  }
  return out;
}

const std::array<KindKeys, 5> profile_kinds{{{"disc", {"radius", "on"}},
                                             {"hole", {"radius", "on"}},
                                             {"path", {"closed", "material", "round", "on"}},
                                             {"spline", {"closed", "material", "on"}},
                                             {"polar", {"about", "material", "on"}}}};

void read_surface(const Node& node, std::string_view keys, const std::vector<ScenePoint>& points, const std::string& body,
                  SceneProfile& out) {
  if (node.has("closed")) out.closed = node.at("closed").yes();
  if (out.kind == SceneProfile::spline) {
    out.points = read_spline(node.at("spline"), keys, points, body);
  } else if (out.kind == SceneProfile::polar) {
    out.points = read_polar(node.at("polar"), keys);
    out.closed = true;
    if (node.has("about")) out.centre = read_place(node.at("about"), points, body);
  } else {
    out.points = read_path(node.at("path"), keys, points, body);
    if (!out.closed && out.points.back().arc != 0)
      node.at("path").fail("ends with an arc; add its end point, or closed: true to end it at the first point");
    if (node.has("round")) out.round = read_size(node.at("round"));
  }
}

SceneProfile read_profile(const Node& node, std::string_view keys, const std::vector<ScenePoint>& points, const std::string& body) {
  SceneProfile out;
  out.name = checked_name(node);
  out.place = node.place();
  check_keys(node, keys);
  out.kind = std::array{SceneProfile::disc, SceneProfile::hole, SceneProfile::path, SceneProfile::spline,
                        SceneProfile::polar}[which_kind(node, profile_kinds)];
  if (node.has("on")) {
    const ScenePathPoint on = read_place(node.at("on"), points, body);
    if (on.point.empty()) node.at("on").fail("is a position; name the point of the body that carries the profile");
    out.on = on.point;
  }
  if (out.kind == SceneProfile::disc || out.kind == SceneProfile::hole) {
    out.centre = read_place(node.at(out.kind == SceneProfile::disc ? "disc" : "hole"), points, body);
    if (!node.has("radius")) node.fail("lacks a required key; add for example radius: 20 mm");
    out.radius = read_size(node.at("radius"));
    return out;
  }
  read_surface(node, keys, points, body, out);
  out.material = out.closed ? SceneProfile::inside : SceneProfile::left;
  if (!node.has("material")) return out;
  const std::string side = node.at("material").one_of(choices(keys, "material"));
  if (out.closed != (side == "inside" || side == "outside"))
    node.at("material")
        .fail(out.closed ? "of a closed path must be inside or outside" : "of an open path must be left or right, seen along the path");
  out.material = side == "left"     ? SceneProfile::left
                 : side == "right"  ? SceneProfile::right
                 : side == "inside" ? SceneProfile::inside
                                    : SceneProfile::outside;
  return out;
}

}  // namespace

std::vector<SceneProfile> read_profiles(const Node& owner, std::string_view keys, const std::vector<ScenePoint>& points,
                                        const std::string& body) {
  std::vector<SceneProfile> out;
  if (!owner.has("profiles")) return out;
  for (const Node& node : owner.at("profiles").entries("names and profiles: {rim: {disc: A, radius: 20 mm}}")) {
    SceneProfile& made = out.emplace_back(read_profile(node, keys, points, body));
    if (owner.has("beam") || owner.has("plate")) {
      if (made.on.empty()) made.on = made.centre.point;
    } else if (node.has("on")) {
      node.at("on").fail("is for flexible bodies only; \"" + body + "\" is rigid: leave it out");
    }
  }
  return out;
}

}  // namespace pintle
