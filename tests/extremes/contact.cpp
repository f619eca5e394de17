#include "tests/extremes/contact.h"

#include <cmath>

namespace extremes {

std::string text(const Puck& p) {
  const auto pair = [](const Pair& v) { return "[" + number(v[0]) + ", " + number(v[1]) + "]"; };
  const std::string friction = p.friction.empty() ? "" : ", friction: {" + p.friction + "}";
  return with(R"(gravity: {gravity}
bodies:
  puck: {rigid: {mass: {mass}, inertia: {inertia}}}
joints:
  bush:
    revolute: [ground, puck]
    clearance: {radial: {radial}, bearing radius: {radius}, bearing: ground, normal: {{law}}{friction}}
start: {puck: {angle: 0, speed: {spin}}, bush: {eccentricity: {at}, speed: {velocity}}}
run: {until: {until}, method: {method}, tolerance: {tolerance}{more}}
output: {every: {every}}
)",
              {{"gravity", pair(p.gravity)},
               {"mass", number(puck_mass)},
               {"inertia", number(puck_inertia)},
               {"radial", number(p.clearance)},
               {"radius", number(p.bearing_radius)},
               {"law", p.law},
               {"friction", friction},
               {"spin", number(p.spin)},
               {"at", pair(p.at)},
               {"velocity", pair(p.velocity)},
               {"until", number(p.until)},
               {"method", p.method},
               {"tolerance", number(p.tolerance)},
               {"more", p.more},
               {"every", number(p.every > 0 ? p.every : p.until / 100)}});
}

double off(double ours, double target) { return std::abs(ours / target - 1); }
Finding count_wrong(const Attempt& a, std::size_t wanted) {
  return {a.end, a.said, printed("%zu impacts, not %zu", a.run->impacts.size(), wanted), 0, -1};
}
double depth_under(double force, double stiffness, double exponent) { return std::pow(force / stiffness, 1 / exponent); }

Atlas axes_of_contact() {
  return {radial_clearance(),   contact_stiffness_axis(), restitution_axis(), friction_coefficient(), friction_onset(),    sticking(),
          impact_count(),       impact_speed(),           impact_time(),      deep_start(),           start_at_the_wall(), grazing(),
          clearances_at_once(), coming_to_rest(),         end_at_an_event()};
}

}  // namespace extremes
