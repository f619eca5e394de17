#include "app/hdf5/convert.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <vector>

#include "app/hdf5/hdf5_file.h"
#include "app/hdf5/table_kinds.h"
#include "framework/common/file.h"
#include "framework/common/file_names.h"
#include "framework/output/results_directory.h"
#include "framework/report/csv_reader.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_rows = std::size_t{1} << 16;   // of a block
constexpr std::size_t most_bytes = std::size_t{1} << 26;  // of a block's fields; the same limit applies to its long texts

std::vector<fs::path> files_ending(const fs::path& folder, const char* ending) {
  std::vector<fs::path> out;
  for (const std::string& name : names_in(folder)) {
    std::error_code error;
    if (fs::path file = folder / name; ending_of(file) == ending && fs::is_regular_file(file, error)) out.push_back(std::move(file));
  }
  std::ranges::sort(out);
  return out;
}

std::string text_of(const fs::path& file) {
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  std::string out{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw ResultsError(file.string() + ": cannot be read (" + std::strerror(errno) + "); check its permissions, or remove it");
  return out;
}

double bytes_of(const fs::path& file) {
  std::error_code error;
  const auto bytes = fs::file_size(file, error);
  return error ? 0 : static_cast<double>(bytes);
}

std::vector<Hdf5Column> columns_of(const std::vector<std::string>& header, const std::vector<bool>& text) {
  std::vector<std::string> names;
  for (const std::string& heading : header) names.push_back(column_name(heading).name);
  names = link_names(names);
  std::vector<Hdf5Column> out;
  for (std::size_t c = 0; c < header.size(); ++c) out.push_back({names[c], column_name(header[c]).unit, header[c], text[c]});
  return out;
}

std::size_t rows_of_a_block(const std::vector<bool>& text) {
  std::size_t row = 0;
  for (const bool is_text : text) row += is_text ? sizeof(std::string) + sizeof(char*) : sizeof(double);
  return std::clamp<std::size_t>(most_bytes / row, 1, most_rows);
}

/// Rows read from a table, to be written to its group together.
class Block {
 public:
  Block(const std::vector<bool>& text, std::size_t most) : text_(text), most_(most), numbers_(text.size()), texts_(text.size()) {}
  bool full() const { return rows_ == most_ || long_text_ > most_bytes; }
  std::size_t end() const { return first_ + rows_; }

  /// @throws ResultsError  a number has become text since the first reading
  void add(const std::vector<std::string>& fields, const CsvReader& file) {
    for (std::size_t c = 0; c < fields.size(); ++c) {
      if (text_[c]) {
        if (fields[c].size() >= sizeof(std::string)) long_text_ += fields[c].size();
        texts_[c].push_back(fields[c]);
      } else if (const auto x = number_in(fields[c])) {
        numbers_[c].push_back(*x);
      } else {
        file.fail("the table was changed while it was read");
      }
    }
    ++rows_;
  }
  void write(Hdf5Table& table) {
    for (std::size_t c = 0; c < text_.size(); ++c) {
      if (text_[c])
        table.write(c, first_, texts_[c]);
      else
        table.write(c, first_, numbers_[c]);
      texts_[c].clear(), numbers_[c].clear();
    }
    first_ += rows_;
    rows_ = long_text_ = 0;
  }

 private:
  const std::vector<bool>& text_;
  std::size_t most_, first_ = 0, rows_ = 0, long_text_ = 0;
  std::vector<std::vector<double>> numbers_;
  std::vector<std::vector<std::string>> texts_;
};

/// Calls `tell` with a table's share of the work, which is read twice. @returns the number of its rows; nothing if it was stopped
std::optional<std::size_t> convert_table(const fs::path& csv, const std::string& group, Hdf5File& out, const ConversionStep& tell) {
  const auto report = [&](const char* what, std::size_t row, double share) {
    return tell(what + csv.filename().string() + ", row " + std::to_string(row), share);
  };
  const auto kinds = table_kinds(csv, [&](std::size_t row, double share) { return report("reading ", row, share / 2); });
  if (!kinds) return {};
  CsvReader in(csv);
  if (in.header().size() != kinds->text.size()) in.fail("the table was changed while it was read");
  const std::size_t most = rows_of_a_block(kinds->text);
  Hdf5Table table = out.add_table(group, columns_of(in.header(), kinds->text), kinds->rows, most);
  Block block(kinds->text, most);
  std::vector<std::string> fields;
  while (block.end() < kinds->rows) {  // a run in progress adds more
    if (!in.next(fields)) in.fail("the table was changed while it was read");
    block.add(fields, in);
    if (!block.full()) continue;
    block.write(table);
    if (!report("writing ", block.end(), (1 + in.share_read()) / 2)) return {};
  }
  block.write(table);
  return kinds->rows;
}

}  // namespace

ConvertedTables convert_results(const fs::path& directory, const fs::path& file, const ConversionStep& tell) {
  const std::vector<fs::path> tables = files_ending(directory, ".csv"), descriptions = files_ending(directory, ".json");
  if (tables.empty()) {
    const std::string why = why_without("tables", directory);
    throw ResultsError(directory.string() + ": has no tables (.csv)" +
                       (why.empty() ? "; name a folder of results, which `pintle run` writes with --out FOLDER" : ": " + why));
  }
  std::vector<std::string> names;
  for (const fs::path& table : tables) names.push_back(table.stem().string());
  for (const fs::path& description : descriptions) names.push_back(description.filename().string());
  names = link_names(names);

  double all = 0, done_bytes = 0;
  for (const fs::path& table : tables) all += bytes_of(table);
  ConvertedTables done;
  Hdf5File out(file);
  for (std::size_t k = 0; k < descriptions.size(); ++k) out.add_text(names[tables.size() + k], text_of(descriptions[k]));
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const double bytes = bytes_of(tables[k]);
    const auto rows = convert_table(tables[k], names[k], out,
                                    [&](const std::string& what, double share) { return tell(what, (done_bytes + share * bytes) / all); });
    done_bytes += bytes;
    if (!rows) {
      done.whole = false;
      return done;
    }
    ++done.tables, done.rows += *rows;
  }
  out.commit();
  return done;
}

}  // namespace pintle::app
