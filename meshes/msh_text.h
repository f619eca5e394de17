#pragma once

#include <string>
#include <string_view>

namespace pintle {

/// Checks for errors that Gmsh ignores in a .msh text file of version 2 or 4.1: a number used for two nodes or two elements, an invalid
/// coordinate, more or fewer nodes or elements than their count. Other versions are left to Gmsh.
/// @param name  of the file, for messages
/// @throws std::invalid_argument  naming the line
void validate_msh(const std::string& name, std::string_view text);

}  // namespace pintle
