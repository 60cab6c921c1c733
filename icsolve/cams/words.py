"""Sentences about profiles."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from icsolve.cams.curve import Curve, Foot, table_spline
from icsolve.cams.pieces import CircularArc, Point, PolarPiece
from icsolve.case import Number
from icsolve.case.profiles import Arcs, Circle, Polygon, Radii, Shape
from icsolve.wording import direction_words, listed, plural

if TYPE_CHECKING:
    from icsolve.answer.bodies import Touching

NEAREST = 3
"""Radii that are left out in turn to tell what interpolation leaves open."""


def never_meets(what: str, kind: str, gap: float | None) -> str:
    """A follower that is apart from its profile, or in it; None: wherever it moves."""
    if gap is None:
        return (
            f"{what}: the {kind} never meets the profile, wherever its guide or pin lets it go. Correct the "
            "guide, the arm or the profile."
        )
    how = f"is {gap:.6g} away from" if gap > 0.0 else f"lies {-gap:.6g} inside"
    return (
        f"{what}: the {kind} {how} the profile in this position. Leave the follower's place open, so that "
        "the contact gives it, or correct it."
    )


def several_ways(what: str, point: str, places: Sequence[Point], pointed: bool) -> str:
    """A follower that can touch in several positions."""
    shown = listed(f"({x:.4g}, {y:.4g})" for x, y in places)
    hint = f"give `near: {{{point}: [...]}}` for one of them"
    if pointed:
        hint = "move `near` to the one that is meant"
    return f"{what} can touch it in {len(places)} ways, with {point} at {shown}: {hint}."


def corner_refusal(what: str, before: float, spread: float, given: Number | None) -> str:
    """A knife edge on a corner."""
    low, high = before % 360.0, (before + spread) % 360.0
    said = "which of them it is, the profile leaves open"
    if given is not None:
        said = f"the normal {given.digits} is not one of them"
    return (
        f"{what}: the knife edge stands on a corner, whose normals go from {low:.6g} to {high:.6g} deg; "
        f"{said}. Give the contact a `normal` between them, or take a position beside it."
    )


def passes_corner(what: str) -> str:
    """A knife edge that meets neither piece beside a corner, as all digits show, where doubles put it."""
    return (
        f"{what}: the knife edge passes a corner, so near that doubles put it there, and it is not told what "
        "it meets beyond. Take a position beside it."
    )


def piece_words(shape: Shape, curve: Curve, foot: Foot) -> str:
    """Which part of a profile a place is on, counted ccw from where the case starts it."""
    if isinstance(shape, Circle):
        return "circle"
    if foot.is_corner:
        return "corner"
    if isinstance(shape, Polygon):
        return "edge"
    piece = curve.pieces[foot.piece]
    if isinstance(shape, Arcs) and isinstance(piece, CircularArc):
        return f"arc of radius {piece.radius:.6g}"
    return "line between arcs" if isinstance(shape, Arcs) else "spline"


def left_open(shape: Shape, curve: Curve, foot: Foot, what: str) -> str:
    """What the interpolation of a table leaves open at a place; '' for exact profiles."""
    piece = curve.pieces[foot.piece]
    if not isinstance(shape, Radii) or not isinstance(piece, PolarPiece):
        return ""
    angle = piece.angle(foot.u)
    table = [(a.value, r.value) for a, r in shape.table]
    table.sort(key=lambda pair: abs(math.remainder(math.radians(pair[0]) - angle, 2.0 * math.pi)))
    said = f"{what} is a periodic cubic spline through {len(table)} radii"
    if len(table) < 5:
        return f"{said}: too few to tell how far it can be trusted between them."
    others = [table_spline((*table[:k], *table[k + 1 :])) for k in range(NEAREST)]
    gaps = (_gap_and_angle(piece, piece._replace(radius=other), foot.u) for other in others)
    off, turned = zip(*gaps, strict=True)
    return (
        f"{said}: without one of those near the contact it would lie up to {max(off):.2g} away there, "
        f"with its normal turned by up to {max(turned):.2g} deg."
    )


def _gap_and_angle(one: PolarPiece, other: PolarPiece, u: float) -> tuple[float, float]:
    """How far two curves are apart at a place, and the angle between them there, degrees."""
    off = math.dist(one.at(u), other.at(u))
    return off, math.degrees(abs(_angle(one.tangent(u), other.tangent(u))))


def _angle(a: Point, b: Point) -> float:
    return math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])


def not_guided(follower: str, cam: str) -> str:
    """A follower that something that moves guides, in a sweep."""
    return (
        f"in a sweep a follower has to be guided by the frame, by a slide or a pin, and link {follower} on "
        f"the profile of link {cam} is not. Vary a load, or solve the positions one by one."
    )


def follower_driven(follower: str, cams: Sequence[str]) -> str:
    """A follower that a sweep is to turn."""
    return (
        f"link {follower} follows a profile and cannot be the driving link of a sweep: drive link "
        f"{listed(cams)}, and the profile moves it."
    )


def contact_said(one: Touching) -> str:
    """Where two links touch."""
    least = 1e-14 * math.hypot(*one.at)
    x, y = (0.0 if abs(v) <= least else v for v in one.at)
    pressure = "" if one.pressure_angle is None else f", pressure angle {one.pressure_angle:.6g} deg"
    place = f"({x:.6g}, {y:.6g}), {_article(one.on)}, normal {direction_words(one.normal)}"
    return f"links {listed(one.links)} touch at {place}{pressure}."


def widest_pressure(links: Sequence[str], angle: float, where: str) -> str:
    """The widest pressure angle of a sweep."""
    return f"the pressure angle of links {listed(links)} is {angle:.4g} deg at most, at {where}."


def lost_rows(links: Sequence[str], count: int, where: str) -> str:
    """A contact that pulls in some rows of a sweep."""
    rows = plural(count, "row")
    return (
        f"the contact of links {listed(links)} is lost in {rows}, first at {where}: its normal force would "
        "have to pull there."
    )


def _article(on: str) -> str:
    return f"on {'an' if on[0] in 'aeiou' else 'the' if on in ('circle', 'spline') else 'a'} {on}"
