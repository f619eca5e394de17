#pragma once

// Slider-cranks with a worn gudgeon pin, up to what drives them.
#include <string>

namespace pintle {

/// The paper's, all bodies rigid.
inline const std::string worn_slider_crank = R"(gravity: [0, -9.81]
parameters: {clearance: 0.1 mm, speed: 150 rad/s}
bodies:
  crank:   {rigid: {mass: 0.30 kg, inertia: 1.0e-4 kg m^2}, points: {O: [-25 mm, 0], A: [25 mm, 0]}}
  coupler: {rigid: {mass: 0.21 kg, inertia: 2.5e-4 kg m^2}, points: {A: [-60 mm, 0], B: [60 mm, 0]}}
  slider:  {rigid: {mass: 0.14 kg, inertia: 1.0e-4 kg m^2}, points: {P: [0, 0]}}
joints:
  main bearing: {revolute: [ground, crank.O]}
  crank pin:    {revolute: [crank.A, coupler.A]}
  gudgeon pin:
    revolute: [coupler.B, slider.P]
    clearance:
      radial: clearance
      bearing radius: 10 mm
      bearing: slider
      normal: {lankarani-nikravesh: {restitution: 0.8, young: 207 GPa, poisson: 0.3}}
  guide: {prismatic: [ground, slider.P]}
)";

/// The joints of one whose contact has a stiffness of its own [N/m^1.5], and friction.
inline std::string worn_joints(const std::string& stiffness) {
  return R"(joints:
  main bearing: {revolute: [ground, crank.O]}
  crank pin: {revolute: [crank.A, coupler.A]}
  gudgeon pin:
    revolute: [coupler.B, slider.P]
    clearance: {radial: 0.1 mm, bearing radius: 10 mm, bearing: slider,
                normal: {lankarani-nikravesh: {restitution: 0.8, stiffness: )" +
         stiffness + R"(}},
                friction: {ambrosio: {coefficient: 0.05}}}
  guide: {prismatic: [ground, slider.P]}
)";
}

}  // namespace pintle
