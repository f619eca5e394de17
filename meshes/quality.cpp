#include "meshes/quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

namespace pintle {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

// A Jacobian below this is zero up to rounding: coordinates have 16 digits, and cells are rarely smaller than a thousandth of the body.
constexpr double zero_jacobian = 1e-10;

using Slopes = Eigen::Matrix<double, Eigen::Dynamic, 2, 0, 9, 2>;  // ∂N/∂ξ, ∂N/∂η of every node

Slopes triangle_slopes(int nodes, double xi, double eta) {
  Slopes d(nodes, 2);
  if (nodes == 3) {
    d << -1, -1, 1, 0, 0, 1;
    return d;
  }
  const double l = 1 - xi - eta;
  d << 1 - 4 * l, 1 - 4 * l,  //
      4 * xi - 1, 0,          //
      0, 4 * eta - 1,         //
      4 * (l - xi), -4 * xi,  //
      4 * eta, 4 * xi,        //
      -4 * eta, 4 * (l - eta);
  return d;
}

constexpr std::array<std::array<double, 2>, 9> square{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}}};
constexpr std::array<std::array<double, 2>, 6> triangle{{{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}};

Slopes quadrilateral_slopes(int nodes, double xi, double eta) {
  Slopes d(nodes, 2);
  for (int i = 0; i < nodes; ++i) {
    const double a = square[static_cast<std::size_t>(i)][0], b = square[static_cast<std::size_t>(i)][1];
    if (nodes == 4) {
      d.row(i) << a * (1 + b * eta) / 4, b * (1 + a * xi) / 4;
    } else if (nodes == 9) {  // products of the three quadratics of a line
      const auto value = [](double p, double t) { return p == 0 ? 1 - t * t : t * (t + p) / 2; };
      const auto slope = [](double p, double t) { return p == 0 ? -2 * t : t + p / 2; };
      d.row(i) << slope(a, xi) * value(b, eta), value(a, xi) * slope(b, eta);
    } else if (i < 4) {
      d.row(i) << a * (1 + b * eta) * (2 * a * xi + b * eta) / 4, b * (1 + a * xi) * (2 * b * eta + a * xi) / 4;
    } else if (a == 0) {
      d.row(i) << -xi * (1 + b * eta), b * (1 - xi * xi) / 2;
    } else {
      d.row(i) << a * (1 - eta * eta) / 2, -eta * (1 + a * xi);
    }
  }
  return d;
}

std::vector<Slopes> slopes_at_nodes(CellShape shape) {
  std::vector<Slopes> at;
  const int n = nodes_of(shape);
  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i)
    at.push_back(corners_of(shape) == 3 ? triangle_slopes(n, triangle[i][0], triangle[i][1])
                                        : quadrilateral_slopes(n, square[i][0], square[i][1]));
  return at;
}

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double scaled_jacobian(const Matrix2d& J, bool is_triangle) {
  double a = J.col(0).norm(), b = J.col(1).norm(), unit = 1;
  if (is_triangle) {
    std::array<double, 3> l{a, b, (J.col(1) - J.col(0)).norm()};
    std::sort(l.begin(), l.end());
    a = l[1], b = l[2], unit = 2 / std::numbers::sqrt3;
  }
  return a > 0 && b > 0 ? unit * cross(J.col(0), J.col(1)) / (a * b) : 0;
}

// From the side that leaves the corner to the side that enters it, reversed.
double corner_angle(const Matrix2d& J, int corner, bool is_triangle) {
  const Vector2d u = J.col(0), v = J.col(1);
  Vector2d out, back;
  if (is_triangle) {
    out = corner == 0 ? u : corner == 1 ? Vector2d(v - u) : Vector2d(-v);
    back = corner == 0 ? v : corner == 1 ? Vector2d(-u) : Vector2d(u - v);
  } else {
    out = corner == 0 ? u : corner == 1 ? v : corner == 2 ? Vector2d(-u) : Vector2d(-v);
    back = corner == 0 ? v : corner == 1 ? Vector2d(-u) : corner == 2 ? Vector2d(-v) : u;
  }
  const double angle = std::atan2(cross(out, back), out.dot(back));
  return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

// 1, or negative if a middle node is so near an end (within a quarter of the side's length) that the side starts in the wrong direction.
// Needed because the Jacobian is positive again where two such sides meet.
double side_sense(const Vector2d& a, const Vector2d& b, const Vector2d& middle) {
  const double s = (middle - a).dot(b - a) / (b - a).squaredNorm(), out = 4 * std::min(s, 1 - s) - 1;
  return out < 0 ? out : 1;
}

CellQuality quality_of(const Mesh& mesh, const int* node, CellShape shape, const std::vector<Slopes>& slopes) {
  const int n = nodes_of(shape), corners = corners_of(shape);
  Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 9> x(2, n);
  for (int i = 0; i < n; ++i) x.col(i) = mesh.x.col(node[i]);
  CellQuality q;
  q.angle_min = 2 * std::numbers::pi;
  double longest = 0, shortest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n; ++i) {
    const Matrix2d J = x * slopes[static_cast<std::size_t>(i)];
    q.jacobian = std::min(q.jacobian, scaled_jacobian(J, corners == 3));
    if (i >= corners) continue;
    const double angle = corner_angle(J, i, corners == 3);
    q.angle_min = std::min(q.angle_min, angle);
    q.angle_max = std::max(q.angle_max, angle);
    const double side = (x.col((i + 1) % corners) - x.col(i)).norm();
    longest = std::max(longest, side), shortest = std::min(shortest, side);
    if (n > corners) q.jacobian = std::min(q.jacobian, side_sense(x.col(i), x.col((i + 1) % corners), x.col(i + corners)));
  }
  q.aspect = longest / shortest;
  return q;
}

double signed_area(const Mesh& mesh, const int* node, int corners) {
  double area = 0;
  for (int i = 0; i < corners; ++i)
    area += cross(mesh.x.col(node[i]) - mesh.x.col(node[0]), mesh.x.col(node[(i + 1) % corners]) - mesh.x.col(node[0])) / 2;
  return area;
}

void turn_over(int* node, int n, int corners) {
  std::reverse(node + 1, node + corners);
  if (n > corners) std::reverse(node + corners, node + 2 * corners);
}

}  // namespace

MeshQuality quality(const Mesh& mesh) {
  MeshQuality all;
  double sum = 0;
  std::size_t plane = 0;
  all.least_angle = 2 * std::numbers::pi;
  for (const Cells& cells : mesh.cells) {
    const int n = nodes_of(cells.shape), corners = corners_of(cells.shape);
    if (corners == 2) {
      all.cells.resize(all.cells.size() + cells.size());
      continue;
    }
    const std::vector<Slopes> slopes = slopes_at_nodes(cells.shape);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const int* node = &cells.nodes[c * static_cast<std::size_t>(n)];
      const CellQuality q = quality_of(mesh, node, cells.shape, slopes);
      all.cells.push_back(q);
      all.least_jacobian = std::min(all.least_jacobian, q.jacobian);
      all.greatest_aspect = std::max(all.greatest_aspect, q.aspect);
      all.least_angle = std::min(all.least_angle, q.angle_min);
      all.greatest_angle = std::max(all.greatest_angle, q.angle_max);
      sum += q.jacobian, ++plane;
      if (!(q.jacobian < bad_jacobian)) continue;
      Vector2d at = Vector2d::Zero();
      for (int i = 0; i < corners; ++i) at += mesh.x.col(node[i]) / corners;
      all.bad.push_back({cells.numbers[c], cells.shape, at, q});
    }
  }
  if (plane == 0) all.least_angle = 0;
  if (plane > 0) all.mean_jacobian = sum / static_cast<double>(plane);
  std::stable_sort(all.bad.begin(), all.bad.end(),
                   [](const WorstCell& a, const WorstCell& b) { return a.quality.jacobian < b.quality.jacobian; });
  std::copy_if(all.bad.begin(), all.bad.end(), std::back_inserter(all.inverted),
               [](const WorstCell& w) { return w.quality.jacobian <= zero_jacobian; });
  return all;
}

void orient(Mesh& mesh) {
  std::vector<std::pair<int, int>> turned;  // sides of the reversed cells, in their previous direction
  for (Cells& cells : mesh.cells) {
    const int n = nodes_of(cells.shape), corners = corners_of(cells.shape);
    if (corners == 2) continue;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      int* node = &cells.nodes[c * static_cast<std::size_t>(n)];
      if (signed_area(mesh, node, corners) >= 0) continue;
      for (int i = 0; i < corners; ++i) turned.emplace_back(node[i], node[(i + 1) % corners]);
      turn_over(node, n, corners);
    }
  }
  std::sort(turned.begin(), turned.end());
  for (Group& group : mesh.groups)
    for (Cells& sides : group.sides) {
      const std::size_t n = static_cast<std::size_t>(nodes_of(sides.shape));
      for (std::size_t s = 0; s < sides.size(); ++s) {
        int &a = sides.nodes[s * n], &b = sides.nodes[s * n + 1];
        if (std::binary_search(turned.begin(), turned.end(), std::pair{a, b})) std::swap(a, b);
      }
    }
}

}  // namespace pintle
