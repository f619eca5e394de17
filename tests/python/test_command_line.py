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

measured_times = ("time", "least time", "most time", "build", "role")
few_cases = """
scene: SCENE
analysis: linearize
equilibrium: true
measure: {frequency: frequency of mode 2, damping: damping of mode 2}
sensitivity:
  parameters: {forces.rubber at rest.stiffness: {uniform: 2 N/mm}, bodies.machine.rigid.mass: {normal: 0.1 kg}}
  corners: true
  monte carlo: {count: 20}
  sobol: {count: 16}
"""


def without_times(told):
    """Also of each body of a static case."""
    return {key: without_times(value) if isinstance(value, dict) else value for key, value in told.items() if key != "timings [s]"}


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

    def runs_alike(self, file):
        out = self.by_program("run", file)
        result = pintle.load(file).run(check=False)
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

    def test_checks(self):
        """But what is timed; of scenes that kinematics alone can run too."""
        for name in ("coupler_curve", "pendulum", "flexible_slider_crank"):
            with self.subTest(example=name):
                told = subprocess.run([program, "check", str(examples / f"{name}.yaml"), "--json"], capture_output=True, text=True, check=True)
                ours, theirs = pintle.load(examples / f"{name}.yaml").check(), json.loads(told.stdout)
                self.assertEqual(ours.keys(), theirs.keys())
                for timed in ("cost", "rigid run"):
                    del ours[timed], theirs[timed]
                self.assertEqual(ours, theirs)
                self.assertEqual(any("only `pintle kinematics`" in w for w in ours["warnings"]), name == "coupler_curve")

    def test_runs(self):
        for name in short_runs:
            with self.subTest(example=name):
                self.runs_alike(examples / f"{name}.yaml")

    @unittest.skipUnless(nightly, "minutes")
    def test_all_runs(self):
        for file in [f for folder in ("", "paper", "nonlinear") for f in sorted((examples / folder).glob("*.yaml"))]:
            scene = pintle.load(file).as_dict()
            if file.stem in short_runs or "run" not in scene or file.stem.startswith("statics") or lacks_masses(scene):
                continue
            with self.subTest(example=file.stem):
                self.runs_alike(file)

    @unittest.skipUnless(nightly, "minutes")
    def test_all_other_questions(self):
        """Both answer alike, or neither answers."""
        asked = {"statics": self.rests_alike, "kinematics": self.moves_alike, "inverse": self.driven_alike,
                 "linearize": self.small_motion_alike, "modes": self.swings_alike, "static": self.bends_alike, "mesh": self.meshed_alike}
        answered = dict.fromkeys(asked, 0)
        for file in [*sorted(examples.glob("*.yaml")), *sorted((examples / "verification").glob("*.yaml"))]:
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

    def test_static(self):
        for name in ("static_bracket", "static_pin", "verification/beams_static"):
            with self.subTest(example=name):
                self.bends_alike(examples / f"{name}.yaml")

    def bends_alike(self, file):
        out, case = self.by_program("static", file), pintle.load(file).static()
        told = json.loads((out / "static.json").read_text())
        for name, body in case.bodies.items():
            own, folder = (told["bodies"][name], out / name) if case.contacts else (told, out)
            self.assertEqual(body["von Mises"].max(), own["greatest von Mises stress"]["value [Pa]"])
            at = body.data[body["von Mises"].argmax(), :2]
            self.assertEqual(list(at), own["greatest von Mises stress"]["at [m]"])
            self.same_words(body.points, folder / "points.csv")
            self.assertEqual(body.section_forces is not None, (folder / "section_forces.csv").exists())
            if body.section_forces:
                self.same_words(body.section_forces, folder / "section_forces.csv")
        if case.contacts:
            self.same_words(case.contacts, out / "contacts.csv")
        self.assertEqual(without_times(case.info), without_times(told))

    def test_mesh(self):
        self.meshed_alike(examples / "static_bracket.yaml")

    def meshed_alike(self, file):
        told = json.loads((self.by_program("mesh", file) / "mesh.json").read_text())
        mesh = pintle.load(file).mesh()
        self.assertEqual(without_times(mesh.info), without_times(told))
        self.assertEqual((len(mesh.nodes), sum(map(len, mesh.cells.values()))), (told["nodes"], told["cells"]))
        self.assertEqual({name: len(nodes) for name, nodes in mesh.groups.items()}, told["nodes of each group"])
        self.assertEqual(set(numpy.concatenate([c.ravel() for c in mesh.cells.values()])), set(range(len(mesh.nodes))))

    def same_words(self, table, file, left_out=()):
        """Numbers to the bit and words; without columns whose names start so."""
        with open(file, newline="") as text:
            header, *rows = csv.reader(text)
        self.assertGreater(len(rows), 0, file)
        self.assertEqual(len(table), len(rows))
        for heading, column in zip(header, zip(*rows)):
            if heading.startswith(left_out):
                continue
            name = heading.rpartition(" [")[0] or heading
            if name in table.words:
                self.assertEqual(table.words[name], list(column))
            else:
                numpy.testing.assert_array_equal(table[heading], [float(x) if x else numpy.nan for x in column])

    def studied_alike(self, question, file, set=None):
        options = [part for name, value in (set or {}).items() for part in ("--set", f"{name}={value}")]
        out, found = self.by_program(question, file, *options), getattr(pintle, question)(file, set=set)
        if question == "nonlinear":
            self.same_words(found, out / "values.csv")
            for part in ("section", "orbits", "lyapunov"):
                self.assertEqual(getattr(found, part) is not None, (out / f"{part}.csv").exists(), part)
                if getattr(found, part) is not None:
                    self.same_words(getattr(found, part), out / f"{part}.csv")
            return
        self.same_words(found, out / f"{question}.csv", measured_times)
        if question == "sweep" and found.warnings:
            self.same_words(found.warnings, out / "warnings.csv")
        if question == "sensitivity":
            self.same_words(found.cases, out / "sweep.csv", measured_times)
        if question == "tradeoff":
            told = json.loads((out / "tradeoff.json").read_text())
            self.assertEqual(found.info["reference"]["quantities"], told["reference"]["quantities"])

    def test_sweep(self):
        self.studied_alike("sweep", examples / "studies" / "clearance.yaml")

    def test_sweep_with_warnings(self):
        study = {
            "scene": str(examples / "pendulum.yaml"), "set": {"run.until": "0.1 s", "run.tolerance": 1e-4},
            "measure": {"turn": "final angle of bob"}, "sweep": {"grid": {"run.method": ["dopri5", "generalized-alpha"]}},
        }
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            self.assertEqual(pintle.sweep(study).warnings["case"].tolist(), [2])
        self.assertEqual([w.category for w in told], [pintle.ModelWarning])
        self.assertIn("1 case of 2 has warnings; case 2: ", str(told[0].message))
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        file = Path(place.name) / "study.yaml"
        file.write_text(json.dumps(study))
        self.studied_alike("sweep", file)

    def test_fit(self):
        self.studied_alike("fit", examples / "studies" / "fit_frequency.yaml")

    def test_sensitivity(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        file = Path(place.name) / "study.yaml"
        file.write_text(few_cases.replace("SCENE", str(examples / "rubber_mount.yaml")))
        self.studied_alike("sensitivity", file)

    def test_nonlinear(self):
        self.studied_alike("nonlinear", examples / "studies" / "slider_crank_returns.yaml")

    def test_tradeoff(self):
        self.studied_alike("tradeoff", examples / "studies" / "trade_modes.yaml")

    @unittest.skipUnless(nightly, "minutes")
    def test_all_studies(self):
        """But those with a budget of time: what they run depends on how fast it went."""
        keys = {"sweep": "sweep", "fit": "fit", "sensitivity": "sensitivity", "section": "nonlinear", "tradeoff": "tradeoff"}
        for file in sorted((examples / "studies").glob("*.yaml")):
            lines = file.read_text().splitlines()
            question = next(q for key, q in keys.items() if any(line.startswith(key + ":") for line in lines))
            if any(line.startswith("  budget:") for line in lines):
                continue
            with self.subTest(study=file.stem):
                self.studied_alike(question, file)


if __name__ == "__main__":
    unittest.main()
