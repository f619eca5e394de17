// Bodies of elements: slender, nearly incompressible, with few and all modes, soft and stiff, damped.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "framework/analysis/natural_modes/natural_modes.h"
#include "framework/analysis/static_case/static_case.h"
#include "framework/scene/error.h"
#include "framework/scene/yaml/reader.h"
#include "tests/extremes/motion.h"

namespace extremes {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double young = 2e11, density = 8000;
constexpr double first_root = 1.875104068711961;  // of 1 + cos x cosh x, the clamped beam's

/// First frequency of a clamped beam of 1 m, its section h high [rad/s].
double clamped_frequency(double h) { return first_root * first_root * h / std::sqrt(12.0) * std::sqrt(young / density); }

/// A beam of 1 m welded to the ground at A; a force at its other end B follows `law`.
struct Cantilever {
  std::string end = "[1, 0]";
  double height = 0.01;  ///< of its section, which is 10 mm wide [m]
  std::string theory = "euler", modes = "{frame: {tangent: A}, craig-bampton: {count: 0}}", damping = "{ratios: 1}", law = "0", more = {};
  double until = 1;
};
std::string text(const Cantilever& c) {
  return with(R"(bodies:
  b:
    beam: {from: A, to: B, section: {rectangle: [{h}, 10 mm]}, young: 200 GPa, poisson: 0.3, density: 8000, theory: {theory}, elements: 20}
    points: {A: [0, 0], B: {end}}
    modes: {modes}
    damping: {damping}
    supports: {A: fixed}
joints: {clamp: {weld: [ground, b.A]}}
forces: {push: {force: [0, "{law}"], at: b.B}}
run: {until: {until}{more}}
output: {points: [b.B], every: {every}}
)",
              {{"end", c.end},
               {"h", number(c.height)},
               {"theory", c.theory},
               {"modes", c.modes},
               {"damping", c.damping},
               {"law", c.law},
               {"until", number(c.until)},
               {"more", c.more},
               {"every", number(c.until / 50)}});
}

/// What judging scene bodies without a run has said, as an Attempt would.
template <class Judge>
Finding judged(const std::string& scene_text, Judge judge) {
  try {
    const pintle::Scene scene = pintle::read_scene_text(scene_text, "scene.yaml");
    const pintle::ElasticBody body = pintle::elastic_body(scene, pintle::elastic_of(scene, ""));
    Finding out = judge(scene, body);
    if (!body.warnings.empty()) out.end = End::warned, out.said = body.warnings.front();
    return out;
  } catch (const pintle::SceneError& e) {
    return {End::rejected, e.what(), "", 0, -1};
  }
}

Finding frequency_of(const Cantilever& c, double bound) {
  return judged(text(c), [&](const pintle::Scene& scene, const pintle::ElasticBody& body) {
    const pintle::ModesReport r = modes_of(scene, body, 1);
    return Finding{End::finished, "", "", std::abs(r.natural.modes.omega[0] / clamped_frequency(c.height) - 1), bound};
  });
}

/// The end pushed by a force that rises over twenty periods of the first shape, over F L³/3EI.
Finding deflection_of(Cantilever c, double bound) {
  const double I = 0.01 * std::pow(c.height, 3) / 12, force = 3 * young * I * 1e-3, rise = 20 * 2 * pi / clamped_frequency(c.height);
  c.until = 1.2 * rise, c.law = number(force) + "*step(t, 0, " + number(rise) + ")";
  const Attempt a = attempt(text(c));
  if (!a.whole()) return ended(a);
  return worst({measured(a, std::abs(a.last("b.B.uy") / 1e-3 - 1), bound), measured(a, a.open_books(), 1e-3)});
}

}  // namespace

Axis slenderness() {
  Axis axis{"slenderness",
            "A clamped beam of 20 elements, length over height of its section; along x, or askew.",
            "its first frequency against Euler's closed form, and in a run its deflection under a force that rises slowly against F "
            "L³/3EI; relative.",
            "1e-6 for Euler's beam, and Timoshenko's what shear and rotary inertia take, 4 (h/L)²; of the run 1e-4, what a slow rise "
            "leaves; to both "
            "what rounding of the stretch leaves of bending, ten times 20 EA L²/3EI units in the last place, of a frequency along x none. "
            "Past 1e5 what is found "
            "differs between processors: a frequency within 1 %, which is what the residual may be, or a refusal.",
            {}};
  const std::string unheld = "more than ten thousand times as long as thick";
  const auto rounding = [](double s) { return 10 * 20 * std::numeric_limits<double>::epsilon() * 4 * s * s; };
  const auto add = [&](double s, const char* what, auto run) {
    Case c{s, printed("%g", s), what, End::finished, "", run};
    if (s > 1e5) c.end = End::warned, c.says = "so slender", c.or_refused = unheld;
    axis.cases.push_back(std::move(c));
  };
  for (const double s : {1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7}) {
    add(s, "Euler", [s] { return frequency_of({.height = 1 / s, .theory = "euler, rotary inertia: false"}, s > 1e5 ? 1e-2 : 1e-6); });
    add(s, "Timoshenko", [s] { return frequency_of({.height = 1 / s, .theory = "timoshenko"}, s > 1e5 ? 1e-2 : 4 / (s * s) + 1e-6); });
  }
  for (const double s : {1e1, 1e2, 1e3, 1e4})
    add(s, "Euler, askew",
        [=] { return frequency_of({.end = "[0.6, 0.8]", .height = 1 / s, .theory = "euler, rotary inertia: false"}, 1e-6 + rounding(s)); });
  axis.cases.push_back(
      {1e5, "1e+05", "Euler, askew", End::rejected, unheld, [] { return frequency_of({.end = "[0.6, 0.8]", .height = 1e-5}, 1); }});
  for (const double s : {1e2, 1e4, 1e5, 1e6}) add(s, "run", [=] { return deflection_of({.height = 1 / s}, 1e-4 + rounding(s)); });
  return axis;
}

Axis poisson_ratio() {
  Axis axis{"Poisson's ratio, plane strain",
            "A link of 1 m, 0.1 m high, clamped, its end pulled across, of 40 × 4 cells; an element that locks says so.",
            "deflection of the end against beam theory, E/(1 − ν²) and shear; relative.",
            "3 %: the clamped end is no beam; of what locks, that it is not softer.",
            {}};
  for (const char* element :
       {"quadrilateral4", "quadrilateral8", "quadrilateral8-reduced", "quadrilateral9", "triangle6", "quadrilateral4-plain", "triangle3"})
    for (const double nu : {0.3, 0.49, 0.4999, 0.499999}) {
      const bool locks = std::string(element) == "quadrilateral4-plain" || std::string(element) == "triangle3";
      if (locks && nu < 0.4) continue;  // there it does not, but bends too little all the same
      axis.cases.push_back({nu, printed("%g", nu), element, locks ? End::warned : End::finished, locks ? "locks" : "", [=] {
                              const std::string scene = with(R"(bodies:
  link:
    plate: {grid: {corners: [[0, 0], [1, 0], [1, 0.1], [0, 0.1]], cells: [40, 4]}, thickness: 1, plane: strain, element: {element},
            young: 1e9, poisson: {nu}, density: 1000}
    points: {tip: [1, 0.05]}
    supports: {left: fixed}
static: {loads: {pull: {traction: [0, 1e3], on: right}}}
)",
                                                             {{"element", element}, {"nu", number(nu)}});
                              return judged(scene, [&](const pintle::Scene& s, const pintle::ElasticBody& body) {
                                const double P = 100, E = 1e9 / (1 - nu * nu), I = 1e-3 / 12, G = 1e9 / (2 * (1 + nu));
                                const double u = P / (3 * E * I) + 6 * P / (5 * G * 0.1), ours = solve_case(s, body).ports.at(0).u.y();
                                return Finding{End::finished, "", "", std::abs(ours / u - 1), locks ? 1 : 0.03};
                              });
                            }});
    }
  axis.cases.push_back(past(0.5, "0.5", "", End::rejected, "must be greater than -1 and less than 0.5", R"(bodies:
  link:
    plate: {grid: {corners: [[0, 0], [1, 0], [1, 0.1], [0, 0.1]], cells: [4, 1]}, thickness: 1, plane: strain, young: 1e9, poisson: 0.5, density: 1000}
run: {until: 1}
)"));
  return axis;
}

Axis modes_kept() {
  Axis axis{"modes kept",
            "A clamped beam of 20 elements in a mechanism, its end pushed by a force that rises slowly.",
            "deflection against F L³/3EI, which the static shapes hold alone and all natural modes together; the energy books.",
            "1e-4, what a slow rise leaves; of books 1e-3.",
            {}};
  for (const int n : {0, 1, 5, 57})
    axis.cases.push_back(
        {static_cast<double>(n), std::to_string(n), "beside the static shapes", End::finished, "",
         [n] { return deflection_of({.modes = "{frame: {tangent: A}, craig-bampton: {count: " + std::to_string(n) + "}}"}, 1e-4); }});
  axis.cases.push_back(
      {60, "all", "natural", End::finished, "", [] { return deflection_of({.modes = "{frame: {tangent: A}, keep: all}"}, 1e-4); }});
  axis.cases.push_back({60, "all", "beside the static shapes", End::finished, "",
                        [] { return deflection_of({.modes = "{frame: {tangent: A}, craig-bampton: {keep: all}}"}, 1e-4); }});
  axis.cases.push_back(past(0, "0", "natural", End::rejected, "at least 1", text(Cantilever{.modes = "{frame: {tangent: A}, count: 0}"})));
  axis.cases.push_back(past(1000, "1000", "natural", End::rejected, "ask for at most this number",
                            text(Cantilever{.modes = "{frame: {tangent: A}, count: 1000}"})));
  axis.cases.push_back(past(0, "0", "below 1e-3 Hz", End::rejected, "", text(Cantilever{.modes = "{frame: mean axes, below: 1e-3 Hz}"})));
  return axis;
}

Axis part_stiffness() {
  Axis axis{"stiffness of a part",
            "The slider-crank of the paper driven at 150 rad/s, its coupler a damped beam of so much Young's modulus; `method: auto`.",
            "place of the slider at all times against the rigid closed form, over the crank; of what bends far, the energy books.",
            "2e-5 from 1e12 Pa on: what generalised-alpha errs by, and the pull in a coupler of 1e12 Pa; of books 1e-3.",
            {}};
  const auto scene = [](double E, const std::string& damping, const std::string& more) {
    return with(R"(bodies:
  crank: {rigid: {mass: 0.3, inertia: 1e-4}, points: {A: [50 mm, 0]}}
  coupler:
    beam: {from: A, to: B, section: {circle: 10 mm}, young: {E}, poisson: 0.3, density: 7850}
    points: {A: [0, 0], B: [120 mm, 0]}
    modes: {frame: chord, craig-bampton: {count: 4}}
    {damping}
  slider: {rigid: {mass: 0.14, inertia: 1e-4}}
joints:
  main bearing: {revolute: [ground, crank]}
  crank pin:    {revolute: [crank.A, coupler.A]}
  gudgeon pin:  {revolute: [coupler.B, slider]}
  guide: {prismatic: [ground, slider]}
drivers: {motor: {angle: [ground, crank], law: "150*t"}}
run: {until: 0.05{more}}
output: {every: 0.5 ms}
)",
                {{"E", number(E)}, {"damping", damping}, {"more", more}});
  };
  const std::string damped = "damping: {ratios: 0.01}";
  for (const double E : {1e5, 1e7, 1e9})
    axis.cases.push_back(
        {E, printed("%g Pa", E), "", E <= 1e7 ? End::stopped : End::warned, "within one body frame, but deformation is assumed small", [=] {
           const Attempt a = attempt(scene(E, damped, ""));
           return a.whole() ? measured(a, a.open_books(), 1e-3) : ended(a);
         }});
  for (const double E : {1e11, 1e12, 1e14, 1e16, 1e18, 1e20})
    axis.cases.push_back({E, printed("%g Pa", E), "", End::finished, "", [=] {
                            const Attempt a = attempt(scene(E, damped, ""));
                            if (!a.whole()) return ended(a);
                            const auto t = a.column("t"), x = a.column("slider.x");
                            double off = 0;
                            for (std::size_t i = 0; i < t.size(); ++i) {
                              const double s = 0.05 * std::sin(150 * t[i]);
                              off = std::max(off, apart(x[i], 0.05 * std::cos(150 * t[i]) + std::sqrt(0.12 * 0.12 - s * s), 0.05));
                            }
                            return measured(a, off, 2e-5 * std::max(1.0, 1e12 / E));
                          }});
  axis.cases.push_back(
      past(1e18, "1e+18 Pa", "undamped", End::stopped, "max steps reached", scene(1e18, "damping: {ratios: 0}", ", max steps: 20000")));
  return axis;
}

Axis modal_damping() {
  Axis axis{"damping of a shape",
            "A clamped beam with its first shape alone, a force put on its end at once.",
            "the end's motion against the damped oscillator's closed form, over its static deflection.",
            "1e-4: twenty elements, and a local error of 1e-8 summed over ten periods.",
            {}};
  for (const double zeta : {0.0, 1e-3, 0.5, 1.0, 2.0, 1e2, 1e4, 1e6})
    axis.cases.push_back({zeta, printed("%g", zeta), "", zeta > 1 ? End::warned : End::finished, zeta > 1 ? "overdamped" : "", [zeta] {
                            Cantilever c{.modes = "{frame: {tangent: A}, count: 1}", .damping = "", .law = "0.1"};
                            const double w = clamped_frequency(c.height), mass = density * 1e-4;
                            c.theory = "euler, rotary inertia: false";
                            c.damping = "{rayleigh: {alpha: " + number(2 * zeta * w) + ", beta: 0}}";
                            c.until = 10 * 2 * pi / w;
                            const Attempt a = attempt(text(c));
                            if (!a.whole()) return ended(a);
                            const auto t = a.column("t"), u = a.column("b.B.uy");
                            const double rest = 4 * 0.1 / (mass * w * w);  // the shape's square at the end is 4/m
                            double off = 0;
                            for (std::size_t i = 0; i < t.size(); ++i) {
                              double left = 0;  // of 1
                              const double x = w * t[i];
                              if (zeta < 1) {
                                const double d = std::sqrt(1 - zeta * zeta);
                                left = std::exp(-zeta * x) * (std::cos(d * x) + zeta / d * std::sin(d * x));
                              } else if (zeta == 1) {
                                left = std::exp(-x) * (1 + x);
                              } else {
                                const double fast = zeta + std::sqrt(zeta * zeta - 1), slow = 1 / fast;
                                left = (fast * std::exp(-slow * x) - slow * std::exp(-fast * x)) / (fast - slow);
                              }
                              off = std::max(off, apart(u[i], rest * (1 - left), rest));
                            }
                            return measured(a, off, 1e-4);
                          }});
  axis.cases.push_back(
      past(1.5, "1.5", "as a ratio", End::rejected, "must lie between 0 and 1", text(Cantilever{.damping = "{ratios: 1.5}"})));
  axis.cases.push_back(
      past(-0.1, "-0.1", "as a ratio", End::rejected, "must lie between 0 and 1", text(Cantilever{.damping = "{ratios: -0.1}"})));
  return axis;
}

}  // namespace extremes
