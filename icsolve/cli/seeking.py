"""`icsolve sweep --find`: positions to the last digit, as text or JSON."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from icsolve.errors import Status

if TYPE_CHECKING:
    from icsolve.case import Case
    from icsolve.errors import SceneError
    from icsolve.sweep.find_on_record import FoundPositions, Query

SCHEMA = "icsolve/find/1"
WORDS = ("dead", "max")
KINDS = {
    "dead": Status.DEAD_CENTRE,
    "limit": "limit",
    "change-point": Status.CHANGE_POINT,
    "max": "max",
    "value": "value",
}
"""The kinds of positions as they are written."""
NONE = {
    "dead": "no dead centre, limit or change point",
    "max": "no greatest {name}",
    "value": "{name} is nowhere {value}",
}
SAID = {
    "dead": "dead centre, no {name} balances",
    "limit": "limit, the links reach no further",
    "change-point": "change point, it can go on in more than one way",
    "max": "{name} is largest, {answer}",
    "value": "{name} = {answer}",
}


def query_of(case: Case, word: str) -> Query:
    """What to look for: ``dead``, ``max``, or ``NAME=VALUE`` with or without a unit.

    Raises RequestError for anything else, and where nothing is unknown.
    """
    from icsolve.statics.power import is_unknown
    from icsolve.sweep.find_on_record import Query
    from icsolve.sweep.request import RequestError

    unknown = next((load.name for load in case.loads if is_unknown(load)), None)
    if unknown is None:
        raise RequestError("--find looks at an unknown load, and this case has none")
    if word in WORDS:
        return Query(word, unknown)
    name, equals, value = (part.strip() for part in word.partition("="))
    if not (name and equals and value):
        raise RequestError(f"--find takes dead, max or NAME=VALUE, as {unknown}=0; {word!r} is none of these")
    return Query("value", name, _value(case, name, value))


def _value(case: Case, name: str, text: str) -> float:
    """The value in case units."""
    from icsolve.read.names import shown, suggestion
    from icsolve.sweep.request import RequestError
    from icsolve.units import UnitError, converted, kind_of, parse_unit, split_quantity

    target = _unit(case, name)
    if target is None:
        likely = suggestion(name, [load.name for load in case.loads])
        raise RequestError(f"there is no load {shown(name)}{likely}")
    try:
        parts = split_quantity(text)
        if parts is None:
            raise UnitError("there is no number")
        unit, wanted = parse_unit(parts[1] or target), parse_unit(target)
        if unit.dims != wanted.dims:
            given = kind_of(unit.dims) or "something else"
            raise UnitError(f"'{parts[1]}' is a unit of {given}, and {name} is in {target}")
        return converted(parts[0], unit, wanted)
    except (UnitError, OverflowError) as error:
        raise RequestError(f"{text!r} is no value of {name}: {error}") from None


def _unit(case: Case, name: str) -> str | None:
    """The unit of a load; None where there is none of this name."""
    from icsolve.wording.senses import unit_of

    return next((unit_of(load, case) for load in case.loads if load.name == name), None)


def as_text(case: Case, along: str, query: Query, spots: FoundPositions, digits: int) -> str:
    """A line for each position; a sentence where there is none."""
    unit = _unit(case, query.load)

    def amount(value: float | None) -> str:
        return "" if value is None else f"{value + 0.0:.{digits}g} {unit}"

    axis = f"link {along} turned by" if along in case.links else f"{along} ="
    lines = [
        f"{axis} {_plain(spot.at)}: " + SAID[spot.kind].format(name=query.load, answer=amount(spot.answer))
        for spot in spots
    ]
    what = NONE[query.kind].format(name=query.load, value=amount(query.value))
    return "\n".join(lines or [f"{what} in this range of {along}"]) + "\n"


def _plain(value: float) -> str:
    """All digits of a number, a whole one without a point."""
    return repr(value + 0.0).removesuffix(".0")


def as_json(case: Case, along: str, query: Query, spots: FoundPositions) -> str:
    """One object on one line."""
    what = f"{query.load}={_plain(query.value)}" if query.kind == "value" else query.kind
    unit = _unit(case, query.load)
    found = [
        {
            "kind": KINDS[spot.kind],
            "at": {along: spot.at + 0.0},
            "error": {along: spot.error},
            "answers": {}
            if spot.answer is None
            else {query.load: {"value": spot.answer + 0.0, "unit": unit}},
        }
        for spot in spots
    ]
    entry = {"schema": SCHEMA, "case": case.name, "status": Status.OK, "find": what, "found": found}
    if spots.notes:
        entry["notes"] = list(spots.notes)
    return json.dumps(entry, allow_nan=False) + "\n"


def refusal(case: Case, error: SceneError) -> str:
    """The object of a case in which nothing can be looked for."""
    entry = {"schema": SCHEMA, "case": case.name, "status": error.status, "message": error.message}
    return json.dumps(entry) + "\n"
