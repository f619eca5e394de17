#include "framework/integration/events/friction_events.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/common/archive.h"
#include "framework/common/index.h"
#include "framework/integration/events/impact_log.h"
#include "framework/integration/events/roots.h"
#include "framework/integration/stepper.h"

namespace pintle {

namespace {

// Cosine of the angle between the force in column i of eq.sticking and the motion that it causes, in coordinates relative to their scales:
// how much of this motion is slip, whatever the masses. Near 0, as at a dead centre, no force can hold the slip.
double leverage(const System& system, Equations& eq, Eigen::Index i) {
  constexpr double rounding = 1e-12;  // of the motion, relative to that of bodies without joints
  const Eigen::VectorXd J = eq.sticking.J.col(i);
  Eigen::VectorXd a = J, lambda, free = Eigen::VectorXd::Zero(J.size());
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const Eigen::Index at = 3 * static_cast<Eigen::Index>(b);
    free.segment<2>(at) = J.segment<2>(at) / system.bodies[b].m;
    free[at + 2] = J[at + 2] / system.bodies[b].J;
  }
  respond(system, eq, a, lambda);
  const double moved = a.cwiseQuotient(system.scale).norm(), unbound = free.cwiseQuotient(system.scale).norm();
  if (unbound == 0) return 1;  // of two ends on the ground
  if (moved <= rounding * unbound) return 0;
  return J.dot(a) / (J.cwiseProduct(system.scale).norm() * moved);
}

MarkerMotion motion_of(const System& system, int marker, const Eigen::VectorXd& y) {
  const MovingPoint p = moving_point(system, marker, y);
  MarkerMotion out;
  out.r = p.r, out.v = p.v, out.w = p.w, out.angle = p.angle;
  out.u = {std::cos(p.angle), std::sin(p.angle)};
  return out;
}

}  // namespace

FrictionEvents::FrictionEvents(const System& system, const Scheme& scheme) : system_(system), tolerance_(scheme.tolerance) {
  for (std::size_t k = 0; k < dry_states(system); ++k)
    if (dry_law(system, k) || of_rigid(k)) dry_.push_back(k);
  fastest_.resize(dry_.size());
}

// A slip below this counts as zero; it depends on the fastest slip and the fastest motion so far [m/s].
double FrictionEvents::still(int event) const {
  constexpr double part = 1e-10;
  return part * fastest_[static_cast<std::size_t>(event / 2)];
}

std::string FrictionEvents::name(int event) const {
  const std::size_t k = place(event), contacts = system_.contacts.size();
  const std::string where =
      k < contacts ? "contact \"" + system_.contact_names[k] : "joint \"" + system_.joint_names[at(system_.frictions[k - contacts].joint)];
  return (of_sliding(event) ? "slip at " : "sticking at ") + where + "\"";
}

// The state defines whether each friction slides or sticks; the guard of the other mode is kept away from zero.
WatchedGuard FrictionEvents::watch(int event) const {
  const double known = of_rigid(place(event)) ? 1e-9 : 1e-6;  // worst relative accuracy of the holding force
  if (of_sliding(event)) return {.direction = Direction::falling, .zero = still(event), .at_once = true};
  return {.direction = Direction::rising, .zero = known, .at_once = true};
}

bool FrictionEvents::of_rigid(std::size_t k) const { return k < system_.contacts.size() && is_rigid(system_.contacts[k]); }
bool FrictionEvents::touches(std::size_t k, const State& state) const {
  return k >= system_.contacts.size() ? !rubs_in_released_joint(system_, state, k) : state.impact_rate[k] > 0;
}

FrictionNow FrictionEvents::now(std::size_t k, const State& state) const {
  const DryFriction& dry = state.friction[k];
  const Coulomb* law = dry_law(system_, k);
  const double part = law ? law->mu_static : 0;
  if (k < system_.contacts.size()) {
    const ContactEffect effect = pressing(system_, static_cast<int>(k), state);
    return {dry.force, effect.gap.material_slip, part * effect.normal.force};
  }
  const JointFriction& rub = system_.frictions[k - system_.contacts.size()];
  const Joint& joint = system_.joints[at(rub.joint)];
  const JointEnds ends = ends_of(joint);
  return {dry.force, slip(joint, rub, motion_of(system_, ends.marker[0], state.y), motion_of(system_, ends.marker[1], state.y)),
          part * dry.load};
}

Guard FrictionEvents::guard(int event, const State& state) const {
  if (!touches(place(event), state)) return {of_sliding(event) ? 1.0 : -1.0};
  return guard(event, state, now(place(event), state));
}

Guard FrictionEvents::guard(int event, const State& state, const Equations& eq) const {
  if (!touches(place(event), state)) return {of_sliding(event) ? 1.0 : -1.0};
  return guard(event, state, friction_now(system_, eq, place(event)));
}

namespace {

constexpr double part_of_most = 1e-9;  // relative to the greatest force of closed rigid contacts: a smaller force counts as none

double most_pressed(const System& system, const State& state) {
  double out = 0;
  for (std::size_t c = 0; c < system.contacts.size(); ++c)
    if (is_rigid(system.contacts[c]) && state.impact_rate[c] > 0) out = std::max(out, std::abs(state.friction[c].load));
  return out;
}

}  // namespace

// Sliding ends slightly past zero slip, so that it can begin at zero. The holding force is relative to its limit μ_s N.
Guard FrictionEvents::guard(int event, const State& state, const FrictionNow& now) const {
  const DryFriction& dry = state.friction[place(event)];
  const bool undecided = dry.direction == DryFriction::undecided;
  if (of_sliding(event)) return {undecided || dry.direction == 0 ? 1.0 : dry.direction * now.slip + 2 * still(event)};
  if (undecided) return {of_rigid(place(event)) ? 1.0 : std::abs(now.slip) / (8 * still(event)) - 1};
  if (dry.direction != 0) return {-1.0};
  const double force = std::abs(dry.force), limit = now.holds;
  if (force > limit && of_rigid(place(event)) && limit <= part_of_most * most_pressed(system_, state)) return {-1.0};  // both are rounding
  return {force <= limit ? (limit > 0 ? force / limit : 0) - 1 : std::min(force / std::max(limit, 1e-300), 1e300) - 1};
}

// A slip that reaches 0 and returns within one step, or a force that reaches its limit and returns.
std::optional<double> FrictionEvents::positive_inside(int event, const Step& step, const DenseOutput& motion, double) const {
  const DryFriction& dry = step.from.state.friction[place(event)];
  if (dry.direction == DryFriction::undecided || of_sliding(event) == (dry.direction == 0)) return std::nullopt;
  if (!dry_law(system_, place(event))) return std::nullopt;  // it neither sticks nor slips
  if (!touches(place(event), step.from.state) || (!of_sliding(event) && !motion.knows_held_forces())) return std::nullopt;
  const double sign = of_sliding(event) ? 1 : -1;
  const auto left = [&](double t) { return sign * guard(event, motion.at(t)).value; };
  const double from = sign * guard(event, step.from.state).value;
  const auto inside = below_zero_inside(left, step, from, of_sliding(event) ? 0 : known_inside(tolerance_));
  const bool rounding = inside && !of_sliding(event) && moves_nothing(motion.at(*inside).friction[place(event)].force, step.h);
  return rounding ? std::nullopt : inside;
}

// In a step of length h this force moves no body by more than the rounding of its position.
bool FrictionEvents::moves_nothing(double force, double h) const {
  constexpr double digits = 1e-13;
  double lightest = std::numeric_limits<double>::infinity();
  for (const Body& body : system_.bodies) lightest = std::min(lightest, body.m);
  return std::abs(force) * h * h < 2 * digits * lightest * system_.length;
}

bool FrictionEvents::met(int event, const Guard& at_end) const {
  constexpr double part = 1e-2, rounding = 1e-13, rigid = 1e-10;  // finer than decide_rigid distinguishes
  const double known = of_rigid(place(event)) ? rigid : std::max(part * tolerance_, rounding);
  return std::abs(at_end.value) <= (of_sliding(event) ? still(event) / 2 : known);
}

namespace {

// Slips that are slow beside the motion of all bodies are its rounding.
void see_motion(double speed, std::vector<double>& fastest) {
  constexpr double part = 1e-3;
  for (double& slip : fastest) slip = std::max(slip, part * speed);
}
double speed_of_motion(const System& system, const State& state) { return system.length * fastest_rate(system, state.y); }
// Of what falls through the mechanism; without gravity, its length in a second.
double expected_speed(const System& system) {
  return has_gravity(system) ? std::sqrt(system.gravity.norm() * system.length) : system.length;
}

}  // namespace

std::string FrictionEvents::follow(Step& step, std::span<const Guard>, std::span<const Guard> to, const DenseOutput&) {
  see_motion(speed_of_motion(system_, step.to.state), fastest_);
  for (int event = 0; event < size(); event += 2)
    if (const double d = step.to.state.friction[place(event)].direction; std::abs(d) == 1 && touches(place(event), step.to.state)) {
      double& fastest = fastest_[static_cast<std::size_t>(event / 2)];
      fastest = std::max(fastest, std::abs(to[static_cast<std::size_t>(event)].value - 2 * still(event)));
    }
  return {};
}

void FrictionEvents::save(Writer& out) const { out.whole(fastest_); }
void FrictionEvents::load(Reader& in) { in.whole(fastest_); }
const char* FrictionEvents::fault() const {
  const bool sound = fastest_.size() == dry_.size() && std::ranges::all_of(fastest_, [](double v) { return std::isfinite(v) && v >= 0; });
  return sound ? nullptr : foreign_modes;
}

void FrictionEvents::start(Step& step) {
  see_motion(std::max(expected_speed(system_), speed_of_motion(system_, step.to.state)), fastest_);
  decide(step.to.state, {}, {});
}

EventOutcome FrictionEvents::act(int event, Step& step, const Guard&) {
  const std::size_t k = place(event);
  const bool breaks_away = !of_sliding(event) && step.to.state.friction[k].direction == 0;
  if (decide(step.to.state, breaks_away ? std::optional(k) : std::nullopt, of_sliding(event) ? std::optional(k) : std::nullopt))
    return {.change = EventOutcome::Change::jump};
  return {.failure =
              name(event) +
              ": no forces of the rigid contacts let the motion continue, as when a rod that slides on its tip jams (Painlevé); give "
              "the contact a law with a stiffness, or less friction"};
}

// Friction that no force can hold slides in the opposite direction once its slip has reached zero; at events of others it stays as it is.
// Where a driver moves it from rest, it is undecided, and without force, until it moves.
void FrictionEvents::pass_dead_centres(const Resting& resting, std::optional<std::size_t> ended, State& state) {
  constexpr double dead = 1e-4;
  pose(system_, state.t, state.y, *eq_);
  factor(system_, state.y, *eq_);
  if (!eq_->regular) return;
  speed(system_, state.t, state.y, *eq_);
  apply_forces(system_, state, *eq_);
  list_sticking(system_, state, *eq_);
  const std::vector<Sticking::Column>& of = eq_->sticking.of;
  for (std::size_t i = 0; i < resting.at.size(); ++i) {
    const auto column = std::ranges::find_if(of, [&](const auto& c) { return c.at == resting.at[i] && !c.normal; }) - of.begin();
    const double by_force = leverage(system_, *eq_, column);
    if (std::abs(resting.came[i]) == 1 && by_force < dead)
      state.friction[resting.at[i]].direction = resting.at[i] == ended ? -resting.came[i] : resting.came[i];
    else if (by_force == 0 && !of_rigid(resting.at[i]))
      state.friction[resting.at[i]].direction = DryFriction::undecided;
  }
}

namespace {

// Whether a closed rigid contact opens although all of them should hold: as when one of a row of discs between two walls is pushed out of
// the row.
bool opens(const System& system, const Equations& eq) {
  constexpr double nearly = 1e-3;
  const Eigen::VectorXd rate = sticking_accelerations(system, eq), by_forces = eq.sticking.J.transpose() * eq.a,
                        terms = eq.sticking.J.cwiseAbs().transpose() * eq.a.cwiseAbs() + (rate - by_forces).cwiseAbs();
  for (Eigen::Index i = 0; i < rate.size(); ++i)
    if (eq.sticking.of[static_cast<std::size_t>(i)].normal && rate[i] > nearly * terms[i]) return true;
  return false;
}

// Whether a closed rigid contact opens, pulls, or holds more than its friction can.
bool overcharged(const System& system, const State& state, const Equations& eq) {
  if (opens(system, eq)) return true;
  constexpr double little = 1e-9;
  double most = 0;
  for (std::size_t c = 0; c < system.contacts.size(); ++c)
    if (is_rigid(system.contacts[c])) most = std::max(most, std::abs(eq.contact[c].normal.force));
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    if (!is_rigid(system.contacts[c]) || !(state.impact_rate[c] > 0)) continue;
    const FrictionNow held = friction_now(system, eq, c);
    if (eq.contact[c].normal.force < -little * most) return true;
    if (state.friction[c].direction == 0 && std::abs(held.force) > (1 + little) * held.holds + little * most) return true;
  }
  return false;
}

}  // namespace

// Sliding continues, or begins against the force that held; everything at rest is first assumed to stick.
FrictionEvents::Resting FrictionEvents::classify(State& state, std::optional<std::size_t> slips) const {
  Resting out;
  for (int event = 0; event < size(); event += 2) {
    const std::size_t k = place(event);
    DryFriction& dry = state.friction[k];
    if (!touches(k, state)) continue;
    out.rigid = out.rigid || of_rigid(k);
    if (!dry_law(system_, k)) {
      dry.direction = 0;
      continue;
    }
    const double slip = now(k, state).slip;
    const bool slow = std::abs(slip) <= 4 * still(event);
    if (k == slips && slow && !of_rigid(k)) {  // rigid contacts are decided together
      dry.direction = -std::copysign(1.0, dry.force);
    } else if (k == slips || !(slow || dry.direction == 0)) {
      dry.direction = std::copysign(1.0, slip);
    } else {
      out.at.push_back(k);
      out.came.push_back(dry.direction);
      dry.direction = 0;
    }
    if (k < system_.contacts.size()) dry.force = 0;
  }
  return out;
}

// Rigid contacts are decided together, since their normal forces depend on their friction.
bool FrictionEvents::decide_rigid_ones(State& state, bool at_limit) {
  if (!at_limit && !overcharged(system_, state, *eq_)) return true;
  Eigen::VectorXd dy(system_.n_y());
  if (decide_rigid(system_, state, *eq_) && evaluate(system_, state, *eq_, dy)) return true;
  for (std::size_t c = 0; c < system_.contacts.size(); ++c)
    if (is_rigid(system_.contacts[c])) state.friction[c].direction = DryFriction::undecided;
  return false;
}

// While forces exceed their limits, makes the friction with the largest ratio slide, in the direction opposite to its holding force.
bool FrictionEvents::decide(State& state, std::optional<std::size_t> slips, std::optional<std::size_t> ended) {
  constexpr double little = 1e-9, nearly = 1e-6;
  const Resting resting = classify(state, slips);
  if (resting.at.empty() && !resting.rigid) return true;
  if (!eq_) eq_ = std::make_unique<Equations>(system_);
  pass_dead_centres(resting, ended, state);
  Eigen::VectorXd dy(system_.n_y());
  for (std::size_t tries = 0; tries < 4 * resting.at.size() + 4; ++tries) {
    if (!evaluate(system_, state, *eq_, dy)) return !resting.rigid;
    if (resting.rigid && !decide_rigid_ones(state, slips && tries == 0)) return false;
    std::optional<std::size_t> worst;
    double most = slips ? 1 - nearly : 1 + little;  // forces that share the load start to slide together
    for (const std::size_t k : resting.at) {
      if (!sticks(system_, state, k) || of_rigid(k)) continue;
      const FrictionNow held = friction_now(system_, *eq_, k);
      const double share = held.force == 0 ? 0 : std::abs(held.force) / std::max(held.holds, 1e-300);
      if (share > most) worst = k, most = share;
    }
    if (!worst) break;
    state.friction[*worst].direction = -std::copysign(1.0, friction_now(system_, *eq_, *worst).force);
  }
  keep_friction(system_, *eq_, state);
  return true;
}

}  // namespace pintle
