"""Positions of equilibrium by virtual work: the generalised load of each unknown datum, the condition that it
vanishes, its numbers in each position, and what its derivative says of a small push."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from icsolve.answer.equilibrium import EquilibriumPosition
from icsolve.case import Spring, TorsionSpring, is_angle
from icsolve.explain.document import Block, Section, formula, words
from icsolve.explain.formula import Expr, Name, Num, Quotient, Sum, product, total
from icsolve.explain.power import AGREE, factor_of, gain_of, sprung, torque_words
from icsolve.explain.worked import Worked, exerted_name, load_name
from icsolve.report import place_text
from icsolve.report.derivation.known import Acting, Known, acting_loads, known_at
from icsolve.report.derivation.ratios import OneMotion, independent_motions, speed_words
from icsolve.screws import Triple, velocity
from icsolve.solve.driven_search import rate_of
from icsolve.sweep.varied_numbers import points_of
from icsolve.tuples import replace
from icsolve.wording import NOTHING

WORK = (
    "Let the unknown q grow by dq, in radians for an angle, while the mechanism moves as its joints allow. "
    "Each load does the work of its force times how far its point goes along it, or of its moment times how "
    "far its link turns: k for each unit of q, with the factor that makes a force of a mass, a pressure or a "
    "load along a line. Forces in the joints do none. The virtual work, dU = Q dq, has the generalised load"
)
CONDITION = (
    "a function of q as every k is. The loads balance where Q is zero. Where Q falls as q grows, the loads "
    "drive a small push back: the position is stable; where it rises, unstable."
)
SIGNS = {"stable": "less than zero", "unstable": "greater than zero", "neutral": "zero to within its error"}
"""Of the derivative of Q in a position."""
LEAST = 1e-7
"""An unknown that moves less than this fraction of the figure stands at a limit."""


def equilibrium_section(work: Worked) -> Iterable[Section]:
    """The virtual work of the loads in each position, where one is told so."""
    said = [block for one in work.answer.positions or () for block in _position(work, one)]
    if not said:
        return
    ways = [(acting, Name("k", "".join(load_name(acting.load.name)))) for acting in acting_loads(work.known)]
    terms = tuple((1, product(exerted_name(acting.load), way)) for acting, way in ways)
    blocks = (words(WORK), formula(Name("Q"), Sum(terms)), words(CONDITION))
    yield Section("Virtual work", (*blocks, *said))


def _position(work: Worked, position: EquilibriumPosition) -> list[Block]:
    """One position: the equation of each unknown, then the derivative; nothing where friction holds it."""
    if position.stability is None or position.answer.scene is None:
        return []
    here = work._replace(known=known_at(work.known, position.answer))
    place = f"In the position {place_text(here.case, position, work.digits)}"
    for path in position.at:
        loose = [name for name in points_of(path) if name not in here.known.points]
        if loose:
            return [words(f"{place} no motion is told by {path}: no link carries {loose[0]}.")]
    motions = _by_unknowns(here.known, list(position.at))
    if not motions:  # a change point, which has more of them
        return []
    blocks: list[Block] = [words(f"{place}:")]
    blocks += torque_words(here.units)
    loads = []
    acting_here = acting_loads(here.known)
    largest = max((abs(acting.value or 0.0) for acting in acting_here), default=0.0)
    least = largest * NOTHING * here.known.size
    for acting in acting_here:
        exerted, said = _force(here, acting)
        loads.append(exerted)
        blocks += said
    for n, ((told, motion), path) in enumerate(zip(motions, position.at, strict=True), 1):
        per = here.units.torque_per_force_length if is_angle(path) else 1.0
        low = str(n) if len(motions) > 1 else ""
        blocks.append(words(f"While {told}:"))
        terms: list[tuple[int, Expr]] = []
        works = []
        for acting in loads:
            k, said = factor_of(here, acting, motion, int(low or 0), per)
            blocks += said
            works.append((acting.value or 0.0) * k)
            if k:
                terms.append((1, product(work.number(acting.value or 0.0), work.number(k))))
        if abs(sum(works)) > AGREE * max(map(abs, works), default=0.0) + least:
            return []  # a rope or a screw takes a part, which its own equations tell
        if not terms:
            blocks.append(words("No load does work."))
        blocks.append(formula(Name("Q", low), total(terms), Num("0")))
    return [*blocks, *_derivative(work, position)]


def _force(work: Worked, acting: Acting) -> tuple[Acting, list[Block]]:
    """A load by what it exerts: a spring by its force or moment in the position."""
    if not isinstance(acting.load, Spring | TorsionSpring):
        return acting, []
    value, stretched = gain_of(work, acting)
    _, force, said = sprung(work, acting, value)
    turns = force.at is None
    gain = 1.0 / work.units.torque_per_force_length if turns else 1.0
    return force._replace(gain=gain), [*stretched, *said]


def _derivative(work: Worked, position: EquilibriumPosition) -> Iterable[Block]:
    """The sign of the derivative, and what it says."""
    stiffness, told = position.stiffness, position.stability
    if stiffness is None:
        yield words(
            f"Here there is no derivative: {position.why} By the change of Q along the motion it is {told}."
        )
        return
    single = isinstance(stiffness.value, float)
    rows = [[stiffness.value]] if single else stiffness.value
    largest = 0.0 if single else max(abs(value) for row in rows for value in row)
    units = [[stiffness.unit]] if single else stiffness.unit
    for i, row in enumerate(rows, 1):
        for j, value in enumerate(row, 1):
            above, below = (Name(s, "" if single else str(n)) for s, n in (("dQ", i), ("dq", j)))
            shown = -value if abs(value) > NOTHING * largest else 0.0
            yield formula(Quotient(above, below), work.quantity(shown, units[i - 1][j - 1]))
    if single:
        yield words(f"It is {SIGNS[told or '']}: {told}.")
    else:
        yield words(f"By the eigenvalues of the symmetric part of these the position is {told}.")


# --- the motion by an unknown ------------------------------------------------------------------------


def _by_unknowns(known: Known, paths: Sequence[str]) -> list[tuple[str, OneMotion]]:
    """The motion in which each unknown grows at 1 and the others stand still, in words and by its twists; at
    a limit of an unknown, that which the mechanism has."""
    motions = independent_motions(known)
    if len(motions) != len(paths):
        return []
    rates = [[_rate(known, path, motion) for motion in motions] for path in paths]
    if not abs(np.linalg.det(rates)) > LEAST:
        return [(speed_words(motion), motion) for motion in motions]
    found = []
    for path, weights in zip(paths, np.linalg.inv(rates).T.tolist(), strict=True):
        told = f"{path} grows at 1 {'rad' if is_angle(path) else known.case.units.length}/s"
        still = "".join(f" and {other} stands still" for other in paths if other != path)
        found.append((told + still, _mixed(motions, weights)))
    return found


def _mixed(motions: Sequence[OneMotion], weights: Sequence[float]) -> OneMotion:
    """The sum of motions, each so many times."""

    def twist(link: str) -> Triple:
        parts = [(w, m.twists[link]) for w, m in zip(weights, motions, strict=True)]
        x, y, turn = (sum(w * t[k] for w, t in parts) for k in range(3))
        return (x, y, turn)

    return motions[0]._replace(twists={link: twist(link) for link in motions[0].twists})


def _rate(known: Known, path: str, motion: OneMotion) -> float:
    """How fast a datum grows in a motion [rad/s for an angle, length/s]."""
    carried = ((point, link) for link, names in known.case.carries.items() for point in names)
    moving = {
        (point, link): velocity(motion.twists[link], known.points[point])
        for point, link in carried
        if point in known.points
    }
    assert known.answer is not None
    return rate_of(replace(known.answer, points=dict(known.points), rates={}, velocities=moving), path)
