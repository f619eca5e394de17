#pragma once

#include <optional>

#include "contact/friction_law.h"
#include "contact/gap.h"
#include "contact/normal_law.h"
#include "framework/dynamics/marker.h"

namespace pintle {

/// Which relative speed friction opposes; see docs/theory/contact.md.
enum class Sliding { material, geometric };

/// A clearance joint: a journal in a bearing, no constraint rows, one contact.
struct ContactPair {
  int journal, bearing;  ///< markers at the two centres
  JournalBearing gap;
  ImpactLaw normal;
  std::optional<Ambrosio> friction;
  Sliding sliding = Sliding::material;
  double slowest_impact = 1e-6;  ///< floor of the latched approach speed [m/s]
};

/// What a clearance joint does at an instant. Friction acts on each body's own surface, Eq. (19).
struct ContactEffect {
  Gap gap;
  Wrench on_journal = Wrench::Zero(), on_bearing = Wrench::Zero();
  NormalForce normal;
  double friction = 0;       ///< on the journal along Zn [N]
  double friction_loss = 0;  ///< as the law sees it: −force · its own sliding speed [W]
};

MovingPoint moving_point(const MarkerMotion&);

/// @param impact_rate  latched approach speed [m/s]; 0 while open: then only the gap is found
ContactEffect evaluate(const ContactPair&, const MarkerMotion& journal, const MarkerMotion& bearing,
                       double impact_rate);

}  // namespace pintle
