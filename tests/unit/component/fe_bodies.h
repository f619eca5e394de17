#pragma once

#include "elements/material.h"
#include "framework/component/fe/fe_model.h"
#include "framework/component/fe/from_mesh.h"
#include "framework/component/fe/statics.h"
#include "meshes/mesh.h"
#include "tests/refusal.h"

#include <Eigen/Core>

#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Small bodies for the tests of models, statics and modes, meshed by hand.
namespace pintle {

/// A rectangle of nx × ny cells carried onto a body by `map`, from [0, 1]²; its edges as sides with
/// the body on their left.
struct Plate {
  Mesh mesh;
  std::map<std::string, std::vector<Cells>> edge;  ///< "bottom", "right", "top", "left"
  std::map<std::string, std::vector<int>> nodes;   ///< along them, in order of the sides
};
using Map = std::function<Eigen::Vector2d(double, double)>;

/// Nodes lie on a lattice of half cells, so that second-order cells have their middles on the map.
/// `closed`: left and right edge are one, as in a ring.
inline Plate plate(int nx, int ny, CellShape shape, const Map& map, bool closed = false) {
  const bool second = shape != CellShape::triangle3 && shape != CellShape::quadrilateral4;
  const bool triangles = corners_of(shape) == 3;
  const bool centers = triangles || shape == CellShape::quadrilateral9;
  const int columns = closed ? 2 * nx : 2 * nx + 1;
  std::vector<int> number(static_cast<std::size_t>(columns * (2 * ny + 1)), -1);
  std::vector<Eigen::Vector2d> x;
  const auto node = [&](int i, int j) -> int& { return number[static_cast<std::size_t>((i % columns) + columns * j)]; };
  for (int j = 0; j <= 2 * ny; ++j)
    for (int i = 0; i < columns; ++i) {
      const int odd = i % 2 + j % 2;
      if (odd > 0 && !second) continue;
      if (odd == 2 && !centers) continue;
      node(i, j) = static_cast<int>(x.size());
      x.push_back(map(0.5 * i / nx, 0.5 * j / ny));
    }
  Plate made;
  made.mesh.x.resize(2, static_cast<Eigen::Index>(x.size()));
  for (std::size_t k = 0; k < x.size(); ++k) {
    made.mesh.x.col(static_cast<Eigen::Index>(k)) = x[k];
    made.mesh.node_numbers.push_back(static_cast<long>(k) + 1);
  }
  Cells cells{shape, {}, {}};
  using Place = std::pair<int, int>;
  const auto add = [&](std::vector<Place> corners, const Place* center) {
    const std::size_t n = corners.size();
    for (const auto& [i, j] : corners) cells.nodes.push_back(node(i, j));
    for (std::size_t k = 0; second && k < n; ++k) {
      const auto [i, j] = corners[k];
      const auto [p, q] = corners[(k + 1) % n];
      cells.nodes.push_back(node((i + p) / 2, (j + q) / 2));
    }
    if (center) cells.nodes.push_back(node(center->first, center->second));
    cells.numbers.push_back(static_cast<long>(cells.numbers.size()) + 1);
  };
  for (int j = 0; j < 2 * ny; j += 2)
    for (int i = 0; i < 2 * nx; i += 2) {
      const Place a{i, j}, b{i + 2, j}, c{i + 2, j + 2}, d{i, j + 2}, center{i + 1, j + 1};
      if (triangles) {
        add({a, b, c}, nullptr);
        add({a, c, d}, nullptr);
      } else {
        add({a, b, c, d}, shape == CellShape::quadrilateral9 ? &center : nullptr);
      }
    }
  made.mesh.cells.push_back(cells);
  const auto add_edge = [&](const char* name, Place at, Place step, int count) {
    Cells sides{second ? CellShape::line3 : CellShape::line2, {}, {}};
    std::vector<int>& along = made.nodes[name];
    for (int k = 0; k < count; ++k) {
      const auto next = [&](int h) { return node(at.first + h * step.first, at.second + h * step.second); };
      along.push_back(next(0));
      sides.nodes.insert(sides.nodes.end(), {next(0), next(2)});
      if (second) {
        along.push_back(next(1));
        sides.nodes.push_back(next(1));
      }
      if (k + 1 == count && !(closed && step.second == 0)) along.push_back(next(2));
      sides.numbers.push_back(k + 1);
      at = {at.first + 2 * step.first, at.second + 2 * step.second};
    }
    made.edge[name] = {sides};
  };
  const int reach = closed ? 4 * nx : 2 * nx;  // stays positive while walking back round a ring
  add_edge("bottom", {0, 0}, {1, 0}, nx);
  add_edge("top", {reach, 2 * ny}, {-1, 0}, nx);
  if (!closed) {
    add_edge("right", {2 * nx, 0}, {0, 1}, ny);
    add_edge("left", {0, 2 * ny}, {0, -1}, ny);
  }
  return made;
}

/// Rectangle from (0, 0), its inner lattice bent so that no cell is a rectangle.
inline Map bent_rectangle(double length, double height) {
  return [=](double s, double t) {
    const double bump = 0.06 * std::sin(M_PI * s) * std::sin(M_PI * t);
    return Eigen::Vector2d(length * (s + bump), height * (t - 0.7 * bump));
  };
}
inline Map rectangle(double length, double height) {
  return [=](double s, double t) { return Eigen::Vector2d(length * s, height * t); };
}
/// Ring or sector between two radii about `center`; s runs clockwise from `from` over `angle`, so
/// that cells run counter-clockwise and "bottom" is the hole's rim.
inline Map ring(double inner, double outer, double from, double angle, Eigen::Vector2d center = Eigen::Vector2d::Zero(),
                double grading = 1) {
  return [=](double s, double t) -> Eigen::Vector2d {
    const double r = inner + (outer - inner) * std::pow(t, grading), a = from - angle * s;
    return center + r * Eigen::Vector2d(std::cos(a), std::sin(a));
  };
}

inline PlaneProperties steel(PlaneState state, double poisson = 0.3) {
  return {plane_material({Isotropic{2e11, poisson}, 7800}, state), 7800, 0.01};
}

inline FeModel model_of(const Plate& p, const PlaneProperties& properties, std::string_view element = "") {
  return fe_model(p.mesh.x, plane_blocks(p.mesh, properties, element));
}

/// What an error of this type says, thrown by `act`.
template <class Error = std::invalid_argument>
std::string refusal(const std::function<void()>& act) {
  return pintle_test::refusal_by<Error>(act);
}
using pintle_test::says;

/// Elements of one kind in a row from `from` to `to`.
template <class E>
FeModel chain(const E& e, int count, const Eigen::Vector2d& from, const Eigen::Vector2d& to, std::vector<Lump> lumps = {}) {
  Eigen::Matrix2Xd x(2, count + 1);
  Block<E> block{{e}, {}, {}};
  for (int i = 0; i <= count; ++i) x.col(i) = from + (to - from) * i / count;
  for (int i = 0; i < count; ++i) {
    block.nodes.insert(block.nodes.end(), {i, i + 1});
    block.cells.push_back(i);
  }
  return fe_model(x, {block}, std::move(lumps));
}

/// Quarter of a ring, from the y axis to the x axis, held by symmetry.
struct Quarter {
  Plate plate;
  FeModel model;
  Supports supports;
  double thickness;

  Quarter(double inner, double outer, int round, int across, CellShape shape, PlaneState state, double grading = 1)
      : plate(pintle::plate(round, across, shape, ring(inner, outer, M_PI / 2, M_PI / 2, {0, 0}, grading))),
        model(model_of(plate, steel(state))),
        thickness(steel(state).thickness) {
    for (const int i : plate.nodes["left"]) hold(supports, model, i, true, false, false);
    for (const int i : plate.nodes["right"]) hold(supports, model, i, false, true, false);
  }
};

inline Eigen::VectorXd random_vector(Eigen::Index size, unsigned seed) {
  std::mt19937 random(seed);
  Eigen::VectorXd v(size);
  for (double& value : v) value = static_cast<double>(random()) / 2147483648.0 - 1;
  return v;
}

}  // namespace pintle
