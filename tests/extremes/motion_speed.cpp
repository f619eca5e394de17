// Speed: of a rigid slider-crank, with a clearance, of a blade, of a start, and what many turns leave of an angle.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/extremes/motion.h"

namespace extremes {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double rpm = 2 * pi / 60;

/// A slider-crank in no gravity, its crank at `spin` at the outer dead centre.
std::string slider_crank(double spin, double turns, const std::string& clearance) {
  const double until = turns * 2 * pi / spin;
  return with(R"(bodies:
  crank:   {rigid: {mass: 0.30, inertia: 1.0e-4}, points: {A: [50 mm, 0]}}
  coupler: {rigid: {mass: 0.21, inertia: 2.5e-4, center: [60 mm, 0]}, points: {A: [0, 0], B: [120 mm, 0]}}
  slider:  {rigid: {mass: 0.14, inertia: 1.0e-4}}
joints:
  main bearing: {revolute: [ground, crank]}
  crank pin:    {revolute: [crank.A, coupler.A]}
  gudgeon pin:  {revolute: [coupler.B, slider]{clearance}}
  guide: {prismatic: [ground, slider]}
start: {crank: {angle: 0, speed: {spin}}}
run: {until: {until}}
output: {every: {every}}
)",
              {{"clearance", clearance}, {"spin", number(spin)}, {"until", number(until)}, {"every", number(until / 100)}});
}

/// Inertia of that mechanism about its crank, kinetic energy over ½ of the crank's speed squared [kg m²].
double inertia(double angle) {
  constexpr double r = 0.05, l = 0.12;
  const double s = std::sin(angle), c = std::cos(angle);
  const double sin_f = r * s / l, cos_f = std::sqrt(1 - sin_f * sin_f), f = r * c / (l * cos_f);  // coupler at −φ, dφ/dθ = f
  const double slider = -r * s - l * sin_f * f, x = -r * s - l / 2 * sin_f * f, y = r * c - l / 2 * cos_f * f;
  return 1e-4 + 0.21 * (x * x + y * y) + 2.5e-4 * f * f + 0.14 * slider * slider;
}

/// Energy gives the crank's speed at each angle, a quadrature the time it takes: the worse of both, relative.
double off_by_energy(const Attempt& a, double spin) {
  const auto t = a.column("t"), angle = a.column("crank.angle"), speed = a.column("crank.speed");
  double worst = t.empty() ? INFINITY : 0, time = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    worst = std::max(worst, std::abs(speed[i] / spin * std::sqrt(inertia(angle[i]) / inertia(0)) - 1));
    if (i == 0) continue;
    constexpr int parts = 40;  // Simpson
    const double h = (angle[i] - angle[i - 1]) / parts;
    double sum = 0;
    for (int k = 0; k <= parts; ++k) sum += (k == 0 || k == parts ? 1 : k % 2 ? 4 : 2) * std::sqrt(inertia(angle[i - 1] + k * h));
    time += sum * h / 3 / std::sqrt(inertia(0));
    worst = std::max(worst, std::abs(time / (spin * t[i]) - 1));
  }
  return worst;
}

}  // namespace

Axis rigid_speed() {
  Axis axis{"speed, rigid",
            "The slider-crank of the paper, its pins ideal, spun up at the outer dead centre and left alone for two turns' time.",
            "speed of the crank at each of its angles by conservation of energy, and the times at which it passes them by a quadrature; "
            "closed forms of the kinematics. The worse, relative.",
            "a hundred times the tolerance of 1e-8.",
            {}};
  for (const double n : {1e-9, 1e-3, 1.0, 1e3, 1e4, 1e5, 1e7, 1e12, 1e30})
    axis.cases.push_back({n, printed("%g rpm", n), "", End::finished, "", [n] {
                            const Attempt a = attempt(slider_crank(n * rpm, 2, ""));
                            return a.whole() ? measured(a, off_by_energy(a, n * rpm), 1e-6) : ended(a);
                          }});
  axis.cases.push_back(past(1e100, "1e100 rpm", "", End::stopped, "beyond what a double holds", slider_crank(1e100 * rpm, 2, "")));
  axis.cases.push_back(past(1e160, "1e160 rpm", "", End::stopped, "beyond what a double holds", slider_crank(1e160 * rpm, 2, "")));
  return axis;
}

Axis clearance_speed() {
  Axis axis{
      "speed, with a clearance",
      "The same with a clearance of 10 µm in the gudgeon pin, steel on steel, Lankarani and Nikravesh's law; a third of a turn's time.",
      "the energy books, over the energy in play.",
      "a thousand times the tolerance of 1e-8: an error for every impact and rebound.",
      {}};
  const std::string pin =
      ", clearance: {radial: 10 um, bearing radius: 10 mm, bearing: slider, "
      "normal: {lankarani-nikravesh: {restitution: 0.8, young: 207 GPa, poisson: 0.3}}}";
  for (const double n : {1.0, 1e2, 1e3, 1e4, 1e5})
    axis.cases.push_back({n, printed("%g rpm", n), "", End::finished, "", [n, pin] {
                            const Attempt a = attempt(slider_crank(n * rpm, 0.3, pin));
                            return a.whole() ? measured(a, a.open_books(), 1e-5) : ended(a);
                          }});
  for (const double n : {1e7, 1e12})
    axis.cases.push_back({n, printed("%g rpm", n), "", End::warned, "no contact law holds there", [n, pin] {
                            const Attempt a = attempt(slider_crank(n * rpm, 0.3, pin));
                            return a.whole() ? measured(a, a.open_books(), 1e-5) : ended(a);
                          }});
  return axis;
}

namespace {

constexpr double blade_length = 0.05, blade_young = 2e11, blade_density = 7850;

/// A short steel blade on a shaft that turns steadily, damped critically until it stands still in its frame.
std::string blade(double spin, double until) {
  return with(R"(bodies:
  blade:
    beam: {from: root, to: tip, section: {rectangle: [5 mm, 5 mm]}, theory: euler, young: 200 GPa, poisson: 0.3, density: 7850, elements: 6}
    points: {root: [0, 0], tip: [50 mm, 0]}
    modes: {frame: {tangent: root}, keep: all}
    damping: {ratios: 1}
    stiffening: rotation
joints: {shaft: {revolute: [ground, blade.root]}}
drivers: {motor: {angle: [ground, blade.root], law: "{spin}*t"}}
run: {until: {until}}
output: {points: [blade.tip], every: {every}}
)",
              {{"spin", number(spin)}, {"until", number(until)}, {"every", number(until / 10)}});
}

}  // namespace

Axis blade_speed() {
  Axis axis{"speed, flexible",
            "A steel blade of 50 mm on a shaft that turns steadily; all of its modes, critically damped, `stiffening: rotation`.",
            "how far its tip moves out, against the closed form of a linear bar, tan(kL)/k − L with k = Ω√(ρ/E); relative.",
            "1e-4: a bar that stretches without turning stays linear, and six elements err by (kL/6)²/12.",
            {}};
  const double until = 4e-3;
  for (const double n : {1e2, 1e3, 1e4, 3e4, 1e5})
    axis.cases.push_back({n, printed("%g rpm", n), "", End::finished, "", [=] {
                            const Attempt a = attempt(blade(n * rpm, until));
                            const double k = n * rpm * std::sqrt(blade_density / blade_young);
                            if (!a.whole()) return ended(a);
                            return measured(a, std::abs(a.last("blade.tip.ux") / (std::tan(k * blade_length) / k - blade_length) - 1),
                                            1e-4);
                          }});
  axis.cases.push_back(past(1e6, "1e6 rpm", "", End::stopped, "the step became too small", blade(1e6 * rpm, 2e-3)));
  return axis;
}

Axis start_spin() {
  Axis axis{"spin at the start",
            "A rod hinged to the ground, in no gravity, spinning steadily for a thousand radians and for 3e5.",
            "its angle, ωt: relative.",
            "a hundred times the tolerance of 1e-8; of 3e5 rad, run at 1e-6, a thousand times.",
            {}};
  for (const double w : {1.0, 1e3, 1e6, 1e9})
    axis.cases.push_back({w, printed("%g rad/s", w), "", End::finished, "", [w] {
                            const Attempt a = attempt(text(Rod{.gravity = 0, .speed = w, .until = 1000 / w}));
                            return a.whole() ? measured(a, apart(a.last("rod.angle"), 1000, 1000), 1e-6) : ended(a);
                          }});
  axis.cases.push_back({1e6, "1e6 rad/s", "3e5 rad", End::finished, "", [] {
                          const Attempt a =
                              attempt(text(Rod{.gravity = 0, .speed = 1e6, .until = 0.3, .tolerance = "1e-6", .method = "verner87"}));
                          return a.whole() ? measured(a, apart(a.last("rod.angle"), 3e5, 3e5), 1e-3) : ended(a);
                        }});
  return axis;
}

Axis turns() {
  Axis axis{"turns gone by",
            "The same from an angle that stands for so many turns gone by, for ten radians more.",
            "how far it turns, of ten radians: relative.",
            "a hundred times the tolerance, and four times the spacing of doubles there.",
            {}};
  for (const double angle : {0.0, 1e3, 1e5, 1e6, 1e7})
    axis.cases.push_back({angle, printed("%g rad", angle), "", End::finished, "", [angle] {
                            const Attempt a = attempt(text(Rod{.gravity = 0, .angle = angle, .speed = 10, .until = 1}));
                            return a.whole() ? measured(a, apart(a.last("rod.angle") - angle, 10, 10), 1e-6 + 4 * 2.2e-16 * angle)
                                             : ended(a);
                          }});
  for (const double angle : {1e9, 1e12, 1e15})
    axis.cases.push_back(past(angle, printed("%g rad", angle), "", End::stopped, "begin again from this state with angles in one turn",
                              text(Rod{.gravity = 0, .angle = angle, .speed = 10, .until = 1})));
  return axis;
}

}  // namespace extremes
