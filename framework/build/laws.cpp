#include "framework/build/laws.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <sstream>

#include "framework/common/text.h"
#include "framework/scene/error.h"
#include "framework/scene/units/law_pole.h"
#include "framework/scene/units/law_scale.h"
#include "framework/scene/units/program_parts.h"
#include "framework/scene/units/signal_law.h"

namespace pintle {

namespace {

constexpr double steps_through_laws = 1000;  // steps of a run whose laws are not known

bool stands_still(const Law& law, double until) {
  const Jet first = law.at(0), last = law.at(until);
  return law.constant && first.value == last.value && first.rate == 0 && last.rate == 0;
}

/// Rejects a jump of a driver's law or of its speed: it is an impact, whose energy would not be accounted for.
void validate_jumps(const Scene& scene, const SceneDriver& d, const LawScale& scale) {
  for (const LawBreak& b : scale.breaks) {
    const bool place = value_jumps(b);
    if (!place && !speed_jumps(b, scale.fastest)) continue;
    const auto [from, to] = place ? std::pair(b.left.value, b.right.value) : std::pair(b.left.rate, b.right.rate);
    const std::string unit = std::string(d.kind == DriverKind::angle ? "rad" : "m") + (place ? "" : "/s"), when = number_text(b.after, 9);
    throw SceneError(scene.file, d.place,
                     "the " + std::string(place ? "value" : "speed") + " of its law " + d.law.text + " jumps at t = " + when + " s, from " +
                         number_text(from, 9) + " to " + number_text(to, 9) + " " + unit +
                         ": that is an impact; make it change gradually, for example with step(t, " + when + " s, " +
                         number_text(b.after + 0.01 * scene.run.until, 9) + " s)");
  }
}

/// Checks that a law is finite also between the times that the reader checks.
void validate_finite(const Scene& scene, const Law& law, const Place& place, const LawScale& scale, bool driver) {
  const auto fail = [&](const char* what, double t) {
    throw SceneError(scene.file, place,
                     "its law " + law.text + " " + what + " at t = " + number_text(t, 9) +
                         " s; write one that stays finite from 0 to run.until, or end the run before");
  };
  if (!std::isnan(scale.not_finite)) fail("is not a finite number", scale.not_finite);
  if (const auto pole = pole_of(law.at, scene.run.until, driver)) fail("grows without bound", *pole);
}

/// Calls f(law, name, place, driver or nullptr) for each law of time.
template <class F>
void each_law(const Scene& scene, F f) {
  for (const SceneDriver& d : scene.drivers) f(d.law, d.name, d.place, &d);
  for (const SceneLoad& l : scene.loads) {
    const auto see = [&](const Law& law) {
      if (law.at) f(law, l.name, l.place, static_cast<const SceneDriver*>(nullptr));
    };
    if (const auto* force = std::get_if<SceneForce>(&l.what)) see(force->x), see(force->y);
    if (const auto* torque = std::get_if<SceneTorque>(&l.what)) see(torque->law);
    if (const auto* spring = std::get_if<SceneSpring>(&l.what); spring && spring->law) see(*spring->law);
    if (const auto* torsion = std::get_if<SceneTorsionSpring>(&l.what); torsion && torsion->law) see(*torsion->law);
  }
  for (const SceneEvent& e : scene.events)  // so that no step skips a short one
    for (const Law& law : e.when)
      if (law.at) f(law, e.name, e.place, static_cast<const SceneDriver*>(nullptr));
}

const Program* formula_of(const Law& law) {
  if (const auto* program = law.at.target<Program>()) return program;
  if (const auto* formula = law.of_signals.target<SignalFormula>()) return &formula->program;
  if (const auto* table = law.of_signals.target<SignalTable>()) return &table->over.program;
  return nullptr;
}

/// Calls f(law of time, law, name, place) for conditions of t alone inside laws of signals.
template <class F>
void each_switch_of_time(const Scene& scene, F f) {
  const auto see = [&](const Law& law, const auto& owner) {
    if (const Program* program = formula_of(law); program && law.uses_time)
      for (Program& one : switches_of_time(*program)) f(TimeLaw(std::move(one)), law, owner.name, owner.place);
  };
  for (const SceneLoad& l : scene.loads) {
    if (const auto* force = std::get_if<SceneForce>(&l.what)) see(force->x, l), see(force->y, l);
    if (const auto* torque = std::get_if<SceneTorque>(&l.what)) see(torque->law, l);
    if (const auto* spring = std::get_if<SceneSpring>(&l.what); spring && spring->law) see(*spring->law, l);
    if (const auto* torsion = std::get_if<SceneTorsionSpring>(&l.what); torsion && torsion->law) see(*torsion->law, l);
  }
  for (const SceneState& s : scene.states) see(s.rate, s);
  for (const SceneEvent& e : scene.events)
    for (const Law& law : e.when) see(law, e);
}

/// A law as messages name it.
std::string name_in_messages(const Scene& scene, const Law& law, const std::string& name, const Place& place) {
  const std::string line = place.line > 0 ? ":" + std::to_string(place.line) : std::string();
  return "the law" + (law.text.empty() ? "" : " " + law.text) + " of \"" + name + "\" (" + (place.file.empty() ? scene.file : place.file) +
         line + ")";
}

/// A short piece of a law that has too many of them to list, from the longest beginning of the run, by halves, in which they can be listed:
/// a tenth of them are shorter, as those that a root cuts off. None: 0, as for a C++ function, or a law that is rounding at this scale.
struct ShortPiece {
  double length = 0, until = 0;  ///< [s]
};
ShortPiece short_piece(const TimeLaw& law, double until) {
  constexpr double least = 1e-7;  // of the run
  for (double end = until / 2; end > least * until; end /= 2) {
    const LawScale scale = scale_of(law, end);
    if (!scale.known) continue;
    std::vector<double> lengths;
    std::adjacent_difference(scale.pieces.begin(), scale.pieces.end(), std::back_inserter(lengths));
    const auto tenth = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 10);
    std::ranges::nth_element(lengths, tenth);
    return *tenth > least * until ? ShortPiece{*tenth, end} : ShortPiece{};
  }
  return {};
}

/// As scale_of, with as many intervals as the beginning of the law lets expect.
struct ListedLaw {
  LawScale scale;
  ShortPiece piece;  ///< unless the first look lists it
};
ListedLaw listed_law(const TimeLaw& law, double until) {
  constexpr double most = 2e5, looks_at_each = 50;  // pieces; to find its ends
  ListedLaw out{scale_of(law, until), {}};
  if (out.scale.known) return out;
  out.piece = short_piece(law, until);
  if (const double pieces = until / out.piece.length; out.piece.length > 0 && pieces < most)
    out.scale = scale_of(law, until, static_cast<int>(looks_at_each * pieces));
  return out;
}

/// Adds the times at which a comparison of t alone, given as a difference, is zero: steps end there, to the last digit.
void end_at_zeros(const TimeLaw& difference, double until, std::vector<LawChange>& changes) {
  const auto* program = difference.target<Program>();
  if (!program) return;
  Program above = *program;
  above.code.push_back({Op::constant, 0});
  above.code.push_back({Op::greater});
  for (const LawBreak& b : listed_law(above, until).scale.breaks) {
    const bool rises = difference(b.after).value > 0;
    double t = b.before;
    while (t < b.after && (rises ? difference(t).value < 0 : difference(t).value > 0)) t = std::nextafter(t, b.after);
    changes.push_back({t, t, false});
  }
}

/// For a law of signals that also contains t, the times at which it acts are unknown.
bool uses_time_beside_signals(const Scene& scene) {
  const auto uses = [](const Law& law) { return law.uses_time && !law.signals.empty(); };
  const auto any = [&](const SceneLoad& l) {
    if (const auto* force = std::get_if<SceneForce>(&l.what)) return uses(force->x) || uses(force->y);
    if (const auto* torque = std::get_if<SceneTorque>(&l.what)) return uses(torque->law);
    if (const auto* spring = std::get_if<SceneSpring>(&l.what)) return spring->law && uses(*spring->law);
    if (const auto* torsion = std::get_if<SceneTorsionSpring>(&l.what)) return torsion->law && uses(*torsion->law);
    return false;
  };
  return std::ranges::any_of(scene.loads, any) || std::ranges::any_of(scene.states, [&](const SceneState& s) { return uses(s.rate); });
}

/// The pieces with these ends that are not linear.
std::vector<LawBend> bends_of(const TimeLaw& law, const std::vector<double>& ends) {
  constexpr double edge = 1e-6, rounding = 1e-9;  // relative to a piece, to leave out jumps at its ends; relative to rates
  std::vector<LawBend> out;
  double begin = 0;
  for (const double end : ends) {
    const double width = end - begin, a = begin + edge * width, b = end - edge * width;
    const Jet from = law(a), middle = law((a + b) / 2), to = law(b);
    const double slope = (to.value - from.value) / (b - a), off = middle.value - (from.value + to.value) / 2;
    const double little =
        rounding * std::max({std::abs(from.rate), std::abs(middle.rate), std::abs(to.rate), std::abs(middle.value) / width});
    const bool straight = std::abs(from.rate - slope) <= little && std::abs(middle.rate - slope) <= little &&
                          std::abs(to.rate - slope) <= little && std::abs(off) <= little * width;
    if (!straight) out.push_back({begin, end});
    begin = end;
  }
  return out;
}

bool accelerates_anew(const LawBreak& b) {
  return std::abs(b.right.accel - b.left.accel) > 1e-9 * std::max(std::abs(b.left.accel), std::abs(b.right.accel));
}

/// Sorts them and merges those that coincide.
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

std::vector<std::string> follow_laws(const Scene& scene, Scheme& scheme) {
  const RunOptions& run = scene.run;
  std::vector<std::string> warnings;
  if (run.max_step > 0) scheme.max_step = run.max_step;
  if (!scene.has_run) return warnings;
  bool known = true;
  const auto list = [&](ListedLaw law, const TimeLaw& of_time, const auto& breaks_motion, const auto& said) {
    auto& [scale, piece] = law;
    for (const LawBreak& b : scale.breaks) scheme.changes.push_back({b.before, b.after, breaks_motion(b)});
    scheme.bends.push_back(bends_of(of_time, scale.pieces));
    const bool is_known = scale.known;
    if (scale.pieces.size() > 1) scheme.pieces.push_back(std::move(scale.pieces));
    if (is_known || run.max_step > 0) return;
    known = known && piece.length > 0;
    if (piece.length == 0) return;
    scheme.max_step = std::min(scheme.max_step, piece.length / 2);
    warnings.push_back(said() + " changes its course too often to list all its times: steps take at most " +
                       number_text(piece.length / 2, 3) + " s, as its pieces in the first " + number_text(piece.until, 3) +
                       " s ask for; if it changes faster later, give run.max step, or end the run before");
  };
  each_law(scene, [&](const Law& law, const std::string& name, const Place& place, const SceneDriver* driver) {
    if (stands_still(law, run.until)) return;
    ListedLaw here = listed_law(law.at, run.until);
    validate_finite(scene, law, place, here.scale, driver != nullptr);
    if (driver) validate_jumps(scene, *driver, here.scale);
    const auto breaks_motion = [&](const LawBreak& b) { return driver ? accelerates_anew(b) : value_jumps(b); };
    list(std::move(here), law.at, breaks_motion, [&] { return name_in_messages(scene, law, name, place); });
  });
  each_switch_of_time(scene, [&](const TimeLaw& of_time, const Law& law, const std::string& name, const Place& place) {
    list(listed_law(of_time, run.until), of_time, value_jumps,
         [&] { return "a condition in " + name_in_messages(scene, law, name, place); });
  });
  for (const SceneEvent& e : scene.events)
    for (const Law& law : e.when)
      if (law.at) end_at_zeros(law.at, run.until, scheme.changes);
  order(scheme.changes);
  known = known && !uses_time_beside_signals(scene);
  if (!known && run.max_step <= 0) scheme.max_step = std::min(scheme.max_step, run.until / steps_through_laws);
  return warnings;
}

std::string explain_laws(const Scene& scene, double t) {
  constexpr int looks = 32;
  constexpr double steep = 1e3;
  std::string out;
  each_law(scene, [&](const Law& law, const std::string& name, const Place& place, const SceneDriver*) {
    if (!out.empty() || scale_of(law.at, scene.run.until).known) return;
    const std::string which = name_in_messages(scene, law, name, place) + " ";
    const Jet now = law.at(t), then = law.at(t + 1e-9 * scene.run.until);
    double before = 0;
    for (int i = 0; i < looks; ++i) {
      const Jet jet = law.at(0.95 * t * i / looks);
      before = std::max({before, std::abs(jet.value), std::abs(jet.rate) * t});
    }
    if (!std::isfinite(now.value + now.rate + then.value + then.rate))
      out = which + "is not a finite number there; write one that is";
    else if (std::abs(now.rate) * t > steep * before)
      out = which + "has reached " + number_text(now.value, 9) + " and changes by " + number_text(now.rate, 9) +
            " per second there: it seems to grow without bound; write one that stays finite, or end the run before (run.until)";
  });
  return out;
}

}  // namespace pintle
