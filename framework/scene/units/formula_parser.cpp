#include "framework/scene/units/formula_parser.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "framework/common/nearest.h"
#include "framework/scene/units/unit.h"

// A Pratt parser: every operator has a binding strength to its left and to its right; an operand between two operators belongs to the
// stronger side.
namespace pintle {

namespace {

using Kind = Word::Kind;

struct Operator {
  std::string_view sign;
  Op op;
  int left, right;
};
// Left below right: a - b - c is (a - b) - c. Left above right: a^b^c is a^(b^c).
constexpr std::array<Operator, 13> operators{{{"||", Op::either, 1, 2},
                                              {"&&", Op::both, 3, 4},
                                              {"<", Op::less, 5, 6},
                                              {">", Op::greater, 5, 6},
                                              {"<=", Op::at_most, 5, 6},
                                              {">=", Op::at_least, 5, 6},
                                              {"==", Op::equal, 5, 6},
                                              {"!=", Op::unequal, 5, 6},
                                              {"+", Op::add, 7, 8},
                                              {"-", Op::subtract, 7, 8},
                                              {"*", Op::multiply, 9, 10},
                                              {"/", Op::divide, 9, 10},
                                              {"^", Op::power, 14, 13}}};
constexpr int weakest = 0, before_a_value = 11;  // a sign: -a^2 is -(a^2), -a*b is (-a)*b

constexpr int any = std::numeric_limits<int>::max();
struct Function {
  std::string_view name;
  Op op;
  int least, most;  // number of arguments; if unlimited, op joins them one after the other
};
constexpr std::array<Function, 18> functions{{{"sin", Op::sin, 1, 1},
                                              {"cos", Op::cos, 1, 1},
                                              {"tan", Op::tan, 1, 1},
                                              {"asin", Op::asin, 1, 1},
                                              {"acos", Op::acos, 1, 1},
                                              {"atan", Op::atan, 1, 1},
                                              {"atan2", Op::atan2, 2, 2},
                                              {"sqrt", Op::sqrt, 1, 1},
                                              {"exp", Op::exp, 1, 1},
                                              {"log", Op::log, 1, 1},
                                              {"abs", Op::abs, 1, 1},
                                              {"min", Op::min, 1, any},
                                              {"max", Op::max, 1, any},
                                              {"if", Op::choose, 3, 3},
                                              {"step", Op::smooth, 3, 3},
                                              {"sign", Op::sign, 1, 1},
                                              {"deadband", Op::deadband, 2, 2},
                                              {"saturate", Op::saturate, 3, 3}}};

constexpr bool compares(Op op) { return op >= Op::less && op <= Op::unequal; }
bool adds(const Word& w) { return w.kind == Kind::sign && (w.text == "+" || w.text == "-"); }

[[noreturn]] void fail(const Word& at, const std::string& what) { throw ExpressionError(what, at.at); }

const Function& function(const Word& w) {
  const auto found = std::ranges::find(functions, w.text, &Function::name);
  if (found != functions.end()) return *found;
  const std::string remedy(instead_of(w.text));
  fail(w, "there is no function \"" + w.text + "\"" + (remedy.empty() ? "." + did_you_mean(w.text, function_names()) : ": " + remedy));
}

// Fails at a word that cannot begin an operand.
[[noreturn]] void misplaced(const Word& w) {
  const std::string what = w.kind == Kind::comma ? "a comma" : w.kind == Kind::close ? "a parenthesis" : "the operator " + w.text;
  fail(w, what + " is where a value should be");
}

[[noreturn]] void miscounted(const Word& name, const Function& f, int given) {
  fail(name, name.text + " has too " + (given < f.least ? "few" : "many") + " arguments: " + std::to_string(given) + " instead of " +
                 std::to_string(f.least) + (f.most == any ? " or more" : ""));
}

class Parser {
 public:
  explicit Parser(std::span<const Word> words) : words_(words) {}

  std::vector<FormulaStep> steps() {
    expression(weakest);
    if (!at_end()) fail(next(), "it should end before " + next().text);
    return std::move(steps_);
  }

 private:
  // Limit of nesting, so that no text overflows the stack.
  static constexpr int deepest = 250;

  bool at_end() const { return place_ == words_.size(); }
  const Word& next() const { return words_[place_]; }
  bool next_is(Kind kind) const { return !at_end() && next().kind == kind; }
  const Word& take() {
    if (!at_end()) return words_[place_++];
    if (words_.empty()) throw ExpressionError("it ends too early");
    fail(words_.back(), "it ends too early: nothing follows " + words_.back().text);
  }
  bool take_if(Kind kind) {
    const bool taken = next_is(kind);
    place_ += taken ? 1 : 0;
    return taken;
  }

  // Continues while operators bind their left side at least this strongly.
  void expression(int least) {
    if (++depth_ > deepest) fail(words_[place_ - 1], "it nests too deeply: name parts of it in parameters");
    operand();
    bool compared = false;
    while (next_is(Kind::sign)) {
      const auto o = std::ranges::find(operators, next().text, &Operator::sign);
      if (o == operators.end() || o->left < least) break;
      const Word& word = take();
      if (compares(o->op) && std::exchange(compared, true))
        fail(word, "a second comparison would compare whether the first holds, 1 or 0: join two by &&, as in 0 < u && u < 1");
      expression(o->right);
      steps_.push_back({&word, 2, o->op});
    }
    --depth_;
  }

  void operand() {
    const Word& word = take();
    switch (word.kind) {
      case Kind::number:
      case Kind::name:
      case Kind::signal: return steps_.push_back({&word});
      case Kind::function: return call(word);
      case Kind::open: expression(weakest); return close(word);
      default: return adds(word) ? signed_operand(word) : misplaced(word);
    }
  }

  void signed_operand(const Word& sign) {
    if (!at_end() && adds(next())) fail(next(), "a second sign needs parentheses, as in -(-2)");
    expression(before_a_value);
    if (sign.text == "-") steps_.push_back({&sign, 1, Op::negate});
  }

  void call(const Word& name) {
    const Function& f = function(name);
    if (!next_is(Kind::open)) fail(name, "the function " + name.text + " needs parentheses");
    const Word& open = take();
    int given = 0;
    for (bool more = !next_is(Kind::close); more; more = take_if(Kind::comma)) {
      expression(weakest);
      if (++given > 1 && f.most == any) steps_.push_back({&name, 2, f.op});
    }
    close(open);
    if (given < f.least || given > f.most) miscounted(name, f, given);
    if (f.most != any) steps_.push_back({&name, given, f.op});
  }

  void close(const Word& open) {
    if (next_is(Kind::comma)) fail(next(), "a comma is outside a function: the decimal point is \".\"");
    if (!take_if(Kind::close)) fail(open, "a parenthesis is not closed");
  }

  std::span<const Word> words_;
  std::size_t place_ = 0;
  int depth_ = 0;
  std::vector<FormulaStep> steps_;
};

}  // namespace

std::vector<FormulaStep> parse(std::span<const Word> words) { return Parser(words).steps(); }

const std::vector<std::string>& function_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const Function& f : functions) out.emplace_back(f.name);
    return out;
  }();
  return names;
}

bool is_function(std::string_view name) { return std::ranges::find(functions, name, &Function::name) != functions.end(); }

}  // namespace pintle
