#include "framework/integration/integrator.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "framework/common/index.h"
#include "framework/common/text.h"
#include "framework/common/worse.h"
#include "framework/integration/events/friction_events.h"
#include "framework/integration/law_changes.h"
#include "framework/integration/trial.h"

namespace pintle {

using Index = Eigen::Index;

namespace {

constexpr std::string_view implicit_method = "generalized-alpha";
constexpr double least_step = 4e-16;  // relative to the time: shorter steps are lost in its last digits

// Sets a time equal to an end that is so near that no step fits in between.
void end_together(double& t, std::initializer_list<double> ends) {
  for (const double end : ends)
    if (std::isfinite(end) && std::abs(end - t) <= least_step * std::abs(end)) t = end;
}

Events events_of(const System& system, const Scheme& scheme, ContactEvents*& contacts, LawEvents*& laws) {
  std::vector<std::unique_ptr<EventGroup>> groups;
  auto of_contacts = std::make_unique<ContactEvents>(system, scheme);
  contacts = of_contacts.get();
  groups.push_back(std::move(of_contacts));
  if (dry_states(system) > 0 && scheme.fixed_step == 0) groups.push_back(std::make_unique<FrictionEvents>(system, scheme));
  for (const auto& make : scheme.events) groups.push_back(make(system));
  laws = nullptr;
  if (LawEvents::has_any(system) && scheme.fixed_step == 0) {
    auto of_laws = std::make_unique<LawEvents>(system);
    laws = of_laws.get();
    groups.push_back(std::move(of_laws));
  }
  return Events(std::move(groups));
}

}  // namespace

Integrator::Integrator(const System& system, const Scheme& scheme, State start)
    : system_(system),
      scheme_(scheme),
      eq_(system),
      stepper_(make_stepper(name(scheme), system, scheme, eq_)),
      norm_(system, scheme.tolerance),
      control_(scheme.max_step),
      events_(events_of(system, scheme, contacts_, laws_)),
      turn_ahead_(system) {
  if (start.y.size() != system.n_y())  // from another model, with different integrals
    throw std::invalid_argument("a start of " + std::to_string(start.y.size()) + " numbers for a system of " +
                                std::to_string(system.n_y()));
  start.impact_rate.resize(system.contacts.size(), 0.0);
  start.friction.resize(dry_states(system));
  step_.to.state = std::move(start);
  step_.to.dy.setZero(system.n_y());
  step_.error.setZero(system.n_y());
  step_.dy_before.setZero(system.n_y());
  step_.y_before.setZero(system.n_y());
  step_.from = step_.to;
  dense_.state = step_.to.state;
  if (!stepper_->project(step_.to, eq_)) {
    stop("the start is a singular configuration or does not satisfy the constraints");
    return;
  }
  events_.start(step_);
  hold_laws();
  stepper_->project(step_.to, eq_);
  step_.from = step_.to;
}

bool Integrator::advance(double until) {
  row_ = save_ = false;
  if (!may_step(until) || !begin_step(until)) return false;
  const double t0 = step_.from.state.t, wish = control_.wish(), law = law_end(scheme_, t0, sees_ends_alone());
  const double ahead = std::min({kink_ahead(wish), law - t0, turn_ahead_.time(system_, step_.from.state)});
  if (!step_to(std::min(until - t0, ahead))) return false;
  if (step_.h == ahead) control_.wish_for(std::max(control_.wish(), wish));  // shortened by a kink or a law, not by the error
  end_together(step_.to.state.t, {law, until});

  std::optional<EventInStep> event;
  if (!events_.empty() && !end_at_first_event(event)) return false;
  end_together(step_.to.state.t, {law, until});
  ++counts_.steps;
  if (const std::string impossible = events_.follow(step_, motion()); !impossible.empty()) return stop(impossible, step_.to.state.t);
  if (!events_.count(step_, event, motion(), wish)) return stop(events_.again_and_again(), step_.to.state.t);
  if (event && !act_on(*event, wish)) return false;
  stepper_->accept(eq_);
  look_at_end();
  return event || switch_method();
}

bool Integrator::act_at_end() {
  row_ = save_ = false;
  if (!failure_.empty() || !ended_.empty()) return false;
  const std::optional<EventInStep> event = events_.due(step_.to.state);
  if (!event) return false;
  step_.from = step_.to;
  step_.h = 0, step_.ends_at_event = false;
  if (!events_.count(step_, event, motion(), control_.wish())) return stop(events_.again_and_again(), step_.to.state.t);
  if (!act_on(*event, control_.wish())) return false;
  stepper_->accept(eq_);
  look_at_end();
  return true;
}

double Integrator::kink_ahead(double wish) const {
  return stepper_->traits().follows_impacts ? events_.kink_ahead(wish) : std::numeric_limits<double>::infinity();
}

// The last step's end becomes the start of a new step; the length of the first step is chosen here.
bool Integrator::begin_step(double until) {
  std::swap(step_.from, step_.to);
  step_.ends_at_event = false;
  if (!go_back()) return false;
  if (!pass_law_change()) return false;
  step_.to.state.t = step_.from.state.t;
  if (control_.wish() == 0) control_.wish_for(first_wish(until - step_.from.state.t));
  events_.begin_step(step_.from.state);
  return true;
}

// A step that begins at a change of a law begins after the change.
bool Integrator::pass_law_change() {
  const LawChange* change = change_at(scheme_, step_.from.state.t);
  if (!change) return true;
  step_.from.state.t = change->after;
  if (!change->jumps) return true;
  control_.wish_for(0);
  control_.forget_errors();
  return stepper_->project(step_.from, eq_) || stop("singular configuration where a law of time jumps");
}

// A hundredth of the time scale of the motion.
double Integrator::first_wish(double left) const {
  if (const double fixed = stepper_->traits().fixed_step; fixed > 0) return control_.bounded(fixed);
  const Index n = system_.n();
  const double speed = step_.from.state.y.segment(n, n).norm(), accel = step_.from.dy.segment(n, n).norm();
  const double h = std::min(left, accel > 0 ? 0.01 * std::max(speed / accel, 1e-3 * std::sqrt(norm_.length() / accel)) : left);
  return control_.bounded(std::min(h, stepper_->first_step(step_.from, norm_, left)));
}

// One accepted error-controlled step of at most the desired length, never past `left`.
bool Integrator::step_to(double left) {
  const StepperTraits traits = stepper_->traits();
  for (int tries = 0; tries < 60; ++tries) {
    const StepControl::Try now = control_.next(left);
    const double h = now.h;
    if (h < least_step * std::max(std::abs(step_.from.state.t), left)) {
      stop("the step became too small (" + number_text(h, 6) + " s) for the tolerance" + trouble());
      break;
    }
    const bool done = stepper_->attempt(h, norm_, step_, eq_);
    if (switching_.falls_back(*stepper_, scheme_, step_.from.state.t)) {
      stepper_ = make_stepper(scheme_.fallback->name, system_, scheme_, eq_);
    } else if (!done && traits.fixed_step > 0) {
      stop(stepper_->trouble());
      break;
    } else if (!done) {
      control_.failed(h, least_part());
    } else if (!now.last && !near_singular_ && tries < 3 && (stepper_->near_singular(eq_) || stepper_->strayed_near_singular(step_, eq_))) {
      control_.wish_for(0.8 * h);  // steps over configurations where no step should start
    } else if (const double error = worse(1e-10, norm_.of(step_, traits.follows_impacts)); !(error <= 1)) {
      control_.rejected(h, error, traits.order, least_part());
    } else {
      control_.accepted(now, error, traits);
      return true;
    }
    ++counts_.rejected;
  }
  if (failure_.empty())
    stop(eq_.regular ? "no step is small enough for the tolerance" + trouble()
                     : "singular configuration: the constraint equations have become linearly dependent");
  step_.to = step_.from;
  return false;
}

// Forces that hold bodies at rest are not part of the error estimate, so at rest only laws limit the steps.
bool Integrator::sees_ends_alone() const {
  const StepperTraits& traits = stepper_->traits();
  return traits.implicit || (traits.fixed_step == 0 && holds_anything(system_, step_.from.state));
}

// Not for implicit steps: these are short, and stiff forces are in balance only at their ends.
void Integrator::look_inside() {
  held_.forget();
  const StepperTraits& traits = stepper_->traits();
  if (traits.implicit || traits.fixed_step > 0 || !holds_anything(system_, step_.from.state)) return;
  held_.look(system_, *stepper_, step_, dense_.state);
}

// If dense output of a long step shows an event that true steps do not find, or find after another one, or if a step goes too far past
// one, a shorter step is tried.
bool Integrator::end_at_first_event(std::optional<EventInStep>& event) {
  for (int halvings = 0;; ++halvings) {
    look_inside();
    event = events_.first(step_, motion(), evaluated_at_end());
    held_.forget();
    if (!event) return true;
    const Events::Ending ending = events_.end_at(*event, *stepper_, norm_, step_, eq_);
    const int most = event->watch.overshoot > 0 ? 200 : 40;
    if (ending == Events::Ending::there && (halvings > most || !events_.passes_another(step_))) {
      events_.look_at_end(step_, evaluated_at_end());
      return true;
    }
    if (ending == Events::Ending::impossible || (halvings > most && !eq_.regular))
      stop("singular configuration while locating an event of " + events_.name(*event));
    else if (halvings > most)
      stop("an event of " + events_.name(*event) + " cannot be located; tighten run.tolerance");
    if (!failure_.empty()) {
      step_.to = step_.from;
      return false;
    }
    control_.wish_for(step_.h / 2);
    if (!step_to(control_.wish())) return false;
  }
}

// After an event the motion continues from the present state, with the step length that was used when it was last in the same mode.
bool Integrator::act_on(const EventInStep& event, double wish) {
  ++counts_.events;
  step_.y_before = step_.to.state.y;
  const EventOutcome outcome = events_.act(event, step_, wish);
  // The state that a failed event leaves is invalid: the last row shows the state before it.
  const auto undo = [&] { step_.to.state.y = step_.y_before; };
  if (!outcome.did.empty()) happenings_.push_back({step_.to.state.t, events_.name(event), outcome.did});
  if (!outcome.failure.empty()) {
    undo();
    return stop(outcome.failure, step_.to.state.t);
  }
  row_ = outcome.row, save_ = outcome.save;
  ended_ = outcome.end;
  if (laws_ && outcome.change >= EventOutcome::Change::jump) laws_->find_sides(step_.to.state);
  hold_laws();
  if (outcome.change == EventOutcome::Change::nothing && step_.h > 0) {
    control_.wish_for(std::max(control_.wish(), wish));
    return true;
  }
  const double remembered = events_.remembered_wish(event);
  control_.wish_for(remembered > 0 ? control_.bounded(remembered) : wish);
  if (outcome.of_every_method || stepper_->traits().follows_impacts) control_.wish_for(std::min(control_.wish(), outcome.first_step));
  control_.forget_errors();
  step_.ends_at_event = true;
  step_.dy_before = step_.to.dy;
  if (outcome.change == EventOutcome::Change::rows) eq_.permanent = 0;
  if (stepper_->project(step_.to, eq_)) return true;
  undo();
  return stop("singular configuration at an event of " + events_.name(event));
}

bool Integrator::change(const std::function<void(State&)>& act) {
  if (!failure_.empty() || !ended_.empty()) return false;
  step_.y_before = step_.to.state.y;
  act(step_.to.state);
  if (laws_) laws_->find_sides(step_.to.state);
  hold_laws();
  control_.forget_errors();
  events_.forget_end();
  step_.ends_at_event = true;
  step_.dy_before = step_.to.dy;
  if (!stepper_->project(step_.to, eq_)) return stop("singular configuration where its state was changed", step_.to.state.t);
  look_at_end();
  return true;
}

void Integrator::hold_laws() {
  if (laws_) eq_.law_sides = laws_->sides();
}

void Integrator::look_at_end() {
  const auto& y = step_.to.state.y;
  near_singular_ = stepper_->near_singular(eq_);
  norm_.see(y);
  worst_position_ = worse(worst_position_, position_violation(system_, eq_));
  worst_velocity_ = worse(worst_velocity_, velocity_violation(system_, y, eq_));
}

long Integrator::cost() const { return cost_of(eq_, implicit()); }

// Called after a step that did not end at an event.
bool Integrator::switch_method() {
  events_.keep_end();
  if (!switching_.held_by_stability(*stepper_, scheme_, step_, cost())) return true;
  constexpr double enough = 2;  // times cheaper; what an explicit pair would do more accurately
  const auto ahead = [&](const State& at) {
    return change_at(scheme_, at.t) || events_.comes_by(at) ? 0
                                                            : std::min(law_end(scheme_, at.t, true) - at.t, turn_ahead_.time(system_, at));
  };
  const double pace =
      trial_pace(implicit_method, system_, scheme_, norm_, eq_, step_.to, step_.h, ahead, std::clamp(counts_.steps / 16, 50L, 500L));
  if (pace < enough * switching_.pace()) return true;
  switching_.go_implicit(*stepper_, step_, pace / switching_.pace(), cost_of(eq_, true));
  return take(implicit_method, step_.to);
}

// Called before a step, when the last one has been sampled.
bool Integrator::go_back() {
  if (!switching_.goes_back(*stepper_, step_.from.state.t, cost())) return true;
  step_.from.memory = step_.to.memory = {};
  control_.wish_for(switching_.step_of_pair());
  return take(switching_.pair(), step_.from);
}

bool Integrator::take(std::string_view method, Instant& node) {
  stepper_ = make_stepper(method, system_, scheme_, eq_);
  control_.forget_errors();
  events_.forget_wishes();
  events_.forget_end();
  return stepper_->project(node, eq_) || stop("singular configuration");
}

bool Integrator::may_step(double until) {
  if (!failure_.empty() || !ended_.empty()) return false;
  const long allowed = scheme_.max_steps;
  const double t = step_.to.state.t;
  if (counts_.steps == allowed - allowed / 10) last_tenth_ = t;
  if (counts_.steps < allowed) return true;
  const double passed = t - last_tenth_, more = std::ceil((until - t) / passed) / 10;
  step_.from = step_.to;
  return stop("max steps reached (" + std::to_string(allowed) + ")" +
              (counts_.steps >= 10 && passed > 0 ? ", the last tenth in " + number_text(passed, 6) +
                                                       " s; at this rate the rest takes about " + number_text(more, 6) + " times as many"
                                                 : "") +
              ": raise run.max steps, loosen run.tolerance, or reduce the stiffness or add damping where the motion is so fast");
}

bool Integrator::sample(double t, State& out) {
  if (!sampled_) sampled_ = std::make_unique<Equations>(system_);
  sampled_->permanent = eq_.permanent;
  if (t > step_.from.state.t || t >= step_.to.state.t) return stepper_->sample(step_, t, *sampled_, out);
  Step begin = step_;  // t is in the few roundings of time between the two sides of a change of a law
  begin.to = begin.from;
  begin.to.state.t = t;
  begin.h = 0, begin.ends_at_event = false;
  return stepper_->sample(begin, t, *sampled_, out);
}

Counts Integrator::counts() const {
  Counts c = counts_;
  c.evaluations = eq_.evaluations;
  c.factorizations = eq_.factorizations;
  c.partitions = stepper_->partitions();
  return c;
}

// A shorter step would end nearer to the singular configuration that a stage met: it is shortened only a little.
double Integrator::least_part() const { return stepper_->strayed_near_singular(step_, eq_) ? 0.7 : 0.2; }

std::string Integrator::trouble() const { return stepper_->trouble().empty() ? "" : ": " + stepper_->trouble(); }

bool Integrator::stop(const std::string& reason) { return stop(reason, step_.from.state.t); }
bool Integrator::stop(const std::string& reason, double t) {
  failure_ = "t = " + number_text(t, 6) + " s: " + reason;
  return false;
}

}  // namespace pintle
