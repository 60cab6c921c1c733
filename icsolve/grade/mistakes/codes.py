"""The codes of known mistakes, simplest first, each with the line that a student is told."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

CODES: dict[str, str] = {
    "unit": "The number is right, but not in this unit.",
    "no-unit": "The number is right; its unit is missing.",
    "unit-case": "The number is right; the capitals of its unit are not.",
    "figures": "The number is right, but written with too few figures.",
    "sign": "Right size, wrong sense. Check the sign of the power of each load.",
    "direction": "Right size, but this is not how the direction of this quantity is given.",
    "no-direction": "Right size; say its direction in words as well.",
    "one-end": "One end of the range is right; the other is missing or wrong.",
    "power-of-ten": "The digits are right, the power of ten is not. Check mm and m, N and kN.",
    "unit-factor": "Off by a unit factor: in and mm, ft and in, lb and N, kg and N, degrees and radians.",
    "deg-rad": "Was the calculator set to radians?",
    "no-cos": "Use only the component of the velocity along the force{at}.",
    "sin-cos": "Sine and cosine are exchanged{at}.",
    "inverse-ratio": "A velocity ratio is upside down{at}.",
    "wrong-ic": "A distance is taken from another centre of the same link{at}. About which one does it turn?",
    "mesh-sense": "An outer mesh is taken for an inner one, or a crossed belt for an open one.",
    "missed-load": "The power of one load is missing{at}.",
    "load-sense": "The power of one load has the wrong sign{at}.",
    "other-unknown": "This is the size of another unknown{at}.",
    "half": "Half the right size. Is something counted once that is there twice?",
    "double": "Twice the right size. Is something counted twice?",
    "other-mode": "This belongs to the other way in which the mechanism assembles. Compare with the figure.",
    "no-friction": "Friction is left out.",
    "friction-sense": "Friction acts against the motion; here it acts with it.",
    "ratio-one": "A velocity ratio is taken as 1{at}.",
    "missed-stage": "One stage of the chain of ratios is left out{at}.",
    "one-component": "Only one component of the arm or the force is taken{at}.",
    "one-arm": "Of the two distances of a ratio one is left out{at}.",
    "angle-sense": "An angle is measured the other way round{at}.",
    "rpm": "Revolutions a minute are taken for radians a second, or the other way.",
    "free-length": "The free length, or the free angle, of a spring is left out{at}.",
    "area": "The area under a pressure is taken wrong{at}: pi/4 of the bore squared, less that of the rod.",
    "line-load": "A force per length is taken wrong{at}: how large is its resultant, and where does it act?",
    "mass": "A mass is taken for a weight, or a weight for a mass{at}.",
    "rope-parts": "The parts of a rope that pull are counted wrong{at}.",
    "wrap": "The angle over which a rope lies is taken wrong, or left out of the exponent{at}.",
    "lead": "A screw moves by its lead a turn, which is 2 pi radians.",
    "no-inertia": "An inertia force or couple is left out{at}.",
    "no-acceleration": "The acceleration that is given is left out, or has the wrong sense.",
    "neighbour": "This is the right answer to other numbers than yours{at}.",
    "swapped": "The two coordinates are exchanged.",
    "carried": "The method is right; the error comes from an earlier answer{at}.",
    "override": "Marked by hand.",
    "near-miss": "Close, but not within the tolerance. Rounding on the way? Keep four figures.",
}
"""Stable codes in order of simplicity: of several that fit, the first is told."""

ORDER = {code: index for index, code in enumerate(CODES)}


class Wrong(NamedTuple):
    """A wrong answer whose cause is known: its code, its signed value, and where the mistake sits."""

    code: str
    value: float
    where: str = ""
    load: str = ""
    """the load whose share it changes, where it changes no other"""


_OTHERWISE = {
    ("sign", "ratio"): "Right size, wrong sense. Do the two links turn the same way?",
    ("sign", "rate"): "Right size, wrong sense. Which way does the link turn?",
    ("sign", "place"): "The sizes are right; a coordinate has the wrong sign.",
    ("sign", "reaction"): "Right size, wrong sense. Which link's force on which is asked?",
    ("sign", "length"): "Right size; a distance has no sign.",
    ("power-of-ten", "ratio"): "The digits are right, the power of ten is not. A ratio has no unit.",
    ("power-of-ten", "place"): "The digits are right, the power of ten is not. Check mm and m.",
    ("power-of-ten", "length"): "The digits are right, the power of ten is not. Check mm and m.",
    ("unit-factor", "place"): "Off by a unit factor: in and mm, ft and in.",
    ("unit-factor", "length"): "Off by a unit factor: in and mm, ft and in.",
    ("unit-factor", "ratio"): "Off by a factor of units; a ratio has none.",
    ("wrong-ic", "place"): "This is another centre{at}.",
    ("sign", "position"): "Right size, wrong sense. From where, and which way round, is it measured?",
    ("power-of-ten", "position"): "The digits are right, the power of ten is not. Check mm and m.",
    ("unit-factor", "position"): "Off by a unit factor: degrees and radians, in and mm.",
    ("sin-cos", "position"): "This is the angle from the other axis.",
    ("angle-sense", "position"): "This is the angle from the other end of the line.",
    ("missed-load", "position"): "One load is missing{at}.",
    ("load-sense", "position"): "One load has the wrong sense{at}.",
    ("half", "ratio"): "Half the right size. Is a ratio counted once that stands there twice?",
}
"""What is told where a question asks for something else than a load."""


def message(code: str, where: str = "", kind: str = "load") -> str:
    """The line for a mistake in an answer of a ``kind`` (`icsolve.grade.keys.kind_of`).

    It names the cause and the load, link or centre, never the answer.
    """
    told = _OTHERWISE.get((code, kind)) or CODES[code]
    return told.format(at=f" ({where})" if where else "")


def together(one: Wrong, two: Wrong, kind: str = "load") -> str:
    """The line for two mistakes that were made at once."""
    said = " ".join(message(wrong.code, wrong.where, kind) for wrong in (one, two))
    return f"Two mistakes at once: {said}"


PLAIN = frozenset({"sign", "power-of-ten", "unit-factor", "half", "double", "rpm"})
"""Mistakes that need nothing but the right answer: a factor on it."""


FACTORS = {
    "in and mm": 25.4,
    "ft and in": 12.0,
    "lb and N": 4.4482216152605,
    "kg and N": 9.80665,
    "ft and m": 0.3048,
    "degrees and radians": 57.29577951308232,
}
"""Unit factors that are forgotten or applied twice."""
_REVOLUTIONS = {"revolutions and radians": 6.283185307179586}
_RPM = 9.549296585513721


def plain_wrongs(value: float, rate: bool = False) -> Iterator[Wrong]:
    """The wrong answers about a right ``value``; of an angular speed (``rate``) with those of revolutions."""
    yield Wrong("sign", -value)
    for power in (*range(-6, 0), *range(1, 7)):
        yield Wrong("power-of-ten", value * 10.0**power)
        yield Wrong("power-of-ten", -value * 10.0**power)
    for name, factor in (FACTORS | (_REVOLUTIONS if rate else {})).items():
        yield Wrong("unit-factor", value * factor, name)
        yield Wrong("unit-factor", value / factor, name)
    if rate:
        yield Wrong("rpm", value * _RPM)
        yield Wrong("rpm", value / _RPM)
    yield Wrong("half", value / 2.0)
    yield Wrong("double", value * 2.0)
