#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/drawing/vtk.h"
#include "framework/drawing/vtu_text.h"

namespace pintle {

/// Cells of a body, the same in each of its frames, prepared for their files.
struct PackedCells {
  explicit PackedCells(const std::vector<Cells>&);
  std::size_t size = 0;
  VtuText::Packed connectivity, offsets, types;
};

// Files of an animation as text; the fields are described in framework/drawing/vtk.h.
std::string lines_text(const Drawing&);
std::string body_text(const DrawnBody&, double t, double deformation, const PackedCells&);
/// A vertex for each impact, at its point.
std::string impacts_text(const Eigen::Matrix2Xd& points, const std::vector<DrawnImpact>&, const std::vector<std::string>& names);

}  // namespace pintle
