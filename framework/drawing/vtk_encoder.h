#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/drawing/vtk.h"

namespace pintle {

/// What the module `vtk` offers (meshes/module.h), the one that links VTK: .vtu files as text, fields as
/// framework/drawing/vtk.h says. Nothing comes back if VTK fails.
struct VtkEncoder {
  const char* version;
  std::string (*lines)(const Drawing&);
  /// A vertex for each impact, at its point.
  std::string (*impacts)(const Eigen::Matrix2Xd& points, const std::vector<DrawnImpact>&, const std::vector<std::string>& names);
  std::string (*grid)(const Eigen::Matrix2Xd& points, const std::vector<Cells>&, const std::vector<Field>& on_points,
                      const std::vector<Field>& on_cells, double t);
  /// @param cells  of the body as VTK keeps them: made if there is nothing yet, for the frames that follow
  std::string (*body)(const DrawnBody&, double t, double deformation, std::shared_ptr<void>& cells);
};

}  // namespace pintle
