#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "framework/report/sheets.h"

namespace pintle {

/// Limits of the size of a page.
struct ReportLimits {
  SheetLimits trajectory;
  std::size_t ledger = 30'000;   ///< numbers
  std::size_t events = 1500;     ///< rows, those with the largest force
  std::size_t meshes = 750'000;  ///< bytes of flexible bodies and their shapes
  std::size_t text = 200'000;    ///< bytes of the scene
  std::size_t rows = 5000;       ///< of a table of settings or modes
};
/// Limits for pages of about `bytes`; the defaults above correspond to five million.
ReportLimits report_limits(double bytes);

/// The results in a folder as one page that needs no other file: the motion for `run`, `kinematics` or `inverse`, the table for a sweep or
/// another analysis. A moving mechanism is built again from the scene in the folder, so meshes and drawings that it names must be where
/// they were.
/// @throws ResultsError  a file is missing or damaged: names file, line, reason   @throws SceneError  the scene cannot be built
std::string report_page(const std::filesystem::path& directory, const ReportLimits& = {});

}  // namespace pintle
