"""A case as a compiled function of some of its numbers: arrays in, arrays out, with gradients on request.

For synthesis, optimisation and many students' numbers: the kernels of one scene are recorded once, with the
numbers as inputs. Few rows run as straight-line Python, many as numpy; a row that comes near to a limit or a
dead centre is solved as a scene of its own, so each row says what `icsolve.solve` says of it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from math import atan2, degrees, inf, isfinite, sqrt
from typing import Any

import numpy as np
import numpy.typing as npt

from icsolve.assembly.steps import PointGroup
from icsolve.case import Case, is_angle, refuse_no_case
from icsolve.errors import SceneError, Status
from icsolve.numbers import turn_of
from icsolve.numbers.adjoint import gradient
from icsolve.numbers.record import Op, live, varies
from icsolve.numbers.replay import BLOCK, Array, Code
from icsolve.numbers.source import PYTHON, straight_line
from icsolve.numbers.units import BOUNDS, NumberLimit
from icsolve.scene import solve_scene
from icsolve.scene.refusals import rubs
from icsolve.statics.power import loads_to_find
from icsolve.sweep.drivers import Drive
from icsolve.sweep.exact_record import hides
from icsolve.sweep.program import CompiledSweep, RowRequest, Setting, compile_sweep, setting_of
from icsolve.sweep.record_runner import SHALLOW, SMALL, STEEP, Key, Rows, Runner, column, usual_and_terms
from icsolve.sweep.request import (
    FARTHEST,
    RequestError,
    SweepRequest,
    array_of,
    names_in,
    refuse_far,
    request_of,
    told,
)
from icsolve.sweep.rows_by_scenes import placed_near
from icsolve.sweep.starting_position import is_hard, is_open, shapes_figure
from icsolve.sweep.table import CODE, RECORDED, WORDS, Table, by_kind
from icsolve.sweep.varied_numbers import find_number, numbers_of, with_numbers
from icsolve.tuples import NamedTuple, dataclass, field

FEW = 24
"""So many rows at most run as Python: numpy's own cost a step is that of some twenty floats."""
COUNTED = (NumberLimit("<", FARTHEST, ""), NumberLimit(">", -FARTHEST, ""))
"""Angles of more turns are refused."""

FINE = np.array((str(Status.OK),), dtype="<U24")

Gradients = dict[str, dict[str, Array]]
"""By answer, then by input."""


@dataclass(frozen=True, eq=False, repr=False)
class Evaluated:
    """The rows of one call; n is their number.

    Attributes
    ----------
    status : words as those of `solve`, (n,)
    answers : unknown loads by name, (n,) [case units]; not a number where the status is not ``ok``
    points : places by name, (n, 2) [case length]
    centres : relative centres by pair, homogeneous (x, y, w), (n, 3)
    rates : angular velocities by link, (n,) [rad/s, or scaled as in one scene]
    velocities, accelerations, angular_accelerations : as those of `Sweep`
    terms : by load, the power of a unit of it, (n,); only their ratios in a row tell something
    gradients : by answer, then by input as it was asked for: derivative [case units; per degree by an angle],
        (n,); not a number where the status is not ``ok``
    """

    status: npt.NDArray[np.str_]
    answers: dict[str, Array] = field(default_factory=dict)
    points: dict[str, Array] = field(default_factory=dict)
    centres: dict[str, Array] = field(default_factory=dict)
    rates: dict[str, Array] = field(default_factory=dict)
    velocities: dict[str, Array] = field(default_factory=dict)
    accelerations: dict[str, Array] = field(default_factory=dict)
    angular_accelerations: dict[str, Array] = field(default_factory=dict)
    terms: dict[str, Array] = field(default_factory=dict)
    gradients: Gradients = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.status)

    def __repr__(self) -> str:
        return f"<Evaluated: {len(self)} rows of {', '.join(self.answers)}>"


class RecordedRows(NamedTuple):
    """Rows of a record: arrays by kind and name (`CompiledSweep.outputs`), gradients by answer and input, and
    the rows that a scene of their own has to tell, (n,)."""

    arrays: dict[Key, Array]
    gradients: Gradients
    doubted: npt.NDArray[np.bool_]


def evaluator(
    case: Case,
    inputs: Sequence[str],
    want: Sequence[str] = ("answers", "status"),
    *,
    gradient: bool = False,
) -> Evaluator:
    """Compile a case as a function of some of its numbers.

    Parameters
    ----------
    case : as `icsolve.load` returns it
    inputs : paths of numbers as in sweeps (``lengths.BC``, ``angles.AB``, ``loads.P``, ``points.D.x``)
    want : as of `icsolve.sweep`, but ``error``
    gradient : whether each call also gives the derivative of every answer by every input, and the answers

    Returns
    -------
    Evaluator
        Called with one array a number, in the order of ``inputs``: each of n values, or one for all rows.
        Every row is a figure as if written so, on the branch on which the case as written is.

    Raises
    ------
    ArgumentError
        A TypeError, for what is no case, as the path of one, and names that are none.
    CaseError
        For a path that the case does not have.
    SceneError
        Where the case as written has no figure, or lies in space.
    ValueError
        For words that can't be wanted, no inputs, or one twice; gradients where rows are solved one by one
        (friction, profiles, ropes, screws, the direction of a motion, groups that Newton's method places,
        inertia forces where joints are redundant or several points have given motions).
    """
    refuse_no_case(case)
    paths = names_in(inputs, "inputs=('angles.AB', 'lengths.BC')")
    own = tuple(find_number(case, path).path for path in paths)
    if not own:
        raise RequestError("nothing is varied: give inputs=('lengths.BC',)")
    if len(set(own)) < len(own):
        raise RequestError("an input is named twice")
    words = (*names_in(want, "want=('answers', 'points.C')"), *(("answers",) if gradient else ()))
    wanted = request_of(case, words, case.dynamic)
    if wanted.asked.reactions:
        raise RequestError("an evaluator tells no reactions: `icsolve.sweep` has them, each row as a scene")
    if case.space is not None:
        raise SceneError(Status.UNSUPPORTED, "an evaluator is for the plane, and this case is in space.")
    return Evaluator(case, dict(zip(paths, own, strict=True)), wanted, gradient)


class Evaluator:
    """A case as a function of some of its numbers; `evaluator` makes it, and tells what is refused.

    Attributes
    ----------
    case : as written
    inputs : the paths, in the order of the arguments
    figure : as written, whose branches all rows have; None where it has to be found anew in each
    compiled : the record with its programs; None where each row is solved as a scene of its own
    """

    def __init__(self, case: Case, names: dict[str, str], wanted: SweepRequest, gradients: bool) -> None:
        self.case, self.inputs, self.wanted = case, tuple(names), wanted
        self.own, self.gradients = tuple(names.values()), gradients
        self.limits = limits_of(case, self.own)
        setting = _setting(case, self.own)
        self.figure = None if setting is None else setting.figure
        self.compiled = None
        if setting is not None and not (case.screws or rubs(case)):
            self.compiled = _compiled(setting, names, wanted.asked, gradients)
        if self.compiled is None and gradients:
            raise RequestError(
                "there are no gradients where each row is solved as a scene of its own: with friction, "
                "profiles, ropes or screws, by the direction of a motion, with inertia forces where joints "
                "are redundant or several points have given motions, or where points can be placed only "
                "together, nothing moves beside the case as written or its known loads do no work"
            )

    def __reduce__(self) -> tuple[Any, ...]:
        """Copies, and those of other processes, compile the case anew."""
        names = dict(zip(self.inputs, self.own, strict=True))
        return Evaluator, (self.case, names, self.wanted, self.gradients)

    def __call__(self, *columns: npt.ArrayLike) -> Evaluated:
        """Every row.

        Parameters
        ----------
        *columns : one a path, in the order of ``inputs``: (n,), or one number for all rows [case units,
        degrees]

        Returns
        -------
        Evaluated
            n rows; one of plain numbers alone is one row. A row without an answer says so in ``status``; one
            with a number that is not finite, or that no case may have there, can't be assembled.

        Raises
        ------
        ValueError
            For columns whose number or lengths do not fit, or with more than one dimension, and for angles
            of more than 10,000,000 degrees.
        """
        self._refuse_count(len(columns))
        if self.compiled is not None:
            found = self.compiled.single(columns)
            if found is not None:
                return found
        given, rows = _columns(self.inputs, columns)
        for name, own, array in zip(self.inputs, self.own, given, strict=True):
            if is_angle(own):
                refuse_far(name, array)
        table = self._empty(rows)
        if self.compiled is None:
            again, slopes = np.arange(rows), Gradients()
        else:
            again, slopes = self.compiled.run(given, rows, table)
        for array in (array for by in slopes.values() for array in by.values()):
            array[again] = np.nan
        for row in again.tolist():
            self._as_scene(given, row, table, slopes)
        kinds = by_kind(table.values, RECORDED)
        status = np.array(WORDS if table.codes.any() else WORDS[:1], FINE.dtype)[table.codes]
        return Evaluated(status, gradients=slopes, **kinds)

    def recorded(self, *columns: Array) -> RecordedRows | None:
        """What the record says of every row, (n,) each column; None where there is no record. No scene is
        solved: the rows that it doubts are to be solved by who asks."""
        if self.compiled is None:
            return None
        table = self._empty(len(columns[0]))
        again, slopes = self.compiled.run(list(columns), table.rows, table)
        doubted = np.zeros(table.rows, dtype=bool)
        doubted[again] = True
        return RecordedRows(table.values, slopes, doubted)

    def case_of(self, *numbers: float) -> Case:
        """The case with these numbers, in the order of ``inputs`` [case units, degrees], as if written so."""
        self._refuse_count(len(numbers))
        return with_numbers(self.case, dict(zip(self.own, map(float, numbers), strict=True)))

    def _refuse_count(self, given: int) -> None:
        """Raise RequestError where there are more or fewer numbers than inputs."""
        if given != len(self.inputs):
            names = ", ".join(self.inputs)
            raise RequestError(f"{len(self.inputs)} numbers are varied ({names}), not {given}")

    def _empty(self, rows: int) -> Table:
        """A table whose arrays of what is asked are there, whatever the rows have."""
        if self.compiled is not None:
            table = Table(rows, self.compiled.asked)
            table.reserve(self.compiled.parts)
            return table
        asked = self.wanted.asked
        table = Table(rows, asked)
        loads = loads_to_find(self.case) if asked.answers else []
        table.reserve({("answers", name): 1 for name in loads})
        table.reserve({("points", name): 2 for name in asked.points})
        table.reserve({("centres", f"{a}-{b}"): 3 for a, b in asked.centres})
        table.reserve({("rates", link): 1 for link in self.case.links} if asked.rates else {})
        return table

    def _as_scene(self, given: list[Array], row: int, table: Table, slopes: Gradients) -> None:
        """One row as `icsolve.solve` has it, on the branch that was followed, with its derivatives
        where gradients are asked for."""
        for array in table.values.values():
            array[row] = np.nan
        numbers = [float(c[row] if c.ndim else c) for c in given]
        if not (all(map(isfinite, numbers)) and all(one.holds(numbers[n]) for n, one in self.limits)):
            table.codes[row] = CODE[Status.CANNOT_ASSEMBLE]
            return
        case = self.case_of(*numbers)
        if self.figure is not None:
            case = placed_near(case, self.figure)
        centres = bool(table.asked.centres)
        rates = table.asked.rates or table.asked.velocities or centres
        try:
            answer = solve_scene(case, rates=rates, all_centres=centres)
        except SceneError as refusal:
            table.refuse(row, refusal)
            return
        table.fill(row, answer)
        with suppress(SceneError):  # so near a singular position that none can be told
            for name, by in slopes.items():
                for path, own in zip(self.inputs, self.own, strict=True):
                    by[path][row] = answer.sensitivities[name].get(own, 0.0)


def limits_of(case: Case, own: Sequence[str]) -> list[tuple[int, NumberLimit]]:
    """What inputs keep to in any case, by their place."""
    known = numbers_of(case)
    return [(n, limit) for n, path in enumerate(own) for limit in BOUNDS[known[path].bound]]


def _setting(case: Case, own: tuple[str, ...]) -> Setting | None:
    """The case as written, whose construction all rows have; None where each has to find its own."""
    if case.touches:
        return None
    setting = setting_of(case, (), ())._replace(paths=own, drive=Drive((), (), ()))
    groups = any(isinstance(step, PointGroup) for step in setting.figure.steps)
    return None if groups or is_hard(setting) else setting


def _columns(names: Sequence[str], columns: Sequence[npt.ArrayLike]) -> tuple[list[Array], int]:
    """The columns as arrays, and how many rows they make."""
    given = [array_of(name, values) for name, values in zip(names, columns, strict=True)]
    rows = max((len(c) for c in given if c.ndim and len(c) != 1), default=1)  # none of nothing
    for name, values in zip(names, given, strict=True):
        if values.ndim > 1 or (values.ndim and len(values) not in (1, rows)):
            raise RequestError(f"{name} has the shape {values.shape} where {rows} rows are asked for")
    return [c if c.ndim == 0 or len(c) == rows else c[0] for c in given], rows


class _Compiled:
    """The record of a case with its inputs, as Python for few rows and as numpy for many."""

    def __init__(
        self, compiled: CompiledSweep, asked: RowRequest, names: Mapping[str, str], gradients: bool
    ) -> None:
        record = compiled.record
        self.compiled, self.asked, self.names = compiled, asked, tuple(names)
        self.bounds = limits_of(compiled.scene.case, tuple(names.values()))
        turned = [n for n, own in enumerate(names.values()) if is_angle(own)]
        self.bounds += [(n, one) for n in turned for one in COUNTED]
        self.nodes = [compiled.inputs[own] for own in names.values()]
        self.parts = {key: len(values) for key, values in compiled.outputs.items()}
        values = [(key, part, v) for key, some in compiled.outputs.items() for part, v in enumerate(some)]
        self.keys = [(key, part) for key, part, _ in values]
        answers = {key[1]: v for key, _, v in values if key[0] == "answers"}
        slopes = {}
        if gradients:
            slopes = {name: gradient(record, v, self.nodes) for name, v in answers.items()}
        self.slopes = [(name, path) for name in slopes for path in self.names]
        shown = [*(v for *_, v in values), *(v for by in slopes.values() for v in by.values())]
        self.shown = [record.lifted(v).index for v in shown]
        alive = live(record.nodes, [v.index for v in shown if varies(v)])
        self.positive = [r.radicand for k, r in record.roots.items() if k in set(alive)]
        self.positive += [*compiled.margins, *compiled.fits]
        divided = {record.nodes[k].b for k in alive if record.nodes[k].op == Op.DIV}
        divided = {k for k in divided if record.nodes[k].row}
        answers = {name: v for name, v in answers.items() if varies(v)}
        self.apart = [*sorted(divided), *(v.index for v in answers.values())]
        watched = [*self.positive, *self.apart]
        terms = {v.index: usual_and_terms(record, v.index)[1] for v in answers.values()}
        sizes = [terms.get(k) or abs(record.nodes[k].value) or 1.0 for k in watched]
        near = [STEEP * STEEP, STEEP, SMALL] if compiled.dynamic else [SHALLOW, SMALL, SMALL]
        counts = [len(self.positive), len(divided), len(answers)]
        self.limits = np.repeat(near, counts) * np.array(sizes)
        self.code = Code(record, [*self.shown, *watched])
        self.one = self._python()

    def _python(self) -> Callable[..., tuple[float, ...] | None]:
        """The same for one row of floats; None where the row has to be looked at."""
        record, names = self.compiled.record, {k: f"x{n}" for n, k in enumerate(self.nodes)}
        wanted = [*self.shown, *self.positive, *self.apart]
        text = straight_line(record.nodes, wanted, names, PYTHON)
        count, limits = len(self.shown), self.limits.tolist()
        watched = text.wanted[count:]
        tests = [f"{w}>{limit!r}" for w, limit in zip(watched, limits, strict=False)][: len(self.positive)]
        later = zip(watched[len(self.positive) :], limits[len(self.positive) :], strict=True)
        tests += [f"(-inf<{w}<-{limit!r} or {limit!r}<{w}<inf)" for w, limit in later]
        body = [*text.lines, *(f"if not ({test}): return None" for test in tests)]
        body.append(f"return ({''.join(f'{w},' for w in text.wanted[:count])})")
        source = f"def one({', '.join(names.values())}):\n" + "".join(f"    {line}\n" for line in body)
        scope: dict[str, Any] = {"turn": turn_of, "root": _root, "atan2": atan2, "degrees": degrees}
        scope["inf"] = inf
        exec(compile(source, "<evaluator>", "exec"), scope)
        found: Callable[..., tuple[float, ...] | None] = scope["one"]
        return found

    def single(self, columns: Sequence[npt.ArrayLike]) -> Evaluated | None:
        """One row of plain numbers, every output (1,) or (1, parts); None where there are several rows,
        or the row has to be looked at.
        """
        if any(getattr(column, "shape", ()) or isinstance(column, list | tuple) for column in columns):
            return None
        try:
            if not all(one.holds(columns[n]) for n, one in self.bounds):
                return None
            found = self.one(*map(float, columns))  # type: ignore[arg-type]
        except (ArithmeticError, TypeError, ValueError):
            return None
        if found is None:
            return None
        kinds: dict[str, dict[str, Array]] = {kind: {} for kind in RECORDED}
        start = 0
        for (kind, name), count in self.parts.items():
            part = found[start : start + count]
            kinds[kind][name] = np.array(part if count == 1 else (part,))
            start += count
        gradients: dict[str, dict[str, Array]] = {}
        for (name, path), value in zip(self.slopes, found[start:], strict=True):
            gradients.setdefault(name, {})[path] = np.array((value,))
        return Evaluated(FINE.copy(), gradients=gradients, **kinds)

    def run(self, given: list[Array], rows: int, table: Table) -> tuple[Rows, Gradients]:
        """Fill all rows from the inputs, (rows,) or () each; the indices of those to be solved as scenes, and
        the gradients."""
        slopes: Gradients = {name: {} for name, _ in self.slopes}
        targets = [column(table.values[key], part) for key, part in self.keys]
        for name, path in self.slopes:
            targets.append(slopes[name].setdefault(path, np.empty(rows)))
        few = rows <= FEW
        return (self._few(given, rows, targets) if few else self._many(given, rows, targets)), slopes

    def _few(self, given: list[Array], rows: int, targets: list[Array]) -> Rows:
        again = []
        columns = [c.tolist() for c in given]
        for row in range(rows):
            numbers = [c[row] if isinstance(c, list) else c for c in columns]
            try:
                found = self.one(*numbers) if all(b.holds(numbers[n]) for n, b in self.bounds) else None
            except (ArithmeticError, ValueError):
                found = None
            if found is None:
                again.append(row)
                continue
            for target, value in zip(targets, found, strict=True):
                target[row] = value
        return np.array(again, dtype=np.int64)

    def _many(self, given: list[Array], rows: int, targets: list[Array]) -> Rows:
        again = []
        shown, positive = len(self.shown), len(self.positive)
        for start in range(0, rows, BLOCK):
            stop = min(start + BLOCK, rows)
            here = {k: c[start:stop] if c.ndim else c for k, c in zip(self.nodes, given, strict=True)}
            found = self.code.run(here, stop - start)
            for target, array in zip(targets, found, strict=False):
                target[start:stop] = array
            fine = np.ones(stop - start, dtype=bool)
            with np.errstate(invalid="ignore"):
                for n, bound in self.bounds:
                    fine &= bound.holds(here[self.nodes[n]])
                for n, array in enumerate(found[shown:]):
                    fine &= ((array if n < positive else np.abs(array)) > self.limits[n]) & np.isfinite(array)
            if not fine.all():
                again.append(np.flatnonzero(~fine) + start)
        return np.concatenate(again) if again else np.empty(0, dtype=np.int64)


def _root(value: float) -> float:
    return sqrt(value) if value > 0.0 else 0.0


def _compiled(
    setting: Setting, names: Mapping[str, str], asked: RowRequest, gradients: bool
) -> _Compiled | None:
    """The record of the case with all inputs; None where its loads need a scene a row."""
    case = setting.case
    asked = told(case, asked)._replace(dynamic=case.dynamic)
    try:
        compiled = compile_sweep(setting, asked)
    except SceneError:  # beside the case as written nothing moves: it does so by exact data alone
        return None
    alone = compiled.refusal is not None or compiled.idle or hides(compiled)
    # in the figure as written exact data are as exact as they are in the scene
    alone = alone or (
        compiled.delicate and (any(map(shapes_figure, names.values())) or is_open(Runner(compiled)))
    )
    alone = alone or bool(case.ropes and not compiled.taut)
    return None if alone else _Compiled(compiled, asked, names, gradients)


__all__ = ["Evaluated", "Evaluator", "evaluator"]
