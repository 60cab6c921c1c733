"""The equation of power for every motion, where several freedoms need several equations."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from icsolve.case import Torque
from icsolve.construction import Acting, Known
from icsolve.construction.motions import OneMotion, independent_motions, speed_words
from icsolve.explain.document import Block, Section, formula, words
from icsolve.explain.formula import Name, Num, Sum, Trig, product
from icsolve.explain.numbers import Figures, load_name
from icsolve.screws.plane import velocity

NOTHING = 1e-12


def motions_section(known: Known, figures: Figures, loads: Sequence[Acting]) -> Section | None:
    """One equation a motion; None where the motions are not known."""
    motions = independent_motions(known)
    if not motions:
        return None
    count = len(motions)
    freedoms = (
        "one freedom: in equilibrium the powers of all loads add up to zero."
        if count == 1
        else (f"{count} freedoms: the powers of all loads add up to zero in each of {count} motions.")
    )
    blocks: list[Block] = [words(f"The mechanism has {freedoms}")]
    units = known.case.units
    if units.torque_per_force_length != 1.0:
        per = f"{1.0 / units.torque_per_force_length:.12g} {units.force}*{units.length}"
        blocks.append(words(f"1 {units.torque} is {per}."))
    rows = []
    for n, motion in enumerate(motions, 1):
        row, said = _motion(known, figures, loads, motion, n if count > 1 else 0)
        rows.append(row)
        blocks += said
    blocks += _found(known, figures)
    if known.answer is not None and all(acting.value is not None for acting in loads):
        blocks.append(words("With these values the sums are"))
        blocks += [_summed(figures, row, found=True) for row in rows if row]
    return Section("Power", tuple(blocks))


Factors = list[tuple[Acting, float]]


def _motion(
    known: Known, figures: Figures, loads: Sequence[Acting], motion: OneMotion, n: int
) -> tuple[Factors, list[Block]]:
    """The factor of every load that does work in a motion, and their equation."""
    others = "" if n == 0 else ", the drivers of the other motions held"
    blocks: list[Block] = [words(f"Motion {n}: " if n else "", f"{speed_words(motion)}{others}.")]
    factors = []
    for acting in loads:
        factor, said = _factor(known, figures, acting, motion, n)
        blocks += said
        factors += [(acting, factor)] if factor else []
    if not factors:
        return [], [*blocks, words("In this motion no load does work.")]
    return factors, [*blocks, words("The sum of power:"), _summed(figures, factors, found=False)]


def _summed(figures: Figures, factors: Factors, *, found: bool) -> Block:
    """The sum of power in a motion; the unknown loads by name or, once ``found``, by their numbers."""
    terms = []
    for acting, factor in factors:
        named = acting.unknown and not found
        first = load_name(acting.load.name) if named else figures.number(acting.value or 0.0)
        terms.append((1, product(first, figures.number(factor))))
    return formula(Sum(tuple(terms)), Num("0"))


def _factor(
    known: Known, figures: Figures, acting: Acting, motion: OneMotion, n: int
) -> tuple[float, list[Block]]:
    """Power per unit of a load: the rate of its link, or the part of its point's velocity along it."""
    name = Name("k", acting.load.name + (f",{n}" if n else ""))
    if isinstance(acting.load, Torque):
        return _turned(figures, acting, motion, name)
    assert acting.at is not None
    (ax, ay), (bx, by) = (velocity(motion.twists[link], acting.at) for link in (acting.link, acting.against))
    v = (ax - bx, ay - by)
    dx, dy = acting.direction
    units = known.case.units.torque_per_force_length
    value = acting.gain * (v[0] * dx + v[1] * dy) * units
    size = abs(acting.gain) * math.hypot(*v) * units
    if abs(value) <= NOTHING * size or size == 0.0:
        return 0.0, []
    angle = figures.number(math.degrees(math.atan2(dy, dx)) % 360.0)
    x, y = (figures.number(c) for c in v)
    along = Sum(((1, product(x, Trig("cos", angle))), (1, product(y, Trig("sin", angle)))))
    extra = [figures.number(f) for f in (acting.gain, units) if f != 1.0]
    whole = product(*extra, along) if extra else along
    said = f" has its point move at ({x.digits}, {y.digits}) {known.case.units.length}/s:"
    return value, [words("", load_name(acting.load.name), said), formula(name, whole, figures.number(value))]


def _turned(figures: Figures, acting: Acting, motion: OneMotion, name: Name) -> tuple[float, list[Block]]:
    on, off = motion.twists[acting.link][2], motion.twists[acting.against][2]
    turn = -1 if acting.gain < 0.0 else 1
    value = turn * (on - off)
    if abs(value) <= NOTHING * (abs(on) + abs(off)):
        return 0.0, []
    rates = Sum(((turn, figures.number(on)), (-turn, figures.number(off))))
    return value, [
        formula(name, rates if off else figures.number(value), *([figures.number(value)] if off else []))
    ]


def _found(known: Known, figures: Figures) -> Iterable[Block]:
    if known.answer is None or not known.answer.answers:
        return
    yield words("So")
    for name, found in known.answer.answers.items():
        yield formula(load_name(name), figures.quantity(found.value, found.unit))
