#pragma once

#include <string>
#include <vector>

#include "framework/dynamics/equations/equations.h"
#include "framework/integration/step.h"

namespace pintle {

/// Contacts that begin slowly and are then pressed in faster, beyond what an impact law with hysteresis is made for: its
/// damping χ δ̇/δ̇₀ of the elastic force grows without bound with the rate δ̇ over the one at onset, δ̇₀.
class SlowContacts {
 public:
  explicit SlowContacts(const System& system) : seen_(system.contacts.size()) {}
  /// After an accepted step.
  void see(const System&, const Step&, const Equations&);
  /// @param in_play  energy that the doubtful loss is held against [J]
  void warn(const System&, double in_play, std::vector<std::string>& warnings) const;

 private:
  struct Seen {
    bool beyond = false;                   ///< at the last step's end
    double since = -1;                     ///< first time [s]; −1: never
    double onset = 0, rate = 0, over = 0;  ///< where damping over elastic force was largest
    double lost = 0;                       ///< in such steps [J]
  };
  std::vector<Seen> seen_;
};

}  // namespace pintle
