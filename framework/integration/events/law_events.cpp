#include "framework/integration/events/law_events.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/common/archive.h"
#include "framework/common/index.h"
#include "framework/dynamics/model/signal_values.h"
#include "framework/integration/events/roots.h"
#include "framework/integration/stepper.h"

namespace pintle {

namespace {

// Relative to the largest value of a switch: when it is located, when it counts as zero, and how far it must return to switch again. A mark
// that need not be located exactly is relative to its interval.
constexpr double switch_rounding = 1e-15, switch_near = 1e-12, switch_lag = 2e-12, mark_near = 1e-3, mark_lag = 4e-3;

}  // namespace

bool LawEvents::has_any(const System& system) {
  return std::ranges::any_of(system.laws, [](const SignalLaw& law) { return law.sided != nullptr; });
}

LawEvents::LawEvents(const System& system) : system_(system) {
  for (std::size_t l = 0; l < system.laws.size(); ++l) {
    const SignalLaw& law = system.laws[l];
    if (!law.sided) continue;
    const int n = law.sided->switches();
    laws_.push_back({l, law.first_side, law.first_side + n});
    for (int k = 0; k < n; ++k) exact_.push_back(law.sided->exact(k)), (exact_.back() ? any_exact_ : any_not_) = true;
  }
  sides_.assign(exact_.size(), 0);
  size_.assign(exact_.size(), 0);
  lag_ = size_;
  most_.assign(laws_.size(), 0);
}

std::string LawEvents::name(int) const {
  const int law = static_cast<int>(laws_[at(last_)].law);
  for (std::size_t k = 0; k < system_.forces.size(); ++k)
    if (const auto* force = std::get_if<SizedForce>(&system_.forces[k]); force && (force->size == law || force->other == law))
      return "the law of \"" + system_.force_names[k] + "\"";
  for (const OwnState& state : system_.states)
    if (state.rate == law) return "the rate of the state \"" + state.name + "\"";
  return "a law";
}

std::vector<double> LawEvents::signals_of(const SignalLaw& law, const State& state) const {
  std::vector<double> in;
  for (const int k : law.in) in.push_back(signal_at(system_, system_.signals[at(k)], state.y));
  return in;
}

double LawEvents::value(const Sided& one, const State& state) const {
  const SignalLaw& law = system_.laws[one.law];
  return law.sided->value(state.t, signals_of(law, state).data(), nullptr, sides_.data() + one.first);
}

std::vector<double> LawEvents::past(const State& state) const {
  std::vector<double> out(sides_.size());
  for (const Sided& one : laws_) {
    const SignalLaw& law = system_.laws[one.law];
    law.sided->left(state.t, signals_of(law, state).data(), sides_.data() + one.first, out.data() + one.first);
  }
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = -out[k] / (exact_[k] && size_[k] > 0 ? size_[k] : 1) - lag_[k];
  return out;
}

void LawEvents::see(const State& state) {
  const std::vector<double> now = past(state);
  for (std::size_t k = 0; k < now.size(); ++k) {
    const double left = -(now[k] + lag_[k]), largest = exact_[k] && size_[k] > 0 ? size_[k] : 1;
    if (std::isfinite(left)) size_[k] = std::max(size_[k], std::abs(left) * largest);
    if (left > lag_[k]) lag_[k] = 0;  // away from the end of its side
  }
  for (std::size_t l = 0; l < laws_.size(); ++l)
    if (const double size = std::abs(value(laws_[l], state)); std::isfinite(size)) most_[l] = std::max(most_[l], size);
}

void LawEvents::find_sides(const State& state) {
  const std::vector<double> before = past(state);
  std::vector<int> found = sides_;
  for (const Sided& one : laws_) {
    const SignalLaw& law = system_.laws[one.law];
    law.sided->find(state.t, signals_of(law, state).data(), found.data() + one.first);
  }
  for (std::size_t k = 0; k < sides_.size(); ++k)
    if (lag_[k] == 0 || before[k] > 0) sides_[k] = found[k], lag_[k] = 0;  // a switch that has just switched is at its end
}

std::string LawEvents::remedy() const {
  return "both sides of its jump drive the motion back to it, as friction written with sign(…) does at rest: smooth it, for example with "
         "saturate(v/(1 mm/s), -1, 1), or use friction: coulomb of a joint or contact";
}

WatchedGuard LawEvents::watch(int event) const {
  if (!(event == 0 ? any_exact_ : any_not_)) return {};
  return {.direction = Direction::rising, .zero = switch_near, .at_once = true, .level = true};
}

// The largest of all exact switches, or of all others.
Guard LawEvents::guard(int event, const State& state) const {
  const std::vector<double> now = past(state);
  double most = -1;
  for (std::size_t k = 0; k < now.size(); ++k)
    if (exact_[k] == (event == 0) && !(now[k] <= most)) most = now[k];
  return {most};
}

bool LawEvents::met(int event, const Guard& guard) const { return std::abs(guard.value) <= (event == 0 ? switch_rounding : mark_near); }

// Examines parts of the step, and maxima of switches near the ends of their sides between three points.
std::optional<double> LawEvents::positive_inside(int event, const Step& step, const DenseOutput& motion, double) const {
  constexpr int parts = 8;
  std::array<std::vector<double>, 3> left;
  std::array<double, 3> t{};
  for (int i = 0; i <= parts; ++i) {
    t = {t[1], t[2], step.from.state.t + step.h * (i == 0 ? 1e-9 : static_cast<double>(i) / parts)};
    std::rotate(left.begin(), left.begin() + 1, left.end());
    left[2] = past(motion.at(t[2]));
    std::optional<double> first;
    for (std::size_t k = 0; k < sides_.size(); ++k) {
      if (exact_[k] != (event == 0)) continue;
      if (left[2][k] > 0) first = std::min(first.value_or(t[2]), t[2]);
      if (i < 2 || left[1][k] < left[0][k] || left[1][k] < left[2][k]) continue;
      const auto of_k = [&](double when) { return -past(motion.at(when))[k]; };
      if (const auto inside = below_zero_near(of_k, t, {-left[0][k], -left[1][k], -left[2][k]}))
        first = std::min(first.value_or(*inside), *inside);
    }
    if (first) return i == 0 ? std::nullopt : first;
  }
  return std::nullopt;
}

void LawEvents::start(Step& step) {
  std::ranges::fill(lag_, 0.0);
  find_sides(step.to.state);
  see(step.to.state);
}

std::string LawEvents::follow(Step& step, std::span<const Guard>, std::span<const Guard>, const DenseOutput&) {
  see(step.to.state);
  return {};
}

// All switches at the ends of their sides switch together. If no law jumps, the motion continues unchanged.
EventOutcome LawEvents::act(int event, Step& step, const Guard&) {
  constexpr double same = 1e-9;  // relative to the largest value of the law
  const State& state = step.to.state;
  const std::vector<double> now = past(state);
  const double near = event == 0 ? switch_rounding : mark_near, most = guard(event, state).value;
  EventOutcome out{.change = EventOutcome::Change::nothing};
  for (std::size_t l = 0; l < laws_.size(); ++l) {
    const Sided& one = laws_[l];
    const SignalLaw& law = system_.laws[one.law];
    const double before = value(one, state);
    for (int k = one.first; k < one.end; ++k) {
      if (exact_[at(k)] != (event == 0) || now[at(k)] < std::min(-near, most)) continue;
      sides_[at(k)] = law.sided->beyond(k - one.first, state.t, signals_of(law, state).data(), sides_.data() + one.first);
      lag_[at(k)] = event == 0 ? switch_lag : mark_lag;
      last_ = static_cast<int>(l);
    }
    if (std::abs(value(one, state) - before) > same * most_[l]) out.change = EventOutcome::Change::jump;
  }
  return out;
}

void LawEvents::save(Writer& out) const {
  out.whole(sides_);
  out.whole(size_);
  out.whole(lag_);
  out.whole(most_);
  out.whole(last_);
}
void LawEvents::load(Reader& in) {
  in.whole(sides_);
  in.whole(size_);
  in.whole(lag_);
  in.whole(most_);
  in.whole(last_);
}
const char* LawEvents::fault() const {
  const auto sound = [](const std::vector<double>& of, std::size_t n) {
    return of.size() == n && std::ranges::all_of(of, [](double x) { return std::isfinite(x) && x >= 0; });
  };
  const std::size_t n = exact_.size();
  return sides_.size() == n && sound(size_, n) && sound(lag_, n) && sound(most_, laws_.size()) && last_ >= 0 && at(last_) < laws_.size()
             ? nullptr
             : foreign_modes;
}

}  // namespace pintle
