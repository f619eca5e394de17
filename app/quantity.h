#pragma once

#include <string>

namespace pintle {

/// "12.5 ms": three digits and a prefix.
std::string quantity(double value, const std::string& unit);

/// The largest of 1, 2, 5 · 10ⁿ not above `length`.
double round_length(double length);

}  // namespace pintle
