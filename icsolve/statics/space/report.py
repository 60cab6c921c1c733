"""What is said of loads and motions in space: units, senses, terms of the sum of power, and words."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from icsolve.answer import Term
from icsolve.case import Case, Spring, Toward, Weight
from icsolve.case.space import (
    Along,
    FromTo,
    Load,
    SpatialForce,
    SpatialTorque,
    TorqueVector,
    Vector,
)
from icsolve.screws.space import AXES, Vec, cross, dot, size, sub, times, unit
from icsolve.statics.space.figure import SpatialFigure
from icsolve.statics.space.power import SpatialBalance, Wrenched


def unit_of(load: Load, case: Case) -> str:
    """Unit in which a load's number is given and printed."""
    match load:
        case SpatialTorque() | TorqueVector():
            return case.units.torque
        case Weight(mass=True):
            return "kg"
        case Spring():
            return f"{case.units.force}/{case.units.length}"
    return case.units.force


def sense_of(w: Wrenched, value: float) -> str:
    """Sense of an unknown load: ``along -z``, ``about x``, ``toward A``, ``pull``; '' for zero."""
    if value == 0.0:
        return ""
    forth = value > 0.0
    match w.load:
        case Spring():
            return "pull" if forth == (float(w.gain) > 0.0) else "push"
        case Weight():
            return "down" if forth else "up"
        case SpatialTorque(heading=Along() | Vector() | FromTo() as heading):
            return f"about {_heading_words(heading, forth)}"
        case SpatialForce(heading=Along() | Vector() | FromTo() as heading):
            return f"along {_heading_words(heading, forth)}"
        case SpatialForce(heading=Toward() as toward):
            drawn = forth != toward.away
            if w.load.against is not None:
                return "pull" if drawn else "push"
            return f"{'toward' if drawn else 'away from'} {toward.point}"
    return ""


def _heading_words(heading: Along | Vector | FromTo, forth: bool) -> str:
    """``-z``; ``A to B``; the components of the unit vector."""
    match heading:
        case Along(word):
            return word if forth else word[1:] if word[0] == "-" else f"-{word}"
        case FromTo(a, b):
            return f"{a} to {b}" if forth else f"{b} to {a}"
        case Vector(x, y, z):
            sign = 1.0 if forth else -1.0
            return direction_words(unit((sign * x.value, sign * y.value, sign * z.value)))


def terms_of_power(
    case: Case, loads: Sequence[Wrenched], balance: SpatialBalance, values: Mapping[str, float]
) -> tuple[Term, ...]:
    """The sum of power, for the motion in which the one unknown load moves at 1 (length or rad a second)."""
    unknown = [w for w in loads if w.known is None]
    if len({w.root for w in unknown}) != 1:
        return ()
    powers = [[float(power.value) for power in row] for row in balance.powers]
    ones = [sum(p for p, w in zip(row, loads, strict=True) if w.known is None) for row in powers]
    most = max(range(len(ones)), key=lambda m: abs(ones[m]))
    turns = isinstance(next(w for w in unknown if w.load.name == w.root).load, SpatialTorque)
    whole = ones[most] * (case.units.torque_per_force_length if turns else 1.0)
    terms = []
    for w, power in zip(loads, powers[most], strict=True):
        factor = power / float(w.ratio) / whole if w.ratio else 0.0
        name, value = w.load.name, values[w.load.name]
        words = f"{name} on link {w.load.link}" + _at(w.load)
        unit_name, is_asked = unit_of(w.load, case), w.known is None
        terms.append(Term(name, w.load.link, value, unit_name, factor, value * factor, is_asked, words))
    return tuple(terms)


def _at(load: Load) -> str:
    at = getattr(load, "at", "@")
    return "" if at.startswith("@") else f" at {at}"


def advantage_of(loads: Sequence[Wrenched], values: Mapping[str, float]) -> float | None:
    """unknown / known where there is one of each and the known one is not zero."""
    found = [w.load.name for w in loads if w.known is None]
    known = [w.load.name for w in loads if w.known is not None]
    if len(found) != 1 or len(known) != 1 or values[known[0]] == 0.0:
        return None
    return values[found[0]] / values[known[0]]


SMALL = 1e-9
"""A part of a twist that is below this fraction of the whole is none (rounding)."""


Motion = Mapping[str, Sequence[float]]
"""The twist of every link, (6,)."""


def _parts(twist: Sequence[float]) -> tuple[Vec, Vec]:
    """Velocity at the origin and angular velocity."""
    u, v, w, a, b, c = twist
    return (u, v, w), (a, b, c)


def _speed(twist: Sequence[float]) -> float:
    return float(sum(map(size, _parts(twist))))


def motion_words(link: str, motion: Motion, figure: SpatialFigure) -> str:
    """How a link moves: `link 2 turns about the line through A along z`."""
    v, w = _parts(motion[link])
    fastest = max(map(_speed, motion.values()))
    if size(w) <= SMALL * fastest:
        return f"link {link} slides along {direction_words(unit(v))}"
    axis = unit(w)
    on_axis = times(1.0 / dot(w, w), cross(w, v))
    pitch = dot(v, axis) / size(w)
    screw = abs(pitch) > SMALL * (1.0 + size(v) / size(w))
    verb = "screws" if screw else "turns"
    return f"link {link} {verb} about the line {_line(on_axis, axis, figure)}"


def _line(p: Vec, axis: Vec, figure: SpatialFigure) -> str:
    """A line by the named points on it, or by a point and its direction."""
    shown = [(name, point) for name, point in figure.points.items() if not name.startswith("@")]
    named = [(name, point) for name, point in shown if _is_on(point, p, axis)]
    apart = [name for name, point in named if size(sub(point, named[0][1])) > SMALL]
    if apart:
        return f"through {named[0][0]} and {apart[0]}"
    if named:
        return f"through {named[0][0]} along {direction_words(axis)}"
    return f"through {point_words(figure.frame.shown(p))} along {direction_words(axis)}"


def _is_on(point: Vec, p: Vec, axis: Vec) -> bool:
    """Whether a point lies on the line through p along a unit vector."""
    apart = sub(point, p)
    return float(size(cross(apart, axis))) <= SMALL * (1.0 + float(size(apart)))


def direction_words(direction: Vec) -> str:
    """``z``, ``-x``, or the components of the unit vector."""
    for name, axis in zip("xyz", AXES, strict=True):
        if size(cross(direction, axis)) <= SMALL:
            return name if dot(direction, axis) > 0.0 else f"-{name}"
    return point_words(direction)


def point_words(p: Vec) -> str:
    """Three numbers in brackets."""
    x, y, z = (0.0 if abs(c) <= SMALL * size(p) else c for c in p)
    return f"[{x:.6g}, {y:.6g}, {z:.6g}]"


def moving(motion: Motion, first: Iterable[str]) -> str:
    """The first link that moves: of those named, or else of all."""
    fastest = max(map(_speed, motion.values()))
    moves = [link for link, twist in motion.items() if _speed(twist) > SMALL * fastest]
    return next((link for link in first if link in moves), moves[0])
