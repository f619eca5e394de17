#include "framework/scene/units/formula.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/common/text.h"
#include "framework/scene/units/jet.h"
#include "framework/scene/units/program_parts.h"

namespace pintle {

namespace {

const char* word_for(Op op) {
  switch (op) {
    case Op::sin: return "sin";
    case Op::cos: return "cos";
    case Op::tan: return "tan";
    case Op::asin: return "asin";
    case Op::acos: return "acos";
    case Op::atan: return "atan";
    case Op::exp: return "exp";
    case Op::log: return "log";
    case Op::smooth: return "step";
    case Op::add: return "+";
    case Op::subtract: return "-";
    case Op::atan2: return "atan2";
    case Op::min: return "min";
    case Op::max: return "max";
    case Op::choose: return "if";
    case Op::both: return "&&";
    case Op::either: return "||";
    default: return "a comparison";
  }
}

[[noreturn]] void mixed(Op op, const Dimension& a, const Dimension& b) {
  std::string s = std::string(word_for(op)) + " mixes " + describe(a) + " and " + describe(b);
  if (bare(a) || bare(b)) s += ": give the bare number its unit";
  throw ExpressionError(s);
}

Dimension joined(const Dimension& a, const Dimension& b) { return {a.length, a.mass, a.time, a.angle != 0 ? a.angle : b.angle, a.current}; }

void must_be_number(Op op, const Dimension& a) {
  if (!same(a, dimension::number)) throw ExpressionError(std::string(word_for(op)) + " needs a number or an angle, not " + describe(a));
}

// a·b, or a/n where b is 1/n, so that 10 us is 1e-5 to the last bit.
double product_to_the_bit(double a, double b) {
  const double n = std::round(1 / b);
  return b > 0 && b < 1 && n < 1e15 && b == 1 / n ? a / n : a * b;
}

}  // namespace

std::string exact_text(double value, const Dimension& d) {
  const std::string unit = si_unit(d);
  return "(" + number_exactly(value) + (unit.empty() ? ")" : " " + unit + ")");
}

Jet Program::operator()(const Jet& t, const Jet* inputs) const {
  union Operand {
    Operand() {}  // not initialised: a law is evaluated at every instant
    Jet jet;
  };
  std::array<Operand, most_stacked> stack;
  std::size_t top = 0;  // one past the last operand
  for (const Instruction& i : code) {
    switch (operand_count(i.op)) {
      case 0:
        stack[top++].jet = i.op == Op::time ? t : i.op == Op::input ? inputs[static_cast<std::size_t>(i.value)] : Jet{i.value, 0, 0};
        break;
      case 1: stack[top - 1].jet = apply(i.op, stack[top - 1].jet); break;
      case 2:
        --top;
        stack[top - 1].jet = apply(i.op, stack[top - 1].jet, stack[top].jet);
        break;
      default: top -= 2; stack[top - 1].jet = stack[top - 1].jet.value != 0 ? stack[top].jet : stack[top + 1].jet;
    }
  }
  return stack[0].jet;
}

int Formula::constant(const Quantity& q) { return append({.op = Op::constant, .dimension = q.dimension, .value = q.value}); }

int Formula::time() {
  uses_time_ = true;
  return append({.op = Op::time, .dimension = of_time_});
}

int Formula::input(const std::string& name, const Dimension& d) {
  const auto known = std::ranges::find(inputs_, name);
  const auto place = static_cast<double>(known - inputs_.begin());
  if (known == inputs_.end()) inputs_.push_back(name);
  return append({.op = Op::input, .dimension = d, .value = place});
}

int Formula::term(Op op, int ia) {
  const Term& a = terms_[index(ia)];
  const Dimension d = dimension_of(op, a);
  if (a.op == Op::constant) return constant({apply(op, Jet{a.value}).value, d});
  return append({.op = op, .a = ia, .dimension = d});
}

int Formula::term(Op op, int ia, int ib) {
  const Term &a = terms_[index(ia)], &b = terms_[index(ib)];
  const Dimension d = dimension_of(op, a, b);
  if (op == Op::multiply && a.op == Op::constant && b.op == Op::constant) return constant({product_to_the_bit(a.value, b.value), d});
  if (a.op == Op::constant && b.op == Op::constant) return constant({apply(op, Jet{a.value}, Jet{b.value}).value, d});
  return append({.op = op, .a = ia, .b = ib, .dimension = d});
}

int Formula::choose(int condition, int then, int otherwise) {
  const Term &c = terms_[index(condition)], &a = terms_[index(then)], &b = terms_[index(otherwise)];
  if (!same(c.dimension, dimension::number))
    throw ExpressionError("if needs a condition such as t < 1 s first, not " + describe(c.dimension));
  const Dimension d = dimension_of(Op::choose, a, b);
  if (c.op == Op::constant) {
    const int chosen = c.value != 0 ? then : otherwise;
    return is_constant(chosen) ? constant({quantity(chosen).value, d}) : chosen;
  }
  return append({.op = Op::choose, .a = condition, .b = then, .c = otherwise, .dimension = d});
}

int Formula::step(int x, int x0, int x1) {
  const int width = term(Op::subtract, x1, x0);
  if (is_constant(width) && quantity(width).value <= 0) throw ExpressionError("step(t, t0, t1) needs t0 before t1");
  return term(Op::smooth, term(Op::divide, term(Op::subtract, x, x0), width));
}

int Formula::sign(int x) {
  const int zero = constant({0, {}});
  return term(Op::subtract, term(Op::greater, x, zero), term(Op::less, x, zero));
}

int Formula::deadband(int x, int width) {
  if (is_constant(width) && quantity(width).value < 0) throw ExpressionError("deadband(x, w) needs a w that is not below 0");
  return term(Op::subtract, x, saturate(x, term(Op::negate, width), width));
}

int Formula::saturate(int x, int lo, int hi) {
  if (is_constant(lo) && is_constant(hi) && quantity(lo).value > quantity(hi).value)
    throw ExpressionError("saturate(x, lo, hi) needs lo below hi");
  return term(Op::min, term(Op::max, x, lo), hi);
}

int Formula::append(Term term) {
  if (term.op == Op::constant && !std::isfinite(term.value)) throw ExpressionError("a part of it is not a finite number");
  terms_.push_back(term);
  return static_cast<int>(terms_.size()) - 1;
}

Dimension Formula::dimension_of(Op op, const Term& a) const {
  if (op == Op::negate || op == Op::abs) return a.dimension;
  if (op == Op::sqrt) return power(a.dimension, 0.5);
  must_be_number(op, a.dimension);
  const bool gives_angle = op == Op::asin || op == Op::acos || op == Op::atan;
  return gives_angle ? dimension::angle : dimension::number;
}

Dimension Formula::dimension_of(Op op, const Term& a, const Term& b) const {
  const Dimension &da = a.dimension, &db = b.dimension;
  if (op == Op::multiply) return product(da, db);
  if (op == Op::divide) return product(da, power(db, -1));
  if (op == Op::power) {
    if (!same(db, dimension::number)) throw ExpressionError("an exponent must be a number, not " + describe(db));
    if (bare(da)) return dimension::number;
    if (b.op != Op::constant) throw ExpressionError("the exponent of " + describe(da) + " must not depend on t");
    return power(da, b.value);
  }
  if (op == Op::both || op == Op::either) {
    must_be_number(op, da);
    must_be_number(op, db);
    return dimension::number;
  }
  // Zero without a unit is valid in every unit.
  const auto zero = [](const Term& x) { return x.op == Op::constant && x.value == 0 && bare(x.dimension); };
  if (!same(da, db) && !zero(a) && !zero(b)) mixed(op, da, db);
  if (op >= Op::less && op <= Op::unequal) return dimension::number;
  if (op == Op::atan2) return dimension::angle;
  return zero(a) ? db : zero(b) ? da : joined(da, db);
}

Program Formula::program(int root) const {
  Program p;
  if (write(root, p.code) > Program::most_stacked)
    throw ExpressionError("it nests too deeply: name parts of it in parameters, or use a table");
  return p;
}

// Returns the largest number of operands on the stack while term i is evaluated.
int Formula::write(int i, std::vector<Program::Instruction>& code) const {
  constexpr std::size_t longest = 20'000;
  if (code.size() > longest) throw ExpressionError("it is too long when written out: name parts of it in parameters");
  const Term& term = terms_[index(i)];
  int deepest = 1, before = 0;
  for (const int operand : {term.a, term.b, term.c}) {
    if (operand < 0) continue;
    deepest = std::max(deepest, before + write(operand, code));
    ++before;
  }
  code.push_back({term.op, term.value});
  return deepest;
}

}  // namespace pintle
