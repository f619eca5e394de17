#pragma once

#include <filesystem>

class vtkRenderWindow;

namespace pintle {

/// What a window shows, after Render. @throws std::runtime_error  the file cannot be written
void write_png(vtkRenderWindow*, const std::filesystem::path&);

}  // namespace pintle
