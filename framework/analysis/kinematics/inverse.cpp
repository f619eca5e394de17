#include "framework/analysis/kinematics/inverse.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/analysis/kinematics/kinematics.h"
#include "framework/analysis/simulate/end_short.h"
#include "framework/common/processor_time.h"
#include "framework/common/text.h"
#include "framework/common/worse.h"
#include "framework/configuration/unsound_laws.h"
#include "framework/dynamics/newton/kkt.h"
#include "framework/scene/error.h"
#include "framework/scene/units/table.h"

namespace pintle {

namespace {

using Eigen::VectorXd;
using Index = Eigen::Index;

/// Forces of a driven motion, from its inertia.
class Forces {
 public:
  Forces(const System& system, const State& start) : system_(system), motion_(system, start), f_(VectorXd::Zero(system.n())) {}

  /// Advances to time t and evaluates everything there. @returns false as DrivenMotion does
  bool advance(double t) {
    if (!motion_.advance(t)) return false;
    Equations& eq = motion_.equations();
    const State& state = motion_.state();
    update_mass(system_, state.y, eq);
    apply_forces(system_, state, eq);
    eq.a = motion_.acceleration();
    f_.setZero();
    add_mass_times(system_, eq, eq.a, f_);
    eq.lambda = motion_.rows().reactions(system_, eq.f - f_);
    return eq.lambda.allFinite();
  }
  DrivenMotion& motion() { return motion_; }

 private:
  const System& system_;
  DrivenMotion motion_;
  VectorXd f_;
};

std::vector<int> driver_joints(const System& system) {
  std::vector<int> out;
  for (std::size_t k = 0; k < system.joints.size(); ++k)
    if (is_driver(system.joints[k])) out.push_back(static_cast<int>(k));
  return out;
}

std::vector<DriverEffort> named_efforts(const System& system) {
  std::vector<DriverEffort> out;
  for (int k : driver_joints(system)) {
    DriverEffort& e = out.emplace_back();
    e.name = system.joint_names[static_cast<std::size_t>(k)];
    e.turns = is_angle_row(system.joints[static_cast<std::size_t>(k)], 0);
  }
  return out;
}

// Error of a spline through every second row at the rows between; with twice as many rows it is about sixteen times smaller.
double spline_error(const DriverEffort& e) {
  if (e.t.size() < 9) return std::numeric_limits<double>::quiet_NaN();
  Samples half;
  for (std::size_t k = 0; k < e.t.size(); k += 2) half.t.push_back(e.t[k]), half.value.push_back(e.value[k]);
  const Spline spline(half);
  double worst = 0;
  for (std::size_t k = 1; k < e.t.size() && e.t[k] < half.t.back(); k += 2)
    worst = worse(worst, std::abs(spline(e.t[k]).value - e.value[k]));
  return worst;
}

double largest_of(const std::vector<double>& values) {
  double out = 0;
  for (double v : values) out = worse(out, std::abs(v));
  return out;
}

void add_efforts(const System& system, double t, const Equations& eq, std::vector<DriverEffort>& out) {
  const std::vector<int> joints = driver_joints(system);
  for (std::size_t d = 0; d < joints.size(); ++d) {
    out[d].t.push_back(t);
    out[d].value.push_back(-eq.lambda[system.row_begin[static_cast<std::size_t>(joints[d])]]);
  }
}

// The number of rows is doubled until a spline through them is accurate. They are kept in memory, so not all of very many.
std::vector<DriverEffort> find_efforts(const Model& model, const Assembly& assembly, std::size_t first, double until) {
  constexpr double enough = 1e-9, smooth = 0.3;
  constexpr std::size_t most = 32768;
  std::vector<double> before(driver_joints(model.system).size(), std::numeric_limits<double>::infinity());
  for (std::size_t n = 2 * std::clamp<std::size_t>(first, 64, 5'000'000);; n *= 2) {
    std::vector<DriverEffort> out = named_efforts(model.system);
    Forces forces(model.system, assembly.start);
    for (std::size_t k = 0; k <= n; ++k) {
      const double t = k == n ? until : until * static_cast<double>(k) / static_cast<double>(n);
      if (!forces.advance(t)) break;
      add_efforts(model.system, t, forces.motion().equations(), out);
    }
    bool done = true;
    for (std::size_t d = 0; d < out.size(); ++d) {
      out[d].error = spline_error(out[d]);
      done = done && (!(out[d].error > enough * largest_of(out[d].value)) || out[d].error > smooth * before[d]);  // the law jumps
      before[d] = out[d].error;
    }
    if (done || 2 * n > most) return out;
  }
}

void solve_by_algebra(const Scene& scene, const Model& model, const Assembly& assembly, const Listeners& listeners, Inverse& out) {
  Run& run = out.run;
  run.warnings = model.warnings;
  for (const std::string& warning : warnings_of(model, assembly)) run.warnings.push_back(warning);
  Forces forces(model.system, assembly.start);
  std::size_t rows = 0;  // that the listener has taken
  Listeners also = listeners;
  if (listeners.rows)
    also.rows = [&](const Table& trajectory, const auto&... others) {
      rows += trajectory.rows();
      listeners.rows(trajectory, others...);
    };
  follow(
      scene, model, forces.motion(), [&](double t) { return forces.advance(t); }, also, run);
  if (run.status == Status::failed && run.reason.empty())
    run.reason = "t = " + number_text(forces.motion().state().t, 9) + " s: the forces there are not finite; " +
                 explain_signals(scene, model, assembly.start, forces.motion().state());
  const double begin = processor_time();
  if (run.t_end > 0 && !ended_short(run)) out.drivers = find_efforts(model, assembly, rows + run.trajectory.rows() - 1, run.t_end);
  run.seconds += processor_time() - begin;
}

// Efforts are recorded at the run's animation frames, taken more often, whether frames are drawn or not.
void integrate(Scene scene, const Model& model, const Assembly& assembly, const Listeners& listeners, Inverse& out) {
  constexpr int least = 4096;
  const bool drawn = scene.output.frames > 1;
  const int between = drawn ? std::max(1, least / (scene.output.frames - 1)) : least;
  scene.output.frames = between * (drawn ? scene.output.frames - 1 : 1) + 1;
  Listeners also = listeners;
  int k = 0;
  also.frame = [&](const State& state, const Equations& eq) {
    add_efforts(model.system, state.t, eq, out.drivers);
    if (drawn && listeners.frame && k % between == 0) listeners.frame(state, eq);
    ++k;
  };
  out.run = simulate(scene, model, steady_start(model, assembly), also);
  for (DriverEffort& e : out.drivers) e.error = spline_error(e);
}

}  // namespace

Inverse inverse(const Scene& scene, const Model& model, const Assembly& assembly, const Listeners& listeners) {
  const System& system = model.system;
  Inverse out;
  out.drivers = named_efforts(system);
  if (out.drivers.empty())
    throw SceneError(scene.file, {0, "drivers"},
                     "there is no driver, so no torque or force to find; add for example motor: {angle: [ground, crank], law: 10 rad/s*t}");
  const bool bends = system.n() > system.n_rigid();
  const int open = system.n() - assembly.rank;
  out.by_algebra = !bends && system.contacts.empty() && system.frictions.empty() && system.n_x() == 0 && open <= 0;
  if (out.by_algebra) {
    out.how = "algebraically: the drivers determine every degree of freedom";
    solve_by_algebra(scene, model, assembly, listeners, out);
    return out;
  }
  const std::string why = bends                       ? "bodies are flexible"
                          : n_clearances(system) > 0  ? "clearances leave degrees of freedom"
                          : !system.contacts.empty()  ? "profiles may touch"
                          : !system.frictions.empty() ? "friction in joints depends on the history"
                          : open > 0                  ? std::to_string(open) + " degree(s) of freedom not driven"
                          : !system.states.empty()    ? "states of the scene depend on the history"
                                                      : "springs in series with dampers depend on the history";
  out.how = "integrated forward with the drivers as constraints: " + why;
  integrate(scene, model, assembly, listeners, out);
  return out;
}

}  // namespace pintle
