#include "framework/integration/events/contact_events.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "framework/common/index.h"
#include "framework/common/archive.h"
#include "framework/common/text.h"
#include "framework/dynamics/equations/internal.h"
#include "framework/integration/events/deep_overlap.h"
#include "framework/integration/events/roots.h"
#include "framework/integration/stepper.h"

namespace pintle {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double part_pressed = 1e-9;  // relative to the greatest force of rigid contacts: a smaller force counts as none

// A rigid corner begins to touch only what it faces by a direction between the normals of the faces beside it. Directions beyond them, up to
// the extent of its piece, serve contacts that turn. Negative outside; by the length of the other piece.
Guard faced_by_corners(const System& system, const ContactPair& pair, const State& state) {
  constexpr double rounding = 1e-6;  // [rad]
  const MovingPoint a = moving_point(system, pair.a, state.y), b = moving_point(system, pair.b, state.y);
  const std::array<PlaceOn, 2> place = places(pair.gap, gap_between(pair, a, b), a, b);
  const std::array<const Piece*, 2> pieces{&pair.gap.a, &pair.gap.b};
  Guard out{infinite};
  for (std::size_t i = 0; i < 2; ++i) {
    const Piece &corner = *pieces[i], &other = *pieces[1 - i];
    const double length = other.straight || other.curve ? other.half : std::abs(other.radius), side = place[i].at < 0 ? -1 : 1;
    if (!is_corner(corner) || is_corner(other) || std::isinf(corner.half) || std::isinf(length)) continue;
    const double left = ((1 - side * place[i].at) * corner.half + rounding) * length;
    if (left < out.value) out = {left, -side * place[i].rate * corner.half * length};
  }
  return out;
}

// As onset_of; rigid corners must also face the other piece.
Guard onset_at(const System& system, int contact, const State& state) {
  const ContactPair& pair = system.contacts[at(contact)];
  const Guard out = onset_of(system, contact, state);
  if (!is_rigid(pair) || !pair.profiles || pair.journal || pair.flank || out.value < -fine_length(pair, system.length)) return out;
  const Guard faced = faced_by_corners(system, pair, state);
  return faced.value < out.value ? faced : out;
}

}  // namespace

ContactEvents::ContactEvents(const System& system, const Scheme& scheme)
    : system_(system),
      tolerance_(scheme.tolerance),
      onset_cut_(scheme.onset_cut),
      fixed_step_(scheme.fixed_step),
      log_(system),
      opened_(system.contacts.size(), -infinite) {
  for (int c = 0; c < contacts(); ++c) {
    const ContactPair& pair = system.contacts[at(c)];
    if (pair.profiles && (std::isfinite(pair.gap.a.half) || std::isfinite(pair.gap.b.half))) leaving_.push_back(c);
  }
}

std::string ContactEvents::name(int event) const {
  const int contact = leaving(event) < 0 ? event : leaving(event);
  return "contact \"" + system_.contact_names[at(contact)] + "\"";
}

// Whether its onset would be the continuation of a neighbouring pair's contact.
bool ContactEvents::continues_another(int contact) const {
  const ContactPair& pair = system_.contacts[at(contact)];
  return pair.profiles && std::ranges::any_of(pair.beyond, [&](int other) { return other >= 0 && log_.touching(other); });
}

// An open contact waits for its onset, a closed one for its loss; a massless link for neither.
WatchedGuard ContactEvents::watch(int event) const {
  const int leaves = leaving(event), contact = leaves < 0 ? event : leaves;
  const ContactPair& pair = system_.contacts[at(contact)];
  if (is_held(pair) || time_stepping()) return {};
  const double zero = is_rigid(pair) ? pair.slack : 1e-9 * fine_length(pair, system_.length);
  if (leaves >= 0) return {.direction = log_.touching(contact) ? Direction::falling : Direction::none, .zero = zero, .at_once = true};
  if (log_.touching(contact) && is_rigid(pair)) return {.direction = Direction::falling, .zero = part_pressed, .at_once = true};
  if (log_.touching(contact))
    return {.direction = Direction::falling, .zero = zero, .overshoot = onset_cut_ > 0 ? infinite : 0, .kink = true};
  if (continues_another(contact)) return {};
  return {.direction = Direction::rising, .zero = zero, .overshoot = onset_cut_, .at_once = true};
}

Guard ContactEvents::guard(int event, const State& state) const {
  if (const int contact = leaving(event); contact >= 0) {
    const Margin inside = margin_of(system_, contact, state);
    return {inside.value, inside.rate};
  }
  if (!log_.touching(event)) {
    Guard onset = onset_at(system_, event, state);
    if (opened_[at(event)] == state.t) onset.rate = std::min(onset.rate, -std::numeric_limits<double>::min());  // rounding of zero
    return onset;
  }
  if (is_released(system_, Switch::contact, event, state.y)) return {-1};
  return is_rigid(system_.contacts[at(event)]) ? pressed(event, state) : gap_of(system_, event, state);
}

// Normal force of a closed rigid contact, relative to the largest so far (in N while there was none), plus a small amount; negative once it
// has opened under its forces.
Guard ContactEvents::pressed(int contact, const State& state) const {
  if (!(state.impact_rate[at(contact)] > 0)) return {-1};
  const double load = state.friction[at(contact)].load;
  return {load / (most_pressed_ > 0 ? most_pressed_ : 1) + 2 * part_pressed};
}

Guard ContactEvents::guard(int event, const State& state, const Equations& eq) const {
  if (leaving(event) >= 0 || system_.contacts[at(event)].profiles || is_rigid(system_.contacts[at(event)])) return guard(event, state);
  if (is_released(system_, Switch::contact, event, state.y)) return {-1};
  const Gap& gap = eq.contact[at(event)].gap;
  return {gap.depth, gap.rate};
}

namespace {

// When a guard that is not positive at `begin` becomes positive before `end`, plus a small margin.
template <class F>
std::optional<double> rise(const F& guard, double begin, const Guard& from, double end, const Guard& to) {
  const double fine = 1e-9 * (end - begin);
  if (!(to.value > 0)) {
    if (!(from.rate >= 0 && to.rate < 0)) return std::nullopt;
    const std::optional<double> summit = positive_between(guard, begin, end, from.rate > 0 ? from.rate : -to.rate, to.rate);
    if (!summit) return std::nullopt;
    end = *summit;
  }
  double t = from.value < 0 ? crossing(guard, begin, end, fine) : begin;
  for (double past = fine; !(guard(t).value > 0) && t < end; past *= 4) t = std::min(t + past, end);
  return t;
}

}  // namespace

// A long step may move a body through a wall, or from beside a piece onto it. So parts of the step are examined: an onset is where the
// overlap or the margin becomes positive while the other is. Parts in which the gap is too wide to close are passed over, up to a sixteenth.
std::optional<double> ContactEvents::positive_inside(int event, const Step& step, const DenseOutput& motion, double until) const {
  if (leaving(event) < 0 && log_.touching(event) && is_rigid(system_.contacts[at(event)]) && motion.knows_held_forces()) {
    const auto left = [&](double t) { return pressed(event, motion.at(t)).value; };
    return below_zero_inside(left, step, pressed(event, step.from.state).value, known_inside(tolerance_));
  }
  if (leaving(event) >= 0 || !system_.contacts[at(event)].profiles || log_.touching(event)) return std::nullopt;
  const auto [parts, reach] = to_examine(system_, event, step);
  if (parts == 0) return std::nullopt;
  const auto inside_of = [&](const State& now) {
    const Margin m = margin_of(system_, event, now);
    return Guard{m.value, m.rate};
  };
  const auto depth = [&](double t) { return gap_of(system_, event, motion.at(t)); };
  const auto inside = [&](double t) { return inside_of(motion.at(t)); };
  const auto look = [&](double t) {
    const State& now = motion.at(t);
    return std::pair(gap_of(system_, event, now), inside_of(now));
  };
  double begin = step.from.state.t;
  auto [depth_before, inside_before] = look(begin);
  const double clear = watch(event).zero;
  if (!(depth_before.value < -clear)) begin += 1e-9 * step.h, std::tie(depth_before, inside_before) = look(begin);
  for (double part = 2e-9; part * parts < 1 && depth_before.value > -clear && depth_before.rate < 0; part *= 2)  // it has just parted
    begin = step.from.state.t + part * step.h, std::tie(depth_before, inside_before) = look(begin);
  for (int i = 1; i <= parts && begin < until; ++i) {
    if (reach > 0) i = std::min(parts, i + static_cast<int>(std::clamp(-depth_before.value / reach * parts - 1, 0.0, parts / 16.0)));
    const double end = step.from.state.t + step.h * i / parts;
    const auto [depth_now, inside_now] = look(end);
    std::optional<double> overlaps, enters;
    if (!(depth_before.value > 0)) overlaps = rise(depth, begin, depth_before, end, depth_now);
    if (!(inside_before.value > 0)) enters = rise(inside, begin, inside_before, end, inside_now);
    for (std::optional<double>* t : {&overlaps, &enters})
      if (*t && !(onset_at(system_, event, motion.at(**t)).value > 0)) t->reset();
    if (overlaps || enters) return std::min(overlaps.value_or(end), enters.value_or(end));
    begin = end, depth_before = depth_now, inside_before = inside_now;
  }
  return std::nullopt;
}

// True once the energy that the contact would store at the remaining depth is at most 1e-4 times the tolerance of the impact's energy.
bool ContactEvents::met(int event, const Guard& gap) const {
  const double enough = 1e-15 * system_.length, part = std::sqrt(1e-4 * tolerance_), depth = std::abs(gap.value);
  if (leaving(event) >= 0) return depth <= watch(event).zero;
  if (is_rigid(system_.contacts[at(event)])) return depth <= (log_.touching(event) ? part_pressed : enough);
  return depth <= enough || gap.rate == 0 || speed_to_reach(event, depth) <= part * std::abs(gap.rate);
}

// A contact that overlaps at the start has no approach speed: it gets that of the impact that would reach this depth.
void ContactEvents::start(Step& step) {
  if (time_stepping()) return;
  std::vector<int> rigid;
  for (int c = 0; c < contacts(); ++c) {
    if (is_rigid(system_.contacts[at(c)])) {
      if (touches(c, step.to.state)) rigid.push_back(c);
      continue;
    }
    if (is_held(system_.contacts[at(c)]) || !(onset_of(system_, c, step.to.state).value > 0)) continue;
    const Guard now = gap_of(system_, c, step.to.state);
    begin(c, step, std::max(now.rate, latched_at(system_, system_.contacts[at(c)], now.value)));
  }
  if (!rigid.empty()) strike(rigid, step);
}

// Ends the contacts that have opened under their forces, so that the step may end at their next onset. Also provides the reference force
// for the first step.
void ContactEvents::begin_step(const State& from) {
  for (int c = 0; c < contacts(); ++c) {
    if (!is_rigid(system_.contacts[at(c)]) || !log_.touching(c) || time_stepping()) continue;
    if (from.impact_rate[at(c)] == 0) {
      log_.end(c, from.t, 0);
      opened_[at(c)] = from.t;
    } else {
      most_pressed_ = std::max(most_pressed_, std::abs(from.friction[at(c)].load));
    }
  }
}

// Logs the contacts of time-stepping: a contact lasts as long as each step has an impulse.
void ContactEvents::write_down(Step& step) {
  const State& state = step.to.state;
  for (int c = 0; c < contacts(); ++c) {
    const bool closed = state.impact_rate[at(c)] > 0, before = log_.touching(c);
    if (closed && !before)
      log_.begin(c, step.from.state, gap_of(system_, c, state), step.from.state.t + step.h / 2, state.impact_rate[at(c)]);
    if (closed && step.h > 0)
      log_.strike({.contact = c,
                   .approach = 0,
                   .separation = 0,
                   .impulse = state.friction[at(c)].load * time_of_force(system_, c, step.from.state, step.h, fixed_step_)},
                  state);
    if (!closed && before) log_.end(c, step.from.state.t, -gap_of(system_, c, step.from.state).rate);
  }
}

namespace {

// The largest rate in a step: that at its end, or the maximum rate of the cubic through depths and rates at both ends.
double fastest(const System& system, int contact, const Step& step, const Guard& from, const Guard& to, const DenseOutput& motion) {
  const double a = step.h * from.rate, b = step.h * to.rate, d = to.value - from.value;
  const double c3 = a + b - 2 * d, summit = (2 * a + b - 3 * d) / (3 * c3);  // of d0 + a x + c2 x² + c3 x³
  if (!(c3 < 0 && summit > 0 && summit < 1)) return to.rate;
  return std::max(to.rate, gap_of(system, contact, motion.at(step.from.state.t + summit * step.h)).rate);
}

}  // namespace

std::string ContactEvents::follow(Step& step, std::span<const Guard> from, std::span<const Guard> to, const DenseOutput& motion) {
  if (time_stepping()) write_down(step);
  log_.follow(step, from, to, motion);
  for (int c = 0; c < contacts(); ++c) {
    if (is_rigid(system_.contacts[at(c)]) && log_.touching(c) && !time_stepping())
      most_pressed_ = std::max(most_pressed_, std::abs(step.to.state.friction[at(c)].load));
    if (double& latched = step.to.state.impact_rate[at(c)]; system_.contacts[at(c)].follows && latched > 0 && to[at(c)].value > 0)
      latched = std::max(latched, fastest(system_, c, step, from[at(c)], to[at(c)], motion));
  }
  return deep_overlap(system_, step, from, to, fixed_step_);
}

EventOutcome ContactEvents::act(int event, Step& step, const Guard& gap) {
  if (const int contact = leaving(event); contact >= 0) return leave(contact, step);
  const bool onset = !log_.touching(event);
  const ContactPair& pair = system_.contacts[at(event)];
  if (is_rigid(pair)) return onset ? strike({event}, step) : part(event, step);
  const Guard now = gap_of(system_, event, step.to.state);
  const bool inside = onset && pair.profiles && now.value > watch(event).zero;  // it enters from the side
  if (inside && now.value > deepest_valid * contact_size(pair, system_.length))
    return {.failure = name(event) + ": the bodies meet from behind a surface or round the end of its path, at a depth of " +
                       number_text(now.value, 3) +
                       " m, and a force of this depth would begin at once; close the path (closed: true), "
                       "lengthen it, or keep the bodies in front of it"};
  if (onset)
    begin(event, step, inside ? std::max(now.rate, latched_at(system_, pair, now.value)) : now.rate);
  else
    end(event, step);
  const bool straightens = !onset && has_bristles(pair);
  return {.change = inside || straightens || begins_with_jump(pair.normal) ? EventOutcome::Change::jump : EventOutcome::Change::forces,
          .first_step = onset ? onset_step(event, gap.rate, step.to.state.t) : infinite,
          .of_every_method = pair.profiles};  // otherwise a long implicit step would skip it
}

// Whether a gap is so small that it closes at this instant. Where two corners pass each other, the faces beside them meet, not the corners,
// between which there is no normal. A corner that reaches the end of a face and moves on beyond it closes no gap either.
bool ContactEvents::touches(int contact, const State& state) const {
  const ContactPair& pair = system_.contacts[at(contact)];
  if (log_.touching(contact) || continues_another(contact) || (is_corner(pair.gap.a) && is_corner(pair.gap.b))) return false;
  const double near = std::max(1e-9 * fine_length(pair, system_.length), pair.slack);
  if (!(onset_at(system_, contact, state).value > -near - pair.slack)) return false;
  const Margin inside = pair.profiles ? margin_of(system_, contact, state) : Margin{infinite, 0, -1};
  return inside.value > near || !(inside.rate < 0);
}

// All contacts that touch at the same instant are treated in one impact.
EventOutcome ContactEvents::strike(std::vector<int> touching, Step& step) {
  if (!eq_) eq_ = std::make_unique<Equations>(system_);
  State& state = step.to.state;
  for (int c = 0; c < contacts(); ++c)
    if (is_rigid(system_.contacts[at(c)]) && std::ranges::find(touching, c) == touching.end() && touches(c, state)) touching.push_back(c);
  State after = state;
  const std::optional<std::vector<Blow>> blows = pintle::strike(system_, touching, after, *eq_);
  if (!blows) return {.failure = name(touching.front()) + ": no impulses can stop the bodies that meet here; " + pressed_together};
  for (const Blow& blow : *blows)
    if (!log_.touching(blow.contact) && (blow.impulse > 0 || blow.separation == 0))
      log_.begin(blow.contact, state, gap_of(system_, blow.contact, state), state.t, std::max(0.0, blow.approach));
  state = std::move(after);
  for (const Blow& blow : *blows)
    if (log_.touching(blow.contact)) log_.strike(blow, state);
  return {.change = EventOutcome::Change::jump};
}

// Its forces are determined again; the contact ends once it has opened under them.
EventOutcome ContactEvents::part(int contact, Step& step) {
  State& state = step.to.state;
  if (state.impact_rate[at(contact)] > 0) {
    state.friction[at(contact)].direction = DryFriction::undecided;
    return {.change = EventOutcome::Change::jump};
  }
  log_.end(contact, state.t, 0);
  return {};
}

namespace {

// The pair beyond the end. If the contact would leave that pair immediately, as where an arc meets the end of a line, the pair beyond
// another end that it enters there.
int next(const System& system, const ImpactLog& log, int contact, const State& state) {
  const ContactPair& pair = system.contacts[at(contact)];
  const int side = margin_of(system, contact, state).side, to = side < 0 ? -1 : pair.beyond[at(side)];
  if (to < 0 || !(margin_of(system, to, state).rate < 0)) return to;
  const double near = 1e-6 * fine_length(pair, system.length), depth = gap_of(system, contact, state).value;
  for (const int other : pair.beyond) {
    if (other < 0 || other == to || log.touching(other)) continue;
    const Margin entered = margin_of(system, other, state);
    if (entered.rate > 0 && std::abs(entered.value) <= near && std::abs(gap_of(system, other, state).value - depth) <= near) return other;
  }
  return to;
}

}  // namespace

EventOutcome ContactEvents::leave(int contact, Step& step) {
  const int to = next(system_, log_, contact, step.to.state);
  if (to < 0 || log_.touching(to)) {  // its stored energy is lost
    const ContactPair& pair = system_.contacts[at(contact)];
    State& state = step.to.state;
    const Guard now = gap_of(system_, contact, state);
    const Approach approach = approach_of(pair, now.value, now.rate, state.impact_rate[at(contact)]);
    state.y[system_.z_begin() + system_.contact_z[at(contact)]] += evaluate(pair.normal, approach).stored;
    end(contact, step);
    return {.change = EventOutcome::Change::jump};
  }
  std::swap(step.to.state.impact_rate[at(contact)], step.to.state.impact_rate[at(to)]);
  if (auto& friction = step.to.state.friction; !friction.empty()) std::swap(friction[at(contact)], friction[at(to)]);
  exchange_bristles(system_, contact, to, step.to.state);
  log_.pass(contact, to);
  return {.change = has_bristles(system_.contacts[at(contact)]) ? EventOutcome::Change::jump : EventOutcome::Change::forces};
}

void ContactEvents::begin(int contact, Step& step, double rate) {
  State& state = step.to.state;
  const double latched = std::max(rate, system_.contacts[at(contact)].slowest_impact);
  state.impact_rate[at(contact)] = latched;
  if (!state.friction.empty()) state.friction[at(contact)] = {};
  const Guard now = gap_of(system_, contact, state);
  log_.begin(contact, state, now, moment(step, now), latched);
}

void ContactEvents::end(int contact, Step& step) {
  State& state = step.to.state;
  const Guard now = gap_of(system_, contact, state);
  log_.end(contact, moment(step, now), -now.rate);
  opened_[at(contact)] = state.t;
  state.impact_rate[at(contact)] = 0;
  straighten_bristles(system_, contact, state);
}

// The time at which the depth is zero, to first order, if that is within a step length of the step's end.
double ContactEvents::moment(const Step& step, const Guard& gap) const {
  const double t = step.to.state.t;
  return !(onset_cut_ > 0) && std::abs(gap.value) < std::abs(gap.rate) * step.h ? t - gap.value / gap.rate : t;
}

double ContactEvents::speed_to_reach(int contact, double depth) const {
  const ContactPair& pair = system_.contacts[at(contact)];
  return pintle::speed_to_reach(pair.normal, lightness(system_, pair), depth);
}

// The first explicit step of an impact [s]. Its force starts as k (1 + χ)(vt)ⁿ, which has no expansion in integer powers, so no embedded
// error estimate shows the whole error. In the step h the force changes the speed v by (1 + χ) ½ v (hv/δ)ⁿ⁺¹, where δ is the depth that v
// can reach; a pair makes an error of about a thousandth of this, which is set equal to the tolerance.
double ContactEvents::onset_step(int contact, double v, double t) const {
  constexpr double missed = 1e-3, clock = 1e-14;
  if (!(v > 0)) return infinite;
  const ContactPair& pair = system_.contacts[at(contact)];
  const double part = part_of_depth(pair.normal, tolerance_, missed);
  return std::max(part * depth_reached(pair.normal, lightness(system_, pair), v) / v, clock * std::abs(t));
}

void ContactEvents::save(Writer& out) const { out.whole(log_), out.whole(most_pressed_); }
void ContactEvents::load(Reader& in) { in.whole(log_), in.whole(most_pressed_); }

}  // namespace pintle
