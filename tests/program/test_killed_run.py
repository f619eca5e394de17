"""A run that is killed, ten times at ten places: what it wrote is there, whole rows, the same bytes as of a run that was not, and says
how far it came. Places are rows, not times: nothing here depends on how fast the machine is.

usage: test_killed_run.py PINTLE"""

import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

pintle = os.path.realpath(sys.argv.pop(1))
scene = """
gravity: [0, -9.81]
bodies: {rod: {rigid: {mass: 1 kg, inertia: 0.1}, points: {O: [-1, 0], E: [1, 0]}}, ball: {rigid: {mass: 1 kg, inertia: 0.1}, points: {O: [0, 0.5]}}}
joints: {hinge: {revolute: [ground, rod.O]}, pin: {revolute: [rod.E, ball.O]}}
start: {rod: {angle: 0 deg}}
run: {until: 20000 s, tolerance: 1e-9, method: dopri5}
output: {every: 5 ms, states: 2 s}
"""
# Impacts in the first tenth of a second, then rest.
burst = """
gravity: [0, -9.81]
bodies: {ball: {rigid: {mass: 1 kg, inertia: 0.1}, points: {O: [0, 0]}}}
joints: {pin: {revolute: [ground, ball.O], clearance: {radial: 1 mm, bearing radius: 10 mm, bearing: ground, normal: {hunt-crossley: {stiffness: 1e9, restitution: 0.7}}}}}
run: {until: 20000 s, method: dopri5, tolerance: 1e-6}
output: {every: 1 s}
"""
# Actions in the first second, then none.
swings = """
gravity: [0, -9.81]
bodies: {rod: {rigid: {mass: 1 kg, inertia: 0.1}, points: {O: [-1, 0]}}}
joints: {hinge: {revolute: [ground, rod.O]}}
start: {rod: {angle: 0 deg}}
events: {first down: {when: rod.angle < -1 deg, do: {row: true}}, far: {when: rod.angle < -60 deg, do: {row: true}}}
run: {until: 1e7 s, method: dopri5, tolerance: 1e-9, max steps: 2000000000}
output: {every: 1 s}
"""
# A driven crank; with a free rod at its end, inverse integrates.
driven = """
gravity: [0, -9.81]
bodies: {crank: {rigid: {mass: 1 kg, inertia: 0.1}, points: {O: [-1, 0], E: [1, 0]}}BODIES}
joints: {hinge: {revolute: [ground, crank.O]}JOINTS}
drivers: {motor: {angle: [ground, crank], law: "1 rad/s*t"}}
run: {until: 20000 s, tolerance: 1e-6, max steps: 2000000000}
output: {every: 5 ms}
"""
crank = driven.replace("BODIES", "").replace("JOINTS", "")
swung = driven.replace("BODIES", ", rod: {rigid: {mass: 1 kg, inertia: 0.1}, points: {O: [-1, 0]}}").replace("JOINTS", ", pin: {revolute: [crank.E, rod.O]}")


def pieces(folder):
    return {f.relative_to(folder).as_posix(): f.read_bytes() for f in sorted(folder.rglob("*")) if f.is_file()}


class KilledRun(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.place = Path(place.name)
        (self.place / "scene.yaml").write_text(scene)

    def killed(self, rows, command="run"):
        """The folder that a run leaves which is killed once so many rows are on the disk."""
        out = self.place / f"killed-{rows}"
        process = subprocess.Popen([pintle, command, "scene.yaml", "--out", out.name, "--quiet"], cwd=self.place)
        try:
            while process.poll() is None:
                found = list(self.place.glob(out.name + ".part-*/trajectory.csv"))
                if found and found[0].read_bytes().count(b"\n") > rows:
                    break
                time.sleep(0.002)
        finally:
            process.send_signal(signal.SIGKILL)
        self.assertEqual(process.wait(), -signal.SIGKILL)
        self.assertFalse(out.exists())
        (left,) = self.place.glob(out.name + ".part-*")
        return left

    def run_to(self, until, command="run"):
        out = self.place / "whole"
        subprocess.run([pintle, command, "scene.yaml", "--set", f"run.until={until!r}", "--out", out.name, "--quiet"], cwd=self.place, check=True)
        return pieces(out)

    def left_with(self, table, text):
        """The folder of a run that is killed once this table has a row."""
        (self.place / "scene.yaml").write_text(text)
        process = subprocess.Popen([pintle, "run", "scene.yaml", "--out", "out", "--quiet"], cwd=self.place)
        rows, end = 0, time.monotonic() + 60  # seconds; one is enough where anything runs at all
        try:
            while rows == 0 and process.poll() is None and time.monotonic() < end:
                time.sleep(0.05)
                for file in self.place.glob(f"out.part-*/{table}"):
                    rows = file.read_bytes().count(b"\n") - 1
        finally:
            process.send_signal(signal.SIGKILL)
        self.assertEqual(process.wait(), -signal.SIGKILL)
        self.assertGreater(rows, 0)
        (left,) = self.place.glob("out.part-*")
        return left

    def test_impacts_reach_the_disk_though_none_follows(self):
        self.left_with("events.csv", burst)

    def test_actions_reach_the_disk_as_a_whole_run_writes_them(self):
        left = self.left_with("actions.csv", swings)
        killed = (left / "actions.csv").read_bytes()
        subprocess.run([pintle, "run", "scene.yaml", "--set", "run.until=20 s", "--out", "whole", "--quiet"], cwd=self.place, check=True)
        whole = (self.place / "whole" / "actions.csv").read_bytes()
        self.assertTrue(killed.startswith(b"event,t [s],did\nfirst down,"), killed)
        self.assertTrue(killed.endswith(b"\n"))
        first = killed.splitlines()[:10]
        self.assertEqual(whole.splitlines()[: len(first)], first)

    def test_it_leaves_what_a_run_writes_and_no_more(self):
        names = {n for n in pieces(self.killed(1)) if "/" not in n}
        self.assertEqual(names, {"trajectory.csv", "ledger.csv", "events.csv", "run.json"})

    def test_driven_motions_leave_what_they_wrote_too(self):
        for name, command, text, tables in (
            ("kinematics", "kinematics", crank, {"trajectory.csv"}),
            ("by algebra", "inverse", crank, {"trajectory.csv"}),
            ("integrated", "inverse", swung, {"trajectory.csv", "ledger.csv", "events.csv"}),
        ):
            with self.subTest(name):
                self.setUp()
                (self.place / "scene.yaml").write_text(text)
                files = pieces(self.killed(500, command))
                self.assertEqual(set(files), tables | {"run.json"})
                self.assertEqual(json.loads(files["run.json"])["status"], "unfinished")
                reached = float(files["trajectory.csv"].split(b"\n")[-2].split(b",")[0])
                whole = self.run_to(reached + 3, command)
                for table in tables:
                    rows = files[table][: files[table].rfind(b"\n") + 1]
                    if name == "integrated":  # whose times of efforts, and so its steps, are parts of the whole time
                        rows = rows[: rows.find(b"\n") + 1]
                    self.assertTrue(whole[table].startswith(rows), table)
                self.assertEqual("run.json" in whole, name == "integrated")
                self.assertEqual(json.loads(whole[f"{command}.json"])["status"], "finished")

    def test_ten_times(self):
        left, furthest = [], 0
        for rows in (0, 1, 10, 100, 500, 1000, 1500, 2500, 4000, 6000):
            folder = self.killed(rows)
            files = pieces(folder)
            lines = files["trajectory.csv"].split(b"\n")
            self.assertGreater(len(lines) - 2, rows - 1)
            last = lines[-2].split(b",")[0]  # what follows the last line's end may be cut
            time_reached = 0.0 if last.startswith(b"t ") else float(last)
            furthest = max(furthest, time_reached)
            left.append((folder, files, time_reached))
        whole = self.run_to(furthest + 3)
        for folder, files, reached in left:
            for table in ("trajectory.csv", "ledger.csv", "events.csv"):
                rows = files[table][: files[table].rfind(b"\n") + 1]
                self.assertTrue(whole[table].startswith(rows), f"{folder.name}: {table}")
            states = [n for n in files if n.startswith("states/") and n.endswith(".state")]
            self.assertGreaterEqual(len(states), int(reached / 2) - 1 if reached > 4 else 0)
            for name in states:  # whole or not there
                done = subprocess.run([pintle, "run", "scene.yaml", "--restart", folder / name, "--out", f"on-{folder.name}-{Path(name).stem}", "--quiet",
                                       "--set", f"run.until={2 * len(states) + 3} s"], cwd=self.place, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                break
            said = subprocess.run([pintle, "run", "scene.yaml", "--out", folder.name.partition(".part-")[0], "--set", "run.until=5 ms"], cwd=self.place,
                                  capture_output=True, text=True)
            self.assertIn(folder.name + (f" (to t = {reached:.6g} s)" if reached > 0 else ""), said.stderr)

    def test_a_full_disk_is_told_with_the_time_of_the_last_row(self):
        run = subprocess.Popen([pintle, "run", "scene.yaml", "--out", "out", "--quiet"], cwd=self.place, stderr=subprocess.PIPE, text=True)
        while not (files := list(self.place.glob("out.part-*/trajectory.csv"))) or files[0].stat().st_size < 100_000:
            time.sleep(0.01)
        limit = files[0].stat().st_size + 50_000
        resource.prlimit(run.pid, resource.RLIMIT_FSIZE, (limit, limit))  # as a disk that becomes full
        said = run.communicate()[1]
        self.assertEqual(run.returncode, 1, said)
        table = next(self.place.glob("out*/trajectory.csv"))
        rows = [row for row in table.read_text().splitlines(True) if row.endswith("\n")]
        self.assertIn(f"what was computed up to t = {float(rows[-1].split(',')[0]):.6g} s is in {table.parent.name}", said)

    def test_what_is_there_is_shown_and_where_it_ends(self):
        frames = scene.replace("states: 2 s", "frames: 20001")  # one each second of the motion
        (self.place / "scene.yaml").write_text(frames)
        left = self.killed(600)  # 3 s
        shown = [("report", "killed-600"), ("plot", "killed-600", "t")]
        if (Path(pintle).parent / "pintle-picture").exists():
            shown += [("picture", "killed-600", "a.png"), ("film", "killed-600", "a.mp4")]
        for words in shown:
            done = subprocess.run([pintle, *words], cwd=self.place, capture_output=True, text=True)
            self.assertIn("killed-600: there is no such folder; a run into it has not ended, or was killed: " + left.name, done.stderr)
        left = left.rename(self.place / "kept")
        told = "kept: the run did not finish; its rows end at t = "
        self.assertIn(told, subprocess.run([pintle, "plot", "kept", "rod.angle"], cwd=self.place, capture_output=True, text=True).stderr)
        done = subprocess.run([pintle, "report", "kept"], cwd=self.place, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("unfinished", (left / "report.html").read_text())
        self.assertIn(told, done.stderr)
        with (left / "trajectory.csv").open("ab") as table:
            table.write(b"9999,1,2")  # a row that the kill has cut
        self.assertEqual(subprocess.run([pintle, "report", "kept"], cwd=self.place).returncode, 0)
        if not (Path(pintle).parent / "pintle-picture").exists():
            return
        done = subprocess.run([pintle, "picture", "kept", "last.png", "--frame", "1"], cwd=self.place, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, "kept: the run did not finish; its frames end at [0-9]+ s")


if __name__ == "__main__":
    unittest.main()
