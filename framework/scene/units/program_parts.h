#pragma once

#include <cstddef>

#include "framework/scene/units/formula.h"

/// Decomposition of programs: an operand is the sequence of instructions that leaves it on the stack.
namespace pintle {

constexpr int operand_count(Op op) {
  if (op <= Op::input) return 0;
  if (op <= Op::smooth) return 1;
  return op < Op::choose ? 2 : 3;
}
/// The first instruction of the operand that ends with this one.
std::size_t begin_of(const Program&, std::size_t last);
/// Instructions [from, to) as a program.
Program part(const Program&, std::size_t from, std::size_t to);
bool names(const Program&, Op);
/// A comparison, or a function with kinks or ends: abs, min, max, step.
bool switches(Op);
/// Those of its comparisons and kinks that depend only on t, each as a law of time with its breaks there.
std::vector<Program> switches_of_time(const Program&);

}  // namespace pintle
