#pragma once

#include <string>

namespace pintle {

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string printed(const char* format, ...);

}  // namespace pintle
