#include "framework/build/events.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <memory>
#include <set>

#include "framework/build/backlash.h"
#include "framework/common/index.h"
#include "framework/dynamics/model/signal_values.h"
#include "framework/dynamics/model/marker_motion.h"
#include "framework/common/nearest.h"
#include "framework/common/text.h"
#include "framework/configuration/unsound_laws.h"
#include "framework/integration/events/scene_events.h"
#include "framework/mechanism/row_law.h"
#include "framework/scene/error.h"
#include "framework/scene/units/guard.h"
#include "framework/scene/units/sided_formula.h"
#include "framework/scene/units/signal_law.h"

namespace pintle {

namespace {

// An element as named in the scene.
struct Element {
  Switch is;
  Place place;
  std::string refusal = {};  ///< why it cannot be released
};

std::map<std::string, Element> elements_of(const Scene& scene, const Model& model) {
  const System& system = model.system;
  std::map<std::string, Element> out;
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    const SceneJoint& j = scene.joints[i];
    const bool contact = j.clearance || j.play;
    Element one{{contact ? Switch::contact : Switch::joint, model.order.joints[i], !j.engaged}, j.place};
    if (contact && is_held(system.contacts[at(one.is.index)]))
      one.refusal = "its clearance is a massless link, which cannot be released; use model: contact";
    out.emplace(j.name, one);
  }
  for (std::size_t i = 0; i < scene.drivers.size(); ++i)
    out.emplace(scene.drivers[i].name, Element{{Switch::joint, model.order.drivers[i], !scene.drivers[i].engaged}, scene.drivers[i].place});
  for (std::size_t i = 0; i < scene.contacts.size(); ++i)
    out.emplace(scene.contacts[i].name,
                Element{{Switch::contact, model.order.contacts[i], !scene.contacts[i].engaged}, scene.contacts[i].place});
  for (std::size_t i = 0; i < scene.loads.size(); ++i)
    out.emplace(scene.loads[i].name, Element{{Switch::force, model.order.loads[i], !scene.loads[i].engaged}, scene.loads[i].place});
  return out;
}

const Element& find_element(const Scene& scene, const SceneEvent& event, const std::map<std::string, Element>& all,
                            const std::string& name) {
  const auto found = all.find(name);
  if (found == all.end()) {
    std::vector<std::string> known;
    for (const auto& [one, element] : all) known.push_back(one);
    throw SceneError(scene.file, event.place,
                     "there is no joint, driver, force or contact " + quoted(name) + " to release or engage." + did_you_mean(name, known));
  }
  if (!found->second.refusal.empty())
    throw SceneError(scene.file, event.place, quoted(name) + " cannot be released: " + found->second.refusal);
  return found->second;
}

int switch_at(const System& system, const Switch& like) {
  const auto found = std::ranges::find_if(system.switches, [&](const Switch& s) { return s.of == like.of && s.index == like.index; });
  return static_cast<int>(found - system.switches.begin());
}

template <class F>
void each_doing(const SceneEvent& event, F f) {
  f(event.then);
  f(event.otherwise);
}

// The laws of one event: of the motion alone, or of the values in a row of the trajectory.
class EventLaws {
 public:
  EventLaws(const Scene& scene, const Model& model, SignalMaker& signals) : scene_(scene), model_(model), signals_(signals) {}

  bool names_columns(const Law& law) const {
    return std::ranges::any_of(law.signals, [&](const std::string& name) {
      const auto word = signals_.words().find(name);
      return word != signals_.words().end() && word->second.what >= SignalWord::output;
    });
  }
  SignalLaw of_motion(const Law& law, const Place& place) const { return signals_.law(law, place); }
  RowLaw of_a_row(const Law& law, const SceneEvent& event) {
    if (!rows_) rows_ = std::make_shared<Model>();
    return {rows_, written_output(scene_, {event.name, law, "", event.place}, model_, signals_)};
  }
  /// The columns of rows, once all laws are made.
  void finish() const {
    if (!rows_) return;
    rows_->system = model_.system;
    rows_->points = model_.points;
    rows_->stresses = model_.stresses;
    rows_->outputs = model_.outputs;
  }
  /// ": crank.angle > 1 (scene.yaml:9)"
  std::string described(const SceneEvent& event) const { return described(event, event.guard); }
  std::string described(const SceneEvent& event, const Law& law) const {
    const Place& place = event.place;
    return ": " + law.text + " (" + (place.file.empty() ? scene_.file : place.file) +
           (place.line > 0 ? ":" + std::to_string(place.line) : "") + ")";
  }

 private:
  const Scene& scene_;
  const Model& model_;
  SignalMaker& signals_;
  std::shared_ptr<Model> rows_;
};

using Inputs = std::array<double, most_law_inputs>;

Inputs inputs_of(const System& system, const SignalLaw& law, const State& state) {
  Inputs in{};
  for (std::size_t k = 0; k < law.in.size(); ++k) in[k] = signal_at(system, system.signals[at(law.in[k])], state.y);
  return in;
}

// "crank.angle = 1 rad, t = 2 s", of the inputs that `read` gives.
template <class Read>
std::function<std::string(const System&, const State&)> seen_by(const Law& law, const std::string& described, const Read& read) {
  return [read, law, described](const System& system, const State& state) {
    const auto in = read(system, state);
    return described +
           seen_by_law(law, law.of_signals, state.t, {in.begin(), in.begin() + static_cast<std::ptrdiff_t>(law.signals.size())});
  };
}

SetState setting(const Scene& scene, const SceneEvent& event, const std::string& name, const Law& value, EventLaws& laws) {
  const auto state = std::ranges::find(scene.states, name, &SceneState::name);
  if (state == scene.states.end()) throw SceneError(scene.file, event.place, "there is no state " + quoted(name) + " to set");
  const int index = static_cast<int>(state - scene.states.begin());
  const std::string described = laws.described(event, value);
  if (laws.names_columns(value)) {
    const RowLaw of = laws.of_a_row(value, event);
    return {name, [index, of](const System& system, const State& seen, State& now) { now.y[own_state(system, index)] = of(seen); },
            seen_by(value, described, [of](const System&, const State& there) { return of.inputs(there); })};
  }
  const SignalLaw of = laws.of_motion(value, event.place);
  return {name,
          [index, of](const System& system, const State& seen, State& now) {
            now.y[own_state(system, index)] = law_at(system, of, seen.t, seen.y);
          },
          seen_by(value, described, [of](const System& system, const State& there) { return inputs_of(system, of, there); })};
}

// Pitch of a gear or rack with backlash [m]; 0: unknown, or another joint.
double pitch_of_teeth(const Scene& scene, const Model& model, const std::string& name) {
  const auto joint = std::ranges::find(scene.joints, name, &SceneJoint::name);
  if (joint == scene.joints.end() || !joint->play || !joint->coupling) return 0;
  const int first = model.order.joints[static_cast<std::size_t>(joint - scene.joints.begin())];
  return pitch_of(*joint, *model.system.contacts[at(first)].flank);
}

std::vector<EventAction> actions_of(const Scene& scene, const SceneEvent& event, const SceneDoing& doing, const Model& model,
                                    EventLaws& laws) {
  const auto elements = elements_of(scene, model);
  std::vector<EventAction> out;
  for (const std::string& name : doing.release)
    out.push_back(SwitchOver{switch_at(model.system, find_element(scene, event, elements, name).is), false});
  for (const std::string& name : doing.engage)
    out.push_back(
        SwitchOver{switch_at(model.system, find_element(scene, event, elements, name).is), true, pitch_of_teeth(scene, model, name)});
  for (const auto& [name, value] : doing.set) out.push_back(setting(scene, event, name, value, laws));
  if (doing.row) out.push_back(Record::row);
  if (doing.save) out.push_back(Record::state);
  if (!doing.stop.empty()) out.push_back(StopRun{doing.stop});
  return out;
}

// The condition's comparisons; none if it is constant.
std::vector<Comparison> comparisons_of(const SceneEvent& event) {
  if (event.guard.constant) return {};
  const auto* of_time = event.guard.at.target<Program>();
  return comparisons(of_time ? *of_time : event.guard.of_signals.target<SignalFormula>()->program);
}

Known known_of_condition(const SceneEvent& event, double until) {
  if (event.guard.constant) return event.guard.at(0).value != 0 ? Known::always : Known::never;
  return known_of(comparisons_of(event), until);
}

// Warns of events and switches that are known beforehand to have no effect, and of conditions that never change.
void warn_of_events(const Scene& scene, Model& model) {
  std::set<std::string> released, engaged;
  for (const SceneEvent& event : scene.events)
    each_doing(event, [&](const SceneDoing& doing) {
      released.insert(doing.release.begin(), doing.release.end());
      engaged.insert(doing.engage.begin(), doing.engage.end());
    });
  for (const auto& [name, element] : elements_of(scene, model)) {
    if (element.is.released && !engaged.contains(name))
      model.warnings.push_back(quoted(name) + " starts released, and no event engages it: it never acts");
    if (!element.is.released && engaged.contains(name) && !released.contains(name))
      model.warnings.push_back(
          quoted(name) + " is engaged from the start and no event releases it, so engaging it has no effect; write engaged: false for it");
  }
  for (const SceneEvent& event : scene.events) {
    const Known known = known_of_condition(event, scene.has_run ? scene.run.until : std::numeric_limits<double>::infinity());
    if (known == Known::open) continue;
    model.warnings.push_back("the event " + quoted(event.name) +
                             (known == Known::always ? " occurs at the start and never again" : " never occurs") + ": its condition " +
                             event.guard.text +
                             (event.guard.constant     ? " does not change"
                              : known == Known::always ? " is always true"
                                                       : " is never true"));
  }
}

// The rate of a signal that depends only on positions; NaN for others.
double rate_of(const System& system, const MotionSignal& signal, const State& state) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (signal.kind == MotionSignal::state) return unknown;
  const MovingPoint a = moving_point(system, signal.a, state.y), b = of_two(signal.kind) ? moving_point(system, signal.b, state.y) : a;
  const SignalSlope slope = signal_slope(signal, a, b);
  if (!slope.rate_a.isZero(0) || !slope.rate_b.isZero(0)) return unknown;
  return slope.pose_a.head<2>().dot(a.v) + slope.pose_a[2] * a.w + slope.pose_b.head<2>().dot(b.v) + slope.pose_b[2] * b.w;
}

// A comparison that depends only on t.
SceneComparison of_time(const Law& law, const Comparison& from, const std::string& described) {
  return {.difference =
              [at = law.at, size = from.size](const System&, const State& state, const Wanted& wanted) {
                const Jet now = at(state.t);
                if (wanted.size) *wanted.size = size(state.t).value;
                return Guard{now.value, now.rate};
              },
          .at_zero = from.at_zero,
          .seen = [law, described](const System&, const State& state) { return described + seen_by_law(law, {}, state.t, {}); }};
}

// Computes further data of a comparison whose inputs have been read.
class Reading {
 public:
  explicit Reading(const Comparison& of) : size_(of.size), sides_(of.difference), inputs_(SignalFormula(of.difference).inputs) {}
  void add(double t, const double* in, const Wanted& wanted) const {
    if (wanted.size) *wanted.size = size_(t, in, nullptr);
    if (!wanted.kinks || sides_.switches() == 0) return;
    std::vector<int> found(at(sides_.switches()));
    std::vector<double> left(found.size());
    sides_.value(t, in, inputs_, nullptr, {nullptr, found.data(), left.data()});
    for (std::size_t k = 0; k < left.size(); ++k) wanted.kinks->push_back(found[k] * left[k]);
  }

 private:
  SignalFormula size_;
  SidedProgram sides_;
  std::size_t inputs_;
};

SceneComparison of_a_row(const Law& law, const Comparison& from, const SceneEvent& event, EventLaws& laws) {
  const RowLaw of = laws.of_a_row(law, event);
  return {.difference =
              [of, more = Reading(from)](const System&, const State& state, const Wanted& wanted) {
                const std::vector<double> in = of.inputs(state);
                more.add(state.t, in.data(), wanted);
                return Guard{of.function()(state.t, in.data(), nullptr)};
              },
          .at_zero = from.at_zero,
          .seen = seen_by(law, laws.described(event), [of](const System&, const State& state) { return of.inputs(state); })};
}

SceneComparison of_motion(const Law& law, const Comparison& from, const SceneEvent& event, const System& built, EventLaws& laws) {
  const SignalLaw of = laws.of_motion(law, event.place);
  const auto read = [of](const System& system, const State& state) { return inputs_of(system, of, state); };
  return {
      .difference =
          [of, more = Reading(from), changes_by_itself = law.uses_time](const System& system, const State& state, const Wanted& wanted) {
            Inputs slope{};
            const Inputs in = inputs_of(system, of, state);
            more.add(state.t, in.data(), wanted);
            const bool rate = wanted.rate && !changes_by_itself;
            Guard now{of.of(state.t, in.data(), rate ? slope.data() : nullptr)};
            if (!rate) return now;
            now.rate = 0;
            for (std::size_t k = 0; k < of.in.size(); ++k)
              if (slope[k] != 0) now.rate += slope[k] * rate_of(system, system.signals[at(of.in[k])], state);
            return now;
          },
      .at_zero = from.at_zero,
      .of_speeds = std::ranges::any_of(of.in, [&](int k) { return is_speed(built.signals[at(k)].kind); }),
      .seen = seen_by(law, laws.described(event), read)};
}

std::vector<SceneComparison> condition_of(const SceneEvent& event, const System& system, EventLaws& laws) {
  if (event.guard.constant) {
    const double holds = event.when[0].at(0).value;
    return {{.difference = [holds](const System&, const State&, const Wanted& wanted) {
      if (wanted.size) *wanted.size = 1;
      return Guard{holds, 0};
    }}};
  }
  const std::vector<Comparison> from = comparisons_of(event);
  std::vector<SceneComparison> out;
  for (std::size_t k = 0; k < from.size(); ++k) {
    const Law& law = event.when[k];
    out.push_back(law.signals.empty()       ? of_time(law, from[k], laws.described(event))
                  : laws.names_columns(law) ? of_a_row(law, from[k], event, laws)
                                            : of_motion(law, from[k], event, system, laws));
  }
  return out;
}

}  // namespace

void add_switches(const Scene& scene, Model& model) {
  const auto elements = elements_of(scene, model);
  std::set<std::string> switched;
  for (const SceneEvent& event : scene.events)
    each_doing(event, [&](const SceneDoing& doing) {
      for (const auto* names : {&doing.release, &doing.engage})
        for (const std::string& name : *names) find_element(scene, event, elements, name), switched.insert(name);
    });
  for (const auto& [name, element] : elements) {
    if (!element.is.released && !switched.contains(name)) continue;
    if (!element.refusal.empty()) throw SceneError(scene.file, element.place, quoted(name) + " cannot be released: " + element.refusal);
    model.system.switches.push_back(element.is);
  }
  warn_of_events(scene, model);
}

void add_events(const Scene& scene, Model& model, SignalMaker& signals) {
  if (scene.events.empty()) return;
  std::vector<SceneEventRule> rules;
  EventLaws laws(scene, model, signals);
  for (const SceneEvent& event : scene.events) {
    rules.push_back({.name = event.name,
                     .when = condition_of(event, model.system, laws),
                     .actions = actions_of(scene, event, event.then, model, laws),
                     .otherwise = actions_of(scene, event, event.otherwise, model, laws),
                     .once = event.once,
                     .from_start = event.from_start});
  }
  laws.finish();
  model.scheme.events.push_back([rules](const System& system) { return std::make_unique<SceneEvents>(system, rules); });
}

}  // namespace pintle
