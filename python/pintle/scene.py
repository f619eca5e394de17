"""Scenes and their analyses."""

import json
import os

from . import _core
from .errors import Error, RunError
from .results import InverseResult, Mesh, Modes, Rest, Result, Simulation, SmallMotion, StaticCase, checked, facts, warn


def plain(value):
    """Converts NumPy values to those of JSON."""
    for convert in ("tolist", "__fspath__"):
        if hasattr(value, convert):
            return getattr(value, convert)()
    raise TypeError(f"{value!r} cannot stand in a scene")


def overrides(values):
    """{name: value} as pairs of strings."""
    texts = {}
    for name, value in (values or {}).items():
        texts[name] = value if isinstance(value, str) else json.dumps(value, default=plain, ensure_ascii=False)
    return list(texts.items())


class Scene:
    """A scene. It is immutable: `set` and `with_law` return a new one."""

    def __init__(self, core):
        self._core = core

    @property
    def title(self):
        return self._core.title

    @property
    def parameters(self):
        """Values by name, in SI units."""
        return dict(self._core.parameters)

    def as_dict(self):
        """The scene as it was read, with every default."""
        return json.loads(self._core.filled_in)

    def set(self, values):
        """The scene with parameters, or any keys by their paths, changed: {"clearance": "0.1 mm", "run.tolerance": 1e-6}."""
        return Scene(self._core.set(overrides(values)))

    def with_law(self, name, function, of):
        """The scene with the law of a force, a state or an output given by a Python function.

        `of` names its arguments, signals and "t", all in SI units. A force returns its x and y components. Implicit methods, `statics` and
        `linearize` find its derivatives by differences."""
        if not callable(function):
            raise TypeError(f"the law of {name!r} must be a function, not {function!r}")
        return Scene(self._core.with_law(name, function, [of] if isinstance(of, str) else list(of)))

    def check(self):
        """The output of `pintle check --json`."""
        return json.loads(self._core.check())

    def run(self, check=True):
        """Runs the scene. `check`: a failed run raises RunError, whose `result` has what was computed."""
        return checked(_found(Result, _core.run, self._core), check)

    def kinematics(self, check=True):
        """Kinematics: the motion that drivers prescribe."""
        return checked(_found(Result, _core.kinematics, self._core), check)

    def inverse(self, check=True):
        """Inverse dynamics: the efforts of drivers and the forces in joints."""
        return checked(_found(InverseResult, _core.inverse, self._core), check)

    def statics(self, at=0.0):
        """Static equilibrium, with drivers and loads as at the time `at` [s]."""
        core = _core.statics(self._core, at)
        if not core.found:
            raise RunError(f"no equilibrium: {core.reason}")
        warn(core.warnings)
        return Rest(core)

    def linearize(self, at=None, at_rest=False):
        """Linearisation about the start, about the run's state at a time [s], or about the static equilibrium."""
        try:
            core = _core.linearize(self._core, at, at_rest)
        except RuntimeError as error:
            raise RunError(str(error)) from None
        if core.trouble:
            raise RunError(core.trouble)
        warn(core.warnings)
        return SmallMotion(core)

    def modes(self, body="", count=6):
        """Natural modes of one body of elements; the name may be omitted if there is only one."""
        return Modes(_core.modes(self._core, body, count))

    def static(self, body=""):
        """The static load case of one body of elements, or of several in contact. Of a whole mechanism: `statics`."""
        case = StaticCase(_core.static_case(self._core, body))
        warn(case.warnings)
        return case

    def mesh(self, body=""):
        """The mesh of one body of elements; its name may be left out where there is one alone."""
        mesh = Mesh(_core.mesh(self._core, body))
        warn(mesh.warnings)
        return mesh

    def simulation(self):
        """A run step by step."""
        return Simulation(_core.Simulation(self._core))

    def __repr__(self):
        return f"<scene {self.title or self._core.name}>"

    def _repr_html_(self):
        said = self.as_dict()
        rows = [(section, ", ".join(said[section])) for section in ("bodies", "joints", "drivers", "forces", "contacts", "events") if said.get(section)]
        try:
            rows.append(("degrees of freedom", str(json.loads(self._core.assembled())["model"]["mobility"])))
        except Error as error:
            rows.append(("degrees of freedom", f"unknown: {error}"))
        return facts(self.title or self._core.name, rows)


def _found(kind, analyse, core):
    """Runs an analysis. If Ctrl-C or a signal handler stops it, the exception's `result` is what was computed."""
    try:
        return kind(analyse(core))
    except BaseException as stop:
        if hasattr(stop, "result"):
            stop.result = kind(stop.result)
        raise


def load(file, set=None):
    """Reads a scene file. `set`: {name: value} of parameters, or of any keys by their paths."""
    return Scene(_core.Scene.of_file(os.fspath(file), overrides(set)))


def parse(scene, set=None, folder="."):
    """Reads a scene from YAML text, or from a dict with the content of a scene file; its file names are relative to `folder`."""
    if isinstance(scene, str):
        return Scene(_core.Scene.of_text(scene, "scene", os.fspath(folder), overrides(set)))
    text = json.dumps(scene, default=plain, ensure_ascii=False, indent=1)
    return Scene(_core.Scene.of_text(text, "<dict>", os.fspath(folder), overrides(set)))


def trust(folders=(), geo=False):
    """Allows scenes to read files in these folders besides their own and, with `geo`, drawings to run all their commands,
    shell commands included (SECURITY.md)."""
    one = isinstance(folders, (str, os.PathLike))
    _core.trust([os.fspath(folder) for folder in ([folders] if one else folders)], geo)
