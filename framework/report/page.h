#pragma once

#include <span>
#include <string>
#include <string_view>

namespace pintle {

/// Escapes text for use between HTML tags.
std::string html_text(std::string_view);
/// Escapes JSON for use in a <script>: no text in it ends the script or begins a comment.
std::string json_in_script(std::string json);
/// [RFC4648]
std::string base64(std::string_view bytes);
/// Numbers as in memory: little-endian IEEE 754.
std::string base64(std::span<const double>);
std::string base64(std::span<const float>);
std::string base64(std::span<const int>);

/// A page that needs no other file: the program of app/report/ with this data. It runs no other script.
std::string page(const std::string& title, std::string json);

}  // namespace pintle
