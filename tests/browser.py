"""A real headless Chromium, driven by chromedriver over the W3C WebDriver protocol (plain HTTP and JSON, so
that no package is needed beside the two programs of the distribution: chromium, chromium-driver)."""

from __future__ import annotations

import base64
import json
import os
import re
import shutil
import subprocess
import tempfile
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

REQUIRED = "ICSOLVE_BROWSER"
"""Where this variable is `required` a missing browser is a failure."""
NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
SWITCHES = (
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-dev-shm-usage",
    "--hide-scrollbars",
    "--disable-background-networking",
    "--disable-component-update",
    "--no-first-run",
)
ELEMENT = "element-6066-11e4-a52e-4f735466cecf"
"""The key of an element in WebDriver's JSON (https://www.w3.org/TR/webdriver2/#elements)."""
KEYS = {
    "right": "\ue014",
    "left": "\ue012",
    "up": "\ue013",
    "down": "\ue015",
    "home": "\ue011",
    "end": "\ue010",
    "enter": "\ue007",
    "tab": "\ue004",
}


class NoBrowserError(Exception):
    """Why there is no browser."""


def programs() -> tuple[str, str]:
    """Chromium and chromedriver; raises where one is missing."""
    chromium = next((found for name in NAMES if (found := shutil.which(name))), None)
    driver = shutil.which("chromedriver")
    missing = [name for name, found in (("chromium", chromium), ("chromedriver", driver)) if found is None]
    if chromium is None or driver is None:
        raise NoBrowserError(f"{' and '.join(missing)} not found: apt-get install chromium chromium-driver")
    return chromium, driver


def required() -> bool:
    """Whether a missing browser is a failure."""
    return os.environ.get(REQUIRED) == "required"


class Browser:
    """A session with one window."""

    def __init__(self, address: str, session: str) -> None:
        self.base = f"{address}/session/{session}"

    def send(self, path: str, body: dict[str, Any] | None = None, method: str = "POST") -> Any:
        """One command; raises RuntimeError with the driver's message."""
        return _request(f"{self.base}{path}", method, body or {})

    def run(self, script: str, *arguments: Any) -> Any:
        """The value of a function's body in the page."""
        return self.send("/execute/sync", {"script": script, "args": list(arguments)})

    def open(self, path: Path) -> None:
        """Load a file; what was logged before is forgotten."""
        self.logs()
        self.requests()
        self.send("/url", {"url": path.as_uri()})

    def size(self, width: int, height: int) -> None:
        """The size of what the page sees, also on a telephone (a window can't be that narrow)."""
        metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
        self.devtools("Emulation.setDeviceMetricsOverride", **metrics)

    def media(self, **features: str) -> None:
        """Set media features: ``prefers_color_scheme="dark"``, ``prefers_reduced_motion="reduce"``."""
        named = [{"name": name.replace("_", "-"), "value": value} for name, value in features.items()]
        self.devtools("Emulation.setEmulatedMedia", features=named)

    def devtools(self, command: str, **parameters: Any) -> Any:
        """A command of Chromium's own protocol."""
        return self.send("/goog/cdp/execute", {"cmd": command, "params": parameters})

    def click(self, selector: str) -> None:
        """Click as a person does: scrolled to, and only if nothing lies above it."""
        self.send(f"/element/{self._find(selector)}/click")

    def press(self, selector: str, *keys: str) -> None:
        """Keys to an element, by name or as characters."""
        text = "".join(KEYS.get(key, key) for key in keys)
        self.send(f"/element/{self._find(selector)}/value", {"text": text})

    def drag(self, kind: str, start: tuple[float, float], end: tuple[float, float]) -> None:
        """Press at a place of the window, move and let go: with the mouse, or by touch."""
        steps = (
            0.0,
            0.25,
            0.5,
            0.75,
            1.0,
            1.0,
        )  # Chromium holds the last move of a finger back until the next
        way = [(start[0] + k * (end[0] - start[0]), start[1] + k * (end[1] - start[1])) for k in steps]
        moves = [{"type": "pointerMove", "x": round(x), "y": round(y), "duration": 10} for x, y in way]
        down, up = {"type": "pointerDown", "button": 0}, {"type": "pointerUp", "button": 0}
        actions = [moves[0], down, *moves[1:], {"type": "pause", "duration": 50}, up]
        finger = {"type": "pointer", "id": kind, "parameters": {"pointerType": kind}, "actions": actions}
        self.send("/actions", {"actions": [finger]})

    def text(self, selector: str) -> str:
        """What an element shows."""
        found = self.run("return document.querySelector(arguments[0]).textContent", selector)
        return " ".join(str(found).split())

    def _find(self, selector: str) -> str:
        found = self.send("/element", {"using": "css selector", "value": selector})
        return str(found[ELEMENT])

    def logs(self) -> list[str]:
        """Warnings and errors of the console since the last call."""
        entries = self.send("/se/log", {"type": "browser"})
        return [f"{e['level']}: {e['message']}" for e in entries if e["level"] in ("WARNING", "SEVERE")]

    def requests(self) -> list[str]:
        """The addresses that were asked for since the last call."""
        entries = self.send("/se/log", {"type": "performance"})
        events = [json.loads(entry["message"])["message"] for entry in entries]
        sent = [e["params"]["request"]["url"] for e in events if e["method"] == "Network.requestWillBeSent"]
        return [str(url) for url in sent]

    def picture(self, path: Path, *, whole: bool = True) -> None:
        """A PNG of the page, its whole length or what is seen."""
        taken = self.devtools("Page.captureScreenshot", format="png", captureBeyondViewport=whole)
        path.write_bytes(base64.b64decode(taken["data"]))


def _request(url: str, method: str, body: dict[str, Any] | None = None) -> Any:
    content = json.dumps(body or {}).encode() if method == "POST" else None
    request = urllib.request.Request(url, content, {"Content-Type": "application/json"}, method=method)
    try:
        with urllib.request.urlopen(request, timeout=60) as answer:
            return json.load(answer)["value"]
    except urllib.error.HTTPError as error:
        with error:
            raise RuntimeError(json.load(error)["value"]["message"].splitlines()[0]) from None


@contextmanager
def browser() -> Iterator[Browser]:
    """A headless Chromium, closed at the end; raises NoBrowserError where there is none that starts."""
    chromium, driver = programs()
    with (
        tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile,
        subprocess.Popen(
            [driver, "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
        ) as process,
    ):
        try:
            address = f"http://127.0.0.1:{_port(process)}"
            session = _session(address, chromium, profile)
            try:
                yield Browser(address, session)
            finally:
                _request(f"{address}/session/{session}", "DELETE")
        finally:
            process.terminate()


def _port(process: subprocess.Popen[str]) -> str:
    """The port that the driver took, from what it prints."""
    assert process.stdout is not None
    end = time.monotonic() + 30.0
    while time.monotonic() < end and (line := process.stdout.readline()):
        if found := re.search(r"started successfully on port (\d+)", line):
            return found[1]
    raise NoBrowserError("chromedriver does not start")


def _session(address: str, chromium: str, profile: str) -> str:
    options = {"binary": chromium, "args": [*SWITCHES, f"--user-data-dir={profile}"]}
    wanted = {
        "browserName": "chrome",
        "goog:chromeOptions": options,
        "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"},
    }
    try:
        made = _request(f"{address}/session", "POST", {"capabilities": {"alwaysMatch": wanted}})
    except (RuntimeError, OSError) as error:
        raise NoBrowserError(f"chromium does not start: {error}") from error
    return str(made["sessionId"])
