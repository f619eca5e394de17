#pragma once

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "elements/line.h"
#include "elements/plane.h"

/// What the exam of the elements is written on: random elements of every size, and the test's own
/// way to integrate over them, which knows of an element its nodes and `shape` alone. Elements are
/// met behind matrices of any size, so that the exam is compiled once and not for each of them.
namespace pintle {

using Eigen::Matrix2d;
using Eigen::Matrix2Xd;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double within(double low, double high) { return low + (high - low) * static_cast<double>(random_()) / 4294967296.0; }
  double over_decades(double low, double high) { return low * std::pow(high / low, within(0, 1)); }
  MatrixXd matrix(int rows, int columns) {
    return MatrixXd::NullaryExpr(rows, columns, [this](Eigen::Index) { return within(-1, 1); });
  }

 private:
  std::mt19937 random_;
};

inline Matrix2d turn_by(double angle) {
  return (Matrix2d() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)).finished();
}
inline const Matrix2d Z = (Matrix2d() << 0, -1, 1, 0).finished();

// ---- elements of any kind ----

enum class Cell { line, triangle, quadrilateral };

/// What an element says of itself.
struct Traits {
  Cell cell;
  int nodes, dofs_per_node, points, stress_rows;
  int spurious_modes;
  bool turns() const { return dofs_per_node == 3; }  ///< its nodes have a rotation
  bool line() const { return cell == Cell::line; }
  int corners() const { return line() ? 2 : cell == Cell::triangle ? 3 : 4; }
  int dofs() const { return nodes * dofs_per_node; }
};

/// An element at a place: its answers.
struct Subject {
  Matrix2Xd x;
  MatrixXd stiffness, mass, skew_mass;
  VectorXd lumped_mass;
  std::function<MatrixXd(const Vector2d& xi)> shape;
  std::function<RowVectorXd(double xi)> rotation;  ///< of beams
  std::function<MatrixXd(const VectorXd& u)> stress;
  std::function<MatrixXd(const MatrixXd& s)> geometric_stiffness;
  Matrix2Xd points;  ///< of plane elements, reference cell
};

/// What it is made of. Mass is `density` times length or volume.
struct Stuff {
  double density = 0, rotary_density = 0;  ///< [kg/m or kg/m³], [kg m]
  double EA = 0, EI = 0, kGA = 0;          ///< of lines; kGA 0: no shear
  double thickness = 1;                    ///< of plane elements
  PlaneMaterial material{};
};

/// An element somewhere, and the same one with material and place turned, and then moved.
struct Sample {
  Traits is;
  Stuff stuff;
  Subject here, elsewhere;
  double angle, size;  ///< [rad], [m]
};

template <class E>
Traits traits() {
  Traits t{Cell::quadrilateral, E::nodes, E::dofs_per_node, E::points, E::stress_rows, 0};
  if (E::stress_rows == 3) t.cell = Cell::line;
  if (E::stress_rows == 4 && E::nodes % 3 == 0 && E::nodes != 9) t.cell = Cell::triangle;
  if constexpr (requires { E::spurious_modes; }) t.spurious_modes = E::spurious_modes;
  return t;
}

template <class E>
Subject subject(const E& e, const Matrix2Xd& place) {
  const Coords<E> x = place;
  Subject s{place, stiffness(e, x), mass(e, x), skew_mass(e, x), lumped_mass(e, x), {}, {}, {}, {}, {}};
  s.shape = [e, x](const Vector2d& xi) -> MatrixXd { return shape(e, x, xi); };
  s.stress = [e, x](const VectorXd& u) -> MatrixXd { return stress(e, x, NodalVector<E>(u)); };
  s.geometric_stiffness = [e, x](const MatrixXd& f) -> MatrixXd { return geometric_stiffness(e, x, Stress<E>(f)); };
  if constexpr (E::dofs_per_node == 3) s.rotation = [e, x](double xi) -> RowVectorXd { return rotation(e, x, xi); };
  if constexpr (E::stress_rows == 4) s.points = reference_points(e);
  return s;
}

/// Slender to stocky, stiff in shear to soft.
inline Stuff line_stuff(Draw& draw, double size) {
  const double young = draw.over_decades(1e3, 1e11), density = draw.over_decades(1, 1e4);
  const double h = size * draw.over_decades(0.005, 0.3), A = h * size * draw.within(0.01, 0.3);
  return {.density = density * A,
          .rotary_density = density * A * h * h / 12,
          .EA = young * A,
          .EI = young * A * h * h / 12,
          .kGA = young * A / draw.over_decades(2, 40)};
}
template <class E>
E line_element(Stuff& s) {
  E e{};
  e.EA = s.EA;
  e.rhoA = s.density;
  if constexpr (requires { e.EI; }) e.EI = s.EI;
  if constexpr (requires { e.kGA; })
    e.kGA = s.kGA;
  else
    s.kGA = 0;
  if constexpr (requires { e.rhoI; })
    e.rhoI = s.rotary_density;
  else
    s.rotary_density = 0;
  return e;
}
inline Orthotropic orthotropic(Draw& draw) {
  const double young = draw.over_decades(1e3, 1e11);
  return {.young_1 = young,
          .young_2 = young * draw.within(0.3, 3),
          .poisson_12 = draw.within(-0.2, 0.35),
          .shear_12 = young * draw.within(0.1, 0.6),
          .angle = draw.within(-3, 3),
          .young_3 = young * draw.within(0.5, 2),
          .poisson_13 = draw.within(0, 0.3),
          .poisson_23 = draw.within(0, 0.3)};
}

/// An element of the given size and its turned twin.
template <class E>
Sample sample(Draw& draw, const Matrix2Xd& x, double size, PlaneState state) {
  Sample s{traits<E>(), {}, {}, {}, draw.within(-3, 3), size};
  const Matrix2Xd moved = (turn_by(s.angle) * x).colwise() + Vector2d(size * draw.matrix(2, 1));
  if constexpr (E::stress_rows == 3) {
    s.stuff = line_stuff(draw, size);
    const E e = line_element<E>(s.stuff);
    s.here = subject(e, x);
    s.elsewhere = subject(e, moved);
  } else {
    Orthotropic solid = orthotropic(draw);
    const double density = draw.over_decades(1, 1e4), thickness = size * draw.within(0.01, 1);
    s.stuff.density = density;
    s.stuff.thickness = thickness;
    s.stuff.material = plane_material({solid, density}, state);
    s.here = subject(E{{s.stuff.material, density, thickness}}, x);
    solid.angle += s.angle;
    s.elsewhere = subject(E{{plane_material({solid, density}, state), density, thickness}}, moved);
  }
  return s;
}

// ---- cells ----

/// Nodes in the reference cell, in the order that plane.h promises; a line's on [0, 1].
inline Matrix2Xd reference_nodes(const Traits& is) {
  Matrix2Xd xi = Matrix2Xd::Zero(2, is.nodes);
  const int n = is.corners();
  if (is.line()) xi.row(0) << 0, 1;
  if (is.cell == Cell::triangle) xi.leftCols(3) << 0, 1, 0, 0, 0, 1;
  if (is.cell == Cell::quadrilateral) xi.leftCols(4) << -1, 1, 1, -1, -1, -1, 1, 1;
  for (int i = 0; i < n && is.nodes > 4; ++i) xi.col(n + i) = (xi.col(i) + xi.col((i + 1) % n)) / 2;
  return xi;
}

enum class Sides { parallel, straight, curved };

/// The reference cell sheared, or a cell of side 1 or 2 that keeps a positive Jacobian: corners
/// move by an eighth of a side, nodes on curved sides and in the middle by a twentieth.
inline Matrix2Xd distorted_cell(const Traits& is, Draw& draw, Sides sides) {
  Matrix2Xd x = reference_nodes(is);
  if (is.line()) return x * draw.within(0.5, 2);
  if (sides == Sides::parallel) return x + 0.3 * draw.matrix(2, 2) * x;
  const int n = is.corners();
  const double side = n == 3 ? 1 : 2;
  x.leftCols(n) += side / 8 * draw.matrix(2, n);
  for (int i = 0; i < n && is.nodes > 4; ++i) x.col(n + i) = (x.col(i) + x.col((i + 1) % n)) / 2;
  if (is.nodes == 9) x.col(8) = x.leftCols(4).rowwise().mean();
  if (sides == Sides::curved) x.rightCols(is.nodes - n) += side / 20 * draw.matrix(2, is.nodes - n);
  return x;
}

/// Three of each size from 1 mm to 1 km, at most three times their size from the origin; of plane
/// elements two in plane stress, one in plane strain.
template <class E>
std::vector<Sample> samples(Sides sides) {
  Draw draw(5);
  std::vector<Sample> all;
  for (int decade = -3; decade <= 3; ++decade)
    for (int n = 0; n < 3; ++n) {
      const double size = std::pow(10.0, decade);
      const Matrix2d placed = size * turn_by(draw.within(-3, 3));
      const Vector2d at = 2 * size * draw.matrix(2, 1);
      const Matrix2Xd x = (placed * distorted_cell(traits<E>(), draw, sides)).colwise() + at;
      all.push_back(sample<E>(draw, x, size, n == 1 ? PlaneState::strain : PlaneState::stress));
    }
  return all;
}

// ---- the test's own integration ----

struct Rule {
  Matrix2Xd xi;
  VectorXd weight;
};

/// Gauss's points and weights on [0, 1], by Newton on Legendre's polynomial.
inline std::vector<std::pair<double, double>> gauss(int n) {
  std::vector<std::pair<double, double>> points;
  for (int i = 0; i < n; ++i) {
    double z = std::cos(M_PI * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 20; ++iteration) {
      double p = 1, before = 0;
      for (int k = 0; k < n; ++k) before = std::exchange(p, ((2 * k + 1) * z * p - k * before) / (k + 1));
      slope = n * (z * p - before) / (z * z - 1);
      z -= p / slope;
    }
    points.emplace_back((1 + z) / 2, 1 / ((1 - z * z) * slope * slope));
  }
  return points;
}

/// Exact to degree 15 on lines and in either direction of a quadrilateral, 14 on triangles.
inline Rule fine_rule(const Traits& is) {
  const auto line = gauss(8);
  const auto n = static_cast<Eigen::Index>(line.size());
  Rule rule{Matrix2Xd::Zero(2, is.line() ? n : n * n), VectorXd(is.line() ? n : n * n)};
  Eigen::Index at = 0;
  for (const auto& [a, w] : line) {
    if (is.line()) {
      rule.xi(0, at) = a;
      rule.weight[at++] = w;
      continue;
    }
    for (const auto& [b, v] : line) {
      if (is.cell == Cell::triangle) {  // the square folded onto the triangle
        rule.xi.col(at) << a * (1 - b), b;
        rule.weight[at++] = w * v * (1 - b);
      } else {
        rule.xi.col(at) << 2 * a - 1, 2 * b - 1;
        rule.weight[at++] = 4 * w * v;
      }
    }
  }
  return rule;
}

/// A plane element's own points, with the weights that integrate as many monomials as there are
/// points: the lowest by total degree on a triangle, by degree in either direction on a square.
inline Rule own_rule(const Sample& s) {
  const Rule fine = fine_rule(s.is);
  const Matrix2Xd& xi = s.here.points;
  const Eigen::Index P = xi.cols();
  MatrixXd value(P, P);
  VectorXd integral(P);
  Eigen::Index row = 0;
  const auto add = [&](int a, int b) {
    value.row(row) = xi.row(0).array().pow(a) * xi.row(1).array().pow(b);
    integral[row++] = (fine.xi.row(0).array().pow(a) * fine.xi.row(1).array().pow(b)).matrix().dot(fine.weight);
  };
  const bool triangle = s.is.cell == Cell::triangle;
  for (int i = 0; (triangle ? i * (i + 1) / 2 : i * i) < P; ++i)
    for (int j = 0; j <= i; ++j) {
      add(triangle ? i - j : i, j);
      if (!triangle && j < i) add(j, i);
    }
  return {xi, value.partialPivLu().solve(integral)};
}

/// An element at one point: its field, the slopes of that, and the share of length or volume.
struct Point {
  Vector2d xi;
  MatrixXd N;
  std::array<MatrixXd, 2> slope;  ///< ∂N/∂x, ∂N/∂y; of a line ∂N/∂s and nothing
  double measure;                 ///< length [m], or volume [m³]
};

/// ∂N/∂ξ by differences, exact up to degree 4: `shape` is at most a cubic in each direction.
inline MatrixXd shape_slope(const Subject& e, const Vector2d& xi, int direction) {
  const Vector2d d = 0.25 * Vector2d::Unit(direction);
  return (8 * (e.shape(xi + d) - e.shape(xi - d)) - (e.shape(xi + 2 * d) - e.shape(xi - 2 * d))) / 3;
}

inline std::vector<Point> points_of(const Sample& s, const Rule& rule) {
  const Subject& e = s.here;
  std::vector<Point> points;
  for (Eigen::Index p = 0; p < rule.weight.size(); ++p) {
    const Vector2d xi = rule.xi.col(p);
    Point at{xi, e.shape(xi), {}, rule.weight[p]};
    const MatrixXd along = shape_slope(e, xi, 0);
    if (s.is.line()) {
      const double L = (e.x.col(1) - e.x.col(0)).norm();
      at.slope[0] = along / L;
      at.measure *= L;
    } else {
      const MatrixXd across = shape_slope(e, xi, 1);
      Matrix2d J;
      J << along * e.x.reshaped(), across * e.x.reshaped();
      const Matrix2d inverse = J.inverse();
      for (int k = 0; k < 2; ++k) at.slope[static_cast<std::size_t>(k)] = inverse(0, k) * along + inverse(1, k) * across;
      at.measure *= J.determinant() * s.stuff.thickness;
    }
    points.push_back(std::move(at));
  }
  return points;
}

}  // namespace pintle
