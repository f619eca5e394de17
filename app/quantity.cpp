#include "app/quantity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace pintle {

std::string quantity(double value, const std::string& unit) {
  constexpr std::array prefixes{"n", "µ", "m", "", "k", "M", "G"};
  constexpr int middle = 3;
  const double thousands = value != 0 && std::isfinite(value) ? std::floor(std::log10(std::abs(value) * (1 + 1e-9)) / 3) : 0;
  const auto step = static_cast<std::size_t>(std::clamp(thousands + middle, 0.0, prefixes.size() - 1.0));
  std::array<char, 48> text;
  std::snprintf(text.data(), text.size(), "%.3g %s%s", value / std::pow(1000.0, static_cast<int>(step) - middle), prefixes[step],
                unit.c_str());
  return text.data();
}

double round_length(double length) {
  const double decade = std::pow(10.0, std::floor(std::log10(length)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * decade <= length) return digit * decade;
  }
  return decade;
}

}  // namespace pintle
