"""`icsolve sweep` on equilibrium: ``--find rest``, ``neutral`` and ``hold``, and positions against a load."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from icsolve.errors import SceneError, Status

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from icsolve.case import Case

    Values = npt.NDArray[np.float64]

WORDS = ("rest", "neutral", "hold")
SCHEMA = "icsolve/find/1"
NONE = {
    "rest": "the loads balance nowhere",
    "neutral": "the stability does not change",
    "hold": "it neither begins nor ceases to hold still",
}


def equilibrium_text(case: Case, word: str, along: str, values: Values, as_json: bool, digits: int) -> str:
    """What is found over the range of ``along``, as lines or as one JSON object.

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
    low, high = float(values.min()), float(values.max())
    found = _FINDERS[word](case, along, low, high)
    if as_json:
        entry = {"schema": SCHEMA, "case": case.name, "status": Status.OK, "find": word, "found": found}
        return json.dumps(entry, allow_nan=False) + "\n"
    lines = [_line(case, along, one, digits) for one in found]
    return "\n".join(lines or [f"{NONE[word]} in this range of {along}"]) + "\n"


def _rest(case: Case, along: str, low: float, high: float) -> list[dict[str, Any]]:
    from icsolve.answer.equilibrium import stiffness_dict
    from icsolve.solve.positions import find_along

    return [
        {
            "kind": "rest",
            "at": {along: rest.value + 0.0},
            "error": {along: rest.error},
            "stability": rest.stability,
            "stiffness": stiffness_dict(rest.stiffness, rest.why),
        }
        for rest in find_along(case, along, low, high)
    ]


def _neutral(case: Case, along: str, low: float, high: float) -> list[dict[str, Any]]:
    from icsolve.solve.stability import neutral_values
    from icsolve.sweep.request import RequestError

    if not along.startswith("loads."):
        raise RequestError(f"--find neutral varies a load's number, as loads.P, not {along}")
    return _turnings("neutral", along, neutral_values(case, along, low, high))


def _hold(case: Case, along: str, low: float, high: float) -> list[dict[str, Any]]:
    from icsolve.solve.stability import holding_values

    return _turnings("hold", along, holding_values(case, along, low, high))


def _turnings(kind: str, along: str, found: Any) -> list[dict[str, Any]]:
    return [
        {
            "kind": kind,
            "at": {along: one.value + 0.0},
            "error": {along: one.error},
            "from": one.before,
            "to": one.after,
        }
        for one in found
    ]


_FINDERS: dict[str, Callable[[Case, str, float, float], list[dict[str, Any]]]] = {
    "rest": _rest,
    "neutral": _neutral,
    "hold": _hold,
}


def _line(case: Case, along: str, one: Mapping[str, Any], digits: int) -> str:
    axis = f"link {along} turned by" if along in case.links else f"{along} ="
    at = repr(one["at"][along]).removesuffix(".0")
    if one["kind"] == "rest":
        stiffness = one["stiffness"]
        shown = "" if stiffness["value"] is None else f", {stiffness['value']:.{digits}g} {stiffness['unit']}"
        return f"{axis} {at}: rests, {one['stability']}{shown}"
    return f"{axis} {at}: from {one['from']} to {one['to']}"


def positions_table(case: Case, columns: Mapping[str, Values], suffix: str) -> tuple[bytes, bool]:
    """A row a position of a case with an unknown datum, for every value of what is varied; whether any has
    one.

    Raises RequestError for a form that has no rows of words.
    """
    from icsolve.sweep.request import RequestError

    if suffix not in (".csv", ".jsonl"):
        raise RequestError(f"positions are written as .csv or .jsonl, not {suffix}")
    rows = list(_rows(case, columns))
    if suffix == ".jsonl":
        text = "".join(json.dumps({k: v for k, v in row.items() if v is not None}) + "\n" for row in rows)
    else:
        out = io.StringIO()
        header = list(dict.fromkeys(key for row in rows for key in row))
        table = csv.DictWriter(out, header, lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
        text = out.getvalue()
    return text.encode(), any(row["status"] == Status.OK for row in rows)


def _rows(case: Case, columns: Mapping[str, Values]) -> Iterator[dict[str, Any]]:
    from icsolve.solve import solve
    from icsolve.sweep.numbers import find_number, with_numbers

    own = {find_number(case, path).path: path for path in columns}
    for numbers in zip(*(columns[path].tolist() for path in own.values()), strict=True):
        varied = dict(zip(own.values(), numbers, strict=True))
        try:
            found = solve(with_numbers(case, dict(zip(own, numbers, strict=True)))).positions or ()
        except SceneError as refusal:
            yield {**varied, "status": refusal.status}
            continue
        for one in found:
            at: dict[str, Any] = {}
            for path, value in one.at.items():
                if isinstance(value, tuple):
                    at |= {f"{path} from": value[0], f"{path} to": value[1]}
                else:
                    at[path] = value
            stiffness = one.stiffness.value if one.stiffness is not None else None
            yield {**varied, "status": Status.OK, **at, "stability": one.stability, "stiffness": stiffness}
