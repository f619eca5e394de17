#include "framework/build/contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <Eigen/Geometry>

#include "contact/cylinder_law.h"
#include "framework/build/clearance.h"
#include "framework/common/index.h"
#include "framework/common/text.h"
#include "framework/scene/error.h"
#include "framework/scene/joint_words.h"

namespace pintle {

namespace {

using Eigen::Vector2d;

const std::vector<SceneProfile>& profiles_of(const Scene& scene, const PointRef& ref) {
  if (ref.body == "ground") return scene.ground_profiles;
  const auto body = std::ranges::find(scene.bodies, ref.body, &SceneBody::name);
  if (body == scene.bodies.end())
    throw SceneError(scene.file, ref.place, "there is no body " + quoted(ref.body) + "; name one of the scene, or the ground");
  return body->profiles;
}

/// The common curvature of all its lines and arcs [1/m]; nothing if they differ.
std::optional<double> curvature(const Profile& profile) {
  std::optional<double> out;
  for (const Piece& p : profile.pieces) {
    if (is_corner(p)) continue;
    if (p.curve) return std::nullopt;
    const double now = p.straight ? 0 : 1 / p.radius;
    if (out && *out != now) return std::nullopt;
    out = now;
  }
  return out;
}

double stiffness_of(const Scene& scene, const SceneContact& c, const Profile& profile_a, const Profile& profile_b) {
  const SceneNormal& n = c.normal;
  if (n.stiffness) return *n.stiffness;
  const std::optional<double> a = curvature(profile_a), b = curvature(profile_b);
  if (!a || !b || !(*a + *b > 0))
    throw SceneError(scene.file, n.place,
                     "`young` and `poisson` give a stiffness only if each profile has a constant radius and the two are not concentric; "
                     "give `stiffness` for " +
                         quoted(c.name));
  return hertz_stiffness(1 / (*a + *b), n.bearing.young, n.bearing.poisson, n.journal.young, n.journal.poisson);
}

/// Radii of the two profiles, with the signs used for cylinders.
std::array<double, 2> radii_of(const Scene& scene, const SceneContact& c, const Profile& profile_a, const Profile& profile_b) {
  const std::optional<double> a = curvature(profile_a), b = curvature(profile_b);
  const bool flat_too = find_cylinder_law(c.normal.law)->of_a_layer;
  if (!a || !b || !(*a + *b > 0) || (!flat_too && (*a == 0 || *b == 0)))
    throw SceneError(scene.file, c.normal.place,
                     c.normal.law + " is a law for two cylinders: each profile must be an arc of constant radius" +
                         (flat_too ? ", or one of them straight," : ",") + " and the two must not be concentric; give a `table` for " +
                         quoted(c.name));
  const auto radius = [](double curved) { return curved == 0 ? std::numeric_limits<double>::infinity() : 1 / curved; };
  return {radius(*a), radius(*b)};
}

/// A straight part of a curve counts as a line against a line or another straight part.
bool turns_too_little(const Piece& curve, const Piece& other) {
  constexpr double straight = 1e-6;  // [rad]
  return curve.curve && curve.curve->turn() < straight && (other.straight || other.curve);
}

/// Whether they can touch at inner points of both. Of two lines that lie on each other, or a line in a hollow, the corners touch.
bool may_touch(const Piece& a, const Piece& b) {
  if ((a.straight || is_corner(a)) && (b.straight || is_corner(b))) return a.straight != b.straight;
  const bool hollow_a = is_hollow(a), hollow_b = is_hollow(b);
  if (!hollow_a && !hollow_b) return !turns_too_little(a, b) && !turns_too_little(b, a);
  if (hollow_a && hollow_b) return false;
  if (a.curve || b.curve) return !a.straight && !b.straight;
  return !a.straight && !b.straight && a.radius + b.radius < 0;
}

// The pairs of pieces that may touch, each with the properties of `like` and the indices of the pairs beyond their ends.
std::vector<ContactPair> pairs_between(const Scene& scene, const SceneContact& c, const Profile& a, const Profile& b,
                                       const ContactPair& like) {
  const int n_a = static_cast<int>(a.pieces.size()), n_b = static_cast<int>(b.pieces.size());
  std::vector<ContactPair> out;
  std::vector<int> pair_of(at(n_a * n_b), -1);
  for (int i = 0; i < n_a; ++i)
    for (int j = 0; j < n_b; ++j) {
      if (!may_touch(a.pieces[at(i)], b.pieces[at(j)])) continue;
      pair_of[at(i * n_b + j)] = static_cast<int>(out.size());
      ContactPair& pair = out.emplace_back(like);
      pair.gap = {a.pieces[at(i)], b.pieces[at(j)]};
      pair.pair = static_cast<int>(out.size()) - 1;
      const auto until = [&](const Piece& piece, double half_material, const Piece& other) {  // round pieces are limited by their normals
        const bool of_a_ring = like.journal && std::isfinite(piece.half);                     // the middle of its outer arc is in the air
        if (piece.straight || piece.radius < 0 || piece.curve || of_a_ring)
          pair.deepest = std::min(pair.deepest, half_material + std::max(other.radius, 0.0));
      };
      until(pair.gap.a, a.deepest[at(i)], pair.gap.b);
      until(pair.gap.b, b.deepest[at(j)], pair.gap.a);
    }
  if (out.empty())
    throw SceneError(scene.file, c.place,
                     quoted(c.a.body + "." + c.a.point) + " and " + quoted(c.b.body + "." + c.b.point) +
                         " cannot touch: both are hollow, or one is too large for the other; change `material` or a radius");

  // Beyond the end of a piece follows another pair. Where there is none, as where pieces lie along each other, the piece is extended a
  // little.
  constexpr double while_turning = std::numbers::pi / 4, while_sliding = 0.5;
  for (int i = 0; i < n_a; ++i)
    for (int j = 0; j < n_b; ++j) {
      const int pair = pair_of[at(i * n_b + j)];
      if (pair < 0) continue;
      ContactPair& now = out[at(pair)];
      now.pairs = static_cast<int>(out.size());
      for (std::size_t side = 0; side < 4; ++side) {
        const bool of_a = side < 2, forwards = side % 2;
        const Profile& profile = of_a ? a : b;
        const int n = of_a ? n_a : n_b, here = of_a ? i : j, next = (here + (forwards ? 1 : n - 1)) % n;
        const bool at_an_end = !profile.closed && (forwards ? here == n - 1 : here == 0);
        if (at_an_end || n == 1) continue;
        const bool joined = profile.goes_on[at(forwards ? here : next)];
        if (joined) now.beyond[side] = pair_of[at(of_a ? next * n_b + j : i * n_b + next)];
        const Piece &piece = profile.pieces[at(here)], &other = of_a ? b.pieces[at(j)] : a.pieces[at(i)];
        const bool off_a_corner = joined && is_corner(profile.pieces[at(next)]) && is_corner(other);
        const bool into_the_air = is_hollow(piece) || piece.curve;  // extended, a hollow arc or a curve would leave the surface
        if (now.beyond[side] < 0 && !off_a_corner && !into_the_air)
          now.extent[side] += piece.straight ? while_sliding : while_turning / piece.half;
      }
    }
  return out;
}

// Whether it has corners without an arc, apart from the ends of an open path.
bool has_sharp_corners(const Profile& profile) {
  const auto ends = profile.closed ? 0 : 2;
  return std::ranges::count_if(profile.pieces, is_corner) > ends;
}

// The radius of the narrowest hollow of a curve, if no part of the other profile fits in; otherwise 0 [m].
double too_hollow(const Profile& a, const Profile& b) {
  double out = 0;
  for (const auto& [hollow, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    double least = std::numeric_limits<double>::infinity(), fits = 0;
    for (const Piece& p : hollow->pieces)
      if (p.curve && is_hollow(p)) least = std::min(least, least_radius(p));
    for (const Piece& p : other->pieces)
      if (!is_hollow(p)) fits = std::max(fits, least_radius(p));
    if (fits > least) out = least;
  }
  return out;
}

}  // namespace

ContactPair laws_of(const Scene& scene, const SceneContact& c, const Profile& a, const Profile& b) {
  ContactPair pair{};
  pair.profiles = true;
  pair.slowest_impact = c.normal.slowest_impact;
  pair.follows = c.normal.follows;
  if (c.impact)
    pair.rigid = rigid_impact(scene, *c.impact, c.place);
  else if (c.normal.law == "spring-damper")
    pair.normal = ImpactLaw{.k = *c.normal.stiffness, .n = 1, .chi = 0, .d = c.normal.damping};
  else if (is_of_cylinders(c.normal))
    pair.normal = normal_law(scene, c.normal, 0, radii_of(scene, c, a, b)),
    pair.pressure = pressure_of(scene, c.normal, radii_of(scene, c, a, b));
  else
    pair.normal = normal_law(scene, c.normal, c.normal.law == "table" ? 0 : stiffness_of(scene, c, a, b), {});
  if (c.friction && rubs(*c.friction)) pair.friction = friction_law(scene, *c.friction);
  if (c.impact && c.friction) check_rigid_friction(scene, *c.friction);
  return pair;
}

std::string laws_text(const ContactPair& pair) {
  std::ostringstream s;
  if (is_rigid(pair))
    s << impact_text(*pair.rigid);
  else
    s << "stiffness " << stiffness_text(pair.normal);
  if (!is_rigid(pair) && begins_with_jump(pair.normal))
    s << ", damping " << viscous_damping(pair.normal) << " N s/m";
  else if (!is_rigid(pair))
    s << ", restitution delivered " << restitution_of(pair.normal, 1);
  s << friction_text(pair);
  return s.str();
}

Profile profile_of(const Scene& scene, const Markers& markers, const PointRef& ref) {
  const std::vector<SceneProfile>& profiles = profiles_of(scene, ref);
  const auto found = std::ranges::find(profiles, ref.point, &SceneProfile::name);
  if (found == profiles.end())
    throw SceneError(scene.file, ref.place, quoted(ref.body) + " has no profile " + quoted(ref.point) + "; give it one, or name another");
  const SceneProfile& p = *found;
  const auto wrong = [&](const std::string& message) {
    throw SceneError(scene.file, p.place, "the profile " + quoted(p.name) + ": " + message);
  };
  const Vector2d origin = markers.place(carrier_of(scene, ref));
  const auto place = [&](const ScenePathPoint& at) -> Vector2d {
    return (at.point.empty() ? Vector2d(at.at[0], at.at[1]) : markers.place({ref.body, at.point, at.place})) - origin;
  };
  if (p.kind == SceneProfile::disc || p.kind == SceneProfile::hole) {
    if (!(p.radius > 0)) wrong("radius must be above 0");
    return circle(place(p.centre), p.kind == SceneProfile::disc ? p.radius : -p.radius);
  }
  std::vector<PathPoint> path;
  const bool polar = p.kind == SceneProfile::polar;
  for (const ScenePathPoint& point : p.points)
    path.push_back({polar ? Vector2d(place(p.centre) + point.at[1] * Vector2d(std::cos(point.at[0]), std::sin(point.at[0]))) : place(point),
                    point.arc});
  const auto turned_round = [&](double inside) {
    const bool clockwise = p.closed && inside < 0;
    return p.closed ? clockwise != (p.material == SceneProfile::outside) : p.material == SceneProfile::right;
  };
  try {
    if (p.kind != SceneProfile::path) {
      std::vector<Vector2d> points;
      for (const PathPoint& point : path) points.push_back(point.at);
      if (turned_round(area(points))) std::ranges::reverse(points);
      return profile_through(points, p.closed);
    }
    const bool turn = turned_round(p.closed ? area(path) : 0);
    return profile_along(turn ? reversed(path, p.closed) : path, p.closed, p.round);
  } catch (const std::invalid_argument& error) {
    wrong(error.what());
  }
  return {};
}

namespace {

bool is_never_released(const Scene& scene, const SceneJoint& joint) {
  const auto releases = [&](const SceneDoing& doing) { return std::ranges::find(doing.release, joint.name) != doing.release.end(); };
  return joint.engaged &&
         std::ranges::none_of(scene.events, [&](const SceneEvent& e) { return releases(e.then) || releases(e.otherwise); });
}

bool deforms(const Scene& scene, const std::string& name) {
  const auto body = std::ranges::find(scene.bodies, name, &SceneBody::name);
  return body != scene.bodies.end() && body->elastic;
}

}  // namespace

BuiltContact build_contact(const Scene& scene, const SceneContact& c, const Profile& a, const Profile& b, const std::array<int, 2>& markers,
                           int first) {
  for (const SceneJoint& j : scene.joints)
    if (word_of(j).pins && word_of(j).clamps && is_never_released(scene, j) && !deforms(scene, c.a.body) && !deforms(scene, c.b.body) &&
        std::minmax(j.a.body, j.b.body) == std::minmax(c.a.body, c.b.body))
      throw SceneError(scene.file, c.place,
                       "the weld " + quoted(j.name) + " joins these two bodies rigidly, so they need no contact; leave the contact out");
  ContactPair like = laws_of(scene, c, a, b);
  like.a = markers[0], like.b = markers[1];
  BuiltContact out = build_pairs(scene, c, a, b, like, first);
  if (const double hollow = too_hollow(a, b); hollow > 0) {
    std::ostringstream s;
    s << quoted(c.name) << ": a profile has a hollow of radius " << hollow
      << " m, too narrow for the other profile to reach its bottom: that profile would touch both sides, and only one of these contacts is "
         "found; give it a smaller radius";
    out.warnings.push_back(s.str());
  }
  if (!c.impact && has_sharp_corners(a) && has_sharp_corners(b))
    out.warnings.push_back(quoted(c.name) +
                           ": both profiles have sharp corners; if two corners meet, there is no contact force and energy is created; give "
                           "one of the profiles `round`");
  return out;
}

BuiltContact build_pairs(const Scene& scene, const SceneContact& c, const Profile& a, const Profile& b, const ContactPair& like,
                         int first) {
  BuiltContact out;
  out.pairs = pairs_between(scene, c, a, b, like);
  for (ContactPair& pair : out.pairs)
    for (int& other : pair.beyond)
      if (other >= 0) other += first;
  const std::size_t n = out.pairs.size();
  out.words = laws_text(like) + "; " + std::to_string(n) + (n == 1 ? " pair" : " pairs") + " of pieces";
  return out;
}

namespace {

// How far from the origin a surface of the ground is, along its normal if it is straight: coordinates there are rounded to 1e-16 of this.
double distance_from_origin(const System& system, const ContactPair& pair) {
  double out = 0;
  for (const auto& [marker, piece] : {std::pair(pair.a, &pair.gap.a), std::pair(pair.b, &pair.gap.b)}) {
    const Marker& m = system.markers[at(marker)];
    if (m.body != ground) continue;
    const Vector2d middle = m.x_BP + Eigen::Rotation2Dd(m.angle) * piece->centre;
    const double normal = m.angle + piece->normal;
    out = std::max(out,
                   piece->straight ? std::abs(middle.dot(Vector2d(std::cos(normal), std::sin(normal)))) : middle.lpNorm<Eigen::Infinity>());
  }
  return out;
}

}  // namespace

void allow_rounding(System& system) {
  constexpr double flush = 1e-9, rounding = 8 * std::numeric_limits<double>::epsilon();  // of some sums and differences
  for (ContactPair& pair : system.contacts) {
    if (!is_rigid(pair)) continue;
    pair.slack = std::max(touching_part * system.length, rounding * distance_from_origin(system, pair));
    const std::array<const Piece*, 2> pieces{&pair.gap.a, &pair.gap.b};
    for (std::size_t side = 0; pair.profiles && side < 4; ++side)
      if (const Piece& piece = *pieces[side / 2]; piece.straight && std::isfinite(piece.half) && pair.beyond[side] < 0)
        pair.extent[side] += flush * system.length / piece.half;
  }
}

}  // namespace pintle
