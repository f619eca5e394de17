#include "framework/scene/units/guard.h"

#include <algorithm>
#include <array>
#include <limits>

#include "framework/scene/units/machine.h"
#include "framework/scene/units/program_parts.h"

namespace pintle {

namespace {

constexpr const char* how_to_write_one = "; write a comparison such as crank.angle > 30 deg, or several joined by &&";

// |a| + |b| for a + b or a − b, recursively.
void add_size(const Program& program, std::size_t last, Program& out) {
  const Op op = program.code[last].op;
  if (op == Op::add || op == Op::subtract) {
    add_size(program, begin_of(program, last - 1) - 1, out);
    add_size(program, last - 1, out);
    out.code.push_back({Op::add});
    return;
  }
  for (const Program::Instruction& one : part(program, begin_of(program, last), last + 1).code) out.code.push_back(one);
  out.code.push_back({Op::abs});
}

void split(const Program& program, std::size_t last, std::vector<Comparison>& out) {
  const Op op = program.code[last].op;
  const std::size_t begin = begin_of(program, last);
  const bool falls = op == Op::less || op == Op::at_most, rises = op == Op::greater || op == Op::at_least;
  if (op == Op::equal || op == Op::unequal)
    throw ExpressionError("an event occurs when something passes a value, not while it equals one" + std::string(how_to_write_one));
  if (op == Op::either) throw ExpressionError("conditions joined by || are separate events; write two");
  if (op != Op::both && !falls && !rises) throw ExpressionError("it is not a condition" + std::string(how_to_write_one));
  const std::size_t second = begin_of(program, last - 1);
  if (op == Op::both) {
    split(program, second - 1, out);
    split(program, last - 1, out);
    return;
  }
  Program difference = falls ? part(program, second, last) : part(program, begin, second);
  for (const Program::Instruction& one : (falls ? part(program, begin, second) : part(program, second, last)).code)
    difference.code.push_back(one);
  difference.code.push_back({Op::subtract});
  Program size;
  add_size(difference, difference.code.size() - 1, size);
  out.push_back({std::move(difference), std::move(size), op == Op::at_most || op == Op::at_least});
}

// The range of a difference.
Range range_of(const Program& program, double until) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::array<RangeJet, Program::most_stacked> stack;
  std::size_t top = 0;
  for (const auto& [op, value] : program.code) {
    top -= static_cast<std::size_t>(operand_count(op));
    RangeJet* const x = stack.data() + top++;
    switch (operand_count(op)) {
      case 0:
        if (op == Op::input)
          *x = {{-infinite, infinite}, {-infinite, infinite}};
        else
          *x = op == Op::time ? time_from(0, until) : RangeJet{{value, value}, {0, 0}};
        break;
      case 1: *x = apply(op, x[0]); break;
      case 2: *x = apply(op, x[0], x[1]); break;
      default: *x = choose(x[0], x[1], x[2]);
    }
  }
  return stack[0].value;
}

bool same(const Program& a, const Program& b) {
  return std::ranges::equal(a.code, b.code, [](const auto& x, const auto& y) { return x.op == y.op && x.value == y.value; });
}

// Whether a is A − low and b is high − A, with high not above low.
bool contradict(const Comparison& a, const Comparison& b) {
  const Program &of_a = a.difference, &of_b = b.difference;
  const std::size_t n = of_a.code.size();
  if (n != of_b.code.size() || n < 3 || of_a.code[n - 2].op != Op::constant || of_b.code.front().op != Op::constant) return false;
  const double low = of_a.code[n - 2].value, high = of_b.code.front().value;
  const bool empty = low > high || (low == high && !(a.at_zero && b.at_zero));
  return empty && same(part(of_a, 0, n - 2), part(of_b, 1, n - 1)) && begin_of(of_a, n - 3) == 0;
}

}  // namespace

Known known_of(const std::vector<Comparison>& all, double until) {
  bool always = true;
  for (const Comparison& one : all) {
    const Range range = range_of(one.difference, until);
    if (range.hi < 0 || (range.hi == 0 && !one.at_zero)) return Known::never;
    always = always && (range.lo > 0 || (range.lo == 0 && one.at_zero));
    for (const Comparison& other : all)
      if (contradict(one, other)) return Known::never;
  }
  return always ? Known::always : Known::open;
}

std::vector<Comparison> comparisons(const Program& program) {
  std::vector<Comparison> out;
  split(program, program.code.size() - 1, out);
  return out;
}

}  // namespace pintle
