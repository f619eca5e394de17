#pragma once

// Bodies of elements that use all of the language.
#include "tests/unit/scene_text.h"

namespace pintle {

// Line numbers below count from the line after R"(.
inline const std::string elastic_scene = R"(title: Bodies of elements
materials:
  steel: {young: 207 GPa, poisson: 0.3, density: 7850 kg/m^3}
  ply: {orthotropic: {young: [140 GPa, 10 GPa], poisson: 0.3, shear: 5 GPa, angle: 30 deg}, density: 1600}
  rubber: {young: 10 MPa, poisson: 0.49}
bodies:
  coupler:
    beam: {from: A, to: B, section: {circle: 10 mm}, mass: 0.21 kg, young: 207 GPa, poisson: 0.3, elements: 1}
    points: {A: [0, 0], B: [120 mm, 0]}
    modes: {frame: chord, keep: all}
    damping: {rayleigh: {ratios: [0.04, 0.03], modes: [1, 3]}}
    mass matrix: lumped
    lumps: {B: {mass: 0.1 kg, inertia: 1e-5 kg m^2}}
    supports: {A: fixed, B: [y]}
  mast:
    beam:
      through: [foot, knee, head]
      section: {i: {height: 100 mm, width: 55 mm, web: 4 mm, flange: 6 mm}}
      taper to: {i: {height: 50 mm, width: 30 mm, web: 3 mm, flange: 4 mm}}
      theory: euler
      rotary inertia: false
      material: steel
    points: {foot: [0, 0], knee: [0, 1 m], head: {at: [1 m, 1 m], angle: 90 deg}}
    modes: {frame: {tangent: foot}, below: 5 kHz}
    damping: {rayleigh: {alpha: 3 1/s, beta: 1e-5 s}}
    supports: {foot: fixed, head: [x, rotation]}
  rocker:
    plate:
      link: {eye bar: {length: 120 mm, width: 14 mm, eyes: [{bore: 24 mm, outer: 38 mm}, {bore: 12 mm, outer: 22 mm}]}}
      thickness: 8 mm
      material: ply
      element: quadrilateral8
      size: 3 mm
      hole size: 1 mm
    points: {C: {hole: eye 1, coupling: average, angle: 10 deg}, D: {hole: eye 2}, tip: [100 mm, 0]}
    pose: {at: [1 m, 0], angle: 5 deg}
    modes: {frame: {chord: [C, D]}, craig-bampton: {below: 8 kHz}}
    damping: {ratios: 0.02}
    supports: {C: pinned, outline: y}
  sheet:
    plate: {grid: {corners: [[0, 0], [2 m, 0], [2 m, 1 m], [0, 1 m]], cells: [20, 10]}, thickness: 1 mm, material: rubber, mass: 2 kg, plane: strain}
    modes: {effective mass: 0.95}
    damping: {ratios: [0.01, 0.02]}
static:
  body: rocker
  loads:
    pull: {at: D, force: [1 kN, 0]}
    turn: {at: D, torque: 5 N m}
    bearing: {on: eye 1, pressure: 5 MPa}
    edge: {on: outline, traction: [0, 1 MPa]}
    dead weight: {acceleration: [0, -9.81 m/s^2]}
    spin: {spin: 3000 rpm, about: C}
)";

inline std::string spoiled(const std::string& from, const std::string& to) {
  std::string text = elastic_scene;
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("no \"" + from + "\" in the scene");
  return text.replace(at, from.size(), to);
}

/// A beam from A (0, 0) to B (1, 0) with more keys of its own.
inline std::string with_beam(const std::string& keys) {
  return "bodies:\n  rod:\n    beam: {from: A, to: B, " + keys + "}\n    points: {A: [0, 0], B: [1, 0]}\n";
}
inline const std::string steel_keys = "young: 207 GPa, poisson: 0.3, density: 7850 kg/m^3";
/// A plate of 1 mm steel with more keys of its own.
inline std::string with_plate(const std::string& keys) {
  return "bodies:\n  part:\n    plate: {thickness: 1 mm, " + steel_keys + ", " + keys + "}\n";
}

inline void expect_refused(const std::vector<Spoiled>& all) { expect_each_refused(all, spoiled); }

}  // namespace pintle
