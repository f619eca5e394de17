from collections.abc import Callable, Iterator, Sequence
from os import PathLike
from typing import Any, NamedTuple

import numpy
import numpy.typing

Array = numpy.typing.NDArray[numpy.float64]
Path = str | PathLike[str]
Values = dict[str, Any]

__version__: str

class Error(Exception): ...

class SceneError(Error, ValueError):
    file: str | None
    line: int | None
    key: str | None
    message: str

class AssemblyError(Error):
    file: str | None
    line: int | None
    key: str | None
    message: str

class RunError(Error):
    result: Result | None
    def __init__(self, message: str, result: Result | None = None) -> None: ...

class ModelWarning(UserWarning): ...

class Table:
    data: Array
    def __init__(self, headings: Sequence[str], data: Array) -> None: ...
    @property
    def names(self) -> list[str]: ...
    def unit(self, name: str) -> str: ...
    def __getitem__(self, name: str) -> Array: ...
    def __contains__(self, name: object) -> bool: ...
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[str]: ...
    def keys(self) -> list[str]: ...
    def frame(self) -> Any: ...
    def plot(self, *names: str, against: str | None = None, axes: Any = None) -> Any: ...

class TextTable(Table):
    words: dict[str, list[str]]
    def __init__(self, text: str) -> None: ...
    def frame(self) -> Any: ...

class Impact(NamedTuple):
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
    event: str
    t: float
    did: str

class Result(Table):
    def __init__(self, core: Any) -> None: ...
    @property
    def t(self) -> Array: ...
    @property
    def ledger(self) -> Table: ...
    @property
    def impacts(self) -> list[Impact]: ...
    @property
    def events(self) -> list[Event]: ...
    @property
    def status(self) -> str: ...
    @property
    def reason(self) -> str: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def steps(self) -> int: ...
    @property
    def unexplained(self) -> float: ...
    @property
    def info(self) -> dict[str, Any]: ...
    def write(self, directory: Path) -> None: ...
    def report(self, file: Path) -> None: ...

class Effort(NamedTuple):
    driver: str
    unit: str
    t: Array
    value: Array
    error: float

class InverseResult(Result):
    how: str
    efforts: dict[str, Effort]
    @property
    def info(self) -> dict[str, Any]: ...

class Rest(Table):
    def __init__(self, core: Any) -> None: ...
    def __getitem__(self, name: str) -> float: ...  # type: ignore[override]
    @property
    def stable(self) -> bool | None: ...
    @property
    def unstable(self) -> int: ...
    @property
    def neutral(self) -> int: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def info(self) -> dict[str, Any]: ...

class LinearMode(NamedTuple):
    kind: str
    frequency: float
    natural: float
    damping: float
    root: complex
    carrier: str
    share: float
    shape: numpy.typing.NDArray[numpy.complex128]

class SmallMotion:
    A: Array
    B: Array
    C: Array
    D: Array
    states: list[str]
    inputs: list[str]
    outputs: list[str]
    coordinates: list[str]
    modes: list[LinearMode]
    t: float
    notes: list[str]
    warnings: list[str]
    @property
    def info(self) -> dict[str, Any]: ...

class BodyModes(NamedTuple):
    title: str
    frequencies: Array
    damping: Array
    mass: Array
    shapes: Array

class Modes:
    body: str
    rigid: int
    mass: float
    natural: BodyModes
    reduced: BodyModes | None
    @property
    def frequencies(self) -> Array: ...

class BodyCase(Table):
    body: str
    points: TextTable
    section_forces: TextTable | None
    def __init__(self, name: str, table: Any, points: str, section_forces: str | None) -> None: ...

class StaticCase:
    bodies: dict[str, BodyCase]
    contacts: TextTable | None
    warnings: list[str]
    def __getitem__(self, body: str) -> BodyCase: ...
    @property
    def info(self) -> dict[str, Any]: ...

class Mesh:
    body: str
    nodes: Array
    cells: dict[str, numpy.typing.NDArray[numpy.int32]]
    groups: dict[str, numpy.typing.NDArray[numpy.int32]]
    warnings: list[str]
    @property
    def info(self) -> dict[str, Any]: ...

class Simulation:
    @property
    def t(self) -> float: ...
    @property
    def names(self) -> list[str]: ...
    def unit(self, name: str) -> str: ...
    def advance(self, t: float) -> bool: ...
    def __getitem__(self, name: str) -> float: ...
    def __setitem__(self, name: str, value: float) -> None: ...
    def result(self, check: bool = True) -> Result: ...

class Scene:
    @property
    def title(self) -> str: ...
    @property
    def parameters(self) -> dict[str, float]: ...
    def as_dict(self) -> dict[str, Any]: ...
    def set(self, values: Values) -> Scene: ...
    def with_law(self, name: str, function: Callable[..., Any], of: str | Sequence[str]) -> Scene: ...
    def check(self) -> dict[str, Any]: ...
    def run(self, check: bool = True) -> Result: ...
    def kinematics(self, check: bool = True) -> Result: ...
    def inverse(self, check: bool = True) -> InverseResult: ...
    def statics(self, at: float = 0.0) -> Rest: ...
    def linearize(self, at: float | None = None, at_rest: bool = False) -> SmallMotion: ...
    def modes(self, body: str = "", count: int = 6) -> Modes: ...
    def static(self, body: str = "") -> StaticCase: ...
    def mesh(self, body: str = "") -> Mesh: ...
    def simulation(self) -> Simulation: ...

class SweepResult(TextTable):
    info: dict[str, Any]
    warnings: TextTable | None
    def __init__(self, text: str, info: str, warnings: str) -> None: ...

class FitResult(TextTable):
    info: dict[str, Any]
    met: bool
    warnings: list[str]
    point: dict[str, float]
    measures: dict[str, float]
    scene: Scene | None

class SensitivityResult(TextTable):
    info: dict[str, Any]
    cases: TextTable
    warning: str
    @property
    def derivatives(self) -> dict[str, dict[str, float]]: ...

class NonlinearResult(TextTable):
    info: dict[str, Any]
    section: TextTable | None
    orbits: TextTable | None
    lyapunov: TextTable | None

class TradeoffResult(TextTable):
    info: dict[str, Any]
    told: str
    recommended: int | None
    scene: Scene | None

def load(file: Path, set: Values | None = None) -> Scene: ...
def parse(scene: str | Values, set: Values | None = None, folder: Path = ".") -> Scene: ...
def sweep(study: Path | Values, out: Path | None = None, set: Values | None = None, threads: int | None = None) -> SweepResult: ...
def fit(study: Path | Values, out: Path | None = None, set: Values | None = None, threads: int | None = None) -> FitResult: ...
def sensitivity(study: Path | Values, out: Path | None = None, set: Values | None = None, threads: int | None = None) -> SensitivityResult: ...
def nonlinear(study: Path | Values, out: Path | None = None, set: Values | None = None, threads: int | None = None) -> NonlinearResult: ...
def tradeoff(
    study: Path | Values,
    quantities: str | Sequence[str] = (),
    error: float | str | None = None,
    time: float | str | None = None,
    budget: float | str | None = None,
    repeats: int | None = None,
    out: Path | None = None,
    set: Values | None = None,
) -> TradeoffResult: ...
def trust(folders: Path | Sequence[Path] = (), geo: bool = False) -> None: ...
