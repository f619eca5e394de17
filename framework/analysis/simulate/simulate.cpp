#include "framework/analysis/simulate/simulate.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <sstream>

#include "framework/analysis/simulate/energy_balance.h"
#include "framework/analysis/simulate/end_short.h"
#include "framework/analysis/simulate/slow_contact.h"
#include "framework/analysis/simulate/deflection_monitor.h"
#include "framework/build/laws.h"
#include "framework/common/worse.h"
#include "framework/integration/integrator.h"

namespace pintle {

namespace {

/// Times k·interval, k = 0, 1, …, the last one `until` itself; none if interval is 0.
class Clock {
 public:
  Clock(double interval, double until) : interval_(interval), until_(until) {
    if (interval > 0) last_ = static_cast<long>(std::ceil(until / interval - 1e-9));
  }
  bool due(double t) const { return k_ <= last_ && next() <= t; }
  double next() const { return k_ >= last_ ? until_ : static_cast<double>(k_) * interval_; }
  void tick() { ++k_; }
  void pass(double t) {
    while (due(t)) tick();
  }

 private:
  double interval_, until_;
  long k_ = 0, last_ = -1;
};

/// Energy that can be held against: the largest stored so far, and all that came in or went.
double in_play(const Energies& e, const Energies& first) {
  return std::abs(e.kinetic) + std::abs(e.gravity - first.gravity) + e.springs + e.contacts + e.strain + std::abs(e.lost) +
         std::abs(e.input);
}

/// What rounding may leave in the books of a mechanism that hardly moves: places known to a part of its length and of their
// distance from the world's origin, and speeds to the former over the run.
double rounding_energy(const System& system, const State& state, double until) {
  constexpr double part = 1e-12, of_distance = 1e-13;
  const double place = part * system.length, speed = place / until;
  double sum = 0;
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const double distance = state.y.segment<2>(3 * static_cast<Eigen::Index>(b)).norm();
    sum += system.bodies[b].m * ((place + of_distance * distance) * system.gravity.norm() + speed * speed);
  }
  return sum;
}

bool all_finite(const Energies& e) { return std::isfinite(e.stored()) && std::isfinite(e.lost) && std::isfinite(e.input); }

std::string short_number(double x) {
  std::ostringstream s;
  s.precision(3);
  s << x;
  return s.str();
}

/// Bodies that show a force the least and the most inertia, at their centres or turning about them.
struct Unlike {
  std::size_t light = 0, heavy = 0;
  double ratio = 1;
};
Unlike most_unlike(const System& system) {
  double least = INFINITY, most = 0;
  Unlike out;
  std::vector<double> reach(system.bodies.size(), 0.0);
  for (const Marker& m : system.markers)
    if (m.body != ground) reach[static_cast<std::size_t>(m.body)] = std::max(reach[static_cast<std::size_t>(m.body)], m.x_BP.norm());
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const Body& body = system.bodies[b];
    const double turning = reach[b] > 0 ? body.J / (reach[b] * reach[b]) : body.m;
    if (const double low = std::min(body.m, turning); low < least) least = low, out.light = b;
    if (const double high = std::max(body.m, turning); high > most) most = high, out.heavy = b;
  }
  out.ratio = most / least;
  return out;
}

// What a run that cannot go on suffers from, where its numbers show it; else empty.
std::string explain_numbers(const System& system, const Integrator& integrator) {
  constexpr double many = 1e6, few = 1e-9, unlike = 1e6;  // radians, of a pivot, times
  const Eigen::Index n = system.n();
  if (!std::isfinite(integrator.last().to.dy.segment(n, n).squaredNorm()))
    return "numbers beyond what a double holds: check masses, lengths, speeds and units";
  if (integrator.failure().find("max steps") != std::string::npos) return "";
  double angle = 0;
  for (std::size_t b = 0; b < system.bodies.size(); ++b)
    angle = std::max(angle, std::abs(integrator.state().y[3 * static_cast<Eigen::Index>(b) + 2]));
  if (angle > many)
    return "an angle has come to " + short_number(angle) + " rad, whose last digit moves points by " +
           short_number(angle * 2.2e-16 * system.length) + " m; begin again from this state with angles in one turn";
  const Schur& rows = integrator.sampled().schur;
  if (integrator.implicit() || system.n() != system.n_rigid() || system.n_rows() == 0) return "";
  const Unlike bodies = most_unlike(system);
  constexpr double hopeless = 1e12;  // nothing of the lighter is left in sums with the heavier
  if (!(bodies.ratio > unlike && (rows.kept() < few || bodies.ratio > hopeless))) return "";
  return "the inertia of \"" + system.bodies[bodies.light].name + "\" is " + short_number(1 / bodies.ratio) + " of that of \"" +
         system.bodies[bodies.heavy].name + "\", at its centre or turning about it, which leaves " + short_number(rows.kept()) +
         " of what the joint forces are found from; give \"" + system.bodies[bodies.light].name +
         "\" a mass and an inertia nearer to the others', which changes nothing that counts where they are small beside " +
         "what it carries, or take method: generalized-alpha";
}

void warn_of_depth(const System& system, Run& run) {
  std::vector<double> deepest(system.contacts.size(), 0.0);
  for (const Impact& i : run.impacts) {
    double& d = deepest[static_cast<std::size_t>(i.contact)];
    d = std::max(d, i.deepest);
  }
  for (std::size_t c = 0; c < deepest.size(); ++c)
    if (deepest[c] > too_deep * system.contacts[c].gap.journal) {
      std::ostringstream s;
      s.precision(3);
      s << "\"" << system.contact_names[c] << "\": the journal went " << deepest[c]
        << " m into the wall, more than a tenth of its radius; no contact law holds there (is the stiffness " << system.contacts[c].normal.k
        << " N/m^" << system.contacts[c].normal.n << " meant?)";
      run.warnings.push_back(s.str());
    }
}

/// What is judged by rows is judged by those of this run.
void warn_of_gap(const System& system, const Model& model, const SavedState& from, Run& run) {
  const bool linked = std::ranges::any_of(system.contacts, [](const ContactPair& c) { return c.link >= 0; });
  if (!linked && model.bending.empty()) return;
  run.warnings.push_back(
      "this run goes on from " + short_number(from.t) + " s: " + (linked ? "whether a massless link pushed" : "how far bodies bent") +
      (linked && !model.bending.empty() ? " and how far bodies bent" : "") + " before that was judged by the run that saved it");
}

/// A massless link holds the journal at the wall whether the wall presses or not.
void warn_of_pushing(const System& system, Run& run) {
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    if (system.contacts[c].link < 0) continue;
    const Run::LinkForce& force = run.links[c];
    if (force.pushing == 0) continue;
    std::ostringstream s;
    s.precision(3);
    s << "\"" << system.contact_names[c] << "\": the massless link pushed, with up to " << -force.least << " N, in " << force.pushing
      << " of " << force.rows << " outputs, as no wall could pull: contact would be lost there";
    run.warnings.push_back(s.str());
  }
}

/// What is kept of the last row of each table, whoever takes the rows.
class RowFigures {
 public:
  RowFigures(const System& system, Run& run)
      : run_(run), first_integral_(first_integral(system)), n_z_(static_cast<std::size_t>(system.n_z())) {
    run.links.resize(system.contacts.size());
    run.greatest_integrals.assign(n_z_, 0);
    for (std::size_t c = 0; c < system.contacts.size(); ++c) {
      if (system.contacts[c].link < 0) continue;
      const auto& header = run.trajectory.header;
      normal_.emplace_back(c, std::ranges::find(header, system.contact_names[c] + ".normal [N]") - header.begin());
    }
  }
  void see() {
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

 private:
  Run& run_;
  std::size_t first_integral_, n_z_;
  std::vector<std::pair<std::size_t, std::ptrdiff_t>> normal_;  ///< contact, column
};

}  // namespace

const char* status_text(Status s) {
  switch (s) {
    case Status::finished: return "finished";
    case Status::failed: return "failed";
    case Status::interrupted: return "interrupted";
    case Status::ledger_over_bound: return "ledger over its bound";
    case Status::not_written: return "results not written";
    case Status::out_of_memory: return "out of memory";
  }
  return "";
}

Run simulate(const Scene& scene, const Model& model, const Assembly& assembly, const Listeners& listeners, const SavedState* from) {
  using clock = std::chrono::steady_clock;
  const System& system = model.system;
  const double until = scene.run.until;
  Run run;
  run.warnings = model.warnings;
  for (std::string& w : warnings_of(model, assembly)) run.warnings.push_back(std::move(w));
  run.trajectory = trajectory_table(model);
  run.ledger = ledger_table(system);
  Clock outputs(scene.output.every > 0 ? scene.output.every : until / 1000, until);
  Clock states(listeners.state ? scene.output.states : 0, until);
  Clock frames(scene.output.frames > 1 && listeners.frame ? until / (scene.output.frames - 1) : 0, until);

  const auto begin = clock::now();
  clock::duration spent_listening{};
  Integrator integrator(system, model.scheme, assembly.start);
  State sampled;
  double last_row = from ? from->t : 0, asked = 0;
  DeflectionMonitor monitor(model);
  RowFigures figures(system, run);
  SlowContacts slow(system);
  bool started = false;
  if (from) {
    integrator.load(from->memory);
    run.first = from->first, started = true;
    run.energy_in_play = from->energy_in_play;
    run.worst_unexplained = from->worst_unexplained;
    outputs.pass(from->t);
    frames.pass(from->t);
  }
  states.pass(integrator.state().t);
  const auto book = [&](const State& state) {
    const Energies e = energies(system, state, integrator.sampled());
    if (!started) run.first = e, started = true;
    run.energy_in_play = worse(run.energy_in_play, in_play(e, run.first));
    run.last = e;
    run.unexplained = e.balance() - run.first.balance();
    const double worst = std::abs(run.worst_unexplained), now = std::abs(run.unexplained);
    if (!std::isnan(worst) && !(now <= worst)) run.worst_unexplained = run.unexplained;
  };
  const auto add_row = [&](const State& state) {
    record(model, state, integrator.sampled(), run.trajectory);
    record_ledger(system, state, run.last, run.unexplained, run.ledger);
    figures.see();
    last_row = state.t;
    if (!listeners.rows) return;
    const auto before = clock::now();
    listeners.rows(run.trajectory, run.ledger, integrator.impacts());
    run.trajectory.data.clear(), run.ledger.data.clear();
    spent_listening += clock::now() - before;
  };
  // Everything due up to the present step's end. @returns false if an output cannot be evaluated
  const auto report = [&] {
    while (outputs.due(integrator.state().t)) {
      if (!integrator.sample(asked = outputs.next(), sampled)) return false;
      book(sampled);
      monitor.see(sampled, integrator.sampled());
      add_row(sampled);
      outputs.tick();
    }
    while (frames.due(integrator.state().t)) {
      if (!integrator.sample(asked = frames.next(), sampled)) return false;
      const auto before = clock::now();
      listeners.frame(sampled, integrator.sampled());
      spent_listening += clock::now() - before;
      frames.tick();
    }
    return true;
  };
  const auto save = [&] {
    const auto before = clock::now();
    listeners.state({integrator.state().t, integrator.save(), run.first, run.energy_in_play, run.worst_unexplained});
    spent_listening += clock::now() - before;
  };

  const Energies at_start = energies(system, integrator.state(), integrator.equations());
  const bool countable = all_finite(at_start);
  bool going = true;
  guarded(run, last_row, [&] {
    going = integrator.failure().empty() && countable && report();
    while (going && integrator.state().t < until && integrator.ended().empty()) {
      if (listeners.progress && integrator.counts().steps % 64 == 0 && !listeners.progress(integrator.state().t)) {
        run.status = Status::interrupted;
        run.reason = "stopped by the user";
        break;
      }
      going = integrator.advance(until);
      if (going && !system.contacts.empty()) slow.see(system, integrator.last(), integrator.equations());
      going = going && report();
      if (going && !monitor.beyond_limits().empty()) {
        run.status = Status::failed;
        run.reason = monitor.beyond_limits();
        break;
      }
      if (going && states.due(integrator.state().t)) {
        states.pass(integrator.state().t);
        save();
      }
    }
  });
  if (!going && !ended_short(run)) {
    run.status = Status::failed;
    run.reason = integrator.failure();
    const State& at = integrator.state();
    integrator.sample(at.t, sampled);
    std::string why = run.reason.empty() ? "" : explain_laws(scene, at.t);
    if (why.empty() && !run.reason.empty() && at.y.allFinite()) why = explain_pose(system, at.t, at.y);
    if (why.empty() && !run.reason.empty()) why = explain_numbers(system, integrator);
    if (why.empty() && !run.reason.empty()) why = monitor.worst_warning();
    if (!why.empty()) run.reason += "; " + why;
    if (run.reason.empty() && !countable)
      run.reason = "the energy at the start is beyond what a double holds; check masses, speeds and units";
    if (run.reason.empty()) {
      std::ostringstream s;
      s << "t = " << asked
        << " s: the output there cannot be evaluated (a singular pose, or numbers beyond what a "
           "double holds: check masses, stiffnesses and speeds)";
      run.reason = s.str();
    }
  }
  guarded(run, last_row, [&] {
    if (started && !ended_short(run)) {
      integrator.sample(integrator.state().t, sampled);
      book(integrator.state());
      // Where a run ends early it has a last row too, so that its figures and its books are of one moment.
      const Equations& eq = integrator.sampled();
      const bool early = run.status != Status::finished || !integrator.ended().empty();
      if (early && integrator.state().t > last_row && eq.a.allFinite() && eq.lambda.allFinite()) add_row(integrator.state());
    }
    if (listeners.state && !ended_short(run)) save();
  });

  run.t_end = ended_short(run) ? last_row : integrator.state().t;  // a step may have been cut short
  if (run.reason.empty()) run.reason = integrator.ended();
  run.impacts = integrator.impacts();
  if (from) warn_of_gap(system, model, *from, run);
  warn_of_depth(system, run);
  warn_of_pushing(system, run);
  slow.warn(system, run.energy_in_play, run.warnings);
  monitor.warn(run.warnings);
  run.counts = integrator.counts();
  run.switched = integrator.switched();
  run.worst_position = integrator.worst_position();
  run.worst_velocity = integrator.worst_velocity();
  run.seconds = std::chrono::duration<double>(clock::now() - begin - spent_listening).count();
  check_energy_balance(scene, model, integrator.implicit(), rounding_energy(system, integrator.state(), until), run);
  return run;
}

}  // namespace pintle
