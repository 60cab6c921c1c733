"""Free bodies: the equations of every link with their numbers, three in the plane and six in space, and the
reactions; friction, as the rule at each joint that rubs and as loads in the sum of power."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Sequence

from icsolve.answer.bodies import Reaction, Rubbing, SpatialReaction
from icsolve.case import Joint, is_link, is_named, told_links
from icsolve.case.joints import Friction
from icsolve.explain.document import Block, Inline, Items, Section, ShownTable, formula, words
from icsolve.explain.formula import Expr, Name, Num, Of, Sum, product
from icsolve.explain.worked import Worked, load_name
from icsolve.report import axial_words
from icsolve.report.derivation.known import Known, acting_loads, bars_of, rope_pulls
from icsolve.report.derivation.spatial import InSpace, in_space
from icsolve.screws import subtract
from icsolve.screws.space import ZERO, Vec, size, spatial, times
from icsolve.tuples import NamedTuple
from icsolve.wording import at_words, listed

NOTHING = 1e-13
ROUNDED = 2.0**-49
"""What rounding makes of a coordinate, of its size: a few units of the last digit."""


class On(NamedTuple):
    """A force and a couple on a link: symbol, place (None for a couple alone) and components, in force and in
    force times length; in the plane a force along x and y, a couple about z. ``rounding`` is what rounding
    can make of each component; None where that is not known."""

    name: str
    low: str
    at: Vec | None
    force: Vec
    couple: Vec
    rounding: tuple[Vec, Vec] | None = None

    def plain(self, largest: float, reach: float) -> On:
        """Without the components that rounding may have made; where that is not known, those that are
        nothing beside the ``largest`` force and its moment."""
        both = (self.force, self.couple)
        least = self.rounding or ((NOTHING * largest,) * 3, (NOTHING * largest * reach,) * 3)
        (a, b, c), (d, e, f) = (
            (v if abs(v) > room else 0.0 for v, room in zip(*pair, strict=True))
            for pair in zip(both, least, strict=True)
        )
        return self._replace(force=(a, b, c), couple=(d, e, f))


def bodies_sections(work: Worked) -> Iterable[Section]:
    """The equilibrium of every moving link, then all reactions."""
    units, reactions = work.units, work.answer.reactions
    if not reactions:
        return
    heading = (f"x, {units.force}", f"y, {units.force}", "size", f"couple, {units.torque}")
    rows = [(name, r, (r.x, r.y, r.magnitude, r.moment)) for name, r in reactions.items()]
    told = reactions_section(work, heading, rows)
    open_ones = sorted({r.why for r in reactions.values() if None in (r.x, r.y, r.moment) and r.why})
    more = (Items(tuple((f"? : {why}",) for why in open_ones)),) if open_ones else ()
    yield told._replace(blocks=(*told.blocks, *more, *_bars(work)))
    for link in told_links(work.case):
        if link != work.case.ground:
            forces = list(_acting_on(work.known, link))
            yield link_section(work, link, forces, _about(work.known, link), work.known.size, "xy")


def _bars(work: Worked) -> Iterable[Block]:
    """What pulls or pushes the bars that two forces load."""
    found = bars_of(work.answer)
    if found:
        yield words("Two forces alone hold these bars, so they act along them:")
        unit = work.units.force
        entries = ((work.number(abs(force)), f" {unit}, {axial_words(force)}") for force in found.values())
        yield Items(tuple((f"link {q}: ", *entry) for q, entry in zip(found, entries, strict=True)))


def reactions_section(
    work: Worked,
    heading: Sequence[str],
    rows: Iterable[tuple[str, Reaction | SpatialReaction, Sequence[float | None]]],
) -> Section:
    """A table of the reactions: name, joint, and numbers under a heading, question marks for those that
    equilibrium leaves open."""
    table: list[tuple[tuple[Inline, ...], ...]] = [
        (
            (name,),
            (f"{r.kind} at {r.where}" if r.where else r.kind,),
            *(("?" if value is None else work.number(value),) for value in numbers),
        )
        for name, r, numbers in rows
    ]
    said = words("The force of the first link on the second, with the couple about the joint:")
    return Section("Reactions", (said, ShownTable(("force", "joint", *heading), tuple(table))))


def _acting_on(known: Known, link: str) -> Iterable[On | None]:
    """Every reaction and load on a link; None for a reaction that is not determined."""
    assert known.answer is not None and known.answer.reactions is not None
    for name, reaction in known.answer.reactions.of_link(link):
        yield _reaction(known, name, reaction)
    for rope in known.case.ropes:
        for pull in rope_pulls(known, rope):
            if pull.link == link:
                at, force = (*pull.at, 0.0), (*pull.force, 0.0)
                yield None if pull.tension is None else load_on(*pull.symbol, at, force, ZERO)
    for acting in acting_loads(known):
        if link in (acting.link, acting.against) and is_link(acting.link):
            sign, own = 1.0 if link == acting.link else -1.0, load_name(acting.load.name)
            place = None if acting.at is None else (*acting.at, 0.0)
            force, couple = (*acting.force, 0.0), (0.0, 0.0, acting.couple)
            yield load_on(own.base, own.low, place, times(sign, force), times(sign, couple))


def load_on(name: str, low: str, at: Vec | None, force: Vec, couple: Vec) -> On:
    """A load, whose components are as good as its direction."""
    return On(name, low, at, force, couple, ((NOTHING * size(force),) * 3, ZERO))


def _reaction(known: Known, name: str, r: Reaction | SpatialReaction) -> On | None:
    """A reaction on its second link; None of one that is not determined."""
    (x, y, z), (mx, my, mz) = r.components
    if x is None or y is None or z is None or mx is None or my is None or mz is None:
        return None
    low = r.by + r.on if len(r.by) == len(r.on) == 1 else f"{r.by}-{r.on}"
    low += "@" + name.partition("@")[2] if "@" in name else ""
    low, per = low if len(low) == 2 else f"{low},", known.case.units.torque_per_force_length
    rounding = None
    if r.bounds is not None:
        force, (ex, ey, ez) = ((a or 0.0, b or 0.0, c or 0.0) for a, b, c in r.bounds)
        rounding = (force, (ex / per, ey / per, ez / per))
    return On("F", low, spatial(r.at), (x, y, z), (mx / per, my / per, mz / per), rounding)


def link_section(
    work: Worked, link: str, forces: Sequence[On | None], about: tuple[Vec, str], reach: float, axes: str
) -> Section:
    """The sums of the forces along the axes, and of the moments about a point and its name; in the plane
    (``axes`` xy) of those about z. ``reach`` is the size of an arm [case length]."""
    title = f"Equilibrium of link {link}"
    found = [force for force in forces if force is not None]
    if len(found) < len(forces):
        said = "Its joints share the load in a way that equilibrium does not determine."
        return Section(title, (words(said),))
    largest = max((size(on.force) for on in found), default=0.0)
    found = [on.plain(largest, reach) for on in found]
    place, where = about
    blocks: list[Block] = []
    for k, axis in enumerate(axes):
        blocks += [words(f"Forces along {axis}:"), _forces(work, found, k, axis, NOTHING * largest)]
    for k, along in [(2, "")] if len(axes) == 2 else [(k, f" along {axis}") for k, axis in enumerate(axes)]:
        moments = _moments(work, found, place, k, NOTHING * largest * reach, NOTHING * reach)
        blocks += [words(f"Moments about {where}{along}:"), moments]
    return Section(title, tuple(blocks))


def _about(known: Known, link: str) -> tuple[Vec, str]:
    """A named point of the link."""
    for name in known.case.carries.get(link, ()):
        if name in known.points and is_named(name):
            return (*known.points[name], 0.0), name
    return ZERO, "the origin"


class TermOfZero(NamedTuple):
    """A term of a sum that is zero, as it is told, with its sign; ``fine``: 0 where it is something beside
    the largest force, else 1, or 2 where its arm is nothing beside the link."""

    value: float
    told: tuple[int, Expr]
    fine: int
    symbol: Name | None = None


def _closing(work: Worked, terms: Sequence[TermOfZero]) -> list[TermOfZero]:
    """The terms that are told: the coarsest that by themselves come to zero, as far as the digits of the
    points let any. Beside a singular position a force that has no arm is so large that all others are
    nothing beside it."""
    levels = [[term for term in terms if term.fine <= level] for level in range(3)]
    closed = (kept for kept in levels if kept and _gap(kept) <= 10.0**-work.digits)
    return next(closed, min(levels, key=_gap) if levels[0] else [])


def _gap(terms: Sequence[TermOfZero]) -> float:
    """By how much terms miss zero, of the largest."""
    values = [term.value for term in terms]
    return abs(math.fsum(values)) / max(map(abs, values), default=math.inf)


def _forces(work: Worked, forces: Sequence[On], k: int, axis: str, least: float) -> Block:
    """Symbols, then numbers, then zero."""
    sizes = [(on.force[k], Name(on.name, on.low + axis)) for on in forces if on.force[k]]
    terms = [TermOfZero(f, (1, work.number(f)), int(abs(f) <= least), name) for f, name in sizes]
    kept = _closing(work, terms)
    if not kept:
        return words("No force acts that way.")
    symbols = Sum(tuple((1, term.symbol) for term in kept if term.symbol is not None))
    return formula(symbols, Sum(tuple(term.told for term in kept)), Num("0"))


def _moments(work: Worked, forces: Sequence[On], about: Vec, k: int, least: float, short: float) -> Block:
    """Arms times components, and couples: M_x = y F_z - z F_y and so on round. Moments up to the ``least``
    and arms up to the ``short`` one are nothing beside those of the link."""
    i, j = (k + 1) % 3, (k + 2) % 3
    terms: list[TermOfZero] = []
    for on in forces:
        at = on.at if on.at is not None else about
        for sign, axis, other in ((1, i, j), (-1, j, i)):
            arm, force = at[axis] - about[axis], on.force[other]
            value = sign * arm * force
            if value and abs(arm) > ROUNDED * max(abs(at[axis]), abs(about[axis])):
                fine = 2 if abs(arm) <= short else int(abs(value) <= least)
                way = -1 if sign < 0 < arm else 1  # what is taken away has no sign in front
                told = product(work.number(sign * way * arm), work.number(force))
                terms.append(TermOfZero(value, (way, told), fine))
        if on.couple[k]:
            couple = on.couple[k]
            terms.append(TermOfZero(couple, (1, work.number(couple)), int(abs(couple) <= least)))
    sums = tuple(term.told for term in _closing(work, terms))
    return formula(Sum(sums), Num("0")) if sums else words("No force has an arm about it.")


# --- in space --------------------------------------------------------------------------------------------


def sections_in_space(work: Worked) -> Iterable[Section]:
    """Power, the reactions, and the equilibrium of every link."""
    if work.answer.spatial is None:
        return
    if work.answer.terms:
        yield _power(work)
    yield _reactions(work)
    scene = in_space(work.known)
    for link in told_links(work.case):
        if link != work.case.ground:
            yield _link(work, scene, link)


def _power(work: Worked) -> Section:
    """One term a load, for the motion in which the unknown moves at 1."""
    terms = [term for term in work.answer.terms if term.power or term.unknown]
    numbers = Sum(tuple((1, product(work.number(t.value), work.number(t.factor))) for t in terms))
    symbols = Sum(tuple((1, product(load_name(t.load), Name("k", t.load))) for t in terms))
    said = "Where the unknown load moves at 1, every load moves along itself at k; the powers add up to zero:"
    return Section("Power", (words(said), formula(symbols, numbers, Num("0"))))


def _reactions(work: Worked) -> Section:
    assert work.answer.spatial is not None
    forces, couples = (f"F{{}}, {work.units.force}", f"M{{}}, {work.units.torque}")
    heading = [form.format(axis) for form in (forces, couples) for axis in "xyz"]
    rows = [(name, r, (*r.force, *r.couple)) for name, r in work.answer.spatial.reactions.items()]
    return reactions_section(work, heading, rows)


def _link(work: Worked, scene: InSpace, link: str) -> Section:
    forces = list(_acting(work.known, scene, link))
    about = next(iter(scene.carried(link)), ZERO)
    where = next((name for name, place in scene.places.items() if place == about), "the origin")
    reach = max((size(subtract(p, about)) for p in scene.places.values()), default=0.0)
    return link_section(work, link, forces, (about, where), reach, "xyz")


def _acting(known: Known, scene: InSpace, link: str) -> Iterable[On | None]:
    """All reactions and loads on a link; None for a reaction that is open."""
    assert known.answer is not None and known.answer.spatial is not None
    for name, reaction in known.answer.spatial.reactions.of_link(link):
        yield _reaction(known, name, reaction)
    for push in scene.loads:
        if link in (push.link, push.against):
            sign, own = 1.0 if link == push.link else -1.0, load_name(push.name)
            yield load_on(own.base, own.low, push.at, times(sign, push.force), times(sign, push.couple))


# --- friction --------------------------------------------------------------------------------------------


FRICTION = "friction "
"""How terms of the sum of power begin that are those of friction."""


class Rubbed(NamedTuple):
    """Friction at a joint as a load of the sum of power: its number, its rate or speed of rubbing while the
    reference moves at 1, and their product in the unit of the equation."""

    name: Name
    words: str
    value: float
    unit: str
    rate: float
    power: float


def rubbed(known: Known, reference: str) -> list[Rubbed]:
    """The friction at all joints that rub, while ``reference`` moves at 1."""
    answer, units = known.answer, known.case.units
    if answer is None:
        return []
    x, y, w = known.twists[reference]
    turns = known.turns(reference)
    speed = w if turns else math.hypot(x, y)
    if not speed:  # what the motion is told by stands still as written
        return []
    found = []
    for term in answer.terms:
        if not term.load.startswith(FRICTION):
            continue
        torque = term.unit == units.torque
        rate = term.factor * (units.torque_per_force_length if torque else 1.0) / speed
        power = term.value * term.factor / speed * (units.torque_per_force_length if turns else 1.0)
        low = term.load.removeprefix(FRICTION).rsplit(" at ", 1)[0]
        name = Name("L", low.removeprefix("F").removeprefix("T "))
        what = term.words.removesuffix(" in the rope").replace("friction T ", "friction of the rope ")
        said = f"{what[:1].upper()}{what[1:]}"
        found.append(Rubbed(name, said, term.value, term.unit, rate, power))
    return list(_numbered(found))


def _numbered(found: list[Rubbed]) -> Iterable[Rubbed]:
    """Each by a name of its own: the two ends of a block, and the posts of one rope, are counted."""
    often, met = Counter(one.name for one in found), Counter[Name]()
    for one in found:
        met[one.name] += 1
        own = Name(one.name.base, f"{one.name.low},{met[one.name]}")
        yield one._replace(name=own) if often[one.name] > 1 else one


def friction_section(work: Worked) -> Iterable[Section]:
    """The rule at each joint that rubs: friction circles of pins, friction angles of guides; then what they
    come to in this position."""
    rules = [block for joint in work.case.joints for block in _rule(work, joint)]
    rule = RULE if work.answer.answers or work.case.motion else RULE_AT_REST
    blocks = [*([words(rule)] if rules else []), *rules, *rubbing_blocks(work)]
    if blocks:
        yield Section("Friction", tuple(blocks))


def rubbing_blocks(work: Worked) -> Iterable[Block]:
    """What the friction at each joint comes to."""
    friction = work.answer.friction
    if friction is not None and friction.rubbing:
        yield words("With the equations of equilibrium of all links (below) these give:")
        yield Items(tuple((_rubs(work, one),) for one in friction.rubbing))


RULE = (
    "Where a joint rubs, its force leans against the motion by the angle phi, with tan phi = mu. In a pin of "
    "radius r it is then tangent to the friction circle, of radius r sin phi about the pin; on a guide, in a "
    "slot or at a contact it makes phi with the normal."
)


RULE_AT_REST = (
    "Where a joint rubs, it holds as long as its force leans by no more than the angle phi, with tan phi = "
    "mu. In a pin of radius r it then passes within the friction circle, of radius r sin phi about the pin; "
    "on a guide, in a slot or at a contact it makes at most phi with the normal."
)


def _rule(work: Worked, joint: Joint) -> Iterable[Block]:
    """The angle of friction at a joint, and the friction circle of a pin."""
    friction: Friction | None = getattr(joint, "friction", None)
    if friction is None or not friction.mu.value:
        return
    at = getattr(joint, "at", "")
    mu = work.number(friction.mu.value)
    phi = math.degrees(math.atan(friction.mu.value))
    links = listed(joint.links)
    yield words(
        f"Links {links}{at_words(at)}: tan ", Name("phi"), " = ", mu, ", ", Name("phi"), f" = {phi:.6g} deg."
    )
    if joint.pivot and friction.radius is not None:
        radius = friction.radius.value
        circle = work.distance(radius * math.sin(math.radians(phi)))
        numbers = product(work.number(radius), Of("sin", work.number(phi)))
        yield formula(product(Name("r", at), Of("sin", Name("phi"))), numbers, circle)


def _rubs(work: Worked, one: Rubbing) -> str:
    """What friction does at one place."""
    units = work.units
    unit = units.torque if one.kind == "pin" else units.force
    along = {"contact": "tangent", "screw": "thread", "rope": "rope"}.get(one.kind, "guide")
    what = "moment about the pin" if one.kind == "pin" else f"friction along the {along}"
    size = work.show(abs(one.value))
    force = work.answer.reactions.get(one.joint) if work.answer.reactions else None
    of = "" if force is None or force.magnitude is None else f" = {work.show(force.magnitude)} {units.force}"
    arm = ""
    if one.radius is not None:
        arm = f", tangent to the circle of radius {work.show(one.radius)} {units.length}"
    return f"{one.joint}{of}{at_words(one.where)}{arm}: {what} {size} {unit}"
