#include "meshes/link_lattice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "meshes/lattice.h"
#include "meshes/sizes.h"

namespace pintle {

namespace {

using Eigen::Vector2d;
using std::numbers::pi;

constexpr double rounding = 1e-9;   // relative to a length of the link
constexpr double narrowest = 0.25;  // relative to the requested size

[[noreturn]] void reject_point(const Vector2d& p, const char* where) {
  std::ostringstream text;
  text << "link: the point (" << p.x() << ", " << p.y() << ") m lies " << where
       << ", where no node can be; put it on the material, or name the hole and couple the point "
          "to its rim";
  throw std::invalid_argument(text.str());
}

double least_gap(const std::vector<double>& values) {
  double gap = values.back() - values.front();
  for (std::size_t i = 1; i < values.size(); ++i) gap = std::min(gap, values[i] - values[i - 1]);
  return gap;
}

// Sets the nodes nearest to the points exactly; the lattice's map gives them only to rounding.
Mesh with_exact_points(Mesh mesh, const MeshOptions& o, double span) {
  for (const Vector2d& p : o.points)
    if (const int node = nearest_node(mesh, p, 1e-6 * span); node >= 0) mesh.x.col(node) = p;
  return mesh;
}

// u along the bar, v across it from −1 to 1.
std::optional<Mesh> bar(double length, double left, double right, const MeshOptions& o) {
  if (std::max(left, right) > 3 * std::min(left, right)) return std::nullopt;  // cells would be long and thin
  const auto half_width = [=](double x) { return (left + (right - left) * x / length) / 2; };
  const double size = o.size > 0 ? o.size : std::sqrt(length * (left + right) / 2) / 10;
  validate_count(length * (left + right) / 2 / (size * size), size);
  std::vector<double> through_u, through_v{0};
  for (const Vector2d& p : o.points) {
    if (p.x() < -rounding * length || p.x() > length * (1 + rounding) || std::abs(p.y()) > half_width(p.x()) + rounding * length)
      reject_point(p, "outside the outline");
    through_u.push_back(std::clamp(p.x(), 0.0, length));
    through_v.push_back(std::clamp(p.y() / half_width(p.x()), -1.0, 1.0));
  }
  const double width = std::max(left, right);
  Lattice l{breaks(0, length, through_u, size), breaks(-1, 1, through_v, 2 * size / width), {}, false, {"bottom", "right", "top", "left"}};
  const double step_u = std::min(size, length), step_v = std::min(2 * size / width, 1.0);
  if (least_gap(l.u) < narrowest * step_u || least_gap(l.v) < narrowest * step_v) return std::nullopt;
  l.at = [=](double u, double v) { return Vector2d(u, v * half_width(u)); };
  return with_exact_points(lattice_mesh(l, o.shape), o, length);
}

// Radii from the bore outwards: the rings are as thick as their cells are long, at most `size`, and scaled so that the last one ends at the
// rim, or at a required radius.
std::vector<double> rings(double inner, double outer, std::vector<double> through, double angle, double size) {
  through.insert(through.end(), {inner, outer});
  std::sort(through.begin(), through.end());
  std::vector<double> out{inner};
  for (const double next : through) {
    const double from = out.back();
    if (next - from <= rounding * outer) continue;
    std::vector<double> r{from};
    while (r.back() < next) r.push_back(r.back() + std::min(size, angle * r.back()));
    if (r.size() > 2 && r.back() - next > next - r[r.size() - 2]) r.pop_back();
    for (std::size_t i = 1; i < r.size(); ++i) out.push_back(from + (r[i] - from) * (next - from) / (r.back() - from));
    out.back() = next;
  }
  out.back() = outer;
  return out;
}

// u is the angle, clockwise, so that with v as the radius the cells are counter-clockwise.
std::optional<Mesh> disc(double inner, double outer, const MeshOptions& o) {
  const double size = o.size > 0 ? o.size : std::sqrt(pi * (outer * outer - inner * inner)) / 10;
  const double hole = o.hole_size > 0 ? o.hole_size : std::min(size, 2 * pi * inner / sides_round_hole);
  validate_count(2 * pi * inner / hole * (outer - inner) / size, std::min(hole, size));
  const double step = std::min({hole / inner, size / outer, 2 * pi / sides_round_arc});
  std::vector<double> through_u, through_v;
  double start = 0;
  for (const Vector2d& p : o.points) {
    const double r = p.norm();
    if (r > outer * (1 + rounding)) reject_point(p, "outside the outline");
    if (r < inner * (1 - rounding)) reject_point(p, "in the hole");
    const double u = -std::atan2(p.y(), p.x());
    if (through_u.empty()) start = u;
    double turned = std::fmod(u - start + 4 * pi, 2 * pi);
    if (turned > 2 * pi - rounding) turned = 0;
    through_u.push_back(start + turned);
    through_v.push_back(std::clamp(r, inner, outer));
  }
  Lattice l{
      breaks(start, start + 2 * pi, through_u, step), rings(inner, outer, through_v, step, size), {}, true, {"bore", "", "outline", ""}};
  if (least_gap(l.u) < narrowest * step || least_gap(l.v) < narrowest * std::min({step * inner, size, outer - inner})) return std::nullopt;
  l.at = [](double u, double v) { return Vector2d(v * std::cos(u), -v * std::sin(u)); };
  return with_exact_points(lattice_mesh(l, o.shape), o, outer);
}

}  // namespace

std::optional<Mesh> lattice_link(const Link& link, const MeshOptions& o) {
  if (corners_of(o.shape) != 4) return std::nullopt;
  if (const auto* l = std::get_if<StraightBar>(&link)) return bar(l->length, l->width, l->width, o);
  if (const auto* l = std::get_if<TaperedBar>(&link)) return bar(l->length, l->width_left, l->width_right, o);
  if (const auto* l = std::get_if<Disc>(&link)) return disc(l->bore / 2, l->diameter / 2, o);
  return std::nullopt;
}

}  // namespace pintle
