"""Free bodies: the equations of every link with their numbers, three in the plane and six in space, and the
reactions."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from icsolve.answer.bodies import Reaction
from icsolve.answer.space import Parts, SpatialReaction
from icsolve.case import is_link, is_named
from icsolve.explain.document import Block, Inline, Items, Section, ShownTable, formula, words
from icsolve.explain.formula import Expr, Name, Num, Sum, product
from icsolve.explain.given import Figures, load_name
from icsolve.report.derivation.known import Known, acting_loads
from icsolve.report.derivation.ropes import rope_pulls
from icsolve.screws.plane import subtract
from icsolve.screws.space import ZERO, Vec, size, times
from icsolve.tuples import NamedTuple

NOTHING = 1e-13


class On(NamedTuple):
    """A force and a couple on a link: symbol, place (None for a couple alone) and components, in force and in
    force times length; in the plane a force along x and y, a couple about z."""

    name: str
    low: str
    at: Vec | None
    force: Vec
    couple: Vec


def bodies_sections(known: Known, figures: Figures) -> Iterable[Section]:
    """The equilibrium of every moving link, then all reactions."""
    answer = known.answer
    if answer is None or not answer.reactions:
        return
    units, reactions = known.case.units, answer.reactions
    heading = (f"x, {units.force}", f"y, {units.force}", "size", f"couple, {units.torque}")
    rows = [(name, r, (r.x, r.y, r.magnitude, r.moment)) for name, r in reactions.items()]
    told = reactions_section(figures, heading, rows)
    open_ones = sorted({r.why for r in reactions.values() if None in (r.x, r.y, r.moment) and r.why})
    more = (Items(tuple((f"? : {why}",) for why in open_ones)),) if open_ones else ()
    yield told._replace(blocks=(*told.blocks, *more))
    for link in known.case.links:
        if link != known.case.ground:
            forces = list(_acting_on(known, link))
            yield link_section(figures, link, forces, _about(known, link), known.size, "xy")


def reactions_section(
    figures: Figures,
    heading: tuple[str, ...],
    rows: Iterable[tuple[str, Reaction | SpatialReaction, Sequence[float | None]]],
) -> Section:
    """A table of the reactions: name, joint, and numbers under a heading, question marks for those that
    equilibrium leaves open."""
    table: list[tuple[tuple[Inline, ...], ...]] = [
        (
            (name,),
            (f"{r.kind} at {r.where}" if r.where else r.kind,),
            *(("?" if value is None else figures.number(value),) for value in numbers),
        )
        for name, r, numbers in rows
    ]
    said = words("The force of the first link on the second, with the couple about the joint:")
    return Section("Reactions", (said, ShownTable(("force", "joint", *heading), tuple(table))))


def _acting_on(known: Known, link: str) -> Iterable[On | None]:
    """Every reaction and load on a link; None for a reaction that is not determined."""
    answer = known.answer
    assert answer is not None
    for name, reaction in (answer.reactions or {}).items():
        if link in (reaction.by, reaction.on):
            r = reaction if reaction.on == link else reaction.reversed()
            yield reaction_on(known, name, r, (r.x, r.y, 0.0), (0.0, 0.0, r.moment))
    for rope in known.case.ropes:
        for pull in rope_pulls(known, rope):
            if pull.link == link:
                at, force = (*pull.at, 0.0), (*pull.force, 0.0)
                yield None if pull.tension is None else On(*pull.symbol, at, force, ZERO)
    for acting in acting_loads(known):
        if link in (acting.link, acting.against) and is_link(acting.link):
            sign, own = 1.0 if link == acting.link else -1.0, load_name(acting.load.name)
            place = None if acting.at is None else (*acting.at, 0.0)
            force, couple = (*acting.force, 0.0), (0.0, 0.0, acting.couple)
            yield On(own.base, own.low, place, times(sign, force), times(sign, couple))


def reaction_on(
    known: Known, name: str, r: Reaction | SpatialReaction, force: Parts, couple: Parts
) -> On | None:
    """A reaction on its second link; None of one that is not determined."""
    x, y, z, mx, my, mz = (*force, *couple)
    if x is None or y is None or z is None or mx is None or my is None or mz is None:
        return None
    low = r.by + r.on if len(r.by) == len(r.on) == 1 else f"{r.by}-{r.on}"
    low, per = f"{low}@{r.where}," if "@" in name else low, known.case.units.torque_per_force_length
    x0, y0, *z0 = r.at
    return On("F", low, (x0, y0, z0[0] if z0 else 0.0), (x, y, z), (mx / per, my / per, mz / per))


def link_section(
    figures: Figures, link: str, forces: Sequence[On | None], about: tuple[Vec, str], reach: float, axes: str
) -> Section:
    """The sums of the forces along the axes, and of the moments about a point and its name; in the plane
    (``axes`` xy) of those about z. ``reach`` is the size of an arm [case length]."""
    title = f"Equilibrium of link {link}"
    found = [force for force in forces if force is not None]
    if len(found) < len(forces):
        said = "Its joints share the load in a way that equilibrium does not determine."
        return Section(title, (words(said),))
    largest = max((size(on.force) for on in found), default=0.0)
    place, where = about
    blocks: list[Block] = []
    for k, axis in enumerate(axes):
        blocks += [words(f"Forces along {axis}:"), _forces(figures, found, k, axis, largest)]
    for k, along in [(2, "")] if len(axes) == 2 else [(k, f" along {axis}") for k, axis in enumerate(axes)]:
        moments = _moments(figures, found, place, k, NOTHING * largest * reach)
        blocks += [words(f"Moments about {where}{along}:"), moments]
    return Section(title, tuple(blocks))


def _about(known: Known, link: str) -> tuple[Vec, str]:
    """A named point of the link."""
    for name in known.case.carries.get(link, ()):
        if name in known.points and is_named(name):
            return (*known.points[name], 0.0), name
    return ZERO, "the origin"


def _forces(figures: Figures, forces: Sequence[On], k: int, axis: str, largest: float) -> Block:
    """Symbols, then numbers, then zero."""
    kept = [on for on in forces if abs(on.force[k]) > NOTHING * largest]
    if not kept:
        return words("No force acts that way.")
    symbols = Sum(tuple((1, Name(on.name, on.low + axis)) for on in kept))
    return formula(symbols, Sum(tuple((1, figures.number(on.force[k])) for on in kept)), Num("0"))


def _moments(figures: Figures, forces: Sequence[On], about: Vec, k: int, least: float) -> Block:
    """Arms times components, and couples: M_x = y F_z - z F_y and so on round."""
    i, j = (k + 1) % 3, (k + 2) % 3
    terms: list[tuple[int, Expr]] = []
    for on in forces:
        arm = subtract(on.at, about) if on.at is not None else ZERO
        if abs(arm[i] * on.force[j]) > least:
            terms.append((1, product(figures.length(arm[i]), figures.number(on.force[j]))))
        if abs(arm[j] * on.force[i]) > least:
            sign = 1 if arm[j] < 0.0 else -1
            terms.append((sign, product(figures.length(abs(arm[j])), figures.number(on.force[i]))))
        if abs(on.couple[k]) > least:
            terms.append((1, figures.number(on.couple[k])))
    return formula(Sum(tuple(terms)), Num("0")) if terms else words("No force has an arm about it.")
