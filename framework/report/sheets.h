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
  std::vector<std::vector<double>> values;  ///< one vector per column
};

/// A table of results for a page. Every number in it is from the file.
struct ReducedTable {
  std::size_t rows = 0;       ///< of the file
  bool whole = true;          ///< all of them are included, in one sheet
  std::vector<Sheet> sheets;  ///< otherwise one per column: the least and greatest value of each stretch of rows, and an empty one of a gap
  Sheet poses;                ///< in that case, some columns at evenly spaced rows, for drawing; otherwise empty
};

/// Limits of the numbers kept of a table.
struct SheetLimits {
  std::size_t values = 220'000, poses = 60'000;
};

/// Part of the work that reading a file is, for work_done.
struct WorkShare {
  double begin = 0, end = 1;
};

/// Reads a .csv file whose first column is the time.
/// @param drawn  names of columns, without units, for the positions drawn   @throws ResultsError
ReducedTable reduced_by_column(const std::filesystem::path&, const SheetLimits&, const std::vector<std::string>& drawn,
                               const WorkShare& = {});

/// The same in one sheet, of the complete rows in which a column has its least or greatest value of a stretch.
ReducedTable reduced_by_row(const std::filesystem::path&, std::size_t most_values, const WorkShare& = {});

/// A file with the columns quantity and value, as a table of one row. @throws ResultsError
ReducedTable single_row(const std::filesystem::path&);

/// A file with the columns mode and phase, as one table: in a period of mode k, counted from 0, the time runs from 2k to 2k + 1.
ReducedTable mode_motions(const std::filesystem::path&);

}  // namespace pintle
