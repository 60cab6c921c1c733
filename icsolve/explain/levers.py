"""The lever of a force on a link: its arm about the link's centre where the link turns, the cosine of the
angle with the motion where it slides; and the names of what moves."""

from __future__ import annotations

import math
from collections.abc import Mapping

from icsolve.explain.document import Block, Inline, formula, words
from icsolve.explain.formula import Expr, Name, Num, Sum, Trig, product
from icsolve.explain.given import Figures, centre_name, rate_name, speed_name
from icsolve.numbers.arithmetic import turn_of
from icsolve.report.derivation.known import Known
from icsolve.screws.plane import Point
from icsolve.tuples import NamedTuple
from icsolve.wording.senses import NOTHING
from icsolve.wording.sentences import link_words


class Lever(NamedTuple):
    """``h`` or ``c`` with its number: the power of a unit of the force while its link moves at 1."""

    name: Name
    number: Num
    value: float


def motion_name(known: Known, link: str) -> Name:
    """The rate of a link that turns, the speed of one that slides."""
    return rate_name(link) if known.turns(link) else speed_name(link)


def place(known: Known, pair: tuple[str, str]) -> Point:
    """Coordinates of a finite centre."""
    centre = known.centre(*pair)
    assert centre is not None and centre.kind == "at"
    return (centre.place[0], centre.place[1])


def difference(figures: Figures, to: float, start: float) -> Expr:
    """One coordinate less another."""
    return Sum(((1, figures.length(to)), (-1, figures.length(start))))


def pivot(known: Known, link: str) -> Point | None:
    """The centre of a link with the frame where it has an arm about it: it turns, or is pinned and rests."""
    centre = known.centre(*known.pair(link, known.case.ground))
    if centre is None or centre.kind != "at" or not (known.turns(link) or known.rests(link)):
        return None
    return (centre.place[0], centre.place[1])


def lever(
    known: Known,
    figures: Figures,
    headings: Mapping[str, float],
    force: tuple[Inline, ...],
    low: str,
    link: str,
    at: Point,
    direction: Point,
) -> tuple[Lever, list[Block]]:
    """The lever of a force (in words) along a direction at a place of a link, and its formula.

    ``headings`` are the directions in which links slide, degrees.
    """
    angle = math.degrees(math.atan2(direction[1], direction[0])) % 360.0
    written = figures.number(angle)
    about = pivot(known, link)
    if about is None:
        cosine = turn_of(angle - headings[link])[0]
        found = Lever(Name("c", low), figures.number(cosine), cosine)
        between = Sum(((1, written), (-1, figures.number(headings[link]))))
        said = words("The part of ", *force, f" along the motion of {link_words(link)}:")
        return found, [said, formula(found.name, Trig("cos", between), found.number)]
    arm = (at[0] - about[0]) * direction[1] - (at[1] - about[1]) * direction[0]
    arm = arm if abs(arm) > NOTHING * math.dist(at, about) else 0.0
    found = Lever(Name("h", low), figures.length(arm), arm)
    across, up = (difference(figures, to, start) for to, start in zip(at, about, strict=True))
    moments = Sum(((1, product(across, Trig("sin", written))), (-1, product(up, Trig("cos", written)))))
    centre = centre_name(known, known.pair(link, known.case.ground))
    turns = f", positive where it turns link {link} counterclockwise:"
    said = words("The arm of ", *force, " about ", centre, turns)
    return found, [said, formula(found.name, moments, figures.distance(arm))]
