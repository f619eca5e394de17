#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/bodies/elastic_body.h"

namespace pintle {

/// A body of elements as it is drawn: a plate as its own mesh, a beam as a ribbon as high as its sections,
/// each element in pieces so that its cubic shows, with points at both edges and on the axis. Displacements and stresses of the drawn points are linear
/// in the nodal freedoms.
struct BodyDrawing {
  explicit BodyDrawing(const ElasticBody&);
  Eigen::Matrix2Xd displacement(const Eigen::VectorXd& u) const;  ///< of each point [m]
  /// [σx σy τxy σz] at each point, 4 × points [Pa]; of beams the stress along the axis stands in σx.
  Eigen::Matrix4Xd stress(const StressField&) const;
  Eigen::Matrix4Xd stress(const Eigen::VectorXd& u) const;  ///< of displacement u
  /// [N V M] of the section at each point of a beam, 3 × points [N, N, N m]; 3 × 0 of plates.
  Eigen::Matrix3Xd section_forces(const StressField&) const;

  Eigen::Matrix2Xd points;
  std::vector<Cells> cells;
  double size = 0;  ///< diagonal of the body [m]

 private:
  const ElasticBody& body_;
  Sparse D_;  ///< beams: 2·points × N
};

/// Every shape in one file: fields `mode 01 [mm]` and `von Mises 01 [Pa/mm]`, each scaled to a greatest displacement
/// of 1 mm.
void write_shapes(const std::filesystem::path& file, const BodyDrawing&, const Eigen::MatrixXd& shapes);

/// The animation of a shape: one period in `frames` frames, NAME.pvd and frames/NAME_00.vtu …, with the deformed
/// points drawn so that the greatest displacement is a tenth of the body's size. Fields are those of the
/// shape at its greatest displacement of 1 mm: `displacement [mm]`, `von Mises [Pa/mm]`, and `scale`, drawn over true.
void write_shape_animation(const std::filesystem::path& directory, const std::string& name, const BodyDrawing&,
                           const Eigen::VectorXd& shape, int frames);

}  // namespace pintle
