#pragma once

#include <string>
#include <vector>

#include "fmi/contents.h"
#include "framework/integration/events/event.h"
#include "framework/integration/events/impact.h"

namespace pintle::fmi {

/// Values of the discrete variables, updated during a run.
class Tally {
 public:
  void look(const std::vector<FmuVariable>&, const std::vector<std::string>& contact_names, const std::vector<Happening>&,
            const std::vector<Impact>&);
  /// One value per variable; 0 if it is not discrete.
  const std::vector<int>& values() const { return values_; }

 private:
  std::size_t happenings_ = 0, impacts_ = 0;
  std::vector<std::size_t> open_;  ///< impacts that had not ended
  std::vector<int> values_;
};

}  // namespace pintle::fmi
