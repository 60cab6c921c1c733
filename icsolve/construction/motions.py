"""The motions of a mechanism with several freedoms (or of one whose centres give no ratio), one by one."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from icsolve.assembly import Frame
from icsolve.construction.known import Known
from icsolve.construction.needed import loaded_links
from icsolve.errors import SceneError
from icsolve.screws.plane import Triple
from icsolve.solve.program import Want, evaluate, prepare

LEAST = 1e-9
"""A rate below this, of the largest of its motion, can't be the one that a motion is told by."""


class OneMotion(NamedTuple):
    """A motion: the twist of every link in case units. ``driver`` has 1 in it and 0 in the others."""

    driver: str
    turns: bool
    twists: Mapping[str, Triple]


def independent_motions(known: Known) -> tuple[OneMotion, ...]:
    """As many motions as there are freedoms; each is told by a link that none of the others moves."""
    try:
        program = prepare(known.case, Want(True, True))
        motions = evaluate(program)[1].motions.twists
    except SceneError:
        return ()
    links = list(dict.fromkeys((*loaded_links(known.case), *known.case.links)))
    count = len(next(iter(motions.values()), ()))
    rows = [{link: motions[link][m] for link in links} for m in range(count)]
    drivers: list[tuple[str, int]] = []
    for n in range(count):
        driver = _driver(rows, n, links)
        if driver is None:
            return ()
        drivers.append(driver)
        rows = _cleared(rows, n, driver)
    frame = program.figure.frame
    return tuple(
        OneMotion(link, place == 2, {name: _in_case_units(t, frame, place) for name, t in row.items()})
        for (link, place), row in zip(drivers, rows, strict=True)
    )


Rows = list[dict[str, Triple]]


def _driver(rows: Rows, n: int, links: list[str]) -> tuple[str, int] | None:
    """The first link that clearly turns in motion n, else one that clearly moves, and by which number."""
    row = rows[n]
    for places in ((2,), (0, 1)):
        sizes = {(link, place): abs(row[link][place]) for link in links for place in places}
        largest = max(sizes.values())
        if largest > LEAST * max(abs(v) for t in row.values() for v in t) and largest > 0.0:
            return next(key for key, size in sizes.items() if size > 0.1 * largest)
    return None


def _cleared(rows: Rows, n: int, driver: tuple[str, int]) -> Rows:
    """The motions with the driver at 1 in motion n and at rest in all others."""
    link, place = driver
    pivot = rows[n][link][place]
    own = {name: _times(t, 1.0 / pivot) for name, t in rows[n].items()}
    rest = []
    for m, row in enumerate(rows):
        amount = row[link][place]
        rest.append(own if m == n else {name: _less(t, own[name], amount) for name, t in row.items()})
    return rest


def _times(t: Triple, s: float) -> Triple:
    return (t[0] * s, t[1] * s, t[2] * s)


def _less(t: Triple, other: Triple, s: float) -> Triple:
    """t less s times another, without what rounding leaves of a difference."""
    values = []
    for a, b in zip(t, other, strict=True):
        value = a - s * b
        values.append(0.0 if abs(value) <= 1e-13 * (abs(a) + abs(s * b)) else value)
    return (values[0], values[1], values[2])


def _in_case_units(t: Triple, frame: Frame, place: int) -> Triple:
    """From the normalised frame; a motion told by a speed has it at 1 case length a second."""
    s = 1.0 if place == 2 else frame.scale
    x, y, w = (float(value) * s + 0.0 for value in t)
    return (x / frame.scale + w * frame.ox, y / frame.scale + w * frame.oy, w)


def speed_words(motion: OneMotion) -> str:
    """The driver's motion in words."""
    x, y, w = motion.twists[motion.driver]
    if motion.turns:
        return f"link {motion.driver} turns at 1 rad/s counterclockwise"
    return f"link {motion.driver} moves at {math.hypot(x, y) if w == 0.0 else 1.0:.6g} length units a second"
