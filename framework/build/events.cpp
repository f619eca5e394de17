#include "framework/build/events.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <memory>
#include <set>

#include "framework/common/index.h"
#include "framework/dynamics/model/signal_values.h"
#include "framework/dynamics/model/marker_motion.h"
#include "framework/common/nearest.h"
#include "framework/common/text.h"
#include "framework/configuration/unsound_laws.h"
#include "framework/integration/events/scene_events.h"
#include "framework/mechanism/row_law.h"
#include "framework/scene/error.h"

namespace pintle {

namespace {

// An element as the scene names it.
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
      one.refusal = "its clearance is a massless link, which holds always; take model: contact";
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

// The laws of one event: of the motion alone, or of what a row of the trajectory would have.
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
  /// What rows are made of, when all laws are made.
  void finish() const {
    if (!rows_) return;
    rows_->system = model_.system;
    rows_->points = model_.points;
    rows_->stresses = model_.stresses;
    rows_->outputs = model_.outputs;
  }
  /// ": crank.angle > 1 (scene.yaml:9)"
  std::string told(const SceneEvent& event) const {
    const Place& place = event.place;
    return ": " + event.guard.text + " (" + (place.file.empty() ? scene_.file : place.file) +
           (place.line > 0 ? ":" + std::to_string(place.line) : "") + ")";
  }

 private:
  const Scene& scene_;
  const Model& model_;
  SignalMaker& signals_;
  std::shared_ptr<Model> rows_;
};

SetState setting(const Scene& scene, const SceneEvent& event, const std::string& name, const Law& value, EventLaws& laws) {
  const auto state = std::ranges::find(scene.states, name, &SceneState::name);
  if (state == scene.states.end()) throw SceneError(scene.file, event.place, "there is no state " + quoted(name) + " to set");
  const int index = static_cast<int>(state - scene.states.begin());
  if (laws.names_columns(value))
    return {name, [index, law = laws.of_a_row(value, event)](const System& system, const State& seen, State& now) {
              now.y[own_state(system, index)] = law(seen);
            }};
  return {name, [index, law = laws.of_motion(value, event.place)](const System& system, const State& seen, State& now) {
            now.y[own_state(system, index)] = law_at(system, law, seen.t, seen.y);
          }};
}

std::vector<EventAction> actions_of(const Scene& scene, const SceneEvent& event, const SceneDoing& doing, const Model& model,
                                    EventLaws& laws) {
  const auto elements = elements_of(scene, model);
  std::vector<EventAction> out;
  for (const std::string& name : doing.release)
    out.push_back(SwitchOver{switch_at(model.system, find_element(scene, event, elements, name).is), false});
  for (const std::string& name : doing.engage)
    out.push_back(SwitchOver{switch_at(model.system, find_element(scene, event, elements, name).is), true});
  for (const auto& [name, value] : doing.set) out.push_back(setting(scene, event, name, value, laws));
  if (doing.row) out.push_back(Record::row);
  if (doing.save) out.push_back(Record::state);
  if (!doing.stop.empty()) out.push_back(StopRun{doing.stop});
  return out;
}

// Where what is known beforehand says that an event never does anything, or always.
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
          quoted(name) + " is engaged from the start, and no event releases it: to engage it does nothing; write engaged: false there");
  }
  for (const SceneEvent& event : scene.events)
    if (event.guard.constant)
      model.warnings.push_back("the event " + quoted(event.name) +
                               (event.guard.at(0).value != 0 ? " comes at the start and never again" : " never comes") +
                               ": its condition " + event.guard.text + " does not change");
}

// The rate of a signal that is one of places alone; NaN of others.
double rate_of(const System& system, const MotionSignal& signal, const State& state) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (signal.kind == MotionSignal::state) return unknown;
  const MovingPoint a = moving_point(system, signal.a, state.y), b = of_two(signal.kind) ? moving_point(system, signal.b, state.y) : a;
  const SignalSlope slope = signal_slope(signal, a, b);
  if (!slope.rate_a.isZero(0) || !slope.rate_b.isZero(0)) return unknown;
  return slope.pose_a.head<2>().dot(a.v) + slope.pose_a[2] * a.w + slope.pose_b.head<2>().dot(b.v) + slope.pose_b[2] * b.w;
}

void add_guard(const SceneEvent& event, const Law& law, EventLaws& laws, SceneEventRule& rule) {
  const auto seen_in = [told = laws.told(event), law](const SignalFunction& of, double t, const std::vector<double>& in) {
    return told + seen_by_law(law, of, t, in);
  };
  if (law.signals.empty()) {
    rule.when.push_back([at = law.at](const System&, const State& state) {
      const Jet now = at(state.t);
      return Guard{now.value, now.rate};
    });
    rule.seen.push_back([seen_in](const System&, const State& state) { return seen_in({}, state.t, {}); });
    return;
  }
  if (laws.names_columns(law)) {
    const RowLaw of = laws.of_a_row(law, event);
    rule.when.push_back([of](const System&, const State& state) { return Guard{of(state)}; });
    rule.seen.push_back([of, seen_in](const System&, const State& state) { return seen_in(of.function(), state.t, of.inputs(state)); });
    return;
  }
  const SignalLaw of = laws.of_motion(law, event.place);
  rule.when.push_back([of, changes_by_itself = law.uses_time](const System& system, const State& state) {
    std::array<double, most_law_inputs> in, slope;
    for (std::size_t k = 0; k < of.in.size(); ++k) in[k] = signal_at(system, system.signals[at(of.in[k])], state.y);
    Guard out{of.of(state.t, in.data(), slope.data())};
    if (changes_by_itself) return out;
    out.rate = 0;
    for (std::size_t k = 0; k < of.in.size(); ++k)
      if (slope[k] != 0) out.rate += slope[k] * rate_of(system, system.signals[at(of.in[k])], state);
    return out;
  });
  rule.seen.push_back([of, seen_in](const System& system, const State& state) {
    std::vector<double> in;
    for (const int k : of.in) in.push_back(signal_at(system, system.signals[at(k)], state.y));
    return seen_in(of.of, state.t, in);
  });
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
    SceneEventRule rule{.name = event.name,
                        .when = {},
                        .actions = actions_of(scene, event, event.then, model, laws),
                        .otherwise = actions_of(scene, event, event.otherwise, model, laws),
                        .once = event.once,
                        .from_start = event.from_start};
    for (const Law& law : event.when) add_guard(event, law, laws, rule);
    rules.push_back(std::move(rule));
  }
  laws.finish();
  model.scheme.events.push_back([rules](const System& system) { return std::make_unique<SceneEvents>(system, rules); });
}

}  // namespace pintle
