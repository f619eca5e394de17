#include "framework/analysis/linearize/linearize.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <sstream>

#include "framework/analysis/linearize/quadratic_roots.h"
#include "framework/analysis/linearize/state_space.h"
#include "framework/analysis/linearize/steady_axes.h"
#include "framework/common/dense.h"
#include "framework/common/index.h"
#include "framework/common/text.h"
#include "framework/common/stop_point.h"
#include "framework/common/work_done.h"
#include "framework/configuration/unsound_laws.h"
#include "framework/configuration/assemble.h"
#include "framework/configuration/deflection_monitor.h"
#include "framework/integration/integrator.h"
#include "framework/scene/error.h"

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

namespace {

std::string text(double x, int digits = 4) {
  std::ostringstream s;
  s.precision(digits);
  s << x;
  return s.str();
}

// " are pressed by 10 N: stiffness 1e+06 N/m along the surfaces, damping 2019 N s/m where they are at rest"
std::string bristles_text(const FrictionLaw& law, double load) {
  const BristleConstants of = bristle_constants(law);
  return " are pressed by " + text(load) + " N: stiffness " + text(load * of.stiffness) + " N/m along the surfaces, damping " +
         text(load * of.damping) + " N s/m where they are at rest";
}

/// The system with the recorded points among its markers, and its laws held constant where required.
System prepared(const Model& model, double t, Laws laws) {
  System out = model.system;
  for (const RecordedPoint& p : model.points) out.markers.push_back(p.marker);
  if (laws == Laws::go_on) return out;
  const auto hold = [t](TimeLaw& law) {
    const double value = law(t).value;
    law = [value](double) { return Jet{value, 0, 0}; };
  };
  for (Joint& j : out.joints)
    if (TimeLaw* law = driver_law(j)) hold(*law);
  for (Force& f : out.forces) {
    if (auto* p = std::get_if<PointForce>(&f)) hold(p->x), hold(p->y);
    if (auto* q = std::get_if<Torque>(&f)) hold(q->law);
  }
  for (SignalLaw& law : out.laws) law.of = [of = law.of, t](double, const double* in, double* slope) { return of(t, in, slope); };
  return out;
}

std::vector<std::string> coordinate_names(const System& system) {
  std::vector<std::string> out(at(system.n()));
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const Body& body = system.bodies[b];
    const std::string centre = body.x_BO.isZero() ? "." : ".centre ";
    out[3 * b] = body.name + centre + "x [m]";
    out[3 * b + 1] = body.name + centre + "y [m]";
    out[3 * b + 2] = body.name + ".angle [rad]";
    for (int i = 0; i < body.modes(); ++i) out[at(system.eta_begin[b] + i)] = body.name + ".mode " + std::to_string(i + 1) + " [m kg^0.5]";
  }
  return out;
}

/// The body with the most kinetic energy, and the coordinate that moves most in it.
void name_carrier(const System& system, const MotionAt& here, const std::vector<std::string>& names, LinearMode& mode) {
  double most = 0, total = 0;
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    std::vector<Index> own;
    for (Index i = 0; i < 3; ++i) own.push_back(static_cast<Index>(3 * b) + i);
    for (Index i = system.eta_begin[b]; i < system.eta_begin[b + 1]; ++i) own.push_back(i);
    const VectorXcd x = mode.shape(own);
    const double energy = x.dot(here.M(own, own) * x).real();
    total += energy;
    if (energy <= most) continue;
    most = energy;
    double greatest = -1;
    for (std::size_t i = 0; i < own.size(); ++i)
      if (const double e = std::norm(x[static_cast<Index>(i)]) * here.M(own[i], own[i]); e > greatest)
        greatest = e, mode.carrier = names[at(own[i])];
  }
  if (mode.carrier.empty()) mode.carrier = "internal states";
  mode.carrier = mode.carrier.substr(0, mode.carrier.rfind(" ["));
  mode.share = total > 0 ? most / total : 0;
}

VectorXcd normalised(const System& system, const VectorXcd& shape) {
  Index most = 0;
  const double size = shape.cwiseAbs().cwiseQuotient(system.scale).maxCoeff(&most);
  return size > 0 ? VectorXcd(shape * (system.scale[most] / shape[most])) : shape;
}

/// Zero roots share shapes: one mode for each unrestrained motion, in the metric of M.
void add_zero_modes(const System& system, const std::vector<QuadraticRoot>& roots, const Linearization& lin, std::vector<LinearMode>& out) {
  constexpr double another = 1e-3;
  std::vector<VectorXd> basis;
  int count = 0;
  for (const QuadraticRoot& r : roots) {
    if (!r.zero) continue;
    ++count;
    VectorXd x = r.right.real().norm() >= r.right.imag().norm() ? VectorXd(r.right.real()) : VectorXd(r.right.imag());
    x /= std::sqrt(x.dot(lin.motion.M * x));
    for (const VectorXd& b : basis) x -= b.dot(lin.motion.M * x) * b;
    if (const double left = std::sqrt(x.dot(lin.motion.M * x)); left > another) basis.push_back(x / left);
  }
  for (std::size_t i = 0; i < basis.size(); ++i) {
    LinearMode& mode = out.emplace_back();
    mode.kind = LinearMode::Kind::zero;
    mode.roots = count / static_cast<int>(basis.size()) + (static_cast<int>(i) < count % static_cast<int>(basis.size()) ? 1 : 0);
    mode.shape = normalised(system, (lin.Z * basis[i]).cast<Complex>());
  }
}

// Coefficients that change by `drift` within `window` make amplitudes grow or decay at that rate, which is no instability.
std::vector<LinearMode> modes_of(const System& system, const MotionAt& here, const SmallMotion& moving, const SmallMotion& size,
                                 const Linearization& lin) {
  const double pace = lin.coefficients != Coefficients::frozen && lin.window > 0 ? lin.drift / lin.window : 0;
  std::vector<LinearMode> out;
  const std::vector<QuadraticRoot> roots = roots_of(moving, size);
  add_zero_modes(system, roots, lin, out);
  for (const QuadraticRoot& r : roots) {
    if (r.zero || r.lambda.imag() < 0) continue;
    LinearMode& mode = out.emplace_back();
    mode.root = r.lambda;
    mode.uncertainty = r.uncertainty + pace;
    mode.roots = r.lambda.imag() == 0 ? 1 : 2;
    mode.kind = r.lambda.real() > mode.uncertainty ? LinearMode::Kind::growing
                : r.lambda.imag() == 0             ? LinearMode::Kind::decaying
                                                   : LinearMode::Kind::oscillating;
    mode.shape = normalised(system, lin.Z.cast<Complex>() * r.right);
  }
  for (LinearMode& mode : out) name_carrier(system, here, lin.coordinates, mode);
  return out;
}

// `"load" has`, or `"load", "lag" have`: the names without their units.
std::string held_states(const MotionAt& here, const std::vector<int>& held) {
  std::string out;
  for (const int i : held) {
    const std::string& name = here.x_names[at(i)];
    out += (out.empty() ? "" : ", ") + quoted(name.substr(0, name.rfind(" [")));
  }
  return out + (held.size() > 1 ? " have" : " has");
}

// Closes contacts whose surfaces overlap although the state contains no impact, as at a start.
State with_contacts_closed(const System& system, State state) {
  state.impact_rate.resize(system.contacts.size(), 0.0);
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    const ContactPair& pair = system.contacts[c];
    if (is_held(pair) || state.impact_rate[c] > 0 || !(onset_of(system, static_cast<int>(c), state).value > 0)) continue;
    state.impact_rate[c] = latched_at(system, pair, gap_of(system, static_cast<int>(c), state).value);
  }
  return state;
}

std::vector<LinearContact> contacts_of(const System& system, const MotionAt& here) {
  std::vector<LinearContact> out;
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    if (system.contacts[c].profiles && !(here.eq.contact[c].normal.force > 0)) continue;
    const ContactEffect e = clearance_effect(system, here.eq, c);
    out.push_back({system.contact_names[c], e.normal.force > 0, e.gap.depth, e.normal.force, e.normal.d_depth, e.normal.d_rate,
                   here.state.impact_rate[c], c});
  }
  return out;
}

bool laws_vary(const Scene& scene) {
  const auto in_time = [](const Law& law) { return !law.constant && (law.signals.empty() || law.uses_time); };
  const auto varies = [&](const SceneLoad& l) {
    const auto* f = std::get_if<SceneForce>(&l.what);
    const auto* q = std::get_if<SceneTorque>(&l.what);
    return (f && (in_time(f->x) || in_time(f->y))) || (q && in_time(q->law));
  };
  return std::ranges::any_of(scene.loads, varies);
}

void add_notes(const Scene& scene, const System& system, const MotionAt& here, Laws laws, Linearization& out) {
  const Index n = system.n();
  const bool moves = out.window > 0 && !here.state.y.segment(n, n).isZero(1e-12);
  if (out.coefficients == Coefficients::turning)
    out.notes.push_back("steady rotation: coordinates are given in axes that turn at " + text(out.turn, 6) +
                        " rad/s about the world's origin; in these axes the coefficients are constant");
  if (out.coefficients == Coefficients::frozen)
    out.notes.push_back(
        std::string(moves ? "the coefficients change during the motion" : "this is not an equilibrium, the mechanism begins to move") +
        ": the roots are those of the coefficients frozen at this instant; they depend on the choice of coordinates and do not determine "
        "stability" +
        (moves ? "" : "; to linearize about the equilibrium, use --equilibrium"));
  for (const LinearContact& c : out.contacts) {
    if (is_held(system.contacts[c.pair]))
      out.notes.push_back("\"" + c.name + "\" is a massless link that carries " + text(c.force) + " N" +
                          (c.force < 0 ? ", in compression, but a wall cannot pull" : ""));
    else if (c.closed && begins_with_jump(system.contacts[c.pair].normal))
      out.notes.push_back("\"" + c.name + "\" is closed: stiffness " + text(c.stiffness) + " N/m along its normal, damping " +
                          text(c.damping) + " N s/m");
    else if (c.closed)
      out.notes.push_back("\"" + c.name + "\" is closed: stiffness " + text(c.stiffness) + " N/m along its normal, damping " +
                          text(c.damping) + " N s/m for an impact at " + text(c.impact_rate) + " m/s");
    else if (c.depth > 0 && c.impact_rate > 0)
      out.notes.push_back("\"" + c.name + "\" overlaps without force (it separates faster than its law can push) and adds nothing");
    else
      out.notes.push_back("\"" + c.name + "\" is open and adds nothing");
  }
  std::string last;
  for (const LinearContact& c : out.contacts)
    if (c.closed && has_bristles(system.contacts[c.pair]))
      out.notes.push_back("bristles at \"" + c.name + "\"" + bristles_text(*system.contacts[c.pair].friction, c.force));
    else if (c.closed && system.contacts[c.pair].friction && std::exchange(last, c.name) != c.name)
      out.notes.push_back("friction at \"" + c.name + "\" is ignored: the contact slides freely here");
  for (std::size_t k = 0; k < system.frictions.size(); ++k)
    if (const JointFriction& f = system.frictions[k]; bristle_states(f.law) > 0)
      out.notes.push_back("bristles in \"" + system.joint_names[at(f.joint)] + "\"" + bristles_text(f.law, here.eq.friction[k].load));
    else
      out.notes.push_back("friction in \"" + system.joint_names[at(f.joint)] + "\" is ignored: the joint slides freely here");
  if (laws_vary(scene))
    out.notes.push_back(laws == Laws::hold ? "loads are held at their values at t = " + text(out.about.t, 6) + " s"
                                           : "loads that vary in time have their values at t = " + text(out.about.t, 6) + " s");
  for (std::size_t k = 0; k < system.forces.size(); ++k)
    if (acts_along_a_line(system.forces[k]) &&
        here.eq.motion[at(marker_a(system.forces[k]))].r == here.eq.motion[at(marker_b(system.forces[k]))].r)
      out.notes.push_back("\"" + system.force_names[k] + "\" has no length and hence no direction here; it adds nothing");
  if (out.independent.empty())
    out.notes.push_back(std::string("joints and drivers leave no degree of freedom: ") +
                        (out.modes.empty() ? "there are no modes" : "the modes are those of internal states"));
  if (std::ranges::any_of(out.modes, [](const LinearMode& m) { return m.kind == LinearMode::Kind::growing; }) &&
      out.coefficients != Coefficients::frozen)
    out.notes.emplace_back("unstable: a mode grows");
}

}  // namespace

double LinearMode::frequency() const { return std::abs(root.imag()) / (2 * std::numbers::pi); }
double LinearMode::natural() const { return std::abs(root) / (2 * std::numbers::pi); }
double LinearMode::damping() const { return root == 0.0 ? 0 : (0 - root.real()) / std::abs(root); }

const char* kind_text(LinearMode::Kind kind) {
  switch (kind) {
    case LinearMode::Kind::oscillating: return "oscillates";
    case LinearMode::Kind::decaying: return "decays";
    case LinearMode::Kind::growing: return "grows";
    case LinearMode::Kind::zero: return "zero";
  }
  return "";
}

Linearization linearize(const Scene& scene, const Model& model, const State& given, Laws laws) {
  const System system = prepared(model, given.t, laws);
  refuse_rigid_contacts(scene, system, "a linearisation");
  const State state = with_contacts_closed(system, given);
  if (system.n() > most_linearized)
    throw SceneError(scene.file, {},
                     "a linearisation uses dense matrices, for at most " + std::to_string(most_linearized) +
                         " coordinates; this scene has " + std::to_string(system.n()) +
                         "; keep fewer modes, cut beams into fewer pieces, or linearize a part of it");
  if (const std::string unsound = explain_signals(scene, model, state, state); !unsound.empty())
    throw AssemblyError(scene.file, {}, unsound);
  const MotionAt here(system, state);
  if (!here.regular)
    throw AssemblyError(scene.file, {},
                        "singular at t = " + text(state.t, 6) +
                            " s: the constraint equations of the joints are linearly dependent there; linearize at another pose, or remove "
                            "redundant joints");
  Linearization out;
  out.about = state;
  out.coordinates = coordinate_names(system);
  const FreeMotion free = in_steady_axes(system, here, driven_rows(system), out);
  out.independent = free.independent;
  out.motion = free.project(here);
  out.Z = free.X.leftCols(free.m());
  out.contacts = contacts_of(system, here);
  std::vector<int> held;
  try {
    const SmallMotion moving = without_held(out.motion, out.motion.G_x.rows() - static_cast<Index>(system.states.size()), held);
    out.modes = modes_of(system, here, moving, sizes(free, here), out);
    out.space = state_space(model, system, here, free, out.motion, out.coordinates);
  } catch (const SceneError&) {
    throw;
  } catch (const std::runtime_error& e) {
    throw AssemblyError(scene.file, {}, std::string("t = ") + text(state.t, 6) + " s: " + e.what());
  }
  add_notes(scene, system, here, laws, out);
  if (!held.empty()) out.notes.push_back(held_states(here, held) + " no mode: nothing changes it here, or it changes nothing");
  DeflectionMonitor deflections(model);
  deflections.see(state, here.eq);
  deflections.warn(out.notes);
  return out;
}

State state_at(const Model& model, const State& start, double t) {
  Integrator integrator(model.system, model.scheme, start);
  while (integrator.failure().empty() && integrator.state().t < t && integrator.advance(t)) {
    stop_point();
    work_done = integrator.state().t / t;
  }
  if (!integrator.failure().empty()) throw std::runtime_error("the run up to this state failed: " + integrator.failure());
  return integrator.state();
}

State displaced(const Model& model, const Linearization& lin, const LinearMode& mode, double phase) {
  constexpr double amplitude = 0.1;
  const System& system = model.system;
  State out = lin.about;
  const double period = mode.frequency() > 0 ? 1 / mode.frequency() : 1;
  out.t += phase / (2 * std::numbers::pi) * period;
  out.y.head(system.n()) += amplitude * (mode.shape * std::polar(1.0, phase)).real();
  out.impact_rate.assign(out.impact_rate.size(), 0.0);
  State closed = out;
  Equations eq(system);
  return project(system, lin.about.t, closed.y, eq) ? closed : out;
}

}  // namespace pintle
