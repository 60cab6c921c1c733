"""With friction a mechanism holds still over ranges of its free datum: about positions of equilibrium, and
wherever else friction is enough."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache, partial
from itertools import groupby

import numpy as np

from icsolve.case import Case, is_angle
from icsolve.case.joints import with_friction
from icsolve.errors import SceneError
from icsolve.numbers.roots import last_that_holds, zero_between
from icsolve.solve.driven_search import NOT_ALL, driven_mechanisms
from icsolve.solve.known_loads import Spare, moving_loads, spare_friction
from icsolve.solve.load_function import TogetherError
from icsolve.solve.positions import modes_and_branches, refuse_unwritten, search_modes, whole_range
from icsolve.solve.refinement import scene_at
from icsolve.statics.power import smooth
from icsolve.tuples import NamedTuple, replace

SAMPLES = 120


class Range(NamedTuple):
    """From where to where it holds still, the bounds of the errors of both, and the case in between."""

    held: tuple[float, float]
    error: tuple[float, float]
    case: Case


class Ranges(NamedTuple):
    """The ranges by rising value, and sentences."""

    ranges: tuple[Range, ...]
    notes: tuple[str, ...]


class RoughMode(NamedTuple):
    """The scene at a value, without friction; the sampled values, and at which of them it assembles."""

    scene: Callable[[float], Case]
    values: list[float]
    usable: list[bool]


def find_ranges(case: Case, path: str, span: tuple[float, float] | None, start: float | None) -> Ranges:
    """All ranges in which a mechanism with friction holds still.

    Every position of equilibrium without friction lies in one; between them the range is sampled, and the
    ends are closed in on to the last digit. Parameters as of `icsolve.solve.positions.find_positions`.
    """
    low, high = span or whole_range(case, path)
    even = np.linspace(low, high, SAMPLES + 1).tolist()
    notes = [
        f"between positions of equilibrium without friction, {path} was sampled at {SAMPLES} values for "
        "ranges in which friction alone is enough."
    ]
    try:
        modes = _in_modes(smooth(case), path, (low, high), start, even, span is None, notes)
    except TogetherError:
        modes, complete = _in_driven_modes(smooth(case), path, (low, high), start, even, span is None)
        notes += [] if complete else [NOT_ALL]
    turns = span is None and is_angle(path)
    found = [one for mode in modes for one in _runs(case, mode, turns)]
    ends = [] if turns else [end for end in (low, high) if any(end in one.held for one in found)]
    notes += [f"at {path} = {end:g} the search ends: it holds still there, and may beyond." for end in ends]
    return Ranges(tuple(_joined(sorted(found, key=lambda one: one.held))), tuple(notes))


def _in_modes(
    case: Case,
    path: str,
    span: tuple[float, float],
    start: float | None,
    even: list[float],
    whole: bool,
    notes: list[str],
) -> list[RoughMode]:
    """The modes of a figure whose points have places one by one."""
    functions, _, branches, kept = modes_and_branches(case, path, span, start, not whole, notes)
    search = search_modes(functions, branches, kept, whole)
    modes = []
    for n, function in enumerate(functions):
        values = sorted({*even, *(p.value for m, p in search if m == n)})
        on = [branches.on(n, v) for v in values]
        usable = [k >= 0 and (kept is None or k in kept) for k in on]
        modes.append(RoughMode(partial(scene_at, function), values, usable))
    return modes


def _in_driven_modes(
    case: Case, path: str, span: tuple[float, float], start: float | None, even: list[float], whole: bool
) -> tuple[list[RoughMode], bool]:
    """The ways of a figure whose points only together have places, along its motion; whether these are all
    of them."""
    driven, complete = driven_mechanisms(case, path, span, start, ())
    if start is None:
        refuse_unwritten(case, path, driven[0].links, not whole)
    modes = []
    for one in driven:
        rests = [] if one.balances_everywhere() else one.rests()
        values = sorted({*even, *(rest.value for rest in rests)})
        places = one.places(np.array(values))[1]
        modes.append(RoughMode(one.scene, values, [not np.isnan(at).any() for at in places]))
    return modes, complete


def _rough(case: Case, row: Case) -> Case:
    """A scene with the friction of the case."""
    joints = map(with_friction, row.joints, case.joints)
    ropes = (rope._replace(mu=own.mu) for rope, own in zip(row.ropes, case.ropes, strict=True))
    return replace(row, joints=tuple(joints), ropes=tuple(ropes))


def edge_of_rest(spare: Callable[[float], Spare], inside: float, outside: float) -> Spare:
    """The last value at which a mechanism holds still (its spare friction is not negative) between two of
    which it holds at the first, and the bound of its error.

    It is closed in on near the zero that Brent's method finds, or at 0, else by halving, to far below the
    last digit of the places between which it was sought. It may lie as far to either side as the error of
    the spare friction leaves its sign open.
    """
    whole, least = (inside, outside), FINEST * math.ulp(max(abs(inside), abs(outside)))

    def is_held(value: float) -> bool:
        return spare(value)[0] >= 0.0

    def narrowed(*values: float) -> tuple[float, float]:
        a, b = inside, outside
        for value in values:
            if min(a, b) < value < max(a, b):
                a, b = (value, b) if is_held(value) else (a, value)
        return a, b

    inside, outside = narrowed(0.0, least, -least)
    at_inside, at_outside = spare(inside)[0], spare(outside)[0]
    if math.isfinite(at_inside - at_outside):
        zero = zero_between(lambda value: spare(value)[0], inside, outside, at_inside, at_outside)
        reach = 2.0 * math.ulp(zero)
        inside, outside = narrowed(zero, zero - reach, zero + reach)
    last, beyond = last_that_holds(is_held, inside, outside, least)
    return last, max(_open(spare, last, max(abs(beyond - last), least), end) for end in whole)


WIDER = 8.0


def _open(spare: Callable[[float], Spare], last: float, step: float, end: float) -> float:
    """So far from the last value that holds, toward an end, the error of the spare friction leaves its sign
    open; first the ``step`` to the next value is looked at."""
    reach = math.copysign(step, end - last)
    while abs(reach) < abs(end - last):
        value, error = spare(last + reach)
        if abs(value) > error:
            return abs(reach)
        reach *= WIDER
    return abs(end - last)


FINEST = 2.0**-20
"""Toward 0 doubles have no end: nobody asks for more digits of a place beside it."""


def _runs(case: Case, mode: RoughMode, turns: bool) -> list[Range]:
    """Ranges of one mode: runs of values at which it holds, with their ends."""
    values = mode.values

    @cache  # what was sampled is asked again where a run ends
    def spare(value: float) -> Spare:
        try:
            return spare_friction(moving_loads(_rough(case, mode.scene(value))))
        except SceneError:  # it does not assemble
            return -math.inf, 0.0

    def end(inside: int, outside: int) -> tuple[float, float]:
        if not 0 <= outside < len(values):
            return values[inside], 0.0
        return edge_of_rest(spare, values[inside], values[outside])

    holding = [usable and spare(value)[0] >= 0.0 for value, usable in zip(values, mode.usable, strict=True)]
    found = []
    for holds_there, group in groupby(range(len(values)), key=holding.__getitem__):
        if holds_there:
            run = list(group)
            (start, off_start), (stop, off_stop) = end(run[0], run[0] - 1), end(run[-1], run[-1] + 1)
            middle = _rough(case, mode.scene(values[run[len(run) // 2]]))
            found.append(Range((start, stop), (off_start, off_stop), middle))
    if turns and len(found) > 1 and holding[0] and holding[-1]:
        head, tail = found[0], found.pop()
        found[0] = Range((tail.held[0], head.held[1] + 360.0), (tail.error[0], head.error[1]), tail.case)
    return found


def _joined(found: Sequence[Range]) -> list[Range]:
    """Ranges that two modes share, once."""
    kept: list[Range] = []
    for one in found:
        same = any(max(abs(a - b) for a, b in zip(one.held, k.held, strict=True)) <= 1e-9 for k in kept)
        if not same or one.case.near not in [k.case.near for k in kept]:
            kept.append(one)
    return kept
