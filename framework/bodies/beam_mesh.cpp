#include "framework/bodies/beam_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "framework/bodies/elastic_parts.h"
#include "meshes/generate.h"
#include "meshes/reject.h"
#include "meshes/squares.h"

namespace pintle {

namespace {

using Eigen::Vector2d;

constexpr double rounding = 1e-9;  ///< relative to a piece's length: a nearer point is on it
constexpr double touching = 1e-6;  ///< relative to the shorter of two pieces: nearer pieces look joined

/// Position of point p along a piece from a to b, 0 to 1; negative if it is not on the piece.
double along(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  const Vector2d d = b - a;
  const double t = d.dot(p - a) / d.squaredNorm();
  return t >= 0 && t <= 1 && (a + t * d - p).norm() <= rounding * d.norm() ? t : -1;
}

/// Points of the body at the same place are one node; if the path names one of them, the node has that name.
struct Places {
  const std::vector<ScenePoint>& points;
  double near;
  std::vector<std::size_t> passed{};  ///< points, one per node
  std::vector<char> named_here{};     ///< whether the path names it

  int node_of(std::size_t point, bool named) {
    for (std::size_t k = 0; k < passed.size(); ++k) {
      if ((vector(points[passed[k]].at) - vector(points[point].at)).norm() > near) continue;
      const bool other = named && passed[k] != point;
      if (other && named_here[k])
        reject("its beam passes ", points[passed[k]].name, " and ", points[point].name, ", which both lie at ",
               shown(vector(points[point].at)),
               "; to join the beam there, write the same name twice in through; to leave it open, move one of the points a little");
      if (named) passed[k] = point, named_here[k] = true;
      return static_cast<int>(k);
    }
    passed.push_back(point);
    named_here.push_back(named);
    return static_cast<int>(passed.size()) - 1;
  }
};

/// Shortest distance between two straight pieces, and the middle of it.
double gap(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d, Vector2d& at) {
  const auto cross = [](const Vector2d& u, const Vector2d& v) { return u.x() * v.y() - u.y() * v.x(); };
  const Vector2d u = b - a, v = d - c;
  if (const double turn = cross(u, v); turn != 0) {
    const double s = cross(c - a, v) / turn, t = cross(c - a, u) / turn;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) {
      at = a + s * u;
      return 0;
    }
  }
  double least = std::numeric_limits<double>::infinity();
  const auto end = [&](const Vector2d& p, const Vector2d& from, const Vector2d& along_it) {
    const double t = std::clamp(along_it.dot(p - from) / along_it.squaredNorm(), 0.0, 1.0);
    const Vector2d q = from + t * along_it;
    if (const double here = (q - p).norm(); here < least) least = here, at = (p + q) / 2;
  };
  end(a, c, v), end(b, c, v), end(c, a, u), end(d, a, u);
  return least;
}

/// Merges nodes where the axis returns to a point: the first one is kept.
void join(Mesh& mesh, const BeamAxis& axis, const std::vector<int>& cells) {
  std::vector<int> to(static_cast<std::size_t>(mesh.x.cols()));
  std::iota(to.begin(), to.end(), 0);
  std::map<int, int> first;
  int at = 0;
  for (std::size_t i = 0; i < axis.node.size(); ++i) {
    to[static_cast<std::size_t>(at)] = first.try_emplace(axis.node[i], at).first->second;
    if (i < cells.size()) at += cells[i];
  }
  for (int& node : mesh.cells.front().nodes) node = to[static_cast<std::size_t>(node)];
  drop_unused_nodes(mesh);
  std::iota(mesh.node_numbers.begin(), mesh.node_numbers.end(), 1L);
}

}  // namespace

double BeamAxis::length() const {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) sum += (corners[i + 1] - corners[i]).norm();
  return sum;
}

bool BeamAxis::returns() const {
  std::vector<int> sorted = node;
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

BeamAxis beam_axis(const Scene& scene, const SceneBody& body, const SceneBeam& beam) {
  if (beam.through.size() < 2) reject("its beam runs through fewer than two points; name two");
  std::vector<std::size_t> through;
  double length = 0;
  for (const std::string& name : beam.through) {
    through.push_back(static_cast<std::size_t>(&point_of(scene, body, name, body.place) - body.points.data()));
    if (through.size() > 1) length += (vector(body.points[through.back()].at) - vector(body.points[through[through.size() - 2]].at)).norm();
  }
  BeamAxis axis;
  Places places{body.points, rounding * length};
  std::map<std::pair<int, int>, std::size_t> run;  // between two nodes
  const auto add = [&](const Vector2d& at, std::size_t point, bool named) {
    axis.corners.push_back(at);
    axis.node.push_back(places.node_of(point, named));
    axis.name.push_back(body.points[point].name);
  };
  add(vector(body.points[through[0]].at), through[0], true);
  for (std::size_t i = 0; i + 1 < through.size(); ++i) {
    const Vector2d a = vector(body.points[through[i]].at), b = vector(body.points[through[i + 1]].at);
    if ((b - a).norm() == 0) {  // line_mesh reports the error
      add(b, through[i + 1], true);
      continue;
    }
    std::vector<std::pair<double, std::size_t>> on;
    for (std::size_t p = 0; p < body.points.size(); ++p) {
      if (!body.points[p].hole.empty()) continue;
      if (const double t = along(a, b, vector(body.points[p].at)); t > rounding && t < 1 - rounding) on.emplace_back(t, p);
    }
    std::sort(on.begin(), on.end());
    on.erase(std::unique(on.begin(), on.end(), [](const auto& s, const auto& t) { return t.first - s.first < rounding; }), on.end());
    for (const auto& [t, p] : on) add(a + t * (b - a), p, false);
    add(b, through[i + 1], true);
  }
  for (std::size_t i = 0; i + 1 < axis.node.size(); ++i) {
    const auto [twin, is_new] = run.try_emplace(std::minmax(axis.node[i], axis.node[i + 1]), i);
    if (!is_new && axis.node[i] != axis.node[i + 1])
      reject("its beam runs twice between ", axis.name[i], " and ", axis.name[i + 1],
             ", so the material there would count twice; draw each stretch once, and make branches separate bodies welded to this one");
  }
  return axis;
}

std::vector<std::string> crossings(const BeamAxis& axis) {
  std::vector<Squares::Box> boxes;
  const auto reach = [&](std::size_t i) { return touching * (axis.corners[i + 1] - axis.corners[i]).norm(); };
  const auto box = [&](std::size_t i) {
    const Vector2d &a = axis.corners[i], &b = axis.corners[i + 1];
    const double near = reach(i);
    return Squares::Box(a.cwiseMin(b).array() - near, a.cwiseMax(b).array() + near);
  };
  for (std::size_t i = 0; i + 1 < axis.corners.size(); ++i) boxes.push_back(box(i));
  const Squares squares(boxes);
  std::vector<std::string> out;
  std::size_t count = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    std::vector<std::size_t> others;
    squares.each(boxes[i], [&](int k) { others.push_back(static_cast<std::size_t>(k)); });
    std::sort(others.begin(), others.end());
    for (const std::size_t k : others) {
      if (k <= i || axis.node[i] == axis.node[k] || axis.node[i + 1] == axis.node[k] || axis.node[i] == axis.node[k + 1] ||
          axis.node[i + 1] == axis.node[k + 1])
        continue;
      Vector2d at;
      if (gap(axis.corners[i], axis.corners[i + 1], axis.corners[k], axis.corners[k + 1], at) > std::min(reach(i), reach(k))) continue;
      if (++count <= 3)
        out.push_back("its beam meets itself at " + shown(at) + ", between " + axis.name[i] + " and " + axis.name[i + 1] + " and between " +
                      axis.name[k] + " and " + axis.name[k + 1] +
                      ", and is not joined there: one passes over the other; give the body a point there to join them");
    }
  }
  if (count > 3) out.back() += " (and so at " + std::to_string(count - 3) + " more places)";
  return out;
}

Mesh beam_mesh(const BeamAxis& axis, const SceneBeam& beam) {
  const double length = axis.length();
  const int wanted = beam.elements > 0 ? beam.elements : default_beam_elements;
  std::vector<int> cells;
  for (std::size_t i = 0; i + 1 < axis.corners.size(); ++i)
    cells.push_back(std::max(1, static_cast<int>(std::lround(wanted * (axis.corners[i + 1] - axis.corners[i]).norm() / length))));
  Mesh mesh = line_mesh(axis.corners, cells);
  if (axis.returns()) join(mesh, axis, cells);
  return mesh;
}

}  // namespace pintle
