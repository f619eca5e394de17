#include "framework/integration/events/contact_events.h"

#include <algorithm>
#include <cmath>

#include "framework/common/index.h"
#include "framework/common/archive.h"

namespace pintle {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
}  // namespace

ContactEvents::ContactEvents(const System& system, const Scheme& scheme)
    : system_(system), tolerance_(scheme.tolerance), onset_cut_(scheme.onset_cut), log_(system) {}

std::string ContactEvents::name(int contact) const { return "contact \"" + system_.contact_names[at(contact)] + "\""; }

// A contact that is open waits for its onset, a closed one for its loss; a massless link for neither.
WatchedGuard ContactEvents::watch(int contact) const {
  const ContactPair& pair = system_.contacts[at(contact)];
  if (is_held(pair)) return {};
  const double zero = 1e-9 * pair.gap.clearance();
  if (log_.touching(contact))
    return {.direction = Direction::falling, .zero = zero, .overshoot = onset_cut_ > 0 ? infinite : 0, .kink = true};
  return {.direction = Direction::rising, .zero = zero, .overshoot = onset_cut_, .at_once = true};
}

Guard ContactEvents::guard(int contact, const State&, const Equations& eq) const {
  const Gap& gap = eq.contact[at(contact)].gap;
  return {gap.depth, gap.rate};
}

// Until what the contact stores at the depth that is left is, of the impact's energy, a ten-thousandth of the tolerance.
bool ContactEvents::met(int contact, const Guard& gap) const {
  const double enough = 1e-15 * system_.length, part = std::sqrt(1e-4 * tolerance_), depth = std::abs(gap.value);
  return depth <= enough || gap.rate == 0 || speed_to_reach(contact, depth) <= part * std::abs(gap.rate);
}

// A start inside the wall has no approach speed. It gets that of the impact which would have come this deep.
void ContactEvents::start(Step& step) {
  for (int c = 0; c < size(); ++c) {
    if (is_held(system_.contacts[at(c)])) continue;
    const Guard now = guard(c, step.to.state);
    if (now.value > 0) begin(c, step, std::max(now.rate, speed_to_reach(c, now.value)));
  }
}

void ContactEvents::follow(const Step& step, std::span<const Guard> from, std::span<const Guard> to, const DenseOutput& motion) {
  log_.follow(step, from, to, motion);
}

EventOutcome ContactEvents::act(int contact, Step& step, const Guard& gap) {
  const bool onset = !log_.touching(contact);
  if (onset)
    begin(contact, step, guard(contact, step.to.state).rate);
  else
    end(contact, step);
  return {.change = begins_with_jump(system_.contacts[at(contact)].normal) ? EventOutcome::Change::jump : EventOutcome::Change::forces,
          .first_step = onset ? onset_step(contact, gap.rate, step.to.state.t) : infinite};
}

void ContactEvents::begin(int contact, Step& step, double rate) {
  State& state = step.to.state;
  const double latched = std::max(rate, system_.contacts[at(contact)].slowest_impact);
  state.impact_rate[at(contact)] = latched;
  const Guard now = guard(contact, state);
  log_.begin(contact, step, now, moment(step, now), latched);
}

void ContactEvents::end(int contact, Step& step) {
  State& state = step.to.state;
  const Guard now = guard(contact, state);
  log_.end(contact, moment(step, now), -now.rate);
  state.impact_rate[at(contact)] = 0;
}

// When the depth was zero, to first order, if that was in the step, or would be as soon after its end.
double ContactEvents::moment(const Step& step, const Guard& gap) const {
  const double t = step.to.state.t;
  return !(onset_cut_ > 0) && std::abs(gap.value) < std::abs(gap.rate) * step.h ? t - gap.value / gap.rate : t;
}

double ContactEvents::speed_to_reach(int contact, double depth) const {
  const ContactPair& pair = system_.contacts[at(contact)];
  return pintle::speed_to_reach(pair.normal, lightness(system_, pair), depth);
}

// The first explicit step of an impact. Its force begins as (1 + χ)(vt)ⁿ, which no series of whole powers follows and no embedded
// error sees in full: of the (1 + χ) ½ v (hv/δ)ⁿ⁺¹ by which it changes the speed v in the step h, δ the depth that v can reach, a
// pair misses some thousandth, and that is to be the tolerance [s].
double ContactEvents::onset_step(int contact, double v, double t) const {
  constexpr double missed = 1e-3, clock = 1e-14;
  if (!(v > 0)) return infinite;
  const ContactPair& pair = system_.contacts[at(contact)];
  const double part = part_of_depth(pair.normal, tolerance_, missed);
  return std::max(part * depth_reached(pair.normal, lightness(system_, pair), v) / v, clock * std::abs(t));
}

void ContactEvents::save(Writer& out) const { out.whole(log_); }
void ContactEvents::load(Reader& in) { in.whole(log_); }

}  // namespace pintle
