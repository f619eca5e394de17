#pragma once

#include <string_view>

/// The files of app/report/, embedded into the program by the build (cmake/embed.cmake).
namespace pintle::page_parts {

extern const std::string_view notice, style, body, script;

}  // namespace pintle::page_parts
