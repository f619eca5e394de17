#include "framework/analysis/simulate/simulation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <utility>

#include "framework/analysis/simulate/end_short.h"
#include "framework/analysis/simulate/energy_balance.h"
#include "framework/analysis/simulate/explain_failure.h"
#include "framework/analysis/simulate/run_warnings.h"
#include "framework/common/worse.h"
#include "framework/configuration/unsound_laws.h"
#include "framework/dynamics/model/signal_values.h"
#include "framework/scene/error.h"

namespace pintle {

Clock::Clock(double interval, double until, std::vector<double> also) : interval_(interval), until_(until), also_(std::move(also)) {
  if (interval > 0) last_ = static_cast<long>(std::ceil(until / interval - 1e-9));
  const auto on_interval = [&](double t) { return std::abs(t / interval - std::round(t / interval)) < 1e-7; };
  std::erase_if(also_, [&](double t) { return last_ < 0 || !(t > 0 && t < until) || on_interval(t); });
  std::ranges::sort(also_, std::greater());
  also_.erase(std::unique(also_.begin(), also_.end()), also_.end());
}

double Clock::next() const {
  const double regular = k_ > last_ ? std::numeric_limits<double>::infinity() : k_ == last_ ? until_ : static_cast<double>(k_) * interval_;
  return also_.empty() ? regular : std::min(regular, also_.back());
}

void Clock::tick() {
  if (!also_.empty() && also_.back() == next())
    also_.pop_back();
  else
    ++k_;
}

void Clock::pass(double t) {
  while (due(t)) tick();
}

void require_few_rows(const Scene& scene, const Listeners& listeners) {
  constexpr double most = 1e7;
  if (listeners.rows || !(scene.output.every > 0 && scene.run.until / scene.output.every > most)) return;
  throw SceneError(
      scene.file, scene.output.place,
      "`every` gives more than ten million rows, which are kept in memory here (pintle run writes any number); increase it, or "
      "decrease run.until");
}

RowFigures::RowFigures(const System& system, Run& run)
    : run_(run), first_integral_(first_integral(system)), n_z_(static_cast<std::size_t>(system.n_z())) {
  run.links.resize(system.contacts.size());
  run.greatest_integrals.assign(n_z_, 0);
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    if (!is_held(system.contacts[c])) continue;
    const auto& header = run.trajectory.header;
    normal_.emplace_back(c, std::ranges::find(header, system.contact_names[c] + ".normal [N]") - header.begin());
  }
}

void RowFigures::see() {
  const auto books = run_.ledger.data.end() - static_cast<std::ptrdiff_t>(run_.ledger.columns() - first_integral_);
  run_.integrals.assign(books, books + static_cast<std::ptrdiff_t>(n_z_));
  for (std::size_t i = 0; i < n_z_; ++i) run_.greatest_integrals[i] = worse(run_.greatest_integrals[i], std::abs(run_.integrals[i]));
  for (const auto& [c, column] : normal_) {
    const double N = *(run_.trajectory.data.end() - static_cast<std::ptrdiff_t>(run_.trajectory.columns()) + column);
    Run::LinkForce& force = run_.links[c];
    force.least = std::min(force.least, N), force.greatest = std::max(force.greatest, N);
    force.pushing += N < 0, ++force.rows;
  }
}

namespace {

/// Energy in play [J], the scale of errors: the energy stored, plus all energy that was supplied or lost.
double in_play(const Energies& e, const Energies& first) {
  return std::abs(e.kinetic) + std::abs(e.gravity - first.gravity) + e.springs + e.contacts + e.strain + std::abs(e.lost) +
         std::abs(e.input);
}

/// Error that rounding may cause in the energy balance of a mechanism that hardly moves [J]. Assumes positions accurate to a `part` of the
/// mechanism's length and to `of_distance` of their distance from the world's origin, angles to `part`, and speeds to `part` of the length
/// over the run.
double rounding_energy(const System& system, const State& state, const Equations& eq, double until) {
  constexpr double part = 1e-12, of_distance = 1e-13;
  const double place = part * system.length, speed = place / until;
  double sum = 0;
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const double distance = state.y.segment<2>(3 * static_cast<Eigen::Index>(b)).norm();
    sum += system.bodies[b].m * ((place + of_distance * distance) * system.gravity.norm() + speed * speed);
  }
  for (const ForceEffect& force : eq.force) sum += force.on_b.head<2>().norm() * place + std::abs(force.on_b[2]) * part;
  return sum;
}

bool all_finite(const Energies& e) { return std::isfinite(e.stored()) && std::isfinite(e.lost) && std::isfinite(e.input); }

Run begun(const Model& model, const Assembly& assembly) {
  Run run;
  run.warnings = model.warnings;
  for (std::string& w : warnings_of(model, assembly)) run.warnings.push_back(std::move(w));
  run.trajectory = trajectory_table(model);
  run.ledger = ledger_table(model.system);
  return run;
}

}  // namespace

/// Time spent in listeners does not count as computing time.
template <class Act>
void Simulation::listen(Act act) {
  const double before = processor_time();
  act();
  seconds_ -= processor_time() - before;
}

Simulation::Simulation(const Scene& scene, const Model& model, const Assembly& assembly, const Listeners& listeners, const SavedState* from)
    : scene_(scene),
      model_(model),
      system_(model.system),
      listeners_(listeners),
      run_(begun(model, assembly)),
      outputs_(scene.output.every > 0 ? scene.output.every : scene.run.until / 1000, scene.run.until, scene.output.instants),
      states_(listeners.state ? scene.output.states : 0, scene.run.until),
      frames_(scene.output.frames > 1 && listeners.frame ? scene.run.until / (scene.output.frames - 1) : 0, scene.run.until),
      start_(assembly.start),
      integrator_(system_, model.scheme, assembly.start),
      monitor_(model),
      figures_(system_, run_),
      slow_(system_),
      undecided_(system_),
      from_(from) {
  require_few_rows(scene, listeners);
  if (from) go_on(*from);
  states_.pass(integrator_.state().t);
  countable_ = all_finite(energies(system_, integrator_.state(), integrator_.equations()));
  going_ = integrator_.failure().empty() && countable_;
  seconds_ += processor_time();
}

void Simulation::go_on(const SavedState& from) {
  last_row_ = from.t;
  integrator_.load(from.memory);
  run_.first = from.first, started_ = true;
  run_.energy_in_play = from.energy_in_play;
  run_.worst_unexplained = from.worst_unexplained;
  outputs_.pass(from.t);
  frames_.pass(from.t);
}

bool SeenEvents::look(const std::vector<Happening>& happenings, const std::vector<Impact>& impacts) {
  const bool more = happenings.size() != happenings_ || impacts.size() != impacts_;
  happenings_ = happenings.size();
  for (; impacts_ < impacts.size(); ++impacts_) open_.push_back(impacts_);
  const std::size_t ended = std::erase_if(open_, [&](std::size_t i) { return !std::isnan(impacts[i].end); });
  return more || ended > 0;
}

bool Simulation::advance(double t) { return advance(t, false); }
bool Simulation::advance_to_event(double t) { return advance(t, true); }

bool Simulation::advance(double t, bool to_event) {
  const Computing computing(seconds_);
  const double until = std::min(t, scene_.run.until);
  guarded(run_, last_row_, [&] {
    if (going_ && !opened_) undecided_.see(integrator_.state());
    if (going_ && !opened_) going_ = report();
    opened_ = true;
    if (to_event) seen_.look(happenings(), impacts());
    while (goes_on() && integrator_.state().t < until) {
      going_ = step(until);
      if (to_event && seen_.look(happenings(), impacts())) break;
    }
    while (goes_on() && integrator_.state().t >= scene_.run.until && integrator_.act_at_end()) going_ = after_step();
    going_ = going_ && integrator_.failure().empty();
  });
  return goes_on() && integrator_.state().t < scene_.run.until;
}

void Simulation::set(int state, double value) {
  if (!goes_on()) return;
  going_ = integrator_.change([&](State& s) { s.y[own_state(system_, state)] = value; });
}

std::vector<double> Simulation::now() {
  Table row{run_.trajectory.header, {}};
  if (integrator_.sample(integrator_.state().t, sampled_)) record(model_, sampled_, integrator_.sampled(), row);
  return std::move(row.data);
}

Run Simulation::finish() {
  const double begin = processor_time();
  if (!going_ && !ended_short(run_)) explain();
  if (goes_on() && integrator_.state().t < scene_.run.until) end(Status::interrupted, "left before its end");
  guarded(run_, last_row_, [&] { add_last(); });
  run_.t_end = lacks_rows() ? last_row_ : integrator_.state().t;  // the last step may have been incomplete
  if (run_.reason.empty()) run_.reason = integrator_.ended();
  run_.impacts = integrator_.impacts();
  run_.happenings = integrator_.happenings();
  if (from_) warn_of_gap(system_, model_, *from_, run_);
  warn_of_depth(system_, run_);
  warn_of_pushing(system_, run_);
  warn_of_lifting(system_, run_);
  warn_of_stiffness(scene_, model_, integrator_.held_by_stability(), run_);
  warn_of_coarse_forces(model_, integrator_.was_implicit(), run_);
  slow_.warn(system_, run_.energy_in_play, run_.warnings);
  undecided_.warn(run_.warnings);
  monitor_.warn(run_.warnings);
  run_.counts = integrator_.counts();
  run_.switched = integrator_.switched();
  run_.worst_position = integrator_.worst_position();
  run_.worst_velocity = integrator_.worst_velocity();
  run_.seconds = seconds_ + processor_time() - begin;
  check_energy_balance(scene_, model_, integrator_.was_implicit(),
                       rounding_energy(system_, integrator_.state(), integrator_.equations(), scene_.run.until), run_);
  return std::move(run_);
}

/// @returns false if the run cannot continue
bool Simulation::step(double until) {
  if (integrator_.counts().steps % 64 == 0 && is_stopped(integrator_.state().t)) return true;
  return integrator_.advance(until) && after_step();
}

bool Simulation::lacks_rows() const {
  return ended_short(run_) || (run_.status == Status::interrupted && outputs_.due(integrator_.state().t));
}

bool Simulation::is_stopped(double t) {
  if (!listeners_.progress || listeners_.progress(t)) return false;
  end(Status::interrupted, "stopped by the user");
  return true;
}

/// Output due by the end of a step, or of an event after the last step. @returns false if the run cannot continue
bool Simulation::after_step() {
  if (!system_.contacts.empty()) slow_.see(system_, integrator_.last(), integrator_.equations());
  undecided_.see(integrator_.state());
  if (!report()) return false;
  if (integrator_.asks_for_row()) add_row_here();
  if (integrator_.asks_for_save() && listeners_.state) save();
  if (const std::string beyond = monitor_.beyond_limits(); !beyond.empty()) {
    end(Status::failed, beyond);
  } else if (states_.due(integrator_.state().t)) {
    states_.pass(integrator_.state().t);
    save();
  }
  return true;
}

/// All output due up to the present step's end. @returns false if an output cannot be evaluated
bool Simulation::report() {
  for (long rows = 1; outputs_.due(integrator_.state().t); ++rows) {
    if (rows % 1024 == 0 && is_stopped(outputs_.next())) return true;
    if (!integrator_.sample(asked_ = outputs_.next(), sampled_)) return false;
    book(sampled_);
    monitor_.see(sampled_, integrator_.sampled());
    add_row(sampled_);
    outputs_.tick();
  }
  while (frames_.due(integrator_.state().t)) {
    if (!integrator_.sample(asked_ = frames_.next(), sampled_)) return false;
    listen([&] { listeners_.frame(sampled_, integrator_.sampled()); });
    frames_.tick();
  }
  return true;
}

/// A row requested by an event: the state after it, in addition to that before it where a row is due at the same time.
void Simulation::add_row_here() {
  if (!integrator_.sample(integrator_.state().t, sampled_)) return;
  book(sampled_);
  add_row(sampled_);
}

SavedState Simulation::saved() const {
  return {integrator_.state().t, integrator_.save(), run_.first, run_.energy_in_play, run_.worst_unexplained};
}

/// Energies of a sampled state, and their balance.
void Simulation::book(const State& state) {
  const Energies e = energies(system_, state, integrator_.sampled());
  if (!started_) run_.first = e, started_ = true;
  run_.energy_in_play = worse(run_.energy_in_play, in_play(e, run_.first));
  run_.last = e;
  run_.unexplained = e.balance() - run_.first.balance();
  const double worst = std::abs(run_.worst_unexplained), now = std::abs(run_.unexplained);
  if (!std::isnan(worst) && !(now <= worst)) run_.worst_unexplained = run_.unexplained;
}

void Simulation::add_row(const State& state) {
  record(model_, state, integrator_.sampled(), run_.trajectory);
  warn_of_signals(scene_, model_, state, run_.trajectory, run_.warnings);
  record_ledger(system_, state, run_.last, run_.unexplained, run_.ledger);
  figures_.see();
  last_row_ = state.t;
  if (!listeners_.rows) return;
  listen([&] {
    listeners_.rows(run_.trajectory, run_.ledger, integrator_.impacts(), integrator_.happenings());
    run_.trajectory.data.clear(), run_.ledger.data.clear();
  });
}

void Simulation::save() {
  if (saved_ == integrator_.state().t) return;
  saved_ = integrator_.state().t;
  listen([&] { listeners_.state(saved()); });
}

/// A run that ends early also has a last row, so that its summary and its energy balance refer to the same time.
void Simulation::add_last() {
  if (started_ && !lacks_rows()) {
    integrator_.sample(integrator_.state().t, sampled_);
    book(integrator_.state());
    const Equations& eq = integrator_.sampled();
    const bool early = run_.status != Status::finished || !integrator_.ended().empty();
    if (early && integrator_.state().t > last_row_ && eq.a.allFinite() && eq.lambda.allFinite()) add_row(integrator_.state());
  }
  if (listeners_.state && !lacks_rows()) save();
}

/// Why a run could not continue.
void Simulation::explain() {
  end(Status::failed, integrator_.failure());
  std::string& reason = run_.reason;
  if (!reason.empty()) {
    reason = explained_failure(scene_, model_, start_, integrator_, monitor_.worst_warning());
  } else if (!countable_) {
    reason = "the energy at the start is beyond what a double holds; check masses, speeds and units";
  } else {
    std::ostringstream s;
    s << "t = " << asked_
      << " s: the output there cannot be evaluated (a singular configuration, or numbers beyond what a double holds: check masses, "
         "stiffnesses and speeds)";
    reason = s.str();
  }
}

}  // namespace pintle
