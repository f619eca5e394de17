#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pintle::app {

/// Called with the number of rows read and the share of the file. @returns false: stop
using RowsRead = std::function<bool(std::size_t, double)>;

/// Result of the first reading of a table.
struct TableKinds {
  std::size_t rows = 0;
  std::vector<bool> text;  ///< by column: always text, or some field is not a number
};

/// Nothing if it was stopped. @throws ResultsError
std::optional<TableKinds> table_kinds(const std::filesystem::path& file, const RowsRead&);

/// The number in a field, as Pintle writes numbers; NaN if it is empty. Nothing if it is text.
std::optional<double> number_in(const std::string& field);

/// Names for links of a group: '/' becomes '_', and so does a name that is empty or "."; a repeated name gets a number ("a_2").
std::vector<std::string> link_names(const std::vector<std::string>&);

}  // namespace pintle::app
