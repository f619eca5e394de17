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
  std::vector<std::filesystem::path> others;  ///< flexible bodies in the order of their parts, then files of the whole run
};

/// The frames of a run listed in mechanism.pvd, at least one.
/// @throws std::runtime_error  naming the file and the remedy
std::vector<FrameFiles> frames_of(const std::filesystem::path& directory);

/// The drawing that was passed to FrameWriter::add, with the paths of the whole run among its lines.
/// @param deformation  factor for flexible bodies, replacing that in the file
/// @throws std::runtime_error  not a frame written by this program
Drawing read_frame(const FrameFiles&, std::optional<double> deformation = {});

/// An impact of the run, where it was.
struct PlacedImpact {
  Eigen::Vector2d at;    ///< [m]
  double t, peak_force;  ///< [s], [N]
};
/// All impacts of the run, from any of its frames. @throws std::runtime_error  they cannot be read
std::vector<PlacedImpact> read_impacts(const FrameFiles&);

/// A single body of elements, as written by `modes`, `static` and `mesh`; fields on cells are assigned to their points.
/// @throws std::runtime_error  the file cannot be read
DrawnBody read_body(const std::filesystem::path&);

}  // namespace pintle
