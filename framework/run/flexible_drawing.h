#pragma once

#include <optional>

#include "framework/component/modal_model.h"
#include "framework/run/elastic_body.h"
#include "framework/run/vtk.h"

namespace pintle {

/// Where a flexible body is and how it is bent: its coordinates and speeds.
struct FlexiblePose {
  Eigen::Vector2d r, v;        ///< mass centre of the undeformed body, world axes [m], [m/s]
  double angle = 0, w = 0;     ///< of the frame [rad], [rad/s]
  Eigen::VectorXd eta, speed;  ///< modal coordinates and their rates, n
};

/// A flexible body of a mechanism as it is drawn: a plate as its own mesh, a beam as a ribbon as high
/// as its sections. All fields are linear in the modal coordinates; this is where the shapes at all
/// nodes live on, and only if frames are asked for.
class FlexibleDrawing {
 public:
  /// @param centre  mass centre in body axes [m]
  FlexibleDrawing(const ElasticBody&, const ModalModel&, const Eigen::Vector2d& centre);
  /// The frame's grid: drawn points (deformation times `exaggeration`), with fields
  /// `displacement [m]` (true, world axes), `velocity [m/s]`, `von Mises [Pa]`, `principal 1 [Pa]`,
  /// `principal 2 [Pa]`; of beams also `section force [N]` (N, V) and `section moment [N m]`.
  DrawnBody at(const FlexiblePose&, double exaggeration) const;
  double largest_displacement(const Eigen::VectorXd& eta) const;  ///< [m]
  double size() const;                                            ///< diagonal of the body [m]
};

/// Stress of a named point while a mechanism runs: a few rows times the modal coordinates.
struct StressProbe {
  bool beam = false;
  Eigen::MatrixXd rows;  ///< plates: [σx σy τxy σz] [Pa], 4 × n; beams: [N V M] [N, N, N m], 3 × n
  double A = 0, I = 0, distance = 0;  ///< of a beam's section there [m², m⁴, m]
};
/// @throws SceneError  there is no such port; a point of a hole, where there is no material
StressProbe stress_probe(const Scene&, const ElasticBody&, const ModalModel&, const PointRef&);

}  // namespace pintle
