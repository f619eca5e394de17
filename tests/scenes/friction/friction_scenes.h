#pragma once

// What dry friction is tried on.
#include "tests/scenes/text_runs.h"

namespace pintle_scenes {

inline const Method dopri5{"Dopri5", "dopri5", 1e-9, 1e-6};

/// A slider of 1 kg in a straight guide, pressed by N on a belt that moves at V, held by a spring of k from rest at x = 0. The guide holds
/// it at the depth at which a contact of Hertz's law gives N.
struct Oscillator {
  double N = 10, k = 400, V = 0.1, slides = 0.2, holds = 0.3, start = 0, until = 4;
  std::string law = "coulomb: {coefficient: " + number(slides) + ", static: " + number(holds) + "}";
  std::string text() const {
    constexpr double stiffness = 1e9, radius = 0.02;
    const double y = radius - std::pow(N / stiffness, 2.0 / 3);
    return "bodies:\n  slider: {rigid: {mass: 1, inertia: 1e-3}, profiles: {shoe: {disc: [0, 0], radius: 20 mm}}}\n"
           "  belt: {rigid: {mass: 1, inertia: 1}, profiles: {face: {path: [[50, 0], [-50, 0]]}}}\n"
           "ground: {points: {G: [0, " +
           number(y) + "], S: [-1, " + number(y) +
           "], Z: [-100, 0]}}\n"
           "joints: {guide: {prismatic: [ground.G, slider]}, bed: {prismatic: [ground, belt]}}\n"
           "drivers: {motor: {distance: [ground.Z, belt], law: 100 m + " +
           number(V) +
           " m/s*t}}\n"
           "forces: {spring: {spring: [ground.S, slider], stiffness: " +
           number(k) +
           ", free length: 1}}\n"
           "contacts: {rub: {between: [slider.shoe, belt.face], normal: {hertz: {stiffness: 1e9}}, friction: {" +
           law +
           "}}}\n"
           "start: {slider: {x: " +
           number(start) + ", vx: " + number(start == 0 ? V : 0) + "}}\nrun: {until: " + number(until) + "}\noutput: {every: 1 ms}\n";
  }
};

/// A block of 2 kg on a ramp that falls by `angle` towards −x. It starts as deep as it rests, and rocks a little until both its corners
/// bear what they will.
inline std::string block_on_ramp(double angle, double until, const std::string& start = "",
                                 const std::string& law = "coulomb: {coefficient: 0.3, static: 0.4}") {
  constexpr double gravity = 9.81;
  return "gravity: [" + number(-gravity * std::sin(angle)) + ", " + number(-gravity * std::cos(angle)) +
         "]\n"
         "bodies: {block: {rigid: {mass: 2, inertia: 5e-3}, profiles: {outline: {path: [[-8 cm, -2 cm], [8 cm, -2 cm], [8 cm, 2 cm], [-8 "
         "cm, 2 cm]], "
         "closed: true, round: 2 mm}}}}\nground: {profiles: {ramp: {path: [[50, 0], [-50, 0]]}}}\n"
         "contacts: {rest: {between: [block.outline, ground.ramp], normal: {spring-damper: {stiffness: 1e6, damping: 1e3}}, "
         "friction: {" +
         law +
         "}}}\n"
         "start: {block: {y: " +
         number(0.02 - gravity * std::cos(angle) / 1e6) + start + "}}\nrun: {until: " + number(until) +
         "}\noutput: {every: " + number(until / 200) + "}\n";
}

}  // namespace pintle_scenes
