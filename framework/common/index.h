#pragma once

#include <cstddef>

namespace pintle {

/// A number that counts from 0, as the index of a standard container. @pre not negative
constexpr std::size_t at(std::ptrdiff_t i) { return static_cast<std::size_t>(i); }

}  // namespace pintle
