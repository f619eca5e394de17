// What the scene says of signals: laws of them, states of its own, outputs.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <locale>
#include <sstream>

#include "framework/scene/units/signal_words.h"
#include "framework/scene/units/signal_law.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

// Cheaper than to list all signals of a large scene for "10 N": a letter after a dot, or a name without one.
bool may_name_signals(const std::string& text, const Scene& scene) {
  if (!scene.states.empty()) return true;
  for (std::size_t dot = text.find('.'); dot != std::string::npos; dot = text.find('.', dot + 1))
    if (dot + 1 < text.size() && std::isalpha(static_cast<unsigned char>(text[dot + 1]))) return true;
  return false;
}

Law read_acting_law(const Node& node, const Dimension& expected, const SignalNames& names) {
  try {
    return read_law(node.expression("an expression in t and signals, " + describe(expected)), expected, node.source().parameters, &names);
  } catch (const ExpressionError& error) {
    node.fail(error.what());
  }
}

std::string json_quoted(const std::string& s) {
  std::string out = "\"";
  for (const char c : s) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

// As `filled_in` turns it back into keys.
std::string signal_table_text(const Node& node, bool linear, bool periodic, double over_unit, const std::string& over_si, double value_unit,
                              const std::string& value_si) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(17);
  out << "{\"table\": " << json_quoted(node.at("table").file("")) << ", \"interpolation\": \"" << (linear ? "linear" : "spline")
      << "\", \"over\": " << json_quoted(node.at("over").expression("")) << ", \"periodic\": " << (periodic ? "true" : "false");
  if (over_unit != 1) out << ", \"over unit\": \"" << over_unit << " " << over_si << "\"";
  if (value_unit != 1) out << ", \"value unit\": \"" << value_unit << " " << value_si << "\"";
  out << "}";
  return out.str();
}

void must_close(const Node& node, const Samples& samples) {
  constexpr double alike = 1e-9;
  const auto [least, most] = std::ranges::minmax(samples.value);
  if (std::abs(samples.value.back() - samples.value.front()) <= alike * (most - least)) return;
  node.at("periodic")
      .fail("the table " + node.at("table").shown() +
            " does not end with the value that it begins with; let its last row be the first one a period later");
}

Law read_signal_table(const Node& node, std::string_view keys, const Dimension& expected, const std::filesystem::path& folder,
                      ActingSignals& signals) {
  if (node.has("time unit")) node.at("time unit").fail("belongs to a table over t; of a table over signals write `over unit`");
  const Node over = node.at("over");
  MeasuredLaw x;
  try {
    x = read_measured_law(over.expression("a signal such as ram.y"), node.source().parameters, signals.names());
  } catch (const ExpressionError& error) {
    over.fail(error.what());
  }
  if (x.law.signals.empty()) over.fail(over.shown() + " names no signal; write one such as ram.y, or leave `over` out for a table over t");
  const bool linear = node.has("interpolation") && node.at("interpolation").one_of(choices(keys, "interpolation")) == "linear";
  const bool periodic = node.has("periodic") && node.at("periodic").yes();
  const double over_unit = unit_factor(node, "over unit", x.dimension), value_unit = unit_factor(node, "value unit", expected);
  Samples samples = read_samples(table_file(node, folder), over_unit, value_unit, node.place().key, "x");
  const SignalFormula& formula = *x.law.of_signals.target<SignalFormula>();
  const std::string text = signal_table_text(node, linear, periodic, over_unit, si_unit(x.dimension), value_unit, si_unit(expected));
  Law out{{}, text, false};
  out.signals = x.law.signals;
  out.uses_time = x.law.uses_time;
  if (periodic) {
    must_close(node, samples);
    out.of_signals = periodic_table(std::move(samples), linear, formula);
  } else if (linear) {
    out.of_signals = SignalTable{Polyline(std::move(samples)), formula};
  } else {
    out.of_signals = SignalTable{Spline(std::move(samples)), formula};
  }
  return out;
}

// A name that an expression can tell from all others.
void check_signal_name(const Node& node, const Scene& scene, const char* what) {
  const std::string name = checked_name(node);
  if (const std::string fault = fault_of_name(name);
      !fault.empty() && (std::ranges::all_of(name, [](char c) { return c != ' ' && c != '-'; }) || !std::isalpha(name.front())))
    node.fail("\"" + name + "\" cannot name " + what + ": " + fault);
  if (node.source().parameters.contains(name)) node.fail("\"" + name + "\" is a parameter too; give this " + what + " a name of its own");
  if (std::ranges::find(scene.states, name, &SceneState::name) != scene.states.end())
    node.fail("\"" + name + "\" is a state too; give this " + what + " a name of its own");
}

}  // namespace

const SignalNames& ActingSignals::names() {
  if (!names_) names_ = signal_names(signal_words(scene_), SignalUse::acts);
  return *names_;
}

Law read_load_law(const Node& node, std::string_view keys, const Dimension& expected, const std::filesystem::path& folder, double until,
                  ActingSignals& signals) {
  if (node.is_map()) {
    check_keys(node, keys);
    if (node.has("over")) return read_signal_table(node, keys, expected, folder, signals);
    for (const char* key : {"over unit", "periodic"})
      if (node.has(key)) node.at(key).fail("belongs to a table over signals; add over: crank.angle, or leave it out");
  } else if (node.is_scalar() && may_name_signals(node.yaml().text, signals.scene())) {
    Law law = read_acting_law(node, expected, signals.names());
    if (!law.signals.empty()) return law;
  }
  return read_time_law(node, expected, Smoothness::load, folder, until);
}

void read_states(const Node& root, Scene& scene) {
  if (!root.has("states")) return;
  for (const Node& node : root.at("states").entries("names and states: {integral: {rate: setpoint - arm.angle, start: 0 rad s}}")) {
    check_signal_name(node, scene, "a state");
    check_keys(node, "states.*");
    SceneState state;
    state.name = node.name();
    state.place = node.place();
    Dimension d = dimension::number;
    if (node.has("unit")) {
      try {
        d = read_quantity(node.at("unit").text("a unit such as rad s")).dimension;
      } catch (const ExpressionError& error) {
        node.at("unit").fail(error.what());
      }
    } else if (node.has("start")) {
      try {
        d = read_quantity(node.at("start").text("a value such as 0 rad s"), node.at("start").parameters()).dimension;
      } catch (const ExpressionError& error) {
        node.at("start").fail(error.what());
      }
    }
    state.unit = si_unit(d);
    read_optional(node, "start", d, rule::any, state.start);
    if (state.start != 0) state.scale = std::abs(state.start);
    read_optional(node, "scale", d, rule::positive, state.scale);
    scene.states.push_back(std::move(state));
  }
}

void read_state_rates(const Node& root, Scene& scene) {
  if (scene.states.empty()) return;
  const SignalNames names = signal_names(signal_words(scene), SignalUse::acts);
  for (SceneState& state : scene.states) {
    const Dimension d = names.find(state.name)->second.dimension;
    state.rate = read_acting_law(root.at("states").at(state.name).at("rate"), product(d, dimension::rate), names);
  }
}

void read_outputs(const Node& root, Scene& scene) {
  if (!root.has("outputs")) return;
  const std::vector<Node> entries = root.at("outputs").entries("names and expressions: {power: gas.fx*piston.vx}");
  auto words = signal_words(scene);
  SignalNames names = signal_names(words, SignalUse::written);
  for (const Node& node : entries) {
    check_signal_name(node, scene, "an output");
    if (names.contains(node.name())) node.fail("\"" + node.name() + "\" is a signal already; give this output a name of its own");
    const std::string text = node.expression("an expression such as gas.fx*piston.vx");
    try {
      MeasuredLaw read = read_measured_law(text, node.source().parameters, names);
      scene.outputs.push_back({node.name(), std::move(read.law), si_unit(read.dimension), node.place()});
      names[node.name()] = {read.dimension, ""};
    } catch (const ExpressionError& error) {
      const std::string said = error.what();
      for (const Node& other : entries)
        if (said.find("\"" + other.name() + "\" is neither") != std::string::npos)
          node.fail("\"" + text + "\": " + other.name() +
                    " is not known yet; an output may name those above it, and not itself, so write " + other.name() + " above " +
                    node.name());
      node.fail(said);
    }
  }
}

}  // namespace pintle
