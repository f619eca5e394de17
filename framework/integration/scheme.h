#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "framework/dynamics/model/system.h"
#include "framework/integration/constraint_treatment.h"
#include "framework/integration/explicit/tableau.h"

namespace pintle {

class EventGroup;

/// A time at which a law of time changes: steps end at `before` and continue from `after`, a few roundings later.
struct LawChange {
  double before, after;  ///< [s]
  bool jumps;            ///< forces or accelerations jump; otherwise only higher derivatives
};

/// A time interval in which a law is a polynomial of fifth degree, but not linear.
struct LawBend {
  double begin, end;  ///< [s]
};

/// The method of time integration and its settings.
struct Scheme {
  const Tableau* tableau = nullptr;  ///< explicit; nullptr: generalised-α, or Moreau's where the step is fixed
  double fixed_step = 0;             ///< of Moreau's scheme [s]
  double tolerance = 1e-8;           ///< local error of each component relative to its scale, see ErrorNorm
  Constraints constraints = Constraints::projection;
  double onset_cut = 0;               ///< 0: locate contact onset and loss as events. Positive: the strategy of
                                      ///< Flores and Ambrósio (2010), halve the step until the first penetration
                                      ///< is below this [m]; loss is then taken at the end of a step
  const Tableau* fallback = nullptr;  ///< takes over permanently if a stage of `tableau` comes near a singular configuration; nullptr: none
  double max_step = std::numeric_limits<double>::infinity();  ///< [s]
  std::vector<LawChange> changes = {};                        ///< of the laws of time, in order and distinct
  std::vector<std::vector<double>> pieces = {};  ///< per law, ends of its smooth pieces; a step contains at most one whole piece
  std::vector<std::vector<LawBend>> bends = {};  ///< per law, its smooth pieces that are not linear, in order
  long max_steps = 100'000'000;
  double rho = 0.8;         ///< of generalised-α: spectral radius at infinite frequency, 0 to 1
  double switch_below = 0;  ///< generalised-α is tried where stability, not accuracy, limits explicit
                            ///< steps to less than this [s]; 0: never
  std::string reason = {};  ///< reason for this scheme, in words
  std::string stiff = {};   ///< the fastest decay, in words
  /// Each creates a group of events for one integrator, in addition to those of the contacts.
  std::vector<std::function<std::unique_ptr<EventGroup>(const System&)>> events = {};
};

/// Name in scene files.
inline std::string name(const Scheme& s) {
  return s.tableau ? std::string(s.tableau->name) : s.fixed_step > 0 ? "moreau" : "generalized-alpha";
}

}  // namespace pintle
