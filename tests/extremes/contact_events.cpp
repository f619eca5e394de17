// Grazing, several contacts at one instant, coming to rest, ends at an event.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/extremes/contact.h"
#include "tests/oracles/hertz_bounce.h"
#include "tests/oracles/slider_crank_clearance.h"

namespace extremes {

namespace po = pintle_oracle;

namespace {

constexpr double K = 1e10, c = 1e-3, m = puck_mass;  // [N/m^1.5], [m], [kg]
const std::string elastic = "hertz: {stiffness: 1e10}", lossy = "lankarani-nikravesh: {restitution: 0.8, stiffness: 1e10}";

struct Flight {
  double x, y, vx, vy;
};
/// A point mass under gravity in a round wall of force K δ^1.5, classical fourth-order steps.
Flight fly(Flight s, double radius, double gravity, double t, int steps) {
  const double h = t / steps;
  const auto rate = [&](const Flight& p) {
    const double r = std::hypot(p.x, p.y), d = r - radius, pull = d > 0 ? K / m * d * std::sqrt(d) / r : 0;
    return Flight{p.vx, p.vy, -pull * p.x, -gravity - pull * p.y};
  };
  const auto plus = [](const Flight& p, double k, const Flight& d) {
    return Flight{p.x + k * d.x, p.y + k * d.y, p.vx + k * d.vx, p.vy + k * d.vy};
  };
  for (int i = 0; i < steps; ++i) {
    const Flight a = rate(s), b = rate(plus(s, h / 2, a)), d = rate(plus(s, h / 2, b)), e = rate(plus(s, h, d));
    s = plus(plus(plus(plus(s, h / 6, a), h / 3, b), h / 3, d), h / 6, e);
  }
  return s;
}

/// A thrown puck whose path would rise `above` the top of the gap.
Finding graze(double above) {
  constexpr double g = 10, radius = 0.01, before = 0.02;  // [m/s²], clearance [m], time to the summit [s]
  const double v = std::sqrt(g * radius / 2);             // bent twice as much as the wall at the summit
  const Flight start{-v * before, radius + above - g * before * before / 2, v, g * before};
  const Attempt a = attempt(text(Puck{.clearance = radius,
                                      .bearing_radius = 0.05,
                                      .law = elastic,
                                      .at = {start.x, start.y},
                                      .velocity = {start.vx, start.vy},
                                      .gravity = {0, -g},
                                      .until = 2 * before,
                                      .tolerance = 1e-12}));
  if (!a.whole()) return ended(a);
  if (a.run->impacts.empty() == (above > 0)) return count_wrong(a, above > 0 ? 1 : 0);
  const Flight end = fly(start, radius, g, 2 * before, 400'000);
  return measured(a, std::hypot(a.last("bush.ex") - end.x, a.last("bush.ey") - end.y) / radius, 1e-7);
}

}  // namespace

Axis grazing() {
  Axis axis{"grazing",
            "A puck is thrown in its bearing (clearance 10 mm, no loss) so that the summit of its path would lie just above, at or below "
            "the top of the gap, "
            "where path and wall are parallel.",
            "a touch or none, and the place 20 ms later, over the clearance, against small classical Runge–Kutta steps of a point "
            "mass in that wall; a missed touch "
            "would be 1e-5 of the clearance off at 1e-12 m.",
            "1e-7: what turns the path is the root of the height.",
            {}};
  for (const double above : {-1e-6, -1e-9, -1e-12, -1e-15, 1e-15, 1e-12, 1e-9, 1e-6, 1e-4})
    axis.cases.push_back({.value = above, .label = printed("%g m", above), .run = [=] { return graze(above); }});
  return axis;
}

namespace {

/// A bar with n journals side by side, or n pucks, each in a bearing on the ground, all at 0.1 m/s.
std::string at_once(int n, bool one_bar, double until) {
  std::string ground, points, bodies, joints, start;
  const auto comma = [](std::string& s) {
    if (!s.empty()) s += ", ";
  };
  for (int i = 0; i < n; ++i) {
    const std::string k = std::to_string(i), x = number((2 * i - n + 1) * 0.05);
    const std::string body = one_bar ? "bar" : "puck " + k;
    comma(ground), ground += "G" + k + ": [" + x + ", 0]";
    if (one_bar)
      comma(points), points += "P" + k + ": [" + x + ", 0]";
    else {
      bodies += "  " + body + ": {rigid: {mass: " + number(m / n) + ", inertia: 1e-4}, points: {P" + k + ": [0, 0]}}\n";
      start += "  " + body + ": {at: [" + x + ", 0], angle: 0, velocity: [0, 0.1], speed: 0}\n";
    }
    joints += "  bush " + k + ": {revolute: [ground.G" + k + ", " + body + ".P" + k +
              "], clearance: {radial: 0.001, bearing radius: 0.01, bearing: ground, normal: {" + lossy + "}}}\n";
    start += "  bush " + k + ": {speed: [0, 0.1]}\n";
  }
  if (one_bar) {
    bodies = "  bar: {rigid: {mass: " + number(m) + ", inertia: 0.01}, points: {" + points + "}}\n";
    start += "  bar: {at: [0, 0], angle: 0, velocity: [0, 0.1], speed: 0}\n";
  }
  return "ground: {points: {" + ground + "}}\nbodies:\n" + bodies + "joints:\n" + joints + "start:\n" + start +
         "run: {until: " + number(until) + ", tolerance: 1e-10}\n";
}

Finding strike_at_once(int n, bool one_bar) {
  const po::Bounce b{.mass = m / n, .speed = 0.1, .stiffness = K, .chi = po::lankarani_nikravesh(0.8)};
  const Attempt a = attempt(at_once(n, one_bar, 1.5 * c / 0.1 + po::duration(b)));
  if (!a.whole()) return ended(a);
  if (a.run->impacts.size() != static_cast<std::size_t>(n)) return count_wrong(a, static_cast<std::size_t>(n));
  double wrong = 0;
  for (const pintle::Impact& i : a.run->impacts)
    wrong = std::max({wrong, off(i.begin, c / 0.1), off(i.separation, 0.1 * po::restitution(b.chi)), off(i.end - i.begin, po::duration(b)),
                      off(i.deepest, po::deepest(b)), off(i.lost, po::loss(b))});
  if (one_bar) wrong = std::max(wrong, std::abs(a.last("bar.angle")) * 1e3);
  return measured(a, wrong, 1e-6);
}

}  // namespace

Axis clearances_at_once() {
  Axis axis{"clearances that strike and open at one instant",
            "A bar with journals side by side, or as many single pucks (together 0.4 kg), each journal in a bearing on the ground, all "
            "moving at 0.1 m/s towards the wall.",
            "each impact's beginning, separation, duration, depth and loss against the closed form of the impact of its share of the "
            "mass; the bar's angle, over "
            "1 mrad; the worst.",
            "1e-6, as for one.",
            {}};
  for (const int n : {1, 2, 3, 10, 100, 300})
    for (const bool bar : {true, false})
      axis.cases.push_back({.value = static_cast<double>(n), .label = printed("%d", n), .what = bar ? "one bar" : "pucks", .run = [=] {
                              return strike_at_once(n, bar);
                            }});
  return axis;
}

namespace {

/// Dropped from the middle of the gap. The bounces end after t₀(1 + e)/(1 − e), when they are but contacts that last; what those take,
/// and what is left of the series then, is the bound.
Finding comes_to_rest(double e) {
  constexpr double g = 10, height = c, stiff = 1e13;
  const double t0 = std::sqrt(2 * height / g), v0 = g * t0, rest = depth_under(m * g, stiff), end = std::sqrt(2 * g * rest);
  const double series = t0 * (1 + e) / (1 - e),
               creep = m * g / (e * v0) / (1.5 * stiff * std::sqrt(rest));  // of a depth that damping holds back [s]
  double allowed = 2 * end / g / (1 - e);
  for (double v = v0; v > end && e > 0; v *= e)
    allowed += 1.5 * po::duration({.mass = m, .speed = v, .stiffness = stiff, .chi = e > 0.9 ? 0 : 1.0});
  const Attempt a = attempt(text(Puck{.law = "exact: {restitution: " + number(e) + ", stiffness: 1e13}",
                                      .gravity = {0, -g},
                                      .until = 2 * series + 0.01 + 20 * creep,
                                      .tolerance = e < 1e-3 ? 1e-11 : 1e-9}));  // creeping, the depth is told to a thousand times it
  if (!a.whole()) return ended(a);
  const pintle::Impact& last = a.run->impacts.back();
  if (!std::isnan(last.end)) return {a.end, "", "it does not rest", 0, -1};
  return worst({measured(a, std::abs(last.begin - series), allowed), measured(a, off(a.last("bush.depth"), rest), 1e-3),
                measured(a, a.open_books(), 1e-7 * static_cast<double>(100 + a.run->impacts.size()))});
}

}  // namespace

Axis coming_to_rest() {
  Axis axis{"coming to rest by bounces",
            "A puck falls 1 mm in its bearing (1e13 N/m^1.5, 10 m/s²) and bounces until it lies, under the law `exact`: infinitely many "
            "bounces in a "
            "finite time, were the wall rigid.",
            "the instant at which the last contact begins against the sum of the geometric series, t₀(1 + e)/(1 − e); the depth at which "
            "it lies against (mg/K)^⅔, to 1e-3; the ledger, to 1e-5 and 1e-7 an impact.",
            "the times of contact that the series leaves out, and what is left of it once the impact's depth is that of rest [s].",
            {}};
  for (const double e : {1e-6, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.999})
    axis.cases.push_back({.value = e, .label = printed("%g", e), .run = [=] { return comes_to_rest(e); }, .nightly = e == 1e-6});
  return axis;
}

namespace {

/// Ends, and writes rows, near the onset (or the end) of contact. What stands there must be as closed forms have it, and a run on from
/// there none the worse.
Finding ends_near(double offset, bool onset) {
  constexpr double v = 0.25, gap = 0x1p-10;  // binary: it strikes at 2⁻⁸ s to the last bit
  const po::Bounce b{.mass = m, .speed = v, .stiffness = K};
  const double event = gap / v + (onset ? 0 : po::duration(b)), until = event + offset;
  const Attempt a = attempt(text(
      Puck{.clearance = gap, .law = elastic, .velocity = {v, 0}, .until = until, .every = onset ? event / 4 : until, .tolerance = 1e-12}));
  if (!a.whole()) return ended(a);
  const double place = onset ? until * v : gap - offset * v;
  double wrong = std::max({std::abs(a.last("bush.ex") - place) / gap, std::abs(a.last("puck.vx") - (onset ? v : -v)) / v, a.open_books()});
  return measured(a, wrong, 1e-8);
}

/// Outputs exactly at onset and through it change nothing of the impact.
Finding outputs_at_onset() {
  constexpr double v = 0.25, gap = 0x1p-10;
  const auto run = [&](double every) {
    return attempt(text(Puck{.clearance = gap, .law = elastic, .velocity = {v, 0}, .until = 0x1p-7, .every = every, .tolerance = 1e-12}));
  };
  const Attempt fine = run(0x1p-18), coarse = run(0x1p-7);
  if (!fine.whole() || !coarse.whole()) return ended(fine);
  if (fine.run->impacts.size() != 1 || coarse.run->impacts.size() != 1) return count_wrong(fine, 1);
  const pintle::Impact &i = fine.run->impacts[0], &j = coarse.run->impacts[0];
  return worst(
      {measured(fine, std::max({off(i.begin, j.begin), off(i.end, j.end), off(i.separation, j.separation), off(i.deepest, j.deepest)}), 0),
       measured(fine, off(i.begin, 0x1p-8), 1e-12)});
}

}  // namespace

Axis end_at_an_event() {
  Axis axis{"end at an event",
            "A puck strikes the wall at 2⁻⁸ s, exactly (0.25 m/s, clearance 2⁻¹⁰ m, no loss). The run ends so much after the onset of "
            "contact, or after its loss, with "
            "rows at it. *Rows*: 2048 rows through flight, onset and contact.",
            "place over the clearance and speed over 0.25 m/s at the end against the closed form. *Rows*: the impact is bit for bit that "
            "of a run with two rows.",
            "1e-8. *Rows*: nothing; and 1e-12 of the time at which it strikes.",
            {}};
  const double ulp = std::numeric_limits<double>::epsilon() * 0x1p-8;
  for (const double offset : {-1e-9, -1e-15, -ulp, 0.0, ulp, 1e-15, 1e-9})
    for (const bool onset : {true, false})
      axis.cases.push_back({.value = offset, .label = printed("%.1g s", offset), .what = onset ? "onset" : "loss", .run = [=] {
                              return ends_near(offset, onset);
                            }});
  axis.cases.push_back({.value = 0, .label = "0 s", .what = "rows", .run = outputs_at_onset});
  return axis;
}

}  // namespace extremes
