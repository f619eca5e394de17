#pragma once

#include <filesystem>

#include "framework/run/vtk.h"

namespace pintle {

/// The file of a frame of a run, as mechanism.pvd lists it.
/// @param frame  counted from 0; from the end if negative   @param at  [s]; unless NaN, the frame
///               nearest to this time instead
/// @throws std::runtime_error  naming the file and the frames it has
std::filesystem::path frame_file(const std::filesystem::path& directory, int frame, double at);

/// What FrameWriter::add was given. @throws std::runtime_error  not a frame of ours
Drawing read_frame(const std::filesystem::path& file);

}  // namespace pintle
