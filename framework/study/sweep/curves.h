#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "framework/study/sweep/journal.h"

/// The curves that each case of a sweep keeps: files in `curves` of the sweep's folder. The case's row in the journal has their names and
/// fingerprints.
namespace pintle {

std::filesystem::path curves_in(const std::filesystem::path& folder);

/// @throws SceneError  something else has its name
void make_curves_folder(const std::filesystem::path& folder);

/// Writes the curves of a case and records them in its row.
/// @param curves  per situation, "" if there is none   @throws FileError   @throws SceneError  something else has the name of one
void write_curves(const std::map<std::string, std::string>& curves, const std::filesystem::path& folder, Row&);

/// The text of a curve, unchanged since its case wrote it.
/// @param noted  an entry of Row::curves
/// @throws FileRejected  it is missing, incomplete, changed or no ordinary file; the message ("is missing") does not name it
std::string read_curve(const std::filesystem::path& folder, const std::pair<const std::string, std::string>& noted);

/// The fault of the first faulty curve of a case, with its name: "FOLDER/curves/case-3.csv is missing". Empty: there is none.
std::string fault_of_curves(const std::filesystem::path& folder, const Row&);

/// Whether a case may have written a file of this name. @param name  without a folder
bool is_curve_of(std::size_t number, std::string_view name);

}  // namespace pintle
