// Many impacts, slow and fast ones, starts in the wall and at it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/extremes/contact.h"
#include "tests/oracles/hertz_bounce.h"
#include "tests/oracles/slider_crank_clearance.h"

namespace extremes {

namespace po = pintle_oracle;

namespace {

constexpr double K = 1e10, c = 1e-3, m = puck_mass;  // [N/m^1.5], [m], [kg]
const std::string elastic = "hertz: {stiffness: 1e10}", lossy = "lankarani-nikravesh: {restitution: 0.8, stiffness: 1e10}";

double energy(double speed) { return m * speed * speed / 2; }
/// To and fro along a diameter, n impacts; ends amid the gap. Hertz's law, or one of exponent 1, whose contact lasts π√(m/k).
Finding bounces(long n, bool linear, double seconds) {
  constexpr double v = 1, k = 1e8;
  const double contact = linear ? std::numbers::pi * std::sqrt(m / k) : po::duration({.mass = m, .speed = v, .stiffness = K});
  const double period = 2 * c / v + contact, N = static_cast<double>(n);
  const Attempt a = attempt(text(Puck{.law = linear ? "hertz: {stiffness: 1e8, exponent: 1}" : elastic,
                                      .velocity = {v, 0},
                                      .until = N * period,
                                      .tolerance = linear ? 1e-10 : 1e-12,
                                      .method = "verner87",
                                      .more = ", ledger bound: 0.01, max steps: 1000000000"}),
                            seconds);
  if (!a.whole()) return ended(a);
  const double counted = static_cast<double>(a.run->impacts.size());
  return measured(a, std::max(std::abs(a.run->last.kinetic / energy(v) - 1), std::abs(counted / N - 1)), N * 1e-9);
}

}  // namespace

Axis impact_count() {
  Axis axis{
      "impacts in one run",
      "A puck of 0.4 kg bounces to and fro along a diameter of its bearing (clearance 1 mm, 1 m/s, no loss): 1e10 N/m^1.5 at a "
      "tolerance of 1e-12, or 1e8 N/m at 1e-10.",
      "energy drifted, over the whole; the number of impacts against the closed form of flight and contact, relative.",
      "1e-9 an impact: some tens of steps that may all err to one side, and the kinks at either end of a contact; the number is exact "
      "while that is less than one impact in all.",
      {}};
  const auto add = [&](long n, bool linear) {
    const bool nightly = n > 100'000 || (linear && n == 100'000);
    axis.cases.push_back({.value = static_cast<double>(n),
                          .label = printed("%ld", n),
                          .what = linear ? "exponent 1" : "exponent 1.5",
                          .run = [=] { return bounces(n, linear, nightly ? 3500 : 100); },
                          .nightly = nightly});
  };
  for (const long n : {1L, 100L, 10'000L}) add(n, false);
  for (const long n : {100L, 10'000L, 100'000L, 10'000'000L}) add(n, true);
  return axis;
}

namespace {

/// Head on; below the law's slowest impact, 1e-6 m/s, the factor acts as if smaller.
Finding head_on(double v) {
  const double chi = po::lankarani_nikravesh(0.8) * std::min(1.0, v / 1e-6);
  const po::Bounce b{.mass = m, .speed = v, .stiffness = K, .chi = chi};
  const Attempt a = attempt(text(Puck{.law = lossy, .velocity = {v, 0}, .until = 1.5 * c / v + po::duration(b), .tolerance = 1e-12}));
  if (!a.whole()) return ended(a);
  if (a.run->impacts.size() != 1) return count_wrong(a, 1);
  const pintle::Impact& i = a.run->impacts[0];
  return measured(a,
                  std::max({off(i.begin, c / v), off(i.separation, po::restitution(chi) * v), off(i.end - i.begin, po::duration(b)),
                            off(i.lost, po::loss(b)), off(i.deepest, po::deepest(b))}),
                  std::max(1e-6, 3e-17 / po::deepest(b)));
}

}  // namespace

Axis impact_speed() {
  Axis axis{"impact speed",
            "A puck strikes the wall of its bearing (radius 10 mm, clearance 1 mm) head on; Lankarani and Nikravesh's law, e = 0.8, 1e10 "
            "N/m^1.5.",
            "beginning, separation, duration, loss and depth against the closed form of the law, in which the factor is χ v/v_f below "
            "the law's slowest "
            "impact v_f = 1e-6 m/s; the worst, relative.",
            "1e-6: depth is read off dense output; or three times what 1e-15 of the bearing's radius, to which the wall is located, is "
            "of the depth.",
            {}};
  for (const double v : {1e-15, 1e-14, 1e-12, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0, 10.0, 50.0, 1e2, 1e3, 1e4, 1e6})
    axis.cases.push_back({.value = v,
                          .label = printed("%g m/s", v),
                          .end = v > 30 ? End::warned : End::finished,
                          .says = v > 30 ? "tenth of its radius" : "",
                          .run = [=] { return head_on(v); }});
  return axis;
}

namespace {

/// A puck held against its weight until `late`, then let fall: it strikes √(2c/g) later.
Finding strikes_late(double late) {
  constexpr double g = 10;
  const double fall = std::sqrt(2 * c / g), speed = g * fall, after = 0.02;
  Puck puck{.law = elastic, .gravity = {0, -g}, .until = late + after, .tolerance = 1e-10, .more = ", max step: " + number(late / 20)};
  const std::string holds = "forces: {hand: {force: [0, \"if(t < " + number(late) + ", " + number(m * g) + ", 0)\"], at: puck}}\n";
  const Attempt a = attempt(text(puck) + holds);
  if (!a.whole()) return ended(a);
  if (a.run->impacts.size() != 1) return count_wrong(a, 1);
  const pintle::Impact& i = a.run->impacts[0];
  return measured(a, std::max({std::abs(i.begin - late - fall) / fall, off(i.approach, speed), off(i.separation, speed), a.open_books()}),
                  1e-6 + 20 * 2.2e-16 * late / fall);
}

}  // namespace

Axis impact_time() {
  Axis axis{
      "late impacts",
      "A puck rests in the middle of its bearing's gap, held against its weight until a time, then falls 1 mm to the wall (1e10 N/m^1.5, "
      "no "
      "loss): the last digit of the time grows from 1e-16 s to the length of the fall.",
      "beginning after the release over the time of the fall, approach and separation against √(2gc), the ledger; the worst, relative.",
      "1e-6, and twenty times what the last digit of the time is of the fall.",
      {}};
  for (const double late : {1.0, 1e2, 1e4, 1e5, 1e6, 1e8, 1e12, 1e16})
    axis.cases.push_back({.value = late,
                          .label = printed("%g s", late),
                          .end = late <= 1e8 ? End::finished : End::stopped,
                          .says = late <= 1e8 ? "" : "step became too small",
                          .run = [=] { return strikes_late(late); }});
  return axis;
}

namespace {

/// At rest in the wall. Without loss all that is stored comes back; with it, what is left of the second half of an impact.
Finding from_within(double depth, bool loss) {
  const double v = std::sqrt(2 * K * std::pow(depth, 2.5) / 2.5 / m);  // of the impact that would come so deep
  const double latched = std::max(v, 1e-6), chi = loss ? po::lankarani_nikravesh(0.8) * v / latched : 0;
  double away = 1;  // ∫₀^away u/(1 − χu) du = 1/2
  if (chi > 0) {
    double low = 0, high = std::min(1.0, 1 / chi);
    for (int i = 0; i < 200; ++i) {
      away = (low + high) / 2;
      ((-chi * away - std::log1p(-chi * away)) / (chi * chi) < 0.5 ? low : high) = away;
    }
  }
  const double out = po::time_to_deepest({.mass = m, .speed = v, .stiffness = K});
  const Attempt a = attempt(text(Puck{.law = loss ? lossy : elastic, .at = {0, c + depth}, .until = 3 * out, .tolerance = 1e-12}));
  if (!a.whole()) return ended(a);
  if (a.run->impacts.empty()) return count_wrong(a, 1);
  const pintle::Impact& i = a.run->impacts[0];
  double wrong = std::max(
      {std::abs(i.separation / v - away), off(i.approach, latched), std::abs(i.lost / energy(v) - (1 - away * away)), a.open_books()});
  if (!loss) wrong = std::max(wrong, off(i.end, out));
  return measured(a, wrong, std::max(1e-7, 1e-17 / depth * 10));
}

}  // namespace

Axis deep_start() {
  Axis axis{"start in the wall",
            "A puck starts at rest, its journal (radius 9 mm) a depth inside the wall.",
            "the speed away over that of the impact which would have come so deep, against the closed form: all that was stored comes "
            "back without loss, what "
            "the second half of an impact leaves of it with Lankarani and Nikravesh's law at e = 0.8; the speed latched, not below the "
            "slowest impact; the loss booked; and, without loss, the time.",
            "1e-7; at depths where a place's rounding, 1e-18 m, is more than that of the depth, ten times its share.",
            {}};
  for (const double d : {1e-16, 1e-14, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 5e-4, 1e-3, 1e-2, 1.0})
    for (const bool loss : {false, true})
      axis.cases.push_back({.value = d,
                            .label = printed("%g m", d),
                            .what = loss ? "with loss" : "without loss",
                            .end = d > 0.9e-3  ? End::rejected
                                   : d < 1e-15 ? End::warned
                                               : End::finished,  // warned: a hundredth of the depth is rounding
                            .says = d > 0.9e-3  ? "tenth of its radius"
                                    : d < 1e-15 ? "rounding alone may leave"
                                                : "",
                            .run = [=] { return from_within(d, loss); }});
  return axis;
}

namespace {

enum class Going { away, along, into };

/// From the wall, an offset into it, at speed v. Away: no impact. Into it: the bounce of that energy. Along it: pressed to the wall by
/// turning, it swings between touch and the depth that energy and angular momentum allow.
Finding from_wall(double offset, Going going) {
  constexpr double v = 0.1, gap = 0x1p-10, bearing = 0x1p-6;  // binary: radii whose difference is exact
  const double inside = std::max(offset, 0.0), stored = K * std::pow(inside, 2.5) / 2.5;
  const Pair start{-(gap + offset), 0};
  if (going == Going::along) {
    const Attempt a = attempt(text(Puck{
        .clearance = gap, .bearing_radius = bearing, .law = elastic, .at = start, .velocity = {0, v}, .until = 0.05, .tolerance = 1e-12}));
    if (!a.whole()) return ended(a);
    const double r0 = gap + offset;
    double low = inside, high = gap;  // v² (1 − r0²/r²) m/2 + stored = K δ^2.5/2.5 at the deepest
    low = std::max(low, 1e-12);
    for (int i = 0; i < 200; ++i) {
      const double d = (low + high) / 2, r = gap + d;
      (energy(v) * (1 - r0 * r0 / (r * r)) + stored > K * std::pow(d, 2.5) / 2.5 ? low : high) = d;
    }
    double deepest = 0, moment = 0;
    const auto x = a.column("bush.ex"), y = a.column("bush.ey"), vx = a.column("puck.vx"), vy = a.column("puck.vy");
    for (const pintle::Impact& i : a.run->impacts) deepest = std::max(deepest, i.deepest);
    for (std::size_t i = 0; i < x.size(); ++i) moment = std::max(moment, std::abs((x[i] * vy[i] - y[i] * vx[i]) / (start[0] * v) - 1));
    return measured(a, std::max({std::abs(deepest / low - 1), moment, a.open_books()}), 1e-6);
  }
  const double speed = std::sqrt(v * v + 2 * stored / m);
  const Attempt a = attempt(text(Puck{.clearance = gap,
                                      .bearing_radius = bearing,
                                      .law = elastic,
                                      .at = start,
                                      .velocity = {going == Going::into ? -v : v, 0},
                                      .until = 1.5 * gap / v,
                                      .tolerance = 1e-12}));
  if (!a.whole()) return ended(a);
  const std::size_t impacts = going == Going::into || offset > 0 ? 1 : 0;
  if (a.run->impacts.size() != impacts) return count_wrong(a, impacts);
  double wrong = std::max({std::abs(a.last("puck.vx") / speed - 1), a.open_books()});
  if (impacts > 0) wrong = std::max(wrong, std::abs(a.run->impacts[0].separation / speed - 1));
  return measured(a, wrong, 1e-8);
}

/// Laid on the wall under a force P without loss: swings between touch and (2.5 P/K)^(2/3).
Finding laid_on_wall(double P) {
  const double deepest = depth_under(2.5 * P, K);
  const double swing = std::sqrt(m * deepest / P);  // of the order of its period [s]
  const Attempt a = attempt(text(Puck{.law = elastic, .at = {0, -c}, .gravity = {0, -P / m}, .until = 50 * swing, .tolerance = 1e-12}));
  if (!a.whole()) return ended(a);
  double d = 0;
  for (const pintle::Impact& i : a.run->impacts) d = std::max(d, i.deepest);
  return measured(a, std::max(off(d, deepest), a.open_books()), std::max(1e-6, 1e-15 / deepest));
}

}  // namespace

Axis start_at_the_wall() {
  Axis axis{
      "start at the wall",
      "A puck starts at the wall or a little off it (negative: short of it), at 0.1 m/s into it, away from it or along it; without loss. "
      "*Laid*: exactly at the wall, at rest, under a force.",
      "*into*, *away*: one impact or none, and the speed after against energy. *Along*: the deepest point against conservation of energy "
      "and angular momentum "
      "about the bearing, angular momentum through fifteen turns, the ledger. *Laid*: the deepest point, (2.5 P/K)^⅔.",
      "1e-8 of the speed; 1e-6 of the depth, which is read off dense output, or what the tolerance, 1e-12 of the clearance, is of it.",
      {}};
  for (const double offset : {-1e-9, -1e-15, 0.0, 1e-15, 1e-9, 1e-6})
    for (const auto& [going, what] : {std::pair{Going::into, "into"}, std::pair{Going::away, "away"}, std::pair{Going::along, "along"}})
      axis.cases.push_back({.value = offset, .label = printed("%g m", offset), .what = what, .run = [=, going = going] {
                              return from_wall(offset, going);
                            }});
  for (const double P : {1e-9, 1e-3, 1.0, 1e3})
    axis.cases.push_back({.value = 0, .label = "0 m", .what = printed("laid, %g N", P), .run = [=] { return laid_on_wall(P); }});
  return axis;
}

}  // namespace extremes
