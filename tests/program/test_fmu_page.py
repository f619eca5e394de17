#!/usr/bin/env python3
"""docs/fmu.md is true: its scene, exported, and its importer, run, print what the page says."""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = sys.argv.pop(1)
PAGE = Path(__file__).resolve().parents[2] / "docs" / "fmu.md"


class Page(unittest.TestCase):
    def test_its_importer_prints_what_it_says(self):
        text = PAGE.read_text()
        scene, importer = (re.search(rf"```{kind}\n(.*?)```", text, re.S).group(1) for kind in ("yaml", "python"))
        printed = re.search(r"It prints\n\n((?:    .*\n)+)", text).group(1).replace("    ", "")
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "arm.yaml").write_text(scene)
            Path(folder, "importer.py").write_text(importer)
            subprocess.run([PROGRAM, "fmu", "arm.yaml", "-q"], cwd=folder, check=True)
            done = subprocess.run([sys.executable, "importer.py"], cwd=folder, capture_output=True, text=True)
        self.assertEqual((done.stdout, done.stderr), (printed, ""))


if __name__ == "__main__":
    unittest.main()
