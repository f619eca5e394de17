#pragma once

#include <string_view>

/// The page of app/view/, embedded into pintle-view by the build (cmake/embed.cmake).
namespace pintle::page_parts {

extern const std::string_view view_page, view_style, view_script;

}  // namespace pintle::page_parts
