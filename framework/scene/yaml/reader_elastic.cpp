#include <algorithm>
#include <array>
#include <cmath>

#include "framework/common/nearest.h"
#include "framework/scene/joint_words.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

using Method = SceneModes::Method;

const std::vector<std::string> keep_words{"keep", "count", "below", "effective mass"};

// At most one of the keys for the number of shapes; a count is at least `least`.
SceneKeep read_keep(const Node& node, long least) {
  SceneKeep keep;
  std::vector<std::string> said;
  for (const std::string& key : keep_words)
    if (node.has(key)) said.push_back(key);
  if (said.size() > 1) node.fail("gives the number of shapes by " + listed(said, "and") + " at once; keep one of them");
  keep.automatic = said.empty();
  if (node.has("keep")) keep.automatic = node.at("keep").one_of(choices("bodies.*.modes", "keep")) == "auto";
  if (node.has("count")) {
    const long count = node.at("count").count(least);
    if (count > 100'000) node.at("count").fail("is more than 100 000; use fewer");
    keep.count = static_cast<int>(count);
  }
  if (node.has("below")) keep.below = node.at("below").frequency(rule::positive);
  if (node.has("effective mass")) keep.effective_mass = node.at("effective mass").quantity(dimension::number, rule::inside_zero_one);
  return keep;
}

void read_frame(const Node& node, const SceneBody& body, SceneModes& modes) {
  using Frame = SceneModes::Frame;
  const auto called = [](const std::string& name) {
    return name == "tangent" ? Frame::tangent : name == "chord" ? Frame::chord : Frame::mean_axes;
  };
  if (!node.is_map()) {
    modes.frame = called(node.one_of(choices("bodies.*.modes", "frame")));
    return;
  }
  static const std::array<KindKeys, 2> kinds{{{"tangent", {}}, {"chord", {}}}};
  check_keys(node, "bodies.*.modes.frame");
  if (which_kind(node, kinds) == 0) {
    modes.frame = Frame::tangent;
    modes.a = read_own_point(node.at("tangent"), body);
    return;
  }
  modes.frame = Frame::chord;
  const Node chord = node.at("chord");
  const auto two = chord.items(2, "two points of the body [A, B]");
  modes.a = read_own_point(two[0], body);
  modes.b = read_own_point(two[1], body);
  if (modes.a == modes.b) chord.fail("runs from " + modes.a + " to itself; name two points");
}

SceneModes read_modes(const Node& node, const SceneBody& body) {
  check_keys(node, "bodies.*.modes");
  SceneModes modes;
  modes.place = node.place();
  if (node.has("frame")) read_frame(node.at("frame"), body, modes);
  if (node.has("boundary")) modes.massless = node.at("boundary").one_of(choices("bodies.*.modes", "boundary")) == "massless";
  const std::array<std::pair<const char*, Method>, 2> methods{{{"craig-bampton", Method::craig_bampton}, {"free", Method::free}}};
  if (node.has(methods[0].first) && node.has(methods[1].first)) node.fail("is craig-bampton and free at once; keep one of them");
  for (const auto& [key, method] : methods) {
    if (!node.has(key)) continue;
    for (const std::string& keep : keep_words)
      if (node.has(keep))
        node.at(keep).fail(std::string("is a key of ") + key + "; move it into its braces: " + key + ": {" + keep + ": …}");
    check_keys(node.at(key), std::string("bodies.*.modes.") + key);
    modes.method = method;
    modes.keep = read_keep(node.at(key), 0);  // none: only the static shapes
    return modes;
  }
  modes.keep = read_keep(node, 1);
  return modes;
}

constexpr Rule damping_ratio{[](double x) { return x >= 0 && x <= 1; },
                             "must lie between 0 and 1, where 1 is critical damping: 4 % is 0.04; for more than critical damping write "
                             "rayleigh: {alpha: 3 1/s, beta: 1e-5 s}"};

void read_rayleigh(const Node& node, SceneDamping& damping) {
  check_keys(node, "bodies.*.damping.rayleigh");
  const bool factors = node.has("alpha") || node.has("beta");
  if (factors == node.has("ratios"))
    node.fail(
        "is given either by ratios at two modes or by alpha and beta; write {ratios: [0.02, 0.02], modes: [1, 2]} or {alpha: 3 1/s, beta: "
        "1e-5 s}");
  if (factors) {
    std::array<double, 2> two{0, 0};
    read_optional(node, "alpha", dimension::rate, rule::not_negative, two[0]);
    read_optional(node, "beta", dimension::time, rule::not_negative, two[1]);
    damping.rayleigh = two;
    if (node.has("modes")) node.at("modes").fail("is for ratios, not for alpha and beta; leave it out");
    return;
  }
  const auto ratios = read_quantities(node.at("ratios"), 2, dimension::number, damping_ratio, "two damping ratios [0.02, 0.02]");
  damping.rayleigh_ratios = {ratios[0], ratios[1]};
  if (!node.has("modes")) return;
  const Node modes = node.at("modes");
  const auto two = modes.items(2, "two modes counted from 1: [1, 2]");
  for (std::size_t i = 0; i < 2; ++i) {
    const long number = two[i].count(1);
    if (number > 100'000) two[i].fail("is more than 100 000; name a lower mode");
    damping.rayleigh_modes[i] = static_cast<int>(number);
  }
  if (damping.rayleigh_modes[0] == damping.rayleigh_modes[1]) modes.fail("names one mode twice; two ratios need two modes");
}

SceneDamping read_damping(const Node& node) {
  check_keys(node, "bodies.*.damping");
  static const std::vector<std::string> ways{"rayleigh", "ratios"};
  SceneDamping damping;
  damping.place = node.place();
  if (which_key(node, ways, "how it is damped") == "rayleigh") {
    read_rayleigh(node.at("rayleigh"), damping);
    return damping;
  }
  const Node ratios = node.at("ratios");
  if (!ratios.is_list())
    damping.ratios.push_back(ratios.quantity(dimension::number, damping_ratio));
  else
    for (const Node& item : ratios.list(1, "a ratio, or a list with one ratio per mode: [0.01, 0.02]"))
      damping.ratios.push_back(item.quantity(dimension::number, damping_ratio));
  return damping;
}

Stiffening read_stiffening(const Node& node) {
  const std::string loads = node.one_of(choices("bodies.*", "stiffening"));
  return loads == "rotation" ? Stiffening::rotation : loads == "axial" ? Stiffening::axial : Stiffening::none;
}

// Rejects keys that only a flexible body in a mechanism can have.
[[noreturn]] void reject_of_rigid(const Node& node) {
  node.fail(
      "needs a flexible body: without modes the body is rigid in a mechanism; add for example "
      "modes: {frame: chord, craig-bampton: {count: 2}}, or leave it out");
}

std::vector<SceneLump> read_lumps(const Node& group, const SceneBody& body) {
  std::vector<SceneLump> lumps;
  for (const Node& node : group.entries("points and the lumps there: {B: {mass: 0.1 kg}}")) {
    check_keys(node, "bodies.*.lumps.*");
    SceneLump lump{node.name(), 0, 0, node.place()};
    check_own_point(node, lump.at, body);
    read_optional(node, "mass", dimension::mass, rule::not_negative, lump.mass);
    read_optional(node, "inertia", dimension::inertia, rule::not_negative, lump.inertia);
    if (lump.mass == 0 && lump.inertia == 0) node.fail("has no mass and no inertia; add mass, inertia or both");
    lumps.push_back(std::move(lump));
  }
  return lumps;
}

SceneSupport read_support(const Node& node) {
  static const std::vector<std::string> words{"x", "y", "rotation", "fixed", "pinned"};
  const std::string remedy = "what it fixes: fixed, pinned, or a list of x, y and rotation";
  SceneSupport support{node.name(), false, false, false, node.place()};
  std::vector<Node> held{node};
  if (node.is_list()) held = node.list(1, remedy);
  for (const Node& word : held) {
    if (!word.is_scalar()) word.fail("is " + word.shown() + "; write " + remedy);
    const std::string w = word.one_of(words);
    support.x |= w == "x" || w == "fixed" || w == "pinned";
    support.y |= w == "y" || w == "fixed" || w == "pinned";
    support.rotation |= w == "rotation" || w == "fixed";
  }
  return support;
}

}  // namespace

SceneElastic read_elastic(const Node& node, const SceneBody& body, const std::vector<SceneMaterial>& materials) {
  SceneElastic out;
  const bool beam = node.has("beam");
  if (beam)
    out.shape = read_beam(node.at("beam"), body, materials);
  else
    out.shape = read_plate(node.at("plate"), materials);
  if (node.has("mass matrix")) out.lumped = node.at("mass matrix").one_of(choices("bodies.*", "mass matrix")) == "lumped";
  if (node.has("lumps")) out.lumps = read_lumps(node.at("lumps"), body);
  if (node.has("supports"))
    for (const Node& support : node.at("supports").entries("points and their supports: {A: fixed, B: [y]}")) {
      if (beam) check_own_point(support, support.name(), body);  // a beam has no groups
      out.supports.push_back(read_support(support));
    }
  if (node.has("modes")) out.modes = read_modes(node.at("modes"), body);
  if (node.has("damping")) out.damping = read_damping(node.at("damping"));
  if (node.has("stiffening")) out.stiffening = read_stiffening(node.at("stiffening"));
  if (out.modes) return out;
  if (node.has("stiffening")) reject_of_rigid(node.at("stiffening"));
  if (beam && node.at("beam").has("pieces")) reject_of_rigid(node.at("beam").at("pieces"));
  return out;
}

namespace {

/// Points of a body that joints hold, each once, and those whose direction is held too.
struct Held {
  std::vector<const ScenePoint*> points, clamped;
};

Held held_points(const SceneBody& body, const Scene& scene) {
  Held held;
  const auto add = [&](std::vector<const ScenePoint*>& to, const PointRef& ref) {
    if (ref.body != body.name) return;
    const auto named = [&](const ScenePoint& p) {
      return ref.point.empty() ? p.hole.empty() && p.at[0] == 0 && p.at[1] == 0 : p.name == ref.point;
    };
    const auto p = std::ranges::find_if(body.points, named);
    if (p != body.points.end() && std::ranges::find(to, &*p) == to.end()) to.push_back(&*p);
  };
  std::vector<const ScenePoint*> turned;
  for (const SceneDriver& d : scene.drivers)
    if (d.kind == DriverKind::angle) add(turned, d.a), add(turned, d.b);
  for (const SceneJoint& j : scene.joints)
    for (const PointRef* ref : points_of(j)) {
      add(held.points, *ref);
      if (word_of(j).clamps) add(held.clamped, *ref);
    }
  for (const ScenePoint* p : held.points)
    if (std::ranges::find(turned, p) != turned.end() && std::ranges::find(held.clamped, p) == held.clamped.end()) held.clamped.push_back(p);
  return held;
}

bool can_turn(const SceneBody& body, const ScenePoint& p) {
  const auto* beam = std::get_if<SceneBeam>(&body.elastic->shape);
  return beam ? !beam->bar : !p.hole.empty();
}

double apart(const ScenePoint& a, const ScenePoint& b) {
  return a.hole.empty() && b.hole.empty() ? std::hypot(a.at[0] - b.at[0], a.at[1] - b.at[1]) : 0;
}

}  // namespace

void check_boundary(const SceneBody& body, const Scene& scene) {
  const auto presses = [&](const SceneJoint& j) { return presses_elastically(j) && (j.a.body == body.name || j.b.body == body.name); };
  if (body.elastic->modes->massless && std::ranges::none_of(scene.joints, presses))
    throw SceneError(scene.file, body.elastic->modes->place,
                     "boundary: massless is for a body at a revolute joint with clearance, a complete bearing and model: contact, and \"" +
                         body.name + "\" has none; leave it out");
}

void choose_frame(SceneBody& body, const Scene& scene) {
  using Frame = SceneModes::Frame;
  SceneModes& modes = *body.elastic->modes;
  const Held held = held_points(body, scene);
  if (held.points.size() == 1 && held.clamped.size() == 1 && can_turn(body, *held.clamped.front())) {
    modes.frame = Frame::tangent;
    modes.a = held.clamped.front()->name;
  }
  if (held.points.size() < 2) return;
  const ScenePoint *a = held.points[0], *b = held.points[1];
  for (const ScenePoint* p : held.points)
    for (const ScenePoint* q : held.points)
      if (apart(*p, *q) > apart(*a, *b)) a = p, b = q;
  if (a->hole.empty() && b->hole.empty() && apart(*a, *b) == 0) return;
  modes.frame = Frame::chord;
  modes.a = a->name, modes.b = b->name;
}

}  // namespace pintle
