"""Velocities of the points, square to their radii, on a scale of their own with its legend."""

from __future__ import annotations

import math
from collections.abc import Mapping

import shapely

from icsolve.draw.arrows import arrow
from icsolve.draw.marks import Group, Point, Run, Text
from icsolve.draw.place import Label, Soft
from icsolve.draw.scene import Part, Scene
from icsolve.draw.view import along
from icsolve.draw.words import quantity

LONGEST = 84.0
LEAST = 3.0
"""An arrow shorter than this is not drawn."""


def velocity_parts(scene: Scene) -> list[Part]:
    """An arrow at each point that moves; points that two links carry together have one."""
    found = _velocities(scene)
    fastest = max((math.hypot(*v) for v in found.values()), default=0.0)
    if fastest == 0.0:
        return []
    parts = []
    for (point, link), v in found.items():
        size = math.hypot(*v)
        length = LONGEST * size / fastest
        if length < LEAST:
            continue
        parts.append(_arrow(scene, point, link, (v[0] / size, -v[1] / size), length, _shared(found, point)))
    return parts


def _velocities(scene: Scene) -> dict[tuple[str, str], Point]:
    """Velocity of each point on the first link that has it so."""
    whole = scene.known.whole
    found: dict[tuple[str, str], Point] = {}
    for (point, link), v in ((whole and whole.velocities) or {}).items():
        if isinstance(v, str) or point not in scene.at or link == scene.case.ground:
            continue
        least = 1e-9 * math.hypot(*v)
        if not any(other == point and math.dist(v, w) <= least for (other, _), w in found.items()):
            found[(point, link)] = v
    return found


def _shared(found: Mapping[tuple[str, str], Point], point: str) -> bool:
    """Whether a point has several velocities, one for each of its links."""
    return sum(1 for other, _ in found if other == point) > 1


def _arrow(scene: Scene, point: str, link: str, u: Point, length: float, several: bool) -> Part:
    tail = scene.at[point]
    tip = along(tail, u, length)
    name = f"velocity-{point}-{link}"
    marks = arrow(tail, tip, "velocity", 10.0)
    low = f"{point}{link}" if several and len(link) == 1 else f"{point} on {link}" if several else point
    label = Label(f"label-{name}", (Run("v"), Run(low, True)), "t-velocity", 13.0, (tip,), 6.0)
    soft = (Soft(shapely.LineString([tail, tip]).buffer(3.0, quad_segs=1), 4.0),)
    return Part((Group(name, "", marks, f"velocity of {point} on link {link}"),), soft, (), (label,))


def legend(scene: Scene, at: Point) -> Group | None:
    """A bar as long as a round speed, and what the speeds are relative to."""
    found = _velocities(scene)
    fastest = max((math.hypot(*v) for v in found.values()), default=0.0)
    if fastest == 0.0:
        return None
    speed = _round(fastest)
    end = along(at, (1.0, 0.0), LONGEST * speed / fastest)
    unit_name = f"{scene.case.units.length}/s"
    text = f"{quantity(speed, unit_name)} ({_reference(scene)})"
    words = Text((end[0] + 10.0, end[1]), (Run(text),), "t-velocity", 12.0, "start")
    return Group("velocity-scale", "", (*arrow(at, end, "velocity", 8.0), words), text)


def _round(value: float) -> float:
    """1, 2 or 5 times a power of ten, at most the value (but for rounding: 99.99999999999999 is 100)."""
    value *= 1.0 + 1e-9
    power = 10.0 ** math.floor(math.log10(value))
    return max(m for m in (1.0, 2.0, 5.0) if m * power <= value) * power


def _reference(scene: Scene) -> str:
    if any(m.speed is not None for m in scene.case.motion):
        return "velocities"
    rates = (scene.known.whole and scene.known.whole.rates) or {}
    one = next((link for link, rate in rates.items() if isinstance(rate, float) and abs(rate) == 1.0), None)
    return f"velocities for 1 rad/s of link {one}" if one else "velocities, scaled"
