#include <algorithm>
#include <numbers>
#include <tuple>

#include "framework/common/text.h"
#include "framework/scene/joint_words.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

const std::vector<KindKeys>& joint_keys() {
  static const std::vector<KindKeys> keys = [] {
    std::vector<KindKeys> out;
    for (const JointWord& word : joint_words()) {
      KindKeys& k = out.emplace_back(KindKeys{word.word, {}});
      for (const JointNumber& number : word.numbers) k.beside.emplace_back(number.key);
      if (word.clearance) k.beside.emplace_back("clearance");
      if (word.friction) k.beside.emplace_back("friction");
      k.beside.emplace_back("engaged");
      k.beside.insert(k.beside.end(), word.couples.begin(), word.couples.end());
    }
    return out;
  }();
  return keys;
}

void read_model(const Node& node, SceneClearance& clearance) {
  if (node.has("model")) {
    const std::string word = node.at("model").one_of(choices("joints.*.clearance", "model"));
    for (const ClearanceModel m : {ClearanceModel::massless_link, ClearanceModel::spring_damper, ClearanceModel::impact})
      if (word == model_name(m)) clearance.model = m;
  }
  if (node.has("stiffness")) clearance.stiffness = node.at("stiffness").quantity({0, 1, -2, 0}, rule::positive);
  if (node.has("damping")) clearance.damping = node.at("damping").quantity({0, 1, -1, 0}, rule::not_negative);
  const bool whole = clearance.model == ClearanceModel::massless_link || clearance.model == ClearanceModel::impact ||
                     (clearance.model == ClearanceModel::spring_damper && clearance.stiffness && clearance.damping);
  if (!whole && !node.has("normal"))
    node.fail(std::string(
                  "lacks a required key; add for example normal: {lankarani-nikravesh: {restitution: 0.8, young: 207 GPa, poisson: 0.3}}") +
              (clearance.model == ClearanceModel::spring_damper ? ", or both stiffness and damping" : ""));
}

// The keys of a clearance in one kind of joint, in addition to those of its laws, with examples of the required ones.
struct ClearanceKeys {
  JointKind kind;
  std::vector<std::pair<std::string, std::string>> needs;
  std::vector<std::string> takes;
  bool knows(const std::string& name) const {
    return std::ranges::find(takes, name) != takes.end() || std::ranges::any_of(needs, [&](const auto& key) { return key.first == name; });
  }
};
const std::vector<ClearanceKeys>& clearance_keys() {
  static const std::vector<ClearanceKeys> all{
      {JointKind::revolute, {{"radial", "0.1 mm"}, {"bearing radius", "10 mm"}, {"bearing", "slider"}}, {"stiffness", "damping", "arc"}},
      {JointKind::prismatic, {{"gap", "0.1 mm"}, {"length", "60 mm"}, {"height", "20 mm"}}, {"round"}},
      {JointKind::slot, {{"gap", "0.1 mm"}, {"pin radius", "5 mm"}}, {"travel"}},
      {JointKind::distance, {}, {"gap", "only"}},
      {JointKind::gear, {{"backlash", "0.1 mm"}}, {"pressure angle"}},
      {JointKind::rack, {{"backlash", "0.1 mm"}}, {"pressure angle"}},
  };
  return all;
}

void check_clearance(const Node& node, const SceneJoint& joint) {
  check_keys(node, "joints.*.clearance");
  static const std::vector<std::string> of_laws{"model", "restitution", "tangential restitution", "restitution law", "normal", "friction"};
  const ClearanceKeys& keys = *std::ranges::find(clearance_keys(), joint.kind, &ClearanceKeys::kind);
  for (const Node& entry : node.entries("keys and values")) {
    if (keys.knows(entry.name()) || std::ranges::find(of_laws, entry.name()) != of_laws.end()) continue;
    entry.fail(std::string("does not belong to the clearance of a ") + word_of(joint).word + " joint; leave it out");
  }
  for (const auto& [key, example] : keys.needs)
    if (!node.has(key)) node.fail("lacks a required key; add for example " + key + ": " + example);
}

void read_backlash(const Node& node, const SceneJoint& joint, ScenePlay& play) {
  constexpr double most = std::numbers::pi / 4;
  const Node backlash = node.at("backlash");
  play.backlash = backlash.quantity(dimension::length, rule::positive);
  const SceneCoupling& wheels = *joint.coupling;
  const double least = wheels.radius > 0 ? wheels.radius : std::min(wheels.radii[0], wheels.radii[1]);
  if (least > 0 && play.backlash >= least)
    backlash.fail(backlash.shown() + " must be less than the radius " + number_text(1e3 * least) +
                  " mm: teeth are smaller than their wheel");
  if (!node.has("pressure angle")) return;
  play.pressure_angle = node.at("pressure angle").quantity(dimension::angle, rule::positive);
  if (play.pressure_angle >= most)
    node.at("pressure angle").fail(node.at("pressure angle").shown() + " must be less than 45 deg; 20 deg is usual");
}

ScenePlay read_play(const Node& node, const SceneJoint& joint) {
  check_clearance(node, joint);
  ScenePlay play;
  play.place = node.place();
  read_optional(node, "gap", dimension::length, rule::positive, play.gap);
  read_optional(node, "length", dimension::length, rule::positive, play.length);
  read_optional(node, "height", dimension::length, rule::positive, play.height);
  read_optional(node, "round", dimension::length, rule::positive, play.round);
  read_optional(node, "pin radius", dimension::length, rule::positive, play.pin_radius);
  if (node.has("travel")) play.travel = node.at("travel").quantity(dimension::length, rule::positive);
  if (node.has("only"))
    play.only = node.at("only").one_of(choices("joints.*.clearance", "only")) == "pull" ? ScenePlay::pull : ScenePlay::push;
  if (joint.kind == JointKind::distance && play.only == ScenePlay::both && !node.has("gap"))
    node.fail("lacks a required key; add for example gap: 1 mm, or only: pull for a rope");
  if (play.gap >= joint.length && joint.kind == JointKind::distance)
    node.at("gap").fail(node.at("gap").shown() + " must be less than the length of the joint");
  if (node.has("backlash")) read_backlash(node, joint, play);
  if (node.has("friction") && !word_of(joint).friction)
    node.at("friction")
        .fail(std::string("does not belong to the clearance of a ") + word_of(joint).word + " joint, where " +
              (word_of(joint).turns ? "pitch circles roll without slip" : "a rod meets no wall") + "; leave it out");
  read_laws(node, "joints.*.clearance", play.normal, play.impact, play.friction);
  return play;
}

SceneArc read_arc(const Node& node, const Node& clearance, ClearanceModel model) {
  check_keys(node, "joints.*.clearance.arc");
  SceneArc arc;
  arc.middle = node.at("middle").quantity(dimension::angle);
  arc.extent = node.at("extent").quantity(dimension::angle, rule::positive);
  read_optional(node, "wall", dimension::length, rule::positive, arc.wall);
  read_optional(node, "edge", dimension::length, rule::positive, arc.edge);
  if (arc.extent > SceneArc::turn + SceneArc::rounding) node.at("extent").fail("must not be above 360 deg, where the bearing is closed");
  if (!arc.whole() && !(arc.wall > 0)) node.fail("lacks a required key; add for example wall: 4 mm (the thickness of the bearing)");
  if (arc.edge > arc.wall / 2) node.at("edge").fail("must not be above half of wall, at which the ends are round");
  if (model == ClearanceModel::massless_link)
    node.fail("is for a journal that can leave its bearing, but a massless link holds it at the wall; use another model, or leave it out");
  if (model == ClearanceModel::spring_damper && !(clearance.has("stiffness") && clearance.has("damping")))
    clearance.fail("needs both stiffness and damping: the spring-damper of an open bearing cannot derive them from `normal`");
  return arc;
}

SceneClearance read_clearance(const Node& node, const SceneJoint& joint) {
  check_clearance(node, joint);
  SceneClearance clearance;
  clearance.place = node.place();
  read_model(node, clearance);
  if (node.has("normal")) clearance.normal = read_normal(node.at("normal"), "joints.*.clearance.normal.*");
  if (clearance.model == ClearanceModel::impact)
    clearance.impact = read_impact(node, "joints.*.clearance");
  else
    reject_impact_keys(node);
  const Node radius = node.at("bearing radius"), radial = node.at("radial");
  clearance.bearing_radius = radius.quantity(dimension::length, rule::positive);
  clearance.radial = radial.quantity(dimension::length, rule::positive);
  if (clearance.radial >= clearance.bearing_radius)
    radial.fail(radial.shown() + " must be less than the bearing radius " + radius.shown() + ": the journal's radius is their difference");
  const Node bearing = node.at("bearing");
  clearance.bearing = bearing.part("the body that carries the bearing").part;
  if (clearance.bearing != joint.a.body && clearance.bearing != joint.b.body)
    bearing.fail(bearing.shown() + " is not a body of this joint; write " + joint.a.body + " or " + joint.b.body);
  if (node.has("friction")) clearance.friction = read_friction(node.at("friction"), "joints.*.clearance.friction");
  if (node.has("arc")) clearance.arc = read_arc(node.at("arc"), node, clearance.model);
  if (clearance.model == ClearanceModel::impact) check_rigid_friction(node);
  return clearance;
}

void read_points(const Node& node, const JointWord& word, SceneJoint& joint) {
  if (!word.third) {
    std::tie(joint.a, joint.b) = read_ends(node);
    return;
  }
  if (read_terms(node, joint)) return;
  const std::string remedy = "two points, or three: [left.A, right.A, cage.A]; the third is the ground if it is left out";
  const std::vector<Node> points = node.list(2, remedy);
  if (points.size() > 3) node.fail("is " + node.shown() + "; write " + remedy);
  joint.a = read_point_ref(points[0]);
  joint.b = read_point_ref(points[1]);
  if (points.size() == 3) {
    joint.c = read_point_ref(points[2]);
  } else if (const PartName own = resolved(node.source(), node.yaml().scope, {"ground", ""}); !own.point.empty()) {
    joint.c = PointRef{own.part, own.point, node.place()};  // of a rotated instance
  }
}

SceneJointFriction read_joint_friction(const Node& node, const SceneJoint& joint, bool has_clearance) {
  check_keys(node, "joints.*.friction");
  if (has_clearance)
    node.fail("is for an ideal joint, but this joint has a clearance; write friction inside the clearance, next to its normal law");
  SceneJointFriction out;
  const std::vector<std::string> laws{"coulomb", "lugre", "gonthier"};
  if (std::ranges::none_of(laws, [&](const std::string& law) { return node.has(law); }))
    node.fail("lacks a required key; add for example coulomb: {coefficient: 0.1}");
  const std::string law = which_key(node, laws, "which friction law it has");
  out.law = read_friction_law(node.at(law), "joints.*.friction." + law);
  const auto own = [&](const char* key, JointKind kind, double& value) {
    if (node.has(key) && joint.kind != kind)
      node.at(key).fail(std::string("does not belong to a ") + word_of(joint).word + " joint; leave it out");
    read_optional(node, key, dimension::length, rule::positive, value);
  };
  own("radius", JointKind::revolute, out.radius);
  own("length", JointKind::prismatic, out.length);
  if (joint.kind == JointKind::revolute && !node.has("radius")) node.fail("lacks a required key; add for example radius: 10 mm");
  if (joint.kind == JointKind::prismatic && !node.has("length")) node.fail("lacks a required key; add for example length: 60 mm");
  read_optional(node, "preload", {1, 1, -2, 0}, rule::not_negative, out.preload);
  return out;
}

const Dimension& dimension_of(const JointNumber& number) {
  switch (number.of) {
    case JointNumber::angle: return dimension::angle;
    case JointNumber::length: return dimension::length;
    case JointNumber::ratio: break;
  }
  return dimension::number;
}

SceneJoint read_joint(const Node& node) {
  SceneJoint joint;
  joint.name = checked_name(node);
  joint.place = node.place();
  check_keys(node, "joints.*");
  const JointWord& word = joint_words()[which_kind(node, joint_keys())];
  joint.kind = word.kind;
  joint.engaged = read_engaged(node);
  read_points(node.at(word.word), word, joint);
  for (const JointNumber& number : word.numbers) {
    if (number.required && !node.has(number.key)) node.fail(std::string("lacks a required key; add for example ") + number.required);
    if (number.present && says_present(node.at(number.key))) {
      joint.length = read_after_present(node.at(number.key), dimension::length).at(0).value;
      joint.from_present = true;
      if (node.has("clearance")) node.at(number.key).fail("cannot be `present` in a joint with clearance; write the length");
      continue;
    }
    read_optional(node, number.key, dimension_of(number), number.required ? rule::positive : rule::any, joint.*number.value);
  }
  read_coupling(node, word, joint);
  if (node.has("friction")) joint.friction = read_joint_friction(node.at("friction"), joint, node.has("clearance"));
  if (!node.has("clearance")) return joint;
  if (joint.kind == JointKind::revolute)
    joint.clearance = read_clearance(node.at("clearance"), joint);
  else
    joint.play = read_play(node.at("clearance"), joint);
  return joint;
}

}  // namespace

const char* model_name(ClearanceModel model) {
  switch (model) {
    case ClearanceModel::contact: return "contact";
    case ClearanceModel::massless_link: return "massless link";
    case ClearanceModel::spring_damper: return "spring-damper";
    case ClearanceModel::impact: return "impact";
  }
  return "";
}

void read_joints(const Node& root, Scene& scene) {
  if (!root.has("joints")) return;
  for (const Node& node : root.at("joints").entries("names and joints: {pin: {revolute: [ground, crank.O]}}"))
    scene.joints.push_back(read_joint(node));
}

}  // namespace pintle
