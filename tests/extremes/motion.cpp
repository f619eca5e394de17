#include "tests/extremes/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/oracles/pendulum.h"

namespace extremes {

double apart(double ours, double target, double size) { return std::abs(ours - target) / size; }

Finding stopped_with_books(const Attempt& a, double bound) {
  Finding out = ended(a);
  if (a.run && a.trouble.empty()) out.measured = a.open_books(), out.bound = bound;
  return out;
}

Case past(double value, const std::string& label, const std::string& what, End end, const std::string& says, const std::string& scene) {
  return {value, label, what, end, says, [=] { return ended(attempt(scene)); }};
}

std::string text(const Rod& r) {
  return with(R"(gravity: [0, {gravity}]
bodies:
  rod: {rigid: {mass: 1, inertia: {inertia}}, points: {O: [-1, 0]}}
joints: {hinge: {revolute: [ground, rod.O]}}
start: {rod: {angle: {angle} rad, speed: {speed}}}
run: {until: {until}, tolerance: {tolerance}, method: {method}{more}}
output: {every: {every}}
)",
              {{"gravity", number(-r.gravity)},
               {"inertia", number(r.inertia)},
               {"angle", number(r.angle)},
               {"speed", number(r.speed)},
               {"until", number(r.until)},
               {"tolerance", r.tolerance},
               {"method", r.method},
               {"more", r.more},
               {"every", number(r.every > 0 ? r.every : r.until / 10)}});
}

double off_the_pendulum(const Attempt& a, const Rod& r) {
  constexpr double down = -std::numbers::pi / 2;
  const pintle_oracle::Pendulum oracle{pintle_oracle::equivalent_length(1, r.inertia, 1), r.gravity, r.angle - down};
  const auto t = a.column("t"), angle = a.column("rod.angle");
  double worst = t.empty() ? INFINITY : 0;
  for (std::size_t i = 0; i < t.size(); ++i) worst = std::max(worst, std::abs(angle[i] - down - evaluate(oracle, t[i]).angle));
  return worst;
}

Atlas axes_of_motion() {
  return {rigid_speed(),
          clearance_speed(),
          blade_speed(),
          start_spin(),
          turns(),
          mass_ratio(),
          inertia_ratio(),
          driven_mass_ratio(),
          light_on_stiff_spring(),
          chain_links(),
          many_clearances(),
          slenderness(),
          poisson_ratio(),
          modes_kept(),
          part_stiffness(),
          modal_damping(),
          damping(),
          step_asked(),
          tolerance_axis(),
          gravity_axis(),
          run_length(),
          output_interval(),
          units(),
          flat_starts(),
          dead_centres(),
          assembly_limit()};
}

}  // namespace extremes
