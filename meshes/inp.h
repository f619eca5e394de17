#pragma once

#include <filesystem>

#include "meshes/mesh.h"

namespace pintle {

/// A CalculiX or Abaqus input file: *NODE, *ELEMENT of plane kinds (CPS3, CPE6, S4, C2D8 …; second-order
/// too), *NSET and *ELSET with GENERATE, and surfaces of element sides. Node sets and element sets become
/// groups. Everything else (materials, steps) is passed over. Lengths in m times `scale`.
/// @throws std::runtime_error     the file cannot be read
/// @throws std::invalid_argument  file:line: what is wrong there and what would be right
Mesh read_inp(const std::filesystem::path&, double scale = 1);

}  // namespace pintle
