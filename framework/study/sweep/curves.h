#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "framework/study/sweep/journal.h"

/// The curves that each case of a sweep keeps, files in `curves` of its folder. Its row in the journal knows their names and fingerprints.
namespace pintle {

std::filesystem::path curves_in(const std::filesystem::path& folder);

/// Writes the curves of a case, and notes them in its row.
/// @param curves  by situation, "" without any  @throws FileError
void write_curves(const std::map<std::string, std::string>& curves, const std::filesystem::path& folder, Row&);

/// The text of a curve, as its case wrote it.
/// @param noted  an entry of Row::curves
/// @throws FileRefused  it is missing, torn or changed, or no ordinary file: "is missing". Without its name
std::string read_curve(const std::filesystem::path& folder, const std::pair<const std::string, std::string>& noted);

/// What is wrong with the first faulty curve of a case, with its name: "FOLDER/curves/case-3.csv is missing". Empty: nothing.
std::string fault_of_curves(const std::filesystem::path& folder, const Row&);

/// Whether a case may have written a file of this name, which has no folder in it.
bool is_curve_of(std::size_t number, std::string_view name);

}  // namespace pintle
