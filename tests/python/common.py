"""What the tests share: where examples and the program are, a pendulum, and an arm with a torque to be set."""

import os
from pathlib import Path

root = Path(__file__).resolve().parents[2]
examples = root / "examples"
program = os.environ.get("PINTLE_PROGRAM")

pendulum = """
gravity: [0, -9.81]
bodies: {rod: {rigid: {mass: 1 kg, inertia: 0.1}, points: {O: [-1, 0]}}}
joints: {hinge: {revolute: [ground, rod.O]}}
start: {rod: {angle: 0 deg}}
run: {until: 0.1 s, tolerance: 1e-10}
"""

servo_arm = """
gravity: [0, -9.81 m/s^2]
bodies: {arm: {rigid: {mass: 2 kg, inertia: 0.06 kg m^2, center: [0.3 m, 0]}, points: {O: [0, 0]}}}
joints: {pivot: {revolute: [ground, arm.O]}}
states: {torque: {rate: 0 N m/s, start: 0 N m}}
forces: {servo: {torque: torque, on: arm}}
start: {arm: {angle: -90 deg}}
"""  # without its run
