#include "framework/scene/units/expression.h"

#include <algorithm>
#include <numbers>
#include <span>

#include "framework/common/nearest.h"
#include "framework/scene/units/formula_parser.h"
#include "framework/scene/units/signal_law.h"

namespace pintle {

namespace {

// @param in_time  the variable t is allowed there
[[noreturn]] void unknown(const std::string& name, const Vocabulary& vocabulary, bool in_time) {
  if (is_function(name)) throw ExpressionError("the function " + name + " needs parentheses");
  if (const std::string_view remedy = instead_of(name); !remedy.empty())
    throw ExpressionError("it contains " + name + ": " + std::string(remedy));
  std::vector<std::string> known{"pi"}, all;  // names that messages list; `all` also has units and signals
  if (in_time) known.insert(known.begin(), std::string(vocabulary.variable));
  for (const auto& [parameter, value] : vocabulary.parameters) known.push_back(parameter);
  if (vocabulary.signals)
    for (const auto& [signal, what] : *vocabulary.signals) (signal.find('.') == std::string::npos ? known : all).push_back(signal);
  all.insert(all.end(), known.begin(), known.end());
  const std::size_t without_units = all.size();
  for (const Unit& u : units()) all.emplace_back(u.name);
  const std::string near = nearest(name, all);
  const bool is_unit = !near.empty() && std::find(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(without_units), near) ==
                                            all.begin() + static_cast<std::ptrdiff_t>(without_units);
  throw ExpressionError(
      "\"" + name + "\" is neither a parameter nor a unit" + (vocabulary.signals ? " nor a signal." : ".") +
      (is_unit && vocabulary.signals ? " Did you mean the unit \"" + near + "\"?" : did_you_mean(name, near.empty() ? known : all)));
}

constexpr std::string_view set_by_an_event =
    " is a parameter that an event sets, but this value is evaluated once, before the run; laws of forces and springs, rates, outputs and "
    "conditions may depend on it: write such a law here, or use another parameter";

int build(const std::vector<FormulaStep>& steps, const Vocabulary& known, Formula& formula);

// Adds the expression that a name stands for to the formula; returns its last term.
int part_of(const Word& word, const std::string& stands_for, const Vocabulary& known, Formula& formula) {
  constexpr int most_within = 30;
  Vocabulary within = known;
  if (++within.within > most_within)
    throw ExpressionError(word.text + " would depend on itself: in the expressions it depends on, name states or signals instead");
  const std::vector<Word> words = spell(stands_for, within);
  return build(parse(words), within, formula);
}

// The text with names that stand for expressions replaced by these, so that it can be read where the names are unknown.
std::string written_out(std::string_view text, const std::vector<Word>& words, const Vocabulary& known) {
  std::string out;
  const auto goes_on = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
  std::size_t place = 0;
  auto word = words.begin();
  while (!text.empty()) {
    if (!goes_on(text.front())) ++place;
    while (word != words.end() && word->at < place) ++word;
    const bool begins = word != words.end() && word->at == place && word->kind == Word::Kind::signal && text.starts_with(word->text);
    const std::string stands_for = begins ? known.signals->find(word->text)->second.stands_for : "";
    if (stands_for.empty()) {
      out += text.front(), text.remove_prefix(1);
    } else {
      out += "(" + written_out(stands_for, spell(stands_for, known), known) + ")";
      place += word->text.size() - 1, text.remove_prefix(word->text.size());
    }
  }
  return out;
}

int value_of(const Word& word, const Vocabulary& known, Formula& formula) {
  const std::string& name = word.text;
  if (word.kind == Word::Kind::number) return formula.constant({word.value, {}});
  if (word.kind == Word::Kind::signal) {
    const SignalName& signal = known.signals->find(name)->second;
    if (!signal.not_allowed.empty()) throw ExpressionError(name + " " + signal.not_allowed);
    if (!signal.stands_for.empty()) return part_of(word, signal.stands_for, known, formula);
    return formula.input(name, signal.dimension);
  }
  if (name == known.variable) return formula.time();
  if (const auto found = known.parameters.find(name); found != known.parameters.end()) {
    if (found->second.varies) throw ExpressionError(name + std::string(set_by_an_event));
    return formula.constant(found->second);
  }
  if (name == "pi") return formula.constant({std::numbers::pi, {}});
  if (const Unit* u = known.unit(name)) return formula.constant({u->factor, u->dimension});
  unknown(name, known, true);
}

int result_of(const FormulaStep& step, std::span<const int> x, const Vocabulary& known, Formula& formula) {
  switch (step.op) {
    case Op::sign: return formula.sign(x[0]);
    case Op::deadband: return formula.deadband(x[0], x[1]);
    case Op::saturate: return formula.saturate(x[0], x[1], x[2]);
    default: break;
  }
  switch (x.size()) {
    case 0: return value_of(*step.word, known, formula);
    case 1: return formula.term(step.op, x[0]);
    case 2: return formula.term(step.op, x[0], x[1]);
    default: return step.op == Op::choose ? formula.choose(x[0], x[1], x[2]) : formula.step(x[0], x[1], x[2]);
  }
}

// Builds the formula; returns its last term.
int build(const std::vector<FormulaStep>& steps, const Vocabulary& known, Formula& formula) {
  std::vector<int> results;
  for (const FormulaStep& step : steps) {
    const std::size_t left = results.size() - step.operands;
    try {
      const int result = result_of(step, std::span(results).subspan(left), known, formula);
      results.resize(left);
      results.push_back(result);
    } catch (const ExpressionError& error) {
      throw ExpressionError(error.what(), step.word->at);
    }
  }
  return results.back();
}

std::string excerpt(std::string_view text) {
  constexpr std::size_t shown = 60;
  const bool cut = text.size() > shown;
  return std::string("\"").append(text.substr(0, shown)).append(cut ? "…\"" : "\"");
}

[[noreturn]] void fail(std::string_view text, const ExpressionError& error) {
  const std::string place = error.at > 0 ? ", character " + std::to_string(error.at) : "";
  throw ExpressionError(excerpt(text) + place + ": " + error.what());
}

bool fits(const Quantity& q, const Dimension& expected) { return bare(q.dimension) || same(q.dimension, expected); }

[[noreturn]] void wrong_dimension(const Dimension& found, const Dimension& expected) {
  throw ExpressionError("it is " + describe(found) + "; expected " + describe(expected));
}

Law law_from(const Formula& formula, int root, std::string_view text) {
  if (formula.is_constant(root)) {
    const Jet jet{formula.quantity(root).value, 0, 0};
    return {[jet](double) { return jet; }, std::string(text), true};
  }
  if (formula.inputs().empty()) return {formula.program(root), std::string(text), false};
  if (formula.inputs().size() > most_signals)
    throw ExpressionError("it names more than " + std::to_string(most_signals) + " signals: split it into outputs or states");
  Law law{{}, std::string(text), false};
  law.of_signals = SignalFormula(formula.program(root));
  law.signals = formula.inputs();
  law.uses_time = formula.uses_time();
  return law;
}

Law law_with(const std::vector<FormulaStep>& steps, std::string_view text, const Dimension& of_time, const Dimension& expected,
             const Vocabulary& known) {
  Formula formula(of_time);
  const int root = build(steps, known, formula);
  if (!fits(formula.quantity(root), expected)) wrong_dimension(formula.quantity(root).dimension, expected);
  return law_from(formula, root, text);
}

bool contains_time(const std::vector<Word>& words) {
  return std::ranges::any_of(words, [](const Word& w) { return w.text == "t"; });
}

// Rejects unknown names in a value that cannot change in time.
void must_know(const std::vector<Word>& words, const Vocabulary& known) {
  for (const Word& word : words) {
    const std::string& name = word.text;
    if (word.kind != Word::Kind::name || name == known.variable || name == "pi" || known.parameters.contains(name) || known.unit(name))
      continue;
    try {
      unknown(name, known, false);
    } catch (const ExpressionError& error) {
      throw ExpressionError(error.what(), word.at);
    }
  }
}

Quantity evaluated(std::string_view text, const Vocabulary& known) {
  try {
    Formula formula(dimension::time);
    const std::vector<Word> words = spell(text, known);
    must_know(words, known);
    const int root = build(parse(words), known, formula);
    if (formula.uses_time()) throw ExpressionError("it depends on t, but this value cannot change in time");
    return formula.quantity(root);
  } catch (const ExpressionError& error) {
    fail(text, error);
  }
}

}  // namespace

Quantity read_quantity(std::string_view text, const Parameters& parameters) { return evaluated(text, {parameters}); }

double read_quantity(std::string_view text, const Dimension& expected, const Parameters& parameters) {
  const Quantity q = read_quantity(text, parameters);
  if (fits(q, expected)) return q.value;
  throw ExpressionError(excerpt(text) + " is " + describe(q.dimension) + "; expected " + describe(expected));
}

double read_frequency(std::string_view text, const Parameters& parameters) {
  const Quantity q = evaluated(text, {parameters, frequency_units()});
  if (bare(q.dimension)) return q.value;
  if (!same(q.dimension, dimension::angular_speed))
    throw ExpressionError(excerpt(text) + " is " + describe(q.dimension) + "; expected a frequency [Hz]");
  if (q.dimension.angle != 1)
    throw ExpressionError(excerpt(text) + " does not say whether turns or radians are counted; write Hz or rad/s");
  return q.value / (2 * std::numbers::pi);
}

Law read_law(std::string_view text, const Dimension& expected, const Parameters& parameters, const SignalNames* signals) {
  try {
    const Vocabulary known{parameters, {}, signals};
    const std::vector<Word> words = spell(text, known);
    const std::vector<FormulaStep> steps = parse(words);
    const auto read = [&](const Dimension& of_time) {
      Law law = law_with(steps, text, of_time, expected, known);
      if (!law.signals.empty()) law.text = written_out(text, words, known);
      return law;
    };
    try {
      return read(dimension::time);
    } catch (const ExpressionError& error) {
      if (!contains_time(words)) throw;
      try {
        return read(dimension::number);
      } catch (const ExpressionError&) {
        throw ExpressionError(std::string(error.what()) + " (t is a time; give every factor of t its unit, or none)", error.at);
      }
    }
  } catch (const ExpressionError& error) {
    fail(text, error);
  }
}

MeasuredLaw read_measured_law(std::string_view text, const Parameters& parameters, const SignalNames& signals) {
  try {
    const Vocabulary known{parameters, {}, &signals};
    const std::vector<Word> words = spell(text, known);
    Formula formula(dimension::time);
    const int root = build(parse(words), known, formula);
    Law law = law_from(formula, root, text);
    if (!law.signals.empty()) law.text = written_out(text, words, known);
    return {std::move(law), formula.quantity(root).dimension};
  } catch (const ExpressionError& error) {
    fail(text, error);
  }
}

Law read_curve(std::string_view text, std::string_view variable, const Dimension& of, const Dimension& expected,
               const Parameters& parameters) {
  try {
    const Vocabulary known{parameters, {}, nullptr, variable};
    const std::vector<Word> words = spell(text, known);
    return law_with(parse(words), text, of, expected, known);
  } catch (const ExpressionError& error) {
    fail(text, error);
  }
}

std::string fault_of_name(std::string_view name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  if (name.empty() || !letter(name[0]) || !std::ranges::all_of(name, [&](char c) { return letter(c) || digit(c); }))
    return "a parameter's name consists of letters, digits and _, and begins with a letter";
  if (name == "t") return "t is the time; choose another name";
  if (name == "pi") return "pi is a constant; choose another name";
  if (name == "present") return "present is the value of a length or angle at the start; choose another name";
  // Single letters have many meanings: if a scene defines F, it means that there, and not farad.
  if (const Unit* unit = find_unit(name); unit && unit->dimension.current == 0)
    return std::string(name) + " is a unit; choose another name, such as " + std::string(name) + "_1";
  if (is_function(name)) return std::string(name) + " is a function; choose another name";
  return {};
}

}  // namespace pintle
