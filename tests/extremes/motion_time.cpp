// Time and numbers: dampers, steps, tolerances, gravity, lengths of runs, outputs, units.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/extremes/motion.h"

namespace extremes {

namespace {

constexpr double sideways = -1.5;  // [rad] near the lowest place, which is −π/2

Finding as_a_pendulum(const Rod& rod, double bound, double seconds = 60) {
  const Attempt a = attempt(text(rod), seconds);
  return a.whole() ? measured(a, off_the_pendulum(a, rod), bound) : ended(a);
}

}  // namespace

Axis damping() {
  Axis axis{"damping of a spring",
            "A mass of 1 kg on a spring of 1 N/m and a damper, displaced; so much of the critical damping.",
            "its place against the closed form, over the displacement.",
            "1e-6; from 1e12 on 1e-4, for the spring is rounding beside the damper.",
            {}};
  for (const double zeta : {0.0, 1e-12, 1e-3, 0.5, 1.0, 2.0, 1e3, 1e6, 1e9, 1e12, 1e15})
    axis.cases.push_back({zeta, printed("%g", zeta), "", End::finished, "", [zeta] {
                            const Attempt a = attempt(with(R"(ground: {points: {S: [-1, 0]}}
bodies: {a: {rigid: {mass: 1, inertia: 1}}}
joints: {guide: {prismatic: [ground, a]}}
forces: {s: {spring: [ground.S, a], stiffness: 1, damping: {c}, free length: 1}}
start: {a: {x: 0.1, vx: 0}}
run: {until: 20}
output: {every: 1}
)",
                                                           {{"c", number(2 * zeta)}}));
                            if (!a.whole()) return ended(a);
                            const auto t = a.column("t"), x = a.column("a.x");
                            double off = 0;
                            for (std::size_t i = 0; i < t.size(); ++i) {
                              double left = std::exp(-t[i]) * (1 + t[i]);
                              if (zeta < 1) {
                                const double d = std::sqrt(1 - zeta * zeta);
                                left = std::exp(-zeta * t[i]) * (std::cos(d * t[i]) + zeta / d * std::sin(d * t[i]));
                              } else if (zeta > 1) {
                                const double fast = zeta + std::sqrt(zeta * zeta - 1), slow = 1 / fast;
                                left = (fast * std::exp(-slow * t[i]) - slow * std::exp(-fast * t[i])) / (fast - slow);
                              }
                              off = std::max(off, apart(x[i], 0.1 * left, 0.1));
                            }
                            return measured(a, off, zeta < 1e12 ? 1e-6 : 1e-4);
                          }});
  return axis;
}

Axis step_asked() {
  Axis axis{"longest step asked for",
            "A pendulum that swings for 100 s with a period of 2 s; outputs every 10 s.",
            "its angles against Jacobi's elliptic functions [rad].",
            "1e-5: errors of a local 1e-8 over fifty periods; of generalised-alpha 1e-3. A loose tolerance is found out by the energy "
            "books, by generalised-alpha where they leave more than 2 % open (at 1e-2: what they leave).",
            {}};
  const auto rod = [](const std::string& method, const std::string& tolerance, double step) {
    return Rod{
        .angle = sideways, .until = 100, .every = 10, .tolerance = tolerance, .method = method, .more = ", max step: " + number(step)};
  };
  for (const double step : {1e-3, 0.1, 10.0, 1e6})
    axis.cases.push_back(
        {step, printed("%g s", step), "", End::finished, "", [=] { return as_a_pendulum(rod("auto", "1e-8", step), 1e-5); }});
  for (const char* method : {"rkf45", "verner87", "generalized-alpha"})
    axis.cases.push_back(
        {10, "10 s", method, End::finished, "", [=] { return as_a_pendulum(rod(method, "1e-8", 10), method[0] == 'g' ? 1e-3 : 1e-5); }});
  for (const char* method : {"dopri5", "rkf45", "verner87", "generalized-alpha"})
    for (const char* tolerance : {"1e-2", "0.9"}) {
      if (method[0] == 'g' && tolerance[0] == '1') continue;  // below
      axis.cases.push_back(past(10, "10 s", std::string(method) + " at " + tolerance, End::stopped, "tighten run.tolerance",
                                text(rod(method, tolerance, 10))));
    }
  axis.cases.push_back(
      {10, "10 s", "generalized-alpha at 1e-2", End::warned, "joint forces", [=] {  // what it allows itself at any loose tolerance
         const Attempt a = attempt(text(rod("generalized-alpha", "1e-2", 10)));
         return measured(a, a.open_books(), 0.02);
       }});
  axis.cases.push_back(
      past(1e-9, "1e-09 s", "", End::stopped, "max steps reached", text(Rod{.until = 1, .more = ", max step: 1e-9, max steps: 10000"})));
  return axis;
}

Axis tolerance_axis() {
  Axis axis{
      "tolerance",
      "A pendulum released level, 2 s.",
      "its angles against Jacobi's elliptic functions [rad].",
      "a hundred times the tolerance and 1e-11, which rounding leaves; of generalised-alpha, of order two, ten times its power ⅔ and 1e-7.",
      {}};
  for (const char* method : {"dopri5", "rkf45", "verner87", "generalized-alpha"})
    for (const char* tolerance : {"1e-3", "1e-5", "1e-8", "1e-10", "1e-12", "1e-13", "1e-14"}) {
      const double value = std::stod(tolerance);
      const bool implicit = method[0] == 'g';
      if (implicit && (value < 1e-10 || value > 1e-4)) continue;  // a million steps and more; books that do not close
      axis.cases.push_back({value, tolerance, method, End::finished, "", [=] {
                              return as_a_pendulum({.tolerance = tolerance, .method = method},
                                                   implicit ? 10 * std::pow(value, 2.0 / 3) + 1e-7 : 100 * value + 1e-11);
                            }});
    }
  axis.cases.push_back(
      past(1e-2, "1e-2", "dopri5", End::stopped, "tighten run.tolerance", text(Rod{.tolerance = "1e-2", .method = "dopri5"})));
  for (const char* tolerance : {"1e-15", "1e-300"})
    axis.cases.push_back(past(std::stod(tolerance), tolerance, "", End::rejected, "not below 1e-14", text(Rod{.tolerance = tolerance})));
  axis.cases.push_back(past(1, "1", "", End::rejected, "must lie between 0 and 1", text(Rod{.tolerance = "1"})));
  return axis;
}

Axis gravity_axis() {
  Axis axis{"gravity",
            "A pendulum released level, for a period and a half.",
            "its angles against Jacobi's elliptic functions [rad].",
            "a hundred times the tolerance of 1e-8.",
            {}};
  axis.cases.push_back({0, "0", "", End::finished, "", [] {
                          const Attempt a = attempt(text(Rod{.gravity = 0}));
                          return measured(a, std::abs(a.last("rod.angle")), 0);
                        }});
  for (const double g : {1e-12, 1e-3, 9.81, 1e6, 1e12, 1e100})
    axis.cases.push_back(
        {g, printed("%g m/s²", g), "", End::finished, "", [g] { return as_a_pendulum({.gravity = g, .until = 6 / std::sqrt(g)}, 1e-6); }});
  axis.cases.push_back(
      past(1e160, "1e+160 m/s²", "", End::stopped, "beyond what a double holds", text(Rod{.gravity = 1e160, .until = 6e-80})));
  return axis;
}

Axis run_length() {
  Axis axis{"length of a run",
            "A pendulum of 2 s released level; a slow one; a body that flies freely.",
            "angle against the parabola of free fall, or Jacobi's functions [rad]; place against vt, relative.",
            "1e-6 of what it turned; of a long run the local error of 1e-10 times its periods, growing with their square.",
            {}};
  for (const double until : {1e-100, 1e-30, 1e-15, 1e-9, 1e-6})
    axis.cases.push_back({until, printed("%g s", until), "falls", End::finished, "", [until] {
                            const Attempt a = attempt(text(Rod{.until = until}));
                            return a.whole() ? measured(a, std::abs(a.last("rod.angle") / (-0.5 * 9.81 / 1.01 * until * until) - 1), 1e-6)
                                             : ended(a);
                          }});
  for (const double until : {1.0, 1e2, 1e3, 1e4})
    axis.cases.push_back({until, printed("%g s", until), "swings", End::finished, "", [until] {
                            return as_a_pendulum({.angle = sideways, .until = until, .tolerance = "1e-10", .method = "verner87"},
                                                 1e-8 * std::max(1.0, until));
                          }});
  axis.cases.push_back(
      {1e6, "1e+06 s", "swings", End::finished, "",
       [] { return as_a_pendulum({.angle = sideways, .until = 1e6, .tolerance = "1e-10", .method = "verner87"}, 1e-2, 1000); }, true});
  axis.cases.push_back({1e6, "1e+06 s", "swings slowly", End::finished, "", [] {
                          return as_a_pendulum(
                              {.gravity = 9.81e-8, .angle = sideways, .until = 1e6, .tolerance = "1e-10", .method = "verner87"}, 1e-6);
                        }});
  for (const double until : {1e6, 1e100})
    axis.cases.push_back(
        {until, printed("%g s", until), "flies", End::finished, "", [until] {
           const Attempt a = attempt(
               "bodies: {b: {rigid: {mass: 1, inertia: 1}}}\nstart: {b: {x: 0, vx: 2, angle: 0, speed: 3}}\nrun: {until: " + number(until) +
               "}\noutput: {every: " + number(until / 4) + "}\n");
           if (!a.whole()) return ended(a);
           return measured(a, std::max(apart(a.last("b.x"), 2 * until, 2 * until), apart(a.last("b.angle"), 3 * until, 3 * until)), 1e-12);
         }});
  axis.cases.push_back(
      {1e-9, "1e-09 s", "a loose step of a fast mass", End::stopped, "J unexplained", [] {  // books that must not close by default
         return ended(attempt(R"(ground: {points: {S: [-1, 0]}}
bodies: {a: {rigid: {mass: 1, inertia: 1}}}
joints: {guide: {prismatic: [ground, a]}}
forces: {s: {spring: [ground.S, a], stiffness: 1e20, free length: 1}}
start: {a: {x: 1 um, vx: 0}}
run: {until: 10 ns, tolerance: 0.5, method: dopri5}
)"));
       }});
  return axis;
}

Axis output_interval() {
  Axis axis{"interval of outputs",
            "A pendulum released level, 2 s.",
            "all rows against Jacobi's elliptic functions [rad].",
            "a hundred times the tolerance of 1e-8.",
            {}};
  for (const double every : {1e-5, 1e-3, 0.3, 2.0})
    axis.cases.push_back({every, printed("%g s", every), "", End::finished, "", [every] { return as_a_pendulum({.every = every}, 1e-6); }});
  axis.cases.push_back(past(1e-300, "1e-300 s", "", End::rejected, "less than the rounding of the times", text(Rod{.every = 1e-300})));
  axis.cases.push_back(past(1e-12, "1e-12 s", "", End::rejected, "ten million rows", text(Rod{.every = 1e-12})));
  for (const double every : {2.5, 1e300})
    axis.cases.push_back(past(every, printed("%g s", every), "", End::rejected, "longer than the run", text(Rod{.every = every})));
  return axis;
}

namespace {

/// Units of length, mass and time in which a mechanism is told.
struct Units {
  double L = 1, M = 1, T = 1;
};

/// A four-bar with a spring and gravity, its coupler a beam, and a puck in a bearing that rubs: the same in any units.
std::string four_bar(const Units& u, bool flexible) {
  const auto n = [&](double x, double length, double mass, double time) {
    return number(x * std::pow(u.L, length) * std::pow(u.M, mass) * std::pow(u.T, time));
  };
  const std::string coupler =
      flexible ? "beam: {from: B, to: C, section: {rectangle: [" + n(0.02, 1, 0, 0) + ", " + n(0.02, 1, 0, 0) +
                     "]}, young: " + n(1e9, -1, 1, -2) + ", poisson: 0.3, density: " + n(1000, -3, 1, 0) +
                     ", elements: 8}\n    modes: {frame: chord, craig-bampton: {count: 2}}"
               : "rigid: {mass: " + n(0.16, 0, 1, 0) + ", inertia: " + n(2e-3, 2, 1, 0) + ", center: [" + n(0.2, 1, 0, 0) + ", 0]}";
  return with(R"(gravity: [0, {g}]
ground: {points: {A: [0, 0], D: [{d4}, 0], S: [{d4}, {d5}]}}
bodies:
  crank:   {rigid: {mass: {m1}, inertia: {J1}}, points: {A: [0, 0], B: [{d1}, 0]}, pose: {angle: 1}}
  coupler:
    {coupler}
    points: {B: [0, 0], C: [{d2}, 0]}
    pose: {at: [{bx}, {by}], angle: 0.7}
  rocker:  {rigid: {mass: {m1}, inertia: {J1}}, points: {D: [0, 0], C: [{d3}, 0]}, pose: {at: [{d4}, 0], angle: 1.7}}
  puck:    {rigid: {mass: {m1}, inertia: {J1}}}
joints:
  A: {revolute: [ground.A, crank.A]}
  B: {revolute: [crank.B, coupler.B]}
  C: {revolute: [coupler.C, rocker.C]}
  D: {revolute: [ground.D, rocker.D]}
  bearing: {revolute: [ground.S, puck], clearance: {radial: {c}, bearing radius: {R}, bearing: ground,
            normal: {lankarani-nikravesh: {restitution: 0.7, stiffness: {K}, slowest impact: {v}}},
            friction: {ambrosio: {coefficient: 0.1, v0: {v0}, v1: {v1}}}}}
forces: {s: {spring: [ground.S, crank.B], stiffness: {k}, damping: {b}, free length: {d1}}}
start:
  crank: {angle: 1, speed: {w}}
  puck: {angle: 0, speed: 0}
run: {until: {until}}
output: {every: {every}}
)",
              {{"coupler", coupler},        {"g", n(-9.81, 1, 0, -2)},    {"d1", n(0.1, 1, 0, 0)},  {"d2", n(0.4, 1, 0, 0)},
               {"d3", n(0.3, 1, 0, 0)},     {"d4", n(0.4, 1, 0, 0)},      {"d5", n(0.5, 1, 0, 0)},  {"bx", n(0.054, 1, 0, 0)},
               {"by", n(0.084, 1, 0, 0)},   {"m1", n(0.3, 0, 1, 0)},      {"J1", n(1e-3, 2, 1, 0)}, {"c", n(1e-3, 1, 0, 0)},
               {"R", n(1e-2, 1, 0, 0)},     {"K", n(1e8, -0.5, 1, -2)},   {"v", n(1e-6, 1, 0, -1)}, {"v0", n(1e-3, 1, 0, -1)},
               {"v1", n(1e-2, 1, 0, -1)},   {"k", n(50, 0, 1, -2)},       {"b", n(0.1, 0, 1, -1)},  {"w", n(8, 0, 0, -1)},
               {"until", n(0.05, 0, 0, 1)}, {"every", n(0.0025, 0, 0, 1)}});
}

Finding alike_in(const Units& u, bool flexible, double bound) {
  const Attempt unit = attempt(four_bar({}, flexible)), ours = attempt(four_bar(u, flexible));
  if (!ours.whole() || !unit.whole()) return ended(ours.whole() ? unit : ours);
  double off = ours.run->trajectory.rows() == unit.run->trajectory.rows() ? 0 : INFINITY;
  const auto compare = [&](const std::string& column, double of_unit) {
    const auto a = ours.column(column), b = unit.column(column);
    double size = 0;
    for (const double x : b) size = std::max(size, std::abs(x));
    for (std::size_t i = 0; i < b.size(); ++i) off = std::max(off, apart(a[i] / of_unit, b[i], size));
  };
  for (const char* body : {"crank", "coupler", "rocker"}) {
    compare(std::string(body) + ".angle", 1);
    compare(std::string(body) + ".speed", 1 / u.T);
  }
  compare("puck.y", u.L);
  compare("C.fx on rocker", u.M * u.L / (u.T * u.T));
  return measured(ours, off, bound);
}

}  // namespace

Axis units() {
  Axis axis{
      "units",
      "A four-bar with a spring, and a puck that bounces and rubs in a bearing, told in other units of length, mass and time.",
      "angles, speeds, a joint force and the puck's place, without units, against those of the mechanism in metres; relative, all rows.",
      "a hundred times the tolerance of 1e-8: rounding places an impact elsewhere in a step.",
      {}};
  const std::vector<std::pair<const char*, Units>> all{{"nm, 1e-27 kg, ns", {1e-9, 1e-27, 1e-9}},
                                                       {"um, 1e-18 kg, s", {1e-6, 1e-18, 1}},
                                                       {"um, ug, ms", {1e-6, 1e-9, 1e-3}},
                                                       {"mm, t, s", {1e-3, 1e3, 1}},
                                                       {"km, 1e9 kg, s", {1e3, 1e9, 1}},
                                                       {"km, kg, us", {1e3, 1, 1e-6}},
                                                       {"1e12 m, 1e30 kg, 1e8 s", {1e12, 1e30, 1e8}}};
  for (const bool flexible : {false, true})
    for (const auto& [name, u] : all)
      axis.cases.push_back(
          {u.L, name, flexible ? "flexible" : "rigid", End::finished, "", [=, u = u] { return alike_in(u, flexible, 1e-6); }});
  return axis;
}

}  // namespace extremes
