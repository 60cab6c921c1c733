"""A second opinion on sweeps: every row is checked by the shapes of its links, by its joints, by
differences from row to row, and as a scene of its own.

Each link of a scene gets two points more, from which alone its place in every row is read off.
"""

from __future__ import annotations

import math
from random import Random
from typing import Any

import numpy as np
import numpy.typing as npt

import icsolve
import transcribe
from mechanisms import spot
from transcribe import Scene

Array = npt.NDArray[np.float64]


def traced(scene: Scene, rng: Random) -> Scene:
    """The scene with two points more on every link."""
    points, links = dict(scene["points"]), {str(k): list(v) for k, v in scene.get("links", {}).items()}
    for link in transcribe.case(scene).links:
        for k in "ab":
            points[f"x{link}{k}"] = spot(rng)
            links.setdefault(link, []).append(f"x{link}{k}")
    return scene | {"points": points, "links": links}


class Turned:
    """The places of the links in the rows of a sweep, read off their two points.

    ``z`` by link is the rotation since the scene as a complex number, ``at`` the place of one of the
    points; complex too.
    """

    def __init__(self, scene: Scene, sweep: icsolve.Sweep) -> None:
        self.scene, self.sweep = scene, sweep
        self.written = {name: complex(*xy) for name, xy in scene["points"].items()}
        self.ok = ~np.isnan(next(iter(sweep.points.values()))[:, 0])
        self.z: dict[str, Any] = {}
        for link in transcribe.case(scene).links:
            a, b = (self.point(f"x{link}{k}") for k in "ab")
            self.z[link] = (b - a) / (self.written[f"x{link}b"] - self.written[f"x{link}a"])

    def point(self, name: str) -> Any:
        """A point in every row."""
        return self.sweep.points[name][:, 0] + 1j * self.sweep.points[name][:, 1]

    def carried(self, link: str, name: str | complex) -> Any:
        """Where a link has a point that was at a place of the scene."""
        written = self.written[name] if isinstance(name, str) else name
        return self.point(f"x{link}a") + self.z[link] * (written - self.written[f"x{link}a"])

    def angle(self, link: str) -> Array:
        """By how much a link has turned, whole turns too, in degrees (from row to row less than half)."""
        return np.degrees(np.unwrap(np.angle(self.z[link])))

    # --- checks -----------------------------------------------------------------------------------

    def shapes(self) -> float:
        """The largest change of a link's shape: of the distance of its two points, of what pins it has."""
        worst = max(float(np.abs(np.abs(z[self.ok]) - 1.0).max()) for z in self.z.values())
        for joint in self.scene["joints"]:
            if "pin" in joint:
                for link in joint["pin"]:
                    off = self.carried(str(link), joint["at"]) - self.point(joint["at"])
                    worst = max(worst, float(np.abs(off[self.ok]).max()))
        return worst

    def guides(self) -> float:
        """The largest distance of a block or pin from its guide, which is on its own link."""
        worst = 0.0
        for joint in self.scene["joints"]:
            kind = next(iter(joint))
            if kind not in ("slide", "slot"):
                continue
            block, guide = (str(link) for link in joint[kind])
            line, through = self._line(joint)
            place = self.carried(block, joint["at"])
            off = (place - self.carried(guide, through)) * np.conj(self.z[guide] * line)
            worst = max(worst, float(np.abs(off.imag[self.ok]).max()))
            if kind == "slide":
                turned = np.abs(self.z[block] - self.z[guide])[self.ok]
                worst = max(worst, float(turned.max()))
        return worst

    def _line(self, joint: dict[str, Any]) -> tuple[complex, complex]:
        """Direction and a point of a guide in the scene."""
        along, at = joint["along"], joint["at"]
        if isinstance(along, list):
            a, b = (self.written[name] for name in along)
            return (b - a) / abs(b - a), self.written[joint.get("through", along[0])]
        heading = complex(math.cos(math.radians(along)), math.sin(math.radians(along)))
        return heading, self.written[joint.get("through", at)]

    def wheels(self) -> float:
        """The largest slip of gears and belts: degrees by which their turnings do not fit."""
        worst = 0.0
        for joint in self.scene["joints"]:
            kind = next(iter(joint))
            if kind not in ("gears", "belt"):
                continue
            a, b = (str(link) for link in joint[kind])
            n, m = joint["teeth"] if kind == "gears" else joint["radii"]
            sense = -1.0 if (n * m > 0 if kind == "gears" else joint.get("crossed", False)) else 1.0
            c = str(joint.get("carrier", self._carrier(a, b)))
            first, second, arm = self.angle(a), self.angle(b), self.angle(c)
            slip = abs(n) * (first - arm) - sense * abs(m) * (second - arm)
            worst = max(worst, float(np.ptp(slip[self.ok]) / (abs(n) + abs(m))))
        return worst

    def _carrier(self, a: str, b: str) -> str:
        pins = [[str(k) for k in joint["pin"]] for joint in self.scene["joints"] if "pin" in joint]
        around = [{k for pin in pins if link in pin for k in pin} for link in (a, b)]
        return min(around[0] & around[1] - {a, b})

    def speeds(self, v: Array) -> float:
        """The largest disagreement of centres and rates with differences from row to row, over the largest:
        the turning of every link, and the way of two points of it. Rows are an even step of ``v`` apart."""
        step = float(v[1] - v[0])
        frame = str(self.scene.get("ground", 1))
        links = [link for link in self.z if link != frame]
        turning = {link: _slope(np.unwrap(np.angle(self.z[link])), step) for link in links}
        rates = {link: self.sweep.rates[link][2:-2] for link in links}
        pace = _pace(turning, rates)
        largest = np.abs(pace) * max(float(np.nanmax(np.abs(p))) for p in rates.values())
        worst = max(float(np.nanmax(np.abs(turning[k] - pace * rates[k]) / largest)) for k in links)
        for link in links:
            x, y, w = self._centre(frame, link)
            for k in "ab":
                p = self.point(f"x{link}{k}")[2:-2]
                moved = _slope(self.point(f"x{link}{k}"), step)
                square = (x - w * p.real) * moved.real + (y - w * p.imag) * moved.imag
                size = np.hypot(x - w * p.real, y - w * p.imag) * np.abs(moved) + 1e-6
                worst = max(worst, float(np.nanmax(np.abs(square) / size)))
        return worst

    def slips(self, v: Array) -> float:
        """The largest velocity of slip where two links roll, over the speed of the contact's links."""
        step, worst = float(v[1] - v[0]), 0.0
        for joint in self.scene["joints"]:
            if "roll" in joint:
                contact = self.point(joint["at"])[2:-2]
                a, b = (self._velocity(str(link), contact, step) for link in joint["roll"])
                size = float(np.abs(self._velocity(str(joint["roll"][0]), contact + 1.0, step)).max())
                worst = max(worst, float(np.abs(a - b).max()) / size)
        return worst

    def _velocity(self, link: str, at: Any, step: float) -> Any:
        """Of the point of a link that is at a place, by differences from row to row."""
        own = self.point(f"x{link}a")
        turning = _slope(np.unwrap(np.angle(self.z[link])), step)
        return _slope(own, step) + 1j * turning * (at - own[2:-2])

    def _centre(self, frame: str, link: str) -> tuple[Array, Array, Array]:
        key = f"{frame}-{link}" if f"{frame}-{link}" in self.sweep.centres else f"{link}-{frame}"
        x, y, w = self.sweep.centres[key][2:-2].T
        return x, y, w

    # --- as scenes --------------------------------------------------------------------------------

    def row(self, k: int) -> Scene:
        """Row k as a scene given by coordinates alone."""
        points = {name: [float(v) for v in self.sweep.points[name][k]] for name in self.written}
        joints = [self._joint(joint, k) for joint in self.scene["joints"]]
        loads = {name: self._load(load, k) for name, load in self.scene.get("loads", {}).items()}
        rest = {key: self.scene[key] for key in ("links", "ground") if key in self.scene}
        return {"points": points, "joints": joints, "loads": loads, **rest}

    def _joint(self, joint: dict[str, Any], k: int) -> dict[str, Any]:
        kind = next(iter(joint))
        if kind in ("slide", "slot"):
            line, _ = self._line(joint)
            z = self.z[str(joint[kind][1])][k] * line
            return {kind: joint[kind], "at": joint["at"], "along": math.degrees(math.atan2(z.imag, z.real))}
        return {key: value for key, value in joint.items() if key != "radii" or kind != "roll"}

    def _load(self, load: dict[str, Any], k: int) -> dict[str, Any]:
        """A load at the place at which its link has its point now."""
        load = dict(load)
        if "at" in load:
            load["at"] = self._place(str(load["link"]), load["at"], k)
        if "to" in load:
            load["to"] = self._place(str(load.get("against", self.scene.get("ground", 1))), load["to"], k)
        return load

    def _place(self, link: str, at: Any, k: int) -> list[float]:
        place = self.carried(link, at if isinstance(at, str) else complex(*at))[k]
        return [float(place.real), float(place.imag)]


def _slope(values: Any, step: float) -> Any:
    """Derivative from row to row by the four neighbours."""
    return (8.0 * (values[3:-1] - values[1:-3]) - (values[4:] - values[:-4])) / (12.0 * step)


def _pace(turning: dict[str, Array], rates: dict[str, Array]) -> Array:
    """How fast the varied number drives, by the link that turns fastest."""
    up = sum(turning[k] * rates[k] for k in rates)
    down = sum(rates[k] ** 2 for k in rates)
    return np.asarray(up / down)
