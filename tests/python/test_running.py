"""Threads, signals, memory."""

import gc
import json
import os
import signal
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import numpy
import pintle
from common import examples, pendulum

long_run = pintle.parse(pendulum).set({"run.until": "1e5 s", "output.every": "1 s"})


class Threads(unittest.TestCase):
    def test_python_goes_on_while_a_run_computes(self):
        def count_and_stop():
            for _ in range(10):
                time.sleep(1e-3)
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=count_and_stop)
        with self.assertRaises(KeyboardInterrupt):  # held, the thread would wait for the end of the run, and none came
            thread.start()
            long_run.run()
        thread.join()

    def test_runs_in_threads_are_the_same_to_the_bit(self):
        scene = pintle.load(examples / "slider_crank_clearance.yaml").set({"run.until": "5 ms"})
        expected, found = scene.run().data, {}

        def run(k):
            found[k] = scene.run().data

        threads = [threading.Thread(target=run, args=(k,)) for k in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for data in found.values():
            numpy.testing.assert_array_equal(data, expected)
        self.assertEqual(len(found), 4)


class Signals(unittest.TestCase):
    def interrupted(self, call, raised=KeyboardInterrupt, number=signal.SIGINT, under_way=lambda stop: hasattr(stop, "result")):
        """What `call` raises where a signal meets it under way; on a busy machine one may come before that."""
        for wait in (0.3, 1, 3, 10):
            timer = threading.Timer(wait, os.kill, (os.getpid(), number))
            timer.start()
            try:
                call()
            except raised as stop:
                if under_way(stop):
                    return stop
            finally:
                timer.join()
        self.fail("no signal came while it was under way")

    def test_ctrl_c_ends_a_run_and_keeps_what_was_computed(self):
        result = self.interrupted(long_run.run, under_way=lambda stop: hasattr(stop, "result") and stop.result.t[-1] > 0).result
        self.assertEqual(result.status, "interrupted")
        self.assertLess(result.t[-1], 1e5)
        self.assertEqual(len(result["rod.angle"]), len(result.t))

    def test_what_another_handler_raises_comes_through(self):
        class Enough(Exception):
            pass

        def handler(number, frame):
            raise Enough

        before = signal.signal(signal.SIGUSR1, handler)
        self.addCleanup(signal.signal, signal.SIGUSR1, before)
        self.assertEqual(self.interrupted(long_run.run, Enough, signal.SIGUSR1).result.status, "interrupted")

    def test_a_simulation_by_hand_keeps_what_was_computed(self):
        simulations = []

        def go():
            simulations.append(long_run.simulation())
            simulations[-1].advance(1e5)

        self.interrupted(go, under_way=lambda stop: simulations and simulations[-1].t > 0)
        self.assertLess(simulations[-1].t, 1e5)
        self.assertGreater(len(simulations[-1].result()), 1)

    def test_ctrl_c_ends_analyses_without_a_run_before_they_are_done(self):
        plate = {"grid": {"corners": [[0, 0], [1, 0], [1, 1], [0, 1]], "cells": [150, 150]}, "thickness": "1 mm", "material": "steel"}
        body = pintle.parse({
            "materials": {"steel": {"young": "207 GPa", "poisson": 0.3, "density": 7850}},
            "bodies": {"plate": {"plate": plate, "points": {"tip": [1, 1]}, "supports": {"left": "fixed"}}},
            "static": {"loads": {"push": {"force": [0, "-1 N"], "at": "tip"}}},
        })
        for call in (body.modes, body.static, lambda: long_run.linearize(at=1e5)):
            ends = []

            def record(frame, event, of):  # an exception that comes after the call is no c_exception
                if event == "c_exception" and of.__name__ in ("modes", "static_case", "linearize"):
                    ends.append(of.__name__)

            def go():
                sys.setprofile(record)
                call()

            with self.subTest(call=call):
                try:
                    self.interrupted(go, under_way=lambda stop: ends)
                finally:
                    sys.setprofile(None)

    def test_a_sweep_stops_and_keeps_its_journal(self):
        study = {
            "scene": str(examples / "slider_crank_clearance.yaml"), "set": {"run.until": "2 s", "output.every": "1 ms"},
            "measure": {"contacts": "impacts at gudgeon pin"}, "sweep": {"grid": {"clearance": ["0.1 mm", "0.2 mm", "0.3 mm"]}},
        }
        with tempfile.TemporaryDirectory() as place:
            file, outs = Path(place) / "study.yaml", []
            file.write_text(json.dumps(study))

            def go():
                outs.append(Path(place) / f"out-{len(outs)}")
                pintle.sweep(file, out=outs[-1], threads=1)

            self.interrupted(go, under_way=lambda stop: (outs[-1] / "journal-0.txt").exists())


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


class Memory(unittest.TestCase):
    def test_a_thousand_runs_do_not_grow(self):
        scene = pintle.parse(pendulum).set({"run.until": "10 ms"})
        law = pintle.parse(pendulum.replace("start:", "forces: {push: {torque: 0 N m, on: rod}}\nstart:")).set({"run.until": "1 ms"})

        def once(k):
            result = scene.set({"run.tolerance": 1e-8 + 1e-12 * k}).run()
            column = result["rod.angle"]
            self.assertEqual(len(column), 1001)
            law.with_law("push", lambda angle: -angle, of=["rod.angle"]).run()
            try:
                scene.set({"nothing": 1})
            except pintle.SceneError:
                pass

        for k in range(200):
            once(k)
        gc.collect()
        before, objects = resident(), len(gc.get_objects())
        for k in range(1000):
            once(k)
        gc.collect()
        one_run = scene.run().data.nbytes
        self.assertLess(resident() - before, 50 * one_run, "one run in twenty would have stayed")
        self.assertLess(len(gc.get_objects()) - objects, 500)


if __name__ == "__main__":
    unittest.main()
