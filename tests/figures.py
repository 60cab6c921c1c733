"""The same mechanisms as a figure gives them: lengths, a crank angle, angles at a point, and `near`.

The coordinates of the scene are the truth from which the data are measured, in full decimals.
"""

from __future__ import annotations

import math
from itertools import combinations
from random import Random
from typing import Any

from mechanisms import bearing
from transcribe import Scene, case

Where = dict[str, list[float]]


def bodies(scene: Scene) -> dict[str, list[str]]:
    """The points that each link carries by its pins, the slide of its block, and `links`."""
    carried: dict[str, list[str]] = {n: [] for n in case(scene).links}
    for joint in scene["joints"]:
        kind = next(iter(joint))
        for link in joint[kind] if kind == "pin" else joint[kind][:1] if kind == "slide" else []:
            carried[str(link)].append(joint["at"])
    for link, points in scene.get("links", {}).items():
        carried[str(link)] += [p for p in points if p not in carried[str(link)]]
    for joint in scene["joints"]:
        if "weld" in joint:  # two names of one body
            i, j = map(str, joint["weld"])
            carried[i] = carried[j] = list(dict.fromkeys([*carried[i], *carried[j]]))
    return carried


class Measured:
    """The data of a figure as they are read off the scene, and the points that they fix so far."""

    def __init__(self, scene: Scene, rng: Random) -> None:
        self.truth: Where = scene["points"]
        self.rng = rng
        self.known: dict[str, None] = {}
        self.lengths: dict[str, float] = {}
        self.angles: dict[str, float] = {}
        self.near: Where = {}
        self.firm = True

    def length(self, a: str, b: str) -> None:
        """Write the distance between two points."""
        self.lengths[f"{a}-{b}"] = math.dist(self.truth[a], self.truth[b])

    def arm(self, a: str, b: str) -> None:
        """b from a by length and direction."""
        self.length(a, b)
        self.angles[f"{a}-{b}"] = bearing(self.truth[a], self.truth[b])
        self.known[b] = None

    def rigid(self, a: str, b: str, p: str) -> None:
        """p from two known points of its link, by its distance from b and the angle at b."""
        self.length(b, p)
        self.angles[f"{a}-{b}-{p}"] = bearing(self.truth[b], self.truth[p]) - bearing(
            self.truth[b], self.truth[a]
        )
        self.known[p] = None

    def dyad(self, a: str, b: str, p: str) -> None:
        """p by its distances from two known points, and `near`."""
        self.length(a, p)
        self.length(b, p)
        self.approximate(p, self.height(a, b, p))

    def height(self, a: str, b: str, p: str) -> float:
        """Of a triangle over its side a-b; one that is nearly flat has two ways that nearly coincide."""
        (ax, ay), (bx, by), (px, py) = (self.truth[q] for q in (a, b, p))
        height = abs((bx - ax) * (py - ay) - (by - ay) * (px - ax)) / math.dist((ax, ay), (bx, by))
        self.firm &= height > 0.3
        return height

    def block(self, a: str, p: str, along: float) -> None:
        """p on a known guide by its distance from a known point, and `near`."""
        self.length(a, p)
        towards = math.cos(math.radians(along - bearing(self.truth[a], self.truth[p])))
        distance = abs(towards) * math.dist(self.truth[a], self.truth[p])
        self.firm &= distance > 0.3
        self.approximate(p, distance)

    def approximate(self, p: str, room: float) -> None:
        """A place near p, off by a quarter of the distance to the other branch at most."""
        off = 0.25 * min(room, 1.0)
        self.near[p] = [round(x + self.rng.uniform(-off, off), 3) for x in self.truth[p]]
        self.known[p] = None


def from_lengths(scene: Scene, rng: Random) -> Scene | None:
    """The figure by lengths in an order of construction; None where it has none, or is nearly stretched."""
    if not {next(iter(j)) for j in scene["joints"]} <= {"pin", "slide", "weld"}:
        return None
    carried, figure = bodies(scene), Measured(scene, rng)
    frame = str(scene.get("ground", 1))
    figure.known = dict.fromkeys(
        [*carried[frame], *(j["through"] for j in scene["joints"] if "through" in j)]
    )
    crank = next((n for n, p in carried.items() if n != frame and len(p) > 1 and p[0] in figure.known), None)
    if crank is None:
        return None
    figure.arm(carried[crank][0], carried[crank][1])
    while _step(scene, carried, figure):
        pass
    needed = {p for points in carried.values() for p in points}
    if not (figure.firm and needed <= set(figure.known)):
        return None
    measured = {"lengths": figure.lengths, "angles": figure.angles, "near": figure.near}
    points = {p: xy for p, xy in scene["points"].items() if p in carried[frame] or p not in figure.known}
    points |= {j["through"]: scene["points"][j["through"]] for j in scene["joints"] if "through" in j}
    return (
        {"points": points}
        | {k: v for k, v in measured.items() if v}
        | {k: v for k, v in scene.items() if k != "points"}
    )


def _step(scene: Scene, carried: dict[str, list[str]], figure: Measured) -> bool:
    """Fix one more point, if any can be."""
    for points in carried.values():
        fixed = [p for p in points if p in figure.known]
        for p in points:
            if p not in figure.known and len(fixed) > 1:
                figure.rigid(fixed[0], fixed[1], p)
                return True
    return any(_by_joint(joint, carried, figure) for joint in scene["joints"])


def _by_joint(joint: dict[str, Any], carried: dict[str, list[str]], figure: Measured) -> bool:
    p = joint.get("at", "")
    if not isinstance(p, str) or p in figure.known or next(iter(joint)) not in ("pin", "slide"):
        return False
    if "slide" in joint and not isinstance(joint["along"], float | int):
        return False
    holders = [points for points in carried.values() if p in points]
    seen = list(dict.fromkeys(q for points in holders for q in points if q in figure.known))
    if "slide" in joint and "through" in joint and seen and joint["through"] != p:
        figure.block(seen[0], p, joint["along"])
        return True
    if "pin" in joint and len(seen) > 1:
        figure.dyad(seen[0], seen[1], p)
        return True
    return False


def without_order(scene: Scene, rng: Random) -> Scene | None:
    """A pinned chain by its links' sides and the crank's direction; None where a triangle is flat."""
    carried, figure = bodies(scene), Measured(scene, rng)
    frame = str(scene.get("ground", 1))
    fixed = carried[frame]
    crank = next(n for n, p in carried.items() if n != frame and len(p) > 1 and p[0] in fixed)
    for link, points in carried.items():
        for a, b in combinations(points, 2):
            if link != frame:
                figure.length(a, b)
        for corners in combinations(points, 3):
            figure.height(*corners)
    if not figure.firm:
        return None
    figure.arm(carried[crank][0], carried[crank][1])
    for p in scene["points"]:
        if p not in fixed:
            figure.approximate(p, 0.1)
    rest = {k: v for k, v in scene.items() if k != "points"}
    measured = {"lengths": figure.lengths, "angles": figure.angles, "near": figure.near}
    return {"points": {p: scene["points"][p] for p in fixed}} | measured | rest
