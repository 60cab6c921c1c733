"""What a sweep is asked: columns of varied numbers, zipped, and what is wanted of every row."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from icsolve.assembly.workspace import names_of
from icsolve.case import Case, Pair, is_angle, is_named
from icsolve.errors import refuse_other
from icsolve.numbers.replay import Array
from icsolve.numbers.units import BOUNDS
from icsolve.read.names import pairs, shown, suggestion
from icsolve.statics.power import is_unknown
from icsolve.sweep.program import RowRequest
from icsolve.sweep.recorded_scene import pairs as all_pairs
from icsolve.sweep.varied_numbers import find_number, number_at
from icsolve.tuples import NamedTuple
from icsolve.wording import listed

WORDS = (
    *("answers", "status", "error", "points", "centres", "rates", "velocities", "accelerations"),
    *("terms", "reactions"),
)


class RequestError(ValueError):
    """What is asked of a sweep makes no sense: the message says what would."""


MOST_NUMBERS = 400_000_000
"""More numbers than these (3 GB) are not made at once."""
MOST_PAIRS = 100_000
FARTHEST = 1e7
"""Degrees: what is farther takes as many steps on the way as would fill the memory."""


class Columns(NamedTuple):
    """What varies, row by row.

    Attributes
    ----------
    paths : by path, numbers in case units, angles in degrees, (rows,) each
    links : by link, degrees by which it is turned from the position as written, (rows,) each
    names : by path or link, as it was asked for
    """

    paths: dict[str, Array]
    links: dict[str, Array]
    names: dict[str, str]
    """by path or link, as it was asked for"""

    @property
    def arrays(self) -> dict[str, Array]:
        """All of them by path or link, (rows,) each."""
        return {**self.links, **self.paths}

    @property
    def rows(self) -> int:
        """Number of rows."""
        return len(next(iter((self.paths or self.links).values())))


def columns_of(
    case: Case, vary: Mapping[str, npt.ArrayLike] | None, drive: Mapping[str, npt.ArrayLike] | None
) -> Columns:
    """The columns of a sweep; single numbers are the same in every row.

    Parameters
    ----------
    vary, drive : by path, by link: values, (rows,) or one number

    Raises
    ------
    RequestError
        A ValueError, for arrays that can't be columns and numbers that no case may have there.
    CaseError
        For paths that the case does not have.
    """
    for columns, wanted in (
        (vary, "vary has values by path, as vary={'angles.AB': values}"),
        (drive, "drive has degrees by link, as drive={'2': degrees}"),
    ):
        refuse_other(columns or {}, Mapping, wanted)
    for path in vary or {}:
        refuse_other(path, str, "a path is a text, as 'angles.AB'")
    asked = [(path, _column(path, values), False) for path, values in (vary or {}).items()]
    asked += [(str(link), _column(str(link), values), True) for link, values in (drive or {}).items()]
    if not asked:
        raise RequestError("nothing is varied: give vary={'angles.AB': values} or drive={'2': degrees}")
    rows = max(array.size for _, array, _ in asked)
    found = Columns({}, {}, {})
    for name, array, turned in asked:
        if array.ndim and len(array) != rows:
            raise RequestError(f"{shown(name)} has {len(array)} values where another has {rows}")
        own = _link(case, name) if turned else _path(case, name)
        if own in found.names:
            raise RequestError(f"{shown(name)} and {shown(found.names[own])} are the same number")
        found.names[own] = name
        bound = "" if turned else number_at(case, own).bound
        _refuse_values(name, bound, array, turned or is_angle(own))
        column = np.ascontiguousarray(array).view() if array.ndim else np.full(rows, array)
        column.flags.writeable = False
        (found.links if turned else found.paths)[own] = column
    return found


def along_of(case: Case, columns: Columns) -> str:
    """The one number (its path), or link, whose values are not all the same.

    Raises ValueError where none varies, or several do, and where no case has what lies between its values.
    """
    varying = [name for name, array in columns.arrays.items() if np.ptp(array) > 0.0]
    if not varying:
        name = shown(next(iter(columns.names.values())))
        raise RequestError(f"positions are found along a range, and {name} has one value: give FROM:TO:STEP")
    if len(varying) > 1:
        raise RequestError("positions are found along one varied number")
    own = varying[0]
    if own in columns.paths and any(limit.than == "whole" for limit in BOUNDS[number_at(case, own).bound]):
        said = f"{shown(columns.names[own])} is whole: vary it for a row of each"
        raise RequestError(f"positions are found along numbers that may have any value, and {said}")
    return own


@lru_cache(maxsize=256)
def _path(case: Case, name: str) -> str:
    return find_number(case, name).path


def array_of(name: str, values: npt.ArrayLike) -> Array:
    """Values as an array, not a number where a mask hides one. Raises RequestError for what is no number."""
    try:
        if np.iscomplexobj(values):
            raise TypeError
        found = np.asarray(values, dtype=np.float64)
        return np.where(np.ma.getmaskarray(values), np.nan, found) if np.ma.isMA(values) else found
    except (TypeError, ValueError, OverflowError):
        raise RequestError(
            f"the values of {shown(name)} should be numbers, in the units of the case"
        ) from None


def names_in(names: Iterable[str] | str, example: str) -> tuple[str, ...]:
    """One name or several. Raises ArgumentError for what is none; ``example`` is what to write."""
    wanted = f"names are wanted, as {example}"
    some = (names,) if isinstance(names, str) else names
    refuse_other(some, Iterable, wanted)
    for name in (found := tuple(some)):
        refuse_other(name, str, wanted)
    return found


def _column(name: str, values: npt.ArrayLike) -> Array:
    array = array_of(name, values)
    if array.ndim > 1:
        raise RequestError(
            f"the values of {shown(name)} should be one row of numbers, not {array.ndim} dimensions"
        )
    if not array.size:
        raise RequestError(f"there are no values for {shown(name)}")
    if not np.isfinite(array).all():
        raise RequestError(f"the values of {shown(name)} are not all finite numbers")
    return array


def _refuse_values(name: str, bound: str, array: Array, turns: bool) -> None:
    """Refuse numbers that no case may have there, and turns that nobody would count."""
    for limit in BOUNDS[bound]:
        if not np.all(limit.holds(array)):
            raise RequestError(f"the values of {shown(name)} {limit.says}")
    if turns:
        refuse_far(name, array)


def refuse_far(name: str, degrees: Array) -> None:
    """Refuse turns that nobody would count, of which doubles leave too few digits to an angle."""
    beyond = np.abs(degrees) > FARTHEST
    if beyond.any() and np.isfinite(degrees[beyond]).any():
        raise RequestError(f"the values of {shown(name)} lie beyond {FARTHEST:.0f} degrees; take turns off")


def _link(case: Case, name: str) -> str:
    if name not in case.links:
        likely = suggestion(name, case.links) or f"; the links are {listed(case.links)}"
        raise RequestError(f"there is no link {shown(name)} to turn{likely}")
    return name


class SweepRequest(NamedTuple):
    """What is wanted of every row, in words and resolved; ``error``: the bounds of the answers."""

    asked: RowRequest
    error: bool
    words: tuple[str, ...] = ()


@lru_cache(maxsize=64)
def request_of(case: Case, want: tuple[str, ...], dynamic: bool = False) -> SweepRequest:
    """What is wanted: whole kinds (``points``) or single ones (``points.C``, ``centres.2-4``).

    Raises RequestError for a word that is none, and for accelerations without inertia forces.
    """
    points: dict[str, None] = {}
    centres: dict[Pair, None] = {}
    kinds = set()
    if "centres" in want and (count := len(case.links) * (len(case.links) - 1) // 2) > MOST_PAIRS:
        raise RequestError(f"all centres are {count}, more than a table has columns; ask for single ones")
    for word in want:
        kind, dot, name = word.partition(".")
        if kind not in WORDS or (dot and kind not in ("points", "centres")):
            likely = suggestion(word, WORDS) or f"; one of {', '.join(WORDS)}"
            raise RequestError(f"{shown(word)} can't be wanted{likely}")
        kinds.add(kind)
        if kind == "points":
            points.update(dict.fromkeys(_points(case, name) if dot else shown_points(case)))
        elif kind == "centres":
            centres.update(dict.fromkeys(_pairs(case, name) if dot else all_pairs(case)))
    if "accelerations" in kinds and not dynamic:
        raise RequestError(
            "accelerations are those of a motion with its inertia forces: ask for `dynamic` too"
        )
    answers = bool(kinds & {"answers", "error", "status", "terms"})
    moving = ("rates" in kinds, "velocities" in kinds, "accelerations" in kinds, dynamic)
    forces = "reactions" in kinds
    asked = RowRequest(
        answers or forces, tuple(points), tuple(centres), *moving, terms="terms" in kinds, reactions=forces
    )
    return SweepRequest(asked, "error" in kinds, want)


def told(case: Case, asked: RowRequest) -> RowRequest:
    """What has to be run: where no load is unknown, rates, so that the status means something."""
    unknown = any(map(is_unknown, case.loads))
    return asked if unknown or asked.rates or asked.centres else asked._replace(rates=True)


def refuse_size(columns: Columns, asked: RowRequest, error: bool) -> None:
    """Raise RequestError where the arrays would not fit."""
    width = len(columns.arrays) + 2 * len(asked.points) + 3 * len(asked.centres) + 2
    numbers = columns.rows * (width * 2 if error else width)
    if numbers > MOST_NUMBERS:
        raise RequestError(
            f"{columns.rows} rows of {width} columns are {numbers} numbers; at most {MOST_NUMBERS} fit. "
            "Ask for fewer rows, or for single points and centres."
        )


def shown_points(case: Case) -> list[str]:
    """The points that have a name in the case."""
    return [name for name in names_of(case) if is_named(name)]


def _points(case: Case, name: str) -> list[str]:
    known = shown_points(case)
    if name not in known:
        raise RequestError(f"there is no point {shown(name)}{suggestion(name, known)}")
    return [name]


def _pairs(case: Case, name: str) -> Iterable[Pair]:
    """The pair that a centre's name means, as the format lets it be written."""
    found = {frozenset(pair) for pair in pairs(name, lambda link: link in case.links)}
    meant = [pair for pair in all_pairs(case) if frozenset(pair) in found]
    if len(meant) != 1:
        raise RequestError(f"{shown(name)} is not a pair of links of this case; write it as 2-4")
    return meant
