#!/usr/bin/env python3
"""Writes docs/screens.md and docs/screens/: what report, plot and film show of twelve examples, taken by headless Chromium and ffmpeg.

usage: make_screens.py PINTLE      asks for chromium and ffmpeg
"""

import subprocess
import sys
import tempfile
from pathlib import Path

root = Path(__file__).resolve().parent.parent
place = root / "docs" / "screens"
size = "1120,760"
scenes = ["slider_crank_clearance", "four_bar_spring", "engine_single", "woodpecker", "geneva", "cam_roller", "double_wishbone", "excavator",
          "flexible_slider_crank", "gear_backlash", "belt_drive", "pid_arm"]
dark = {"woodpecker", "geneva"}
plots = {"slider_crank_clearance": "gudgeon pin.normal", "stick_slip": "block.vx"}
film = "four_bar_spring"


def page_of(pintle, scene, work):
    out = work / scene
    subprocess.run([pintle, "run", str(root / "examples" / f"{scene}.yaml"), "--out", str(out), "--quiet", "--report"], check=True)
    return out


def shot(page, picture, of_dark):
    subprocess.run(["timeout", "60", "chromium", "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", f"--window-size={size}",
                    *(["--blink-settings=preferredColorScheme=0"] if of_dark else []), "--virtual-time-budget=5000",
                    f"--screenshot={picture}", page.as_uri()], check=True, capture_output=True)


def main(pintle):
    place.mkdir(exist_ok=True)
    text = "# What it looks like\n\nPages of `run --report`, as a browser shows them when they are opened. Written by docs/make_screens.py.\n"
    with tempfile.TemporaryDirectory() as work:
        work = Path(work)
        for scene in scenes:
            out = page_of(pintle, scene, work)
            shot(out / "report.html", place / f"{scene}.png", scene in dark)
            text += f"\n## {scene}\n\n![report of {scene}](screens/{scene}.png)\n"
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
