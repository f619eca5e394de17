// Restitution of every law; friction: coefficient, onset, sticking.
#include <algorithm>
#include <cmath>

#include "tests/extremes/contact.h"
#include "tests/oracles/hertz_bounce.h"

namespace extremes {

namespace po = pintle_oracle;

namespace {

struct LossLaw {
  const char* name;
  double (*chi)(double e);  ///< as published, e above 0 where it has a pole there
  bool pole;
};
const std::vector<LossLaw>& laws() {
  static const std::vector<LossLaw> all{
      {"hunt-crossley", [](double e) { return 1.5 * (1 - e); }, false},
      {"herbert-mcwhannell", [](double e) { return 6 * (1 - e) / (std::pow(2 * e - 1, 2) + 3); }, false},
      {"lee-wang", [](double e) { return 0.75 * (1 - e); }, false},
      {"lankarani-nikravesh", [](double e) { return 0.75 * (1 - e * e); }, false},
      {"gonthier", [](double e) { return (1 - e * e) / e; }, true},
      {"zhiying-qishao", [](double e) { return 0.75 * (1 - e * e) * std::exp(2 - 2 * e); }, false},
      {"flores", [](double e) { return 8 * (1 - e) / (5 * e); }, true},
      {"hu-guo", [](double e) { return 1.5 * (1 - e) / e; }, true},
  };
  return all;
}

constexpr double K = 1e10, approach = 0.1;  // [N/m^1.5], [m/s]

/// Long enough to leave the wall again, at `kept` of the speed, from the deepest point.
double contact_time(double chi, double kept) {
  return 3 * po::deepest({.mass = puck_mass, .speed = approach, .stiffness = K, .chi = chi}) / (kept * approach);
}

/// One bounce: what is left of the energy, in the free flight after it and in the impact's own book, and the speed away, against
/// `kept` = e_out; over the energy and the speed before.
Finding bounce(const std::string& law, double kept, double leaving) {
  const Attempt a = attempt(text(Puck{.law = law, .velocity = {approach, 0}, .until = 1e-3 / approach + leaving, .tolerance = 1e-12}));
  if (!a.whole()) return ended(a);
  if (a.run->impacts.size() != 1) return {a.end, "", printed("%zu impacts, not one", a.run->impacts.size()), 0, -1};
  const pintle::Impact& i = a.run->impacts[0];
  const double energy = puck_mass * approach * approach / 2, lost = (1 - kept) * (1 + kept);
  return measured(a,
                  std::max({std::abs(i.separation / approach - kept), std::abs(i.lost / energy - lost),
                            std::abs(a.run->last.kinetic / energy - kept * kept), a.open_books()}),
                  1e-8);
}

Finding bounce_of(const LossLaw& law, double e) {
  const double chi = law.chi(e), kept = po::restitution(chi);
  return bounce(std::string(law.name) + ": {restitution: " + number(e) + ", stiffness: 1e10}", kept, contact_time(chi, kept));
}

/// The law that delivers what it is asked for.
Finding bounce_exact(double e) { return bounce("exact: {restitution: " + number(e) + ", stiffness: 1e10}", e, contact_time(0, e)); }

}  // namespace

Axis restitution_axis() {
  Axis axis{"restitution",
            "A puck strikes a bearing's wall head on (0.4 kg, 0.1 m/s, 1e10 N/m^1.5) under every law that there is.",
            "speed away, energy left and energy booked as lost, over those before, against the closed form of the law, "
            "χ(1 + e) = ln[(1 + χ)/(1 − χe)] with χ as published; a restitution of 1 conserves the energy, `exact` delivers what it is "
            "asked for.",
            "1e-8: some hundred steps, each at a tolerance of 1e-12 of the energy, and the speed from its square root.",
            {}};
  const auto add = [&](double e, const std::string& label, const std::string& law, const std::function<Finding()>& run) {
    axis.cases.push_back({.value = e, .label = label, .what = law, .run = run});
  };
  const auto reject = [&](double e, const std::string& label, const std::string& law) {
    axis.cases.push_back(
        {.value = e, .label = label, .what = law, .end = End::rejected, .says = "restitution", .run = [=] {
           return ended(attempt(text(Puck{.law = law + ": {restitution: " + label + ", stiffness: 1e10}", .velocity = {approach, 0}})));
         }});
  };
  for (const auto& [e, label] : std::vector<std::pair<double, std::string>>{{0, "0"}, {1e-6, "1e-6"}, {0.5, "0.5"}, {1, "1"}}) {
    for (const LossLaw& law : laws())
      if (e == 0 && law.pole)
        reject(e, label, law.name);
      else
        add(e, label, law.name, [e = e, &law] { return bounce_of(law, e); });
    if (e == 0)
      reject(e, label, "exact");
    else
      add(e, label, "exact", [e = e] { return bounce_exact(e); });
  }
  add(1, "1", "hertz", [] { return bounce("hertz: {stiffness: 1e10}", 1, contact_time(0, 1)); });
  reject(-1e-6, "-1e-6", "hunt-crossley");
  reject(1 + 1e-6, "1.000001", "hunt-crossley");
  return axis;
}

namespace {

/// A shoe that slides up and down only is pressed into the rim of a wheel that turns.
struct Brake {
  double mu = 0.5, v0 = 1e-3, v1 = 1e-2;  ///< –, [m/s], [m/s]
  double spin = 100, torque = 0;          ///< of the wheel at the start [rad/s], on it [N m]
  double until = 1;                       ///< [s]
};
constexpr double press = 10, rim = 0.02, wheel_inertia = 1e-4;  // [N], [m], [kg m²]

std::string text(const Brake& b) {
  return with(R"(ground: {points: {G: {at: [0, 0], angle: 90 deg}}}
bodies:
  wheel: {rigid: {mass: 1, inertia: 1e-4}}
  shoe:  {rigid: {mass: 1, inertia: 1e-4}}
joints:
  axle:  {revolute: [ground, wheel]}
  guide: {prismatic: [ground.G, shoe], angle: -90 deg}
  rim:
    revolute: [wheel, shoe]
    clearance: {radial: 0.1 mm, bearing radius: {rim}, bearing: wheel, normal: {hertz: {stiffness: 1e10}},
                friction: {ambrosio: {coefficient: {mu}, v0: {v0}, v1: {v1}}}}
forces:
  press: {force: [0, {press}], at: shoe}
  drive: {torque: {torque}, on: wheel}
start: {wheel: {angle: 0, speed: {spin}}, rim: {eccentricity: [0, {depth}]}}
run: {until: {until}, tolerance: 1e-10, max steps: 100000}
output: {every: {every}}
)",
              {{"rim", number(rim)},
               {"mu", number(b.mu)},
               {"v0", number(b.v0)},
               {"v1", number(b.v1)},
               {"press", number(-press)},
               {"torque", number(b.torque)},
               {"spin", number(b.spin)},
               {"depth", number(-1e-4 - depth_under(press, 1e10))},
               {"until", number(b.until)},
               {"every", number(b.until / 100)}});
}

struct Slide {
  double speed, turned;  ///< of the rim [m/s]; of the wheel [rad]
};
/// The law's own motion, without a torque: μPR²/J until v1, then towards v0 as an exponential.
Slide after(const Brake& b, double t) {
  const double a = b.mu * press * rim * rim / wheel_inertia, s0 = b.spin * rim;
  const double t1 = a > 0 ? (s0 - b.v1) / a : INFINITY;
  if (t <= t1) return {s0 - a * t, (s0 * t - a * t * t / 2) / rim};
  const double rate = a / (b.v1 - b.v0), left = std::exp(-rate * (t - t1));
  return {b.v0 + (b.v1 - b.v0) * left, ((s0 * s0 - b.v1 * b.v1) / (2 * a) + b.v0 * (t - t1) + (b.v1 - b.v0) * (1 - left) / rate) / rim};
}

/// Sliding to rest: angle turned, speed left, energy booked, each over the whole.
Finding stopping(const Brake& b) {
  const Attempt a = attempt(text(b));
  if (!a.whole()) return ended(a);
  const Slide s = after(b, b.until);
  const double whole = wheel_inertia * b.spin * b.spin / 2, left = std::pow(s.speed / rim / b.spin, 2);
  const double lost = b.mu > 0 ? a.ledger("rim.lost to friction").back() / whole : 0;
  return measured(a,
                  std::max({off(a.last("wheel.angle"), s.turned), std::abs(a.last("wheel.speed") * rim - s.speed) / (b.spin * rim),
                            std::abs(lost - (1 - left)), a.open_books()}),
                  1e-7);
}

double stopping_time(double mu) { return rim * 100 / (mu * press * rim * rim / wheel_inertia); }

const std::string brake =
    "A shoe that a guide lets slide up and down alone is pressed with 10 N into the rim (20 mm) of a wheel (1e-4 kg m²) turning at 100 "
    "rad/s.";

}  // namespace

Axis friction_coefficient() {
  Axis axis{"friction coefficient",
            brake + " v0 = 1 mm/s, v1 = 10 mm/s; the run lasts 1.2 times as long as the wheel needs to stop, at most 1 s.",
            "angle turned (the stopping distance), speed left and energy booked to friction, over the whole, against the closed form of "
            "the law: "
            "even slowing by μPR²/J until v1, then an exponential towards v0.",
            "1e-7: some hundred steps at a tolerance of 1e-10, and two kinks of the law within steps.",
            {}};
  for (const double mu : {0.0, 1e-9, 1e-3, 0.1, 0.5, 1.0, 2.0, 10.0, 1e3, 1e6})
    axis.cases.push_back({.value = mu, .label = printed("%g", mu), .run = [=] {
                            return stopping({.mu = mu, .until = mu > 0 ? std::min(1.0, 1.2 * stopping_time(mu)) : 1});
                          }});
  axis.cases.push_back({.value = -0.1, .label = "-0.1", .end = End::rejected, .says = "coefficient", .run = [] {
                          return ended(attempt(text(Brake{.mu = -0.1})));
                        }});
  return axis;
}

Axis friction_onset() {
  Axis axis{"friction onset v1",
            brake + " μ = 0.5; v0 = v1/10, and v0 = 0; v1 → 0 is Coulomb's law. The run lasts 1.2 stopping times; at most 100 000 steps.",
            "as for the friction coefficient.",
            "as there.",
            {}};
  for (const double v1 : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-10, 1e-12, 1e-16})
    for (const double share : {0.1, 0.0}) {
      const bool too_fine = v1 < 1e-10;
      if (v1 < 1e-8 && share > 0) continue;  // it rests or not as its last step happens to fall into the band without friction
      axis.cases.push_back({.value = v1,
                            .label = printed("%g m/s", v1),
                            .what = share > 0 ? "v0 = v1/10" : "v0 = 0",
                            .end = too_fine ? End::stopped : End::finished,
                            .says = too_fine ? "max steps reached" : "",
                            .run = [=] { return stopping({.v0 = share * v1, .v1 = v1, .until = 1.2 * stopping_time(0.5)}); }});
    }
  const auto reject = [&](double v0, double v1, const std::string& label, const std::string& what) {
    axis.cases.push_back({.value = v1, .label = label, .what = what, .end = End::rejected, .says = "ambrosio.v", .run = [=] {
                            return ended(attempt(text(Brake{.v0 = v0, .v1 = v1})));
                          }});
  };
  reject(1e-2, 1e-2, "0.01 m/s", "v0 = v1");
  reject(0, 0, "0 m/s", "v0 = 0");
  reject(-1e-3, 1e-2, "0.01 m/s", "v0 = -1 mm/s");
  return axis;
}

Axis sticking() {
  Axis axis{"sticking",
            brake + " It starts at rest; a torque of half of what friction can hold, μPR/2, tries to turn it. v0 = v1/10.",
            "the speed of the rim after 0.1 s against the creep at which the law holds the torque, v0 + (v1 − v0)/2, relative: it tends "
            "to zero with v1, "
            "which is sticking. *Slips*: a torque of twice what friction can hold: μPR/J after the onset.",
            "1e-6: the tolerance of 1e-10 is of the fastest speed, and the creep is settled to within rounding.",
            {}};
  const double holds = 0.5 * press * rim;
  for (const double v1 : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-10, 1e-12})
    axis.cases.push_back({.value = v1,
                          .label = printed("%g m/s", v1),
                          .end = v1 < 1e-8 ? End::stopped : End::finished,
                          .says = v1 < 1e-8 ? "max steps reached" : "",
                          .run = [=] {
                            const Attempt a = attempt(text(Brake{.v0 = v1 / 10, .v1 = v1, .spin = 0, .torque = holds / 2, .until = 0.1}));
                            if (!a.whole()) return ended(a);
                            return measured(a, off(a.last("wheel.speed") * rim, 0.55 * v1), 1e-6);
                          }});
  axis.cases.push_back({.value = 1e-8, .label = "1e-08 m/s", .what = "slips", .run = [=] {
                          const Attempt a = attempt(text(Brake{.v0 = 1e-9, .v1 = 1e-8, .spin = 0, .torque = 2 * holds, .until = 0.1}));
                          if (!a.whole()) return ended(a);
                          return measured(a, off(a.last("wheel.speed"), holds / wheel_inertia * 0.1), 1e-6);
                        }});
  return axis;
}

}  // namespace extremes
