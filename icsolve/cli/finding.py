"""`icsolve sweep --find`: positions to the last digit, as text or JSON."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from icsolve.cli.run import json_text
from icsolve.errors import Status
from icsolve.tuples import NamedTuple

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from icsolve.case import Case
    from icsolve.solve.stability import MovingLoads, TurningPower
    from icsolve.sweep.find_on_record import Query

    Values = npt.NDArray[np.float64]

SCHEMA = "icsolve/find/1"
WORDS = ("dead", "max")
EQUILIBRIUM = ("rest", "neutral", "hold")
"""Of loads that are all known."""
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
    "max": "{name} peaks nowhere",
    "value": "{name} is nowhere {value}",
    "rest": "the loads balance nowhere",
    "neutral": "the stability does not change",
    "hold": "it neither begins nor ceases to hold still",
}
SAID = {
    Status.DEAD_CENTRE: "dead centre, no {name} balances",
    "limit": "limit, the links reach no further",
    Status.CHANGE_POINT: "change point, it can go on in more than one way",
    "max": "{name} is largest, {answer}",
    "value": "{name} = {answer}",
    "rest": "rests, {stability}{stiffness}",
    "neutral": "from {from} to {to}",
    "hold": "from {from} to {to}",
}


class Finding(NamedTuple):
    """What was looked for along a number or a link, and an entry for each position.

    Attributes
    ----------
    kind : of what was looked for
    load : whose values the entries have
    value : that is looked for [``unit``]
    """

    kind: str
    along: str
    found: Sequence[Mapping[str, Any]]
    load: str = ""
    value: float = 0.0
    unit: str | None = None
    notes: Sequence[str] = ()


def finding(case: Case, word: str, varied: Mapping[str, Values], driven: Mapping[str, Values]) -> Finding:
    """What ``--find WORD`` finds over the range of the main number or link.

    Raises RequestError for a word that means nothing for this case.
    """
    from icsolve.sweep.request import along_of, columns_of

    columns = columns_of(case, varied, driven)
    own = along_of(case, columns)
    if word in EQUILIBRIUM:
        values = columns.arrays[own]
        return _equilibrium(case, word, own, float(values.min()), float(values.max()))
    return _places(case, word, columns.names[own], varied, driven)


def as_json(case: Case, one: Finding) -> str:
    """One object on one line."""
    what = f"{one.load}={_plain(one.value)}" if one.kind == "value" else one.kind
    entry = {"schema": SCHEMA, "case": case.name, "status": Status.OK, "find": what, "found": one.found}
    if one.notes:
        entry["notes"] = list(one.notes)
    return json_text(entry) + "\n"


def as_text(case: Case, one: Finding, digits: int) -> str:
    """A line for each position; a sentence where there is none."""
    axis = f"link {one.along} turned by" if one.along in case.links else f"{one.along} ="
    lines = [
        f"{axis} {_plain(entry['at'][one.along])}: {SAID[entry['kind']].format(**_words(entry, one, digits))}"
        for entry in one.found
    ]
    none = NONE[one.kind].format(name=one.load, value=f"{one.value + 0.0:.{digits}g} {one.unit}")
    return "\n".join(lines or [f"{none} in this range of {one.along}"]) + "\n"


def _words(entry: Mapping[str, Any], one: Finding, digits: int) -> dict[str, Any]:
    """What the sentence of an entry names."""
    answers, stiffness = entry.get("answers", {}), entry.get("stiffness")
    return {
        **entry,
        "name": one.load,
        "answer": "".join(f"{a['value']:.{digits}g} {a['unit']}" for a in answers.values()),
        "stiffness": "" if stiffness is None else f", {stiffness['value']:.{digits}g} {stiffness['unit']}",
    }


def _plain(value: float) -> str:
    """All digits of a number, a whole one without a point."""
    return repr(value + 0.0).removesuffix(".0")


# --- dead centres, peaks and values of an unknown load --------------------------------------------------


def _places(
    case: Case, word: str, along: str, varied: Mapping[str, Values], driven: Mapping[str, Values]
) -> Finding:
    from icsolve.sweep.find_on_record import find

    query = _query(case, word)
    unit = _unit(case, query.load)
    spots = find(case, varied, query, drive=driven)
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
    return Finding(query.kind, along, found, query.load, query.value, unit, spots.notes)


def _query(case: Case, word: str) -> Query:
    """What to look for: ``dead``, ``max``, or ``NAME=VALUE`` with or without a unit.

    Raises RequestError for anything else, and where nothing is unknown.
    """
    from icsolve.statics.power import is_unknown
    from icsolve.sweep.find_on_record import Query
    from icsolve.sweep.request import RequestError

    unknown = next((load.name for load in case.loads if is_unknown(load)), None)
    if unknown is None:
        raise RequestError(
            "--find looks at an unknown load, and this case has none; of loads that are all known it "
            "finds rest, neutral and hold"
        )
    if word in WORDS:
        return Query(word, unknown)
    name, equals, value = (part.strip() for part in word.partition("="))
    if not (name and equals and value):
        raise RequestError(
            f"--find takes dead, max or NAME=VALUE, as {unknown}=0 (of loads that are all known rest, "
            f"neutral or hold); {word!r} is none of these"
        )
    return Query("value", name, _value(case, name, value))


def _value(case: Case, name: str, text: str) -> float:
    """The value in case units."""
    from icsolve.numbers.units import UnitError, converted, kind_of, parse_unit, split_quantity
    from icsolve.read.names import shown, suggestion
    from icsolve.sweep.request import RequestError
    from icsolve.wording import listed

    target = _unit(case, name)
    if target is None:
        names = [load.name for load in case.loads]
        if name in case.directed:
            raise RequestError(f"{name} has a size and a direction: find a value of {name}.x or of {name}.y")
        likely = suggestion(name, names) or (f"; the loads are {listed(names)}" if names else "")
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
        likely = f"; `--find max` finds where {name} is largest" if text in ("max", "min") else ""
        raise RequestError(f"{text!r} is no value of {name}: {error}{likely}") from None


def _unit(case: Case, name: str) -> str | None:
    """The unit of a load; None where there is none of this name."""
    from icsolve.wording import unit_of

    return next((unit_of(load, case) for load in case.loads if load.name == name), None)


# --- equilibrium of loads that are all known ------------------------------------------------------------


def _equilibrium(case: Case, word: str, along: str, low: float, high: float) -> Finding:
    """``rest``, ``neutral`` or ``hold``.

    Raises RequestError where the case has an unknown load, or another number than a load's is varied for
    ``neutral``.
    """
    from icsolve.statics.power import is_unknown
    from icsolve.sweep.request import RequestError

    unknown = next((load.name for load in case.loads if is_unknown(load)), None)
    if unknown is not None:
        raise RequestError(f"--find {word} asks of loads that are all known, and {unknown} is unknown")
    if case.unknowns:
        raise RequestError(
            f"{case.unknowns[0].path} is unknown: `icsolve solve` lists the positions of equilibrium"
        )
    if word == "neutral" and not along.startswith("loads."):
        raise RequestError(f"--find neutral varies a load's number, as loads.P, not {along}")
    if word == "hold" and along in case.links:
        raise RequestError(
            "--find hold varies a number of the case, as --vary angles.AB=0:90:1, and turns no link: vary "
            f"what poses link {along}"
        )
    places, notes = _found(case, word, along, low, high)
    found = [
        {"kind": word, "at": {along: one.value + 0.0}, "error": {along: one.error}, **told}
        for one, told in places
    ]
    return Finding(word, along, found, notes=tuple(notes))


FRICTIONLESS = (
    "friction is left out here: with it the mechanism rests over ranges, whose ends `--find hold` gives."
)


LEFT = (
    "{where}, where it is said to slip, it may still hold if friction was left the other way round at some "
    "joint."
)


def _found(
    case: Case, word: str, along: str, low: float, high: float
) -> tuple[list[tuple[Any, dict[str, Any]]], list[str]]:
    """Each place with what is told of it, and sentences on what is left out or what the places do not say."""
    if word == "rest":
        from icsolve.answer.equilibrium import stability_dict
        from icsolve.solve.positions import find_along
        from icsolve.statics.power import has_friction

        rests, notes = find_along(case, along, low, high)
        told = [(one, stability_dict(one.stability, one.stiffness, one.why)) for one in rests]
        return told, [*notes, *([FRICTIONLESS] if has_friction(case) else [])]
    from icsolve.solve.stability import holding_values, loads_along, neutral_values

    if word == "neutral":
        changes, notes = neutral_values(case, along, low, high), []
    else:
        loads = loads_along(case, along)
        changes = holding_values(case, along, low, high, loads)
        notes = list(_of_holding(case, along, (low, high), changes, loads))
    return [(change, {"from": change.before, "to": change.after}) for change in changes], notes


def _of_holding(
    case: Case, along: str, span: tuple[float, float], changes: Sequence[TurningPower], loads: MovingLoads
) -> Iterator[str]:
    """What is so where nothing changes, and where it hangs on how friction was left."""
    from icsolve.solve.stability import CUTS, is_still, left_along

    if not changes:
        whole = along.count(".") == 1 and along.startswith("loads.")  # its range is one of `solve`
        where = "throughout" if whole else f"at all {CUTS + 1} places that were looked at"
        yield f"it {'holds still' if is_still(case, along, span[0], loads) else 'slips'} {where}."
    for ends in left_along(*span, changes, loads):
        low, high = (f"{end:.6g}" for end in ends)
        where = f"beside {along} = {low}" if low == high else f"from {along} = {low} to {high}"
        yield LEFT.format(where=where)
