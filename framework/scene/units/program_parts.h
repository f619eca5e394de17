#pragma once

#include <cstddef>

#include "framework/scene/units/formula.h"

/// Programs taken apart: an operand is the run of instructions that leaves it on the stack.
namespace pintle {

int operand_count(Op);
/// Where the operand begins that ends with this instruction.
std::size_t begin_of(const Program&, std::size_t last);
/// Instructions [from, to) as a program.
Program part(const Program&, std::size_t from, std::size_t to);
bool names(const Program&, Op);
/// A comparison, or a function with a kink or with ends: abs, min, max, step.
bool switches(Op);
/// Those of its comparisons and kinks that t alone decides, each as a law of time that has its breaks where they are.
std::vector<Program> switches_of_time(const Program&);

}  // namespace pintle
