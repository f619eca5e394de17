#include "framework/run/clearance.h"

#include <cmath>

#include "framework/scene/error.h"
#include "framework/scene/nearest.h"

namespace pintle {

ContactPair contact_of(const Scene& scene, const SceneJoint& j) {
  const auto wrong = [&](const Place& place, const std::string& message) { throw SceneError(scene.file, place, message); };
  const SceneClearance& c = *j.clearance;
  if (j.kind != JointKind::revolute)
    wrong(c.place, "only a revolute joint takes a clearance");
  if (c.bearing != j.a.body && c.bearing != j.b.body)
    wrong(c.place, "bearing: \"" + c.bearing + "\" is neither \"" + j.a.body + "\" nor \"" + j.b.body + "\"." +
                       did_you_mean(c.bearing, std::vector{j.a.body, j.b.body}));
  if (!(c.radial > 0)) wrong(c.place, "radial must be above 0; leave out `clearance` for an ideal joint");
  if (!(c.radial < c.bearing_radius))
    wrong(c.place, "radial clearance must be below the bearing radius, else no journal is left");

  ContactPair pair{};
  pair.gap = {c.bearing_radius - c.radial, c.bearing_radius};
  const SceneNormal& n = c.normal;
  const ImpactFactor* factor = find_impact_factor(n.law);
  if (!factor) {
    std::vector<std::string> known;
    for (const ImpactFactor& f : impact_factors()) known.emplace_back(f.name);
    wrong(n.place, "there is no impact law \"" + n.law + "\"." + did_you_mean(n.law, known));
  }
  if (n.restitution < 0 || n.restitution > 1 || (n.restitution == 0 && !factor->zero_allowed))
    wrong(n.place, "restitution must lie in " + std::string(factor->zero_allowed ? "[0, 1]" : "(0, 1]") + " for " + n.law);
  if (!n.stiffness && n.exponent != 1.5)
    wrong(n.place, "`young` and `poisson` give the stiffness of exponent 1.5; with another exponent give `stiffness`");
  const double k = contact_stiffness(c);
  if (!(k > 0) || !std::isfinite(k))
    wrong(n.place, "no stiffness: give `young` and `poisson`, or `stiffness`");
  pair.normal = {k, n.exponent, factor->chi(n.restitution)};
  if (c.friction && c.friction->coefficient != 0) {
    pair.friction = Ambrosio{c.friction->coefficient, c.friction->v0, c.friction->v1};
    pair.sliding = c.friction->sliding == SlidingSpeed::material ? Sliding::material : Sliding::geometric;
  }
  pair.slowest_impact = n.slowest_impact;
  return pair;
}

double contact_stiffness(const SceneClearance& c) {
  if (c.normal.stiffness) return *c.normal.stiffness;
  const Elasticity& j = c.normal.journal.young > 0 ? c.normal.journal : c.normal.bearing;
  if (!(c.normal.bearing.young > 0)) return 0;
  return hertz_stiffness(c.bearing_radius - c.radial, c.bearing_radius, j.young, j.poisson,
                         c.normal.bearing.young, c.normal.bearing.poisson,
                         c.normal.radii == RadiusConvention::internal);
}

}  // namespace pintle
