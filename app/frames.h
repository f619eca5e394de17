#pragma once

#include <filesystem>
#include <vector>

#include "framework/drawing/vtk.h"

namespace pintle {

/// The files of one frame.
struct FrameFiles {
  std::filesystem::path lines;
  std::vector<std::filesystem::path> bodies;  ///< flexible ones, in the order of their parts
};

/// Those of a run, as mechanism.pvd lists them.
/// @param frame  counted from 0; from the end if negative   @param at  [s]; unless NaN, the frame
///               nearest to this time instead
/// @throws std::runtime_error  naming the file and the frames it has
FrameFiles frame_files(const std::filesystem::path& directory, int frame, double at);

/// What FrameWriter::add was given. @throws std::runtime_error  not a frame of ours
Drawing read_frame(const FrameFiles&);

}  // namespace pintle
