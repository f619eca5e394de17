#include <string>
#include <vector>

#include "framework/scene/keys.h"

namespace performance {

// Apart from what knows integrators: the vocabulary is the reader's.
std::vector<std::string> known_methods() {
  const auto known = pintle::choices("run", "method");
  return {known.begin(), known.end()};
}

}  // namespace performance
