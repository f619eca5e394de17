"""Plays pages of `pintle report` in headless Chromium: errors told on the console, how long frames take, whether each value is one of the tables.

python3 tests/report/play.py PAGE DIR [PAGE DIR ...]   DIR: the results that the page is of, or -
Exits with 1 where something is wrong; times are told and not judged."""

import csv
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

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


class Chromium:
    """One page, spoken to by the DevTools protocol on two pipes."""

    def __init__(self, page):
        self.profile = tempfile.mkdtemp()
        inward, self.out = os.pipe()
        self.back, outward = os.pipe()

        def pipes():
            a, b = os.dup(inward), os.dup(outward)
            os.dup2(a, 3), os.dup2(b, 4)

        self.process = subprocess.Popen(
            ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking",
             "--disable-component-update", "--disable-sync", f"--user-data-dir={self.profile}", "--window-size=1400,1000",
             "--remote-debugging-pipe", "about:blank"],
            preexec_fn=pipes, close_fds=False, start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(inward), os.close(outward)
        self.text, self.number, self.told, self.session = b"", 0, [], None
        target = next(t for t in self.ask("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self.session = self.ask("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.ask(domain + ".enable")
        self.ask("Page.navigate", url=page.resolve().as_uri())
        while not any(m.get("method") == "Page.loadEventFired" for m in self.told):
            self.told.append(self.read())

    def read(self):
        while b"\0" not in self.text:
            self.text += os.read(self.back, 1 << 20)
        message, _, self.text = self.text.partition(b"\0")
        return json.loads(message)

    def ask(self, method, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.out, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.read()
            if answer.get("id") == self.number:
                return answer["result"]
            self.told.append(answer)

    def value(self, expression):
        return json.loads(self.ask("Runtime.evaluate", expression=expression, awaitPromise=True)["result"]["value"])

    def computed(self):
        """Seconds of the processor in all of its processes."""
        out, session = 0, str(self.process.pid)
        for stat in Path("/proc").glob("[0-9]*/stat"):
            try:
                fields = stat.read_text().rpartition(")")[2].split()
            except OSError:  # it has ended
                continue
            if fields[3] == session:
                out += int(fields[11]) + int(fields[12])
        return out / os.sysconf("SC_CLK_TCK")

    def troubles(self):
        return [m for m in self.told if m.get("method") in ("Runtime.exceptionThrown", "Log.entryAdded")
                or m.get("method") == "Runtime.consoleAPICalled" and m["params"]["type"] in ("error", "warning")]

    def close(self):
        self.process.terminate()
        self.process.wait()
        os.close(self.out), os.close(self.back)
        shutil.rmtree(self.profile, ignore_errors=True)


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
    """What the page holds or shows that the table does not."""
    kept, shown = browser.value(columns), browser.value(values)
    header, rows = rows_at(folder / "trajectory.csv", {t for _, _, times, _ in kept for t in times})
    places, out, count = {name: i for i, name in enumerate(header)}, [], 0

    def stands(name, t, value):
        place = next((places[h] for h in places if h == name or h.startswith(name + " [")), None)
        return place is not None and any(row[place] == value or value != value and row[place] != row[place] for row in rows.get(t, []))

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
            print(f"{page.name}: {count} numbers held and {shown} shown, {len(wrong)} of them not in {folder.name}/trajectory.csv", *wrong[:5], sep="\n  ")
            troubles += wrong
        troubles += [json.dumps(m)[:300] for m in browser.troubles()]
        print(f"{page.name}: {len(troubles)} errors", *troubles[:5], sep="\n  ", flush=True)
        return not troubles
    finally:
        browser.close()


if __name__ == "__main__":
    pairs = list(zip(sys.argv[1::2], sys.argv[2::2]))
    sys.exit(0 if all([play(Path(page), None if folder == "-" else Path(folder)) for page, folder in pairs]) else 1)
