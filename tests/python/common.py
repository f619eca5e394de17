"""What the tests share: where examples and the program are, and a pendulum."""

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
