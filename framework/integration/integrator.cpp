#include "framework/integration/integrator.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "framework/common/worse.h"
#include "framework/dynamics/equations/energy.h"

namespace pintle {

using Index = Eigen::Index;

namespace {
std::size_t at(int i) { return static_cast<std::size_t>(i); }

constexpr double fork = 1e-9;           // a pivot at which no step should start
constexpr double slowest_speed = 1e-6;  // over the finest length and the step: slower is rest

std::string number_text(double x) {
  std::ostringstream s;
  s.precision(6);
  s << x;
  return s.str();
}
}  // namespace

Integrator::Integrator(const System& system, const Scheme& scheme, State start)
    : system_(system),
      scheme_(scheme),
      eq_(system),
      reach_(system.bodies.size(), 0.0),
      open_impact_(system.contacts.size(), -1),
      loss_at_begin_(system.contacts.size(), 0.0),
      before_(system.contacts.size()),
      after_(system.contacts.size()) {
  for (const Marker& m : system.markers)
    if (m.body != ground) reach_[at(m.body)] = std::max(reach_[at(m.body)], m.x_BP.norm());
  for (const Body& b : system.bodies) {
    mass_ += b.m;
    if (b.modes() > 0) lowest_shape_ = lowest_shape_ > 0 ? std::min(lowest_shape_, b.flex->omega.minCoeff()) : b.flex->omega.minCoeff();
  }
  for (double& r : reach_)
    if (r == 0) r = system.length;
  fine_length_ = system.length;
  for (const ContactPair& c : system.contacts) fine_length_ = std::min(fine_length_, c.gap.clearance());

  start.impact_rate.resize(system.contacts.size(), 0.0);
  step_.to.state = std::move(start);
  step_.to.dy.setZero(system.n_y());
  step_.error.setZero(system.n_y());
  step_.dy_before.setZero(system.n_y());
  step_.from = step_.to;
  dense_ = step_.to.state;
  if (scheme_.tableau)
    stages_.emplace(system, *scheme_.tableau, scheme_.constraints);
  else
    alpha_.emplace(system, eq_, scheme_.rho, scheme_.tolerance);
  if (!settle(step_.to)) {
    stop("the start is a singular pose or off the constraints");
    return;
  }
  for (int c = 0; c < static_cast<int>(system.contacts.size()); ++c) {
    if (system.contacts[at(c)].link >= 0) continue;
    const Touch now = touch(c, step_.to.state);
    if (now.depth > 0) close(c, std::max(now.rate, speed_to_reach(c, now.depth)));
  }
  settle(step_.to);
  step_.from = step_.to;
}

bool Integrator::settle(Instant& node) { return alpha_ ? alpha_->settle(system_, node, eq_) : stages_->settle(system_, node, eq_); }

bool Integrator::attempt(double h) {
  if (!alpha_) return stages_->attempt(system_, h, step_, eq_);
  alpha_->validate_by(fine_length_, std::max({fastest_, fastest_speed(step_.from.state.y), slowest_speed * fine_length_ / h}));
  return alpha_->attempt(system_, h, step_, eq_);
}

// Of any body's centre or of its farthest marker about it [m/s].
double Integrator::fastest_speed(const Eigen::VectorXd& y) const {
  double fastest = 0;
  const double* v = y.data() + system_.n();
  for (std::size_t b = 0; b < reach_.size(); ++b, v += 3) {
    const double around = v[2] * reach_[b];
    fastest = std::max({fastest, v[0] * v[0] + v[1] * v[1], around * around});
  }
  return std::sqrt(fastest);
}

// A start inside the wall has no approach speed. It gets that of the impact which would have come this
// deep: ½ v² = w k δⁿ⁺¹/(n + 1), 1/w the two bodies' reduced mass.
double Integrator::speed_to_reach(int contact, double depth) const {
  const ImpactLaw& law = system_.contacts[at(contact)].normal;
  return std::sqrt(2 * lightness(contact) * law.k * std::pow(depth, law.n + 1) / (law.n + 1));
}

// Sum of the bodies' 1/m [1/kg].
double Integrator::lightness(int contact) const {
  const ContactPair& pair = system_.contacts[at(contact)];
  double out = 0;
  for (int marker : {pair.journal, pair.bearing})
    if (const int body = system_.markers[at(marker)].body; body != ground) out += 1 / system_.bodies[at(body)].m;
  return out;
}

Counts Integrator::counts() const {
  Counts c = counts_;
  c.evaluations = eq_.evaluations;
  c.factorizations = eq_.factorizations;
  c.partitions = stages_ ? stages_->partitions() : 0;
  return c;
}

bool Integrator::stop(const std::string& reason) {
  failure_ = "t = " + number_text(step_.from.state.t) + " s: " + reason;
  return false;
}

// Gap of a contact from the coordinates alone; leaves the equations as they are.
Integrator::Touch Integrator::touch(int contact, const State& state) {
  const ContactPair& pair = system_.contacts[at(contact)];
  const Gap gap = evaluate(pair.gap, moving_point(system_, pair.journal, state.y), moving_point(system_, pair.bearing, state.y));
  return {gap.depth, gap.rate};
}

Integrator::Touch Integrator::touch_at(int contact, double t) {
  interpolate(system_, step_, t, dense_);
  return touch(contact, dense_);
}

// Largest error over its scale. Lengths, modal ones by what their shapes move, are judged against the smallest that matters (a clearance c,
// else the mechanism), angles by what they move, speeds against the fastest so far, v; in explicit steps, where there is a clearance,
// against what is gained across it at the acceleration of the motion, √(c v ω), ω = v/L or of the lowest shape, and those of shapes
// against what is as fine, ω c; integrals against the kinetic energy so far.
double Integrator::scaled_error() {
  const Index n = system_.n();
  const auto& y = step_.to.state.y;
  const double fastest = std::max(fastest_, fastest_speed(y));
  const double length = fine_length_, slowest = slowest_speed * length / step_.h;
  constexpr double known = 1e-13;  // of the fastest speed, to which constraints are met: an error below it is noise
  const double across = std::max(std::sqrt(length * fastest * std::max(fastest / system_.length, lowest_shape_)), known / scheme_.tolerance * fastest);
  const double speed = std::max(alpha_ ? fastest : std::min(fastest, across), slowest);
  const double energy = std::max({energy_, kinetic_energy(system_, y), mass_ * slowest * slowest / 2});
  double worst = 0;
  for (Index b = 0; b < static_cast<Index>(reach_.size()); ++b) {
    const double reach = reach_[at(static_cast<int>(b))];
    const auto judge = [&](Index i, double scale) {
      const double rounding = 1e-15 * std::abs(y[i]);
      worst = worse(worst, std::abs(step_.error[i]) / (scheme_.tolerance * scale + rounding));
    };
    judge(3 * b, length);
    judge(3 * b + 1, length);
    judge(3 * b + 2, length / reach);
    judge(n + 3 * b, speed);
    judge(n + 3 * b + 1, speed);
    judge(n + 3 * b + 2, speed / reach);
    const double per_metre = std::sqrt(system_.bodies[at(static_cast<int>(b))].m);  // shapes of 1/√m
    const Index begin = system_.eta_begin[at(static_cast<int>(b))], end = system_.eta_begin[at(static_cast<int>(b)) + 1];
    for (Index i = begin; i < end; ++i) {
      const double as_fine = system_.bodies[at(static_cast<int>(b))].flex->omega[i - begin] * length;
      judge(i, length * per_metre);
      judge(n + i, std::max(speed, std::min(as_fine, fastest)) * per_metre);
    }
  }
  for (Index i = 2 * n; i < y.size(); ++i)
    worst = worse(worst, std::abs(step_.error[i]) / (scheme_.tolerance * std::max(energy, std::abs(y[i])) + 1e-300));
  return worst;
}

// One accepted error-controlled step of at most h_, never past `h_left`.
bool Integrator::step_to(double h_left) {
  const double order = alpha_ ? Alpha::order + 1 : stages_->tableau().error_order + 1;
  for (int tries = 0; tries < 60; ++tries) {
    const bool last = h_ >= h_left * (1 - short_part);  // nor is a rest left that is too short to tell accelerations by
    const double h = last ? h_left : h_;
    if (h < 4e-16 * std::max(std::abs(step_.from.state.t), h_left))
      return stop("the step became too small (" + number_text(h) + " s) for the tolerance" + trouble());
    const bool done = attempt(h);
    if (fall_back()) {
      ++counts_.rejected;
      continue;
    }
    if (!done) {
      ++counts_.rejected;
      h_ = h * (passes_fork() ? 0.7 : 0.25);
      continue;
    }
    if (!last && !at_singular_configuration_ && tries < 3 && (at_singular_configuration() || passes_fork())) {  // momentum carries past what no step should start from
      ++counts_.rejected;
      h_ = 0.8 * h;
      continue;
    }
    const double error = worse(1e-10, scaled_error());
    if (!(error <= 1)) {
      ++counts_.rejected;
      h_ = h * (std::isnan(error) ? 0.2 : std::max(passes_fork() ? 0.7 : 0.2, 0.9 * std::pow(error, -1 / order)));
      continue;
    }
    const double grow = 0.9 * std::pow(error, -0.7 / order) * std::pow(error_before_, 0.4 / order);
    error_before_ = std::max(error, 1e-4);
    double next = h * std::clamp(grow, 0.2, 5.0);
    if (alpha_ && next > 0.9 * h && next < 1.2 * h) next = h;  // a step kept keeps its factor good
    if (!last || next < h_) h_ = next;
    h_ = std::min(h_, scheme_.max_step);
    return true;
  }
  return stop(eq_.regular ? "no step is small enough for the tolerance" + trouble()
                          : "singular pose: the constraint rows have become dependent");
}

std::string Integrator::trouble() const { return alpha_ && !alpha_->trouble().empty() ? ": " + alpha_->trouble() : ""; }

bool Integrator::advance(double until) {
  if (!failure_.empty()) return false;
  if (counts_.steps == scheme_.max_steps - scheme_.max_steps / 10) last_tenth_ = step_.to.state.t;
  if (counts_.steps >= scheme_.max_steps) {
    const double passed = step_.to.state.t - last_tenth_, more = std::ceil((until - step_.to.state.t) / passed) / 10;
    step_.from = step_.to;
    return stop("max steps reached (" + std::to_string(scheme_.max_steps) + ")" +
                (counts_.steps >= 10 && passed > 0 ? ", the last tenth in " + number_text(passed) + " s: so the rest takes some " +
                                                         number_text(more) + " times as many" : "") +
                ": raise run.max steps, loosen run.tolerance, or soften or damp what is so fast");
  }
  std::swap(step_.from, step_.to);
  step_.struck = false;
  if (!pass_change()) return false;
  step_.to.state.t = step_.from.state.t;
  const double left = until - step_.from.state.t;
  if (h_ == 0) {  // first guess: a hundredth of the time in which the motion changes by itself
    const Index n = system_.n();
    const double speed = step_.from.state.y.segment(n, n).norm(), accel = step_.from.dy.segment(n, n).norm();
    h_ = std::min(left, accel > 0 ? 0.01 * std::max(speed / accel, 1e-3 * std::sqrt(fine_length_ / accel)) : left);
    // An implicit step much longer than a period shows its error as a part of it only: the first is so short that nothing moves
    // by more than the tolerance, and the next, each five times as long at most, see what was resolved before them.
    if (const double fastest = fastest_speed(step_.from.state.y); alpha_ && fastest > 0)
      h_ = std::min(h_, std::max(std::max(scheme_.tolerance, 1e-6) * fine_length_ / fastest, 1e-12 * left));
    for (const Body& b : system_.bodies)  // no shape's first period is stepped over
      if (b.modes() > 0 && !alpha_) h_ = std::min(h_, 0.3 / b.flex->omega.maxCoeff());
    h_ = std::min(h_, scheme_.max_step);
  }
  before_.swap(after_);
  if (!after_known_)
    for (int c = 0; c < static_cast<int>(system_.contacts.size()); ++c) before_[at(c)] = touch(c, step_.from.state);
  after_known_ = false;

  const double h_wish = h_, law_end = law_ahead(step_.from.state.t), ahead = std::min(release_ahead(), law_end - step_.from.state.t);
  if (!step_to(std::min(left, ahead))) {
    step_.to = step_.from;
    return false;
  }
  if (step_.h == ahead) h_ = std::max(h_, h_wish);  // cut short by the release or a law, not by an error
  for (const double end : {law_end, until})
    if (std::isfinite(end) && std::abs(end - step_.to.state.t) <= 4e-16 * std::abs(end)) step_.to.state.t = end;
  int contact = -1;
  bool onset = false;
  if (!system_.contacts.empty()) {
    if (scheme_.onset_cut > 0) {
      for (int halvings = 0; halvings < 200; ++halvings) {
        contact = -1;
        double deepest = 0;
        for (int c = 0; c < static_cast<int>(system_.contacts.size()); ++c) {
          if (system_.contacts[at(c)].link >= 0) continue;
          const double depth = touch(c, step_.to.state).depth;
          const bool closed = open_impact_[at(c)] >= 0;
          if (!closed && depth > deepest) contact = c, onset = true, deepest = depth;
          if (closed && depth <= 0 && deepest == 0) contact = c, onset = false;
        }
        if (contact < 0 || !onset || deepest <= scheme_.onset_cut) break;
        h_ = step_.h / 2;
        if (!step_to(h_)) {
          step_.to = step_.from;
          return false;
        }
      }
    } else {
      double t = first_event(contact, onset);
      // Where the dense output of a long step promises an event that true steps do not find: a shorter step.
      for (int halvings = 0; contact >= 0 && !finish_at(t, contact); ++halvings) {
        h_ = step_.h / 2;
        if (!failure_.empty() || halvings > 40 || !step_to(h_)) {
          step_.to = step_.from;
          return !failure_.empty() ? false : stop("an impact cannot be located; tighten run.tolerance");
        }
        t = first_event(contact, onset);
      }
    }
  }

  ++counts_.steps;
  if (contact >= 0 || scheme_.onset_cut > 0) look_at_end();
  follow_impacts();
  events_here_ = contact < 0 ? 0 : step_.h > 0 ? 1 : events_here_ + 1;
  if (events_here_ > 100 + 2 * static_cast<int>(system_.contacts.size())) return stop("contact \"" + system_.contact_names[at(contact)] +
                                      "\" opens and closes without time passing");
  if (contact >= 0) {
    ++counts_.events;
    (onset ? h_open_ : h_closed_) = h_wish;
    if (onset)
      close(contact, touch(contact, step_.to.state).rate);
    else
      open(contact);
    const double remembered = onset ? h_closed_ : h_open_;
    h_ = remembered > 0 ? std::min(remembered, scheme_.max_step) : h_wish;
    if (onset && stages_) h_ = std::min(h_, onset_step(contact));
    error_before_ = 1;
    step_.struck = system_.contacts[at(contact)].normal.d > 0;
    if (step_.struck) step_.dy_before = step_.to.dy;
    if (!settle(step_.to)) return stop("singular pose at an impact");
  }
  after_known_ = contact < 0;
  if (stages_) stages_->refresh(system_, eq_);
  at_singular_configuration_ = at_singular_configuration();

  const auto& y = step_.to.state.y;
  fastest_ = std::max(fastest_, fastest_speed(y));
  energy_ = std::max(energy_, kinetic_energy(system_, y));
  worst_position_ = worse(worst_position_, position_violation(system_, eq_));
  worst_velocity_ = worse(worst_velocity_, velocity_violation(system_, y, eq_));
  if (contact < 0 && scheme_.switch_below > 0 && stages_) return watch_stiffness();
  return true;
}

// Accelerations at a distance u of a pose where motions branch are known to ω² ε/u³, ε the rounding of places, and of that a step brings
// the part hω into the motion: the pivot, which falls as u², that leaves the tolerance.
double Integrator::fork_pivot() const {
  constexpr double rounding = 1e-16;
  const double turn = step_.h * fastest_rate(system_, step_.to.state.y);
  return std::max(fork, std::pow(turn * turn * rounding / scheme_.tolerance, 2.0 / 3));
}
bool Integrator::at_singular_configuration() const {
  if (!stages_) return false;
  const Schur& S = eq_.schur;
  return S.lost() > eq_.permanent || (S.near_singular(eq_.permanent) && S.kept() < fork);
}
// A stage came nearer than that, and much nearer than the step's end: so it is the pose, not bodies of unlike inertias.
bool Integrator::passes_fork() const {
  constexpr double nearer = 0.1;
  return stages_ && stages_->closest() < std::min(fork_pivot(), nearer * eq_.schur.kept());
}

// Stages of a pair of high order stray far from the motion, too far where branches meet.
bool Integrator::fall_back() {
  if (!stages_ || !scheme_.fallback || fallen_back_ || !stages_->near_singular()) return false;
  fallen_back_ = true;
  switched_ = std::string(scheme_.fallback->name) + " from t = " + number_text(step_.from.state.t) + " s on: a singular pose is near";
  stages_.emplace(system_, *scheme_.fallback, scheme_.constraints);
  return true;
}

// An explicit pair whose steps lie at the edge of its stability, one after another, is asked for by stability.
bool Integrator::watch_stiffness() {
  constexpr double edge = 0.9;
  constexpr int many = 30;
  const bool held = step_.h < scheme_.switch_below && stages_->stiffness(system_, step_) > edge * stages_->tableau().reach;
  held_by_stability_ = held ? held_by_stability_ + 1 : std::max(0, held_by_stability_ - 2);
  if (held_by_stability_ < many) return true;
  switched_ = "generalized-alpha from t = " + number_text(step_.to.state.t) + " s on: stability, not accuracy, held " +
              std::to_string(many) + " explicit steps near " + number_text(step_.h) + " s";
  stages_.reset();
  alpha_.emplace(system_, eq_, scheme_.rho, scheme_.tolerance);
  h_open_ = h_closed_ = 0;
  error_before_ = 1;
  after_known_ = false;
  return settle(step_.to) || stop("singular pose");
}

bool Integrator::sample(double t, State& out) {
  if (!sampler_) sampler_ = std::make_unique<Sampler>(system_);
  if (alpha_)
    sampler_->follow(system_, *alpha_, scheme_.rho, scheme_.tolerance);
  else
    sampler_->follow(system_, *stages_);
  return sampler_->sample(system_, step_, t, eq_.permanent, out);
}

}  // namespace pintle
