"""The surfaces of cams and followers whose profiles a case gives, in case units."""

from __future__ import annotations

from collections.abc import Mapping

from icsolve.cams.curve import placed
from icsolve.case import Case, Contact
from icsolve.case.profiles import Circle, Flat, Knife, Roller, points_of
from icsolve.draw.marks import Box
from icsolve.draw.wheels import Edge, Wheel
from icsolve.errors import SceneError
from icsolve.numbers.arithmetic import turn_of
from icsolve.screws.plane import Point


def surfaces(case: Case, joint: Contact, points: Mapping[str, Point]) -> list[Wheel | Edge]:
    """The circles and faces that touch at a contact; other profiles are `outlines`."""
    assert case.profiles is not None
    found: list[Wheel | Edge] = []
    for link, sign in zip(joint.links, (1.0, -1.0), strict=True):
        match case.profiles.shapes[link]:
            case Circle(centre, radius) | Roller(centre, radius) if centre in points:
                found.append(Wheel(link, points[centre], radius.value, "cam"))
            case Flat():
                x, y = turn_of(joint.normal.value)
                found.append(Edge(link, points[joint.at], (sign * x, sign * y)))
    return found


def outlines(case: Case, points: Mapping[str, Point]) -> list[tuple[str, list[Point]]]:
    """Links with the corners of their profiles, curved pieces by short chords; but circles and followers."""
    shapes = case.profiles.shapes if case.profiles is not None else {}
    found = []
    for link, shape in shapes.items():
        if isinstance(shape, Circle | Flat | Roller | Knife) or not set(points_of(shape)) <= points.keys():
            continue
        try:
            curve = placed(shape, points, f"the profile of link {link}")
        except SceneError:
            continue
        found.append((link, [place for place, _, _ in curve.chords]))
    return found


def outline_boxes(case: Case, points: Mapping[str, Point]) -> list[Box]:
    """The room that outlines take."""
    boxes = []
    for _, corners in outlines(case, points):
        xs, ys = [x for x, _ in corners], [y for _, y in corners]
        boxes.append((min(xs), min(ys), max(xs), max(ys)))
    return boxes
