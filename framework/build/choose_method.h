#pragma once

#include <string>
#include <vector>

#include "framework/integration/scheme.h"
#include "framework/scene/scene.h"

namespace pintle {

/// How fast a system would move by itself and how fast it is made to, estimated from its parts alone: linear
/// in their number, before any pose is known.
struct RateSpectrum {
  struct Part {
    double rate = 0;        ///< as an undamped oscillation [rad/s]
    double decay = 0;       ///< of its speed by its damper, 2ζω of a mode [1/s]
    std::string what = {};  ///< for messages
  };
  double motion = 0;          ///< start spins, drivers' rates, √(g/length) [rad/s]; if none, how what swings, or is pushed, moves
  double until = 0;           ///< length of the run [s]
  Part fastest, most_damped;  ///< of springs and modes
  std::vector<Part> parts;    ///< springs, modes, contacts
  bool struck = false;        ///< there are contacts, which set everything ringing again
  double strike = 0;          ///< rate of the fastest contact [rad/s]
};
/// Each spring is taken as if nothing but it held its two bodies, at the points where it holds them, which no joint
/// makes slower. A contact is no `fastest`: while it lasts, accuracy asks for short steps of any scheme.
RateSpectrum spectrum(const Scene&, const System&);

/// Steps a second that stability and accuracy ask for at a local error of `tolerance`.
struct Demand {
  double stability;  ///< of dopri5
  double accuracy;   ///< of dopri5
  double implicit;   ///< accuracy, of generalised-α
  double high;       ///< accuracy, of verner87
};
Demand demand(const RateSpectrum&, double tolerance);

/// Fills tableau, constraints, rho, switch_below and reason. `method: auto` takes generalised-α if it gets by with
/// an eighth of the steps of dopri5, which cost about the same but are more accurate; else verner87 if the tolerance is 1e-6 or
/// less, it is not contacts that ask for the steps, and its evaluations, those for rows and frames among them, are fewer,
/// with dopri5 to fall back on near singular poses; else dopri5.
/// @throws SceneError  no such method, or constraints that it cannot keep
void choose_method(const Scene&, const System&, Scheme&);

}  // namespace pintle
