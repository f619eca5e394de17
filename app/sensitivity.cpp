// pintle sensitivity: how measures depend on parameters and their tolerances.
#include "framework/study/sensitivity/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "app/options.h"
#include "app/progress.h"
#include "framework/common/file.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;

std::string interval_text(const Share& s) {
  char text[64];
  std::snprintf(text, sizeof text, "%6.3f (%6.3f to %6.3f)", s.value, s.low, s.high);
  return text;
}

void print_measure(const SensitivityPlan& plan, const MeasureSensitivity& m) {
  std::size_t width = 10;
  for (const Scattered& p : plan.parameters) width = std::max(width, parameter_header(p).size());
  const int w = static_cast<int>(width);
  std::printf("\n  %s = %s\n    %-*s %15s %10s", m.header.c_str(), number(m.nominal, 9).c_str(), w, "parameter", "derivative", "error");
  const bool scatters = m.linear_worst > 0;
  if (scatters) std::printf(" %15s", "its tolerance");
  if (!m.shares.empty()) std::printf("   %-25s  %-25s", "first order (95 %)", "total (95 %)");
  for (std::size_t i = 0; i < plan.parameters.size(); ++i) {
    const Scattered& p = plan.parameters[i];
    std::printf("\n    %-*s %15.8g %10.2g", w, parameter_header(p).c_str(), m.slopes[i].value, m.slopes[i].error);
    if (scatters) std::printf(" %15s", p.width > 0 ? ("+-" + number(std::abs(m.slopes[i].value) * p.reach(), 5)).c_str() : "");
    if (!m.shares.empty()) std::printf("   %s  %s", interval_text(m.shares[i].first).c_str(), interval_text(m.shares[i].total).c_str());
  }
  std::printf("\n");
  if (scatters) std::printf("    worst case by derivatives  +-%s\n", number(m.linear_worst).c_str());
  if (m.corners)
    std::printf("    worst case by corners      %s to %s\n", number(m.corners->least, 9).c_str(), number(m.corners->greatest, 9).c_str());
  if (m.scatter)
    std::printf("    Monte Carlo                mean %s, standard deviation %s, 95 %% from %s to %s (%zu cases)\n",
                number(m.scatter->mean, 9).c_str(), number(m.scatter->deviation).c_str(), number(m.scatter->low, 9).c_str(),
                number(m.scatter->high, 9).c_str(), m.scatter->cases);
}

void print(const SensitivityPlan& plan, const std::vector<MeasureSensitivity>& all, const SweepEnd& end, const fs::path& out) {
  std::cout << (plan.sweep.study.title.empty() ? plan.sweep.study.file : plan.sweep.study.title) << std::endl;
  for (const MeasureSensitivity& m : all) print_measure(plan, m);
  std::fflush(stdout);
  Rows rows;
  std::string ended = std::to_string(end.rows.size());
  for (const auto& [status, n] : statuses(end.rows))
    if (status != "finished") ended += ", " + std::to_string(n) + " " + status;
  rows.emplace_back("cases", ended);
  rows.emplace_back("results", (out / "sensitivity.csv").string());
  std::cout << "\n";
  print_rows(std::cout, rows);
}

// Whether every measure has a nominal value; reports those without.
bool has_values(const SensitivityPlan& plan, const std::vector<MeasureSensitivity>& all) {
  bool out = true;
  for (const MeasureSensitivity& m : all)
    if (std::isnan(m.nominal))
      std::cerr << plan.sweep.study.file << ": " << m.header << ": the case without deviations has no value\n", out = false;
  return out;
}

}  // namespace

int sensitivity(const Options& options) {
  now_doing("reading the study");
  const SensitivityPlan plan = read_sensitivity(options.scene, overrides(options));
  const fs::path out = study_directory(options, "-sensitivity");
  SweepSettings settings;
  settings.threads = thread_count(options);
  handle_signals();
  settings.progress = [](const SweepCount&) { return !asked_to_stop(); };
  now_doing("running the cases");
  const SweepEnd end = run_sweep(plan.sweep, out, settings);
  for (const std::string& note : end.notes) std::cerr << "note: " << note << "\n";
  if (!end.whole) {
    std::cerr << plan.sweep.study.file << ": " << (asked_to_stop() ? stopped_by() : "stopped") << " after " << end.rows.size() << " of "
              << plan.sweep.cases.size() << " cases; the same command continues from here\n";
    return stopped;
  }
  if (const std::string text = warnings_text(end.rows, out / "warnings.csv"); !text.empty()) std::cerr << "warning: " << text << "\n";
  const std::vector<MeasureSensitivity> all = sensitivities(plan, end.rows);
  write_synced(out / "sensitivity.csv", sensitivity_csv(plan, all));
  write_synced(out / "sensitivity.json", sensitivity_json(plan, all));
  if (options.json)
    std::cout << sensitivity_json(plan, all);
  else if (!options.quiet)
    print(plan, all, end, out);
  const auto ran = [](const Row& r) { return r.status == "finished"; };
  if (std::ranges::all_of(end.rows, ran)) return has_values(plan, all) ? ok : run_failed;
  if (const auto lost = std::ranges::find_if_not(end.rows, ran); std::ranges::any_of(end.rows, ran)) {
    std::cerr << plan.sweep.study.file << ": " << std::ranges::count_if(end.rows, [&](const Row& r) { return !ran(r); }) << " of "
              << end.rows.size() << " cases did not run to their end and are left out of the results; case " << lost->number << ": "
              << lost->status << ": " << lost->reason << "\n";
    return run_failed;
  }
  std::cerr << plan.sweep.study.file << ": none of " << end.rows.size() << " cases ran to its end; case 1: " << end.rows.front().status
            << ": " << end.rows.front().reason << "\n";
  return run_failed;
}

}  // namespace pintle::app
