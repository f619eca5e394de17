#include "framework/mechanism/table.h"

#include <stdexcept>

#include "framework/common/file.h"
#include "framework/common/text.h"

namespace pintle {

std::vector<double> Table::column(const std::string& name) const {
  for (std::size_t c = 0; c < header.size(); ++c)
    if (header[c] == name) {
      std::vector<double> out;
      for (std::size_t r = 0; r < rows(); ++r) out.push_back(data[r * columns() + c]);
      return out;
    }
  throw std::out_of_range("no column \"" + name + "\"");
}

std::string csv_heading(const Table& table) {
  std::string out;
  for (std::size_t c = 0; c < table.columns(); ++c) {
    if (c) out += ',';
    out += csv_field(table.header[c]);
  }
  out += '\n';
  return out;
}

void append_csv_row(std::string& out, const Table& table, std::size_t row) {
  for (std::size_t c = 0; c < table.columns(); ++c) {
    if (c) out += ',';
    append_number(out, table.data[row * table.columns() + c]);
  }
  out += '\n';
}

std::string csv(const Table& table) {
  std::string out = csv_heading(table);
  for (std::size_t r = 0; r < table.rows(); ++r) append_csv_row(out, table, r);
  return out;
}

void write_csv(const std::filesystem::path& path, const Table& table) {
  FileWriter file(path);
  file.append(csv_heading(table));
  std::string row;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    row.clear();
    append_csv_row(row, table, r);
    file.append(row);
  }
  file.close();
}

}  // namespace pintle
