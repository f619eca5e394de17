#include "framework/configuration/placed.h"

#include "framework/configuration/least_step.h"

namespace pintle {

using Eigen::VectorXd;
using Index = Eigen::Index;
using Sparse = Eigen::SparseMatrix<double>;

VectorXd placed(const Scene& scene, const System& system, Closure& closure, const VectorXd& y, const VectorXd& W, double bend) {
  constexpr double held = 1e-4, damping = 1e-12;
  constexpr int sweeps = 4;
  VectorXd angles = VectorXd::Zero(W.size()), places = angles, out = y;
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const auto i = static_cast<Index>(3 * b);
    places.segment<2>(i) = (scene.bodies[b].drawn_at ? held : 1) * W.segment<2>(i);
    angles[i + 2] = (scene.bodies[b].drawn_angle ? held : 1) * W[i + 2];
    if (!scene.bodies[b].drawn_angle && W[i + 2] > 0) out[i + 2] += bend * static_cast<double>(b % 2 == 0 ? 1 : -1);
  }
  const VectorXd angular = closure.angle_rows();
  const auto move = [&](const VectorXd& rows, const VectorXd& weights) {
    Sparse J;
    const VectorXd C = closure.violation(out, &J);
    out.head(W.size()) += least_step(rows.asDiagonal() * J, weights, -rows.cwiseProduct(C), damping, sweeps);
  };
  move(angular, angles);
  move(VectorXd::Ones(angular.size()) - angular, places);
  return out;
}

}  // namespace pintle
