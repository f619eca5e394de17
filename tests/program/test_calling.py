"""Sweeps in parts as the pages show them: a job array, and the scripts of docs/calling.md.

usage: test_calling.py PINTLE        (PYTHONPATH: the package for Python; without it, and without Snakemake, parts are skipped)"""

import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

pintle = os.path.realpath(sys.argv.pop(1))
root = Path(__file__).resolve().parents[2]
study = """scene: scene.yaml
set: {run.until: 2 ms}
measure: {peak: peak force at gudgeon pin, lost: energy lost}
keep: [x of slider]
sweep: {latin hypercube: {count: 21, clearance: {from: 0.01 mm, to: 0.5 mm, scale: log}, speed: {from: 50 rad/s, to: 200 rad/s}}}
"""
parameters = """                                          2 variables
                      2.000000000000000e-05 clearance
                      {speed} speed
                                          2 functions
                                          1 ASV_1:peak
                                          1 ASV_2:lost
                                          2 derivative_variables
                                          1 DVV_1:clearance
                                          2 DVV_2:speed
                                          0 analysis_components
                                          1 eval_id
"""
has_package = importlib.util.find_spec("pintle") is not None


def block(page, start):
    """The block of a page that begins so."""
    blocks = re.findall(r"(?ms)^```\w*\n(.*?)^```$", (root / "docs" / page).read_text())
    found = [b for b in blocks if start in "\n".join(b.split("\n")[:2])]
    assert len(found) == 1, (page, start, len(found))
    return found[0]


class Calling(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.place = Path(place.name)
        shutil.copy(root / "examples/slider_crank_clearance.yaml", self.place / "scene.yaml")
        (self.place / "study.yaml").write_text(study)

    def do(self, *words, code=0, **environment):
        path = f"{os.path.dirname(pintle)}:{os.environ['PATH']}"
        done = subprocess.run(words, cwd=self.place, capture_output=True, text=True, env={**os.environ, "PATH": path, **environment})
        self.assertEqual(done.returncode, code, f"{words}: {done.stdout}{done.stderr}")
        return done.stdout + done.stderr

    def expect_whole(self, merged):
        self.do(pintle, "sweep", "study.yaml", "-q", "--out", "whole")
        for file in ["sweep.csv", "study.yaml", "scene.yaml"] + [f"curves/case-{k}.csv" for k in range(1, 22)]:
            self.assertEqual((self.place / merged / file).read_bytes(), (self.place / "whole" / file).read_bytes(), file)
        names = [sorted(p.name for p in (self.place / d).glob("[!.]*")) for d in (merged, "whole")]  # .snakemake_timestamp
        self.assertEqual(*names)

    def test_a_job_array(self):
        script = block("studies.md", "#SBATCH --array")
        (self.place / "array.sh").write_text(script)
        merge = re.search(r"(?m)^    (pintle merge .*?)  ", (root / "docs/studies.md").read_text())[1]
        for task in range(1, 9):
            if task == 3:
                said = self.do("sh", "-c", merge, code=2)
                self.assertIn("parts 3, 4, 5, 6, 7 and 8 of 8 are missing", said)
                self.assertFalse((self.place / "runs/study-sweep").exists())
            self.do("sh", "array.sh", SLURM_ARRAY_TASK_ID=str(task), SLURM_CPUS_PER_TASK="1", SLURM_SUBMIT_DIR=str(self.place))
        self.do("sh", "-c", merge)
        self.expect_whole("runs/study-sweep")
        again = self.do(pintle, "sweep", "study.yaml")  # continues in the merged folder, where nothing is left to do
        self.assertIn("21 of 21, 21 of them in earlier sessions", again)

    def test_options_that_are_wrong(self):
        for shard, says in {"0/4": "write 1/4 to 4/4", "5/4": "write 1/4 to 4/4", "a/b": "for example --shard 3/8", "": "variable of the script"}.items():
            self.assertIn(says, self.do(pintle, "sweep", "study.yaml", "--shard", shard, code=2))
        for command in ("fit", "sensitivity", "nonlinear", "tradeoff"):
            said = self.do(pintle, command, "study.yaml", "--shard", "1/2", code=2)
            self.assertIn(f"--shard 1/2: {command} cannot be divided: ", said)
            self.assertNotIn("--shard", self.do(pintle, command, "--help"))
        self.assertIn("--out is required", self.do(pintle, "merge", "runs", code=2))
        self.assertFalse((self.place / "runs").exists())

    def test_a_part_without_cases_and_one_whose_cases_fail(self):
        (self.place / "study.yaml").write_text("scene: scene.yaml\nmeasure: {lost: energy lost}\nset: {run.until: 1 ms}\nsweep: {list: [{speed: 9 rad/s}, {run.max steps: 1}]}\n")
        self.assertIn("none: part 3 of 3 has no case, as the study has only 2", self.do(pintle, "sweep", "study.yaml", "--shard", "3/3"))
        for part in ("1/3", "2/3"):
            self.assertIn(f"1 of 1 of part {part[0]} of 3; the study has 2 cases", self.do(pintle, "sweep", "study.yaml", "--shard", part))
        said = self.do(pintle, "merge", *(f"runs/study-sweep-{i}-of-3" for i in (3, 1, 2)), "--out", "merged")
        self.assertRegex(said, "cases ended +2 of 2\n +failed +1, the first is case 2: .*\n +finished +1\n")
        self.assertIn("exists already", self.do(pintle, "merge", "runs/study-sweep-1-of-3", "--out", "merged", code=1))

    @unittest.skipUnless(shutil.which("snakemake"), "there is no snakemake")
    def test_snakemake(self):
        (self.place / "Snakefile").write_text(block("calling.md", "# Snakefile"))
        self.do("snakemake", "--cores", "2")
        self.expect_whole("runs/study-sweep")

    @unittest.skipUnless(has_package, "there is no package for Python")
    def test_dakota(self):
        (self.place / "driver.py").write_text(block("calling.md", "# driver.py"))
        results = self.place / "results.out"
        (self.place / "params.in").write_text(parameters.format(speed="1.500000000000000e+02"))
        self.do(sys.executable, "driver.py", "params.in", "results.out")
        said = [line.split() for line in results.read_text().splitlines()]
        self.assertEqual([name for _, name in said], ["peak", "lost"])
        (self.place / "study.yaml").write_text(study.partition("keep")[0].replace("2 ms", "5 ms") + "sweep: {list: [{clearance: 0.02 mm, speed: 150 rad/s}]}\n")
        self.do(pintle, "sweep", "study.yaml", "-q", "--out", "one")
        row = (self.place / "one/sweep.csv").read_text().splitlines()[1].split(",")
        self.assertEqual([float(value) for value, _ in said], [float(x) for x in row[3:5]])
        (self.place / "params.in").write_text(parameters.format(speed="inf").replace("1 ASV_1", "0 ASV_1"))
        self.do(sys.executable, "driver.py", "params.in", "results.out")
        self.assertIn("fail: ", results.read_text())
        self.assertIn("sweep.list[1].speed", results.read_text())
        (self.place / "params.in").write_text(parameters.format(speed="1.5e2"))
        (self.place / "stopped.py").write_text(block("calling.md", "# driver.py").replace('{"run.until"', '{"run.max steps": 3, "run.until"'))
        self.do(sys.executable, "stopped.py", "params.in", "results.out")
        self.assertRegex(results.read_text(), "^fail: .+\n$")
        (self.place / "params.in").write_text(parameters.format(speed="1.5e2").replace("1 ASV_1", "0 ASV_1"))
        self.do(sys.executable, "driver.py", "params.in", "results.out")
        self.assertEqual(results.read_text().splitlines(), [f"{float(said[1][0]):.16e} lost"])

    @unittest.skipUnless(has_package, "there is no package for Python")
    def test_openturns(self):
        (self.place / "crank.py").write_text(block("calling.md", "# crank.py"))
        call = "from crank import crank; print(crank([(2e-5, 150), (4e-5, 150)]))"
        first, second = eval(self.do(sys.executable, "-c", call))
        self.assertEqual([len(first), len(second)], [2, 2])
        self.assertEqual([round(first[0]), round(second[0])], [2856, 3664])  # as on the page on Python
        if importlib.util.find_spec("openturns"):
            (self.place / "use.py").write_text(block("calling.md", "import openturns") + "assert outputs.getSize() == 20 and outputs.getDimension() == 2\n")
            self.do(sys.executable, "use.py")


if __name__ == "__main__":
    unittest.main()
