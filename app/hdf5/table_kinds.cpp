#include "app/hdf5/table_kinds.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>

#include "framework/report/csv_reader.h"

namespace pintle::app {

std::optional<TableKinds> table_kinds(const std::filesystem::path& file, const RowsRead& tell) {
  constexpr std::size_t often = 4096;
  CsvReader in(file);
  TableKinds out;
  out.text.resize(in.header().size());
  for (std::vector<std::string> fields; in.next(fields); ++out.rows) {
    for (std::size_t c = 0; c < fields.size(); ++c)
      if (!out.text[c] && !number_in(fields[c])) out.text[c] = true;
    if (out.rows % often == 0 && !tell(out.rows)) return {};
  }
  return out;
}

std::optional<double> number_in(const std::string& field) {
  if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
  double x = 0;
  const char* const end = field.data() + field.size();
  const auto [read, error] = std::from_chars(field.data(), end, x);
  if (error != std::errc() || read != end || std::isnan(x)) return {};
  if (std::isinf(x) && field != "inf" && field != "-inf") return {};
  return x;
}

std::vector<std::string> link_names(const std::vector<std::string>& names) {
  std::vector<std::string> out;
  std::set<std::string> taken;
  for (std::string name : names) {
    std::ranges::replace(name, '/', '_');
    if (name.empty() || name == ".") name = "_";
    std::string link = name;
    for (int k = 2; !taken.insert(link).second; ++k) link = name + "_" + std::to_string(k);
    out.push_back(link);
  }
  return out;
}

}  // namespace pintle::app
