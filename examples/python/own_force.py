"""A pendulum in a wind that Python blows: a force as a function of signals. Expect that it comes to rest at 0.1972 rad from hanging,
where the drag of a wind of 4 m/s, 0.125 N s^2/m^2 v^2 = 2 N, balances its weight: tan = 2 N/(1.0204 kg 9.81 m/s^2)."""

import math

import pintle

scene = pintle.parse("""
gravity: [0, -9.81 m/s^2]
bodies: {bob: {rigid: {mass: 1.0204 kg, inertia: 1e-3 kg m^2}, points: {top: [0, 1 m], C: [0, 0]}}}
joints: {hook: {revolute: [ground, bob.top]}}
forces: {wind: {force: [0 N, 0 N], at: bob.C}}
run: {until: 120 s, tolerance: 1e-9}
output: {every: 0.1 s}
""")


def wind(t, vx, vy):
    x, y = 4 - vx, -vy
    drag = 0.125 * math.hypot(x, y)
    return drag * x, drag * y


result = scene.with_law("wind", wind, of=["t", "bob.C.vx", "bob.C.vy"]).run()
print(f"at rest at {result['bob.angle'][-1]:.4f} rad for {math.atan(2 / (1.0204 * 9.81)):.4f}, blown in {result.ledger['wind.work in'][-1]:.3f} J")
