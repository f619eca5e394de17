#pragma once

#include <string>

namespace pintle::scene_schema_test {

// Every key of the scene language at least once.
inline const std::string base = R"(
parameters: {c: 0.1 mm}
materials:
  steel: {young: 2e11, poisson: 0.3, density: 7850}
  ply: {orthotropic: {young: [1e11, 1e10], poisson: 0.3, shear: 5e9, angle: 30 deg}}
ground:
  points: {C: [0, 1], D: {at: [0, 0], angle: 1}}
  profiles: {floor: {path: [C, [1, 0], {arc: 2 m}, [2, 0]], material: right, round: 1 mm}, socket: {hole: D, radius: 20 mm}}
bodies:
  crank: {rigid: {mass: 1 kg, inertia: 0.1, center: [0, 0]}, points: {A: [10 mm, 0]}, pose: {at: [0, 0], angle: 1},
          profiles: {pin: {disc: A, radius: 10 mm}, cam: {path: [[0, 0], {arc: 0.6}, [1, 0], {arc: 0.6}], closed: true, material: inside}}}
  rod:
    beam: {from: A, to: B, section: {tube: [0.02, 0.01]}, taper to: {tube: [0.01, 5 mm]}, material: ply, mass: 1,
           theory: timoshenko, shear factor: 5/6, rotary inertia: false, elements: 4, pieces: 2}
    points: {A: [0, 0], B: {at: [1, 0], angle: 1}}
    modes: {frame: {chord: [A, B]}, below: 5 kHz}
    damping: {rayleigh: {ratios: [0.01, 0.02], modes: [1, 3]}}
    stiffening: axial
    mass matrix: lumped
    lumps: {B: {mass: 0.1, inertia: 0.01}}
    supports: {A: fixed, B: [y, rotation]}
  mast:
    beam: {through: [A, B, C], section: {i: {height: 0.1, width: 0.05, web: 0.004, flange: 0.006}}, material: steel, theory: euler}
    points: {A: [0, 0], B: [1, 0], C: [1, 1]}
    modes: {frame: tangent, keep: all, boundary: massless}
    damping: {ratios: [0.01, 0.02]}
  bracket:
    plate:
      link: {triangle: {centers: [[0, 0], [0.09, 0], [0.02, 0.07]], eyes: [{bore: 0.01, outer: 0.024}, {bore: 0.01, outer: 0.024}, {bore: 0.012, outer: 0.026}]}}
      thickness: 0.008
      plane: strain
      element: quadrilateral8-reduced
      size: 3 mm
      hole size: 1 mm
      young: 7e10
      poisson: 0.33
      density: 2700
    points: {foot: {hole: eye 1, coupling: average}, head: {hole: eye 3, angle: 1}}
    modes: {frame: mean axes, craig-bampton: {effective mass: 0.9}}
    damping: {rayleigh: {alpha: 3 1/s, beta: 1e-5}}
    supports: {foot: pinned, outline: y}
  membrane:
    plate: {grid: {corners: [[0, 0], [1, 0], [1, 1], [0, 1]], cells: [4, 2]}, thickness: 1, orthotropic: {young: [1e9, 2e9, 3e9], poisson: [0.2, 0.1, 0.1], shear: 1e9}, density: 1}
    modes: {free: {keep: auto}}
static:
  body: bracket
  loads:
    pull: {force: [0, 1 N], at: head}
    turn: {torque: 1, at: foot}
    edge: {traction: [0, 1], on: outline}
    fit: {pressure: 1, on: eye 2}
    weight: {acceleration: [0, -9.81]}
    spin: {spin: 3000 rpm, about: foot}
joints:
  pin: {revolute: [ground, crank.A], clearance: {radial: c, bearing radius: 1 cm, bearing: crank,
        normal: {flores: {restitution: 0.5, young: 2e11, poisson: 0.3, radii: external,
                          journal: {young: 1 GPa, poisson: 0.2}}},
        friction: {ambrosio: {coefficient: 0.1, v0: 0.001, v1: 0.01, sliding: geometric}}}}
  eye: {revolute: [ground, mast.C], clearance: {radial: c, bearing radius: 1 cm, bearing: mast, normal: {hertz: {stiffness: 1e9}}}}
  rod: {distance: [ground, crank], length: 1}
  track: {slot: [ground, crank]}
contacts:
  roll: {between: [crank.pin, ground.floor], normal: {hunt-crossley: {restitution: 0.5, stiffness: 1e9, exponent: 2, slowest impact: 1e-3}},
         friction: {ambrosio: {coefficient: 0.1, v0: 0.001, v1: 0.01}}}
  turn: {between: [crank.pin, ground.socket], normal: {hertz: {young: 2e11, poisson: 0.3, second: {young: 1 GPa, poisson: 0.2}}}}
  stop: {between: [crank.cam, ground.floor], normal: {spring-damper: {stiffness: 1e5 N/m, damping: 15}}}
  seat: {between: [crank.pin, ground.socket], normal: {johnson: {length: 20 mm, young: 2e11, poisson: 0.3, hysteresis: flores, restitution: 0.7}}}
  pad: {between: [crank.pin, ground.floor], normal: {table: {points: [[0, 0], [1 um, 50 N], [5 um, 400 N]], restitution: 0.5}}}
drivers: {motor: {angle: [ground, crank], law: 3*t}, jack: {distance: [ground, crank], law: 1 + t}}
forces:
  load: {force: [0, 1 N], at: crank.A, follows: true}
  brake: {torque: 3, on: crank, from: ground}
  coil: {spring: [ground, crank], stiffness: 10, free length: 0}
  pot: {spring: [ground, crank], damping: 10}
  hair: {torsion spring: [ground, crank], stiffness: 10, free angle: 1}
start: {crank: {at: [0, 0], vx: 1, speed: 2}, pin: {eccentricity: [0, 0], speed: [0, 1]}}
run: {until: 1, method: dopri5, constraints: partitioning, onset: {cut: 1 nm}, max steps: 10}
output: {every: 0.1, frames: 3, exaggerate: 2, deformation: auto, points: [crank.A, ground.C, rod], stress: [rod.A]}
assemblies:
  cell:
    parameters: {w: 1 mm}
    ports: [on]
    bodies: {box: {rigid: {mass: 1, inertia: 1}, points: {A: {world: [w, 0], angle: 1}}, colour: teal}}
    joints: {hold: {revolute: [on, box.A]}}
instances: {cell: {of: cell, repeat: 2, at: [index*1 m, 0], angle: 0.5, mirror: y, with: {w: 2 mm}, ports: {on: ground.C}}}
)";

}  // namespace pintle::scene_schema_test
