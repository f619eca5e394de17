#include <algorithm>
#include <cmath>
#include <optional>

#include <nlohmann/json.hpp>

#include "framework/common/fingerprint.h"
#include "framework/common/text.h"
#include "framework/scene/units/expression.h"
#include "framework/scene/yaml/json_text.h"
#include "framework/study/sweep/sweep.h"

namespace pintle {

namespace {

using Json = nlohmann::ordered_json;

/// A varied quantity as a column: SI numbers if every value accepted by the scene is a number, otherwise as written.
struct Varied {
  std::string header;
  std::vector<std::string> fields;  ///< of all cases
};

/// In each case; nothing if there is none.
using Quantities = std::vector<std::optional<Quantity>>;

/// The unit in which the scene accepted the values of a name; if none has been accepted, the first one written. Nothing if there are
/// several.
std::optional<std::string> unit_of(const Quantities& values, const std::vector<bool>& taken) {
  std::string first, out;
  bool any = false;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!values[k]) continue;
    any = any || taken[k];
    if (bare(values[k]->dimension)) continue;
    const std::string unit = si_unit(values[k]->dimension);
    if (first.empty()) first = unit;
    if (!taken[k]) continue;
    if (!out.empty() && unit != out) return {};
    out = unit;
  }
  return any ? out : first;
}

/// @param taken  the cases that ended, except those rejected by the scene's reader
Varied varied(const Cases& cases, std::size_t name, const std::vector<bool>& taken) {
  Quantities values;
  bool numbers = true;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    values.push_back(cases.quantity(k, name));
    numbers = numbers && (values[k] || !cases.values[k][name] || !taken[k]);
  }
  const std::optional<std::string> unit = numbers ? unit_of(values, taken) : std::nullopt;
  Varied out{unit && !unit->empty() ? cases.names[name] + " [" + *unit + "]" : cases.names[name], {}};
  for (std::size_t k = 0; k < cases.size(); ++k) {
    std::string& field = out.fields.emplace_back();
    if (unit && values[k] && (bare(values[k]->dimension) || si_unit(values[k]->dimension) == *unit))
      append_number(field, values[k]->value);
    else
      field = cases.values[k][name].value_or("");
  }
  return out;
}

/// "peak [N]", with the unit from the first case that has one.
std::string measure_header(const Sweep& sweep, const std::vector<Row>& rows, std::size_t m) {
  std::string out = sweep.study.measures[m].name;
  for (const Row& r : rows)
    if (m < r.units.size() && !r.units[m].empty()) return out + " [" + r.units[m] + "]";
  return out;
}

}  // namespace

std::string sweep_csv(const Sweep& sweep, const std::vector<Row>& rows) {
  std::vector<Varied> columns;
  std::vector<bool> taken(sweep.cases.size(), false);
  for (const Row& r : rows) taken[r.number - 1] = r.status != "refused";
  for (std::size_t k = 0; k < sweep.cases.names.size(); ++k) columns.push_back(varied(sweep.cases, k, taken));
  std::string out = "case";
  for (const Varied& v : columns) out += "," + csv_field(v.header);
  for (std::size_t m = 0; m < sweep.study.measures.size(); ++m) out += "," + csv_field(measure_header(sweep, rows, m));
  out += ",status,reason,t_end [s],steps,impacts,unexplained share\n";
  for (const Row& r : rows) {
    out += std::to_string(r.number);
    for (const Varied& v : columns) out += "," + csv_field(v.fields[r.number - 1]);
    for (std::size_t m = 0; m < sweep.study.measures.size(); ++m) {
      out += ',';
      if (m < r.values.size()) append_number(out, r.values[m]);
    }
    out += "," + csv_field(r.status) + "," + csv_field(r.reason) + ",";
    append_number(out, r.t_end);
    out += "," + std::to_string(r.steps) + "," + std::to_string(r.impacts) + ",";
    append_number(out, r.unexplained_share);
    out += '\n';
  }
  return out;
}

std::string timings_csv(const std::vector<Row>& rows) {
  std::string out = "case,process.thread,build [s],run [s]\n";
  for (const Row& r : rows) {
    out += std::to_string(r.number) + "," + r.worker + ",";
    append_number(out, r.build_seconds);
    out += ',';
    append_number(out, r.run_seconds);
    out += '\n';
  }
  return out;
}

std::string warnings_csv(const std::vector<Row>& rows) {
  std::string out;
  for (const Row& r : rows)
    for (const std::string& warning : r.warnings) out += std::to_string(r.number) + "," + csv_field(warning) + "\n";
  return out.empty() ? out : "case,warning\n" + out;
}

std::string warnings_text(const std::vector<Row>& rows, const std::filesystem::path& file) {
  const auto has = [](const Row& row) { return !row.warnings.empty(); };
  const auto first = std::ranges::find_if(rows, has);
  if (first == rows.end()) return "";
  const auto n = static_cast<std::size_t>(std::ranges::count_if(rows, has));
  return counted(n, "case") + " of " + std::to_string(rows.size()) + (n == 1 ? " has" : " have") + " warnings" +
         (file.empty() ? "" : ", see " + file.string()) + "; case " + std::to_string(first->number) + ": " + first->warnings.front();
}

std::map<std::string, std::size_t> statuses(const std::vector<Row>& rows) {
  std::map<std::string, std::size_t> out;
  for (const Row& r : rows) ++out[r.status];
  return out;
}

std::vector<MeasureRange> measure_ranges(const Sweep& sweep, const std::vector<Row>& rows) {
  std::vector<MeasureRange> out;
  for (std::size_t m = 0; m < sweep.study.measures.size(); ++m) {
    MeasureRange range{measure_header(sweep, rows, m), std::nan(""), std::nan(""), 0, 0};
    for (const Row& r : rows) {
      if (m >= r.values.size() || std::isnan(r.values[m])) continue;
      if (!(range.least <= r.values[m])) range.least = r.values[m], range.least_in = r.number;
      if (!(range.greatest >= r.values[m])) range.greatest = r.values[m], range.greatest_in = r.number;
    }
    out.push_back(range);
  }
  return out;
}

std::string sweep_json(const Sweep& sweep, const SweepEnd& end) {
  Json measures = Json::object();
  for (const MeasureRange& r : measure_ranges(sweep, end.rows))
    measures[r.header] = {{"least", r.least}, {"least in case", r.least_in}, {"greatest", r.greatest}, {"greatest in case", r.greatest_in}};
  double busy = 0;
  for (const Row& r : end.rows) busy += r.build_seconds + r.run_seconds;
  const auto doubtful = std::ranges::count_if(end.rows, [](const Row& r) { return !r.warnings.empty(); });
  Json out = {{"program", "pintle"},
              {"version", PINTLE_VERSION},
              {"title", sweep.study.title},
              {"file", sweep.study.file},
              {"fingerprint", fingerprint_text(sweep.print)},
              {"cases", sweep.cases.size()},
              {"ended", end.rows.size()},
              {"statuses", statuses(end.rows)},
              {"varied", sweep.cases.names},
              {"measures", measures},
              {"cases with warnings", doubtful},
              {"computing time of all cases [s]", busy},
              {"this session",
               {{"cases", end.count.done},
                {"workers", end.workers},
                {"elapsed [s]", end.count.seconds},
                {"busy [s]", end.count.busy},
                {"efficiency", end.efficiency()}}}};
  if (sweep.part) out["part"] = {{"number", sweep.part->number}, {"of", sweep.part->count}};
  return json_text(out) + "\n";
}

}  // namespace pintle
