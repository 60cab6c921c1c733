"""The numbers of a case in which variables stand, as arrays over many draws."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from icsolve.case import Case, Number
from icsolve.read.document import Mapping as Tree
from icsolve.read.document import Node, Scalar, parse
from icsolve.read.document import Sequence as Items
from icsolve.read.formula import names_in, replaced
from icsolve.read.problems import Problems
from icsolve.sense import unit_of
from icsolve.turn.numbers import numbers_of
from icsolve.units import Unit, converted, parse_unit, split_quantity

Array = npt.NDArray[np.float64]
Values = Mapping[str, str]
"""What was drawn for each variable, as text."""
_FREE = ("title", "source", "reconstructed", "variables", "units", "icsolve", "expect")


class UnsuitedError(ValueError):
    """A case whose variants can't be taken together; each is then a scene of its own."""


class Written(NamedTuple):
    """One number with variables in it: its path, its text, and the unit in which it is kept."""

    path: str
    text: str
    names: tuple[str, ...]
    unit: Unit | None


def written_numbers(text: str, case: Case) -> list[Written]:
    """The numbers with variables of a case's file.

    Raises UnsuitedError where a variable stands in something else.
    """
    root = parse(text, Problems(case.path))
    assert type(root) is Tree
    by_mark = {case.marks[path]: path for path in numbers_of(case) if path in case.marks}
    found = []
    for node in _scalars([node for key, node in root.items.items() if key not in _FREE]):
        names = tuple(dict.fromkeys(names_in(node.text)))
        if names:
            path = by_mark.get(node.mark)
            if path is None:
                raise UnsuitedError("a variable stands in something else than a number")
            found.append(Written(path, node.text, names, _unit(case, path)))
    return found


def _scalars(stack: list[Node]) -> list[Scalar]:
    found = []
    while stack:
        node = stack.pop()
        if type(node) is Scalar:
            found.append(node)
        elif type(node) is Tree:
            stack.extend(node.items.values())
        elif type(node) is Items:
            stack.extend(node.items)
    return found


def _unit(case: Case, path: str) -> Unit | None:
    """The unit in which a case keeps the number at a path; None where a unit is not foreseen."""
    section, _, rest = path.partition(".")
    if section in ("lengths", "points"):
        return parse_unit(case.units.length)
    if section == "angles" or rest.endswith(".angle"):
        return parse_unit("deg")
    load = next((load for load in case.loads if f"loads.{load.name}" == path), None)
    return parse_unit(unit_of(load, case)) if load is not None else None


def columns(numbers: Sequence[Written], draws: Sequence[Values]) -> dict[str, Array]:
    """By path the numbers of every draw, as the reader of cases would read them.

    Raises UnsuitedError, or the reader's own errors, where a text is no such number.
    """
    return {number.path: _column(number, draws) for number in numbers}


def _column(number: Written, draws: Sequence[Values]) -> Array:
    known: dict[tuple[str, ...], float] = {}
    out = np.empty(len(draws))
    for row, values in enumerate(draws):
        key = tuple(values[name] for name in number.names)
        value = known.get(key)
        if value is None:
            value = known[key] = _value(number, values)
        out[row] = value
    return out


def _value(number: Written, values: Values) -> float:
    parts = split_quantity(replaced(number.text, values).strip())
    if parts is None:
        raise UnsuitedError("what was drawn is not a number")
    numeral, unit = parts
    if not unit:
        return float(numeral.digits)
    if number.unit is None:
        raise UnsuitedError("a unit stands where none is foreseen")
    return converted(numeral, parse_unit(unit), number.unit)


def as_written(case: Case) -> dict[str, Number]:
    """The numbers of a case's figure and of its loads, by path."""
    found: dict[str, Number] = {}
    stack: list[object] = [case.points, case.lengths, case.angles, case.loads]
    while stack:
        item = stack.pop()
        if isinstance(item, Number):
            found[item.path] = item
        elif isinstance(item, dict):
            stack.extend(item.values())
        elif isinstance(item, tuple):
            stack.extend(item)
    return found
