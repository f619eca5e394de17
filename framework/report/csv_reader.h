#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace pintle {

/// A results file that cannot be read: names file, line and reason.
struct ResultsError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reads a .csv file of results record by record; memory does not depend on the number of rows.
class CsvReader {
 public:
  /// @throws ResultsError  it cannot be opened, or has no heading
  explicit CsvReader(std::filesystem::path file);
  const std::vector<std::string>& header() const { return header_; }
  /// The next record's fields, as many as in the heading. @returns false at the end   @throws ResultsError
  bool next(std::vector<std::string>& fields);
  /// The same as numbers; an empty field is NaN.
  bool next(std::vector<double>& row);
  double share_read();  ///< of the file, 0 to 1
  /// @throws ResultsError  always: about the last record read
  [[noreturn]] void fail(const std::string& why) const;

 private:
  bool read_record();
  void require_count(std::size_t fields) const;

  std::filesystem::path file_;
  std::ifstream in_;
  double bytes_ = 0;
  std::vector<std::string> header_;
  std::string record_;
  long line_ = 0, lines_ = 0;  ///< first line of the record; lines read
};

/// Number of lines after the heading. @throws ResultsError
std::size_t count_rows(const std::filesystem::path& file);

/// A column heading: "gudgeon pin.normal [N]".
struct ColumnName {
  std::string name, unit;
};
ColumnName column_name(const std::string& heading);

}  // namespace pintle
