#include "framework/build/joints.h"

#include <cmath>
#include <numbers>
#include <variant>

#include "framework/build/clearance.h"
#include "framework/build/couplings.h"
#include "framework/scene/error.h"
#include "framework/scene/joint_words.h"

namespace pintle {

namespace {

/// A point's direction for the rough pose and start of its body.
double drawn_angle(const Scene& scene, const PointRef& ref, const Markers& markers) {
  const int b = markers.body(ref);
  double angle = markers.marker_at(ref, Holds::direction).angle;
  if (b == ground) return angle;
  angle += scene.bodies[static_cast<std::size_t>(b)].angle;
  for (const StartBody& s : scene.start_bodies)
    if (s.body == ref.body && s.angle) angle += *s.angle - scene.bodies[static_cast<std::size_t>(b)].angle;
  return angle;
}

/// The joint's angle including the whole turns in the rough poses of its bodies.
double nearest_turn(const Scene& scene, const SceneJoint& j, const Markers& markers) {
  constexpr double turn = 2 * std::numbers::pi;
  const double drawn = drawn_angle(scene, j.b, markers) - drawn_angle(scene, j.a, markers);
  return j.angle + turn * std::round((drawn - j.angle) / turn);
}

}  // namespace

Joint joint_of(const Scene& scene, const SceneJoint& j, Markers& markers) {
  const JointWord& word = word_of(j);
  if (is_coupling(j)) return coupling_of(scene, j, markers);
  const int a = markers.marker(j.a, word.clamps || word.guides ? Holds::direction : Holds::point);
  const int b = markers.marker(j.b, word.clamps ? Holds::direction : Holds::point);
  switch (j.kind) {
    case JointKind::revolute: return Revolute{a, b};
    case JointKind::slot: return Slot{a, b};
    case JointKind::prismatic: return Prismatic{a, b, nearest_turn(scene, j, markers)};
    case JointKind::weld: return Weld{a, b, nearest_turn(scene, j, markers)};
    case JointKind::distance:
      if (!(j.length > 0) && !j.from_present)
        throw SceneError(scene.file, j.place, "length must be above 0; for two points that coincide use revolute");
      return Distance{a, b, j.length};
    default: throw SceneError(scene.file, j.place, std::string("a ") + word.word + " joint needs the dimensions of its coupling");
  }
}

JointFriction friction_of(const Scene& scene, const SceneJoint& j, int joint) {
  const SceneJointFriction& f = *j.friction;
  const FrictionLaw law = friction_law(scene, f.law);
  if (!word_of(j).friction || (!std::holds_alternative<Coulomb>(law) && bristle_states(law) == 0))
    throw SceneError(scene.file, j.place, "friction in a joint is coulomb, lugre or gonthier, and in a revolute, prismatic or slot joint");
  if ((j.kind == JointKind::revolute && !(f.radius > 0)) || !(f.preload >= 0))
    throw SceneError(scene.file, j.place, "friction needs the pin's radius, above 0");
  return {joint, law, f.radius, f.length, f.preload};
}

}  // namespace pintle
