#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "framework/common/nearest.h"
#include "framework/common/text.h"

namespace pintle {

/// Lists names in a message: "a", "b" and "c"; of more than nine, the first eight and the number of the others: "and 990 others".
/// @param quotes  puts the names in quotes
inline std::string some_of(const std::vector<std::string>& names, bool quotes = true) {
  constexpr std::size_t most = 8;
  const bool many = names.size() > most + 1;
  std::vector<std::string> shown;
  for (std::size_t i = 0; i < (many ? most : names.size()); ++i) shown.push_back(quotes ? quoted(names[i]) : names[i]);
  return many ? listed(shown, ",") + " and " + std::to_string(names.size() - most) + " others" : listed(shown, "and");
}

}  // namespace pintle
