#include "framework/analysis/simulate/simulate.h"

#include "framework/analysis/simulate/simulation.h"

namespace pintle {

const char* status_text(Status s) {
  switch (s) {
    case Status::finished: return "finished";
    case Status::failed: return "failed";
    case Status::interrupted: return "interrupted";
    case Status::ledger_over_bound: return "ledger over its bound";
    case Status::not_written: return "results not written";
    case Status::out_of_memory: return "out of memory";
  }
  return "";
}

Run simulate(const Scene& scene, const Model& model, const Assembly& assembly, const Listeners& listeners, const SavedState* from) {
  Simulation simulation(scene, model, assembly, listeners, from);
  simulation.advance(scene.run.until);
  return simulation.finish();
}

}  // namespace pintle
