#pragma once

#include <filesystem>
#include <string>

namespace pintle {

/// Draws a field of a .vtu that `pintle modes`, `static` or `mesh` wrote: a vector by its length, in colour, with
/// a scale.
/// @throws std::runtime_error  the file cannot be read, it has no such field (those it has), or the picture cannot be written
void write_field_picture(const std::filesystem::path& grid, const std::string& field, int width, const std::filesystem::path& picture);

}  // namespace pintle
