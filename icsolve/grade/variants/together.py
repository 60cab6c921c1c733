"""Whether many variants of a case suit, which mistakes they show, and their keys, all in one sweep."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from icsolve.answer import Answer
from icsolve.case import Case, Coordinates, Corner, Force, Load, Number, Slope, Torque, Toward, Weight
from icsolve.case.names import pair_name
from icsolve.errors import IcsolveError
from icsolve.grade.mistakes.changed import known_loads, same_kind
from icsolve.grade.variants.family import (
    Array,
    Columns,
    Family,
    Mask,
    Rows,
    UnsuitedError,
    Values,
    columns,
    written_numbers,
)
from icsolve.grade.variants.varied import APART, DRAWING, SWING, Mistake, Seen

_NOTHING = 1e-9
_FAR = 1e-9
"""A centre whose weight is below this part of its place lies at infinity."""


class Slip(NamedTuple):
    """A mistake with its wrong answer in each row, not a number where it can't be made."""

    code: str
    where: str
    value: Array


def slips(family: Family, columns: Columns, rows: Rows) -> Iterator[Slip]:
    """The mistakes of loads and centres."""
    count = len(rows.value)
    run = _Loads(family, columns, rows)
    known = list(known_loads(family.case))
    base = {load.name: run.without(load) if len(known) > 1 else np.zeros(count) for load in known}
    for load in known:
        if len(known) > 1:
            yield Slip("missed-load", load.name, base[load.name])
            yield Slip("load-sense", load.name, run.reversed(load))
        quarter = run.turned(load)
        if quarter is not None:
            yield from _component(load, rows.value, base[load.name], quarter)
    yield from _own_direction(run, rows.value)
    shares = {name: rows.value - value for name, value in base.items()}
    yield from _of_centres(family, columns, rows, shares)


class _Loads:
    """The unknown under changed loads."""

    def __init__(self, family: Family, columns: Columns, rows: Rows) -> None:
        self.family, self.columns, self.rows = family, columns, rows
        self.count = len(rows.value)
        self.headings = {
            load.name: found
            for load in family.case.loads
            if (found := heading(load, family, columns, rows)) is not None
        }
        self.by_angle = family.with_loads(tuple(map(self._by_angle, family.case.loads)))

    def _by_angle(self, load: Load) -> Load:
        """A force whose direction is a number that can be turned."""
        if load.name not in self.headings:
            return load
        angle = Number(float(self.headings[load.name].flat[0]), 0.0, f"loads.{load.name}.angle", "0")
        if isinstance(load, Weight):
            return Force(load.name, load.link, load.at, load.value, angle)
        assert isinstance(load, Force)
        return load._replace(heading=angle, turns_with=None)

    def _number(self, load: Load) -> Array:
        return self.family.number(f"loads.{load.name}", self.columns, self.count)

    def without(self, load: Load) -> Array:
        """Missed."""
        return self.family.values({**self.columns, f"loads.{load.name}": np.zeros(self.count)}, self.count)

    def reversed(self, load: Load) -> Array:
        """Of the wrong sign."""
        return self.family.values({**self.columns, f"loads.{load.name}": -self._number(load)}, self.count)

    def turned(self, load: Load) -> Array | None:
        """A quarter turn on."""
        if load.name not in self.headings:
            return None
        angles = {f"loads.{name}.angle": array for name, array in self.headings.items()}
        angles[f"loads.{load.name}.angle"] = angles[f"loads.{load.name}.angle"] + 90.0
        runner = self.by_angle
        columns = {**self.columns, **angles}
        given = self.family.given(runner, columns)
        return runner.run(given, self.count).values["answers", self.family.unknown]


def heading(load: Load, family: Family, columns: Columns, rows: Rows) -> Array | None:
    """The direction of a positive force in degrees, in each row; None for a torque."""
    count = len(rows.value)
    if isinstance(load, Weight):
        return np.full(count, -90.0)
    if not isinstance(load, Force):
        return None
    match load.heading:
        case Number(path=path):
            return family.number(path, columns, count)
        case Slope(run, rise):
            x, y = (family.number(part.path, columns, count) for part in (run, rise))
            back = 0.0
        case Toward(point, away):
            x, y = (rows.points[point] - rows.points[load.at]).T
            back = 180.0 if away else 0.0
    found: Array = np.degrees(np.arctan2(y, x)) + back
    return found


def _component(load: Load, right: Array, base: Array, quarter: Array) -> Iterator[Slip]:
    """The whole velocity, and the component square to it (`malrules.loads._component`)."""
    along, across = right - base, quarter - base
    across = np.where(np.abs(across) <= _NOTHING * np.abs(along), np.nan, across)
    yield Slip("no-cos", load.name, base + np.copysign(np.hypot(along, across), along))
    square = np.copysign(across, along)
    yield Slip("sin-cos", load.name, base + square)
    yield Slip("sin-cos", load.name, base - square)


def _own_direction(run: _Loads, value: Array) -> Iterator[Slip]:
    """The same for an unknown force."""
    own = next(load for load in run.family.case.loads if load.name == run.family.unknown)
    across = run.turned(own)
    if across is None:
        return
    works = (across != 0.0) & (np.abs(across) < np.abs(value) / _NOTHING)
    across = np.where(works, across, np.nan)  # square to its motion it balances nothing
    yield Slip("no-cos", own.name, np.copysign(1.0 / np.hypot(1.0 / value, 1.0 / across), value))
    yield Slip("sin-cos", own.name, np.copysign(across, value))


# --- ratios and distances ---------------------------------------------------------------------------


def _of_centres(
    family: Family, columns: Columns, rows: Rows, shares: dict[str, Array]
) -> Iterator[Slip]:
    """A ratio upside down, a distance from another centre (`malrules.centres.centre_wrongs`)."""
    case, value = family.case, rows.value
    own = next(load for load in case.loads if load.name == family.unknown)
    for load in known_loads(case):
        part = shares[load.name]
        number = family.number(f"loads.{load.name}", columns, len(value))
        for ratio, where in _upside_down(rows, load, own, -part / number):
            yield Slip("inverse-ratio", where, value + part * (ratio**-2 - 1.0))
        for factor, where in (*_arms(family, columns, rows, load), *_ratios(family, rows, load, own)):
            yield Slip("wrong-ic", where, value + part * (factor - 1.0))
    for factor, where in _arms(family, columns, rows, own):
        yield Slip("wrong-ic", where, value / factor)


def _upside_down(rows: Rows, load: Load, own: Load, factors: Array) -> Iterator[tuple[Array, str]]:
    first, second = rows.rates.get(load.link), rows.rates.get(own.link)
    if first is not None and second is not None and load.link != own.link:
        yield _quotient(first, second), f"links {own.link} and {load.link}"
    if same_kind(load, own):
        yield np.where(factors == 0.0, np.nan, factors), f"{own.name} and {load.name}"


def _quotient(above: Array, below: Array) -> Array:
    """Not a number where either is zero."""
    return np.where((above == 0.0) | (below == 0.0), np.nan, above) / np.where(below == 0.0, np.nan, below)


def _arms(family: Family, columns: Columns, rows: Rows, load: Load) -> Iterator[tuple[Array, str]]:
    case, degrees = family.case, heading(load, family, columns, rows)
    reacting = getattr(load, "against", None) or case.ground
    centres = family.centres_of(rows, load.link)
    if isinstance(load, Torque) or degrees is None or reacting not in centres:
        return
    at = rows.points[load.at]
    right = _arm(at, degrees, centres[reacting])
    place = centres[reacting][:, :2] / centres[reacting][:, 2:]
    right = np.where(np.abs(right) < 1e-9 * (1.0 + np.hypot(*(at - place).T)), np.nan, right)
    for other, centre in centres.items():
        factor = _arm(at, degrees, centre) / right
        if other != reacting:
            yield np.where(factor == 0.0, np.nan, factor), f"I{pair_name(case, (load.link, other))}"


def _arm(at: Array, degrees: Array, centre: Array) -> Array:
    angle, place = np.radians(degrees), _place(centre)
    return (at[:, 0] - place[:, 0]) * np.sin(angle) - (at[:, 1] - place[:, 1]) * np.cos(angle)


def _place(centre: Array) -> Array:
    """Not numbers where it lies at infinity."""
    far = np.abs(centre[:, 2]) <= _FAR * np.hypot(centre[:, 0], centre[:, 1])
    return np.where(far[:, None], np.nan, centre[:, :2] / np.where(far, np.nan, centre[:, 2])[:, None])


def _ratios(family: Family, rows: Rows, load: Load, own: Load) -> Iterator[tuple[Array, str]]:
    case: Case = family.case
    mine, its = family.centres_of(rows, own.link), family.centres_of(rows, load.link)
    common, first, second = its.get(own.link), mine.get(case.ground), its.get(case.ground)
    if common is None or load.link == own.link or (first is None and second is None):
        return
    right = _distances(common, first, second)
    for centres, link in ((its, load.link), (mine, own.link)):
        for other, centre in centres.items():
            if {other, link} != {load.link, own.link} and other != case.ground:
                wrong = _distances(centre, first, second)
                yield _quotient(wrong, right), f"I{pair_name(case, (link, other))}"


def _distances(centre: Array, first: Array | None, second: Array | None) -> Array:
    """Distance from the first over that from the second; one at infinity counts for nothing."""
    ones = np.ones(len(centre))
    above, below = (ones if end is None else _apart(centre, end) for end in (first, second))
    return _quotient(above, below)


def _apart(one: Array, two: Array) -> Array:
    distance: Array = np.hypot(*(_place(one) - _place(two)).T)
    return distance


_PLAIN = 1e-6
"""A comparison is left to a scene of its own where it is as near as this to going the other way."""


class Together:
    """The variants of one case; ``answer`` is that of ``case``, one of them."""

    def __init__(self, text: str, case: Case, answer: Answer) -> None:
        """Raises UnsuitedError, SceneError where they can't be taken together."""
        self.numbers = written_numbers(text, case)
        self.family = Family(case, answer)
        if not {number.path for number in self.numbers} <= self.family.numbers.keys():
            raise UnsuitedError("a variable stands in a joint")

    def seen(self, draws: Sequence[Values]) -> list[Seen | None]:
        """Each variant; None for one that has to be looked at as a scene of its own."""
        try:
            return look(self.family, columns(self.numbers, draws), len(draws))
        except (IcsolveError, LookupError, ArithmeticError, ValueError):
            return [None] * len(draws)  # what one of them can't be is for scenes of their own to say


def look(family: Family, given: Columns, count: int) -> list[Seen | None]:
    """The rows of a family; None for those that have to be looked at as scenes of their own."""
    with np.errstate(all="ignore"):
        rows = family.run(given, count)
        clear = rows.clear.copy()
        swing = _swing(family, given, rows) / (SWING * np.abs(rows.value))
        clear &= np.abs(swing - 1.0) > _PLAIN
        hidden: list[tuple[Mistake, Mask]] = []
        for slip in slips(family, given, rows):
            off = np.abs(slip.value - rows.value) / (APART * np.abs(rows.value))
            clear &= ~(np.abs(off - 1.0) <= _PLAIN)
            if (off <= 1.0).any():
                hidden.append(((family.unknown, slip.code, slip.where), off <= 1.0))
    return [_seen(row, hidden, swing, rows.value) if clear[row] else None for row in range(count)]


def _seen(row: int, hidden: list[tuple[Mistake, Mask]], swing: Array, value: Array) -> Seen:
    inside = frozenset(mistake for mistake, at in hidden if at[row])
    return Seen(bool(swing[row] < 1.0), inside, float(value[row]))


def _swing(family: Family, given: Columns, rows: Rows) -> Array:
    """By how much the answer may change where the figure is drawn to a thousandth of its size."""
    places = np.stack([rows.points[name] for name in family.named])
    size = np.hypot(*(places.max(axis=0) - places.min(axis=0)).T)
    case, slopes = family.case, family.slopes(given, len(rows.value))
    total = np.zeros(len(rows.value))
    for path in _lengths(case):
        total += np.abs(slopes[path]) * DRAWING * size
    for angle in case.angles:
        ends = [(angle.at, angle.a), (angle.at, angle.b)] if isinstance(angle, Corner) else [angle[:2]]
        if not {p for pair in ends for p in pair} <= rows.points.keys():
            continue  # of a point that nothing asks for
        arms = sum(1.0 / np.hypot(*(rows.points[p] - rows.points[q]).T) for p, q in ends)
        total += np.abs(slopes[angle.value.path]) * np.degrees(DRAWING * size * arms)
    return total


def _lengths(case: Case) -> Iterator[str]:
    """Paths of coordinates and lengths."""
    yield from (length.value.path for length in case.lengths)
    for place in case.points.values():
        if isinstance(place, Coordinates):
            yield from (number.path for number in place if number is not None)
