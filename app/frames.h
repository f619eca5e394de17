#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "framework/drawing/vtk.h"

namespace pintle {

/// The files of one frame.
struct FrameFiles {
  double t;  ///< [s]
  std::filesystem::path lines;
  std::vector<std::filesystem::path> others;  ///< flexible bodies in the order of their parts, then what is of the whole run
};

/// Those of a run, as mechanism.pvd lists them, one at least.
/// @throws std::runtime_error  naming the file and what to do
std::vector<FrameFiles> frames_of(const std::filesystem::path& directory);

/// What FrameWriter::add was given, with the paths of the whole run among its lines.
/// @param deformation  of flexible bodies, to be drawn in place of that of the file
/// @throws std::runtime_error  not a frame of ours
Drawing read_frame(const FrameFiles&, std::optional<double> deformation = {});

/// A body of elements alone, as `modes`, `static` and `mesh` write it; fields on cells go to the points of theirs.
/// @throws std::runtime_error  the file cannot be read
DrawnBody read_body(const std::filesystem::path&);

}  // namespace pintle
