"""The worked solution of a case, in the textbook's order, and its last sections: the answer in words, its
check by free bodies, the rates where they are asked, and what was left out."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from icsolve.answer import Answer, Found
from icsolve.case import ForceVector, Like, Load, Spring, Torque, is_named
from icsolve.errors import SceneError
from icsolve.explain.centres import centre_sections, ratio_section, worked_speeds
from icsolve.explain.document import Block, Document, Inline, Items, Section, ShownTable, formula, words
from icsolve.explain.equilibrium import equilibrium_section
from icsolve.explain.formula import Name, Num, Product, Quantity, Quotient, minus, product
from icsolve.explain.friction import friction_section
from icsolve.explain.given import (
    Figures,
    asked_section,
    centre_name,
    figures_of,
    given_section,
    load_name,
    rate_name,
)
from icsolve.explain.power import motions_section, power_section
from icsolve.explain.ropes import ropes_section, screws_section
from icsolve.report.derivation.known import Known, acting_loads
from icsolve.report.derivation.ratios import Step, all_steps, answer_ratios, needed_steps
from icsolve.report.text import positions_text
from icsolve.statics.power import is_unknown
from icsolve.wording.senses import holding, plain_vector, spelt
from icsolve.wording.sentences import provenance

SEARCHED = (
    "The loads balance where the power of all of them vanishes for the motion that the mechanism has. The "
    "whole range was searched; the figure shows the first position that is stable, where there is one:"
)
HOLDS = (
    "Where the loads nearly balance friction holds the mechanism still: from one value, at which it is about "
    "to move one way, to another, at which it is about to move the other way."
)


def answer_section(known: Known, figures: Figures) -> Iterable[Section]:
    """Each unknown with its unit and sense in words, and the mechanical advantage."""
    answer = known.answer
    if answer is None:
        return
    if answer.positions:
        yield from equilibrium_section(known, figures)
        rests = tuple((line,) for line in positions_text(answer, figures.digits))
        said = HOLDS if all(one.stability is None for one in answer.positions) else SEARCHED
        yield Section("Positions of equilibrium", (words(said), Items(rests)))
    if answer.answers:
        entries = tuple(_found(known, figures, name, found) for name, found in answer.answers.items())
        blocks: list[Block] = [Items(entries)]
        blocks += _advantage(known, figures)
        yield Section("Answer", tuple(blocks))
    elif known.whole is not None:
        yield from rates_section(known, figures)


def _found(known: Known, figures: Figures, name: str, found: Found) -> tuple[Inline, ...]:
    if found.holds is not None:
        return (load_name(name), f" {holding(found, lambda value: figures.number(value).digits)}.")
    sense = spelt(found.sense)
    size = figures.quantity(abs(found.value), found.unit)
    said = f", {sense}" if sense else ""
    load = next((load for load in known.case.loads if load.name == name), None)
    if found.value < 0.0 and not isinstance(load, Torque):
        said += "; the minus in the equation says that it acts against the direction that the case gives"
    elif found.value < 0.0:
        said += "; the minus in the equation says that it turns against its positive sense"
    return (load_name(name), " = ", size, f"{said}.")


def _advantage(known: Known, figures: Figures) -> Iterable[Block]:
    answer = known.answer
    if answer is None or answer.advantage is None:
        return
    loads = [term.load for term in answer.terms if " " not in term.load]
    top = next(iter(answer.answers))
    bottom = next(name for name in loads if name not in answer.answers)
    units = {term.load: term.unit for term in answer.terms}
    under, unit, value = load_name(bottom), units[bottom], answer.advantage
    for acting in acting_loads(known):
        if acting.load.name == bottom and isinstance(acting.load, Spring):  # its force, not its stiffness
            under, unit, value = Name("F", bottom), known.case.units.force, value / acting.gain
    alike = units[top] == unit
    kind = (
        f"The mechanical advantage, where {top} is the output" if alike else "For one unit of the known load"
    )
    per = "" if alike else f"{units[top]} per {unit}"
    yield words(f"{kind}: ", Quotient(load_name(top), under), " = ", figures.quantity(value, per), ".")


def rates_section(known: Known, figures: Figures) -> Iterable[Section]:
    """How fast the links turn, and the points move."""
    whole = known.whole
    if whole is None or whole.rates is None:
        return
    timed = any(motion.speed is not None for motion in known.case.motion)
    unit = "rad/s" if timed else "scaled"
    rows: list[tuple[tuple[Inline, ...], ...]] = []
    for link, rate in whole.rates.items():
        if link == known.case.ground:
            continue
        value = f"left open: {rate}" if isinstance(rate, str) else figures.number(rate)
        rows.append(((rate_name(link),), (value,)))
    yield from worked_speeds(known, figures)
    one = next((link for link, rate in whole.rates.items() if rate == 1.0), None)
    blocks: list[Block] = []
    if not timed and one is not None:
        blocks = [words("No speed is given; these are the speeds while ", rate_name(one), " = 1.")]
    blocks += [ShownTable(("link", f"angular velocity, {unit}, counterclockwise positive"), tuple(rows))]
    blocks += _velocities(known, figures, timed)
    yield Section("Speeds", tuple(blocks))


def _velocities(known: Known, figures: Figures, timed: bool) -> Iterable[Block]:
    whole = known.whole
    if whole is None or not whole.velocities:
        return
    unit = f"{known.case.units.length}/s" if timed else "scaled"
    rows: list[tuple[tuple[Inline, ...], ...]] = []
    vectors = {key: v for key, v in whole.velocities.items() if not isinstance(v, str)}
    fastest = max((math.hypot(*v) for v in vectors.values()), default=0.0)
    for (point, link), v in vectors.items():
        if not is_named(point) or link == known.case.ground:
            continue
        x, y = map(figures.number, plain_vector(v, fastest))
        rows.append(((f"{point} on {link}",), (x,), (y,)))
    if rows:
        yield ShownTable(("point", f"x, {unit}", f"y, {unit}"), tuple(rows))


SAME = 1e-12
"""Two ways to an answer that differ by less, of it, gave the same: that is what rounding leaves."""


def check_section(known: Known, figures: Figures) -> Iterable[Section]:
    """The unknown loads a second time, by the equilibrium of every link."""
    answer = known.answer
    if answer is None or not answer.witnesses:
        return
    entries: list[tuple[Inline, ...]] = []
    units = {name: found.unit for name, found in answer.answers.items()}
    for w in answer.witnesses:
        unit = units.get(w.load, "")
        off = Quantity(Num(f"{abs(w.difference):.1g}"), unit)
        found = figures.quantity(w.bodies, unit)
        seen = abs(w.difference) > SAME * abs(w.bodies)
        but: tuple[Inline, ...] = (" but for ", off) if seen else ()
        same = " by free bodies alone; power gave the same"
        entries.append((load_name(w.load), " = ", found, same, *but, "."))
    said = words("The equations of equilibrium of all links, without power or centres, give:")
    yield Section("Check by free bodies", (said, Items(tuple(entries))))


def left_out(known: Known, steps: Sequence[Step], *, bodies: bool) -> Iterable[Section]:
    """What the answer did not need, and why; ``bodies``: the forces in the joints are shown."""
    if known.answer is None:
        return
    entries = tuple(_skipped(known, known.answer, steps, bodies=bodies))
    if entries:
        yield Section("Left out", (Items(entries),))


def remarks_section(known: Known, figures: Figures) -> Iterable[Section]:
    """Notes, and what rounding leaves."""
    if known.answer is None:
        return
    entries: list[tuple[Inline, ...]] = [(sentence(note),) for note in known.answer.notes]
    entries += _rounding(known.answer)
    if entries:
        yield Section("Remarks", (Items(tuple(entries)),))


def _skipped(
    known: Known, answer: Answer, steps: Sequence[Step], *, bodies: bool
) -> Iterable[tuple[Inline, ...]]:
    needed = {step.centre.pair for step in steps}
    others = [pair for pair in (known.whole.centres if known.whole else ()) if pair not in needed]
    if others and answer.answers:
        names: list[Inline] = []
        for n, pair in enumerate(others):
            names += [", " if n else "", centre_name(known, pair)]
        what, them = ("The centre ", "it") if len(others) == 1 else ("The centres ", "them")
        yield (what, *names, f": the loaded links are related without {them}.")
    if answer.answers and not bodies:
        idle = "do no work" if answer.friction is None else "do work by friction alone"
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
    figures = figures_of(known, digits)
    case = known.case
    lead = [f"Source: {case.source}"] if case.source else []
    return Document(known.title, (*lead, *provenance(case)), tuple(_sections(known, figures, bodies)))


def _sections(known: Known, figures: Figures, bodies: bool) -> Iterable[Section]:
    if known.case.space is not None:
        yield from _in_space(known, figures)
        return
    yield given_section(known, figures)
    yield asked_section(known, figures)
    steps = _steps(known)
    yield from centre_sections(known, figures, steps)
    if known.refusal is not None:
        yield _refused(known.refusal)
        return
    yield from inertia_section(known, figures)
    power = list(_by_power(known, figures))
    yield from power
    ratios = answer_ratios(known)
    ropes, is_open = ropes_section(known, figures, {} if ratios is None else ratios.headings, power)
    yield from ropes
    yield from screws_section(known, figures)
    yield from friction_section(known, figures)
    yield from answer_section(known, figures)
    yield from left_out(known, steps, bodies=bodies)
    yield from check_section(known, figures)
    rubs = known.answer is not None and known.answer.friction is not None
    if bodies or known.structure or is_open or rubs:
        from icsolve.explain.bodies import bodies_sections

        yield from bodies_sections(known, figures)
    yield from remarks_section(known, figures)


def _refused(refusal: SceneError) -> Section:
    said = f"{sentence(refusal.message)} (Status: {refusal.status}.)"
    return Section("No answer", (words(said),))


def _in_space(known: Known, figures: Figures) -> Iterable[Section]:
    """A case in space: statics, with the reactions always."""
    from icsolve.explain.space import asked_in_space, given_in_space, sections_in_space

    yield given_in_space(known, figures)
    yield asked_in_space(known, figures)
    if known.refusal is not None:
        yield _refused(known.refusal)
        return
    yield from sections_in_space(known, figures)
    yield from answer_section(known, figures)
    yield from left_out(known, (), bodies=True)
    yield from check_section(known, figures)
    yield from remarks_section(known, figures)


def _steps(known: Known) -> tuple[Step, ...]:
    """The centres that the answer needs; all where nothing else is asked."""
    asked = any(is_unknown(load) for load in known.case.loads)
    return needed_steps(known) if asked else all_steps(known)


def _by_power(known: Known, figures: Figures) -> Iterable[Section]:
    """Ratios of speeds and the equation of power; by motions where the centres do not give them."""
    loads = acting_loads(known)
    if not any(load.unknown for load in loads):
        return
    if any(load.holds is not None for load in loads):
        yield Section("Power", (words(AT_REST),))
        return
    ratios = answer_ratios(known)
    asked = [load for load in known.case.loads if is_unknown(load)]
    several = known.answer is not None and (known.answer.mobility or 0) > 1 and len(asked) > 1
    section = None if ratios is None or several else power_section(known, figures, ratios, loads)
    if ratios is None or section is None:
        yield from motions_section(known, figures, loads)
        return
    yield from ratio_section(known, figures, ratios)
    yield section


# --- inertia forces ---------------------------------------------------------------------------------


DALEMBERT = (
    "With the inertia forces of its motion among the loads a mechanism counts as in equilibrium "
    "(d'Alembert). They act against the accelerations, which the second derivative of the figure gives:"
)


def inertia_section(known: Known, figures: Figures) -> Iterable[Section]:
    """-m a at the centre of mass and -J alpha of every link that has a mass."""
    loads = [load for load in known.case.loads if load.name.startswith("inertia ")]
    blocks = [block for load in loads for block in _inertia(known, figures, load)]
    if blocks:
        yield Section("Inertia forces", (words(DALEMBERT), *blocks))


def _inertia(known: Known, figures: Figures, load: Load) -> Iterable[Block]:
    answer, units, given = known.answer, known.case.units, known.case.inertia.get(load.link)
    if answer is None or given is None:
        return
    symbol = load_name(load.name)

    def against(name: Name, own: Name, rate: Name, numbers: tuple[float, ...], whole: Quantity) -> Block:
        """Minus inertia times acceleration; the last of the numbers brings it into case units."""
        shown = numbers[:-1] if numbers[-1] == 1.0 else numbers
        return formula(
            name, minus(product(own, rate)), minus(Product(tuple(map(figures.number, shown)))), whole
        )

    if isinstance(load, ForceVector):
        place = (answer.accelerations or {}).get((load.at, load.link))
        if given.mass is None or place is None or isinstance(place, str):
            return
        mass, scale = Name("m", load.link), units.force_per_newton / units.length_per_metre
        x, y = (figures.quantity(size, "").number for size in place)
        yield words(
            f"Link {load.link}, ", mass, " = ", figures.quantity(given.mass.value, "kg"),
            f", moves {load.at} with ", Name("a", load.at), " = (", x, ", ", y, f") {units.length}/s^2:",
        )  # fmt: skip
        for axis, size, force in zip("xy", place, (load.x.value, load.y.value), strict=True):
            if force:
                own, rate = Name(symbol.base, symbol.low + axis), Name("a", f"{load.at}{axis}")
                whole = figures.quantity(force, units.force)
                yield against(own, mass, rate, (given.mass.value, size, scale), whole)
    if isinstance(load, Torque) and load.value is not None:
        moment, spin = given.moment, (answer.angular_accelerations or {}).get(load.link)
        if moment is None or spin is None or isinstance(spin, str) or isinstance(load.value, Like):
            return
        rate, own = Name("alpha", load.link), Name("J", load.link)
        yield words(
            f"Link {load.link} has ", own, " = ", figures.quantity(moment.value, "kg*m^2"),
            " and turns with ", rate, " = ", figures.quantity(spin, "rad/s^2"), ":",
        )  # fmt: skip
        scale = units.force_per_newton * units.length_per_metre * units.torque_per_force_length
        whole = figures.quantity(load.value.value, units.torque)
        yield against(symbol, own, rate, (moment.value, spin, scale), whole)
