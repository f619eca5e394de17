// Radial clearance, contact stiffness.
#include <algorithm>
#include <cmath>

#include "tests/extremes/contact.h"
#include "tests/oracles/hertz_bounce.h"
#include "tests/oracles/slider_crank_clearance.h"

namespace extremes {

namespace po = pintle_oracle;

namespace {

constexpr double bearing_radius = 0.02;                                // [m]
constexpr double young = 207e9, nu = 0.3;                              // [Pa], –
constexpr double slider_accel = 0.05 * 150 * 150 * (1 + 0.05 / 0.12);  // at the outer dead centre, of the ideal mechanism [m/s²]

/// The paper's slider-crank, a clearance in its gudgeon pin.
std::string slider_crank(double clearance, double until, double tolerance) {
  return with(R"(gravity: [0, -9.81]
bodies:
  crank:   {rigid: {mass: 0.30, inertia: 1.0e-4}, points: {O: [-25 mm, 0], A: [25 mm, 0]}}
  coupler: {rigid: {mass: 0.21, inertia: 2.5e-4}, points: {A: [-60 mm, 0], B: [60 mm, 0]}}
  slider:  {rigid: {mass: 0.14, inertia: 1.0e-4}, points: {P: [0, 0]}}
joints:
  main bearing: {revolute: [ground, crank.O]}
  crank pin:    {revolute: [crank.A, coupler.A]}
  gudgeon pin:
    revolute: [coupler.B, slider.P]
    clearance: {radial: {radial}, bearing radius: {radius}, bearing: slider,
                normal: {lankarani-nikravesh: {restitution: 0.8, young: 207 GPa, poisson: 0.3}}}
  guide: {prismatic: [ground, slider.P]}
start: {crank: {angle: 0, speed: 150}}
run: {until: {until}, tolerance: {tolerance}}
output: {every: {every}}
)",
              {{"radial", number(clearance)},
               {"radius", number(bearing_radius)},
               {"until", number(until)},
               {"tolerance", number(tolerance)},
               {"every", number(until / 200)}});
}

po::Params params(double clearance) {
  po::Params p;
  p.clearance = clearance, p.bearing_radius = bearing_radius;
  p.stiffness = po::hertz_stiffness(bearing_radius - clearance, bearing_radius, young, nu, true);
  p.chi = po::lankarani_nikravesh(0.8);
  return p;
}

/// Through the first impacts, the journal's place in its bearing, over the clearance, against minimal coordinates.
Finding as_minimal_coordinates(double clearance) {
  const double until = 4 * std::sqrt(2 * clearance / slider_accel);
  const Attempt a = attempt(slider_crank(clearance, until, 1e-12));
  if (!a.whole()) return ended(a);
  const po::Params p = params(clearance);
  po::State s = po::start(p);
  po::simulate(p, {.tolerance = 1e-12}, until, s);
  const po::Sample end = po::evaluate(p, s);
  const double apart = std::hypot(a.last("gudgeon pin.ex") - end.e[0], a.last("gudgeon pin.ey") - end.e[1]);
  return measured(a, apart / clearance, clearance < 1e-10 ? 1e3 * 1.1e-16 * 0.12 / clearance : 1e-6);
}

/// Through a third of a turn: the slider's distance from where an ideal pin takes it, over the gap that there is, the overlap under
/// twice the ideal pin's greatest force included.
Finding as_ideal_pin(double clearance) {
  const Attempt a = attempt(slider_crank(clearance, 0.014, 1e-8));
  if (!a.whole()) return ended(a);
  const po::Params p = params(clearance);
  double apart = 0, force = 0;
  const auto t = a.column("t"), x = a.column("slider.x");
  for (std::size_t i = 0; i < t.size(); i += 10) {
    const po::Ideal ideal = po::ideal_at(p, t[i]);
    apart = std::max(apart, std::abs(x[i] - ideal.x));
    force = std::max(force, std::hypot(ideal.pin_force[0], ideal.pin_force[1]));
  }
  return worst({measured(a, apart / (clearance + depth_under(2 * force, p.stiffness)), 5), measured(a, a.open_books(), 1e-5)});
}

}  // namespace

Axis radial_clearance() {
  Axis axis{
      "radial clearance",
      "The paper's slider-crank (150 rad/s, bearing radius 20 mm, stiffness from Young's modulus by the radii) with a clearance in its "
      "gudgeon pin. *Impacts*: from the concentric start through the first impacts. *Limit*: a third of a turn.",
      "*impacts*: the journal's place in its bearing at the end, over the clearance, against a model in minimal coordinates that shares "
      "no "
      "code. *Limit*: the slider's largest distance from the mechanism with an ideal pin, over clearance plus overlap; and the ledger "
      "closes to 1e-5.",
      "1e-6 of the clearance is what the few impacts amplify of two tolerances of 1e-12; below 1 nm a thousand times what "
      "rounding of places of 0.12 m is of it. The slider is away by the gap itself and by the "
      "crank's lag, a few gaps: 5. The ledger: a thousand steps at 1e-8.",
      {}};
  const auto add = [&](double c, const std::string& label, bool in_limit) {
    axis.cases.push_back({.value = c, .label = label, .what = "impacts", .run = [=] { return as_minimal_coordinates(c); }});
    if (in_limit) axis.cases.push_back({.value = c, .label = label, .what = "limit", .run = [=] { return as_ideal_pin(c); }});
  };
  add(1e-9, "1 nm", true);
  add(1e-8, "10 nm", true);
  add(1e-7, "100 nm", true);
  add(1e-6, "1 um", true);
  add(1e-5, "10 um", true);
  add(1e-4, "0.1 mm", true);
  add(1e-3, "1 mm", true);
  add(1e-2, "10 mm", true);
  const auto past = [&](double c, const std::string& label, End end, const std::string& says) {
    axis.cases.push_back({.value = c, .label = label, .what = "", .end = end, .says = says, .run = [=] {
                            return ended(attempt(slider_crank(c, 1e-4, 1e-8)));
                          }});
  };
  past(-1e-6, "-1 um", End::rejected, "radial");
  past(0, "0", End::rejected, "radial");
  past(1e-30, "1e-30 m", End::rejected, "last digit");
  past(1e-18, "1e-18 m", End::rejected, "last digit");
  past(1e-16, "1e-16 m", End::rejected, "rounded");
  past(1e-14, "1e-14 m", End::rejected, "rounded");
  for (const auto& [c, label] : {std::pair{1e-12, "1 pm"}, std::pair{1e-11, "10 pm"}})
    axis.cases.push_back({.value = c, .label = label, .what = "impacts", .end = End::warned, .says = "rounded", .run = [c = c] {
                            return as_minimal_coordinates(c);
                          }});
  past(bearing_radius, "the bearing's radius", End::rejected, "bearing radius");
  past(2 * bearing_radius, "twice the bearing's radius", End::rejected, "bearing radius");
  return axis;
}

namespace {

/// A head-on bounce against its closed form: times, speeds, depth, force, loss. The worst of all, relative.
Finding bounce(double stiffness, double speed, const std::string& method) {
  const Attempt a = attempt(text(Puck{.law = "lankarani-nikravesh: {restitution: 0.8, stiffness: " + number(stiffness) + "}",
                                      .velocity = {speed, 0},
                                      .until = 1.9e-3 / speed + 20 * std::pow(puck_mass / stiffness, 0.4) / std::pow(speed, 0.2),
                                      .method = method}));
  if (!a.whole()) return ended(a);
  const po::Bounce b{.mass = puck_mass, .speed = speed, .stiffness = stiffness, .chi = po::lankarani_nikravesh(0.8)};
  const pintle::Impact& i = a.run->impacts.at(0);
  const double wrong = std::max({off(i.begin, 1e-3 / speed), off(i.approach, speed), off(i.separation, po::restitution(b.chi) * speed),
                                 off(i.end - i.begin, po::duration(b)), off(i.deepest, po::deepest(b)),
                                 off(i.peak_force, po::peak_force(b)), off(i.lost, po::loss(b))});
  const double of_scheme = method == "generalized-alpha" ? 1e-4 : 1e-6;
  return measured(a, wrong, std::max(of_scheme, 1e-14 * 0.01 / po::deepest(b)));
}

}  // namespace

Axis contact_stiffness_axis() {
  Axis axis{"contact stiffness",
            "A puck of 0.4 kg strikes the wall of a bearing (radius 10 mm, clearance 1 mm) head on at 0.1 m/s; Lankarani and Nikravesh's "
            "law, e = 0.8.",
            "of the first impact: beginning, approach, separation, duration, deepest, peak force and loss, each against the closed form "
            "of the law; the worst, relative.",
            "1e-6: depth and force are read off dense output between steps, all else is met to 1e-9. Where the depth itself is but "
            "rounding of places, "
            "ten times the share that 1e-15 of the bearing's radius has in it.",
            {}};
  for (const int decade : {0, 2, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 18, 20, 25, 30, 40, 100}) {
    const double k = std::pow(10.0, decade);
    const bool soft = decade <= 5, hard = decade >= 40;
    axis.cases.push_back({.value = k,
                          .label = printed("1e%d", decade),
                          .end = soft   ? End::warned
                                 : hard ? End::stopped
                                        : End::finished,
                          .says = soft ? "tenth of its radius" : "",
                          .run = [=] { return bounce(k, 0.1, "auto"); }});
  }
  for (const char* method : {"rkf45", "dopri5", "verner87", "generalized-alpha"})
    for (const int decade : {6, 10, 14})
      axis.cases.push_back({.value = std::pow(10.0, decade), .label = printed("1e%d", decade), .what = method, .run = [=] {
                              return bounce(std::pow(10.0, decade), 0.1, method);
                            }});
  for (const auto& [value, label] : std::vector<std::pair<double, std::string>>{{-1, "-1"}, {0, "0"}, {1e300, "1e300 * 1e300"}})
    axis.cases.push_back({.value = value, .label = label, .end = End::rejected, .says = "stiffness", .run = [label = label] {
                            return ended(attempt(text(Puck{.law = "hertz: {stiffness: " + label + "}", .velocity = {0.1, 0}})));
                          }});
  return axis;
}

}  // namespace extremes
