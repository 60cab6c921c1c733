"""The equation of power: in symbols, then a load at a time in this case's numbers, then solved."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from icsolve.case import ForceVector
from icsolve.construction import Acting, Known, Ratios
from icsolve.explain.document import Block, Section, formula, words
from icsolve.explain.formula import Expr, Name, Num, Quotient, Sum, product
from icsolve.explain.levers import Term, conversion, term_of
from icsolve.explain.numbers import Figures, load_name
from icsolve.explain.speeds import motion_name

AGREE = 1e-8
"""The terms of the equation add up to zero, but for this fraction of the largest."""
SLIDING = (
    "In equilibrium the powers of all loads add up to zero, with those of the friction L at each joint "
    "(found with the reactions, below), which acts against the given motion:"
)


class Rubbed(NamedTuple):
    """Friction at a joint as a load of the sum of power: its number, its rate or speed of rubbing while the
    reference moves at 1, and their product in the unit of the equation."""

    name: Name
    words: str
    value: float
    unit: str
    rate: float
    power: float


def rubbed(known: Known, ratios: Ratios) -> list[Rubbed]:
    """The friction at all joints that rub."""
    answer, units = known.answer, known.case.units
    if answer is None:
        return []
    x, y, w = known.twists[ratios.reference]
    turns = known.turns(ratios.reference)
    speed = w if turns else math.hypot(x, y)
    found = []
    for term in answer.terms:
        if " " not in term.load:
            continue
        torque = term.unit == units.torque
        rate = term.factor * (units.torque_per_force_length if torque else 1.0) / speed
        power = term.value * term.factor / speed * (units.torque_per_force_length if turns else 1.0)
        name = Name("L", term.load.split()[1].removeprefix("F"))
        found.append(Rubbed(name, term.words, term.value, term.unit, rate, power))
    return found


def power_section(known: Known, figures: Figures, ratios: Ratios, loads: Sequence[Acting]) -> Section | None:
    """The sum of power and the unknown load that makes it zero; None where the centres are not sharp enough
    to give it."""
    blocks: list[Block] = []
    terms: list[Term] = []
    for acting in loads:
        term, said = term_of(known, figures, ratios, acting)
        blocks += said
        terms += [] if term is None else [term]
    friction = rubbed(known, ratios)
    if not _agrees(known, terms, friction):
        return None
    blocks.append(
        words("In equilibrium the powers of all loads add up to zero:" if not friction else SLIDING)
    )
    symbols: list[tuple[int, Expr]] = [(term.sign, term.symbols(known)) for term in terms]
    symbols += [(1, product(r.name, motion_name(known, ratios.reference))) for r in friction]
    blocks.append(formula(Sum(tuple(symbols)), Num("0")))
    blocks += _numbers(known, figures, ratios, terms, friction)
    return Section("Power", tuple(blocks))


def _agrees(known: Known, terms: Sequence[Term], friction: Sequence[Rubbed]) -> bool:
    """Whether the terms give the answer (centres that contradict each other a little do not)."""
    roots = [term for term in terms if term.acting.unknown and _is_root(term.acting)]
    if len(roots) != 1 or roots[0].acting.value is None:
        return True
    powers = [t.sign * (t.acting.value or 0.0) * t.factor for t in terms] + [r.power for r in friction]
    return abs(sum(powers)) <= AGREE * max(map(abs, powers))


def _numbers(
    known: Known, figures: Figures, ratios: Ratios, terms: Sequence[Term], friction: Sequence[Rubbed]
) -> Iterable[Block]:
    """A load at a time over the reference's speed, then the unknown from their sum."""
    units, reference = known.case.units, ratios.reference
    unit = units.torque if known.turns(reference) else units.force
    if any(conversion(known, ratios, term.acting) != 1.0 for term in terms):
        per = f"{1.0 / units.torque_per_force_length:.12g} {units.force}*{units.length}"
        yield words(f"1 {units.torque} is {per}.")
    yield words("Over ", motion_name(known, reference), f", a load at a time, in {unit}:")
    for term in terms:
        yield from _term(known, figures, reference, term, unit)
    for r in friction:
        yield words(f"{r.words[:1].upper()}{r.words[1:]}, {figures.number(r.value).digits} {r.unit}:")
        ratio = r.power / (r.value * r.rate) if r.value * r.rate else 1.0
        numbers = product(figures.number(r.value), figures.number(r.rate), figures.number(ratio))
        yield formula(r.name, numbers, figures.quantity(r.power, unit))
    yield from _solved(known, figures, terms, friction)


def _term(known: Known, figures: Figures, reference: str, term: Term, unit: str) -> Iterable[Block]:
    """The power of a known load; of the unknown one what it is multiplied by."""
    symbols = term.symbols(known, over=reference)
    name = load_name(term.acting.load.name)
    if not term.acting.unknown:
        assert term.acting.value is not None
        power = figures.quantity(term.acting.value * term.factor, unit)
        written = product(figures.number(term.acting.value), term.numbers)
        yield formula(symbols, power) if written == power.number else formula(symbols, written, power)
    elif term.numbers != Num("1"):
        yield formula(symbols, product(name, term.numbers), product(name, figures.number(term.factor)))


def _solved(
    known: Known, figures: Figures, terms: Sequence[Term], friction: Sequence[Rubbed]
) -> Iterable[Block]:
    """The unknown load: the powers of the others with the other sign, over its factor."""
    unknown = [term for term in terms if term.acting.unknown]
    roots = [term for term in unknown if _is_root(term.acting)]
    if known.answer is None or len(roots) != 1:
        return
    root = roots[0].acting
    found = known.answer.answers[root.load.name]
    powers = [(t.sign, (t.acting.value or 0.0) * t.factor) for t in terms if not t.acting.unknown]
    powers += [(1, r.power) for r in friction]
    over = Sum(tuple((-sign, figures.number(power)) for sign, power in powers)) if powers else Num("0")
    parts = tuple(
        (t.sign, product(figures.number(_times(t.acting, root)), figures.number(t.factor))) for t in unknown
    )
    under: Expr = parts[0][1] if len(parts) == 1 and parts[0][0] > 0 else Sum(parts)
    value = figures.quantity(found.value, found.unit)
    yield words("So")
    name = load_name(root.load.name)
    if under != Num("1"):
        yield formula(name, Quotient(over, under), value)
    elif len(powers) == 1 and powers[0][0] * powers[0][1] > 0.0:
        yield formula(name, value)
    else:
        yield formula(name, over, value)


def _is_root(acting: Acting) -> bool:
    """Whether a load's own number is asked for (another may be like it)."""
    return not isinstance(acting.load, ForceVector) and acting.load.value is None


def _times(acting: Acting, root: Acting) -> float:
    """How many times as large as the unknown one a load is."""
    return (acting.value or 0.0) / root.value if root.value else 1.0
