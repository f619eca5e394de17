#include "framework/study/fit/fit.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <map>
#include <new>
#include <thread>

#include "framework/bodies/body_store.h"
#include "framework/common/file.h"
#include "framework/common/text.h"
#include "framework/study/share_out.h"
#include "framework/study/sweep/study_folder.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
using clock = std::chrono::steady_clock;

/// Cases by their number: those in the journal are not run again.
class Evaluations {
 public:
  Evaluations(const FitPlan& plan, const fs::path& folder, const FitSettings& settings, FitEnd& end)
      : plan_(plan),
        settings_(settings),
        folder_(folder),
        caller_(std::this_thread::get_id()),
        rows_(plan.evaluations + 1),
        worths_(rows_.size()) {
    journal_ = open_study_folder(plan.base, folder, end.notes);
    for (Row& row : read_journals(folder, plan.base.print, plan.evaluations, &end.notes))
      if (!lacked_memory(row)) ++end.before, known_[row.number] = std::move(row);
  }

  /// The result of a case; nothing if the search has been stopped. Only one thread calls it for a number.
  const Worth* at(std::size_t number, const BoxPoint& u) {
    Row& row = rows_[number];
    if (const auto known = known_.find(number); known != known_.end()) {
      row = known->second;
      must_be_at(row, u);
    } else {
      row = run(number, u);
      if (stopped_ || row.status == status_text(Status::interrupted)) {
        row.number = 0;
        return nullptr;
      }
      journal_->append(row);
    }
    ++done_;
    const std::vector<double> values(row.values.begin() + static_cast<std::ptrdiff_t>(u.size()), row.values.end());
    worths_[number] = row.status == "finished" ? plan_.goal.worth(values) : Worth{};
    return &worths_[number];
  }

  void poll() {
    if (settings_.progress && !settings_.progress(done_, plan_.evaluations)) stopped_ = true;
  }
  bool stopped() const { return stopped_; }

  /// Collects the results of a range of numbers.
  void take(std::size_t first, std::size_t count, const std::string& phase, std::vector<FitCase>& out) const {
    for (std::size_t k = first; k < first + count; ++k)
      if (rows_[k].number > 0) out.push_back({phase, rows_[k], worths_[k]});
  }

 private:
  Row run(std::size_t number, const BoxPoint& u) {
    CaseLimits limits;
    limits.bodies = &bodies_;
    limits.go_on = [this] {
      if (std::this_thread::get_id() == caller_) poll();
      return !stopped_;
    };
    Outcome outcome;
    try {
      outcome = run_case(plan_.base.study.scene, plan_.overrides(u), plan_.base.study.measures, limits);
    } catch (const std::bad_alloc&) {
      outcome.status = status_text(Status::out_of_memory),
      outcome.reason = "there was not enough memory; run fewer cases at once (--threads)";
      outcome.values.assign(plan_.base.study.measures.size(), std::nan(""));
    }
    std::vector<double> values = place(u);
    values.insert(values.end(), outcome.values.begin(), outcome.values.end());
    Row row = row_of(number, outcome, "0");
    row.values = std::move(values);
    return row;
  }

  /// The variables in SI.
  std::vector<double> place(const BoxPoint& u) const {
    std::vector<double> out;
    for (std::size_t j = 0; j < u.size(); ++j) out.push_back(plan_.variables[j].span.span.at(u[j]));
    return out;
  }
  void must_be_at(const Row& row, const BoxPoint& u) const {
    const std::vector<double> here = place(u);
    const auto same_bits = [](double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); };
    if (row.values.size() != here.size() + plan_.base.study.measures.size() ||
        !std::equal(here.begin(), here.end(), row.values.begin(), same_bits))
      throw SceneError(folder_.string(), {},
                       "case " + std::to_string(row.number) +
                           " of the journal differs from the case that the search requests now: the journal was written with another "
                           "version of NLopt or on another processor; name another directory with --out, or remove " +
                           folder_.string());
  }

  const FitPlan& plan_;
  const FitSettings& settings_;
  fs::path folder_;
  std::thread::id caller_;
  std::unique_ptr<Journal> journal_;
  BodyStore bodies_;
  std::map<std::size_t, Row> known_;
  std::vector<Row> rows_;
  std::vector<Worth> worths_;
  std::atomic<std::size_t> done_ = 0;
  std::atomic<bool> stopped_ = false;
};

/// A point and its value.
struct Tried {
  BoxPoint u;
  Worth worth;
};

/// One search by several methods in turn, with a given number of evaluations; cases are numbered from `first`.
class Descent {
 public:
  Descent(const FitPlan& plan, Evaluations& evaluations, std::size_t first, std::size_t share)
      : plan_(plan), evaluations_(evaluations), first_(first), share_(share) {}

  /// @returns how it ended
  std::string go(const Tried& start, double first_step) {
    best_ = start;
    seen_[start.u] = start.worth;
    const WorthAt worth = [this](const BoxPoint& u) { return look(u); };
    std::string end;
    for (const Optimiser method : plan_.methods()) {
      within_ = !plan_.goal.bounds.empty() && !takes_constraints(method);
      if (within_ && best_.worth.worst() > met_within) break;
      SearchSettings s{method,
                       best_.u,
                       within_ ? 0 : plan_.goal.bounds.size(),
                       first_step,
                       plan_.precision,
                       plan_.step,
                       plan_.goal.good_enough(),
                       plan_.seed + first_};
      end += (end.empty() ? "" : ", then ") + std::string(name_of(method)) + ": " + search(s, worth);
      if (s.good_enough >= 0 && best_.worth.worst() <= met_within && best_.worth.value <= s.good_enough) break;
      if (used_ >= share_ || evaluations_.stopped()) break;
      first_step /= 2;
    }
    return end;
  }
  std::size_t used() const { return used_; }
  const Tried& best() const { return best_; }

 private:
  /// For a method without constraints, a point that violates them counts as unknown.
  const Worth* look(const BoxPoint& u) {
    static const Worth beyond{};
    const Worth* found = find(u);
    return found && within_ && found->worst() > met_within ? &beyond : found;
  }

  const Worth* find(const BoxPoint& u) {
    if (const auto seen = seen_.find(u); seen != seen_.end()) return &seen->second;
    if (used_ >= share_) return nullptr;
    const Worth* worth = evaluations_.at(first_ + used_, u);
    if (!worth) return nullptr;
    ++used_;
    if (better(*worth, best_.worth)) best_ = {u, *worth};
    return &(seen_[u] = *worth);
  }

  const FitPlan& plan_;
  Evaluations& evaluations_;
  std::size_t first_, share_, used_ = 0;
  bool within_ = false;  ///< points that violate constraints are hidden
  Tried best_;
  std::map<BoxPoint, Worth> seen_;
};

double apart(const BoxPoint& a, const BoxPoint& b) {
  double out = 0;
  for (std::size_t j = 0; j < a.size(); ++j) out = std::max(out, std::abs(a[j] - b[j]));
  return out;
}

/// Starting points of searches: the study's start, then the best of the other first points, if possible a tenth of the box apart.
std::vector<Tried> chosen_starts(const FitPlan& plan, const std::vector<Tried>& first) {
  constexpr double near = 0.1;
  std::vector<const Tried*> order;
  for (const Tried& p : first)
    if (p.worth.known) order.push_back(&p);
  const bool starts_known = first.front().worth.known;
  std::stable_sort(order.begin() + starts_known, order.end(), [](const Tried* a, const Tried* b) { return better(a->worth, b->worth); });
  std::vector<Tried> out;
  for (const double least : {near, 0.0})
    for (const Tried* p : order) {
      const auto taken = [&](const Tried& q) { return apart(p->u, q.u) <= least; };
      if (out.size() < plan.starts && std::ranges::none_of(out, taken)) out.push_back(*p);
    }
  return out;
}

/// The best result of these phases.
std::optional<std::size_t> best_of(const std::vector<FitCase>& tried, const std::string& phase = "") {
  std::optional<std::size_t> out;
  for (std::size_t k = 0; k < tried.size(); ++k)
    if ((phase.empty() || tried[k].phase == phase) && tried[k].worth.known && (!out || better(tried[k].worth, tried[*out].worth))) out = k;
  return out;
}

void search_all(const FitPlan& plan, Evaluations& evaluations, const FitSettings& settings, FitEnd& end) {
  const auto poll = [&] { evaluations.poll(); };
  const std::size_t n_first = plan.base.cases.size(), share = plan.share();
  std::vector<Tried> first(n_first);
  const auto try_first = [&](std::size_t k, int) {
    first[k].u = plan.point(k);
    if (evaluations.stopped()) return;
    if (const Worth* w = evaluations.at(k + 1, first[k].u)) first[k].worth = *w;
  };
  end.workers = share_out(n_first, settings.threads, try_first, poll).threads;
  evaluations.take(1, n_first, "first points", end.tried);
  if (evaluations.stopped()) return;

  const std::vector<Tried> starts = chosen_starts(plan, first);
  end.ends.resize(starts.size());
  std::vector<Tried> found(starts.size());
  std::vector<std::size_t> used(starts.size());
  share_out(
      starts.size(), settings.threads,
      [&](std::size_t s, int) {
        if (evaluations.stopped()) return;
        Descent descent(plan, evaluations, 1 + n_first + s * share, share);
        end.ends[s] = descent.go(starts[s], 0.1);
        found[s] = descent.best(), used[s] = descent.used();
      },
      poll);
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const std::string phase = "start " + std::to_string(s + 1);
    evaluations.take(1 + n_first + s * share, share, phase, end.tried);
    end.best_of.push_back(best_of(end.tried, phase));
  }
  const std::size_t first_left = 1 + n_first + plan.starts * share;
  if (evaluations.stopped() || plan.method || found.empty() || first_left > plan.evaluations) return;

  const Tried& best = *std::ranges::min_element(found, [](const Tried& a, const Tried& b) { return better(a.worth, b.worth); });
  const std::size_t left = plan.evaluations + 1 - first_left;
  share_out(
      1, settings.threads, [&](std::size_t, int) { Descent(plan, evaluations, first_left, left).go(best, 0.02); }, poll);
  evaluations.take(first_left, left, "last search", end.tried);
}

/// path.csv: the points of a path, and where the curve of the best case passes them.
std::string path_csv(const FitPlan& plan, const FitEnd& end) {
  const Measure& m = plan.base.study.measures[plan.goal.measure];
  CaseLimits limits;
  limits.keep_run = true;
  const Outcome outcome = run_case(plan.base.study.scene, best_point(plan, end), plan.base.study.measures, limits);
  std::string out = "point,x [m],y [m],t [s],curve x [m],curve y [m],distance [m]\n";
  if (!outcome.run) return out;
  const std::vector<Passage> passed = passages_of(m, common_scene(plan.base.study.scene), *outcome.run);
  for (std::size_t k = 0; k < passed.size(); ++k) {
    out += std::to_string(k + 1);
    for (const double x : {m.path->through[k][0], m.path->through[k][1], passed[k].t, passed[k].x, passed[k].y, passed[k].distance})
      out += ',', append_number(out, x);
    out += '\n';
  }
  return out;
}

void write_fit(const FitPlan& plan, const fs::path& folder, const FitEnd& end) {
  std::error_code ignored;
  if (end.stopped) {
    write_synced(folder / "fit-so-far.csv", fit_csv(plan, end));
    return;
  }
  fs::remove(folder / "fit-so-far.csv", ignored);
  fs::remove(folder / "fitted.yaml", ignored);
  write_synced(folder / "fit.csv", fit_csv(plan, end));
  if (end.best && plan.goal.kind == Goal::Kind::path) write_synced(folder / "path.csv", path_csv(plan, end));
  if (end.best && end.tried[*end.best].worth.worst() <= met_within) write_synced(folder / "fitted.yaml", fitted_scene(plan, end, folder));
  write_synced(folder / "fit.json", fit_json(plan, end));
}

}  // namespace

FitEnd run_fit(const FitPlan& plan, const fs::path& folder, const FitSettings& settings) {
  const clock::time_point begin = clock::now();
  FitEnd end;
  {
    Evaluations evaluations(plan, folder, settings, end);
    search_all(plan, evaluations, settings, end);
    end.stopped = evaluations.stopped();
  }
  end.best = best_of(end.tried);
  end.seconds = std::chrono::duration<double>(clock::now() - begin).count();
  write_fit(plan, folder, end);
  return end;
}

}  // namespace pintle
