#pragma once

#include <array>

#include "elements/plane.h"

/// Shape functions and integration rules of the plane kinds, tabulated at compile time. Only for plane.cpp and plane_stress.cpp.
namespace pintle {

using CellPosition = std::array<double, 2>;  ///< ξ, η

inline constexpr std::array<CellPosition, 6> triangle_nodes{{{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}};
inline constexpr std::array<CellPosition, 9> quadrilateral_nodes{
    {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}}};

constexpr bool is_triangle(PlaneKind kind) { return kind == PlaneKind::triangle3 || kind == PlaneKind::triangle6; }

/// Values at all nodes: N_i; one row for ∂/∂ξ and one for ∂/∂η.
template <int nodes>
struct ShapeValues {
  std::array<double, nodes> N{};
  std::array<std::array<double, nodes>, 2> d{};
};

/// Functions of one variable, and their slopes, that are 1 at `node` ∈ {−1, 0, 1} and 0 at the others.
struct ValueAndSlope {
  double f, d;
};
constexpr ValueAndSlope linear(double node, double xi) { return {(1 + node * xi) / 2, node / 2}; }
constexpr ValueAndSlope quadratic(double node, double xi) {
  if (node == 0) return {1 - xi * xi, -2 * xi};
  return {xi * (xi + node) / 2, xi + node / 2};
}

template <class E>
constexpr ShapeValues<E::nodes> triangle_shapes(double xi, double eta) {
  ShapeValues<E::nodes> s;
  const std::array<double, 3> L{1 - xi - eta, xi, eta};
  constexpr std::array<std::array<double, 3>, 2> dL{{{-1, 1, 0}, {-1, 0, 1}}};
  for (int i = 0; i < E::nodes; ++i) {
    const int a = i % 3, b = (i + 1) % 3;
    if (E::nodes == 3)
      s.N[i] = L[a];
    else
      s.N[i] = i < 3 ? L[a] * (2 * L[a] - 1) : 4 * L[a] * L[b];
    for (int k = 0; k < 2; ++k) {
      if (E::nodes == 3)
        s.d[k][i] = dL[k][a];
      else
        s.d[k][i] = i < 3 ? (4 * L[a] - 1) * dL[k][a] : 4 * (dL[k][a] * L[b] + L[a] * dL[k][b]);
    }
  }
  return s;
}

/// Tensor products; for corners and sides of a serendipity element, the corner functions minus half of those of both adjacent sides.
template <class E>
constexpr ShapeValues<E::nodes> quadrilateral_shapes(double xi, double eta) {
  ShapeValues<E::nodes> s;
  for (int i = 0; i < E::nodes; ++i) {
    const auto [x, y] = quadrilateral_nodes[i];
    const bool linear_x = E::nodes == 4 || (E::nodes == 8 && x != 0);
    const bool linear_y = E::nodes == 4 || (E::nodes == 8 && y != 0);
    const ValueAndSlope a = linear_x ? linear(x, xi) : quadratic(x, xi);
    const ValueAndSlope b = linear_y ? linear(y, eta) : quadratic(y, eta);
    s.N[i] = a.f * b.f;
    s.d[0][i] = a.d * b.f;
    s.d[1][i] = a.f * b.d;
  }
  if (E::nodes == 8)
    for (int i = 0; i < 4; ++i)
      for (int side : {4 + i, 4 + (i + 3) % 4}) {
        s.N[i] -= s.N[side] / 2;
        for (int k = 0; k < 2; ++k) s.d[k][i] -= s.d[k][side] / 2;
      }
  return s;
}

template <class E>
constexpr ShapeValues<E::nodes> shape_values(double xi, double eta) {
  if constexpr (is_triangle(E::plane_kind))
    return triangle_shapes<E>(xi, eta);
  else
    return quadrilateral_shapes<E>(xi, eta);
}

/// Points and weights on the reference cell.
template <int count>
struct PlaneRule {
  std::array<CellPosition, count> at{};
  std::array<double, count> weight{};
};

/// Gauss rules on [−1, 1] with 2, 3 or 4 points: exact to degree 3, 5, 7.
template <int count>
struct LineRule {
  std::array<double, count> at, weight;
};
inline constexpr LineRule<2> gauss_2{{-0.57735026918962576451, 0.57735026918962576451}, {1, 1}};
inline constexpr LineRule<3> gauss_3{{-0.77459666924148337704, 0, 0.77459666924148337704}, {5.0 / 9, 8.0 / 9, 5.0 / 9}};
inline constexpr LineRule<4> gauss_4{{-0.86113631159405257522, -0.33998104358485626480, 0.33998104358485626480, 0.86113631159405257522},
                                     {0.34785484513745385737, 0.65214515486254614263, 0.65214515486254614263, 0.34785484513745385737}};

template <int count>
constexpr PlaneRule<count * count> squared(const LineRule<count>& line) {
  PlaneRule<count * count> r;
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < count; ++i) {
      r.at[j * count + i] = {line.at[i], line.at[j]};
      r.weight[j * count + i] = line.weight[i] * line.weight[j];
    }
  return r;
}

inline constexpr PlaneRule<1> triangle_1{{{{1.0 / 3, 1.0 / 3}}}, {0.5}};
inline constexpr PlaneRule<3> triangle_3{{{{1.0 / 6, 1.0 / 6}, {2.0 / 3, 1.0 / 6}, {1.0 / 6, 2.0 / 3}}}, {1.0 / 6, 1.0 / 6, 1.0 / 6}};

/// Exact to degree 6 [Dunavant1985], with digits refined by Newton's method on the moment equations.
constexpr PlaneRule<12> triangle_12() {
  constexpr double a = 0.24928674517091043650, wa = 0.11678627572637933960 / 2;
  constexpr double b = 0.06308901449150222305, wb = 0.05084490637020680984 / 2;
  constexpr double c = 0.05314504984481695893, d = 0.31035245103378439010;
  constexpr double wc = 0.08285107561837359193 / 2, e = 1 - c - d;
  return {
      {{{a, a}, {a, 1 - 2 * a}, {1 - 2 * a, a}, {b, b}, {b, 1 - 2 * b}, {1 - 2 * b, b}, {c, d}, {d, c}, {c, e}, {e, c}, {d, e}, {e, d}}},
      {wa, wa, wa, wb, wb, wb, wc, wc, wc, wc, wc, wc}};
}

template <class E>
constexpr auto stiffness_rule() {
  if constexpr (E::points == 1)
    return triangle_1;
  else if constexpr (E::points == 3)
    return triangle_3;
  else if constexpr (E::points == 4)
    return squared(gauss_2);
  else
    return squared(gauss_3);
}

/// Exact for N_i N_j det J, for any positions of the nodes.
template <class E>
constexpr auto mass_rule() {
  if constexpr (E::nodes == 3)
    return triangle_3;
  else if constexpr (E::nodes == 6)
    return triangle_12();
  else if constexpr (E::nodes == 4)
    return squared(gauss_2);
  else
    return squared(gauss_4);
}

template <int nodes, int count>
struct ShapeTable {
  PlaneRule<count> rule;
  std::array<ShapeValues<nodes>, count> shapes{};
};

template <class E, int count>
constexpr ShapeTable<E::nodes, count> tabulate(const PlaneRule<count>& rule) {
  ShapeTable<E::nodes, count> t{rule};
  for (int p = 0; p < count; ++p) t.shapes[p] = shape_values<E>(rule.at[p][0], rule.at[p][1]);
  return t;
}

template <class E>
inline constexpr auto stiffness_table = tabulate<E>(stiffness_rule<E>());
template <class E>
inline constexpr auto mass_table = tabulate<E>(mass_rule<E>());
template <class E>
constexpr auto at_nodes() {
  PlaneRule<E::nodes> nodes;
  for (int i = 0; i < E::nodes; ++i) nodes.at[i] = is_triangle(E::plane_kind) ? triangle_nodes[i] : quadrilateral_nodes[i];
  return tabulate<E>(nodes);
}
template <class E>
inline constexpr auto node_table = at_nodes<E>();

/// ∂x/∂ξ [m], columns for ξ and η.
template <class E>
Eigen::Matrix2d jacobian(const ShapeValues<E::nodes>& s, const Coords<E>& x) {
  Eigen::Matrix2d J = Eigen::Matrix2d::Zero();
  for (int i = 0; i < E::nodes; ++i)
    for (int k = 0; k < 2; ++k) J.col(k) += s.d[k][i] * x.col(i);
  return J;
}

/// Displacement functions of an element: those of the nodes, then the incompatible ones 1 − ξ² and 1 − η².
template <class E>
inline constexpr int functions = E::nodes + (E::plane_kind == PlaneKind::quadrilateral4 ? 2 : 0);

/// ∂/∂x and ∂/∂y of every function at the integration points [1/m], and the area of each point [m²].
template <class E>
struct PointGradients {
  std::array<Eigen::Matrix<double, functions<E>, 2>, E::points> g;
  std::array<double, E::points> area;
};

template <class E>
PointGradients<E> point_gradients(const Coords<E>& x) {
  constexpr auto& table = stiffness_table<E>;
  PointGradients<E> out;
  [[maybe_unused]] Eigen::Matrix2d centre;
  if constexpr (functions < E >> E::nodes) {
    constexpr auto middle = shape_values<E>(0, 0);
    centre = jacobian<E>(middle, x);
  }
  for (int p = 0; p < E::points; ++p) {
    const auto& s = table.shapes[p];
    const Eigen::Matrix2d J = jacobian<E>(s, x);
    const double det = J.determinant();
    const Eigen::Matrix2d inverse = J.inverse();
    out.area[p] = table.rule.weight[p] * det;
    auto& g = out.g[p];
    for (int i = 0; i < E::nodes; ++i) g.row(i) = s.d[0][i] * inverse.row(0) + s.d[1][i] * inverse.row(1);
    if constexpr (functions < E >> E::nodes) {
      // With the Jacobian of the centre, and det J cancelled: ∫ ∇M_k = 0, which satisfies the patch test.
      const Eigen::Matrix2d scaled = centre.inverse() * (centre.determinant() / det);
      for (int k = 0; k < 2; ++k) g.row(E::nodes + k) = -2 * table.rule.at[p][k] * scaled.row(k);
    }
  }
  return out;
}

/// Amplitudes [u_x u_y] of the two incompatible modes per nodal dof, with no force acting on them.
Eigen::Matrix<double, 4, 8> incompatible_amplitudes(const PlaneProperties&, const PointGradients<Quadrilateral4>&);

}  // namespace pintle
