"""Headless Chromium, spoken to and driven by the DevTools protocol."""

import base64
import json
import os
import shutil
import subprocess
import tempfile
from pathlib import Path


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
        self.open(page)

    def open(self, page):
        """Goes to another page and forgets what was told before."""
        self.told = []
        self.ask("Page.navigate", url=page.resolve().as_uri())
        while not any(m.get("method") == "Page.loadEventFired" for m in self.told):
            self.told.append(self.read())

    def read(self):
        while b"\0" not in self.text:
            read = os.read(self.back, 1 << 20)
            if not read:
                raise EOFError("Chromium has ended")
            self.text += read
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
        answer = self.ask("Runtime.evaluate", expression=expression, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{expression}: {answer['exceptionDetails']}")
        return json.loads(answer["result"]["value"])

    def get(self, expression):
        """A value as JSON, once what is waiting is drawn."""
        return self.value("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
                          f".then(() => ({expression})).then((x) => JSON.stringify(x ?? null))")

    def wait(self, condition):
        """Until it holds in some frame; raises if it does not hold in a thousand."""
        told = self.value("new Promise((done) => { let left = 1000; const look = () => "
                          f"({condition}) ? done('true') : --left ? requestAnimationFrame(look) : done('false'); look(); }})")
        if not told:
            raise RuntimeError("never so: " + condition)

    def screen(self, width, height, scheme="light", mobile=False):
        self.ask("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=2 if mobile else 1, mobile=mobile)
        self.ask("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])

    def place(self, selector, x=0.5, y=0.5):
        """Where a share of an element's box is in the window, after scrolling there."""
        left, top, width, height = self.get(
            f"(e => (e.scrollIntoView({{block: 'center', behavior: 'instant'}}), (b => [b.left, b.top, b.width, b.height])(e.getBoundingClientRect())))"
            f"(document.querySelector({json.dumps(selector)}))")
        return left + x * width, top + y * height

    def mouse(self, kind, at, **more):
        self.ask("Input.dispatchMouseEvent", type="mouse" + kind, x=at[0], y=at[1], **more)

    def click(self, at, count=1):
        """Clicks an element's middle or a place in the window."""
        at = self.place(at) if isinstance(at, str) else at
        self.mouse("Moved", at)
        for n in range(1, count + 1):
            for kind in ("Pressed", "Released"):
                self.mouse(kind, at, button="left", clickCount=n)

    def drag(self, start, end):
        self.mouse("Moved", start)
        self.mouse("Pressed", start, button="left", clickCount=1)
        for share in (0.5, 1):
            self.mouse("Moved", [a + share * (b - a) for a, b in zip(start, end)], button="left", buttons=1)
        self.mouse("Released", end, button="left", clickCount=1)

    def key(self, key):
        code = {"ArrowDown": 40, "ArrowRight": 39, "Enter": 13, "Tab": 9, "Home": 36}.get(key, 0)
        self.ask("Input.dispatchKeyEvent", type="rawKeyDown", key=key, windowsVirtualKeyCode=code)
        if len(key) == 1:
            self.ask("Input.dispatchKeyEvent", type="char", text=key)
        self.ask("Input.dispatchKeyEvent", type="keyUp", key=key, windowsVirtualKeyCode=code)

    def type(self, text):
        for letter in text:
            self.key(letter)

    def picture(self, file, whole=True):
        """What the window shows as PNG, or the whole document."""
        Path(file).write_bytes(base64.b64decode(self.ask("Page.captureScreenshot", captureBeyondViewport=whole)["data"]))

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
