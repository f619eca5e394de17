#pragma once

#include <string>
#include <string_view>

namespace pintle {

/// What Gmsh passes over in a .msh file of version 2 or 4.1 in text: a number of two nodes or of two elements, a place that is no
/// number, more or fewer nodes or elements than their count. Other kinds of it are left to Gmsh.
/// @param name  of the file, for messages
/// @throws std::invalid_argument  naming the line
void validate_msh(const std::string& name, std::string_view text);

}  // namespace pintle
