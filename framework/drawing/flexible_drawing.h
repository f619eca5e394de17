#pragma once

#include <string>
#include <vector>

#include "framework/bodies/elastic_body.h"
#include "framework/component/reduction/modal_model.h"
#include "framework/drawing/vtk.h"

namespace pintle {

/// Position and deformation of a flexible body: its coordinates and speeds.
struct FlexiblePose {
  Eigen::Vector2d r, v;        ///< mass centre of the undeformed body, world axes [m], [m/s]
  double angle = 0, w = 0;     ///< of the frame [rad], [rad/s]
  Eigen::VectorXd eta, speed;  ///< modal coordinates and their rates, n
};

/// A flexible body of a mechanism for drawing: a plate as its own mesh, a beam as a ribbon with the height of its sections. Displacement
/// and stress are linear in the modal coordinates; the shapes at all drawn points are stored here, and only if frames are requested.
/// Displacements are those of first order: foreshortening is not drawn.
class FlexibleDrawing {
 public:
  /// @param centre  mass centre in body axes [m]
  FlexibleDrawing(const ElasticBody&, const ModalModel&, const Eigen::Vector2d& centre);

  /// The body's grid: point x of the body, displaced by u in body axes, is drawn at
  ///   r + A(θ)(x − centre + exaggeration·u),
  /// with these fields, which are not exaggerated:
  ///
  /// | field                                | what |
  /// |--------------------------------------|---------------------------------------------------|
  /// | `displacement [m]`                   | A u                                               |
  /// | `velocity [m/s]`                     | v + w Z d + A u̇, d = A(x − centre + u)            |
  /// | `von Mises [Pa]`                     | of plates; of beams the magnitude of N/A ∓ M y/I  |
  /// | `principal 1 [Pa]`, `principal 2 [Pa]` | the larger and the smaller one in the plane     |
  /// | `section force [N]`                  | of beams: N along the axis and V across it        |
  /// | `section moment [N m]`               | of beams: M, stretching the right side if positive |
  DrawnBody at(const FlexiblePose&, double exaggeration) const;
  double largest_displacement(const Eigen::VectorXd& eta) const;  ///< of a drawn point [m]
  double size() const { return size_; }                           ///< diagonal of the body [m]

  const Eigen::Matrix2Xd& points() const { return x_; }  ///< from the mass centre, undeformed, body axes [m]
  const std::vector<Cells>& cells() const { return cells_; }
  const Eigen::MatrixXd& displacements() const { return u_; }  ///< [x y] of all points, one column per shape, body axes
  const Eigen::MatrixXd& stresses() const { return stress_; }  ///< [σx σy τxy σz] likewise

 private:
  std::string name_;
  Eigen::Matrix2Xd x_;  ///< drawn points from the mass centre, undeformed, body axes [m]
  std::vector<Cells> cells_;
  double size_;
  // One column per shape, with the drawn points stacked:
  Eigen::MatrixXd u_;       ///< displacement [x y], body axes
  Eigen::MatrixXd stress_;  ///< [σx σy τxy σz]; for beams σx is the stress along the axis
  Eigen::MatrixXd forces_;  ///< for beams: [N V M]
};

/// Stress of a named point during a run: a few rows times the modal coordinates. It is computed from displacement alone, without the
/// contribution of loads between a beam's nodes, such as its inertia: the error decreases with finer elements.
struct StressProbe {
  struct Side {
    /// Plates: [σx σy τxy σz] [Pa], 4 × n, the mean over the elements at the node. Beams: [N V M] [N, N, N m], 3 × n.
    Eigen::MatrixXd rows;
    double A = 0, I = 0, distance = 0;  ///< of a beam's section there [m²], [m⁴], [m]
  };
  bool beam = false;
  /// Beams: the elements that meet at the node, as section forces jump where something acts or the axis bends; their mean if nothing acts on
  /// a straight beam there. Plates: one.
  std::vector<Side> sides;
};
/// @throws SceneError  there is no such point; it is the origin of the axes or the middle of a hole, where there is no material
StressProbe stress_probe(const Scene&, const ElasticBody&, const ModalModel&, const PointRef&);

}  // namespace pintle
