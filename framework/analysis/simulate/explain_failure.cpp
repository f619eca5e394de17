#include "framework/analysis/simulate/explain_failure.h"

#include <algorithm>
#include <cmath>

#include "framework/analysis/simulate/explain_cams.h"
#include "framework/build/laws.h"
#include "framework/common/text.h"
#include "framework/configuration/redundancy.h"
#include "framework/configuration/unsound_laws.h"
#include "framework/dynamics/model/reach.h"

namespace pintle {

namespace {

/// Bodies with the least and the greatest effective mass against a force, in translation or rotation.
struct Unlike {
  std::size_t light = 0, heavy = 0;
  double ratio = 1;
};
Unlike most_unlike(const System& system) {
  double least = INFINITY, most = 0;
  Unlike out;
  const std::vector<double> reach = reaches(system);
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const Body& body = system.bodies[b];
    const double turning = reach[b] > 0 ? body.J / (reach[b] * reach[b]) : body.m;
    if (const double low = std::min(body.m, turning); low < least) least = low, out.light = b;
    if (const double high = std::max(body.m, turning); high > most) most = high, out.heavy = b;
  }
  out.ratio = most / least;
  return out;
}

std::string explain_numbers(const System& system, const Integrator& integrator) {
  constexpr double many = 1e6, few = 1e-9, unlike = 1e6;  // radians; relative to a pivot; ratio
  const Eigen::Index n = system.n();
  if (!std::isfinite(integrator.last().to.dy.segment(n, n).squaredNorm()))
    return "numbers beyond what a double holds: check masses, lengths, speeds and units";
  if (integrator.failure().find("max steps") != std::string::npos) return "";
  double angle = 0;
  for (std::size_t b = 0; b < system.bodies.size(); ++b)
    angle = std::max(angle, std::abs(integrator.state().y[3 * static_cast<Eigen::Index>(b) + 2]));
  if (angle > many)
    return "an angle has reached " + number_text(angle, 3) + " rad, whose last digit moves points by " +
           number_text(angle * 2.2e-16 * system.length, 3) + " m; begin again from this state with angles in one turn";
  if (system.n() != system.n_rigid() || system.n_rows() == 0) return "";
  const Unlike bodies = most_unlike(system);
  const bool implicit = integrator.implicit();  // computes joint forces without inverting the masses
  const double kept = implicit ? 1 : integrator.sampled().schur.kept();
  constexpr double hopeless = 1e12;  // the lighter body is lost in rounding beside the heavier
  if (!(bodies.ratio > unlike && (kept < few || bodies.ratio > hopeless))) return "";
  const std::string leaves = implicit ? "" : ", which leaves " + number_text(kept, 3) + " of what the joint forces are found from";
  const std::string otherwise = implicit ? "" : ", or take method: generalized-alpha";
  if (bodies.light == bodies.heavy)
    return "the mass of \"" + system.bodies[bodies.light].name +
           "\" and its inertia, over the square of the distance at which it is held, differ by a factor of " +
           number_text(bodies.ratio, 3) + leaves + "; correct the larger or the smaller of them (check their units)" + otherwise;
  return "the inertia of \"" + system.bodies[bodies.light].name + "\" is " + number_text(1 / bodies.ratio, 3) + " of that of \"" +
         system.bodies[bodies.heavy].name + "\", at its centre or turning about it" + leaves + "; give \"" +
         system.bodies[bodies.light].name +
         "\" a mass and an inertia nearer to the others', which hardly affects the motion if they remain small compared with what it "
         "carries" +
         otherwise;
}

std::string explain_state(const Scene& scene, const System& system, Integrator& integrator) {
  const State at = integrator.state();
  State sampled;
  integrator.sample(at.t, sampled);
  if (std::string law = explain_laws(scene, at.t); !law.empty()) return law;
  if (!at.y.allFinite()) return explain_numbers(system, integrator);
  const std::string pose = explain_pose(system, at.t, at.y);
  return pose.empty() ? explain_numbers(system, integrator) : pose;
}

}  // namespace

std::string explained_failure(const Scene& scene, const Model& model, const State& start, Integrator& integrator,
                              const std::string& otherwise) {
  const std::string& failure = integrator.failure();
  for (const State& tried : {integrator.last().to.state, integrator.state()})
    for (const std::string& why : {explain_cams(scene, model, tried), explain_signals(scene, model, start, tried)})
      if (!why.empty()) return why + " (" + failure + ")";
  std::string why = explain_state(scene, model.system, integrator);
  if (why.empty()) why = otherwise;
  return why.empty() ? failure : failure + "; " + why;
}

}  // namespace pintle
