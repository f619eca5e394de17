"""Python equals the program to the last bit: each example by both, the program's files read back.

Those of seconds are left to  ctest -C nightly -L nightly;  PINTLE_NIGHTLY=1 runs them."""

import csv
import json
import os
import subprocess
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy
import pintle
from common import examples, program

nightly = os.environ.get("PINTLE_NIGHTLY") == "1"
short_runs = """belt_drive box_and_ramp breaker cam_roller engine_single latch motor_flywheel pendulum pid_arm
    planetary_gearbox shear_pin slider_crank_clearance stage_microslip stick_slip woodpecker""".split()


def numbers(file):
    with open(file, newline="") as text:
        header, *rows = csv.reader(text)
    return header, numpy.array([[float(x) if x else numpy.nan for x in row] for row in rows])


def lacks_masses(scene):
    """Of such a scene there is no run, only kinematics."""
    return any("rigid" in body and not body["rigid"].get("mass") for body in scene["bodies"].values())


class CommandLine(unittest.TestCase):
    def setUp(self):
        self.enterContext(warnings.catch_warnings())
        warnings.simplefilter("ignore", pintle.ModelWarning)

    def ask_program(self, command, file, *options):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        out = Path(place.name) / "out"
        done = subprocess.run([program, command, str(file), "--out", str(out), "--quiet", *options], capture_output=True, text=True,
                              env={**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"})  # `modes` takes all
        done.out = out
        return done

    def by_program(self, command, file, *options):
        done = self.ask_program(command, file, *options)
        out = done.out
        self.assertIn(done.returncode, (0, 4, 5), done.stderr)
        return out

    def same(self, table, file):
        header, data = numbers(file)
        self.assertEqual([f"{n} [{table.unit(n)}]" if table.unit(n) else n for n in table.names], header)
        numpy.testing.assert_array_equal(table.data, data)

    def runs_alike(self, name):
        out = self.by_program("run", examples / f"{name}.yaml")
        result = pintle.load(examples / f"{name}.yaml").run(check=False)
        self.same(result, out / "trajectory.csv")
        self.same(result.ledger, out / "ledger.csv")
        told = json.loads((out / "run.json").read_text())
        self.assertEqual(result.status, told["status"])
        self.assertEqual(result.warnings, told["warnings"])
        with open(out / "events.csv", newline="") as text:
            events = list(csv.reader(text))[1:]
        self.assertEqual([i.contact for i in result.impacts], [e[0] for e in events])
        ours = [[i.begin, i.end, i.approach, i.separation, i.deepest, i.peak_force, i.lost] for i in result.impacts]
        theirs = [[float(x) if x else numpy.nan for x in e[1:8]] for e in events]
        numpy.testing.assert_array_equal(ours, theirs)

    def test_runs(self):
        for name in short_runs:
            with self.subTest(example=name):
                self.runs_alike(name)

    @unittest.skipUnless(nightly, "minutes")
    def test_all_runs(self):
        for file in sorted(examples.glob("*.yaml")):
            scene = pintle.load(file).as_dict()
            if file.stem in short_runs or "run" not in scene or file.stem.startswith("statics") or lacks_masses(scene):
                continue
            with self.subTest(example=file.stem):
                self.runs_alike(file.stem)

    @unittest.skipUnless(nightly, "minutes")
    def test_all_other_questions(self):
        """Both answer alike, or neither answers."""
        asked = {"statics": self.rests_alike, "kinematics": self.moves_alike, "inverse": self.driven_alike,
                 "linearize": self.small_motion_alike, "modes": self.swings_alike}
        answered = dict.fromkeys(asked, 0)
        for file in sorted(examples.glob("*.yaml")):
            for question, alike in asked.items():
                with self.subTest(example=file.stem, question=question):
                    done = self.ask_program(question, file)
                    if done.returncode == 0:
                        alike(file)
                        answered[question] += 1
                    else:
                        self.assertIn(done.returncode, (2, 3, 4), done.stderr)
                        with self.assertRaises(pintle.Error):
                            getattr(pintle.load(file), question)()
        self.assertEqual([q for q, count in answered.items() if count == 0], [])

    def moves_alike(self, file):
        self.same(pintle.load(file).kinematics(), self.by_program("kinematics", file) / "trajectory.csv")

    def test_kinematics(self):
        self.moves_alike(examples / "kinematics_quick_return.yaml")

    def test_inverse(self):
        self.driven_alike(examples / "inverse_four_bar.yaml")

    def driven_alike(self, file):
        out, found = self.by_program("inverse", file), pintle.load(file).inverse()
        self.same(found, out / "trajectory.csv")
        told = json.loads((out / "inverse.json").read_text())["drivers"]
        for name, effort in found.efforts.items():
            rows = numpy.loadtxt(out / told[name]["file"], delimiter=",", skiprows=1)
            numpy.testing.assert_array_equal(numpy.column_stack([effort.t, effort.value]), rows)

    def test_statics(self):
        self.rests_alike(examples / "statics_lever.yaml")

    def rests_alike(self, file):
        told = json.loads((self.by_program("statics", file) / "statics.json").read_text())["values"]
        rest = pintle.load(file).statics()
        for heading, value in told.items():
            self.assertEqual(rest[heading], value)

    def test_linearize(self):
        self.small_motion_alike(examples / "pid_arm.yaml", ((), {}), (("--equilibrium",), {"at_rest": True}), (("--at", "10 ms"), {"at": 0.01}))

    def small_motion_alike(self, file, *ways):
        for options, asked in ways or (((), {}),):
            out, small = self.by_program("linearize", file, *options), pintle.load(file).linearize(**asked)
            for name in "ABCD":
                with open(out / f"{name}.csv", newline="") as text:
                    rows = list(csv.reader(text))[1:]
                written = numpy.array([[float(x) for x in row[1:]] for row in rows])
                numpy.testing.assert_array_equal(getattr(small, name).ravel(), written.ravel())

    def test_modes(self):
        self.swings_alike(examples / "modes_beam.yaml")

    def swings_alike(self, file):
        told = json.loads((self.by_program("modes", file, "--count", "3") / "modes.json").read_text())
        modes = pintle.load(file).modes(count=3)
        self.assertEqual([m["frequency [Hz]"] for m in told["natural"]["modes"]], list(modes.frequencies))

    def test_sweep(self):
        file = examples / "studies" / "clearance.yaml"
        with open(self.by_program("sweep", file) / "sweep.csv", newline="") as text:
            rows = list(csv.DictReader(text))
        sweep = pintle.sweep(file)
        self.assertEqual(len(sweep), len(rows))
        for name in sweep.names:
            heading = f"{name} [{sweep.unit(name)}]" if sweep.unit(name) else name
            numpy.testing.assert_array_equal(sweep[name], [float(row[heading] or "nan") for row in rows])


if __name__ == "__main__":
    unittest.main()
