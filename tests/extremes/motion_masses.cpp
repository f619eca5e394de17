// Masses: unlike ones, light ones on stiff springs, many of them.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include <Eigen/Dense>

#include "tests/extremes/motion.h"
#include "tests/oracles/pendulum.h"

namespace extremes {

namespace po = pintle_oracle;

namespace {

constexpr double pi = std::numbers::pi;

/// Two rods of 1 m, hinged in a chain, released level; the second of mass m.
std::string double_pendulum(double m, const std::string& method) {
  return with(R"(gravity: [0, -9.81]
bodies:
  a: {rigid: {mass: 1, inertia: 0.01}, points: {O: [-0.5, 0], P: [0.5, 0]}}
  b: {rigid: {mass: {m}, inertia: {J}}, points: {P: [-0.5, 0]}}
joints: {A: {revolute: [ground, a.O]}, B: {revolute: [a.P, b.P]}}
start: {a: {angle: 0}, b: {angle: 0}}
run: {until: 1, method: {method}}
output: {every: 0.1}
)",
              {{"m", number(m)}, {"J", number(0.01 * m)}, {"method", method}});
}

Finding as_minimal_coordinates(double m, const std::string& method, double bound) {
  const Attempt a = attempt(double_pendulum(m, method));
  if (!a.whole()) return ended(a);
  const po::DoublePendulum oracle{9.81, {1, m}, {0.5, 0.5}, {0.01, 0.01 * m}, 1};
  const auto end = po::evaluate(oracle, {pi / 2, pi / 2, 0, 0}, 1);
  return measured(a, std::max(apart(a.last("a.angle") + pi / 2, end[0]), apart(a.last("b.angle") + pi / 2, end[1])), bound);
}

}  // namespace

Axis mass_ratio() {
  Axis axis{"mass ratio",
            "Two rods in a chain, released level in gravity; mass of the second over that of the first.",
            "both angles after 1 s against minimal coordinates [rad].",
            "a hundred times the tolerance of 1e-8; of generalised-alpha what its own error is, 1e-4.",
            {}};
  for (const double m : {1e-30, 1e-12, 1e-8, 1e-4, 1.0, 1e4, 1e8})
    axis.cases.push_back({m, printed("%g", m), "", End::finished, "", [m] { return as_minimal_coordinates(m, "auto", 1e-6); }});
  for (const double m : {1e12, 1e30})
    axis.cases.push_back({m, printed("%g", m), "generalized-alpha", End::finished, "",
                          [m] { return as_minimal_coordinates(m, "generalized-alpha", 1e-4); }});
  for (const double m : {1e12, 1e16, 1e30})
    axis.cases.push_back(past(m, printed("%g", m), "", End::stopped, "take method: generalized-alpha", double_pendulum(m, "auto")));
  return axis;
}

Axis inertia_ratio() {
  Axis axis{"inertia over mass times distance squared",
            "A pendulum whose mass is nearly a point: its inertia about the mass centre over m l².",
            "angles against Jacobi's elliptic functions [rad].",
            "a hundred times the tolerance of 1e-8; of generalised-alpha 1e-4.",
            {}};
  for (const double j : {1e2, 1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12})
    axis.cases.push_back({j, printed("%g", j), "", End::finished, "", [j] {
                            const Rod rod{.inertia = j};
                            const Attempt a = attempt(text(rod));
                            return a.whole() ? measured(a, off_the_pendulum(a, rod), 1e-6) : ended(a);
                          }});
  for (const double j : {1e-12, 1e-16, 1e-30})
    axis.cases.push_back({j, printed("%g", j), "generalized-alpha", End::finished, "", [j] {
                            const Rod rod{.inertia = j, .method = "generalized-alpha"};
                            const Attempt a = attempt(text(rod));
                            return a.whole() ? measured(a, off_the_pendulum(a, rod), 1e-4) : ended(a);
                          }});
  for (const double j : {1e-16, 1e-30})
    axis.cases.push_back(past(j, printed("%g", j), "", End::stopped, "take method: generalized-alpha", text(Rod{.inertia = j})));
  return axis;
}

Axis driven_mass_ratio() {
  Axis axis{"mass ratio, in a loop",
            "A slider-crank without gravity, crank and coupler of 1 kg; mass of the slider over theirs.",
            "the energy books, over the energy in play.",
            "1e-4: near dead centres a heavy slider amplifies a hundredfold what the tolerance of 1e-8 leaves.",
            {}};
  const auto scene = [](double m, const std::string& method) {
    return with(R"(bodies:
  crank:   {rigid: {mass: 1, inertia: 1.0e-4}, points: {A: [50 mm, 0]}}
  coupler: {rigid: {mass: 1, inertia: 2.5e-4, center: [60 mm, 0]}, points: {A: [0, 0], B: [120 mm, 0]}}
  slider:  {rigid: {mass: {m}, inertia: 1.0e-4}}
joints:
  main bearing: {revolute: [ground, crank]}
  crank pin:    {revolute: [crank.A, coupler.A]}
  gudgeon pin:  {revolute: [coupler.B, slider]}
  guide: {prismatic: [ground, slider]}
start: {crank: {angle: 1, speed: 10}}
run: {until: 1, method: {method}}
output: {every: 0.01}
)",
                {{"m", number(m)}, {"method", method}});
  };
  for (const double m : {1e-12, 1e-8, 1.0, 1e8})
    axis.cases.push_back({m, printed("%g", m), "", End::finished, "", [=] {
                            const Attempt a = attempt(scene(m, "auto"));
                            return a.whole() ? measured(a, a.open_books(), 1e-4) : ended(a);
                          }});
  for (const double m : {1e-16})
    axis.cases.push_back({m, printed("%g", m), "generalized-alpha", End::finished, "", [=] {
                            const Attempt a = attempt(scene(m, "generalized-alpha"));
                            return a.whole() ? measured(a, a.open_books(), 1e-3) : ended(a);
                          }});
  for (const double m : {1e-30, 1e-16})
    axis.cases.push_back(past(m, printed("%g", m), "", End::stopped, "take method: generalized-alpha", scene(m, "auto")));
  axis.cases.push_back(past(1e16, "1e+16", "", End::stopped, "", scene(1e16, "auto")));
  return axis;
}

Axis light_on_stiff_spring() {
  Axis axis{"mass on a spring of 1e12 N/m",
            "A body held by a spring of 1e12 N/m, displaced by 10 mm; ten periods.",
            "its place against x₀ cos ωt, over x₀.",
            "a hundred times the tolerance of 1e-8, for each of ten periods.",
            {}};
  const auto scene = [](double m, double until, const std::string& more) {
    return with(R"(ground: {points: {S: [-1, 0]}}
bodies: {a: {rigid: {mass: {m}, inertia: {J}}}}
joints: {guide: {prismatic: [ground, a]}}
forces: {s: {spring: [ground.S, a], stiffness: 1e12, free length: 1}}
start: {a: {x: 0.01, vx: 0}}
run: {until: {until}{more}}
output: {every: {every}}
)",
                {{"m", number(m)}, {"J", number(1e-4 * m)}, {"until", number(until)}, {"every", number(until / 10)}, {"more", more}});
  };
  for (const double m : {1e3, 1.0, 1e-3, 1e-9, 1e-12, 1e-30})
    axis.cases.push_back({m, printed("%g kg", m), "", End::finished, "", [=] {
                            const double w = std::sqrt(1e12 / m);
                            const Attempt a = attempt(scene(m, 10.25 * 2 * pi / w, ""));
                            if (!a.whole()) return ended(a);
                            const auto t = a.column("t"), x = a.column("a.x");
                            double worst = 0;
                            for (std::size_t i = 0; i < t.size(); ++i)
                              worst = std::max(worst, apart(x[i], 0.01 * std::cos(w * t[i]), 0.01));
                            return measured(a, worst, 1e-5);
                          }});
  axis.cases.push_back(past(1e-9, "1e-09 kg", "a run of 1 s", End::stopped, "max steps reached", scene(1e-9, 1, ", max steps: 20000")));
  axis.cases.push_back(past(1e-30, "1e-30 kg", "a run of 1 s", End::stopped, "the step became too small", scene(1e-30, 1, "")));
  return axis;
}

namespace {

/// n equal uniform rods of together 1 m and 1 kg, hung up; rod i displaced by the angle angle(i).
template <class Angle>
std::string chain(int n, double until, Angle angle) {
  const double l = 1.0 / n, m = 1.0 / n;
  std::ostringstream s;
  s.precision(17);
  s << "gravity: [0, -9.81]\nbodies:\n";
  double x = 0, y = 0;
  std::ostringstream start;
  start.precision(17);
  for (int i = 0; i < n; ++i) {
    const double a = -pi / 2 + angle(i), dx = l * std::cos(a), dy = l * std::sin(a);
    s << " b" << i << ": {rigid: {mass: " << m << ", inertia: " << m * l * l / 12 << "}, points: {t: [" << -l / 2 << ", 0], e: [" << l / 2
      << ", 0]}, pose: {at: [" << x + dx / 2 << ", " << y + dy / 2 << "], angle: " << a << "}}\n";
    start << " b" << i << ": {angle: " << a << "}\n";
    x += dx, y += dy;
  }
  s << "joints:\n";
  for (int i = 0; i < n; ++i)
    s << " j" << i << ": {revolute: [" << (i ? "b" + std::to_string(i - 1) + ".e" : "ground") << ", b" << i << ".t]}\n";
  s << "start:\n" << start.str() << "run: {until: " << until << "}\noutput: {every: " << until / 4 << "}\n";
  return s.str();
}

/// Bernoulli's chain in its first shape, ω = ½ j₀,₁ √(g/l): the frequency that the first accelerations show, by a quotient of
/// Rayleigh's kind, whose error is of second order in what the links differ from a chain; then the books of a short run.
std::vector<Finding> hanging_chain(int n, double until) {
  constexpr double j01 = 2.404825557695773, small = 2e-3;
  const double l = 1.0 / n;
  const auto slope = [&](int i) {  // −d/ds of J₀(j₀₁ √s), s from the free end, over the link
    const double s0 = 1 - i * l, s1 = s0 - l;
    return small * (std::cyl_bessel_j(0, j01 * std::sqrt(std::max(s1, 0.0))) - std::cyl_bessel_j(0, j01 * std::sqrt(s0))) / l;
  };
  const Attempt a = attempt(chain(n, until, slope), 110);
  if (!a.whole()) return {ended(a)};
  double xa = 0, xx = 0, x = 0;
  const pintle::Table& first = a.run->trajectory;  // its columns, found in one pass: there are many
  for (std::size_t c = 0; c < first.columns(); ++c) {
    if (first.header[c].ends_with(".x [m]")) x = first.data[c], xx += x * x;
    if (first.header[c].ends_with(".ax [m/s^2]")) xa += x * first.data[c];
  }
  const double w2 = 9.81 * j01 * j01 / 4;
  return {measured(a, std::abs(-xa / xx / w2 - 1), 2.0 / (n * static_cast<double>(n)) + 1e-4), measured(a, a.open_books(), 1e-3)};
}

}  // namespace

Axis chain_links() {
  Axis axis{"links of a hanging chain",
            "Uniform rods of together 1 m and 1 kg, hung up, released from the first shape of Bernoulli's chain.",
            "the square of the frequency that accelerations show, against j₀,₁²g/4l (of one rod 3g/2l), relative; the energy books of a "
            "short run.",
            "2/n² for links that are no chain, and 1e-4, for swings are not quite small; books 1e-3.",
            {}};
  axis.cases.push_back(
      {1, "1", "", End::finished, "", [] {
         const Attempt a = attempt(chain(1, 0.1, [](int) { return 1e-4; }));
         return measured(a, std::abs(-a.column("b0.alpha").front() / (a.column("b0.angle").front() + pi / 2) / (1.5 * 9.81) - 1), 1e-6);
       }});
  for (const auto& [n, until] : {std::pair{10, 1.0}, {100, 0.2}, {1000, 0.01}, {10000, 1e-3}})
    axis.cases.push_back({static_cast<double>(n), std::to_string(n), "", End::finished, "",
                          [n = n, until = until] { return worst(hanging_chain(n, until)); }});
  return axis;
}

Axis many_clearances() {
  Axis axis{"clearances at once",
            "So many pucks, each in a bearing of its own, dropped from heights of their own; elastic walls.",
            "times of all first impacts against √(2h/g), relative; the energy books.",
            "1e-7 for times, 1e-5 for books.",
            {}};
  const auto scene = [](int n) {
    std::string s = "gravity: [0, -9.81]\nbodies:\n", joints = "joints:\n", start = "start:\n";
    for (int i = 0; i < n; ++i) {
      const std::string id = std::to_string(i);
      s += " b" + id + ": {rigid: {mass: 0.1, inertia: 1e-5}}\n";
      joints += " j" + id + ": {revolute: [ground, b" + id +
                "], clearance: {radial: 1 mm, bearing radius: 10 mm, bearing: ground, normal: {hertz: {stiffness: 1e9}}}}\n";
      start += " j" + id + ": {eccentricity: [0, " + number(-1e-3 + (i + 1) * 1.5e-3 / n) + "]}\n b" + id + ": {angle: 0, speed: 0}\n";
    }
    return s + joints + start + "run: {until: 0.0179, tolerance: 1e-9}\noutput: {every: 0.00179}\n";
  };
  for (const int n : {1, 20, 200})
    axis.cases.push_back({static_cast<double>(n), std::to_string(n), "", End::finished, "", [=] {
                            const Attempt a = attempt(scene(n));
                            if (!a.whole()) return ended(a);
                            std::vector<double> first(static_cast<std::size_t>(n), -1);
                            for (const pintle::Impact& i : a.run->impacts)
                              if (double& t = first[static_cast<std::size_t>(i.contact)]; t < 0) t = i.begin;
                            double off = 0;
                            for (int i = 0; i < n; ++i)
                              off = std::max(off,
                                             std::abs(first[static_cast<std::size_t>(i)] / std::sqrt(2 * (i + 1) * 1.5e-3 / n / 9.81) - 1));
                            return worst({measured(a, off, 1e-7), measured(a, a.open_books(), 1e-5)});
                          }});
  return axis;
}

}  // namespace extremes
