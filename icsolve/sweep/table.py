"""The rows of a sweep as arrays: filled by the record or scene by scene, read as a `Sweep`, written out."""

from __future__ import annotations

import csv
import io
import json
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from icsolve.answer import Answer, by_load
from icsolve.case import Case, is_named, pair_name, spot_name
from icsolve.errors import SceneError, Status
from icsolve.numbers import turn_of
from icsolve.numbers.replay import Array, Mask
from icsolve.numbers.tape import UNIT
from icsolve.statics.power import loads_to_find
from icsolve.sweep.program import RowRequest
from icsolve.sweep.record_runner import Key, Rows
from icsolve.tuples import cached_property, dataclass, field

WORDS = (
    Status.OK,
    Status.CANNOT_ASSEMBLE,
    Status.CHANGE_POINT,
    Status.DEAD_CENTRE,
    Status.NO_VALUE,
    Status.ANY_VALUE,
    Status.NEAR_SINGULAR,
    Status.MOBILITY,
    Status.STRUCTURE,
    Status.UNSUPPORTED,
    Status.INCONSISTENT,
    Status.CONTRADICTORY,
    Status.LOOSE,
    Status.AMBIGUOUS,
    Status.UNDERDETERMINED,
    "holds",
    Status.JAM,
    Status.UNBALANCED,
    Status.SLACK,
)
"""The statuses of rows; ``holds``: with friction and no motion, the unknown holds over a range."""
CODE = {word: n for n, word in enumerate(WORDS)}

Codes = npt.NDArray[np.int8]


def among(codes: Codes, statuses: Iterable[str]) -> Mask:
    """Which codes, (rows,), are those of some statuses."""
    wanted = np.zeros(len(WORDS), dtype=bool)
    wanted[[CODE[status] for status in statuses]] = True
    return np.asarray(wanted[codes])


Value = float | tuple[float, ...]
OTHER = CODE["near-singular"]
ALL = slice(None)
Held = Array | tuple[float, float]
Locks = Mask | bool


# --- a sweep as it is read ------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, repr=False)
class Sweep:
    """The rows of a sweep; n is their number. Arrays that were not wanted are not there.

    Attributes
    ----------
    vary : the varied numbers by path, and the turnings of driven links by link, (n,)
    answers : unknown loads by name, (n,) [case units]; not a number where the status is another than ok
    error : bounds of the absolute rounding errors of the answers, (n,)
    errors : the same of every kind (``points``, ``velocities``, ...) by name, each number's own, in the shape
        of its array; not a number where none is proven (with friction)
    points : places, (n, 2) [case length]
    centres : relative centres as homogeneous coordinates, (n, 3): (x, y, w) at (x/w, y/w), at infinity
        toward (x, y) where w is zero; all zero where the two links have no relative motion
    rates : angular velocities of the links, (n,) [rad/s, or scaled as in one scene]
    touching : with profiles and where points were wanted, the places of the contacts by their two links
        (``2-3``), (n, 2) [case length]; not a number where the status is another than ok
    velocities : of points on links, by ``C on 3``, (n, 2) [case length/s]; where wanted
    accelerations : the same, (n, 2) [case length/s^2], with inertia forces
    angular_accelerations : of links, (n,) [rad/s^2], with inertia forces
    terms : by load, the power of a unit of it, (n,), where there is one freedom or one unknown; the speed is
        another in each row, so that ratios tell something
    reactions : where wanted, by joint as in one scene (``F34``), x and y of the force and its couple about
        the joint, (n, 3); of ropes (``T A-P-B``) the pull, (n,) [case units]; what equilibrium leaves open is
        not a number
    holds : with friction and no motion, the ranges in which unknown loads hold, (n, 2)
    locks : by load with a range, in which rows the mechanism locks itself, (n,)
    notes : sentences about the sweep
    """

    case: Case
    vary: dict[str, Array]
    answers: dict[str, Array] = field(default_factory=dict)
    points: dict[str, Array] = field(default_factory=dict)
    centres: dict[str, Array] = field(default_factory=dict)
    rates: dict[str, Array] = field(default_factory=dict)
    errors: dict[str, dict[str, Array]] = field(default_factory=dict)
    holds: dict[str, Array] = field(default_factory=dict)
    locks: dict[str, Mask] = field(default_factory=dict)
    touching: dict[str, Array] = field(default_factory=dict)
    velocities: dict[str, Array] = field(default_factory=dict)
    accelerations: dict[str, Array] = field(default_factory=dict)
    angular_accelerations: dict[str, Array] = field(default_factory=dict)
    terms: dict[str, Array] = field(default_factory=dict)
    reactions: dict[str, Array] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    codes: Codes = field(default_factory=lambda: np.empty(0, np.int8))
    _case_of: Callable[[int], Case] | None = None

    def __len__(self) -> int:
        return len(self.codes)

    def __repr__(self) -> str:
        """What was varied, and how the rows came out."""
        return f"<Sweep {self.case.name}: {self.outcome}>"

    @property
    def outcome(self) -> str:
        """What was varied, and how many rows came out how, in words."""
        counts = Counter(str(word) for word in self.status)
        rows = "1 row" if len(self) == 1 else f"{len(self)} rows"
        varied = f" of {', '.join(self.vary)}" if self.vary else ""
        return f"{rows}{varied}: " + (", ".join(f"{n} {word}" for word, n in counts.most_common()) or "none")

    @cached_property
    def status(self) -> npt.NDArray[np.str_]:
        """The status of every row in words, (n,)."""
        if not self.codes.any():
            return np.full(len(self.codes), WORDS[0])
        return np.array(WORDS)[self.codes]

    def case_of(self, row: int) -> Case:
        """The case of a row, as `icsolve.solve` takes it: its points by coordinates.

        In a family of figures: the case as if written so.

        Raises
        ------
        ValueError
            Where the links do not assemble in this row.
        IndexError
            For a row that the sweep does not have.
        """
        if self._case_of is None or self.status[row] == Status.CANNOT_ASSEMBLE:
            raise ValueError(f"row {row} does not assemble")
        return self._case_of(row)

    @property
    def error(self) -> dict[str, Array]:
        """Bounds of the absolute rounding errors of the answers by load, (n,) [case units]."""
        return self.errors.get("answers", {})

    @property
    def kinds(self) -> dict[str, dict[str, Array]]:
        """The arrays, (n,) or (n, parts), by kind (``answers``, ``points``, ...) and name."""
        return {kind: getattr(self, kind) for kind in KINDS}


VECTORS = ("velocities", "accelerations")
MOTION = ("rates", *VECTORS, "angular_accelerations")
RECORDED = ("answers", "points", "centres", *MOTION, "terms")
"""What a record tells, of many rows at once."""
KINDS = (*RECORDED, "reactions")
LETTERS = {"rates": "w", "angular_accelerations": "a", "terms": "power "}


def by_kind(
    arrays: Mapping[tuple[str, str], Array], shown: Iterable[str] = KINDS
) -> dict[str, dict[str, Array]]:
    """Arrays by (kind, name) as arrays by kind and then by name; every kind that is shown is there, and no
    other."""
    kinds: dict[str, dict[str, Array]] = {kind: {} for kind in shown}
    for (kind, name), array in arrays.items():
        if kind in kinds:
            kinds[kind][name] = array
    return kinds


def by_key(kinds: Mapping[str, Mapping[str, Array]]) -> dict[Key, Array]:
    """Arrays by kind and then by name as arrays by (kind, name)."""
    return {(kind, name): array for kind, arrays in kinds.items() for name, array in arrays.items()}


# --- a sweep as it is filled ----------------------------------------------------------------------


class Table:
    """The rows of a sweep while they are filled; not a number where nothing was put.

    Attributes
    ----------
    codes : (rows,), places of the statuses in `WORDS`; 0 is ``ok``
    values, errors : by (kind, name), (rows,) or (rows, parts), as the arrays of `Sweep`; ``("touching",
        "2-3")`` has the place of a contact [case length], its pressure angle [degrees; nan: none], and 1
        where it is lost, (rows, 4)
    holds, locks : by load, (rows, 2) [case units] and (rows,), as in `Sweep`
    """

    def __init__(self, rows: int, asked: RowRequest) -> None:
        self.rows, self.asked = rows, asked
        self.codes: Codes = np.zeros(rows, dtype=np.int8)
        self.values: dict[Key, Array] = {}
        self.errors: dict[Key, Array] = {}
        self.holds: dict[str, Array] = {}
        self.locks: dict[str, Mask] = {}

    def hold(self, name: str, rows: Rows | Mask | list[int] | slice, ends: Held, locks: Locks) -> None:
        """The ranges, (n, 2), over which a load holds in some rows, and whether it locks itself there."""
        self.holds.setdefault(name, np.full((self.rows, 2), np.nan))[rows] = ends
        self.locks.setdefault(name, np.zeros(self.rows, dtype=bool))[rows] = locks

    def reserve(self, parts: Mapping[Key, int]) -> None:
        """Arrays by (kind, name), of so many numbers a row, for what will be put into every row."""
        self.values |= {k: np.empty(self.rows if n == 1 else (self.rows, n)) for k, n in parts.items()}

    def put(self, kind: str, name: str, row: int, value: Value, error: Value | None = None) -> None:
        """One value, a float or a tuple of parts, and the bound of its absolute error where one is proven."""
        shape = (self.rows,) if isinstance(value, float) else (self.rows, len(value))
        self._table(self.values, (kind, name), shape)[row] = value
        self._table(self.errors, (kind, name), shape)[row] = np.nan if error is None else error

    def leave_open(self, kind: str, name: str, row: int) -> None:
        """No value: what the record has of it, as of every other row, this row does not have."""
        for tables in (self.values, self.errors):
            if (kind, name) in tables:
                tables[kind, name][row] = np.nan

    def _table(self, tables: dict[Key, Array], key: Key, shape: tuple[int, ...]) -> Array:
        """The array of a kind and name; not a number where nothing was put."""
        if key not in tables:
            tables[key] = np.full(shape, np.nan)
        return tables[key]

    def refuse(self, row: int, error: SceneError) -> None:
        """A row without an answer."""
        self.codes[row] = CODE.get(error.status, OTHER)

    def some(self, rows: Rows | list[int]) -> Table:
        """Some rows, by their indices (n,), as a table of their own (copies)."""
        part = Table(len(rows), self.asked)
        part.codes = self.codes[rows]
        part.values = {key: array[rows] for key, array in self.values.items()}
        part.errors = {key: array[rows] for key, array in self.errors.items()}
        for name, ends in self.holds.items():
            part.hold(name, ALL, ends[rows], self.locks[name][rows])
        return part

    def take(self, rows: Rows | list[int], part: Table | Sweep, of: Rows | slice = ALL) -> None:
        """The rows ``rows``, (n,) indices, from a table or a sweep of these n rows alone, or from the rows
        ``of`` of it."""
        self.codes[rows] = part.codes[of]
        values, errors = (
            (by_key(part.kinds), by_key(part.errors))
            if isinstance(part, Sweep)
            else (part.values, part.errors)
        )
        for mine, arrays in ((self.values, values), (self.errors, errors)):
            for key, array in arrays.items():
                self._table(mine, key, (self.rows, *array.shape[1:]))[rows] = array[of]
        for name, ends in part.holds.items():
            self.hold(name, rows, ends[of], part.locks[name][of])

    def fill(self, row: int, answer: Answer, missing: bool = False) -> None:
        """All that is asked of a solved row; or only the answers that it does not have yet."""
        asked, case = self.asked, answer.case
        for name, found in by_load(answer.answers).items() if asked.answers else ():
            if missing and not np.isnan(self.values["answers", name][row]):
                continue
            value = float(found.value) if found.holds is None else np.nan
            self.put("answers", name, row, value, found.error)
            if found.holds is not None:
                self.codes[row] = CODE["holds"]
                self.hold(name, [row], found.holds, found.self_locking)
        if missing and not self.lacks(row):
            return
        centres = not missing or self.lacks(row, "centres")
        for one in answer.touching:
            angle = np.nan if one.pressure_angle is None else one.pressure_angle
            self.put("touching", "-".join(one.links), row, (*one.at, angle, float(one.lost)))
        for name in asked.points if not missing else ():
            if name in answer.points:
                self.put("points", name, row, answer.points[name], answer.errors.get("points", {}).get(name))
        self._fill_motion(row, answer)
        self._fill_forces(row, answer)
        loads = {load.name for load in case.loads}  # the power of friction is none of a unit of a load
        for term in answer.terms if asked.terms else ():
            if term.load in loads:
                self.put("terms", term.load, row, term.factor)
        for pair in asked.centres if centres else ():
            triple = _triple(answer, pair)
            name = pair_name(case, pair)
            if triple is not None:
                self.put("centres", name, row, triple, _centre_error(answer, pair))
            else:
                self.leave_open("centres", name, row)

    def _fill_motion(self, row: int, answer: Answer) -> None:
        """Rates, velocities and accelerations, where they are asked; of those that are open none."""
        for kind in (kind for kind in MOTION if getattr(self.asked, kind.removeprefix("angular_"))):
            errors = answer.errors.get(kind, {})
            for key, value in (getattr(answer, kind) or {}).items():
                name = spot_name(key)
                if isinstance(value, str):
                    self.leave_open(kind, name, row)
                elif is_named(name):
                    self.put(kind, name, row, value, errors.get(key, 0.0 if value == 0.0 else None))

    def _fill_forces(self, row: int, answer: Answer) -> None:
        """Forces in joints and pulls of ropes, where they are asked; of those that are open none."""
        for name, force in (answer.reactions or {}).items() if self.asked.reactions else ():
            parts = tuple(np.nan if part is None else part for part in (force.x, force.y, force.moment))
            bounds = tuple(force.errors.get(part) or 0.0 for part in ("x", "y", "moment"))
            self.put("reactions", name, row, parts, bounds if force.errors else None)
        for pull in answer.tensions if self.asked.reactions else ():
            self.put(
                "reactions", pull.name, row, np.nan if pull.tension is None else pull.tension, pull.error
            )

    def lacks(self, row: int, *kinds: str) -> bool:
        """Whether a row lacks a number of what moves in it (or of some kinds of these), as where what scales
        the others stands still, or where the record divides by what is zero there; or a centre, where it has
        lines that coincide meet."""
        kinds = kinds or ("centres", *MOTION)
        some = [(kind, array[row]) for (kind, _), array in self.values.items() if kind in kinds]
        return any(np.isnan(at).any() or (kind == "centres" and not at.any()) for kind, at in some)

    def sweep(
        self,
        case: Case,
        vary: dict[str, Array],
        error: bool,
        notes: tuple[str, ...],
        case_of: Callable[[int], Case],
    ) -> Sweep:
        """The table as a sweep.

        Parameters
        ----------
        vary : by path or link, what was varied, (rows,)
        error : whether bounds of errors were wanted
        case_of : the case of a row, by its index
        """
        if self.asked.answers and not any(kind == "answers" for kind, _ in self.values):  # no row has one
            for name in loads_to_find(case):
                self._table(self.values, ("answers", name), (self.rows,))
        return Sweep(
            case,
            vary,
            **by_kind(self.values),
            errors=by_kind(self.errors) if error else {},
            holds=self.holds,
            locks=self.locks,
            notes=notes,
            codes=self.codes,
            _case_of=case_of,
        )


def _triple(answer: Answer, pair: tuple[str, str]) -> tuple[float, float, float] | None:
    centre = answer.centres.get(pair)
    if centre is None or centre.kind == "undetermined":
        return None
    if centre.kind == "at":
        return (centre.place[0], centre.place[1], 1.0)
    if centre.kind == "toward":
        return (*turn_of(centre.place[0]), 0.0)
    return (0.0, 0.0, 0.0)


def _centre_error(answer: Answer, pair: tuple[str, str]) -> tuple[float, float, float] | None:
    """Bounds of the coordinates of `_triple`, of which the weight is exact."""
    centre = answer.centres[pair]
    if centre.kind not in ("at", "toward"):
        return (0.0, 0.0, 0.0)
    if centre.error is None:
        return None
    error = centre.error if centre.kind == "at" else float(np.radians(centre.error)) + UNIT
    return (error, error, 0.0)


# --- a sweep as it is written ---------------------------------------------------------------------

PART = 8192
"""Rows that are written at once."""


def columns(sweep: Sweep) -> dict[str, Array]:
    """Every array of numbers of a sweep as columns of its table, by name, (n,) each: ``C.x``, ``I2-4.w``,
    ``w3``.
    """
    table: dict[str, Array] = dict(sweep.vary)
    for kind, arrays in sweep.kinds.items():
        bounds = sweep.errors.get(kind, {})
        for name, array in arrays.items():
            table |= _parted(kind, name, array)
            if name in bounds:
                table |= {f"error {n}": bound for n, bound in _parted(kind, name, bounds[name]).items()}
    for name, array in sweep.holds.items():
        table |= {f"{name} from": array[:, 0], f"{name} to": array[:, 1]}
    return table


def _parted(kind: str, name: str, array: Array) -> dict[str, Array]:
    """The columns of one array."""
    if kind == "points":
        return {f"{name}.x": array[:, 0], f"{name}.y": array[:, 1]}
    if kind == "reactions" and array.ndim > 1:
        return {f"{name}.{part}": array[:, k] for k, part in enumerate(("x", "y", "moment"))}
    if kind in VECTORS:
        return {f"{kind[0]} {name}.{axis}": array[:, k] for k, axis in enumerate("xy")}
    if kind == "centres":
        return {f"I{name}.{axis}": array[:, k] for k, axis in enumerate("xyw")}
    return {f"{LETTERS.get(kind, '')}{name}": array}


def as_csv(sweep: Sweep) -> Iterator[bytes]:
    """A header and a line a row, UTF-8; what is not a number stands empty beside its status. Numbers have the
    fewest digits that give the same double again.
    """
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerow([*columns(sweep), "status"])
    yield out.getvalue().encode("utf-8")
    for part in _parts(sweep, {"nan": ""}):
        yield ("\n".join(map(",".join, zip(*part, strict=True))) + "\n").encode("utf-8")


IN_JSON = {"nan": "null", "inf": "Infinity", "-inf": "-Infinity"}


def as_jsonl(sweep: Sweep) -> Iterator[bytes]:
    """An object a row; what is not a number is null."""
    names = [json.dumps(name).replace("%", "%%") for name in columns(sweep)]
    form = "{" + "".join(f"{name}: %s, " for name in names) + '"status": "%s"}\n'
    for part in _parts(sweep, IN_JSON):
        yield "".join(map(form.__mod__, zip(*part, strict=True))).encode("utf-8")


def as_npz(sweep: Sweep) -> Iterator[bytes]:
    """The arrays of the sweep in one npz, under the names of the columns."""
    out = io.BytesIO()
    arrays: Mapping[str, Any] = {**columns(sweep), "status": sweep.status}
    np.savez(out, **arrays)
    yield out.getvalue()


FORMATS: dict[str, Callable[[Sweep], Iterator[bytes]]] = {
    ".csv": as_csv,
    ".jsonl": as_jsonl,
    ".npz": as_npz,
}


def _parts(sweep: Sweep, words: Mapping[str, str]) -> Iterator[list[list[str]]]:
    """The columns of so many rows after another, as texts; the status in words last."""
    table = columns(sweep)
    for start in range(0, len(sweep), PART):
        rows = slice(start, start + PART)
        statuses = [WORDS[code] for code in sweep.codes[rows].tolist()]
        yield [*(_texts(column[rows], words) for column in table.values()), statuses]


def _texts(column: Array, words: Mapping[str, str]) -> list[str]:
    """Numbers in the fewest digits that give the same double again; ``words`` for what is none."""
    texts = list(map(repr, (column + 0.0).tolist()))
    for k in np.flatnonzero(~np.isfinite(column)).tolist():
        texts[k] = words.get(texts[k], texts[k])
    return texts
