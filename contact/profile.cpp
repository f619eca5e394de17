#include "contact/profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

#include "contact/plane.h"

namespace pintle {

namespace {

using Eigen::Vector2d;
using std::numbers::pi;

Vector2d towards(double angle) { return {std::cos(angle), std::sin(angle)}; }
double angle_of(const Vector2d& v) { return std::atan2(v.y(), v.x()); }

/// A straight line or an arc of a path, by its two ends and the directions at them.
struct Stretch {
  Vector2d from, to;
  double arc, leaves, arrives;
  std::size_t point;  ///< where it begins, from 1
};

[[noreturn]] void wrong(const std::string& what) { throw std::invalid_argument(what); }
std::string between(std::size_t point, std::size_t points) {
  return "between point " + std::to_string(point) + " and point " + std::to_string(point % points + 1);
}

std::vector<Stretch> stretches_of(const std::vector<PathPoint>& path, bool closed) {
  constexpr double no_length = 1e-12;  // relative to the whole
  const std::size_t n = path.size(), count = closed ? n : n - 1;
  double size = 0;
  for (const PathPoint& p : path) size = std::max(size, (p.at - path.front().at).norm());
  std::vector<Stretch> out;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2d &from = path[i].at, &to = path[(i + 1) % n].at;
    const double chord = (to - from).norm(), radius = path[i].arc;
    if (!(chord > no_length * size)) wrong("it has no length " + between(i + 1, n) + "; remove one of them");
    double half = 0;
    if (radius != 0) {
      if (chord > 2 * std::abs(radius))
        wrong("an arc of radius " + std::to_string(std::abs(radius)) + " m is too small for the " + std::to_string(chord) + " m " +
              between(i + 1, n) + "; make its radius at least half of that");
      half = std::copysign(std::asin(std::min(1.0, chord / (2 * std::abs(radius)))), radius);
    }
    const double along = angle_of(to - from);
    out.push_back({from, to, radius, along - half, along + half, i + 1});
  }
  return out;
}

// Left turn from one stretch to the next; distinguishes a reversal from going straight on.
double turn_between(const Stretch& a, const Stretch& b) { return std::remainder(b.leaves - a.arrives, 2 * pi); }

Piece piece_of(const Stretch& s) {
  const Vector2d middle = (s.from + s.to) / 2, along = (s.to - s.from).normalized();
  const double normal = angle_of(-perp(along)), half_chord = (s.to - s.from).norm() / 2;
  if (s.arc == 0) return {.centre = middle, .normal = normal, .half = half_chord, .straight = true};
  const double inward = std::copysign(std::sqrt(std::max(0.0, (std::abs(s.arc) - half_chord) * (std::abs(s.arc) + half_chord))), s.arc);
  return {.radius = s.arc,
          .centre = middle + inward * perp(along),
          .normal = normal,
          .half = std::abs(std::remainder(s.arrives - s.leaves, 2 * pi)) / 2};
}

Piece corner(const Vector2d& at, double normal, double half) { return {.radius = 0, .centre = at, .normal = normal, .half = half}; }

// Replaces a corner between two straight lines by an arc.
Stretch rounded(Stretch& before, Stretch& after, double turn, double radius, std::size_t points) {
  const double cut = radius * std::tan(std::abs(turn) / 2);
  for (const Stretch* s : {&before, &after})
    if (cut > (s->to - s->from).norm() * (1 + 1e-12))
      wrong("there is no room to round its corner at point " + std::to_string(after.point) + " by " + std::to_string(radius) + " m " +
            between(s->point, points) + "; make `round` smaller");
  Stretch arc{before.to - cut * towards(before.arrives),
              after.from + cut * towards(after.leaves),
              std::copysign(radius, turn),
              before.arrives,
              after.leaves,
              after.point};
  before.to = arc.from, after.from = arc.to;
  return arc;
}

// Every point that it passes through, and points between these.
std::vector<Vector2d> drawn(const CurveSpan& span) {
  std::vector<double> stops{span.begin()};
  for (const double s : span.knots())
    if (s > span.begin() && s < span.end()) stops.push_back(s);
  stops.push_back(span.end());
  const int parts = std::max(2, static_cast<int>(24 / stops.size()));
  std::vector<Vector2d> out{span.at(span.begin()).at};
  for (std::size_t i = 0; i + 1 < stops.size(); ++i)
    for (int part = 1; part <= parts; ++part) out.push_back(span.at(stops[i] + (stops[i + 1] - stops[i]) * part / parts).at);
  return out;
}

struct Segment {
  Vector2d from, to;
  double bulge;  ///< largest distance to the piece, relative to its length
};
std::vector<Segment> segments_of(const std::vector<Piece>& pieces) {
  std::vector<Segment> out;
  for (const Piece& p : pieces) {
    if (is_corner(p)) continue;
    const std::vector<Vector2d> points = drawn(p);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) out.push_back({points[i], points[i + 1], p.straight ? 1e-6 : 2e-2});
  }
  return out;
}

void require_simple(const std::vector<Piece>& pieces, bool closed) {
  const std::vector<Segment> all = segments_of(pieces);
  const auto side = [](const Segment& s, const Vector2d& p) { return cross(s.to - s.from, p - s.from); };
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 2; j < all.size(); ++j) {
      if (closed && i == 0 && j + 1 == all.size()) continue;  // they meet where the path closes
      const Segment &a = all[i], &b = all[j];
      if (side(a, b.from) * side(a, b.to) < 0 && side(b, a.from) * side(b, a.to) < 0) {
        const Vector2d at = b.from + (b.to - b.from) * side(a, b.from) / (side(a, b.from) - side(a, b.to));
        wrong("it crosses itself at (" + std::to_string(at.x()) + ", " + std::to_string(at.y()) +
              ") m; list its points in their order along the surface");
      }
    }
}

struct Raised {
  Vector2d at, out;
};
// @param part  position on the piece, −1 where it begins
Raised surface_at(const Piece& piece, double part) {
  if (piece.curve) {
    const CurvePoint p = piece.curve->at(piece.curve->begin() + (1 + part) * piece.half);
    return {p.at, p.normal()};
  }
  const double angle = piece.normal + (piece.straight ? 0 : (piece.radius < 0 ? -part : part) * piece.half);
  const Vector2d out = towards(angle);
  return {piece.straight ? Vector2d(piece.centre + part * piece.half * perp(out)) : Vector2d(piece.centre + piece.radius * out), out};
}

// Half the shortest distance through the material behind a piece.
double half_material(const Piece& piece, const std::vector<Segment>& all) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const double part : {-0.9, -0.5, 0.0, 0.5, 0.9}) {
    const auto [from, out] = surface_at(piece, part);
    for (const Segment& s : all) {
      const Vector2d along = s.to - s.from, d = s.from - from;
      const double det = cross(along, out);
      if (det == 0) continue;
      const double way = cross(d, along) / det, on = -cross(d, out) / det;  // from − way·out = s.from + on·along
      if (on >= -1e-9 && on <= 1 + 1e-9 && way > s.bulge * along.norm()) shortest = std::min(shortest, way);
    }
  }
  return shortest / 2;
}

}  // namespace

std::vector<Vector2d> drawn(const Piece& p) {
  if (p.curve) return drawn(*p.curve);
  if (p.straight) {
    const Vector2d along = perp(towards(p.normal));
    return {p.centre - p.half * along, p.centre + p.half * along};
  }
  constexpr double part = 2 * pi / 180;
  const double half = std::isinf(p.half) ? pi : p.half;
  const int n = std::max(2, static_cast<int>(std::ceil(2 * half / part)));
  std::vector<Vector2d> out;
  for (int i = 0; i <= n; ++i) {
    const double beside = half * (2.0 * i / n - 1);
    out.emplace_back(p.centre + p.radius * towards(p.normal + (p.radius < 0 ? -beside : beside)));
  }
  return out;
}

std::vector<Vector2d> drawn(const Profile& profile) {
  std::vector<Vector2d> out;
  for (const Piece& piece : profile.pieces) {
    if (is_corner(piece)) continue;
    const std::vector<Vector2d> points = drawn(piece);
    out.insert(out.end(), points.begin() + (out.empty() ? 0 : 1), points.end());
  }
  return out;
}

bool solid(const Profile& profile) {
  if (!profile.closed) return false;
  return area(drawn(profile)) > 0;
}

Profile circle(const Vector2d& centre, double radius) {
  return {{{.radius = radius, .centre = centre}}, {true}, {radius > 0 ? radius : std::numeric_limits<double>::infinity()}, true};
}

std::vector<PathPoint> reversed(std::vector<PathPoint> path, bool closed) {
  std::vector<PathPoint> out;
  const std::size_t n = path.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = closed ? (n - i) % n : n - 1 - i;
    out.push_back({path[at].at, -path[(at + n - 1) % n].arc});
  }
  if (!closed) out.back().arc = 0;
  return out;
}

double area(const std::vector<PathPoint>& path) {
  double out = 0;
  for (const Stretch& s : stretches_of(path, true)) {
    out += cross(s.from, s.to) / 2;
    if (s.arc == 0) continue;
    const double half = std::asin(std::min(1.0, (s.to - s.from).norm() / (2 * std::abs(s.arc))));
    out += std::copysign(s.arc * s.arc * (half - std::sin(half) * std::cos(half)), s.arc);
  }
  return out;
}

double area(const std::vector<Vector2d>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return twice / 2;
}

Profile profile_through(const std::vector<Vector2d>& points, bool closed) {
  const std::size_t n = points.size(), least = closed ? 3 : 4;
  if (n < least) wrong("it has " + std::to_string(n) + " points; a spline takes " + std::to_string(least) + " or more");
  std::vector<PathPoint> path;
  path.reserve(n);
  for (const Vector2d& p : points) path.push_back({p});
  stretches_of(path, closed);  // checks for two points at one place
  const auto curve = std::make_shared<const SmoothCurve>(points, closed);
  Profile out;
  out.closed = closed;
  const auto add = [&](const Piece& p, bool goes_on) { out.pieces.push_back(p), out.goes_on.push_back(goes_on); };
  const auto end = [&](double s, double turn) {
    const CurvePoint p = curve->at(s);
    add(corner(p.at, angle_of(p.along) + turn, pi / 4), s == 0);
  };
  if (!closed) end(0, -3 * pi / 4);
  for (const CurveSpan& span : spans_of(curve)) {
    if (span.least_radius() < 1e-6 * curve->length())
      wrong("it has a cusp near (" + std::to_string(span.at(span.begin()).at.x()) + ", " + std::to_string(span.at(span.begin()).at.y()) +
            ") m; list its points in their order along the surface, or add points there");
    const CurvePoint middle = span.at((span.begin() + span.end()) / 2);
    add({.normal = angle_of(middle.normal()), .half = (span.end() - span.begin()) / 2, .curve = std::make_shared<const CurveSpan>(span)},
        true);
  }
  if (!closed) end(curve->length(), -pi / 4);
  require_simple(out.pieces, closed);
  const std::vector<Segment> all = segments_of(out.pieces);
  for (const Piece& p : out.pieces) out.deepest.push_back(half_material(p, all));
  return out;
}

Profile profile_along(std::vector<PathPoint> path, bool closed, double round) {
  constexpr double smooth = 1e-9, kink = 1e-2;  // [rad]; a contact continues across a smaller concave kink
  if (path.size() < 2) wrong("it has fewer than two points; add points");
  const bool arcs = std::any_of(path.begin(), path.end(), [](const PathPoint& p) { return p.arc != 0; });
  if (closed && path.size() < 3 && !arcs) wrong("it is closed but has fewer than three points; add a point, or an arc");
  std::vector<Stretch> stretches = stretches_of(path, closed);
  const std::size_t n = stretches.size(), joins = closed ? n : n - 1;
  std::vector<double> turn(joins);
  std::vector<std::optional<Stretch>> arc(joins);
  for (std::size_t i = 0; i < joins; ++i) {
    Stretch &before = stretches[i], &after = stretches[(i + 1) % n];
    turn[i] = turn_between(before, after);
    if (std::abs(turn[i]) > pi - 1e-6)
      wrong("it turns back on itself at point " + std::to_string(after.point) + "; move or remove that point");
    if (round > 0 && before.arc == 0 && after.arc == 0 && std::abs(turn[i]) > smooth)
      arc[i] = rounded(before, after, turn[i], round, path.size());
  }

  Profile out;
  out.closed = closed;
  const auto add = [&](const Piece& p, bool goes_on) { out.pieces.push_back(p), out.goes_on.push_back(goes_on); };
  if (!closed) add(corner(path.front().at, stretches.front().leaves - 3 * pi / 4, pi / 4), true);
  for (std::size_t i = 0; i < n; ++i) {
    const Stretch& s = stretches[i];
    const bool last = i == joins;  // of an open path
    const bool reentrant = !last && !arc[i] && turn[i] < -kink;
    if ((s.to - s.from).norm() > 1e-9 * (path[0].at - path[1].at).norm()) add(piece_of(s), !reentrant);
    if (last)
      add(corner(s.to, s.arrives - pi / 4, pi / 4), false);
    else if (arc[i])
      add(piece_of(*arc[i]), true);
    else if (turn[i] > smooth)
      add(corner(s.to, s.arrives + turn[i] / 2 - pi / 2, turn[i] / 2), true);
  }
  require_simple(out.pieces, closed);
  measure_material(out);
  return out;
}

void measure_material(Profile& profile) {
  const std::vector<Segment> all = segments_of(profile.pieces);
  profile.deepest.clear();
  for (const Piece& p : profile.pieces) profile.deepest.push_back(half_material(p, all));
}

}  // namespace pintle
