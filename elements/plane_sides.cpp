#include <cmath>
#include <stdexcept>
#include <string>

#include "elements/plane.h"
#include "elements/plane_shapes.h"

namespace pintle {
namespace {

/// Adds w · N_i · force(∂x/∂ξ) for each node, at the Gauss points of `panels` equal parts of [−1, 1]. `force` converts the tangent [m] into
/// a force [N].
template <class Force>
Eigen::VectorXd integrate(const Eigen::Matrix2Xd& side, int panels, Force force) {
  const Eigen::Index nodes = side.cols();
  if (nodes != 2 && nodes != 3)
    throw std::invalid_argument("side of an element: " + std::to_string(nodes) +
                                " nodes; must be 2 or 3: its ends, then its middle if it has one");
  constexpr std::array<double, 3> place{-1, 1, 0};
  Eigen::VectorXd load = Eigen::VectorXd::Zero(2 * nodes);
  for (int panel = 0; panel < panels; ++panel)
    for (std::size_t p = 0; p < gauss_4.at.size(); ++p) {
      const double xi = (2 * panel + 1 + gauss_4.at[p]) / panels - 1;
      std::array<ValueAndSlope, 3> N{};
      Eigen::Vector2d tangent = Eigen::Vector2d::Zero();
      for (Eigen::Index i = 0; i < nodes; ++i) {
        const auto k = static_cast<std::size_t>(i);
        N[k] = nodes == 2 ? linear(place[k], xi) : quadratic(place[k], xi);
        tangent += N[k].d * side.col(i);
      }
      const Eigen::Vector2d f = gauss_4.weight[p] / panels * force(tangent);
      for (Eigen::Index i = 0; i < nodes; ++i) load.segment<2>(2 * i) += N[static_cast<std::size_t>(i)].f * f;
    }
  return load;
}

}  // namespace

Eigen::VectorXd side_load(const Eigen::Matrix2Xd& side, const Eigen::Vector2d& traction, double thickness) {
  // |∂x/∂ξ| of a parabola is not a polynomial, but nearly one in each of many parts.
  constexpr int panels = 32;
  return integrate(side, panels, [&](const Eigen::Vector2d& tangent) -> Eigen::Vector2d { return thickness * tangent.norm() * traction; });
}

Eigen::VectorXd side_pressure(const Eigen::Matrix2Xd& side, double pressure, double thickness) {
  return integrate(side, 1, [&](const Eigen::Vector2d& tangent) -> Eigen::Vector2d {
    return thickness * pressure * Eigen::Vector2d(-tangent.y(), tangent.x());
  });
}

}  // namespace pintle
