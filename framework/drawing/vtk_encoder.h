#pragma once

#include <string>
#include <vector>

#include "framework/drawing/vtk.h"

namespace pintle {

/// Interface of the module `vtk` (meshes/module.h), which links VTK, for the files of single bodies: they are large, written once, and
/// compressed as strongly as zlib can. Frames are many and small, and are written without VTK (frame_text.h).
struct VtkEncoder {
  const char* version;
  /// The text of write_grid's file; nothing if VTK fails.
  std::string (*grid)(const Eigen::Matrix2Xd& points, const std::vector<Cells>&, const std::vector<Field>& on_points,
                      const std::vector<Field>& on_cells, double t);
};

}  // namespace pintle
