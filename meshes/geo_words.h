#pragma once

#include <filesystem>
#include <string>

namespace pintle {

/// Adds to a message about a .geo script the line concerned and a remedy, if its text shows them: Gmsh names the line of a syntax error,
/// but not of a file that it cannot open, and a killed script reports nothing.
/// @param words  "FILE: what is wrong; what to do"
/// @param read_from  the folder whose files it may read
std::string with_line_of_script(const std::filesystem::path& file, const std::string& text, const std::string& words,
                                const std::filesystem::path& read_from);

}  // namespace pintle
