"""mechanism.py is Python, and where there is ParaView it draws: forces in their colours, couples, bodies in theirs.

usage: test_paraview.py PINTLE [--render]    --render: with pvbatch, on a display of xvfb-run's; 77 where one of them is missing"""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

pintle = os.path.realpath(sys.argv.pop(1))
render = "--render" in sys.argv and sys.argv.remove("--render") is None
examples = Path(__file__).resolve().parents[2] / "examples"


def has_paraview():
    """Debian's pvbatch comes without the modules that it runs scripts with."""
    if not (shutil.which("pvbatch") and shutil.which("xvfb-run")):
        return False
    with tempfile.NamedTemporaryFile("w", suffix=".py") as script:
        script.write("import paraview.simple\n")
        script.flush()
        return subprocess.run(["pvbatch", script.name], capture_output=True).returncode == 0


def run(place, scene):
    out = place / scene
    subprocess.run([pintle, "run", examples / f"{scene}.yaml", "--out", out, "-q"], check=True)
    return out / "mechanism.py"


class Macro(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.place = Path(place.name)

    def test_it_is_python(self):
        macro = run(self.place, "slider_crank_clearance")
        compile(macro.read_text(), macro, "exec")

    @unittest.skipUnless(render, "draws only with --render")
    def test_it_draws(self):
        # An example, and the colours seen in it: bodies' outlines, then arrows of joints, contacts, springs and loads.
        shown = {"slider_crank_clearance": ("0072b2", "d55e00", "009e73", "5c6175", "cc2924"),
                 "four_bar_flexible": ("0072b2", "009e73", "5c6175"),
                 "rear_suspension": ("d55e00", "5c6175", "cc2924", "8a6a1a"),
                 "knuckle_press": ("5c6175", "9940bf")}
        for scene, colours in shown.items():
            with self.subTest(scene):
                macro = run(self.place, scene)
                picture = self.place / f"{scene}.png"
                done = subprocess.run(["xvfb-run", "-a", "-n", str(100 + os.getpid() % 9000), "pvbatch", macro, picture], capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                pixels = (matplotlib.image.imread(picture)[:, :, :3] * 255).round()
                pixels = pixels[100:-100, :1250]  # without the legends
                for colour in colours:
                    wanted = [int(colour[i:i + 2], 16) for i in (0, 2, 4)]
                    near = (abs(pixels - wanted).max(axis=2) <= 12).sum()
                    self.assertGreater(near, 4, colour)


if __name__ == "__main__":
    if render:
        if not has_paraview():
            sys.exit(77)
        import matplotlib.image
    unittest.main()
