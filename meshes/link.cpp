#include "meshes/link.h"

#include "meshes/reject.h"

#include <array>
#include <cmath>
#include <numbers>

namespace pintle {

namespace {

using Eigen::Vector2d;
using std::numbers::pi;

void positive(const char* link, const char* what, double value) {
  if (!(value > 0) || !std::isfinite(value)) reject(link, ": ", what, " = ", value, " m, must be positive");
}

void validate_eye(const char* link, const char* which, const Eye& eye) {
  const std::string name = std::string(which) + " ";
  positive(link, (name + "bore").c_str(), eye.bore);
  positive(link, (name + "outer").c_str(), eye.outer);
  if (!(eye.bore < eye.outer))
    reject(link, ": ", name, "bore = ", eye.bore, " m leaves no material inside outer = ", eye.outer, " m; the bore must be smaller");
}

void validate_apart(const char* link, const char* a, const char* b, double distance, double outer_a, double outer_b) {
  if (!(distance > (outer_a + outer_b) / 2))
    reject(link, ": ", a, " and ", b, " overlap: their centres are ", distance, " m apart, their outer radii together are ",
           (outer_a + outer_b) / 2, " m; move them apart or make them smaller");
}

/// The three eyes in counter-clockwise order.
std::array<int, 3> turn_order(const Triangle& t) {
  const Vector2d a = t.center[1] - t.center[0], b = t.center[2] - t.center[0];
  return a.x() * b.y() - a.y() * b.x() >= 0 ? std::array{0, 1, 2} : std::array{0, 2, 1};
}

// Outward normal of the tangent from circle i to circle j, with the material to its left: n·(c_j − c_i) = R_i − R_j.
Vector2d tangent_normal(const Triangle& t, int i, int j) {
  const Vector2d d = t.center[j] - t.center[i];
  const double cosine = (t.eye[i].outer - t.eye[j].outer) / 2 / d.norm();
  const Vector2d e = d.normalized(), right(e.y(), -e.x());
  return cosine * e + std::sqrt(1 - cosine * cosine) * right;
}

double angle_of(const Vector2d& v) { return std::atan2(v.y(), v.x()); }
Vector2d on_circle(const Vector2d& center, double radius, double angle) {
  return center + radius * Vector2d(std::cos(angle), std::sin(angle));
}
// Counter-clockwise angle from one direction to another, in [0, 2π).
double sweep(double from, double to) {
  const double s = std::fmod(to - from, 2 * pi);
  return s < 0 ? s + 2 * pi : s;
}

struct Validate {
  void operator()(const StraightBar& l) const {
    positive("straight bar", "length", l.length);
    positive("straight bar", "width", l.width);
  }
  void operator()(const TaperedBar& l) const {
    positive("tapered bar", "length", l.length);
    positive("tapered bar", "width_left", l.width_left);
    positive("tapered bar", "width_right", l.width_right);
  }
  void operator()(const Disc& l) const {
    positive("disc", "diameter", l.diameter);
    positive("disc", "bore", l.bore);
    if (!(l.bore < l.diameter))
      reject("disc: bore = ", l.bore, " m leaves no material inside diameter = ", l.diameter, " m; the bore must be smaller");
  }
  void operator()(const EyeBar& l) const {
    const char* link = "bar with two eyes";
    positive(link, "length", l.length);
    positive(link, "width", l.width);
    validate_eye(link, "first eye", l.first);
    validate_eye(link, "second eye", l.second);
    validate_apart(link, "the first eye", "the second", l.length, l.first.outer, l.second.outer);
    for (const Eye& eye : {l.first, l.second})
      if (l.width > eye.outer)
        reject(link, ": width = ", l.width, " m, must be at most the outer diameter of either eye, ", eye.outer,
               " m; for a plain plate with holes use a drawing");
  }
  void operator()(const Triangle& l) const {
    const char* link = "triangle with three eyes";
    constexpr std::array names{"eye 1", "eye 2", "eye 3"};
    for (std::size_t i = 0; i < 3; ++i) {
      if (!l.center[i].allFinite()) reject(link, ": the centre of ", names[i], " is not finite");
      validate_eye(link, names[i], l.eye[i]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      validate_apart(link, names[i], names[j], (l.center[i] - l.center[j]).norm(), l.eye[i].outer, l.eye[j].outer);
    }
    const auto order = turn_order(l);
    double turn = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const int before = order[(k + 2) % 3], at = order[k], after = order[(k + 1) % 3];
      const double arc = sweep(angle_of(tangent_normal(l, before, at)), angle_of(tangent_normal(l, at, after)));
      turn += arc;
      if (arc < 1e-3 || arc > 2 * pi - 1e-3 || turn > 2 * pi + 1e-6)
        reject(link, ": an eye does not reach the outline round the other two (centres (", l.center[0].x(), ", ", l.center[0].y(), "), (",
               l.center[1].x(), ", ", l.center[1].y(), "), (", l.center[2].x(), ", ", l.center[2].y(),
               ") m); move it outwards, make it larger, or use a drawing");
    }
  }
};

void add_arc(Loop& loop, const Vector2d& center, double radius, double from, double turn, const std::string& name) {
  const int n = static_cast<int>(std::ceil(std::abs(turn) / (pi / 2) - 1e-9));
  for (int k = 0; k < n; ++k) {
    loop.edges.push_back(
        {on_circle(center, radius, from + turn * k / n), on_circle(center, radius, from + turn * (k + 1) / n), true, center});
    loop.names.push_back(name);
  }
}

Loop circle(const Vector2d& center, double diameter, const std::string& name) {
  Loop loop;
  add_arc(loop, center, diameter / 2, 0, 2 * pi, name);
  return loop;
}

// Joins arcs by straight edges and closes the loop, with common ends identical to the bit.
void close(Loop& loop, const std::string& name) {
  Loop out;
  for (std::size_t k = 0; k < loop.edges.size(); ++k) {
    const Vector2d end = loop.edges[k].to, next = loop.edges[(k + 1) % loop.edges.size()].from;
    out.edges.push_back(loop.edges[k]);
    out.names.push_back(loop.names[k]);
    if ((next - end).norm() < 1e-12 * (next.norm() + end.norm()) || next == end) continue;
    out.edges.push_back({end, next});
    out.names.push_back(name);
  }
  for (std::size_t k = 0; k < out.edges.size(); ++k) out.edges[(k + 1) % out.edges.size()].from = out.edges[k].to;
  loop = std::move(out);
}

struct Draw {
  static std::vector<Loop> trapezium(double length, double left, double right) {
    const Vector2d c[] = {{0, -left / 2}, {length, -right / 2}, {length, right / 2}, {0, left / 2}};
    return {{{{c[0], c[1]}, {c[1], c[2]}, {c[2], c[3]}, {c[3], c[0]}}, {"bottom", "right", "top", "left"}}};
  }
  std::vector<Loop> operator()(const StraightBar& l) const { return trapezium(l.length, l.width, l.width); }
  std::vector<Loop> operator()(const TaperedBar& l) const { return trapezium(l.length, l.width_left, l.width_right); }
  std::vector<Loop> operator()(const Disc& l) const {
    std::vector<Loop> loops{circle(Vector2d::Zero(), l.diameter, "outline"), circle(Vector2d::Zero(), l.bore, "bore")};
    for (Loop& loop : loops) close(loop, loop.names[0]);
    return loops;
  }
  std::vector<Loop> operator()(const EyeBar& l) const {
    const Vector2d far(l.length, 0);
    const double a = std::asin(l.width / l.first.outer), b = std::asin(l.width / l.second.outer);
    Loop outline;
    add_arc(outline, Vector2d::Zero(), l.first.outer / 2, a, 2 * (pi - a), "outline");
    add_arc(outline, far, l.second.outer / 2, b - pi, 2 * (pi - b), "outline");
    std::vector<Loop> loops{outline, circle(Vector2d::Zero(), l.first.bore, "eye 1"), circle(far, l.second.bore, "eye 2")};
    for (Loop& loop : loops) close(loop, loop.names[0]);
    return loops;
  }
  std::vector<Loop> operator()(const Triangle& l) const {
    const auto order = turn_order(l);
    std::vector<Loop> loops(1);
    for (std::size_t k = 0; k < 3; ++k) {
      const int before = order[(k + 2) % 3], at = order[k], after = order[(k + 1) % 3];
      const double from = angle_of(tangent_normal(l, before, at));
      add_arc(loops[0], l.center[at], l.eye[at].outer / 2, from, sweep(from, angle_of(tangent_normal(l, at, after))), "outline");
    }
    for (int i = 0; i < 3; ++i) loops.push_back(circle(l.center[i], l.eye[i].bore, "eye " + std::to_string(i + 1)));
    for (Loop& loop : loops) close(loop, loop.names[0]);
    return loops;
  }
};

}  // namespace

void validate(const Link& link) { std::visit(Validate{}, link); }
std::vector<Loop> drawing(const Link& link) { return std::visit(Draw{}, link); }

}  // namespace pintle
