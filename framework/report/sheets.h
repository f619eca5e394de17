#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/report/csv_reader.h"

namespace pintle {

/// Some columns at the same times.
struct Sheet {
  std::vector<ColumnName> columns;  ///< without the time
  std::vector<double> t;
  std::vector<std::vector<double>> values;  ///< a vector a column
};

/// A table of results as a page holds it. Every number in it stands in the file.
struct ReducedTable {
  std::size_t rows = 0;       ///< of the file
  bool whole = true;          ///< all of them are here, in one sheet
  std::vector<Sheet> sheets;  ///< else each column for itself: of every stretch of rows its least and greatest value
  Sheet poses;                ///< then some columns at evenly spaced rows, for drawing; else empty
};

/// How many numbers a table may keep.
struct SheetLimits {
  std::size_t values = 220'000, poses = 60'000;
};

/// Reads a .csv file whose first column is the time.
/// @param drawn  names of columns, without units, that poses are made of   @throws ResultsError
ReducedTable reduced_by_column(const std::filesystem::path&, const SheetLimits&, const std::vector<std::string>& drawn);

/// The same in one sheet: of every stretch the rows in which some column is least or greatest, whole.
ReducedTable reduced_by_row(const std::filesystem::path&, std::size_t most_values);

}  // namespace pintle
