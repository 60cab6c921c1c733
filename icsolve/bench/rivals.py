"""A scene as other methods see it: points, basis twists of the joints, wrenches of the loads."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from icsolve.assembly import Frame
from icsolve.case import Case, Coordinates
from icsolve.kinematics.loops import Bases
from icsolve.numbers.arithmetic import FLOATS
from icsolve.screws.joints import freedoms
from icsolve.screws.plane import Point, Triple
from icsolve.solve.program import Program, Want, prepare
from icsolve.statics import power
from icsolve.structure.topology import Topology

Twists = Sequence[Triple]
"""Twist of every body relative to the frame."""


class Failed(Exception):
    """A method that has no answer for a scene."""


class OtherData(Exception):
    """A method for figures that are given in another way."""


class Drawn(NamedTuple):
    """A case to be solved by any method: its points as they were read; empty where lengths are given."""

    program: Program
    raw: dict[str, Point]

    @property
    def case(self) -> Case:
        """The case."""
        return self.program.case

    @property
    def top(self) -> Topology:
        """Its bodies and bonds."""
        return self.program.top


class Posed(NamedTuple):
    """Basis twists and unit wrenches in one frame."""

    top: Topology
    bases: Bases
    wrenches: tuple[power.Wrench, ...]


def drawn(case: Case) -> Drawn:
    """A case by coordinates, or a four-bar by its lengths."""
    program = prepare(case, Want(centres=True))
    raw = {}
    for name, place in case.points.items():
        assert isinstance(place, Coordinates) and place.x is not None and place.y is not None
        raw[name] = (place.x.value, place.y.value)
    return Drawn(program, {} if case.lengths else raw)


def posed(scene: Drawn, normalised: bool) -> Posed:
    """The scene in raw coordinates, or moved to an input pin and scaled by a power of two."""
    ox, oy, scale = scene.program.figure.frame if normalised else (0.0, 0.0, 1.0)
    raw = scene.raw or by_cosines(scene.case)
    points = {name: ((x - ox) * scale, (y - oy) * scale) for name, (x, y) in raw.items()}
    bases = {k: freedoms(bond, points, FLOATS) for k, bond in enumerate(scene.top.bonds)}
    return Posed(scene.top, bases, power.wrenches(scene.case, Frame(0.0, 0.0, scale), points, FLOATS))


def by_cosines(case: Case) -> dict[str, Point]:
    """The pins A, B, C, D of a four-bar from its lengths and the crank's angle, by the law of cosines."""
    a, b, c = (length.value.value for length in case.lengths)
    place = case.points["D"]
    assert isinstance(place, Coordinates) and place.x is not None
    d, angle = place.x.value, math.radians(case.angles[0].value.value)
    bx, by = a * math.cos(angle), a * math.sin(angle)
    apart = math.sqrt(a * a + d * d - 2.0 * a * d * math.cos(angle))
    turn = math.acos((b * b + apart * apart - c * c) / (2.0 * b * apart)) + math.atan2(-by, d - bx)
    return {
        "A": (0.0, 0.0),
        "B": (bx, by),
        "C": (bx + b * math.cos(turn), by + b * math.sin(turn)),
        "D": (d, 0.0),
    }


def balanced(pose: Posed, twists: Twists) -> float:
    """The unknown load from the sum of power, without any test."""
    of_link = {link: (twists[body],) for link, body in pose.top.body_of.items()}
    factors = power.balance(pose.wrenches, of_link, 1).factors[0]
    known = factor = measure = 0.0
    for w, value in zip(pose.wrenches, factors, strict=True):
        number = power.known_value(w)
        if number is None:
            factor, measure = factor + value, w.measure
        else:
            known += number * value * w.measure
    return -known / factor / measure
