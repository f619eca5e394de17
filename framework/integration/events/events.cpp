#include "framework/integration/events/events.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "framework/common/some_of.h"
#include "framework/common/text.h"
#include "framework/integration/events/roots.h"

namespace pintle {

namespace {

double sign_of(Direction d) { return d == Direction::falling ? -1 : 1; }
/// Signed so that the event is where it becomes positive.
Guard turned(const Guard& g, const WatchedGuard& w) { return {sign_of(w.direction) * g.value, sign_of(w.direction) * g.rate}; }

}  // namespace

Events::Events(std::vector<std::unique_ptr<EventGroup>> groups) : groups_(std::move(groups)), wishes_(groups_.size()) {
  std::stable_sort(groups_.begin(), groups_.end(), [](const auto& a, const auto& b) { return a->order() < b->order(); });
  begin_.push_back(0);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    for (int i = 0; i < groups_[g]->size(); ++i) places_.push_back({g, i});
    begin_.push_back(places_.size());
  }
  watched_.resize(places_.size()), from_.resize(places_.size()), to_.resize(places_.size());
  spent_.assign(places_.size(), 0), crowded_ = spent_;
}

void Events::start(Step& step) {
  for (auto& g : groups_) g->start(step);
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const WatchedGuard w = ask(k);
    const bool left_undecided = w.at_once && group(k).order() > 0;  // a start found no forces: the event acts at once and reports this
    spent_[k] = !left_undecided && w.direction != Direction::none && turned(guard(k, step.to.state), w).value > 0;
  }
}

void Events::begin_step(const State& from) {
  for (auto& g : groups_) g->begin_step(from);
  from_.swap(to_);
  if (!known_)
    for (std::size_t k = 0; k < places_.size(); ++k) from_[k] = guard(k, from);
  known_ = false;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    watched_[k] = ask(k);
    if (spent_[k]) spent_[k] = !(turned(from_[k], watched_[k]).value < -watched_[k].zero);
  }
}

double Events::kink_ahead(double wish) const {
  constexpr double little = 1e-2;  // relative to the desired step: if the kink is nearer than this, the step may pass it
  constexpr double past = 1.02;    // margin, because a contact opens with increasing speed
  double ahead = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const WatchedGuard& w = watched_[k];
    if (!w.kink) continue;
    const Guard g = turned(from_[k], w);
    if (!(g.rate > 0) || !(g.value < 0)) continue;
    const double left = past * -g.value / g.rate;
    if (left > little * wish) ahead = std::min(ahead, left);
  }
  return ahead;
}

void Events::look_at_end(const Step& step, const Equations* evaluated) {
  for (std::size_t k = 0; k < places_.size(); ++k)
    to_[k] = evaluated ? group(k).guard(places_[k].event, step.to.state, *evaluated) : guard(k, step.to.state);
}

// Of the events that a step may pass: the one passed farthest among those with finite overshoot; otherwise the last.
std::optional<EventInStep> Events::passed_by_end(const Step& step) const {
  std::optional<EventInStep> out;
  double farthest = 0;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const WatchedGuard& w = watched_[k];
    if (w.direction == Direction::none || w.overshoot == 0) continue;
    const double past = turned(to_[k], w).value;
    const bool counts = std::isfinite(w.overshoot);
    if (counts ? past > farthest : past >= 0 && farthest == 0) out = {k, w, step.to.state.t};
    if (counts) farthest = std::max(farthest, past);
  }
  return out;
}

// Time of an event in the step, by dense output; nothing if it does not occur, or perhaps if it occurs after `until`.
std::optional<double> Events::passage(std::size_t at, const Step& step, const DenseOutput& motion, double until) const {
  const WatchedGuard& w = watched_[at];
  const double t0 = step.from.state.t, t1 = step.to.state.t;
  const Guard from = turned(from_[at], w), to = turned(to_[at], w);
  const auto along = [&](double t) { return turned(guard(at, motion.at(t)), w); };
  if (w.level && from.value > w.zero) return t0;
  double begin = t0, end = t1;
  const bool spent = spent_[at];
  if (spent && from.rate > 0) return std::nullopt;  // this is the previous passage
  // A contact may end slightly before its gap opens, within its own accuracy.
  const double left = t0 - 2 * from.value / from.rate;
  const bool leaves = !spent && from.value > w.zero && from.rate < 0 && left < t1 && along(left).value < 0;
  if (!(to.value > 0)) {
    std::optional<double> between;  // the closest look comes first: others may find a later time
    if (spent || leaves || !(from.value > w.zero)) between = group(at).positive_inside(places_[at].event, step, motion, until);
    if (!between && from.rate > 0 && to.rate < 0) between = positive_between(along, t0, t1, from.rate, to.rate);
    const bool parted = leaves || ((spent || std::abs(from.value) <= w.zero) && from.rate < 0);
    if (!between && (parted || may_be_positive_between(from, to, t1 - t0))) between = positive_in_parts(along, t0, from, t1);
    if (!between) return std::nullopt;
    end = *between;
  } else if (spent || leaves || !(from.value > w.zero)) {  // it may have been positive earlier, and negative again
    end = group(at).positive_inside(places_[at].event, step, motion, until).value_or(t1);
  }
  if (spent || (from.value > -w.zero && from.rate < 0)) {  // at zero and decreasing: start the search after it has decreased
    const double away = std::min(from.value, spent ? -w.zero : 0.0);
    for (double part = 0.5; part > 1e-9 && begin == t0; part /= 2)
      if (const double t = t0 + part * (end - t0); along(t).value < away) begin = t;
    if (begin == t0 && (spent || from.value >= 0)) {           // it has not decreased
      if (spent && w.at_once && from.rate < 0 && to.rate > 0)  // no decrease was visible, but it returns: the event is at its minimum
        return crossing([&](double t) { return Guard{along(t).rate}; }, t0, t1, 1e-9 * step.h);
      if (spent || !w.at_once || here_ > 4) return std::nullopt;
      end = t0;
    }
  } else if (from.value >= 0) {
    end = t0;
  }
  constexpr double fine = 1e-9;  // below the accuracy of dense output
  return end > begin ? crossing(along, begin, end, fine * step.h) : t0;
}

std::optional<EventInStep> Events::first(const Step& step, const DenseOutput& motion, const Equations* evaluated) {
  look_at_end(step, evaluated);
  constexpr double together = 1e-6;  // relative to the step: events so near in time may act in either order
  constexpr double beyond = 0.05;    // relative to the step: so much later than by dense output an event may really come
  second_ = std::numeric_limits<double>::infinity(), together_ = together * step.h;
  for (std::size_t k = 0; k < places_.size(); ++k)
    if (watched_[k].level) group(k).decide_at_zero(places_[k].event, step, motion, from_[k], to_[k]);
  const std::optional<EventInStep> at_end = passed_by_end(step);
  if (at_end && turned(to_[at_end->at], at_end->watch).value > at_end->watch.overshoot) return at_end;  // passed too far
  std::optional<EventInStep> out;
  double until = step.to.state.t;  // what may come later than this is not searched for
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const WatchedGuard& w = watched_[k];
    if (w.direction == Direction::none || w.overshoot > 0) continue;
    const std::optional<double> t = passage(k, step, motion, until);
    if (!t) continue;
    if (!out || *t < out->t) {
      if (out) second_ = out->t;
      out = {k, w, *t};
      until = std::min(step.to.state.t, *t + beyond * step.h);
    } else {
      second_ = std::min(second_, *t);
    }
  }
  if (until < step.to.state.t) second_ = std::min(second_, until + together_);
  return out ? out : at_end;
}

bool Events::passes_another(const Step& step) const { return second_ < step.to.state.t - together_; }

bool Events::comes_by(const State& later) const {
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const WatchedGuard& w = watched_[k];
    if (w.direction != Direction::none && !(turned(to_[k], w).value > 0) && turned(guard(k, later), w).value > w.zero) return true;
  }
  return false;
}

std::optional<EventInStep> Events::due(const State& end) const {
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const WatchedGuard w = ask(k);
    if (!w.level || w.direction == Direction::none) continue;
    const double before = turned(from_[k], w).value, now = turned(guard(k, end), w).value;
    if (now > w.zero || (before < -w.zero && now >= -w.zero && group(k).comes_at_zero(places_[k].event, end)))
      return EventInStep{k, w, end.t};
  }
  return std::nullopt;
}

Events::Ending Events::end_at(const EventInStep& event, Stepper& stepper, const ErrorNorm& norm, Step& step, Equations& eq) {
  if (event.watch.overshoot > 0) return turned(to_[event.at], event.watch).value <= event.watch.overshoot ? Ending::there : Ending::missed;
  const double t0 = step.from.state.t, t1 = step.to.state.t, h = step.h;
  double t = event.t;
  if (t <= t0) {  // at once
    step.to = step.from;
    step.h = 0;
    return Ending::there;
  }
  constexpr double last_digits = 4.5e-16;  // two last digits of the time: the zero cannot be located more accurately
  double t_before = t0, low = t0, high = turned(to_[event.at], event.watch).value > 0 ? t1 : std::numeric_limits<double>::infinity();
  Guard now = from_[event.at];
  constexpr double dense_part = 1e-9;              // relative to the step: accuracy of the search on dense output
  const int most = std::isnan(now.rate) ? 12 : 6;  // by secants, or by Newton's method
  for (int i = 0; i < most && t > t0; ++i) {
    if (!stepper.attempt(t - t0, norm, step, eq)) {
      step.h = h;
      return Ending::missed;
    }
    const Guard before = std::exchange(now, guard(event.at, step.to.state));
    if (group(event.at).met(places_[event.at].event, now)) {
      if (!event.watch.level || norm.of(step, stepper.traits().follows_impacts) <= 1) return Ending::there;
      step.h = h;
      return Ending::missed;  // the longer step missed what this step resolves
    }
    const bool at_rounding = std::abs(now.value) <= event.watch.zero && std::abs(now.value) > std::abs(before.value) / 2;
    if (!event.watch.level && i > 0 && at_rounding) return Ending::there;
    (turned(now, event.watch).value > 0 ? high : low) = t;
    const double rate = std::isnan(now.rate) ? (now.value - before.value) / (t - t_before) : now.rate;
    double next = std::clamp(t - now.value / rate, t0, t1);
    if (event.watch.level && !(rate != 0)) next = std::min(t + std::ldexp(dense_part * h, 4 * i), t1);  // it may jump just ahead
    if (event.watch.level && turned(now, event.watch).value > event.watch.zero && !(next < t)) break;   // it has jumped before
    if (std::abs(next - t) <= last_digits * std::abs(t1)) {
      if (event.watch.level && !(turned(now, event.watch).value > -event.watch.zero)) break;  // before a jump
      return Ending::there;
    }
    t_before = std::exchange(t, next);
  }
  if (t > t0 && std::abs(now.value) <= event.watch.zero) return Ending::there;
  if (event.watch.level && std::isfinite(high)) return bisect(event, low < high ? low : t0, high, stepper, norm, step, eq);
  step.h = h;
  return Ending::missed;
}

// Locates a jump of a guard between two adjacent values of the time.
Events::Ending Events::bisect(const EventInStep& event, double low, double high, Stepper& stepper, const ErrorNorm& norm, Step& step,
                              Equations& eq) {
  const double t0 = step.from.state.t;
  while (true) {
    const double t = low + (high - low) / 2;
    const bool last = !(t > low && t < high);
    if (!stepper.attempt((last ? high : t) - t0, norm, step, eq)) return Ending::impossible;
    if (last) return Ending::there;
    (turned(guard(event.at, step.to.state), event.watch).value > 0 ? high : low) = t;
  }
}

std::string Events::follow(Step& step, const DenseOutput& motion) {
  std::string impossible;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const std::size_t size = begin_[g + 1] - begin_[g];
    const std::string why = groups_[g]->follow(step, {from_.data() + begin_[g], size}, {to_.data() + begin_[g], size}, motion);
    if (impossible.empty()) impossible = why;
  }
  return impossible;
}

bool Events::count(const Step& step, const std::optional<EventInStep>& event, const DenseOutput& motion, double wish) {
  constexpr double hardly = 1e-6;  // relative to a step
  const int most = 100 + 2 * static_cast<int>(places_.size());
  const bool crowds = event && step.h <= hardly * wish && (step.h == 0 || !group(event->at).remedy().empty());
  if (event) still_ = group(event->at).hardly_left(places_[event->at].event, step, motion);
  if (!crowds && !still_) crowd_ = 0, std::ranges::fill(crowded_, 0);
  if (event) ++crowd_, crowded_[event->at] = 1;
  here_ = !event ? 0 : step.h > 0 ? 1 : here_ + 1;
  return here_ <= most && crowd_ <= most;
}

std::string Events::again_and_again() const {
  std::vector<std::string> names;
  std::string remedy;
  for (std::size_t k = 0; k < places_.size(); ++k)
    if (crowded_[k]) {
      const std::string name = group(k).name(places_[k].event);
      names.push_back(name.find('"') == std::string::npos ? "the event " + quoted(name) : name);
      if (remedy.empty()) remedy = group(k).remedy();
    }
  return some_of(names, false) + (names.size() > 1 ? ": their" : ": its") + " events repeat without time passing" +
         (remedy.empty() ? "" : "; " + remedy);
}

EventOutcome Events::act(const EventInStep& event, Step& step, double wish) {
  Wishes& wishes = wishes_[places_[event.at].group];
  (event.watch.direction == Direction::rising ? wishes.of_rising : wishes.of_falling) = wish;
  EventOutcome out = group(event.at).act(places_[event.at].event, step, to_[event.at]);
  spent_[event.at] = !event.watch.level && ask(event.at).direction == event.watch.direction;  // groups track level events themselves
  return out;
}

double Events::remembered_wish(const EventInStep& event) const {
  const Wishes& wishes = wishes_[places_[event.at].group];
  return event.watch.direction == Direction::rising ? wishes.of_falling : wishes.of_rising;
}

void Events::forget_wishes() {
  for (Wishes& w : wishes_) w = {};
}

const char* Events::fault() const {
  if (to_.size() != places_.size() || spent_.size() != places_.size() || crowded_.size() != places_.size()) return foreign_modes;
  for (const auto& g : groups_)
    if (const char* fault = g->fault()) return fault;
  return nullptr;
}

}  // namespace pintle
