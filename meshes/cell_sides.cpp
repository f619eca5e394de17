#include "meshes/cell_sides.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pintle {

namespace {

using Eigen::Vector2d;

/// x(t) = x0 + x1 t + x2 t², through a at 0, the middle at ½ and b at 1.
struct Parabola {
  Vector2d x0, x1, x2;
  Vector2d at(double t) const { return x0 + t * (x1 + t * x2); }
};

Parabola parabola(const Mesh& mesh, const SideView& s) {
  const Vector2d a = mesh.x.col(s.a), b = mesh.x.col(s.b);
  if (s.middle < 0) return {a, b - a, Vector2d::Zero()};
  const Vector2d bow = mesh.x.col(s.middle) - (a + b) / 2;
  return {a, b - a + 4 * bow, -4 * bow};
}

// Whether the ray from p to the right meets the part of the curve from t = 0 to 1, on which y is monotonic.
bool ray_meets(const Parabola& c, double from, double to, double y_from, double y_to, const Vector2d& p) {
  if ((y_from <= p.y()) == (y_to <= p.y())) return false;
  double low = from, high = to;
  const bool rises = y_to > y_from;
  for (int k = 0; k < 60 && high - low > 1e-15; ++k) {
    const double t = (low + high) / 2;
    ((c.at(t).y() <= p.y()) == rises ? low : high) = t;
  }
  return c.at((low + high) / 2).x() > p.x();
}

bool side_crosses_ray(const Mesh& mesh, const SideView& s, const Vector2d& p) {
  const Vector2d a = mesh.x.col(s.a), b = mesh.x.col(s.b);
  if (s.middle < 0) {
    if ((a.y() <= p.y()) == (b.y() <= p.y())) return false;
    return a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > p.x();
  }
  const Parabola c = parabola(mesh, s);
  const double turn = c.x2.y() == 0 ? -1 : -c.x1.y() / (2 * c.x2.y());
  if (!(turn > 0 && turn < 1)) return ray_meets(c, 0, 1, a.y(), b.y(), p);
  const double top = c.at(turn).y();
  return ray_meets(c, 0, turn, a.y(), top, p) != ray_meets(c, turn, 1, top, b.y(), p);
}

}  // namespace

std::vector<CellView> cell_views(const Mesh& mesh) {
  std::vector<CellView> views;
  views.reserve(mesh.cell_count());
  for (const Cells& cells : mesh.cells)
    for (std::size_t c = 0; c < cells.size(); ++c)
      views.push_back({&cells.nodes[c * static_cast<std::size_t>(nodes_of(cells.shape))], cells.shape, cells.numbers[c]});
  return views;
}

SideView side_of(const CellView& view, int cell, int side) {
  const int corners = corners_of(view.shape);
  const bool curved = nodes_of(view.shape) > corners;
  return {view.nodes[side], view.nodes[(side + 1) % corners], curved ? view.nodes[corners + side] : -1, cell};
}

std::vector<SideView> paired_sides(const std::vector<CellView>& views) {
  std::vector<SideView> sides;
  for (std::size_t c = 0; c < views.size(); ++c)
    for (int s = 0; corners_of(views[c].shape) > 2 && s < corners_of(views[c].shape); ++s)
      sides.push_back(side_of(views[c], static_cast<int>(c), s));
  const auto key = [](const SideView& s) { return std::pair(std::minmax(s.a, s.b)); };
  std::sort(sides.begin(), sides.end(), [&](const SideView& p, const SideView& q) {
    const std::pair<int, int> i = key(p), j = key(q);
    return i != j ? i < j : p.cell < q.cell;
  });
  return sides;
}

Vector2d on_side(const Mesh& mesh, const SideView& s, double t) { return parabola(mesh, s).at(t); }

double distance(const Mesh& mesh, const SideView& s, const Vector2d& p, double& t) {
  const Parabola c = parabola(mesh, s);
  const auto gap = [&](double at) { return (c.at(at) - p).norm(); };
  if (s.middle < 0) {
    t = std::clamp(c.x1.dot(p - c.x0) / c.x1.squaredNorm(), 0.0, 1.0);
    return gap(t);
  }
  t = 0;
  for (int k = 1; k <= 16; ++k)
    if (gap(k / 16.0) < gap(t)) t = k / 16.0;
  for (int k = 0; k < 20; ++k) {  // Newton on ½ |x(t) − p|²
    const Vector2d off = c.at(t) - p, d = c.x1 + 2 * t * c.x2;
    const double slope = off.dot(d), bend = d.squaredNorm() + 2 * off.dot(c.x2);
    if (!(bend > 0)) break;
    t = std::clamp(t - slope / bend, 0.0, 1.0);
  }
  return gap(t);
}

bool covers(const Mesh& mesh, const CellView& view, const Vector2d& p) {
  bool inside = false;
  for (int s = 0; s < corners_of(view.shape); ++s) inside = inside != side_crosses_ray(mesh, side_of(view, 0, s), p);
  return inside;
}

}  // namespace pintle
