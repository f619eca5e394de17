#include <cmath>

#include <nlohmann/json.hpp>

#include "framework/analysis/cost/cost_estimate.h"
#include "framework/common/text.h"
#include "framework/scene/yaml/json_text.h"

namespace pintle {

namespace {

using Json = nlohmann::ordered_json;

Json range(const Estimate& e) { return {{"least", e.low}, {"likely", e.likely}, {"most", e.high}}; }
Json whole_range(const Estimate& e) {
  return {{"least", std::lround(e.low)}, {"likely", std::lround(e.likely)}, {"most", std::lround(e.high)}};
}

Json run_cost_json(const RunCost& c) {
  const Trial& t = c.trial;
  return {{"steps", whole_range(c.steps)},
          {"mean step [s]", c.step},
          {"computing [s]", range(c.seconds)},
          {"trial",
           {{"steps", t.steps},
            {"rejected", t.rejected},
            {"evaluations", t.evaluations},
            {"impacts", t.impacts},
            {"reached [s]", t.reached},
            {"whole run", t.whole},
            {"ended by the clock", t.by_clock},
            {"took [s]", t.seconds},
            {"trouble", t.trouble}}}};
}

}  // namespace

std::string certainty(const CostEstimate& p) {
  const Trial& t = p.run.trial;
  if (!t.trouble.empty()) return "the trial run failed: " + t.trouble;
  if (t.whole) return "the trial covered the whole run: the steps are counted, not estimated";
  constexpr double even = 1.2;
  const std::string part = number_text(100 * t.reached / p.until, 2);
  const std::string seen = "estimated from " + std::to_string(t.steps) + " steps, the first " + part + " % of the run";
  const double spread = p.run.steps.low > 0 ? p.run.steps.high / p.run.steps.low : INFINITY;
  return seen + (spread < even ? ", where the step rate was even" : ", where the step rate was uneven, hence the range") +
         "; events after that are not included";
}

std::string cost_json(const CostEstimate& p) {
  Json simpler = Json::array();
  for (const Saving& s : p.simpler) {
    simpler.push_back({{"what", s.what}, {"part of the time saved", s.saved}});
    if (!s.of_outputs) simpler.back()["cost"] = run_cost_json(s.cost);
  }
  const OutputCost& o = p.output;
  const Json out = {{"coordinates", p.coordinates},
                    {"rows", p.rows},
                    {"integrals", p.integrals},
                    {"terms", p.terms},
                    {"largest rate [rad/s]", p.largest_rate},
                    {"largest rate of", p.largest_rate_of},
                    {"contact rate [rad/s]", p.contact_rate},
                    {"run", run_cost_json(p.run)},
                    {"outputs",
                     {{"rows", o.rows},
                      {"columns", o.columns},
                      {"frames", o.frames},
                      {"time of a row [s]", o.row_seconds},
                      {"time of a frame [s]", o.frame_seconds},
                      {"files [bytes]", std::lround(o.bytes())}}},
                    {"time [s]", range(p.seconds)},
                    {"memory [bytes]", std::lround(p.memory)},
                    {"certainty", certainty(p)},
                    {"what would be saved", simpler},
                    {"not tried for lack of time", p.untried}};
  return json_text(out) + "\n";
}

}  // namespace pintle
