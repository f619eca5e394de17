// pintle sweep: the cases of a study, by worker threads and processes.
#include "framework/study/sweep/sweep.h"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "app/communicator.h"
#include "app/options.h"
#include "app/progress.h"
#include "framework/analysis/simulate/simulate.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;

/// "137 of 400 cases, 2 not finished, 8.31 a second, 32 s left".
std::string line(const SweepCount& c) {
  std::ostringstream s;
  s << c.before + c.done << " of " << c.cases << " cases";
  if (c.trouble > 0) s << ", " << c.trouble << " not finished";
  if (c.done > 0 && c.seconds > 0) {
    const double done = static_cast<double>(c.done);
    s << std::setprecision(3) << ", " << done / c.seconds << " a second"
      << time_left(done, static_cast<double>(c.cases - c.before), c.seconds);
  }
  return s.str();
}

void print(const Sweep& sweep, const SweepEnd& end, const fs::path& out) {
  std::cout << (sweep.study.title.empty() ? sweep.study.file : sweep.study.title) << "\n";
  Rows rows;
  std::string ended = std::to_string(end.rows.size()) + " of " + std::to_string(sweep.cases.size());
  if (end.count.before > 0) ended += ", " + std::to_string(end.count.before) + " of them in earlier sessions";
  rows.emplace_back("cases ended", ended);
  for (const auto& [status, n] : statuses(end.rows)) {
    const Row& first = *std::ranges::find(end.rows, status, &Row::status);
    const std::string why = ", the first is case " + std::to_string(first.number) + ": " + first.reason;
    rows.emplace_back(status, std::to_string(n) + (first.reason.empty() ? "" : why));
  }
  for (const MeasureRange& r : measure_ranges(sweep, end.rows))
    rows.emplace_back(r.header, r.least_in == 0 ? "no case has a value"
                                                : number(r.least) + " (case " + std::to_string(r.least_in) + ") to " + number(r.greatest) +
                                                      " (case " + std::to_string(r.greatest_in) + ")");
  if (end.count.done > 0)
    rows.emplace_back("this session",
                      std::to_string(end.count.done) + " cases in " + span_text(end.count.seconds) + " by " + std::to_string(end.workers) +
                          (end.workers > 1 ? " workers, busy " + number(100 * end.efficiency(), 3) + " % of the time" : " worker"));
  rows.emplace_back("table", (out / (end.whole ? "sweep.csv" : "sweep-so-far.csv")).string());
  print_rows(std::cout, rows);
  if (!end.whole) std::cout << "  " << (asked_to_stop() ? stopped_by() : "stopped") << "; the same command continues from here\n";
}

/// There are cases, and each was rejected or failed.
bool none_ran(const SweepEnd& end) {
  const auto ran = [](const Row& row) { return row.status == "finished" || row.status == status_text(Status::ledger_over_bound); };
  return !end.rows.empty() && std::ranges::none_of(end.rows, ran);
}

int carry_out(const Sweep& sweep, const Options& options, Communicator* together, bool leads) {
  const fs::path out = study_directory(options, "-sweep");
  SweepSettings settings;
  settings.threads = options.threads == 0 && together ? 1 : thread_count(options);
  settings.communicator = together;
  SweepEnd end;
  now_doing("running the cases");
  {
    StudyLine progress(options.quiet || !leads);
    settings.progress = [&](const SweepCount& count) {
      progress.tell([&] { return line(count); });
      return !asked_to_stop();
    };
    end = run_sweep(sweep, out, settings);
  }
  for (const std::string& note : end.notes) std::cerr << "note: " << note << "\n";
  if (!end.shortage.empty()) std::cerr << "warning: " << end.shortage << "\n";
  if (!leads) return ok;
  if (const auto n = std::ranges::count_if(end.rows, lacked_memory); n > 0)
    std::cerr << "warning: " << n << (n == 1 ? " case" : " cases") << " lacked memory; the same command, with fewer --threads, runs "
              << (n == 1 ? "it" : "them") << " again\n";
  if (options.json)
    std::cout << sweep_json(sweep, end);
  else if (!options.quiet)
    print(sweep, end, out);
  if (!end.whole && (options.quiet || options.json))
    std::cerr << sweep.study.file << ": " << (asked_to_stop() ? stopped_by() : "stopped") << "; the same command continues from here\n";
  if (!end.whole) return stopped;
  if (none_ran(end)) {
    std::cerr << sweep.study.file << ": none of " << end.rows.size() << " cases ran to its end; case " << end.rows.front().number << ": "
              << end.rows.front().status << ": " << end.rows.front().reason << "\n";
    return run_failed;
  }
  return ok;
}

}  // namespace

int sweep(const Options& options) {
  const std::unique_ptr<Communicator> together = communicator();
  const bool leads = !together || together->rank() == 0;
  Sweep what;
  try {
    what = read_sweep(options.scene, overrides(options));
  } catch (...) {
    // What stops one process usually stops all: only one of them reports it.
    if (together && leads)
      reject_all(*together);
    else if (together && rejected(*together))
      return ok;
    else if (together)
      stay_away(*together);
    throw;
  }
  return carry_out(what, options, together.get(), leads);
}

}  // namespace pintle::app
