"""The equation of power: what each load does for a motion, in symbols and in this case's numbers, then
solved; one equation for every motion where several freedoms need several."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from icsolve.case import (
    Area,
    Force,
    ForceVector,
    Number,
    Spring,
    Stretch,
    TorsionSpring,
    Units,
    Weight,
)
from icsolve.explain.bodies import Rubbed, rubbed
from icsolve.explain.document import Block, Section, formula, words
from icsolve.explain.formula import Expr, Name, Num, Of, Quotient, Sum, product, solved_for, total
from icsolve.explain.worked import Worked, exerted_name, gain_names, lever, load_name
from icsolve.numbers import FLOATS, turn_of
from icsolve.report.derivation.known import Acting, Known
from icsolve.report.derivation.ratios import OneMotion, Ratios, independent_motions, speed_words
from icsolve.screws import velocity
from icsolve.statics.load_wrenches import direction
from icsolve.tuples import NamedTuple
from icsolve.wording import NOTHING, degrees_of, link_words, plain_vector


class TermEnd(NamedTuple):
    """A load at one of its two links: ``lever`` as a symbol (None for a torque) and as a number."""

    sign: int
    link: str
    lever: Name | None
    number: Num
    value: float


class ShownTerm(NamedTuple):
    """A load by ``name`` with its ends; ``gain`` is what its own unit exerts, ``factor`` its power per unit
    of it while the reference moves at 1, in the unit of the equation; ``numbers`` is that written out."""

    acting: Acting
    ends: tuple[TermEnd, ...]
    gain: tuple[Expr, ...]
    numbers: Expr
    factor: float
    name: Name

    def symbols(self, work: Worked, over: str | None = None) -> Expr:
        """The load times its levers and speeds (over the speed of a link)."""
        parts = tuple((end.sign, _moving(work, end, over)) for end in self.ends)
        whole = parts[0][1] if len(parts) == 1 else Sum(parts)
        return product(self.name, *self.gain, whole)

    @property
    def sign(self) -> int:
        """The sign in front, where the load has one end."""
        return self.ends[0].sign if len(self.ends) == 1 else 1


def _moving(work: Worked, end: TermEnd, over: str | None) -> Expr:
    motion: Expr = work.motion_name(end.link)
    if over is not None:
        motion = Num("1") if end.link == over else Quotient(motion, work.motion_name(over))
    return product(*(() if end.lever is None else (end.lever,)), motion)


def term_of(work: Worked, ratios: Ratios, acting: Acting) -> tuple[ShownTerm | None, list[Block]]:
    """A load's term and the formulas of its levers; None where all its links stand still."""
    said: list[Block] = []
    ends = []
    for sign, link in links_of(work.known, acting):
        if work.known.rests(link):
            said.append(
                words(f"{_begun(link)} stands still: ", load_name(acting.load.name), " does no work on it.")
            )
            continue
        if acting.at is None and work.known.slides(link):
            name = load_name(acting.load.name)
            said.append(words(f"{_begun(link)} does not turn: ", name, " does no work on it."))
            continue
        end, more = _end(work, ratios, acting, sign, link)
        ends.append(end)
        said += more
    if not ends:
        return None, said
    value, more = gain_of(work, acting)
    name, gain = load_name(acting.load.name), gain_names(acting.load)
    if isinstance(acting.load, Spring | TorsionSpring) and acting.value is not None and not acting.unknown:
        name, acting, said_so = sprung(work, acting, value)
        more, gain, value = [*more, *said_so], (), 1.0
    scale = conversion(work.known, ratios, acting)
    parts = tuple((end.sign, product(end.number, work.number(ratios.rates[end.link]))) for end in ends)
    whole = parts[0][1] if len(parts) == 1 else Sum(parts)
    numbers = product(*(() if not gain else (work.number(value),)), whole, work.number(scale))
    sign = ends[0].sign if len(ends) == 1 else 1
    powers = [end.sign * end.value * ratios.rates[end.link] for end in ends]
    power = sum(powers)
    if abs(power) <= NOTHING * max(map(abs, powers)):  # along a line that keeps its length
        power = 0.0
    return ShownTerm(acting, tuple(ends), gain, numbers, sign * power * value * scale, name), [*said, *more]


def _begun(link: str) -> str:
    """A link at the beginning of a sentence."""
    said = link_words(link)
    return f"{said[0].upper()}{said[1:]}"


def sprung(work: Worked, acting: Acting, value: float) -> tuple[Name, Acting, list[Block]]:
    """A spring as the force, or the moment, that it exerts."""
    torsion, stiffness = isinstance(acting.load, TorsionSpring), acting.value or 0.0
    unit = work.units.torque if torsion else work.units.force
    name = exerted_name(acting.load)
    numbers = product(work.number(stiffness), work.number(value))
    size = work.quantity(stiffness * value, unit)
    said = words("So its ", "moment" if torsion else "force", " is")
    law = formula(name, product(load_name(acting.load.name), *gain_names(acting.load)), numbers, size)
    return name, acting._replace(value=stiffness * value, unit=unit), [said, law]


def links_of(known: Known, acting: Acting) -> list[tuple[int, str]]:
    """The links on which a load acts, with their signs: the frame does no work, a clockwise torque has -1."""
    both = [(acting.sign, acting.link), (-acting.sign, acting.against)]
    return [(sign, link) for sign, link in both if link != known.case.ground]


def conversion(known: Known, ratios: Ratios, acting: Acting) -> float:
    """What brings a term to the unit of the equation: torque where the reference turns, else force."""
    ratio = known.case.units.torque_per_force_length
    torque = acting.at is None and not isinstance(
        acting.load, Force
    )  # a line load makes its couple of forces
    if known.turns(ratios.reference):
        return 1.0 if torque else ratio
    return 1.0 / ratio if torque else 1.0


def gain_of(work: Worked, acting: Acting) -> tuple[float, list[Block]]:
    """The number of what stands beside a load (`gain_names`), and how it is found."""
    load = acting.load
    if not gain_names(load):
        return 1.0, []
    (name,) = gain_names(load)
    if isinstance(load, Weight):
        weight = work.quantity(acting.gain, f"{work.units.force}/kg")
        return acting.gain, [words("A mass weighs g = ", weight, ".")]
    if isinstance(load, TorsionSpring):
        slack = acting.gain * work.units.torque_per_force_length
        size = work.quantity(slack, "rad")
        angles = (load.free.value, load.free.value - math.degrees(slack))
        begin, end = (work.number(angle) for angle in angles)
        turned = product(Sum(((1, begin), (-1, end))), Name("pi"))
        turn = formula(name, Quotient(turned, Num("180")), size)
        return slack, [words("By how much ", load_name(load.name), " is turned:"), turn]
    if isinstance(load, Force) and isinstance(load.over, Area):
        return acting.gain, _area(work, load, load.over, acting.gain)
    if isinstance(load, Force) and isinstance(load.over, Stretch) and acting.at is None:
        return _couple(work, load, load.over)
    if isinstance(load, Force) and load.over is not None:
        length = work.distance(acting.gain)
        said = words("The length over which ", load_name(load.name), " makes its resultant:")
        return acting.gain, [said, formula(name, *_tapered(work, load), length)]
    assert isinstance(load, Spring)
    a, b = work.known.points[load.at], work.known.points[load.to]
    long, free = work.length(math.dist(a, b)), work.length(load.free.value)
    stretch = formula(name, Sum(((1, long), (-1, free))), work.distance(acting.gain))
    return acting.gain, [words("The stretch of ", load_name(load.name), ":"), stretch]


def _area(work: Worked, load: Force, over: Area, gain: float) -> list[Block]:
    """The area under a pressure, and the force that a unit of the pressure makes on it."""
    name, units, size = Name("A", load.name), work.units, 0.0 if over.area is None else over.area.value
    numbers: tuple[Expr, ...] = ()
    if over.bore is not None:
        bore, rod = over.bore.value, 0.0 if over.rod is None else over.rod.value
        size = math.pi * (bore - rod) * (bore + rod) / 4.0
        squares = [(sign, Of("square", work.number(d))) for sign, d in ((1, bore), (-1, rod)) if d]
        numbers = (Quotient(product(Name("pi"), total(squares)), Num("4")),)
    area, square = work.quantity(size, f"{units.length}^2"), f"{units.force}/{units.length}^2"
    blocks: list[Block] = [words("The area of ", load_name(load.name), ":"), formula(name, *numbers, area)]
    if abs(gain - size) > 1e-9 * size:
        unit = work.quantity(gain / size, square)
        force = work.quantity(gain, f"{units.force}/{units.pressure}")
        blocks += [
            words(f"1 {units.pressure} is ", unit, ", so that"),
            formula(name, product(area.number, unit.number), force),
        ]
    return blocks


def _couple(work: Worked, load: Force, over: Stretch) -> tuple[float, list[Block]]:
    """The couple of a line load that is as large the other way at its end, for a unit of it."""
    a, b = (work.known.points[name] for name in (over.a, over.b))
    (name,), (x, y), length = gain_names(load), direction(load, work.known.points, FLOATS), math.dist(a, b)
    line, way = degrees_of((b[0] - a[0], b[1] - a[1])), degrees_of((x, y))
    between = Sum(((1, work.number(line)), (-1, work.number(way))))
    gain = length**2 / 6.0 * turn_of(line - way)[1]
    said = words(load_name(load.name), " has no resultant; a unit of it makes the couple")
    numbers = product(Quotient(Of("square", work.number(length)), Num("6")), Of("sin", between))
    return gain, [said, formula(name, numbers, work.quantity(gain, f"{work.units.length}^2"))]


def _tapered(work: Worked, load: Force) -> Iterator[Expr]:
    """The length of a load along a line that is another at its end, as far as its own number makes it."""
    if isinstance(load.over, Stretch) and load.over.end is not None and isinstance(load.value, Number):
        first, last = (work.number(number.value) for number in (load.value, load.over.end))
        mean = Quotient(Sum(((1, first), (1, last))), product(Num("2"), first))
        yield product(
            mean, work.number(math.dist(work.known.points[load.over.a], work.known.points[load.over.b]))
        )


def _end(work: Worked, ratios: Ratios, acting: Acting, sign: int, link: str) -> tuple[TermEnd, list[Block]]:
    if acting.at is None:
        return TermEnd(sign, link, None, Num("1"), 1.0), []
    low = "".join(load_name(acting.load.name))
    low = low if len(links_of(work.known, acting)) == 1 else f"{low},{link}"
    force = (load_name(acting.load.name),)
    found, said = lever(work, ratios.headings, force, low, link, acting.at, acting.direction)
    return TermEnd(sign, link, *found), said


# --- the sum of power ------------------------------------------------------------------------------------


AGREE = 1e-8
"""The terms of the equation add up to zero, but for this fraction of the largest."""
SLIDING = (
    "In equilibrium the powers of all loads add up to zero, with those of the friction L at each joint "
    "(worked out below), which acts against the given motion:"
)
ABOUT_TO = SLIDING.replace("below", "above").replace("the given motion", "the motion that is about to begin")


def power_section(work: Worked, ratios: Ratios, loads: Sequence[Acting]) -> Section | None:
    """The sum of power and the unknown load that makes it zero; None where the centres are not sharp enough
    to give it."""
    blocks: list[Block] = []
    terms: list[ShownTerm] = []
    for acting in loads:
        term, said = term_of(work, ratios, acting)
        blocks += said
        terms += [] if term is None else [term]
    friction = rubbed(work.known, ratios.reference)
    if not _agrees(terms, friction):
        return None
    sliding = SLIDING if work.case.motion else ABOUT_TO
    blocks.append(
        words("In equilibrium the powers of all loads add up to zero:" if not friction else sliding)
    )
    symbols: list[tuple[int, Expr]] = [(term.sign, term.symbols(work)) for term in terms]
    symbols += [(1, product(r.name, work.motion_name(ratios.reference))) for r in friction]
    blocks.append(formula(Sum(tuple(symbols)), Num("0")))
    blocks += _numbers(work, ratios, terms, friction)
    return Section("Power", tuple(blocks))


def _agrees(terms: Sequence[ShownTerm], friction: Sequence[Rubbed]) -> bool:
    """Whether the terms give the answer (centres that contradict each other a little do not)."""
    roots = [term for term in terms if term.acting.unknown and _is_root(term.acting)]
    if len(roots) != 1 or roots[0].acting.value is None:
        return True
    powers = [t.sign * (t.acting.value or 0.0) * t.factor for t in terms] + [r.power for r in friction]
    return abs(sum(powers)) <= AGREE * max(map(abs, powers))


def _numbers(
    work: Worked, ratios: Ratios, terms: Sequence[ShownTerm], friction: Sequence[Rubbed]
) -> Iterable[Block]:
    """A load at a time over the reference's speed, then the unknown from their sum."""
    units, reference = work.units, ratios.reference
    unit = units.torque if work.known.turns(reference) else units.force
    if any(conversion(work.known, ratios, term.acting) != 1.0 for term in terms):
        yield from torque_words(units)
    yield words("Over ", work.motion_name(reference), f", a load at a time, in {unit}:")
    for term in terms:
        yield from _term(work, reference, term, unit)
    for r in friction:
        rubs = "rate" if r.unit == units.torque else "speed"
        said = f"{r.words}, {work.show(r.value)} {r.unit}, times its {rubs} of rubbing over "
        yield words(said, work.motion_name(reference), ":")
        ratio = r.power / (r.value * r.rate) if r.value * r.rate else 1.0
        numbers = product(work.number(r.value), work.number(r.rate), work.number(ratio))
        yield formula(r.name, numbers, work.quantity(r.power, unit))
    yield from _solved(work, terms, friction)


def _term(work: Worked, reference: str, term: ShownTerm, unit: str) -> Iterable[Block]:
    """The power of a known load; of the unknown one what it is multiplied by."""
    symbols, name = term.symbols(work, over=reference), term.name
    if not term.acting.unknown:
        assert term.acting.value is not None
        power = work.quantity(term.acting.value * term.factor, unit)
        written = product(work.number(term.acting.value), term.numbers)
        yield formula(symbols, power) if written == power.number else formula(symbols, written, power)
    elif term.numbers != Num("1"):
        yield formula(symbols, product(name, term.numbers), product(name, work.number(term.factor)))


def _solved(work: Worked, terms: Sequence[ShownTerm], friction: Sequence[Rubbed]) -> Iterable[Block]:
    """The unknown load: the powers of the others with the other sign, over its factor."""
    unknown = [term for term in terms if term.acting.unknown]
    roots = [term for term in unknown if _is_root(term.acting)]
    if friction and not any(term.factor for term in unknown):
        yield from _pressing(work)
        return
    if len(roots) != 1:
        return
    root = roots[0].acting
    found = work.answer.answers[root.load.name]
    powers = [(t.sign, (t.acting.value or 0.0) * t.factor) for t in terms if not t.acting.unknown]
    powers += [(1, r.power) for r in friction]
    rest = [(-sign, work.number(power)) for sign, power in powers if power]
    factors = [(t.sign, product(work.number(_times(t.acting, root)), work.number(t.factor))) for t in unknown]
    value = work.quantity(found.value, found.unit)
    yield words("So")
    alone = len(factors) == len(rest) == 1 and factors[0][1] == Num("1")
    numbers = () if alone else (solved_for(rest, factors),)
    yield formula(load_name(root.load.name), *numbers, value)


def _pressing(work: Worked) -> Iterable[Block]:
    """The loads that do no work."""
    for name, found in work.answer.answers.items():
        yield words(load_name(name), PRESSES)
        yield formula(load_name(name), work.quantity(found.value, found.unit))


PRESSES = " does no work: it presses until friction is enough, by the equilibrium of all links (below):"


def torque_words(units: Units) -> Iterable[Block]:
    """What a unit of torque is, where it is not a force times a length of the case."""
    if units.torque_per_force_length != 1.0:
        per = f"{1.0 / units.torque_per_force_length:.12g} {units.force}*{units.length}"
        yield words(f"1 {units.torque} is {per}.")


def _is_root(acting: Acting) -> bool:
    """Whether a load's own number is asked for (another may be like it)."""
    return not isinstance(acting.load, ForceVector) and acting.load.value is None


def _times(acting: Acting, root: Acting) -> float:
    """How many times as large as the unknown one a load is."""
    return (acting.value or 0.0) / root.value if root.value else 1.0


# --- an equation for every motion ------------------------------------------------------------------------


def motions_section(work: Worked, loads: Sequence[Acting]) -> Iterable[Section]:
    """One equation a motion, where the motions are known."""
    motions = independent_motions(work.known)
    if not motions:
        return
    count = len(motions)
    freedoms = (
        "one freedom: in equilibrium the powers of all loads add up to zero."
        if count == 1
        else (f"{count} freedoms: the powers of all loads add up to zero in each of {count} motions.")
    )
    blocks: list[Block] = [words(f"The mechanism has {freedoms}")]
    blocks += torque_words(work.units)
    rows = []
    friction = rubbed(work.known, motions[0].driver) if motions[0].driver in work.known.twists else []
    if count > 1 and any(r.value for r in friction):
        yield Section("Power", (*blocks, words(SHARED)))
        return
    for n, motion in enumerate(motions, 1):
        row, said = _motion(work, loads, motion, n if count > 1 else 0)
        if row and friction:
            row += _rubbing(work.known, friction, motion)
            said[-2:] = [*(words(f"{r.words}, {work.show(r.value)} {r.unit}.") for r in friction)]
            said += [words("The sum of power:"), _summed(work, row, found=False)]
        rows.append(row)
        blocks += said
    blocks += _found(work)
    if all(acting.value is not None for acting in loads):
        blocks.append(words("With these values the sums are"))
        blocks += [_summed(work, row, found=True) for row in rows if row]
    yield Section("Power", tuple(blocks))


SHARED = (
    "Friction does work in them together; the equations of equilibrium of all links (below) give the answer."
)
Factors = list[tuple[Acting | Rubbed, float]]


def _rubbing(known: Known, friction: Sequence[Rubbed], motion: OneMotion) -> Factors:
    """The friction at each joint with its power per unit in a motion that is a multiple of the given one."""
    (x, y, w), (a, b, c) = known.twists[motion.driver], motion.twists[motion.driver]
    speed = w if motion.turns else math.hypot(x, y)
    times = c / w if motion.turns else math.copysign(math.hypot(a, b) / speed, a * x + b * y)
    per = 1.0 if motion.turns else known.case.units.torque_per_force_length
    return [(r, r.power * per * speed * times / r.value) for r in friction if r.value]


def _motion(work: Worked, loads: Sequence[Acting], motion: OneMotion, n: int) -> tuple[Factors, list[Block]]:
    """The factor of every load that does work in a motion, and their equation."""
    others = "" if n == 0 else ", the drivers of the other motions held"
    told = speed_words(motion)
    told = f"Motion {n}: {told}" if n else told[:1].upper() + told[1:]
    blocks: list[Block] = [words(f"{told}{others}.")]
    factors: Factors = []
    for acting in loads:
        factor, said = factor_of(work, acting, motion, n, work.units.torque_per_force_length)
        blocks += said
        factors += [(acting, factor)] if factor else []
    if not factors:
        return [], [*blocks, words("In this motion no load does work.")]
    return factors, [*blocks, words("The sum of power:"), _summed(work, factors, found=False)]


def _summed(work: Worked, factors: Factors, *, found: bool) -> Block:
    """The sum of power in a motion; the unknown loads by name or, once ``found``, by their numbers."""
    terms = []
    for acting, factor in factors:
        if isinstance(acting, Acting) and acting.unknown and not found:
            first: Expr = load_name(acting.load.name)
        else:
            first = work.number(acting.value or 0.0)
        terms.append((1, product(first, work.number(factor))))
    return formula(Sum(tuple(terms)), Num("0"))


def factor_of(
    work: Worked, acting: Acting, motion: OneMotion, n: int, units: float
) -> tuple[float, list[Block]]:
    """Power per unit of a load: the rate of its link, or the part of its point's velocity along it; ``units``
    of power a second for a force times a length."""
    name = Name("k", "".join(load_name(acting.load.name)) + (f",{n}" if n else ""))
    if acting.at is None:
        return _turned(work, acting, motion, name, units)
    (ax, ay), (bx, by) = (velocity(motion.twists[link], acting.at) for link in (acting.link, acting.against))
    v = plain_vector((ax - bx, ay - by))
    dx, dy = acting.direction
    value = acting.gain * (v[0] * dx + v[1] * dy) * units
    fastest = max(abs(c) for twist in motion.twists.values() for c in twist)
    size = abs(acting.gain) * max(math.hypot(*v), NOTHING * fastest) * units
    if abs(value) <= NOTHING * size or size == 0.0:
        return 0.0, []
    angle = work.number(degrees_of((dx, dy)))
    x, y = map(work.number, v)
    along = Sum(((1, product(x, Of("cos", angle))), (1, product(y, Of("sin", angle)))))
    extra = [work.number(f) for f in (acting.gain, units) if f != 1.0]
    whole = product(*extra, along) if extra else along
    said = f" has its point move at ({x.digits}, {y.digits}) {work.units.length}/s:"
    return value, [words(load_name(acting.load.name), said), formula(name, whole, work.number(value))]


def _turned(
    work: Worked, acting: Acting, motion: OneMotion, name: Name, units: float
) -> tuple[float, list[Block]]:
    on, off = plain_vector((motion.twists[acting.link][2], motion.twists[acting.against][2]))
    per = acting.gain * units  # of a torsion spring its turn
    turn = -1 if per < 0.0 else 1
    value = per * (on - off)
    if not per or abs(on - off) <= NOTHING * (abs(on) + abs(off)):
        return 0.0, []
    both = Sum(((turn, work.number(on)), (-turn, work.number(off))))
    whole = product(work.number(abs(per)), both if off else work.number(turn * on))
    return value, [formula(name, whole, work.number(value))]


def _found(work: Worked) -> Iterable[Block]:
    yield words("So")
    for name, found in work.answer.answers.items():
        sides: tuple[Expr, ...] = ()
        if found.components:  # a force of unknown direction
            parts = [load_name(f"{name}.{axis}") for axis in "xy"]
            numbers = [work.number(abs(part)) for part in found.components]
            for part, value in zip(parts, found.components, strict=True):
                yield formula(part, work.quantity(value, found.unit))
            sides = tuple(
                Of("sqrt", Sum(tuple((1, Of("square", one)) for one in some))) for some in (parts, numbers)
            )
        yield formula(load_name(name), *sides, work.quantity(found.value, found.unit))
