#include "framework/report/table_report.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "framework/common/text.h"
#include "framework/report/csv_reader.h"
#include "framework/report/description.h"
#include "framework/report/page.h"
#include "framework/scene/yaml/json_text.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
using TableJson = nlohmann::ordered_json;

/// A table of results, and the columns shown first.
struct TableFile {
  const char* file;
  const char* x = "";       ///< empty: the first that vary between rows
  const char* y = "";       ///< likewise
  const char* colour = "";  ///< likewise
  bool logarithmic = false;
};
/// A kind of tabular results; of its tables, those that exist are shown.
struct TableKind {
  const char* name;
  std::vector<TableFile> tables;
};
const std::vector<TableKind>& kinds() {
  static const std::vector<TableKind> all{{"sensitivity", {{"sensitivity.csv", "parameter", "of the tolerance", "measure"}, {"sweep.csv"}}},
                                          {"fit", {{"fit.csv", "case", "goal", "phase"}, {"path.csv"}}},
                                          {"nonlinear",
                                           {{"section.csv", "", "", "direction"},
                                            {"values.csv", "", "period"},
                                            {"orbits.csv", "", "", "stability"},
                                            {"attractors.csv", "attractor", "share"},
                                            {"lyapunov.csv", "t"}}},
                                          {"sweep", {{"sweep.csv"}}},
                                          {"tradeoff", {{"tradeoff.csv", "time", "error", "", true}}},
                                          {"linearized", {{"linearized.csv", "frequency", "damping ratio", "kind"}}},
                                          {"statics", {{"statics.csv"}}},
                                          {"static", {{"points.csv", "x", "y"}, {"section_forces.csv"}, {"contacts.csv"}}},
                                          {"modes", {{"modes.csv", "mode", "frequency"}, {"reduced.csv", "mode", "frequency"}}}};
  return all;
}

constexpr const char* stopped_sweep = "sweep-so-far.csv";

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

/// The names of the description's list or object under the key, without units.
std::vector<std::string> names_in(const TableJson& json, const char* key) {
  std::vector<std::string> out;
  if (!json.contains(key)) return out;
  for (const auto& [name, value] : json[key].items())
    out.push_back(column_name(json[key].is_array() ? value.get<std::string>() : name).name);
  return out;
}

/// Of a study of basins: its plane of starts is what is seen first.
bool shows_starts(const TableFile& table, const TableJson& description) {
  return description.contains("attractors") && table.file == std::string_view("values.csv");
}

/// What all modes of the body together have of a column: a number that is nothing beside it is rounding. null for other columns.
TableJson whole_of(const std::string& column, const Description& results) {
  if (results.question != "modes") return nullptr;
  if (column.starts_with("share")) return 1;
  const std::string key = column.starts_with("effective mass") ? "mass [kg]" : "inertia about the centre [kg m^2]";
  return column.starts_with("effective") ? results.json.value(key, TableJson()) : TableJson();
}

TableJson table_of(const TableFile& kind, const Description& results, const fs::path& file, std::size_t most_rows) {
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
    if (const TableJson whole = whole_of(column.name, results); !whole.is_null()) columns.back()["whole"] = whole;
  }
  for (const std::size_t r : kept(rows, reader.header().size(), most_rows)) shown.push_back(std::move(rows[r]));
  std::vector<std::string> first = names_in(results.json, "varied");
  const bool starts = shows_starts(kind, results.json);
  std::string colour = starts ? "attractor" : kind.logarithmic ? columns[1]["name"].get<std::string>() : kind.colour;
  if (first.size() > 1 && !starts) first.resize(1);
  for (const char* key : {"measures", "recorded"})
    for (const std::string& name : names_in(results.json, key)) first.push_back(name);
  first.resize(2);
  if (*kind.x) first[0] = kind.x;
  if (*kind.y && !(starts && !first[1].empty())) first[1] = kind.y;
  return {{"file", file.filename().string()},
          {"columns", columns},
          {"rows", shown},
          {"all", rows.size()},
          {"x", first[0]},
          {"y", first[1]},
          {"colour", colour},
          {"logarithmic", kind.logarithmic}};
}

/// Each text of warnings.csv once, with its cases.
TableJson warnings_of(const fs::path& directory) {
  constexpr std::size_t most = 100;
  TableJson out = TableJson::array();
  if (!fs::exists(directory / "warnings.csv")) return out;
  CsvReader file(directory / "warnings.csv");
  if (file.header().size() != 2)
    throw ResultsError((directory / "warnings.csv").string() + ":1: does not have the columns case and warning");
  struct Cases {
    std::string text, first, last = {};
    std::size_t count = 0;
  };
  std::vector<Cases> all;
  std::map<std::string, std::size_t> place;
  for (std::vector<std::string> fields; file.next(fields);) {
    const auto [it, is_new] = place.try_emplace(fields[1], all.size());
    if (is_new) all.push_back({fields[1], fields[0]});
    if (Cases& cases = all[it->second]; std::exchange(cases.last, fields[0]) != fields[0]) ++cases.count;
  }
  for (std::size_t k = 0; k < std::min(most, all.size()); ++k)
    out.push_back((all[k].count > 1 ? counted(all[k].count, "case") + ", the first is case " : "case ") + all[k].first + ": " +
                  all[k].text);
  if (all.size() > most) out.push_back("… and " + counted(all.size() - most, "other warning") + ", see warnings.csv");
  return out;
}

/// The cases so far of a sweep that was stopped.
std::optional<std::string> stopped_page(const fs::path& directory, std::size_t most_rows) {
  const fs::path file = directory / stopped_sweep;
  if (!fs::exists(file)) return {};
  const TableJson table = table_of({stopped_sweep}, {"sweep", file, TableJson::object()}, file, most_rows);
  const std::string title = directory.filename().string();
  const std::string reason = counted(table["all"].get<std::size_t>(), "case") + " so far; the command of the sweep continues it";
  const TableJson data{
      {"title", title}, {"run", {{"status", "the sweep has not ended"}, {"reason", reason}}}, {"tables", TableJson::array({table})}};
  return page(title, json_text(data, -1));
}

}  // namespace

bool has_table_page(const fs::path& directory) {
  return fs::exists(directory / stopped_sweep) ||
         std::ranges::any_of(kinds(), [&](const TableKind& kind) { return fs::exists(directory / (std::string(kind.name) + ".json")); });
}

TableJson tables_json(const Description& results, std::size_t most_rows) {
  const fs::path directory = results.file.parent_path();
  TableJson out = TableJson::array();
  for (const TableKind& kind : kinds())
    if (kind.name == results.question)
      for (const TableFile& table : kind.tables)
        if (fs::exists(directory / table.file))
          out.insert(shows_starts(table, results.json) ? out.begin() : out.end(),
                     table_of(table, results, directory / table.file, most_rows));
  if (out.empty()) throw ResultsError(results.file.string() + ": its tables are missing from the folder; run it again");
  return out;
}

std::optional<std::string> table_page(const fs::path& directory, std::size_t most_rows, std::size_t most_text) {
  for (const TableKind& kind : kinds()) {
    const auto results = description(directory, kind.name);
    if (!results) continue;
    std::string title = results->json.value("title", std::string());
    if (title.empty()) title = results->json.value("file", std::string(kind.name));
    TableJson run = facts(*results, most_text);
    for (const TableJson& warning : warnings_of(directory)) run["warnings"].push_back(warning);
    const TableJson data{{"title", title}, {"run", run}, {"tables", tables_json(*results, most_rows)}};
    return page(title, json_text(data, -1));
  }
  return stopped_page(directory, most_rows);
}

}  // namespace pintle
