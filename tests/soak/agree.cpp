#include "tests/soak/agree.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "framework/build/build.h"
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

/// Where a run ends; nothing if it does not, or takes too long.
std::optional<End> end_of(const System& system, const Scheme& scheme, const State& start, double until, double seconds) {
  const double begin = processor_time();  // not by the clock of a machine that has other things to do
  Integrator run(system, scheme, start);
  End out;
  while (run.failure().empty() && run.state().t < until) {
    if (processor_time() - begin > seconds || !run.advance(until)) return std::nullopt;
    out.fastest = std::max(out.fastest, fastest_rate(system, run.state().y));
    out.implicit = out.implicit || run.implicit();
  }
  if (!run.failure().empty() || !run.state().y.allFinite()) return std::nullopt;
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

}  // namespace

std::string number(double x) {
  std::ostringstream s;
  s << x;
  return s.str();
}

Verdict agreement(const Scene& scene, const Model& model, const Assembly& assembly, double seconds) {
  constexpr double off = 1e-7, other_directions = 10, telling = 0.05;
  const System& system = model.system;
  const double until = scene.run.until;
  const auto skipped = [](const std::string& why) { return Verdict{true, "not compared: " + why, "", 0, 0}; };
  Scene second = scene;
  second.run.constraints = "projection";
  second.run.method = name(model.scheme) == "dopri5" ? "verner87" : "dopri5";
  const Model other = build(second);
  const auto one = end_of(system, model.scheme, assembly.start, until, seconds);
  if (!one) return skipped("the run does not end");
  const auto two = end_of(other.system, other.scheme, State(assembly.start), until, seconds);
  if (!two) return skipped(second.run.method + " does not end");
  double growth = 1;
  for (const double phase : {0.3, 1.9}) {
    State start = assembly.start;
    for (Index i = 0; i < system.n(); ++i) {
      const double way = off * system.scale[i] * std::sin(phase + 12.9898 * static_cast<double>(i + 1));
      start.y[i] += way;
      start.y[system.n() + i] += way * fastest_rate(system, assembly.start.y);
    }
    const auto moved = end_of(system, model.scheme, start, until, seconds);
    if (!moved) return skipped("it does not end from a start that is a little off");
    if (moved->impacts != one->impacts) return skipped("impacts depend on the last digits");
    growth = std::max(growth, apart(system, moved->state.y, one->state.y, one->fastest) / off);
  }
  if (one->impacts != two->impacts && growth > 10) return skipped("impacts depend on the last digits");
  const double within = other_directions * growth * (allowed(*one, scene.run.tolerance) + allowed(*two, scene.run.tolerance)) + 1e-9 * growth;
  if (!(within < telling)) return skipped("errors grow too much");
  const double difference = apart(system, one->state.y, two->state.y, std::max(one->fastest, two->fastest));
  if (difference <= within) return {true, "agrees with another method", number(difference) + " of " + number(within), two->steps, 0};
  return {false, "two methods disagree", name(model.scheme) + " and " + name(other.scheme) + " end " + number(difference) + " apart, " + number(within) + " allowed", 0, 0};
}

}  // namespace soak
