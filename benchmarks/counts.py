"""What work costs in counts, which do not depend on how busy the machine is: instructions of the program under callgrind, and what it
allocates. Differences of two runs give what one evaluation, row, frame or link adds.

    python3 benchmarks/counts.py build/release/app/pintle            compares with docs/counts.md; code 1 if a count grew by over 10 %
    python3 benchmarks/counts.py build/release/app/pintle --write    writes docs/counts.md
"""

import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

root = Path(__file__).resolve().parents[1]
page = root / "docs" / "counts.md"
grown = 1.10
rigid, flexible = root / "examples" / "slider_crank_clearance.yaml", root / "examples" / "flexible_slider_crank.yaml"
driven = ["--set", "drivers.motor={angle: [ground, crank], law: 150 rad/s*t}"]
impacts = ["--set", "joints.gudgeon pin.clearance={radial: clearance, bearing radius: 10 mm, bearing: slider, model: impact, restitution: 0.5}"]
quiet = ["--set", "output.frames=0", "--set", "output.every=1 ms"]


def under(tool, command):
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run(["valgrind", *tool, *map(str, command)], capture_output=True, text=True, env=environment)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))} ended with code {done.returncode}: {done.stdout[-500:]}{done.stderr[-500:]}")
    return done


def instructions(command):
    said = under(["--tool=callgrind", "--callgrind-out-file=/dev/null"], command).stderr
    return int(re.search(r"Collected : (\d+)", said)[1])


def allocated(command):
    """Allocations and bytes."""
    found = re.search(r"total heap usage: ([\d,]+) allocs, [\d,]+ frees, ([\d,]+) bytes", under(["--tool=memcheck"], command).stderr)
    return [int(number.replace(",", "")) for number in found.groups()]


class Counts:
    def __init__(self, program, place):
        self.program, self.place, self.runs, self.figures = program, place, 0, {}

    def run(self, scene, *options):
        """Its command, and the folder of its results."""
        self.runs += 1
        out = self.place / f"run{self.runs}"
        return [self.program, "run", scene, "--quiet", *options, "--out", out], out

    def each(self, name, scene, common, few, many, number):
        """Instructions that one more of a kind adds; `number` reads from run.json how many there were."""
        total, of = [], []
        for options in (few, many):
            command, out = self.run(scene, *common, *options)
            total.append(instructions(command))
            of.append(number(json.loads((out / "run.json").read_text()), out))
        self.figures[name] = round((total[1] - total[0]) / (of[1] - of[0]))

    def evaluation(self, name, scene, *options):
        spans = [["--set", f"run.until={ms} ms"] for ms in (2, 12)]
        self.each(f"an evaluation: {name}", scene, [*quiet, *options], *spans, lambda run, _: run["counts"]["evaluations"])

    def chain(self, links):
        bodies = {f"l{i}": {"rigid": {"mass": 1, "inertia": 0.01}, "points": {"A": [0, 0], "B": [0.1, 0]}} for i in range(links)}
        ends = ["ground"] + [f"l{i}.B" for i in range(links)]
        joints = {f"p{i}": {"revolute": [ends[i], f"l{i}.A"]} for i in range(links)}
        file = self.place / f"chain{links}.yaml"
        file.write_text(json.dumps({"gravity": [0, -9.81], "bodies": bodies, "joints": joints, "run": {"until": 1}}))
        return [self.program, "check", file]

    def all(self):
        rows = lambda _, out: sum(1 for _ in open(out / "trajectory.csv"))
        frames = lambda _, out: sum(1 for _ in out.rglob("*.vt*"))
        self.figures["start: instructions"] = instructions([self.program, "--version"])
        self.figures["start: allocations"], self.figures["start: bytes allocated"] = allocated([self.program, "--version"])
        self.evaluation("slider-crank with a clearance", rigid)
        self.evaluation("the same, driven", rigid, *driven)
        self.evaluation("the same, with rigid impacts", rigid, *driven, *impacts)
        self.evaluation("slider-crank with a flexible coupler", flexible)
        self.each("a row", rigid, ["--set", "run.until=5 ms", "--set", "output.frames=0"], ["--set", "output.every=500 us"],
                  ["--set", "output.every=5 us"], rows)
        self.each("a frame", rigid, ["--set", "run.until=5 ms", "--set", "output.every=1 ms"], ["--set", "output.frames=5"],
                  ["--set", "output.frames=105"], frames)
        few, many = 100, 1100
        self.figures["checking a link of a chain: instructions"] = round((instructions(self.chain(many)) - instructions(self.chain(few))) / (many - few))
        more = [b - a for a, b in zip(allocated(self.chain(few)), allocated(self.chain(many)))]
        self.figures["checking a link of a chain: allocations"] = round(more[0] / (many - few))
        self.figures["checking a link of a chain: bytes allocated"] = round(more[1] / (many - few))
        return self.figures


def spaced(number):
    return f"{number:,}".replace(",", " ")


def known():
    return {name: int(number.replace(" ", "")) for name, number in re.findall(r"(?m)^\| ([^|]+) \| ([\d ]+) \|$", page.read_text())}


def write(figures):
    rows = "".join(f"| {name} | {spaced(number)} |\n" for name, number in figures.items())
    page.write_text("""# Counts

What work costs in counts, which do not depend on how busy the machine is. `python3 benchmarks/counts.py build/release/app/pintle` counts
instructions and allocations under valgrind, as differences of two runs where a thing is done many times, and fails if one has grown by more
than a tenth; `--write` writes this page. Evaluations include all that a step does besides. Times: [performance](performance.md).

| | count |
|---|---|
""" + rows)


def main(program, *options):
    with tempfile.TemporaryDirectory() as place:
        figures = Counts(program, Path(place)).all()
    before = known() if page.exists() else {}
    for name, number in figures.items():
        ratio = f"{number / before[name]:.3f} of the page's" if before.get(name) else "not on the page"
        print(f"{name:52} {spaced(number):>12}  {ratio}")
    if "--write" in options:
        write(figures)
        return 0
    return int(set(figures) != set(before) or any(figures[name] > grown * before[name] for name in figures))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
