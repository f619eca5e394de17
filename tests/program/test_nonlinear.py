"""What `pintle nonlinear` says while it goes on, and of values that fell short.

usage: test_nonlinear.py PINTLE"""

import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from terminal import interrupted

pintle = os.path.realpath(sys.argv.pop(1))
lorenz = """
parameters: {sigma: 10, rho: 28, beta: 8/3}
bodies: {plate: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}
joints: {held: {weld: [ground, plate]}}
states:
  X: {rate: "sigma*(Y - X)/(1 s)", start: 1}
  Y: {rate: "(X*(rho - Z) - Y)/(1 s)", start: 1}
  Z: {rate: "(X*Y - beta*Z)/(1 s)", start: 20}
run: {until: 10 s, method: dopri5}
"""


class Nonlinear(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.place = Path(place.name)
        (self.place / "lorenz.yaml").write_text(lorenz)

    def study(self, text):
        (self.place / "study.yaml").write_text("scene: lorenz.yaml\n" + text)
        return [pintle, "nonlinear", "study.yaml", "--threads", "1"]

    def end_of(self, text, *options):
        return subprocess.run([*self.study(text), *options], cwd=self.place, capture_output=True, text=True)

    def test_too_few_returns_are_told_and_kept(self):
        for k, (when, options) in enumerate((("Z > 1000", ()), ("Z > rho - 1", ()), ("Z > rho - 1", ("--json",)), ("Z > rho - 1", ("-q",)))):
            done = self.end_of(f"section: {{when: {when}, record: X, transient: 0, returns: 1000}}\n", "--out", f"out{k}", *options)
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertRegex(done.stderr, "too few returns: [0-9]+ of 1000 within run.until")
            rows = (self.place / f"out{k}" / "section.csv").read_text().splitlines()
            self.assertEqual(len(rows) > 1, "rho" in when)

    def test_some_values_that_fell_short_are_a_warning(self):
        done = self.end_of("section: {when: Z > 20, record: X, transient: 0, returns: 5}\nover: {rho: [2, 28]}\ndirection: from start\n")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("warning: 1 of 2 values could not be followed to the end; the first: rho = 2: too few returns", done.stderr)

    def test_dots_of_the_diagram_are_whole(self):
        for text in ("section: {when: Z > 20, record: X, transient: 0, returns: 5}\nover: {rho: [26, 27, 28]}\n",
                     "section: {when: Z > 20, record: [X, Y], transient: 0, returns: 9}\n",
                     "section: {every: 1 s, record: 0*X, transient: 0, returns: 2}\nover: {rho: [28]}\n",
                     "section: {when: Z > 1000, record: X, transient: 0, returns: 5}\n"):
            self.end_of(text, "--out", f"diagram{hash(text)}")
            picture = (self.place / f"diagram{hash(text)}" / "section.svg").read_text()
            self.assertNotRegex(picture, "nan|inf")
            clip = re.search("<clipPath.*?<rect x='(.*?)' y='(.*?)' width='(.*?)' height='(.*?)'", picture)
            x, y, width, height = map(float, clip.groups())
            dots = [tuple(map(float, dot)) for dot in re.findall("<circle cx='(.*?)' cy='(.*?)' r='(.*?)'", picture)]
            self.assertEqual(len(dots) > 0, "1000" not in text)
            for cx, cy, r in dots:
                self.assertTrue(x <= cx - r and cx + r <= x + width and y <= cy - r and cy + r <= y + height, (text, cx, cy))

    def test_its_tables_are_a_page(self):
        self.assertEqual(self.end_of("section: {when: Z > 20, record: [X, Y], transient: 0, returns: 9}\nlyapunov: {every: 0.1 s, over: 5 s}\n"
                                     "over: {rho: [27, 28]}\n", "--out", "out").returncode, 0)
        json.loads((self.place / "out" / "nonlinear.json").read_text())
        done = subprocess.run([pintle, "report", "out"], cwd=self.place, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        data = re.search('<script type="application/json" id="data">(.*?)</script>', (self.place / "out" / "report.html").read_text())
        tables = {table["file"]: table for table in json.loads(data[1])["tables"]}
        self.assertEqual(list(tables), ["section.csv", "values.csv", "lyapunov.csv"])
        self.assertEqual((tables["section.csv"]["x"], tables["section.csv"]["y"]), ("rho", "X"))
        for file, table in tables.items():
            rows = (self.place / "out" / file).read_text().splitlines()
            self.assertEqual(table["all"], len(rows) - 1, file)

    # x'' + b x' + x = cos(2 t): the pair of multipliers leaves the unit circle at b = 0.
    def test_losses_of_stability_name_their_branch(self):
        (self.place / "lorenz.yaml").write_text(
            "parameters: {b: 0.1}\nbodies: {block: {rigid: {mass: 1 kg, inertia: 1}}}\njoints: {guide: {prismatic: [ground, block]}}\n"
            'forces: {pull: {force: ["1 N*cos(2 rad/s*t) - 1 N/m*block.x - b*1 N s/m*block.vx", 0], at: block}}\n'
            "run: {until: 100 s, tolerance: 1e-9, method: verner87}\n")
        done = self.end_of("section: {every: pi*1 s, record: [block.x], transient: 0, returns: 3}\norbit: {}\nover: {b: [0.1, -0.1]}\n"
                           "direction: both\n")
        self.assertEqual(done.returncode, 0, done.stderr)
        for branch in ("forwards", "backwards"):
            self.assertRegex(done.stdout, f"near .*, between .* and .*, {branch}")

    def test_an_interrupted_study_is_a_picture_and_a_page(self):
        study = self.study("section: {every: rho^6*1 s, record: [X], transient: 0, returns: 3}\nover: {rho: [1, 100]}\n")
        _, code = interrupted([*study, "--out", "out"], self.place, b"1 of 2 values, the next at return ")
        self.assertEqual(code, 6)
        self.assertIn("<circle", (self.place / "out" / "section.svg").read_text())
        done = subprocess.run([pintle, "report", "out"], cwd=self.place, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_columns_are_aligned_whatever_letters_their_names_have(self):
        (self.place / "study.yaml").write_text("scene: lorenz.yaml\nmeasure: {größe: max X, other: max Y}\nsweep: {grid: {rho: [28]}}\n")
        done = subprocess.run([pintle, "sweep", "study.yaml"], cwd=self.place, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [line for line in done.stdout.splitlines() if line.startswith(("  größe", "  other"))]
        self.assertEqual(*[re.search(r"\S  +", row).end() for row in rows])

    def test_who_waits_is_told_how_far_a_value_is(self):
        _, code = interrupted(self.study("section: {every: 100 s, record: X, transient: 0, returns: 1000000}\n"), self.place,
                              b"0 of 1 values, the next at return ", b" left")
        self.assertEqual(code, 6)


if __name__ == "__main__":
    unittest.main()
