#pragma once

#include "framework/common/index.h"
#include "framework/dynamics/equations/equations.h"

namespace pintle {

/// A marker's motion in its body's coordinates: ṗ = [1 J_θ J_ηᵀ]s and its derivatives V by θ and, transposed, by η.
struct MarkerJacobian {
  explicit MarkerJacobian(const System&);
  Eigen::Vector3d J_theta, V_theta;
  Eigen::MatrixX3d J_eta, V_eta;  ///< of the body with the most shapes; the first n are meant
  Eigen::Index n = 0;
};
/// n = 0 on the ground and on rigid bodies. After speed.
void move(const System&, const State&, const Equations&, int marker, MarkerJacobian&);

/// Coordinates of a body, [x y θ η], and where the i-th of them stands in q.
inline int coordinates_of(const System& system, int body) { return 3 + system.bodies[at(body)].modes(); }
inline int coordinate(const System& system, int body, int i) { return i < 3 ? 3 * body + i : system.eta_begin[at(body)] + i - 3; }

}  // namespace pintle
