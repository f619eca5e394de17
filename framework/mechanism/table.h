#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace pintle {

/// Named columns over time.
struct Table {
  std::vector<std::string> header;  ///< "name [unit]"
  std::vector<double> data;         ///< row after row
  std::size_t columns() const { return header.size(); }
  std::size_t rows() const { return header.empty() ? 0 : data.size() / header.size(); }
  /// @throws std::out_of_range  no column of that name (including its unit)
  std::vector<double> column(const std::string& name) const;
};

/// The first line of a .csv file, and one of its rows, each with a line break.
std::string csv_heading(const Table&);
void append_csv_row(std::string& out, const Table&, std::size_t row);
/// A table as the text of a .csv file.
std::string csv(const Table&);
/// The same to a new file, row by row. @throws FileError
void write_csv(const std::filesystem::path&, const Table&);
}  // namespace pintle
