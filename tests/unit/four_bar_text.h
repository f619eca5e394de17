#pragma once

#include <string>

namespace pintle_test {

/// A four-bar with neither drive nor run.
inline const std::string four_bar = R"(
gravity: [0, -9.81]
ground: {points: {O: [0, 0], C: [0.3, 0]}}
bodies:
  crank: {rigid: {mass: 0.3, inertia: 1e-4}, points: {O: [-50 mm, 0], A: [50 mm, 0]}, pose: {at: [0.05, 0]}}
  coupler: {rigid: {mass: 0.5, inertia: 1e-2}, points: {A: [-150 mm, 0], B: [150 mm, 0]}, pose: {at: [0.25, 0.05], angle: 40 deg}}
  rocker: {rigid: {mass: 0.4, inertia: 5e-3}, points: {B: [0, 0.1], C: [0, -0.1]}, pose: {at: [0.3, 0.1]}}
joints:
  main bearing: {revolute: [ground.O, crank.O]}
  crank pin: {revolute: [crank.A, coupler.A]}
  rocker pin: {revolute: [coupler.B, rocker.B]}
  rocker bearing: {revolute: [ground.C, rocker.C]}
)";

}  // namespace pintle_test
