#include "framework/integration/events/friction_events.h"

#include <algorithm>
#include <cmath>

#include "framework/common/index.h"
#include "framework/dynamics/equations/sticking.h"
#include "framework/integration/events/impact_log.h"
#include "framework/integration/stepper.h"

namespace pintle {

namespace {

double slip_limit(const System& system, std::size_t c, const ContactEffect& now) {
  return dry_friction(system.contacts[c])->mu_static * now.normal.force;
}

}  // namespace

FrictionEvents::FrictionEvents(const System& system, const Scheme& scheme)
    : system_(system), tolerance_(scheme.tolerance), still_(1e-9 * system.length) {
  for (std::size_t c = 0; c < system.contacts.size(); ++c)
    if (dry_friction(system.contacts[c])) dry_.push_back(c);
}

std::string FrictionEvents::name(int event) const {
  return (of_sliding(event) ? "slip at contact \"" : "sticking at contact \"") + system_.contact_names[contact(event)] + "\"";
}

// Whether a contact slides or sticks is its state's, so guards of what it is not doing stay off zero.
WatchedGuard FrictionEvents::watch(int event) const {
  constexpr double known = 1e-6;  // of the force that holds, at worst
  if (of_sliding(event)) return {.direction = Direction::falling, .zero = still_, .at_once = true};
  return {.direction = Direction::rising, .zero = known, .at_once = true};
}

Guard FrictionEvents::guard(int event, const State& state) const {
  if (state.impact_rate[contact(event)] <= 0) return {of_sliding(event) ? 1.0 : -1.0};
  return guard(event, state, pressing(system_, static_cast<int>(contact(event)), state));
}

Guard FrictionEvents::guard(int event, const State& state, const Equations& eq) const {
  if (state.impact_rate[contact(event)] <= 0) return {of_sliding(event) ? 1.0 : -1.0};
  return guard(event, state, eq.contact[contact(event)]);
}

// Sliding ends a little past 0, so that it can begin at 0. What holds is measured by what can be held.
Guard FrictionEvents::guard(int event, const State& state, const ContactEffect& now) const {
  const DryFriction& dry = state.friction[contact(event)];
  const bool undecided = dry.direction == DryFriction::undecided;
  if (of_sliding(event)) return {undecided || dry.direction == 0 ? 1.0 : dry.direction * now.gap.material_slip + 2 * still_};
  if (undecided || dry.direction != 0) return {undecided ? 1.0 : -1.0};
  const double force = std::abs(dry.force), limit = slip_limit(system_, contact(event), now);
  return {force <= limit ? (limit > 0 ? force / limit : 0) - 1 : std::min(force / std::max(limit, 1e-300), 1e300) - 1};
}

// A slip that comes to 0 and back in one step.
std::optional<double> FrictionEvents::positive_inside(int event, const Step& step, const DenseOutput& motion) const {
  constexpr int parts = 8;
  const DryFriction& dry = step.from.state.friction[contact(event)];
  if (!of_sliding(event) || dry.direction == 0 || dry.direction == DryFriction::undecided) return std::nullopt;
  if (step.from.state.impact_rate[contact(event)] <= 0) return std::nullopt;
  for (int i = 1; i < parts; ++i)
    if (const double t = step.from.state.t + step.h * i / parts; guard(event, motion.at(t)).value < 0) return t;
  return std::nullopt;
}

bool FrictionEvents::met(int event, const Guard& now) const {
  constexpr double part = 1e-2, rounding = 1e-13;
  return std::abs(now.value) <= (of_sliding(event) ? still_ / 2 : std::max(part * tolerance_, rounding));
}

void FrictionEvents::start(Step& step) { decide(step.to.state, {}); }

EventOutcome FrictionEvents::act(int event, Step& step, const Guard&) {
  const std::size_t c = contact(event);
  const bool breaks_away = !of_sliding(event) && step.to.state.friction[c].direction == 0;
  decide(step.to.state, breaks_away ? std::optional(c) : std::nullopt);
  return {.change = EventOutcome::Change::jump};
}

// All that are at rest stick, to begin with. Then, of those that cannot hold, the one that is asked for most slides, against the
// force that would have held it, until all can.
void FrictionEvents::decide(State& state, std::optional<std::size_t> slips) {
  constexpr double little = 1e-9;
  std::vector<std::size_t> still;
  for (const std::size_t c : dry_) {
    DryFriction& dry = state.friction[c];
    if (state.impact_rate[c] <= 0) continue;
    const double slip = pressing(system_, static_cast<int>(c), state).gap.material_slip;
    const bool at_rest = dry.direction == 0 || std::abs(slip) <= 4 * still_;
    if (c == slips && std::abs(slip) <= 4 * still_) {
      dry = {-std::copysign(1.0, dry.force), 0};
    } else if (c == slips || !at_rest) {
      dry = {std::copysign(1.0, slip), 0};
    } else {
      still.push_back(c);
      dry = {0, 0};
    }
  }
  if (still.empty()) return;
  if (!eq_) eq_ = std::make_unique<Equations>(system_);
  Eigen::VectorXd dy(system_.n_y());
  for (std::size_t tries = 0; tries < 4 * still.size() + 4; ++tries) {
    if (!evaluate(system_, state, *eq_, dy)) return;
    std::optional<std::size_t> worst;
    double most = 1 + little;
    for (const std::size_t c : still) {
      if (state.friction[c].direction != 0) continue;
      const double force = std::abs(eq_->contact[c].friction), limit = holds_at_most(system_, *eq_, c);
      const double share = force == 0 ? 0 : force / std::max(limit, 1e-300);
      if (share > most) worst = c, most = share;
    }
    if (!worst) break;
    state.friction[*worst] = {-std::copysign(1.0, eq_->contact[*worst].friction), 0};
  }
  keep_holding_forces(*eq_, state);
}

}  // namespace pintle
