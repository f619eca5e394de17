"""Pictures hold what they draw, and unknown words of plots, pictures and films end with code 2 and the words that there are.

usage: test_pictures.py PINTLE"""

import math
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

from terminal import interrupted

pintle = os.path.realpath(sys.argv.pop(1))
has_pictures = (Path(pintle).parent / "pintle-picture").exists()
load_colour = (153, 64, 191)
impact_colour = (230, 26, 115)
pushed = """
bodies: {{bar: {{rigid: {{mass: 1000 kg, inertia: 1000}}, points: {{O: [-1, 0], end: [1, 0.2]}}}}}}
joints: {{hinge: {{revolute: [ground, bar.O]}}}}
forces: {{push: {{force: [{x:.6f}, {y:.6f}], at: bar.end}}}}
run: {{until: 1 ms}}
output: {{frames: 2}}
"""
dropped = """
gravity: [0, -10]
ground: {profiles: {floor: {path: [[1, 0], [-1, 0]], material: left}}}
bodies: {ball: {rigid: {mass: 1 kg, inertia: 1e-3}, profiles: {rim: {disc: [0, 0], radius: 5 cm}}, pose: {at: [0, 0.25]}}}
contacts: {hit: {between: [ball.rim, ground.floor], %s}}
start: {ball: {at: [0.3, 0.25]}}
run: {until: 0.4 s}
output: {frames: 81}
"""
fourteen = "bodies:\n" + "".join(
    f"  link {k}: {{rigid: {{mass: 1 kg, inertia: 1}}, pose: {{at: [{k}, 0]}}}}\n" for k in range(1, 15)) + """
run: {until: 100 ms}
output: {frames: 2}
"""
body_colours = [tuple(bytes.fromhex(c)) for c in (
    "0072b2", "d55e00", "009e73", "cc79a7", "56b4e9", "e69f00", "961e1e", "6a5cf0", "93a34a", "8a1466", "694b4b", "2d694b")]
ink, pale_ink = (41, 46, 56), (105, 109, 116)
gears = """
bodies:
  sun: {rigid: {mass: 1 kg, inertia: 0.01}, points: {O: [0, 0]}}
  wheel: {rigid: {mass: 1 kg, inertia: 0.01}, points: {O: [0, 0]}, pose: {at: [0.3, 0]}}
joints:
  a: {revolute: [ground, sun.O]}
  b: {revolute: [ground.Q, wheel.O]}
  mesh: {gear: [sun, wheel], radii: [0.1, 0.2]}
ground: {points: {Q: [0.3, 0]}}
run: {until: 1 ms}
output: {frames: 2}
"""


def pixels(file, most=8000):
    """Rows of (red, green, blue) of a PNG of 8 bits a colour, at most so many."""
    data, at, packed = file.read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, _, colours = struct.unpack(">IIBB", body[:10])
        if kind == b"IDAT":
            packed += body
        at += 12 + length
    step = {2: 3, 6: 4}[colours]
    raw, before, rows = zlib.decompress(packed), bytearray(width * step), []
    for y in range(min(height, most)):
        begin = y * (width * step + 1)
        method, row = raw[begin], bytearray(raw[begin + 1:begin + 1 + width * step])
        for i in range(len(row)):
            left = row[i - step] if i >= step else 0
            above, corner = before[i], before[i - step] if i >= step else 0
            if method == 4:
                guess = left + above - corner
                near = min((abs(guess - left), 0, left), (abs(guess - above), 1, above), (abs(guess - corner), 2, corner))[2]
            else:
                near = (0, left, above, (left + above) // 2)[method]
            row[i] = (row[i] + near) & 255
        before = row
        rows.append([tuple(row[i:i + 3]) for i in range(0, len(row), step)])
    return rows


class Pictures(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.place = Path(place.name)

    def say(self, *words):
        return subprocess.run([pintle, *words], cwd=self.place, capture_output=True, text=True)

    def run_of(self, scene, out):
        (self.place / "scene.yaml").write_text(scene)
        done = self.say("run", "scene.yaml", "-q", "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)

    @unittest.skipUnless(has_pictures, "the program that draws was not built")
    def test_a_time_without_frames_is_told(self):
        self.run_of(pushed.format(x=1, y=0), "out")
        for time, told in (("99", True), ("-1", True), ("1e-3", False), ("4e-4", False)):
            done = self.say("picture", "out", "a.png", f"--time={time}")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(f"--time {time}: the frames of out are from 0 to 0.001 s" in done.stderr, told, done.stderr)

    @unittest.skipUnless(has_pictures, "the program that draws was not built")
    def test_it_says_what_it_wrote(self):
        self.run_of(pushed.format(x=1, y=1), "run")
        done = self.say("picture", "run", "a.png", "--size", "700x400")
        self.assertEqual((done.returncode, done.stdout), (0, "  a.png  700 x 400\n"), done.stderr)
        self.assertEqual(self.say("picture", "run", "a.png", "-q").stdout, "")

    @unittest.skipUnless(has_pictures, "the program that draws was not built")
    def test_one_is_not_many(self):
        self.run_of(pushed.format(x=1, y=1), "run")
        (self.place / "lever.yaml").write_text(pushed.format(x=0, y=0).replace("run: {until: 1 ms}", "").replace("output: {frames: 2}", ""))
        self.assertEqual(self.say("statics", "lever.yaml", "-q", "--out", "rest").returncode, 0)
        self.assertIn("rest has 1 frame, number 0; asked for 3", self.say("picture", "rest", "a.png", "--frame", "3").stderr)
        if shutil.which("ffmpeg"):
            self.assertIn("  1 picture of ", self.say("film", "run", "a.mp4", "--to", "0").stdout)

    @unittest.skipUnless(has_pictures and shutil.which("ffmpeg"), "the program that draws was not built, or there is no ffmpeg")
    def test_a_film_tells_the_time_left(self):
        self.run_of(pushed.format(x=1, y=1).replace("frames: 2", "frames: 1000"), "run")
        self.assertEqual(interrupted([pintle, "film", "run", "a.mp4"], self.place, b"drawing picture ", b" left")[1], 6)

    @unittest.skipUnless(has_pictures, "the program that draws was not built")
    def test_names_keep_off_the_time(self):
        self.run_of(fourteen, "out")
        is_one_of = lambda p, colours: min(p) < 200 and any(max(abs(a - b) for a, b in zip(p, c)) <= 4 for c in colours)
        for width in ("1400", "800", "500", "300"):
            self.assertEqual(self.say("picture", "out", "a.png", "--size", width).returncode, 0)
            rows = pixels(self.place / "a.png", 62 + 3 * 34)
            both = 0
            for row in rows:
                time = [x for x, p in enumerate(row) if is_one_of(p, (ink, pale_ink))]
                bodies = [x for x, p in enumerate(row) if is_one_of(p, body_colours)]
                if time and bodies:
                    both += 1
                    self.assertLess(max(time) + 10, min(bodies), width)
            self.assertGreater(both, 2, width)

    @unittest.skipUnless(has_pictures, "the program that draws was not built")
    def test_arrows_end_inside(self):
        for k in range(8):
            angle = math.pi * k / 4
            self.run_of(pushed.format(x=math.cos(angle), y=math.sin(angle)), f"out{k}")
            for size in ("300", "300x300", "400x220", "220x400"):
                done = self.say("picture", f"out{k}", "a.png", "--size", size)
                self.assertEqual(done.returncode, 0, done.stderr)
                rows = pixels(self.place / "a.png")
                near = lambda p: max(abs(a - b) for a, b in zip(p, load_colour)) < 60
                found = [(x, y) for y, row in enumerate(rows) for x, p in enumerate(row) if near(p)]
                # Names stand above and scales below, over white; the arrow's own colour is there in words too: the foot is looked at beside.
                self.assertTrue(found)
                self.assertTrue(all(2 <= x < len(rows[0]) - 2 for x, _ in found), (k, size))
                tip = self.length_of_arrow(found, len(rows))
                self.assertGreater(tip, 12, (k, size))

    @unittest.skipUnless(has_pictures, "the program that draws was not built")
    def test_impacts_are_points_from_their_time_on(self):
        magenta = lambda p: max(abs(a - b) for a, b in zip(p, impact_colour)) < 20
        for law in ("normal: {hunt-crossley: {stiffness: 1e7, exponent: 1, restitution: 0}}", "model: impact, restitution: 0"):
            shutil.rmtree(self.place / "out", ignore_errors=True)
            self.run_of(dropped % law, "out")
            for options, seen in ((("--time", "0.19"), False), (("--time", "0.205"), True), (("--time", "0.205", "--no-impacts"), False)):
                self.assertEqual(self.say("picture", "out", "a.png", "--size", "500", *options).returncode, 0)
                rows = pixels(self.place / "a.png")
                self.assertEqual(any(magenta(p) for row in rows[:-70] for p in row), seen, (law, options))

    @staticmethod
    def length_of_arrow(found, height):
        inside = [(x, y) for x, y in found if y < 0.75 * height]
        return max(math.dist(a, b) for a in inside[::7] or [(0, 0)] for b in inside[::7] or [(0, 0)])

    def test_unknown_columns(self):
        self.run_of(pushed.format(x=1, y=0), "out")
        for words, said in ((("bar.angel",), 'did you mean "bar.angle"?'), (("zzz",), "Known here: t, bar.x"), (("t", "--against", "br.x"), '"bar.x"')):
            done = self.say("plot", "out", *words)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(said, done.stderr)
        done = self.say("plot", "nowhere", "bar.x")  # a folder that is not there is no word
        self.assertEqual(done.returncode, 1)
        self.assertIn("there is no such folder", done.stderr)

    @unittest.skipUnless(has_pictures, "the program that draws was not built")
    def test_unknown_words_and_endings(self):
        self.run_of(gears, "out")
        for command, file in (("picture", "a.png"), ("film", "a.mp4")):
            if command == "film" and not shutil.which("ffmpeg"):
                continue  # then that is what a film says first
            for option in ("--around", "--field"):
                self.assertEqual(self.say(command, "out", file, option, "zzz").returncode, 2)
            done = self.say(command, "out", file, "--around", "zzz")
            names = re.search("Known here: (.*)\\.", done.stderr).group(1).replace(" or ", ", ").split(", ")
            self.assertIn("sun", names)
            self.assertEqual(len(names), len(set(names)), names)
        endings = {"picture": ("png",), "film": ("mp4", "webm", "gif")}
        for command, own in endings.items():
            done = self.say(command, "out", "a.jpg")
            self.assertEqual(done.returncode, 2)
            told = re.search("ends? in ([^;]*);", done.stderr).group(1)
            self.assertEqual(set(re.findall("\\.(\\w+)", told)), set(own), done.stderr)
            of_the_other = {"picture": "--fps", "film": "--frame"}[command]
            self.assertNotIn(of_the_other, self.say(command, "out", "a.png", "--zzzzzzzz").stderr)


if __name__ == "__main__":
    unittest.main()
