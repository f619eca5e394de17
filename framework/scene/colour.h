#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Colours in pictures, by their CSS names or as #rrggbb.
namespace pintle {

/// Red, green, blue. Nothing for a text that is not a colour.
std::optional<std::array<unsigned char, 3>> rgb_of(std::string_view text);
std::vector<std::string> colour_names();

}  // namespace pintle
