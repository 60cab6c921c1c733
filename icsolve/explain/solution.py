"""The worked solution of a case, in the textbook's order, and its last sections: the answer in words, its
check by free bodies, the rates where they are asked, and what was left out."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from icsolve.answer import Answer, Found
from icsolve.cams.words import contact_said
from icsolve.case import ForceVector, Like, Load, Spring, Torque, is_link, is_named
from icsolve.case.loads import name_of_inertia
from icsolve.draw.words import holding_sentences
from icsolve.explain.bodies import bodies_sections, friction_section, rubbing_blocks, sections_in_space
from icsolve.explain.centres import RATIOS, centre_sections, ratio_section, worked_speeds
from icsolve.explain.document import Block, Document, Inline, Items, Section, ShownTable, formula, words
from icsolve.explain.equilibrium import equilibrium_section
from icsolve.explain.formula import Name, Num, Product, Quantity, Quotient, minus, product
from icsolve.explain.given import asked_section, given_section
from icsolve.explain.power import motions_section, power_section
from icsolve.explain.ropes import ropes_section, screws_section
from icsolve.explain.worked import Worked, exerted_name, load_name, rate_name, worked
from icsolve.kinematics import FRAME
from icsolve.report import positions_text
from icsolve.report.derivation.known import Known, acting_loads
from icsolve.report.derivation.ratios import Step, all_steps, answer_ratios, needed_steps
from icsolve.screws import velocity
from icsolve.statics.power import is_unknown
from icsolve.wording import direction_words, holding, plain_vector, spelt
from icsolve.wording.sentences import provenance

SEARCHED = (
    "The loads balance where the power of all of them vanishes for the motion that the mechanism has. The "
    "whole range was searched; the figure shows the first position that is stable, where there is one:"
)
HOLDS = (
    "Where the loads nearly balance friction holds the mechanism still: from one value, at which it is about "
    "to move one way, to another, at which it is about to move the other way, or to where the search ends."
)


def answer_section(work: Worked) -> Iterable[Section]:
    """Each unknown with its unit and sense in words, and the mechanical advantage."""
    answer = work.answer
    if answer.positions:
        yield from equilibrium_section(work)
        rests = tuple((line,) for line in positions_text(answer, work.digits))
        said = HOLDS if all(one.stability is None for one in answer.positions) else SEARCHED
        yield Section("Positions of equilibrium", (words(said), Items(rests)))
    if answer.answers:
        entries = tuple(_found(work, name, found) for name, found in answer.answers.items())
        blocks: list[Block] = [Items(entries)]
        blocks += _advantage(work)
        yield Section("Answer", tuple(blocks))
    elif work.known.whole is not None:
        yield from rates_section(work)
        if held := holding_sentences(work.known):
            yield Section("Answer", (words(f"{held[0]}."),))


def _found(work: Worked, name: str, found: Found) -> tuple[Inline, ...]:
    if found.holds is not None:
        return (load_name(name), f" {holding(found, work.show)}.")
    sense = spelt(found.sense)
    size = work.quantity(abs(found.value), found.unit)
    said = f", {sense}" if sense else ""
    load = next((load for load in work.case.loads if load.name == name), None)
    if found.value < 0.0 and not isinstance(load, Torque):
        said += "; the minus in the equation says that it acts against the direction that the case gives"
    elif found.value < 0.0:
        said += "; the minus in the equation says that it turns against its positive sense"
    return (load_name(name), " = ", size, f"{said}.")


def _advantage(work: Worked) -> Iterable[Block]:
    answer = work.answer
    if answer.advantage is None:
        return
    loads = [term.load for term in answer.terms if " " not in term.load]
    top = next(iter(answer.answers))
    bottom = next(name for name in loads if name not in answer.answers)
    units = {term.load: term.unit for term in answer.terms}
    under, unit, value = load_name(bottom), units[bottom], answer.advantage
    for acting in acting_loads(work.known):
        if acting.load.name == bottom and isinstance(acting.load, Spring):  # its force, not its stiffness
            under, unit, value = exerted_name(acting.load), work.units.force, value / acting.gain
    alike = units[top] == unit
    kind = (
        f"The mechanical advantage, where {top} is the output" if alike else "For one unit of the known load"
    )
    per = "" if alike else f"{units[top]} per {unit}"
    yield words(f"{kind}: ", Quotient(load_name(top), under), " = ", work.quantity(value, per), ".")


def rates_section(work: Worked) -> Iterable[Section]:
    """How fast the links turn, and the points move."""
    whole = work.known.whole
    if whole is None or whole.rates is None:
        return
    timed = any(motion.speed is not None for motion in work.case.motion)
    unit = "rad/s" if timed else "scaled"
    rows: list[tuple[tuple[Inline, ...], ...]] = []
    for link, rate in whole.rates.items():
        if link == work.case.ground:
            continue
        value = f"left open: {rate}" if isinstance(rate, str) else work.number(rate)
        rows.append(((rate_name(link),), (value,)))
    yield from worked_speeds(work)
    one = next((link for link, rate in whole.rates.items() if rate == 1.0), None)
    blocks: list[Block] = []
    if not timed and one is not None:
        blocks = [words("No speed is given; these are the speeds while ", rate_name(one), " = 1.")]
    blocks += [ShownTable(("link", f"angular velocity, {unit}, counterclockwise positive"), tuple(rows))]
    blocks += _velocities(work, timed)
    yield Section("Speeds", tuple(blocks))


def _velocities(work: Worked, timed: bool) -> Iterable[Block]:
    whole = work.known.whole
    if whole is None or not whole.velocities:
        return
    unit = f"{work.units.length}/s" if timed else "scaled"
    rows: list[tuple[tuple[Inline, ...], ...]] = []
    vectors = {key: v for key, v in whole.velocities.items() if not isinstance(v, str)}
    fastest = max((math.hypot(*v) for v in vectors.values()), default=0.0)
    for (point, link), v in vectors.items():
        if not is_named(point) or link == work.case.ground:
            continue
        x, y = map(work.number, plain_vector(v, fastest))
        rows.append(((f"{point} on {link}",), (x,), (y,)))
    if rows:
        yield ShownTable(("point", f"x, {unit}", f"y, {unit}"), tuple(rows))


SAME = 1e-12
"""Two ways to an answer that differ by less, of it, gave the same: that is what rounding leaves."""


def check_section(work: Worked) -> Iterable[Section]:
    """The unknown loads a second time, by the equilibrium of every link."""
    if not work.answer.witnesses:
        return
    entries: list[tuple[Inline, ...]] = []
    units = {name: found.unit for name, found in work.answer.answers.items()}
    for w in work.answer.witnesses:
        unit = units.get(w.load, "")
        off = Quantity(Num(f"{abs(w.difference):.1g}"), unit)
        found = work.quantity(w.bodies, unit)
        seen = abs(w.difference) > SAME * abs(w.bodies)
        but: tuple[Inline, ...] = (" but for ", off) if seen else ()
        same = " by free bodies alone; power gave the same"
        entries.append((load_name(w.load), " = ", found, same, *but, "."))
    said = words("The equations of equilibrium of all links, without power or centres, give:")
    yield Section("Check by free bodies", (said, Items(tuple(entries))))


def left_out(work: Worked, steps: Sequence[Step], *, bodies: bool) -> Iterable[Section]:
    """What the answer did not need, and why; ``bodies``: the forces in the joints are shown."""
    entries = tuple(_skipped(work, steps, bodies=bodies))
    if entries:
        yield Section("Left out", (Items(entries),))


def contacts_section(work: Worked) -> Iterable[Section]:
    """Where profiles touch, and their normal there, which the centres are found by."""
    if work.known.answer is not None and work.known.answer.touching:
        told = tuple((sentence(contact_said(one)),) for one in work.known.answer.touching)
        yield Section("Contacts", (words("Profiles touch where they have one normal:"), Items(told)))


def remarks_section(work: Worked) -> Iterable[Section]:
    """Notes, and what rounding leaves."""
    told = [contact_said(one) for one in work.answer.touching]
    entries: list[tuple[Inline, ...]] = [(sentence(note),) for note in work.answer.notes if note not in told]
    entries += _rounding(work.answer)
    if entries:
        yield Section("Remarks", (Items(tuple(entries)),))


def _skipped(work: Worked, steps: Sequence[Step], *, bodies: bool) -> Iterable[tuple[Inline, ...]]:
    needed = {step.centre.pair for step in steps}
    answer, whole = work.answer, work.known.whole
    others = [pair for pair in (whole.centres if whole else ()) if pair not in needed]
    if others and answer.answers:
        names: list[Inline] = []
        for n, pair in enumerate(others):
            names += [", " if n else "", work.centre_name(pair)]
        what, them = ("The centre ", "it") if len(others) == 1 else ("The centres ", "them")
        yield (what, *names, f": the loaded links are related without {them}.")
    if answer.answers and not bodies:
        idle = "do no work" if answer.friction is None else "do no work but by friction"
        yield (f"The forces in the joints: they {idle}, and the equation of power is without them.",)
    if answer.skipped:
        yield (f"Not examined, as the answer does not need it: {'; '.join(answer.skipped)}.",)


def _rounding(answer: Answer) -> Iterable[tuple[Inline, ...]]:
    """How far rounding can have moved each answer."""
    for name, found in answer.answers.items():
        if found.error is not None and found.error > 0.0:
            bound = Quantity(Num(f"{found.error:.1e}"), found.unit)
            yield ("Rounding can have moved ", load_name(name), " by ", bound, " at most.")
        elif found.error is None and found.why:
            yield ("No bound is known for what rounding has done to ", load_name(name), f": {found.why}.")


def sentence(text: str) -> str:
    """With a full stop, and a capital where it does not begin with a path (``angles.AB``)."""
    first, _, rest = text.partition(" ")
    text = text if "." in first else f"{first[:1].upper()}{first[1:]} {rest}".strip()
    return text if text.endswith((".", "!", "?")) else f"{text}."


# --- the whole solution ----------------------------------------------------------------------------------


AT_REST = (
    "Nothing moves and no motion is given, so friction may act either way within its limits: the unknown "
    "load holds over a range. Its ends are where the mechanism is about to move, by the equilibrium of all "
    "links with full friction."
)


def solution(known: Known, digits: int = 6, *, bodies: bool = False) -> Document:
    """The worked solution; ``bodies`` adds the equations of every link."""
    case = known.case
    lead = [f"Source: {case.source}"] if case.source else []
    work = worked(known, digits)
    sections = (
        section._replace(blocks=tuple(map(work.recomputing, section.blocks)))
        for section in _sections(work, bodies)
    )
    return Document(known.title, (*lead, *provenance(case)), tuple(sections))


def _sections(work: Worked, bodies: bool) -> Iterable[Section]:
    """In the textbook's order; a case in space is statics, with the reactions always."""
    known, in_space, is_open = work.known, work.case.space is not None, False
    yield given_section(work)
    yield asked_section(work)
    yield from contacts_section(work)
    asked = any(is_unknown(load) for load in work.case.loads)
    steps = needed_steps(known) if asked else all_steps(known)
    yield from centre_sections(work, steps)
    if known.refusal is not None:
        said = f"{sentence(known.refusal.message)} (Status: {known.refusal.status}.)"
        yield Section("No answer", (words(said),))
        return
    if in_space:
        yield from sections_in_space(work)
    else:
        yield from inertia_section(work)
        power = list(_by_power(work))
        yield from power
        ratios = answer_ratios(known)
        ropes, is_open = ropes_section(work, {} if ratios is None else ratios.headings, power)
        yield from ropes
        yield from screws_section(work)
        yield from friction_section(work)
        yield from ends_sections(work)
    yield from answer_section(work)
    yield from left_out(work, steps, bodies=bodies or in_space)
    yield from check_section(work)
    if bodies or known.structure or is_open or work.answer.friction is not None:
        yield from bodies_sections(work)
    yield from remarks_section(work)


def _by_power(work: Worked) -> Iterable[Section]:
    """Ratios of speeds and the equation of power; by motions where the centres do not give them."""
    loads = acting_loads(work.known)
    if not any(load.unknown for load in loads):
        return
    if any(load.held is not None for load in loads):
        yield Section("Power", (words(AT_REST),))
        return
    ratios = answer_ratios(work.known)
    asked = [load for load in work.case.loads if is_unknown(load)]
    several = (work.answer.mobility or 0) > 1 and len(asked) > 1
    section = None if ratios is None or several else power_section(work, ratios, loads)
    if ratios is None or section is None:
        yield from motions_section(work, loads)
        return
    yield from ratio_section(work, ratios)
    yield section


def ends_sections(work: Worked) -> Iterable[Section]:
    """The ends of a range in which friction holds: how it is about to move, power and the free bodies of
    each; the ratios of the speeds, which are those of both, once."""
    for n, (way, answer) in enumerate(work.answer.about_to_move):
        twists = {link: (way * x, way * y, way * w) for link, (x, y, w) in work.known.twists.items()}
        here = work._replace(known=work.known._replace(answer=answer, twists=twists))
        (name, found), *_ = answer.answers.items()
        at = f" where {name} = {work.show(found.value)} {found.unit}"
        yield Section(f"About to move{at}", (words(f"{_about_to(here)}:"), *rubbing_blocks(here)))
        for section in (*_by_power(here), *bodies_sections(here)):
            if section.title != RATIOS:
                yield section._replace(title=f"{section.title}{at}")
            elif n == 0:
                yield section


def _about_to(work: Worked) -> str:
    """How the first link that moves is about to."""
    known = work.known
    link = next(link for link in known.twists if is_link(link) and not known.rests(link))
    twist = known.twists[link]
    if known.turns(link):
        return f"Link {link} is about to turn {spelt('ccw' if twist[2] > 0.0 else 'cw')}"
    x, y = velocity(twist, FRAME)
    return f"Link {link} is about to move toward {direction_words(math.degrees(math.atan2(y, x)))}"


# --- inertia forces ---------------------------------------------------------------------------------


DALEMBERT = (
    "With the inertia forces of its motion among the loads a mechanism counts as in equilibrium "
    "(d'Alembert). They act against the accelerations, which the second derivative of the figure gives:"
)


def inertia_section(work: Worked) -> Iterable[Section]:
    """-m a at the centre of mass and -J alpha of every link that has a mass."""
    loads = [load for load in work.case.loads if name_of_inertia(load.name)]
    blocks = [block for load in loads for block in _inertia(work, load)]
    if blocks:
        yield Section("Inertia forces", (words(DALEMBERT), *blocks))


def _inertia(work: Worked, load: Load) -> Iterable[Block]:
    answer, units, given = work.answer, work.units, work.case.inertia.get(load.link)
    if given is None:
        return
    symbol = load_name(load.name)

    def against(name: Name, own: Name, rate: Name, numbers: tuple[float, ...], whole: Quantity) -> Block:
        """Minus inertia times acceleration; the last of the numbers brings it into case units."""
        shown = numbers[:-1] if numbers[-1] == 1.0 else numbers
        return formula(name, minus(product(own, rate)), minus(Product(tuple(map(work.number, shown)))), whole)

    if isinstance(load, ForceVector):
        place = (answer.accelerations or {}).get((load.at, load.link))
        if given.mass is None or place is None or isinstance(place, str):
            return
        mass, scale = Name("m", load.link), units.force_per_newton / units.length_per_metre
        x, y = (work.quantity(size, "").number for size in place)
        so = ":" if load.x.value or load.y.value else ", so its inertia force is zero."
        yield words(
            f"Link {load.link}, ", mass, " = ", work.quantity(given.mass.value, "kg"),
            f", moves {load.at} with ", Name("a", load.at), " = (", x, ", ", y, f") {units.length}/s^2{so}",
        )  # fmt: skip
        for axis, size, force in zip("xy", place, (load.x.value, load.y.value), strict=True):
            if force:
                own, rate = Name(symbol.base, symbol.low + axis), Name("a", f"{load.at}{axis}")
                whole = work.quantity(force, units.force)
                yield against(own, mass, rate, (given.mass.value, size, scale), whole)
    if isinstance(load, Torque) and load.value is not None:
        moment, spin = given.moment, (answer.angular_accelerations or {}).get(load.link)
        if moment is None or spin is None or isinstance(spin, str) or isinstance(load.value, Like):
            return
        rate, own = Name("alpha", load.link), Name("J", load.link)
        yield words(
            f"Link {load.link} has ", own, " = ", work.quantity(moment.value, "kg*m^2"),
            " and turns with ", rate, " = ", work.quantity(spin, "rad/s^2"), ":",
        )  # fmt: skip
        scale = units.force_per_newton * units.length_per_metre * units.torque_per_force_length
        whole = work.quantity(load.value.value, units.torque)
        yield against(symbol, own, rate, (moment.value, spin, scale), whole)
