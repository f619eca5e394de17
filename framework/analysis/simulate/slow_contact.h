#pragma once

#include <string>
#include <vector>

#include "framework/dynamics/equations/equations.h"
#include "framework/integration/step.h"

namespace pintle {

/// Contacts that begin slowly and are then compressed faster, outside the range of an impact law with hysteresis: its damping, χ δ̇/δ̇₀
/// times the elastic force, grows without bound with the ratio of the rate δ̇ to that at onset, δ̇₀.
class SlowContacts {
 public:
  explicit SlowContacts(const System& system) : seen_(system.contacts.size()) {}
  /// After an accepted step.
  void see(const System&, const Step&, const Equations&);
  /// @param in_play  energy that is the scale of the doubtful loss [J]
  void warn(const System&, double in_play, std::vector<std::string>& warnings) const;

 private:
  struct Seen {
    bool beyond = false;                   ///< at the last step's end
    double since = -1;                     ///< first time [s]; −1: never
    double onset = 0, rate = 0, over = 0;  ///< at the largest ratio of damping to elastic force
    double lost = 0;                       ///< during such steps [J]
  };
  std::vector<Seen> seen_;
};

}  // namespace pintle
