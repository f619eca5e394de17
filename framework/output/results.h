#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/analysis/cost/cost_estimate.h"
#include "framework/analysis/simulate/simulate.h"
#include "framework/output/results_directory.h"

namespace pintle {

/// trajectory.csv, ledger.csv, events.csv and run.json in `directory`.
/// @throws std::runtime_error  naming the path that cannot be written
void write_results(const std::filesystem::path& directory, const Scene&, const Model&, const Assembly&, const Run&);

/// The contents of run.json, as text.
std::string run_json(const Scene&, const Model&, const Assembly&, const Run&);
/// The run.json of a run that has begun, which remains if the program is killed. Its status is "unfinished".
std::string begun_json(const Scene&);
/// The output of `pintle check --json`.
std::string check_json(const Scene&, const Model&, const Assembly&, const CostEstimate&);

}  // namespace pintle
