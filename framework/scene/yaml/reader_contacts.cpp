#include <algorithm>
#include <array>
#include <tuple>

#include "files/files.h"
#include "framework/common/nearest.h"
#include "framework/common/text.h"
#include "framework/scene/units/table.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

Elasticity read_elasticity(const Node& node) {
  return {node.at("young").quantity(dimension::stress, rule::positive), node.at("poisson").quantity(dimension::number, rule::poisson)};
}

// `young` and `poisson` apply to both bodies, unless the other has its own.
void read_stiffness(const Node& node, std::string_view keys, SceneNormal& normal) {
  const char* other = keys.starts_with("joints") ? "journal" : "second";
  const bool elastic = node.has("young") || node.has("poisson");
  if (node.has("stiffness")) {
    if (elastic || node.has(other))
      node.at("stiffness").fail("cannot be combined with young and poisson; give either the stiffness or those");
    const Dimension expected{1 - normal.exponent, 1, -2, 0};  // N/mⁿ
    normal.stiffness = node.at("stiffness").quantity(expected, rule::positive);
    return;
  }
  if (!(node.has("young") && node.has("poisson")))
    node.fail("does not give the stiffness of the contact; add young and poisson, or stiffness");
  normal.bearing = normal.journal = read_elasticity(node);
  if (!node.has(other)) return;
  check_keys(node.at(other), std::string(keys) + "." + other);
  normal.journal = read_elasticity(node.at(other));
}

constexpr const char* spring_damper = "spring-damper";

void read_spring_damper(const Node& law, SceneNormal& normal) {
  for (const char* key : {"stiffness", "damping"})
    if (!law.has(key))
      law.fail(std::string("lacks a required key; add for example ") + (key[0] == 's' ? "stiffness: 1e6 N/m" : "damping: 100 N s/m"));
  for (const std::string& key : law.keys())
    if (key != "stiffness" && key != "damping") law.at(key).fail("does not belong to spring-damper; leave it out");
  normal.exponent = 1;
  normal.stiffness = law.at("stiffness").quantity({0, 1, -2, 0}, rule::positive);
  normal.damping = law.at("damping").quantity({0, 1, -1, 0}, rule::not_negative);
}

// Restitution, and the speed that scales the damping.
void read_damping(const Node& law, std::string_view keys, SceneNormal& normal) {
  read_optional(law, "restitution", dimension::number, rule::zero_to_one, normal.restitution);
  read_optional(law, "slowest impact", dimension::speed, rule::positive, normal.slowest_impact);
  normal.follows = law.has("approach speed") ? law.at("approach speed").one_of(choices(keys, "approach speed")) == "largest"
                                             : keys.starts_with("contacts");
}

const std::vector<std::string> names_of_cylinders{"johnson", "radzimovsky", "goldsmith", "esdu", "liu", "pereira", "winkler"};
constexpr const char* layer_law = "winkler";
constexpr const char* table_law = "table";

std::vector<Pair> read_points(const Node& law) {
  const char* remedy = "points of depth and force, the first [0, 0]: [[0, 0], [1 um, 50 N], [5 um, 400 N]]";
  std::vector<Pair> out;
  if (which_key(law, std::vector<std::string>{"points", "file"}, "its table") == "points") {
    for (const char* unit : {"depth unit", "force unit"})
      if (law.has(unit)) law.at(unit).fail("is for `file` only; write the units with the numbers of points");
    for (const Node& point : law.at("points").list(2, remedy)) {
      const std::vector<Node> numbers = point.items(2, remedy);
      out.push_back({numbers[0].quantity(dimension::length), numbers[1].quantity(dimension::force)});
    }
    return out;
  }
  const Node file = law.at("file");
  const double depth_unit = unit_factor(law, "depth unit", dimension::length),
               force_unit = unit_factor(law, "force unit", dimension::force);
  std::filesystem::path path;
  try {
    path = contained_file(file.file("the name of a file beside the scene"), law.source().folder);
  } catch (const FileRejected& rejected) {
    file.fail(rejected.what());
  }
  const Samples samples = read_samples(path, depth_unit, force_unit, file.place().key, "depth");
  for (std::size_t i = 0; i < samples.t.size(); ++i) out.push_back({samples.t[i], samples.value[i]});
  return out;
}

// The material of winkler's layer, or its stiffness.
void read_layer(const Node& law, SceneNormal& normal) {
  if (law.has("stiffness")) {
    for (const char* key : {"layer", "young", "poisson"})
      if (law.has(key)) law.at("stiffness").fail("cannot be combined with layer, young and poisson; give either the stiffness or those");
    normal.stiffness = law.at("stiffness").quantity({-2, 1, -2, 0}, rule::positive);  // N/m³
    return;
  }
  if (!law.has("layer"))
    law.fail("lacks a required key; add for example layer: 1 mm (the thickness of the elastic layer), or stiffness: 4e12 N/m^3");
  if (!(law.has("young") && law.has("poisson"))) law.fail("does not give the stiffness of the layer; add young and poisson, or stiffness");
  normal.layer = read_size(law.at("layer"));
  normal.bearing = {law.at("young").quantity(dimension::stress, rule::positive),
                    law.at("poisson").quantity(dimension::number, rule::solid_poisson)};
}

// A law of cylinders, or a table.
void read_elastic_law(const Node& law, std::string_view keys, SceneNormal& normal) {
  const bool table = normal.law == table_law;
  const std::string other = keys.starts_with("joints") ? "journal" : "second";
  std::vector<std::string> known{"hysteresis", "restitution", "slowest impact", "approach speed"};
  const bool layer = normal.law == layer_law;
  for (const std::string& key : table   ? std::vector<std::string>{"points", "file", "depth unit", "force unit"}
                                : layer ? std::vector<std::string>{"length", "layer", "young", "poisson", "stiffness"}
                                        : std::vector<std::string>{"length", "young", "poisson", other})
    known.push_back(key);
  for (const std::string& key : law.keys())
    if (std::ranges::find(known, key) == known.end()) law.at(key).fail("does not belong to " + normal.law + "; leave it out");
  read_damping(law, keys, normal);
  if (law.has("hysteresis")) {
    normal.hysteresis = law.at("hysteresis").one_of(choices(keys, "hysteresis"));
    if (!law.has("restitution")) law.at("hysteresis").fail("needs a restitution; add for example restitution: 0.8");
  }
  if (table) {
    normal.points = read_points(law);
    return;
  }
  if (!law.has("length")) law.fail("lacks a required key; add for example length: 20 mm (of the contact along the axes)");
  normal.length = read_size(law.at("length"));
  if (layer) return read_layer(law, normal);
  read_stiffness(law, keys, normal);
}

SceneContact read_contact(const Node& node, const Scene& scene) {
  SceneContact out;
  out.name = checked_name(node);
  out.place = node.place();
  check_keys(node, "contacts.*");
  std::tie(out.a, out.b) = read_ends(node.at("between"), "two profiles, each as BODY.PROFILE: [box.outline, ground.floor]");
  for (const PointRef* ref : {&out.a, &out.b}) {
    const auto body = std::ranges::find(scene.bodies, ref->body, &SceneBody::name);
    if (ref->body != "ground" && body == scene.bodies.end()) continue;  // reported by build
    const auto& profiles = ref->body == "ground" ? scene.ground_profiles : body->profiles;
    std::vector<std::string> known;
    for (const SceneProfile& p : profiles) known.push_back(p.name);
    if (std::ranges::find(known, ref->point) == known.end())
      throw SceneError(
          scene.file, ref->place,
          "\"" + ref->body + "\" " + (ref->point.empty() ? "names no profile" : "has no profile \"" + ref->point + "\"") +
              (known.empty() ? "; give it one: profiles: {rim: {disc: A, radius: 20 mm}}" : "." + did_you_mean(ref->point, known)));
  }
  read_laws(node, "contacts.*", out.normal, out.impact, out.friction);
  out.engaged = read_engaged(node);
  return out;
}

}  // namespace

void reject_impact_keys(const Node& node) {
  for (const char* key : {"restitution", "tangential restitution", "restitution law"})
    if (node.has(key)) node.at(key).fail("is for model: impact only; add that, or write the restitution into the normal law");
}

SceneImpact read_impact(const Node& node, std::string_view keys) {
  SceneImpact out;
  if (node.has("restitution"))
    out.restitution = node.at("restitution").quantity(dimension::number, rule::zero_to_one);
  else if (node.has("normal") && node.at("normal").entries("").front().has("restitution"))
    out.restitution = node.at("normal").entries("").front().at("restitution").quantity(dimension::number, rule::zero_to_one);
  else
    node.fail("lacks a required key; add for example restitution: 0.8");
  read_optional(node, "tangential restitution", dimension::number, rule::zero_to_one, out.tangential);
  if (node.has("restitution law")) out.poisson = node.at("restitution law").one_of(choices(keys, "restitution law")) == "poisson";
  if (out.poisson && out.tangential > 0)
    node.at("tangential restitution").fail("is for Newton's law of restitution only; leave one of the two out");
  return out;
}

void check_rigid_friction(const Node& node) {
  if (!node.has("friction") || node.at("friction").has("coulomb")) return;
  node.at("friction").fail("of rigid bodies must be dry; write {coulomb: {coefficient: 0.1}}");
}

void read_laws(const Node& node, std::string_view keys, SceneNormal& normal, std::optional<SceneImpact>& impact,
               std::optional<SceneFriction>& friction) {
  const std::string word = node.has("model") ? node.at("model").one_of(std::vector<std::string>{"contact", "impact"}) : "contact";
  if (node.has("normal")) normal = read_normal(node.at("normal"), "contacts.*.normal.*");
  if (node.has("friction")) friction = read_friction(node.at("friction"), "contacts.*.friction");
  if (word == "impact") {
    impact = read_impact(node, keys);
    check_rigid_friction(node);
    return;
  }
  reject_impact_keys(node);
  if (!node.has("normal"))
    node.fail(
        "lacks a required key; add for example normal: {lankarani-nikravesh: {restitution: 0.8, stiffness: 1e9 N/m^1.5}}, or model: "
        "impact with a restitution");
}

SceneNormal read_normal(const Node& node, std::string_view keys) {
  const char* remedy = "one law: {lankarani-nikravesh: {restitution: 0.8, young: 207 GPa, poisson: 0.3}}";
  if (keys.starts_with("joints") && (node.is_map() ? node.has(spring_damper) : node.is_scalar() && node.yaml().text == spring_damper))
    node.fail(
        "a spring-damper is a model of the clearance, not a normal law: next to `radial` write model: spring-damper, stiffness: 1e6 N/m, "
        "damping: 100 N s/m, and leave `normal` out");
  const auto laws = node.entries(remedy);
  if (laws.size() != 1) node.fail("names " + std::to_string(laws.size()) + " laws; write " + remedy);
  const Node& law = laws.front();
  check_keys(law, keys);
  SceneNormal normal;
  normal.law = law.name();
  normal.place = law.place();
  if (keys.starts_with("contacts")) {
    if (normal.law == spring_damper) {
      read_spring_damper(law, normal);
      return normal;
    }
    if (law.has("damping")) law.at("damping").fail("is for spring-damper only; leave it out");
  }
  if (normal.law == table_law || std::ranges::find(names_of_cylinders, normal.law) != names_of_cylinders.end()) {
    read_elastic_law(law, keys, normal);
    return normal;
  }
  for (const char* key : {"length", "layer", "hysteresis", "points", "file", "depth unit", "force unit"})
    if (law.has(key)) law.at(key).fail("does not belong to " + normal.law + "; leave it out");
  const bool lossless = normal.law == "hertz";
  if (lossless && law.has("restitution")) law.at("restitution").fail("hertz has no losses; leave restitution out");
  if (!lossless && !law.has("restitution")) law.fail("lacks a required key; add for example restitution: 0.8");
  read_damping(law, keys, normal);
  read_optional(law, "exponent", dimension::number, rule::at_least_one, normal.exponent);
  if (law.has("radii") && law.at("radii").one_of(choices(keys, "radii")) == "external") normal.radii = RadiusConvention::external;
  read_stiffness(law, keys, normal);
  return normal;
}

SceneFriction read_friction(const Node& node, const std::string& path) {
  check_keys(node, path);
  const std::string law =
      which_key(node, std::vector<std::string>{"coulomb", "lugre", "gonthier", "ambrosio", "threlfall", "tanh", "bengisu-akay"},
                "which friction law it has");
  return read_friction_law(node.at(law), path + "." + law);
}

namespace {

void read_bristles(const Node& law, SceneFriction& friction) {
  constexpr Dimension per_length{-1, 0, 0, 0}, per_speed{-1, 0, 1, 0};
  if (!(friction.coefficient > 0)) law.at("coefficient").fail("must be above 0: bristles slip at a force proportional to it");
  friction.bristle_stiffness = law.at("bristle stiffness").quantity(per_length, rule::positive);
  const auto optional_of = [&](const char* key, const Dimension& of, const Rule& must, std::optional<double>& to) {
    if (law.has(key)) to = law.at(key).quantity(of, must);
  };
  optional_of("bristle damping", per_speed, friction.law == "gonthier" ? rule::positive : rule::not_negative, friction.bristle_damping);
  optional_of("damping speed", dimension::speed, rule::positive, friction.damping_speed);
  read_optional(law, "viscous", per_speed, rule::not_negative, friction.viscous);
  read_optional(law, "dwell time", dimension::time, rule::positive, friction.dwell);
}

}  // namespace

SceneFriction read_friction_law(const Node& law, const std::string& keys) {
  check_keys(law, keys);
  SceneFriction friction;
  friction.law = law.name();
  friction.place = law.place();
  friction.coefficient = law.at("coefficient").quantity(dimension::number, rule::not_negative);
  if (law.has("static")) {
    friction.holds = law.at("static").quantity(dimension::number, rule::not_negative);
    if (*friction.holds < friction.coefficient)
      law.at("static").fail("must be coefficient, " + number_text(friction.coefficient) +
                            ", or above: sticking friction is at least sliding friction");
  }
  read_optional(law, "stribeck speed", dimension::speed, rule::positive, friction.stribeck);
  const bool bristles = friction.law == "lugre" || friction.law == "gonthier";
  if (bristles) read_bristles(law, friction);
  if (!bristles && law.has("stribeck speed") && !(friction.holds.value_or(0) > friction.coefficient))
    law.at("stribeck speed").fail("needs `static` above coefficient; add it, or leave this out");
  if (friction.law == "bengisu-akay" && law.has("v0")) law.at("v0").quantity(dimension::speed, rule::positive);
  read_optional(law, "v0", dimension::speed, rule::not_negative, friction.v0);
  read_optional(law, "v1", dimension::speed, rule::positive, friction.v1);
  if (friction.law == "ambrosio" && friction.v0 >= friction.v1)
    (law.has("v1") ? law.at("v1") : law.at("v0")).fail("v0 must be less than v1: friction grows from 0 at v0 to its full value at v1");
  if (law.has("sliding") && law.at("sliding").one_of(choices(keys, "sliding")) == "geometric") friction.sliding = SlidingSpeed::geometric;
  return friction;
}

void read_contacts(const Node& root, Scene& scene) {
  if (!root.has("contacts")) return;
  for (const Node& node : root.at("contacts").entries("names and contacts: {stop: {between: [arm.tip, ground.stop], normal: {…}}}"))
    scene.contacts.push_back(read_contact(node, scene));
}

}  // namespace pintle
