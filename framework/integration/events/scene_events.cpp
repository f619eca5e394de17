#include "framework/integration/events/scene_events.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "framework/common/archive.h"
#include "framework/common/index.h"
#include "framework/common/text.h"
#include "framework/integration/events/roots.h"
#include "framework/integration/stepper.h"

namespace pintle {

namespace {

constexpr double guard_rounding = 1e-15, guard_near = 1e-12;  // of its largest value: when it is located, when it is zero
constexpr double guard_still = 1e-10;                         // … and within which it has not moved
constexpr double guard_ahead = 1e-5;                          // extrapolation of the motion, to see whether a guard leaves zero [s]

}  // namespace

SceneEvents::SceneEvents(const System& system, std::vector<SceneEventRule> rules)
    : system_(system), rules_(std::move(rules)), waits_(rules_.size(), Waits::for_true), away_(rules_.size(), 0), shift_(rules_.size(), 0) {
  for (const SceneEventRule& rule : rules_) {
    first_.push_back(size_.size());
    size_.resize(size_.size() + rule.when.size(), 0);
    for (const SceneComparison& one : rule.when) any_of_speeds_ = any_of_speeds_ || one.of_speeds;
  }
}

// The smallest of its comparisons, each relative to its largest value.
Guard SceneEvents::all_of(int event, const State& state) const {
  Guard least{std::numeric_limits<double>::infinity()};
  const auto& when = rules_[at(event)].when;
  for (std::size_t k = 0; k < when.size(); ++k) {
    Guard now = when[k].difference(system_, state, {.rate = true});
    if (!std::isfinite(now.value)) return {std::numeric_limits<double>::quiet_NaN()};
    if (const double size = size_[first_[at(event)] + k]; size > 0) now.value /= size, now.rate /= size;
    if (now.value < least.value) least = now;
  }
  return least;
}

double SceneEvents::look(int event, const State& state, std::vector<double>& out, bool with_kinks) const {
  const auto& when = rules_[at(event)].when;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < when.size(); ++k) {
    const double size = size_[first_[at(event)] + k];
    const double now = when[k].difference(system_, state, {.kinks = with_kinks ? &out : nullptr}).value / (size > 0 ? size : 1);
    if (!(now >= least) && !std::isnan(least)) least = now;
    out.push_back(now);
  }
  return least;
}

// Whether the condition holds; numbers closer than guard_near count as equal.
bool SceneEvents::holds(int event, const State& state) const {
  std::vector<double> now;
  look(event, state, now);
  for (std::size_t k = 0; k < now.size(); ++k)
    if (!(rules_[at(event)].when[k].at_zero ? now[k] >= -guard_near : now[k] > guard_near)) return false;
  return true;
}

State SceneEvents::extrapolated(const Instant& from, double dt) const {
  const Eigen::Index n = system_.n();
  State next = from.state;
  next.t += dt;
  next.y += dt * from.dy;
  next.y.head(n) += dt * dt / 2 * from.dy.segment(n, n);
  return next;
}

// Whether the guard rises, according to the motion just after the instant.
bool SceneEvents::rises(int event, const Instant& from) const {
  return all_of(event, extrapolated(from, guard_ahead)).value > std::max(guard_near, all_of(event, from.state).value);
}

// At zero a comparison is true for >= and <=, false for > and <. Most conditions need no state for this.
bool SceneEvents::true_at_zero(int event, const State& state) const {
  const auto& when = rules_[at(event)].when;
  const auto equal = std::ranges::count(when, true, &SceneComparison::at_zero);
  return equal == std::ssize(when) || (equal > 0 && holds(event, state));
}

bool SceneEvents::on_zero(int event, const State& state) const { return std::abs(all_of(event, state).value) <= guard_near; }

// Whether the guard stays at zero around this end of the step, inside the step and beyond it, and does not just pass zero.
bool SceneEvents::stands(int event, const Step& step, const DenseOutput& motion, bool at_end) const {
  constexpr double part = 0.125, ahead = 1e-3;
  const double beside = at_end ? step.to.state.t - part * step.h : step.from.state.t + part * step.h;
  return on_zero(event, motion.at(beside)) &&
         on_zero(event, extrapolated(at_end ? step.to : step.from, std::max(guard_ahead, ahead * step.h)));
}

// A condition that stays at zero is true or false there as its comparison says. Its guard is shifted to the side from which it came.
void SceneEvents::decide_at_zero(int event, const Step& step, const DenseOutput& motion, Guard& from, Guard& to) {
  if (waits_[at(event)] == Waits::no_more || !(step.h > 0)) return;
  double& shift = shift_[at(event)];
  const double aside = believed(event) ? -2 * guard_near : 2 * guard_near;
  const auto differs = [&](const Guard& guard, bool at_end) {
    return std::abs(guard.value - shift) <= guard_near && true_at_zero(event, (at_end ? step.to : step.from).state) != believed(event) &&
           stands(event, step, motion, at_end);
  };
  if (shift == aside || !(differs(to, true) || differs(from, false))) return;
  from.value += aside - shift, to.value += aside - shift;
  shift = aside;
}

// The size of a comparison is the largest magnitude so far of the compared quantities, also if everything moved as fast as the fastest:
// otherwise a quantity at rest would be compared with rounding.
void SceneEvents::see(const State& state) {
  const Eigen::Index n = system_.n();
  if (any_of_speeds_ && n > 0) {
    faster_ = state;
    const double fastest = state.y.segment(n, n).cwiseQuotient(system_.scale.head(n)).lpNorm<Eigen::Infinity>();
    for (Eigen::Index i = 0; i < n; ++i)  // unevenly, so that differences of two speeds do not vanish
      faster_.y[n + i] += fastest * system_.scale[i] * (1 + 0.5 * static_cast<double>(i) / static_cast<double>(n));
  }
  for (int event = 0; event < size(); ++event) {
    if (waits_[at(event)] == Waits::no_more) continue;
    for (std::size_t k = 0; k < rules_[at(event)].when.size(); ++k) {
      const SceneComparison& one = rules_[at(event)].when[k];
      double& size = size_[first_[at(event)] + k];
      double here = 0, faster = 0;
      one.difference(system_, state, {.size = &here});
      if (one.of_speeds && n > 0) one.difference(system_, faster_, {.size = &faster});
      for (const double x : {here, faster})
        if (std::isfinite(x)) size = std::max(size, x);
    }
  }
}

std::string SceneEvents::remedy() const {
  return "their actions undo their conditions: use two different levels (a hysteresis), or once: true";
}

WatchedGuard SceneEvents::watch(int event) const {
  if (waits_[at(event)] == Waits::no_more) return {};
  const Direction way = waits_[at(event)] == Waits::for_true ? Direction::rising : Direction::falling;
  return {.direction = way, .zero = guard_near, .at_once = true, .level = true};
}

Guard SceneEvents::guard(int event, const State& state) const {
  Guard now = all_of(event, state);
  if (std::isnan(now.value)) return {waits_[at(event)] == Waits::for_true ? 1.0 : -1.0};  // leads to `act`, which reports it
  now.value += shift_[at(event)];
  return now;
}

// Examines parts of the step, and in each the zeros of every comparison, of its kinks, and of minima between three points: between two of
// these no comparison changes.
std::optional<double> SceneEvents::positive_inside(int event, const Step& step, const DenseOutput& motion, double) const {
  constexpr int parts = 8;
  constexpr double fine = 1e-12;
  if (waits_[at(event)] == Waits::no_more) return std::nullopt;
  const double sign = waits_[at(event)] == Waits::for_true ? 1 : -1;
  const auto comes = [&](double t) { return sign * guard(event, motion.at(t)).value > 0; };
  struct Moment {
    double t;
    std::optional<bool> comes = {};  ///< if known
  };
  const auto looked = [&](double t) {
    std::vector<double> out;
    const double least = look(event, motion.at(t), out, true);
    out.push_back(least + shift_[at(event)]);
    return out;
  };
  std::array<std::vector<double>, 3> f;
  std::array<double, 3> t{};
  std::vector<Moment> moments;
  for (int i = 0; i <= parts; ++i) {
    t = {t[1], t[2], step.from.state.t + step.h * (i == 0 ? 1e-9 : static_cast<double>(i) / parts)};
    std::rotate(f.begin(), f.begin() + 1, f.end());
    f[2] = looked(t[2]);
    if (sign * f[2].back() > 0 && i == 0) return t[2];
    for (std::size_t k = 0; i > 0 && k < f[2].size(); ++k) {
      const double up = f[1][k] < f[2][k] ? 1 : -1, near = f[1][k] > 0 ? 1 : -1;
      if (f[1][k] * f[2][k] < 0)
        moments.push_back({crossing([&](double when) { return Guard{up * looked(when)[k]}; }, t[1], t[2], fine * step.h)});
      if (i < 2 || f[0][k] * f[2][k] <= 0 || near * f[1][k] > near * f[0][k] || near * f[1][k] > near * f[2][k]) continue;
      const auto of_k = [&](double when) { return near * looked(when)[k]; };
      if (const auto touch = below_zero_near(of_k, t, {near * f[0][k], near * f[1][k], near * f[2][k]})) moments.push_back({*touch});
    }
    moments.push_back({t[2], !(sign * f[2].back() <= 0)});  // NaN counts, to be reported
  }
  std::ranges::sort(moments, {}, &Moment::t);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    if (i > 0 && moments.size() > parts + 1u)
      if (const double middle = moments[i - 1].t + (moments[i].t - moments[i - 1].t) / 2; comes(middle)) return middle;
    if (moments[i].comes ? *moments[i].comes : comes(moments[i].t)) return moments[i].t;
  }
  return std::nullopt;
}

bool SceneEvents::comes_at_zero(int event, const State& state) const {
  return holds(event, state) == (waits_[at(event)] == Waits::for_true);
}

bool SceneEvents::met(int, const Guard& guard) const { return std::abs(guard.value) <= guard_rounding; }

// At the ends of steps, and in the middle of the last step, which may be the only point between two events.
bool SceneEvents::hardly_left(int event, const Step& step, const DenseOutput& motion) const {
  if (away_[at(event)] > guard_still) return false;
  return step.h == 0 || std::abs(guard(event, motion.at(step.from.state.t + step.h / 2)).value) <= guard_still;
}

// A start may be where an earlier run located the event, to the resolution of its time.
void SceneEvents::start(Step& step) {
  constexpr double last_digits = 4.5e-16;  // two to four units in the last place of the time
  const State &state = step.to.state, next = extrapolated(step.to, guard_ahead);
  const Eigen::Index moving = 2 * system_.n();
  State begun = state;
  begun.y.head(moving) = next.y.head(moving);
  see(state);
  see(begun);  // also of quantities that begin to move
  for (int event = 0; event < size(); ++event) {
    const double now = all_of(event, state).value, rate = (all_of(event, next).value - now) / guard_ahead;
    const bool on_level = std::abs(now) <= std::max(guard_near, last_digits * std::abs(rate * state.t));
    const bool is_true = on_level ? true_at_zero(event, state) : now > 0;
    double& shift = shift_[at(event)];
    if (rules_[at(event)].from_start) {
      if (on_level && is_true) shift = 2 * guard_near - now;
    } else if (is_true || (on_level && rises(event, step.to))) {
      waits_[at(event)] = Waits::for_false;
      if (on_level)
        shift = 2 * guard_near - now;
      else if (true_at_zero(event, state))
        shift = 2 * guard_near;
    }
  }
}

// A comparison at zero that does not rise there, such as the speed of a body that is held, must rise by more than rounding.
void SceneEvents::begin_step(const State& from) {
  for (int event = 0; event < size(); ++event) {
    if (waits_[at(event)] != Waits::for_true || shift_[at(event)] != 0) continue;
    const Guard now = all_of(event, from);
    if (std::abs(now.value) <= guard_near && !(now.rate > 0)) shift_[at(event)] = -2 * guard_near;
  }
}

// The shift of a guard is removed once it has gone well below zero.
std::string SceneEvents::follow(Step& step, std::span<const Guard> from, std::span<const Guard> to, const DenseOutput&) {
  see(step.to.state);
  for (int event = 0; event < size(); ++event) {
    for (const Guard& now : {from[at(event)], to[at(event)]}) away_[at(event)] = std::max(away_[at(event)], std::abs(now.value));
    if (waits_[at(event)] == Waits::for_true && shift_[at(event)] != 0 && all_of(event, step.to.state).value < -2 * guard_near)
      shift_[at(event)] = 0;
  }
  return {};
}

// Other conditions that fall to the level at which this event acts count as no longer true: they may become true as soon as the motion
// reverses.
void SceneEvents::rearm_beside(int event, const Step& step) {
  for (int other = 0; other < size(); ++other) {
    if (other == event || waits_[at(other)] != Waits::for_false) continue;
    const double now = all_of(other, step.to.state).value;
    const double before = step.h > 0 ? all_of(other, step.from.state).value : now;
    if (!(std::abs(now) <= 4 * guard_near && before - now > guard_near)) continue;
    if (true_at_zero(other, step.to.state) && on_zero(other, extrapolated(step.to, guard_ahead))) continue;  // it stays at zero
    if (rules_[at(other)].otherwise.empty())
      waits_[at(other)] = Waits::for_true, shift_[at(other)] = -2 * guard_near;
    else
      shift_[at(other)] = -2 * guard_near - now;  // it acts at this instant
  }
}

// A jump of the state may make two compared numbers exactly equal. A condition that it makes false may become true again at this instant,
// even if it has no actions for becoming false.
void SceneEvents::decide_on_level(const std::vector<double>& before, const State& state) {
  for (int event = 0; event < size(); ++event) {
    const double now = all_of(event, state).value;
    if (now == before[at(event)]) continue;
    if (waits_[at(event)] == Waits::for_false && rules_[at(event)].otherwise.empty() && now < -guard_near)
      waits_[at(event)] = Waits::for_true, shift_[at(event)] = 0;
    if (!(std::abs(now) <= guard_near) || waits_[at(event)] == Waits::no_more) continue;
    const bool is_true = holds(event, state);
    if (is_true == (waits_[at(event)] == Waits::for_true))
      shift_[at(event)] = (is_true ? 2 : -2) * guard_near - now;
    else
      shift_[at(event)] = is_true ? 2 * guard_near : 0;
  }
}

namespace {

std::string list_of(const System& system, const std::vector<SwitchOver>& changes, bool engaged) {
  std::string out;
  for (const SwitchOver& one : changes)
    if (one.engage == engaged)
      out += (out.empty() ? engaged ? "engaged " : "released " : ", ") + switch_name(system, system.switches[at(one.at)]);
  return out;
}

constexpr const char* failed_to_act = "could not do it, which ended the run";  // the event has occurred nevertheless

void add_words(std::string& did, const std::string& words) {
  if (!words.empty()) did += (did.empty() ? "" : "; ") + words;
}

}  // namespace

// @returns false if they cannot be switched this way
bool SceneEvents::switches_all(const std::vector<EventAction>& actions, State& state, EventOutcome& out) {
  std::vector<SwitchOver> changes;
  for (const EventAction& action : actions)
    if (const auto* change = std::get_if<SwitchOver>(&action)) changes.push_back(*change);
  if (changes.empty()) return true;
  if (!eq_) eq_ = std::make_unique<Equations>(system_);
  const Engagement made = switch_over(system_, changes, state, *eq_);
  if (!made.trouble.empty()) {
    out.failure = made.trouble;
    return false;
  }
  if (made.changed) out.change = EventOutcome::Change::rows;
  add_words(out.did, list_of(system_, changes, false));
  add_words(out.did, list_of(system_, changes, true) + (made.lost > 0 ? " (" + number_text(made.lost, 6) + " J lost)" : ""));
  if (!made.changed) out.did += " (already so)";
  return true;
}

EventOutcome SceneEvents::act(int event, Step& step, const Guard&) {
  const SceneEventRule& rule = rules_[at(event)];
  for (const SceneComparison& one : rule.when) {
    if (std::isfinite(one.difference(system_, step.to.state, {}).value)) continue;
    EventOutcome none;
    none.failure = "the condition of the event " + quoted(rule.name) + " is not a finite number at t = " + number_text(step.to.state.t, 9) +
                   " s" + (one.seen ? one.seen(system_, step.to.state) : "");
    return none;
  }
  away_[at(event)] = 0;
  const bool becomes_true = waits_[at(event)] == Waits::for_true;
  const std::vector<EventAction>& actions = becomes_true ? rule.actions : rule.otherwise;
  waits_[at(event)] = !becomes_true ? Waits::for_true : rule.once ? Waits::no_more : Waits::for_false;
  EventOutcome out{.change = EventOutcome::Change::nothing};
  State& state = step.to.state;
  std::vector<double> before;
  for (int other = 0; other < size(); ++other) before.push_back(all_of(other, state).value);
  const double now = before[at(event)];  // zero, up to the rounding of the time
  shift_[at(event)] = becomes_true ? std::max(2 * guard_near, -2 * now) : now > -guard_near ? -2 * guard_near - now : 0;
  rearm_beside(event, step);
  if (!switches_all(actions, state, out)) {
    out.failure = "the event \"" + rule.name + "\": " + out.failure;
    out.did = failed_to_act;
    return out;
  }
  const State seen = state;
  for (const EventAction& action : actions) {
    if (const auto* set = std::get_if<SetState>(&action)) {
      set->set(system_, seen, state);
      if (!state.y.allFinite()) {
        out.failure = "the event " + quoted(rule.name) + " sets " + set->name +
                      " to a value that is not finite at t = " + number_text(state.t, 9) + " s" +
                      (set->seen ? set->seen(system_, seen) : "");
        out.did = failed_to_act;
        return out;
      }
      out.change = std::max(out.change, EventOutcome::Change::jump);
      add_words(out.did, "set " + set->name);
    } else if (const auto* stop = std::get_if<StopRun>(&action)) {
      out.end = stop->reason;
      add_words(out.did, "stopped the run");
    } else if (const auto* record = std::get_if<Record>(&action)) {
      (*record == Record::state ? out.save : out.row) = true;
      add_words(out.did, *record == Record::state ? "saved the state" : "wrote a row");
    }
  }
  decide_on_level(before, state);
  return out;
}

void SceneEvents::save(Writer& out) const {
  out.whole(waits_);
  out.whole(size_);
  out.whole(away_);
  out.whole(shift_);
}
void SceneEvents::load(Reader& in) {
  in.whole(waits_);
  in.whole(size_);
  in.whole(away_);
  in.whole(shift_);
}
const char* SceneEvents::fault() const {
  const std::size_t comparisons = rules_.empty() ? 0 : first_.back() + rules_.back().when.size();
  const bool sound = waits_.size() == rules_.size() && size_.size() == comparisons && away_.size() == rules_.size() &&
                     shift_.size() == rules_.size() && std::ranges::all_of(waits_, [](Waits w) { return w <= Waits::no_more; }) &&
                     std::ranges::all_of(size_, [](double x) { return std::isfinite(x) && x >= 0; }) &&
                     std::ranges::all_of(shift_, [](double x) { return std::isfinite(x); });
  return sound ? nullptr : foreign_modes;
}

}  // namespace pintle
