"""What moves a mechanism in its page: a link that turns, or where everything slides a link that is moved."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from icsolve.case import Case, Centroid, Coordinates, Number, Pin, Slide, Slot, Weld
from icsolve.construction import Known
from icsolve.draw.words import figure_number, unit_word
from icsolve.page.poses import Array
from icsolve.screws.plane import Point

STILL = 1e-12
"""A part of the figure's size: a link that turns by less, for a way as long as the figure, only slides."""
ROWS = 50
"""Positions to either side of the one as written where everything slides."""


class Input(NamedTuple):
    """A link, and where it slides, for each coordinate that then changes (by its path) its number as written
    and its change by one unit of the link's way; ``unit`` and ``senses`` say how a position is told."""

    link: str
    slides: Mapping[str, tuple[float, float]] = {}
    unit: str = "°"
    senses: tuple[str, str] = ("counterclockwise", "clockwise")

    @property
    def verb(self) -> str:
        """What is done to the link."""
        return "moved" if self.slides else "turned"

    @property
    def unit_name(self) -> str:
        """The unit of its positions as an axis has it."""
        return self.unit.strip() if self.slides else "degrees"

    def driven(self, rows: Array) -> dict[str, Array]:
        """The sweep's ``drive``."""
        return {} if self.slides else {self.link: rows}

    def varied(self, rows: Array) -> dict[str, Array]:
        """The sweep's ``vary``."""
        return {path: start + pace * rows for path, (start, pace) in self.slides.items()}


def sliding(known: Known) -> tuple[Case, Input] | None:
    """The case with all points by coordinates, and its input, where every link only slides; None elsewhere.

    No guide turns then, so that every link goes straight on at the velocity of the position as written.
    """
    case = known.case
    if known.answer is None or known.answer.mobility != 1:
        return None
    nameless = any(name.startswith("@") for name in known.points)
    if nameless or not all(isinstance(joint, Slide | Pin | Slot | Weld) for joint in case.joints):
        return None
    going = {link: (t[1], -t[0]) for link, t in known.twists.items()}
    fastest = max((math.hypot(*v) for v in going.values()), default=0.0)
    if fastest == 0.0 or any(abs(t[2]) * known.size > STILL * fastest for t in known.twists.values()):
        return None
    paces = _paces(case, going)
    driver = _driver(case, going, fastest)
    if paces is None or driver is None:
        return None
    speed = math.hypot(*going[driver])
    moved = {name: (x / speed, y / speed) for name, (x, y) in paces.items()}
    return _by_coordinates(known), _input(known, driver, moved)


def _driver(case: Case, going: Mapping[str, Point], fastest: float) -> str | None:
    """The link whose motion is given, else the first that moves."""
    ranked = (*(m.link for m in case.motion), *case.links)
    return next((link for link in ranked if math.hypot(*going.get(link, (0.0, 0.0))) > 1e-3 * fastest), None)


def _paces(case: Case, going: Mapping[str, Point]) -> dict[str, Point] | None:
    """The velocity of every point that a link carries; None where a guide's points do not go with it."""
    paces = {p: going[link] for link in case.links if link != case.ground for p in case.carries.get(link, ())}
    paces |= dict.fromkeys(case.carries.get(case.ground, ()), (0.0, 0.0))
    for joint in case.joints:
        if isinstance(joint, Slide | Slot):
            ends = {*(joint.guide.ends or ()), joint.guide.through} - {None, joint.at}
            own = going[joint.links[1]]
            if any(math.dist(paces.get(str(p), (0.0, 0.0)), own) > STILL * math.hypot(*own) for p in ends):
                return None
    return paces


def _by_coordinates(known: Known) -> Case:
    def number(value: float, path: str) -> Number:
        return Number(value, 0.0, path, repr(value))

    points: dict[str, Coordinates | Centroid] = {
        name: Coordinates(number(x, f"points.{name}.x"), number(y, f"points.{name}.y"))
        for name, (x, y) in known.points.items()
    }
    return replace(known.case, points=points, lengths=(), angles=(), near={})


def _input(known: Known, driver: str, moved: Mapping[str, Point]) -> Input:
    """The input; its way is positive to the right, straight up where it goes neither right nor left."""
    t = known.twists[driver]
    angle = math.degrees(math.atan2(-t[0], t[1]))
    sign = 1.0 if -90.0 < round(angle, 9) <= 90.0 else -1.0
    toward = angle if sign > 0.0 else angle + (180.0 if angle <= 0.0 else -180.0)
    slides = {
        f"points.{name}.{axis}": (known.points[name][n], sign * pace[n])
        for name, pace in moved.items()
        for n, axis in enumerate("xy")
        if pace[n] != 0.0
    }
    senses = (f"at {figure_number(toward % 360.0)}°", f"at {figure_number((toward + 180.0) % 360.0)}°")
    return Input(driver, slides, f" {unit_word(known.case.units.length)}", senses)


def places(known: Known, by: Input, rows: Array) -> dict[str, Array]:
    """Where every point is, in positions too in which nothing can be solved."""
    now = by.varied(rows)

    def column(path: str, written: float) -> Array:
        return now.get(path, np.full(len(rows), written))

    return {
        name: np.column_stack((column(f"points.{name}.x", x), column(f"points.{name}.y", y)))
        for name, (x, y) in known.points.items()
    }


def ways(known: Known) -> Array:
    """Ways to either side, in round numbers, together about as long as the figure.

    The guides have no ends in a case, so that no range is the whole one.
    """
    size = max((math.dist(p, q) for p in known.points.values() for q in known.points.values()), default=0.0)
    size = size or known.size
    power = 10.0 ** math.floor(math.log10(0.5 * size))
    half = max(m for m in (1.0, 2.0, 5.0) if m * power <= 0.5 * size * (1.0 + 1e-9)) * power
    return np.arange(-ROWS, ROWS + 1) * (half / ROWS)
