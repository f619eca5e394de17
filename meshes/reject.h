#pragma once

#include <sstream>
#include <stdexcept>

namespace pintle {

/// Throws std::invalid_argument with the parts joined as a stream would print them.
template <class... Parts>
[[noreturn]] void reject(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  throw std::invalid_argument(text.str());
}

}  // namespace pintle
