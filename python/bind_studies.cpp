// Studies: the many runs of a study file.
#include <algorithm>

#include "framework/common/file.h"
#include "framework/common/library_threads.h"
#include "framework/plots/tradeoff_plot.h"
#include "framework/report/run_report.h"
#include "framework/study/fit/fit.h"
#include "framework/study/nonlinear/nonlinear.h"
#include "framework/study/sensitivity/sensitivity.h"
#include "framework/study/sweep/sweep.h"
#include "framework/study/tradeoff/tradeoff_question.h"
#include "python/bindings.h"

namespace pintle::python {

namespace {

// `called`: what results call the study; empty: its file

/// (sweep.csv, sweep.json, warnings.csv or "", the same in a sentence)
py::tuple sweep(const std::string& study, const std::string& called, const std::string& folder, const Overrides& set, int threads) {
  Watch watch;
  std::string csv, json, warnings, sentence;
  {
    const py::gil_scoped_release free;
    Sweep what = read_sweep(study, set);
    if (!called.empty()) what.study.file = called;
    SweepSettings settings;
    settings.threads = threads;
    settings.progress = [&](const SweepCount&) { return watch(); };
    const SweepEnd end = run_sweep(what, folder, settings);
    csv = sweep_csv(what, end.rows), json = sweep_json(what, end);
    warnings = warnings_csv(end.rows), sentence = warnings_text(end.rows, {});
  }
  watch.raise();
  return py::make_tuple(csv, json, warnings, sentence);
}

/// (fit.csv, fit.json, whether the goal is met, the scene's file, its overrides for the best point, this point by name, its measures by name,
/// warnings of the best case); the file is empty if no point was found
py::tuple fit(const std::string& study, const std::string& called, const std::string& folder, const Overrides& set, int threads) {
  Watch watch;
  std::string csv, json;
  std::optional<std::string> file;
  bool met = false;
  std::vector<std::tuple<std::string, double>> point, measures;
  std::vector<std::string> warnings;
  Overrides best;
  {
    const py::gil_scoped_release free;
    FitPlan plan = read_fit(study, set);
    if (!called.empty()) plan.base.study.file = called;
    FitSettings settings;
    settings.threads = threads;
    settings.progress = [&](std::size_t, std::size_t) { return watch(); };
    const FitEnd end = run_fit(plan, folder, settings);
    csv = fit_csv(plan, end), json = fit_json(plan, end);
    if (end.best) {
      const FitCase& t = end.tried[*end.best];
      warnings = t.row.warnings;
      met = end.meets(plan), file = plan.source.file.string(), best = plan.source.common;
      for (auto& [name, value] : best_point(plan, end)) best.emplace_back(name, value);
      for (std::size_t j = 0; j < plan.variables.size(); ++j) point.emplace_back(variable_header(plan.variables[j]), variable_value(t, j));
      const std::vector<double> values = measured_values(plan, t);
      for (std::size_t k = 0; k < values.size(); ++k) measures.emplace_back(measured_header(plan, end, k), values[k]);
    }
  }
  watch.raise();
  return py::make_tuple(csv, json, met, file, best, point, measures, warnings);
}

/// The number of cases that did not run to their end, and the reason of the first; otherwise their warnings; empty: there are none.
std::string doubts(const std::vector<Row>& rows) {
  const auto lost = [](const Row& r) { return r.status != "finished"; };
  const auto first = std::ranges::find_if(rows, lost);
  if (first == rows.end()) return warnings_text(rows, {});
  return std::to_string(std::ranges::count_if(rows, lost)) + " of " + std::to_string(rows.size()) +
         " cases did not run to their end and are left out of the results; case " + std::to_string(first->number) + ": " + first->status +
         ": " + first->reason;
}

/// (sensitivity.csv, sensitivity.json, sweep.csv, a warning or "")
py::tuple sensitivity(const std::string& study, const std::string& called, const std::string& folder, const Overrides& set, int threads) {
  Watch watch;
  std::string csv, json, cases, warning;
  {
    const py::gil_scoped_release free;
    SensitivityPlan plan = read_sensitivity(study, set);
    if (!called.empty()) plan.sweep.study.file = called;
    SweepSettings settings;
    settings.threads = threads;
    settings.progress = [&](const SweepCount&) { return watch(); };
    const SweepEnd end = run_sweep(plan.sweep, folder, settings);
    if (end.whole) {
      const std::vector<MeasureSensitivity> all = sensitivities(plan, end.rows);
      csv = sensitivity_csv(plan, all), json = sensitivity_json(plan, all);
      cases = sweep_csv(plan.sweep, end.rows), warning = doubts(end.rows);
      write_synced(std::filesystem::path(folder) / "sensitivity.csv", csv);
      write_synced(std::filesystem::path(folder) / "sensitivity.json", json);
    }
  }
  watch.raise();
  return py::make_tuple(csv, json, cases, warning);
}

/// (values.csv, the output of `pintle nonlinear --json`, section.csv, orbits.csv, attractors.csv, lyapunov.csv), None for tables not requested
py::tuple nonlinear(const std::string& study, const std::string& called, const std::string& folder, const Overrides& set, int threads) {
  Watch watch;
  std::string values, json;
  std::optional<std::string> section, orbits, attractors, exponents;
  {
    const py::gil_scoped_release free;
    Nonlinear what = read_nonlinear(study, set);
    if (!called.empty()) what.sweep.study.file = called;
    SweepSettings settings;
    settings.threads = threads;
    settings.progress = [&](const SweepCount&) { return watch(); };
    const SweepEnd end = run_nonlinear(what, folder, settings);
    if (end.whole) {
      const std::vector<FollowedValue> all = followed(what, end.rows);
      values = values_csv(what, all), json = nonlinear_json(what, all);
      if (what.question.section) section = section_csv(what, all);
      if (what.question.cycle) orbits = orbits_csv(what, all);
      if (what.basins) attractors = attractors_csv(what, all);
      if (what.question.lyapunov) exponents = lyapunov_csv(what, all);
    }
  }
  watch.raise();
  return py::make_tuple(values, json, section, orbits, attractors, exponents);
}

/// (tradeoff.csv, tradeoff.json, the report as text, the scene's file, overrides of the recommended setting or None)
py::tuple tradeoff(const std::string& file, const std::optional<std::string>& folder, const Overrides& set, const TradeWishes& wishes) {
  Watch watch;
  std::string csv, json, text, scene;
  std::optional<Overrides> recommended;
  {
    const py::gil_scoped_release free;
    hold_library_threads();
    const TradeQuestion question = read_trade_question(file, wishes, set);
    TradeListener listener;
    listener.go_on = [&] { return watch(); };
    const TradeReport report = run_tradeoff(question, listener);
    csv = tradeoff_csv(report), json = tradeoff_json(report), text = tradeoff_text(report), scene = question.scene.file.string();
    if (report.recommended) {
      recommended = question.scene.common;
      const Overrides& own = report.points[*report.recommended].set;
      recommended->insert(recommended->end(), own.begin(), own.end());
    }
    if (folder) {
      std::filesystem::create_directories(*folder);
      write_tradeoff(*folder, *folder, question.scene, report);
      write_text(std::filesystem::path(*folder) / "tradeoff.svg", tradeoff_svg(report));
    }
  }
  watch.raise();
  return py::make_tuple(csv, json, text, scene, recommended);
}

}  // namespace

void bind_studies(py::module_& m) {
  m.def("sweep", &sweep);
  m.def("fit", &fit);
  m.def("sensitivity", &sensitivity);
  m.def("nonlinear", &nonlinear);
  m.def("tradeoff", [](const std::string& file, const std::optional<std::string>& folder, const Overrides& set,
                       std::vector<std::string> quantities, std::string error, std::string time, std::string budget, int repeats) {
    return tradeoff(file, folder, set, {std::move(quantities), std::move(error), std::move(time), std::move(budget), repeats, ""});
  });
  m.def("report", [](const std::string& directory) {
    const py::gil_scoped_release free;
    return report_page(directory);
  });
}

}  // namespace pintle::python
