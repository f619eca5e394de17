"""What a run from Python costs beside the same case of a sweep: the same cases by `pintle sweep --threads 1` and by a loop in Python,
processor time of each in a process of its own, the least of three. Ends with code 1 if Python costs over 5 % more.

    PYTHONPATH=build/release/python python3 benchmarks/python_runs.py build/release/app/pintle [CASES]
"""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

scene = Path(__file__).resolve().parents[1] / "examples" / "slider_crank_clearance.yaml"


def clearances(cases):
    return [1e-5 + 1e-7 * k for k in range(cases)]


def in_python(cases):
    import pintle

    base = pintle.load(scene).set({"run.until": "5 ms"})
    peaks = []
    for clearance in clearances(cases):
        result = base.set({"clearance": clearance}).run()
        peaks.append(max((i.peak_force for i in result.impacts), default=0))
    print(sum(peaks))


def seconds(command):
    """User and system time of a process."""
    before = os.times()
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    after = os.times()
    return after.children_user - before.children_user + after.children_system - before.children_system, done.stdout


def main(program, cases):
    with tempfile.TemporaryDirectory() as place:
        study = {
            "scene": str(scene), "set": {"run.until": "5 ms"}, "measure": {"peak": "peak force at gudgeon pin"},
            "sweep": {"list": [{"clearance": f"{c} m"} for c in clearances(cases)]},
        }
        file = Path(place) / "study.yaml"
        file.write_text(json.dumps(study))
        swept, looped = [], []
        for k in range(3):
            swept.append(seconds([program, "sweep", str(file), "--threads", "1", "--quiet", "--out", f"{place}/out{k}"])[0])
            took, said = seconds([sys.executable, __file__, "--loop", str(cases)])
            looped.append(took)
        rows = (Path(place) / "out0" / "sweep.csv").read_text().splitlines()
        column = rows[0].split(",").index("peak [N]")
        total = sum(float(row.split(",")[column]) for row in rows[1:])
        assert abs(total - float(said)) <= 1e-12 * total, "the two have not run the same cases"
        ratio = min(looped) / min(swept)
        print(f"{cases} cases: sweep {min(swept):.2f} s, Python {min(looped):.2f} s, {100 * (ratio - 1):+.1f} %")
        return ratio > 1.05


if __name__ == "__main__":
    if sys.argv[1] == "--loop":
        in_python(int(sys.argv[2]))
    else:
        sys.exit(main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 1000))
