"""A few runs of PINTLE, the first argument of the script, their pages, and the Chromium that shows them."""

import atexit
import csv
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from chromium import Chromium

pintle = os.path.realpath(sys.argv.pop(1))
if not shutil.which("chromium"):
    sys.exit(print("skipped: there is no chromium; apt-get install chromium") or 77)
source = Path(__file__).resolve().parents[2]
folder = Path(tempfile.mkdtemp())
atexit.register(shutil.rmtree, folder)
commands = {
    "worn": ["run", "slider_crank_clearance.yaml"],
    "plate": ["run", "four_bar_flexible.yaml", "--set", "run.until=50 ms"],
    "warned": ["run", "rotating_beam.yaml"],
    "events": ["run", "breaker.yaml"],
    "sweep": ["sweep", "studies/speed.yaml"],
    "modes": ["linearize", "four_bar_flexible.yaml"],
    "rest": ["statics", "double_wishbone.yaml"],
    "shapes": ["modes", "modes_beam.yaml"],
    "loaded": ["static", "static_bracket.yaml"],
    "upright": ["statics", folder / "upright.yaml"],
    "free": ["modes", folder / "free.yaml"],
    "heavy": ["static", "modes_beam.yaml"],
    "frozen": ["linearize", "slider_crank_clearance.yaml"],
}
(folder / "empty.html").write_text("<!DOCTYPE html>")
browser = Chromium(folder / "empty.html")
atexit.register(browser.close)


def call(*words):
    subprocess.run([pintle, *words], check=True, stdout=subprocess.DEVNULL)


def show(*names):
    for name in names:
        call("report", folder / name)


def report(*names):
    for name in names:
        command, file, *more = commands[name]
        call(command, source / "examples" / file, *more, "-o", folder / name)
        show(name)


def table(file):
    """Names of columns without their units, rows."""
    with open(folder / file, newline="") as text:
        header, *rows = csv.reader(text)
    return [name.partition(" [")[0] for name in header], [[float(x) if x else math.nan for x in row] for row in rows]


class Driven(unittest.TestCase):
    def open(self, name, width=1400, height=1000, **screen):
        browser.screen(width, height, **screen)
        browser.open(folder / name / "report.html")

    def tearDown(self):
        self.assertEqual(browser.get("errors"), [])
        self.assertEqual(browser.troubles(), [])

    def expect_values_of(self, run):
        """What stands above the plots is what the tables hold at the time of the nearest row."""
        held = {}
        for file in "ledger", "trajectory":
            names, rows = table(f"{run}/{file}.csv")
            held |= {name: (rows, i) for i, name in enumerate(names)}
        shown = browser.get("page.panels.filter((panel) => !panel.against).flatMap(({shown}) => shown.map(({column, value}) =>"
                            "[column.name, column.t[nearestIndex(column.t, page.clock.time)], value.title]))")
        self.assertGreater(len(shown), 1)
        for name, t, title in shown:
            rows, i = held[name]
            self.assertIn(float(title), [row[i] for row in rows if row[0] == t], f"{name} at {t}")
