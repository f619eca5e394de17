"""A gudgeon pin that wears: how hard it knocks, by its clearance. Expect a peak force of 2241 N at 0.01 mm, 5124 N at 0.1 mm."""

from pathlib import Path

import pintle

scene = pintle.load(Path(__file__).parents[1] / "slider_crank_clearance.yaml")
for clearance in ("0.01 mm", "0.1 mm"):
    result = scene.set({"clearance": clearance}).run()
    peak = max(impact.peak_force for impact in result.impacts)
    lost = result.ledger["gudgeon pin.lost to hysteresis"][-1]
    print(f"{clearance}: {len(result.impacts)} contacts, peak {peak:.0f} N, {1e3 * lost:.2f} mJ lost")

force = result["gudgeon pin.normal"]  # a NumPy array, in the memory of the run
print(f"the pin is free in {100 * (force == 0).mean():.0f} % of the rows of {result.t[-1]} s")
