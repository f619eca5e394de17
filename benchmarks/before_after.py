"""What work costs before and after a change: figures of two programs, each with the aim that was set for it. Every time is the processor
time of a whole process, user and system. The old and the new program run in turn; times are medians, and a ratio is the median over the
pairs. Counts beside the times are from run.json (evaluations, factorizations, steps) and from callgrind (instructions).

    python3 benchmarks/before_after.py OLD/pintle NEW/pintle                     prints; --only NAME ... takes the groups named
    python3 benchmarks/before_after.py OLD/pintle NEW/pintle --write             writes the tables of docs/speed.md
"""

import argparse
import json
import math
import os
import re
import resource
import shutil
import statistics
import subprocess
import tempfile
from pathlib import Path

root = Path(__file__).resolve().parents[1]
page = root / "docs" / "speed.md"
limit = 300  # [s] processor time of a process, after which it is ended
old, new = 0, 1
environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}


# ---- scenes: YAML reads JSON, so they are written as dictionaries ----

clearance = {"radial": "clearance", "bearing radius": "10 mm", "bearing": "slider",
             "normal": {"lankarani-nikravesh": {"restitution": 0.9, "young": "207 GPa", "poisson": 0.3}}}
rigid_coupler = {"rigid": {"mass": 0.21, "inertia": 2.5e-4}, "points": {"A": ["-60 mm", 0], "B": ["60 mm", 0]}}


def slider_crank(until, gap=True, coupler=rigid_coupler, every="1 ms", **run):
    """Of Ebrahimi, Salahshoor and Moradi (2017), the crank free from 150 rad/s; no frames."""
    pin = {"revolute": ["coupler.B", "slider.P"], **({"clearance": clearance} if gap else {})}
    return {"gravity": [0, -9.81], "parameters": {"clearance": "0.01 mm"},
            "bodies": {"crank": {"rigid": {"mass": 0.3, "inertia": 1e-4}, "points": {"O": ["-25 mm", 0], "A": ["25 mm", 0]}},
                       "coupler": coupler, "slider": {"rigid": {"mass": 0.14, "inertia": 1e-4}, "points": {"P": [0, 0]}}},
            "joints": {"main bearing": {"revolute": ["ground", "crank.O"]}, "crank pin": {"revolute": ["crank.A", "coupler.A"]},
                       "gudgeon pin": pin, "guide": {"prismatic": ["ground", "slider.P"]}},
            "start": {"crank": {"angle": 0, "speed": 150}}, "run": {"until": until, **run}, "output": {"every": every, "frames": 0}}


def beam_coupler(shapes, **more):
    return {"beam": {"from": "A", "to": "B", "section": {"circle": "10 mm"}, "mass": "0.21 kg", "young": "207 GPa", "poisson": 0.3,
                     "theory": "euler", "rotary inertia": False, "elements": 16},
            "points": {"A": [0, 0], "B": ["120 mm", 0]}, "modes": {"frame": "chord", "craig-bampton": {"count": shapes}}, **more}


def chain(links, until, **run):
    """Of rigid links in a straight line, hung at one end."""
    bodies = {f"l{i}": {"rigid": {"mass": 1, "inertia": 0.01}, "points": {"A": [0, 0], "B": [0.1, 0]}, "pose": {"at": [0.1 * i, 0]}}
              for i in range(links)}
    ends = ["ground"] + [f"l{i}.B" for i in range(links)]
    joints = {f"p{i}": {"revolute": [ends[i], f"l{i}.A"]} for i in range(links)}
    return {"gravity": [0, -9.81], "bodies": bodies, "joints": joints, "run": {"until": until, **run},
            "output": {"every": until, "frames": 0}}


def four_bar(until, **run):
    """With a coupler cut into four pieces, driven up to 600 rpm."""
    crank = {"rigid": {"mass": 0.4, "inertia": 5e-4}, "points": {"A": [0, 0], "B": ["60 mm", 0]}, "pose": {"angle": "60 deg"}}
    coupler = {"beam": {"from": "B", "to": "C", "section": {"rectangle": ["4 mm", "20 mm"]}, "elements": 16, "pieces": 4,
                        "young": "70 GPa", "poisson": 0.33, "density": "2700 kg/m^3"},
               "points": {"B": [0, 0], "C": ["240 mm", 0]}, "modes": {"frame": "chord", "craig-bampton": {"count": 0}},
               "damping": {"ratios": 0.01}, "pose": {"at": ["30 mm", "52 mm"], "angle": "20 deg"}}
    rocker = {"rigid": {"mass": 0.5, "inertia": 2e-3, "center": ["90 mm", 0]}, "points": {"D": [0, 0], "C": ["180 mm", 0]},
              "pose": {"at": ["0.28 m", 0], "angle": "100 deg"}}
    return {"gravity": [0, -9.81], "ground": {"points": {"A": [0, 0], "D": ["0.28 m", 0]}},
            "bodies": {"crank": crank, "coupler": coupler, "rocker": rocker},
            "joints": {"A": {"revolute": ["ground.A", "crank.A"]}, "B": {"revolute": ["crank.B", "coupler.B"]},
                       "C": {"revolute": ["coupler.C", "rocker.C"]}, "D": {"revolute": ["ground.D", "rocker.D"]}},
            "drivers": {"motor": {"angle": ["ground", "crank"], "law": "60 deg + 600 rpm*if(t < 50 ms, t^2/(100 ms), t - 25 ms)"}},
            "run": {"until": until, **run}, "output": {"every": "1 ms", "frames": 0}}


def spin_up(**run):
    """Of Simo and Vu-Quoc (1986): from rest to 6 rad/s in 15 s, until 20 s."""
    blade = {"beam": {"from": "A", "to": "B", "theory": "euler", "rotary inertia": False, "elements": 40, "young": 2.8e7, "poisson": 0,
                      "density": 1.2, "section": {"area": 1, "second moment": 5e-4}},
             "points": {"A": [0, 0], "B": [10, 0]}, "modes": {"frame": "mean axes", "craig-bampton": {"count": 4}}, "stiffening": "axial"}
    law = "if(t < 15, 0.4*(t^2/2 + (15/(2*pi))^2*(cos(2*pi*t/15) - 1)), 6*(t - 7.5))"
    return {"bodies": {"blade": blade}, "joints": {"axle": {"revolute": ["ground", "blade.A"]}},
            "drivers": {"motor": {"angle": ["ground", "blade.A"], "law": law}}, "run": {"until": 20, **run},
            "output": {"every": 0.1, "frames": 0}}


def plate():
    """A free link of 42 320 triangles, 171 306 degrees of freedom."""
    grid = {"corners": [[0, -0.05], [1, -0.05], [1, 0.05], [0, 0.05]], "cells": [460, 46]}
    return {"bodies": {"link": {"plate": {"thickness": "10 mm", "young": "207 GPa", "poisson": 0.3, "density": "7850 kg/m^3",
                                          "element": "triangle6", "grid": grid}}}}


# ---- measuring ----


class Refused(Exception):
    """Why a program did not do what it was asked."""


def process(command):
    """Processor time [s], peak memory [MB], what it printed."""
    ends = lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit))
    with tempfile.TemporaryFile("w+") as said:
        child = subprocess.Popen(list(map(str, command)), stdout=said, stderr=subprocess.STDOUT, env=environment, preexec_fn=ends)
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        said.seek(0)
        text = said.read()
    time = used.ru_utime + used.ru_stime
    if time >= limit:
        raise Refused(f"not done after {limit} s")
    if child.returncode:
        words = [line for line in text.splitlines() if not line.startswith("==")]  # those are valgrind's
        raise Refused(f"code {child.returncode}: {' '.join(words)}"[:120])
    return time, used.ru_maxrss / 1024, text


class Bench:
    def __init__(self, programs, place):
        self.programs, self.place, self.number, self.spent = programs, place, 0, 0

    def command(self, program, scene, *options, verb="run"):
        self.number += 1
        file, out = self.place / f"{self.number}.yaml", self.place / f"out{self.number}"
        file.write_text(json.dumps(scene))
        results = [] if verb == "check" else ["--quiet", "--out", out]
        return [self.programs[program], verb, file, *options, *results], out

    def do(self, program, scene, *options, verb="run"):
        """Processor time, peak memory and the counts of a run."""
        command, out = self.command(program, scene, *options, verb=verb)
        time, peak, _ = process(command)
        self.spent += time
        counts = json.loads((out / "run.json").read_text())["counts"] if verb == "run" else {}
        shutil.rmtree(out, ignore_errors=True)
        return time, peak, counts

    def instructions(self, program, scene, *options):
        command, out = self.command(program, scene, *options)
        _, _, said = process(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *command])
        return int(re.search(r"Collected : (\d+)", said)[1]), json.loads((out / "run.json").read_text())["counts"]

    def compare(self, sample, pairs=0, only=(old, new)):
        """`sample(program)` gives figures by name; both programs in turn: 7 pairs, 3 if one takes over 5 s, 1 if over 60 s. Returns for each
        program the medians of its figures, or why there are none, and the medians of new over old."""
        figures, longest, done = ([], []), 0, 0
        failed = {program: "not run" for program in {old, new} - set(only)}
        while len(failed) < 2 and done < (pairs or (1 if longest > 60 else 3 if longest > 5 else 7)):
            for program in (old, new):
                if program in failed:
                    continue
                self.spent = 0
                try:
                    figures[program].append(sample(program))
                except Refused as why:
                    failed[program] = str(why)
                longest = max(longest, self.spent)
            done += 1
        median = lambda values: {name: statistics.median(v[name] for v in values) for name in values[0]}
        ratios = [{name: b[name] / a[name] if a[name] else math.nan for name in a} for a, b in zip(*figures)]
        return [failed[p] if p in failed else median(figures[p]) for p in (old, new)], {} if failed else median(ratios)


def shown(value, scale, unit):
    if isinstance(value, str):
        return value
    number = f"{value * scale:,.0f}".replace(",", " ") if abs(value * scale) >= 1000 else f"{value * scale:.3g}"
    return f"{number} {unit}".strip()


def row(compared, name, what, unit="", scale=1.0, aim="", met=None):
    """A row of a table; `met(after, ratio)` judges the aim."""
    before, after = (figures if isinstance(figures, str) else figures[name] for figures in compared[0])
    ratio = compared[1].get(name, math.nan)
    unknown = isinstance(after, str) or met is tenth and math.isnan(ratio)
    verdict = "" if met is None else "unknown" if unknown else "yes" if met(after, ratio) else "no"
    share = "–" if math.isnan(ratio) else f"{ratio:.3g}"
    return f"| {what} | {aim} | {shown(before, scale, unit)} | {shown(after, scale, unit)} | {share} | {verdict} |"


under = lambda most: lambda after, _: after <= most
tenth = lambda _, ratio: ratio <= 0.1


# ---- the aims, a function for each group: the rows of its table, and what needs explaining ----


def rows(bench):
    many, few = slider_crank(1, gap=False), slider_crank(1, gap=False, every="100 ms")
    each = lambda more, less: (more - less) / 990

    def sample(program):
        (a, _, less), (b, _, more) = bench.do(program, few), bench.do(program, many)
        return {"time": each(b, a), **{n: each(more[n], less[n]) for n in ("evaluations", "factorizations")}}

    def counted(program):
        return {"instructions": each(bench.instructions(program, many)[0], bench.instructions(program, few)[0])}

    times, counts = bench.compare(sample), bench.compare(counted, 1)
    return [row(times, "time", "processor time of a row", "µs", 1e6), row(counts, "instructions", "instructions of a row"),
            row(times, "evaluations", "evaluations a row", aim="0", met=under(0.01)),
            row(times, "factorizations", "factorizations a row", aim="0", met=under(0.01))], \
        "The ideal slider-crank by defaults, 1 s, with 1000 rows and with ten. A row should cost what writing it costs. The counts are those of " \
        "`run.json`, which leave out what a program computes for a row without counting it; instructions include all."


def frames(bench):
    scene = slider_crank(0.005)
    with_frames = lambda n: ["--set", f"output.frames={n}"]

    def sample(program):
        few, many = (bench.do(program, scene, *with_frames(n))[0] for n in (5, 205))
        return {"time": (many - few) / 200}

    def counted(program):
        few, many = (bench.instructions(program, scene, *with_frames(n))[0] for n in (5, 55))
        return {"instructions": (many - few) / 50}

    return [row(bench.compare(sample), "time", "processor time of a frame", "ms", 1e3, "a tenth", tenth),
            row(bench.compare(counted, 1), "instructions", "instructions of a frame", "million", 1e-6, "a tenth", tenth)], \
        "The slider-crank with clearance, 5 ms, with 205 frames and with five."


def start(bench):
    scene = slider_crank(1e-6, gap=False, every=1e-6)
    times = bench.compare(lambda program: {"time": bench.do(program, scene)[0]}, 15)
    counts = bench.compare(lambda program: {"instructions": bench.instructions(program, scene)[0]}, 1)
    return [row(times, "time", "processor time", "ms", 1e3, "4 ms", under(0.004)),
            row(counts, "instructions", "instructions", "million", 1e-6)], "The smallest run: the ideal slider-crank for 1 µs, without frames; 15 pairs."


def reading(bench):
    lines = []
    for links in (1000, 10_000, 100_000):
        times = bench.compare(lambda program: dict(zip(("time", "peak"), bench.do(program, chain(links, 0.001), verb="check"))))
        lines += [row(times, "time", f"`check` of {links} links, processor time", "s", 1, "a tenth", tenth),
                  row(times, "peak", "… peak memory", "MB")]
    run = bench.compare(lambda program: dict(zip(("time", "peak"), bench.do(program, chain(100_000, 0.001)))), 1, only=(new,))
    return lines + [row(run, "time", "`run` of 100 000 links for 1 ms, processor time", "s", 1, "10 s", under(10)),
                    row(run, "peak", "… peak memory", "MB", 1, "1000 MB", under(1000))], \
        "Straight chains, until 1 ms. `check` includes its trial run."


def kernel(bench):
    scenes = lambda *untils: (slider_crank(until, every=until, method="dopri5", tolerance=1e-8) for until in untils)
    each = lambda a, few, b, many: (b - a) / (many["evaluations"] - few["evaluations"])

    def sample(program):
        (a, _, few), (b, _, many) = (bench.do(program, scene) for scene in scenes(0.05, 1.05))
        return {"time": each(a, few, b, many)}

    def counted(program):
        return {"instructions": each(*(x for scene in scenes(0.002, 0.012) for x in bench.instructions(program, scene)))}

    return [row(bench.compare(sample), "time", "time of an evaluation", "ns", 1e9, "150 ns", under(150e-9)),
            row(bench.compare(counted, 1), "instructions", "instructions of an evaluation")], \
        "The slider-crank with clearance, `dopri5` at a tolerance of 1e-8: difference of 1.05 s and 0.05 s (instructions: 12 and 2 ms) over the " \
        "difference in evaluations. It contains what a step does besides evaluating."


def chains(bench):
    def step(program, links, spans):
        runs = [bench.do(program, chain(links, until, method="generalized-alpha")) for until in spans]
        steps = runs[1][2]["steps"] - runs[0][2]["steps"]
        return [(runs[1][0] - runs[0][0]) / steps] + [(runs[1][2][n] - runs[0][2][n]) / steps for n in ("factorizations", "evaluations")]

    def growth(less, more):
        def sample(program):
            a, b = step(program, *less)[0], step(program, *more)[0]
            return {"time": b, "slope": math.log10(b / a)}
        return sample

    thousand, ten, hundred = (1000, (0.005, 0.055)), (10_000, (0.005, 0.015)), (100_000, (0.001, 0.003))
    sample = lambda program: dict(zip(("time", "factorizations", "evaluations"), step(program, *thousand)))
    times, grown, most = bench.compare(sample), bench.compare(growth(thousand, ten), 3), bench.compare(growth(ten, hundred), 1, only=(new,))
    return [row(times, "time", "a step of 1000 links", "ms", 1e3, "0.5 ms", under(0.0005)),
            row(times, "factorizations", "factorizations a step"), row(times, "evaluations", "evaluations a step"),
            row(grown, "time", "a step of 10 000 links", "ms", 1e3),
            row(grown, "slope", "slope of time over links, 10³ to 10⁴", aim="1.05", met=under(1.05)),
            row(most, "time", "a step of 100 000 links", "ms", 1e3), row(most, "slope", "slope, 10⁴ to 10⁵", aim="1.05", met=under(1.05))], \
        "A straight chain that falls from rest, `generalized-alpha`: difference of two lengths of run over the difference in steps."


def modes(bench):
    def of(**scenes):
        def sample(program):
            runs = {name: bench.do(program, scene) for name, scene in scenes.items()}
            return {f"{name} {what}": value for name, (time, _, counts) in runs.items()
                    for what, value in (("time", time), ("evaluations", counts["evaluations"]))}
        return sample

    def over(sample, a, b):
        def both(program):
            figures = sample(program)
            return {**figures, "over": figures[f"{a} time"] / figures[f"{b} time"]}
        return both

    crank = lambda shapes, tolerance, **more: slider_crank(1, coupler=beam_coupler(shapes, **more), tolerance=tolerance)
    shapes = bench.compare(over(of(eight=crank(8, 1e-6), sixteen=crank(16, 1e-6)), "sixteen", "eight"))
    axial = bench.compare(of(axial=crank(8, 1e-6, stiffening="axial")))
    damped = {"damping": {"ratios": 0.02}}
    stiff = bench.compare(over(of(sixteen=crank(16, 1e-4, **damped), two=crank(2, 1e-4, **damped)), "sixteen", "two"))
    pieces = bench.compare(over(of(auto=four_bar(0.1), alpha=four_bar(0.1, method="generalized-alpha")), "auto", "alpha"))
    spin = bench.compare(over(of(auto=spin_up(), alpha=spin_up(method="generalized-alpha")), "auto", "alpha"))
    cost = lambda compared, name, what, *aim: [row(compared, f"{name} time", what, "s", 1, *aim), row(compared, f"{name} evaluations", "… evaluations")]
    return [*cost(shapes, "eight", "8 shapes, 1 s", "0.5 s", under(0.5)), *cost(axial, "axial", "8 shapes with `axial`, 1 s", "0.5 s", under(0.5)),
            *cost(shapes, "sixteen", "16 shapes, 1 s"), row(shapes, "over", "16 shapes over 8"),
            *cost(stiff, "sixteen", "16 shapes with 2 % damping, tolerance 1e-4"), *cost(stiff, "two", "2 shapes, the same"),
            row(stiff, "over", "16 shapes over 2", aim="2", met=under(2)),
            *cost(pieces, "auto", "four-bar with a coupler in 4 pieces, 0.1 s, `auto`"), *cost(pieces, "alpha", "… `generalized-alpha`"),
            row(pieces, "over", "`auto` over `generalized-alpha`", aim="1", met=under(1)),
            *cost(spin, "auto", "axial spin-up, `auto`"), *cost(spin, "alpha", "… `generalized-alpha`"),
            row(spin, "over", "`auto` over `generalized-alpha`", aim="1", met=under(1))], \
        "The paper's slider-crank with a clearance of 0.01 mm and its coupler as 16 beam elements with Craig-Bampton shapes, undamped where no " \
        "damping is named, at a tolerance of 1e-6 where none is; then a four-bar driven up to 600 rpm, and the spin-up of Simo and Vu-Quoc."


def eigenmodes(bench):
    def sample(program):
        time, peak, _ = bench.do(program, plate(), "--count", "20", "--frames", "0", verb="modes")
        return {"time": time, "peak": peak}

    found = bench.compare(sample)
    return [row(found, "time", "`modes --count 20`, processor time", "s"), row(found, "peak", "… peak memory", "MB")], \
        "A free plate of 171 306 degrees of freedom on a regular grid: the whole process, which also assembles and writes. The aim is 0.6 of ARPACK " \
        "with CHOLMOD, with which this page does not compare; neither program writes how many solves it needed."


def sweep(bench):
    cases = 100

    def sample(program):
        bench.number += 1
        scene, study, out = (bench.place / f"{kind}{bench.number}{end}" for kind, end in (("scene", ".yaml"), ("study", ".yaml"), ("sweep", "")))
        scene.write_text(json.dumps(slider_crank(0.05)))
        study.write_text(json.dumps({"scene": scene.name, "measure": {"peak": "peak force at gudgeon pin", "lost": "energy lost at gudgeon pin"},
                                     "sweep": {"grid": {"clearance": {"from": "0.01 mm", "to": "0.5 mm", "count": cases, "scale": "log"}}}}))
        time, _, _ = process([bench.programs[program], "sweep", study, "--quiet", "--threads", "1", "--out", out])
        bench.spent += time
        return {"cases": cases / time}

    return [row(bench.compare(sample), "cases", "cases a second and core", aim="400", met=lambda after, _: after >= 400)], \
        f"{cases} clearances from 0.01 to 0.5 mm, 50 ms each, by defaults; the whole process in one thread."


def totals(bench):
    lines = []
    for name, scene in (("ideal", slider_crank(1, gap=False)), ("with clearance", slider_crank(1))):
        for drawn in (0, 101):
            def sample(program):
                time, _, counts = bench.do(program, scene, "--set", f"output.frames={drawn}")
                return {"time": time, "evaluations": counts["evaluations"]}
            both = bench.compare(sample)
            lines.append(row(both, "time", f"{name}, {drawn} frames", "ms", 1e3))
        lines.append(row(both, "evaluations", "… evaluations"))
    return lines, "The rigid slider-crank by defaults, 1 s, 1000 rows, whole process. The old program drew no frames by default, the new one draws 101."


groups = {"rows": ("Rows", rows), "frames": ("Frames", frames), "start": ("Start", start), "kernel": ("Kernel", kernel),
          "totals": ("Whole runs", totals), "sweep": ("Sweep", sweep), "modes": ("Shapes", modes), "chains": ("Chains", chains),
          "eigenmodes": ("Eigenmodes", eigenmodes), "reading": ("Reading", reading)}

mark = "<!-- What follows is written by benchmarks/before_after.py --write. -->\n"
table = "| | aim | before | after | ratio | met |\n|---|---|---|---|---|---|\n"


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("old", type=Path)
    options.add_argument("new", type=Path)
    options.add_argument("--only", nargs="+", choices=groups, default=list(groups))
    options.add_argument("--write", action="store_true")
    chosen = options.parse_args()
    text = page.read_text().split(mark)[0] + mark
    with tempfile.TemporaryDirectory() as place:
        bench = Bench([chosen.old.resolve(), chosen.new.resolve()], Path(place))
        for name in chosen.only:
            title, measure = groups[name]
            lines, explained = measure(bench)
            part = f"\n## {title}\n\n{explained}\n\n{table}" + "".join(f"{line}\n" for line in lines)
            print(part, flush=True)
            text += part
            if chosen.write:  # after each group, so that nothing is lost
                page.write_text(text)


if __name__ == "__main__":
    main()
