// Singular configurations: flat starts, dead centres, triangles that are hardly any.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/extremes/motion.h"

namespace extremes {

namespace {

constexpr double pi = std::numbers::pi;

struct FourBar {
  double a = 0.1, b = 0.4, c = 0.35, d = 0.4;  ///< crank, coupler, rocker, ground [m]
  double angle = 1, speed = 5;                 ///< of the crank at the start
  double coupler = 0, rocker = 0;              ///< rough angles
  bool driven = false;
  double until = 1;
  std::string method = "auto";
};

/// Uniform enough: crank and rocker of one inertia about their pins, the coupler's centre at its middle.
std::string text(const FourBar& m) {
  return with(
      R"(ground: {points: {A: [0, 0], D: [{d}, 0]}}
bodies:
  crank:   {rigid: {mass: 1, inertia: 0.01, center: [{a2}, 0]}, points: {A: [0, 0], B: [{a}, 0]}, pose: {angle: {angle}}}
  coupler: {rigid: {mass: 1, inertia: 0.1, center: [{b2}, 0]}, points: {B: [0, 0], C: [{b}, 0]}, pose: {at: [{bx}, {by}], angle: {coupler}}}
  rocker:  {rigid: {mass: 1, inertia: 0.05, center: [{c2}, 0]}, points: {D: [0, 0], C: [{c}, 0]}, pose: {at: [{d}, 0], angle: {rocker}}}
joints:
  A: {revolute: [ground.A, crank.A]}
  B: {revolute: [crank.B, coupler.B]}
  C: {revolute: [coupler.C, rocker.C]}
  D: {revolute: [ground.D, rocker.D]}
{moves}
run: {until: {until}, method: {method}}
output: {every: {every}}
)",
      {{"a", number(m.a)},
       {"b", number(m.b)},
       {"c", number(m.c)},
       {"d", number(m.d)},
       {"a2", number(m.a / 2)},
       {"b2", number(m.b / 2)},
       {"c2", number(m.c / 2)},
       {"bx", number(m.a * std::cos(m.angle))},
       {"by", number(m.a * std::sin(m.angle))},
       {"angle", number(m.angle)},
       {"coupler", number(m.coupler)},
       {"rocker", number(m.rocker)},
       {"moves", m.driven ? "drivers: {motor: {angle: [ground, crank], law: \"" + number(m.angle) + " + " + number(m.speed) + "*t\"}}"
                          : "start: {crank: {angle: " + number(m.angle) + ", speed: " + number(m.speed) + "}}"},
       {"until", number(m.until)},
       {"method", m.method},
       {"every", number(m.until / 20)}});
}

FourBar parallelogram(double off) { return {.a = 0.2, .b = 0.5, .c = 0.2, .d = 0.5, .angle = 0, .coupler = off, .rocker = -off}; }

/// The rocker's angle of the open branch, by the two triangles about the diagonal.
double rocker_angle(const FourBar& m, double crank) {
  const double x = m.d - m.a * std::cos(crank), y = -m.a * std::sin(crank), diagonal = std::hypot(x, y);
  const double at_d = std::acos((m.c * m.c + diagonal * diagonal - m.b * m.b) / (2 * m.c * diagonal));
  return std::atan2(-y, -x) - at_d;
}

FourBar placed(FourBar m) {
  m.rocker = rocker_angle(m, m.angle);
  m.coupler = std::atan2(m.c * std::sin(m.rocker) - m.a * std::sin(m.angle), m.d + m.c * std::cos(m.rocker) - m.a * std::cos(m.angle));
  return m;
}

}  // namespace

Axis flat_starts() {
  Axis axis{"flat start of a parallelogram",
            "A parallelogram four-bar that starts flat, where its motions branch, from rough poses so far off; free or driven.",
            "it goes on as a parallelogram, whose inertia is constant: crank and rocker at 5t, or both as driven; what stops at a flat "
            "pose it drives "
            "through says so and is a parallelogram up to there [rad].",
            "1e-5: how near to flat it comes is known to the root of rounding.",
            {}};
  for (const double off : {0.0, 1e-12, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5})
    for (const bool driven : {false, true})
      axis.cases.push_back(
          {off, printed("%g rad", off), driven ? "driven" : "free", End::warned, "the start is a singular configuration", [=] {
             FourBar m = parallelogram(off);
             m.driven = driven, m.until = 0.5;
             const Attempt a = attempt(text(m));
             if (!a.whole()) return ended(a);
             return measured(a, std::max(apart(a.last("crank.angle"), 2.5), apart(a.last("rocker.angle"), 2.5)), 1e-5);
           }});
  FourBar through = parallelogram(0);
  through.angle = 1, through.rocker = 1, through.driven = true, through.until = 3;
  for (const char* method : {"auto", "generalized-alpha"})
    axis.cases.push_back(
        {1, "1 rad", std::string("driven through flat at six speeds, ") + method, End::finished, "", [=] {
           std::vector<Finding> all;  // an explicit method goes on as a parallelogram or stops there, by rounding
           for (const double speed : {4.7, 4.9, 5.0, 5.1, 5.3, 6.0}) {
             FourBar m = through;
             m.method = method, m.speed = speed;
             const Attempt a = attempt(text(m));
             const bool stops = a.end == End::stopped && a.said.find("a singular configuration") != std::string::npos && m.method == "auto";
             if (stops && a.trouble.empty())
               all.push_back({End::finished, "", "", apart(a.last("rocker.angle"), a.last("crank.angle")), 1e-5});
             else
               all.push_back(a.whole() ? measured(a, apart(a.last("rocker.angle"), a.last("crank.angle")), 1e-5) : ended(a));
           }
           return worst(all);
         }});
  FourBar free = through;
  free.driven = false;
  axis.cases.push_back({1, "1 rad", "free through flat", End::finished, "", [free] {
                          const Attempt a = attempt(text(free));
                          return a.whole()
                                     ? measured(a, std::max(apart(a.last("crank.angle"), 16), apart(a.last("rocker.angle"), 16)), 1e-5)
                                     : ended(a);
                        }});
  FourBar locked{.a = 0.2, .b = 0.2, .c = 0.2, .d = 0.6, .angle = 0, .rocker = pi};
  axis.cases.push_back(past(0, "0 rad", "locked: ground as long as all bars", End::stopped, "", text(locked)));
  return axis;
}

Axis dead_centres() {
  Axis axis{"dead centres",
            "Four-bars through and up to poses where a link comes into line with another.",
            "a driven crank-rocker: the rocker against two triangles [rad]; free ones: the energy books.",
            "1e-8 driven; books 1e-5.",
            {}};
  const FourBar rocker = placed({.driven = true, .until = 3});
  axis.cases.push_back({0, "crank-rocker", "driven", End::finished, "", [=] {
                          const Attempt a = attempt(text(rocker));
                          if (!a.whole()) return ended(a);
                          const auto t = a.column("t"), angle = a.column("rocker.angle");
                          double off = 0;
                          for (std::size_t i = 0; i < t.size(); ++i)
                            off = std::max(off, std::abs(std::remainder(angle[i] - rocker_angle(rocker, 1 + 5 * t[i]), 2 * pi)));
                          return measured(a, off, 1e-8);
                        }});
  const FourBar swinging{.a = 0.4, .b = 0.4, .c = 0.35, .d = 0.6, .angle = 1};
  const auto books = [&](const char* name, FourBar m, double value) {
    m = placed(m);
    m.until = 3;
    axis.cases.push_back({value, name, "free", End::finished, "", [m] {
                            const Attempt a = attempt(text(m));
                            return a.whole() ? measured(a, a.open_books(), 1e-5) : ended(a);
                          }});
  };
  books("crank-rocker", {}, 0);
  books("double rocker", swinging, 1);
  FourBar toggle = placed(swinging);
  toggle.driven = true;
  for (const char* method : {"auto", "generalized-alpha"}) {
    toggle.method = method;
    axis.cases.push_back(past(1, "double rocker", std::string("driven to its toggle, ") + method, End::stopped,
                              "a dead centre: the driver \"motor\" cannot move past 1.659 rad", text(toggle)));
  }
  const FourBar deltoid = placed({.a = 0.3, .b = 0.5, .c = 0.5, .d = 0.3, .angle = 1, .driven = false, .until = 3, .method = "dopri5"});
  axis.cases.push_back(
      {2, "deltoid", "free, folds", End::finished, "", [deltoid] {  // coupler and rocker could turn together with the crank at rest
         const Attempt a = attempt(text(deltoid));
         if (!a.whole()) return ended(a);
         return measured(a, a.last("crank.angle") > 4 * pi ? a.open_books() : 1, 1e-5);
       }});
  FourBar apart_bars{.a = 0.1, .b = 0.1, .c = 0.1, .d = 0.6};
  axis.cases.push_back(past(3, "too short", "", End::rejected, "cannot close", text(apart_bars)));
  return axis;
}

Axis assembly_limit() {
  Axis axis{"limit of assembly",
            "A truss of two bars between supports 1 m apart, in gravity; by how much the bars are longer than half of that.",
            "the thrust at its apex against m g/4h·L, h by Pythagoras: relative.",
            "1e-13 over the excess, for the square of h is known to rounding, and 1e-9.",
            {}};
  const auto scene = [](double excess) {
    const double l = 0.5 * (1 + excess), h = l * l > 0.25 ? std::sqrt((l - 0.5) * (l + 0.5)) : 0.0;
    return with(R"(gravity: [0, -9.81]
ground: {points: {P: [0, 0], Q: [1, 0]}}
bodies:
  left:  {rigid: {mass: 1, inertia: 0.02, center: [{l2}, 0]}, points: {P: [0, 0], T: [{l}, 0]}, pose: {angle: {angle}}}
  right: {rigid: {mass: 1, inertia: 0.02, center: [{l2}, 0]}, points: {T: [0, 0], Q: [{l}, 0]}, pose: {at: [0.5, {h}], angle: {down}}}
joints:
  P: {revolute: [ground.P, left.P]}
  T: {revolute: [left.T, right.T]}
  Q: {revolute: [right.Q, ground.Q]}
run: {until: 0.1}
)",
                {{"l", number(l)},
                 {"l2", number(l / 2)},
                 {"h", number(h)},
                 {"angle", number(1.3 * std::atan2(h, 0.5))},
                 {"down", number(-1.3 * std::atan2(h, 0.5))}});
  };
  for (const double excess : {1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10})
    axis.cases.push_back({excess, printed("%g", excess), "", End::finished, "", [=] {
                            const Attempt a = attempt(scene(excess));
                            const double l = 0.5 * (1 + excess), h = std::sqrt((l - 0.5) * (l + 0.5)), thrust = 9.81 * 0.25 / h;
                            return a.whole() ? measured(a, std::abs(std::abs(a.last("T.fx on right")) / thrust - 1), 1e-9 + 1e-13 / excess)
                                             : ended(a);
                          }});
  axis.cases.push_back(past(1e-12, "1e-12", "", End::stopped, "J unexplained", scene(1e-12)));
  axis.cases.push_back(past(-1e-12, "-1e-12", "flat", End::stopped, "", scene(-1e-12)));
  axis.cases.push_back(past(0, "0", "flat", End::stopped, "", scene(0)));
  axis.cases.push_back(past(-1e-9, "-1e-09", "", End::rejected, "cannot close", scene(-1e-9)));
  axis.cases.push_back(past(-1e-2, "-0.01", "", End::rejected, "cannot close", scene(-1e-2)));
  return axis;
}

}  // namespace extremes
