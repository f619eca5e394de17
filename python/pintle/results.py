"""Results of the analyses."""

import html
import json
import math
import tempfile
import warnings
from pathlib import Path
from typing import NamedTuple

from . import _core
from .errors import ModelWarning, RunError
from .tables import Headed, Table, TextTable


class Impact(NamedTuple):
    """One contact from its beginning to its end; NaN if it has not ended. SI units."""

    contact: str
    begin: float
    end: float
    approach: float
    separation: float
    deepest: float
    peak_force: float
    lost: float
    impulse: float


class Event(NamedTuple):
    """An occurrence of an event of the scene."""

    event: str
    t: float
    did: str


class Page:
    """A page that a notebook shows in a frame of its own."""

    def __init__(self, text, height):
        self.text, self.height = text, height

    def _repr_html_(self):
        return f'<iframe srcdoc="{html.escape(self.text)}" style="width: 100%; height: {self.height}px; border: 0"></iframe>'


def facts(title, rows):
    """A table of names and texts for a notebook."""
    lines = "".join(f"<tr><td>{html.escape(name)}</td><td>{html.escape(text)}</td></tr>" for name, text in rows)
    return f"<table><caption>{html.escape(title)}</caption>{lines}</table>"


class Result(Table):
    """Result of a run: `result["crank.angle"]` is a column of its trajectory."""

    def __init__(self, core):
        super().__init__(*core.trajectory)
        self._core = core

    @property
    def t(self):
        return self.data[:, 0]

    @property
    def ledger(self):
        """Table of the stored energies and of the energy supplied and lost."""
        return Table(*self._core.ledger)

    @property
    def impacts(self):
        return [Impact(*one) for one in self._core.impacts]

    @property
    def events(self):
        return [Event(*one) for one in self._core.events]

    @property
    def status(self):
        return self._core.status

    @property
    def reason(self):
        return self._core.reason

    @property
    def warnings(self):
        return self._core.warnings

    @property
    def steps(self):
        return self._core.steps

    @property
    def unexplained(self):
        """Unexplained energy of the ledger at the end [J]."""
        return self._core.unexplained

    @property
    def info(self):
        """The content of run.json, or of the JSON file of another analysis."""
        return json.loads(self._core.info)

    def write(self, directory):
        """Writes the files of `pintle run`, or of another analysis, into a new folder."""
        if Path(directory).exists():
            raise FileExistsError(f"{directory} already exists; name another folder, or remove it")
        self._write(str(directory))

    def _write(self, directory):
        self._core.write(directory)

    def report(self, file):
        """Writes one HTML page: motion, plots, impacts, ledger."""
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place) / "run"
            self.write(folder)
            Path(file).write_text(_core.report(str(folder)), encoding="utf-8")

    def view(self, height=720):
        """The page of `report`, shown where a notebook shows results."""
        with tempfile.TemporaryDirectory() as place:
            page = Path(place) / "page.html"
            self.report(page)
            return Page(page.read_text(encoding="utf-8"), height)

    def _rows(self):
        core = self._core
        share = abs(core.unexplained) / core.energy_in_play if core.energy_in_play > 0 else 0
        yield "status", core.status + (f": {core.reason}" if core.reason else "")
        yield "time reached", f"{core.end:.6g} s, {len(self)} rows, {core.steps} steps"
        if len(self.ledger):
            yield "unexplained energy", f"{core.unexplained:.3g} J, {share:.3g} of the energy in play"
        if core.impacts:
            yield "contacts", f"{len(core.impacts)}, peak force {max(i.peak_force for i in self.impacts):.4g} N"
        for warning in core.warnings:
            yield "warning", warning

    def __repr__(self):
        return "\n".join([self._core.title or "run"] + [f"  {name:<20}{text}" for name, text in self._rows()])

    def _repr_html_(self):
        return facts(self._core.title or "run", self._rows())


def warn(texts, level=3):
    """Issues a warning at the code that called the caller; `level` is the stack level of `warnings.warn`."""
    for text in texts:
        warnings.warn(text, ModelWarning, stacklevel=level)


def checked(result, check):
    """Raises RunError if the run failed; issues its warnings."""
    if check and result.status in ("failed", "out of memory"):
        raise RunError(f"{result.status}: {result.reason}", result)
    warn(([result.reason] if result.status == "ledger over its bound" else []) + result.warnings, 4)
    return result


class Effort(NamedTuple):
    """Effort of a driver over time: its torque or force."""

    driver: str
    unit: str
    t: object
    value: object
    error: float


class InverseResult(Result):
    """A driven motion with the efforts of its drivers."""

    def __init__(self, core):
        super().__init__(core.run)
        self._inverse = core
        self.how = core.how
        self.efforts = {effort.driver: effort for effort in (Effort(*one) for one in core.efforts)}

    @property
    def info(self):
        """The content of inverse.json."""
        return json.loads(self._inverse.info)

    def _write(self, directory):
        self._inverse.write(directory)


class Rest(Table):
    """Static equilibrium of a mechanism: `rest["spring.length"]` is one number."""

    def __init__(self, core):
        super().__init__(*core.table)
        self._core = core

    def __getitem__(self, name):
        return float(super().__getitem__(name)[0])

    @property
    def stable(self):
        """None if stability was not determined."""
        return core.unstable == 0 and core.neutral == 0 if (core := self._core).judged else None

    @property
    def unstable(self):
        """Number of unstable directions."""
        return self._core.unstable

    @property
    def neutral(self):
        """Number of neutral directions."""
        return self._core.neutral

    @property
    def warnings(self):
        return self._core.warnings

    @property
    def info(self):
        """The content of statics.json."""
        return json.loads(self._core.info)

    def __repr__(self):
        return "at rest: " + self._core.method


class LinearMode(NamedTuple):
    """A solution shape·exp(root t) of the linearised motion."""

    kind: str
    frequency: float  # [Hz]
    natural: float  # |root|/2π [Hz]
    damping: float
    root: complex
    carrier: str
    share: float
    shape: object


class SmallMotion:
    """The linearised motion about a state, x' = A x + B u, y = C x + D u, and its modes."""

    def __init__(self, core):
        self._core = core
        self.A, self.B, self.C, self.D = core.A, core.B, core.C, core.D
        self.states, self.inputs, self.outputs = core.states, core.inputs, core.outputs
        self.coordinates = core.coordinates
        self.modes = [LinearMode(*one) for one in core.modes]
        self.t, self.notes, self.warnings = core.time, core.notes, core.warnings

    @property
    def info(self):
        """The content of linearized.json."""
        return json.loads(self._core.info)

    def __repr__(self):
        return "\n".join(
            [f"{len(self.states)} states, {len(self.inputs)} inputs, {len(self.outputs)} outputs"]
            + [f"  {m.frequency:.9g} Hz, damping {m.damping:.4g}: {m.carrier}" for m in self.modes]
        )


class BodyModes(NamedTuple):
    """Modes of one body: frequencies [Hz], damping ratios, effective masses along x, y and in rotation, nodal shapes."""

    title: str
    frequencies: object
    damping: object
    mass: object
    shapes: object


class Modes:
    """`natural`: modes of the body as it is held; `reduced`: the modes that a mechanism uses, if the body has the key `modes`."""

    def __init__(self, core):
        self.body, self.rigid, self.mass = core.body, core.rigid, core.mass
        self.natural = BodyModes(*core.natural)
        self.reduced = BodyModes(*core.reduced) if core.reduced else None

    @property
    def frequencies(self):
        return self.natural.frequencies

    def __repr__(self):
        return f"{self.body}: " + ", ".join(f"{f:.6g}" for f in self.frequencies) + " Hz"

    def _repr_html_(self):
        n = self.natural
        columns = {"mode": range(1, len(n.frequencies) + 1), "frequency<br>[Hz]": n.frequencies, "damping ratio": n.damping,
                   "effective mass x<br>[kg]": n.mass[0], "effective mass y<br>[kg]": n.mass[1], "effective inertia<br>[kg m²]": n.mass[2]}
        rows = "".join("<tr>" + "".join(f"<td>{x:.6g}</td>" for x in row) + "</tr>" for row in zip(*columns.values()))
        head = "".join(f"<th>{name}</th>" for name in columns)
        return f"<table><caption>{html.escape(f'{self.body}, {n.title}')}</caption><tr>{head}</tr>{rows}</table>"


class BodyCase(Table):
    """A body under its static load: a row for each point of it, with displacement and stresses."""

    def __init__(self, name, table, points, section_forces):
        super().__init__(*table)
        self.body = name
        self.points = TextTable(points)
        self.section_forces = None if section_forces is None else TextTable(section_forces)


class StaticCase:
    """The static case of one body, or of several in contact."""

    def __init__(self, core):
        self._core = core
        self.bodies = {one[0]: BodyCase(*one) for one in core.bodies}
        self.contacts = None if core.contacts is None else TextTable(core.contacts)
        self.warnings = core.warnings

    def __getitem__(self, body):
        return self.bodies[body]

    @property
    def info(self):
        """What static.json holds."""
        return json.loads(self._core.info)

    def __repr__(self):
        return "\n".join(f"{name}: greatest von Mises stress {b['von Mises'].max() * 1e-6:.6g} MPa" for name, b in self.bodies.items())


class Mesh:
    """The mesh of one body: `nodes` [m], the nodes of cells by their shape, and those of groups by name, counted from 0."""

    def __init__(self, core):
        self._core = core
        self.body, self.nodes, self.groups = core.body, core.nodes, core.groups
        self.cells = dict(core.cells)
        self.warnings = core.warnings

    @property
    def info(self):
        """What mesh.json holds."""
        return json.loads(self._core.info)

    def __repr__(self):
        return f"{self.body}: {len(self.nodes)} nodes, " + ", ".join(f"{len(c)} {shape}" for shape, c in self.cells.items())


class Simulation(Headed):
    """A run step by step: advance to a time, read columns, set states of the scene, advance again.

    Set the inputs of a controller as states whose rate is 0."""

    def __init__(self, core):
        super().__init__(core.header)
        self._core = core
        self._states = {name: (place, unit) for place, (name, unit) in enumerate(core.states)}
        self._row = None
        self._over = False

    @property
    def t(self):
        return self._core.time

    def advance(self, t):
        """Advances to time t [s], through all events before it. False if the run has ended. ValueError if t is not later than now."""
        if not t > self.t and not self._over:
            raise ValueError(f"advance to {t} s: it must be after {self.t} s, the present time of the simulation")
        self._row = None
        self._over = not self._core.advance(t)
        return not self._over

    def __getitem__(self, name):
        if self._row is None:
            self._row = self._core.now()
        return self._row[self._columns.place(name)]

    def __setitem__(self, name, value):
        if name not in self._states:
            known = ", ".join(self._states) or "the scene has none"
            raise KeyError(f'"{name}" is not a state of the scene; states: {known}')
        value = float(value)
        if not math.isfinite(value):
            raise ValueError(f'"{name}" cannot be {value}: a state is a finite number')
        self._row = None
        self._core.set(self._states[name][0], value)

    def result(self, check=True):
        """Ends the run and returns its result."""
        return checked(Result(self._core.finish()), check)

    def __repr__(self):
        return f"<simulation at t = {self.t:.6g} s>"
