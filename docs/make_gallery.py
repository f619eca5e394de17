#!/usr/bin/env python3
"""Writes docs/gallery.md and the pictures in docs/gallery/: each scene of examples/ as the program draws it, with what its head says to expect and
what the program says it found. docs/gallery/numbers.json keeps the latter.

usage: make_gallery.py PINTLE PINTLE_PICTURE [SCENE …]      of some scenes the pictures and numbers alone are made again
"""

import json
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

root = Path(__file__).resolve().parent.parent
frames = 25
more_frames = {"breaker": 500, "knuckle_press": 100}  # an event ends them long before run.until
# Of the frames of a run, the one that shows what the scene is about; otherwise the one after a third.
telling = {"box_and_ramp": 0.6, "breaker": 0.8, "chain_200": 0.9, "guide_with_play": 0.5, "latch": 0.5, "pendulum": 0.1, "rotating_beam": 0.5,
           "walker": 0.7, "woodpecker": 0.5, "geneva": 0.4, "four_bar_flexible": 0.7, "shear_pin": 0.9}
around = {"walker": "body", "woodpecker": "bird"}  # small beside the ground or the pole that they move along
fields = {"modes": ("modes.vtu", "mode 01 [mm]"), "static": ("static.vtu", "von Mises [Pa]"), "mesh": ("mesh.vtu", "scaled Jacobian")}
greatest = 45_000  # bytes of a picture
# Rows of the program's summary that differ from run to run or from machine to machine, or say how it was computed.
of_the_run = ("results", "time ", "steps", "method", "constraints held", "unexplained", "warning", "note", "finished", "at rest", "stopped", "found",
              "Sturm", "rigid motions", "held ", "sum ", "mode ", "mesh ", "stress jump", "over ")
most_numbers = 8
groups = [
    ("Linkages", "pendulum four_bar_spring inverse_four_bar coupler_curve chebyshev_straight_line hoecken_straight_line kinematics_quick_return "
     "statics_lever double_wishbone rear_suspension excavator chain_200"),
    ("Real joints, contact, friction", "slider_crank_clearance guide_with_play plunger_pump cam_roller box_and_ramp walker woodpecker geneva ratchet "
     "drum_brake stick_slip stage_microslip jamming_drawer release_hook latch"),
    ("Flexible links", "flexible_slider_crank four_bar_flexible rotating_beam valve_spring_surge modes_beam modes_eye_bar conrod_drawing static_bracket "
     "static_pin fv32_tapered_membrane"),
    ("Gears, belts, cams", "planetary_gear planetary_gearbox gear_backlash belt_drive cam_valve_train"),
    ("Engines, controllers, events", "engine_single engine_four engine_map motor_flywheel pid_arm knuckle_press breaker vacuum_breaker gearbox shear_pin "
     "rubber_mount"),
]


class Scene:
    def __init__(self, file):
        text = file.read_text(encoding="utf-8")
        head = [line[1:].strip() for line in re.match(r"(?:#.*\n)+", text)[0].splitlines()]
        self.file, self.name, self.numbers = file, file.stem, []
        self.title = re.search(r"(?m)^title: *(.*)", text)[1].strip("\"'")
        told = re.search(r"pintle (run|kinematics|inverse|statics|static|modes|mesh|linearize) examples/" + re.escape(file.name), "\n".join(head))
        asked = {"statics": ("statics_",), "modes": ("modes_",), "static": ("static_",), "kinematics": ("kinematics_",)}
        by_name = [c for c, begins in asked.items() if file.stem.startswith(begins)]
        told = re.search(rf"pintle (run) examples/{file.name}", text) or told
        self.command = told[1] if told else by_name[0] if by_name else "run" if re.search(r"(?m)^run:", text) else "modes"
        if file.stem == "conrod_drawing":
            self.command = "static"
        words = [h for h in head if not h.startswith(("yaml-language-server", "pintle ", "writes "))]
        self.words = re.sub(r"\n{2,}", "\n\n", "\n".join(words)).strip()

    @property
    def picture(self):
        return root / "docs" / "gallery" / f"{self.name}.png"

    def draw(self, pintle, draw):
        with tempfile.TemporaryDirectory() as place:
            out = Path(place) / "out"
            command = [pintle, self.command, str(self.file), "--out", str(out)]
            if self.command in ("run", "kinematics", "inverse"):
                command += ["--set", f"output.frames={more_frames.get(self.name, frames)}"]
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode not in (0, 5):
                return f"{self.name}: {' '.join(command)}: {done.stderr}"
            self.numbers = numbers_of(done.stdout)
            self.picture.parent.mkdir(exist_ok=True)
            for width in (560, 480, 400, 320, 260, 200):
                if self.command in fields:
                    file, field = fields[self.command]
                    shown = [str(sorted(out.rglob(file))[-1]), str(self.picture), "--field", field]
                else:
                    written = len(list(out.glob("frames/[0-9]*.vtu")))
                    frame = round(telling.get(self.name, 1 / 3) * (written - 1))
                    shown = [str(out), str(self.picture), "--frame", str(frame)]
                    if self.name in around:
                        shown += ["--around", around[self.name]]
                done = subprocess.run([draw, *shown, "--size", str(width)], capture_output=True, text=True)
                if done.returncode != 0:
                    return f"{self.name}: {done.stderr}"
                if self.picture.stat().st_size <= greatest:
                    return ""
            return f"{self.name}: its picture stays larger than {greatest} bytes"

    def section(self):
        found = "\n".join(self.numbers)
        return (f"### {self.title[0].upper() + self.title[1:]}\n\n![{self.title}](gallery/{self.name}.png)\n\n"
                f"[{self.name}.yaml](../examples/{self.name}.yaml), `./dev {self.command} examples/{self.name}.yaml`\n\n{self.escaped()}\n"
                + (f"\n```\n{found}\n```\n" if found else ""))

    def escaped(self):
        return re.sub(r"([*_<>|])", r"\\\1", self.words)


def numbers_of(summary):
    """What the program found, from its summary: its rows of results, each "label  value"."""
    out = []
    for line in summary.splitlines()[1:]:
        row = re.sub(r"[,;]? *(/tmp/|\(error of).*", "", line.rstrip())
        if mode := re.match(r" +(\d+) +(\d[\d.e+-]*) ", row):
            out.append(f"  mode {mode[1]}  {mode[2]} Hz")
        elif row.strip() and not row.strip().startswith(of_the_run):
            out.append(row)
    return out[:most_numbers]


def main(pintle, draw, *names):
    scenes = {s.stem: s for s in sorted((root / "examples").glob("*.yaml"))}
    scenes = {name: Scene(file) for name, file in scenes.items() if re.search(r"(?m)^(bodies|include|instances|assemblies):", file.read_text())
              and name != "engine_cylinder"}  # a part of engine_four
    kept = root / "docs" / "gallery" / "numbers.json"
    if names and kept.exists():
        for name, numbers in json.loads(kept.read_text(encoding="utf-8")).items():
            if name in scenes:
                scenes[name].numbers = numbers
    chosen = [scenes[n] for n in names] or list(scenes.values())
    with ThreadPoolExecutor(2) as pool:
        troubles = [t for t in pool.map(lambda s: s.draw(pintle, draw), chosen) if t]
    kept.write_text(json.dumps({n: s.numbers for n, s in scenes.items()}, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    listed = {name for _, group in groups for name in group.split()}
    page = ("# Gallery\n\nEach scene of `examples/`, drawn by the program, with what its file says to expect and what the program found. Written by `./dev gallery` "
            "(docs/make_gallery.py).\n")
    for title, group in groups + [("Others", " ".join(sorted(scenes.keys() - listed)))]:
        found = [scenes[n] for n in group.split() if n in scenes]
        if found:
            page += f"\n## {title}\n\n" + "\n".join(s.section() for s in found)
    (root / "docs" / "gallery.md").write_text(page, encoding="utf-8")
    for trouble in troubles:
        print(trouble, file=sys.stderr)
    return 1 if troubles else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
