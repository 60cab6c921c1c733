"""The worked solution of a case in space: power, the reactions, the six equations of every link."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from icsolve.explain.bodies import NOTHING, open_number
from icsolve.explain.document import Block, Inline, Items, Section, ShownTable, formula, words
from icsolve.explain.formula import Expr, Name, Num, Sum, product
from icsolve.explain.given import Figures, load_name
from icsolve.report.derivation import Known
from icsolve.report.derivation.spatial import InSpace, Push, in_space
from icsolve.screws.plane import subtract
from icsolve.screws.space import Vec, size
from icsolve.statics.space.reaction_basis import SpatialTie
from icsolve.statics.space.reactions import direction_words
from icsolve.tuples import NamedTuple
from icsolve.wording.sentences import listed

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
        if not name.startswith("@"):
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
    where = f" at {tie.where}" if tie.where and not tie.where.startswith("@") else ""
    return f"a {kind.get(tie.joint_kind, tie.joint_kind)} of links {tie.by} and {tie.on}{where}{axis}"


def _load(figures: Figures, push: Push) -> tuple[Inline, ...]:
    value = (
        "" if push.unknown or push.value is None else f" of {figures.number(push.value).digits} {push.unit}"
    )
    kind = "couple" if push.at is None else "load"
    where = f" at {push.where}" if push.where and not push.where.startswith("@") else ""
    return (
        load_name(push.name),
        f": a {kind}{value} on link {push.link}{where}, along {direction_words(push.direction)}",
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
    rows: list[tuple[tuple[Inline, ...], ...]] = []
    for name, r in known.answer.spatial.reactions.items():
        numbers = tuple((open_number(figures, value),) for value in (*r.force, *r.couple))
        rows.append(((name,), (f"{r.kind} at {r.where}" if r.where else r.kind,), *numbers))
    forces = tuple(f"F{axis}, {units.force}" for axis in AXES)
    couples = tuple(f"M{axis}, {units.torque}" for axis in AXES)
    said = words("The force of the first link on the second, with the couple about the joint:")
    return Section("Reactions", (said, ShownTable(("force", "joint", *forces, *couples), tuple(rows))))


class SpatialOn(NamedTuple):
    """A force and a couple on a link, in force and force times length."""

    name: str
    low: str
    at: Vec | None
    force: Vec
    couple: Vec


def _link(known: Known, figures: Figures, scene: InSpace, link: str) -> Section:
    title = f"Equilibrium of link {link}"
    forces = list(_acting(known, scene, link))
    if any(force is None for force in forces):
        return Section(
            title, (words("Its joints share the load in a way that equilibrium does not determine."),)
        )
    found = [force for force in forces if force is not None]
    about = next(iter(scene.carried(link)), (0.0, 0.0, 0.0))
    where = next((name for name, place in scene.places.items() if place == about), "the origin")
    largest = max((size(on.force) for on in found), default=0.0)
    reach = max((size(subtract(p, about)) for p in scene.places.values()), default=0.0)
    blocks: list[Block] = []
    for k, axis in enumerate(AXES):
        blocks += [words(f"Forces along {axis}:"), _forces(figures, found, k, largest)]
    for k, axis in enumerate(AXES):
        blocks += [
            words(f"Moments about {where} along {axis}:"),
            _moments(figures, found, about, k, largest * reach),
        ]
    return Section(title, tuple(blocks))


def _acting(known: Known, scene: InSpace, link: str) -> Iterable[SpatialOn | None]:
    """All reactions and loads on a link; None for a reaction that is open."""
    assert known.answer is not None and known.answer.spatial is not None
    per = known.case.units.torque_per_force_length
    for title, reaction in known.answer.spatial.reactions.items():
        if link not in (reaction.by, reaction.on):
            continue
        r = reaction if reaction.on == link else reaction.reversed()
        numbers = [value for value in (*r.force, *r.couple) if value is not None]
        if len(numbers) < 6:
            yield None
            continue
        low = r.by + r.on if len(r.by) == len(r.on) == 1 else f"{r.by}-{r.on}"
        x, y, z, mx, my, mz = numbers
        low = f"{low}@{r.where}," if "@" in title else low
        yield SpatialOn("F", low, r.at, (x, y, z), (mx / per, my / per, mz / per))
    for push in scene.loads:
        if link in (push.link, push.against):
            sign = 1.0 if link == push.link else -1.0
            name = load_name(push.name)
            force, couple = (_scaled(sign, v) for v in (push.force, push.couple))
            yield SpatialOn(name.base, name.low, push.at, force, couple)


def _scaled(s: float, v: Vec) -> Vec:
    return (s * v[0], s * v[1], s * v[2])


def _forces(figures: Figures, forces: Sequence[SpatialOn], k: int, largest: float) -> Block:
    kept = [on for on in forces if abs(on.force[k]) > NOTHING * largest]
    if not kept:
        return words("No force acts that way.")
    symbols = Sum(tuple((1, Name(on.name, on.low + AXES[k])) for on in kept))
    return formula(symbols, Sum(tuple((1, figures.number(on.force[k])) for on in kept)), Num("0"))


def _moments(figures: Figures, forces: Sequence[SpatialOn], about: Vec, k: int, largest: float) -> Block:
    """Arms times components, and couples: M_x = y F_z - z F_y and so on round."""
    i, j = (k + 1) % 3, (k + 2) % 3
    terms: list[tuple[int, Expr]] = []
    for on in forces:
        arm = subtract(on.at, about) if on.at is not None else (0.0, 0.0, 0.0)
        for sign, a, b in ((1, i, j), (-1, j, i)):
            if abs(arm[a] * on.force[b]) > NOTHING * largest:
                terms.append((sign, product(figures.length(arm[a]), figures.number(on.force[b]))))
        if abs(on.couple[k]) > NOTHING * largest:
            terms.append((1, figures.number(on.couple[k])))
    return formula(Sum(tuple(terms)), Num("0")) if terms else words("No force has an arm about it.")
