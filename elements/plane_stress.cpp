#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include <Eigen/LU>

#include "elements/plane.h"
#include "elements/plane_shapes.h"

namespace pintle {
namespace {

/// Weight of a point's stress at a node. Quadrilaterals: bilinear least squares, whose normal equations are diagonal with the Gauss
/// weights. docs/theory/plane.md.
template <class E>
double share(int p, const CellPosition& node) {
  if constexpr (E::points == 1) return 1;
  const CellPosition& at = stiffness_table<E>.rule.at[p];
  if constexpr (E::points == 3) {
    const std::array L{1 - node[0] - node[1], node[0], node[1]};
    return 2 * L[p] - 1.0 / 3;
  }
  return stiffness_table<E>.rule.weight[p] / 4 * (1 + 3 * node[0] * at[0]) * (1 + 3 * node[1] * at[1]);
}

template <class E>
Eigen::Matrix<double, E::points, E::nodes> extrapolation() {
  Eigen::Matrix<double, E::points, E::nodes> W;
  for (int i = 0; i < E::nodes; ++i)
    for (int p = 0; p < E::points; ++p) W(p, i) = share<E>(p, node_table<E>.rule.at[i]);
  return W;
}

}  // namespace

template <PlaneElementType E>
Stress<E> stress(const E& e, const Coords<E>& x, const NodalVector<E>& u) {
  const PointGradients<E> at = point_gradients<E>(x);
  Eigen::Matrix<double, 2 * functions<E>, 1> all;
  all.template head<E::dofs>() = u;
  if constexpr (functions < E >> E::nodes) all.template tail<4>() = incompatible_amplitudes(e.p, at) * u;
  const Eigen::Map<const Eigen::Matrix<double, 2, functions<E>>> U(all.data());

  Stress<E> out;
  for (int p = 0; p < E::points; ++p) {
    const Eigen::Matrix2d H = U * at.g[p];
    const Eigen::Vector3d strain(H(0, 0), H(1, 1), H(0, 1) + H(1, 0));
    out.col(p).template head<3>() = e.p.material.D * strain;
    out(3, p) = e.p.material.Dz * strain;
  }
  return out;
}

// With ω the rotation, H = ε + ωZ:  s : (HᵀH − ε²) = ω (ω tr s + (sx − sy) γ + 2τ (εy − εx)).
template <PlaneElementType E>
Square<E> geometric_stiffness(const E& e, const Coords<E>& x, const Stress<E>& s) {
  const PointGradients<E> at = point_gradients<E>(x);
  Square<E> half = Square<E>::Zero();
  for (int p = 0; p < E::points; ++p) {
    const double sx = s(0, p), sy = s(1, p), tau = s(2, p);
    NodalVector<E> rotation, rest;  // ω, and the second factor
    for (int i = 0; i < E::nodes; ++i) {
      const double dx = at.g[p](i, 0), dy = at.g[p](i, 1);
      rotation.template segment<2>(2 * i) << -dy / 2, dx / 2;
      rest.template segment<2>(2 * i) << (sx - sy) * dy - 2 * tau * dx, (sx - sy) * dx + 2 * tau * dy;
    }
    rest += (sx + sy) * rotation;
    half += (at.area[p] * e.p.thickness / 2) * rotation * rest.transpose();
  }
  return half + half.transpose();
}

template <PlaneElementType E>
Eigen::Matrix<double, 2, E::points> reference_points(const E&) {
  Eigen::Matrix<double, 2, E::points> out;
  for (int p = 0; p < E::points; ++p) out.col(p) << stiffness_table<E>.rule.at[p][0], stiffness_table<E>.rule.at[p][1];
  return out;
}

template <PlaneElementType E>
Eigen::Matrix<double, 2, E::points> stress_points(const E&, const Coords<E>& x) {
  Eigen::Matrix<double, 2, E::points> out;
  for (int p = 0; p < E::points; ++p)
    out.col(p) = x * Eigen::Map<const Eigen::Matrix<double, E::nodes, 1>>(stiffness_table<E>.shapes[p].N.data());
  return out;
}

template <PlaneElementType E>
Eigen::Matrix<double, 4, E::nodes> nodal_stress(const E&, const Stress<E>& s) {
  static const auto W = extrapolation<E>();
  return s * W;
}

template <PlaneElementType E>
Eigen::Matrix<double, 1, E::nodes> nodal_jacobians(const E&, const Coords<E>& x) {
  Eigen::Matrix<double, 1, E::nodes> det;
  for (int i = 0; i < E::nodes; ++i) det[i] = jacobian<E>(node_table<E>.shapes[i], x).determinant();
  return det;
}

double von_mises(const Eigen::Vector4d& s) {
  const double xy = s[0] - s[1], yz = s[1] - s[3], zx = s[3] - s[0];
  return std::sqrt((xy * xy + yz * yz + zx * zx) / 2 + 3 * s[2] * s[2]);
}

Eigen::Vector3d principal(const Eigen::Vector4d& s) {
  const double middle = (s[0] + s[1]) / 2, half = (s[0] - s[1]) / 2;
  const double radius = std::hypot(half, s[2]);
  return {middle + radius, middle - radius, std::atan2(s[2] + 0.0, half) / 2};
}

template Stress<Triangle3> stress(const Triangle3&, const Coords<Triangle3>&, const NodalVector<Triangle3>&);
template Stress<Triangle6> stress(const Triangle6&, const Coords<Triangle6>&, const NodalVector<Triangle6>&);
template Stress<Quadrilateral4> stress(const Quadrilateral4&, const Coords<Quadrilateral4>&, const NodalVector<Quadrilateral4>&);
template Stress<Quadrilateral4Plain> stress(const Quadrilateral4Plain&, const Coords<Quadrilateral4Plain>&,
                                            const NodalVector<Quadrilateral4Plain>&);
template Stress<Quadrilateral8> stress(const Quadrilateral8&, const Coords<Quadrilateral8>&, const NodalVector<Quadrilateral8>&);
template Stress<Quadrilateral8Reduced> stress(const Quadrilateral8Reduced&, const Coords<Quadrilateral8Reduced>&,
                                              const NodalVector<Quadrilateral8Reduced>&);
template Stress<Quadrilateral9> stress(const Quadrilateral9&, const Coords<Quadrilateral9>&, const NodalVector<Quadrilateral9>&);

template Square<Triangle3> geometric_stiffness(const Triangle3&, const Coords<Triangle3>&, const Stress<Triangle3>&);
template Square<Triangle6> geometric_stiffness(const Triangle6&, const Coords<Triangle6>&, const Stress<Triangle6>&);
template Square<Quadrilateral4> geometric_stiffness(const Quadrilateral4&, const Coords<Quadrilateral4>&, const Stress<Quadrilateral4>&);
template Square<Quadrilateral4Plain> geometric_stiffness(const Quadrilateral4Plain&, const Coords<Quadrilateral4Plain>&,
                                                         const Stress<Quadrilateral4Plain>&);
template Square<Quadrilateral8> geometric_stiffness(const Quadrilateral8&, const Coords<Quadrilateral8>&, const Stress<Quadrilateral8>&);
template Square<Quadrilateral8Reduced> geometric_stiffness(const Quadrilateral8Reduced&, const Coords<Quadrilateral8Reduced>&,
                                                           const Stress<Quadrilateral8Reduced>&);
template Square<Quadrilateral9> geometric_stiffness(const Quadrilateral9&, const Coords<Quadrilateral9>&, const Stress<Quadrilateral9>&);

template Eigen::Matrix<double, 2, Triangle3::points> reference_points(const Triangle3&);
template Eigen::Matrix<double, 2, Triangle6::points> reference_points(const Triangle6&);
template Eigen::Matrix<double, 2, Quadrilateral4::points> reference_points(const Quadrilateral4&);
template Eigen::Matrix<double, 2, Quadrilateral4Plain::points> reference_points(const Quadrilateral4Plain&);
template Eigen::Matrix<double, 2, Quadrilateral8::points> reference_points(const Quadrilateral8&);
template Eigen::Matrix<double, 2, Quadrilateral8Reduced::points> reference_points(const Quadrilateral8Reduced&);
template Eigen::Matrix<double, 2, Quadrilateral9::points> reference_points(const Quadrilateral9&);

template Eigen::Matrix<double, 2, Triangle3::points> stress_points(const Triangle3&, const Coords<Triangle3>&);
template Eigen::Matrix<double, 2, Triangle6::points> stress_points(const Triangle6&, const Coords<Triangle6>&);
template Eigen::Matrix<double, 2, Quadrilateral4::points> stress_points(const Quadrilateral4&, const Coords<Quadrilateral4>&);
template Eigen::Matrix<double, 2, Quadrilateral4Plain::points> stress_points(const Quadrilateral4Plain&,
                                                                             const Coords<Quadrilateral4Plain>&);
template Eigen::Matrix<double, 2, Quadrilateral8::points> stress_points(const Quadrilateral8&, const Coords<Quadrilateral8>&);
template Eigen::Matrix<double, 2, Quadrilateral8Reduced::points> stress_points(const Quadrilateral8Reduced&,
                                                                               const Coords<Quadrilateral8Reduced>&);
template Eigen::Matrix<double, 2, Quadrilateral9::points> stress_points(const Quadrilateral9&, const Coords<Quadrilateral9>&);

template Eigen::Matrix<double, 4, Triangle3::nodes> nodal_stress(const Triangle3&, const Stress<Triangle3>&);
template Eigen::Matrix<double, 4, Triangle6::nodes> nodal_stress(const Triangle6&, const Stress<Triangle6>&);
template Eigen::Matrix<double, 4, Quadrilateral4::nodes> nodal_stress(const Quadrilateral4&, const Stress<Quadrilateral4>&);
template Eigen::Matrix<double, 4, Quadrilateral4Plain::nodes> nodal_stress(const Quadrilateral4Plain&, const Stress<Quadrilateral4Plain>&);
template Eigen::Matrix<double, 4, Quadrilateral8::nodes> nodal_stress(const Quadrilateral8&, const Stress<Quadrilateral8>&);
template Eigen::Matrix<double, 4, Quadrilateral8Reduced::nodes> nodal_stress(const Quadrilateral8Reduced&,
                                                                             const Stress<Quadrilateral8Reduced>&);
template Eigen::Matrix<double, 4, Quadrilateral9::nodes> nodal_stress(const Quadrilateral9&, const Stress<Quadrilateral9>&);

template Eigen::Matrix<double, 1, Triangle3::nodes> nodal_jacobians(const Triangle3&, const Coords<Triangle3>&);
template Eigen::Matrix<double, 1, Triangle6::nodes> nodal_jacobians(const Triangle6&, const Coords<Triangle6>&);
template Eigen::Matrix<double, 1, Quadrilateral4::nodes> nodal_jacobians(const Quadrilateral4&, const Coords<Quadrilateral4>&);
template Eigen::Matrix<double, 1, Quadrilateral4Plain::nodes> nodal_jacobians(const Quadrilateral4Plain&,
                                                                              const Coords<Quadrilateral4Plain>&);
template Eigen::Matrix<double, 1, Quadrilateral8::nodes> nodal_jacobians(const Quadrilateral8&, const Coords<Quadrilateral8>&);
template Eigen::Matrix<double, 1, Quadrilateral8Reduced::nodes> nodal_jacobians(const Quadrilateral8Reduced&,
                                                                                const Coords<Quadrilateral8Reduced>&);
template Eigen::Matrix<double, 1, Quadrilateral9::nodes> nodal_jacobians(const Quadrilateral9&, const Coords<Quadrilateral9>&);

}  // namespace pintle
