#!/usr/bin/env python3
"""Writes docs/screens.md and docs/screens/: what report, plot and film show of examples and of other results, taken by headless Chromium and ffmpeg.

usage: make_screens.py PINTLE      asks for chromium and ffmpeg
"""

import subprocess
import sys
import tempfile
from pathlib import Path

root = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(root / "tests" / "report"))
from chromium import Chromium

place = root / "docs" / "screens"
size = (1120, 760)
scenes = ["slider_crank_clearance", "four_bar_spring", "engine_single", "woodpecker", "geneva", "cam_roller", "double_wishbone", "excavator",
          "flexible_slider_crank", "gear_backlash", "belt_drive", "pid_arm"]
dark = {"woodpecker", "geneva"}
plots = {"slider_crank_clearance": "gudgeon pin.normal", "stick_slip": "block.vx"}
film = "four_bar_spring"
others = {
    "equilibrium": ("An equilibrium", ["statics", "double_wishbone.yaml"]),
    "modes": ("The modes of a mechanism", ["linearize", "four_bar_flexible.yaml"]),
    "shapes": ("The modes of a body", ["modes", "modes_eye_bar.yaml"]),
    "bracket": ("The static case of a body", ["static", "static_bracket.yaml"]),
    "sweep": ("A sweep", ["sweep", "studies/clearance.yaml"]),
    "fit": ("A fit", ["fit", "studies/fit_chebyshev.yaml"]),
    "bifurcation": ("A bifurcation diagram", ["nonlinear", "studies/duffing.yaml"]),
    "basins": ("Basins of attraction", ["nonlinear", "studies/duffing_basins.yaml"]),
}
show = dict.fromkeys(("bifurcation", "basins"), "byId('study-scatter').scrollIntoView({block: 'center'})")


def page_of(pintle, scene, work):
    out = work / scene
    subprocess.run([pintle, "run", str(root / "examples" / f"{scene}.yaml"), "--out", str(out), "--quiet", "--report"], check=True)
    return out


def shot(browser, page, picture, scheme="light", before="1"):
    browser.screen(*size, scheme=scheme)
    browser.open(page)
    browser.get(before)
    browser.picture(picture, whole=False)


def main(pintle):
    place.mkdir(exist_ok=True)
    text = "# What it looks like\n\nPages of `run --report`, as a browser shows them when they are opened. Written by docs/make_screens.py.\n"
    with tempfile.TemporaryDirectory() as work:
        work = Path(work)
        (work / "empty.html").write_text("<!DOCTYPE html>")
        browser = Chromium(work / "empty.html")
        for scene in scenes:
            out = page_of(pintle, scene, work)
            shot(browser, out / "report.html", place / f"{scene}.png", "dark" if scene in dark else "light")
            text += f"\n## {scene}\n\n![report of {scene}](screens/{scene}.png)\n"
        text += "\n## Pages of other results\n"
        for name, (title, (command, file, *more)) in others.items():
            subprocess.run([pintle, command, str(root / "examples" / file), *more, "--out", str(work / name), "--quiet"], check=True)
            subprocess.run([pintle, "report", str(work / name), "--quiet"], check=True)
            shot(browser, work / name / "report.html", place / f"{name}.png", before=show.get(name, "1"))
            text += f"\n{title}, `pintle {command} examples/{file}`:\n\n![{title}](screens/{name}.png)\n"
        browser.close()
        text += "\n## Plots and a film\n"
        for scene, column in plots.items():
            out = work / scene if (work / scene).exists() else page_of(pintle, scene, work)
            subprocess.run([pintle, "plot", str(out), column, "-o", str(place / f"plot_{scene}.svg")], check=True, capture_output=True)
            text += f"\n`pintle plot runs/{scene} \"{column}\" -o plot.svg`\n\n![{column} of {scene}](screens/plot_{scene}.svg)\n"
        subprocess.run([pintle, "film", str(work / film), str(work / "film.mp4"), "--quiet"], check=True)
        subprocess.run(["ffmpeg", "-loglevel", "error", "-y", "-ss", "1", "-i", str(work / "film.mp4"), "-frames:v", "1", "-vf", "scale=900:-1",
                        str(place / "film.png")], check=True)
        text += f"\nA frame of `pintle film runs/{film} out.mp4`:\n\n![a frame of a film](screens/film.png)\n"
    (root / "docs" / "screens.md").write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
