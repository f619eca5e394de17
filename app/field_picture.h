#pragma once

#include <filesystem>

#include "app/frame_picture.h"

namespace pintle {

/// Draws a field of a .vtu written by `pintle modes`, `static` or `mesh`: a vector by its magnitude, in colour, with a scale.
/// @throws std::invalid_argument  it has no such field (lists the existing ones); std::runtime_error  it cannot be read, or the picture
/// cannot be written
PictureSize write_field_picture(const std::filesystem::path& grid, PictureStyle, const std::filesystem::path& picture);

}  // namespace pintle
