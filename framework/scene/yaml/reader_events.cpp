#include <algorithm>
#include <array>
#include <initializer_list>
#include <numbers>

#include "framework/common/nearest.h"
#include "framework/common/text.h"
#include "framework/scene/units/guard.h"
#include "framework/scene/units/program_parts.h"
#include "framework/scene/units/signal_law.h"
#include "framework/scene/units/signal_words.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

std::vector<std::string> read_names(const Node& node) {
  constexpr const char* what = "the name of a joint, driver, force or contact, or a list of them";
  if (!node.is_list()) return {node.part(what).part};
  std::vector<std::string> out;
  for (const Node& item : node.list(1, what)) out.push_back(item.part(what).part);
  return out;
}

Law read_event_law(const Node& node, const Dimension& expected, const SignalNames& names) {
  try {
    return read_law(node.expression("an expression in t and signals, " + describe(expected)), expected, node.source().parameters, &names);
  } catch (const ExpressionError& error) {
    node.fail(error.what());
  }
}

// Rejects an output: it is computed, as that of a PID controller from its states.
void refuse_output(const Node& node, const std::string& name, const Scene& scene) {
  const auto output = std::ranges::find(scene.outputs, name, &SceneOutput::name);
  if (output == scene.outputs.end()) return;
  std::vector<std::string> parts;
  for (const SceneState& s : scene.states)
    if (s.place.key == output->place.key) parts.push_back("\"" + s.name + "\"");
  node.fail("\"" + name + "\" is not a state: it is computed from others" +
            (parts.empty() ? "; set a state or a parameter that it names" : "; set one of its states: " + listed(parts)));
}

std::vector<std::pair<std::string, Law>> read_settings(const Node& group, const Scene& scene, const SignalNames& names) {
  std::vector<std::pair<std::string, Law>> out;
  for (const Node& node : group.entries("names of states and their new values: {integral: 0}")) {
    const std::string name = resolved(node.source(), node.yaml().scope, {node.name(), ""}).part;
    if (std::ranges::find(scene.states, name, &SceneState::name) == scene.states.end()) {
      refuse_output(node, name, scene);
      std::vector<std::string> known;
      for (const SceneState& s : scene.states) known.push_back(s.name);
      for (const SceneParameter& p : scene.parameters) known.push_back(p.name);
      if (const Scope* own = node.source().scope(node.yaml().scope); own && own->own.contains(node.name()))
        node.fail("\"" + node.name() +
                  "\" is a parameter of the assembly, and only those of the scene can be set; make it a state of the assembly: states: {" +
                  node.name() + "_now: {rate: 0, start: " + node.name() + "}}");
      node.fail(
          "there is no state \"" + node.name() + "\", and no parameter" +
          (known.empty() ? "; add one under states: {" + node.name() + ": {rate: 0, start: 0}}" : "." + did_you_mean(node.name(), known)));
    }
    out.emplace_back(name, read_event_law(node, names.find(name)->second.dimension, names));
  }
  return out;
}

SceneDoing read_doing(const Node& node, const std::string& keys, const Scene& scene, const SignalNames& names) {
  check_keys(node, keys);
  SceneDoing out;
  if (node.has("release")) out.release = read_names(node.at("release"));
  if (node.has("engage")) out.engage = read_names(node.at("engage"));
  for (const std::string& name : out.release)
    if (std::ranges::find(out.engage, name) != out.engage.end())
      node.at("engage").fail("\"" + name + "\" is released and engaged by one event; keep one of them");
  if (node.has("set")) out.set = read_settings(node.at("set"), scene, names);
  if (node.has("stop")) out.stop = node.at("stop").text("why the run stops: \"the crank has come to rest\"");
  if (node.has("save")) out.save = node.at("save").yes();
  if (node.has("row")) out.row = node.at("row").yes();
  if (!out.does()) node.fail("has no effect; write for example {release: latch pin}");
  return out;
}

// For a constant condition, a single constant function.
std::vector<Law> read_comparisons(const Node& node, const Law& condition) {
  if (condition.constant) {
    const double holds = condition.at(0).value;
    if (holds != 0 && holds != 1) node.fail(node.shown() + " is not a condition; write a comparison such as t > 0.1 s");
    return {{[holds](double) { return Jet{holds - 0.5, 0, 0}; }, condition.text, true}};
  }
  std::vector<Law> out;
  try {
    const auto* of_time = condition.at.target<Program>();
    for (Comparison& comparison : comparisons(of_time ? *of_time : condition.of_signals.target<SignalFormula>()->program)) {
      Program& one = comparison.difference;
      Law law{.at = {}, .text = condition.text, .constant = false, .uses_time = names(one, Op::time)};
      if (names(one, Op::input))
        law.of_signals = SignalFormula(std::move(one)), law.signals = condition.signals;
      else
        law.at = std::move(one);
      out.push_back(std::move(law));
    }
  } catch (const ExpressionError& error) {
    node.fail("\"" + condition.text + "\": " + error.what());
  }
  return out;
}

// A signal alone, or a formula of signals that compares nothing.
void refuse_number(const Node& when, const SignalNames& names) {
  const std::string text = when.expression("a comparison");
  std::vector<Word> words;
  try {
    words = spell(text, {when.source().parameters, {}, &names});
  } catch (const ExpressionError&) {  // reported when it is read
    return;
  }
  const auto compares = [](const Word& word) {
    return std::ranges::any_of(std::array{"<", ">", "<=", ">=", "==", "!=", "&&", "||"},
                               [&](const char* sign) { return word.text == sign; });
  };
  if (std::ranges::none_of(words, [](const Word& word) { return word.kind == Word::Kind::signal; }) || std::ranges::any_of(words, compares))
    return;
  std::string unit, example = "rod.angle > 30 deg";
  if (words.size() == 1) {
    unit = si_unit(names.find(words[0].text)->second.dimension);
    example = words[0].text + " > 1" + (unit.empty() ? "" : " " + unit);
  }
  when.fail("\"" + text + "\" is a number" + (unit.empty() ? "" : " in " + unit) + "; write a comparison such as " + example);
}

// "arm.angle > 30", which may be meant in degrees.
void doubt_bare_angles(const Node& when, const SignalNames& names) {
  std::vector<std::string>* doubts = when.source().doubts;
  if (!doubts) return;
  const std::string text = when.expression("a comparison");
  const std::vector<Word> words = spell(text, {when.source().parameters, {}, &names});
  constexpr double turn = 2 * std::numbers::pi;
  const auto is = [&](std::size_t i, std::initializer_list<const char*> texts) {
    return i < words.size() && std::ranges::any_of(texts, [&](const char* one) { return words[i].text == one; });
  };
  for (std::size_t i = 0; i + 2 < words.size(); ++i) {
    if (words[i].kind != Word::Kind::signal || (i > 0 && !is(i - 1, {"&&"})) || !is(i + 1, {"<", ">", "<=", ">="})) continue;
    const Dimension& d = names.find(words[i].text)->second.dimension;
    const std::size_t number = is(i + 2, {"-"}) ? i + 3 : i + 2;
    const bool alone = number + 1 == words.size() || is(number + 1, {"&&"});
    if (d.angle != 1 || !same(d, dimension::number) || number >= words.size() || words[number].kind != Word::Kind::number || !alone)
      continue;
    if (words[number].value > turn)
      doubts->push_back(SceneError(when.source().file, when.place(),
                                   "\"" + text + "\": " + words[number].text + " without a unit is in rad, " +
                                       number_text(words[number].value / turn, 3) + " turns; if degrees are meant, write \"" +
                                       words[number].text + " deg\", else \"" + words[number].text + " rad\"")
                            .what());
  }
}

SceneEvent read_event(const Node& node, const Scene& scene, const SignalNames& names) {
  SceneEvent event;
  event.name = checked_name(node);
  event.place = node.place();
  check_keys(node, "events.*");
  const Node when = node.at("when");
  refuse_number(when, names);
  event.guard = read_event_law(when, dimension::number, names);
  event.when = read_comparisons(when, event.guard);
  doubt_bare_angles(when, names);
  if (node.has("once")) event.once = node.at("once").yes();
  if (node.has("from start")) event.from_start = node.at("from start").yes();
  event.then = read_doing(node.at("do"), "events.*.do", scene, names);
  if (node.has("else")) event.otherwise = read_doing(node.at("else"), "events.*.else", scene, names);
  if (event.once && node.has("else"))
    node.at("else").fail("never happens: an event with once does not wait for the end of its condition; leave out once or else");
  return event;
}

}  // namespace

void read_events(const Node& root, Scene& scene) {
  if (!root.has("events")) return;
  const SignalNames names = signal_names(signal_words(scene), SignalUse::written);
  for (const Node& node : root.at("events").entries("names and events: {trip: {when: crank.angle > 30 deg, do: {release: latch pin}}}"))
    scene.events.push_back(read_event(node, scene, names));
}

bool read_engaged(const Node& node) { return !node.has("engaged") || node.at("engaged").yes(); }

}  // namespace pintle
