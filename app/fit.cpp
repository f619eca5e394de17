// pintle fit: parameters that achieve a goal.
#include "framework/study/fit/fit.h"

#include <algorithm>
#include <iostream>
#include <map>

#include "app/options.h"
#include "app/progress.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;

std::string methods_text(const FitPlan& plan) {
  std::string out;
  for (const Optimiser m : plan.methods())
    if (!out.ends_with(name_of(m))) out += (out.empty() ? "" : ", then ") + std::string(name_of(m));
  return out + " from " + std::to_string(plan.starts) + (plan.starts == 1 ? " start" : " starts") + ", seed " + std::to_string(plan.seed);
}

std::string cases_text(const FitPlan& plan, const FitEnd& end) {
  std::map<std::string, std::size_t> trouble;
  for (const FitCase& t : end.tried)
    if (!t.worth.known) ++trouble[t.row.status == "finished" ? "without the measure" : t.row.status];
  std::string out = std::to_string(end.tried.size()) + " of at most " + std::to_string(plan.evaluations);
  for (const auto& [status, n] : trouble) out += ", " + std::to_string(n) + " " + status;
  if (end.before > 0) out += "; " + std::to_string(end.before) + " in earlier sessions";
  return out;
}

void add_best(Rows& rows, const FitPlan& plan, const FitEnd& end) {
  const FitCase& t = end.tried[*end.best];
  const std::vector<double> values = measured_values(plan, t);
  for (std::size_t m = 0; m < values.size(); ++m) rows.emplace_back(measured_header(plan, end, m), number(values[m], 9));
  for (std::size_t i = 0; i < plan.goal.bounds.size(); ++i) {
    const Bound& b = plan.goal.bounds[i];
    rows.emplace_back(measured_header(plan, end, b.measure), std::string(b.at_most ? "at most " : "at least ") + number(b.limit) +
                                                                 (t.worth.excess[i] <= met_within ? ": met" : ": NOT MET"));
  }
  for (std::size_t j = 0; j < plan.variables.size(); ++j) {
    const ValueSpan& span = plan.variables[j].span;
    const double x = variable_value(t, j), u = span.where(x);
    const char* end_of_span = u < 1e-6 ? ", at the lower end of its span" : u > 1 - 1e-6 ? ", at the upper end of its span" : "";
    rows.emplace_back(variable_header(plan.variables[j]),
                      number(x, 9) + " (from " + number(span.span.from) + " to " + number(span.span.to) + end_of_span + ")");
  }
  rows.emplace_back("found", "in case " + std::to_string(t.row.number) + ", " + t.phase + "; " + std::to_string(agreeing(plan, end)) +
                                 " of " + std::to_string(end.best_of.size()) + " starts reached it independently");
}

void print(const FitPlan& plan, const FitEnd& end, const fs::path& out) {
  std::cout << (plan.base.study.title.empty() ? plan.base.study.file : plan.base.study.title) << "\n";
  Rows rows{{"method", methods_text(plan)}, {"cases", cases_text(plan, end)}};
  if (end.best) add_best(rows, plan, end);
  rows.emplace_back("computing",
                    number(end.seconds, 3) + " s by " + std::to_string(end.workers) + (end.workers > 1 ? " workers" : " worker"));
  if (end.stopped)
    rows.emplace_back("history", (out / "fit-so-far.csv").string());
  else
    rows.emplace_back("results", (out / "fit.csv").string() +
                                     (fs::exists(out / "fitted.yaml") ? ", ready to run: " + (out / "fitted.yaml").string() : ""));
  print_rows(std::cout, rows);
  if (end.stopped) std::cout << "  " << stopped_by() << "; the same command continues from here\n";
}

/// What is missing in the result; empty if nothing.
std::string lack(const FitPlan& plan, const FitEnd& end) {
  if (!end.best) {
    const auto first = std::ranges::find_if(end.tried, [](const FitCase& t) { return !t.worth.known; });
    std::string out =
        "none of " + std::to_string(end.tried.size()) + " points could be measured; give a start that works, or more sample points";
    if (first != end.tried.end()) out += "; the first: " + first->row.status + (first->row.reason.empty() ? "" : ": " + first->row.reason);
    return out;
  }
  if (end.tried[*end.best].worth.worst() > met_within)
    return "no point was found that meets all limits of `subject to`; fitted.yaml is not written. Widen the ranges of `vary` or the "
           "limits, or "
           "allow more evaluations";
  if (!end.meets(plan)) return "the goal is not reached within its tolerance; the nearest point is in fitted.yaml";
  return "";
}

}  // namespace

int fit(const Options& options) {
  now_doing("reading the study");
  const FitPlan plan = read_fit(options.scene, overrides(options));
  const fs::path out = study_directory(options, "-fit");
  FitSettings settings;
  settings.threads = thread_count(options);
  FitEnd end;
  now_doing("searching");
  {
    StatusLine line(options.quiet || options.json);
    settings.progress = [&](std::size_t done, std::size_t most) {
      if (line.due()) line.show(std::to_string(done) + " cases of at most " + std::to_string(most));
      return !asked_to_stop();
    };
    end = run_fit(plan, out, settings);
  }
  for (const std::string& note : end.notes) std::cerr << "note: " << note << "\n";
  if (end.best)
    for (const std::string& warning : end.tried[*end.best].row.warnings) std::cerr << "warning: the best case: " << warning << "\n";
  if (options.json)
    std::cout << fit_json(plan, end);
  else if (!options.quiet)
    print(plan, end, out);
  if (end.stopped) {
    if (options.quiet || options.json)
      std::cerr << plan.base.study.file << ": " << stopped_by() << "; the same command continues from here\n";
    return stopped;
  }
  if (const std::string what = lack(plan, end); !what.empty()) {
    std::cerr << plan.base.study.file << ": " << what << "\n";
    return run_failed;
  }
  return ok;
}

}  // namespace pintle::app
