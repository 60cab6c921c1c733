"""Free bodies: the three equations of every link with their numbers, and the reactions."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from icsolve.answer.bodies import Reaction
from icsolve.explain.document import Block, Inline, Items, Section, ShownTable, formula, words
from icsolve.explain.formula import Expr, Name, Num, Sum, product
from icsolve.explain.given import Figures, load_name
from icsolve.report.derivation import Acting, Known, acting_loads, rope_pulls
from icsolve.screws.plane import Point
from icsolve.tuples import NamedTuple

NOTHING = 1e-13


class On(NamedTuple):
    """A force or couple on a link: its symbol, place (None for a couple alone) and numbers, in force and
    force times length."""

    name: str
    low: str
    at: Point | None
    x: float
    y: float
    couple: float


def bodies_sections(known: Known, figures: Figures) -> Iterable[Section]:
    """The equilibrium of every moving link, then all reactions."""
    answer = known.answer
    if answer is None or not answer.reactions:
        return
    yield _reactions(known, figures, answer.reactions)
    for link in known.case.links:
        if link != known.case.ground:
            yield _link(known, figures, link, list(_acting_on(known, link)))


def _reactions(known: Known, figures: Figures, reactions: dict[str, Reaction]) -> Section:
    units = known.case.units
    rows: list[tuple[tuple[Inline, ...], ...]] = []
    for name, r in reactions.items():
        numbers = tuple((open_number(figures, value),) for value in (r.x, r.y, r.magnitude, r.moment))
        where = f"{r.kind} at {r.where}" if r.where else r.kind
        rows.append(((name,), (where,), *numbers))
    open_ones = sorted({r.why for r in reactions.values() if None in (r.x, r.y, r.moment) and r.why})
    heading = ("force", "joint", f"x, {units.force}", f"y, {units.force}", "size", f"couple, {units.torque}")
    blocks: list[Block] = [
        words("The force of the first link on the second, with the couple about the joint:"),
        ShownTable(heading, tuple(rows)),
    ]
    if open_ones:
        blocks.append(Items(tuple((f"? : {why}",) for why in open_ones)))
    return Section("Reactions", tuple(blocks))


def open_number(figures: Figures, value: float | None) -> Inline:
    """A number, or a question mark for one that equilibrium leaves open."""
    return "?" if value is None else figures.number(value)


def _acting_on(known: Known, link: str) -> Iterable[On | None]:
    """Every reaction and load on a link; None for a reaction that is not determined."""
    answer = known.answer
    assert answer is not None
    for name, r in (answer.reactions or {}).items():
        if link in (r.by, r.on):
            yield _reaction(known, r if r.on == link else r.reversed(), f"@{r.where}," if "@" in name else "")
    for rope in known.case.ropes:
        for pull in rope_pulls(known, rope):
            if pull.link == link:
                yield None if pull.tension is None else On(*pull.symbol, pull.at, *pull.force, 0.0)
    for acting in acting_loads(known):
        if link in (acting.link, acting.against) and not acting.link.startswith("@"):
            yield _load(known, acting, 1.0 if link == acting.link else -1.0)


def _reaction(known: Known, r: Reaction, where: str) -> On | None:
    if r.x is None or r.y is None or r.moment is None:
        return None
    low = r.by + r.on if len(r.by) == len(r.on) == 1 else f"{r.by}-{r.on}"
    return On("F", low + where, r.at, r.x, r.y, r.moment / known.case.units.torque_per_force_length)


def _load(known: Known, acting: Acting, sign: float) -> On:
    name = load_name(acting.load.name)
    if acting.at is None:
        return On(name.base, name.low, None, 0.0, 0.0, sign * acting.couple)
    return On(name.base, name.low, acting.at, sign * acting.force[0], sign * acting.force[1], 0.0)


def _link(known: Known, figures: Figures, link: str, forces: Sequence[On | None]) -> Section:
    """The sums of forces along x and y and of moments about a joint."""
    title = f"Equilibrium of link {link}"
    if any(force is None for force in forces):
        return Section(
            title, (words("Its joints share the load in a way that equilibrium does not determine."),)
        )
    known_forces = [force for force in forces if force is not None]
    about, where = _about(known, link)
    largest = max((math.hypot(f.x, f.y) for f in known_forces), default=0.0)
    blocks: list[Block] = [
        words("Forces along x:"),
        *_sum(figures, [(f, f.x) for f in known_forces], "x", largest),
    ]
    blocks += [words("Forces along y:"), *_sum(figures, [(f, f.y) for f in known_forces], "y", largest)]
    blocks += [words(f"Moments about {where}:"), *_moments(figures, known_forces, about, largest, known.size)]
    return Section(title, tuple(blocks))


def _about(known: Known, link: str) -> tuple[Point, str]:
    """A named point of the link."""
    for name in known.case.carries.get(link, ()):
        if name in known.points and not name.startswith("@"):
            return known.points[name], name
    return (0.0, 0.0), "the origin"


def _sum(figures: Figures, parts: Sequence[tuple[On, float]], axis: str, largest: float) -> Iterable[Block]:
    """Symbols, then numbers, then zero."""
    kept = [(on, value) for on, value in parts if abs(value) > NOTHING * largest]
    if not kept:
        yield words("No force acts that way.")
        return
    symbols: Expr = Sum(tuple((1, Name(on.name, f"{on.low}{axis}" if on.low else axis)) for on, _ in kept))
    numbers: Expr = Sum(tuple((1, figures.number(value)) for _, value in kept))
    yield formula(symbols, numbers, Num("0"))


def _moments(
    figures: Figures, forces: Sequence[On], about: Point, largest: float, size: float
) -> Iterable[Block]:
    """Each force by its components and their arms, each couple by itself."""
    terms: list[tuple[int, Expr]] = []
    least = NOTHING * largest * size
    for force in forces:
        if force.at is not None:
            dx, dy = force.at[0] - about[0], force.at[1] - about[1]
            if abs(dx * force.y) > least:
                terms.append((1, product(figures.length(dx), figures.number(force.y))))
            if abs(dy * force.x) > least:
                sign = 1 if dy < 0.0 else -1
                terms.append((sign, product(figures.length(abs(dy)), figures.number(force.x))))
        if abs(force.couple) > least:
            terms.append((1, figures.number(force.couple)))
    if terms:
        yield formula(Sum(tuple(terms)), Num("0"))
    else:
        yield words("No force has an arm about it.")
