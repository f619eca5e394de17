#pragma once

#include <filesystem>

namespace pintle::app {

/// Turns a folder of results into a page; an older page of that name is replaced. @throws as report_page, FileError
void write_report(const std::filesystem::path& directory, const std::filesystem::path& file, double megabytes);

}  // namespace pintle::app
