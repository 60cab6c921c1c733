"""The worked solution of a case in space: power, the reactions, the six equations of every link."""

from __future__ import annotations

from collections.abc import Iterable

from icsolve.case import is_named
from icsolve.explain.bodies import On, link_section, reaction_on, reactions_section
from icsolve.explain.document import Block, Inline, Items, Section, ShownTable, formula, words
from icsolve.explain.formula import Name, Num, Sum, product
from icsolve.explain.given import Figures, load_name
from icsolve.report.derivation.known import Known
from icsolve.report.derivation.spatial import InSpace, Push, in_space
from icsolve.screws.plane import subtract
from icsolve.screws.space import ZERO, size, times
from icsolve.statics.space.reaction_basis import SpatialTie
from icsolve.statics.space.reactions import direction_words
from icsolve.wording.sentences import at_words, listed

AXES = "xyz"


def given_in_space(known: Known, figures: Figures) -> Section:
    """Links, joints, points and known loads."""
    scene = in_space(known)
    case = known.case
    others = [link for link in case.links if link != case.ground]
    blocks: list[Block] = [
        words(f"The frame is link {case.ground}; the links that it holds: {listed(others)}.")
    ]
    blocks.append(Items(tuple((_joint(tie),) for tie in scene.ties)))
    unit = case.units.length
    rows: list[tuple[tuple[Inline, ...], ...]] = []
    for name, place in scene.places.items():
        if is_named(name):
            rows.append(((name,), *((figures.length(c).digits,) for c in place)))
    if rows:
        blocks.append(ShownTable(("point", *(f"{axis}, {unit}" for axis in AXES)), tuple(rows)))
    loads = [push for push in scene.loads if not push.unknown]
    if loads:
        blocks.append(words("Loads:"))
        blocks.append(Items(tuple(_load(figures, push) for push in loads)))
    return Section("Given", tuple(blocks))


def asked_in_space(known: Known, figures: Figures) -> Section:
    """The unknown loads, or the reactions."""
    unknown = [push for push in in_space(known).loads if push.unknown]
    if not unknown:
        return Section("Asked", (words("The force and the couple at every joint."),))
    said = words("What load holds the links in equilibrium in this position?")
    return Section("Asked", (said, Items(tuple(_load(figures, push) for push in unknown))))


def _joint(tie: SpatialTie) -> str:
    kind = {
        "ball": "ball joint",
        "radial": "radial bearing",
        "thrust": "thrust bearing",
        "gears": "mesh of gears",
    }
    axis = f" along {direction_words(tie.axis)}" if size(tie.axis) > 0.5 else ""
    where = at_words(tie.where)
    return f"a {kind.get(tie.joint_kind, tie.joint_kind)} of links {tie.by} and {tie.on}{where}{axis}"


def _load(figures: Figures, push: Push) -> tuple[Inline, ...]:
    value = (
        "" if push.unknown or push.value is None else f" of {figures.number(push.value).digits} {push.unit}"
    )
    kind = "couple" if push.at is None else "load"
    return (
        load_name(push.name),
        f": a {kind}{value} on link {push.link}{at_words(push.where)}, {push.way}",
    )


def sections_in_space(known: Known, figures: Figures) -> Iterable[Section]:
    """Power, the reactions, and the equilibrium of every link."""
    answer = known.answer
    if answer is None or answer.spatial is None:
        return
    if answer.terms:
        yield _power(known, figures)
    yield _reactions(known, figures)
    scene = in_space(known)
    for link in known.case.links:
        if link != known.case.ground:
            yield _link(known, figures, scene, link)


def _power(known: Known, figures: Figures) -> Section:
    """One term a load, for the motion in which the unknown moves at 1."""
    assert known.answer is not None
    terms = [term for term in known.answer.terms if term.power or term.unknown]
    numbers = Sum(tuple((1, product(figures.number(t.value), figures.number(t.factor))) for t in terms))
    symbols = Sum(tuple((1, product(load_name(t.load), Name("k", t.load))) for t in terms))
    said = "Where the unknown load moves at 1, every load moves along itself at k; the powers add up to zero:"
    return Section("Power", (words(said), formula(symbols, numbers, Num("0"))))


def _reactions(known: Known, figures: Figures) -> Section:
    assert known.answer is not None and known.answer.spatial is not None
    units = known.case.units
    forces = tuple(f"F{axis}, {units.force}" for axis in AXES)
    couples = tuple(f"M{axis}, {units.torque}" for axis in AXES)
    rows = [(name, r, (*r.force, *r.couple)) for name, r in known.answer.spatial.reactions.items()]
    return reactions_section(figures, (*forces, *couples), rows)


def _link(known: Known, figures: Figures, scene: InSpace, link: str) -> Section:
    forces = list(_acting(known, scene, link))
    about = next(iter(scene.carried(link)), ZERO)
    where = next((name for name, place in scene.places.items() if place == about), "the origin")
    reach = max((size(subtract(p, about)) for p in scene.places.values()), default=0.0)
    return link_section(figures, link, forces, (about, where), reach, AXES)


def _acting(known: Known, scene: InSpace, link: str) -> Iterable[On | None]:
    """All reactions and loads on a link; None for a reaction that is open."""
    assert known.answer is not None and known.answer.spatial is not None
    for title, reaction in known.answer.spatial.reactions.items():
        if link in (reaction.by, reaction.on):
            r = reaction if reaction.on == link else reaction.reversed()
            yield reaction_on(known, title, r, r.force, r.couple)
    for push in scene.loads:
        if link in (push.link, push.against):
            sign, name = 1.0 if link == push.link else -1.0, load_name(push.name)
            yield On(name.base, name.low, push.at, times(sign, push.force), times(sign, push.couple))
