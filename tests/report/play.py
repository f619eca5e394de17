"""Plays pages of `pintle report` in headless Chromium: errors told on the console, how long frames take, whether each value is one of the tables.

python3 tests/report/play.py PAGE DIR [PAGE DIR ...]   DIR: the results that the page is of, or -
Exits with 1 where something is wrong; times are told and not judged."""

import csv
import json
import os
import sys
from pathlib import Path

from chromium import Chromium

playing = """(async () => {
  const times = [], work = [];
  const median = (list) => [...list].sort((a, b) => a - b)[list.length >> 1];
  const draw = page.stage.draw.bind(page.stage), tell = page.clock.tell.bind(page.clock);
  let spent = 0;
  const timed = (f) => (...args) => { const begin = performance.now(); f(...args); spent += performance.now() - begin; };
  page.stage.draw = timed(draw), page.clock.tell = timed(tell);
  STRESS && page.stage.meshes.some((mesh) => mesh) && (page.stage.show.stress = true);
  page.clock.set(page.clock.begin), page.clock.toggle();
  await new Promise((done) => {
    const frame = () => {
      times.push(performance.now()), work.push(spent), spent = 0;
      page.clock.playing || page.clock.toggle();
      times.length > 120 ? done() : requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  });
  const between = times.slice(1).map((t, i) => t - times[i]);
  page.clock.playing && page.clock.toggle();
  return JSON.stringify({between: median(between), longest: Math.max(...between), work: median(work), frames: between.length, errors});
})()"""
columns = """JSON.stringify([...page.table.columns.values()].map(({name, unit, t, y}) => [name, unit, [...t], [...y]]))"""
values = """JSON.stringify([0, 0.13, 0.5, 0.77, 1].map((share) => {
  page.clock.set(page.clock.begin + share * (page.clock.end - page.clock.begin));
  return page.panels.filter((panel) => !panel.against).flatMap((panel) => (panel.shown ?? []).map(({column, value}) => {
    return [column.name, column.t[nearestIndex(column.t, page.clock.time)], value.title];
  }));
}).flat())"""


def rows_at(file, times):
    """Rows of a table by their times, of those asked for."""
    with open(file, newline="") as text:
        header = next(csv.reader(text))
        found = {}
        for line in text:
            t = float(line.partition(",")[0])
            if t in times:
                found.setdefault(t, []).append([float(x) if x else float("nan") for x in line.rstrip("\n").split(",")])
    return header, found


def wrong_values(browser, folder):
    """What the page holds or shows that the tables do not."""
    kept, shown = browser.value(columns), browser.value(values)
    wanted = {t for _, _, times, _ in kept for t in times}
    places, out, count = {}, [], 0
    for file in filter(Path.exists, (folder / "ledger.csv", folder / "trajectory.csv")):
        header, rows = rows_at(file, wanted)
        places |= {name: (rows, i) for i, name in enumerate(header)}

    def stands(name, t, value):
        rows, place = next((places[h] for h in places if h == name or h.startswith(name + " [")), ({}, None))
        return any(row[place] == value or value != value and row[place] != row[place] for row in rows.get(t, []))

    for name, unit, times, numbers in kept:
        for t, number in zip(times, numbers):
            count += 1
            if number is not None and not stands(f"{name} [{unit}]" if unit else name, t, number):
                out.append(f"{name} at {t}: {number}")
    out += [f"shown: {name} at {t}: {value}" for name, t, value in shown if not stands(name, t, float(value))]
    return out, count, len(shown)


def play(page, folder):
    browser = Chromium(page)
    try:
        troubles = []
        for script in filter(None, os.environ.get("PLAY_WITH", "").split(":")):  # parts of the page's program, in the place of its own
            browser.ask("Runtime.evaluate", expression=Path(script).read_text())
        for stress in ("false", "true"):
            before = browser.computed()
            told = browser.value(playing.replace("STRESS", stress))
            computed = 1e3 * (browser.computed() - before) / told["frames"]
            troubles += told["errors"]
            print(f"{page.name}, {page.stat().st_size / 1e6:.2f} MB{', stress in colours' if stress == 'true' else ''}: {told['between']:.1f} ms between frames "
                  f"({told['longest']:.1f} at most), the page's program takes {told['work']:.1f}, the whole browser {computed:.1f} of computing", flush=True)
        if folder:
            wrong, count, shown = wrong_values(browser, folder)
            print(f"{page.name}: {count} numbers held and {shown} shown, {len(wrong)} of them not in the tables of {folder.name}", *wrong[:5], sep="\n  ")
            troubles += wrong
        troubles += [json.dumps(m)[:300] for m in browser.troubles()]
        print(f"{page.name}: {len(troubles)} errors", *troubles[:5], sep="\n  ", flush=True)
        return not troubles
    finally:
        browser.close()


if __name__ == "__main__":
    pairs = list(zip(sys.argv[1::2], sys.argv[2::2]))
    sys.exit(0 if all([play(Path(page), None if folder == "-" else Path(folder)) for page, folder in pairs]) else 1)
