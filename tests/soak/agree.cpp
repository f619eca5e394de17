#include "tests/soak/agree.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "framework/build/build.h"
#include "framework/common/library_threads.h"
#include "framework/common/processor_time.h"
#include "framework/integration/integrator.h"

namespace soak {

using namespace pintle;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

struct End {
  State state;
  double steps = 0, fastest = 0;  ///< fastest rate of the run [1/s]
  std::size_t impacts = 0;
  bool implicit = false;
};

/// What a run may cost; what would come later is left out.
struct Budget {
  double steps, seconds;  ///< [s] of the processor, not of the clock of a machine that has other things to do
};

/// Where a run stands at `until`, or before that where it fails or its budget ends.
End end_of(const System& system, const Scheme& scheme, const State& start, double until, const Budget& budget) {
  const double begin = processor_time();
  Integrator run(system, scheme, start);
  End out;
  while (run.state().t < until && static_cast<double>(run.counts().steps) < budget.steps && processor_time() - begin < budget.seconds) {
    if (!run.advance(until)) break;
    out.fastest = std::max(out.fastest, fastest_rate(system, run.state().y));
    out.implicit = out.implicit || run.implicit();
  }
  out.state = run.state();
  out.steps = static_cast<double>(run.counts().steps);
  out.impacts = run.impacts().size();
  return out;
}

/// Largest difference of the bodies' places and speeds, angles by what they move, over the mechanism's length and `rate`.
double apart(const System& system, const VectorXd& a, const VectorXd& b, double rate) {
  VectorXd reach = VectorXd::Zero(static_cast<Index>(system.bodies.size()));
  for (const Marker& m : system.markers)
    if (m.body != ground) reach[m.body] = std::max(reach[m.body], m.x_BP.norm());
  double worst = 0;
  for (Index i = 0; i < system.n_rigid(); ++i) {
    const double arm = i % 3 == 2 ? reach[i / 3] : 1, s = std::abs(a[system.n() + i] - b[system.n() + i]) / rate;
    worst = std::max(worst, arm * std::max(std::abs(a[i] - b[i]), s) / system.length);
  }
  return worst;
}

/// What a run may err by if errors did not grow. Each step of an explicit pair errs by the tolerance at the most; a run of
/// generalised-α by the tolerance's power ⅔, and it takes away what is fast.
double allowed(const End& e, double tolerance) {
  constexpr double implicit_constant = 10;
  return e.implicit ? std::max(e.steps * tolerance, implicit_constant * std::pow(tolerance, 2.0 / 3)) : e.steps * tolerance;
}

/// The same of Moreau's steps h: each impact comes a step late at most, at the fastest rate there is. Between impacts they err by h².
double allowed_of_steps(const End& e, double h) { return h * e.fastest * static_cast<double>(1 + e.impacts); }

struct Ends {
  double until;
  End one, two;
};

/// The same start for another model of the mechanism, which may keep other integrals.
State start_for(const System& system, State start) {
  start.y.conservativeResize(system.z_begin());
  start.y.conservativeResizeLike(VectorXd::Zero(system.n_y()));
  return start;
}

/// Two runs from one start as far as both come for what they may cost. One that does not come to the end is compared a little before,
/// not just where an event or a singular configuration has ended it.
Ends ends_of(const Model& first, const Model& second, const State& start, double until, double seconds) {
  constexpr double short_of_the_end = 0.97;
  const Budget first_budget{1000, seconds / 20}, second_budget{5000, seconds / 10}, enough{1e9, seconds};
  End one = end_of(first.system, first.scheme, start, until, first_budget);
  if (one.state.t < until) until = short_of_the_end * one.state.t;
  const State second_start = start_for(second.system, start);
  End two = end_of(second.system, second.scheme, second_start, until, second_budget);
  if (two.state.t < until) {
    until = short_of_the_end * two.state.t;
    two = end_of(second.system, second.scheme, second_start, until, enough);
  }
  if (one.state.t > until) one = end_of(first.system, first.scheme, start, until, enough);
  return {until, one, two};
}

Verdict skipped(const std::string& why) { return {true, "not compared: " + why, "", 0, 0}; }

/// How much a small difference of the start has grown; nothing if that cannot be told.
std::optional<double> growth_of(const Model& model, const State& from, const End& one, double until, double seconds, std::string& why) {
  constexpr double off = 1e-7;
  const System& system = model.system;
  double growth = 1;
  for (const double phase : {0.3, 1.9}) {
    State start = from;
    for (Index i = 0; i < system.n(); ++i) {
      const double way = off * system.scale[i] * std::sin(phase + 12.9898 * static_cast<double>(i + 1));
      start.y[i] += way;
      start.y[system.n() + i] += way * fastest_rate(system, from.y);
    }
    const End moved = end_of(system, model.scheme, start, until, {1e9, seconds});
    if (moved.state.t < until) return why = "it does not come as far from a start that is a little off", std::nullopt;
    if (moved.impacts != one.impacts) return why = "impacts depend on the last digits", std::nullopt;
    growth = std::max(growth, apart(system, moved.state.y, one.state.y, one.fastest) / off);
  }
  return growth;
}

/// @returns nothing where errors have grown too much to tell
std::optional<Verdict> compared(const Model& model, const Model& other, const Assembly& assembly, double tolerance, const Ends& ends,
                                double seconds, std::string& why) {
  constexpr double other_directions = 10, telling = 0.05;
  const auto& [until, one, two] = ends;
  const State& start = assembly.start;
  const bool branches = std::ranges::any_of(assembly.redundant, [](const Redundancy& r) { return !r.permanent; });
  if (!one.state.y.allFinite() || !two.state.y.allFinite()) return Verdict{false, "a state that is not finite", "", 0, 0};
  if (one.state.t < until || two.state.t < until) return skipped("a run does not come as far a second time");
  const double step = model.scheme.fixed_step;  // 0: it has none
  const auto growth = step > 0 ? growth_of(other, start_for(other.system, start), two, until, seconds, why)
                               : growth_of(model, start, one, until, seconds, why);
  if (!growth) return std::nullopt;
  if (one.impacts != two.impacts && (step > 0 || *growth > 10)) return why = "impacts depend on the last digits", std::nullopt;
  const double first = step > 0 ? allowed_of_steps(two, step) : allowed(one, tolerance);
  const double within = other_directions * *growth * (first + allowed(two, tolerance)) + 1e-9 * *growth;
  if (!(within < telling)) return why = "errors grow too much", std::nullopt;
  const double rate = std::max(one.fastest, two.fastest), difference = apart(model.system, one.state.y, two.state.y, rate);
  const std::string what = name(model.scheme) + " and " + name(other.scheme) + " end " + number(difference) +
                           " apart at t = " + number(until) + ", " + number(within) + " allowed";
  if (!(difference <= within) && branches) return skipped("it starts where motions branch, which is warned of");
  if (!(difference <= within)) return Verdict{false, "two methods disagree", what, 0, 0};
  const bool moved = apart(model.system, one.state.y, start.y, rate) > 10 * within;
  return Verdict{true, moved ? "agrees with another method" : "agrees, but has hardly moved", what, two.steps, 0};
}

}  // namespace

std::string number(double x) {
  std::ostringstream s;
  s << x;
  return s.str();
}

namespace {

Verdict agreement_of(const Scene& scene, const Model& model, const Assembly& assembly, double seconds) {
  constexpr int spans = 4;
  constexpr double shorter = 0.2;
  Scene second = scene;
  second.run.constraints = "projection";
  second.run.method = name(model.scheme) == "dopri5" ? "verner87" : "dopri5";
  second.run.max_steps = 1'000'000;
  const Model other = build(second);
  std::string why;
  double until = scene.run.until;
  for (int k = 0; k < spans; ++k, until *= shorter) {
    const Ends ends = ends_of(model, other, assembly.start, until, seconds);
    until = ends.until;
    if (!(until > 0)) return skipped("a run does not begin");
    if (auto v = compared(model, other, assembly, scene.run.tolerance, ends, seconds, why)) {
      if (until < scene.run.until) v->outcome += ", over a part of the run";
      return *v;
    }
  }
  return skipped(why);
}

}  // namespace

// Steps that are too long for what is stiff, which Moreau's do not follow, must come to agree as they get shorter.
Verdict agreement(const Scene& scene, const Model& model, const Assembly& assembly, double seconds) {
  constexpr double shorter = 64;
  hold_library_threads();
  const Verdict v = agreement_of(scene, model, assembly, seconds);
  if (v.good || !(model.scheme.fixed_step > 0)) return v;
  Scene finer = scene;
  finer.run.step /= shorter;
  return agreement_of(finer, build(finer), assembly, seconds);
}

}  // namespace soak
