#include "framework/build/backlash.h"

#include <cmath>
#include <numbers>

#include "framework/build/clearance.h"
#include "framework/build/play.h"
#include "framework/common/text.h"
#include "framework/scene/error.h"

namespace pintle {

namespace {

/// The rolling pair that replaces teeth without backlash, between markers 0 and 1.
Flank::Teeth teeth_of(const Joint& ideal) {
  if (const auto* rack = std::get_if<Rack>(&ideal)) return RollsOnLine{{0, 1, rack->radius, rack->phase}};
  const Gear& gear = std::get<Gear>(ideal);
  return RollsOnDisc{{0, 1, gear.radius_a, gear.radius_b, gear.phase}};
}

/// A flank near the pitch point: an involute has the curvature of a circle of this radius there, the flank of a rack is straight.
Profile round(double pitch_radius, double pressure_angle) {
  if (pitch_radius != 0) return circle({0, 0}, pitch_radius * std::sin(pressure_angle));
  return profile_along({{{-1, 0}}, {{1, 0}}}, false);
}

void require_round(const Scene& scene, const SceneJoint& j) {
  const SceneNormal& n = j.play->normal;
  const auto wrong = [&](const std::string& message) { throw SceneError(scene.file, n.place, message); };
  if (j.play->impact || n.stiffness || n.law == "table") return;
  if (!(j.play->pressure_angle > 0))
    wrong(n.law + " needs the curvature of the flanks: add `pressure angle: 20 deg` to the clearance, or give a `stiffness` or a table");
  if (j.coupling->teeth[0] > 0)
    wrong(n.law + " needs the curvature of the flanks: write `radii` instead of `teeth`, or give a `stiffness`");
}

}  // namespace

BuiltContact build_flanks(const Scene& scene, const SceneJoint& j, const Joint& ideal) {
  const ScenePlay& play = *j.play;
  const auto wrong = [&](const std::string& message) { throw SceneError(scene.file, play.place, message); };
  if (j.kind != JointKind::gear && j.kind != JointKind::rack) wrong("of the couplings, only a gear and a rack can have a clearance");
  if (!(play.backlash > 0)) wrong("backlash must be above 0; leave out `clearance` for an ideal joint");
  if (!(play.pressure_angle >= 0 && play.pressure_angle < std::numbers::pi / 4)) wrong("the pressure angle must lie between 0 and 45 deg");
  if (play.friction) wrong("the pitch circles of the teeth roll on each other without slip, so friction has no effect; leave it out");
  require_round(scene, j);
  const Flank flank{teeth_of(ideal), 1, play.backlash / 2 * std::cos(play.pressure_angle), play.pressure_angle};
  const std::array<double, 2> radius = pitch_radii(flank);
  ContactPair pair = laws_of(scene, contact_with_play(j), round(radius[0], flank.angle), round(radius[1], flank.angle));
  const JointEnds ends = ends_of(ideal);
  pair.a = ends.marker[0], pair.b = ends.marker[1];
  pair.pairs = 2;
  pair.flank = flank;
  BuiltContact out{{pair, pair}, laws_text(pair) + "; teeth with a backlash of " + number_text(1e3 * play.backlash) + " mm"};
  out.pairs[1].pair = 1;
  out.pairs[1].flank->side = -1;
  return out;
}

double pitch_of(const SceneJoint& j, const Flank& flank) {
  const Pair& teeth = j.coupling->teeth;
  const std::array<double, 2> radius = pitch_radii(flank);
  for (const std::size_t wheel : {0u, 1u})
    if (teeth[wheel] > 0) return 2 * std::numbers::pi * std::abs(radius[wheel]) / teeth[wheel];
  return 0;
}

void complete_flanks(const Scene& scene, const SceneJoint& j, const Joint& ideal, std::size_t first, System& system) {
  for (std::size_t k = first; k < first + 2; ++k) system.contacts[k].flank->teeth = teeth_of(ideal);
  const double pitch = pitch_of(j, *system.contacts[first].flank);
  if (pitch > 0 && !(j.play->backlash < pitch))
    throw SceneError(scene.file, j.play->place,
                     "backlash " + number_text(1e3 * j.play->backlash) + " mm is not less than the pitch of the teeth, " +
                         number_text(1e3 * pitch) + " mm along the pitch circle; make it smaller");
}

}  // namespace pintle
