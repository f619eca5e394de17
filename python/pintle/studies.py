"""Studies: many runs, as a study file asks for them."""

import csv
import io
import json
import os
import tempfile
from contextlib import contextmanager
from pathlib import Path

import numpy

from . import _core
from .scene import Scene, overrides
from .tables import Table, split


def _threads(threads):
    return threads or os.cpu_count() or 1


def _table(text):
    """Columns of numbers as a Table, those of words by name; empty fields are NaN."""
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
def _folder(out):
    if out is not None:
        yield Path(out)
        return
    with tempfile.TemporaryDirectory() as place:
        yield Path(place) / "study"


class SweepResult(Table):
    """A row for each case; columns are what was varied and what was measured."""

    def __init__(self, text, info):
        table, self.words = _table(text)
        super().__init__([f"{n} [{table.unit(n)}]" if table.unit(n) else n for n in table.names], table.data)
        self.info = json.loads(info)


class FitResult(Table):
    """A row for each case that was tried."""

    def __init__(self, text, info, met, file, best, point, measures):
        table, self.words = _table(text)
        super().__init__([f"{n} [{table.unit(n)}]" if table.unit(n) else n for n in table.names], table.data)
        self.info = json.loads(info)
        self.met = met
        self.point = {split(name)[0]: value for name, value in point}
        self.measures = {split(name)[0]: value for name, value in measures}
        self.scene = None if file is None else Scene(_core.Scene.of_file(file, best))


def sweep(study, out=None, set=None, threads=None):
    """Runs the cases of a study. `out`: the folder that it leaves its files in, and goes on from; without it nothing is kept."""
    with _folder(out) as folder:
        return SweepResult(*_core.sweep(os.fspath(study), str(folder), overrides(set), _threads(threads)))


def fit(study, out=None, set=None, threads=None):
    """Finds parameters that reach a study's goal; `scene` of the result is the scene with them, None if no point was found."""
    with _folder(out) as folder:
        return FitResult(*_core.fit(os.fspath(study), str(folder), overrides(set), _threads(threads)))
