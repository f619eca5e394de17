#pragma once

#include <string>
#include <vector>

#include "framework/drawing/vtk.h"

namespace pintle {

/// What the module `vtk` offers (meshes/module.h), the one that links VTK: the files of single bodies, which are large, written once, and
/// packed as small as zlib makes them. Frames, many and small, are written without VTK (frame_text.h).
struct VtkEncoder {
  const char* version;
  /// The text of write_grid's file; nothing if VTK fails.
  std::string (*grid)(const Eigen::Matrix2Xd& points, const std::vector<Cells>&, const std::vector<Field>& on_points,
                      const std::vector<Field>& on_cells, double t);
};

}  // namespace pintle
