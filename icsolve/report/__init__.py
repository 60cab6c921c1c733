"""An answer as text for people: the unknown with its unit and its sense in words, and why; free bodies."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import combinations
from typing import TYPE_CHECKING, Any

from icsolve.answer import Answer, Centre, Found, Term
from icsolve.case import Case, Pair, Torque, Units, is_angle, is_named, link_order, pair_name
from icsolve.scene.parts import scene_of
from icsolve.statics.power import has_friction
from icsolve.tuples import replace
from icsolve.wording import NOTHING, SPELT, holding, plain_vector, spelt

if TYPE_CHECKING:
    from icsolve.answer.bodies import FrictionFound, Reaction, Rubbing, Spatial, SpatialReaction, Witness
    from icsolve.answer.equilibrium import EquilibriumPosition, Stiffness

Format = Callable[[float], str]
"""A number with the digits that were asked for."""


def answer_text(answer: Answer, digits: int = 6) -> str:
    """The answer in lines, each section apart by an empty line; numbers to ``digits`` digits."""
    show = _formatter(digits)
    case = answer.case
    sections = [
        _title(case),
        _unknowns(answer, digits),
        positions_text(answer, digits),
        *_in_positions(answer, digits),
        _points(answer, show),
        _centres(answer, digits),
        _power(answer, digits),
        _rates(answer, digits),
        _velocities(answer, digits),
        _accelerations(answer, show),
        _bodies(answer, show),
        _sentences("Notes", answer.notes),
        _sentences("Not examined", answer.skipped),
    ]
    return "\n\n".join("\n".join(lines) for lines in sections if lines)


def _formatter(digits: int) -> Format:
    def show(value: float) -> str:
        rounded = float(format(value, f".{digits}g")) + 0.0
        return format(rounded, f".{max(digits, 12)}g")

    return show


def _title(case: Case) -> list[str]:
    lines = [case.title or case.name]
    if case.source:
        lines.append(f"Source: {case.source}")
    if case.reconstructed:
        lines.append(f"RECONSTRUCTED: {case.reconstructed}")
    return lines


def _unknowns(answer: Answer, digits: int) -> list[str]:
    lines = [_unknown(answer.case, name, found, digits) for name, found in answer.answers.items()]
    if answer.advantage is None:
        return lines
    least = min((certain_digits(found, digits) for found in answer.answers.values()), default=digits)
    return [*lines, _advantage(answer, answer.advantage, _formatter(least))]


def positions_text(answer: Answer, digits: int) -> list[str]:
    """Where it rests: a line a position with what becomes of a small push."""
    lines = []
    for position in answer.positions or ():
        at = place_text(answer.case, position, digits)
        lines.append(f"{at}{_kind(position.stability, position.stiffness, position.why, digits)}")
    if answer.stability is not None:
        kind = _kind(answer.stability, answer.stiffness, answer.why_no_stiffness, digits)
        lines.append(f"the position as written{kind}")
    return lines


def _in_positions(answer: Answer, digits: int) -> Iterable[list[str]]:
    """What was asked of the scene in each position, section by section under where it is."""
    show = _formatter(digits)
    for position in answer.positions or ():
        scene = _without_rounding(position.answer)
        asked = [section(scene, digits) for section in (_centres, _rates, _velocities)]
        if any((*asked, forces := _bodies(scene, show))):
            yield [f"In the position {place_text(answer.case, position, digits)}"]
            yield from (*asked, forces)


def _without_rounding(scene: Answer) -> Answer:
    """A scene in a position of equilibrium, which is a double, without what its rounding leaves of zeros."""
    vectors = {key: v for key, v in (scene.velocities or {}).items() if not isinstance(v, str)}
    fastest = max((math.hypot(*v) for v in vectors.values()), default=0.0)
    size = max((math.dist(*two) for two in combinations(scene.points.values(), 2)), default=1.0)

    def placed(centre: Centre) -> Centre:
        if centre.kind != "at":
            return centre
        if NOTHING * math.hypot(*centre.place) > size:
            x, y = plain_vector(centre.place)
            return centre._replace(kind="toward", place=(math.degrees(math.atan2(y, x)) % 180.0,))
        return centre._replace(place=plain_vector(centre.place, size))

    velocities = {**(scene.velocities or {}), **{key: plain_vector(v, fastest) for key, v in vectors.items()}}
    centres = {pair: placed(centre) for pair, centre in scene.centres.items()}
    return replace(scene, velocities=velocities, centres=centres)


def place_text(case: Case, position: EquilibriumPosition, digits: int) -> str:
    """The free data of a position: ``angles.AB = 42.7786 deg``."""
    return ", ".join(
        f"{path} {_held(case, path, value, position.error[path], digits)}"
        for path, value in position.at.items()
    )


def _held(case: Case, path: str, value: Any, error: Any, digits: int) -> str:
    """A datum's value, or the range in which friction holds, with its unit."""
    unit = "deg" if is_angle(path) else case.units.length
    values, errors = (value, error) if isinstance(value, tuple) else ((value,), (error,))
    shown = [_formatter(_certain(v, e, digits))(v) for v, e in zip(values, errors, strict=True)]
    return f"= {shown[0]} {unit}" if len(shown) == 1 else f"holds still from {shown[0]} to {shown[1]} {unit}"


def _kind(stability: str | None, stiffness: Stiffness | None, why: str, digits: int) -> str:
    """``: stable (stiffness 232.445 N*m/rad)``."""
    if stability is None:
        return ""
    if stiffness is None:
        return f": {stability} ({why.rstrip('.')})" if why else f": {stability}"
    values, units, show = stiffness.value, stiffness.unit, _formatter(digits)
    rows = [([values], [units])] if isinstance(values, float) else zip(values, units, strict=True)
    least = stiffness.error or 0.0
    cells = [[f"{show(v if abs(v) > least else 0.0)} {u}" for v, u in zip(*row, strict=True)] for row in rows]
    return f": {stability} (stiffness {'; '.join(', '.join(row) for row in cells)})"


def _advantage(answer: Answer, advantage: float, show: Format) -> str:
    """The unknown over the known load, by name; a mechanical advantage where both are of one kind."""
    units = {term.load: term.unit for term in answer.terms}
    known = [term.load for term in answer.terms if term.load not in answer.answers and " " not in term.load]
    names = [*answer.answers, *known]
    above, below = (units.get(name, "") for name in (names[0], names[-1]))
    told = f"{'/'.join(names)} = {show(advantage)}"
    if above != below:
        return f"{told} {above} per {below}"
    return f"{told} (mechanical advantage, where {names[0]} is the output)"


def _unknown(case: Case, name: str, found: Found, digits: int) -> str:
    """One line: size, unit and sense; the signed value where the sign is not plus."""
    show = _formatter(certain_digits(found, digits))
    if found.holds is not None:
        return f"{name}: {holding(found, show)}"
    line = f"{name} = {show(abs(found.value))} {found.unit}".rstrip()
    if found.sense:
        line += f", {spelt(found.sense)}"
    if found.value < 0.0:
        line += f"   ({name} = {show(found.value)}, {_positive(case, name)})"
    return line


def certain_digits(found: Found, digits: int) -> int:
    """How many digits to show: those asked for, but none that the error bound leaves open."""
    ends = [abs(end) for end in found.holds or (found.value,) if math.isfinite(end)]
    return _certain(max(ends, default=0.0), found.error, digits)


def _certain(value: float, error: float | None, digits: int) -> int:
    """How many of the digits of a number its error bound leaves certain, at least one."""
    if not error or not value or not math.isfinite(value) or not math.isfinite(error):
        return digits
    first = math.floor(math.log10(abs(value))) + 1
    return max(1, min(digits, math.floor(first - math.log10(2.0 * error))))


def _shown(value: float, error: float | None, digits: int) -> str:
    """A number with the digits that its error bound leaves certain."""
    return _formatter(_certain(value, error, digits))(value)


def _positive(case: Case, name: str) -> str:
    """What a plus sign means for the load of that name."""
    load = next((load for load in case.loads if load.name == name), None)
    if isinstance(load, Torque):
        return f"positive {SPELT[load.positive]}"
    return "positive along its line as the case gives it"


def _centres(answer: Answer, digits: int) -> list[str]:
    if not answer.centres:
        return []
    case = answer.case
    rows = (
        (f"I{pair_name(case, pair)}", _place(centre, digits), _how(case, centre))
        for pair, centre in answer.centres.items()
    )
    return ["Instant centres", *table(rows)]


def _place(centre: Centre, digits: int) -> str:
    if centre.kind == "at":
        shows = [_formatter(_certain(value, centre.error, digits)) for value in centre.place]
        x, y = (show(value) for value, show in zip(centre.place, shows, strict=True))
        return f"({x}, {y})"
    if centre.kind == "toward":
        return f"at infinity, toward {_shown(centre.place[0], centre.error, digits)} deg"
    return f"{centre.kind}: {centre.why}"


def _how(case: Case, centre: Centre) -> str:
    """How a centre was found, in words."""
    if len(centre.lines) == 1 and len(centre.lines[0]) > 1:  # a line through one place is any
        return f"in the place of {_line(case, centre.lines, 0).removeprefix('line ').replace(' ', ' and ')}"
    if centre.lines:
        return "where " + " meets ".join(_line(case, centre.lines, n) for n in range(len(centre.lines)))
    return {"inspection": "a joint", "given": "given by the case"}.get(centre.by, centre.by)


def _line(case: Case, lines: Sequence[tuple[Pair, ...]], number: int) -> str:
    if len(lines[number]) == 1:
        from icsolve.wording.joints import joint_of_normal, normal_name

        return f"the {normal_name(joint_of_normal(case, lines, number))}"
    ends = sorted(lines[number], key=lambda pair: sorted(link_order(case, link) for link in pair))
    return "line " + " ".join(f"I{pair_name(case, pair)}" for pair in ends)


def _power(answer: Answer, digits: int) -> list[str]:
    if not answer.terms:
        return []
    error = _power_error(answer)
    rows = [_term(answer, term, _certain(term.power, error, digits), digits) for term in answer.terms]
    summed = _sum_of_powers(answer, _formatter(digits))
    return [f"Power in {answer.case.units.torque}/s: {summed}", *table(rows)]


def _power_error(answer: Answer) -> float:
    """What is open of the powers that unknowns balance: by the bounds of these, and by what is left over
    where an answer was confirmed in more digits than the terms have."""
    unknown = [(term, answer.answers[term.load]) for term in answer.terms if term.load in answer.answers]
    left = abs(math.fsum(term.power for term in answer.terms)) if unknown else 0.0
    return max([left, *(abs(term.factor) * (found.error or 0.0) for term, found in unknown)])


def _sum_of_powers(answer: Answer, show: Format) -> str:
    """What the terms add up to: zero where an unknown balances them; else it shows whether known loads do."""
    scene, unit = scene_of(answer), answer.case.units.torque_per_force_length
    if answer.answers:
        return "the terms add up to zero"
    if scene is None:
        return f"the terms add up to {show(math.fsum(term.power for term in answer.terms) * unit)}"
    if has_friction(answer.case):
        return f"without friction the terms add up to {show(scene.sum_of_powers() * unit)}"
    if scene.in_equilibrium:
        return "the terms add up to zero, the loads are in equilibrium"
    within = [one.within for one in scene.left_over]
    why = f"which is within {within[0]}" if all(within) else "the loads are not in equilibrium"
    return f"the terms add up to {show(scene.sum_of_powers() * unit)}, {why}"


def _term(answer: Answer, term: Term, certain: int, digits: int) -> tuple[str, str, str]:
    """A load times its velocity is its power, in torque units a second; so many digits are certain."""
    units, show = answer.case.units, _formatter(certain)
    load = answer.answers.get(term.load)
    value = _formatter(certain_digits(load, digits) if load else digits)(term.value)
    power, factor = (number * units.torque_per_force_length for number in (term.power, term.factor))
    velocity = f"{show(factor)} per {term.unit}"
    if term.unit == units.torque:
        velocity = f"{show(factor)} rad/s"
    elif term.unit == units.force:
        velocity = f"{show(term.factor)} {units.length}/s"
    product = f"{value} {term.unit} x {velocity} = {show(power)}"
    return (term.load, product, term.words.removeprefix(f"{term.load} "))


def _rates(answer: Answer, digits: int) -> list[str]:
    if answer.rates is None:
        return []
    unit = "Angular velocities, rad/s" if _has_speed(answer.case) else "Angular velocities, scaled"
    errors = answer.errors.get("rates", {})
    rows = []
    for link, rate in answer.rates.items():
        certain = digits if isinstance(rate, str) else _certain(abs(rate), errors.get(link), digits)
        rows.append((f"w{link}", _signed(rate, _formatter(certain))))
    return [unit, *table(rows)]


def _has_speed(case: Case) -> bool:
    return any(motion.speed is not None for motion in case.motion)


def _velocities(answer: Answer, digits: int) -> list[str]:
    if not answer.velocities:
        return []
    error = _velocity_error(answer)
    rows = _vectors(answer.velocities, lambda value: _shown(value, error, digits))
    unit = f"{answer.case.units.length}/s" if _has_speed(answer.case) else "scaled"
    return [f"Velocities, {unit}", *table(row for key, row in rows if is_named(key[0]))]


def _vectors(
    vectors: Mapping[tuple[str, str], tuple[float, float] | str], show: Format
) -> Iterable[tuple[tuple[str, str], tuple[str, str]]]:
    """Rows of vectors at points of links; of one that is open why."""
    for (point, link), v in vectors.items():
        told = f"undetermined: {v}" if isinstance(v, str) else _vector(v, show)
        yield (point, link), (f"{point} on {link}", told)


def _vector(parts: Iterable[float | None], show: Format) -> str:
    """Components in brackets, question marks for those that equilibrium leaves open."""
    return f"({', '.join(_number(part, show) for part in parts)})"


def _accelerations(answer: Answer, show: Format) -> list[str]:
    """Accelerations of links and points, where the inertia forces of the motion are among the loads."""
    if answer.angular_accelerations is None or answer.accelerations is None:
        return []
    turning = ((f"a{link}", _signed(a, show)) for link, a in answer.angular_accelerations.items())
    lines = ["Angular accelerations, rad/s^2", *table(turning)]
    points = [row for _, row in _vectors(answer.accelerations, show)]
    if not points:
        return lines
    return [*lines, "", f"Accelerations, {answer.case.units.length}/s^2", *table(points)]


def _signed(rate: float | str, show: Format) -> str:
    """A rate with its sense in words."""
    if isinstance(rate, str):
        return f"undetermined: {rate}"
    return f"{show(abs(rate))} {'ccw' if rate > 0.0 else 'cw'}" if rate else "0"


def _velocity_error(answer: Answer) -> float:
    """What the bounds of the rates leave open of velocities: the same part of the largest."""
    rates = [abs(rate) for rate in (answer.rates or {}).values() if isinstance(rate, float)]
    speeds = [abs(c) for v in (answer.velocities or {}).values() if not isinstance(v, str) for c in v]
    turning, fastest = max(rates, default=0.0), max(speeds, default=0.0)
    open_ = max(answer.errors.get("rates", {}).values(), default=0.0)
    return open_ / turning * fastest if turning else 0.0


def _points(answer: Answer, show: Format) -> list[str]:
    """The points that the figure's data, and not their coordinates, determine."""
    given, found = answer.case.given_places, answer.shown_points
    rows = [(name, _vector(p, show)) for name, p in found.items() if name not in given]
    return [f"Points found, {answer.case.units.length}", *table(rows)] if rows else []


def _sentences(title: str, sentences: Iterable[str]) -> list[str]:
    lines = [f"  {sentence}" for sentence in sentences]
    return [title, *lines] if lines else []


def table(rows: Iterable[Sequence[str]]) -> list[str]:
    """Rows of entries as lines, each column as wide as its widest entry."""
    rows = list(rows)
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    padded = ((entry.ljust(width) for entry, width in zip(row, widths, strict=True)) for row in rows)
    return [f"  {'  '.join(row)}".rstrip() for row in padded]


# --- free bodies, in the plane and in space --------------------------------------------------------------


def _bodies(answer: Answer, show: Format) -> list[str]:
    """Reactions, friction, and the unknown loads by free bodies."""
    if answer.spatial is not None:
        return _space(answer, answer.spatial, show)
    if answer.reactions is None and answer.friction is None:
        return []
    blocks = [_reactions(answer, show), _bars(answer, show), _tensions(answer, show)]
    if answer.friction is not None:
        blocks.append(_friction(answer.friction, answer.case.units, show))
    blocks.append(_witnesses(answer.witnesses, show))
    return "\n\n".join("\n".join(lines) for lines in blocks if lines).splitlines()


def _reactions(answer: Answer, show: Format) -> list[str]:
    """A line for each joint: components, size and direction, couple."""
    if not answer.reactions:
        return []
    couples = any(reaction.moment for reaction in answer.reactions.values())
    rows = ((name, *_columns(reaction, show)) for name, reaction in answer.reactions.items())
    return [_title_of_forces(answer.case.units, couples), *table(rows)]


def _bars(answer: Answer, show: Format) -> list[str]:
    """A line for each bar that two forces pull or push."""
    if not answer.reactions:
        return []
    from icsolve.report.derivation.known import bars_of

    rows = [(f"link {link}", f"{show(abs(f))}", axial_words(f)) for link, f in bars_of(answer).items()]
    return [f"Bars, {answer.case.units.force}: the force along each", *table(rows)] if rows else []


def axial_words(force: float) -> str:
    """Whether a bar is pulled or pushed."""
    return "tension" if force > 0.0 else "compression" if force else "no force"


def _title_of_forces(units: Units, couples: bool) -> str:
    unit = f"{units.force}; couples in {units.torque}" if couples else units.force
    return f"Reactions, {unit}: the force of the first link on the second"


def _space(answer: Answer, spatial: Spatial, show: Format) -> list[str]:
    """A line for each joint in space: components, size, couple and shares; then the witness."""
    couples = any(map(_has_couple, spatial.reactions.values()))
    rows = ((name, _vector(r.force, show), _shares(r, show)) for name, r in spatial.reactions.items())
    lines = [f"{_title_of_forces(answer.case.units, couples)}, along x, y, z", *table(rows)]
    return [*lines, "", *_witnesses(spatial.witnesses, show)] if spatial.witnesses else lines


def _has_couple(reaction: SpatialReaction) -> bool:
    return any(part is None or part != 0.0 for part in reaction.couple)


def _shares(reaction: SpatialReaction, show: Format) -> str:
    size = "" if reaction.magnitude is None else f"= {show(reaction.magnitude)}; "
    couple = f", couple {_vector(reaction.couple, show)}" if _has_couple(reaction) else ""
    parts = "".join(f", {name} {_number(part, show)}" for name, part in reaction.parts)
    return f"{size}{reaction.kind} at {reaction.where}{couple}{parts}"


def _tensions(answer: Answer, show: Format) -> list[str]:
    """A line for each rope: its pull, or that of each of its parts."""
    if not answer.tensions:
        return []
    pulls = ((tension.name, tension.parts or (tension.tension,)) for tension in answer.tensions)
    rows = ((name, ", ".join(_number(pull, show) for pull in each)) for name, each in pulls)
    return [f"Pulls of ropes, {answer.case.units.force}", *table(rows)]


def _columns(reaction: Reaction, show: Format) -> tuple[str, str, str]:
    """The force by components, by size and direction, and what goes with it."""
    size = "" if reaction.magnitude is None else f"= {show(reaction.magnitude)}"
    if reaction.direction is not None:
        size += f" at {show(reaction.direction)} deg"
    place = f"{reaction.kind} at {reaction.where}" if reaction.where else reaction.kind
    couple = "" if reaction.moment == 0.0 else f", couple {_number(reaction.moment, show)}"
    parts = "".join(f", {name} {show(value)}" for name, value in reaction.parts if value)
    return _vector((reaction.x, reaction.y), show), size, f"{place}{couple}{parts}"


def _friction(friction: FrictionFound, units: Units, show: Format) -> list[str]:
    """A line for each rub, what friction takes, and the efficiency."""
    rows = [_rub(rub, units, show) for rub in friction.rubbing]
    lines = ["Friction", *table(rows)] if rows else []
    if friction.efficiency is not None:
        lines.append(f"Efficiency {show(100.0 * friction.efficiency)} % (power out over power in)")
    return lines


def _rub(rub: Rubbing, units: Units, show: Format) -> tuple[str, str, str]:
    place = f"{rub.kind} {rub.joint[1:]}" + (f" at {rub.where}" if rub.where else "")
    unit = units.torque if rub.kind == "pin" else units.force
    circle = f", friction circle {show(rub.radius)} {units.length}" if rub.radius is not None else ""
    loss = show(rub.loss * units.torque_per_force_length)
    return place, f"{show(abs(rub.value))} {unit}", f"takes {loss} {units.torque}/s{circle}"


def _number(value: float | None, show: Format) -> str:
    return "?" if value is None else show(value)


def _witnesses(witnesses: Sequence[Witness], show: Format) -> list[str]:
    """A line for each unknown load, in the plane and in space."""
    lines = []
    for w in witnesses:
        apart = f"{abs(w.difference):.1e} apart" if w.difference else "no difference"
        bound = (
            f"rounding may make {w.bound:.1e}" if math.isfinite(w.bound) else "with no bound on the rounding"
        )
        lines.append(f"  {w.load} = {show(w.bodies)}, by power {show(w.power)}: {apart}, {bound}")
    return ["By the equilibrium of the links alone", *lines] if lines else []
