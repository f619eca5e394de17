#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "framework/common/time_law.h"
#include "framework/scene/units/unit.h"

namespace pintle {

/// An expression that cannot be read; the message says what is wrong and what to write instead.
struct ExpressionError : std::runtime_error {
  explicit ExpressionError(const std::string& what, std::size_t character = 0) : std::runtime_error(what), at(character) {}
  std::size_t at;  ///< position of the wrong character, from 1; 0: the whole text
};

/// A number with its dimension; SI.
struct Quantity {
  double value = 0;
  Dimension dimension = {};
  bool varies = false;  ///< a parameter that an event sets; `value` is its initial value
};
/// As an expression, to the last bit: "(0.1 m)".
std::string exact_text(double value, const Dimension&);
inline std::string exact_text(const Quantity& q) { return exact_text(q.value, q.dimension); }

enum class Op : unsigned char {
  constant,
  time,
  input,  // no operand
  negate,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  sqrt,
  exp,
  log,
  abs,
  smooth,  // one
  add,
  subtract,
  multiply,
  divide,
  power,
  atan2,
  min,
  max,  // two
  less,
  greater,
  at_most,
  at_least,
  equal,
  unequal,
  both,
  either,  // two, answer 1 or 0
  choose,  // three: condition, then, else
  sign,
  deadband,
  saturate,  // functions of the language that are expressed by the others
};

/// A formula in t and inputs, as a stack machine over jets: value, rate and acceleration are exact, by the rules of differentiation. No
/// allocation and no shared state: safe to call from many threads.
struct Program {
  struct Instruction {
    Op op;
    double value = 0;  ///< of a constant; for an input its index
  };
  static constexpr int most_stacked = 32;
  std::vector<Instruction> code;  ///< in postfix order

  Jet operator()(double t) const { return (*this)(Jet{t, 1, 0}, nullptr); }
  Jet operator()(const Jet& t, const Jet* inputs) const;
};

/// Builds a formula term by term, checking dimensions and folding constants. A term is identified by its index.
/// @throws ExpressionError  from every member, if the dimensions do not fit or a constant is not finite
class Formula {
 public:
  /// @param of_time  dimension of t: a time, or a number of seconds
  explicit Formula(const Dimension& of_time) : of_time_(of_time) {}

  int constant(const Quantity&);
  int time();
  /// A signal of the motion; the same name gives the same input.
  int input(const std::string& name, const Dimension&);
  int term(Op, int a);
  int term(Op, int a, int b);
  int choose(int condition, int then, int otherwise);
  /// 0 before t0, 1 after t1, 10s³ − 15s⁴ + 6s⁵ between: two continuous derivatives.
  int step(int x, int x0, int x1);

  bool is_constant(int i) const { return terms_[index(i)].op == Op::constant; }
  Quantity quantity(int i) const { return {terms_[index(i)].value, terms_[index(i)].dimension}; }
  /// sign(x): −1, 0 or 1. deadband(x, w): the part of x beyond ±w. saturate(x, lo, hi).
  int sign(int x);
  int deadband(int x, int width);
  int saturate(int x, int lo, int hi);

  bool uses_time() const { return uses_time_; }
  const std::vector<std::string>& inputs() const { return inputs_; }
  Program program(int root) const;

 private:
  struct Term {
    Op op;
    int a = -1, b = -1, c = -1;
    Dimension dimension = {};
    double value = 0;
  };
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  int append(Term);
  Dimension dimension_of(Op, const Term& a) const;
  Dimension dimension_of(Op, const Term& a, const Term& b) const;
  int write(int i, std::vector<Program::Instruction>& code) const;

  Dimension of_time_;
  bool uses_time_ = false;
  std::vector<std::string> inputs_;
  std::vector<Term> terms_;
};

}  // namespace pintle
