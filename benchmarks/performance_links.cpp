#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "benchmarks/performance.h"

namespace performance {

namespace {

/// Time of an entry in seconds.
double seconds_of(const nlohmann::json& entry) {
  const std::string unit = entry.at("time_unit");
  return entry.at("real_time").get<double>() * (unit == "ns" ? 1e-9 : unit == "us" ? 1e-6 : unit == "ms" ? 1e-3 : 1);
}

/// The counters of the benchmark, without the fields that the library itself writes.
std::string counters_of(const nlohmann::json& entry) {
  static const std::vector<std::string> own{
      "family_index", "per_family_instance_index", "repetitions", "repetition_index", "threads", "iterations", "real_time", "cpu_time"};
  std::string out;
  for (const auto& [key, value] : entry.items())
    if (value.is_number() && std::find(own.begin(), own.end(), key) == own.end())
      out += (out.empty() ? "" : ", ") + key + printed(" %.4g", value.get<double>());
  return out;
}

}  // namespace

std::string links_section(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file);
  const auto all = nlohmann::json::parse(in);
  std::ostringstream md;
  md << "\n## Many links\n\n"
        "Chains, ladders and grids of rigid links with pins, up to 10⁵ bodies (benchmarks/chains.cpp): time of one turn of each benchmark, "
        "and "
        "what it counts. `ratio`: of medians, ours over the other solver's, turn about in one process; `slope`: of log time over log "
        "links.\n\n"
        "| benchmark | time | counters |\n|---|---|---|\n";
  for (const auto& entry : all.at("benchmarks")) {
    if (entry.contains("error_occurred")) continue;
    md << "| " << entry.at("name").get<std::string>() << printed(" | %.3g ms | ", 1e3 * seconds_of(entry)) << counters_of(entry) << " |\n";
  }
  return md.str();
}

}  // namespace performance
