#include "elements/plane.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "elements/plane_shapes.h"

namespace pintle {
namespace {

/// Σ_p t A_p B_pᵀ D B_p over all functions, [u_x u_y] of each. Since D is constant, products of gradients are summed first and multiplied
/// by D once.
template <class E>
Eigen::Matrix<double, 2 * functions<E>, 2 * functions<E>> full_stiffness(const PlaneProperties& properties, const PointGradients<E>& at) {
  constexpr int n = functions<E>;
  using Products = Eigen::Matrix<double, n, n>;
  Products xx = Products::Zero(), xy = Products::Zero(), yy = Products::Zero();
  for (int p = 0; p < E::points; ++p) {
    const double volume = at.area[p] * properties.thickness;
    const Eigen::Matrix<double, n, 1> x = at.g[p].col(0), y = at.g[p].col(1);
    for (int j = 0; j < n; ++j) {
      xx.col(j) += (volume * x[j]) * x;
      xy.col(j) += (volume * y[j]) * x;
      yy.col(j) += (volume * y[j]) * y;
    }
  }

  const Eigen::Matrix3d& D = properties.material.D;
  Eigen::Matrix<double, 2 * n, 2 * n> K;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i <= j; ++i) {
      const double a = xx(i, j), b = yy(i, j), c = xy(i, j), d = xy(j, i);
      K(2 * i, 2 * j) = D(0, 0) * a + D(0, 2) * (c + d) + D(2, 2) * b;
      K(2 * i + 1, 2 * j + 1) = D(1, 1) * b + D(1, 2) * (c + d) + D(2, 2) * a;
      K(2 * i, 2 * j + 1) = D(0, 1) * c + D(0, 2) * a + D(1, 2) * b + D(2, 2) * d;
      K(2 * i + 1, 2 * j) = D(0, 1) * d + D(0, 2) * a + D(1, 2) * b + D(2, 2) * c;
    }
  K.template triangularView<Eigen::StrictlyLower>() = K.transpose();
  return K;
}

Eigen::Matrix<double, 4, 8> amplitudes(const Eigen::Matrix<double, 12, 12>& K) {
  return -K.bottomRightCorner<4, 4>().llt().solve(K.bottomLeftCorner<4, 8>());
}

/// ∫ ρ t N_i N_j, from which the mass and the skew mass are formed.
template <class E>
Eigen::Matrix<double, E::nodes, E::nodes> scalar_mass(const E& e, const Coords<E>& x) {
  constexpr auto& table = mass_table<E>;
  Eigen::Matrix<double, E::nodes, E::nodes> m = decltype(m)::Zero();
  for (std::size_t p = 0; p < table.shapes.size(); ++p) {
    const double det = jacobian<E>(table.shapes[p], x).determinant();
    const double mass = e.p.density * e.p.thickness * table.rule.weight[p] * det;
    const Eigen::Map<const Eigen::Matrix<double, E::nodes, 1>> N(table.shapes[p].N.data());
    for (int j = 0; j < E::nodes; ++j) m.col(j) += (mass * N[j]) * N;
  }
  return m;
}

}  // namespace

Eigen::Matrix<double, 4, 8> incompatible_amplitudes(const PlaneProperties& p, const PointGradients<Quadrilateral4>& at) {
  return amplitudes(full_stiffness<Quadrilateral4>(p, at));
}

template <PlaneElementType E>
Square<E> stiffness(const E& e, const Coords<E>& x) {
  auto K = full_stiffness<E>(e.p, point_gradients<E>(x));
  if constexpr (functions<E> == E::nodes) {
    return K;
  } else {
    Square<E> condensed = K.template topLeftCorner<8, 8>();
    condensed.noalias() += K.template topRightCorner<8, 4>() * amplitudes(K);
    return (condensed + condensed.transpose()) / 2;
  }
}

template <PlaneElementType E>
Square<E> mass(const E& e, const Coords<E>& x) {
  const auto m = scalar_mass(e, x);
  Square<E> M = Square<E>::Zero();
  for (int j = 0; j < E::nodes; ++j)
    for (int i = 0; i < E::nodes; ++i) M(2 * i, 2 * j) = M(2 * i + 1, 2 * j + 1) = m(i, j);
  return M;
}

template <PlaneElementType E>
NodalVector<E> lumped_mass(const E& e, const Coords<E>& x) {
  const auto m = scalar_mass(e, x);
  Eigen::Matrix<double, E::nodes, 1> share = m.rowwise().sum();
  if constexpr (E::nodes > 4) share = m.diagonal() * (m.sum() / m.trace());
  NodalVector<E> lumped;
  for (int i = 0; i < E::nodes; ++i) lumped[2 * i] = lumped[2 * i + 1] = share[i];
  return lumped;
}

template <PlaneElementType E>
Square<E> skew_mass(const E& e, const Coords<E>& x) {
  const auto m = scalar_mass(e, x);
  Square<E> G = Square<E>::Zero();
  for (int j = 0; j < E::nodes; ++j)
    for (int i = 0; i < E::nodes; ++i) {
      G(2 * i, 2 * j + 1) = m(i, j);
      G(2 * i + 1, 2 * j) = -m(i, j);
    }
  return G;
}

template <PlaneElementType E>
ShapeMatrix<E> shape(const E&, const Coords<E>&, const Eigen::Vector2d& xi) {
  const auto s = shape_values<E>(xi.x(), xi.y());
  ShapeMatrix<E> N = ShapeMatrix<E>::Zero();
  for (int i = 0; i < E::nodes; ++i) N(0, 2 * i) = N(1, 2 * i + 1) = s.N[i];
  return N;
}

template Square<Triangle3> stiffness(const Triangle3&, const Coords<Triangle3>&);
template Square<Triangle6> stiffness(const Triangle6&, const Coords<Triangle6>&);
template Square<Quadrilateral4> stiffness(const Quadrilateral4&, const Coords<Quadrilateral4>&);
template Square<Quadrilateral4Plain> stiffness(const Quadrilateral4Plain&, const Coords<Quadrilateral4Plain>&);
template Square<Quadrilateral8> stiffness(const Quadrilateral8&, const Coords<Quadrilateral8>&);
template Square<Quadrilateral8Reduced> stiffness(const Quadrilateral8Reduced&, const Coords<Quadrilateral8Reduced>&);
template Square<Quadrilateral9> stiffness(const Quadrilateral9&, const Coords<Quadrilateral9>&);

template Square<Triangle3> mass(const Triangle3&, const Coords<Triangle3>&);
template Square<Triangle6> mass(const Triangle6&, const Coords<Triangle6>&);
template Square<Quadrilateral4> mass(const Quadrilateral4&, const Coords<Quadrilateral4>&);
template Square<Quadrilateral4Plain> mass(const Quadrilateral4Plain&, const Coords<Quadrilateral4Plain>&);
template Square<Quadrilateral8> mass(const Quadrilateral8&, const Coords<Quadrilateral8>&);
template Square<Quadrilateral8Reduced> mass(const Quadrilateral8Reduced&, const Coords<Quadrilateral8Reduced>&);
template Square<Quadrilateral9> mass(const Quadrilateral9&, const Coords<Quadrilateral9>&);

template NodalVector<Triangle3> lumped_mass(const Triangle3&, const Coords<Triangle3>&);
template NodalVector<Triangle6> lumped_mass(const Triangle6&, const Coords<Triangle6>&);
template NodalVector<Quadrilateral4> lumped_mass(const Quadrilateral4&, const Coords<Quadrilateral4>&);
template NodalVector<Quadrilateral4Plain> lumped_mass(const Quadrilateral4Plain&, const Coords<Quadrilateral4Plain>&);
template NodalVector<Quadrilateral8> lumped_mass(const Quadrilateral8&, const Coords<Quadrilateral8>&);
template NodalVector<Quadrilateral8Reduced> lumped_mass(const Quadrilateral8Reduced&, const Coords<Quadrilateral8Reduced>&);
template NodalVector<Quadrilateral9> lumped_mass(const Quadrilateral9&, const Coords<Quadrilateral9>&);

template Square<Triangle3> skew_mass(const Triangle3&, const Coords<Triangle3>&);
template Square<Triangle6> skew_mass(const Triangle6&, const Coords<Triangle6>&);
template Square<Quadrilateral4> skew_mass(const Quadrilateral4&, const Coords<Quadrilateral4>&);
template Square<Quadrilateral4Plain> skew_mass(const Quadrilateral4Plain&, const Coords<Quadrilateral4Plain>&);
template Square<Quadrilateral8> skew_mass(const Quadrilateral8&, const Coords<Quadrilateral8>&);
template Square<Quadrilateral8Reduced> skew_mass(const Quadrilateral8Reduced&, const Coords<Quadrilateral8Reduced>&);
template Square<Quadrilateral9> skew_mass(const Quadrilateral9&, const Coords<Quadrilateral9>&);

template ShapeMatrix<Triangle3> shape(const Triangle3&, const Coords<Triangle3>&, const Eigen::Vector2d&);
template ShapeMatrix<Triangle6> shape(const Triangle6&, const Coords<Triangle6>&, const Eigen::Vector2d&);
template ShapeMatrix<Quadrilateral4> shape(const Quadrilateral4&, const Coords<Quadrilateral4>&, const Eigen::Vector2d&);
template ShapeMatrix<Quadrilateral4Plain> shape(const Quadrilateral4Plain&, const Coords<Quadrilateral4Plain>&, const Eigen::Vector2d&);
template ShapeMatrix<Quadrilateral8> shape(const Quadrilateral8&, const Coords<Quadrilateral8>&, const Eigen::Vector2d&);
template ShapeMatrix<Quadrilateral8Reduced> shape(const Quadrilateral8Reduced&, const Coords<Quadrilateral8Reduced>&,
                                                  const Eigen::Vector2d&);
template ShapeMatrix<Quadrilateral9> shape(const Quadrilateral9&, const Coords<Quadrilateral9>&, const Eigen::Vector2d&);

}  // namespace pintle
