#include "framework/scene/units/unlimited.h"

#include <algorithm>

#include "framework/scene/units/program_parts.h"
#include "framework/scene/units/signal_law.h"

namespace pintle {

namespace {

bool moves(const Program& of, const std::vector<bool>& fixed) {
  return std::ranges::any_of(of.code,
                             [&](const Program::Instruction& i) { return i.op == Op::input && !fixed[static_cast<std::size_t>(i.value)]; });
}

// The operand that ends with instruction `last`, without its limits.
Program operand_without_limits(const Program& of, std::size_t last, const std::vector<bool>& fixed, Limits which) {
  const Op op = of.code[last].op;
  if (which == Limits::of_value && op != Op::min && op != Op::max) return of;
  std::vector<Program> operands;
  std::size_t end = last;  // of the operands not yet taken, which are taken from the last on
  for (int k = operand_count(op); k > 0; --k) {
    const std::size_t begin = begin_of(of, end - 1);
    operands.push_back(operand_without_limits(part(of, begin, end), end - begin - 1, fixed, which));
    end = begin;
  }
  if ((op == Op::min || op == Op::max) && moves(operands[0], fixed) != moves(operands[1], fixed))
    return operands[moves(operands[0], fixed) ? 0 : 1];
  Program out;
  for (auto one = operands.rbegin(); one != operands.rend(); ++one) out.code.insert(out.code.end(), one->code.begin(), one->code.end());
  out.code.push_back(of.code[last]);
  return out;
}

}  // namespace

std::optional<SignalFunction> unlimited(const SignalFunction& of, const std::vector<bool>& fixed, Limits which) {
  const auto* formula = of.target<SignalFormula>();
  if (!formula) return {};
  Program made = operand_without_limits(formula->program, formula->program.code.size() - 1, fixed, which);
  if (made.code.size() == formula->program.code.size()) return {};
  SignalFormula out(std::move(made));
  out.inputs = formula->inputs;
  return SignalFunction(std::move(out));
}

}  // namespace pintle
