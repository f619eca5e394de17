"""Studies: the many runs of a study file."""

import csv
import io
import json
import os
import tempfile
from contextlib import contextmanager
from pathlib import Path

import numpy

from . import _core
from .scene import Scene, overrides, plain
from .tables import Table, split


def _threads(threads):
    return threads or os.cpu_count() or 1


def _table(text):
    """Columns of numbers as a Table, columns of text by name; empty fields are NaN."""
    header, *rows = csv.reader(io.StringIO(text))
    numbers, words = {}, {}
    for heading, column in zip(header, zip(*rows) if rows else [()] * len(header)):
        try:
            numbers[heading] = [float(x) if x else numpy.nan for x in column]
        except ValueError:
            words[split(heading)[0]] = list(column)
    data = numpy.array(list(numbers.values())).T.reshape(len(rows), len(numbers))
    return Table(list(numbers), data), words


@contextmanager
def _files(study, out):
    """The study's file and the folder of its results. A dict is written to a file; its scene is relative to the current folder."""
    with tempfile.TemporaryDirectory() as place:
        if isinstance(study, dict):
            file = Path(place) / "study.yaml"
            scene = {"scene": str(Path(study["scene"]).resolve())} if "scene" in study else {}
            file.write_text(json.dumps({**study, **scene}, default=plain, ensure_ascii=False), encoding="utf-8")
        else:
            file = study
        yield os.fspath(file), str(Path(place) / "out" if out is None else out)


class SweepResult(Table):
    """A row for each case; columns are the varied parameters and the measures."""

    def __init__(self, text, info):
        table, self.words = _table(text)
        super().__init__([f"{n} [{table.unit(n)}]" if table.unit(n) else n for n in table.names], table.data)
        self.info = json.loads(info)


class FitResult(Table):
    """A row for each case that was computed."""

    def __init__(self, text, info, met, file, best, point, measures):
        table, self.words = _table(text)
        super().__init__([f"{n} [{table.unit(n)}]" if table.unit(n) else n for n in table.names], table.data)
        self.info = json.loads(info)
        self.met = met
        self.point = {split(name)[0]: value for name, value in point}
        self.measures = {split(name)[0]: value for name, value in measures}
        self.scene = None if file is None else Scene(_core.Scene.of_file(file, best))


def sweep(study, out=None, set=None, threads=None):
    """Runs the cases of a study, given as a file or a dict of its content. `out`: the folder of its files, from which it continues; without it nothing is kept."""
    with _files(study, out) as (file, folder):
        return SweepResult(*_core.sweep(file, folder, overrides(set), _threads(threads)))


def fit(study, out=None, set=None, threads=None):
    """Finds parameters that reach the goal of a study, given as a file or a dict; `scene` of the result is the scene with them, or None if none were found."""
    with _files(study, out) as (file, folder):
        return FitResult(*_core.fit(file, folder, overrides(set), _threads(threads)))
