// The parts of a scene about signals: laws of them, own states, outputs.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <locale>
#include <set>
#include <sstream>

#include "framework/scene/units/signal_words.h"
#include "framework/scene/units/signal_law.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

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

// The argument of a table: an expression, and the unit of its column in the table.
struct TableAxis {
  MeasuredLaw law;
  std::string text;
  double unit = 1;
};

double unit_of(const Node& node, const Dimension& expected) {
  try {
    const Quantity unit = read_quantity(node.text("a unit such as rpm or mm"));
    if (!same(unit.dimension, expected) || (bare(unit.dimension) && !bare(expected)))
      node.fail(node.shown() + " measures " + describe(unit.dimension) + "; expected a unit of " + describe(expected));
    return unit.value;
  } catch (const ExpressionError&) {
    node.fail(node.shown() + " is not a unit; write one such as rpm or mm");
  }
}

TableAxis read_axis(const Node& over, const Node* unit, const SignalNames& names) {
  TableAxis out;
  out.text = over.expression("a signal such as ram.y");
  try {
    out.law = read_measured_law(out.text, over.source().parameters, names);
    out.text = out.law.law.text;
  } catch (const ExpressionError& error) {
    over.fail(error.what());
  }
  if (unit) out.unit = unit_of(*unit, out.law.dimension);
  return out;
}

std::string json_unit(const TableAxis& axis) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(17);
  out << axis.unit << " " << si_unit(axis.law.dimension);
  return json_quoted(axis.unit == 1 && si_unit(axis.law.dimension).empty() ? "1" : out.str());
}

// The table as text that `filled_in` converts back to keys.
std::string signal_table_text(const Node& node, const std::vector<TableAxis>& axes, const char* interpolation, bool periodic,
                              Outside outside, double value_unit, const std::string& value_si) {
  const auto listed = [&](const auto& word) {
    if (axes.size() == 1) return word(axes[0]);
    return "[" + word(axes[0]) + ", " + word(axes[1]) + "]";
  };
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(17);
  out << "{\"table\": " << json_quoted(node.at("table").file(""))
      << ", \"over\": " << listed([](const TableAxis& axis) { return json_quoted(axis.text); });
  if (axes.size() == 1) out << ", \"interpolation\": \"" << interpolation << "\", \"periodic\": " << (periodic ? "true" : "false");
  if (std::ranges::any_of(axes, [](const TableAxis& axis) { return axis.unit != 1; })) out << ", \"over unit\": " << listed(json_unit);
  if (!periodic && outside != Outside::holds_unasked) out << ", \"outside\": \"" << (outside == Outside::holds ? "hold" : "refuse") << "\"";
  if (value_unit != 1 || (node.has("value unit") && !value_si.empty()))
    out << ", \"value unit\": \"" << value_unit << " " << value_si << "\"";
  out << "}";
  return out.str();
}

void must_close(const Node& node, const Samples& samples) {
  constexpr double alike = 1e-9;
  const auto [least, most] = std::ranges::minmax(samples.value);
  if (std::abs(samples.value.back() - samples.value.front()) <= alike * (most - least)) return;
  node.at("periodic")
      .fail("the table " + node.at("table").shown() +
            " does not end with its first value; make its last row the first one, a period later");
}

Outside read_outside(const Node& node, std::string_view keys, Outside otherwise) {
  if (!node.has("outside")) return otherwise;
  return node.at("outside").one_of(choices(keys, "outside")) == "hold" ? Outside::holds : Outside::rejected;
}

// Checks a table without `over`.
void must_be_of_time(const Node& node) {
  for (const char* key : {"over unit", "periodic", "outside"})
    if (node.has(key)) node.at(key).fail("is for a table over signals; add over: crank.angle, or leave it out");
}

// The same formula with input i renamed to[i].
SignalFormula renumbered(const Law& law, const std::vector<int>& to) {
  if (law.constant) return SignalFormula(Program{{{Op::constant, law.at(0).value}}});
  Program program = law.signals.empty() ? *law.at.target<Program>() : law.of_signals.target<SignalFormula>()->program;
  for (Program::Instruction& i : program.code)
    if (i.op == Op::input) i.value = to[static_cast<std::size_t>(i.value)];
  return SignalFormula(std::move(program));
}

Law read_signal_map(const Node& node, std::string_view keys, const Dimension& expected, const std::filesystem::path& folder,
                    const SignalNames& names) {
  for (const char* key : {"interpolation", "periodic"})
    if (node.has(key)) node.at(key).fail("is for a table over one number; a table over two is bilinear: leave it out");
  const std::vector<Node> over = node.at("over").items(2, "an expression, or two for a table over both: [engine.speed, throttle]");
  std::vector<Node> units;
  if (node.has("over unit")) units = node.at("over unit").items(2, "a unit for each: [rpm, 1]");
  std::vector<TableAxis> axes;
  for (std::size_t k = 0; k < 2; ++k) axes.push_back(read_axis(over[k], units.empty() ? nullptr : &units[k], names));
  Law out{{}, "", false};
  std::vector<SignalFormula> formulas;
  for (const TableAxis& axis : axes) {
    std::vector<int> at;
    for (const std::string& name : axis.law.law.signals) {
      auto known = std::ranges::find(out.signals, name);
      at.push_back(static_cast<int>(known - out.signals.begin()));
      if (known == out.signals.end()) out.signals.push_back(name);
    }
    out.uses_time = out.uses_time || axis.law.law.uses_time || (axis.law.law.signals.empty() && !axis.law.law.constant);
    formulas.push_back(renumbered(axis.law.law, at));
  }
  if (out.signals.empty()) node.at("over").fail("names no signal; write one such as crank.speed in one of its expressions");
  if (out.signals.size() > most_signals) node.at("over").fail("names more than " + std::to_string(most_signals) + " signals");
  const double value_unit = unit_factor(node, "value unit", expected);
  const Outside outside = read_outside(node, keys, Outside::rejected);
  Grid grid = read_grid(table_file(node, folder), {axes[0].unit, axes[1].unit, value_unit}, node.place().key, {axes[0].text, axes[1].text});
  out.text = signal_table_text(node, axes, "linear", false, outside, value_unit, si_unit(expected));
  out.of_signals = SignalMap{
      Bilinear(std::move(grid)), {formulas[0], formulas[1]}, outside, {si_unit(axes[0].law.dimension), si_unit(axes[1].law.dimension)}};
  return out;
}

Law read_signal_table(const Node& node, std::string_view keys, const Dimension& expected, const std::filesystem::path& folder,
                      const SignalNames& names) {
  if (node.has("time unit")) node.at("time unit").fail("is for a table over t; for a table over signals write `over unit`");
  const Node over = node.at("over");
  if (over.is_list()) return read_signal_map(node, keys, expected, folder, names);
  std::vector<Node> unit;
  if (node.has("over unit")) unit.push_back(node.at("over unit"));
  const TableAxis x = read_axis(over, unit.empty() ? nullptr : unit.data(), names);
  if (x.law.law.signals.empty())
    over.fail(over.shown() + " names no signal; write one such as ram.y, or leave `over` out for a table over t");
  const bool linear = node.has("interpolation") && node.at("interpolation").one_of(choices(keys, "interpolation")) == "linear";
  const bool periodic = node.has("periodic") && node.at("periodic").yes();
  if (periodic && node.has("outside")) node.at("outside").fail("has no meaning for a periodic table; leave it out");
  const Outside outside = read_outside(node, keys, Outside::holds_unasked);
  const double value_unit = unit_factor(node, "value unit", expected);
  Samples samples = read_samples(table_file(node, folder), x.unit, value_unit, node.place().key, "x");
  const SignalFormula& formula = *x.law.law.of_signals.target<SignalFormula>();
  Law out{{}, signal_table_text(node, {x}, linear ? "linear" : "spline", periodic, outside, value_unit, si_unit(expected)), false};
  out.signals = x.law.law.signals;
  out.uses_time = x.law.law.uses_time;
  const std::string of_axis = si_unit(x.law.dimension);
  if (periodic) {
    must_close(node, samples);
    out.of_signals = periodic_table(std::move(samples), linear, formula);
  } else if (linear) {
    out.of_signals = SignalTable{.table = Polyline(std::move(samples)), .over = formula, .outside = outside, .unit = of_axis};
  } else {
    out.of_signals = SignalTable{.table = Spline(std::move(samples)), .over = formula, .outside = outside, .unit = of_axis};
  }
  return out;
}

// An output from a table; its dimension is that of `value unit`.
SceneOutput read_table_output(const Node& node, const SignalNames& names) {
  constexpr const char* keys = "outputs.*";
  check_keys(node, keys);
  if (!node.has("over")) node.fail("lacks a required key; add for example over: crank.angle (the argument of the table)");
  Dimension d = dimension::number;
  try {
    if (node.has("value unit")) d = read_quantity(node.at("value unit").text("a unit such as N m")).dimension;
  } catch (const ExpressionError& error) {
    node.at("value unit").fail(error.what());
  }
  return {node.name(), read_signal_table(node, keys, d, node.source().folder, names), si_unit(d), node.place()};
}

// Whether an output names another, directly or through other outputs.
bool needs(const std::vector<Node>& outputs, const Node& one, const std::string& name, std::set<std::string>& seen) {
  const auto in_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  const auto names = [&](const std::string& text, const std::string& word) {
    for (std::size_t i = text.find(word); i != std::string::npos; i = text.find(word, i + 1))
      if ((i == 0 || !in_word(text[i - 1])) && (i + word.size() == text.size() || !in_word(text[i + word.size()]))) return true;
    return false;
  };
  if (!one.is_scalar() || !seen.insert(one.name()).second) return false;
  const std::string& text = one.yaml().text;
  return names(text, name) ||
         std::ranges::any_of(outputs, [&](const Node& next) { return names(text, next.name()) && needs(outputs, next, name, seen); });
}

// Reports an output that names one not read yet.
[[noreturn]] void fail_of_order(const std::vector<Node>& outputs, const Node& node, const Node& named) {
  const std::string begun = "\"" + node.yaml().text + "\": ";
  std::set<std::string> seen;
  if (node.name() == named.name()) node.fail(begun + node.name() + " would depend on itself; use other signals, or make it a state");
  if (needs(outputs, named, node.name(), seen))
    node.fail(begun + node.name() + " and " + named.name() + " would depend on each other; make one of them depend on signals only");
  node.fail(begun + named.name() + " is not known yet; an output may name those above it, so write " + named.name() + " above " +
            node.name());
}

}  // namespace

Law read_rate(const Node& node, const Dimension& d, const Scene& scene, const SignalNames& names) {
  constexpr const char* keys = "states.*.rate";
  if (!node.is_map()) return read_acting_law(node, d, names);
  check_keys(node, keys);
  if (node.has("over")) return read_signal_table(node, keys, d, node.source().folder, names);
  must_be_of_time(node);
  return read_time_law(node, d, Smoothness::load, node.source().folder, scene.has_run ? scene.run.until : 0);
}

void check_signal_name(const Node& node, const Scene& scene, const char* what) {
  const std::string name = checked_name(node);
  if (const std::string fault = fault_of_name(name);
      !fault.empty() && (std::ranges::all_of(name, [](char c) { return c != ' ' && c != '-'; }) || !std::isalpha(name.front())))
    node.fail("\"" + name + "\" cannot name " + what + ": " + fault);
  if (node.source().parameters.contains(name)) node.fail("\"" + name + "\" is a parameter too; give " + what + " a name of its own");
  if (std::ranges::find(scene.states, name, &SceneState::name) != scene.states.end())
    node.fail("\"" + name + "\" is a state too; give " + what + " a name of its own");
}

const SignalNames& ActingSignals::names() {
  if (names_) return *names_;
  names_ = signal_names(signal_words(scene_), SignalUse::acts);
  for (const SceneOutput& made : scene_.outputs) {  // outputs of states such as PID controllers; the scene's own are read later
    SignalName& name = names_->find(made.name)->second;
    name.not_allowed.clear();
    name.stands_for = made.law.text;
  }
  if (root_.has("outputs") && root_.at("outputs").is_map())
    for (const Yaml& output : root_.at("outputs").yaml().items)
      names_->try_emplace(
          output.key,
          SignalName{
              dimension::number,
              "is an output, which may depend on forces, so only outputs and conditions of events may name it: write its expression here"});
  return *names_;
}

// A signal has a letter after a dot; names of states and outputs have no dot.
bool ActingSignals::may_be_in(const std::string& text) const {
  if (!scene_.states.empty() || !scene_.outputs.empty() || root_.has("outputs")) return true;
  for (std::size_t dot = text.find('.'); dot != std::string::npos; dot = text.find('.', dot + 1))
    if (dot + 1 < text.size() && std::isalpha(static_cast<unsigned char>(text[dot + 1]))) return true;
  return false;
}

Law read_load_law(const Node& node, std::string_view keys, const Dimension& expected, const std::filesystem::path& folder, double until,
                  ActingSignals& signals) {
  if (node.is_map()) {
    check_keys(node, keys);
    if (node.has("over")) return read_signal_table(node, keys, expected, folder, signals.names());
    must_be_of_time(node);
  } else if (node.is_scalar() && signals.may_be_in(node.yaml().text)) {
    Law law = read_acting_law(node, expected, signals.names());
    if (!law.signals.empty()) return law;
  }
  return read_time_law(node, expected, Smoothness::load, folder, until);
}

void read_outputs(const Node& root, Scene& scene) {
  if (!root.has("outputs")) return;
  const std::vector<Node> entries = root.at("outputs").entries("names and expressions: {power: gas.fx*piston.vx}");
  auto words = signal_words(scene);
  SignalNames names = signal_names(words, SignalUse::written);
  for (const Node& node : entries) {
    check_signal_name(node, scene, "an output");
    if (names.contains(node.name())) node.fail("\"" + node.name() + "\" is already a signal; give this output another name");
    if (node.is_map()) {
      scene.outputs.push_back(read_table_output(node, names));
      const std::string& unit = scene.outputs.back().unit;
      names[node.name()] = {unit.empty() ? dimension::number : read_quantity(unit).dimension, ""};
      continue;
    }
    const std::string text = node.expression("an expression such as gas.fx*piston.vx, or a table");
    try {
      MeasuredLaw read = read_measured_law(text, node.source().parameters, names);
      scene.outputs.push_back({node.name(), std::move(read.law), si_unit(read.dimension), node.place()});
      names[node.name()] = {read.dimension, ""};
    } catch (const ExpressionError& error) {
      const std::string said = error.what();
      for (const Node& other : entries)
        if (said.find("\"" + other.name() + "\" is neither") != std::string::npos) fail_of_order(entries, node, other);
      node.fail(said);
    }
  }
}

}  // namespace pintle
