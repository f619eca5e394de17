#include "meshes/gmsh_figure.h"

#include "meshes/reject.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace pintle {

namespace {

using Eigen::Vector2d;
using std::size_t;
using Tags = std::vector<int>;
namespace model = gmsh::model;

Tags tags(const gmsh::vectorpair& entities) {
  Tags out;
  for (const auto& [dim, tag] : entities) out.push_back(std::abs(tag));
  return out;
}

// 96 points along a curve: for a full circle the error is at most 1/8 % of the radius.
void sample(const std::string& name, int curve, bool forward, Contour& contour) {
  constexpr int count = 96;
  std::vector<double> low, high, t, x, curvature;
  model::getParametrizationBounds(1, curve, low, high);
  for (int i = 0; i < count; ++i) {
    const double s = static_cast<double>(forward ? i : count - i) / count;
    t.push_back(low.at(0) + s * (high.at(0) - low.at(0)));
  }
  model::getValue(1, curve, t, x);
  model::getCurvature(1, curve, t, curvature);
  for (size_t i = 0; i < t.size(); ++i) {
    if (std::abs(x[3 * i + 2]) > 1e-6 * std::max(1e-3, std::hypot(x[3 * i], x[3 * i + 1])))
      reject(name, ": not plane: curve ", curve, " passes (", x[3 * i], ", ", x[3 * i + 1], ", ", x[3 * i + 2],
             "); a body must lie in the plane z = 0: draw its face there, or move it there");
    contour.points.emplace_back(x[3 * i], x[3 * i + 1]);
    contour.curvature.push_back(std::isfinite(curvature[i]) ? curvature[i] : 0);
  }
  contour.curves.push_back(curve);
}

// First and last point of a curve; they are the same for a closed one.
std::pair<int, int> ends(int curve) {
  gmsh::vectorpair points;
  model::getBoundary({{1, curve}}, points, false, false);
  if (points.empty()) return {-curve, -curve};
  return {points.front().second, points.back().second};
}

std::vector<Contour> contours_of(const std::string& name, const Tags& boundary) {
  std::vector<Contour> out;
  std::map<int, Tags> at;  // curves by end point
  for (const int curve : boundary) {
    const auto [a, b] = ends(curve);
    at[a].push_back(curve);
    if (b != a) at[b].push_back(curve);
  }
  std::set<int> used;
  for (const int start : boundary) {
    if (used.contains(start)) continue;
    Contour contour;
    int curve = start, from = ends(start).first;
    while (curve != 0) {
      used.insert(curve);
      const auto [a, b] = ends(curve);
      sample(name, curve, a == from, contour);
      from = a == from ? b : a;
      const Tags& next = at[from];
      const auto found = std::find_if(next.begin(), next.end(), [&](int c) { return !used.contains(c); });
      curve = found == next.end() ? 0 : *found;
    }
    out.push_back(std::move(contour));
  }
  std::stable_sort(out.begin(), out.end(), [](const Contour& a, const Contour& b) { return a.area() > b.area(); });
  return out;
}

}  // namespace

Tags gmsh_body(int dim) {
  gmsh::vectorpair entities, physical;
  model::getEntities(entities, dim);
  model::getPhysicalGroups(physical, dim);
  if (dim == 1 || physical.empty()) return tags(entities);
  std::set<int> named;
  for (const auto& group : physical) {
    Tags of;
    model::getEntitiesForPhysicalGroup(group.first, group.second, of);
    named.insert(of.begin(), of.end());
  }
  return {named.begin(), named.end()};
}

Figure gmsh_figure(const std::string& name, const Tags& surfaces) {
  Figure f{name, surfaces, {}, {}, 0};
  gmsh::vectorpair faces, boundary;
  for (const int s : surfaces) faces.emplace_back(2, s);
  model::getBoundary(faces, boundary, false, false);
  f.curves = tags(boundary);
  std::sort(f.curves.begin(), f.curves.end());
  f.curves.erase(std::unique(f.curves.begin(), f.curves.end()), f.curves.end());
  model::getBoundary(faces, boundary, true, false);
  f.contours = contours_of(name, tags(boundary));
  if (f.contours.empty() || !(f.contours[0].area() > 0))
    reject(name, ": its surfaces have no outline in the plane z = 0; draw a face bounded by curves");
  Vector2d low = f.contours[0].points[0], high = low;
  for (const Vector2d& p : f.contours[0].points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  f.span = (high - low).norm();
  return f;
}

std::vector<Pinned> gmsh_pin(const Figure& f, const std::vector<Vector2d>& points, double scale) {
  std::vector<Pinned> on_curves;
  Tags within;
  gmsh::vectorpair faces;
  model::occ::getEntities(faces, 2);
  const bool open_cascade = !faces.empty();  // drawn by Gmsh's other kernel
  for (const Vector2d& p : points) {
    const Vector2d at = p / scale;
    double least = std::numeric_limits<double>::infinity();
    Pinned nearest{at, 0, 0};
    for (const int curve : f.curves) {
      std::vector<double> closest, unset;
      model::getClosestPoint(1, curve, {at.x(), at.y(), 0}, closest, unset);
      const double d = (Vector2d(closest[0], closest[1]) - at).norm();
      if (d < least) least = d, nearest.curve = curve;
    }
    if (least <= 1e-6 * f.span) {
      std::vector<double> t;  // getClosestPoint does not set it on Open CASCADE curves
      model::getParametrization(1, nearest.curve, {at.x(), at.y(), 0}, t);
      nearest.t = t.at(0);
      on_curves.push_back(nearest);
      continue;
    }
    for (size_t k = 0; k < f.contours.size(); ++k)
      if (inside(f.contours[k], at) != (k == 0))
        reject(f.name, ": the point (", p.x(), ", ", p.y(), ") m ", k == 0 ? "lies outside the outline" : "lies in a hole",
               ", where no node can be; put it on the material, or name the hole and couple the "
               "point to its rim");
    within.push_back(open_cascade ? model::occ::addPoint(at.x(), at.y(), 0) : model::geo::addPoint(at.x(), at.y(), 0));
  }
  if (!within.empty()) open_cascade ? model::occ::synchronize() : model::geo::synchronize();
  for (const int point : within)
    for (const int s : f.surfaces) {
      std::vector<double> x, closest, uv;
      model::getValue(0, point, {}, x);
      model::getClosestPoint(2, s, x, closest, uv);
      if (f.surfaces.size() == 1 || model::isInside(2, s, uv) > 0) {
        model::mesh::embed(0, {point}, 2, s);
        break;
      }
    }
  return on_curves;
}

void gmsh_move_nodes(const std::vector<Pinned>& pinned, double span) {
  std::set<size_t> taken;
  for (const Pinned& p : pinned) {
    std::vector<size_t> nodes, end_nodes;
    std::vector<double> x, u;
    model::mesh::getNodes(nodes, x, u, 1, p.curve, true);
    std::vector<double> inner_x;
    model::mesh::getNodes(end_nodes, inner_x, u, 1, p.curve, false);
    size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    bool met = false;
    for (size_t i = 0; i < nodes.size(); ++i) {
      const double d = std::hypot(x[3 * i] - p.at.x(), x[3 * i + 1] - p.at.y());
      met = met || d <= 1e-9 * span;
      const bool inner = std::find(end_nodes.begin(), end_nodes.end(), nodes[i]) != end_nodes.end();
      if (inner && !taken.contains(nodes[i]) && d < least) least = d, best = nodes[i];
    }
    if (met || best == 0) continue;
    model::mesh::setNode(best, {p.at.x(), p.at.y(), 0}, {p.t});
    taken.insert(best);
  }
}

void gmsh_make_room(const Figure& f, const std::vector<Pinned>& pinned, SizeField& field) {
  for (const Pinned& p : pinned) {
    double room = std::numeric_limits<double>::infinity();
    for (const int curve : f.curves)
      for (const int end : {ends(curve).first, ends(curve).second}) {
        std::vector<double> x;
        if (end > 0) model::getValue(0, end, {}, x);
        const double d = end > 0 ? std::hypot(x[0] - p.at.x(), x[1] - p.at.y()) : 0;
        if (d > 1e-6 * f.span) room = std::min(room, d);
      }
    for (const Pinned& other : pinned)
      if (const double d = (other.at - p.at).norm(); d > 1e-6 * f.span) room = std::min(room, d / 2);
    if (room < field.largest) field.sources.push_back({p.at, room});
  }
}

}  // namespace pintle
