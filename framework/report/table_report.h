#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "framework/report/description.h"

namespace pintle {

/// Whether the folder has such tables.
bool has_table_page(const std::filesystem::path& directory);

/// The tables of these results. @param most_rows  as below   @throws ResultsError
nlohmann::ordered_json tables_json(const Description&, std::size_t most_rows);

/// The tables of a `sweep`, `fit`, `sensitivity`, `nonlinear`, `tradeoff`, `linearize` or `modes` as one page, also the cases so far of a sweep that was stopped;
/// nothing if the folder has none.
/// @param most_rows  of a longer table, evenly spaced rows are kept, and those with the least or greatest value of a column
/// @throws ResultsError
std::optional<std::string> table_page(const std::filesystem::path& directory, std::size_t most_rows, std::size_t most_text);

}  // namespace pintle
