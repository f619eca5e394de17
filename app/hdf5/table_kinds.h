#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pintle::app {

/// Told the number of rows read. @returns false: stop
using RowsRead = std::function<bool(std::size_t)>;

/// What a first reading of a table finds.
struct TableKinds {
  std::size_t rows = 0;
  std::vector<bool> text;  ///< by column: by its nature, or some field is not a number
};

/// Nothing if it was stopped. @throws ResultsError
std::optional<TableKinds> table_kinds(const std::filesystem::path& file, const RowsRead&);

/// A field as Pintle writes numbers: an empty one is NaN. Nothing if it is text.
std::optional<double> number_in(const std::string& field);

/// Names for links of a group: '/' becomes '_', and so does a name that is empty or "."; a name that was there gets a number ("a_2").
std::vector<std::string> link_names(const std::vector<std::string>&);

}  // namespace pintle::app
