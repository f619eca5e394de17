"""What may be asked of a mechanism beside a run: its rest, its small motion, its motion by drivers, their torques; modes of a body.

Expect 53.39 deg for the lever, as its file says."""

import math
from pathlib import Path

import pintle

examples = Path(__file__).parents[1]

lever = pintle.load(examples / "statics_lever.yaml").statics()
print(f"a lever at rest at {math.degrees(lever['lever.angle']):.2f} deg, stable: {lever.stable}")

arm = pintle.load(examples / "pid_arm.yaml").linearize(at_rest=True)
print(f"slowest mode of a servo: {arm.modes[0].root.real:.4f} 1/s of {len(arm.states)} states")

quick_return = pintle.load(examples / "kinematics_quick_return.yaml").kinematics()
print("a quick return moves through", len(quick_return), "poses")

four_bar = pintle.load(examples / "inverse_four_bar.yaml").inverse()
for effort in four_bar.efforts.values():
    print(f"{effort.driver}: at most {abs(effort.value).max():.4f} {effort.unit}")

modes = pintle.load(examples / "modes_beam.yaml").modes(count=3)
print("modes of a beam:", ", ".join(f"{f:.4f} Hz" for f in modes.frequencies))
