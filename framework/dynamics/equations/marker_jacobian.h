#pragma once

#include "framework/common/index.h"
#include "framework/dynamics/equations/equations.h"

namespace pintle {

/// Motion of a marker in its body's coordinates: ṗ = [1 J_θ J_ηᵀ]s, and the derivatives V with respect to θ and, transposed, to η.
struct MarkerJacobian {
  explicit MarkerJacobian(const System&);
  Eigen::Vector3d J_theta, V_theta;
  Eigen::MatrixX3d J_eta, V_eta;  ///< sized for the body with the most shapes; only the first n rows are used
  Eigen::Index n = 0;
};
/// n = 0 on the ground and on rigid bodies. After speed.
void move(const System&, const State&, const Equations&, int marker, MarkerJacobian&);

/// Number of coordinates of a body, [x y θ η], and the index of the i-th one in q.
inline int coordinates_of(const System& system, int body) { return 3 + system.bodies[at(body)].modes(); }
inline int coordinate(const System& system, int body, int i) { return i < 3 ? 3 * body + i : system.eta_begin[at(body)] + i - 3; }

}  // namespace pintle
