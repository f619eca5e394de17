#pragma once

#include <string>
#include <vector>

#include "fmi/contents.h"
#include "framework/integration/events/event.h"
#include "framework/integration/events/impact.h"

namespace pintle::fmi {

/// What the discrete variables count, kept up with a run.
class Tally {
 public:
  void look(const std::vector<FmuVariable>&, const std::vector<std::string>& contact_names, const std::vector<Happening>&,
            const std::vector<Impact>&);
  /// Of each variable; 0 of those that are not discrete.
  const std::vector<int>& values() const { return values_; }

 private:
  std::size_t happenings_ = 0, impacts_ = 0;
  std::vector<std::size_t> open_;  ///< impacts that had not ended
  std::vector<int> values_;
};

}  // namespace pintle::fmi
