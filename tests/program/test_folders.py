"""What is said of folders that lack what a command needs, and of files and folders without permission: the user's own path, the cause, a remedy.

usage: test_folders.py PINTLE"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

pintle = os.path.realpath(sys.argv.pop(1))
has_pictures = (Path(pintle).parent / "pintle-picture").exists()
has_hdf5 = (Path(pintle).parent / "pintle-hdf5").exists()
has_ffmpeg = shutil.which("ffmpeg") is not None
scene = """
gravity: [0, -9.81]
parameters: {m1: 1 kg}
bodies: {rod: {rigid: {mass: m1, inertia: 0.1}, points: {O: [-1, 0]}}}
joints: {hinge: {revolute: [ground, rod.O]}}
start: {rod: {angle: 0 deg}}
run: {until: 10 ms}
output: {frames: 3, states: 5 ms}
"""
study = "scene: s.yaml\nmeasure: {turn: final angle of rod}\nsweep: {grid: {m1: [1 kg, 2 kg]}}\n"
fit = "scene: s.yaml\nmeasure: {turn: final angle of rod}\nvary: {m1: {from: 1 kg, to: 2 kg}}\ngoal: {minimise: turn}\nfit: {evaluations: 8}\n"


class Folders(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.place = Path(place.name)
        self.place.chmod(0o755)
        for name, text in (("s.yaml", scene), ("sweep.yaml", study), ("fit.yaml", fit)):
            (self.place / name).write_text(text)

    def say(self, *words, **more):
        return subprocess.run([pintle, *words], cwd=self.place, capture_output=True, text=True, **more)

    def done(self, *words):
        done = self.say(*words)
        self.assertIn(done.returncode, (0, 4), done.stderr)

    def refusal(self, said, *words):
        done = self.say(*words)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("pintle: " + said), (words, done.stderr))

    def test_a_run_killed_before_its_first_row(self):
        self.done("run", "s.yaml", "--out", "run", "-q")
        run = json.loads((self.place / "run" / "run.json").read_text())
        for name, tables in (("begun", True), ("bare", False)):
            folder = self.place / name
            (folder / "frames").mkdir(parents=True)
            for table in ("trajectory.csv", "ledger.csv", "events.csv"):
                heading = (self.place / "run" / table).read_text().partition("\n")[0] + "\n"
                (folder / table).write_text(heading if tables else "")
            if tables:
                begun = {"status": "unfinished", "title": "", "file": run["file"], "scene": run["scene"]}
                (folder / "run.json").write_text(json.dumps(begun, indent=2))
            self.refusal(f"{name}: has nothing to show: its run was killed before it wrote any motion; run its scene again", "report", name)
            self.refusal(f"{name}: has nothing to plot: its run was killed before it wrote any rows over time; run its scene again",
                         "plot", name, "rod.angle")
            if has_pictures:
                said = f"{name}: holds no frames (mechanism.pvd): its run was killed before it wrote any frames; run its scene again"
                self.refusal(said, "picture", name, "a.png")
                if has_ffmpeg:
                    self.refusal(said, "film", name, "a.mp4")
        self.done("run", "s.yaml", "--set", "output.frames=0", "--out", "frameless", "-q")
        if has_pictures:
            self.refusal("frameless: holds no frames (mechanism.pvd); run its scene again with --set output.frames=100",
                         "picture", "frameless", "a.png")

    def test_driven_motions_have_a_report_too(self):
        examples = Path(__file__).resolve().parents[2] / "examples"
        for question, file in (("kinematics", "kinematics_quick_return.yaml"), ("inverse", "inverse_four_bar.yaml")):
            self.done(question, examples / file, "--out", question, "-q", "--report")
            self.assertIn("<!DOCTYPE html>", (self.place / question / "report.html").read_text())

    def test_a_study(self):
        self.done("sweep", "sweep.yaml", "--out", "sweep", "-q")
        self.done("fit", "fit.yaml", "--out", "fit", "-q")
        (self.place / "begun").mkdir()
        for name in ("journal-0.txt", "study.yaml", "scene.yaml"):
            shutil.copy(self.place / "sweep" / name, self.place / "begun")
        goes_on = "it holds a study that has not ended; to continue it, repeat its command with the same --out"
        self.refusal("begun: has nothing to show: " + goes_on, "report", "begun")
        self.refusal("begun: has nothing to plot: " + goes_on, "plot", "begun", "rod.angle")
        self.refusal("sweep: has nothing to plot: it holds a sweep, which has no rows over time; name the folder of a run", "plot", "sweep", "turn")
        self.done("report", "fit")
        self.done("report", "sweep")
        if has_pictures:
            self.refusal("begun: holds no frames (mechanism.pvd): " + goes_on, "picture", "begun", "a.png")
            self.refusal("sweep: holds no frames (mechanism.pvd): it holds a sweep, which has no frames; name the folder of a run",
                         "picture", "sweep", "a.png")
        if has_hdf5:
            self.refusal("begun: has no tables (.csv): " + goes_on, "hdf5", "begun")
            self.done("hdf5", "sweep")

    def test_parts_of_a_sweep(self):
        for part in "12":
            self.done("sweep", "sweep.yaml", "-q", "--shard", part + "/2", "--out", "p" + part)
        self.refusal("p1: holds a part of a sweep; join all its parts by pintle merge", "report", "p1")
        inside = self.say("merge", "p1", "p2", "--out", "p2/whole")
        self.assertEqual(inside.returncode, 2)
        self.assertIn("--out p2/whole: lies in the part p2; name a folder outside", inside.stderr)
        self.done("merge", "-q", "p1", "p2", "--out", "whole")
        self.done("report", "-q", "whole")

    def test_without_permission(self):
        anyone = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
        try:
            if self.say("--version", **anyone).returncode != 0:
                self.skipTest("the program cannot be started by another user")
        except PermissionError:
            self.skipTest("the program cannot be started by another user")
        self.done("run", "s.yaml", "--out", "run", "-q")
        for name in ("unread", "closed"):
            shutil.copytree(self.place / "run", self.place / name / "run")
            for file in ("s.yaml", "sweep.yaml"):
                shutil.copy(self.place / file, self.place / name)
        for file in (self.place / "unread").rglob("*"):
            if file.is_file():
                file.chmod(0)
        shutil.copytree(self.place / "run", self.place / "frames")
        (self.place / "frames" / "frames" / "00002.vtu").chmod(0)
        (self.place / "mine").mkdir()
        for folder, mode in (("mine", 0o555), ("run", 0o555), ("closed", 0o000)):
            (self.place / folder).chmod(mode)
            self.addCleanup((self.place / folder).chmod, 0o755)

        denied, look = "cannot be read (Permission denied); check ", "its permissions"
        above = "its permissions and those of the folders above it"
        expected = [("unread/s.yaml: " + denied + look, "run", "unread/s.yaml"),
                    ("unread/sweep.yaml: " + denied + look, "sweep", "unread/sweep.yaml"),
                    ("closed/s.yaml: " + denied + look, "check", "closed/s.yaml"),
                    ("unread/run/run.json: " + denied + look, "report", "unread/run"),
                    ("unread/run/trajectory.csv: " + denied + look, "plot", "unread/run", "t"),
                    ("closed/run: " + denied + above, "report", "closed/run"), ("closed/run: " + denied + above, "plot", "closed/run", "t"),
                    ("closed/run: " + denied + above, "run", "s.yaml", "--allow-path", "closed/run")]
        unmade, unwritten = ": cannot be made (Permission denied); ", ": cannot be written (Permission denied); "
        for place in ("mine", "closed"):
            for command, file in (("run", "s.yaml"), ("sweep", "sweep.yaml"), ("statics", "s.yaml"), ("linearize", "s.yaml")):
                expected.append((f"{place}/a" + unmade, command, file, "--out", f"{place}/a"))
            expected += [(f"{place}/a.html" + unwritten, "report", "run", "--out", f"{place}/a.html"),
                         (f"{place}/a.svg" + unwritten, "plot", "run", "t", "--out", f"{place}/a.svg")]
            if has_hdf5:
                expected.append((f"{place}/a.h5" + unwritten, "hdf5", "run", "--out", f"{place}/a.h5"))
            if has_pictures:
                expected.append((f"{place}/a.png" + unwritten, "picture", "run", f"{place}/a.png"))
                if has_ffmpeg:
                    expected.append((f"{place}/a.mp4" + unwritten + "name a film in an existing folder", "film", "run", f"{place}/a.mp4"))
        if has_hdf5:
            expected.append(("closed/run: " + denied + above, "hdf5", "closed/run", "a.h5"))
        if has_pictures:
            expected += [("closed/run: " + denied + above, "picture", "closed/run", "a.png"),
                         ("unread/run/mechanism.pvd: " + denied + look, "picture", "unread/run", "a.png"),
                         ("frames/frames/00002.vtu: " + denied + look, "picture", "frames", "a.png"),
                         ("frames/frames/00002.vtu: " + denied + look, "picture", "frames/frames/00002.vtu", "a.png", "--field", "x")]
        for said, *words in expected:
            with self.subTest(" ".join(words)):
                done = self.say(*words, **anyone)
                self.assertIn(done.returncode, (1, 2))
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                self.assertTrue(done.stderr.startswith("pintle: " + said), done.stderr)
                if words[0] in ("picture", "film", "plot"):  # they have no such option
                    self.assertNotIn("--out", done.stderr)


if __name__ == "__main__":
    unittest.main()
