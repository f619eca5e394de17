"""Everything that the package does, again and again: no round may keep memory.

python3 tests/python/repeat.py [ROUNDS [PART...]]   counts what is allocated before and after ROUNDS (20), some times;
under valgrind (docs/python.md) it says where what was lost was allocated."""

import ctypes
import gc
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import warnings

plain = {"PYTHONMALLOC": "malloc", "GLIBC_TUNABLES": "glibc.malloc.tcache_count=0:glibc.malloc.arena_max=1", "OPENBLAS_NUM_THREADS": "1"}
if any(os.environ.get(name) != value for name, value in plain.items()):  # blocks in pools and caches count as used
    sys.exit(subprocess.run([sys.executable, *sys.argv], env={**os.environ, **plain}).returncode)

import pintle
from common import examples, pendulum, servo_arm

arm = servo_arm + "run: {until: 0.02 s}\n"


def runs():
    scene = pintle.load(examples / "slider_crank_clearance.yaml", {"run.until": "0.2 ms"})
    result = scene.set({"clearance": "0.02 mm"}).run()
    column = result["gudgeon pin.normal"]
    del result, scene  # the column keeps the run
    assert column.max() > 0
    result = pintle.parse(pendulum).run()
    return result.ledger.data.sum(), result.impacts, result.events, result.info, repr(result), result._repr_html_()


def steps():
    simulation = pintle.parse(arm).simulation()
    while simulation.advance(simulation.t + 0.002):
        simulation["torque"] = 5.886 - 40 * simulation["arm.angle"] - 6 * simulation["arm.speed"]
    left = pintle.parse(arm).simulation()  # and never ended
    left.advance(0.001)
    return simulation.result()["arm.angle"]


def functions():
    return pintle.parse(arm).with_law("servo", lambda speed, t: -0.4 * speed - t, of=["arm.speed", "t"]).run()


def questions():
    pintle.load(examples / "statics_lever.yaml").statics()
    pintle.load(examples / "pid_arm.yaml").linearize(at_rest=True)
    pintle.load(examples / "kinematics_quick_return.yaml", {"run.until": "10 ms"}).kinematics()
    pintle.load(examples / "inverse_four_bar.yaml", {"run.until": "10 ms"}).inverse()
    scene = pintle.parse(pendulum)
    return scene.check(), scene.as_dict(), scene.parameters


def bodies():
    ruler = pintle.load(examples / "modes_beam.yaml", {"bodies.ruler.beam.elements": 4})
    return ruler.modes(count=2).frequencies, ruler.mesh().nodes, ruler.static()["ruler"]["von Mises"]


def studies():
    study = {"scene": str(examples / "pendulum.yaml"), "set": {"run.until": "10 ms"}, "measure": {"lost": "energy lost"},
             "sweep": {"grid": {"run.tolerance": [1e-6, 1e-8]}}}
    pintle.sweep(study, threads=1)
    mount = {"scene": examples / "rubber_mount.yaml", "analysis": "linearize", "equilibrium": True, "measure": {"frequency": "frequency of mode 2"}}
    stiffness = "forces.rubber at rest.stiffness"
    pintle.fit({**mount, "vary": {stiffness: {"from": "50 N/mm", "to": "80 N/mm"}}, "fit": {"starts": 1, "evaluations": 4},
                "goal": {"reach": {"frequency of mode 2": {"to": "12 Hz", "tolerance": "1 Hz"}}}}, threads=1)
    pintle.sensitivity({**mount, "sensitivity": {"parameters": {stiffness: {"uniform": "2 N/mm"}}}}, threads=1)
    pintle.nonlinear({"scene": examples / "nonlinear" / "duffing.yaml", "over": {"gamma": {"from": 0.2, "to": 0.21, "count": 2}},
                      "section": {"every": "2*pi/omega", "record": {"x": "block.x"}, "transient": 1, "returns": 2}}, threads=1)


def tradeoffs():
    return pintle.tradeoff(examples / "studies" / "trade_modes.yaml", repeats=1)


def stopped():
    endless = pintle.parse(pendulum).set({"run.until": "1e5 s", "output.every": "1 s"})
    for call in (endless.run, lambda: endless.linearize(at=1e5)):
        timer = threading.Timer(0.02, os.kill, (os.getpid(), signal.SIGINT))
        try:
            timer.start()
            call()
        except KeyboardInterrupt:
            pass
        timer.join()
        while len(os.listdir("/proc/self/task")) > 1:  # what was stopped has ended
            time.sleep(1e-3)


def errors():
    for raises in (lambda: pintle.parse("bodies: 3"), lambda: pintle.parse(pendulum).set({"bodies.rod.rigid.mass": "1 m"}),
                   lambda: pintle.load("nowhere.yaml"), lambda: pintle.parse(pendulum).run()["no such column"],
                   lambda: pintle.parse(arm).with_law("servo", lambda speed: 1 / 0, of="arm.speed").run()):
        try:
            raises()
        except (pintle.Error, KeyError, ZeroDivisionError):
            continue
        raise AssertionError("an error was expected")


def files():
    with tempfile.TemporaryDirectory() as place:
        result = pintle.parse(pendulum).run()
        result.write(f"{place}/run")
        result.report(f"{place}/page.html")


def frames():
    result = pintle.parse(pendulum).run()
    result.frame()
    matplotlib.pyplot.close(result.plot("rod.angle").figure)


everything = [runs, steps, functions, questions, bodies, studies, tradeoffs, errors, files, stopped]
try:
    import matplotlib
    import pandas  # noqa: F401

    matplotlib.use("Agg")
    import matplotlib.pyplot

    everything.append(frames)
except ImportError:
    pass
slow = {tradeoffs: 4, stopped: 4, frames: 4}  # with so many times fewer rounds


class Heap(ctypes.Structure):
    """Of glibc's mallinfo2."""

    _fields_ = [(name, ctypes.c_size_t)
                for name in "arena ordblks smblks hblks hblkhd usmblks fsmblks uordblks fordblks keepcost".split()]


def allocated():
    sys._clear_type_cache()  # it holds the names of attributes that were asked for, each time another string
    gc.collect()
    libc.mallinfo2.restype = Heap
    heap = libc.mallinfo2()
    return heap.uordblks + heap.hblkhd


def kept(part, rounds):
    """Bytes that the rounds leave allocated, the least of the last three of five goes: what is made once, and what Python keeps for later,
    does not grow in each."""
    goes = [allocated()]
    for _ in range(5):
        for _ in range(rounds):
            part()
        goes.append(allocated())
    return min(after - before for before, after in zip(goes[2:], goes[3:]))


if __name__ == "__main__":
    libc = ctypes.CDLL(None)
    warnings.simplefilter("ignore", pintle.ModelWarning)
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 8
    smallest = 32  # of glibc's blocks [B]: one that each round leaves is at least this
    leaks = False
    for part in [p for p in everything if p.__name__ in sys.argv[2:]] or everything:
        rounds = max(2, count // slow.get(part, 1))
        bytes_kept = kept(part, rounds)
        leaks |= bytes_kept >= smallest * rounds
        print(f"{part.__name__}: {bytes_kept} B after {rounds} rounds", flush=True)
    sys.exit(leaks)
