#include <tuple>

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
    }
    return out;
  }();
  return keys;
}

void read_model(const Node& node, SceneClearance& clearance) {
  if (node.has("model")) {
    const std::string word = node.at("model").one_of(choices("joints.*.clearance", "model"));
    for (const ClearanceModel m : {ClearanceModel::massless_link, ClearanceModel::spring_damper})
      if (word == model_name(m)) clearance.model = m;
  }
  if (node.has("stiffness")) clearance.stiffness = node.at("stiffness").quantity({0, 1, -2, 0}, rule::positive);
  if (node.has("damping")) clearance.damping = node.at("damping").quantity({0, 1, -1, 0}, rule::not_negative);
  const bool whole = clearance.model == ClearanceModel::massless_link ||
                     (clearance.model == ClearanceModel::spring_damper && clearance.stiffness && clearance.damping);
  if (!whole && !node.has("normal"))
    node.fail(std::string(
                  "lacks a required key; add for example normal: {lankarani-nikravesh: {restitution: 0.8, young: 207 GPa, poisson: 0.3}}") +
              (clearance.model == ClearanceModel::spring_damper ? ", or both stiffness and damping" : ""));
}

SceneClearance read_clearance(const Node& node, const SceneJoint& joint) {
  check_keys(node, "joints.*.clearance");
  SceneClearance clearance;
  clearance.place = node.place();
  read_model(node, clearance);
  if (node.has("normal")) clearance.normal = read_normal(node.at("normal"), "joints.*.clearance.normal.*");
  const Node radius = node.at("bearing radius"), radial = node.at("radial");
  clearance.bearing_radius = radius.quantity(dimension::length, rule::positive);
  clearance.radial = radial.quantity(dimension::length, rule::positive);
  if (clearance.radial >= clearance.bearing_radius)
    radial.fail(radial.shown() + " must be less than the bearing radius " + radius.shown() + ": the journal's radius is their difference");
  const Node bearing = node.at("bearing");
  clearance.bearing = bearing.text("the body that carries the bearing");
  if (clearance.bearing != joint.a.body && clearance.bearing != joint.b.body)
    bearing.fail(bearing.shown() + " is not joined here; write " + joint.a.body + " or " + joint.b.body);
  if (node.has("friction")) clearance.friction = read_friction(node.at("friction"), "joints.*.clearance.friction");
  return clearance;
}

void read_points(const Node& node, const JointWord& word, SceneJoint& joint) {
  if (!word.third) {
    std::tie(joint.a, joint.b) = read_ends(node);
    return;
  }
  const std::string remedy = "two points, or three: [left.A, right.A, cage.A]; the third is the ground if it is left out";
  const std::vector<Node> points = node.list(2, remedy);
  if (points.size() > 3) node.fail("is " + node.shown() + "; write " + remedy);
  joint.a = read_point_ref(points[0]);
  joint.b = read_point_ref(points[1]);
  if (points.size() == 3) joint.c = read_point_ref(points[2]);
}

SceneJoint read_joint(const Node& node) {
  SceneJoint joint;
  joint.name = checked_name(node);
  joint.place = node.place();
  check_keys(node, "joints.*");
  const JointWord& word = joint_words()[which_kind(node, joint_keys())];
  joint.kind = word.kind;
  read_points(node.at(word.word), word, joint);
  for (const JointNumber& number : word.numbers) {
    if (number.required && !node.has(number.key)) node.fail(std::string("lacks a required key; add for example ") + number.required);
    const Dimension& expected = number.of == JointNumber::angle    ? dimension::angle
                                : number.of == JointNumber::length ? dimension::length
                                                                   : dimension::number;
    read_optional(node, number.key, expected, number.required ? rule::positive : rule::any, joint.*number.value);
  }
  if (node.has("clearance")) joint.clearance = read_clearance(node.at("clearance"), joint);
  return joint;
}

}  // namespace

const char* model_name(ClearanceModel model) {
  switch (model) {
    case ClearanceModel::contact: return "contact";
    case ClearanceModel::massless_link: return "massless link";
    case ClearanceModel::spring_damper: return "spring-damper";
  }
  return "";
}

void read_joints(const Node& root, Scene& scene) {
  if (!root.has("joints")) return;
  for (const Node& node : root.at("joints").entries("names and joints: {pin: {revolute: [ground, crank.O]}}"))
    scene.joints.push_back(read_joint(node));
}

}  // namespace pintle
