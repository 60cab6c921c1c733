"""Published values against found ones: one row for each value under ``expect``; of free bodies reactions,
arms, tensions, friction radii."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from icsolve.answer import Answer, Centre, Found
from icsolve.answer.bodies import Reaction, SpatialReaction
from icsolve.case import Case, Force, Number, Pair, Torque, is_angle, is_link, pair_name
from icsolve.case.expected import (
    ArmIs,
    CentreIs,
    DistanceIs,
    Expected,
    FrictionRadiusIs,
    LoadIs,
    OfBodies,
    PositionIs,
    RateIs,
    RatioIs,
    ReactionIs,
    SpeedIs,
    Target,
    TensionIs,
)
from icsolve.errors import SceneError
from icsolve.numbers import FLOATS
from icsolve.scene.parts import scene_of, sense_with
from icsolve.screws import add, cross, subtract
from icsolve.screws.space import size, spatial, times
from icsolve.statics.load_wrenches import number_taken, vector_size
from icsolve.tuples import NamedTuple
from icsolve.wording import along_or_back, direction_words, holding, way_of, with_or_against

AGREES = "agrees"
DISAGREES = "disagrees"
ERRATUM = "erratum"
NOT_EXAMINED = "not examined"

_OPPOSITE = {"ccw": "cw", "cw": "ccw"}

_SLACK = 1e-12
"""Relative room for rounding where a found value lies exactly half a unit away."""


class Row(NamedTuple):
    """One published value beside the found one, and what the comparison says."""

    key: str
    published: str
    found: str
    verdict: str
    text: str = ""


class _NotAskedError(LookupError):
    """A value that was not solved for."""


def wanted(case: Case) -> dict[str, bool]:
    """The options of `icsolve.solve` by which every published value can be compared."""
    targets = [expected.target for expected in case.expect]
    return {
        "all_centres": any(isinstance(t, CentreIs | DistanceIs) for t in targets),
        "rates": any(isinstance(t, RatioIs | RateIs | SpeedIs) for t in targets),
        "reactions": any(isinstance(t, OfBodies) for t in targets),
    }


def compare(answer: Answer) -> list[Row]:
    """Every published value of the answer's case, in the order of the file."""
    return [_row(answer, expected) for expected in answer.case.expect]


def value_of(answer: Answer, target: Target) -> tuple[float, ...]:
    """The value that a key of ``expect`` would be compared with: one number, two for the place of a centre.

    Raises LookupError, with a sentence, where the answer has no such value.
    """
    return _found(answer, Expected("", target, ()))


def _row(answer: Answer, expected: Expected) -> Row:
    published = _published(expected)
    try:
        if expected.holds is not None:
            return _verdict(expected, published, *_range(answer, expected, expected.holds))
        values = _found(answer, expected)
    except LookupError as missing:
        verdict = NOT_EXAMINED if isinstance(missing, _NotAskedError) else DISAGREES
        return Row(expected.key, published, "", verdict, str(missing))
    unit = _unit(answer, expected)
    return _verdict(expected, published + unit, _shown(values, expected) + unit, _agrees(values, expected))


def _unit(answer: Answer, expected: Expected) -> str:
    """The unit of a load whose published number is not shown as its file has it: of a pressure that is bare
    there it is another than the one in which that is read."""
    found = answer.answers.get(expected.target.load) if isinstance(expected.target, LoadIs) else None
    if found is None or expected.sense:
        return ""
    converted = (number.dimension == "pressure" and number.factor != 1.0 for number in expected.value)
    return f" {found.unit}" if any(converted) else ""


def _verdict(expected: Expected, published: str, found: str, agrees: bool) -> Row:
    if expected.erratum is None:
        return Row(expected.key, published, found, AGREES if agrees else DISAGREES)
    if agrees:
        return Row(expected.key, published, found, DISAGREES, "marked as an erratum, but the value agrees")
    return Row(expected.key, published, found, ERRATUM, expected.erratum)


def _range(answer: Answer, expected: Expected, ends: tuple[Number | None, Number | None]) -> tuple[str, bool]:
    """The range in which a load holds, and whether it is the published one: both ends, open where that is."""
    assert isinstance(expected.target, LoadIs)
    found = answer.answers.get(expected.target.load)
    if found is None or found.holds is None:
        raise LookupError(f"{expected.target.load} holds over no range: it has one value, or is given")
    agrees = all(
        math.isinf(end)
        if number is None
        else abs(end - number.value) <= _width(expected, number, abs(number.value))
        for number, end in zip(ends, found.holds, strict=True)
    )
    return _ends(*(None if math.isinf(end) else _digits(end) for end in found.holds)), agrees


def _ends(low: str | None, high: str | None) -> str:
    if low is None or high is None:
        return f"up to {high}" if high is not None else f"{low} and more" if low is not None else "all"
    return f"{low} to {high}"


def _resting(answer: Answer, path: str, expected: Expected) -> float:
    """Of the positions of equilibrium (those of the kind that is meant) the nearest to the published one."""
    if answer.positions is None:
        raise _NotAskedError("positions of equilibrium were not asked for")
    near = expected.value[0].value if expected.value else 0.0
    turn = 360.0 if is_angle(path) else math.inf
    found = []
    for position in answer.positions:
        held = position.at.get(path)
        if held is None or expected.stability not in (None, position.stability):
            continue
        low, high = (held, held) if isinstance(held, float) else held
        found.append(near + _off(near, low, high, turn))
    if not found:
        kind = f" {expected.stability}" if expected.stability else ""
        raise LookupError(f"there is no{kind} position of equilibrium with {path}")
    return min(found, key=lambda value: abs(value - near))


def _off(near: float, low: float, high: float, turn: float) -> float:
    """How far a value lies from a range, 0 within it; whole turns do not count."""
    if turn < math.inf:
        low, high = (near + math.remainder(low - near, turn) + width for width in (0.0, high - low))
    return low - near if near < low else high - near if near > high else 0.0


def _published(expected: Expected) -> str:
    if expected.holds is not None:
        return _ends(*(None if end is None else _written(end) for end in expected.holds))
    if expected.toward is not None:
        return f"toward {_written(expected.toward)}"
    numbers = ", ".join(_written(number) for number in expected.value)
    text = f"[{numbers}]" if len(expected.value) > 1 else numbers
    return f"{text} {expected.sense}" if expected.sense else text


def _written(number: Number) -> str:
    """A published number as its file writes it; in case units where it has a unit of its own."""
    return number.written(_digits)


def _shown(values: tuple[float, ...], expected: Expected) -> str:
    if expected.toward is not None:
        return f"toward {_digits(values[0])}"
    if len(values) > 1:
        return f"[{', '.join(_digits(value) for value in values)}]"
    if expected.sense in _OPPOSITE:
        return f"{_digits(abs(values[0]))} {_OPPOSITE[expected.sense] if values[0] < 0.0 else expected.sense}"
    if expected.sense and values[0] * expected.sign < 0.0:
        off = "the other way" if expected.sense in ("pull", "push") else "in another direction"
        return f"{_digits(abs(values[0]))} {off}"
    return _digits(values[0])


def _digits(value: float) -> str:
    return format(value + 0.0, ".8g")


def _agrees(values: tuple[float, ...], expected: Expected) -> bool:
    if expected.toward is not None:
        off = math.remainder(values[0] - expected.toward.value, 180.0)
        return abs(off) <= _width(expected, expected.toward, abs(expected.toward.value))
    size = max(abs(number.value) for number in expected.value)
    return all(
        abs(value - number.value) <= _width(expected, number, size)
        for value, number in zip(values, expected.value, strict=True)
    )


def _width(expected: Expected, number: Number, size: float) -> float:
    """How far the found value may lie from the published one.

    A fraction is taken of ``size``: of the number itself, of a place the larger coordinate.
    """
    if expected.within is None:
        width = number.half
    else:
        width = expected.within * (size if expected.relative else 1.0)
    return width + _SLACK * max(size, width)


def _found(answer: Answer, expected: Expected) -> tuple[float, ...]:
    """The value that the published one is about; where its sense is in words, of the published sign if it
    goes that way, else of the other."""
    match expected.target:
        case LoadIs(load):
            return (_load(answer, load, expected),)
        case PositionIs(path):
            return (_resting(answer, path, expected),)
        case CentreIs(pair):
            return _place(answer, pair, "at" if expected.toward is None else "toward")
        case DistanceIs(a, b):
            return (_distance(answer, a, b),)
        case RatioIs(over, under):
            return (_ratio(answer, over, under),)
        case RateIs(link):
            return (_turned(_rate(answer, link), expected.sense),)
        case SpeedIs(point, link):
            return (_speed(answer, point, link, expected),)
        case ReactionIs() | TensionIs() | ArmIs() | FrictionRadiusIs() as target:
            return (_of_bodies(answer, target, expected),)


def _of_bodies(answer: Answer, target: OfBodies, expected: Expected) -> float:
    if answer.reactions is None and answer.spatial is None and not isinstance(target, FrictionRadiusIs):
        if any(found.holds is not None for found in answer.answers.values()):
            raise LookupError("at rest friction leaves the reactions open: give `motion`")
        raise _NotAskedError("reactions were not asked for")
    value, sense = found_value(answer, target), expected.sense
    if sense is None or not isinstance(target, ReactionIs):
        return -value if sense == "push" else value
    if target.part == "moment":
        return _turned(value, sense)
    force, place = force_of(answer, target)
    return _going(answer, force, place, expected)


def _load(answer: Answer, name: str, expected: Expected) -> float:
    space, sense = answer.case.space, expected.sense
    loads: dict[str, Any] = {load.name: load for load in (space or answer.case).loads}
    value, load = _load_value(answer, name, loads), loads.get(name)
    found = answer.answers.get(name)
    if found is not None and found.components is not None:
        return _going(answer, found.components, answer.points.get(loads[f"{name}.x"].at), expected)
    if sense is None or load is None:
        return value
    if isinstance(load, Torque):
        return _turned(value if load.positive == "ccw" else -value, sense)
    own = found.sense if found is not None else _given_sense(answer, name, value)
    at_end = isinstance(load, Force) and not is_link(load.link)  # of a rope: away from its last pulley
    if at_end and sense not in ("pull", "push"):
        own = f"at {direction_words(heading_in(answer, name) + (0.0 if value > 0.0 else 180.0))}"
    if not own:
        return value
    places: Mapping[str, Sequence[float]] = answer.points
    if answer.spatial is not None:
        places = answer.spatial.points
    return _signed(abs(value), with_or_against(sense, own, load, places), expected)


def _signed(size: float, way: int, expected: Expected) -> float:
    """A size that goes the published way (1), the opposite (-1) or another (0), with the published sign where
    that agrees, else with the other."""
    return size * (way or -expected.sign)


def _given_sense(answer: Answer, name: str, value: float) -> str:
    """The sense of a load that the case gives, as it acts in the scene."""
    scene = scene_of(answer)
    if scene is None:
        raise _NotAskedError(f"the case gives {name}, and its sense was not worked out")
    return next(sense_with(w, value) for w in scene.outcome.balance.wrenches if w.load.name == name)


def heading_in(answer: Answer, name: str) -> float:
    """The direction of a positive force in the scene, degrees ccw from +x.

    Raises LookupError where the answer has no scene.
    """
    scene = scene_of(answer)
    if scene is None:
        raise _NotAskedError(f"the direction of {name} was not worked out")
    w = next(w for w in scene.outcome.balance.wrenches if w.load.name == name)
    return math.degrees(math.atan2(-w.unit[0], w.unit[1]))


def _turned(value: float, sense: str | None) -> float:
    """A value that is positive ccw, as positive in the sense."""
    return -value if sense == "cw" else value


def _load_value(answer: Answer, name: str, loads: Mapping[str, Any]) -> float:
    """A load's number as solved for, as given, or as another load has it; the size of one by components."""
    if name in answer.answers:
        return _found_value(name, answer.answers[name])
    own, times, number = number_taken(loads[name], loads, FLOATS) if name in loads else (name, 1.0, None)
    if number is None:
        if own not in answer.answers:
            raise LookupError(f"{name} was not solved for")
        return float(times) * _found_value(own, answer.answers[own])
    return float(times) * (number.value if isinstance(number, Number) else vector_size(number))


def _found_value(name: str, found: Found) -> float:
    if found.holds is not None:
        raise LookupError(f"{name} {holding(found, _digits)}: give `motion` for one value")
    return found.value


def _centre(answer: Answer, pair: Pair) -> Centre:
    centre = answer.centres.get(pair) or answer.centres.get((pair[1], pair[0]))
    if centre is None:
        raise LookupError(f"the centre {pair_name(answer.case, pair)} was not found")
    return centre


def _place(answer: Answer, pair: Pair, kind: str) -> tuple[float, ...]:
    centre = _centre(answer, pair)
    if centre.kind == kind:
        return centre.place
    raise LookupError(f"the centre {pair_name(answer.case, pair)} {_otherwise(centre)}")


def _otherwise(centre: Centre) -> str:
    """Where a centre is that is not where it was looked for."""
    if centre.kind == "at":
        return f"is at [{_digits(centre.place[0])}, {_digits(centre.place[1])}]"
    if centre.kind == "toward":
        return f"is at infinity, toward {_digits(centre.place[0])}: no distance and no place compare with it"
    return f"is {centre.kind}: {centre.why}"


def _distance(answer: Answer, a: Pair | str, b: Pair | str) -> float:
    """Of two places that are near to each other their rounded coordinates have few digits left: the scene has
    more."""
    near, scene = math.dist(_end(answer, a), _end(answer, b)), scene_of(answer)
    if scene is None:
        return near
    try:
        return scene.apart(a, b)
    except SceneError:  # so near to a singular position that no digits tell
        return near


def _end(answer: Answer, end: Pair | str) -> tuple[float, ...]:
    if not isinstance(end, str):
        return _place(answer, end, "at")
    return place_of(answer, end)


def _rate(answer: Answer, link: str) -> float:
    rate = (answer.rates or {}).get(link)
    if rate is None:
        raise LookupError(f"the rate of link {link} was not found")
    if isinstance(rate, str):
        raise LookupError(f"the rate of link {link} is undetermined: {rate}")
    return rate


def _ratio(answer: Answer, over: str, under: str) -> float:
    rate = _rate(answer, under)
    if rate == 0.0:
        raise LookupError(f"link {under} does not turn: w{over}/w{under} has no value")
    return _rate(answer, over) / rate


def _speed(answer: Answer, point: str, link: str, expected: Expected) -> float:
    """Magnitude of a velocity, with a sign by the way that it goes."""
    velocity = (answer.velocities or {}).get((point, link))
    if velocity is None:
        raise LookupError(f"the velocity of {point} on link {link} was not found")
    if isinstance(velocity, str):
        raise LookupError(f"the velocity of {point} on link {link} is undetermined: {velocity}")
    return _going(answer, velocity, answer.points.get(point), expected)


def _going(
    answer: Answer, vector: tuple[float, float], start: tuple[float, float] | None, expected: Expected
) -> float:
    """The size of a vector that begins at a place, with a sign by the way that it goes."""
    size, sense = math.hypot(*vector), expected.sense
    if sense is None or size == 0.0:
        return size
    way = way_of(sense, None, answer.points, start)
    if way is None:
        raise LookupError(f"no direction leads '{sense}' from there")
    own = (vector[0] / size, vector[1] / size, 0.0)
    return _signed(size, along_or_back(way, own, sense), expected)


HEADER = "| case | published, and found | agree | errata |\n|---|---|---|---|"


def table_row(case: Case, rows: list[Row]) -> str:
    """The row of one case: what it asks for, how many values agree, and what is wrong in print."""
    answers = {load.name for load in case.loads}
    asked = [row for row in rows if row.key in answers] or rows[:3]
    values = "; ".join(f"{row.key} {row.published}, {row.found}" for row in asked)
    agree = sum(row.verdict == AGREES for row in rows)
    errata = "; ".join(f"{row.key}: {row.text}" for row in rows if row.verdict == ERRATUM)
    return _table_row(case, values, f"{agree} of {len(rows)}", errata)


def row_without_answer(case: Case, status: str) -> str:
    """The row of a case that has no answer."""
    return _table_row(case, f"no answer ({status})", f"0 of {len(case.expect)}", "")


def _table_row(case: Case, *cells: str) -> str:
    label = " (reconstructed)" if case.reconstructed else ""
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in (f"{case.name}{label}", *cells)) + " |"


# --- of free bodies: reactions, arms, tensions, friction radii -----------------------------------------


def found_value(answer: Answer, target: OfBodies) -> float:
    """The value of a target about joints or ropes, in case units, in the plane or in space.

    Raises LookupError, with a sentence, where the answer has none.
    """
    match target:
        case FrictionRadiusIs(point):
            return _friction_radius(answer, point)
        case ArmIs(by, on, point):
            return _arm(answer, _reaction(answer, by, on, None), point)
        case TensionIs():
            return _tension(answer, target)
        case ReactionIs(by, on, at=at, part=part):
            return _part(_reaction(answer, by, on, at), part)


def force_of(answer: Answer, target: ReactionIs) -> tuple[tuple[float, float], tuple[float, float]]:
    """The force of a joint in the plane, of which a component alone may be meant, and where it acts [case
    units]. Raises LookupError as `found_value` does.
    """
    reaction = _reaction(answer, target.by, target.on, target.at)
    assert isinstance(reaction, Reaction)
    x, y = (0.0 if part == target.part.translate(_OTHER) else _part(reaction, part) for part in "xy")
    return (x, y), reaction.at


_OTHER = str.maketrans("xy", "yx")


def _tension(answer: Answer, target: TensionIs) -> float:
    """The pull of a rope, or of a part of it."""
    found = next(one for one in answer.tensions if one.rope == target.rope)
    if found.tension is None:
        raise LookupError(f"it is not determined: {found.why}")
    return found.parts[target.part - 1] if found.parts else found.tension


def _part(reaction: Reaction | SpatialReaction, part: str) -> float:
    """Size or component of a force or couple, or a share of it by its name."""
    parts: dict[str, float | None] = {"": reaction.magnitude, "moment": reaction.moment}
    if isinstance(reaction, Reaction):
        parts |= {"x": reaction.x, "y": reaction.y}
    else:
        parts |= dict(zip("xyz", reaction.force, strict=True))
        parts |= dict(zip(("moment x", "moment y", "moment z"), reaction.couple, strict=True))
    parts |= dict(reaction.parts)
    is_open = isinstance(reaction, Reaction) and None in (reaction.x, reaction.y)
    if part not in parts and not is_open:
        shares = ", ".join(name for name, _ in reaction.parts) or "none"
        raise LookupError(f"a {reaction.kind} has no '{part}' share; it has {shares}")
    value = parts.get(part)
    if value is None:
        raise LookupError(f"it is not determined: {reaction.why}")
    return value


def _reaction(answer: Answer, by: str, on: str, at: str | None) -> Reaction | SpatialReaction:
    """The one reaction between two links (at a point, where they have several joints)."""
    every: dict[str, Reaction | SpatialReaction] = {**(answer.reactions or {})}
    if answer.spatial is not None:
        every = {**answer.spatial.reactions}
    between = {name: r for name, r in every.items() if {r.by, r.on} == {by, on}}
    called = [r for name, r in between.items() if at is not None and name.partition("@")[2] == at]
    found = called or [r for r in between.values() if at in (None, r.where)]
    if not found:
        for joint in answer.case.joints:
            if joint.pivot and {by, on} <= {*joint.links} and at in (None, joint.at):
                first = joint.links[0]
                said = f"the pin at {joint.at} is carried by link {first}, which is named first: ask for"
                raise LookupError(f"{said} F{pair_name(answer.case, (first, by))}, or name another first")
        place = f" at {at}" if at else ""
        raise LookupError(f"links {by} and {on} have no joint{place}")
    if len(found) > 1:
        which = " or ".join(name for name, r in between.items() if r in found)
        raise LookupError(f"links {by} and {on} have {len(found)} joints: say which, {which}")
    return found[0] if (found[0].by, found[0].on) == (by, on) else found[0].reversed()


def _arm(answer: Answer, reaction: Reaction | SpatialReaction, point: str) -> float:
    """Arm of a force about a point: the size of its moment there, with its couple, over its own size.

    Where a pin of the same link rubs at the point, its reaction is tangent to the friction circle: the arm
    is to that line, as books draw it.
    """
    place = place_of(answer, point)
    force, couple = reaction.components
    rubbed = _rubbed(answer, reaction, point) if isinstance(reaction, Reaction) else 0.0
    if None in (*force, *couple):
        raise LookupError(f"the force is not determined: {reaction.why}")
    if not any(force):
        raise LookupError("the force is zero: it has no arm")
    per = answer.case.units.torque_per_force_length
    moment = cross(subtract(spatial(reaction.at), spatial(place)), force)
    whole = add(moment, times(1.0 / per, add(couple, (0.0, 0.0, rubbed))))
    return float(size(whole) / size(force))


def place_of(answer: Answer, point: str) -> tuple[float, ...]:
    """A point of an answer, in the plane or in space. Raises LookupError where it was not found."""
    points = answer.points if answer.spatial is None else answer.spatial.points
    if point not in points:
        raise LookupError(f"the point {point} was not found")
    return points[point]


def _rubbed(answer: Answer, reaction: Reaction, point: str) -> float:
    """The couples of pins at a point on the link that a force acts on, other than with the force itself."""
    total = 0.0
    for other in (answer.reactions or {}).values():
        if (
            other.kind == "pin"
            and other.where == point
            and {other.by, other.on} != {reaction.by, reaction.on}
        ):
            sign = 1.0 if other.on == reaction.on else -1.0 if other.by == reaction.on else 0.0
            total += sign * (other.moment or 0.0)
    return total


def _friction_radius(answer: Answer, point: str) -> float:
    """Radius of a pin's friction circle: its own radius times the sine of the friction angle."""
    for joint in answer.case.joints:
        if joint.pivot == point and joint.friction and joint.friction.radius:
            return float(joint.friction.radius.value * math.sin(math.atan(joint.friction.mu.value)))
    raise LookupError(f"no pin at {point} has friction")
