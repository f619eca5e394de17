"""Results as arrays, tables, frames, pictures."""

import gc
import json
import math
import tempfile
import unittest
from pathlib import Path

import numpy
import pintle
from common import examples, pendulum

worn = pintle.load(examples / "slider_crank_clearance.yaml").set({"run.until": "2 ms"})


def is_there(module):
    try:
        __import__(module)
    except ImportError:
        return False
    return True


class Objects(unittest.TestCase):
    """A scene built from objects is the scene of the same dict."""

    built = pintle.Mechanism(gravity=[0, -9.81], run={"until": "0.1 s", "tolerance": 1e-10})
    rod = built.add_body("rod_1", rigid={"mass": numpy.float64(1), "inertia": 0.1}, points={"O_1": (-1, 0)})
    hinge = built.add_joint("hinge", revolute=[built.ground, rod["O_1"]])
    limits = built.add_event("turned", when="rod_1.angle < -0.04 rad", do={"stop": True})

    def test_it_is_that_of_the_dict(self):
        self.assertEqual(self.built.as_dict(), {
            "gravity": [0, -9.81], "run": {"until": "0.1 s", "tolerance": 1e-10},
            "bodies": {"rod_1": {"rigid": {"mass": 1.0, "inertia": 0.1}, "points": {"O_1": [-1, 0]}}},
            "joints": {"hinge": {"revolute": ["ground", "rod_1.O_1"]}},
            "events": {"turned": {"when": "rod_1.angle < -0.04 rad", "do": {"stop": True}}},
        })
        result = self.built.scene().run()
        self.assertEqual(result.events[0].event, "turned")
        self.assertAlmostEqual(result["rod_1.angle"][-1], -0.04, delta=1e-8)

    def test_underscores_of_keywords_are_spaces_and_elements_are_names(self):
        coupled = pintle.Mechanism(run={"until": 1}, ground={"points": {"P": [0, 1]}})
        a = coupled.add_body("a")
        coupled.add_force("spring", spring=[coupled.ground["P"], a], free_length=coupled.add_parameter("l_0", "1 m"))
        coupled.start(a, x=0)
        self.assertEqual(coupled.as_dict()["forces"], {"spring": {"spring": ["ground.P", "a"], "free length": "l_0"}})
        self.assertEqual(coupled.as_dict()["start"], {"a": {"x": 0}})

    def test_what_is_wrong_is_told_at_once(self):
        with self.assertRaisesRegex(KeyError, "no point .*O_2.*it has O_1"):
            self.rod["O_2"]
        with self.assertRaisesRegex(ValueError, "already a body called"):
            self.built.add_body("rod_1")
        with self.assertRaisesRegex(pintle.SceneError, "bodies.b.rigid.mass") as caught:
            wrong = pintle.Mechanism(run={"until": 1})
            wrong.add_body("b", rigid={"mass": "1 m", "inertia": 1})
            wrong.scene()
        self.assertEqual(caught.exception.key, "bodies.b.rigid.mass")


class Columns(unittest.TestCase):
    def setUp(self):
        self.result = pintle.parse(pendulum).run()

    def test_the_numbers_are_those_of_mechanics(self):
        a, t = 9.81 / 1.1, 0.1
        expected = -a * t**2 / 2 + a**3 * t**6 / 240  # phi'' = -a cos phi
        self.assertAlmostEqual(self.result["rod.angle"][-1], expected, delta=1e-8)

    def test_names_units_and_places(self):
        self.assertEqual(self.result.names[0], "t")
        self.assertEqual(self.result.unit("rod.speed"), "rad/s")
        self.assertEqual(self.result.unit("hinge.fx"), "N")
        numpy.testing.assert_array_equal(self.result["hinge.fx"], self.result["hinge.fx on rod"])
        numpy.testing.assert_array_equal(self.result["hinge.fx"], self.result["hinge.fx on rod [N]"])
        self.assertIn("rod.angle", self.result)
        self.assertNotIn("rod.angel", self.result)
        self.assertEqual(list(self.result), self.result.names)

    def test_a_name_that_is_not_there_gets_the_nearest_one(self):
        with self.assertRaisesRegex(KeyError, "rod.angel.*did you mean .*rod.angle"):
            self.result["rod.angel"]

    def test_a_short_name_of_two_columns_names_both(self):
        table = pintle.Table(["t [s]", "hit.fx on a [N]", "hit.fx on b [N]"], numpy.zeros((1, 3)))
        with self.assertRaisesRegex(KeyError, "hit.fx on a.* or .*hit.fx on b"):
            table["hit.fx"]

    def test_columns_share_the_memory_of_the_run_and_outlive_it(self):
        column, whole = self.result["rod.angle"], self.result.data
        self.assertTrue(numpy.shares_memory(column, whole))
        self.assertTrue(numpy.shares_memory(self.result["rod.angle"], column))
        self.assertFalse(column.flags.owndata)
        expected = column.copy()
        del self.result, whole
        gc.collect()
        pintle.parse(pendulum).run()  # would write over memory that was given back
        numpy.testing.assert_array_equal(column, expected)

    def test_results_cannot_be_written_to(self):
        with self.assertRaises(ValueError):
            self.result["rod.angle"][0] = 1

    def test_the_ledger_closes(self):
        ledger = self.result.ledger
        self.assertEqual(len(ledger), len(self.result))
        self.assertEqual(set(ledger.unit(n) for n in ledger.names[1:]), {"J"})
        self.assertLess(abs(self.result.unexplained), 1e-9)

    def test_info_is_run_json(self):
        self.assertEqual(self.result.info["status"], "finished")
        self.assertEqual(self.result.info["scene"]["run"]["tolerance"], 1e-10)


class Tables(unittest.TestCase):
    def test_impacts_and_events(self):
        result = worn.run()
        first = result.impacts[0]
        self.assertEqual(first.contact, "gudgeon pin")
        self.assertTrue(0 < first.begin < first.end < 2e-3)
        self.assertGreaterEqual(first.peak_force, result["gudgeon pin.normal"][result.t < first.end].max())
        events = pintle.load(examples / "breaker.yaml").run().events
        self.assertTrue(events and events[0].event and events[0].t > 0 and events[0].did)

    @unittest.skipUnless(is_there("pandas"), "pandas is not installed")
    def test_a_frame_has_units(self):
        frame = worn.run().frame()
        self.assertEqual(frame.attrs["units"]["gudgeon pin.normal"], "N")
        self.assertEqual(len(frame), len(frame["t"]))
        self.assertEqual(frame["t"].iloc[-1], 2e-3)

    def test_words_stand_beside_numbers(self):
        table = pintle.TextTable("case,kind,x [m]\n1,a,0.5\n2,b,\n")
        self.assertEqual((table.names, table.unit("x"), table.words), (["case", "x"], "m", {"kind": ["a", "b"]}))
        numpy.testing.assert_array_equal(table["x"], [0.5, numpy.nan])

    @unittest.skipUnless(is_there("pandas"), "pandas is not installed")
    def test_a_frame_has_the_words_too(self):
        frame = pintle.TextTable("case,kind,x [m]\n1,a,0.5\n2,b,\n").frame()
        self.assertEqual((list(frame.columns), list(frame["kind"])), (["case", "kind", "x"], ["a", "b"]))
        self.assertEqual(frame.attrs["units"]["x"], "m")

    @unittest.skipUnless(is_there("matplotlib"), "matplotlib is not installed")
    def test_a_plot_has_an_axis_for_each_unit(self):
        import matplotlib

        matplotlib.use("Agg")
        axes = worn.run().plot("gudgeon pin.normal", "gudgeon pin.friction", "gudgeon pin.depth")
        self.assertEqual([a.get_ylabel() for a in axes], ["[N]", "[m]"])
        self.assertEqual(len(axes[0].lines), 2)
        orbit = worn.run().plot("gudgeon pin.ey", against="gudgeon pin.ex")
        self.assertEqual(orbit.get_xlabel(), "gudgeon pin.ex [m]")

    def test_words_and_pages(self):
        result = worn.run()
        self.assertIn("finished", repr(result))
        self.assertIn("<table>", result._repr_html_())
        self.assertIn("gudgeon pin.normal", pintle.Table(*worn.run()._core.trajectory)._repr_html_())

    def test_results_are_written_as_the_program_does(self):
        result = worn.run()
        with tempfile.TemporaryDirectory() as place:
            result.write(Path(place) / "out")
            self.assertEqual(json.loads((Path(place) / "out" / "run.json").read_text())["status"], "finished")
            rows = (Path(place) / "out" / "trajectory.csv").read_text().splitlines()
            self.assertEqual(len(rows), len(result) + 1)
            with self.assertRaises(OSError):
                result.write(Path(place) / "out")
            result.report(Path(place) / "page.html")
            self.assertIn("gudgeon pin", (Path(place) / "page.html").read_text())


class Questions(unittest.TestCase):
    def test_a_lever_rests_where_moments_balance(self):
        rest = pintle.load(examples / "statics_lever.yaml").statics()
        k, m, g, h, d = 150, 2, 9.81, 0.4, 0.2
        self.assertAlmostEqual(rest["lever.angle"], math.atan2(k * h - m * g, k * d), places=9)
        self.assertTrue(rest.stable)
        self.assertEqual(rest.info["found"], True)

    def test_a_pendulum_swings_with_its_small_motion(self):
        hanging = pintle.parse(pendulum).set({"start.rod.angle": "-90 deg"})
        for small in (hanging.linearize(), hanging.linearize(at_rest=True)):
            expected = math.sqrt(9.81 / 1.1) / (2 * math.pi)
            self.assertAlmostEqual(small.modes[0].frequency, expected, places=9)
            roots = numpy.linalg.eigvals(small.A)
            self.assertAlmostEqual(max(abs(roots.imag)), 2 * math.pi * expected, places=8)
            self.assertEqual(small.A.shape, (2, 2))
            self.assertEqual(small.C.shape, (len(small.outputs), 2))

    def test_drivers_move_and_are_told_their_torques(self):
        scene = pintle.parse("""
            gravity: [0, -9.81]
            bodies: {arm: {rigid: {mass: 2 kg, inertia: 0.1}, points: {O: [-0.5, 0]}}}
            joints: {hinge: {revolute: [ground, arm.O]}}
            drivers: {motor: {angle: [ground, arm], law: "3 rad/s*t"}}
            run: {until: 0.5 s}
            """)
        turning = scene.kinematics()
        numpy.testing.assert_allclose(turning["arm.angle"], 3 * turning.t, atol=1e-9)
        found = scene.inverse()
        effort = found.efforts["motor"]
        self.assertEqual(effort.unit, "N m")
        numpy.testing.assert_allclose(effort.value, 2 * 9.81 * 0.5 * numpy.cos(3 * effort.t), atol=1e-8)

    def test_each_question_writes_its_files(self):
        quick_return = pintle.load(examples / "kinematics_quick_return.yaml").kinematics()
        self.assertEqual(quick_return.info["model"]["bodies"], 4)
        four_bar = pintle.load(examples / "inverse_four_bar.yaml").inverse()
        self.assertIn("motor", str(four_bar.info))
        with tempfile.TemporaryDirectory() as place:
            quick_return.write(Path(place) / "kinematics")
            four_bar.write(Path(place) / "inverse")
            found = sorted(str(file.relative_to(place)) for file in Path(place).rglob("*.*"))
        for file in ("kinematics/kinematics.json", "kinematics/trajectory.csv", "inverse/inverse.json", "inverse/motor.csv"):
            self.assertIn(file, found)

    def test_check_says_what_a_scene_holds(self):
        self.assertEqual(pintle.parse(pendulum).check()["model"]["mobility"], 1)

    def test_a_sweep_of_a_dict_is_as_many_runs(self):
        scene = examples / "slider_crank_clearance.yaml"
        clearances = numpy.array([1e-5, 2e-5])
        sweep = pintle.sweep({
            "scene": str(scene), "set": {"run.until": "2 ms"}, "measure": {"peak": "peak force at gudgeon pin"},
            "sweep": {"grid": {"clearance": [f"{c} m" for c in clearances]}},
        })
        self.assertEqual(sweep.words["status"], ["finished", "finished"])
        self.assertEqual(sweep.unit("peak"), "N")
        for clearance, peak in zip(clearances, sweep["peak"]):
            run = pintle.load(scene, {"run.until": "2 ms", "clearance": clearance}).run()
            self.assertEqual(peak, max(i.peak_force for i in run.impacts))

    def test_a_fit_gives_the_scene_that_meets_the_goal(self):
        fit = pintle.fit(examples / "studies" / "fit_frequency.yaml")
        stiffness = fit.point["forces.rubber at rest.stiffness"]
        self.assertAlmostEqual(stiffness, 63250, delta=10)  # by hand, in its file
        self.assertAlmostEqual(fit.scene.linearize(at_rest=True).modes[1].frequency, 12, delta=2e-4)

    def test_modes_of_a_cantilever(self):
        modes = pintle.load(examples / "modes_beam.yaml").modes(count=2)
        self.assertEqual(len(modes.frequencies), 2)
        self.assertEqual(modes.natural.mass.shape, (3, 2))
        ratio = (4.694091 / 1.875104) ** 2  # of roots of 1 + cos x cosh x = 0
        self.assertAlmostEqual(modes.frequencies[1] / modes.frequencies[0] / ratio, 1, delta=2e-3)


class Views(unittest.TestCase):
    def test_a_notebook_shows_what_a_scene_holds(self):
        shown = pintle.parse(pendulum.replace("rod", "rod <1>"))._repr_html_()
        for row in ("<td>bodies</td><td>rod &lt;1&gt;</td>", "<td>joints</td><td>hinge</td>", "<td>degrees of freedom</td><td>1</td>"):
            self.assertIn(row, shown)
        apart = pintle.parse(pendulum.replace("joints: {", "joints: {far: {distance: [ground, rod], length: 9 m}, "))
        self.assertIn("unknown: ", apart._repr_html_())

    def test_a_notebook_shows_modes_as_a_table(self):
        modes = pintle.load(examples / "modes_beam.yaml").modes(count=2)
        shown = modes._repr_html_()
        self.assertEqual(shown.count("<tr>"), 3)
        for f in modes.frequencies:
            self.assertIn(f"<td>{f:.6g}</td>", shown)

    def test_a_notebook_shows_the_page_of_the_report(self):
        page = worn.run().view(height=500)
        self.assertIn("<html", page.text)
        shown = page._repr_html_()
        self.assertTrue(shown.startswith('<iframe srcdoc="') and "height: 500px" in shown)
        self.assertNotIn("<html", shown)  # escaped


if __name__ == "__main__":
    unittest.main()
