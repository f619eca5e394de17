#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pintle {

/// An expression cut into words, with the multiplications that a space before a unit means written
/// out. `10 mm` becomes 10 * mm; `1/2 mm` becomes 1 / 2 * mm.
struct Word {
  enum class Kind { number, name, function, sign, open, close, comma } kind;
  std::string text;
  double value = 0;  ///< of a number
};

/// @throws ExpressionError  a character, number or parenthesis that cannot be, two values side by
///                          side, or a unit after a division that could be read two ways
std::vector<Word> spell(std::string_view text);

}  // namespace pintle
