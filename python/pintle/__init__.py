"""Planar mechanisms with real joints and flexible links.

>>> import pintle
>>> scene = pintle.parse({
...     "gravity": [0, "-9.81 m/s^2"],
...     "bodies": {"rod": {"rigid": {"mass": "1 kg", "inertia": 0.1}, "points": {"O": [-1, 0]}}},
...     "joints": {"hinge": {"revolute": ["ground", "rod.O"]}},
...     "start": {"rod": {"angle": "0 deg"}},
...     "run": {"until": "0.1 s", "tolerance": 1e-10},
... })
>>> result = scene.run()
>>> print(f'{result["rod.angle"][-1]:.4f} {result.unit("rod.angle")}')
-0.0446 rad
"""

from ._core import version as __version__
from .errors import AssemblyError, Error, ModelWarning, RunError, SceneError
from .results import BodyModes, Effort, Event, Impact, InverseResult, LinearMode, Modes, Rest, Result, Simulation, SmallMotion
from .scene import Scene, load, parse, trust
from .studies import FitResult, SweepResult, fit, sweep
from .tables import Table

__all__ = [
    "AssemblyError", "BodyModes", "Effort", "Error", "Event", "FitResult", "Impact", "InverseResult", "LinearMode", "ModelWarning",
    "Modes", "Rest", "Result", "RunError", "Scene", "SceneError", "Simulation", "SmallMotion", "SweepResult", "Table", "fit", "load",
    "parse", "sweep", "trust",
]
