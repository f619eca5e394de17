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
from .mechanism import Element, Mechanism
from .results import (
    BodyCase, BodyModes, Effort, Event, Impact, InverseResult, LinearMode, Mesh, Modes, Page, Rest, Result, Simulation, SmallMotion, StaticCase
)
from .scene import Scene, load, parse, trust
from .studies import (
    FitResult, NonlinearResult, SensitivityResult, SweepResult, TradeoffResult, fit, nonlinear, sensitivity, sweep, tradeoff
)
from .tables import Table, TextTable

__all__ = [
    "AssemblyError", "BodyCase", "BodyModes", "Effort", "Element", "Error", "Event", "FitResult", "Impact", "InverseResult", "LinearMode", "Mechanism", "Mesh",
    "ModelWarning", "Modes", "NonlinearResult", "Page", "Rest", "Result", "RunError", "Scene", "SceneError", "SensitivityResult", "Simulation",
    "SmallMotion", "StaticCase", "SweepResult", "Table", "TextTable", "TradeoffResult", "fit", "load", "nonlinear", "parse", "sensitivity",
    "sweep", "tradeoff", "trust",
]
