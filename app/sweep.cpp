// pintle sweep: the cases of a study, by worker threads and processes. pintle merge: its parts, joined.
#include "framework/study/sweep/sweep.h"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>

#include "app/communicator.h"
#include "app/options.h"
#include "app/progress.h"
#include "app/run_end.h"
#include "framework/analysis/simulate/simulate.h"
#include "framework/common/text.h"
#include "framework/study/sweep/merge.h"

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
  std::string ended = std::to_string(end.rows.size()) + " of " + std::to_string(sweep.size());
  if (end.count.before > 0) ended += ", " + std::to_string(end.count.before) + " of them in earlier sessions";
  if (sweep.part) ended += " of " + part_text(*sweep.part) + "; the study has " + counted(sweep.cases.size(), "case");
  if (sweep.size() == 0)
    ended = "none: " + part_text(*sweep.part) + " has no case, as the study has only " + std::to_string(sweep.cases.size());
  rows.emplace_back("cases ended", ended);
  for (const auto& [status, n] : statuses(end.rows)) {
    const Row& first = *std::ranges::find(end.rows, status, &Row::status);
    const std::string why = ", the first is case " + std::to_string(first.number) + ": " + first.reason;
    rows.emplace_back(status, std::to_string(n) + (first.reason.empty() ? "" : why));
  }
  for (const MeasureRange& r : sweep.size() > 0 ? measure_ranges(sweep, end.rows) : std::vector<MeasureRange>())
    rows.emplace_back(r.header, r.least_in == 0 ? "no case has a value"
                                                : number(r.least) + " (case " + std::to_string(r.least_in) + ") to " + number(r.greatest) +
                                                      " (case " + std::to_string(r.greatest_in) + ")");
  if (end.count.done > 0)
    rows.emplace_back("this session",
                      std::to_string(end.count.done) + " cases in " + span_text(end.count.seconds) + " by " + std::to_string(end.workers) +
                          (end.workers > 1 ? " workers, busy " + number(100 * end.efficiency(), 3) + " % of the time" : " worker"));
  rows.emplace_back("table", (out / (end.whole ? table_name(sweep) : "sweep-so-far.csv")).string());
  print_rows(std::cout, rows);
  if (!end.whole) std::cout << "  " << (asked_to_stop() ? stopped_by() : "stopped") << "; the same command continues from here\n";
}

/// Whether there are cases and all were rejected or failed.
bool none_ran(const SweepEnd& end) {
  const auto ran = [](const Row& row) { return row.status == "finished" || row.status == status_text(Status::ledger_over_bound); };
  return !end.rows.empty() && std::ranges::none_of(end.rows, ran);
}

/// A part that has ended is complete even if cases failed: `pintle merge` evaluates all cases together.
int exit_code_of(const Sweep& sweep, const SweepEnd& end) {
  if (sweep.part || !none_ran(end)) return ok;
  std::cerr << sweep.study.file << ": none of " << end.rows.size() << " cases ran to its end; case " << end.rows.front().number << ": "
            << end.rows.front().status << ": " << end.rows.front().reason << "\n";
  return run_failed;
}

void tell_lack_of_memory(const SweepEnd& end, const std::string& remedy) {
  if (const auto n = std::ranges::count_if(end.rows, lacked_memory); n > 0)
    std::cerr << "warning: " << n << (n == 1 ? " case" : " cases") << " lacked memory; " << remedy << (n == 1 ? "it" : "them")
              << " again\n";
}

void tell_warnings(const SweepEnd& end, const fs::path& out) {
  const std::string text = warnings_text(end.rows, end.whole ? out / "warnings.csv" : fs::path());
  if (!text.empty()) std::cerr << "warning: " << text << "\n";
}

/// Ending of the name of a part's folder, so that parts do not share one: "-3-of-8".
std::string own_name(const Sweep& sweep) {
  return sweep.part ? "-" + std::to_string(sweep.part->number) + "-of-" + std::to_string(sweep.part->count) : "";
}

int carry_out(const Sweep& sweep, const Options& options, Communicator* together, bool leads) {
  const fs::path out = study_directory(options, "-sweep" + own_name(sweep));
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
  tell_lack_of_memory(end, "the same command, with fewer --threads, runs ");
  tell_warnings(end, out);
  if (options.json)
    std::cout << sweep_json(sweep, end);
  else if (!options.quiet)
    print(sweep, end, out);
  if (!end.whole && (options.quiet || options.json))
    std::cerr << sweep.study.file << ": " << (asked_to_stop() ? stopped_by() : "stopped") << "; the same command continues from here\n";
  if (!end.whole) return stopped;
  return exit_code_of(sweep, end);
}

}  // namespace

int sweep(const Options& options) {
  const std::unique_ptr<Communicator> together = communicator();
  const bool leads = !together || together->rank() == 0;
  Sweep what;
  std::optional<SweepPart> part;
  try {
    if (options.shard) part = read_part(*options.shard);
    what = read_sweep(options.scene, overrides(options));
    what.part = part;
  } catch (...) {
    // An error that stops one process usually stops all: only one of them reports it.
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

int merge(const Options& options) {
  const std::filesystem::path out = results_directory(options);
  require_place(out);
  for (const std::string& part : options.folders)
    if (const std::string from = fs::proximate(fs::absolute(out), fs::absolute(part)).string(); !from.starts_with(".."))
      throw SceneError("--out " + out.string() + ": lies in the part " + part + "; name a folder outside of the parts");
  now_doing("reading the parts");
  const Merged merged = read_parts({options.folders.begin(), options.folders.end()});
  for (const std::string& note : merged.end.notes) std::cerr << "note: " << note << "\n";
  write_whole(options, out, [&](const fs::path& folder) { write_merged(merged, folder); });
  tell_lack_of_memory(merged.end, "pintle sweep " + merged.sweep.study.file + " --out " + out.string() + " runs ");
  tell_warnings(merged.end, out);
  if (options.json)
    std::cout << sweep_json(merged.sweep, merged.end);
  else if (!options.quiet)
    print(merged.sweep, merged.end, out);
  return exit_code_of(merged.sweep, merged.end);
}

}  // namespace pintle::app
