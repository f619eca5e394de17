#include "framework/build/choose_method.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "framework/common/index.h"
#include "framework/common/nearest.h"
#include "framework/common/text.h"
#include "framework/dynamics/model/signal_values.h"
#include "framework/scene/error.h"

namespace pintle {

namespace {

// A row or frame between steps costs one evaluation; with verner87, the first one in a step costs 25 more. Counting a whole step for each
// row overestimates this, which keeps dopri5 where steps are few.
const Tableau* automatic_explicit(const Scene& scene, const RateSpectrum& s, const Demand& d) {
  constexpr double fine = 1e-6, brief = 0.05, taken = 0.4;  // tolerance; ratio of rates; share of the demand of a smooth motion
  constexpr double read = 1000;                             // default number of rows; the actual number must not affect the motion
  const Tableau *low = find_tableau("dopri5"), *high = find_tableau("verner87");
  const double steps = taken * scene.run.until * std::max(d.stability, d.accuracy), long_steps = taken * scene.run.until * d.high;
  const bool by_contacts = s.fastest.rate < brief * s.strike;  // impacts are brief, and the motion between them is smooth
  const bool dearer = high->stages() * (long_steps + read) > (low->stages() - 1) * steps + read;
  return scene.run.tolerance > fine || by_contacts || dearer ? low : high;
}
constexpr double rate_reached = 1.0, decay_reached = 3.3;  // stability limits of dopri5 along the axes

/// Acceleration by a unit force, in the most favourable direction, or by a unit couple on a marker. [1/kg], [1/(kg m²)]
struct Mobility {
  double force = 0, couple = 0;
};
Mobility mobility(const System& system, int marker) {
  const Marker& m = system.markers[at(marker)];
  if (m.body == ground) return {};
  const Body& b = system.bodies[at(m.body)];
  return {1 / b.m + m.x_BP.squaredNorm() / b.J + m.shape.rowwise().squaredNorm().sum(), 1 / b.J + m.slope.squaredNorm()};
}

class Parts {
 public:
  explicit Parts(const System& system) : system_(system) {}

  void see(const Force& force, const std::string& name) {
    if (const auto* s = std::get_if<Spring>(&force)) {
      const double w = mobility(system_, s->a).force + mobility(system_, s->b).force;
      see({std::sqrt(s->k * w), s->c * w, "the spring \"" + name + "\""});
    } else if (const auto* t = std::get_if<TorsionSpring>(&force)) {
      const double w = mobility(system_, t->a).couple + mobility(system_, t->b).couple;
      see({std::sqrt(t->k * w), t->c * w, "the spring \"" + name + "\""});
    } else if (const auto* m = std::get_if<Maxwell>(&force)) {
      const double w = mobility(system_, m->a).force + mobility(system_, m->b).force;
      see({std::sqrt(m->k * w), m->k / m->c, "the spring in series with the damper \"" + name + "\""});
    } else if (const auto* span = std::get_if<BeltSpan>(&force)) {
      const Mobility a = mobility(system_, span->a), b = mobility(system_, span->b);
      const double w = a.force + b.force + span->radius_a * span->radius_a * a.couple + span->radius_b * span->radius_b * b.couple;
      see({std::sqrt(span->k * w), span->c * w, "the belt \"" + name + "\""});
    }
  }
  void see(const Body& body) {
    for (int i = 0; i < body.modes(); ++i) {
      const double omega = body.flex->omega[i];
      see({omega, 2 * body.flex->zeta[i] * omega, "mode " + std::to_string(i + 1) + " of \"" + body.name + "\""});
    }
  }
  // Relative rate of change [1/s] of the force of a contact that closes at a hundredth of the motion's speed.
  void see(const ContactPair& pair, double motion, const std::string& name) {
    if (is_held(pair) || pair.pair > 0) return;
    found.struck = true;
    if (is_rigid(pair)) return;
    const double w = mobility(system_, pair.a).force + mobility(system_, pair.b).force + tooth_mobility(system_, pair);
    const double speed = std::max(motion * system_.length * 1e-2, pair.slowest_impact), depth = depth_reached(pair.normal, w, speed);
    if (depth > 0) found.parts.push_back({speed / depth, viscous_damping(pair.normal) * w, "contact at \"" + name + "\""});
    if (depth > 0 && found.parts.back().decay > found.most_damped.decay) found.most_damped = found.parts.back();
    if (depth > 0) found.strike = std::max(found.strike, speed / depth);
  }
  // Bristles under the preload and the weight of the moving bodies.
  void see(const JointFriction& rub, const std::string& name) {
    const BristleConstants bristles = bristle_constants(rub.law);
    if (bristles.stiffness == 0) return;
    const JointEnds ends = ends_of(system_.joints[at(rub.joint)]);
    const Mobility a = mobility(system_, ends.marker[0]), b = mobility(system_, ends.marker[1]);
    const double w = rub.radius > 0 ? rub.radius * rub.radius * (a.couple + b.couple) : a.force + b.force;
    const double load = rub.preload + system_.gravity.norm() / (a.force + b.force);
    see({std::sqrt(load * bristles.stiffness * w), load * bristles.damping * w, "the bristles in \"" + name + "\""});
  }
  // Stiffness and damping of forces with laws of signals: the slopes of the laws at the scene's start.
  void see_laws(const Scene& scene) {
    const Eigen::VectorXd y = drawn(scene);
    std::array<double, most_law_inputs> in, slope{};
    for (std::size_t k = 0; k < system_.forces.size(); ++k) {
      const auto* force = std::get_if<SizedForce>(&system_.forces[k]);
      for (const int l : {force ? force->size : -1, force ? force->other : -1}) {
        if (l < 0) continue;
        const SignalLaw& law = system_.laws[at(l)];
        for (std::size_t i = 0; i < law.in.size(); ++i) in[i] = signal_at(system_, system_.signals[at(law.in[i])], y);
        push(*force, law.of(0, in.data(), slope.data()));
        for (std::size_t i = 0; i < law.in.size(); ++i)
          see(*force, system_.signals[at(law.in[i])], std::abs(slope[i]), system_.force_names[k]);
      }
    }
    see_states(y);
  }
  RateSpectrum found;
  double pushed = 0;  ///< √(acceleration/length) due to the laws of forces at the start of the scene [rad/s]

 private:
  // The scene's own states with the mechanism held: the spectral radius of the Jacobian of their rates [1/s].
  void see_states(const Eigen::VectorXd& y) {
    std::array<double, most_law_inputs> in, slope{};
    const auto n = static_cast<Eigen::Index>(system_.states.size());
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index row = 0; row < n; ++row) {
      const SignalLaw& law = system_.laws[at(system_.states[at(row)].rate)];
      for (std::size_t i = 0; i < law.in.size(); ++i) in[i] = signal_at(system_, system_.signals[at(law.in[i])], y);
      law.of(0, in.data(), slope.data());
      for (std::size_t i = 0; i < law.in.size(); ++i)
        if (const MotionSignal& signal = system_.signals[at(law.in[i])]; signal.kind == MotionSignal::state && std::isfinite(slope[i]))
          J(row, signal.a) += slope[i];
    }
    if (n == 0) return;
    Eigen::Index own, fastest;
    const double decay = J.diagonal().cwiseAbs().maxCoeff(&own), rate = spectral_radius(J, fastest);
    constexpr double known = 0.1;  // accuracy of the rate, for any units
    const bool alone = rate <= (1 + known) * decay;
    see({alone ? 0 : rate, decay, "the state \"" + system_.states[at(alone ? own : fastest)].name + "\""});
  }
  // ‖A^m‖^(1/m) with m = 2^10, for any units of the states: accurate to a few per cent. @param row  the one that grows most
  static double spectral_radius(Eigen::MatrixXd power, Eigen::Index& row) {
    double log = 0, part = 1;
    for (int squarings = 0;; ++squarings) {
      const double size = power.cwiseAbs().rowwise().sum().maxCoeff(&row);
      if (!(size > 0)) return 0;
      log += part * std::log(size);
      if (squarings == 10) return std::exp(log);
      power = (power * power / (size * size)).eval();
      part /= 2;
    }
  }
  void push(const SizedForce& force, double size) {
    const bool couple = force.way == SizedForce::couple || force.way == SizedForce::restoring;
    const Mobility a = mobility(system_, force.a), b = mobility(system_, force.b);
    const double turning = std::abs(size) * (couple ? a.couple + b.couple : (a.force + b.force) / system_.length);
    if (std::isfinite(turning)) pushed = std::max(pushed, std::sqrt(turning));
  }
  // Upper bound of the effect of the force on the signal.
  void see(const SizedForce& force, const MotionSignal& signal, double slope, const std::string& name) {
    using Kind = MotionSignal::Kind;
    if (signal.kind == Kind::state || !std::isfinite(slope)) return;
    const Mobility of_force{mobility(system_, force.a).force + mobility(system_, force.b).force,
                            mobility(system_, force.a).couple + mobility(system_, force.b).couple};
    const Mobility a = mobility(system_, signal.a), b = of_two(signal.kind) ? mobility(system_, signal.b) : Mobility{};
    const bool turns = signal.kind == Kind::angle || signal.kind == Kind::speed || signal.kind == Kind::relative_angle ||
                       signal.kind == Kind::relative_speed;
    const bool couple = force.way == SizedForce::couple || force.way == SizedForce::restoring;
    const double w = std::sqrt((couple ? of_force.couple : of_force.force) * (turns ? a.couple + b.couple : a.force + b.force));
    const bool rate = is_speed(signal.kind);
    see({rate ? 0 : std::sqrt(slope * w), rate ? slope * w : 0, "the law of \"" + name + "\""});
  }
  /// y for the drawn bodies, at the speeds given by the scene.
  Eigen::VectorXd drawn(const Scene& scene) const {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(system_.n_y());
    for (std::size_t b = 0; b < scene.bodies.size() && b < system_.bodies.size(); ++b) {
      Eigen::Vector3d p(scene.bodies[b].at[0], scene.bodies[b].at[1], scene.bodies[b].angle), rate = Eigen::Vector3d::Zero();
      for (const StartBody& s : scene.start_bodies) {
        if (s.body != scene.bodies[b].name) continue;
        p = {s.x.value_or(p[0]), s.y.value_or(p[1]), s.angle.value_or(p[2])};
        rate = {s.vx.value_or(0), s.vy.value_or(0), s.speed.value_or(0)};
      }
      const Eigen::Vector2d arm = Eigen::Rotation2Dd(p[2]) * system_.bodies[b].x_BO;
      p.head<2>() -= arm;
      rate.head<2>() -= rate[2] * perp(arm);
      y.segment<3>(3 * static_cast<Eigen::Index>(b)) = p;
      y.segment<3>(system_.n() + 3 * static_cast<Eigen::Index>(b)) = rate;
    }
    start_own_states(system_, y);
    return y;
  }

  void see(const RateSpectrum::Part& part) {
    found.parts.push_back(part);
    if (part.rate > found.fastest.rate) found.fastest = part;
    if (part.decay > found.most_damped.decay) found.most_damped = part;
  }
  const System& system_;
};

double fastest_of(const TimeLaw& law, double until, double per) {
  constexpr int samples = 64;
  double fastest = 0;
  for (int i = 0; i <= samples; ++i) {
    const Jet jet = law(until * i / samples);
    fastest = std::max({fastest, std::abs(jet.rate) / per, std::sqrt(std::abs(jet.accel) / per)});
  }
  return std::isfinite(fastest) ? fastest : 0;
}

double motion_of(const Scene& scene, const System& system) {
  double motion = std::sqrt(system.gravity.norm() / system.length);
  for (const StartBody& s : scene.start_bodies)
    motion = std::max({motion, std::abs(s.speed.value_or(0)), std::hypot(s.vx.value_or(0), s.vy.value_or(0)) / system.length});
  for (const Joint& j : system.joints)
    if (const TimeLaw* law = driver_law(j))
      motion = std::max(motion, fastest_of(*law, scene.run.until, is_angle_row(j, 0) ? 1 : system.length));
  return motion;
}

/// Rate of the motion that forces with laws of time cause in a mechanism at rest [1/s]: the larger of √(acceleration/length) and of the
/// forces' own rate, the root mean square of their derivative over that of their value.
double pushed_by_laws_of_time(const Scene& scene, const System& system) {
  constexpr int samples = 64;
  double fastest = 0;
  const auto see = [&](const TimeLaw& law, double turned) {
    double most = 0, sizes = 0, rates = 0;
    for (int i = 0; i <= samples; ++i) {
      const Jet jet = law(scene.run.until * i / samples);
      most = std::max(most, std::abs(jet.value)), sizes += jet.value * jet.value, rates += jet.rate * jet.rate;
    }
    for (const double found : {std::sqrt(most * turned), sizes > 0 ? std::sqrt(rates / sizes) : 0})
      if (std::isfinite(found)) fastest = std::max(fastest, found);
  };
  for (const Force& force : system.forces) {
    const Mobility a = mobility(system, marker_a(force)), b = mobility(system, marker_b(force));
    if (const auto* point = std::get_if<PointForce>(&force))
      for (const TimeLaw* law : {&point->x, &point->y}) see(*law, b.force / system.length);
    if (const auto* torque = std::get_if<Torque>(&force)) see(torque->law, a.couple + b.couple);
  }
  return fastest;
}

/// Rate of a motion without drivers [rad/s]: the largest of that due to the forces, that of the slowest oscillation that lasts through the
/// run, and 1/(length of the run).
double undriven_motion(const Scene& scene, const System& system, const RateSpectrum& s, double pushed) {
  double ringing = 0;
  for (const RateSpectrum::Part& p : s.parts) {
    const bool rings = p.rate > 0 && p.decay < 2 * p.rate && p.decay * scene.run.until < 2 * std::log(1 / scene.run.tolerance);
    if (rings) ringing = ringing > 0 ? std::min(ringing, p.rate) : p.rate;
  }
  const double seen = scene.run.until > 0 ? 1 / scene.run.until : 0;
  return std::max({seen, ringing, pushed, pushed_by_laws_of_time(scene, system)});
}

/// Whether the rate of an own state changes with time while all signals are constant.
bool are_led_by_time(const System& system, double until) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(system.n_y());
  start_own_states(system, y);
  return std::ranges::any_of(system.states, [&](const auto& state) {
    std::array<double, most_law_inputs> in, slope{};
    const SignalLaw& law = system.laws[at(state.rate)];
    for (std::size_t i = 0; i < law.in.size(); ++i) in[i] = signal_at(system, system.signals[at(law.in[i])], y);
    const auto rate = [&](double t) { return law.of(t, in.data(), slope.data()); };
    return rate(0) != rate(0.3 * until) || rate(0) != rate(until);
  });
}

/// Whether only own states move by laws, and their rates do not depend on time: no forces, friction, contacts, shapes or drivers.
bool has_states_alone(const Scene& scene, const System& system) {
  return std::ranges::none_of(system.joints, [](const Joint& j) { return driver_law(j) != nullptr; }) && !system.states.empty() &&
         system.forces.empty() && system.frictions.empty() && system.contacts.empty() && system.n() == system.n_rigid() &&
         !are_led_by_time(system, scene.run.until);
}

Constraints constraints_of(const Scene& scene, bool is_explicit) {
  const std::string& c = scene.run.constraints;
  if (c == "partitioning" && !is_explicit)
    throw SceneError(scene.file, scene.run.place,
                     scene.run.method + " does not support constraints: partitioning; leave it out, or use dopri5");
  if (c != "partitioning" && c != "projection")
    throw SceneError(scene.file, scene.run.place, "there are no constraints: " + c + "; write projection (the default) or partitioning");
  return c == "partitioning" ? Constraints::partitioning : Constraints::projection;
}

// The error of a whole run is the tolerance to the power ⅔ with generalised-α, and the tolerance itself with an explicit scheme.
constexpr double dearer = 8;

bool has_rigid_contacts(const System& system) {
  return std::ranges::any_of(system.contacts, [](const ContactPair& c) { return is_rigid(c); });
}

std::string damped_text(const RateSpectrum& s) { return s.most_damped.what + " (" + number_text(s.most_damped.decay, 2) + " 1/s)"; }

/// Whether it is a decay that limits explicit steps most, not an oscillation.
bool is_limited_by_decay(const RateSpectrum& s) { return s.most_damped.decay / decay_reached > s.fastest.rate / rate_reached; }

std::string reason_of(const RateSpectrum& s, const Demand& d, const Scheme& scheme, bool rigid) {
  const std::string low = number_text(std::max(d.stability, d.accuracy), 2), high = number_text(d.high, 2);
  std::string why = scheme.tableau == find_tableau("verner87")
                        ? "Verner's pair needs about " + high + " steps a second for its accuracy, Dormand and Prince's pair about " + low
                        : "Dormand and Prince's pair needs about " + low + " steps a second";
  if (d.stability > d.accuracy) {
    why += ", a limit of stability set by " +
           (is_limited_by_decay(s) ? damped_text(s) : s.fastest.what + " (" + number_text(s.fastest.rate, 2) + " rad/s)");
  } else {
    why += " for its accuracy";
  }
  return why + (rigid ? "; each impact of rigid bodies is an event" : ", and generalised-alpha about " + number_text(d.implicit, 2));
}

void choose(const Scene& scene, const System& system, const RateSpectrum& s, Scheme& scheme) {
  const Demand d = demand(s, scene.run.tolerance);
  const bool rigid = has_rigid_contacts(system), states_alone = has_states_alone(scene, system);
  const bool is_implicit =
      !rigid && !states_alone && std::max(d.stability, d.accuracy) > dearer * d.implicit && scene.run.constraints != "partitioning";
  if (!is_implicit) scheme.tableau = automatic_explicit(scene, s, d);
  scheme.reason = name(scheme) + ", chosen because " +
                  (states_alone ? "only steps show how fast the states of the scene change" : reason_of(s, d, scheme, rigid));
  if (is_implicit) return;
  if (scheme.tableau != find_tableau("dopri5")) scheme.fallback = find_tableau("dopri5");
  if (!rigid && !s.parts.empty() && scene.run.constraints == "projection" && d.implicit > 0)
    scheme.switch_below = s.struck && !is_limited_by_decay(s) ? 0.5 / d.implicit : scene.run.until;
}

}  // namespace

RateSpectrum spectrum(const Scene& scene, const System& system) {
  const double motion = motion_of(scene, system);
  Parts parts(system);
  for (std::size_t i = 0; i < system.forces.size(); ++i)
    parts.see(system.forces[i], i < system.force_names.size() ? system.force_names[i] : "");
  if (!system.laws.empty()) parts.see_laws(scene);
  for (const Body& b : system.bodies) parts.see(b);
  for (const JointFriction& f : system.frictions) parts.see(f, system.joint_names[at(f.joint)]);
  for (std::size_t i = 0; i < system.contacts.size(); ++i)
    parts.see(system.contacts[i], motion, i < system.contact_names.size() ? system.contact_names[i] : "");
  RateSpectrum s = std::move(parts.found);
  s.motion = motion;
  s.until = scene.run.until;
  if (!(motion > 0)) s.motion = undriven_motion(scene, system, s, parts.pushed);
  return s;
}

// A step h of order p in an oscillation of rate r, whose speed is A times that of the motion, has an error of about (hr)ᵖ A; the constants
// are those observed for the schemes on a slider-crank. Inertia forces deflect an elastic part by a fifth of (motion/r)², and it oscillates
// with this amplitude from the start, or from an impact, until damping has reduced it to the tolerance.
Demand demand(const RateSpectrum& s, double tolerance) {
  constexpr double explicit_order = 5, high_order = 8, implicit_order = 3, explicit_constant = 0.7, high_constant = 0.4,
                   implicit_constant = 1, bent = 0.2;
  const auto most = [&](double order) {
    double steps = s.motion * std::pow(1 / tolerance, 1 / order);
    for (const RateSpectrum::Part& p : s.parts) {
      const double excess = bent * std::min(1.0, s.motion / std::max(p.rate, 1e-300)) / tolerance;
      if (!(p.rate > 0) || excess <= 1) continue;
      const double rings = s.struck || p.decay == 0 ? 1 : std::min(1.0, 2 * std::log(excess) / (p.decay * s.until));
      steps = std::max(steps, rings * p.rate * std::pow(excess, 1 / order));
    }
    return steps;
  };
  return {std::max(s.fastest.rate / rate_reached, s.most_damped.decay / decay_reached), explicit_constant * most(explicit_order),
          implicit_constant * most(implicit_order), high_constant * most(high_order)};
}

namespace {

// Moreau's scheme handles impulses of rigid contacts, and forces that change little in a step.
void require_rigid(const Scene& scene, const System& system) {
  const auto wrong = [&](const std::string& message) { throw SceneError(scene.file, scene.run.place, "moreau takes " + message); };
  if (!(scene.run.step > 0 && scene.run.step <= scene.run.until)) wrong("steps of one length, above 0 and no longer than the run");
  if (system.n() != system.n_rigid()) wrong("rigid bodies only, because its steps do not resolve fast vibrations; use auto");
  if (!system.frictions.empty()) wrong("no friction in ideal joints; use auto, or leave that friction out");
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    if (!is_rigid(system.contacts[c])) wrong("rigid contacts only; give \"" + system.contact_names[c] + "\" model: impact, or use auto");
    if (system.contacts[c].rigid->poisson)
      wrong("Newton's law of restitution only; give it to \"" + system.contact_names[c] + "\", or use auto");
  }
}

}  // namespace

void choose_method(const Scene& scene, const System& system, Scheme& scheme) {
  const RunOptions& run = scene.run;
  const RateSpectrum s = spectrum(scene, system);
  scheme.rho = run.rho;
  if (s.most_damped.decay > 0) scheme.stiff = damped_text(s);
  if (run.method == "auto") {
    choose(scene, system, s, scheme);
  } else {
    scheme.tableau = find_tableau(run.method);
    if (!scheme.tableau && run.method != "generalized-alpha" && run.method != "moreau") {
      std::vector<std::string> known{"auto", "generalized-alpha", "moreau"};
      for (const Tableau& t : tableaus()) known.emplace_back(t.name);
      throw SceneError(scene.file, run.place, "there is no method \"" + run.method + "\"." + did_you_mean(run.method, known));
    }
    if (run.method == "moreau") {
      require_rigid(scene, system);
      scheme.fixed_step = run.step;
    } else if (!scheme.tableau && has_rigid_contacts(system)) {
      throw SceneError(scene.file, run.place,
                       "generalized-alpha does not support impacts of rigid bodies (model: impact); use auto, dopri5 or moreau, or give "
                       "the contacts a law with a stiffness");
    }
    scheme.reason = run.method + ", chosen in the scene";
  }
  scheme.constraints = constraints_of(scene, scheme.tableau != nullptr);
}

}  // namespace pintle
