#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "framework/common/printed.h"
#include "framework/study/tradeoff/convergence.h"
#include "framework/study/tradeoff/refinement.h"
#include "framework/study/tradeoff/tradeoff.h"

namespace pintle {

namespace {

using Clock = std::chrono::steady_clock;
using At = std::vector<std::size_t>;

// Shares of a budget: for the reference, and for a reference that is still insufficient; of the remaining time, the shares after which no
// further setting and no further run of an ensemble is started.
constexpr double for_reference = 0.4, for_want_of_it = 0.7, for_settings = 0.58, in_ensembles = 0.75;
/// smaller relative differences are rounding
constexpr double constant = 1e-12;
/// A setting worse by this factor in both time and error is clearly dominated.
constexpr double clearly = 2;

double median(std::vector<double> v) {
  std::ranges::sort(v);
  return v.size() % 2 == 1 ? v[v.size() / 2] : 0.5 * (v[v.size() / 2 - 1] + v[v.size() / 2]);
}

class Trade {
 public:
  Trade(const TradePlan& plan, const std::vector<Measure>& measures, const CaseRunner& run, const TradeListener& listener)
      : measures_(measures), run_(run), listener_(listener) {
    out_.plan = plan;
    for (const Measure& m : measures) out_.quantities.push_back(m.name);
    out_.units.assign(measures.size(), "");
  }

  TradeReport trade() {
    tell("reference", 0);
    const CaseRunner stoppable = [this](const Overrides& set, const std::vector<Measure>& m, const CaseLimits& l) {
      return run(set, m, l);
    };
    out_.reference = find_reference(out_.plan, measures_, stoppable, for_reference * out_.plan.budget, for_want_of_it * out_.plan.budget);
    list_points();
    if (!out_.stopped && out_.reference.trouble.empty()) {
      for (const QuantityReference& r : out_.reference.of) chaos_ = chaos_ || r.chaotic;
      begun_ = std::max(spent(), for_reference * out_.plan.budget);
      if (out_.plan.budget > 0)
        explore();
      else
        for (std::size_t i = 0; i < points().size() && !out_.stopped; ++i) tell("settings", share(i, points().size())), visit(i, 0);
      find_constants();
      if (out_.tells()) time_all(), tell_model_apart();
    }
    const char* const why = out_.stopped                      ? "stopped by the user"
                            : !out_.reference.trouble.empty() ? "there is no reference"
                                                              : "the budget was spent";
    for (TradePoint& p : points())
      if (p.status == "not run") p.reason = why;
    if (out_.plan.budget > 0) out_.cut = std::ranges::any_of(points(), [](const TradePoint& p) { return p.status == "not run"; });
    out_.seconds = spent();
    answer(out_);
    return std::move(out_);
  }

 private:
  std::vector<TradePoint>& points() { return out_.points; }
  double spent() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }
  /// A share of the time left for the reference.
  double left(double share = 1) const { return out_.plan.budget > 0 ? begun_ + share * (out_.plan.budget - begun_) - spent() : INFINITY; }
  static double share(std::size_t i, std::size_t n) { return static_cast<double>(i) / static_cast<double>(n); }
  void tell(const std::string& what, double done) const {
    if (listener_.progress) listener_.progress(what, done);
  }

  Outcome run(const Overrides& set, const std::vector<Measure>& measures, CaseLimits limits) {
    limits.go_on = [this] {
      if (listener_.go_on && !listener_.go_on()) out_.stopped = true;
      return !out_.stopped;
    };
    if (!limits.go_on())
      return Outcome{.status = "interrupted", .reason = "stopped by the user", .values = {}, .units = {}, .counts = {}, .run = {}};
    return run_(set, measures, limits);
  }

  void list_points() {
    const TradePlan& plan = out_.plan;
    TradePoint as_is;
    points().push_back(as_is);
    At at(plan.axes.size(), 0);
    for (bool more = !plan.axes.empty(); more;) {
      TradePoint p;
      p.at = at;
      p.set = setting(plan, at);
      points().push_back(p);
      more = false;
      for (std::size_t i = plan.axes.size(); i-- > 0;) {
        if (++at[i] < plan.axes[i].values.size()) {
          more = true;
          break;
        }
        at[i] = 0;
      }
    }
    for (TradePoint& p : points()) {
      p.values.assign(measures_.size(), NAN);
      p.spread.assign(measures_.size(), 0);
      p.errors = p.warnings_of = p.model = p.values;
    }
  }

  /// Runs a setting and evaluates it; an ensemble where something is chaotic.
  void visit(std::size_t i, double limit) {
    TradePoint& p = points()[i];
    CaseLimits limits;
    limits.seconds = limit;
    const Outcome o = run(p.set, measures_, limits);
    p.status = o.status, p.reason = o.reason;
    p.time = p.least = p.most = o.build_seconds + o.run_seconds;
    p.build = o.build_seconds;
    p.steps = o.counts.steps, p.evaluations = o.counts.evaluations;
    if (o.values.size() != measures_.size() || o.status == "interrupted") return;
    if (o.units.size() == measures_.size()) out_.units = o.units;
    p.values = o.values;
    const bool whole = std::ranges::all_of(o.values, [](double v) { return std::isfinite(v); });
    p.usable = o.status == "finished" && whole;
    if (o.status == "finished" && !whole) p.reason = "a quantity has no value with this setting";
    if (p.usable && chaos_) average(p, limits);
    compare(p);
  }

  std::vector<Sample> ensemble(const Overrides& set, const std::vector<double>& first, const CaseLimits& limits) {
    std::vector<std::vector<double>> v(measures_.size());
    for (std::size_t q = 0; q < v.size(); ++q)
      if (!first.empty()) v[q].push_back(first[q]);
    for (int k = first.empty() ? 0 : 1; k < out_.plan.ensemble && !out_.stopped && left(in_ensembles) > 0; ++k) {
      const Outcome o = run(member(out_.plan, set, k), measures_, limits);
      if (o.status == "finished" && o.values.size() == v.size())
        for (std::size_t q = 0; q < v.size(); ++q) v[q].push_back(o.values[q]);
    }
    std::vector<Sample> out;
    for (const auto& values : v) out.push_back(sample_of(values));
    return out;
  }

  void average(TradePoint& p, const CaseLimits& limits) {
    const std::vector<Sample> s = ensemble(p.set, p.values, limits);
    for (std::size_t q = 0; q < s.size(); ++q)
      if (out_.reference.of[q].chaotic)
        p.values[q] = s[q].mean, p.spread[q] = std::max(s[q].error, s[q].count < 4 ? out_.reference.of[q].spread : 0);
  }

  /// Finds quantities that are the same in every run; for those whose reference is 0, also the scale of their errors.
  void find_constants() {
    if (out_.ran() == 0) return;
    for (std::size_t q = 0; q < measures_.size(); ++q) {
      QuantityReference& r = out_.reference.of[q];
      double least = INFINITY, most = -INFINITY;
      const auto see = [&](double v) { least = std::min(least, v), most = std::max(most, v); };
      for (const ReferenceLevel& level : out_.reference.levels) see(level.values[q]);
      for (const TradePoint& p : points())
        if (p.usable) see(p.values[q]);
      const double largest = std::max(std::abs(least), std::abs(most));
      r.constant = most - least <= constant * largest;
      if (r.constant || std::abs(r.value) > constant * largest) continue;
      if (r.scale < largest) r.words += "; it is 0, so errors are relative to the largest value of any setting";
      r.scale = largest;
    }
    for (TradePoint& p : points())
      if (p.usable) compare(p);
  }

  void compare(TradePoint& p) {
    p.error = p.warning = 0;
    for (std::size_t q = 0; q < measures_.size(); ++q) {
      const QuantityReference& r = out_.reference.of[q];
      if (r.constant) {
        p.errors[q] = p.warnings_of[q] = 0;
        continue;
      }
      p.errors[q] = std::abs(p.values[q] - r.value) / r.scale;
      p.warnings_of[q] = std::hypot(r.error, p.spread[q]) / r.scale;
      if (std::isnan(p.errors[q])) continue;
      p.error = std::max(p.error, p.errors[q]);
      p.warning = std::max(p.warning, p.warnings_of[q]);
    }
  }

  // --- within a budget -------------------------------------------------------------------------------------------

  /// All numerical axes together count as one axis here: the cost of a tolerance depends on the scheme.
  std::vector<std::vector<std::size_t>> groups() const {
    std::vector<std::vector<std::size_t>> out;
    std::vector<std::size_t> numerical;
    for (std::size_t i = 0; i < out_.plan.axes.size(); ++i)
      if (out_.plan.axes[i].numerical)
        numerical.push_back(i);
      else
        out.push_back({i});
    if (!numerical.empty()) out.push_back(numerical);
    return out;
  }

  At finest_at() const {
    At at;
    for (const FidelityAxis& axis : out_.plan.axes) at.push_back(axis.finest);
    return at;
  }

  std::size_t index(const At& at) const {
    std::size_t i = 0;
    for (std::size_t k = 0; k < at.size(); ++k) i = i * out_.plan.axes[k].values.size() + at[k];
    return i + 1;
  }

  /// The setting with the finest values except for the axes of `group`, where it is as `at`.
  std::size_t star(const At& at, const std::vector<std::size_t>& group) const {
    At s = finest_at();
    for (const std::size_t axis : group) s[axis] = at[axis];
    return index(s);
  }

  struct Guess {
    double time, error;
  };

  /// Estimate from the effect of each single group with all others finest: time factors multiply, the largest error remains.
  Guess guess(const At& at) const {
    const TradePoint& finest = out_.points[index(finest_at())];
    const double centre = finest.usable ? finest.time : 0;
    Guess g{centre, 0};
    for (const auto& group : groups()) {
      const TradePoint& s = out_.points[star(at, group)];
      if (!s.usable) continue;
      if (centre > 0) g.time *= s.time / centre;
      g.error = std::max(g.error, s.claimed());
    }
    return g;
  }

  bool clearly_dominated(double time, double error) const {
    return std::ranges::any_of(out_.points, [&](const TradePoint& p) {
      return p.usable && clearly * p.time < time && (clearly * p.claimed() < error || (p.claimed() <= error && error <= p.warning));
    });
  }

  void explore() {
    const double each = 0.05 * out_.plan.budget;
    visit(0, 3 * each);
    visit(index(finest_at()), 2 * each);
    std::vector<bool> seen(points().size(), false);
    seen[0] = seen[index(finest_at())] = true;
    // First the effect of each single axis, all numerical ones together, ...
    std::vector<std::size_t> stars;
    for (std::size_t i = 1; i < points().size(); ++i)
      for (const auto& group : groups())
        if (star(points()[i].at, group) == i && !seen[i]) stars.push_back(i), seen[i] = true;
    // ... in an order that covers them evenly for any budget, ...
    std::ranges::sort(stars, {}, [](std::size_t i) { return std::fmod(0.6180339887498949 * static_cast<double>(i), 1.0); });
    for (const std::size_t i : stars) {
      if (left(for_settings) <= 0 || out_.stopped) break;
      tell("what each axis does alone", spent() / out_.plan.budget);
      visit(i, each);
    }
    find_constants();
    // ... then the rest, the most promising first.
    std::vector<std::size_t> rest;
    for (std::size_t i = 1; i < points().size(); ++i)
      if (points()[i].status == "not run") rest.push_back(i);
    if (!out_.tells()) {
      for (const std::size_t i : rest)
        points()[i].status = "left out", points()[i].reason = "the quantities are the same in every setting that ran";
      return;
    }
    while (!rest.empty() && left(for_settings) > 0 && !out_.stopped) {
      tell("settings", spent() / out_.plan.budget);
      const auto next = most_promising(rest);
      const std::size_t i = *next;
      rest.erase(next);
      const Guess g = guess(points()[i].at);
      if (clearly_dominated(g.time, g.error))
        points()[i].status = "dropped",
        points()[i].reason = printed("predicted: %.2g s with an error of %.2g %%, clearly dominated", g.time, 100 * g.error);
      else
        visit(i, std::min(each, std::max(0.01, left(0.85))));
    }
  }

  std::vector<std::size_t>::iterator most_promising(std::vector<std::size_t>& rest) {
    auto best = rest.begin();
    double least = INFINITY;
    for (auto i = rest.begin(); i != rest.end(); ++i) {
      const Guess g = guess(points()[*i].at);
      double better = 0;
      for (const TradePoint& p : points())
        if (p.usable && p.time <= g.time && p.claimed() <= g.error) better += 1;
      if (const double rank = better + 1e-3 * g.time / std::max(1e-12, out_.plan.budget); rank < least) least = rank, best = i;
    }
    return best;
  }

  // --- times -----------------------------------------------------------------------------------------------------

  /// Rounds over all settings, so that a temporary disturbance of the machine affects all equally. Timed runs compute no measures: they
  /// write the outputs of the scene itself. Analyses without a run only compute their measures.
  void time_all() {
    std::vector<std::size_t> who, beaten;
    for (std::size_t i = 0; i < points().size(); ++i)
      if (const TradePoint& p = points()[i]; p.usable)
        (out_.plan.budget > 0 && clearly_dominated(p.time, p.claimed()) ? beaten : who).push_back(i);
    for (auto* list : {&who, &beaten}) std::ranges::sort(*list, {}, [this](std::size_t i) { return points()[i].time; });
    for (int round = 0; round < out_.plan.repeats; ++round) {
      tell("times", share(static_cast<std::size_t>(round), static_cast<std::size_t>(out_.plan.repeats)));
      for (const std::size_t i : who) time_once(points()[i]);
    }
    for (const std::size_t i : beaten) time_once(points()[i]);  // once, if the budget allows
    for (TradePoint& p : points()) {
      if (p.times.empty()) continue;
      p.time = median(p.times);
      p.least = *std::ranges::min_element(p.times);
      p.most = *std::ranges::max_element(p.times);
    }
  }

  void time_once(TradePoint& p) {
    if (out_.stopped || p.time > left(0.95)) return;
    const Outcome o = run(p.set, out_.plan.integrates ? std::vector<Measure>{} : measures_, {});
    if (o.status != "finished") return;
    p.times.push_back(o.build_seconds + o.run_seconds);
    p.build = p.times.size() == 1 ? o.build_seconds : std::min(p.build, o.build_seconds);
    p.steps = o.counts.steps, p.evaluations = o.counts.evaluations;
  }

  // --- error of the model ----------------------------------------------------------------------------------------

  /// The same model as in a setting, computed as accurately as the reference: its remaining error is that of the model.
  void tell_model_apart() {
    const TradePlan& plan = out_.plan;
    if (std::ranges::all_of(plan.axes, [](const FidelityAxis& a) { return a.numerical || a.values.size() < 2; })) return;
    if (!plan.integrates) {
      for (TradePoint& p : points()) p.model = p.errors;
      return;
    }
    std::map<At, std::vector<std::size_t>> models;
    for (std::size_t i = 1; i < points().size(); ++i) {
      At key;
      for (std::size_t a = 0; a < plan.axes.size(); ++a) key.push_back(plan.axes[a].numerical ? 0 : points()[i].at[a]);
      if (points()[i].usable) models[key].push_back(i);
    }
    std::size_t done = 0;
    for (const auto& [key, members] : models) {
      tell("error of the models", share(done++, models.size()));
      if (out_.stopped || left() < 2 * out_.reference.seconds * (chaos_ ? plan.ensemble : 1)) return;
      Overrides set;
      for (std::size_t a = 0; a < plan.axes.size(); ++a)
        if (!plan.axes[a].numerical) set.insert(set.end(), plan.axes[a].values[key[a]].set.begin(), plan.axes[a].values[key[a]].set.end());
      for (const auto& s : out_.reference.set)
        if (s.first.starts_with("run.")) set.push_back(s);
      CaseLimits limits;
      limits.seconds = std::isfinite(left()) ? std::max(0.01, left()) : 0;
      const Outcome o = run(set, measures_, limits);
      if (o.status != "finished" || o.values.size() != measures_.size()) continue;
      std::vector<double> v = o.values;
      if (chaos_) {
        const std::vector<Sample> s = ensemble(set, o.values, limits);
        for (std::size_t q = 0; q < v.size(); ++q)
          if (out_.reference.of[q].chaotic) v[q] = s[q].mean;
      }
      for (const std::size_t i : members)
        for (std::size_t q = 0; q < v.size(); ++q)
          points()[i].model[q] = std::abs(v[q] - out_.reference.of[q].value) / out_.reference.of[q].scale;
    }
  }

  const std::vector<Measure>& measures_;
  const CaseRunner& run_;
  const TradeListener& listener_;
  TradeReport out_;
  Clock::time_point begin_ = Clock::now();
  double begun_ = 0;  ///< start time of the settings [s]
  bool chaos_ = false;
};

}  // namespace

TradeReport run_tradeoff(const TradePlan& plan, const std::vector<Measure>& measures, const CaseRunner& run,
                         const TradeListener& listener) {
  return Trade(plan, measures, run, listener).trade();
}

}  // namespace pintle
