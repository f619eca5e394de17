#pragma once

#include <optional>

#include "contact/friction_law.h"
#include "contact/gap.h"
#include "contact/normal_law.h"
#include "framework/dynamics/model/marker.h"
#include "framework/dynamics/model/wrench_tangent.h"

namespace pintle {

/// Which relative speed friction opposes; see docs/theory/contact.md.
enum class Sliding { material, geometric };

/// A clearance joint: a journal in a bearing. By its model a contact without constraint rows, or, with
/// `link`, a massless link between the two centres, one row that some joint of the system holds.
struct ContactPair {
  int journal, bearing;  ///< markers at the two centres
  JournalBearing gap;
  ImpactLaw normal;
  std::optional<Ambrosio> friction;
  Sliding sliding = Sliding::material;
  double slowest_impact = 1e-6;  ///< floor of the latched approach speed [m/s]
  int link = -1;                 ///< the joint that holds the centres apart; then no law acts. −1: a contact
};

/// What a clearance joint does at an instant. Friction acts on each body's own surface, Eq. (19).
struct ContactEffect {
  Gap gap;
  Wrench on_journal = Wrench::Zero(), on_bearing = Wrench::Zero();
  NormalForce normal;
  double friction = 0;       ///< on the journal along Zn [N]
  double friction_loss = 0;  ///< as the law sees it: −force · its own sliding speed [W]
};

/// Its two centres are kept apart by a massless link: no law acts, nothing is touched or left.
inline bool is_held(const ContactPair& pair) { return pair.link >= 0; }

MovingPoint moving_point(const MarkerMotion&);

/// @param impact_rate  latched approach speed [m/s]; 0 while open: then only the gap is found
ContactEffect evaluate(const ContactPair&, const MarkerMotion& journal, const MarkerMotion& bearing, double impact_rate);

inline constexpr WrenchPattern contact_pattern{{{{true, true}, {true, true}}}, true};
/// How the wrenches [journal; bearing] answer to the motion, the latched approach speed held. Zero while open.
/// @param now  what the contact does in this state
WrenchTangent wrench_tangent(const ContactPair&, const ContactEffect& now, const MarkerMotion& journal, const MarkerMotion& bearing);

}  // namespace pintle
