#include <cmath>

#include <nlohmann/json.hpp>

#include "framework/common/file.h"
#include "framework/common/printed.h"
#include "framework/common/text.h"
#include "framework/scene/yaml/json_text.h"
#include "framework/study/changed_scene.h"
#include "framework/study/tradeoff/tradeoff.h"
#include "framework/study/tradeoff/tradeoff_words.h"

namespace pintle {

namespace {

using Json = nlohmann::ordered_json;

std::string label(const TradeReport& r, const TradePoint& p, std::size_t axis) {
  return p.at.empty() ? "as it stands" : r.plan.axes[axis].values[p.at[axis]].label;
}

const char* status(const TradeReport& r) {
  return r.stopped ? "stopped by the user" : !r.reference.trouble.empty() ? "no reference" : r.cut ? "the budget was spent" : "finished";
}

const char* shown(const TradeReport& r, const TradePoint& p) {
  if (!(r.plan.error > 0) || !p.usable) return "";
  const Verdict v = verdict(p, r.plan.error);
  return v == Verdict::meets ? "yes" : v == Verdict::misses ? "no" : "not known";
}

const char* role(const TradeReport& r, std::size_t i) {
  return r.recommended == i ? "recommended" : r.points[i].front ? "front" : r.points[i].dominated ? "dominated" : "";
}

Json json_number(double x) { return std::isfinite(x) ? Json(x) : Json(); }

Json overrides_json(const Overrides& set) {
  Json out = Json::object();
  for (const auto& [name, text] : set) out[name] = text;
  return out;
}

Json point_json(const TradeReport& r, std::size_t i) {
  const TradePoint& p = r.points[i];
  Json axes = Json::object(), quantities = Json::object();
  for (std::size_t a = 0; a < r.plan.axes.size(); ++a) axes[r.plan.axes[a].name] = label(r, p, a);
  for (std::size_t q = 0; q < p.values.size(); ++q)
    quantities[r.quantities[q]] = {{"value", json_number(p.values[q])},
                                   {"error", json_number(p.errors[q])},
                                   {"doubt", json_number(p.warnings_of[q])},
                                   {"error of the model", json_number(p.model[q])}};
  return {{"setting", i},
          {"axes", axes},
          {"set", overrides_json(p.set)},
          {"status", p.status},
          {"reason", p.reason},
          {"role", role(r, i)},
          {"time", p.time},
          {"times", p.times},
          {"build", p.build},
          {"steps", p.steps},
          {"evaluations", p.evaluations},
          {"quantities", quantities},
          {"has the wanted error", *shown(r, p) ? Json(shown(r, p)) : Json()},
          {"error", json_number(p.error)},
          {"doubt", json_number(p.warning)}};
}

Json reference_json(const TradeReport& r) {
  Json levels = Json::array(), of = Json::object();
  for (const ReferenceLevel& l : r.reference.levels) levels.push_back({{"what", l.what}, {"values", l.values}, {"seconds", l.seconds}});
  for (std::size_t q = 0; q < r.reference.of.size(); ++q) {
    const QuantityReference& x = r.reference.of[q];
    of[r.quantities[q]] = {{"value", json_number(x.value)},
                           {"unit", r.units[q]},
                           {"error", json_number(x.error)},
                           {"scale", x.scale},
                           {"converged", x.converged},
                           {"chaotic", x.chaotic},
                           {"constant", x.constant},
                           {"fall a decade of tolerance", x.ratio},
                           {"order of the model", x.order},
                           {"spread", x.spread},
                           {"growth", x.rate},
                           {"words", x.words}};
  }
  return {{"set", overrides_json(r.reference.set)},
          {"levels", levels},
          {"quantities", of},
          {"trouble", r.reference.trouble},
          {"short of time", r.reference.short_of_time}};
}

}  // namespace

std::string tradeoff_csv(const TradeReport& r) {
  std::string out = "setting";
  for (const FidelityAxis& axis : r.plan.axes) out += "," + csv_field(axis.name);
  out += ",status,time [s],least time [s],most time [s],timed runs,build [s],steps,evaluations";
  for (std::size_t q = 0; q < r.quantities.size(); ++q) {
    const std::string& name = r.quantities[q];
    out += "," + csv_field(name + (r.units[q].empty() ? "" : " [" + r.units[q] + "]")) + "," + csv_field("error of " + name) + "," +
           csv_field("reference's error of " + name) + "," + csv_field("model's error of " + name);
  }
  out += ",error,error resolution,role,reason\n";
  for (std::size_t i = 0; i < r.points.size(); ++i) {
    const TradePoint& p = r.points[i];
    const bool ran = p.steps > 0;
    out += std::to_string(i);
    for (std::size_t a = 0; a < r.plan.axes.size(); ++a) out += "," + csv_field(label(r, p, a));
    out += "," + csv_field(p.status);
    for (const double x : {p.time, p.least, p.most}) out += "," + (ran ? number_exactly(x) : "");
    out += "," + std::to_string(p.times.size()) + "," +
           (ran ? number_exactly(p.build) + "," + std::to_string(p.steps) + "," + std::to_string(p.evaluations) : ",,");
    for (std::size_t q = 0; q < r.quantities.size(); ++q)
      out += "," + number_exactly(p.values[q]) + "," + number_exactly(p.errors[q]) + "," + number_exactly(p.warnings_of[q]) + "," +
             number_exactly(p.model[q]);
    out += "," + (p.usable ? number_exactly(p.error) + "," + number_exactly(p.warning) : ",") + "," + role(r, i) + "," +
           csv_field(p.reason) + "\n";
  }
  return out;
}

std::string tradeoff_json(const TradeReport& r) {
  Json axes = Json::array(), points = Json::array(), front = Json::array();
  for (const FidelityAxis& axis : r.plan.axes) {
    Json values = Json::array();
    for (const AxisValue& v : axis.values) values.push_back({{"label", v.label}, {"set", overrides_json(v.set)}});
    axes.push_back({{"name", axis.name},
                    {"values", values},
                    {"ordered", axis.ordered},
                    {"numerical", axis.numerical},
                    {"finest", axis.values[axis.finest].label}});
  }
  for (std::size_t i = 0; i < r.points.size(); ++i) points.push_back(point_json(r, i));
  for (const std::size_t i : r.front) front.push_back(i);
  const auto chosen = [](const std::optional<std::size_t>& i) { return i ? Json(*i) : Json(); };
  const Json out{{"title", r.plan.title},
                 {"status", status(r)},
                 {"settings that ran", r.ran()},
                 {"settings in all", r.listed()},
                 {"axes chosen from the scene", r.plan.suggested},
                 {"wanted",
                  {{"error", r.plan.error > 0 ? Json(r.plan.error) : Json()},
                   {"time", r.plan.time > 0 ? Json(r.plan.time) : Json()},
                   {"budget", r.plan.budget > 0 ? Json(r.plan.budget) : Json()},
                   {"repeats", r.plan.repeats}}},
                 {"said", r.said},
                 {"recommended", chosen(r.recommended)},
                 {"cheapest for the error", chosen(r.cheapest)},
                 {"most accurate in the time", chosen(r.best_in_time)},
                 {"front", front},
                 {"reference", reference_json(r)},
                 {"axes", axes},
                 {"settings", points},
                 {"seconds", r.seconds},
                 {"stopped", r.stopped}};
  return json_text(out) + "\n";
}

void write_tradeoff(const std::filesystem::path& directory, const std::filesystem::path& final_directory, const CaseSource& source,
                    const TradeReport& r) {
  write_text(directory / "tradeoff.csv", tradeoff_csv(r));
  write_text(directory / "tradeoff.json", tradeoff_json(r));
  write_text(directory / "tradeoff.md", tradeoff_markdown(r, "tradeoff.svg"));
  if (!r.recommended) return;
  const TradePoint& p = r.points[*r.recommended];
  write_text(
      directory / "recommended.yaml",
      changed_scene(source, p.set, final_directory,
                    "Recommended by pintle tradeoff for " + source.file.filename().string() + ": " + setting_text(r.plan, p) + "\n" +
                        "Measured: " + time_text(p.time) + ", error " + error_text(p) +
                        (r.quantities.empty() ? "" : " of " + r.quantities.front()) + (r.quantities.size() > 1 ? " and others" : "")));
}

}  // namespace pintle
