"""A run by hand: read, set, on; and Python functions as laws."""

import math
import unittest

import numpy
import pintle
from common import examples, servo_arm

arm = servo_arm + """run: {until: 0.5 s, tolerance: 1e-10}
output: {every: 10 ms}
"""
written = arm.replace("torque: torque", 'torque: "8 N m*(0.3 - arm.angle) - 1.5 N m s*arm.speed"')


def rates(angle, speed, torque):
    return speed, (torque - 2 * 9.81 * 0.3 * math.cos(angle)) / (0.06 + 2 * 0.3**2)


def runge_kutta(angle, speed, torque, time, parts):
    """The arm by hand, under a torque that stays."""
    h = time / parts
    for _ in range(parts):
        a1 = rates(angle, speed, torque)
        a2 = rates(angle + h / 2 * a1[0], speed + h / 2 * a1[1], torque)
        a3 = rates(angle + h / 2 * a2[0], speed + h / 2 * a2[1], torque)
        a4 = rates(angle + h * a3[0], speed + h * a3[1], torque)
        angle += h / 6 * (a1[0] + 2 * a2[0] + 2 * a3[0] + a4[0])
        speed += h / 6 * (a1[1] + 2 * a2[1] + 2 * a3[1] + a4[1])
    return angle, speed


class ByHand(unittest.TestCase):
    def controlled(self, text, within):
        simulation = pintle.parse(text).simulation()
        angle, speed, work, going = -math.pi / 2, 0.0, 0.0, True
        for k in range(1, 51):
            torque = 8 * (0.3 - simulation["arm.angle"]) - 1.5 * simulation["arm.speed"]
            simulation["torque"] = torque
            self.assertEqual(simulation["torque"], torque)
            self.assertTrue(going)
            going = simulation.advance(0.01 * k)
            self.assertEqual(simulation.t, 0.01 * k)
            before = angle
            angle, speed = runge_kutta(angle, speed, torque, 0.01, 20)
            work += torque * (angle - before)
            yield simulation, angle, speed
        self.assertFalse(going)
        result = simulation.result()
        self.assertEqual(result.status, "finished")
        self.assertAlmostEqual(result.ledger["servo.work in"][-1], work, delta=10 * within)  # at most 10 N m
        self.assertLess(abs(result.unexplained), 10 * within)

    def test_a_sampled_controller_is_that_of_a_model_by_hand(self):
        for method, within in (("dopri5", 1e-7), ("verner87", 1e-7), ("generalized-alpha", 1e-5)):
            tolerance = "1e-10" if within < 1e-6 else "1e-7"
            text = arm.replace("tolerance: 1e-10", f"method: {method}, tolerance: {tolerance}")
            with self.subTest(method=method):
                for simulation, angle, speed in self.controlled(text, within):
                    self.assertAlmostEqual(simulation["arm.angle"], angle, delta=within)
                    self.assertAlmostEqual(simulation["arm.speed"], speed, delta=10 * within)

    def test_one_advance_to_the_end_is_a_run_to_the_bit(self):
        for file in ("slider_crank_clearance.yaml", "breaker.yaml", "stick_slip.yaml"):
            scene = pintle.load(examples / file)
            simulation = scene.simulation()
            simulation.advance(math.inf)
            by_hand, run = simulation.result(), scene.run()
            numpy.testing.assert_array_equal(by_hand.data, run.data)
            numpy.testing.assert_array_equal(by_hand.ledger.data, run.ledger.data)
            self.assertEqual(by_hand.status, run.status)
            numpy.testing.assert_equal(by_hand.impacts, run.impacts)  # NaN is NaN

    def test_steps_by_hand_change_nothing_but_rounding_and_tolerance(self):
        scene = pintle.load(examples / "slider_crank_clearance.yaml").set({"run.until": "5 ms"})
        simulation, run = scene.simulation(), scene.run()
        for k in range(1, 30):
            simulation.advance(k * 1e-4)
        simulation.advance(1)
        result = simulation.result()
        self.assertEqual(len(result.impacts), len(run.impacts))
        self.assertAlmostEqual(result.impacts[0].begin, run.impacts[0].begin, delta=1e-10)
        numpy.testing.assert_allclose(result["crank.angle"], run["crank.angle"], atol=1e-6)

    def test_a_level_that_an_input_passes_is_an_event(self):
        text = arm.replace("start: {arm", "events: {on: {when: torque > 1 N m, do: {row: true}}}\nstart: {arm")
        simulation = pintle.parse(text).simulation()
        simulation.advance(0.1)
        simulation["torque"] = 2
        simulation.advance(0.2)
        events = simulation.result().events
        self.assertEqual([(e.event, e.t) for e in events], [("on", 0.1)])

    def test_a_simulation_left_early_has_its_last_row_there(self):
        simulation = pintle.parse(arm).simulation()
        simulation.advance(0.123)
        result = simulation.result()
        self.assertEqual(result.t[-1], 0.123)
        self.assertEqual(result.status, "interrupted")
        self.assertEqual(simulation.t, 0.123)
        with self.assertRaisesRegex(RuntimeError, "has ended"):
            simulation.advance(0.2)

    def test_a_simulation_that_fails_says_why(self):
        simulation = pintle.parse(arm).simulation()
        simulation.advance(0.1)
        simulation["torque"] = 1e308
        self.assertFalse(simulation.advance(0.2))
        with self.assertRaises(pintle.RunError) as caught:
            simulation.result()
        self.assertEqual(caught.exception.result.t[-1], 0.1)

    def test_what_cannot_be_set_or_read(self):
        simulation = pintle.parse(arm).simulation()
        with self.assertRaisesRegex(KeyError, "states: torque"):
            simulation["arm.angle"] = 1
        with self.assertRaisesRegex(KeyError, "did you mean"):
            simulation["arm.angel"]
        self.assertEqual(simulation.unit("arm.angle"), "rad")
        with self.assertRaisesRegex(ValueError, "finite"):
            simulation["torque"] = math.nan
        simulation.advance(0.1)
        for t in (0.1, 0.05, -1, math.nan):
            with self.assertRaisesRegex(ValueError, "after 0.1 s"):
                simulation.advance(t)


class Functions(unittest.TestCase):
    def law(self, angle, speed):
        return 8 * (0.3 - angle) - 1.5 * speed

    def test_a_law_in_python_is_that_of_the_scene(self):
        for method, within in (("dopri5", 1e-8), ("generalized-alpha", 1e-8)):
            text = written.replace("tolerance: 1e-10", f"method: {method}, tolerance: {1e-10 if method == 'dopri5' else 1e-7}")
            scene = pintle.parse(text)
            ours = scene.set({"forces.servo.torque": "0 N m"}).with_law("servo", self.law, of=["arm.angle", "arm.speed"])
            expected, found = scene.run(), ours.run()
            numpy.testing.assert_allclose(found["arm.angle"], expected["arm.angle"], atol=within)
            numpy.testing.assert_allclose(found.ledger["servo.work in"], expected.ledger["servo.work in"], atol=10 * within)

    def test_small_motion_and_rest_see_its_slopes(self):
        scene = pintle.parse(written)
        ours = pintle.parse(arm.replace("torque: torque", "torque: 0 N m")).with_law("servo", self.law, of=["arm.angle", "arm.speed"])
        expected, found = scene.statics(), ours.statics()
        self.assertAlmostEqual(found["arm.angle"], expected["arm.angle"], places=9)
        for one, other in zip(scene.linearize(at_rest=True).modes, ours.linearize(at_rest=True).modes):
            self.assertAlmostEqual(one.root, other.root, places=6)

    def test_a_force_gives_two_numbers_and_a_state_its_rate(self):
        scene = pintle.parse(arm.replace("servo: {torque: torque, on: arm}", "push: {force: [0 N, 0 N], at: arm.O}"))
        result = scene.with_law("torque", lambda t: 6 * t, of=["t"]).run()
        numpy.testing.assert_allclose(result["torque"], 3 * result.t**2, atol=1e-8)
        pulled = scene.with_law("push", lambda t, speed: (t, 2 * t), of=["t", "arm.speed"]).run()
        reaction = pulled["pivot.fx"] - scene.run()["pivot.fx"]
        numpy.testing.assert_allclose(reaction, -pulled.t, atol=1e-6)  # at the pivot it moves nothing

    def test_what_a_function_gives_is_named_where_it_is_not_that(self):
        pushed = arm.replace("servo: {torque: torque, on: arm}", "push: {force: [0 N, 0 N], at: arm.O}")
        for given in (1.0, "ab", (1, 2, 3), None, ("a", "b")):
            with self.assertRaisesRegex(TypeError, '"push" returned .*two numbers'):
                pintle.parse(pushed).with_law("push", lambda t, speed: given, of=["t", "arm.speed"]).run()
        for given in ("a", (1, 2), None):
            with self.assertRaisesRegex(TypeError, '"servo" returned .*a number'):
                pintle.parse(arm).with_law("servo", lambda t, speed: given, of=["t", "arm.speed"]).run()

    def test_an_output_in_python(self):
        scene = pintle.parse(arm.replace("run: {", "outputs: {half: arm.angle}\nrun: {"))
        result = scene.with_law("half", lambda angle: angle / 2, of="arm.angle").run()
        with self.assertRaisesRegex(TypeError, "function"):
            scene.with_law("half", 0.5, of="arm.angle")
        numpy.testing.assert_array_equal(result["half"], result["arm.angle"] / 2)

    def test_an_error_in_a_function_is_raised_as_it_is(self):
        def wrong(angle):
            return 1 / 0

        with self.assertRaises(ZeroDivisionError):
            pintle.parse(arm).with_law("servo", wrong, of=["arm.angle"]).run()
        simulation = pintle.parse(arm).with_law("servo", lambda t, speed: 1 / (t < 0.1), of=["t", "arm.speed"]).simulation()
        with self.assertRaises(ZeroDivisionError):
            while simulation.advance(simulation.t + 0.01):
                pass
        with self.assertRaisesRegex(RuntimeError, "has ended"):
            simulation.result()
        with self.assertRaises(pintle.SceneError) as caught:
            pintle.parse(arm).with_law("servos", self.law, of=["arm.angle", "arm.speed"])
        self.assertIn("servo", caught.exception.message)
        with self.assertRaisesRegex(pintle.SceneError, "arm.angel"):
            pintle.parse(arm).with_law("servo", self.law, of=["arm.angel", "arm.speed"]).run()

    def test_a_scene_stays_as_it_was(self):
        scene = pintle.parse(written)
        before = scene.run().data
        scene.with_law("servo", lambda angle: 0.0, of=["arm.angle"])
        scene.set({"run.tolerance": 1e-4})
        numpy.testing.assert_array_equal(scene.run().data, before)


if __name__ == "__main__":
    unittest.main()
