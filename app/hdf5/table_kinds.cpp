#include "app/hdf5/table_kinds.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string_view>

#include "framework/report/csv_reader.h"

namespace pintle::app {

namespace {

/// Whether a column is always text, even if it is empty or holds names such as "12". The type of any other column follows from its values.
bool is_text_by_nature(const std::string& table, const std::string& heading) {
  static const std::map<std::string_view, std::vector<std::string_view>> columns{{"A", {"rate of"}},
                                                                                 {"B", {"rate of"}},
                                                                                 {"C", {"output"}},
                                                                                 {"D", {"output"}},
                                                                                 {"actions", {"event", "did"}},
                                                                                 {"contacts", {"contact"}},
                                                                                 {"events", {"joint"}},
                                                                                 {"fit", {"phase", "status", "reason"}},
                                                                                 {"fit-so-far", {"phase", "status", "reason"}},
                                                                                 {"linearized", {"kind", "moves most"}},
                                                                                 {"lyapunov", {"direction"}},
                                                                                 {"orbits", {"direction", "found from", "stability"}},
                                                                                 {"points", {"point"}},
                                                                                 {"section", {"direction"}},
                                                                                 {"sensitivity", {"measure", "parameter"}},
                                                                                 {"shapes", {"coordinate"}},
                                                                                 {"statics", {"quantity"}},
                                                                                 {"sweep", {"status", "reason"}},
                                                                                 {"sweep-part", {"status", "reason"}},
                                                                                 {"sweep-so-far", {"status", "reason"}},
                                                                                 {"timings", {"process.thread"}},
                                                                                 {"tradeoff", {"status", "role", "reason"}},
                                                                                 {"values", {"direction", "status", "reason"}},
                                                                                 {"warnings", {"warning"}}};
  const auto found = columns.find(table);
  return found != columns.end() && std::ranges::find(found->second, heading) != found->second.end();
}

}  // namespace

std::optional<TableKinds> table_kinds(const std::filesystem::path& file, const RowsRead& tell) {
  constexpr std::size_t often = 4096;
  CsvReader in(file);
  TableKinds out;
  for (const std::string& heading : in.header()) out.text.push_back(is_text_by_nature(file.stem().string(), heading));
  for (std::vector<std::string> fields; in.next(fields); ++out.rows) {
    for (std::size_t c = 0; c < fields.size(); ++c)
      if (!out.text[c] && !number_in(fields[c])) out.text[c] = true;
    if (out.rows % often == 0 && !tell(out.rows, in.share_read())) return {};
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
