"""A sweep over clearances and a search, as study files ask for them. Expect 5, 19 and 18 contacts (docs/paper.md)."""

from pathlib import Path

import pintle

studies = Path(__file__).parents[1] / "studies"

sweep = pintle.sweep(studies / "clearance.yaml")
for clearance, contacts, peak in zip(sweep["clearance"], sweep["contacts"], sweep["peak"]):
    print(f"{1e3 * clearance:.2f} mm: {contacts:.0f} contacts, peak force {peak:.0f} N")

fit = pintle.fit(studies / "fit_frequency.yaml")
print("the goal is met:", fit.met, fit.point, fit.measures)
