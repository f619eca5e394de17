"""What the program says where a name is mistyped, and to someone who waits or no longer wants to.

usage: test_manners.py PINTLE"""

import os
import re
import signal
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

from terminal import interrupted

pintle = os.path.realpath(sys.argv.pop(1))
examples = Path(__file__).resolve().parents[2] / "examples"
pendulum = """
gravity: [0, -9.81]
bodies: {rod: {rigid: {mass: 1 kg, inertia: 0.1}, points: {O: [-1, 0]}}}
joints: {hinge: {revolute: [ground, rod.O]}}
start: {rod: {angle: 0 deg}}
run: {until: 0.1 s}
"""


class Manners(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.place = Path(place.name)
        (self.place / "swing.pintle.yaml").write_text(pendulum)

    def say(self, *words):
        return subprocess.run([pintle, *words], cwd=self.place, capture_output=True, text=True)

    def test_a_mistyped_command(self):
        done = self.say("rnu", "swing.pintle.yaml")
        self.assertEqual(done.returncode, 2)
        self.assertIn('"rnu" is not a command. Did you mean "run"?', done.stderr)
        self.assertIn("Known here: ", self.say("simulate").stderr)

    def test_a_mistyped_option(self):
        for words in (("run", "swing.pintle.yaml", "--reprot"), ("run", "--reprot", "swing.pintle.yaml"), ("run", "--reprot")):
            done = self.say(*words)
            self.assertEqual(done.returncode, 2)
            self.assertIn('run has no option --reprot. Did you mean "--report"?', done.stderr)
        self.assertIn('Did you mean "--count"?', self.say("modes", "swing.pintle.yaml", "--cuont=3").stderr)
        self.assertIn("study is required", self.say("sweep").stderr)  # what is no slip of a name stays as it was
        self.assertEqual(self.say("--version").returncode, 0)
        self.assertEqual(self.say("run", "--help").returncode, 0)
        self.assertEqual(self.say().returncode, 2)

    def test_hdf5_is_an_option_of_run_alone(self):
        for words in (("sweep", "study.yaml", "--hdf5"), ("inverse", "swing.pintle.yaml", "--hdf5"), ("report", "--hdf5", "out")):
            done = self.say(*words)
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"{words[0]} has no option --hdf5; `pintle hdf5 DIR` turns the tables of a folder of results into HDF5", done.stderr)

    def test_a_path_without_its_group(self):
        worn = pendulum.replace("rod.O]", "rod.O], clearance: {radial: 1 mm, bearing radius: 20 mm, bearing: ground, "
                                "normal: {hunt-crossley: {stiffness: 1e9, restitution: 0.7}}}").replace("hinge", "worn pin")
        (self.place / "worn.yaml").write_text(worn)
        radial = '"joints.worn pin.clearance.radial"'
        for path, meant in (("worn pin.clearance.radial", radial), ("clearance.radial", radial),
                            ("rod.rigid.mass", '"bodies.rod.rigid.mass"'), ("worn pin.stop", '"joints.worn pin.stop"'), ("jiont.a", '"joints"')):
            done = self.say("run", "worn.yaml", "--set", path + "=2 mm")
            self.assertEqual(done.returncode, 2)
            self.assertIn(f'--set {path}: a scene has no key "{path.partition(".")[0]}". Did you mean {meant}?', done.stderr)

    def test_plots_as_pictures(self):
        self.assertEqual(self.say("run", "swing.pintle.yaml", "--out", "out", "-q").returncode, 0)
        done = self.say("plot", "out", "rod.angle", "-o", "a.gif")
        self.assertEqual(done.returncode, 2)
        self.assertIn("a plot is written as .svg, .png or .pdf; write a.svg", done.stderr)
        if not (Path(pintle).parent / "pintle-picture").exists():  # built without cairo
            self.assertIn("libcairo2-dev", self.say("plot", "out", "rod.angle", "-o", "a.png").stderr)
            return
        for name in ("a.png", "a.pdf", "b.pdf"):
            done = self.say("plot", "out", "rod.angle", "kinetic", "-o", name)
            self.assertEqual((done.returncode, done.stdout), (0, f"  {name}\n"), done.stderr)
        png, pdf = (self.place / "a.png").read_bytes(), (self.place / "a.pdf").read_bytes()
        self.assertEqual(png[:8] + png[12:24], b"\x89PNG\r\n\x1a\nIHDR" + struct.pack(">II", 2080, 780))
        drawn = [zlib.decompress(part) for part in re.findall(rb"stream\n(.*?)\nendstream", pdf, re.S) if part[:1] == b"x"]
        self.assertTrue(any(re.search(rb"0\.10588\d* 0\.42352\d* 0\.65882\d* RG", part) for part in drawn))  # the first curve
        self.assertEqual(pdf, (self.place / "b.pdf").read_bytes())

    def test_a_plot_leaves_out_what_is_no_number(self):
        (self.place / "gone.yaml").write_text(pendulum + "output: {every: 10 ms}\noutputs: {gone: 'sqrt(t - 0.05 s)', far: '1e21*t'}\n")
        done = self.say("run", "gone.yaml", "--out", "gone", "-q")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = self.say("plot", "gone", "gone", "far", "-o", "gone.svg")
        self.assertEqual(done.returncode, 0, done.stderr)
        drawn = (self.place / "gone.svg").read_text()
        self.assertNotIn("nan", drawn)
        self.assertIn(">5e+19<", drawn)
        first = min(float(x) for x in re.search("stroke='#1b6ca8' d='M(.*?)'", drawn)[1].replace("L", " ").split()[::2])
        self.assertGreater(first, 78 + 0.49 * 426)  # nothing before half of the time

    def test_endings_in_any_case(self):
        self.assertEqual(self.say("run", "swing.pintle.yaml", "--out", "out", "-q", "--set", "output.frames=2").returncode, 0)
        made = [("report", "out", "--out", "a.HTML"), ("plot", "out", "rod.angle", "--out", "a.Svg")]
        if (Path(pintle).parent / "pintle-picture").exists():
            made += [("picture", "out", "a.PNG"), ("plot", "out", "rod.angle", "--out", "b.Png"), ("plot", "out", "rod.angle", "--out", "b.PDF")]
        if (Path(pintle).parent / "pintle-fmu").exists():
            made.append(("fmu", "swing.pintle.yaml", "--out", "a.FMU"))
        for words in made:
            done = self.say(*words)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("  " + words[-1], done.stdout)  # each says what it wrote
            self.assertTrue((self.place / words[-1]).exists())
        (self.place / "swing.pintle.yaml").rename(self.place / "Swing.YAML")
        (self.place / "study.yaml").write_text("scene: Swing.YAML\nmeasure: {x: final x of rod}\nsweep: {grid: {run.tolerance: [1e-6]}}\n")
        self.assertEqual(self.say("sweep", "study.yaml", "--out", "swept", "-q").returncode, 0)

    def test_every_example_that_runs_can_be_checked(self):
        for scene in sorted(examples.glob("*.yaml")):
            if re.search("^run:", scene.read_text(), re.MULTILINE):
                with self.subTest(scene.name):
                    done = self.say("check", str(scene))
                    self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_scene_may_be_named_pintle_yaml(self):
        self.assertEqual(self.say("run", "swing.pintle.yaml", "-q").returncode, 0)
        self.assertTrue((self.place / "runs" / "swing" / "run.json").exists())

    def test_events_that_never_came_are_told(self):
        (self.place / "events.yaml").write_text(pendulum + "events:\n  far: {when: rod.angle > 30 rad, do: {stop: far}}\n"
                                                           "  down: {when: rod.angle < -0.1 deg, do: {row: true}}\n")
        said = self.say("run", "events.yaml").stdout
        self.assertRegex(said, "events that never came +far\n")
        self.assertRegex(said, "event down +[0-9.e-]+ s: ")

    def test_an_event_that_fails_came(self):
        (self.place / "events.yaml").write_text(pendulum.replace("until: 0.1 s", "until: 1 s") + "states: {X: {rate: 1/(1 s), start: 0}}\n"
                                                "events: {jump: {when: X > 0.05, do: {set: {X: 1/(X - X)}}}}\n")
        said = self.say("run", "events.yaml")
        self.assertEqual(said.returncode, 4, said.stderr)
        self.assertNotIn("never came", said.stdout)
        self.assertRegex(said.stdout, "event jump +[0-9.e-]+ s: could not do it")

    def test_what_is_not_there_ends_as_the_help_says(self):
        help = self.say("--help").stdout
        self.assertRegex(help, "1  results cannot be read or written")
        self.assertRegex(help, "2  .*a scene, a study or a file that they name is wrong, missing or unreadable")
        for command in ("run", "check", "statics", "kinematics", "inverse", "linearize", "modes", "static", "mesh", "fmu", "sweep", "fit", "sensitivity",
                        "nonlinear", "tradeoff"):
            if command != "fmu" or (Path(pintle).parent / "pintle-fmu").exists():
                self.assertEqual(self.say(command, "none.yaml").returncode, 2, command)
        unread = [("report", "none"), ("plot", "none", "t")]
        if (Path(pintle).parent / "pintle-hdf5").exists():
            unread.append(("hdf5", "none"))
        for words in unread:
            self.assertEqual(self.say(*words).returncode, 1, words)

    def test_of_a_file_that_is_no_scene_nothing_is_shown(self):
        for k, text in enumerate(("hidden words\n", "hidden:*:20228:0:99999:7:::\nother:*:1\n", "hidden: 1\n", "- hidden\n", "hidden words: x\nmore: y\n")):
            (self.place / f"other{k}").write_text(text)
            for command in ("run", "check", "sweep", "modes"):
                done = self.say(command, f"other{k}")
                self.assertEqual(done.returncode, 2)
                self.assertNotIn("hidden", done.stderr)
        self.assertIn("other0:1: is a plain text, not a mapping of keys; write keys and values", self.say("run", "other0").stderr)
        self.assertIn("other1:2: this is not YAML", self.say("run", "other1").stderr)
        self.assertIn("is it the right file?", self.say("run", "other2").stderr)

    def test_a_study_is_not_run(self):
        (self.place / "study.yaml").write_text("title: many\nscene: swing.pintle.yaml\nmeasure: {e: final x of rod}\n")
        for command in ("run", "check", "statics"):
            self.assertRegex(self.say(command, "study.yaml").stderr, "study.yaml: is a study, not a scene: .*sweep")

    def test_no_two_columns_of_a_study_have_one_name(self):
        (self.place / "swing.pintle.yaml").write_text(pendulum.replace("mass: 1 kg", "mass: m1") + "parameters: {m1: 1 kg, steps: 1, K: 1}\n")
        sweep, fit = "sweep: {grid: {m1: [1 kg, 2 kg]}}\n", "vary: {m1: {from: 1 kg, to: 2 kg}}\ngoal: {minimise: far}\n"
        scatter, trade = "sensitivity: {parameters: {m1: {uniform: 1 g}}}\n", "tradeoff: {error: 1%, axes: {finer: {run.tolerance: [1e-4, 1e-6]}}}\n"
        orbits = "section: {every: 10 ms, record: {NAME: rod.angle}, transient: 0, returns: 3}\n"
        measure = "measure: {far: final x of rod, NAME: final angle of rod}\n"
        for command, section, taken, free in (("sweep", measure + sweep, ("t_end", "status", "case", "m1", "unexplained share"), "phase"),
                                              ("fit", measure + fit, ("phase", "goal", "reason", "m1"), "t_end"),
                                              ("sensitivity", measure + scatter, ("steps", "impacts", "m1"), "goal"),
                                              ("tradeoff", measure + trade, ("time", "setting", "finer", "error of far"), "m1"),
                                              ("nonlinear", orbits, ("t", "t [s]", "return"), "case"),
                                              ("nonlinear", orbits + "orbit: {}\n", ("period", "stability", "modulus 1", "error 3"), "K"),
                                              ("nonlinear", "over: {m1: [1 kg, 2 kg]}\n" + orbits, ("m1",), "steps")):
            for name in taken + (free,):
                (self.place / "study.yaml").write_text("scene: swing.pintle.yaml\n" + section.replace("NAME", f'"{name}"'))
                done = self.say(command, "study.yaml", "--out", "out-" + command + name.replace(" ", "") + str(len(section)), "-q")
                with self.subTest(command + " " + name):
                    if name == free:
                        self.assertNotIn("another column", done.stderr)
                        continue
                    self.assertEqual(done.returncode, 2, done.stderr)
                    said = f'"{name}" is the name of another column of the study\'s table; choose'
                    self.assertRegex(done.stderr, "study.yaml:[23]: .*" + re.escape(said))
        far = "measure: {far: final x of rod}\n"
        for command, section, name in (("sweep", far + "sweep: {grid: {steps: [1, 2]}}\n", "steps"), ("tradeoff", far + trade.replace("finer", "time"), "time"),
                                       ("tradeoff", far + trade.replace("finer", "error of far"), "error of far"),
                                       ("nonlinear", orbits + "over: {K: [1, 2]}\n", "K")):
            (self.place / "study.yaml").write_text("scene: swing.pintle.yaml\n" + section)
            self.assertRegex(self.say(command, "study.yaml", "--out", "none").stderr, f'study.yaml:[23]: .*"{name}" is the name of another column')

    def test_nothing_is_measured_or_recorded_without_a_name(self):
        for command, section in (("sweep", 'measure: {"": final x of rod}\nsweep: {grid: {run.until: [1 ms]}}\n'),
                                 ("nonlinear", 'section: {every: 10 ms, record: {" ": rod.angle}, transient: 0, returns: 3}\n')):
            (self.place / "study.yaml").write_text("scene: swing.pintle.yaml\n" + section)
            done = self.say(command, "study.yaml", "--out", "none")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertRegex(done.stderr, "study.yaml:2: .*has an empty name; give it one")

    def test_one_body_is_not_compared_with_itself(self):
        heavy = pendulum.replace("mass: 1 kg", "mass: 1e300 kg")
        (self.place / "heavy.yaml").write_text(heavy)
        said = self.say("run", "heavy.yaml")
        self.assertNotIn('of that of "rod"', said.stdout + said.stderr)

    def test_the_length_of_steps_is_no_time_of_computing(self):
        self.assertRegex(self.say("check", "swing.pintle.yaml").stdout, "steps +[^\n]*, each [0-9.]+ [a-z]+ of the motion on average")

    def test_a_unit_is_called_as_its_scene(self):
        if not (Path(pintle).parent / "pintle-fmu").exists():
            return
        (self.place / "sp äö.yaml").write_text(pendulum)
        done = self.say("fmu", "sp äö.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.place / "sp äö.fmu").exists(), done.stdout)

    def test_a_folder_that_cannot_be_made_is_named_as_the_user_did(self):
        done = self.say("run", "swing.pintle.yaml", "--out", "/proc/results")
        self.assertEqual(done.returncode, 1)
        self.assertIn("/proc/results: cannot be made", done.stderr)
        self.assertNotIn(".part-", done.stderr)

    def refusal(self, more, scene=pendulum):
        (self.place / "refused.yaml").write_text(scene + more)
        done = self.say("check", "refused.yaml")
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertEqual(done.stderr.count("\n"), 1)
        return done.stderr

    def test_signals_of_worn_joints_are_told_of_ideal_ones(self):
        for column in ("normal", "depth", "ex", "ey", "rate", "friction", "sliding"):
            for use in (f"events: {{knock: {{when: hinge.{column} > 0, do: {{stop: now}}}}}}\n", f"outputs: {{seen: 2*hinge.{column}}}\n",
                        f"forces: {{f: {{torque: 1 m*hinge.{column}, on: rod}}}}\n"):
                said = self.refusal(use)
                self.assertIn(f'refused.yaml:7: ', said)
                self.assertIn(f'there is no signal "hinge.{column}". "hinge" is an ideal joint and has angle', said)
                self.assertIn("only joints with clearance", said)
        self.assertIn('Did you mean "rod.angle"?', self.refusal("outputs: {seen: rod.angel}\n"))
        self.assertIn('"rod" has alpha', self.refusal("outputs: {seen: rod.stroke}\n"))

    def test_a_condition_that_is_a_number(self):
        for when, said in (("rod.speed", '"rod.speed" is a number in rad/s; write a comparison such as rod.speed > 1 rad/s'),
                           ("rod.x", '"rod.x" is a number in m; write a comparison such as rod.x > 1 m'),
                           ("2*rod.x", '"2*rod.x" is a number; write a comparison such as rod.angle > 30 deg')):
            self.assertIn(f"refused.yaml:7: events.e.when: {said}\n", self.refusal(f"events: {{e: {{when: {when}, do: {{stop: now}}}}}}\n"))

    def test_a_table_that_is_not_there_is_told_by_the_line_that_names_it(self):
        (self.place / "load.csv").write_text("0 0\n1 1\n")
        (self.place / "load.txt").write_text("")
        for use in ("drivers: {d: {angle: [ground, rod], law: {table: lod.csv}}}\n", "forces: {f: {torque: {table: lod.csv, over: rod.angle}, on: rod}}\n",
                    "outputs: {o: {table: lod.csv, over: rod.angle}}\n"):
            said = self.refusal(use)
            self.assertIn("refused.yaml:7: ", said)
            self.assertIn('table: "lod.csv": there is no such file; check the path. Did you mean "load.csv"?', said)

    def test_names_that_parameters_cannot_have(self):
        for name in ("m", "g", "s", "N", "J", "W", "Pa", "bar", "rad", "deg", "rev", "rpm", "mm", "kg", "ms", "mN"):
            said = self.refusal(f"parameters: {{{name}: 1}}\n")
            self.assertIn(f'refused.yaml:7: parameters.{name}: "{name}" cannot name a parameter: {name} is a unit; choose another name, such as {name}_1', said)
        for name, why in (("sin", "is a function"), ("min", "is a function"), ("t", "is the time"), ("pi", "is a constant"), ("present", "at the start")):
            self.assertIn(why, self.refusal(f"parameters: {{{name}: 1}}\n"))
        for name in ("F", "A", "V", "H", "C", "J_1"):
            (self.place / "named.yaml").write_text(pendulum + f"parameters: {{{name}: 1}}\n")
            self.assertEqual(self.say("check", "named.yaml").returncode, 0, name)

    def test_a_driven_distance_of_nothing_is_told_with_a_remedy(self):
        scene = "ground: {points: {G: [0, 0]}}\nbodies: {b: {rigid: {mass: 1, inertia: 1}}}\njoints: {j: {prismatic: [ground.G, b]}}\nrun: {until: 1}\n"
        said = self.refusal("drivers: {d: {distance: [ground.G, b], law: -1 m + 1 m/s*t}}\n", scene)
        self.assertIn("refused.yaml:5: drivers.d: a driven distance must stay above 0; at t = 0 its law is -1 m: write `present", said)

    def test_redundancy_is_told_in_few_lines(self):
        bars = "\n".join(f"  bar {k}: {{rigid: {{mass: 1 kg, inertia: 0.1}}, points: {{A: [0, 0], B: [0, 1]}}}}" for k in range(40))
        pins = "\n".join(f"  foot {k}: {{revolute: [ground [{k}, 0], bar {k}.A]}}\n  head {k}: {{revolute: [plate.P{k}, bar {k}.B]}}" for k in range(40))
        points = ", ".join(f"P{k}: [{k}, 0]" for k in range(40))
        (self.place / "bars.yaml").write_text(
            f"bodies:\n{bars}\n  plate: {{rigid: {{mass: 1 kg, inertia: 0.1}}, points: {{{points}}}}}\njoints:\n"
            + pins.replace("ground [", "ground.G").replace(", 0],", ",") + "\nground: {points: {" + ", ".join(f"G{k}: [{k}, 0]" for k in range(40)) + "}}\n"
            + "start: {plate: {at: [0, 1]}}\nrun: {until: 0.1 s}\n")
        done = self.say("check", "bars.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("38 redundant", done.stdout)
        about = [line for line in done.stdout.splitlines() if "redundant" in line or "joint forces" in line]
        self.assertLess(len(about), 16)
        self.assertLess(max(map(len, about)), 400)

    def test_who_waits_is_told_how_long_and_may_stop(self):
        said, code = interrupted([pintle, "linearize", "swing.pintle.yaml", "--at", "1e6 s", "--set", "run.until=1e7 s",
                                  "--set", "output.every=1e4 s"], self.place, b"running to the state: ")
        self.assertEqual(code, 6)
        self.assertIn(b"stopped by the user (Ctrl-C) while running to the state; there are no results yet", said)

    def test_who_waits_is_told_the_time_left(self):
        self.assertEqual(self.say("run", "swing.pintle.yaml", "--out", "out", "-q").returncode, 0)
        (self.place / "out" / "ledger.csv").unlink()
        os.mkfifo(self.place / "out" / "ledger.csv")  # the program waits for it
        for words, awaited in (("run swing.pintle.yaml --set run.until=1e6s --set output.every=1e4s --out long", (b" %  t = ", b" left")),
                               ("linearize swing.pintle.yaml --frames 100000", (b"writing the results: ", b" %, about ", b" left")),
                               ("plot out kinetic", (b"reading the results: ", b" 50 %, about ")),
                               ("report out", (b"writing the report: ", b" %, about "))):
            with self.subTest(words):
                _, code = interrupted([pintle, *words.split()], self.place, *awaited)
                self.assertEqual(code, 6)

    def test_rows_are_limited_by_the_disk_alone(self):
        (self.place / "driven.yaml").write_text(pendulum + "drivers: {motor: {angle: [ground, rod], law: 1 rad/s*t}}\n")
        for command, scene in (("run", "swing.pintle.yaml"), ("kinematics", "driven.yaml")):
            with self.subTest(command):  # 2e7 rows
                _, code = interrupted([pintle, command, scene, "--set", "output.every=5 ns", "--out", command], self.place, b"t = ")
                self.assertEqual(code, 6)
                rows = (self.place / command / "trajectory.csv").read_text().splitlines()[-2:]
                self.assertLess(float(rows[1].split(",")[0]) - float(rows[0].split(",")[0]), 6e-9)  # none is missing before the last
        self.assertIn("`every` is less than the rounding of the times", self.say("run", "swing.pintle.yaml", "--set", "output.every=1e-300").stderr)

    def test_the_reason_for_a_method_is_its_own(self):
        said = self.say("check", "swing.pintle.yaml", "--set", "run.until=100 s").stdout
        self.assertRegex(said, r"verner87, chosen because Verner's pair needs about \d+ steps a second for its accuracy, Dormand and Prince's")

    def test_a_state_after_the_end_of_the_run(self):
        told = "warning: --at 0.2 s: the run ends at 0.1 s (run.until); it is continued to the state\n"
        self.assertIn(told, self.say("linearize", "swing.pintle.yaml", "--at", "0.2 s").stderr)
        self.assertEqual(self.say("linearize", "swing.pintle.yaml", "--at", "0.1 s").stderr, "")

    def test_who_stops_a_report_or_a_plot_is_told_what_is_missing(self):
        self.assertEqual(self.say("run", "swing.pintle.yaml", "--out", "out", "-q").returncode, 0)
        for read, words, said in (("inverse.json", ("report", "out"), "while writing the report; the page was not written"),
                                  ("ledger.csv", ("plot", "out", "kinetic"), "while reading the results; nothing was plotted")):
            (self.place / "out" / read).unlink(missing_ok=True)
            os.mkfifo(self.place / "out" / read)
            process = subprocess.Popen([pintle, *words], cwd=self.place, stderr=subprocess.PIPE, text=True)
            with (self.place / "out" / read).open("w"):  # opens once the program does, which then waits for what is written
                process.send_signal(signal.SIGINT)
                self.assertEqual((process.communicate()[1], process.returncode), (f"pintle: stopped by the user (Ctrl-C) {said}\n", 6))


if __name__ == "__main__":
    unittest.main()
