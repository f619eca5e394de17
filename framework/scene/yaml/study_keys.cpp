#include "framework/scene/yaml/keys.h"

namespace pintle {

namespace {
using presence::optional, presence::required;
}

std::span<const KeyTable> study_tables() {
  static const std::vector<KeyTable> all{
      {"study", {{"title"},      {"scene", required, "slider_crank.yaml"},
                 {"set"},        {"analysis", optional, "", {"run", "kinematics", "inverse", "statics", "linearize", "modes"}},
                 {"at"},         {"equilibrium"},
                 {"situations"}, {"measure"},
                 {"keep"},       {"sweep"},
                 {"tradeoff"},   {"vary"},
                 {"goal"},       {"subject to"},
                 {"fit"},        {"sensitivity"},
                 {"section"},    {"over"},
                 {"basins"},     {"direction", optional, "", {"forwards", "backwards", "both", "from start"}},
                 {"orbit"},      {"lyapunov"},
                 {"limit"},      {"most steps"}}},
      {"study.sweep", {{"grid"}, {"list"}, {"random"}, {"latin hypercube"}, {"limit"}, {"most steps"}}},
      {"study.sweep.grid.*",
       {{"from", required, "0.01 mm"}, {"to", required, "0.5 mm"}, {"count", required, "50"}, {"scale", optional, "", {"linear", "log"}}}},
      {"study.sweep.random.*", {{"from", required, "0.01 mm"}, {"to", required, "0.5 mm"}, {"scale", optional, "", {"linear", "log"}}}},
      {"study.tradeoff",
       {{"error"},
        {"time"},
        {"repeats"},
        {"budget"},
        {"ensemble"},
        {"axes", required, "{tolerance: {run.tolerance: [1e-4, 1e-6, 1e-8]}}"},
        {"reference"}}},
      {"study.vary.*", {{"from", required, "20 mm"}, {"to", required, "60 mm"}, {"start"}, {"scale", optional, "", {"linear", "log"}}}},
      {"study.goal", {{"minimise"}, {"maximise"}, {"reach"}, {"path"}}},
      {"study.goal.reach.*", {{"to", required, "5 Hz"}, {"tolerance"}}},
      {"study.goal.path",
       {{"point", required, "coupler.M"},
        {"through", required, "[[0, 0], [10 mm, 0], [20 mm, 0]]"},
        {"times"},
        {"order", optional, "", {"along", "either way", "any"}},
        {"tolerance"}}},
      {"study.subject to.*", {{"at most"}, {"at least"}}},
      {"study.fit",
       {{"method", optional, "", {"auto", "bobyqa", "cobyla", "nelder-mead", "sbplx", "slsqp", "mma", "direct", "crs", "isres"}},
        {"starts"},
        {"sample"},
        {"seed"},
        {"evaluations"},
        {"precision"},
        {"step"},
        {"most steps"}}},
      {"study.sensitivity",
       {{"parameters", required, "{length: {uniform: 0.1 mm}}"}, {"levels"}, {"corners"}, {"monte carlo"}, {"sobol"}, {"most steps"}}},
      {"study.sensitivity.parameters.*", {{"at"}, {"step"}, {"uniform"}, {"normal"}}},
      {"study.sensitivity.monte carlo", {{"count", required, "1000"}, {"seed"}}},
      {"study.sensitivity.sobol", {{"count", required, "256"}, {"seed"}}},
      {"study.section", {{"every"}, {"when"}, {"record", required, "{height: ball.y}"}, {"transient"}, {"returns"}, {"tolerance"}}},
      {"study.basins", {{"grid"}, {"list"}, {"random"}, {"latin hypercube"}, {"tolerance"}}},
      {"study.orbit", {{"period"}, {"tolerance"}, {"distance"}}},
      {"study.lyapunov", {{"exponents"}, {"every", required, "0.1 s"}, {"over", required, "1000 s"}, {"transient"}, {"distance"}}}};
  return all;
}

}  // namespace pintle
