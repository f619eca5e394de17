"""Results as one HDF5 file, read by h5py: each table to the last bit, whole or not there.

usage: test_hdf5.py PINTLE"""

import csv
import os
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from terminal import interrupted

pintle = os.path.realpath(sys.argv.pop(1))
try:
    import h5py
    import numpy
except ImportError:
    sys.exit(print("skipped: there is no h5py; apt-get install python3-h5py") or 77)
if not (Path(pintle).parent / "pintle-hdf5").exists():
    sys.exit(print("skipped: pintle-hdf5 was not built; apt-get install libhdf5-dev pkgconf") or 77)

scene = """
gravity: [0, -9.81]
bodies:
  rod: {rigid: {mass: 1 kg, inertia: 0.1}, points: {O: [-1, 0], E: [1, 0]}}
joints:
  main pin: {revolute: [ground, rod.O], clearance: {radial: 1 mm, bearing radius: 20 mm, bearing: ground,
             normal: {lankarani-nikravesh: {restitution: 0.8, young: 207 GPa, poisson: 0.3}}}}
start: {rod: {angle: 0 deg}}
events: {"first row": {when: rod.angle < -1 deg, do: {row: true}}}
run: {until: 0.3 s}
output: {every: 0.1 ms}
"""
pendulum = """
gravity: [0, -9.81]
parameters: {m1: 1 kg}
bodies: {rod: {rigid: {mass: m1, inertia: 0.1}, points: {O: [-1, 0]}}}
joints: {hinge: {revolute: [ground, rod.O]}}
start: {rod: {angle: -80 deg}}
events: {far: {when: rod.angle < -81 deg, do: {row: true}}}
run: {until: 0.1 s}
"""


def table_of(file):
    with open(file, newline="", encoding="utf-8") as text:
        header, *rows = csv.reader(text)
    return header, rows


def number(field):
    try:
        return float(field or "nan")
    except ValueError:
        return None


def bits(values):
    return [struct.pack("<d", x) if x == x else b"nan" for x in values]


class Hdf5(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.place = Path(place.name)

    def say(self, *words, **more):
        return subprocess.run([pintle, *map(str, words)], cwd=self.place, capture_output=True, text=True, **more)

    def folder(self, tables, name="results"):
        folder = self.place / name
        folder.mkdir()
        for table, text in tables.items():
            (folder / table).write_text(text, encoding="utf-8")
        return folder

    def converted(self, folder):
        done = self.say("hdf5", folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        file = h5py.File(folder / "results.h5", "r")
        self.addCleanup(file.close)
        return file

    def equals_its_tables(self, file, folder):
        tables = sorted(folder.glob("*.csv"))
        self.assertEqual({k for k in file if isinstance(file[k], h5py.Group)}, {t.stem for t in tables})
        for table in tables:
            header, rows = table_of(table)
            group = file[table.stem]
            self.assertEqual(len(group), len(header))
            for heading, link, column in zip(header, group.attrs["columns"], zip(*rows) if rows else [()] * len(header)):
                data = group[link]
                self.assertEqual(data.attrs["heading"], heading)
                name, _, unit = heading.removesuffix("]").rpartition(" [") if heading.endswith("]") else (heading, "", "")
                self.assertEqual((link, data.attrs["unit"]), (name.replace("/", "_"), unit))
                numbers = [number(field) for field in column]
                if None in numbers or heading in ("joint", "event", "did"):
                    self.assertEqual([x.decode() for x in data[:]], list(column))
                else:
                    self.assertEqual(data.dtype, numpy.float64)
                    self.assertEqual(bits(data[:]), bits(numbers), heading)

    def test_a_run(self):
        (self.place / "scene.yaml").write_text(scene)
        done = self.say("run", "scene.yaml", "--out", "out", "--hdf5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("HDF5: out/results.h5", done.stdout)
        with h5py.File(self.place / "out" / "results.h5", "r") as file:
            self.equals_its_tables(file, self.place / "out")
            self.assertEqual(file["run.json"][()].decode(), (self.place / "out" / "run.json").read_text())
            self.assertGreater(len(file["trajectory/rod.angle"]), 3000)
            self.assertEqual(file["trajectory/rod.angle"].attrs["unit"], "rad")
            self.assertEqual(file["actions/event"][0], b"first row")
            self.assertGreater(len(file["events/joint"]), 0)
            self.assertEqual(file["trajectory/t"].compression, "gzip")

    def test_a_run_without_the_program_is_refused_at_once(self):
        (self.place / "scene.yaml").write_text(scene)
        alone = shutil.copy(pintle, self.place / "pintle")
        done = subprocess.run([alone, "run", "scene.yaml", "--out", "out", "--hdf5"], cwd=self.place, capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("pintle-hdf5 is missing, and `pintle run --hdf5` needs it; build all programs (./dev build)", done.stderr)
        self.assertEqual(list(self.place.glob("out*")), [])

    def test_names_text_and_empty_fields(self):
        folder = self.folder({
            "odd.name.csv": 't [s],"main pin, worn.fx on rod [N]",a/b.c [1/s],"a_b.c [m]",.,,did\r\n'
                            '0,1,,-0,1,,x\r\n0.1,5e-324,inf,1.7976931348623157e+308,2,,"says ""no"", ä\nand more"\r\n-0.1,2.2250738585072011e-308,-inf,-1e-5,,,\r\n',
            "empty.csv": "joint,begin [s]\n",
            "words.csv": "a,b,c,d\nnan,1,infinity,1e999\n1,x,2,3\n",
            "study.json": '{"α": 1}\n'})
        file = self.converted(folder)
        odd = file["odd.name"]
        self.assertEqual(list(odd.attrs["columns"]), ["t", "main pin, worn.fx on rod", "a_b.c", "a_b.c_2", "_", "__2", "did"])
        self.assertEqual([odd[c].attrs["heading"] for c in odd.attrs["columns"]],
                         ["t [s]", "main pin, worn.fx on rod [N]", "a/b.c [1/s]", "a_b.c [m]", ".", "", "did"])
        self.assertEqual(bits(odd["main pin, worn.fx on rod"][:]), bits([1, 5e-324, 2.2250738585072011e-308]))
        self.assertEqual(bits(odd["a_b.c"][:]), bits([numpy.nan, numpy.inf, -numpy.inf]))
        self.assertEqual(bits(odd["a_b.c_2"][:]), bits([-0.0, 1.7976931348623157e308, -1e-5]))
        self.assertEqual(bits(odd["__2"][:]), bits([numpy.nan] * 3))
        self.assertEqual([x.decode() for x in odd["did"][:]], ["x", 'says "no", ä\nand more', ""])
        self.assertEqual(file["empty/joint"].shape, (0,))
        self.assertEqual([[x.decode() for x in file["words"][c][:]] for c in "abcd"], [["nan", "1"], ["1", "x"], ["infinity", "2"], ["1e999", "3"]])
        self.assertEqual(file["study.json"][()].decode(), '{"α": 1}\n')

    def test_a_killed_run(self):
        (self.place / "scene.yaml").write_text(scene.replace("until: 0.3 s", "until: 900 s, max steps: 2000000000"))
        process = subprocess.Popen([pintle, "run", "scene.yaml", "--out", "out", "--quiet"], cwd=self.place)
        try:
            while process.poll() is None:
                found = list(self.place.glob("out.part-*/trajectory.csv"))
                if found and found[0].read_bytes().count(b"\n") > 1000:
                    break
                time.sleep(0.002)
        finally:
            process.send_signal(signal.SIGKILL)
        process.wait()
        (left,) = self.place.glob("out.part-*")
        with (left / "trajectory.csv").open("r+b") as table:  # a row that the kill has cut
            table.truncate(table.read().rfind(b"\n") + 1)
            table.seek(0, 2)
            table.write(b"9999,1,2")
        done = self.say("hdf5", left, "killed.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"{left}: the run did not finish; the whole rows of its tables are converted", done.stderr)
        text = (left / "trajectory.csv").read_bytes()
        (left / "trajectory.csv").write_bytes(text[: text.rfind(b"\n") + 1])
        with h5py.File(self.place / "killed.h5", "r") as file:
            self.assertGreater(len(file["trajectory/t"]), 900)
            self.equals_its_tables(file, left)

    def killed(self, text):
        """The folder of a run of this scene, still running; it is killed when the test ends."""
        (self.place / "scene.yaml").write_text(text)
        process = subprocess.Popen([pintle, "run", "scene.yaml", "--out", "out", "--quiet"], cwd=self.place)
        self.addCleanup(lambda: (process.kill(), process.wait()))
        while process.poll() is None:
            found = list(self.place.glob("out.part-*/trajectory.csv"))
            if found and found[0].read_bytes().count(b"\n") > 100:
                break
            time.sleep(0.002)
        return process, next(self.place.glob("out.part-*"))

    def test_a_run_that_goes_on_is_told_from_a_killed_one(self):
        process, folder = self.killed(scene.replace("until: 0.3 s", "until: 900 s, max steps: 2000000000"))
        done = self.say("hdf5", folder, "now.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"{folder}: the run is still going on; the file holds the rows written so far", done.stderr)
        with h5py.File(self.place / "now.h5", "r") as file:
            self.assertEqual({k for k in file if isinstance(file[k], h5py.Dataset)}, {"run.json"})  # nothing else ends in .json
        process.kill(), process.wait()
        self.assertIn(f"{folder}: the run did not finish;", self.say("hdf5", folder, "then.h5").stderr)

    def test_columns_of_text_are_text_without_rows_too(self):
        (self.place / "s.yaml").write_text(pendulum)
        many = "scene: s.yaml\nmeasure: {turn: final angle of rod}\n"
        (self.place / "sweep.yaml").write_text(many + "sweep: {grid: {m1: [1 kg, -1 kg]}}\n")
        (self.place / "fit.yaml").write_text(many + "vary: {m1: {from: 1 kg, to: 2 kg}}\ngoal: {minimise: turn}\nfit: {evaluations: 8}\n")
        (self.place / "scatter.yaml").write_text(many + "sensitivity: {parameters: {m1: {uniform: 1 g}}}\n")
        (self.place / "trade.yaml").write_text(many + "tradeoff: {error: 1%, repeats: 1, axes: {finer: {run.tolerance: [1e-4, 1e-6, 1e-8]}}}\n")
        (self.place / "orbit.yaml").write_text("scene: s.yaml\nover: {m1: [1 kg, 2 kg]}\ndirection: both\n"
                                               "section: {every: 10 ms, record: {a: rod.angle}, transient: 0, returns: 3}\n")
        varied, seen = {("tradeoff", "finer")}, set()
        for name, file, *part in (("run", "s.yaml"), ("statics", "s.yaml"), ("linearize", "s.yaml"), ("sweep", "sweep.yaml"),
                                  ("part", "sweep.yaml", "--shard", "1/1"), ("fit", "fit.yaml"), ("sensitivity", "scatter.yaml"),
                                  ("tradeoff", "trade.yaml"), ("nonlinear", "orbit.yaml")):
            command = "sweep" if part else name
            done = self.say(command, file, *part, "--out", name, "-q")
            self.assertIn(done.returncode, (0, 4), done.stderr)
            whole = self.place / name
            kinds = []
            for folder in (whole, self.folder({t.name: t.read_text().partition("\n")[0] + "\n" for t in whole.glob("*.csv")}, name + "-bare")):
                self.assertEqual(self.say("hdf5", folder, "all.h5").returncode, 0)
                with h5py.File(self.place / "all.h5", "r") as h5:
                    kinds.append({(t, c): h5[t][c].dtype for t in h5 if isinstance(h5[t], h5py.Group) for c in h5[t]})
            for column in kinds[0].keys() - varied:
                self.assertEqual(kinds[0][column], kinds[1][column], (command, column))
                seen |= {column} if kinds[0][column] != numpy.float64 else set()
        for column in (("events", "joint"), ("actions", "did"), ("sweep", "reason"), ("sweep-part", "reason"), ("timings", "process.thread"),
                       ("values", "reason"), ("statics", "quantity")):
            self.assertIn(column, seen)
        points = self.converted(self.folder({"points.csv": "point,x [m]\n12,0.5\n013,1\n"}, "points"))
        self.assertEqual([p.decode() for p in points["points/point"][:]], ["12", "013"])

    def test_a_table_of_another_program(self):
        file = self.converted(self.folder({"T.CSV": "\ufefft [s],x\n0,1\n", "u.csv": "a\n1\n"}))
        self.assertEqual(list(file["T"].attrs["columns"]), ["t", "x"])
        for text, what in (("t [s];x\n0;1\n", "semicolons"), ("t [s]\tx\n0\t1\n", "tabs")):
            done = self.say("hdf5", self.folder({"t.csv": text}, what))
            self.assertEqual(done.returncode, 1)
            self.assertIn(f"{what}/t.csv:1: its columns are separated by {what}, but results by commas; write it with commas", done.stderr)

    def test_a_folder_and_a_file_of_any_name(self):
        self.folder({"t.csv": "t [s]\n1\n"}, "-x")
        for words in (("--", "-x"), ("-q", "--", "-x", "-y.H5"), ("--out", "z.HDF5", "--", "-x")):
            done = self.say("hdf5", *words)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(all((self.place / file).exists() for file in ("-x/results.h5", "-y.H5", "z.HDF5")))

    def test_what_a_folder_without_tables_holds_is_told(self):
        self.folder({"journal-0.txt": "", "study.yaml": "", "scene.yaml": ""}, "study")
        self.assertIn("study: has no tables (.csv): it holds a study that has not ended; to continue it, repeat its command with the same --out",
                      self.say("hdf5", "study").stderr)
        self.folder({}, "out.part-abcdef")
        self.assertIn("out.part-abcdef: has no tables (.csv): its run was killed before it wrote any tables; run its scene again",
                      self.say("hdf5", "out.part-abcdef").stderr)

    def test_what_cannot_be_read_is_named(self):
        cut = self.folder({"t.csv": "t [s],x\n0,1\n1,2"})
        for text, said in (("t [s],x\n0,1\n1,2", "t.csv:3: the line is cut off"), ("t [s],x\n0,1\n1\n", "t.csv:3: has 1 fields, but the header has 2"),
                           ('t [s],x\n0,"1\n', "t.csv:2: a quotation mark is not closed"), ("", "t.csv: cannot be read: it is empty")):
            (cut / "t.csv").write_text(text)
            done = self.say("hdf5", "results")
            self.assertEqual(done.returncode, 1)
            self.assertIn(said, done.stderr)
            self.assertEqual([f.name for f in cut.iterdir()], ["t.csv"])
        self.folder({"run.json": "{}"}, "none")
        for words, code, said in ((["none"], 1, "none: has no tables (.csv)"), (["missing"], 1, "missing: there is no such folder"),
                                  (["results/t.csv"], 1, "results/t.csv: is not a folder"), (["results", "t.csv"], 2, "t.csv: an HDF5 file is called NAME.h5"),
                                  (["results", "no/t.h5"], 1, "no/t.h5: cannot be written"), ([], 2, "results is required")):
            done = self.say("hdf5", *words)
            self.assertEqual(done.returncode, code, words)
            self.assertIn(said, done.stderr)

    def test_an_older_file_is_replaced(self):
        folder = self.folder({"t.csv": "t [s]\n1\n"})
        (folder / "results.h5").write_bytes(b"old" * 100_000)
        self.assertEqual(list(self.converted(folder)["t/t"][:]), [1])
        self.assertEqual(sorted(f.name for f in folder.iterdir()), ["results.h5", "t.csv"])
        (self.place / "taken.h5").mkdir()
        self.assertIn("taken.h5: is a folder", self.say("hdf5", "results", "taken.h5").stderr)
        (self.place / "full.h5").symlink_to("/dev/full")
        self.assertIn("full.h5: is not an ordinary file", self.say("hdf5", "results", "full.h5").stderr)
        self.assertEqual(self.say("hdf5", "results", "--out", "named.hdf5").returncode, 0)
        self.assertTrue((self.place / "named.hdf5").exists())

    def test_a_full_disk_leaves_what_was_there(self):
        lines = "".join(f"{i},{i * 0.7 ** (i % 50)!r},name {i * 7919 % 10007}\n" for i in range(20_000))
        folder = self.folder({"t.csv": "t [s],x [m],name\n" + lines, "ledger.csv": "t [s]\n1\n"})
        self.converted(folder).close()
        whole = (folder / "results.h5").stat().st_size
        (folder / "results.h5").write_bytes(b"old")
        for k in range(40):
            most = whole * k // 40
            done = self.say("hdf5", folder, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most)))
            self.assertEqual(done.returncode, 1, (most, done.stderr))
            self.assertIn(f"{folder}/results.h5: cannot be written (File too large); ", done.stderr)
            self.assertEqual((folder / "results.h5").read_bytes(), b"old")
            self.assertEqual(len(list(folder.iterdir())), 3)

    def test_a_table_of_many_columns(self):
        names = [f"body {k}.angle [rad]" for k in range(12_000)]
        folder = self.folder({"wide.csv": ",".join(names) + "\n" + "".join(",".join(str(k + i) for k in range(len(names))) + "\n" for i in range(3))})
        wide = self.converted(folder)["wide"]
        self.assertEqual(list(wide.attrs["columns"]), [n.removesuffix(" [rad]") for n in names])
        self.assertEqual(list(wide["body 11999.angle"][:]), [11999, 12000, 12001])

    def test_rows_of_many_blocks_and_long_texts(self):
        rows = [(i, i / 7, f"{i} " + "long " * (i % 3 * 100)) for i in range(150_000)]
        folder = self.folder({"t.csv": "n,x [m],text\n" + "".join(f"{n},{x!r},{text}\n" for n, x, text in rows)})
        table = self.converted(folder)["t"]
        self.assertEqual(bits(table["n"][:]), bits([float(n) for n, _, _ in rows]))
        self.assertEqual(bits(table["x"][:]), bits([x for _, x, _ in rows]))
        self.assertEqual([t.decode() for t in table["text"][:]], [t for _, _, t in rows])

    def test_a_stop_leaves_no_file(self):
        folder = self.folder({"t.csv": "t [s],x [m]\n" + "1,0.123456789012345\n" * 2_000_000})
        said, code = interrupted([pintle, "hdf5", folder], folder, b"t.csv, row ", b" left")
        self.assertEqual(code, 6, said)
        self.assertIn(b"stopped by the user (Ctrl-C); there is no ", said)
        self.assertEqual([f.name for f in folder.iterdir()], ["t.csv"])


if __name__ == "__main__":
    unittest.main()
