"""What a load does for a motion: its arm about a centre or its part along a translation, with formulas."""

from __future__ import annotations

import math
from typing import NamedTuple

from icsolve.case import Spring, Torque, Weight
from icsolve.construction import Acting, Known, Ratios
from icsolve.explain.document import Block, formula, words
from icsolve.explain.formula import Expr, Name, Num, Quotient, Sum, Trig, product
from icsolve.explain.numbers import Figures, centre_name, load_name
from icsolve.explain.speeds import difference, motion_name, place


class End(NamedTuple):
    """A load at one of its two links: ``lever`` as a symbol (None for a torque) and as a number."""

    sign: int
    link: str
    lever: Name | None
    number: Num
    value: float


class Term(NamedTuple):
    """A load with its ends; ``gain`` is what its own unit exerts, ``factor`` its power per unit of it while
    the reference moves at 1, in the unit of the equation; ``numbers`` is that written out."""

    acting: Acting
    ends: tuple[End, ...]
    gain: tuple[Expr, ...]
    numbers: Expr
    factor: float

    def symbols(self, known: Known, over: str | None = None) -> Expr:
        """The load times its levers and speeds (over the speed of a link)."""
        parts = tuple((end.sign, _moving(known, end, over)) for end in self.ends)
        whole = parts[0][1] if len(parts) == 1 else Sum(parts)
        return product(load_name(self.acting.load.name), *self.gain, whole)

    @property
    def sign(self) -> int:
        """The sign in front, where the load has one end."""
        return self.ends[0].sign if len(self.ends) == 1 else 1


def _moving(known: Known, end: End, over: str | None) -> Expr:
    motion: Expr = motion_name(known, end.link)
    if over is not None:
        motion = Num("1") if end.link == over else Quotient(motion, motion_name(known, over))
    return product(*(() if end.lever is None else (end.lever,)), motion)


def term_of(
    known: Known, figures: Figures, ratios: Ratios, acting: Acting
) -> tuple[Term | None, list[Block]]:
    """A load's term and the formulas of its levers; None where all its links stand still."""
    said: list[Block] = []
    ends = []
    for sign, link in links_of(known, acting):
        if known.rests(link):
            said.append(
                words(f"Link {link} stands still: ", load_name(acting.load.name), " does no work on it.")
            )
            continue
        end, more = _end(known, figures, ratios, acting, sign, link)
        ends.append(end)
        said += more
    if not ends:
        return None, said
    gain, value, more = _gain(known, figures, acting)
    scale = conversion(known, ratios, acting)
    parts = tuple((end.sign, product(end.number, figures.number(ratios.rates[end.link]))) for end in ends)
    whole = parts[0][1] if len(parts) == 1 else Sum(parts)
    numbers = product(*(() if not gain else (figures.number(value),)), whole, figures.number(scale))
    sign = ends[0].sign if len(ends) == 1 else 1
    total = sum(end.sign * end.value * ratios.rates[end.link] for end in ends)
    return Term(acting, tuple(ends), gain, numbers, sign * total * value * scale), [*said, *more]


def links_of(known: Known, acting: Acting) -> list[tuple[int, str]]:
    """The links on which a load acts, with their signs: the frame does no work, a clockwise torque has -1."""
    turn = -1 if isinstance(acting.load, Torque) and acting.load.turns == "cw" else 1
    both = [(turn, acting.link), (-turn, acting.against)]
    return [(sign, link) for sign, link in both if link != known.case.ground]


def conversion(known: Known, ratios: Ratios, acting: Acting) -> float:
    """What brings a term to the unit of the equation: torque where the reference turns, else force."""
    ratio = known.case.units.torque_per_force_length
    torque = acting.at is None
    if known.turns(ratios.reference):
        return 1.0 if torque else ratio
    return 1.0 / ratio if torque else 1.0


def _gain(known: Known, figures: Figures, acting: Acting) -> tuple[tuple[Expr, ...], float, list[Block]]:
    """What a kilogram weighs, or by how much a spring is stretched: symbol, number and words."""
    load = acting.load
    if isinstance(load, Weight) and load.mass:
        weight = figures.quantity(acting.gain, f"{known.case.units.force}/kg")
        return (Name("g"),), acting.gain, [words("A mass weighs g = ", weight, ".")]
    if isinstance(load, Spring):
        a, b = known.points[load.at], known.points[load.to]
        long, free = figures.length(math.dist(a, b)), figures.length(load.free.value)
        name = Name("s", load.name)
        stretch = formula(name, Sum(((1, long), (-1, free))), figures.distance(acting.gain))
        return (name,), acting.gain, [words("The stretch of ", load_name(load.name), ":"), stretch]
    return (), 1.0, []


def _end(
    known: Known, figures: Figures, ratios: Ratios, acting: Acting, sign: int, link: str
) -> tuple[End, list[Block]]:
    if acting.at is None:
        return End(sign, link, None, Num("1"), 1.0), []
    low = acting.load.name if len(links_of(known, acting)) == 1 else f"{acting.load.name},{link}"
    if known.turns(link):
        return _arm(known, figures, acting, End(sign, link, Name("h", low), Num("0"), 0.0))
    return _part(figures, ratios, acting, End(sign, link, Name("c", low), Num("0"), 0.0))


def _arm(known: Known, figures: Figures, acting: Acting, end: End) -> tuple[End, list[Block]]:
    """The arm of a force about the centre of a link with the frame, positive counterclockwise."""
    pair = known.pair(end.link, known.case.ground)
    assert acting.at is not None and end.lever is not None
    about, at, (dx, dy) = place(known, pair), acting.at, acting.direction
    arm = (at[0] - about[0]) * dy - (at[1] - about[1]) * dx
    angle = figures.number(_degrees(acting))
    across, up = (difference(figures, to, start) for to, start in zip(at, about, strict=True))
    written = Sum(((1, product(across, Trig("sin", angle))), (-1, product(up, Trig("cos", angle)))))
    turns = f", positive where it turns link {end.link} counterclockwise:"
    name = load_name(acting.load.name)
    return end._replace(number=figures.length(arm), value=arm), [
        words("The arm of ", name, " about ", centre_name(known, pair), turns),
        formula(end.lever, written, figures.distance(arm)),
    ]


def _part(figures: Figures, ratios: Ratios, acting: Acting, end: End) -> tuple[End, list[Block]]:
    """The part of a force along the motion of a link that slides."""
    assert end.lever is not None
    angle, heading = _degrees(acting), ratios.headings[end.link]
    cosine = math.cos(math.radians(angle - heading))
    between = Sum(((1, figures.number(angle)), (-1, figures.number(heading))))
    return end._replace(number=figures.number(cosine), value=cosine), [
        words("The part of ", load_name(acting.load.name), f" along the motion of link {end.link}:"),
        formula(end.lever, Trig("cos", between), figures.number(cosine)),
    ]


def _degrees(acting: Acting) -> float:
    """Direction of a load of positive value, degrees in [0, 360)."""
    return math.degrees(math.atan2(acting.direction[1], acting.direction[0])) % 360.0
