#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "framework/report/sheets.h"

namespace pintle {

/// How large a page may be.
struct ReportLimits {
  SheetLimits trajectory;
  std::size_t ledger = 30'000;   ///< numbers
  std::size_t events = 1500;     ///< rows, those of the greatest force
  std::size_t meshes = 750'000;  ///< bytes of flexible bodies and their shapes
  std::size_t text = 200'000;    ///< bytes of the scene
  std::size_t rows = 5000;       ///< of a table of settings or modes
};
/// Limits of pages up to about so many bytes, five million as they stand above.
ReportLimits report_limits(double bytes);

/// The results in a folder as one page that needs no other file: of `run`, `kinematics` or `inverse` the motion, of a sweep or another
/// question its table. A mechanism that moves is built again from the scene in the folder, so meshes and drawings that it names must be
/// where they were.
/// @throws ResultsError  a file is missing or damaged: names file, line, reason   @throws SceneError  the scene cannot be built
std::string report_page(const std::filesystem::path& directory, const ReportLimits& = {});

}  // namespace pintle
