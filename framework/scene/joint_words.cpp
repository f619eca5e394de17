#include "framework/scene/joint_words.h"

#include <algorithm>

#include "framework/scene/error.h"

namespace pintle {

std::span<const JointWord> joint_words() {
  static const JointNumber angle{JointNumber::angle, "angle", &SceneJoint::angle},
      length{JointNumber::length, "length", &SceneJoint::length, "length: 120 mm", true},
      ratio{JointNumber::ratio, "ratio", &SceneJoint::ratio};
  static const std::vector<JointWord> words{
      {.kind = JointKind::revolute, .word = "revolute", .pins = true, .clearance = true, .friction = true},
      {.kind = JointKind::prismatic,
       .word = "prismatic",
       .guides = true,
       .clamps = true,
       .clearance = true,
       .friction = true,
       .numbers = {angle}},
      {.kind = JointKind::slot, .word = "slot", .guides = true, .clearance = true, .friction = true},
      {.kind = JointKind::weld, .word = "weld", .pins = true, .clamps = true, .numbers = {angle}},
      {.kind = JointKind::distance, .word = "distance", .clearance = true, .numbers = {length}},
      {.kind = JointKind::differential, .word = "differential", .third = true, .turns = true, .numbers = {ratio}, .efforts = {".force"}},
      {.kind = JointKind::gear,
       .word = "gear",
       .turns = true,
       .clearance = true,
       .couples = {"radii", "teeth", "inside"},
       .efforts = {".force"}},
      {.kind = JointKind::rack, .word = "rack", .turns = true, .clearance = true, .couples = {"radius", "teeth"}, .efforts = {".force"}},
      {.kind = JointKind::rolling,
       .word = "rolling",
       .turns = true,
       .couples = {"radius", "radii", "inside"},
       .efforts = {".normal", ".force"}},
      {.kind = JointKind::belt, .word = "belt", .turns = true, .couples = {"radii", "crossed"}, .efforts = {".force"}},
      {.kind = JointKind::screw, .word = "screw", .third = true, .turns = true, .couples = {"lead"}, .efforts = {".force"}},
      {.kind = JointKind::cam, .word = "cam", .third = true, .turns = true, .couples = {"lift", "swing"}, .efforts = {".force"}},
  };
  return words;
}

const JointWord& word_of(const SceneJoint& joint) { return *std::ranges::find(joint_words(), joint.kind, &JointWord::kind); }

std::vector<const char*> efforts_of(const SceneJoint& joint) {
  const bool shafts = joint.kind == JointKind::differential && (!joint.coupling || joint.coupling->terms.front().kind == SceneTerm::angle);
  const bool swings = joint.kind == JointKind::cam && joint.coupling->swings;
  return shafts || swings ? std::vector<const char*>{} : word_of(joint).efforts;
}

namespace {

// For measured quantities the point matters, not only its body. Several points on the ground may be used.
std::vector<const PointRef*> points_of(const std::vector<SceneTerm>& terms) {
  std::vector<const PointRef*> out;
  for (const bool turning : {false, true})
    for (const SceneTerm& t : terms)
      for (const PointRef* p : {&t.a, &t.b}) {
        const auto alike = [&](const PointRef* q) { return q->body == p->body && (q->body != "ground" || q->point == p->point); };
        if (turning == (t.kind == SceneTerm::angle) && std::ranges::none_of(out, alike)) out.push_back(p);
      }
  return out;
}

}  // namespace

std::vector<const PointRef*> points_of(const SceneJoint& joint) {
  if (joint.coupling && !joint.coupling->terms.empty()) return points_of(joint.coupling->terms);
  if (joint.c) return {&joint.a, &joint.b, &*joint.c};
  return {&joint.a, &joint.b};
}

bool presses_elastically(const SceneJoint& j) { return j.clearance && !is_open(j) && j.clearance->model == ClearanceModel::contact; }

PointRef carrier_of(const Scene& scene, const PointRef& ref) {
  const auto body = std::ranges::find(scene.bodies, ref.body, &SceneBody::name);
  if (body == scene.bodies.end()) return {ref.body, "", ref.place};
  const auto profile = std::ranges::find(body->profiles, ref.point, &SceneProfile::name);
  if (profile == body->profiles.end()) return {ref.body, "", ref.place};  // reported where its surface is built
  if (profile->on.empty() && body->elastic && body->elastic->modes)
    throw SceneError(scene.file, profile->place,
                     "\"" + body->name + "\" is flexible, and it is not given which of its points carries \"" + profile->name +
                         "\"; add `on` with a point that has a direction: of a beam, or the centre of a hole");
  return {ref.body, profile->on, profile->place};
}

}  // namespace pintle
