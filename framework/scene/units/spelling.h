#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "framework/scene/units/formula.h"

namespace pintle {

using Parameters = std::map<std::string, Quantity, std::less<>>;

/// A signal of the motion that expressions may name.
struct SignalName {
  Dimension dimension;
  std::string not_allowed = {};  ///< why it is not allowed here; empty: it is allowed
  std::string stands_for = {};   ///< the expression that replaces it; empty: it has a value of its own
};
using SignalNames = std::map<std::string, SignalName, std::less<>>;

/// The names an expression may use besides pi and the functions. Must not outlive its parts.
struct Vocabulary {
  const Parameters& parameters;
  std::span<const Unit> more_units = {};          ///< besides units()
  const SignalNames* signals = nullptr;           ///< nullptr: the value cannot change with the motion
  std::string_view variable = "t";                ///< the name of its variable
  int within = 0;                                 ///< nesting depth of expressions that stand for names
  const Unit* unit(std::string_view name) const;  ///< nullptr if there is none
};

/// An expression divided into words, with the multiplications implied by a space before a unit made explicit. `10 mm` becomes 10 * mm; `1/2
/// mm` becomes 1 / 2 * mm. A signal is the longest known name that the text continues with.
struct Word {
  enum class Kind { number, name, signal, function, sign, open, close, comma } kind;
  std::string text;
  std::size_t at = 0;  ///< position of its first character in the expression, from 1
  double value = 0;    ///< of a number
};

/// `3 1/s` becomes 3 * 1 / s.
/// @throws ExpressionError  an invalid character, number or parenthesis, two adjacent values, or a unit after a division that is ambiguous
std::vector<Word> spell(std::string_view text, const Vocabulary&);

}  // namespace pintle
