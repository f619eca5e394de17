"""An arm held level by a controller written in Python, once a millisecond. Expect 5.886 N m at the end: 2 kg at 0.3 m under gravity."""

import pintle

scene = pintle.parse("""
gravity: [0, -9.81 m/s^2]
bodies: {arm: {rigid: {mass: 2 kg, inertia: 0.06 kg m^2, center: [0.3 m, 0]}, points: {O: [0, 0]}}}
joints: {pivot: {revolute: [ground, arm.O]}}
states: {torque: {rate: 0 N m/s, start: 0 N m}}     # an input: it changes only where Python sets it
forces: {servo: {torque: torque, on: arm}}
start: {arm: {angle: -90 deg}}
run: {until: 4 s}
""")

step, integral = 1e-3, 0.0
simulation = scene.simulation()
going = True
while going:
    error = 0 - simulation["arm.angle"]
    integral += error * step
    simulation["torque"] = 40 * error + 60 * integral - 6 * simulation["arm.speed"]
    going = simulation.advance(simulation.t + step)

result = simulation.result()
print(f"angle {result['arm.angle'][-1]:.6f} rad, torque {result['torque'][-1]:.3f} N m at {result.t[-1]:.3f} s")
print(f"work of the servo {result.ledger['servo.work in'][-1]:.3f} J, unexplained {result.unexplained:.1e} J")
