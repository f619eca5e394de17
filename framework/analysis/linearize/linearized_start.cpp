// Start of a linearisation: flexible bodies of a steadily rotating mechanism in their steady deformation.
#include <algorithm>
#include <cmath>

#include "framework/analysis/kinematics/inverse.h"
#include "framework/analysis/linearize/linearize.h"
#include "framework/bodies/elastic_parts.h"
#include "framework/common/text.h"

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// The largest deflection, relative to body size, if the bodies followed the forces of the start statically.
double bending_left(const Model& model, const State& start, std::string& body) {
  const System& system = model.system;
  Equations eq(system);
  VectorXd dy(system.n_y());
  double most = 0;
  if (!evaluate(system, start, eq, dy)) return most;
  for (const BendingProbe& p : model.bending) {
    const auto b = static_cast<std::size_t>(p.index);
    const VectorXd eta =
        eq.a.segment(system.eta_begin[b], system.bodies[b].modes()).cwiseQuotient(system.bodies[b].flex->omega.cwiseAbs2());
    const VectorXd u = p.displacement * eta;
    for (Index i = 0; i + 1 < u.size(); i += 2)
      if (const double part = u.segment<2>(i).norm() / p.size; part > most) most = part, body = p.body;
  }
  return most;
}

/// Flexible bodies are at rest in axes that rotate with the mechanism: no modal acceleration, constant spins.
bool steady(const System& system, const State& state) {
  constexpr double rest = 1e-6;
  Equations eq(system);
  VectorXd dy(system.n_y());
  if (!evaluate(system, state, eq, dy)) return false;
  const Index n = system.n();
  double fastest = 0;
  for (std::size_t b = 0; b < system.bodies.size(); ++b) fastest = std::max(fastest, std::abs(state.y[n + 3 * static_cast<Index>(b) + 2]));
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const Index spin = 3 * static_cast<Index>(b) + 2;
    if (std::abs(eq.a[spin]) > rest * fastest * fastest) return false;
    for (Index i = system.eta_begin[b]; i < system.eta_begin[b + 1]; ++i)
      if (std::abs(eq.a[i]) > rest * fastest * fastest * system.scale[i]) return false;
  }
  return true;
}

}  // namespace

LinearizedStart linearized_start(const Scene& scene, const Model& model, const Assembly& assembly) {
  constexpr double nothing = 1e-9;
  const System& system = model.system;
  const Index n = system.n();
  LinearizedStart out{assembly.start, ""};
  if (n == system.n_rigid() || assembly.start.y.segment(n, n).isZero(0)) return out;
  std::string body;
  const double left = bending_left(model, assembly.start, body);
  if (!(left > nothing)) return out;
  const State there = steady_start(model, assembly).start;
  if (steady(system, there)) {
    out.note =
        "flexible bodies start with the deflection of steady rotation, \"" + body + "\" by " + number_text(100 * left) + " % of its size";
    out.state = there;
  } else {
    out.note = "flexible bodies start undeformed, although loads bend them (\"" + body + "\" by some " + number_text(100 * left) +
               " % of its size), so the roots are those without this deflection; linearize at a later time with --at, when damping has "
               "brought the bodies to rest, or hold the spin with a driver" +
               (scene.has_run ? "" : " (needs `run`)");
  }
  return out;
}

}  // namespace pintle
