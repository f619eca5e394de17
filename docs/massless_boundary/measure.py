#!/usr/bin/env python3
"""Measures docs/massless_boundary.md: measure.py PINTLE [--times N]. Writes error.svg beside itself and prints the table."""
import argparse
import json
import pathlib
import subprocess
import tempfile

import matplotlib
matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "pintle"
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

HERE = pathlib.Path(__file__).parent
SCENE = HERE.parents[1] / "examples/massless_boundary.yaml"
ALL = "frame: chord, keep: all"
FAMILIES = {
    "natural modes": "frame: chord, count: {n}",
    "Craig-Bampton": "frame: chord, craig-bampton: {{count: {n}}}",
    "free": "frame: chord, free: {{count: {n}}}",
    "massless, Craig-Bampton": "boundary: massless, frame: {{tangent: A}}, craig-bampton: {{count: {n}}}",
    "massless, free": "boundary: massless, frame: chord, free: {{count: {n}}}",
}
MARKS = dict(zip(FAMILIES, "v^so*"))
COUNTS = 2, 4, 8, 16
span = "run.until=1 ms", "output.every=1 us", "output.frames=0"  # the first two contacts


def run(program, out, modes, *more):
    said = ["--set", "bodies.coupler.modes={" + modes + "}"]
    for one in more:
        said += ["--set", one]
    subprocess.run([program, "run", SCENE, "-q", "-o", out, *said], check=True, stderr=subprocess.DEVNULL)
    return out


def read(out):
    rows = pd.read_csv(out / "trajectory.csv")
    first = pd.read_csv(out / "events.csv").iloc[0]
    told = json.loads((out / "run.json").read_text())
    return {
        "force": rows["gudgeon pin.normal [N]"].to_numpy(), "speed": rows["slider.vx [m/s]"].to_numpy(),
        "peak": first["peak force [N]"], "lasts": first["end [s]"] - first["begin [s]"], "lost": first["energy lost [J]"],
        "steps": told["counts"]["steps"], "evaluations": told["counts"]["evaluations"], "seconds": told["timings [s]"]["integration"],
        "unexplained": abs(told["unexplained [J]"]) / told["energy in play [J]"],
        "highest": max(told["flexible bodies"][0]["frequencies [Hz]"]),
    }


def root_mean_square(x):
    return np.sqrt(np.mean(np.square(x)))


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("program")
    options.add_argument("--times", type=int, default=3)
    options.add_argument("--stiffening", default="none")
    asked = options.parse_args()
    same = "bodies.coupler.stiffening=" + asked.stiffening
    variants = [(family, n, words.format(n=n)) for family, words in FAMILIES.items() for n in COUNTS]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        truth = read(run(asked.program, folder / "truth", ALL, same, *span))
        found = {}
        for turn in range(asked.times):  # turn about
            for family, n, words in variants:
                got = read(run(asked.program, folder / f"{family} {n} {turn}", words, same, *span))
                found.setdefault((family, n), []).append(got)
    lines = ["| shapes | count | highest [Hz] | steps | evaluations | time [ms] | peak force | duration | energy lost | force | speed | unexplained |",
             "|---|---|---|---|---|---|---|---|---|---|---|---|"]
    points = {}
    for (family, n), all_of in found.items():
        r = all_of[0]
        seconds = np.median([one["seconds"] for one in all_of])
        off = lambda what: r[what] / truth[what] - 1
        force = root_mean_square(r["force"] - truth["force"]) / root_mean_square(truth["force"])
        speed = np.abs(r["speed"] - truth["speed"]).max()
        points.setdefault(family, []).append((1e3 * seconds, force))
        lines.append(f"| {family} | {n} | {r['highest']:.3g} | {r['steps']} | {r['evaluations']} | {1e3 * seconds:.3g} | {off('peak'):+.2%} | "
                     f"{off('lasts'):+.2%} | {off('lost'):+.2%} | {force:.2%} | {speed:.1e} m/s | {r['unexplained']:.0e} |")
    end = "" if asked.stiffening == "none" else "_" + asked.stiffening
    figure, axes = plt.subplots(figsize=(6, 4))
    for family, of in points.items():
        x, y = np.array(of).T
        axes.loglog(x, y, marker=MARKS.get(family, "D"), label=family if family != "all" else "all 48 shapes")
    axes.set(xlabel="time [ms]", ylabel="error of the contact force, r.m.s.")
    axes.legend(fontsize=8)
    axes.grid(which="both", alpha=0.3)
    figure.tight_layout()
    figure.savefig(HERE / f"error{end}.svg", metadata={"Date": None})
    print("\n".join(lines))


if __name__ == "__main__":
    main()
