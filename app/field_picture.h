#pragma once

#include <filesystem>

#include "app/frame_picture.h"

namespace pintle {

/// Draws a field of a .vtu that `pintle modes`, `static` or `mesh` wrote: a vector by its length, in colour, with
/// a scale.
/// @throws std::invalid_argument  it has no such field (those it has); std::runtime_error  it cannot be read, or the picture not written
void write_field_picture(const std::filesystem::path& grid, PictureStyle, const std::filesystem::path& picture);

}  // namespace pintle
