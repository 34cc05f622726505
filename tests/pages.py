"""Pages opened in a browser, and what is asked of them."""

import json
import os
import re
import time
from pathlib import Path

import numpy as np

PICTURES = os.environ.get("ROBOTICS1_PICTURES")  # a folder: build/pictures in make test, docs/pictures in make pictures
PICTURES = None if PICTURES is None else Path(PICTURES).absolute()

WINDOWS = ((1280, 800), (900, 700), (390, 844), (1600, 500))


def data_behind(html):
    """Return what the script of a page draws and computes with."""
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', html, re.DOTALL)[1])


class OpenPage:
    """A page in a window: its faults, and the numbers behind what it shows."""

    def __init__(self, browser, path, width=900, height=700, *, sheet=False, **options):
        self.faults = []
        self.held = None  # where a hand last held the handle
        self.tab = browser.new_page(viewport={"width": width, "height": height}, **options)
        self.tab.on("pageerror", lambda error: self.faults.append(str(error)))
        self.tab.on("console", lambda message: self.faults.append(message.text) if message.type == "error" else None)
        self.tab.on("request", lambda request: self.faults.append(request.url) if "file:" not in request.url else None)
        self.tab.goto(path.as_uri(), wait_until="commit", timeout=90_000)
        if not sheet:  # whose arm is in a frame
            self.wait("window.robotics1?.ready")

    def wait(self, condition, seconds=90):
        """Wait until a JavaScript expression is true; the page itself must not evaluate text."""
        end = time.monotonic() + seconds
        while not self.tab.evaluate(condition):
            assert time.monotonic() < end, f"{condition} is not true after {seconds} s"
            time.sleep(0.05)

    def ask(self, expression, *arguments):
        """Return the value of a JavaScript expression of `app` and of arguments a, b."""
        return self.tab.evaluate(f"([a, b]) => {{ const app = window.robotics1.app; return {expression}; }}", [
            *arguments, *[None] * (2 - len(arguments)),
        ])  # fmt: skip

    def keep(self, name):
        """Save what is seen of a page without a scene of its own in the folder of the pictures, if one is named."""
        if PICTURES:
            PICTURES.mkdir(parents=True, exist_ok=True)
            self.tab.screenshot(path=PICTURES / f"{name}.png")

    def picture(self, name, width=1280, height=800):
        """Save what is seen in the folder of the pictures, if one is named."""
        if PICTURES:
            PICTURES.mkdir(parents=True, exist_ok=True)
            self.tab.set_viewport_size({"width": width, "height": height})
            self.ask("(app.frame(), app.stage.fit())")
            self.tab.wait_for_timeout(300)
            self.tab.screenshot(path=PICTURES / f"{name}.png")

    def place(self, name):
        """Return the world position of the object of a name."""
        found = self.ask(
            "(() => { const o = app.stage.scene.getObjectByName(a); o.updateWorldMatrix(true, true);"
            " return o.matrixWorld.toArray(); })()",
            name,
        )
        return np.array(found).reshape(4, 4)[3, :3]

    def move(self, q):
        """Put the robot at q."""
        self.ask("app.change(a)", [float(value) for value in q])

    def pixels(self, p):
        """Return where in the window a point of the world is."""
        return self.ask(
            "(p => { const v = new THREE.Vector3(...p).project(app.stage.viewer.camera), e = app.stage.element;"
            " return [(v.x + 1) / 2 * e.clientWidth, (1 - v.y) / 2 * e.clientHeight]; })(a)",
            [float(value) for value in p],
        )

    def drag(self, goal):
        """Drag the handle from where it is to a point of the world, and return what the page says of it."""
        self.tab.mouse.move(*self.pixels(self.place("handle")))
        self.tab.mouse.down()
        self.tab.mouse.move(*self.pixels(goal), steps=6)
        said = self.tab.inner_text("#verdict")
        self.held = np.array(self.ask("positionOf(app.handle.held.wanted)"))
        self.tab.mouse.up()
        return said

    def touch(self, start, end, steps=6):
        """Put a finger on a pixel, move it to another one, and lift it."""
        protocol = self.tab.context.new_cdp_session(self.tab)
        for kind, share in (("touchStart", 0), *(("touchMove", k / steps) for k in range(1, steps + 1))):
            x, y = np.asarray(start) + share * (np.asarray(end) - start)
            protocol.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": float(x), "y": float(y)}]})
        protocol.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
        protocol.detach()

    def seek(self, time):
        """Drag the slider of time."""
        self.tab.evaluate(
            "t => { const s = document.getElementById('time'); s.value = t; s.dispatchEvent(new Event('input')); }",
            time,
        )

    def inside(self):
        """Return the least and the largest window coordinate (from −1 to 1) of the box of what is drawn."""
        seen = self.ask("corners(app.stage.box).map(p => p.project(app.stage.viewer.camera)).map(p => [p.x, p.y])")
        return np.min(seen), np.max(seen)

    def inside_windows(self):
        """Yield what `inside` says in windows of four sizes, each after fit."""
        for width, height in WINDOWS:
            self.tab.set_viewport_size({"width": width, "height": height})
            self.ask("app.stage.fit()")
            yield self.inside()
