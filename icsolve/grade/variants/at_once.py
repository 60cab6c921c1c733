"""Cases that differ in their numbers alone, solved together: each a row of one record, as if by itself; and
the numbers by which the variants of a case differ.

What the record doubts, and what it can't tell (friction, screws, inertia, profiles), is left to a
scene of its own. Of the ways in which a figure assembles each row has the one that `near` means.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import zip_longest
from typing import Any

import numpy as np
import numpy.typing as npt

from icsolve.answer import Answer, Centre
from icsolve.assembly.ways import ways_of
from icsolve.case import Case, ForceVector, Load, Mark, Number, Pair
from icsolve.errors import IcsolveError
from icsolve.grade.mistakes.changed import changed_loads, turned_loads
from icsolve.grade.mistakes.engine import Known, solved_for
from icsolve.numbers.replay import Array
from icsolve.numbers.units import converted, numbers_in, parse_unit, split_quantity
from icsolve.read.document import Mapping as Tree
from icsolve.read.document import parse, scalars
from icsolve.read.names import Problems
from icsolve.read.variables import names_in, replaced
from icsolve.solve import solve
from icsolve.sweep.drivers import Drive
from icsolve.sweep.evaluator import Evaluator, RecordedRows
from icsolve.sweep.program import RowRequest, compile_sweep, setting_of
from icsolve.sweep.recorded_scene import pairs
from icsolve.sweep.request import SweepRequest
from icsolve.sweep.varied_numbers import numbers_of, with_numbers
from icsolve.tuples import replace
from icsolve.wording import unit_of

_NEARER = 0.81
"""Of two ways one is the nearer to `near` without doubt, where its squared distance is this part of the
other's."""
_ROUNDING = 1e-9
"""What is smaller beside its like may be a zero."""
Answers = list[Answer | None]
Columns = dict[str, Array]
Rows = npt.NDArray[np.int64]


def solved_at_once(cases: Sequence[Case]) -> Iterator[tuple[Answer, Known] | None]:
    """Cases of one shape, each with those with another load by which its wrong answers are known; None of one
    that is to be solved by itself."""
    answers = together(cases)
    found = [(case, answer) for case, answer in zip(cases, answers, strict=True) if answer is not None]
    kinds: dict[str, list[Answers]] = {}
    doubted = [False] * len(found)
    for kind, changes in (
        ("loads", [[c.case for c in changed_loads(case, a.points)] for case, a in found]),
        ("quarters", [list(turned_loads(a).values()) for _, a in found]),
    ):
        columns = [together(some, bare=True) for some in zip_longest(*changes)]
        for some, column in zip(zip_longest(*changes), columns, strict=True):
            if None in column and not _never_solved(some):
                doubted = [doubt or answer is None for doubt, answer in zip(doubted, column, strict=True)]
        kinds[kind] = [list(row) for row in zip(*columns, strict=True)] or [[] for _ in found]
    rows = zip(kinds["loads"], kinds["quarters"], doubted, strict=True)
    for answer in answers:
        if answer is None:
            yield None
            continue
        loads, quarters, doubt = next(rows)
        yield None if doubt else (answer, {"loads": loads, "quarters": quarters})


def _never_solved(cases: Sequence[Case]) -> bool:
    """Whether no case of a shape has an answer, whatever its numbers."""
    try:
        columns = tuple(_columns(cases, figure=False))
        setting = setting_of(cases[0], (), ())._replace(paths=columns, drive=Drive((), (), ()))
        return compile_sweep(setting, RowRequest()).refusal is not None
    except (IcsolveError, ArithmeticError):
        return False


def together(cases: Sequence[Case], bare: bool = False) -> Answers:
    """The answers of cases of one shape, unless ``bare`` with points, centres, rates, and derivatives by the
    figure; None of one that is to be solved by itself."""
    if not cases:
        return []
    found: Answers = [None] * len(cases)
    try:
        first = cases[0]
        modes = _modes(first)
        template = solve(first, bound=False) if bare else solved_for(first)
        if any(one.holds or one.components for one in template.answers.values()):
            return found
        columns = _columns(cases, figure=not bare)
        if not columns:
            return [replace(template, case=case) for case in cases]
        for case, rows in _by_mode(cases, modes, columns):
            made = _rows(case, template, {path: column[rows] for path, column in columns.items()}, bare)
            for row, answer in zip(rows.tolist(), made, strict=True):
                found[row] = answer and replace(answer, case=cases[row])
    except (IcsolveError, ArithmeticError, ValueError):
        return found
    return found


def _columns(cases: Sequence[Case], figure: bool) -> Columns:
    """The numbers that are not the same in all cases, by path; with ``figure`` those of the figure too."""
    values = np.array([[number.value for number in numbers_of(case).values()] for case in cases]).T.copy()
    drawn = {number.path for number in numbers_in(cases[0].points, cases[0].lengths, cases[0].angles)}
    return {
        path: column
        for path, column in zip(numbers_of(cases[0]), values, strict=True)
        if (figure and path in drawn) or np.ptp(column) > 0.0
    }


def _modes(case: Case) -> list[Case]:
    """The case in each of its ways to assemble, the one that it means first.

    Raises ValueError where there may be more: each point that `near` places has to have two places.
    """
    if not case.near:
        return [case]
    found = ways_of(case)
    if not found.complete or len(found.ways) != 2 ** len(case.near):
        raise ValueError("the ways of assembling are not as many as the points that are placed by near")
    ways = [{name: way.points[name] for name in case.near} for way in found.ways]
    ways.sort(key=lambda way: sum(math.dist(way[name], place) ** 2 for name, place in case.near.items()))
    return [replace(case, near=way) for way in ways]


def _by_mode(cases: Sequence[Case], modes: Sequence[Case], columns: Columns) -> Iterator[tuple[Case, Rows]]:
    """Each way to assemble with the rows that mean it by their own `near`; the others are in doubt."""
    if len(modes) == 1:
        yield modes[0], np.arange(_count(columns))
        return
    near = {name: np.array([case.near[name] for case in cases]) for name in cases[0].near}
    off = np.full((len(modes), _count(columns)), np.nan)
    for n, case in enumerate(modes):
        found = _recorded(case, columns, RowRequest(answers=False, points=tuple(near)), False)
        if found is not None and all(("points", name) in found.arrays for name in near):  # none is spare
            sure = ~found.doubted[:, None]  # where the links do not meet a place is any number
            places = [np.where(sure, found.arrays["points", name], np.nan) for name in near]
            own = (((place - near[name]) ** 2).sum(axis=1) for name, place in zip(near, places, strict=True))
            off[n] = sum(own)
    nearest = np.argsort(off, axis=0)
    first, second = (np.take_along_axis(off, nearest[k : k + 1], axis=0)[0] for k in (0, 1))
    clear = np.isfinite(off).all(axis=0) & (first < _NEARER * second)
    for n, case in enumerate(modes):
        rows = np.flatnonzero(clear & (nearest[0] == n))
        if len(rows):
            yield case, rows


def _recorded(case: Case, columns: Columns, asked: RowRequest, slopes: bool) -> RecordedRows | None:
    names = dict(zip(columns, columns, strict=True))
    return Evaluator(case, names, SweepRequest(asked, False), slopes).recorded(*columns.values())


def _count(columns: Columns) -> int:
    return len(next(iter(columns.values())))


def _rows(case: Case, template: Answer, columns: Columns, bare: bool) -> Answers:
    """The answers of rows of one way to assemble."""
    asked = RowRequest()
    if not bare:
        terms = template.mobility == 1
        asked = RowRequest(True, tuple(template.points), tuple(pairs(case)), rates=True, terms=terms)
    found = _recorded(case, columns, asked, not bare)
    if found is None:
        return [None] * _count(columns)
    values: dict[str, dict[str, list[Any]]] = {kind: {} for kind in ("answers", "points", "rates", "terms")}
    for (kind, name), array in found.arrays.items():
        values.setdefault(kind, {})[name] = array.tolist()
    pairs_of = {f"{a}-{b}": (a, b) for a, b in pairs(case)}
    slopes = {name: {path: a.tolist() for path, a in by.items()} for name, by in found.gradients.items()}
    doubted = (found.doubted | _small(found.arrays)).tolist()
    sizes = {load.name: _size_of(load, columns) for load in case.loads}

    def answer(row: int) -> Answer:
        own = {name: one._replace(value=values["answers"][name][row], sense="", error=None)
               for name, one in template.answers.items()}  # fmt: skip
        terms = []
        for term in template.terms if values["terms"] else ():
            size, per = sizes[term.load]
            power = values["terms"][term.load][row] * (per or size[row])
            factor = power / size[row] if per and size[row] else values["terms"][term.load][row]
            terms.append(term._replace(value=size[row], factor=factor, power=power))
        return Answer(
            case,
            own,
            {
                pairs_of[name]: _centre(pairs_of[name], at[row])
                for name, at in values.get("centres", {}).items()
            },
            {link: rate[row] for link, rate in values["rates"].items()},
            points={name: tuple(place[row]) for name, place in values["points"].items()},
            terms=terms,
            mobility=template.mobility,
            sensitivities={name: {path: a[row] for path, a in by.items()} for name, by in slopes.items()},
        )

    return [None if doubt else answer(row) for row, doubt in enumerate(doubted)]


def _small(arrays: Mapping[tuple[str, str], Array]) -> npt.NDArray[np.bool_]:
    """The rows in which a rate, a factor of a load or the weight of a centre may be a zero."""
    doubt = np.zeros(len(next(iter(arrays.values()))), dtype=bool)
    for kind in ("rates", "terms"):
        some = np.abs([array for (k, _), array in arrays.items() if k == kind])
        if len(some):
            doubt |= ((some > 0.0) & (some < _ROUNDING * some.max(axis=0))).any(axis=0)
    for (kind, _), array in arrays.items():
        if kind == "centres":
            x, y, w = np.abs(array).T
            doubt |= (w > 0.0) & (w < _ROUNDING * (x + y))
    return doubt


def _size_of(load: Load, columns: Columns) -> tuple[list[float], float]:
    """A load's own number in every row; of a vector its size, and that for which the record has its power."""
    rows = _count(columns)

    def own(number: Number) -> Array:
        return columns.get(number.path, np.full(rows, number.value))

    if isinstance(load, ForceVector):
        return np.hypot(own(load.x), own(load.y)).tolist(), math.hypot(load.x.value, load.y.value)
    return own(load.value).tolist() if isinstance(load.value, Number) else [0.0] * rows, 0.0


def _centre(pair: Pair, triple: Sequence[float]) -> Centre:
    x, y, w = triple
    if w:
        return Centre(pair, "at", (x / w, y / w))
    return Centre(pair, "toward", (math.degrees(math.atan2(y, x)) % 180.0,) if x or y else ())


# --- the numbers of a variant --------------------------------------------------------------------------

_FREE = ("title", "source", "reconstructed", "variables")
"""Sections in which a variable changes no number."""


class VariedNumbers:
    """The numbers of a case in which variables stand.

    ``of_loads`` are the variables that stand in the sizes of loads alone; ``whole`` tells whether none stands
    anywhere but in a coordinate, a length, an angle or the size of a load.
    """

    def __init__(self, text: str, case: Case) -> None:
        root = parse(text, Problems(case.path))
        assert type(root) is Tree
        written = {node.mark: node for node in scalars(root) if names_in(node.text)}
        section = root.items.get("loads")
        loads = section.items if type(section) is Tree else {}
        powers = {f"loads.{name}" for name, load in loads.items() if "power" in getattr(load, "items", ())}
        sizes = {f"loads.{load.name}" for load in case.loads} - powers  # a power gives a torque by its speed
        of_figure = ("points.", "lengths.", "angles.")
        paths = [path for path in numbers_of(case) if path in sizes or path.startswith(of_figure)]
        nodes = {path: node for path in paths if (node := written.get(case.marks[path])) is not None}
        self.case = case
        self._texts = {path: (node.text, parse_unit(_unit_at(path, case))) for path, node in nodes.items()}
        on_loads = [node for path, node in nodes.items() if path in sizes]
        inside = {name for node in on_loads for name in names_in(node.text)}
        self.of_loads = frozenset(inside - _elsewhere(root, {node.mark for node in on_loads}))
        self.whole = not _elsewhere(root, {node.mark for node in nodes.values()})
        self._written = [(f"loads.{load.name}", number_of(load)) for load in case.loads]

    def at(self, values: Mapping[str, str], section: str = "") -> dict[str, float]:
        """The numbers of a section (of all) that depend on variables, by path, in case units."""
        found = {}
        for path, (written, own) in self._texts.items():
            if path.startswith(section):
                parts = split_quantity(replaced(written, values)[0])
                assert parts is not None
                numeral, unit = parts
                found[path] = converted(numeral, parse_unit(unit), own) if unit else float(numeral.digits)
        return found

    def case_of(self, values: Mapping[str, str]) -> Case:
        """The case with these values, of a ``whole`` one."""
        return with_numbers(self.case, self.at(values))

    def factor(self, base: Mapping[str, str], values: Mapping[str, str]) -> float | None:
        """By what all loads are larger than with other values; None where they do not grow alike, as those of
        inertia do not."""
        if self.case.dynamic:
            return None
        old, new = self.at(base, "loads."), self.at(values, "loads.")
        ratios = set()
        for path, written in self._written:
            before = old.get(path, written)
            if before is None:
                continue
            after = new.get(path, before)
            if before == 0.0 or after == 0.0:
                return None
            ratios.add(after / before)
        return ratios.pop() if len(ratios) == 1 else None


def number_of(load: Load) -> float | None:
    """A load's own known number; 1 of a vector, which no variable scales."""
    value = getattr(load, "value", None)
    if isinstance(value, Number):
        return value.value
    return 1.0 if hasattr(load, "x") else None


def _unit_at(path: str, case: Case) -> str:
    """The unit in which a case keeps a number."""
    section, _, name = path.partition(".")
    if section == "angles":
        return "deg"
    return (
        unit_of(next(x for x in case.loads if x.name == name), case)
        if section == "loads"
        else case.units.length
    )


def _elsewhere(root: Tree, within: set[Mark]) -> set[str]:
    """Variables that stand outside these places; titles and the like do not count."""
    nodes = (node for key, section in root.items.items() if key not in _FREE for node in scalars(section))
    return {name for node in nodes if node.mark not in within for name in names_in(node.text)}
