"""The variants of one case as one sweep: a family of figures built in the same way, all rows at once.

Each row is what the case gives with those numbers, by the kernels and the construction of one scene. Only
figures whose every branch `near` picks are taken, and a row in which the pick is not plain, or where
anything comes near zero, is left to be solved as a scene of its own.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from icsolve.answer import Answer
from icsolve.assembly import Figure, solve_figure
from icsolve.assembly.groups import Group
from icsolve.assembly.loci import is_round
from icsolve.assembly.order import order_of
from icsolve.assembly.steps import Meet
from icsolve.case import Case, Corner, Force, Load, Number, Torque, Weight
from icsolve.case.names import pair_name
from icsolve.read.document import Mapping as Tree
from icsolve.read.document import Node, Scalar, parse
from icsolve.read.document import Sequence as Items
from icsolve.read.names import Problems
from icsolve.read.variables import names_in, replaced
from icsolve.solve.refusals import rubs
from icsolve.statics.power import is_unknown
from icsolve.structure.topology import topology
from icsolve.sweep.drivers import Drive
from icsolve.sweep.numbers import numbers_of
from icsolve.sweep.program import Asked, Setting, sheet_of, wanted_points
from icsolve.sweep.runner import Runner
from icsolve.sweep.scene import pairs
from icsolve.units import Unit, converted, parse_unit, split_quantity
from icsolve.wording.senses import unit_of

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
    parts = split_quantity(replaced(number.text, values)[0].strip())
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


PLAIN = 0.98
"""The place that is taken lies nearer to `near` than the other one by this factor at least."""

Columns = Mapping[str, Array]
Mask = npt.NDArray[np.bool_]


class Rows(NamedTuple):
    """What a family gives: the unknown, points (n, 2), centres (n, 3) and rates by name; ``clear`` rows hold.

    ``points`` have what has coordinates only, too; a centre or rate that is the same for all is an array
    all the same.
    """

    value: Array
    points: dict[str, Array]
    centres: dict[str, Array]
    rates: dict[str, Array]
    clear: Mask


class Family:
    """The figures of ``case``, which was solved to ``answer``, for other numbers at the paths of its loads
    and its figure."""

    def __init__(self, case: Case, answer: Answer) -> None:
        """Raises UnsuitedError, SceneError."""
        self.case = case
        self.unknown = _only_unknown(case, answer)
        self.numbers = {path: number.value for path, number in as_written(case).items()}
        self.named = tuple(answer.points)
        self.figure = _built(case)
        acting = [at for load in case.loads if (at := getattr(load, "at", None)) is not None]
        if not {*self.named, *acting} <= self.figure.points.keys():
            raise UnsuitedError("points that the figure does not have")
        self.runner = self._runner(self.figure, full=True)
        self.others = [(step.target, self._other_place(n)) for n, step in self._forks()]
        self.flat = {
            angle.value.path: angle.value.value % 180.0 == 0.0
            for angle in case.angles
            if isinstance(angle, Corner)
        }

    def run(self, columns: Columns, rows: int) -> Rows:
        """All rows."""
        found = self.runner.run(self.given(self.runner, columns), rows)
        clear = np.ones(rows, dtype=bool)
        clear[found.doubtful] = False
        value = found.values["answers", self.unknown]
        kinds: dict[str, dict[str, Array]] = {"answers": {}, "points": {}, "centres": {}, "rates": {}}
        for (kind, name), array in found.values.items():
            kinds[kind][name] = array
        with np.errstate(all="ignore"):
            clear &= np.isfinite(value) & (value != 0.0)
            clear &= self._picked(kinds["points"], columns, rows) & self._as_built(columns, rows)
        return Rows(value, kinds["points"], kinds["centres"], kinds["rates"], clear)

    def values(self, columns: Columns, rows: int) -> Array:
        """The unknown alone."""
        return self.runner.run(self.given(self.runner, columns), rows).values["answers", self.unknown]

    def slopes(self, columns: Columns, rows: int) -> dict[str, Array]:
        """Derivatives of the unknown by every number, by path."""
        passes = self.runner.bounds
        given, names = self.given(self.runner, columns), {k: n for n, k in self.runner.sheet.inputs.items()}
        out = {name: np.zeros(rows) for name in names.values()}
        for start in range(0, rows, passes.rows):
            here = slice(start, min(start + passes.rows, rows))
            (passed,) = passes.run(
                {k: v[here] if v.ndim else v for k, v in given.items()}, here.stop - start
            )
            for k, slope in passed.by.items():
                if k in names:
                    out[names[k]][here] = slope
        return out

    def number(self, path: str, columns: Columns, rows: int) -> Array:
        """A number in each row."""
        return np.broadcast_to(columns[path] if path in columns else self.numbers[path], rows)

    def given(self, runner: Runner, columns: Columns) -> dict[int, Array]:
        """The inputs of a runner: what varies by row, and single numbers."""
        inputs = runner.sheet.inputs
        return {k: np.asarray(columns[p] if p in columns else self.numbers[p]) for p, k in inputs.items()}

    def with_loads(self, loads: tuple[Load, ...]) -> Runner:
        """A runner of the same figure under other loads, for the unknown alone."""
        from dataclasses import replace

        return self._runner(self.figure, full=False, case=replace(self.case, loads=loads))

    # --- making -----------------------------------------------------------------------------------

    def _runner(self, figure: Figure, full: bool, case: Case | None = None, points: str = "") -> Runner:
        case = case or self.case
        paths = tuple(as_written(case))
        setting = Setting(case, topology(case), figure, paths, (), Drive((), (), ()))
        asked = Asked(answers=not points, points=(points,) if points else ())
        if full:
            asked = Asked(True, tuple(figure.points), tuple(pairs(case)), True)
        sheet = sheet_of(setting, asked)
        if sheet.refusal is not None or sheet.delicate:
            raise UnsuitedError("the mechanism moves only because its data are exact")
        return Runner(sheet)

    def _forks(self) -> list[tuple[int, Meet]]:
        steps = enumerate(self.figure.steps)
        return [(n, step) for n, step in steps if isinstance(step, Meet) and is_round(step.second)]

    def _other_place(self, n: int) -> Runner:
        """The figure with the other place of one step."""
        steps = list(self.figure.steps)
        step = steps[n]
        assert isinstance(step, Meet) and isinstance(step.target, str)
        steps[n] = step._replace(sign=-step.sign)
        return self._runner(self.figure._replace(steps=tuple(steps)), full=False, points=step.target)

    # --- rows -------------------------------------------------------------------------------------

    def _picked(self, points: Mapping[str, Array], columns: Columns, rows: int) -> Mask:
        """Rows in which `near` picks the places as in the case itself."""
        clear = np.ones(rows, dtype=bool)
        for target, runner in self.others:
            assert isinstance(target, str)
            other = runner.run(self.given(runner, columns), rows).values["points", target]
            near = np.array(self.case.near[target])
            own = np.hypot(*(points[target] - near).T)
            clear &= own < PLAIN * np.hypot(*(other - near).T)
        return clear

    def _as_built(self, columns: Columns, rows: int) -> Mask:
        """Rows that are constructed as the case itself: corners as flat as there, lengths above zero."""
        clear = np.ones(rows, dtype=bool)
        for path, array in columns.items():
            if path.startswith("lengths."):
                clear &= array > 0.0
            elif path.startswith("loads.") and not path.endswith(".angle"):
                clear &= array != 0.0
            elif path in self.flat:
                clear &= (array % 180.0 == 0.0) == self.flat[path]
        return clear

    def centres_of(self, rows: Rows, link: str) -> dict[str, Array]:
        """Homogeneous centres of a link that are not at infinity, by the other link."""
        found = {}
        for other in self.case.links:
            name = pair_name(self.case, (link, other)) if other != link else ""
            if name in rows.centres and rows.centres[name][:, 2].any():
                found[other] = rows.centres[name]
        return found


def _only_unknown(case: Case, answer: Answer) -> str:
    """The one unknown of a smooth mechanism under loads that a sum of power of plain terms balances."""
    unknown = [load.name for load in case.loads if is_unknown(load)]
    plain = all(
        isinstance(load, Torque | Force) or (isinstance(load, Weight) and not load.mass)
        for load in case.loads
    )
    own = case.space is not None or case.profiles is not None or any(m.point for m in case.motion)
    if own or rubs(case):
        raise UnsuitedError("a case of its own kind")
    if len(unknown) != 1 or list(answer.answers) != unknown or not plain or answer.mobility != 1:
        raise UnsuitedError("not one unknown under plain loads")
    return unknown[0]


def _built(case: Case) -> Figure:
    """The figure, if it is constructed step by step, of no more data than it needs, by `near` alone."""
    goal, _ = wanted_points(case)
    figure = solve_figure(case, goal)
    order = order_of(case, list(figure.points))
    spare = {d for d in set(order.facts.data) - order.used() if all(p in figure.points for p in d.points)}
    if spare or figure.notes:
        raise UnsuitedError("data are compared with each other")
    for step in figure.steps:
        if isinstance(step, Group):
            raise UnsuitedError("points that only all their data together determine")
        if isinstance(step, Meet) and is_round(step.second) and not (step.sign and step.target in case.near):
            raise UnsuitedError("a branch that `near` does not pick")
    return figure
