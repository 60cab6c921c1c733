"""With friction a mechanism holds still over ranges of its free datum: about positions of equilibrium, and
wherever else friction is enough."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from icsolve.case import Case, Torque
from icsolve.case.joints import without_friction
from icsolve.errors import SceneError, Status
from icsolve.kinematics.speeds import joint_order
from icsolve.scene import solve_scene
from icsolve.solve.branches import Branches
from icsolve.solve.load_function import LoadFunction, load_functions, refuse_unposed
from icsolve.solve.positions import refuse_history, scene_at, search_modes, whole_range
from icsolve.solve.rest import PROBE
from icsolve.tuples import NamedTuple, replace

SAMPLES = 120


class Range(NamedTuple):
    """From where to where it holds still, the bounds of the errors of both, and the case in between."""

    held: tuple[float, float]
    error: tuple[float, float]
    case: Case


class Ranges(NamedTuple):
    """The ranges by rising value, sentences, and where the loads come nearest to holding."""

    ranges: tuple[Range, ...]
    notes: tuple[str, ...]
    nearest: float | None


def find_ranges(case: Case, path: str, span: tuple[float, float] | None) -> Ranges:
    """All ranges in which a mechanism with friction holds still.

    Every position of equilibrium without friction lies in one; between them the range is sampled, and the
    ends are closed in on to the last digit.
    """
    low, high = span or whole_range(case, path)
    ropes = tuple(rope._replace(mu=(None,) * len(rope.mu)) for rope in case.ropes)
    smooth = replace(case, joints=tuple(map(without_friction, case.joints)), ropes=ropes)
    functions, _ = load_functions(smooth, path, low, high)
    refuse_history(smooth, path, functions[0].links)
    refuse_unposed(functions[0])
    branches = Branches(functions, low, high)
    kept = branches.nearest(case) if case.near else None
    search = search_modes(functions, branches, kept, low, high, span is None)
    turns = span is None and path.startswith("angles.")
    found: list[Range] = []
    for n, function in enumerate(functions):
        rough = function._replace(case=replace(function.case, joints=case.joints, ropes=case.ropes))
        seeds = [p.value for m, p in search if m == n]
        values = sorted({*np.linspace(low, high, SAMPLES + 1).tolist(), *seeds})
        usable = [v for v in values if branches.on(n, v) >= 0 and (kept is None or branches.on(n, v) in kept)]
        found += _runs(rough, usable, values, turns)
    found.sort(key=lambda one: one.held)
    note = (
        f"between positions of equilibrium without friction, {path} was sampled at {SAMPLES} values for "
        "ranges in which friction alone is enough."
    )
    return Ranges(tuple(_joined(found)), (note,), None)


def _holds(function: LoadFunction, value: float) -> bool:
    """Whether the mechanism holds still: zero lies among the values of a torque at which it does."""
    return holds_as_written(scene_at(function, value))


def holds_as_written(case: Case) -> bool:
    """Whether a mechanism under known loads holds still as it is written."""
    links = [link for link in joint_order(case) if link != case.ground]
    bare = replace(case, motion=(), expect=())
    for link in links:
        try:
            found = solve_scene(replace(bare, loads=(*bare.loads, Torque(PROBE, link, None)))).answers[PROBE]
        except SceneError as error:
            if error.status == Status.ANY_VALUE:  # the loads balance without friction
                return True
            continue
        low, high = found.holds or (found.value, found.value)
        return low <= 0.0 <= high
    return False


def _runs(
    function: LoadFunction, usable: Sequence[float], values: Sequence[float], turns: bool
) -> list[Range]:
    """Ranges of one mode: runs of values at which it holds, with their ends."""
    holding = {v: _holds(function, v) for v in usable}
    order = [v for v in values if v in holding]
    runs: list[list[float]] = []
    for before, v in zip([None, *order[:-1]], order, strict=True):
        if holding[v]:
            if runs and before is not None and holding[before]:
                runs[-1].append(v)
            else:
                runs.append([v])
    result = []
    for run in runs:
        first, last = order.index(run[0]), order.index(run[-1])
        start, off_start = _end(function, run[0], order[first - 1] if first else None)
        stop, off_stop = _end(function, run[-1], order[last + 1] if last + 1 < len(order) else None)
        middle = run[len(run) // 2]
        result.append(Range((start, stop), (off_start, off_stop), scene_at(function, middle)))
    if turns and len(result) > 1 and result[0].held[0] <= values[0] and result[-1].held[1] >= values[-1]:
        first_, last_ = result[0], result.pop()
        whole = (last_.held[0], first_.held[1] + 360.0)
        result[0] = Range(whole, (last_.error[0], first_.error[1]), last_.case)
    return result


def _end(function: LoadFunction, inside: float, outside: float | None) -> tuple[float, float]:
    """The last value at which it holds, toward one at which it does not; the range's own end without one."""
    if outside is None:
        return inside, 0.0
    return _closed_in(lambda value: _holds(function, value), inside, outside)


def _closed_in(holds: Callable[[float], bool], inside: float, outside: float) -> tuple[float, float]:
    while True:
        middle = 0.5 * (inside + outside)
        if middle in (inside, outside):
            return inside, 2.0 * abs(outside - inside)
        inside, outside = (middle, outside) if holds(middle) else (inside, middle)


def _joined(found: Sequence[Range]) -> list[Range]:
    """Ranges that two modes share, once."""
    kept: list[Range] = []
    for one in found:
        same = any(max(abs(a - b) for a, b in zip(one.held, k.held, strict=True)) <= 1e-9 for k in kept)
        if not same or one.case.near not in [k.case.near for k in kept]:
            kept.append(one)
    return kept
