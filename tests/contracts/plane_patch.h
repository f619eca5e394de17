#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Dense>
#include <Eigen/Sparse>

#include "elements/plane.h"

/// Meshes, assembly and solution for the exams of plane elements: small, and sharing nothing with
/// the framework's.
namespace pintle::patch {

using Kinds =
    testing::Types<Triangle3, Triangle6, Quadrilateral4, Quadrilateral4Plain, Quadrilateral8, Quadrilateral8Reduced, Quadrilateral9>;

using LinearKinds = testing::Types<Triangle3, Quadrilateral4, Quadrilateral4Plain>;
using QuadraticKinds = testing::Types<Triangle6, Quadrilateral8, Quadrilateral8Reduced, Quadrilateral9>;
using QuadrilateralKinds = testing::Types<Quadrilateral4, Quadrilateral4Plain, Quadrilateral8, Quadrilateral8Reduced, Quadrilateral9>;
using QuadraticQuadrilateralKinds = testing::Types<Quadrilateral8, Quadrilateral8Reduced, Quadrilateral9>;

template <class E>
inline constexpr bool triangular = E::nodes == 3 || E::nodes == 6;
template <class E>
inline constexpr int corners = triangular<E> ? 3 : 4;
template <class E>
inline constexpr int order = E::nodes > 4 ? 2 : 1;  ///< p

struct Elastic {
  double E, nu;
  bool plane_strain = false;
  double shear() const { return E / (2 * (1 + nu)); }
  /// λ of σ = 2μ ε + λ tr ε 1 in the plane.
  double lame() const { return plane_strain ? E * nu / (1 + nu) / (1 - 2 * nu) : E * nu / (1 - nu * nu); }
  Eigen::Matrix3d D() const {
    const double l = lame(), g = shear();
    Eigen::Matrix3d out;
    out << l + 2 * g, l, 0, l, l + 2 * g, 0, 0, 0, g;
    return out;
  }
  Eigen::RowVector3d Dz() const { return plane_strain ? Eigen::RowVector3d(lame(), lame(), 0) : Eigen::RowVector3d::Zero().eval(); }
};

template <class E>
E element(const Elastic& m, double density = 1, double thickness = 1) {
  return E{{{m.D(), m.Dz()}, density, thickness}};
}

using Point = Eigen::Vector2d;
using Field = std::function<Point(const Point&)>;

template <class E>
struct Mesh {
  std::vector<Point> nodes;
  std::vector<std::array<int, E::nodes>> cells;

  Coords<E> coords(const std::array<int, E::nodes>& cell) const {
    Coords<E> x;
    for (int i = 0; i < E::nodes; ++i) x.col(i) = nodes[cell[i]];
    return x;
  }
  Eigen::Index dofs() const { return 2 * static_cast<Eigen::Index>(nodes.size()); }
};

/// A mesh of given corners and quadrilaterals, which triangles halve. Middles of sides are put
/// halfway, centres at the mean of the corners.
template <class E>
Mesh<E> refine(const std::vector<Point>& vertices, const std::vector<std::array<int, 4>>& quads) {
  Mesh<E> mesh{vertices, {}};
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<int>(mesh.nodes.size()));
    if (fresh) mesh.nodes.push_back((vertices[a] + vertices[b]) / 2);
    return at->second;
  };
  const auto add = [&](const std::array<int, corners<E>>& corner) {
    std::array<int, E::nodes> cell{};
    for (int i = 0; i < corners<E>; ++i) cell[i] = corner[i];
    if constexpr (order<E> == 2)
      for (int i = 0; i < corners<E>; ++i) cell[corners<E> + i] = middle(corner[i], corner[(i + 1) % corners<E>]);
    if constexpr (E::nodes == 9) {
      cell[8] = static_cast<int>(mesh.nodes.size());
      mesh.nodes.push_back((vertices[corner[0]] + vertices[corner[1]] + vertices[corner[2]] + vertices[corner[3]]) / 4);
    }
    mesh.cells.push_back(cell);
  };
  for (const auto& [a, b, c, d] : quads) {
    if constexpr (triangular<E>) {
      add({a, b, c});
      add({a, c, d});
    } else {
      add({a, b, c, d});
    }
  }
  return mesh;
}

/// The unit square in columns × rows, before any map.
template <class E>
Mesh<E> grid(int columns, int rows) {
  std::vector<Point> vertices;
  std::vector<std::array<int, 4>> quads;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) vertices.emplace_back(double(i) / columns, double(j) / rows);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i, b = a + columns + 1;
      quads.push_back({a, a + 1, b + 1, b});
    }
  return refine<E>(vertices, quads);
}

template <class E>
Mesh<E> mapped(Mesh<E> mesh, const Field& map) {
  for (Point& x : mesh.nodes) x = map(x);
  return mesh;
}

template <class E>
using Verb = std::function<Square<E>(const E&, const Coords<E>&)>;

template <class E>
Eigen::SparseMatrix<double> assemble(const Mesh<E>& mesh, const E& e, const Verb<E>& matrix) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& cell : mesh.cells) {
    const Square<E> K = matrix(e, mesh.coords(cell));
    for (int i = 0; i < E::dofs; ++i)
      for (int j = 0; j < E::dofs; ++j) entries.emplace_back(2 * cell[i / 2] + i % 2, 2 * cell[j / 2] + j % 2, K(i, j));
  }
  Eigen::SparseMatrix<double> out(mesh.dofs(), mesh.dofs());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}
template <class E>
Eigen::SparseMatrix<double> assembled_stiffness(const Mesh<E>& mesh, const E& e) {
  return assemble<E>(mesh, e, [](const E& f, const Coords<E>& x) { return stiffness(f, x); });
}
template <class E>
Eigen::SparseMatrix<double> assembled_mass(const Mesh<E>& mesh, const E& e) {
  return assemble<E>(mesh, e, [](const E& f, const Coords<E>& x) { return mass(f, x); });
}

/// Values prescribed to dofs.
using Held = std::map<int, double>;

template <class E>
Held hold(
    const Mesh<E>& mesh, const std::function<bool(const Point&)>& where, const Field& value = [](const Point&) { return Point(0, 0); }) {
  Held held;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (where(mesh.nodes[i]))
      for (int k = 0; k < 2; ++k) held[2 * static_cast<int>(i) + k] = value(mesh.nodes[i])[k];
  return held;
}

/// The columns of the identity that are free.
inline Eigen::SparseMatrix<double> selection(Eigen::Index dofs, const Held& held) {
  std::vector<Eigen::Triplet<double>> ones;
  for (Eigen::Index i = 0; i < dofs; ++i)
    if (!held.contains(static_cast<int>(i))) ones.emplace_back(i, Eigen::Index(ones.size()), 1.0);
  Eigen::SparseMatrix<double> P(dofs, static_cast<Eigen::Index>(ones.size()));
  P.setFromTriplets(ones.begin(), ones.end());
  return P;
}

inline Eigen::VectorXd solve(const Eigen::SparseMatrix<double>& K, const Eigen::VectorXd& load, const Held& held) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(K.rows());
  for (const auto& [dof, value] : held) u[dof] = value;
  const Eigen::SparseMatrix<double> P = selection(K.rows(), held);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(P.transpose() * K * P);
  if (factor.info() != Eigen::Success) throw std::runtime_error("patch: singular stiffness");
  return u + P * factor.solve(P.transpose() * (load - K * u));
}

/// The lowest eigenvalue of K φ = λ M φ, by inverse iteration.
inline double lowest(const Eigen::SparseMatrix<double>& K, const Eigen::SparseMatrix<double>& M, const Held& held) {
  const Eigen::SparseMatrix<double> P = selection(K.rows(), held);
  const Eigen::SparseMatrix<double> k = P.transpose() * K * P, m = P.transpose() * M * P;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(k);
  Eigen::VectorXd mv = Eigen::VectorXd::LinSpaced(k.rows(), 1, 2);
  for (Eigen::Index i = 0; i < mv.size(); i += 3) mv[i] = -mv[i];
  double value = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::VectorXd next = factor.solve(mv);
    mv = m * next;
    const Eigen::VectorXd kv = k * next;
    const double before = value;
    value = next.dot(kv) / next.dot(mv);
    mv /= mv.norm();
    if (std::abs(value - before) < 1e-14 * value) break;
  }
  return value;
}

template <class E>
NodalVector<E> gather(const std::array<int, E::nodes>& cell, const Eigen::VectorXd& u) {
  NodalVector<E> out;
  for (int i = 0; i < E::dofs; ++i) out[i] = u[2 * cell[i / 2] + i % 2];
  return out;
}

/// Gauss–Legendre on [−1, 1], five points, exact to degree 9; on a triangle by collapsing the
/// square.
template <class E>
void for_quadrature(const std::function<void(const Point& xi, double weight)>& visit) {
  const double a = std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 3, b = std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3;
  const double wa = (322 + 13 * std::sqrt(70.0)) / 900, wb = (322 - 13 * std::sqrt(70.0)) / 900;
  const std::array<double, 5> at{-b, -a, 0, a, b}, w{wb, wa, 128.0 / 225, wa, wb};
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) {
      if constexpr (triangular<E>) {
        const double r = (1 + at[i]) / 2, s = (1 + at[j]) / 2;
        visit({r, s * (1 - r)}, w[i] * w[j] / 4 * (1 - r));
      } else {
        visit({at[i], at[j]}, w[i] * w[j]);
      }
    }
}

/// det ∂x/∂ξ by central differences of `shape`, exact as shapes are quadratic in each coordinate.
template <class E>
double determinant(const E& e, const Coords<E>& x, const Point& xi) {
  constexpr double h = 0.25;
  const Eigen::Map<const NodalVector<E>> nodal(x.data());
  Eigen::Matrix2d J;
  for (int k = 0; k < 2; ++k) {
    const Point step = h * Point::Unit(k);
    J.col(k) = (shape(e, x, Point(xi + step)) - shape(e, x, Point(xi - step))) * nodal / (2 * h);
  }
  return J.determinant();
}

/// visit(x, volume, N, cell): position, t det J w, shapes and cell at each quadrature point.
template <class E, class Visit>
void for_points(const Mesh<E>& mesh, const E& e, Visit visit) {
  for (const auto& cell : mesh.cells) {
    const Coords<E> x = mesh.coords(cell);
    const Eigen::Map<const NodalVector<E>> nodal(x.data());
    for_quadrature<E>([&](const Point& xi, double weight) {
      const ShapeMatrix<E> N = shape(e, x, xi);
      visit(Point(N * nodal), weight * determinant(e, x, xi) * e.p.thickness, N, cell);
    });
  }
}

/// Sides of which both ends meet `where`: nodes in order, ends then middle, counter-clockwise about
/// the cell.
template <class E>
std::vector<std::vector<int>> sides(const Mesh<E>& mesh, const std::function<bool(const Point&)>& where) {
  std::vector<std::vector<int>> out;
  for (const auto& cell : mesh.cells)
    for (int i = 0; i < corners<E>; ++i) {
      const int a = cell[i], b = cell[(i + 1) % corners<E>];
      if (!where(mesh.nodes[a]) || !where(mesh.nodes[b])) continue;
      out.push_back({a, b});
      if (order<E> == 2) out.back().push_back(cell[corners<E> + i]);
    }
  return out;
}

/// Adds what `load(side)` gives for each side.
template <class E, class Load>
Eigen::VectorXd side_loads(const Mesh<E>& mesh, const std::vector<std::vector<int>>& list, Load load) {
  Eigen::VectorXd f = Eigen::VectorXd::Zero(mesh.dofs());
  for (const auto& nodes : list) {
    Eigen::Matrix2Xd x(2, static_cast<Eigen::Index>(nodes.size()));
    for (std::size_t i = 0; i < nodes.size(); ++i) x.col(static_cast<Eigen::Index>(i)) = mesh.nodes[nodes[i]];
    const Eigen::VectorXd share = load(x);
    for (std::size_t i = 0; i < nodes.size(); ++i) f.segment<2>(2 * nodes[i]) += share.segment<2>(2 * static_cast<Eigen::Index>(i));
  }
  return f;
}

}  // namespace pintle::patch
