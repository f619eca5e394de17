#pragma once

#include <span>
#include <string>
#include <string_view>

namespace pintle {

/// Text between tags of HTML.
std::string html_text(std::string_view);
/// JSON as it may stand inside a <script>: no text in it ends the script or begins a comment.
std::string json_in_script(std::string json);
/// [RFC4648]
std::string base64(std::string_view bytes);
/// Numbers as they lie in memory: little-endian IEEE 754.
std::string base64(std::span<const double>);
std::string base64(std::span<const float>);
std::string base64(std::span<const int>);

/// A page that needs no other file: the program of app/report/ with this data. It runs no script but that one.
std::string page(const std::string& title, std::string json);

}  // namespace pintle
