#include <cmath>

#include <nlohmann/json.hpp>

#include "framework/run/text.h"
#include "framework/scene/expression.h"
#include "framework/study/fingerprint.h"
#include "framework/study/sweep.h"

namespace pintle {

namespace {

using Json = nlohmann::ordered_json;

/// A varied thing as a column: SI numbers if every value is one, else as written.
struct Varied {
  std::string header;
  std::vector<std::string> fields;  ///< of all cases
};

Varied varied(const Cases& cases, std::size_t name) {
  Varied out{cases.names[name], {}};
  std::string unit;
  bool numbers = true;
  for (const auto& values : cases.values) {
    out.fields.emplace_back();
    if (!values[name]) continue;
    try {
      const Quantity q = read_quantity(*values[name]);
      append_number(out.fields.back(), q.value);
      if (const std::string u = si_unit(q.dimension); !u.empty()) unit = u;
    } catch (const ExpressionError&) {
      numbers = false;
      break;
    }
  }
  if (numbers && !unit.empty()) out.header += " [" + unit + "]";
  if (numbers) return out;
  out.fields.clear();
  for (const auto& values : cases.values) out.fields.push_back(values[name] ? *values[name] : "");
  return out;
}

/// "peak [N]", with the unit that the first case knows which has one.
std::string measure_header(const Sweep& sweep, const std::vector<Row>& rows, std::size_t m) {
  std::string out = sweep.study.measures[m].name;
  for (const Row& r : rows)
    if (m < r.units.size() && !r.units[m].empty()) return out + " [" + r.units[m] + "]";
  return out;
}

}  // namespace

std::string sweep_csv(const Sweep& sweep, const std::vector<Row>& rows) {
  std::vector<Varied> columns;
  for (std::size_t k = 0; k < sweep.cases.names.size(); ++k) columns.push_back(varied(sweep.cases, k));
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
  const Json out = {{"program", "pintle"},
                    {"version", PINTLE_VERSION},
                    {"title", sweep.study.title},
                    {"file", sweep.study.file},
                    {"fingerprint", fingerprint_text(sweep.print)},
                    {"cases", sweep.cases.size()},
                    {"ended", end.rows.size()},
                    {"statuses", statuses(end.rows)},
                    {"varied", sweep.cases.names},
                    {"measures", measures},
                    {"computing time of all cases [s]", busy},
                    {"this session", {{"cases", end.count.done}, {"workers", end.workers}, {"elapsed [s]", end.count.seconds},
                                      {"busy [s]", end.count.busy}, {"efficiency", end.efficiency()}}}};
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace pintle
