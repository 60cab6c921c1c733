"""Ropes and screws: the ratios that they give, the tension of a rope, Euler's formula where it slips, and the
torque that raises and lowers by a screw."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise

from icsolve.answer.bodies import Reaction
from icsolve.case import Rope, Screw, Torque, Weight
from icsolve.explain.document import Block, Formula, Section, formula, words
from icsolve.explain.formula import (
    Expr,
    Name,
    Num,
    Of,
    Quantity,
    Quotient,
    Sum,
    minus,
    product,
    quotient,
    solved_for,
    total,
)
from icsolve.explain.worked import Lever, Worked, gain_names, lever, load_name
from icsolve.numbers import FLOATS
from icsolve.report.derivation.known import Acting, Known, Pull, acting_loads, rope_pulls, tension_name
from icsolve.report.derivation.ratios import Ratio, Ratios
from icsolve.screws import velocity
from icsolve.screws.joints import guide_direction
from icsolve.screws.ropes import rope_parts, wrap_angle
from icsolve.tuples import NamedTuple
from icsolve.wording import listed

Headings = Mapping[str, float]


class RopeLine(NamedTuple):
    """What a link has to do with a rope: sign, factor in symbols and in numbers."""

    sign: int
    symbol: Expr
    number: Expr


MOST_EXPONENT = 700.0
"""Beyond this a ratio of pulls is no double."""


def rope_ratio(work: Worked, ratios: Ratios, ratio: Ratio) -> Iterable[Block]:
    """How two links move that a rope ties: the pulls of its parts do no work."""
    assert ratio.rope is not None
    parts: dict[str, list[RopeLine]] = {ratio.of: [], ratio.link: []}
    yield words(f"The rope {ratio.rope.name} keeps its length, so the pulls of its parts do no work.")
    for pull in rope_pulls(work.known, ratio.rope):
        if pull.link == ratio.rope.end:  # pulled toward the last pulley
            angle = math.radians(ratios.headings[pull.link])
            toward = math.cos(angle) * pull.direction[0] + math.sin(angle) * pull.direction[1]
            parts[pull.link].append(RopeLine(1 if toward > 0.0 else -1, Num("1"), Num("1")))
        elif pull.link in parts:
            found, said = _pulled(work, ratios.headings, pull)
            yield from said
            both = (product(Num(str(pull.strands)), one) for one in (found.name, found.number))
            parts[pull.link].append(RopeLine(1, *both))
    moves = {link: work.motion_name(link) for link in parts}
    terms = [(p.sign, product(p.symbol, moves[link])) for link, some in parts.items() for p in some]
    yield formula(Sum(tuple(sorted(terms, key=lambda term: -term[0]))), Num("0"))
    over, under = parts[ratio.of], parts[ratio.link]
    flip = -1 if all(part.sign < 0 for part in under) else 1
    symbols = quotient(
        total([(-flip * p.sign, p.symbol) for p in over]), total([(flip * p.sign, p.symbol) for p in under])
    )
    numbers = solved_for([(-p.sign, p.number) for p in over], [(p.sign, p.number) for p in under])
    yield formula(Quotient(moves[ratio.link], moves[ratio.of]), symbols, numbers, work.number(ratio.value))


def _pulled(work: Worked, headings: Headings, pull: Pull) -> tuple[Lever, list[Block]]:
    """The lever of a pull on its link."""
    shared = sum(
        1 for one in rope_pulls(work.known, pull.rope) if one.where == pull.where and one.link != pull.link
    )
    low = f"{pull.where},{pull.link}" if shared else pull.where
    force = (
        f"the pull of {pull.where}"
        if pull.strands == 1
        else f"each of the {pull.strands} pulls at {pull.where}"
    )
    return lever(work, headings, (force,), low, pull.link, pull.at, pull.direction)


def screw_ratio(work: Worked, ratio: Ratio) -> Iterable[Block]:
    """A screw moves its nut by the lead while it turns once."""
    assert ratio.screw is not None
    yield words("The screw moves by its lead ", Name("l"), " a turn:")
    turn, lead = product(Num("2"), Name("pi")), work.number(ratio.screw.thread.lead.value)
    both = [Quotient(turn, Name("l")), Quotient(work.number(2.0 * math.pi), lead)]
    if ratio.of == ratio.screw.rotor:
        both = [Quotient(one.under, one.over) for one in both]
    signed = [minus(one) if ratio.value < 0.0 else one for one in both]
    left = Quotient(work.motion_name(ratio.link), work.motion_name(ratio.of))
    yield formula(left, *signed, work.number(ratio.value))


# --- tensions ----------------------------------------------------------------------------------------------


def ropes_section(
    work: Worked, headings: Headings, before: Sequence[Section]
) -> tuple[tuple[Section, ...], bool]:
    """The tension of every rope: by the load at its free end, or by the equilibrium of one link; Euler's
    formula where it slips; and whether a tension is left to the equations of the links. Formulas that stand
    ``before`` are not repeated."""
    if not work.answer.tensions:
        return (), False
    blocks: list[Block] = []
    found: set[str] = set()
    for rope in work.case.ropes:
        blocks += _slipping(work, rope)
        if not (rope.slips and any(a.unknown for a in _at_end(work.known, rope))):
            drawn = [*_drawn(work, rope, found)]
            last = _symbol(work.known, rope, len(rope.points) - 1)
            blocks += [*drawn, *(_grown(work, rope, last) if drawn and rope.slips else ())]
    shown = {b.sides[0] for s in before for b in s.blocks if isinstance(b, Formula)}
    still = {work.case.ground, *filter(work.known.rests, work.known.twists)}
    found |= {a.load.name for a in acting_loads(work.known) if not a.unknown or {a.link, a.against} - still}
    links = [link for link in work.case.links if _alone(work.known, link)]
    for link in [*links, *links]:  # one may give what an earlier one needs
        blocks += _by_itself(work, headings, link, found, shown)
    for rope in work.case.ropes:
        if rope.slips:
            blocks += _drawn(work, rope, found)
    left_open = [pull.rope for pull in work.answer.tensions if pull.tension is None and not pull.parts]
    if left_open:
        blocks.append(words(f"Equilibrium alone does not determine the tension of {listed(left_open)}."))
    missing = [rope.name for rope in work.case.ropes if rope.name not in {*found, *left_open}]
    if missing:
        blocks.append(words(f"The equations of equilibrium (below) give the tension of {listed(missing)}."))
    title = "Ropes" if len(work.case.ropes) > 1 else "The rope"
    return (Section(title, tuple(blocks)),), bool(missing)


def _tensions(known: Known, rope: Rope) -> list[float]:
    """The tension of each part."""
    assert known.answer is not None
    found = next(t for t in known.answer.tensions if t.rope == rope.name)
    return list(found.parts) or [found.tension or 0.0] * (len(rope.points) - 1)


def _symbol(known: Known, rope: Rope, part: int) -> Name:
    return Name(*tension_name(known.case, rope, part if rope.slips else 0))


def _slipping(work: Worked, rope: Rope) -> Iterable[Block]:
    """The ratio of the tensions on both sides of what a rope slips on."""
    pulls = _tensions(work.known, rope)
    parts = rope_parts(rope, work.known.points, 1.0, FLOATS)
    for k, mu in enumerate(rope.mu):
        if mu is None or not 0 < k < len(parts):
            continue
        angle, wrap = max(wrap_angle(rope, k, parts[k - 1], parts[k]), 0.0), Name("beta", rope.points[k])
        turn = work.quantity(math.degrees(angle), "deg")
        yield words(
            f"On {rope.points[k]} the rope lies over ", wrap, " = ", turn, " = ",
            work.quantity(angle, "rad"),
            " and slips: its tension grows the way in which it runs (Euler, Eytelwein).",
        )  # fmt: skip
        more, less = (k + 1, k) if pulls[k] >= pulls[k - 1] else (k, k + 1)
        ratio = Quotient(_symbol(work.known, rope, more), _symbol(work.known, rope, less))
        numbers = Of("exp", product(work.number(mu.value), work.number(angle)))
        grown = [work.number(math.exp(mu.value * angle))] if mu.value * angle < MOST_EXPONENT else []
        yield formula(ratio, Of("exp", product(Name("mu"), wrap)), numbers, *grown)


def _grown(work: Worked, rope: Rope, known: Name) -> Iterable[Block]:
    """The tensions of the other parts of a rope that slips, from that of the part which is known."""
    pulls = _tensions(work.known, rope)
    names = [_symbol(work.known, rope, k) for k in range(1, len(pulls) + 1)]
    first = names.index(known)
    for a, b in (*pairwise(range(first, len(pulls))), *pairwise(range(first, -1, -1))):
        tension = work.quantity(pulls[b], work.units.force)
        if rope.mu[max(a, b)] is None:
            yield formula(names[b], names[a], tension)
        elif pulls[a]:
            ratio = work.number(pulls[b] / pulls[a])
            symbols = product(names[a], Quotient(names[b], names[a]))
            yield formula(names[b], symbols, product(work.number(pulls[a]), ratio), tension)


def _at_end(known: Known, rope: Rope) -> list[Acting]:
    """The loads that pull the free end of a rope."""
    return [acting for acting in acting_loads(known) if acting.link == rope.end]


def _drawn(work: Worked, rope: Rope, found: set[str]) -> Iterable[Block]:
    """The tension at the free end is what its loads draw; on the other sides it is in the ratios of Euler."""
    loads = _at_end(work.known, rope)
    if not loads or any(acting.value is None for acting in loads) or f"end of {rope.name}" in found:
        return
    found |= {rope.name, f"end of {rope.name}"}
    last = len(rope.points) - 1
    symbols = total([(1, product(load_name(a.load.name), *gain_names(a.load))) for a in loads])
    numbers = total([(1, product(work.number(a.value or 0.0), *_gain_number(work, a))) for a in loads])
    tension = work.quantity(_tensions(work.known, rope)[-1], work.units.force)
    one = " in all of it" if not rope.slips else f" in its part at {rope.points[-1]}"
    yield words(f"What draws its end is the tension{one}:")
    yield formula(_symbol(work.known, rope, last), symbols, numbers, tension)


def _gain_number(work: Worked, acting: Acting) -> tuple[Num, ...]:
    return (work.number(acting.gain),) if gain_names(acting.load) else ()


def _alone(known: Known, link: str) -> bool:
    """Whether a link has joints with the frame alone, without friction, and only plain loads."""
    case = known.case
    joints = [joint for joint in case.joints if link in joint.links]
    plain = all(j.freedom == 1 and case.ground in j.links and j.friction is None for j in joints)
    loads = [a for a in acting_loads(known) if link in (a.link, a.against)]
    simple = all(
        a.against == case.ground and (isinstance(a.load, Torque | Weight) or a.gain == 1.0) for a in loads
    )
    turned = any(link in screw.links for screw in case.screws)
    return link != case.ground and bool(joints) and plain and simple and not turned


class RopeWork(NamedTuple):
    """The work of a load or pull on a link: its symbol, what stands beside it in symbols and in numbers, its
    number, and whether it is asked for."""

    sign: int
    name: Name
    beside: tuple[Expr, ...]
    factors: tuple[Num, ...]
    number: Quantity
    asked: bool


def _by_itself(
    work: Worked,
    headings: Headings,
    link: str,
    found: set[str],
    shown: set[Expr],
) -> Iterable[Block]:
    """The work of the loads and pulls on one link, solved for the one that is not ``found`` yet."""
    pulls = [pull for rope in work.case.ropes for pull in rope_pulls(work.known, rope) if pull.link == link]
    loads = [acting for acting in acting_loads(work.known) if acting.link == link]
    names = {pull.rope.name for pull in pulls} | {acting.load.name for acting in loads}
    about = work.pivot(link) is not None
    if not pulls or len(names - found) != 1 or not (about or link in headings):
        return
    terms: list[RopeWork] = []
    blocks: list[Block] = []
    for acting in loads:
        own, said = _of_load(work, headings, acting, found, shown)
        terms += [] if own is None else [own]
        blocks += said
    for pull in pulls:
        one, said = _pulled(work, headings, pull)
        beside: tuple[Name, Num] = (one.name, Num(str(pull.strands)))
        new = pull.rope.name not in found
        number = work.quantity(pull.tension or 0.0, work.units.force)
        terms.append(RopeWork(1, Name(*pull.symbol), beside, (beside[1], one.number), number, new))
        blocks += [] if one.name in shown else said
    arms = "have no arm about its centre" if about else "do no work as it slides"
    yield words(f"Link {link} by itself: the forces of the frame {arms}.")
    yield from blocks
    yield formula(Sum(tuple((w.sign, product(*w.beside[1:], w.name, w.beside[0])) for w in terms)), Num("0"))
    rest = [(-w.sign, product(w.number.number, *w.factors)) for w in terms if not w.asked]
    asked = [w for w in terms if w.asked]
    first = float(asked[0].number.number.digits) or 1.0
    shares = [work.number(float(w.number.number.digits) / first) for w in asked]
    factors = [(w.sign, product(s, *w.factors)) for w, s in zip(asked, shares, strict=True)]
    yield formula(asked[0].name, solved_for(rest, factors), asked[0].number)
    for rope in work.case.ropes:
        if rope.slips and rope.name in names - found:
            yield from _grown(work, rope, asked[0].name)
    found |= names


def _of_load(
    work: Worked, headings: Headings, acting: Acting, found: set[str], shown: set[Expr]
) -> tuple[RopeWork | None, list[Block]]:
    name, new = load_name(acting.load.name), acting.load.name not in found
    number = work.quantity(acting.value or 0.0, acting.unit)
    if acting.at is not None:
        low = "".join(name)
        one, said = lever(work, headings, (name,), low, acting.link, acting.at, acting.direction)
        factors = (*_gain_number(work, acting), one.number)
        return RopeWork(
            1, name, (one.name, *gain_names(acting.load)), factors, number, new
        ), [] if one.name in shown else said
    if work.pivot(acting.link) is None:
        return None, []
    per = work.number(1.0 / work.units.torque_per_force_length)
    return RopeWork(acting.sign, name, (Num("1"),), (per,), number, new), []


# --- screws ------------------------------------------------------------------------------------------------


def screws_section(work: Worked) -> Iterable[Section]:
    """The torque of every screw by its thread, as books have it."""
    blocks = [block for screw in work.case.screws for block in _screw(work, screw)]
    if blocks:
        yield Section("The screw" if len(work.case.screws) == 1 else "Screws", tuple(blocks))


def _screw(work: Worked, screw: Screw) -> Iterable[Block]:
    thrust = _thrust(work.known, screw)
    turn = product(Num("2"), Name("pi"))
    lead, pi2 = work.number(screw.thread.lead.value), work.number(2.0 * math.pi)
    if thrust is not None:
        size = work.quantity(abs(thrust), work.units.force)
        links = f"Links {listed(screw.links)} press on each other along the screw with "
        yield words(links, Name("F"), " = ", size, ".")
    if screw.thread.radius is None or screw.thread.mu is None or not screw.rubs:
        yield words("Without friction the work of a turn is that of the lead:")
        sides: tuple[Expr, Expr] = (Quotient(Name("l"), turn), Quotient(lead, pi2))
        yield _turned(work, screw, thrust, 1, screw.thread.lead.value / (2.0 * math.pi), sides)
        return
    r, rise = screw.thread.radius.value, screw.thread.lead.value / (2.0 * math.pi * screw.thread.radius.value)
    slope, phi = math.degrees(math.atan(rise)), math.degrees(math.atan(screw.thread.mu.value))
    names = (Name("lambda"), Name("phi"))
    yield words("The angle of its thread, and that of friction:")
    sizes = Quotient(lead, product(pi2, work.number(r)))
    pitch = Quotient(Name("l"), product(turn, Name("r")))
    yield formula(Of("tan", names[0]), pitch, sizes, work.number(rise))
    yield formula(names[0], work.quantity(slope, "deg"))
    yield formula(Of("tan", names[1]), Name("mu"), work.number(screw.thread.mu.value))
    yield formula(names[1], work.quantity(phi, "deg"))
    driven = _driven(work.known, screw, thrust)
    for sign, way in ((1, "Against the load, to raise it:"), (-1, "With the load, to lower it:")):
        if driven in (None, sign):
            yield words(way)
            written = (_tangent(*names, sign), _tangent(work.number(slope), work.number(phi), sign))
            sides = (product(Name("r"), written[0]), product(work.number(r), written[1]))
            gain = r * math.tan(math.radians(phi + sign * slope))
            yield _turned(work, screw, thrust, sign, gain, sides)
    holds = "at least" if phi >= slope else "less than"
    locks = "is self-locking: the load alone does not turn it" if phi >= slope else "is not self-locking"
    yield words("As ", names[1], f" is {holds} ", names[0], f", it {locks}.")
    if driven != -1:
        yield words("Its efficiency:")
        whole = Quotient(Of("tan", names[0]), _tangent(*names, 1))
        both = (work.number(slope), work.number(phi))
        gained = rise / math.tan(math.radians(phi + slope))
        yield formula(whole, Quotient(Of("tan", both[0]), _tangent(*both, 1)), work.number(gained))


def _tangent(slope: Expr, phi: Expr, sign: int) -> Expr:
    """The tangent of the angle of friction and, or less, that of the thread."""
    return Of("tan", Sum(((1, phi), (sign, slope))))


def _turned(
    work: Worked,
    screw: Screw,
    thrust: float | None,
    sign: int,
    gain: float,
    sides: tuple[Expr, Expr],
) -> Block:
    """The torque that moves a screw against (1) or with (-1) its load: ``gain`` times it, ``sides`` in
    symbols and in numbers; negative where it turns counterclockwise."""
    loads = [acting for acting in acting_loads(work.known) if acting.link == screw.rotor]
    torque = load_name(loads[0].load.name) if len(loads) == 1 else Name("T", "screw")
    symbols = product(Name("F"), sides[0])
    if thrust is None:
        return formula(torque, symbols)
    per = work.units.torque_per_force_length
    scale = () if per == 1.0 else (work.number(per),)
    numbers = product(work.number(abs(thrust)), sides[1], *scale)
    value = math.copysign(1.0, thrust) * sign * abs(thrust) * gain * per
    backward = thrust * sign < 0.0
    both = [minus(one) for one in (symbols, numbers)] if backward else [symbols, numbers]
    return formula(torque, *both, work.quantity(value, work.units.torque))


def _thrust(known: Known, screw: Screw) -> float | None:
    """The force along the axis on the second link; None where it is not known."""
    reactions: Mapping[str, Reaction] = (known.answer.reactions or {}) if known.answer is not None else {}
    for r in reactions.values():
        if r.kind == "screw" and {r.by, r.on} == {*screw.links} and r.x is not None and r.y is not None:
            x, y = guide_direction(screw.slide.guide, known.points, FLOATS)
            return float(x * r.x + y * r.y) * (1.0 if r.on == screw.links[1] else -1.0)
    return None


def _driven(known: Known, screw: Screw, thrust: float | None) -> int | None:
    """1 where the nut moves against its load, -1 with it; None where that is open."""
    if thrust is None or not known.case.motion or not {*screw.links} <= known.twists.keys():
        return None
    x, y = guide_direction(screw.slide.guide, known.points, FLOATS)
    both = [velocity(known.twists[link], known.points[screw.slide.at]) for link in screw.links]
    speed = x * (both[1][0] - both[0][0]) + y * (both[1][1] - both[0][1])
    return None if thrust * speed == 0.0 else 1 if thrust * speed > 0.0 else -1
