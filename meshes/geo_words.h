#pragma once

#include <filesystem>
#include <string>

namespace pintle {

/// What was said of a .geo script, with the line that it is about and what to do about it, as far as both can be told from its
/// text: Gmsh names the line of a syntax error, but of no file that it cannot open, and a script that is ended says nothing.
/// @param words  "FILE: what is wrong; what to do"
/// @param read_from  the folder whose files it may read
std::string with_line_of_script(const std::filesystem::path& file, const std::string& text, const std::string& words,
                                const std::filesystem::path& read_from);

}  // namespace pintle
