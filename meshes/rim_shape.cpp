#include "meshes/rim_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <Eigen/QR>

namespace pintle {

namespace {

using Eigen::Vector2d;
using SideEnds = std::vector<std::pair<int, int>>;

SideEnds side_ends(const std::vector<Cells>& sides) {
  SideEnds ends;
  for (const Cells& c : sides) {
    const std::size_t n = static_cast<std::size_t>(nodes_of(c.shape));
    for (std::size_t s = 0; s < c.size(); ++s) ends.emplace_back(c.nodes[s * n], c.nodes[s * n + 1]);
  }
  return ends;
}

void count_runs(const SideEnds& ends, RimShape& shape) {
  std::map<int, int> parent, degree;  // of corners
  const auto root = [&](int i) {
    while (parent.at(i) != i) i = parent[i] = parent.at(parent.at(i));
    return i;
  };
  for (const auto& [a, b] : ends) parent.try_emplace(a, a), parent.try_emplace(b, b), ++degree[a], ++degree[b];
  for (const auto& [a, b] : ends) parent[root(a)] = root(b);
  std::map<int, bool> whole;
  for (const auto& [node, count] : degree) {
    bool& closed = whole.try_emplace(root(node), true).first->second;
    closed = closed && count % 2 == 0;
  }
  for (const auto& [run, closed] : whole) ++(closed ? shape.loops : shape.open);
}

// |x|² = 2 c·x + (r² − |c|²), least squares about the mean.
void fit_circle(const Mesh& mesh, const SideEnds& ends, RimShape& shape) {
  const Eigen::Index n = static_cast<Eigen::Index>(ends.size());
  Eigen::Matrix2Xd x(2, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    x.col(2 * i) = mesh.x.col(ends[static_cast<std::size_t>(i)].first);
    x.col(2 * i + 1) = mesh.x.col(ends[static_cast<std::size_t>(i)].second);
  }
  const Vector2d mean = x.rowwise().mean();
  x.colwise() -= mean;
  const double size = x.colwise().norm().maxCoeff();
  x /= size;
  Eigen::MatrixX3d A(2 * n, 3);
  A << 2 * x.transpose(), Eigen::VectorXd::Ones(2 * n);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixX3d> qr(A);
  if (qr.rank() < 3) {
    shape.radius = std::numeric_limits<double>::infinity();
    return;
  }
  const Eigen::Vector3d fit = qr.solve(x.colwise().squaredNorm().transpose());
  const Vector2d c = fit.head<2>();
  const double r = std::sqrt(fit[2] + c.squaredNorm());
  shape.center = mean + size * c;
  shape.radius = size * r;
  shape.misfit = ((x.colwise() - c).colwise().norm().array() - r).abs().maxCoeff() / r;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vector2d u = x.col(2 * i) - c, v = x.col(2 * i + 1) - c;
    shape.angle += std::abs(std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v)));
  }
}

}  // namespace

RimShape rim_shape(const Mesh& mesh, const std::vector<Cells>& sides) {
  RimShape shape;
  const SideEnds ends = side_ends(sides);
  count_runs(ends, shape);
  fit_circle(mesh, ends, shape);
  return shape;
}

}  // namespace pintle
