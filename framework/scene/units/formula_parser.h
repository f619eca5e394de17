#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "framework/scene/units/spelling.h"

namespace pintle {

/// One step in the evaluation of an expression on a stack: it takes the last `operands` values and leaves one.
struct FormulaStep {
  const Word* word;      ///< its source
  int operands = 0;      ///< none: the word is the number or name itself
  Op op = Op::constant;  ///< with operands; Op::smooth with three of them: step(x, x0, x1)
};

/// The steps of an expression, those of its operands first. In its grammar, [ ] means optional, { } any number of times:
///
///     expression = and {"||" and}
///     and        = comparison {"&&" comparison}
///     comparison = sum {("<" | "<=" | ">" | ">=" | "==" | "!=") sum}
///     sum        = product {("+" | "-") product}
///     product    = signed {("*" | "/") signed}
///     signed     = ["+" | "-"] power
///     power      = operand ["^" signed]
///     operand    = number | name | signal | "(" expression ")" | call
///     call       = function "(" [expression {"," expression}] ")"
///
/// The steps point to the words, which must outlive them.
/// @throws ExpressionError  invalid expression, nesting too deep, an unknown function, or too many or too few arguments
std::vector<FormulaStep> parse(std::span<const Word>);

/// Names of all functions, for messages and documentation.
const std::vector<std::string>& function_names();
bool is_function(std::string_view name);

}  // namespace pintle
