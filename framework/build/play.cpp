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

/// A sector of a ring: its wall from R to R + w, radial faces at its ends, edges of radius r. The surface runs with the ring to its left:
/// clockwise along the inner wall, outwards along the first end, back along the outer wall, inwards along the other end.
Profile ring(double R, const SceneArc& arc) {
  const double w = arc.wall, r = arc.edge, quarter = std::numbers::pi / 4, pi = std::numbers::pi;
  const double inside = std::asin(r / (R + r)), outside = std::asin(r / (R + w - r));  // angles by which the edges shorten the arcs
  const double from = (R + r) * std::cos(inside), to = (R + w - r) * std::cos(outside);
  const auto at = [](double radius, double angle) { return Vector2d(radius * std::cos(angle), radius * std::sin(angle)); };
  Profile out;
  out.closed = true;
  const auto end = [&](double side) {  // −1: the first, 1: the other; its pieces from inside to outside
    const double angle = arc.middle + side * arc.extent / 2;
    std::vector<Piece> all{{.radius = r,
                            .centre = at(R + r, angle - side * inside),
                            .normal = angle + side * (3 * quarter - inside / 2),
                            .half = quarter - inside / 2}};
    if (to - from > 1e-9 * w)
      all.push_back({.centre = at((from + to) / 2, angle), .normal = angle + side * pi / 2, .half = (to - from) / 2, .straight = true});
    all.push_back({.radius = r,
                   .centre = at(R + w - r, angle - side * outside),
                   .normal = angle + side * (quarter - outside / 2),
                   .half = quarter + outside / 2});
    return all;
  };
  add(out, {.radius = -R, .normal = arc.middle + pi, .half = arc.extent / 2 - inside});
  for (const Piece& piece : end(-1)) add(out, piece);
  add(out, {.radius = R + w, .normal = arc.middle, .half = arc.extent / 2 - outside});
  std::vector<Piece> last = end(1);
  for (auto piece = last.rbegin(); piece != last.rend(); ++piece) add(out, *piece);
  out.goes_on.assign(out.pieces.size(), true);
  measure_material(out);
  return out;
}

/// The circles between which the end of a rod moves.
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
  if (j.kind != JointKind::distance) wrong("only revolute, prismatic, slot, distance, gear and rack joints can have a clearance");
  if (!(play.gap < j.length)) wrong("gap must be less than the length");
  Profile end;
  add(end, {});
  return {reach(play, j.length), end};
}

std::array<Profile, 2> open_bearing(const Scene& scene, const SceneJoint& j) {
  const SceneClearance& c = *j.clearance;
  const SceneArc& arc = *c.arc;
  const auto wrong = [&](const std::string& message) { throw SceneError(scene.file, c.place, message); };
  const Profile journal = circle({0, 0}, c.journal_radius());
  if (!(arc.extent > 0 && arc.extent < SceneArc::turn + SceneArc::rounding)) wrong("the extent of the arc must lie between 0 and 360 deg");
  if (c.model == ClearanceModel::massless_link) wrong("a massless link needs a wall all round, and an arc is open");
  if (c.model == ClearanceModel::spring_damper && !(c.stiffness && c.damping))
    wrong("the spring-damper of an open bearing needs both stiffness and damping");
  if (arc.whole()) return {journal, circle({0, 0}, -c.bearing_radius)};
  if (!(arc.wall > 0)) wrong("the arc needs a wall above 0");
  if (!(arc.edge >= 0 && arc.edge <= arc.wall / 2)) wrong("the edge of the arc must lie between 0 and half of its wall");
  if (!(2 * std::asin(arc.edge / (c.bearing_radius + arc.edge)) < arc.extent))
    wrong("the edges cover the whole arc; make them smaller or the extent larger");
  return {journal, ring(c.bearing_radius, arc)};
}

SceneContact contact_with_play(const SceneJoint& j) {
  return {j.name, j.a, j.b, j.play->normal, j.play->friction, j.play->place, j.play->impact};
}

}  // namespace pintle
