#include <algorithm>
#include <cmath>
#include <map>

#include <nlohmann/json.hpp>

#include "framework/common/fingerprint.h"
#include "framework/common/text.h"
#include "framework/scene/yaml/json_text.h"
#include "framework/study/changed_scene.h"
#include "framework/study/fit/fit.h"

namespace pintle {

namespace {

using Json = nlohmann::ordered_json;

Json finite(double x) { return std::isfinite(x) ? Json(x) : Json(); }

/// The unit, from a case that has it.
std::string unit_of_measure(const FitEnd& end, std::size_t m) {
  for (const FitCase& t : end.tried)
    if (m < t.row.units.size() && !t.row.units[m].empty()) return t.row.units[m];
  return "";
}

/// Whether a variable of the best point is at an end of its span.
bool at_an_end(const Variable& v, double x) {
  const double u = v.span.where(x);
  return u < 1e-6 || u > 1 - 1e-6;
}

Json best_json(const FitPlan& plan, const FitEnd& end) {
  if (!end.best) return nullptr;
  const FitCase& t = end.tried[*end.best];
  Json variables = Json::object(), measures = Json::object();
  for (std::size_t j = 0; j < plan.variables.size(); ++j)
    variables[variable_header(plan.variables[j])] = {{"value", variable_value(t, j)},
                                                     {"at the end of its span", at_an_end(plan.variables[j], variable_value(t, j))}};
  const std::vector<double> values = measured_values(plan, t);
  for (std::size_t m = 0; m < values.size(); ++m) measures[measured_header(plan, end, m)] = finite(values[m]);
  return {{"case", t.row.number},
          {"phase", t.phase},
          {"variables", variables},
          {"measures", measures},
          {"goal", finite(t.worth.value)},
          {"all limits are met", t.worth.worst() <= met_within},
          {"goal is reached", plan.goal.reached(values)}};
}

}  // namespace

double variable_value(const FitCase& t, std::size_t variable) { return t.row.values[variable]; }

std::vector<double> measured_values(const FitPlan& plan, const FitCase& t) {
  return {t.row.values.begin() + static_cast<std::ptrdiff_t>(plan.variables.size()), t.row.values.end()};
}

Overrides best_point(const FitPlan& plan, const FitEnd& end) {
  Overrides out;
  for (std::size_t j = 0; j < plan.variables.size(); ++j)
    out.emplace_back(plan.variables[j].name, with_unit(variable_value(end.tried[*end.best], j), plan.variables[j].span.dimension));
  return out;
}

std::string variable_header(const Variable& v) {
  const std::string unit = si_unit(v.span.dimension);
  return unit.empty() ? v.name : v.name + " [" + unit + "]";
}

std::string measured_header(const FitPlan& plan, const FitEnd& end, std::size_t m) {
  const std::string unit = unit_of_measure(end, m);
  return plan.base.study.measures[m].name + (unit.empty() ? "" : " [" + unit + "]");
}

bool FitEnd::meets(const FitPlan& plan) const {
  if (!best) return false;
  const FitCase& t = tried[*best];
  return t.worth.worst() <= met_within && (!plan.goal.exact || plan.goal.reached(measured_values(plan, t)));
}

std::size_t agreeing(const FitPlan& plan, const FitEnd& end) {
  std::size_t out = 0;
  for (const std::optional<std::size_t>& one : end.best_of) {
    bool same = one.has_value();
    for (std::size_t j = 0; same && j < plan.variables.size(); ++j) {
      const ValueSpan& span = plan.variables[j].span;
      same = std::abs(span.where(variable_value(end.tried[*one], j)) - span.where(variable_value(end.tried[*end.best], j))) <= 1e-3;
    }
    out += same;
  }
  return out;
}

std::string fit_csv(const FitPlan& plan, const FitEnd& end) {
  std::string out = "case,phase";
  for (const Variable& v : plan.variables) out += "," + csv_field(variable_header(v));
  for (std::size_t m = 0; m < plan.base.study.measures.size(); ++m) out += "," + csv_field(measured_header(plan, end, m));
  out += ",goal,worst excess,status,reason\n";
  for (const FitCase& t : end.tried) {
    out += std::to_string(t.row.number) + "," + t.phase;
    for (const double x : t.row.values) out += ',', append_number(out, x);
    out += ',';
    append_number(out, t.worth.known ? t.worth.value : std::nan(""));
    out += ',';
    append_number(out, t.worth.known ? t.worth.worst() : std::nan(""));
    out += "," + csv_field(t.row.status) + "," + csv_field(t.row.reason) + "\n";
  }
  return out;
}

std::string fit_json(const FitPlan& plan, const FitEnd& end) {
  std::map<std::string, std::size_t> by_status;
  for (const FitCase& t : end.tried) ++by_status[t.row.status];
  Json spans = Json::object(), searches = Json::array(), methods = Json::array();
  for (const Variable& v : plan.variables) spans[variable_header(v)] = {v.span.span.from, v.span.span.to};
  for (std::size_t s = 0; s < end.ends.size(); ++s)
    searches.push_back({{"ended", end.ends[s]}, {"goal", end.best_of[s] ? finite(end.tried[*end.best_of[s]].worth.value) : Json()}});
  for (const Optimiser m : plan.methods()) methods.push_back(name_of(m));
  const Json out = {{"program", "pintle"},
                    {"version", PINTLE_VERSION},
                    {"title", plan.base.study.title},
                    {"file", plan.base.study.file},
                    {"fingerprint", fingerprint_text(plan.base.print)},
                    {"methods", methods},
                    {"seed", plan.seed},
                    {"cases", end.tried.size()},
                    {"cases at most", plan.evaluations},
                    {"statuses", by_status},
                    {"spans", spans},
                    {"searches", searches},
                    {"searches that came to the best point", end.best ? agreeing(plan, end) : 0},
                    {"best", best_json(plan, end)}};
  return json_text(out) + "\n";
}

std::string fitted_scene(const FitPlan& plan, const FitEnd& end, const std::filesystem::path& folder) {
  const FitCase& t = end.tried[*end.best];
  std::string comment = "Fitted by pintle fit " + plan.base.study.file;
  const std::vector<double> values = measured_values(plan, t);
  for (std::size_t m = 0; m < values.size(); ++m) comment += "\n  " + measured_header(plan, end, m) + ": " + number_text(values[m], 9);
  if (!plan.goal.reached(values)) comment += "\nThe goal is not reached within its tolerance.";
  return changed_scene(plan.source, best_point(plan, end), folder, comment);
}

}  // namespace pintle
