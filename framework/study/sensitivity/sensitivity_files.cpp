#include <cmath>

#include <nlohmann/json.hpp>

#include "framework/common/fingerprint.h"
#include "framework/common/text.h"
#include "framework/scene/units/unit.h"
#include "framework/scene/yaml/json_text.h"
#include "framework/study/sensitivity/sensitivity.h"

namespace pintle {

namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(); }

Json share_json(const Share& s) {
  return {{"value", number_or_null(s.value)}, {"from", number_or_null(s.low)}, {"to", number_or_null(s.high)}};
}

Json parameter_json(const SensitivityPlan& plan, const MeasureSensitivity& m, std::size_t i) {
  const Scattered& p = plan.parameters[i];
  Json out = {{"derivative", number_or_null(m.slopes[i].value)}, {"error", number_or_null(m.slopes[i].error)}};
  if (p.width > 0) out["of the tolerance"] = number_or_null(m.slopes[i].value * p.reach());
  if (!m.shares.empty()) out["first order"] = share_json(m.shares[i].first), out["total"] = share_json(m.shares[i].total);
  return out;
}

Json measure_json(const SensitivityPlan& plan, const MeasureSensitivity& m) {
  Json parameters = Json::object();
  for (std::size_t i = 0; i < plan.parameters.size(); ++i) parameters[parameter_header(plan.parameters[i])] = parameter_json(plan, m, i);
  Json out = {
      {"nominal", number_or_null(m.nominal)}, {"parameters", parameters}, {"worst case by derivatives", number_or_null(m.linear_worst)}};
  if (m.corners) out["corners"] = {{"least", m.corners->least}, {"greatest", m.corners->greatest}};
  if (m.scatter)
    out["monte carlo"] = {{"cases", m.scatter->cases},
                          {"mean", m.scatter->mean},
                          {"standard deviation", m.scatter->deviation},
                          {"95 % from", m.scatter->low},
                          {"to", m.scatter->high}};
  return out;
}

}  // namespace

std::string parameter_header(const Scattered& p) {
  const std::string unit = si_unit(p.dimension);
  return unit.empty() ? p.name : p.name + " [" + unit + "]";
}

std::string sensitivity_csv(const SensitivityPlan& plan, const std::vector<MeasureSensitivity>& all) {
  std::string out =
      "measure,nominal,parameter,at,derivative,error,of the tolerance,first order,first order from,first order to,total,total from,total "
      "to\n";
  for (const MeasureSensitivity& m : all)
    for (std::size_t i = 0; i < plan.parameters.size(); ++i) {
      const Scattered& p = plan.parameters[i];
      const SobolIndex share = m.shares.empty() ? SobolIndex{{NAN, NAN, NAN}, {NAN, NAN, NAN}} : m.shares[i];
      out += csv_field(m.header) + ",";
      append_number(out, m.nominal);
      out += "," + csv_field(parameter_header(p));
      for (const double x : {p.at, m.slopes[i].value, m.slopes[i].error, p.width > 0 ? m.slopes[i].value * p.reach() : NAN,
                             share.first.value, share.first.low, share.first.high, share.total.value, share.total.low, share.total.high})
        out += ',', append_number(out, x);
      out += '\n';
    }
  return out;
}

std::string sensitivity_json(const SensitivityPlan& plan, const std::vector<MeasureSensitivity>& all) {
  Json measures = Json::object();
  for (const MeasureSensitivity& m : all) measures[m.header] = measure_json(plan, m);
  const Json out = {{"program", "pintle"},
                    {"version", PINTLE_VERSION},
                    {"title", plan.sweep.study.title},
                    {"file", plan.sweep.study.file},
                    {"fingerprint", fingerprint_text(plan.sweep.print)},
                    {"cases", plan.sweep.cases.size()},
                    {"measures", measures}};
  return json_text(out) + "\n";
}

}  // namespace pintle
