#include "fmi/contents.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "framework/common/nearest.h"
#include "framework/common/text.h"
#include "framework/mechanism/result_tables.h"
#include "framework/scene/error.h"

namespace pintle::fmi {

namespace {

using Json = nlohmann::json;

std::string written(std::string unit) {
  std::ranges::replace(unit, '*', ' ');
  return unit == "1" ? "" : unit;
}

/// "crank.x [m]" as name and unit.
FmuVariable column_variable(const std::string& heading) {
  const std::size_t open = heading.rfind(" [");
  return {FmuVariable::column, heading.substr(0, open), written(heading.substr(open + 2, heading.size() - open - 3)), heading};
}

/// "pin.fx on crank" without the body.
std::string without_body(const std::string& name) { return name.substr(0, name.find(" on ")); }

bool can_be_input(const SceneState& state) { return state.rate.constant && state.rate.at && state.rate.at(0).value == 0; }

std::set<std::string> set_by_events(const Scene& scene) {
  std::set<std::string> out;
  for (const SceneEvent& event : scene.events)
    for (const SceneDoing* doing : {&event.then, &event.otherwise})
      for (const auto& [state, value] : doing->set) out.insert(state);
  return out;
}

std::vector<std::string> chosen_inputs(const Scene& scene, const std::vector<std::string>& wanted) {
  const std::set<std::string> set = set_by_events(scene);
  std::vector<std::string> able, states;
  for (const SceneState& state : scene.states) {
    states.push_back(state.name);
    if (can_be_input(state) && !set.contains(state.name)) able.push_back(state.name);
  }
  for (const std::string& name : wanted) {
    if (std::ranges::find(able, name) != able.end()) continue;
    const std::string start = "--input " + name + ": ";
    if (set.contains(name)) throw SceneError(start + "an event of the scene sets this state, so that no importer can; take another one");
    if (std::ranges::find(states, name) != states.end())
      throw SceneError(start +
                       "the scene gives this state a rate; an input is a state whose rate is 0, as in {rate: 0 N m/s, start: 0 N m}");
    throw SceneError(start + (able.empty()
                                  ? "the scene has no state whose rate is 0, which is what an input is: states: {torque: {rate: 0 N "
                                    "m/s, start: 0 N m}}"
                                  : "is no state of the scene whose rate is 0." + did_you_mean(name, able)));
  }
  return wanted.empty() ? able : wanted;
}

void choose_outputs(const Scene& scene, const std::vector<std::string>& wanted, std::vector<FmuVariable>& variables) {
  std::vector<std::string> names = wanted, known;
  if (names.empty())
    for (const SceneOutput& output : scene.outputs)
      if (!output.place.key.starts_with("states.")) names.push_back(output.name);  // PID controllers were not chosen
  const bool all = names.empty();
  for (FmuVariable& v : variables)
    if (v.kind == FmuVariable::column) v.output = all, known.push_back(v.name);
  for (const std::string& name : names) {
    bool found = false;
    for (FmuVariable& v : variables)
      if (v.kind == FmuVariable::column && (v.name == name || without_body(v.name) == name)) v.output = found = true;
    if (!found) throw SceneError("--output " + name + ": there is no column of that name." + did_you_mean(name, known));
  }
}

}  // namespace

std::vector<FmuVariable> variables_of(const Scene& scene, const Model& model, const std::vector<std::string>& inputs,
                                      const std::vector<std::string>& outputs) {
  std::vector<FmuVariable> out{{FmuVariable::time, "time", "s"}};
  std::set<std::string> taken{"time"};
  const auto add = [&](FmuVariable v) {
    while (!taken.insert(v.name).second) v.name = v.kind == FmuVariable::parameter ? "parameters." + v.name : v.name + "'";
    out.push_back(std::move(v));
  };
  const std::vector<std::string> given = chosen_inputs(scene, inputs);
  for (const SceneState& state : scene.states)
    if (std::ranges::find(given, state.name) != given.end())
      add({FmuVariable::input, state.name, written(state.unit), state.name, state.start});
  for (const std::string& heading : trajectory_table(model).header) {
    const FmuVariable v = column_variable(heading);
    if (v.name != "t" && std::ranges::find(given, v.name) == given.end()) add(v);
  }
  choose_outputs(scene, outputs, out);
  for (const SceneEvent& event : scene.events) add({FmuVariable::happened, event.name + ".happened", "", event.name});
  std::set<std::string> named;
  for (const std::string& contact : model.system.contact_names)
    if (named.insert(contact).second) {
      add({FmuVariable::contacts, contact + ".contacts", "", contact});
      add({FmuVariable::touching, contact + ".touching", "", contact});
    }
  for (const SceneParameter& p : scene.parameters) add({FmuVariable::parameter, p.name, written(p.unit), p.name, p.value});
  return out;
}

std::string text_of(const FmuContents& c) {
  Json variables = Json::array();
  for (const FmuVariable& v : c.variables)
    variables.push_back({{"kind", v.kind}, {"name", v.name}, {"unit", v.unit}, {"of", v.of}, {"start", v.start}, {"output", v.output}});
  return Json{{"title", c.title},         {"scene", c.scene}, {"token", c.token},         {"set", c.set},
              {"variables", variables},   {"until", c.until}, {"tolerance", c.tolerance}, {"every", c.every},
              {"version", PINTLE_VERSION}}
      .dump(1);
}

FmuContents contents_of(const std::string& text) {
  try {
    const Json said = Json::parse(text);
    FmuContents out{said.at("title"), said.at("scene"),     said.at("token"), said.at("set").get<Overrides>(), {},
                    said.at("until"), said.at("tolerance"), said.at("every")};
    for (const Json& v : said.at("variables"))
      out.variables.push_back(
          {v.at("kind").get<FmuVariable::Kind>(), v.at("name"), v.at("unit"), v.at("of"), v.at("start"), v.at("output")});
    return out;
  } catch (const Json::exception& error) {
    throw std::runtime_error(std::string("resources/") + contents_file + " cannot be read (" + error.what() + "); unpack the unit again");
  }
}

}  // namespace pintle::fmi
