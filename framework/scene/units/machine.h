#pragma once

#include <array>
#include <type_traits>

#include "framework/scene/units/jet.h"
#include "framework/scene/units/range.h"

namespace pintle {

/// Evaluates a formula of time alone, over jets or over ranges of them, up to a given instruction.
template <class Value>
class Machine {
 public:
  /// The operands on the stack before instruction `count`, the last ones at the end.
  const Value* run(const Program& program, std::size_t count, const Value& time) {
    std::size_t top = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [op, value] = program.code[i];
      if (op == Op::constant) {
        stack_[top++] = constant(value);
      } else if (op == Op::time) {
        stack_[top++] = time;
      } else if (op <= Op::smooth) {
        stack_[top - 1] = apply(op, stack_[top - 1]);
      } else if (op < Op::choose) {
        --top;
        stack_[top - 1] = apply(op, stack_[top - 1], stack_[top]);
      } else {
        top -= 2;
        stack_[top - 1] = chosen(stack_[top - 1], stack_[top], stack_[top + 1]);
      }
    }
    return stack_.data() + top;
  }

 private:
  static Value constant(double x) {
    if constexpr (std::is_same_v<Value, Jet>)
      return {x, 0, 0};
    else
      return {{x, x}, {0, 0}};
  }
  static Value chosen(const Value& condition, const Value& then, const Value& otherwise) {
    if constexpr (std::is_same_v<Value, Jet>)
      return condition.value != 0 ? then : otherwise;
    else
      return choose(condition, then, otherwise);
  }
  std::array<Value, Program::most_stacked> stack_;
};

inline RangeJet time_from(double a, double b) { return {{a, b}, {1, 1}}; }

}  // namespace pintle
