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

class Simulation:
    @property
    def t(self) -> float: ...
    @property
    def names(self) -> list[str]: ...
    def unit(self, name: str) -> str: ...
    def advance(self, t: float) -> bool: ...
    def __getitem__(self, name: str) -> float: ...
    def __setitem__(self, name: str, value: float) -> None: ...
    def result(self) -> Result: ...

class Scene:
    @property
    def title(self) -> str: ...
    @property
    def parameters(self) -> dict[str, float]: ...
    def as_dict(self) -> dict[str, Any]: ...
    def set(self, values: Values) -> Scene: ...
    def with_law(self, name: str, function: Callable[..., Any], of: Sequence[str]) -> Scene: ...
    def check(self) -> dict[str, Any]: ...
    def run(self, check: bool = True) -> Result: ...
    def kinematics(self, check: bool = True) -> Result: ...
    def inverse(self, check: bool = True) -> InverseResult: ...
    def statics(self, at: float = 0.0) -> Rest: ...
    def linearize(self, at: float | None = None, at_rest: bool = False) -> SmallMotion: ...
    def modes(self, body: str = "", count: int = 6) -> Modes: ...
    def simulation(self) -> Simulation: ...

class SweepResult(Table):
    words: dict[str, list[str]]
    info: dict[str, Any]
    def __init__(self, text: str, info: str) -> None: ...

class FitResult(Table):
    words: dict[str, list[str]]
    info: dict[str, Any]
    met: bool
    best: dict[str, str]
    point: dict[str, float]
    measures: dict[str, float]
    scene: Scene | None

def load(file: Path, set: Values | None = None) -> Scene: ...
def parse(scene: str | Values, set: Values | None = None, folder: Path = ".") -> Scene: ...
def sweep(study: Path, out: Path | None = None, set: Values | None = None, threads: int | None = None) -> SweepResult: ...
def fit(study: Path, out: Path | None = None, set: Values | None = None, threads: int | None = None) -> FitResult: ...
