#include "framework/report/csv_reader.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <limits>

#include "framework/report/description.h"

namespace pintle {

namespace {

/// Fields of a record, with quotes removed; `out` keeps its memory from record to record.
void split_record(const std::string& record, std::vector<std::string>& out) {
  std::size_t count = 0;
  const auto next = [&] {
    if (count == out.size()) out.emplace_back();
    out[count].clear();
    return &out[count++];
  };
  std::string* field = next();
  bool in_quotes = false;
  for (auto at = record.begin(), end = record.end(); at != end; ++at) {
    const auto stop = std::find_if(at, end, [&](char c) { return c == '"' || (c == ',' && !in_quotes); });
    field->append(at, stop);
    if ((at = stop) == end) break;
    if (in_quotes && *at == '"' && at + 1 != end && at[1] == '"')
      *field += *++at;
    else if (*at == '"')
      in_quotes = !in_quotes;
    else
      field = next();
  }
  out.resize(count);
}

std::ifstream opened(const std::filesystem::path& file) {
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in || in.peek() == std::char_traits<char>::eof())
    throw ResultsError(file.string() + ": cannot be read" + (errno ? std::string(" (") + std::strerror(errno) + ")" : ": it is empty") +
                       (errno == EACCES ? "; check its permissions" : "; run the scene again, or name another results folder"));
  return in;
}

}  // namespace

CsvReader::CsvReader(std::filesystem::path file) : file_(std::move(file)), in_(opened(file_)) {
  std::error_code unknown;
  if (const auto bytes = std::filesystem::file_size(file_, unknown); !unknown) bytes_ = static_cast<double>(bytes);
  read_record();
  if (record_.starts_with("\xef\xbb\xbf")) record_.erase(0, 3);  // byte-order mark
  split_record(record_, header_);
  for (const char* const other : {";", "\t"})
    if (header_.size() == 1 && header_[0].find(other) != std::string::npos)
      throw ResultsError(file_.string() + ":1: its columns are separated by " + (*other == ';' ? "semicolons" : "tabs") +
                         ", but results by commas; write it with commas");
}

bool CsvReader::read_record() {
  line_ = lines_ + 1;
  if (!std::getline(in_, record_)) return false;
  ++lines_;
  const auto in_quotes = [this] { return std::ranges::count(record_, '"') % 2 == 1; };
  for (std::string more; in_quotes(); record_ += '\n' + more) {
    if (!std::getline(in_, more)) {
      if (is_unfinished(file_.parent_path())) return false;
      fail("a quotation mark is not closed");
    }
    ++lines_;
  }
  if (in_.eof()) {
    if (is_unfinished(file_.parent_path())) return false;  // only complete records count
    fail("the line is cut off: it has no newline");
  }
  if (!record_.empty() && record_.back() == '\r') record_.pop_back();
  return true;
}

void CsvReader::fail(const std::string& why) const {
  throw ResultsError(file_.string() + ":" + std::to_string(line_) + ": " + why + "; run the scene again, or correct the file");
}

void CsvReader::require_count(std::size_t fields) const {
  if (fields != header_.size()) fail("has " + std::to_string(fields) + " fields, but the header has " + std::to_string(header_.size()));
}

bool CsvReader::next(std::vector<std::string>& fields) {
  if (!read_record()) return false;
  split_record(record_, fields);
  require_count(fields.size());
  return true;
}

bool CsvReader::next(std::vector<double>& row) {
  if (!read_record()) return false;
  row.clear();
  const char *at = record_.data(), *const end = at + record_.size();
  while (true) {
    const char* const stop = std::find(at, end, ',');
    double x = std::numeric_limits<double>::quiet_NaN();
    if (at != stop) {
      const auto [read, error] = std::from_chars(at, stop, x);
      if (error != std::errc() || read != stop)
        fail("\"" + std::string(at, stop) + "\" in column " + std::to_string(row.size() + 1) + " is not a number");
    }
    row.push_back(x);
    if (stop == end) break;
    at = stop + 1;
  }
  require_count(row.size());
  return true;
}

double CsvReader::share_read() {
  const auto at = static_cast<double>(in_.tellg());  // -1 at the end
  return at >= 0 && at < bytes_ ? at / bytes_ : 1;
}

std::size_t count_rows(const std::filesystem::path& file) {
  std::ifstream in = opened(file);
  std::array<char, 1 << 16> block;
  std::ptrdiff_t lines = 0;
  while (in.read(block.data(), block.size()) || in.gcount() > 0) lines += std::count(block.data(), block.data() + in.gcount(), '\n');
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(lines - 1, 0));
}

ColumnName column_name(const std::string& heading) {
  const std::size_t bracket = heading.rfind(" [");
  if (bracket == std::string::npos || heading.back() != ']') return {heading, ""};
  return {heading.substr(0, bracket), heading.substr(bracket + 2, heading.size() - bracket - 3)};
}

}  // namespace pintle
