"""Studies: the many runs of a study file."""

import json
import os
import tempfile
from contextlib import contextmanager
from pathlib import Path

from . import _core
from .errors import SceneError
from .results import warn
from .scene import Scene, overrides, plain
from .tables import TextTable, split


def _threads(threads):
    return threads or os.cpu_count() or 1


@contextmanager
def _files(study, out):
    """The study's file, what to call it, and the folder of its results. A dict is written to a file, whose name is not shown; its scene
    is relative to the current folder."""
    with tempfile.TemporaryDirectory() as place:
        folder = str(Path(place) / "out" if out is None else out)
        if not isinstance(study, dict):
            yield os.fspath(study), "", folder
            return
        file = Path(place) / "study.yaml"
        scene = {"scene": str(Path(study["scene"]).resolve())} if "scene" in study else {}
        file.write_text(json.dumps({**study, **scene}, default=plain, ensure_ascii=False), encoding="utf-8")
        try:
            yield str(file), "<dict>", folder
        except SceneError as error:
            if error.file != str(file):
                raise
            error.file = error.line = None
            error.args = ("<dict>: " + (f"{error.key}: " if error.key else "") + error.message,)
            raise


class SweepResult(TextTable):
    """A row for each case; columns are the varied parameters and the measures. `warnings`: a table of the cases' warnings, None if there are none."""

    def __init__(self, text, info, warnings):
        super().__init__(text)
        self.info = json.loads(info)
        self.warnings = TextTable(warnings) if warnings else None


class FitResult(TextTable):
    """A row for each case that was computed."""

    def __init__(self, text, info, met, file, best, point, measures, warnings):
        super().__init__(text)
        self.info = json.loads(info)
        self.met = met
        self.warnings = warnings
        self.point = {split(name)[0]: value for name, value in point}
        self.measures = {split(name)[0]: value for name, value in measures}
        self.scene = None if file is None else Scene(_core.Scene.of_file(file, best))


class SensitivityResult(TextTable):
    """A row for each measure and parameter; `cases` is the table of what was run."""

    def __init__(self, text, info, cases, warning):
        super().__init__(text)
        self.info = json.loads(info)
        self.cases = TextTable(cases)
        self.warning = warning

    @property
    def derivatives(self):
        """{measure: {parameter: derivative}}, in SI."""
        out = {}
        for measure, parameter, value in zip(self.words["measure"], self.words["parameter"], self["derivative"]):
            out.setdefault(split(measure)[0], {})[split(parameter)[0]] = float(value)
        return out


class NonlinearResult(TextTable):
    """A row for each value of the parameter, or each start. Tables of the returns, of periodic orbits, of attractors and of Lyapunov
    exponents, None where the study does not ask for them."""

    def __init__(self, text, info, section, orbits, attractors, lyapunov):
        super().__init__(text)
        self.info = json.loads(info)
        tables = (None if t is None else TextTable(t) for t in (section, orbits, attractors, lyapunov))
        self.section, self.orbits, self.attractors, self.lyapunov = tables


class TradeoffResult(TextTable):
    """A row for each setting, the unchanged scene first; `scene` is the scene with the recommended one, None if none is recommended."""

    def __init__(self, text, info, report, file, recommended):
        super().__init__(text)
        self.info = json.loads(info)
        self.report = report
        self.recommended = self.info["recommended"]
        self.scene = None if recommended is None else Scene(_core.Scene.of_file(file, recommended))

    def __repr__(self):
        return self.report.rstrip()


def sweep(study, out=None, set=None, threads=None):
    """Runs the cases of a study, given as a file or a dict of its content. `out`: the folder of its files, from which it continues; without it nothing is kept."""
    with _files(study, out) as (file, name, folder):
        *tables, doubts = _core.sweep(file, name, folder, overrides(set), _threads(threads))
    warn([doubts] if doubts else [])
    return SweepResult(*tables)


def fit(study, out=None, set=None, threads=None):
    """Finds parameters that reach the goal of a study, given as a file or a dict; `scene` of the result is the scene with them, or None if none were found."""
    with _files(study, out) as (file, name, folder):
        result = FitResult(*_core.fit(file, name, folder, overrides(set), _threads(threads)))
    warn([f"the best case: {doubt}" for doubt in result.warnings])
    return result


def sensitivity(study, out=None, set=None, threads=None):
    """Finds how measures depend on parameters and their tolerances, as a study, a file or a dict, asks for it. `out` as of `sweep`."""
    with _files(study, out) as (file, name, folder):
        result = SensitivityResult(*_core.sensitivity(file, name, folder, overrides(set), _threads(threads)))
    warn([result.warning] if result.warning else [])
    return result


def nonlinear(study, out=None, set=None, threads=None):
    """Finds Poincaré sections, periodic orbits, basins of attraction and Lyapunov exponents, as a study, a file or a dict, asks for them. `out` as of `sweep`."""
    with _files(study, out) as (file, name, folder):
        return NonlinearResult(*_core.nonlinear(file, name, folder, overrides(set), _threads(threads)))


def _asked(value, unit=""):
    return "" if value is None else value if isinstance(value, str) else f"{value!r}{unit}"


def tradeoff(study, quantities=(), error=None, time=None, budget=None, repeats=None, out=None, set=None):
    """Measures error against time over settings of fidelity, and recommends one.

    `study`: a study, a file or a dict, or a scene file with the `quantities` that matter. `error`: the one that is wanted, 0.01 or "1%";
    `time`, of a run, and `budget`, of all of them: [s] or "10 min"; `repeats`: timed runs of each setting. `out`: a new folder for the files of `pintle tradeoff`."""
    if out is not None and Path(out).exists():
        raise FileExistsError(f"{out} already exists; name another folder, or remove it")
    with _files(study, out) as (file, _, folder):
        names = [quantities] if isinstance(quantities, str) else list(quantities)
        wishes = names, _asked(error), _asked(time, " s"), _asked(budget, " s"), repeats or 0
        return TradeoffResult(*_core.tradeoff(file, None if out is None else folder, overrides(set), *wishes))
