#include "framework/integration/events/scene_events.h"

#include <algorithm>
#include <cmath>

#include "framework/common/archive.h"
#include "framework/common/index.h"
#include "framework/common/text.h"
#include "framework/integration/events/roots.h"
#include "framework/integration/stepper.h"

namespace pintle {

namespace {

constexpr double guard_rounding = 1e-15, guard_near = 1e-12;  // of the largest that it was: where it is met, and where it is zero

}  // namespace

SceneEvents::SceneEvents(const System& system, std::vector<SceneEventRule> rules)
    : system_(system),
      rules_(std::move(rules)),
      waits_(rules_.size(), Waits::for_true),
      unsound_(rules_.size(), -1),
      shift_(rules_.size(), 0) {
  for (const SceneEventRule& rule : rules_) {
    first_.push_back(size_.size());
    size_.resize(size_.size() + rule.when.size(), 0);
  }
}

// The least of them all, each over the largest that it was.
Guard SceneEvents::all_of(int event, const State& state) const {
  Guard least{std::numeric_limits<double>::infinity()};
  const auto& when = rules_[at(event)].when;
  for (std::size_t k = 0; k < when.size(); ++k) {
    Guard now = when[k](system_, state);
    if (std::isnan(now.value)) return now;
    if (const double size = size_[first_[at(event)] + k]; size > 0) now.value /= size, now.rate /= size;
    if (now.value < least.value) least = now;
  }
  return least;
}

// A comparison is as large as it has been, or as it would change if all were as fast as the fastest: else it would be measured by rounding
// where what it asks for stands still.
void SceneEvents::see(const State& state) {
  faster_ = state;
  const Eigen::Index n = system_.n();
  const double fastest = n > 0 ? state.y.segment(n, n).cwiseQuotient(system_.scale.head(n)).lpNorm<Eigen::Infinity>() : 0;
  for (Eigen::Index i = 0; i < n; ++i)  // unevenly, so that differences of two speeds do not vanish
    faster_.y[n + i] += fastest * system_.scale[i] * (1 + 0.5 * std::sin(static_cast<double>(i)));
  for (std::size_t event = 0; event < rules_.size(); ++event) {
    unsound_[event] = -1;
    if (waits_[event] == Waits::no_more) continue;
    for (std::size_t k = 0; k < rules_[event].when.size(); ++k) {
      const double now = rules_[event].when[k](system_, state).value, change = rules_[event].when[k](system_, faster_).value - now;
      double& size = size_[first_[event] + k];
      for (const double x : {now, change})
        if (std::isfinite(x)) size = std::max(size, std::abs(x));
      if (std::isnan(now)) unsound_[event] = static_cast<int>(k);
    }
  }
}

WatchedGuard SceneEvents::watch(int event) const {
  if (waits_[at(event)] == Waits::no_more) return {};
  const Direction way = waits_[at(event)] == Waits::for_true ? Direction::rising : Direction::falling;
  return {.direction = way, .zero = guard_near, .at_once = true, .level = true};
}

Guard SceneEvents::guard(int event, const State& state) const {
  if (unsound_[at(event)] >= 0) return {waits_[at(event)] == Waits::for_true ? 1.0 : -1.0};  // which leads to `act`, where it is named
  Guard now = all_of(event, state);
  now.value += shift_[at(event)];
  return now;
}

// Parts of the step are looked at, and where the guard bends towards zero between three of them.
std::optional<double> SceneEvents::positive_inside(int event, const Step& step, const DenseOutput& motion) const {
  constexpr int parts = 8;
  if (waits_[at(event)] == Waits::no_more) return std::nullopt;
  const double sign = waits_[at(event)] == Waits::for_true ? -1 : 1;
  const auto value = [&](double t) { return sign * guard(event, motion.at(t)).value; };  // below zero where it comes
  std::array<double, 3> t{}, f{};
  for (int i = 0; i <= parts; ++i) {
    const double now = step.from.state.t + step.h * (i == 0 ? 1e-9 : static_cast<double>(i) / parts);
    std::rotate(t.begin(), t.begin() + 1, t.end()), std::rotate(f.begin(), f.begin() + 1, f.end());
    t[2] = now, f[2] = value(now);
    if (f[2] < 0) return i == 0 ? std::nullopt : std::optional(now);
    if (i >= 2 && f[1] <= f[0] && f[1] <= f[2])
      if (const auto inside = below_zero_near(value, t, f)) return inside;
  }
  return std::nullopt;
}

bool SceneEvents::met(int, const Guard& guard) const { return std::abs(guard.value) <= guard_rounding; }

void SceneEvents::start(Step& step) {
  see(step.to.state);
  unsound_at_ = step.to.state;
  for (int event = 0; event < size(); ++event)
    if (all_of(event, step.to.state).value > 0 && !rules_[at(event)].from_start) waits_[at(event)] = Waits::for_false;
}

// What stands at zero and does not rise there, such as the speed of what is held, has to rise by more than rounding can.
void SceneEvents::begin_step(const State& from) {
  for (int event = 0; event < size(); ++event) {
    if (waits_[at(event)] != Waits::for_true) continue;
    const Guard now = all_of(event, from);
    if (std::abs(now.value) <= guard_near && !(now.rate > 0)) shift_[at(event)] = -2 * guard_near;
  }
}

bool SceneEvents::is_unsound(int event, const State& state) const {
  return std::isnan(rules_[at(event)].when[at(unsound_[at(event)])](system_, state).value);
}

void SceneEvents::follow(Step& step, std::span<const Guard>, std::span<const Guard>, const DenseOutput& motion) {
  const auto is_one = [](int k) { return k >= 0; };
  const bool known = std::ranges::any_of(unsound_, is_one);
  see(step.to.state);
  const auto first = std::ranges::find_if(unsound_, is_one);
  if (known || first == unsound_.end()) return;
  constexpr int halvings = 60;
  const int event = static_cast<int>(first - unsound_.begin());
  unsound_at_ = step.to.state;
  double sound = step.from.state.t;
  for (int i = 0; i < halvings && sound < unsound_at_.t; ++i) {
    const State between = motion.at(sound + (unsound_at_.t - sound) / 2);
    if (is_unsound(event, between))
      unsound_at_ = between;
    else
      sound = between.t;
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

void add_words(std::string& did, const std::string& words) {
  if (!words.empty()) did += (did.empty() ? "" : "; ") + words;
}

}  // namespace

// @returns false where they cannot be switched so
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
  if (const int k = unsound_[at(event)]; k >= 0) {
    EventOutcome none;
    const std::string seen = at(k) < rule.seen.size() ? rule.seen[at(k)](system_, unsound_at_) : "";
    none.failure =
        "the condition of the event " + quoted(rule.name) + " is not a finite number at t = " + number_text(unsound_at_.t, 9) + " s" + seen;
    return none;
  }
  const bool becomes_true = waits_[at(event)] == Waits::for_true;
  const std::vector<EventAction>& actions = becomes_true ? rule.actions : rule.otherwise;
  waits_[at(event)] = !becomes_true ? Waits::for_true : rule.once ? Waits::no_more : Waits::for_false;
  EventOutcome out{.change = EventOutcome::Change::nothing};
  State& state = step.to.state;
  const double now = all_of(event, state).value;  // zero, but for what the clock's last digit leaves
  shift_[at(event)] = becomes_true ? std::max(2 * guard_near, -2 * now) : std::min(0.0, -2 * now);
  if (!switches_all(actions, state, out)) {
    out.failure = "the event \"" + rule.name + "\": " + out.failure;
    return out;
  }
  const State seen = state;
  for (const EventAction& action : actions) {
    if (const auto* set = std::get_if<SetState>(&action)) {
      set->set(system_, seen, state);
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
  return out;
}

void SceneEvents::save(Writer& out) const {
  out.whole(waits_);
  out.whole(size_);
  out.whole(shift_);
}
void SceneEvents::load(Reader& in) {
  in.whole(waits_);
  in.whole(size_);
  in.whole(shift_);
}
const char* SceneEvents::fault() const {
  const std::size_t comparisons = rules_.empty() ? 0 : first_.back() + rules_.back().when.size();
  const bool sound = waits_.size() == rules_.size() && size_.size() == comparisons && shift_.size() == rules_.size() &&
                     std::ranges::all_of(waits_, [](Waits w) { return w <= Waits::no_more; }) &&
                     std::ranges::all_of(size_, [](double x) { return std::isfinite(x) && x >= 0; }) &&
                     std::ranges::all_of(shift_, [](double x) { return std::isfinite(x); });
  return sound ? nullptr : "it is of another system, or has numbers that are none";
}

}  // namespace pintle
