#include <algorithm>
#include <chrono>
#include <cmath>

#include "framework/common/printed.h"
#include "framework/study/tradeoff/convergence.h"
#include "framework/study/tradeoff/refinement.h"
#include "framework/study/tradeoff/tradeoff.h"

namespace pintle {

namespace {

constexpr double tightest = 1e-13;  ///< below this, rounding dominates
constexpr double loosest = 1e-4;    ///< start of a search with limited time
constexpr int most_tolerances = 6, most_refinements = 5;
constexpr const char* chaotic_model =
    "a finer model changes a single chaotic run at random, so the reference is the ensemble of the finest model of the study";
constexpr std::size_t judged_tolerances = 5;  ///< number of the last tolerances that are compared

using Clock = std::chrono::steady_clock;

bool whole(const Outcome& o, std::size_t n) {
  return o.status == "finished" && o.values.size() == n && std::ranges::all_of(o.values, [](double v) { return std::isfinite(v); });
}

/// Refines until every quantity has converged or is known not to converge.
class Search {
 public:
  Search(const TradePlan& plan, const std::vector<Measure>& measures, const CaseRunner& run, double seconds, double most)
      : plan_(plan), measures_(measures), run_(run), seconds_(seconds), most_(std::max(seconds, most)), n_(measures.size()) {
    scale_.assign(n_, 0);
  }

  Reference find() {
    base_ = finest(plan_, true);
    // For a numerical axis other than scheme and tolerance (such as a largest step), the reference also uses the finest value.
    for (const FidelityAxis& axis : plan_.axes)
      for (const auto& set : axis.values[axis.finest].set)
        if (axis.numerical && set.first != "run.method" && set.first != "run.tolerance" && set.first != "run.constraints" &&
            set.first != "run.onset")
          base_.push_back(set);
    if (plan_.integrates) base_.insert(base_.end(), {{"run.method", "auto"}, {"run.constraints", "projection"}});
    base_.insert(base_.end(), plan_.reference.begin(), plan_.reference.end());
    out_.of.resize(n_);
    if (plan_.integrates)
      climb_tolerances();
    else
      take_finest();
    if (!out_.trouble.empty()) return std::move(out_);
    for (std::size_t k = 0; k < tolerances_; ++k) out_.seconds = std::max(out_.seconds, out_.levels[k].seconds);
    for (std::size_t q = 0; q < n_; ++q) validate_tolerances(q);
    find_chaos();
    refine_model();
    for (std::size_t q = 0; q < n_; ++q) describe(q);
    return std::move(out_);
  }

 private:
  double spent() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }
  /// Whether there is time for more: without a sufficient reference there is no recommendation, so it may then take up to `most_`.
  bool may_spend(double more) {
    if (seconds_ <= 0 || spent() + more <= seconds_) return true;
    if (stands()) return false;
    const bool may = spent() + more <= most_;
    out_.short_of_time = out_.short_of_time || !may;
    return may;
  }

  Outcome run(const Overrides& set, bool keep) {
    CaseLimits limits;
    limits.keep_run = keep;
    if (seconds_ > 0) limits.seconds = std::max(0.05 * seconds_, 1.05 * most_ - spent());
    return run_(set, measures_, limits);
  }

  bool level(const std::string& what, const Overrides& set) {
    Outcome o = run(set, true);
    if (!whole(o, n_)) {
      why_ = what + ": " + o.status + (o.reason.empty() ? "" : ": " + o.reason);
      out_.short_of_time = out_.short_of_time || o.status == "over its limit";
      if (o.status == "finished") why_ = what + ": a quantity has no value there; the model of the reference may lack it";
      return false;
    }
    for (std::size_t q = 0; q < n_; ++q) scale_[q] = std::max(scale_[q], std::abs(o.values[q]));
    out_.levels.push_back({what, set, o.values, o.build_seconds + o.run_seconds});
    if (runs_.size() > 1) runs_[runs_.size() - 2].reset();
    runs_.push_back(o.run);
    return true;
  }

  std::vector<double> values(std::size_t q, std::size_t from, std::size_t to) const {
    std::vector<double> v;
    for (std::size_t k = from; k < to; ++k) v.push_back(out_.levels[k].values[q]);
    return v;
  }

  /// The value, or if it is nearly zero the largest one seen.
  double scale(std::size_t q) const {
    const double now = std::abs(out_.levels.back().values[q]);
    return std::max({now, 1e-6 * scale_[q], 1e-300});
  }

  double wanted() const { return plan_.error > 0 ? plan_.error : 1e-4; }
  double target() const { return wanted() / 100; }

  /// Whether the runs so far determine every quantity to a third of the requested error.
  bool stands() const { return out_.levels.size() > 2 && (tolerances_ == 0 ? settled(1.0 / 3) : stands_); }

  Ladder ladder(std::size_t q, std::size_t levels) const {
    return validate_ladder(values(q, levels > judged_tolerances ? levels - judged_tolerances : 0, levels), 10, scale(q));
  }

  bool settled(double share) const {
    for (std::size_t q = 0; q < n_; ++q) {
      const Ladder l = ladder(q, out_.levels.size());
      if (!(l.rounding || (l.falling && l.error <= share * wanted() * scale(q)))) return false;
    }
    return true;
  }

  bool given_tolerance() const {
    return std::ranges::any_of(plan_.reference, [](const auto& s) { return s.first == "run.tolerance"; });
  }

  /// The tightest tolerance in the study, or that specified for the reference.
  double study_tolerance() const {
    double t = tolerance_of(plan_, plan_.reference);
    for (const FidelityAxis& axis : plan_.axes)
      for (const AxisValue& v : axis.values)
        if (!given_tolerance()) t = std::min(t, tolerance_of(plan_, v.set));
    return std::clamp(t, 1e2 * tightest, 1e-6);
  }

  /// Down to two decades below the study's finest. With limited time it starts from loose tolerances, so that expensive runs come last, and
  /// goes no further than the requested error needs, to leave time for refining the model, whose error may be larger.
  void climb_tolerances() {
    const double finest = study_tolerance();
    const bool bounded = seconds_ > 0, model = refined(base_).has_value();
    double t = bounded && !given_tolerance() ? loosest : finest;
    for (int k = 0; t >= 0.9 * tightest && (bounded || k < most_tolerances); ++k, t /= 10) {
      const std::size_t had = out_.levels.size();
      if (had > 0 && !may_spend(1.6 * out_.levels.back().seconds) && had > 1) break;
      if (!level(printed("tolerance %.0e", t), with_tolerance(base_, t))) {
        if (t < 1e-6 || out_.short_of_time || why_.find("refused") != std::string::npos) break;
        continue;  // too loose for this scene
      }
      if (had < 2 || t > 1.1e-6) continue;
      if (settled(0.01) && (t < 1.1e-2 * finest || (bounded && model))) break;
      if (bounded && model && settled(0.1) && spent() > 0.25 * seconds_) break;
      if (bounded && !settled(1) && parts()) break;
    }
    tolerances_ = out_.levels.size();
    if (tolerances_ == 0) out_.trouble = why_;
    if (tolerances_ == 1)
      out_.trouble =
          "the reference was run at one tolerance only, so its error is unknown: " + (why_.empty() ? "there was no time for more" : why_);
    if (!out_.levels.empty()) out_.set = out_.levels.back().set;
  }

  /// For an analysis without a run: only the model has an error.
  void take_finest() {
    if (level("the finest model of the study", base_))
      tolerances_ = 1, out_.set = base_;
    else
      out_.trouble = why_;
  }

  bool parts() const {
    const auto &a = runs_[runs_.size() - 2], &b = runs_.back();
    return a && b && parting(*a, *b).chaotic();
  }

  void validate_tolerances(std::size_t q) {
    QuantityReference& r = out_.of[q];
    ladder_.push_back(ladder(q, tolerances_));
    const Ladder& l = ladder_.back();
    r.value = out_.levels.back().values[q];
    r.scale = scale(q);
    r.error = std::max(l.error, 1e-14 * r.scale);
    r.ratio = l.ratio;
    r.converged = l.falling || l.rounding || l.error <= 1e-2 * target() * r.scale || !plan_.integrates;
  }

  static bool steady(const Ladder& l, double scale) {
    const std::vector<double>& d = l.differences;
    const double whole = std::pow(d.front() / std::max(d.back(), 1e-300), 1.0 / static_cast<double>(d.size() - 1));
    return l.rounding || (l.falling && whole >= 3 && d.back() <= 1e-4 * scale);
  }

  /// For exponentially diverging motions, the quantities that do not converge are evaluated by ensembles.
  void find_chaos() {
    if (tolerances_ < 3) return;
    const auto &a = runs_[tolerances_ - 2], &b = runs_[tolerances_ - 1];
    if (a && b) {
      parting_ = parting(*a, *b);
      if (!parting_.chaotic()) return;
    }
    // For diverging motions, a quantity is regular only if it converges steadily, like one that is determined early in the run.
    std::vector<std::size_t> suspects;
    for (std::size_t q = 0; q < n_; ++q)
      if (!steady(ladder_[q], out_.of[q].scale) && out_.of[q].error > 1e-9 * out_.of[q].scale) suspects.push_back(q);
    if (suspects.empty()) return;
    const int runs = 2 * plan_.ensemble;
    double fine = study_tolerance();
    while (seconds_ > 0 && fine < 0.9e-6 && spent() + 2.6 * runs * seconds_at(fine) > most_) fine *= 10;
    std::vector<Sample> first = ensemble(with_tolerance(base_, fine), runs), second = ensemble(with_tolerance(base_, fine / 10), runs);
    for (const std::size_t q : suspects) {
      const Sample &s = first[q], &t = second[q];
      const double largest = *std::ranges::max_element(ladder_[q].differences);
      if (s.count < 4 || t.count < 2 || s.deviation < 0.1 * largest) continue;
      QuantityReference& r = out_.of[q];
      const double n = static_cast<double>(s.count), m = static_cast<double>(t.count);
      r.chaotic = true;
      r.value = (n * s.mean + m * t.mean) / (n + m);
      r.spread = std::sqrt((n * s.deviation * s.deviation + m * t.deviation * t.deviation) / (n + m));
      const double standard = r.spread / std::sqrt(n + m), apart = std::abs(s.mean - t.mean), apart_by = std::hypot(s.error, t.error);
      r.converged = apart <= 3 * apart_by;
      r.error = r.converged ? standard : std::max(standard, apart);
      r.scale = std::max(std::abs(r.value), r.spread);
      r.rate = parting_.rate;
      chaos_words_ = printed("two ensembles of %zu and %zu runs, at tolerances %.0e and %.0e, have means %.1f standard errors apart",
                             s.count, t.count, fine, fine / 10, apart_by > 0 ? apart / apart_by : 0);
    }
    if (std::ranges::any_of(out_.of, &QuantityReference::chaotic)) out_.set = with_tolerance(base_, fine);
  }

  /// Time of a run at the level with the nearest tolerance.
  double seconds_at(double tolerance) const {
    double seconds = 0, nearest = INFINITY;
    for (std::size_t k = 0; k < tolerances_; ++k)
      if (const double off = std::abs(std::log(tolerance / tolerance_of(plan_, out_.levels[k].set))); off < nearest)
        nearest = off, seconds = out_.levels[k].seconds;
    return seconds;
  }

  std::vector<Sample> ensemble(const Overrides& set, int runs) {
    std::vector<std::vector<double>> v(n_);
    const double each = seconds_at(tolerance_of(plan_, set));
    for (int k = 0; k < runs; ++k) {
      if (k >= 4 && !may_spend(each)) break;
      const Outcome o = run(member(plan_, set, k), false);
      if (whole(o, n_))
        for (std::size_t q = 0; q < n_; ++q) v[q].push_back(o.values[q]);
    }
    std::vector<Sample> out;
    for (const auto& values : v) out.push_back(sample_of(values));
    return out;
  }

  /// Doubles elements, modes and the like of the finest model twice, and further as long as the requested accuracy is not reached.
  void refine_model() {
    const double tolerance = tolerance_of(plan_, out_.set);
    const auto computed = [&](const Overrides& set) { return plan_.integrates ? with_tolerance(set, tolerance) : set; };
    if (std::ranges::all_of(out_.of, &QuantityReference::chaotic)) {
      model_words_ = chaotic_model;
      return;
    }
    const int most = seconds_ > 0 ? most_refinements : 3;
    std::optional<Overrides> finer = out_.set;
    const std::vector<QuantityReference> before = out_.of;
    double dearer = 3;
    for (int k = 1; k <= most; ++k) {
      finer = refined(*finer);
      if (!finer) {
        if (std::ranges::any_of(plan_.axes, [](const FidelityAxis& axis) { return !axis.numerical && axis.values.size() > 1; }))
          model_words_ = "its model is the finest of the study, and cannot be refined";
        return;
      }
      if (k > 2 && stands_) break;
      const double last = out_.levels.back().seconds;
      if (!may_spend(dearer * last)) {
        model_words_ = "the model was not refined" +
                       std::string(k == 1   ? ""
                                   : k == 2 ? " a second time"
                                            : " further") +
                       ": no time left in the budget";
        if (k == 1) compare_coarser();
        break;
      }
      if (!level(printed("finer model, %d times", 1 << k), computed(*finer))) {
        model_words_ = "the model cannot be refined further (" + why_ + ")";
        if (k == 1) compare_coarser();
        break;
      }
      dearer = std::clamp(1.5 * out_.levels.back().seconds / std::max(last, 1e-9), 1.5, 5.0);
      out_.set = out_.levels.back().set;
      out_.of = before;
      for (std::size_t q = 0; q < n_; ++q) add_model(q);
      stands_ =
          k > 1 && std::ranges::all_of(out_.of, [&](const QuantityReference& r) { return r.chaotic || r.error <= wanted() / 3 * r.scale; });
    }
  }

  /// Without a finer model, the change to the next coarser one is taken as the error of the finest.
  void compare_coarser() {
    for (std::size_t a = 0; a < plan_.axes.size(); ++a) {
      const FidelityAxis& axis = plan_.axes[a];
      if (axis.numerical || !axis.ordered || axis.finest == 0 || !refined(axis.values[axis.finest].set)) continue;
      Overrides set;
      for (std::size_t b = 0; b < plan_.axes.size(); ++b)
        for (const auto& s : plan_.axes[b].values[plan_.axes[b].finest - (a == b ? 1 : 0)].set)
          if (!s.first.starts_with("run.")) set.push_back(s);
      for (const auto& s : out_.set)
        if (s.first.starts_with("run.")) set.push_back(s);
      const Outcome o = run(set, false);
      for (std::size_t q = 0; q < n_; ++q) {
        out_.of[q].converged = false;
        if (whole(o, n_)) out_.of[q].error += std::abs(o.values[q] - out_.levels[tolerances_ - 1].values[q]);
      }
      model_words_ += whole(o, n_) ? "; this includes the change from the next coarser " + axis.name
                                   : "; the error of its " + axis.name + " is not known";
    }
  }

  void add_model(std::size_t q) {
    QuantityReference& r = out_.of[q];
    if (r.chaotic) {
      model_words_ = chaotic_model;
      return;
    }
    std::vector<double> v{out_.levels[tolerances_ - 1].values[q]};
    for (std::size_t k = tolerances_; k < out_.levels.size(); ++k) v.push_back(out_.levels[k].values[q]);
    const Ladder l = validate_ladder(v, 4, r.scale);
    r.value = v.back();
    r.scale = scale(q);
    r.order = l.ratio > 0 ? std::log2(l.ratio) : 0;
    r.error += l.error;
    r.converged = r.converged && (l.falling || l.rounding || l.error <= target() * r.scale);
    refinements_ = v.size() - 1;
  }

  void describe(std::size_t q) {
    QuantityReference& r = out_.of[q];
    const double share = 100 * r.error / r.scale;
    std::string s;
    if (r.chaotic) {
      s = printed(
          "chaotic: runs at ever finer tolerances do not converge, and the motions of two of them diverge %.2g-fold each second until they "
          "have nothing in common; single runs spread by %.2g %%. "
          "It is compared by its mean over an ensemble, known to %.2g %% (standard error); %s",
          std::exp(std::min(r.rate, 600.0)), 100 * r.spread / r.scale, share, chaos_words_.c_str());
      if (r.rate > 50)
        s = printed(
            "chaotic: runs at ever finer tolerances do not converge, and the motions of two of them diverge by a factor e in %.2g s until "
            "they have nothing in common; single runs spread by %.2g %%. "
            "It is compared by its mean over an ensemble, known to %.2g %% (standard error); %s",
            1 / r.rate, 100 * r.spread / r.scale, share, chaos_words_.c_str());
      r.words = s;
      return;
    }
    std::string fell;
    for (const double d : ladder_[q].differences) fell += (fell.empty() ? "" : ", ") + printed("%.1e", d / r.scale);
    s = plan_.integrates ? printed("%zu tolerances from %.0e to %.0e change it %sby %s of its value", tolerances_,
                                   tolerance_of(plan_, out_.levels.front().set), tolerance_of(plan_, out_.levels[tolerances_ - 1].set),
                                   tolerances_ > judged_tolerances ? "in the end " : "", fell.c_str())
                         : "it needs no run, so it has the error of the model only";
    if (r.ratio > 0) s += printed(", decreasing %.1f times per decade", r.ratio);
    if (refinements_ > 0)
      s += r.order > 0 ? printed("; %zu refinements of the model show order %.1f", refinements_, r.order)
                       : printed("; refining the model %s does not show an order", refinements_ == 1 ? "once" : "twice");
    s += printed("; its own error is %s%.2g %%", r.converged ? "" : "not proved small, about ", share);
    if (!model_words_.empty()) s += "; " + model_words_;
    r.words = s;
  }

  const TradePlan& plan_;
  const std::vector<Measure>& measures_;
  const CaseRunner& run_;
  double seconds_, most_;
  std::size_t n_;
  Clock::time_point begin_ = Clock::now();
  Overrides base_;
  Reference out_;
  std::vector<std::shared_ptr<const Run>> runs_;
  std::vector<double> scale_;
  std::vector<Ladder> ladder_;
  std::size_t tolerances_ = 0, refinements_ = 0;
  bool stands_ = false;
  Parting parting_;
  std::string why_, chaos_words_, model_words_;
};

}  // namespace

Reference find_reference(const TradePlan& plan, const std::vector<Measure>& measures, const CaseRunner& run, double seconds, double most) {
  return Search(plan, measures, run, seconds, most).find();
}

}  // namespace pintle
