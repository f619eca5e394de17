#include "framework/report/sheets.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "framework/common/work_done.h"

namespace pintle {

namespace {

using Row = std::vector<double>;

Sheet sheet_of(const std::vector<std::string>& header, const std::vector<std::size_t>& columns) {
  Sheet out;
  for (const std::size_t c : columns) out.columns.push_back(column_name(header[c]));
  out.values.resize(columns.size());
  return out;
}

void append(Sheet& sheet, const Row& row, const std::vector<std::size_t>& columns) {
  sheet.t.push_back(row[0]);
  for (std::size_t k = 0; k < columns.size(); ++k) sheet.values[k].push_back(row[columns[k]]);
}

std::vector<std::size_t> all_but_time(std::size_t columns) {
  std::vector<std::size_t> out;
  for (std::size_t c = 1; c < columns; ++c) out.push_back(c);
  return out;
}

/// The rows of a file divided into stretches of equal length.
class Stretches {
 public:
  Stretches(std::size_t rows, std::size_t stretches)
      : length_(std::max<std::size_t>(1, (rows + stretches - 1) / std::max<std::size_t>(stretches, 1))) {}
  bool ends_after(std::size_t row) const { return (row + 1) % length_ == 0; }

 private:
  std::size_t length_;
};

/// A value and its time.
struct Sample {
  double t = 0, value = std::numeric_limits<double>::quiet_NaN();
  bool there() const { return !std::isnan(value); }
};

/// A reduced column: first, last, and the least and greatest value of each stretch, in their order; of gaps the beginning, where a stretch
/// has several that of the last: longer ones are all kept.
class Extremes {
 public:
  void add(double t, double value) {
    const bool was_empty = std::exchange(is_empty_, std::isnan(value));
    if (is_empty_ && !was_empty) gap_ = t;
    if (is_empty_) return;
    last_ = {t, value};
    if (!first_.there()) first_ = last_;
    if (!least_.there() || value < least_.value) least_ = last_;
    if (!greatest_.there() || value > greatest_.value) greatest_ = last_;
  }
  void end_stretch(Sheet& sheet) {
    if (least_.t > greatest_.t) std::swap(least_, greatest_);
    if (!begun_) keep_with_gap(first_, sheet);
    begun_ = first_.there();
    keep_with_gap(least_, sheet), keep_with_gap(greatest_, sheet), keep_gap(sheet);
    least_ = greatest_ = {};
  }
  void finish(Sheet& sheet) {
    end_stretch(sheet);
    if (!is_empty_) keep(last_, sheet);
  }

 private:
  void keep_with_gap(const Sample& s, Sheet& sheet) {
    if (s.there() && gap_ && *gap_ < s.t) keep_gap(sheet);
    keep(s, sheet);
  }
  void keep_gap(Sheet& sheet) {
    if (gap_) sheet.t.push_back(*gap_), sheet.values[0].push_back(std::nan(""));
    gap_.reset();
  }
  static void keep(const Sample& s, Sheet& sheet) {
    if (!s.there() || (!sheet.t.empty() && sheet.t.back() == s.t && sheet.values[0].back() == s.value)) return;
    sheet.t.push_back(s.t), sheet.values[0].push_back(s.value);
  }
  Sample first_, last_, least_, greatest_;
  std::optional<double> gap_;
  bool is_empty_ = false, begun_ = false;
};

/// Reads the next row. @returns false at the end
bool next(CsvReader& file, Row& row, std::size_t number, const WorkShare& work) {
  constexpr std::size_t often = 4096;
  const bool more = file.next(row);
  if (!more || number % often == 0) work_done = work.begin + (work.end - work.begin) * (more ? file.share_read() : 1);
  return more;
}

ReducedTable whole_table(CsvReader& file, const WorkShare& work) {
  ReducedTable out;
  const auto columns = all_but_time(file.header().size());
  out.sheets.push_back(sheet_of(file.header(), columns));
  for (Row row; next(file, row, out.rows, work); ++out.rows) append(out.sheets[0], row, columns);
  return out;
}

std::vector<std::size_t> columns_called(const std::vector<std::string>& header, const std::vector<std::string>& names) {
  const std::set<std::string> wanted(names.begin(), names.end());
  std::vector<std::size_t> out;
  for (std::size_t c = 1; c < header.size(); ++c)
    if (wanted.contains(column_name(header[c]).name)) out.push_back(c);
  return out;
}

/// Rows in which some column has its least or greatest value.
class ExtremeRows {
 public:
  explicit ExtremeRows(std::size_t columns) : least_(columns), greatest_(columns) {}
  void add(const Row& row) {
    for (std::size_t c = 1; c < row.size(); ++c) {
      if (least_[c].empty() || row[c] < least_[c][c]) least_[c] = row;
      if (greatest_[c].empty() || row[c] > greatest_[c][c]) greatest_[c] = row;
    }
  }
  std::vector<Row> end_stretch() {
    std::vector<Row> out;
    for (auto* rows : {&least_, &greatest_})
      for (Row& row : *rows) {
        if (!row.empty()) out.push_back(std::move(row));
        row.clear();
      }
    std::ranges::sort(out, {}, [](const Row& r) { return r[0]; });
    out.erase(std::unique(out.begin(), out.end(), [](const Row& a, const Row& b) { return a[0] == b[0]; }), out.end());
    return out;
  }

 private:
  std::vector<Row> least_, greatest_;
};

}  // namespace

ReducedTable reduced_by_column(const std::filesystem::path& path, const SheetLimits& limits, const std::vector<std::string>& drawn,
                               const WorkShare& work) {
  const std::size_t rows = count_rows(path);
  CsvReader file(path);
  const std::size_t columns = file.header().size();
  if (rows * columns <= limits.values) return whole_table(file, work);

  ReducedTable out;
  out.whole = false;
  for (std::size_t c = 1; c < columns; ++c) out.sheets.push_back(sheet_of(file.header(), {c}));
  std::vector<Extremes> extremes(columns);
  const std::size_t a_column = std::max<std::size_t>(limits.values / (2 * columns), 8);  // a value and its time
  const Stretches stretches(rows, a_column / 2);
  const auto posed = columns_called(file.header(), drawn);
  out.poses = sheet_of(file.header(), posed);
  const Stretches pauses(rows, std::max<std::size_t>(limits.poses / (posed.size() + 1), 2));

  Row row;
  for (; next(file, row, out.rows, work); ++out.rows) {
    for (std::size_t c = 1; c < columns; ++c) {
      extremes[c].add(row[0], row[c]);
      if (stretches.ends_after(out.rows)) extremes[c].end_stretch(out.sheets[c - 1]);
    }
    if (out.rows == 0 || pauses.ends_after(out.rows)) append(out.poses, row, posed);
  }
  for (std::size_t c = 1; c < columns; ++c) extremes[c].finish(out.sheets[c - 1]);
  if (out.rows > 0 && out.poses.t.back() != row[0] && !row.empty()) append(out.poses, row, posed);
  return out;
}

ReducedTable reduced_by_row(const std::filesystem::path& path, std::size_t most_values, const WorkShare& work) {
  const std::size_t rows = count_rows(path);
  CsvReader file(path);
  const std::size_t columns = file.header().size();
  if (rows * columns <= most_values) return whole_table(file, work);

  ReducedTable out;
  out.whole = false;
  const auto kept = all_but_time(columns);
  Sheet& sheet = out.sheets.emplace_back(sheet_of(file.header(), kept));
  ExtremeRows extremes(columns);
  const Stretches stretches(rows, std::max<std::size_t>(most_values / (2 * columns * columns), 4));
  const auto end_stretch = [&] {
    for (const Row& row : extremes.end_stretch()) append(sheet, row, kept);
  };
  Row row, last;
  for (; next(file, row, out.rows, work); ++out.rows, last = row) {
    if (out.rows == 0)
      append(sheet, row, kept);
    else
      extremes.add(row);
    if (stretches.ends_after(out.rows)) end_stretch();
  }
  end_stretch();
  if (!last.empty() && sheet.t.back() != last[0]) append(sheet, last, kept);
  return out;
}

ReducedTable single_row(const std::filesystem::path& path) {
  CsvReader file(path);
  ReducedTable out{.rows = 1, .whole = true, .sheets = {Sheet{}}, .poses = {}};
  Sheet& sheet = out.sheets.front();
  sheet.t = {0};
  for (std::vector<std::string> fields; file.next(fields);) {
    const ColumnName column = column_name(fields[0]);
    double value = 0;
    if (const auto [end, error] = std::from_chars(fields[1].data(), fields[1].data() + fields[1].size(), value); error != std::errc())
      file.fail("\"" + fields[1] + "\" is not a number");
    if (column.name == "t")
      sheet.t = {value};
    else
      sheet.columns.push_back(column), sheet.values.push_back({value});
  }
  return out;
}

ReducedTable mode_motions(const std::filesystem::path& path) {
  CsvReader file(path);
  std::vector<std::size_t> kept = all_but_time(file.header().size());
  kept.erase(kept.begin());
  ReducedTable out{.rows = 0, .whole = true, .sheets = {sheet_of(file.header(), kept)}, .poses = {}};
  for (Row row; file.next(row); ++out.rows) {
    row[0] = 2 * (row[0] - 1) + row[1] / (2 * std::numbers::pi);
    append(out.sheets.front(), row, kept);
  }
  return out;
}

}  // namespace pintle
