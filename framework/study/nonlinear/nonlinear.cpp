#include "framework/study/nonlinear/nonlinear.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <new>
#include <numeric>
#include <thread>

#include "framework/bodies/body_store.h"
#include "framework/common/file.h"
#include "framework/common/library_threads.h"
#include "framework/common/processor_time.h"
#include "framework/study/share_out.h"
#include "framework/study/sweep/study_folder.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
using wall_clock = std::chrono::steady_clock;

double seconds_since(wall_clock::time_point begin) { return std::chrono::duration<double>(wall_clock::now() - begin).count(); }

/// Threads that follow chains of values and write the results into the journal. They continue from values that are already there.
class ChainWorkers {
 public:
  ChainWorkers(const Nonlinear& study, Journal& journal, std::vector<Row> ended)
      : study_(study), journal_(journal), chains_(study.chains()) {
    for (const std::vector<double>& at : parameter_numbers(study)) x_.push_back(at.empty() ? 0 : at[0]);
    for (Row& row : ended)
      if (!lacked_memory(row)) ended_.emplace(row.number, std::move(row));
  }

  void work(const SweepSettings& settings, const std::function<void(const Underway&)>& far, SweepEnd& end) {
    const auto begin = wall_clock::now();
    const auto look = [&] {
      count(end.count);
      end.count.seconds = seconds_since(begin);
    };
    report_ = [&] {
      look();
      if (far) far(underway());
      if (settings.progress && !settings.progress(end.count)) stopped_ = true;
    };
    const auto follow_chain = [&](std::size_t chain, int thread) {
      hold_library_threads();
      follow(chains_[chain], thread);
    };
    end.shortage = share_out(chains_.size(), settings.threads, follow_chain, report_).shortage;
    look();
  }

 private:
  Underway underway() {
    const std::lock_guard lock(mutex_);
    Underway out;
    for (const auto& [number, far] : begun_) ++out.values, out.share += far.share, out.at = far.at;
    return out;
  }

  void count(SweepCount& count) {
    const std::lock_guard lock(mutex_);
    count.done = done_, count.trouble = troubled_, count.busy = busy_;
  }

  void follow(const std::vector<std::size_t>& chain, int thread) {
    Orbit before;
    bool known = false;
    for (const std::size_t number : chain) {
      if (stopped_) return;
      if (const auto found = ended_.find(number); found != ended_.end()) {
        before = Orbit::of(found->second.values);
      } else {
        const auto begin = wall_clock::now();
        const double begin_computing = processor_time();
        Row row = follow_one(number, known ? &before : nullptr);
        set_progress(number, {});
        if (stopped_ || row.status == status_text(Status::interrupted)) return;
        row.worker = "0." + std::to_string(thread);
        row.run_seconds = processor_time() - begin_computing;
        journal_.append(row);
        if (row.status == status_text(Status::out_of_memory)) return;
        before = Orbit::of(row.values);
        const std::lock_guard lock(mutex_);
        ++done_, troubled_ += row.status != "finished", busy_ += seconds_since(begin);
      }
      known = !before.end.empty();
    }
  }

  struct Far {
    double share = 0;
    std::string at;
  };
  /// Stores the progress of a value; nothing: it has ended.
  void set_progress(std::size_t number, const std::optional<Far>& far) {
    const std::lock_guard lock(mutex_);
    if (far)
      begun_[number] = *far;
    else
      begun_.erase(number);
  }

  Row follow_one(std::size_t number, const Orbit* before) {
    Row row;
    row.number = number;
    const OrbitLimits limits{.seconds = study_.sweep.limits.seconds, .go_on = [&](double share, const std::string& at) {
                               set_progress(number, Far{share, at});
                               if (std::this_thread::get_id() == caller_) report_();
                               return !stopped_;
                             }};
    try {
      const std::size_t k = study_.case_of(number);
      const OrbitEnd end =
          follow_orbit(study_.sweep.study.scene, study_.sweep.cases.overrides(k), study_.question, before, x_[k], bodies_, limits);
      row.status = end.status, row.reason = end.reason, row.values = end.orbit.numbers(), row.units = end.units;
      row.warnings = end.warnings;
      row.t_end = end.orbit.end_t, row.steps = end.steps, row.impacts = end.impacts;
    } catch (const std::bad_alloc&) {
      row.status = status_text(Status::out_of_memory), row.reason = "there was not enough memory; follow fewer values at once (--threads)";
      row.values = Orbit{}.numbers();
    }
    return row;
  }

  const Nonlinear& study_;
  Journal& journal_;
  const std::vector<std::vector<std::size_t>> chains_;
  std::vector<double> x_;  ///< the parameter of each case
  std::map<std::size_t, Row> ended_;
  BodyStore bodies_;
  std::function<void()> report_;
  std::thread::id caller_ = std::this_thread::get_id();  ///< reports during the computation if there are no other threads
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;  ///< protects the members below
  std::size_t done_ = 0, troubled_ = 0;
  std::map<std::size_t, Far> begun_;  ///< by their numbers
  double busy_ = 0;
};

void write_results(const Nonlinear& study, const fs::path& folder, const std::vector<Row>& rows) {
  const std::vector<FollowedValue> values = followed(study, rows);
  if (study.question.section) write_synced(folder / "section.csv", section_csv(study, values));
  if (study.question.cycle) write_synced(folder / "orbits.csv", orbits_csv(study, values));
  if (study.basins) write_synced(folder / "attractors.csv", attractors_csv(study, values));
  if (study.question.lyapunov) write_synced(folder / "lyapunov.csv", lyapunov_csv(study, values));
  write_synced(folder / "timings.csv", timings_csv(rows));
  if (const std::string warnings = warnings_csv(rows); !warnings.empty()) write_synced(folder / "warnings.csv", warnings);
  write_synced(folder / "values.csv", values_csv(study, values));
  write_synced(folder / "nonlinear.json", nonlinear_json(study, values));
}

}  // namespace

std::vector<std::vector<std::size_t>> Nonlinear::chains() const {
  std::vector<std::size_t> up(sweep.cases.size());
  std::iota(up.begin(), up.end(), std::size_t{1});
  std::vector<std::vector<std::size_t>> out;
  if (order == Order::from_start) {
    for (const std::size_t k : up) out.push_back({k});
    return out;
  }
  if (order == Order::backwards) std::ranges::reverse(up);
  if (order == Order::both)
    for (std::size_t k = sweep.cases.size(); k > 0; --k) up.push_back(sweep.cases.size() + k);
  return {up};
}

SweepEnd run_nonlinear(const Nonlinear& study, const fs::path& folder, const SweepSettings& settings,
                       const std::function<void(const Underway&)>& far) {
  SweepEnd end;
  end.workers = settings.threads;
  end.count.cases = study.size();
  const std::unique_ptr<Journal> journal = open_study_folder(study.sweep, folder, end.notes);
  const auto ended = [&] { return read_journals(folder, study.sweep.print, study.size()); };
  const std::vector<Row> before = ended();
  end.count.before = static_cast<std::size_t>(std::ranges::count_if(before, [](const Row& row) { return !lacked_memory(row); }));
  ChainWorkers(study, *journal, before).work(settings, far, end);
  end.rows = ended();
  end.whole = end.rows.size() == study.size();
  if (!end.rows.empty()) write_results(study, folder, end.rows);
  return end;
}

}  // namespace pintle
