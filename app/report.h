#pragma once

#include <filesystem>

namespace pintle::app {

/// Converts a folder of results into a page; replaces an older page of this name. @throws as report_page, FileError
void write_report(const std::filesystem::path& directory, const std::filesystem::path& file, double megabytes, bool quiet);

}  // namespace pintle::app
