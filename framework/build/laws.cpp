#include "framework/build/laws.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "framework/common/text.h"
#include "framework/scene/error.h"
#include "framework/scene/units/law_scale.h"

namespace pintle {

namespace {

constexpr double steps_through_laws = 1000;  // of a run whose laws are not known

bool stands_still(const Law& law, double until) {
  const Jet first = law.at(0), last = law.at(until);
  return law.constant && first.value == last.value && first.rate == 0 && last.rate == 0;
}

/// A jump of what a driver imposes, or of its speed, is an impact, whose energy no equation here books.
void validate_jumps(const Scene& scene, const SceneDriver& d, const LawScale& scale) {
  for (const LawBreak& b : scale.breaks) {
    const bool place = value_jumps(b);
    if (!place && !speed_jumps(b, scale.fastest)) continue;
    const auto [from, to] = place ? std::pair(b.left.value, b.right.value) : std::pair(b.left.rate, b.right.rate);
    const std::string unit = std::string(d.kind == DriverKind::angle ? "rad" : "m") + (place ? "" : "/s"), when = number_text(b.after, 9);
    throw SceneError(scene.file, d.place,
                     "the " + std::string(place ? "value" : "speed") + " of its law " + d.law.text + " jumps at t = " + when + " s, from " +
                         number_text(from, 9) + " to " + number_text(to, 9) + " " + unit + ": that is an impact; let it change over some time, for example with step(t, " +
                         when + " s, " + number_text(b.after + 0.01 * scene.run.until, 9) + " s)");
  }
}

bool accelerates_anew(const LawBreak& b) {
  return std::abs(b.right.accel - b.left.accel) > 1e-9 * std::max(std::abs(b.left.accel), std::abs(b.right.accel));
}

/// In order, those that fall together made one.
void order(std::vector<LawChange>& changes) {
  std::sort(changes.begin(), changes.end(), [](const LawChange& a, const LawChange& b) { return a.before < b.before; });
  std::vector<LawChange> apart;
  for (const LawChange& c : changes) {
    if (apart.empty() || c.before > apart.back().after * (1 + 1e-14)) apart.push_back(c);
    apart.back().after = std::max(apart.back().after, c.after);
    apart.back().jumps = apart.back().jumps || c.jumps;
  }
  changes.swap(apart);
}

}  // namespace

void follow_laws(const Scene& scene, Scheme& scheme) {
  const RunOptions& run = scene.run;
  if (run.max_step > 0) scheme.max_step = run.max_step;
  if (!scene.has_run) return;
  bool known = true;
  const auto see = [&](const Law& law, const SceneDriver* driver) {
    if (stands_still(law, run.until)) return;
    LawScale scale = scale_of(law.at, run.until);
    if (driver) validate_jumps(scene, *driver, scale);
    known = known && scale.known;
    for (const LawBreak& b : scale.breaks) scheme.changes.push_back({b.before, b.after, driver ? accelerates_anew(b) : value_jumps(b)});
    if (scale.pieces.size() > 1) scheme.pieces.push_back(std::move(scale.pieces));
  };
  for (const SceneDriver& d : scene.drivers) see(d.law, &d);
  for (const SceneLoad& l : scene.loads) {
    if (const auto* f = std::get_if<SceneForce>(&l.what)) see(f->x, nullptr), see(f->y, nullptr);
    if (const auto* q = std::get_if<SceneTorque>(&l.what)) see(q->law, nullptr);
  }
  order(scheme.changes);
  if (!known && run.max_step <= 0) scheme.max_step = run.until / steps_through_laws;
}

}  // namespace pintle
