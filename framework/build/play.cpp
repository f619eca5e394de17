#include "framework/build/play.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "framework/scene/error.h"

namespace pintle {

namespace {

using Eigen::Vector2d;

constexpr double infinite = std::numeric_limits<double>::infinity();

void add(Profile& profile, const Piece& piece, double deepest = infinite) {
  profile.pieces.push_back(piece);
  profile.goes_on.push_back(false);
  profile.deepest.push_back(deepest);
}

/// Two walls along x, as far apart as `width`.
Profile walls(double width) {
  Profile out;
  for (const double side : {-1.0, 1.0})
    add(out, {.centre = {0, side * width / 2}, .normal = -side * std::numbers::pi / 2, .straight = true});
  return out;
}

/// A slot along x with round ends.
Profile slot(double width, double travel) {
  const double r = width / 2, l = travel / 2;
  return profile_along({{{-l, r}}, {{l, r}, -r}, {{l + r, 0}, -r}, {{l, -r}}, {{-l, -r}, -r}, {{-l - r, 0}, -r}}, true);
}

/// A block, turned by an angle from x.
Profile block(double length, double height, double angle, double round) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto corner = [&](double x, double y) {
    return PathPoint{{(c * length * x - s * height * y) / 2, (s * length * x + c * height * y) / 2}};
  };
  return profile_along({corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)}, true, round);
}

/// Circles between which the end of a rod stays.
Profile reach(const ScenePlay& play, double length) {
  Profile out;
  if (play.only != ScenePlay::push) add(out, {.radius = -(length + play.gap)});
  if (play.only != ScenePlay::pull) add(out, {.radius = length - play.gap}, length - play.gap);
  return out;
}

}  // namespace

std::array<Profile, 2> profiles_of(const Scene& scene, const SceneJoint& j) {
  const ScenePlay& play = *j.play;
  const auto wrong = [&](const std::string& message) { throw SceneError(scene.file, play.place, message); };
  if (!(play.gap > 0) && j.kind != JointKind::distance) wrong("gap must be above 0; leave out `clearance` for an ideal joint");
  if (j.kind == JointKind::prismatic) {
    if (!(play.length > 0) || !(play.height > 0)) wrong("the block needs a length and a height above 0");
    try {
      return {walls(play.height + 2 * play.gap), block(play.length, play.height, -j.angle, play.round)};
    } catch (const std::invalid_argument& error) {
      wrong(error.what());
    }
  }
  if (j.kind == JointKind::slot) {
    if (!(play.pin_radius > 0)) wrong("pin radius must be above 0");
    const double width = 2 * (play.pin_radius + play.gap);
    return {play.travel ? slot(width, *play.travel) : walls(width), circle({0, 0}, play.pin_radius)};
  }
  if (j.kind != JointKind::distance) wrong("only revolute, prismatic, slot and distance joints take a clearance");
  if (!(play.gap < j.length)) wrong("gap must be less than the length");
  Profile end;
  add(end, {});
  return {reach(play, j.length), end};
}

SceneContact contact_with_play(const SceneJoint& j) {
  return {j.name, j.a, j.b, j.play->normal, j.play->friction, j.play->place, j.play->impact};
}

}  // namespace pintle
