"""Man pages and completion say what the programs say, and shells take them.

usage: test_manual.py PINTLE"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

pintle = sys.argv.pop(1)
made = tempfile.TemporaryDirectory()
out = Path(made.name)
subprocess.run([sys.executable, Path(__file__).parents[2] / "packaging" / "manual.py", out, pintle], check=True)
text = subprocess.run([pintle, "--help"], capture_output=True, text=True, check=True).stdout
commands = re.findall(r"(?m)^  (\w+) {2,}\S", text.partition("Subcommands:")[2].partition("Exit codes")[0])


def options(command):
    said = subprocess.run([pintle, command, "--help"], capture_output=True, text=True, check=True).stdout
    return re.findall(r"(?m)^  (?:-\w,)?(--[\w-]+)", said)


def shell(*command, cwd):
    home = {"HOME": str(out), "XDG_CONFIG_HOME": str(out), "XDG_DATA_HOME": str(out)}
    done = subprocess.run(command, capture_output=True, text=True, cwd=cwd, env={**os.environ, **home})
    return done.stdout.split("\n"), done.stderr


class Manual(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.place = Path(place.name)
        for name in ("a scene.yaml", "other.pintle.yaml", "picture.png"):
            (self.place / name).touch()
        (self.place / "runs").mkdir()

    def bash(self, *words):
        quoted = " ".join("'" + w + "'" for w in words)
        script = f"compopt() {{ :; }}; . {out}/bash/pintle; COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; _pintle; printf '%s\\n' \"${{COMPREPLY[@]}}\""
        found, errors = shell("bash", "--norc", "-c", script, cwd=self.place)
        self.assertEqual(errors, "")
        return sorted(w for w in found if w)

    def test_there_are_commands(self):
        self.assertGreater(len(commands), 10)
        self.assertIn("--set", options("run"))

    def test_pages_have_every_command_and_option(self):
        page = (out / "man/pintle.1").read_text()
        for command in commands:
            self.assertIn(command, page)
            own = (out / f"man/pintle-{command}.1").read_text().replace("\\-", "-")
            for option in options(command):
                self.assertIn(f"\\fB{option}\\fR", own)

    @unittest.skipUnless(shutil.which("groff"), "there is no groff")
    def test_pages_are_pages(self):
        for page in sorted((out / "man").iterdir()):
            done = subprocess.run(["groff", "-Kutf8", "-man", "-Tutf8", "-ww", "-z", page], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""), page.name)

    def test_bash(self):
        self.assertEqual(self.bash("pintle", "kin"), ["kinematics"])
        self.assertEqual(self.bash("pintle", "run", "--rep"), ["--report"])
        self.assertEqual(self.bash("pintle", "run", ""), ["a scene.yaml", "other.pintle.yaml", "runs"])
        self.assertEqual(self.bash("pintle", "run", "--out", ""), ["runs"])
        self.assertEqual(self.bash("pintle", "report", ""), ["runs"])
        self.assertEqual(self.bash("pintle", "merge", ""), ["runs"])
        self.assertEqual(self.bash("pintle", "sweep", "--sh"), ["--shard"])
        self.assertEqual(self.bash("pintle", "run", "--set", ""), [])
        for command in commands:
            self.assertLessEqual(set(options(command)), set(self.bash("pintle", command, "--")), command)

    @unittest.skipUnless(shutil.which("fish"), "there is no fish")
    def test_fish(self):
        def fish(line):
            found, errors = shell("fish", "--no-config", "-c", f"source {out}/fish/pintle.fish; complete -C '{line}'", cwd=self.place)
            self.assertEqual(errors, "")
            return [w.partition("\t")[0] for w in found if w]

        self.assertEqual(fish("pintle kin"), ["kinematics"])
        self.assertEqual(fish("pintle run --rep"), ["--report"])
        self.assertIn("other.pintle.yaml", fish("pintle run oth"))
        self.assertEqual(fish("pintle report "), ["runs/"])
        for command in commands:
            self.assertLessEqual(set(options(command)), set(fish(f"pintle {command} --")), command)

    @unittest.skipUnless(shutil.which("zsh"), "there is no zsh")
    def test_zsh(self):
        _, errors = shell("zsh", "-n", str(out / "zsh/_pintle"), cwd=self.place)
        self.assertEqual(errors, "")
        specs = (out / "zsh/_pintle").read_text()
        for command in commands:
            self.assertRegex(specs, rf"(?m)^    '{command}:")
            own = re.search(rf"(?ms)^    {command}\) (.*?) ;;$", specs)[1]
            for option in options(command):
                self.assertIn(f"{option}[", own)


if __name__ == "__main__":
    unittest.main()
