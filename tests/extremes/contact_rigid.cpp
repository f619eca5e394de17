// Bodies that do not give way: friction angle, dry friction, many contacts at once, corners, fast bodies and thin plates. Each case by
// events and by Moreau's steps.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/extremes/contact_rigid.h"

namespace extremes {

namespace {

constexpr double g = 10;  // [m/s²]

Finding miscounted(const Attempt& a, std::size_t wanted) {
  return {a.end, a.said, printed("%zu impacts, not %zu", a.run->impacts.size(), wanted), 0, -1};
}

/// How a run goes through time: by events, or by this many of Moreau's steps.
struct Way {
  int steps = 0;  ///< 0: events
  std::string name() const { return steps > 0 ? "moreau" : "events"; }
  std::string method(double until) const { return steps > 0 ? "{moreau: {step: " + number(until / steps) + "}}" : "dopri5"; }
};
const std::vector<Way> both{{0}, {1000}};

/// A scene of bodies at this ground profile, and what its run says.
Attempt run_of(const std::string& ground, const std::string& bodies, const std::string& contacts, const std::string& start, double until,
               const Way& way, std::array<double, 2> gravity) {
  return attempt(with(R"(gravity: [{gx}, {gy}]
ground: {profiles: {skin: {ground}}}
bodies:
{bodies}contacts:
{contacts}start:
{start}run: {until: {until}, method: {method}}
output: {every: {every}, frames: 0}
)",
                      {{"gx", number(gravity[0])},
                       {"gy", number(gravity[1])},
                       {"ground", ground},
                       {"bodies", bodies},
                       {"contacts", contacts},
                       {"start", start},
                       {"until", number(until)},
                       {"method", way.method(until)},
                       {"every", number(until / 10)}}));
}

const std::string floor_ahead = "{path: [[-1000, 0], [1000, 0]], material: right}";

std::string rigid(double restitution, double mu) {
  return "model: impact, restitution: " + number(restitution) +
         (mu > 0 ? ", friction: {coulomb: {coefficient: " + number(mu) + "}}" : std::string());
}

/// A flat block of 1 kg with sharp corners, its middle `high` above the floor.
std::string block(double half_width, double high) {
  const std::string w = number(half_width), h = number(high);
  return "  block: {rigid: {mass: 1, inertia: " + number(half_width * half_width / 3) + "}, profiles: {skin: {path: [[-" + w + ", -" + h +
         "], [" + w + ", -" + h + "], [" + w + ", " + h + "], [-" + w + ", " + h + "]], closed: true}}}\n";
}
Attempt block_on_floor(double slope, double mu, double high, double speed, double until, const Way& way) {
  return run_of(floor_ahead, block(0.1, high), "  foot: {between: [block.skin, ground.skin], " + rigid(0, mu) + "}\n",
                "  block: {at: [0, " + number(high) + "], angle: 0, velocity: [" + number(speed) + ", 0], speed: 0}\n", until, way,
                {g * std::sin(slope), -g * std::cos(slope)});
}

// Over half a g t² of 1 s. Whether bodies at rest can stay is asked to 1e-9 of the greatest force in each of Moreau's steps.
Finding at_friction_angle(double off, const Way& way) {
  constexpr double mu = 0.4;
  const double slope = std::atan(mu) * (1 + off), a = std::max(0.0, g * (std::sin(slope) - mu * std::cos(slope)));
  const Attempt run = block_on_floor(slope, mu, 0.05, 0, 1, way);
  if (!run.whole()) return ended(run);
  return measured(run, std::abs(run.last("block.x") - a / 2) / (g / 2), way.steps > 0 ? 1e-9 : 1e-12);
}

Axis friction_angle() {
  Axis axis{
      "friction angle",
      "A block with sharp corners is set down on an incline whose angle is so much more than the friction angle, of it (μ = 0.4, rigid "
      "bodies): by events, and by a thousand of Moreau's steps.",
      "the way after 1 s against none below the angle and g (sin − μ cos)/2 above it, over g/2.",
      "1e-12: some thousand roundings; a thousand-millionth above the angle the way is 4e-10 of g/2. In each of Moreau's steps what is at "
      "rest stays where 1e-9 of the force is missing.",
      {}};
  for (const double off : {-1.0, -1e-1, -1e-3, -1e-6, -1e-9, -1e-12, 0.0, 1e-12, 1e-9, 1e-6, 1e-3, 1e-1, 1.0})
    for (const Way& way : both)
      axis.cases.push_back(
          {.value = off, .label = printed("%g", off), .what = way.name(), .run = [=] { return at_friction_angle(off, way); }});
  return axis;
}

/// Slides from 1 m/s until it stops and a fifth longer; without friction for 1 s.
Finding stops_by_dry_friction(double mu, const Way& way) {
  const double stops = mu > 0 ? 1 / (mu * g) : 1, until = mu > 0 ? std::min(1.2 * stops, 100.0) : 1, during = std::min(until, stops);
  const double far = during - mu * g * during * during / 2, left = std::max(0.0, 1 - mu * g * until);
  const Attempt run = block_on_floor(0, mu, 1e-4, 1, until, way);
  if (!run.whole()) return ended(run);
  const double lost = mu > 0 ? run.ledger("foot.lost to friction").back() / 0.5 : 0, step = way.steps > 0 ? until / way.steps : 0;
  return measured(run,
                  std::max({std::abs(run.last("block.x") / far - 1), std::abs(run.last("block.vx") - left),
                            std::abs(lost - (1 - left * left)), run.open_books()}),
                  1e-9 + 2 * mu * g * step * step / far);
}

Axis dry_friction_of_rigid() {
  Axis axis{
      "dry friction of rigid bodies",
      "A block, 200 mm long and 0.2 mm high, slides at 1 m/s on a rigid floor until Coulomb's friction has stopped it: by events, and by "
      "a thousand of Moreau's steps. The run lasts a fifth longer, and at most 100 s.",
      "the way against v²/(2μg), the speed and the energy booked to friction, over those at the start.",
      "1e-9: places of a run at a tolerance of 1e-8, whose motion is exact but for rounding and the instant of the stop. Moreau's steps: "
      "the step in which it stops, 2 μ g h² of the way.",
      {}};
  for (const double mu : {0.0, 1e-9, 1e-3, 0.1, 0.5, 1.0, 2.0, 5.0, 10.0, 100.0})
    for (const Way& way : both)
      axis.cases.push_back(
          {.value = mu, .label = printed("%g", mu), .what = way.name(), .run = [=] { return stops_by_dry_friction(mu, way); }});
  axis.cases.push_back(
      {.value = -0.1, .label = "-0.1", .end = End::rejected, .says = "coefficient", .run = [] {
         return ended(
             attempt(with("ground: {profiles: {skin: {floor}}}\nbodies:\n{block}contacts:\n  foot: {between: [block.skin, ground.skin], "
                          "model: impact, restitution: 0, friction: {coulomb: {coefficient: -0.1}}}\nrun: {until: 1}\n",
                          {{"floor", floor_ahead}, {"block", block(0.1, 0.1)}})));
       }});
  return axis;
}

/// A bar that falls 0.1 m onto all its n feet, or n discs that fall beside each other: they leave the floor at e times their speed.
Finding land_at_once(int n, bool one_bar, const Way& way) {
  constexpr double e = 0.5, height = 0.1, radius = 0.01;
  std::string bodies, contacts, start;
  const auto contact = [&](const std::string& name, const std::string& profile) {
    contacts += "  " + name + ": {between: [" + profile + ", ground.skin], " + rigid(e, 0) + "}\n";
  };
  for (int i = 0; i < n; ++i) {
    const std::string k = std::to_string(i), x = number(0.05 * (2 * i - n + 1));
    if (one_bar) {
      bodies += (i ? ", f" : "f") + k + ": {disc: [" + x + ", 0], radius: 0.01}";
      contact("foot " + k, "bar.f" + k);
    } else {
      bodies += "  ball " + k + ": {rigid: {mass: 1, inertia: 5e-5}, profiles: {rim: {disc: [0, 0], radius: 0.01}}}\n";
      start += "  ball " + k + ": {at: [" + x + ", " + number(radius + height) + "], angle: 0}\n";
      contact("foot " + k, "ball " + k + ".rim");
    }
  }
  if (one_bar) {
    bodies = "  bar: {rigid: {mass: 1, inertia: 1}, profiles: {" + bodies + "}}\n";
    start = "  bar: {at: [0, " + number(radius + height) + "], angle: 0}\n";
  }
  const double fall = std::sqrt(2 * height / g), v = g * fall, until = 1.5 * fall, after = until - fall;
  const Attempt run = run_of(floor_ahead, bodies, contacts, start, until, way, {0, -g});
  if (!run.whole()) return ended(run);
  if (run.run->impacts.size() != static_cast<std::size_t>(n)) return miscounted(run, static_cast<std::size_t>(n));
  double wrong = one_bar ? std::abs(run.last("bar.angle")) : 0;
  for (int i = 0; i < (one_bar ? 1 : n); ++i) {
    const std::string body = one_bar ? "bar" : "ball " + std::to_string(i);
    wrong = std::max(wrong, std::abs(run.last(body + ".y") - radius - e * v * after + g * after * after / 2) / height);
    wrong = std::max(wrong, std::abs(run.last(body + ".vy") - e * v + g * after) / v);
  }
  // A step late, and by as much too fast when it comes, over the height and the speed.
  const double step = way.steps > 0 ? until / way.steps : 0;
  return measured(run, wrong, 1e-9 + 2 * (1 + e) * v * step / height + 2 * (1 + e) * g * step / v);
}

Axis rigid_contacts_at_once() {
  Axis axis{
      "rigid contacts that strike at one instant",
      "A rigid bar falls onto all its n feet at once (restitution 0.5), of which two would do; or n discs fall side by side: by events, "
      "and by a thousand of Moreau's steps.",
      "height and speed after the impact against those of one ball, over the height and the speed of the fall; the bar's angle; n "
      "impacts.",
      "1e-9: what is left of a gap that counts as closed, and rounding of n impulses. Moreau's steps: the impact is a step late at most.",
      {}};
  for (const int n : {1, 2, 3, 4, 10, 30, 100})
    for (const bool bar : {true, false})
      for (const Way& way : both)
        axis.cases.push_back({.value = static_cast<double>(n),
                              .label = printed("%d", n),
                              .what = std::string(bar ? "one bar" : "discs") + ", " + way.name(),
                              .run = [=] { return land_at_once(n, bar, way); }});
  return axis;
}

/// A bar lies on its n feet on an incline of 10° and sticks: the feet bear its weight between them, however they share it.
Finding lie_at_once(int n, const Way& way) {
  constexpr double slope = 10 * std::numbers::pi / 180;
  std::string feet, contacts;
  for (int i = 0; i < n; ++i) {
    const std::string k = std::to_string(i);
    feet += (i ? ", f" : "f") + k + ": {disc: [" + number(0.05 * (2 * i - n + 1)) + ", 0], radius: 0.01}";
    contacts += "  foot " + k + ": {between: [bar.f" + k + ", ground.skin], " + rigid(0, 0.5) + "}\n";
  }
  const Attempt run = run_of(floor_ahead, "  bar: {rigid: {mass: 1, inertia: 1}, profiles: {" + feet + "}}\n", contacts,
                             "  bar: {at: [0, 0.01], angle: 0}\n", 1, way, {g * std::sin(slope), -g * std::cos(slope)});
  if (!run.whole()) return ended(run);
  double normal = 0, along = 0;
  for (int i = 0; i < n; ++i) {
    normal += run.last("foot " + std::to_string(i) + ".normal");
    along += run.last("foot " + std::to_string(i) + ".friction");
  }
  return measured(run,
                  std::max({std::abs(normal / g - std::cos(slope)), std::abs(std::abs(along) / g - std::sin(slope)),
                            std::abs(run.last("bar.x")), run.open_books()}),
                  1e-12);
}

Axis rigid_contacts_at_rest() {
  Axis axis{
      "rigid contacts at rest at once",
      "A rigid bar lies on n feet on an incline of 10° (μ = 0.5): by events, and by twenty of Moreau's steps. From three feet on how they "
      "share the load is no question of its motion, and the run says so.",
      "the sums of normal forces and of friction after 1 s against those of statics, over the weight; the way [m].",
      "1e-12: rounding of n forces.",
      {}};
  for (const int n : {2, 3, 10, 30, 100})
    for (const Way& way : {Way{0}, Way{20}}) {
      if (n > 30 && way.steps > 0) continue;  // seconds
      axis.cases.push_back({.value = static_cast<double>(n),
                            .label = printed("%d", n),
                            .what = way.name(),
                            .end = n > 2 ? End::warned : End::finished,
                            .says = n > 2 ? "more are closed than the motion can tell apart" : "",
                            .run = [=] { return lie_at_once(n, way); }});
    }
  return axis;
}

/// A ball flies past the corner of a ledge, which would stand `inside` its path's edge.
Finding graze_corner(double inside, const Way& way) {
  constexpr double r = 0.1, e = 0.5, v = 1, before = 0.5, after = 0.5;
  const Attempt run = run_of("{path: [[0, 1], [0, 0], [-1, 0], [-1, 1]], closed: true}",
                             "  ball: {rigid: {mass: 1, inertia: 5e-3}, profiles: {rim: {disc: [0, 0], radius: 0.1}}}\n",
                             "  edge: {between: [ball.rim, ground.skin], " + rigid(e, 0) + "}\n",
                             "  ball: {at: [" + number(r - inside) + ", -" + number(v * before) + "], velocity: [0, " + number(v) + "]}\n",
                             before + after, way, {0, 0});
  if (!run.whole()) return ended(run);
  // It is met where its middle is h below the corner, and thrown along n = (r − inside, −h)/r.
  const auto below = [](double depth) { return depth > 0 ? std::sqrt(depth * (2 * r - depth)) : 0.0; };
  const double h = below(inside), blow = (1 + e) * v * h / r, t = before + after - (before - h / v);
  const double x = r - inside + blow * (r - inside) / r * t, y = v * after - blow * h / r * t;
  const double known = 1e-12, slow = 1e-6, step = way.steps > 0 ? (before + after) / way.steps : 0;
  const double unsure = (1 + e) * v / r * (below(inside + known) - below(inside - known)) + 2 * slow + 2 * (1 + e) * v * v * step / r;
  return measured(run, std::hypot(run.last("ball.x") - x, run.last("ball.y") - y) / (v * after), 2 * unsure);
}

Axis corner_grazing() {
  Axis axis{
      "grazing a corner",
      "A ball of 100 mm flies at 1 m/s past the sharp corner of a rigid ledge (restitution 0.5), whose edge stands so far inside its path: "
      "by events, and by a thousand of Moreau's steps.",
      "the place half a second after it, over 0.5 m, against straight flight and one impact along the line from the corner to the middle.",
      "what 1e-12 m of the path do to the normal, and impacts below 1e-6 m/s, which do not rebound; at a depth d the normal turns with "
      "the root of d. Moreau's steps: what one step does to the normal.",
      {}};
  for (const double inside : {-1e-3, -1e-6, -1e-9, -1e-12, -1e-15, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 5e-2})
    for (const Way& way : both)
      axis.cases.push_back(
          {.value = inside, .label = printed("%g m", inside), .what = way.name(), .run = [=] { return graze_corner(inside, way); }});
  return axis;
}

/// A ball of 2 mm radius is shot at a plate 1 mm thick, 1 m away.
Attempt shoot(double v, const Way& way) {
  return run_of("{path: [[1, -0.5 mm], [1, 0.5 mm], [-1, 0.5 mm], [-1, -0.5 mm]], closed: true}",
                "  ball: {rigid: {mass: 1e-3, inertia: 1e-8}, profiles: {rim: {disc: [0, 0], radius: 2 mm}}}\n",
                "  hit: {between: [ball.rim, ground.skin], " + rigid(0.5, 0) + "}\n",
                "  ball: {at: [0, 1], velocity: [0, " + number(-v) + "]}\n", 2 / v, way, {0, 0});
}
Finding stopped_by_plate(double v, const Way& way) {
  const Attempt run = shoot(v, way);
  if (!run.whole()) return ended(run);
  if (run.run->impacts.size() != 1) return miscounted(run, 1);
  const double before = 1 - 2.5e-3, step = way.steps > 0 ? 2.0 / way.steps : 0;
  return measured(run,
                  std::max(std::abs(run.run->impacts[0].begin * v - before), std::abs(run.last("ball.y") - 2.5e-3 - 0.5 * (2 - before))),
                  1e-9 + 2 * step);
}

Axis tunnelling() {
  Axis axis{
      "speed at a thin plate",
      "A ball of 2 mm radius is shot at a rigid plate, 1 mm thick and 1 m away (restitution 0.5), at this speed: by events. *Steps*: at 1 "
      "m/s by Moreau's steps in which it goes so far.",
      "instant of the impact times the speed, and the place at the end, both over 1 m.",
      "1e-9. *Steps*: two steps; where one goes through the plate the run ends and says so.",
      {}};
  for (const double v : {1e-5, 1e-3, 1.0, 1e2, 1e4, 1e6, 1e8, 1e12})
    axis.cases.push_back({.value = v, .label = printed("%g m/s", v), .what = "events", .run = [=] { return stopped_by_plate(v, {}); }});
  for (const double way : {1e-4, 1e-3, 4e-3})
    axis.cases.push_back({.value = way, .label = printed("%g m", way), .what = "steps", .run = [=] {
                            return stopped_by_plate(1, {static_cast<int>(std::lround(2 / way))});
                          }});
  for (const double way : {1e-2, 1e-1, 1.0})
    axis.cases.push_back(
        {.value = way, .label = printed("%g m", way), .what = "steps", .end = End::stopped, .says = "use a shorter step", .run = [=] {
           return stopped_by_plate(1, {static_cast<int>(std::lround(2 / way))});
         }});
  return axis;
}

/// A plank of 1 m, so thick, falls flat onto the floor and bounces.
Finding plank_falls(double thick, const Way& way) {
  constexpr double e = 0.5, fall = 0.1, v = g * fall;
  const double high = thick / 2, until = 0.15, after = until - fall;
  const Attempt run = run_of(floor_ahead, block(0.5, high), "  foot: {between: [block.skin, ground.skin], " + rigid(e, 0) + "}\n",
                             "  block: {at: [0, " + number(high + g * fall * fall / 2) + "], angle: 0}\n", until, way, {0, -g});
  if (!run.whole()) return ended(run);
  const double step = way.steps > 0 ? until / way.steps : 0;
  return measured(run, std::abs(run.last("block.y") - high - e * v * after + g * after * after / 2) / (g * fall * fall / 2),
                  1e-9 + 1e-12 * high + 2 * (1 + e) * v * step / (g * fall * fall / 2));
}

Axis side_of_a_profile() {
  Axis axis{"side of a profile",
            "A rigid plank, 1 m long and so thick, falls flat by 50 mm onto the floor and bounces (restitution 0.5): by events, and by a "
            "thousand of Moreau's steps.",
            "its height at the end, over the fall, against a ball's.",
            "1e-9, what a gap of the plank's size counts as closed at. Moreau's steps: the impact is a step late at most.",
            {}};
  for (const double thick : {1e-9, 1e-6, 1e-3, 1.0, 1e3})
    for (const Way& way : both)
      axis.cases.push_back(
          {.value = thick, .label = printed("%g m", thick), .what = way.name(), .run = [=] { return plank_falls(thick, way); }});
  axis.cases.push_back({.value = 0, .label = "0 m", .end = End::rejected, .says = "no length", .run = [] { return plank_falls(0, {}); }});
  return axis;
}

}  // namespace

Atlas axes_of_rigid_bodies() {
  return {friction_angle(), dry_friction_of_rigid(), rigid_contacts_at_once(), rigid_contacts_at_rest(), corner_grazing(),
          tunnelling(),     side_of_a_profile()};
}

}  // namespace extremes
