#include "framework/scene/units/guard.h"

namespace pintle {

namespace {

constexpr const char* how_to_write_one = "; write a comparison such as crank.angle > 30 deg, or several joined by &&";

int operand_count(Op op) {
  if (op < Op::negate) return 0;
  return op <= Op::smooth ? 1 : op < Op::choose ? 2 : 3;
}

// Where the operand begins that ends with this instruction.
std::size_t begin_of(const Program& program, std::size_t last) {
  for (int wanted = operand_count(program.code[last].op); wanted > 0; --wanted) last = begin_of(program, last - 1);
  return last;
}

void split(const Program& program, std::size_t last, std::vector<Program>& out) {
  const Op op = program.code[last].op;
  const std::size_t begin = begin_of(program, last);
  const bool falls = op == Op::less || op == Op::at_most, rises = op == Op::greater || op == Op::at_least;
  if (op == Op::equal || op == Op::unequal)
    throw ExpressionError("an event comes where something passes a value, not where it equals one" + std::string(how_to_write_one));
  if (op == Op::either) throw ExpressionError("conditions joined by || are events of their own; write two");
  if (op != Op::both && !falls && !rises) throw ExpressionError("it is no condition" + std::string(how_to_write_one));
  const std::size_t second = begin_of(program, last - 1);
  if (op == Op::both) {
    split(program, second - 1, out);
    split(program, last - 1, out);
    return;
  }
  const auto part = [&](std::size_t from, std::size_t to) {
    return std::vector(program.code.begin() + static_cast<std::ptrdiff_t>(from), program.code.begin() + static_cast<std::ptrdiff_t>(to));
  };
  Program difference{falls ? part(second, last) : part(begin, second)};
  for (const Program::Instruction& one : falls ? part(begin, second) : part(second, last)) difference.code.push_back(one);
  difference.code.push_back({Op::subtract});
  out.push_back(std::move(difference));
}

}  // namespace

std::vector<Program> comparisons(const Program& program) {
  std::vector<Program> out;
  split(program, program.code.size() - 1, out);
  return out;
}

}  // namespace pintle
