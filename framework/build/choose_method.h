#pragma once

#include <string>
#include <vector>

#include "framework/integration/scheme.h"
#include "framework/scene/scene.h"

namespace pintle {

/// The rates at which a system would oscillate by itself and is driven, estimated from its parts alone, before any configuration is known,
/// in time linear in their number.
struct RateSpectrum {
  struct Part {
    double rate = 0;        ///< as an undamped oscillation [rad/s]
    double decay = 0;       ///< of its speed due to its damper, 2ζω of a mode [1/s]
    std::string what = {};  ///< for messages
  };
  double motion = 0;          ///< initial spins, drivers' rates, √(g/length) [rad/s]; if none, that of oscillations or due to forces
  double until = 0;           ///< length of the run [s]
  Part fastest, most_damped;  ///< of springs and modes
  std::vector<Part> parts;    ///< springs, modes, contacts
  bool struck = false;        ///< there are contacts, whose impacts excite all oscillations anew
  double strike = 0;          ///< rate of the fastest contact [rad/s]
};
/// Each spring is considered alone, acting on its two bodies at its points; joints can only make it slower. A contact is never `fastest`:
/// while it lasts, accuracy requires short steps with any scheme.
RateSpectrum spectrum(const Scene&, const System&);

/// Steps per second required by stability and accuracy at a local error of `tolerance`.
struct Demand {
  double stability;  ///< of dopri5
  double accuracy;   ///< of dopri5
  double implicit;   ///< accuracy, of generalised-α
  double high;       ///< accuracy, of verner87
};
Demand demand(const RateSpectrum&, double tolerance);

/// Fills tableau, constraints, rho, switch_below and reason. `method: auto` chooses generalised-α if it needs at most an eighth of the
/// steps of dopri5, which cost about the same but are more accurate; otherwise verner87 if the tolerance is 1e-6 or less, contacts do not
/// determine the steps, and it needs fewer evaluations, including those for rows and frames, with dopri5 as the fallback near singular
/// configurations; otherwise dopri5.
/// @throws SceneError  no such method, or constraints that it does not support
void choose_method(const Scene&, const System&, Scheme&);

}  // namespace pintle
