#include "app/rounded.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace pintle {

using Eigen::Vector2d;

std::vector<Vector2d> rounded(std::vector<Vector2d> r) {
  constexpr std::size_t many = 24;
  constexpr double visible = 0.1, alike = 1e-3, pi = std::numbers::pi;
  const std::size_t n = r.size();
  if (n < many) return r;
  Vector2d middle(0, 0);
  for (const Vector2d& p : r) middle += p / static_cast<double>(n);
  const Vector2d first = r[0] - middle;
  const double radius = first.norm(), half = pi / static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double side = (r[(i + 1) % n] - r[i]).norm();
    if (std::abs((r[i] - middle).norm() - radius) > alike * radius || std::abs(side - 2 * radius * std::sin(half)) > alike * radius)
      return r;
  }
  if (!(radius * (1 - std::cos(half)) > visible)) return r;
  const auto corners = static_cast<int>(std::ceil(pi / std::acos(1 - visible / radius)));
  r.clear();
  for (int i = 0; i < corners; ++i) r.emplace_back(middle + Eigen::Rotation2Dd(2 * pi * i / corners) * first);
  return r;
}

}  // namespace pintle
