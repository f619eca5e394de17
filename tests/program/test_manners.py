"""What the program says where a name is mistyped, and to someone who waits or no longer wants to.

usage: test_manners.py PINTLE"""

import os
import pty
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

pintle = os.path.realpath(sys.argv.pop(1))
pendulum = """
gravity: [0, -9.81]
bodies: {rod: {rigid: {mass: 1 kg, inertia: 0.1}, points: {O: [-1, 0]}}}
joints: {hinge: {revolute: [ground, rod.O]}}
start: {rod: {angle: 0 deg}}
run: {until: 0.1 s}
"""


class Manners(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.place = Path(place.name)
        (self.place / "swing.pintle.yaml").write_text(pendulum)

    def say(self, *words):
        return subprocess.run([pintle, *words], cwd=self.place, capture_output=True, text=True)

    def test_a_mistyped_command(self):
        done = self.say("rnu", "swing.pintle.yaml")
        self.assertEqual(done.returncode, 2)
        self.assertIn('"rnu" is not a command. Did you mean "run"?', done.stderr)
        self.assertIn("Known here: ", self.say("simulate").stderr)

    def test_a_mistyped_option(self):
        for words in (("run", "swing.pintle.yaml", "--reprot"), ("run", "--reprot", "swing.pintle.yaml"), ("run", "--reprot")):
            done = self.say(*words)
            self.assertEqual(done.returncode, 2)
            self.assertIn('run has no option --reprot. Did you mean "--report"?', done.stderr)
        self.assertIn('Did you mean "--count"?', self.say("modes", "swing.pintle.yaml", "--cuont=3").stderr)
        self.assertIn("study is required", self.say("sweep").stderr)  # what is no slip of a name stays as it was
        self.assertEqual(self.say("--version").returncode, 0)
        self.assertEqual(self.say("run", "--help").returncode, 0)
        self.assertEqual(self.say().returncode, 2)

    def test_a_scene_may_be_named_pintle_yaml(self):
        self.assertEqual(self.say("run", "swing.pintle.yaml", "-q").returncode, 0)
        self.assertTrue((self.place / "runs" / "swing" / "run.json").exists())

    def test_redundancy_is_told_in_few_lines(self):
        bars = "\n".join(f"  bar {k}: {{rigid: {{mass: 1 kg, inertia: 0.1}}, points: {{A: [0, 0], B: [0, 1]}}}}" for k in range(40))
        pins = "\n".join(f"  foot {k}: {{revolute: [ground [{k}, 0], bar {k}.A]}}\n  head {k}: {{revolute: [plate.P{k}, bar {k}.B]}}" for k in range(40))
        points = ", ".join(f"P{k}: [{k}, 0]" for k in range(40))
        (self.place / "bars.yaml").write_text(
            f"bodies:\n{bars}\n  plate: {{rigid: {{mass: 1 kg, inertia: 0.1}}, points: {{{points}}}}}\njoints:\n"
            + pins.replace("ground [", "ground.G").replace(", 0],", ",") + "\nground: {points: {" + ", ".join(f"G{k}: [{k}, 0]" for k in range(40)) + "}}\n"
            + "start: {plate: {at: [0, 1]}}\nrun: {until: 0.1 s}\n")
        done = self.say("check", "bars.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("38 redundant", done.stdout)
        about = [line for line in done.stdout.splitlines() if "redundant" in line or "joint forces" in line]
        self.assertLess(len(about), 16)
        self.assertLess(max(map(len, about)), 400)

    def test_who_waits_is_told_how_long_and_may_stop(self):
        ours, its = pty.openpty()
        process = subprocess.Popen([pintle, "linearize", "swing.pintle.yaml", "--at", "1e6 s", "--set", "run.until=1e7 s", "--set", "output.every=1e4 s"],
                                   cwd=self.place, stdout=subprocess.DEVNULL, stderr=its)
        os.close(its)
        said = b""
        try:
            while b"running to the state: " not in said:
                said += os.read(ours, 4096)
            process.send_signal(signal.SIGINT)
        finally:
            if not said:
                process.kill()
        try:
            while more := os.read(ours, 4096):
                said += more
        except OSError:  # the other end is closed
            pass
        self.assertEqual(process.wait(), 6)
        self.assertIn(b"stopped by the user (Ctrl-C) while running to the state; there are no results yet", said)


if __name__ == "__main__":
    unittest.main()
