"""Students who make one known mistake: their wrong answers, from the case's text and plain mechanics.

Nothing of the grader's own rules is used: a load is dropped by setting it to zero in the file, degrees are
fed as radians by setting the angles, distances are taken from the centres by hand.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import icsolve
from icsolve import Answer, Case
from icsolve.errors import IcsolveError


class Mistake(NamedTuple):
    """A wrong answer and the code by which it should be known."""

    code: str
    value: float


def solved(path: Path, settings: dict[str, Any] | None = None) -> Answer:
    return icsolve.solve(icsolve.load(path, settings), all_centres=True, rates=True, bound=False)


def tried(path: Path, settings: dict[str, Any], name: str) -> Iterator[float]:
    """The answer of a changed case, where it has one."""
    try:
        yield solved(path, settings).answers[name].value
    except (IcsolveError, ArithmeticError):
        return


def mistakes(path: Path) -> Iterator[Mistake]:
    """All mistakes that can be made on a case with one unknown."""
    right = solved(path)
    ((name, found),) = right.answers.items()
    value = found.value
    yield from _plain(value)
    for mistake in (_loads, _radians, _components, _ratios, _arms, _cranks, _other_mode):
        for m in mistake(path, right, name):
            if math.isfinite(m.value) and m.value:
                yield m


def _plain(value: float) -> Iterator[Mistake]:
    yield Mistake("sign", -value)
    for power in (-3, -1, 1, 2, 3):
        yield Mistake("power-of-ten", value * 10.0**power)
    for factor in (25.4, 1 / 25.4, 12.0, 1 / 12.0, 4.448, 1 / 4.448, 9.81, 0.3048, 57.3):
        yield Mistake("unit-factor", value * factor)
    yield Mistake("half", value / 2.0)
    yield Mistake("double", value * 2.0)
    yield Mistake("near-miss", value * 1.02)


def _numbers(case: Case) -> dict[str, float]:
    """The known loads that are one number."""
    loads = {load.name: getattr(load, "value", None) for load in case.loads}
    return {name: number.value for name, number in loads.items() if hasattr(number, "digits")}


def _loads(path: Path, right: Answer, name: str) -> Iterator[Mistake]:
    """One of several loads missed, or with the wrong sign."""
    known = _numbers(right.case)
    if len(known) < 2:
        return
    for load, number in known.items():
        yield from (Mistake("missed-load", v) for v in tried(path, {f"loads.{load}": 0}, name))
        yield from (Mistake("load-sense", v) for v in tried(path, {f"loads.{load}": -number}, name))


def _radians(path: Path, right: Answer, name: str) -> Iterator[Mistake]:
    """The calculator in radians: 60 degrees taken for 60 rad."""
    degrees = {angle.value.path: angle.value.value for angle in right.case.angles}
    fed = {key: math.degrees(value) for key, value in degrees.items()}
    if fed:
        yield from (Mistake("deg-rad", v) for v in tried(path, fed, name))


def _force(case: Case) -> Any:
    """The only known load, where it is a force with an angle; else None."""
    known = [load for load in case.loads if load.name in _numbers(case)]
    if len(known) != 1 or not hasattr(getattr(known[0], "heading", None), "digits"):
        return None
    return known[0]


def _components(path: Path, right: Answer, name: str) -> Iterator[Mistake]:
    """The whole velocity in place of its component along the force, and the component square to it."""
    force = _force(right.case)
    velocity = (right.velocities or {}).get((force.at, force.link)) if force is not None else None
    if force is None or velocity is None or force.against is not None:
        return
    angle = math.radians(force.heading.value)
    along = velocity[0] * math.cos(angle) + velocity[1] * math.sin(angle)
    across = -velocity[0] * math.sin(angle) + velocity[1] * math.cos(angle)
    value = right.answers[name].value
    if abs(along) > 1e-9 * math.hypot(*velocity):
        yield Mistake("no-cos", value * math.hypot(*velocity) / abs(along))
        yield Mistake("sin-cos", value * abs(across / along))


def _ratios(path: Path, right: Answer, name: str) -> Iterator[Mistake]:
    """T2 = T4 * w4 / w2 taken as T4 * w2 / w4."""
    unknown = next(load for load in right.case.loads if load.name == name)
    known = [load for load in right.case.loads if load.name in _numbers(right.case)]
    if len(known) != 1 or type(known[0]) is not type(unknown) or hasattr(unknown, "at"):
        return
    rates = right.rates or {}
    over, under = rates.get(known[0].link), rates.get(unknown.link)
    if isinstance(over, float) and isinstance(under, float) and over and under:
        yield Mistake("inverse-ratio", right.answers[name].value * (under / over) ** 2)


def _arms(path: Path, right: Answer, name: str) -> Iterator[Mistake]:
    """The arm of the force taken about another centre of its link."""
    force = _force(right.case)
    if force is None or force.at not in right.points or force.against is not None:
        return
    places = {pair: c.place for pair, c in right.centres.items() if c.kind == "at" and force.link in pair}
    own = next((place for pair, place in places.items() if right.case.ground in pair), None)
    if own is None:
        return
    angle, at = math.radians(force.heading.value), right.points[force.at]

    def arm(centre: tuple[float, ...]) -> float:
        return (at[0] - centre[0]) * math.sin(angle) - (at[1] - centre[1]) * math.cos(angle)

    if abs(arm(own)) > 1e-9:
        for place in places.values():
            if place != own:
                yield Mistake("wrong-ic", right.answers[name].value * arm(place) / arm(own))


def _cranks(path: Path, right: Answer, name: str) -> Iterator[Mistake]:
    """T = P I12-I24 of a slider 4, with the crank I12-I23 in place of the distance to its centre."""
    case = right.case
    unknown = next(load for load in case.loads if load.name == name)
    known = [load for load in case.loads if load.name in _numbers(case)]
    if len(known) != 1 or hasattr(unknown, "at") or not hasattr(known[0], "at"):
        return
    crank, slider = unknown.link, known[0].link
    own = {link: c for pair, c in right.centres.items() for link in pair if case.ground in pair}
    if crank == slider or own[slider].kind != "toward" or own[crank].kind != "at":
        return
    places = {frozenset(pair): c.place for pair, c in right.centres.items() if c.kind == "at"}
    common = places.get(frozenset((crank, slider)))
    if common is None or math.dist(common, own[crank].place) < 1e-9:
        return
    for pair, place in places.items():
        if crank in pair and case.ground not in pair and slider not in pair:
            factor = math.dist(place, own[crank].place) / math.dist(common, own[crank].place)
            yield Mistake("wrong-ic", right.answers[name].value * factor)


def _other_mode(path: Path, right: Answer, name: str) -> Iterator[Mistake]:
    """The coupler's pin of a four-bar on the other side of the line of its neighbours."""
    lengths = [(length.a, length.b) for length in right.case.lengths]
    for point in right.case.near:
        others = [b if a == point else a for a, b in lengths if point in (a, b)]
        if len(others) != 2:
            continue
        a, b = (complex(*right.points[other]) for other in others)
        turned = (complex(*right.points[point]) - a) / (b - a)
        image = a + turned.conjugate() * (b - a)
        settings = {f"near.{point}.x": repr(image.real), f"near.{point}.y": repr(image.imag)}
        yield from (Mistake("other-mode", v) for v in tried(path, settings, name))
