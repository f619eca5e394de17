// Studies: the many runs of a study file.
#include "framework/report/run_report.h"
#include "framework/study/fit/fit.h"
#include "framework/study/sweep/sweep.h"
#include "python/bindings.h"

namespace pintle::python {

namespace {

/// (sweep.csv, sweep.json)
py::tuple sweep(const std::string& study, const std::string& folder, const Overrides& set, int threads) {
  Watch watch;
  std::string csv, json;
  {
    const py::gil_scoped_release free;
    const Sweep what = read_sweep(study, set);
    SweepSettings settings;
    settings.threads = threads;
    settings.progress = [&](const SweepCount&) { return watch(); };
    const SweepEnd end = run_sweep(what, folder, settings);
    csv = sweep_csv(what, end.rows), json = sweep_json(what, end);
  }
  watch.raise();
  return py::make_tuple(csv, json);
}

/// (fit.csv, fit.json, whether the goal is met, the scene's file, its overrides for the best point, this point by name, its measures by name);
/// the file is empty if no point was found
py::tuple fit(const std::string& study, const std::string& folder, const Overrides& set, int threads) {
  Watch watch;
  std::string csv, json;
  std::optional<std::string> file;
  bool met = false;
  std::vector<std::tuple<std::string, double>> point, measures;
  Overrides best;
  {
    const py::gil_scoped_release free;
    const FitPlan plan = read_fit(study, set);
    FitSettings settings;
    settings.threads = threads;
    settings.progress = [&](std::size_t, std::size_t) { return watch(); };
    const FitEnd end = run_fit(plan, folder, settings);
    csv = fit_csv(plan, end), json = fit_json(plan, end);
    if (end.best) {
      const FitCase& t = end.tried[*end.best];
      met = end.meets(plan), file = plan.source.file.string(), best = plan.source.common;
      for (auto& [name, value] : best_point(plan, end)) best.emplace_back(name, value);
      for (std::size_t j = 0; j < plan.variables.size(); ++j) point.emplace_back(variable_header(plan.variables[j]), variable_value(t, j));
      const std::vector<double> values = measured_values(plan, t);
      for (std::size_t k = 0; k < values.size(); ++k) measures.emplace_back(measured_header(plan, end, k), values[k]);
    }
  }
  watch.raise();
  return py::make_tuple(csv, json, met, file, best, point, measures);
}

}  // namespace

void bind_studies(py::module_& m) {
  m.def("sweep", &sweep);
  m.def("fit", &fit);
  m.def("report", [](const std::string& directory) {
    const py::gil_scoped_release free;
    return report_page(directory);
  });
}

}  // namespace pintle::python
