#include "framework/report/table_report.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "framework/report/csv_reader.h"
#include "framework/report/description.h"
#include "framework/report/page.h"
#include "framework/scene/yaml/json_text.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
using TableJson = nlohmann::ordered_json;

/// A kind of tabular results, and the columns shown first.
struct TableKind {
  const char* name;
  const char *x, *y;   ///< empty: the first that vary between rows
  const char* colour;  ///< likewise
  bool logarithmic;
};
constexpr TableKind kinds[] = {{"sweep", "", "", "", false},
                               {"tradeoff", "time", "error", "", true},
                               {"linearized", "frequency", "damping ratio", "kind", false},
                               {"modes", "mode", "frequency", "", false}};

/// The number, if the whole field is one.
TableJson value_of(const std::string& field) {
  if (field.empty()) return nullptr;
  double x = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), x);
  return error == std::errc() && end == field.data() + field.size() && std::isfinite(x) ? TableJson(x) : TableJson(field);
}

/// The rows that are kept.
std::set<std::size_t> kept(const std::vector<TableJson>& rows, std::size_t columns, std::size_t most) {
  std::set<std::size_t> out;
  const auto below = [&](std::size_t c) {
    return [&rows, c](std::size_t a, std::size_t b) { return rows[a][c].get<double>() < rows[b][c].get<double>(); };
  };
  for (std::size_t c = 0; c < columns && rows.size() > most; ++c) {
    std::vector<std::size_t> numbers;
    for (std::size_t r = 0; r < rows.size(); ++r)
      if (rows[r][c].is_number()) numbers.push_back(r);
    if (numbers.empty()) continue;
    const auto [least, greatest] = std::ranges::minmax_element(numbers, below(c));
    out.insert(*least), out.insert(*greatest);
  }
  const std::size_t step = std::max<std::size_t>(1, (rows.size() + most - 1) / std::max<std::size_t>(most, 1));
  for (std::size_t r = 0; r < rows.size(); r += step) out.insert(r);
  return out;
}

/// A name without its unit, if there is one.
std::string first_name(const TableJson& json, const char* key) {
  if (!json.contains(key) || json[key].empty()) return "";
  const TableJson& of = json[key];
  return column_name(of.is_array() ? of[0].get<std::string>() : of.items().begin().key()).name;
}

std::string table_page_of(const TableKind& kind, const Description& results, const fs::path& file, std::size_t most_rows,
                          std::size_t most_text) {
  CsvReader reader(file);
  std::vector<TableJson> rows;
  for (std::vector<std::string> fields; reader.next(fields);) {
    TableJson& row = rows.emplace_back(TableJson::array());
    for (const std::string& field : fields) row.push_back(value_of(field));
  }
  TableJson columns = TableJson::array(), shown = TableJson::array();
  for (const std::string& heading : reader.header()) {
    const ColumnName column = column_name(heading);
    columns.push_back({{"name", column.name}, {"unit", column.unit}});
  }
  for (const std::size_t r : kept(rows, reader.header().size(), most_rows)) shown.push_back(std::move(rows[r]));
  const bool sweep = kind.name == std::string("sweep");
  std::string title = results.json.value("title", std::string());
  if (title.empty()) title = results.json.value("file", std::string(kind.name));
  const TableJson data{{"title", title},
                       {"run", facts(results, most_text)},
                       {"columns", columns},
                       {"rows", shown},
                       {"all", rows.size()},
                       {"x", sweep ? first_name(results.json, "varied") : kind.x},
                       {"y", sweep ? first_name(results.json, "measures") : kind.y},
                       {"colour", kind.name == std::string("tradeoff") ? columns[1]["name"].get<std::string>() : kind.colour},
                       {"logarithmic", kind.logarithmic}};
  return page(title, json_text(data, -1));
}

}  // namespace

bool has_table_page(const fs::path& directory) {
  return std::ranges::any_of(kinds, [&](const TableKind& kind) { return fs::exists(directory / (std::string(kind.name) + ".json")); });
}

std::optional<std::string> table_page(const fs::path& directory, std::size_t most_rows, std::size_t most_text) {
  for (const TableKind& kind : kinds)
    if (const auto results = description(directory, kind.name))
      return table_page_of(kind, *results, directory / (std::string(kind.name) + ".csv"), most_rows, most_text);
  return {};
}

}  // namespace pintle
