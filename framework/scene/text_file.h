#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace pintle {

/// Reads a complete text file. Checks beforehand that it is an ordinary file, not empty, of at most `most_bytes`; then that it is text
/// (UTF-8, no zero bytes).
/// @param key  where the scene names the file, for the message; empty for the scene itself
/// @throws SceneError  naming the file and the remedy
std::string read_text_file(const std::filesystem::path&, std::size_t most_bytes, const std::string& key = {});

/// Line of the first byte that is not UTF-8 text, 1-based; 0 if there is none.
int line_not_text(const std::string&);

}  // namespace pintle
