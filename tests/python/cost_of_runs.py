"""What a run from Python costs beside a case of `pintle sweep`: computing times of both whole processes, in turn, the same cases, one thread.

PYTHONPATH=build/release/python PINTLE_PROGRAM=build/release/app/pintle python3 tests/python/cost_of_runs.py [RUNS [PAIRS]]"""

import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from common import examples, program

scene, until, measured = examples / "slider_crank_clearance.yaml", "5 ms", "gudgeon pin.normal"


def clearances(count):
    return [1e-5 * (1 + k / count) for k in range(count)]


def by_python(count):
    import pintle

    worn = pintle.load(scene, {"run.until": until})
    return [float(worn.set({"clearance": c}).run()[measured].max()) for c in clearances(count)]


def seconds(command):
    """Of computing, the operating system's for it included."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True, check=True, env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime, done.stdout


def pair(count):
    with tempfile.TemporaryDirectory() as place:
        study = Path(place) / "study.yaml"
        study.write_text(json.dumps({"scene": str(scene), "set": {"run.until": until}, "measure": {"peak": "peak force at gudgeon pin"},
                                     "sweep": {"grid": {"clearance": clearances(count)}}}))
        swept, _ = seconds([program, "sweep", str(study), "--threads", "1", "--quiet", "--out", f"{place}/out"])
        ran, told = seconds([sys.executable, __file__, "by_python", str(count)])
        assert int(told) == count
        return ran, swept


if __name__ == "__main__":
    if sys.argv[1:2] == ["by_python"]:
        print(len(by_python(int(sys.argv[2]))))
    else:
        count, pairs = (int(n) for n in (sys.argv[1:] + ["1000", "5"][len(sys.argv) - 1:]))
        times = [pair(count) for _ in range(pairs)]
        for ran, swept in times:
            print(f"{1e3 * ran / count:.3f} ms a run from Python, {1e3 * swept / count:.3f} ms a case of sweep: {ran / swept:.3f}")
        print(f"median of the ratios: {statistics.median(ran / swept for ran, swept in times):.3f}")
