#include "framework/scene/yaml/keys.h"

namespace pintle {

namespace {
using presence::optional, presence::required;
}

std::span<const KeyTable> study_tables() {
  static const std::vector<KeyTable> all{
      {"study",
       {{"title"},
        {"scene", required, "slider_crank.yaml"},
        {"set"},
        {"measure", required, "{peak: peak force at crank pin}"},
        {"sweep"},
        {"tradeoff"}}},
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
        {"reference"}}}};
  return all;
}

}  // namespace pintle
