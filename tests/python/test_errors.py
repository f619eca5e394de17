"""Errors say where the scene is wrong; a run that fails keeps what it computed."""

import tempfile
import unittest
import warnings
from pathlib import Path
from unittest import mock

import pintle
from common import examples, pendulum


class Scenes(unittest.TestCase):
    def test_an_error_names_file_line_and_key(self):
        with tempfile.TemporaryDirectory() as place:
            file = Path(place) / "wrong.yaml"
            file.write_text(pendulum.replace("mass: 1 kg", "mass: 1 m"))
            with self.assertRaises(pintle.SceneError) as caught:
                pintle.load(file)
        error = caught.exception
        self.assertEqual(error.file, str(file))
        self.assertEqual(error.line, 3)
        self.assertEqual(error.key, "bodies.rod.rigid.mass")
        self.assertIn("1 m", error.message)
        self.assertEqual(str(error), f"{file}:3: bodies.rod.rigid.mass: {error.message}")
        self.assertIsInstance(error, ValueError)

    def test_a_name_that_only_build_knows_to_be_wrong(self):
        with self.assertRaises(pintle.SceneError) as caught:
            pintle.parse(pendulum.replace("rod.O]", "rod.P]")).run()
        self.assertEqual(caught.exception.line, 4)
        self.assertTrue(caught.exception.key.startswith("joints.hinge"))

    def test_an_override_has_no_line(self):
        with self.assertRaises(pintle.SceneError) as caught:
            pintle.parse(pendulum).set({"run.tolerence": 1e-6})
        self.assertIsNone(caught.exception.line)
        self.assertIn("tolerance", caught.exception.message)

    def test_a_dict_names_the_key(self):
        with self.assertRaises(pintle.SceneError) as caught:
            pintle.parse({"bodies": {"rod": {"rigid": {"mass": "1 kg", "inertia": "0.1 m"}}}, "run": {"until": 1}})
        error = caught.exception
        self.assertEqual((error.file, error.line, error.key), (None, None, "bodies.rod.rigid.inertia"))
        self.assertEqual(str(error), f"<dict>: {error.key}: {error.message}")

    def test_a_study_of_a_dict_names_the_key_and_no_file(self):
        study = {"scene": examples / "pendulum.yaml", "set": {"run.until": "10 ms"}, "measure": {"lost": "energy lost"},
                 "sweep": {"grid": {"run.tolerance": [1e-6]}}}
        for call, wrong, key in ((pintle.sweep, {"sweep": {"gird": {}}}, "sweep.gird"), (pintle.sweep, {"scene": "nowhere.yaml"}, "scene"),
                                 (pintle.fit, {"measure": {"lost": "energy lots"}}, "measure.lost")):
            with tempfile.TemporaryDirectory() as temporary, mock.patch("tempfile.tempdir", temporary), self.subTest(wrong=wrong), \
                    self.assertRaises(pintle.SceneError) as caught:
                call({**study, **wrong})
            error = caught.exception
            self.assertEqual((error.file, error.line, error.key), (None, None, key))
            self.assertEqual(str(error), f"<dict>: {error.key}: {error.message}")
            self.assertNotIn(temporary, error.message)
        with tempfile.TemporaryDirectory() as place:
            self.assertEqual(pintle.sweep(study, out=f"{place}/out").info["file"], "<dict>")
            self.assertIn('"file": "<dict>"', Path(f"{place}/out/sweep.json").read_text())
        with self.assertRaises(pintle.SceneError) as caught:  # what the scene refuses belongs to the study that sets it
            pintle.sweep({**study, "set": {"run.untl": 1}})
        self.assertEqual((caught.exception.file, caught.exception.key), (None, "set.run.untl"))

    def test_a_file_that_is_not_there(self):
        with self.assertRaisesRegex(pintle.SceneError, "nowhere.yaml"):
            pintle.load("nowhere.yaml")

    def test_a_mechanism_that_cannot_close(self):
        open_loop = pendulum.replace("joints: {", "joints: {far: {distance: [ground, rod], length: 9 m}, ")
        with self.assertRaises(pintle.AssemblyError) as caught:
            pintle.parse(open_loop).run()
        self.assertIn("far", str(caught.exception))
        self.assertIsInstance(caught.exception, pintle.Error)

    def test_what_cannot_stand_in_a_scene(self):
        with self.assertRaisesRegex(TypeError, "cannot stand in a scene"):
            pintle.parse({"bodies": object()})


class Runs(unittest.TestCase):
    failing = pendulum.replace("tolerance: 1e-10", "tolerance: 1e-10, max steps: 5")

    def test_a_run_that_fails_keeps_what_it_computed(self):
        with self.assertRaisesRegex(pintle.RunError, "max steps") as caught:
            pintle.parse(self.failing).run()
        result = caught.exception.result
        self.assertEqual(result.status, "failed")
        self.assertTrue(0 < result.t[-1] < 0.1)

    def test_unless_it_is_not_to_be_judged(self):
        self.assertEqual(pintle.parse(self.failing).run(check=False).status, "failed")

    def test_what_is_doubtful_is_a_warning(self):
        doubtful = pintle.parse(pendulum).set({"run.tolerance": 1e-3, "run.ledger bound": 1e-15, "run.until": "20 s"})
        with self.assertWarnsRegex(pintle.ModelWarning, "unexplained") as caught:
            result = doubtful.run()
        self.assertEqual(result.status, "ledger over its bound")
        self.assertEqual(Path(caught.filename).name, Path(__file__).name)

    def test_no_warning_where_nothing_is_doubtful(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            pintle.load(examples / "pendulum.yaml").run()


if __name__ == "__main__":
    unittest.main()
