#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/bodies/elastic_body.h"

namespace pintle {

/// A body of elements for drawing: a plate as its own mesh, a beam as a ribbon with the height of its sections, with each element divided
/// into pieces to show its cubic, and points at both edges and on the axis. Displacements and stresses of the drawn points are linear in
/// the nodal dofs.
struct BodyDrawing {
  explicit BodyDrawing(const ElasticBody&);
  Eigen::Matrix2Xd displacement(const Eigen::VectorXd& u) const;  ///< of each point [m]
  /// [σx σy τxy σz] at each point, 4 × points [Pa]; for beams σx is the stress along the axis.
  Eigen::Matrix4Xd stress(const StressField&) const;
  Eigen::Matrix4Xd stress(const Eigen::VectorXd& u) const;  ///< for displacement u
  /// [N V M] of the section at each point of a beam, 3 × points [N, N, N m]; 3 × 0 for plates.
  Eigen::Matrix3Xd section_forces(const StressField&) const;

  Eigen::Matrix2Xd points;
  std::vector<Cells> cells;
  double size = 0;  ///< diagonal of the body [m]

 private:
  const ElasticBody& body_;
  Sparse D_;  ///< beams: 2·points × N
};

/// Writes all shapes to one file: fields `mode 01 [mm]` and `von Mises 01 [Pa/mm]`, each scaled to a largest displacement of 1 mm.
void write_shapes(const std::filesystem::path& file, const BodyDrawing&, const Eigen::MatrixXd& shapes);

/// Writes the animation of a shape: one period in `frames` frames, NAME.pvd and frames/NAME_00.vtu …, with the points displaced such that
/// the largest displacement is a tenth of the body's size. Fields are those of the shape at its largest displacement of 1 mm: `displacement
/// [mm]`, `von Mises [Pa/mm]`, and `scale`, the ratio of drawn to true displacement.
void write_shape_animation(const std::filesystem::path& directory, const std::string& name, const BodyDrawing&,
                           const Eigen::VectorXd& shape, int frames);

}  // namespace pintle
