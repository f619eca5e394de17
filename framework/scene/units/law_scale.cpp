#include "framework/scene/units/law_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "framework/scene/units/machine.h"
#include "framework/scene/units/table.h"

namespace pintle {

namespace {

constexpr double part = 1e-3;        // relative to the law's range: smaller features are ignored
constexpr double known_to = 1e-12;   // accuracy of its values, limited by rounding
constexpr double narrowest = 1e-13;  // relative to the time, or to the run: smallest interval

double roundings(double t, int n) { return n * std::numeric_limits<double>::epsilon() * std::max(std::abs(t), 1e-300); }

/// A function whose sign determines the branch of a law: the operand of an instruction, or the difference of two, minus `offset`.
struct Switch {
  std::size_t instruction;
  bool two;
  double offset;
};

std::vector<Switch> switches(const Program& program) {
  std::vector<Switch> out;
  for (std::size_t i = 0; i < program.code.size(); ++i) {
    const Op op = program.code[i].op;
    if (op == Op::abs || op == Op::sqrt) out.push_back({i, false, 0});
    if (op == Op::smooth) out.push_back({i, false, 0}), out.push_back({i, false, 1});
    if (op == Op::min || op == Op::max || (op >= Op::less && op <= Op::unequal)) out.push_back({i, true, 0});
    if (op == Op::atan2) out.push_back({i, false, 0});
  }
  return out;
}

struct Root {
  double before, after;
  bool step_end;
};

/// Finds where a formula's switches change sign or touch zero.
class Roots {
 public:
  Roots(const Program& program, double until, int most) : program_(program), until_(until), most_(most) {}

  /// @returns false if there are too many
  bool find() {
    for (const Switch& s : switches(program_)) {
      std::vector<Root> found;
      double begin = 0;
      for (std::size_t i = 0; i <= all_.size(); ++i) {
        const double end = i < all_.size() ? all_[i].before : until_;
        if (end > begin && !find(s, begin, end, found)) return false;
        if (i < all_.size()) begin = all_[i].after;
      }
      all_.insert(all_.end(), found.begin(), found.end());
      std::sort(all_.begin(), all_.end(), [](const Root& a, const Root& b) { return a.before < b.before; });
      merge();
    }
    return true;
  }
  const std::vector<Root>& all() const { return all_; }

 private:
  double value(const Switch& s, double t) {
    const Jet* end = jets_.run(program_, s.instruction, {t, 1, 0});
    // Of the two operands of an atan2, the first decides.
    if (program_.code[s.instruction].op == Op::atan2) return end[-2].value;
    return s.two ? end[-2].value - end[-1].value : end[-1].value - s.offset;
  }
  RangeJet range(const Switch& s, double a, double b) {
    const RangeJet* end = ranges_.run(program_, s.instruction, time_from(a, b));
    if (program_.code[s.instruction].op == Op::atan2) return end[-2];
    return s.two ? apply(Op::subtract, end[-2], end[-1]) : apply(Op::subtract, end[-1], RangeJet{{s.offset, s.offset}, {0, 0}});
  }
  bool find(const Switch& s, double from, double to, std::vector<Root>& found) {
    const bool step_end = program_.code[s.instruction].op == Op::smooth;
    std::vector<std::pair<double, double>> left{{from, to}};
    while (!left.empty()) {
      if (++looks_ > most_) return false;
      const auto [a, b] = left.back();
      left.pop_back();
      const RangeJet r = range(s, a, b);
      if (!r.value.holds(0) || (r.value.lo == 0 && r.value.hi == 0)) continue;
      if (!r.rate.holds(0)) {
        cross(s, a, b, step_end, found);
      } else if (b - a <= narrowest * std::max(b, until_)) {
        if (a > from && b < to) found.push_back({a - roundings(a, 4), b + roundings(b, 4), step_end});
      } else {
        left.emplace_back(a + (b - a) / 2, b);
        left.emplace_back(a, a + (b - a) / 2);
      }
    }
    return true;
  }
  // The single root of a monotonic function between a and b, to the last digit.
  void cross(const Switch& s, double a, double b, bool step_end, std::vector<Root>& found) {
    const double at_a = value(s, a), at_b = value(s, b);
    if (at_a != 0 && at_b != 0 && (at_a > 0) == (at_b > 0)) return;
    const bool rises = at_b > at_a;
    while (true) {
      const double t = a + (b - a) / 2;
      if (!(t > a && t < b)) break;
      const double f = value(s, t);
      if (f == 0) {
        a = b = t;
        break;
      }
      ((f > 0) == rises ? b : a) = t;
    }
    found.push_back({std::max(0.0, a - roundings(a, 4)), b + roundings(b, 4), step_end});
  }
  void merge() {
    std::vector<Root> kept;
    for (const Root& r : all_) {
      if (!kept.empty() && r.before <= kept.back().after) {
        kept.back().after = std::max(kept.back().after, r.after);
        kept.back().step_end = kept.back().step_end || r.step_end;
      } else {
        kept.push_back(r);
      }
    }
    all_.swap(kept);
  }

  const Program& program_;
  double until_;
  int most_, looks_ = 0;
  Machine<Jet> jets_;
  Machine<RangeJet> ranges_;
  std::vector<Root> all_;
};

struct Sample {
  double t;
  Jet jet;
};

/// Deviation of the values from the line from the law's start to its end, and their magnitude.
class Spread {
 public:
  Spread(const TimeLaw& law, double until) : first_(law(0).value), slope_((law(until).value - first_) / until) {}
  void see(const Sample& s) {
    if (!std::isfinite(s.jet.value)) return void(not_finite_ = std::isnan(not_finite_) ? s.t : std::min(not_finite_, s.t));
    const double off = s.jet.value - first_ - slope_ * s.t;
    least_ = std::min(least_, off), most_ = std::max(most_, off), size_ = std::max(size_, std::abs(s.jet.value));
    lowest_ = std::min(lowest_, s.jet.value), highest_ = std::max(highest_, s.jet.value);
    if (std::isfinite(s.jet.rate)) fastest_ = std::max(fastest_, std::abs(s.jet.rate));
  }
  double seen() const { return highest_ - lowest_; }
  double little() const { return part * (most_ - least_) + known_to * size_; }
  double fastest() const { return fastest_; }
  double not_finite() const { return not_finite_; }

 private:
  double first_, slope_, least_ = 0, most_ = 0, size_ = 0, fastest_ = 0;
  double not_finite_ = std::numeric_limits<double>::quiet_NaN();
  double lowest_ = std::numeric_limits<double>::infinity(), highest_ = -lowest_;
};

/// Samples a formula between its roots until no significant feature can be missed between samples.
class Sampling {
 public:
  Sampling(const Program& program, const TimeLaw& law, Spread& spread) : program_(program), law_(law), spread_(spread) {}
  void begin(double a, double b) { look(a, b); }
  bool refine(double until, int most) {
    int looks = 0;
    while (!queue_.empty() && queue_.top().hidden > spread_.little()) {
      const Cell c = queue_.top();
      queue_.pop();
      if (c.b - c.a <= narrowest * std::max(c.b, until)) continue;
      if (++looks > most / 8) return false;
      look(c.a, c.a + (c.b - c.a) / 2);
      look(c.a + (c.b - c.a) / 2, c.b);
    }
    std::sort(samples_.begin(), samples_.end(), [](const Sample& x, const Sample& y) { return x.t < y.t; });
    return true;
  }
  const std::vector<Sample>& samples() const { return samples_; }

 private:
  struct Cell {
    double a, b, hidden;
    bool operator<(const Cell& other) const { return hidden < other.hidden; }
  };
  // Largest change of the value that the sampled rates do not show: the excess of the bounds of the rate, times the time; or, if the
  // sampled values span less than half of the bounds of the value, as when all samples fall on one phase of a wave, those bounds.
  void look(double a, double b) {
    constexpr int n = 8;
    const auto t = [&](int i) { return i == n ? b : a + (b - a) * i / n; };
    Range seen{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}, bounds = seen, values = seen;
    for (int i = 0; i <= n; ++i) {
      const Sample s{t(i), law_(t(i))};
      spread_.see(s);
      if (i > 0) samples_.push_back(s);
      seen = hull(seen, {s.jet.rate, s.jet.rate});
      if (i == n) break;
      const RangeJet over = ranges_.run(program_, program_.code.size(), time_from(t(i), t(i + 1)))[-1];
      bounds = hull(bounds, over.rate), values = hull(values, over.value);
    }
    const double excess = std::max(0.0, seen.lo - bounds.lo) + std::max(0.0, bounds.hi - seen.hi);
    const double unseen = values.hi - values.lo - 2 * spread_.seen(), hidden = std::max(excess * (b - a), std::isnan(unseen) ? 0 : unseen);
    queue_.push({a, b, std::isnan(hidden) ? std::numeric_limits<double>::infinity() : hidden});
  }

  const Program& program_;
  const TimeLaw& law_;
  Spread& spread_;
  Machine<RangeJet> ranges_;
  std::priority_queue<Cell> queue_;
  std::vector<Sample> samples_;
};

/// The polynomial of fifth degree through two jets.
double hermite(const Sample& from, const Sample& to, double t) {
  const double h = to.t - from.t, x = (t - from.t) / h;
  const auto share = [](const Jet& end, double away, double step) {  // of one end, at `away` of the step from it
    const double left = 1 - away;
    return left * left * left *
           (end.value * (1 + 3 * away + 6 * away * away) + end.rate * step * away * (1 + 3 * away) +
            end.accel * step * step * away * away / 2);
  };
  return share(from.jet, x, h) + share(to.jet, 1 - x, -h);
}

/// Halves [a, b] recursively until each part is the polynomial through its ends, to the accuracy needed.
/// @returns false where that needs too many parts
bool divide(const TimeLaw& law, double a, double b, const std::vector<Sample>& samples, double little, double until, int most,
            std::vector<double>& ends) {
  if (static_cast<int>(ends.size()) > most) return false;
  constexpr int looks = 8;
  const Sample from{a, law(a)}, to{b, law(b)};
  const auto off = [&](double t, double value) { return !(std::abs(hermite(from, to, t) - value) <= little); };
  bool bends = false;
  for (int i = 1; i < looks && !bends; ++i) {
    const double t = a + (b - a) * i / looks;
    bends = off(t, law(t).value);
  }
  const auto begin = std::upper_bound(samples.begin(), samples.end(), a, [](double t, const Sample& s) { return t < s.t; });
  for (auto s = begin; s != samples.end() && s->t < b && !bends; ++s) bends = off(s->t, s->jet.value);
  if (!bends || b - a <= narrowest * std::max(b, until)) {
    ends.push_back(b);
    return true;
  }
  const double middle = a + (b - a) / 2;
  return divide(law, a, middle, samples, little, until, most, ends) && divide(law, middle, b, samples, little, until, most, ends);
}

/// The largest value, rate and acceleration in a few samples: the scale of a difference.
Jet size_of(const TimeLaw& law, double until) {
  constexpr int looks = 32;
  Jet out;
  for (int i = 0; i <= looks; ++i) {
    const Jet jet = law(until * i / looks);
    const auto see = [](double& most, double x) { most = std::isfinite(x) ? std::max(most, std::abs(x)) : most; };
    see(out.value, jet.value), see(out.rate, jet.rate), see(out.accel, jet.accel);
  }
  return out;
}

bool goes_on(const LawBreak& b, const Jet& size) {
  const auto same = [](double left, double right, double most, double within) {
    return std::abs(left - right) <= within * std::max({std::abs(left), std::abs(right), most});
  };
  return same(b.left.value, b.right.value, size.value, 1e-10) && same(b.left.rate, b.right.rate, size.rate, 1e-8) &&
         same(b.left.accel, b.right.accel, size.accel, 1e-6);
}

LawScale of_formula(const Program& program, const TimeLaw& law, double until, int most) {
  LawScale out;
  Roots roots(program, until, most);
  if (!roots.find()) return out;
  const Jet size = size_of(law, until);
  Spread spread(law, until);
  Sampling sampling(program, law, spread);
  std::vector<std::pair<double, double>> between;
  double begin = 0;
  for (const Root& r : roots.all()) {
    if (r.after >= until) break;
    if (r.before > begin) between.emplace_back(begin, r.before);
    begin = r.after;
    const LawBreak b{r.before, r.after, law(r.before), law(r.after)};
    if (r.step_end || !goes_on(b, size)) out.breaks.push_back(b);
  }
  between.emplace_back(begin, until);
  for (const auto& [a, b] : between) sampling.begin(a, b);
  const bool fine = sampling.refine(until, most);
  LawScale unknown;
  out.not_finite = unknown.not_finite = spread.not_finite();
  if (!fine) return unknown;
  for (const auto& [a, b] : between)
    if (!divide(law, a, b, sampling.samples(), spread.little(), until, most, out.pieces)) return unknown;
  out.fastest = spread.fastest();
  out.known = true;
  return out;
}

// Only those kinks of a polyline that matter over the next samples; a spline has none.
LawScale of_samples(const Samples& s, bool linear, const TimeLaw& law, double until, int most) {
  LawScale out;
  Spread spread(law, until);
  std::vector<Sample> samples;
  for (const double t : s.t)
    if (t >= 0 && t <= until) samples.push_back({t, law(t)}), spread.see(samples.back());
  double begin = 0;
  for (std::size_t i = 1; linear && i + 1 < s.t.size(); ++i) {
    const double t = s.t[i], h = std::min(t - s.t[i - 1], s.t[i + 1] - t);
    if (!(t > 0 && t < until)) continue;
    const LawBreak b{t - roundings(t, 4), t + roundings(t, 4), law(t - roundings(t, 4)), law(t + roundings(t, 4))};
    if (std::abs(b.right.rate - b.left.rate) * h <= spread.little()) continue;
    if (!divide(law, begin, b.before, samples, spread.little(), until, most, out.pieces)) return {};
    begin = b.after;
    out.breaks.push_back(b);
  }
  if (!divide(law, begin, until, samples, spread.little(), until, most, out.pieces)) return {};
  out.fastest = spread.fastest();
  out.known = true;
  return out;
}

}  // namespace

LawScale scale_of(const TimeLaw& law, double until, int most) {
  if (!(until > 0)) return {};
  if (const auto* program = law.target<Program>()) return of_formula(*program, law, until, most);
  if (const auto* spline = law.target<Spline>()) return of_samples(spline->samples(), false, law, until, most);
  if (const auto* polyline = law.target<Polyline>()) return of_samples(polyline->samples(), true, law, until, most);
  return {};
}

bool value_jumps(const LawBreak& b) {
  return std::abs(b.right.value - b.left.value) > 1e-10 * std::max({1.0, std::abs(b.left.value), std::abs(b.right.value)});
}

bool speed_jumps(const LawBreak& b, double fastest) {
  return std::abs(b.right.rate - b.left.rate) > 1e-7 * std::max({fastest, std::abs(b.left.rate), std::abs(b.right.rate)});
}

}  // namespace pintle
