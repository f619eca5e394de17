#include "framework/scene/units/expression.h"

#include <muParserBase.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>

#include "framework/common/nearest.h"
#include "framework/scene/units/spelling.h"

// muParser orders the operations; what it calculates with are indices of terms of a Formula, so
// that calculating builds the formula. Dimensions are judged and derivatives prepared there.
namespace pintle {

namespace {

// The formula being built by this thread. muParser's operators carry no user data.
thread_local Formula* building = nullptr;

struct Building {
  explicit Building(Formula& f) : before(building) { building = &f; }
  ~Building() { building = before; }
  Building(const Building&) = delete;
  Building& operator=(const Building&) = delete;
  Formula* before;
};

template <Op op>
double one(double a) {
  return building->term(op, static_cast<int>(a));
}
template <Op op>
double two(double a, double b) {
  return building->term(op, static_cast<int>(a), static_cast<int>(b));
}
template <Op op>
double several(const double* a, int n) {
  double result = a[0];
  for (int i = 1; i < n; ++i) result = two<op>(result, a[i]);
  return result;
}
double choose(double c, double a, double b) {
  return building->choose(static_cast<int>(c), static_cast<int>(a), static_cast<int>(b));
}
double step(double x, double x0, double x1) {
  return building->step(static_cast<int>(x), static_cast<int>(x0), static_cast<int>(x1));
}

// What a name stands for while a formula is built.
struct Names {
  const Vocabulary& known;
  const std::vector<Word>& words;
  Formula& formula;
  std::deque<double> terms;  // muParser keeps pointers into it

  int term(const std::string& name);
};

// Names that people try and that are absent on purpose; units of that kind: unit.cpp.
struct Absent {
  const char *name, *remedy;
};
constexpr std::array absent{Absent{"inf", "every value must be finite"},
                            Absent{"Inf", "every value must be finite"},
                            Absent{"infinity", "every value must be finite"},
                            Absent{"nan", "every value must be finite"},
                            Absent{"NaN", "every value must be finite"},
                            Absent{"e", "Euler's number is exp(1); a power of ten is written 1e-3"},
                            Absent{"ln", "the natural logarithm is log"}};

constexpr bool fixed = false;  // keeps muParser from folding: our terms fold themselves

class Grammar : public mu::ParserBase {
 public:
  Grammar() {
    EnableBuiltInOprt(false);
    EnableOptimizer(false);
    Init();
  }

 private:
  void InitCharSets() override {
    DefineNameChars("0123456789_$abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
    DefineOprtChars("+-*^/<>=!&|");
    DefineInfixOprtChars("+-");
  }
  void InitConst() override {}
  void InitFun() override {
    DefineFun("sin", one<Op::sin>, fixed);
    DefineFun("cos", one<Op::cos>, fixed);
    DefineFun("tan", one<Op::tan>, fixed);
    DefineFun("asin", one<Op::asin>, fixed);
    DefineFun("acos", one<Op::acos>, fixed);
    DefineFun("atan", one<Op::atan>, fixed);
    DefineFun("sqrt", one<Op::sqrt>, fixed);
    DefineFun("exp", one<Op::exp>, fixed);
    DefineFun("log", one<Op::log>, fixed);
    DefineFun("abs", one<Op::abs>, fixed);
    DefineFun("atan2", two<Op::atan2>, fixed);
    DefineFun("min", several<Op::min>, fixed);
    DefineFun("max", several<Op::max>, fixed);
    DefineFun("if", choose, fixed);
    DefineFun("step", step, fixed);
  }
  void InitOprt() override {
    DefineInfixOprt("-", one<Op::negate>, mu::prINFIX, fixed);
    DefineInfixOprt(
        "+", [](double a) { return a; }, mu::prINFIX, fixed);
    DefineOprt("+", two<Op::add>, mu::prADD_SUB);
    DefineOprt("-", two<Op::subtract>, mu::prADD_SUB);
    DefineOprt("*", two<Op::multiply>, mu::prMUL_DIV);
    DefineOprt("/", two<Op::divide>, mu::prMUL_DIV);
    DefineOprt("^", two<Op::power>, mu::prPOW, mu::oaRIGHT);
    DefineOprt("<", two<Op::less>, mu::prCMP);
    DefineOprt(">", two<Op::greater>, mu::prCMP);
    DefineOprt("<=", two<Op::at_most>, mu::prCMP);
    DefineOprt(">=", two<Op::at_least>, mu::prCMP);
    DefineOprt("==", two<Op::equal>, mu::prCMP);
    DefineOprt("!=", two<Op::unequal>, mu::prCMP);
    DefineOprt("&&", two<Op::both>, mu::prLAND);
    DefineOprt("||", two<Op::either>, mu::prLOR);
  }
};

bool is_function(std::string_view name) {
  return std::ranges::find(function_names(), name) != function_names().end();
}

// A number is written $i, the index of its word.
std::string rewritten(const std::vector<Word>& words) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i].kind == Word::Kind::function && !is_function(words[i].text))
      throw ExpressionError("there is no function \"" + words[i].text + "\"." +
                            did_you_mean(words[i].text, function_names()));
    out +=
        words[i].kind == Word::Kind::number ? std::to_string(i).insert(0, 1, '$') : words[i].text;
    if (words[i].kind != Word::Kind::function) out += ' ';
  }
  return out;
}

[[noreturn]] void unknown(const std::string& name, const Parameters& parameters) {
  if (is_function(name)) throw ExpressionError("the function " + name + " needs its parentheses");
  for (const Absent& a : absent)
    if (name == a.name) throw ExpressionError(std::string("it contains ") + name + ": " + a.remedy);
  if (const std::string_view remedy = instead_of(name); !remedy.empty())
    throw ExpressionError(std::string("it contains ") + name + ": " + std::string(remedy));
  std::vector<std::string> known{"t", "pi"};
  for (const auto& [parameter, value] : parameters) known.push_back(parameter);
  for (const Unit& u : units()) known.emplace_back(u.name);
  throw ExpressionError("\"" + name + "\" is neither a parameter nor a unit." +
                        did_you_mean(name, known));
}

int Names::term(const std::string& name) {
  if (name[0] == '$') return formula.constant({words[std::stoul(name.substr(1))].value, {}});
  if (const auto found = known.parameters.find(name); found != known.parameters.end())
    return formula.constant(found->second);
  if (name == "t") return formula.time();
  if (name == "pi") return formula.constant({std::numbers::pi, {}});
  if (const Unit* u = known.unit(name)) return formula.constant({u->factor, u->dimension});
  unknown(name, known.parameters);
}

double* place_of(const char* name, void* names) {
  Names& all = *static_cast<Names*>(names);
  return &all.terms.emplace_back(all.term(name));
}

std::string reason(const mu::ParserError& error) {
  switch (error.GetCode()) {
    case mu::ecUNEXPECTED_EOF:
      return "it ends too early: something is missing at its end";
    case mu::ecMISSING_PARENS:
      return "a parenthesis is not closed";
    case mu::ecTOO_MANY_PARAMS:
      return "a function has too many arguments";
    case mu::ecTOO_FEW_PARAMS:
      return "a function has too few arguments";
    case mu::ecUNEXPECTED_OPERATOR:
      return "an operator has nothing to its left or right";
    case mu::ecUNEXPECTED_PARENS:
      return "a parenthesis stands where a value should";
    case mu::ecUNEXPECTED_ARG_SEP:
      return "a comma stands where a value should";
    default:
      return "it is not an expression; check operators and parentheses";
  }
}

// Builds the formula; returns its last term.
int build(const std::vector<Word>& words, const Vocabulary& known, Formula& formula) {
  const std::string text = rewritten(words);
  Names names{known, words, formula, {}};
  const Building guard(formula);
  try {
    Grammar grammar;
    grammar.SetVarFactory(place_of, &names);
    grammar.SetExpr(text);
    return static_cast<int>(grammar.Eval());
  } catch (const mu::ParserError& error) {
    throw ExpressionError(reason(error));
  }
}

std::string quoted(std::string_view text) {
  constexpr std::size_t shown = 60;
  const bool cut = text.size() > shown;
  return std::string("\"").append(text.substr(0, shown)).append(cut ? "…\"" : "\"");
}

bool fits(const Quantity& q, const Dimension& expected) {
  return bare(q.dimension) || same(q.dimension, expected);
}

[[noreturn]] void wrong_dimension(const Dimension& found, const Dimension& expected) {
  throw ExpressionError("it is " + describe(found) + "; expected " + describe(expected));
}

Law law_from(const Formula& formula, int root, std::string_view text) {
  if (formula.is_constant(root)) {
    const Jet jet{formula.quantity(root).value, 0, 0};
    return {[jet](double) { return jet; }, std::string(text), true};
  }
  return {formula.program(root), std::string(text), false};
}

Law law_with(const std::vector<Word>& words, std::string_view text, const Dimension& of_time,
             const Dimension& expected, const Vocabulary& known) {
  Formula formula(of_time);
  const int root = build(words, known, formula);
  if (!fits(formula.quantity(root), expected))
    wrong_dimension(formula.quantity(root).dimension, expected);
  return law_from(formula, root, text);
}

bool contains_time(const std::vector<Word>& words) {
  return std::ranges::any_of(words, [](const Word& w) { return w.text == "t"; });
}

Quantity constant(std::string_view text, const Vocabulary& known) {
  try {
    Formula formula(dimension::time);
    const int root = build(spell(text, known), known, formula);
    if (formula.uses_time())
      throw ExpressionError("it depends on t, but this value cannot change in time");
    return formula.quantity(root);
  } catch (const ExpressionError& error) {
    throw ExpressionError(quoted(text) + ": " + error.what());
  }
}

}  // namespace

Quantity read_quantity(std::string_view text, const Parameters& parameters) {
  return constant(text, {parameters});
}

double read_quantity(std::string_view text, const Dimension& expected,
                     const Parameters& parameters) {
  const Quantity q = read_quantity(text, parameters);
  if (fits(q, expected)) return q.value;
  throw ExpressionError(quoted(text) + " is " + describe(q.dimension) + "; expected " +
                        describe(expected));
}

double read_frequency(std::string_view text, const Parameters& parameters) {
  const Quantity q = constant(text, {parameters, frequency_units()});
  if (bare(q.dimension)) return q.value;
  if (!same(q.dimension, dimension::angular_speed))
    throw ExpressionError(quoted(text) + " is " + describe(q.dimension) +
                          "; expected a frequency [Hz]");
  if (q.dimension.angle != 1)
    throw ExpressionError(quoted(text) +
                          " does not say whether turns or radians are counted; write Hz or rad/s");
  return q.value / (2 * std::numbers::pi);
}

Law read_law(std::string_view text, const Dimension& expected, const Parameters& parameters) {
  try {
    const Vocabulary known{parameters};
    const std::vector<Word> words = spell(text, known);
    try {
      return law_with(words, text, dimension::time, expected, known);
    } catch (const ExpressionError& error) {
      if (!contains_time(words)) throw;
      try {
        return law_with(words, text, dimension::number, expected, known);
      } catch (const ExpressionError&) {
        throw ExpressionError(std::string(error.what()) +
                              " (t is a time; give every factor of t its unit, or none)");
      }
    }
  } catch (const ExpressionError& error) {
    throw ExpressionError(quoted(text) + ": " + error.what());
  }
}

std::string fault_of_name(std::string_view name) {
  const auto letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  if (name.empty() || !letter(name[0]) ||
      !std::ranges::all_of(name, [&](char c) { return letter(c) || digit(c); }))
    return "a parameter's name is letters, digits and _, and begins with a letter";
  if (name == "t") return "t is the time; choose another name";
  if (name == "pi") return "pi is a constant; choose another name";
  if (find_unit(name)) return std::string(name) + " is a unit; choose another name";
  if (is_function(name)) return std::string(name) + " is a function; choose another name";
  return {};
}

const std::vector<std::string>& function_names() {
  static const std::vector<std::string> names{"sin",  "cos",   "tan",  "asin", "acos",
                                              "atan", "atan2", "sqrt", "exp",  "log",
                                              "abs",  "min",   "max",  "if",   "step"};
  return names;
}

}  // namespace pintle
