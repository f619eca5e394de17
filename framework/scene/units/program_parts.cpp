#include "framework/scene/units/program_parts.h"

#include <algorithm>

namespace pintle {

std::size_t begin_of(const Program& program, std::size_t last) {
  for (int wanted = operand_count(program.code[last].op); wanted > 0; --wanted) last = begin_of(program, last - 1);
  return last;
}

Program part(const Program& program, std::size_t from, std::size_t to) {
  return {{program.code.begin() + static_cast<std::ptrdiff_t>(from), program.code.begin() + static_cast<std::ptrdiff_t>(to)}};
}

bool names(const Program& program, Op what) {
  return std::ranges::any_of(program.code, [what](const Program::Instruction& i) { return i.op == what; });
}

bool switches(Op op) {
  return op == Op::abs || op == Op::smooth || op == Op::min || op == Op::max || (op >= Op::less && op <= Op::at_least);
}

std::vector<Program> switches_of_time(const Program& program) {
  std::vector<Program> out;
  for (std::size_t i = 0; i < program.code.size(); ++i) {
    if (!switches(program.code[i].op)) continue;
    Program one = part(program, begin_of(program, i), i + 1);
    if (names(one, Op::time) && !names(one, Op::input)) out.push_back(std::move(one));
  }
  return out;
}

}  // namespace pintle
