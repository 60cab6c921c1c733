"""Positions of equilibrium: every value of a free datum of the figure at which the loads balance."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterator, Sequence
from contextlib import suppress
from decimal import Decimal
from itertools import product

import numpy as np

from icsolve.answer import Answer
from icsolve.answer.equilibrium import Stiffness
from icsolve.assembly.modes import ways_of
from icsolve.case import (
    Case,
    Coordinates,
    Torque,
    TorsionSpring,
)
from icsolve.case.joints import Mesh, Rolling
from icsolve.errors import SceneError, Status
from icsolve.numbers.adjoint import gradient
from icsolve.numbers.intervals import Interval, enclose
from icsolve.numbers.replay import Code
from icsolve.scene import solve_scene
from icsolve.solve.branches import Branches, isolate, nearest
from icsolve.solve.followed import (
    NOT_ALL,
    LedMechanism,
    converted,
    exchanged,
    led_mechanisms,
    nearest_of,
    rate_of,
)
from icsolve.solve.load_function import (
    LoadFunction,
    TogetherError,
    given_at,
    load_functions,
    moving_function,
    refuse_unposed,
    with_other_ways,
    written_function,
)
from icsolve.solve.rest import AT_LIMIT, PROBE, Rest, held
from icsolve.sweep.exact import RowScenes, counted_about
from icsolve.sweep.numbers import find_number
from icsolve.tuples import NamedTuple, replace

STEPS = 64
BESIDE = 5e-4
"""Beside a change point a branch is looked at in steps of this fraction of the range."""
SPREAD = (255.0 * 2.0**-46, 618.0 * 2.0**-46)
"""What becomes of the rounding of loads at eight steps, 64 units each: of the value and slope one step on."""
APART = 1e-6
"""Points of two ways of assembling differ by more than this fraction of the figure's size."""
ESTIMATED = (
    "{path} = {value:g} is a change point, where no scene has an answer: the position there is found from "
    "the loads beside it, and its errors are estimates."
)
STRETCHES = 4
"""So many times the range of a length or a coordinate is made ten times longer."""
JUMP = 1e-5
"""Beside a zero, even one at which the load rises as steeply as a root, it is smaller than this fraction."""
DEGREES = 180.0 / math.pi


class Search(NamedTuple):
    """What was found over a range: positions by rising value, sentences, and where the loads come nearest."""

    path: str
    positions: tuple[Rest, ...]
    notes: tuple[str, ...]
    any_value: bool
    nearest: float | None


def find_positions(
    case: Case, path: str, span: tuple[float, float] | None, start: float | None = None
) -> Search:
    """All positions of equilibrium of a case whose datum at ``path`` is free.

    Parameters
    ----------
    case : all of its loads known, of one freedom
    span : the values that are searched, both included; None: a whole turn, or wherever it assembles
    start : where the figure is written, from which the mechanism then moves; None: every position is read
        anew

    Raises SceneError where the figure assembles nowhere, or `near` does not tell branches apart.
    """
    try:
        return _find_in_modes(case, path, span, start)
    except TogetherError:
        return _find_followed(case, path, span or whole_range(case, path), start, span is None)


def _find_in_modes(
    case: Case, path: str, span: tuple[float, float] | None, start: float | None = None, whole: bool = False
) -> Search:
    """The positions in all modes of a figure whose points have places one by one; raises TogetherError where
    it is to be ``whole`` and has too many."""
    low, high = span or whole_range(case, path)
    functions, complete = functions_of(case, path, (low, high), start, span is not None, whole)
    branches = Branches(functions, low, high)
    kept = branches.nearest(case) if case.near else None
    notes: list[str] = []
    meant = frozenset(branches.ids[branches.ids >= 0].tolist()) if kept is None else kept
    states = {branch: _balances_everywhere(functions, branches.samples(branch)) for branch in sorted(meant)}
    for state in states.values():
        if isinstance(state, SceneError):
            notes.append(f"in one way in which the figure assembles it has no answer: {state.message}")
    found_open = frozenset(branch for branch, state in states.items() if state is False)
    balanced = sum(state is True for state in states.values())
    if balanced and not found_open:
        return Search(path, (), (), True, None)
    if balanced:
        notes.append(_balanced(balanced, balanced + len(found_open)))
    stretches = [(branches, kept if found_open == meant else found_open)]
    if span is None and not path.startswith("angles."):
        stretches += _beyond(*stretches[0])
        notes += _unbounded(path, stretches)
    found = [
        rest
        for part, meant_there in stretches
        for _, rest in search_modes(functions, part, meant_there, span is None, notes)
    ]
    if not complete:
        notes.append(f"the figure has more than {len(functions)} ways of assembling: not all were searched.")
    least = None if found else _nearest(functions, stretches)
    rests = _settled_turns(found, path, span is None)
    return Search(path, tuple(rests), tuple(dict.fromkeys(notes)), False, least)


Stretch = tuple[Branches, frozenset[int] | None]
"""A part of what is searched, and which of its branches are meant (None: all)."""


def _beyond(branches: Branches, kept: frozenset[int] | None) -> list[Stretch]:
    """Ever longer stretches of a length or a coordinate beyond the sizes of the figure, as long as it still
    assembles at their ends: on a long guide loads may carry a block far away."""
    functions, found = branches.functions, list[Stretch]()
    for end, start in ((-1, 0), (0, -1)):
        here, meant = branches, kept
        for _ in range(STRETCHES):
            low, high = here.low, here.high
            if not here.whole[:, end].any() or (start and functions[0].path.startswith("lengths.")):
                break
            far = Branches(functions, low - 9.0 * (high - low), low) if start else None
            far = far or Branches(functions, high, high + 9.0 * (high - low))
            if meant is not None:
                pairs = zip(here.ids[:, end].tolist(), far.ids[:, start].tolist(), strict=True)
                meant = frozenset(there for own, there in pairs if own in meant and there >= 0)
            found.append((far, meant))
            here = far
    return found


def _unbounded(path: str, stretches: Sequence[Stretch]) -> list[str]:
    """What was searched, where the figure assembles beyond it."""
    parts = sorted((part for part, _ in stretches), key=lambda part: part.low)
    ends = path.startswith("lengths.") and parts[0].low <= 0.0  # no length is less
    if (parts[0].whole[:, 0].any() and not ends) or parts[-1].whole[:, -1].any():
        return [f"{path} was searched from {parts[0].low:g} to {parts[-1].high:g}."]
    return []


def functions_of(
    case: Case,
    path: str,
    span: tuple[float, float],
    start: float | None,
    bounded: bool,
    whole: bool = False,
) -> tuple[list[LoadFunction], bool]:
    """The modes of the figure, and whether these are all."""
    if start is not None:
        return _moving_from(case, path, start, span)
    refuse_ropes(case, path)
    functions, complete = load_functions(case, path, *span, whole)
    refuse_unwritten(case, path, functions[0].links, bounded)
    refuse_unposed(functions[0])
    return functions, complete


def _find_followed(
    case: Case, path: str, span: tuple[float, float], start: float | None, whole: bool
) -> Search:
    """Where points only all together have places: by another datum by which they have them one by one; else
    along the motion from some ways in which the figure assembles."""
    found = None
    if start is None and not any(_history(case)) and not _counts(case):
        found = _exchanged(case, path, span)
    if found is not None and (found.any_value or found.positions) and not case.near:
        return found._replace(path=path, positions=tuple(_settled_turns(found.positions, path, whole)))
    led, complete = led_mechanisms(case, path, span, start, found.positions if found is not None else ())
    if start is None:
        refuse_unwritten(case, path, led[0].links, not whole)
    meant = [led[nearest(case, [one.off(case.near) for one in led])]] if case.near else led
    left = [one for one in meant if not one.balances_everywhere()]
    if not left:
        return Search(path, (), (), True, None)
    notes = [] if len(left) == len(meant) else [_balanced(len(meant) - len(left), len(meant))]
    rests = [rest for one in left for rest in one.rests()]
    notes += [note for one in left for note in one.search.notes]
    if not complete:
        notes.append(NOT_ALL)
    least = None if rests else nearest_of(left)
    rests = _settled_turns(rests, path, whole)
    return Search(path, tuple(rests), tuple(dict.fromkeys(notes)), False, least)


def _exchanged(case: Case, path: str, span: tuple[float, float]) -> Search | None:
    """The positions by another datum in place of the unknown one; None where no points have places by it."""
    for other, by in exchanged(case, path):
        try:
            search = _find_in_modes(other, by, None, whole=True)
        except SceneError:
            continue
        return search._replace(positions=tuple(converted(search.positions, path, span, by)))
    return None


def _settled_turns(rests: Sequence[Rest], path: str, whole: bool) -> list[Rest]:
    """Positions by rising value, each once; angles of a whole turn within it."""
    if whole and path.startswith("angles."):
        rests = [rest._replace(value=_within_a_turn(rest.value, rest.error)) for rest in rests]
    return _distinct(sorted(rests, key=lambda rest: rest.value))


def _balanced(some: int, of: int) -> str:
    return (
        f"in {some} of the {of} ways in which the figure assembles the loads balance in every position; the "
        "positions of the others are listed."
    )


def find_along(case: Case, along: str, low: float, high: float) -> list[Rest]:
    """The positions of equilibrium along a sweep of an ordinary case: by a datum that poses it, or by
    turning a link from the position as written (degrees)."""
    bare = replace(case, motion=(), expect=())
    value = 0.0 if along in case.links else find_number(case, along).value
    wide = (min(low, value), max(high, value))
    try:
        function = moved_by(bare, along, wide)
    except TogetherError:
        return LedMechanism(bare, _own(bare, along), (low, high)).rests()
    functions = with_other_ways(function, wide) if function.compiled.setting.moves else [function]
    branches = Branches(functions, *wide)
    kept = frozenset({branches.on(0, value)})
    found = (rest for _, rest in search_modes(functions, branches, kept, False))
    rests = [rest for rest in found if low <= rest.value <= high]
    return _distinct(sorted(rests, key=lambda rest: rest.value))


def _own(case: Case, along: str) -> str:
    return along if along in case.links else find_number(case, along).path


def rest_of(case: Case, along: str) -> Rest:
    """The position as written, by a datum or a link; raises as `moved_by`."""
    value = 0.0 if along in case.links else find_number(case, along).value
    try:
        return described(moved_by(case, along), value, 0.0)
    except TogetherError:
        if along in case.links:
            raise
        return led_rest(case, along)


def led_rest(case: Case, along: str) -> Rest:
    """The same where points only together have places."""
    value = 0.0 if along in case.links else find_number(case, along).value
    return LedMechanism(case, _own(case, along), (value, value)).described(value, 0.0)


def moved_by(case: Case, along: str, span: tuple[float, float] | None = None) -> LoadFunction:
    """The mechanism as it moves by a datum, or by a link that is turned.

    Raises CaseError for what is neither, SceneError where it can't be moved so.
    """
    if case.dynamic:
        said = "with the inertia forces of its motion a mechanism does not rest: leave `dynamic` out."
        raise SceneError(Status.UNSUPPORTED, said)
    if along in case.links:
        if along == case.ground:
            raise SceneError(Status.STRUCTURE, f"link {along} is the frame: it does not move.")
        return moving_function(case, link=along, span=span)
    path = find_number(case, along).path
    try:
        function = moving_function(case, path, span=span)
    except SceneError as error:
        if error.status != Status.UNSUPPORTED or isinstance(error, TogetherError):
            raise
        function = written_function(case, path, span)
    refuse_unposed(function)
    return function


def _moving_from(
    case: Case, path: str, start: float, span: tuple[float, float]
) -> tuple[list[LoadFunction], bool]:
    """The mechanism moved from each way in which it assembles where it is written."""
    written = given_at(case, path, start)
    found = ways_of(written)
    ways = (replace(written, near=way.near) for way in found.ways)
    functions = [moving_function(way, path, span=span, posing=True) for way in ways]
    return functions, found.complete


def refuse_unwritten(case: Case, path: str, links: Sequence[str], bounded: bool) -> None:
    """Refuse what counts from a position as written, on links that turn, where none is written; and a torsion
    spring whose turns nothing counts from, not even the middle of a range."""
    turning = set(links)
    for what, link in _history(case):
        if link in turning:
            raise SceneError(
                Status.UNDERDETERMINED,
                f"{what} counts from the position as written, and link {link} turns: say at which "
                f"{path} the figure is written, as in {{unknown: [0, 360], from: 30}}.",
            )
    for load in case.loads if not bounded else ():
        if isinstance(load, TorsionSpring) and {load.link, load.against} & turning:
            raise SceneError(
                Status.UNDERDETERMINED,
                f"the torsion spring {load.name} turns with {path}, and nothing says from where its "
                f"angle counts: give a range or a start, as in {{unknown: [0, 180], from: 30}}.",
            )


def refuse_ropes(case: Case, path: str) -> None:
    """Refuse ropes that are fixed at both ends, and of which nothing says how long they are."""
    for rope in case.ropes:
        if not rope.is_free and rope.length is None:
            raise SceneError(
                Status.UNDERDETERMINED,
                f"the rope {rope.name} keeps the length that it has in the position as written: say at which "
                f"{path} the figure is written,"
                " as in {unknown: [0, 360], from: 30}, or give its `length`.",
            )


def _counts(case: Case) -> bool:
    """Whether something counts turns, or a length, from where the figure is written."""
    return bool(case.ropes) or any(isinstance(load, TorsionSpring) for load in case.loads)


def _history(case: Case) -> Iterator[tuple[str, str]]:
    """What counts from a position as written, with a link on which it does."""
    for joint in case.joints:
        pair = "-".join(joint.links[:2])
        if isinstance(joint, Rolling | Mesh) or joint.stands_in:
            yield from ((f"the joint of links {pair}", link) for link in joint.links)
        elif joint.guide is not None and joint.guide.angle is not None:
            yield f"the guide of links {pair} by degrees", joint.links[1]
        elif not joint.stays_known:
            yield from ((f"the normal of links {pair}", link) for link in joint.links)
    for load in case.loads:
        if getattr(load, "turns_with", None):
            yield f"load {load.name}, which turns with a link,", str(getattr(load, "turns_with", ""))
        for at in (getattr(load, "at", ""), getattr(load, "to", "")):
            if at.startswith("@") and getattr(load, "over", None) is None:
                yield f"load {load.name} at coordinates", load.link
    for name in _given(case):
        carriers = [link for link, names in case.carries.items() if name in names]
        if case.ground not in carriers:
            yield from ((f"point {name} by coordinates", link) for link in carriers)


def search_modes(
    functions: Sequence[LoadFunction],
    branches: Branches,
    kept: frozenset[int] | None,
    whole: bool,
    notes: list[str] | None = None,
) -> list[tuple[int, Rest]]:
    """The positions of all modes, each with its mode; ``kept`` has the branches that are meant (None: all),
    and ``notes`` takes sentences on what stays open."""
    found: list[tuple[int, Rest]] = []
    low, high = branches.low, branches.high
    path = functions[0].path
    limits = _limits(functions, branches)
    every = frozenset(branches.ids[branches.ids >= 0].tolist())
    left_out = frozenset[int]() if kept is None else every - kept
    modes = [n for n in range(len(functions)) if kept is None or kept & set(branches.ids[n].tolist())]
    for n, part in [(mode, part) for mode in modes for part in branches.parts(mode, left_out)]:
        function = functions[n]
        search = isolate(function, *part)
        if not search.complete and notes is not None:
            doubt = f"{path} was searched from {low:g} to {high:g}, but not proven to have no other position."
            notes.append(doubt)
        for bracket in search.brackets:
            position = _settled(function, bracket, (low, high), whole)
            if position is not None and (kept is None or branches.on(n, position.value) in kept):
                found.append((n, position))
        for cluster in search.open_cells if search.complete else ():
            ends = [limit.value for limit in limits if limit.mode == n]
            if any(cluster[0] - branches.slack <= value <= cluster[1] + branches.slack for value in ends):
                continue
            if not _changes(function, cluster):
                position = _in_range(function, _in_open_cells(function, cluster), (low, high), whole)
                if position is not None and (kept is None or branches.on(n, position.value) in kept):
                    found.append((n, position))
                continue
            for step in (-BESIDE * (high - low), BESIDE * (high - low)):
                beside = branches.on(n, 0.5 * (cluster[0] + cluster[1]) + 8.0 * step)
                if beside >= 0 and (kept is None or beside in kept):
                    there = _at_change_point(function, cluster, step, (low, high))
                    found += [(n, one) for one in there]
                    if notes is not None:
                        notes += [ESTIMATED.format(path=path, value=one.value) for one in there]
    found += [(-1, position) for position in _at_limits(functions, branches, kept, limits)]
    return found


def whole_range(case: Case, path: str) -> tuple[float, float]:
    """A whole turn; of a length or a coordinate all that the sizes of the figure allow."""
    if path.startswith("angles."):
        return 0.0, 360.0
    lengths = [length.value.value for length in case.lengths if length.value.path != path]
    places = [at for at in case.points.values() if isinstance(at, Coordinates)]
    given = [n.value for at in places for n in (at.x, at.y) if n is not None and math.isfinite(n.value)]
    spread = max(given, default=0.0) - min(given, default=0.0)
    reach = sum(x for x in lengths if math.isfinite(x)) + 2.0 * spread or 1.0
    if path.startswith("lengths."):
        return 0.0, reach
    middle = sum(given) / len(given) if given else 0.0
    return middle - reach - spread, middle + reach + spread


def _balances_everywhere(
    functions: Sequence[LoadFunction], samples: Sequence[tuple[int, float]]
) -> bool | SceneError:
    """Whether the loads balance in all of a branch: at places of no meaning, all of them; why nothing can be
    said where none of these has an answer."""
    some = [samples[len(samples) * k // 7] for k in (1, 3, 5)] if len(samples) > 6 else list(samples)
    refusal: SceneError | None = None
    loads = []
    for mode, value in some:
        try:
            loads.append(_probe(functions[mode], value))
        except SceneError as error:
            refusal = error
    if not loads and refusal is not None:
        return refusal
    return bool(loads) and refusal is None and not any(loads)


# --- one position ---------------------------------------------------------------------------------


def _settled(
    function: LoadFunction, bracket: tuple[float, float], span: tuple[float, float], turns: bool
) -> Rest | None:
    """The position in a bracket, to the last digit: between two doubles the power changes its sign."""
    start = _closed_in(function, *bracket)
    return _in_range(function, _to_the_last_digit(function, start, bracket), span, turns)


def _in_range(
    function: LoadFunction, closest: tuple[float, float] | None, span: tuple[float, float], turns: bool
) -> Rest | None:
    """A value and its error as a position; None where it is beyond the range."""
    if closest is None:
        return None
    value, error = closest
    low, high = span
    if turns and function.path.startswith("angles."):
        value = _within_a_turn(value, error)
    elif not low <= value <= high:
        end = low if abs(value - low) < abs(value - high) else high
        if abs(value - end) > 4.0 * error:
            return None
        value = end
    return described(function, value, error)


def _within_a_turn(value: float, error: float) -> float:
    """An angle from 0 up to 360, 0 where it is a whole turn to within its error."""
    value %= 360.0
    return 0.0 if 360.0 - value <= 2.0 * error or value <= 2.0 * error else value


def _closed_in(function: LoadFunction, low: float, high: float) -> float:
    """The zero of the power in floats, by cutting the bracket into many parts again and again."""
    code = Code(function.record, [function.power])
    for _ in range(12):
        at = np.linspace(low, high, STEPS + 1)
        (values,) = code.run(function.given(at), len(at))
        signs = np.signbit(values)
        change = np.flatnonzero(signs[1:] != signs[:-1])
        if not change.size:
            break
        low, high = float(at[change[0]]), float(at[change[0] + 1])
        if math.nextafter(low, high) >= high:
            break
    return 0.5 * (low + high)


def _to_the_last_digit(
    function: LoadFunction, start: float, bracket: tuple[float, float]
) -> tuple[float, float] | None:
    """The double nearest to the zero and a bound of its error, by the scene's own answers; None where the
    load jumps from one sign to the other."""
    step = math.ulp(start) or 5e-324
    here = _probe(function, start)
    if here == 0.0:
        return start, step
    side = _probe(function, bracket[1])
    toward = 1.0 if (side > 0.0) != (here > 0.0) else -1.0
    low, at_low, reach = start, here, step
    while True:
        high = start + toward * reach
        if not bracket[0] <= high <= bracket[1]:
            high = bracket[1] if toward > 0.0 else bracket[0]
        at_high = _probe(function, high)
        if at_high == 0.0:
            return high, math.ulp(high) or step
        if (at_high > 0.0) != (at_low > 0.0) or high in bracket:
            break
        low, at_low, reach = high, at_high, 4.0 * reach
    while True:
        middle = 0.5 * (low + high)
        if middle in (low, high):
            best = low if abs(at_low) <= abs(at_high) else high
            jumps = min(abs(at_low), abs(at_high)) > JUMP * max(abs(here), abs(side))
            return None if jumps else (best, abs(high - low))
        at_middle = _probe(function, middle)
        if at_middle == 0.0:
            return middle, math.ulp(middle)
        if (at_middle > 0.0) == (at_low > 0.0):
            low, at_low = middle, at_middle
        else:
            high, at_high = middle, at_middle


def scene_at(function: LoadFunction, value: float) -> Case:
    """The case with the free datum at a value, in the mode of the function; of a mechanism that moves, the
    row of its sweep."""
    if function.compiled.setting.moves:
        given = {k: Decimal(float(v)) for k, v in function.given(np.array(value)).items()}
        own = {} if function.path in function.case.links else {function.path: given[function.input]}
        row = RowScenes(function.compiled).case(given, own)
        return replace(row, near={}, motion=(), expect=())
    ox, oy, scale = function.compiled.scene.frame
    nodes = [k for pair in function.places.values() for k in pair]
    found = Code(function.record, [*nodes, *function.springs.values()]).run(
        function.given(np.array(value)), 1
    )
    flat = [float(np.ravel(v)[0]) for v in found]
    pairs = zip(function.places, zip(flat[::2], flat[1::2], strict=False), strict=False)
    near = {name: (x / scale + ox, y / scale + oy) for name, (x, y) in pairs if math.isfinite(x + y)}
    free = {name: at for name, at in near.items() if name not in _given(function.case)}
    counted = counted_about(function.case, dict(zip(function.springs, flat[len(nodes) :], strict=True)))
    return replace(given_at(counted, function.path, value), near=free, motion=(), expect=())


def _given(case: Case) -> set[str]:
    places = [(name, at) for name, at in case.points.items() if isinstance(at, Coordinates)]
    return {name for name, at in places if at.x is not None and at.y is not None}


def _probe(function: LoadFunction, value: float, on: str = "") -> float:
    """The torque on a link that would balance the loads, as `icsolve.solve` finds it."""
    answer = held(scene_at(function, value), [on] if on else function.links)
    assert answer is not None
    torque: float = answer.answers[PROBE].value
    return torque


def described(function: LoadFunction, value: float, error: float) -> Rest:
    """A position with its stiffness: enclosed about the value by the record. Where the loads do not balance
    it counts, too, that the rate of the free number changes along the motion."""
    cells = function.enclosed(Interval(np.array([value - error]), np.array([value + error])))
    record, nodes = function.record, [function.slope, function.rate, function.power]
    slope, rate, power = enclose(record, nodes, cells)
    if float(power.low.flat[0]) > 0.0 or float(power.high.flat[0]) < 0.0:
        motion = record.nodes[function.rate]
        load = record.nodes[function.power] / motion
        change = gradient(record, load, (function.input,))[function.input] * motion
        (slope,) = enclose(record, [record.lifted(change).index], cells)
    factor, unit = _units(function)
    stiffness, why = None, ""
    stability = "neutral"
    with np.errstate(all="ignore"):
        pairs = [(float(s.flat[0]), float(r.flat[0])) for s in slope for r in rate] if _apart(rate) else []
    ends = [-s / r * factor for s, r in pairs]
    if ends and all(map(math.isfinite, ends)):
        low, high = min(ends), max(ends)
        middle = 0.5 * (low + high)
        stiffness = Stiffness(middle, unit, 0.5 * (high - low) + 4.0 * math.ulp(middle))
        stability = "stable" if low > 0.0 else "unstable" if high < 0.0 else "neutral"
    else:
        why = AT_LIMIT
    return _rest(function, value, error, stability, stiffness, why)


def _rest(
    function: LoadFunction,
    value: float,
    error: float,
    stability: str,
    stiffness: Stiffness | None,
    why: str,
    at: float | None = None,
) -> Rest:
    """A position with its scene; ``at`` is a value beside it that assembles."""
    case = scene_at(function, value if at is None else at)
    size = function.case.units.torque_per_force_length / (
        function.force_scale * function.compiled.scene.frame.scale
    )
    answer = solve_scene(case, rates=True)
    return Rest(value, error, stability, stiffness, why, answer, case, function.links, size)


def _apart(rate: Interval) -> bool:
    return bool((rate.low.flat[0] > 0.0) or (rate.high.flat[0] < 0.0))


def _units(function: LoadFunction) -> tuple[float, str]:
    """What brings minus slope over rate into the unit of a stiffness, and that unit."""
    case, frame = function.case, function.compiled.scene.frame
    per_load = 1.0 / (function.force_scale * frame.scale)
    units = case.units
    if function.turns_links:
        return per_load * DEGREES * DEGREES * units.torque_per_force_length, f"{units.torque}/rad"
    return per_load, f"{units.force}/{units.length}"


def _in_open_cells(function: LoadFunction, cluster: tuple[float, float]) -> tuple[float, float] | None:
    """The position in cells that stayed open, where there is one: a zero of higher order, at which the
    stiffness vanishes too."""
    low, high = cluster
    width = max(high - low, 4.0 * math.ulp(abs(low) + abs(high)))
    low, high = low - width, high + width
    try:
        at_low, at_high = _probe(function, low), _probe(function, high)
        if (at_low > 0.0) != (at_high > 0.0):
            return _to_the_last_digit(function, 0.5 * (low + high), (low, high))
        beside = max(abs(at_low), abs(at_high))
        turning = _turning_point(function, low, high)
        if turning is None:
            return None
        value, error = turning
        plain = plain_within(value, error)
        if _probe(function, plain) == 0.0:
            return plain, math.ulp(plain)
        least = abs(_probe(function, value))
    except SceneError:
        return None
    # beside the place the load rises as the square of the distance: so much is left where that is zero,
    # and two zeros may lie on either side of it
    return (value, 2.5 * error) if least <= 8.0 * beside * (error / (high - low)) ** 2 else None


def plain_within(value: float, error: float) -> float:
    """The number with the fewest decimals that is as near as an error bound."""
    return next((v for d in range(13) if abs((v := round(value, d)) - value) <= error), value)


def _changes(function: LoadFunction, cluster: tuple[float, float]) -> bool:
    """Whether two modes meet in some cells."""
    width = max(cluster[1] - cluster[0], 4.0 * math.ulp(abs(cluster[0]) + abs(cluster[1])))
    here = Interval(np.array([cluster[0] - width]), np.array([cluster[1] + width]))
    margins = enclose(function.record, function.margins, function.enclosed(here))
    return any(not float(margin.low.flat[0]) > 0.0 for margin in margins)


def _at_change_point(
    function: LoadFunction, cluster: tuple[float, float], step: float, span: tuple[float, float]
) -> list[Rest]:
    """The position at a change point, if there is one: the generalised load of a branch goes smoothly on to
    it, though no scene can be solved there. A polynomial takes it there from one side; how far one of one
    degree less is off, and what rounding becomes on the way, estimate the errors."""
    middle = 0.5 * (cluster[0] + cluster[1])
    steps = list(range(1, 9))
    beside = [middle + k * step for k in steps]
    if not all(span[0] <= value <= span[1] for value in beside):
        return []
    try:
        loads = [_generalised(function, value) for value in beside]
        if not any(loads):
            return []
        smooth, rough = (
            np.polynomial.Polynomial.fit(steps[:n], loads[:n], n - 1, domain=[0, 8], window=[0, 8])
            for n in (len(steps), len(steps) - 1)
        )
        roots = smooth.roots()
        root = float(np.real(roots[np.argmin(np.abs(roots))]))
        largest = max(map(abs, loads))
        level, slope, bend = (float(smooth.deriv(n)(root)) for n in range(3))
        off, off_slope = (
            2.0 * abs(float((smooth - rough).deriv(n)(root))) + spread * largest
            for n, spread in enumerate(SPREAD)
        )
        # so far from the root the load is within what the sides leave open, also where it but touches zero
        error = 2.0 * off / (abs(slope) + math.sqrt(slope * slope + 2.0 * abs(bend) * off))
        if abs(level) > off or (abs(root) - error) * abs(step) > cluster[1] - cluster[0]:
            return []
        off_slope += abs(bend) * error
        error *= abs(step)
        value = min(max(middle + root * step, span[0]), span[1])
        value = plain_within(value, error)
        here = next(_scenes_near(function, value, step))
    except (SceneError, StopIteration):
        return []
    per = (DEGREES if function.turns_links else 1.0) / step
    known = Stiffness(-slope * per, _units(function)[1], off_slope * abs(per))
    kind = "neutral" if abs(slope) <= off_slope else "stable" if known.value > 0.0 else "unstable"
    return [here._replace(value=value, error=error, stability=kind, stiffness=known)]


def _generalised(function: LoadFunction, value: float) -> float:
    """The generalised load of the free datum [case units], of the torque that would balance it."""
    answer = held(scene_at(function, value), function.links, rates=True)
    assert answer is not None
    probe, units = answer.case.loads[-1], function.case.units
    if not isinstance(probe, Torque):
        return 0.0
    ratio = float((answer.rates or {})[probe.link]) / rate_of(answer, function.path)
    torque: float = answer.answers[PROBE].value
    return -torque * ratio * (1.0 if function.turns_links else 1.0 / units.torque_per_force_length)


def _scenes_near(function: LoadFunction, value: float, step: float) -> Iterator[Rest]:
    """The scene at a change point, or as near to it as it has an answer."""
    for part in (0.0, 1e-9, 1e-6, 1e-3):
        with suppress(SceneError):
            yield _rest(function, value, 0.0, "", None, "", value + part * step)


def _turning_point(function: LoadFunction, low: float, high: float) -> tuple[float, float] | None:
    """Where the power's derivative changes its sign, as far as its enclosure tells; None where nowhere."""

    def sign(value: float) -> int:
        here = np.array([value])
        (slope,) = enclose(function.record, [function.slope], function.enclosed(Interval(here, here)))
        return int(float(slope.low.flat[0]) > 0.0) - int(float(slope.high.flat[0]) < 0.0)

    def edge(outside: float, inside: float, word: int) -> float:
        while (middle := 0.5 * (outside + inside)) not in (outside, inside):
            outside, inside = (middle, inside) if sign(middle) == word else (outside, middle)
        return inside

    first, last = sign(low), sign(high)
    if not first or not last or first == last:
        return None
    start, stop = edge(low, high, first), edge(high, low, last)
    middle = 0.5 * (start + stop)
    return middle, 0.5 * abs(stop - start) + math.ulp(middle)


class _Limit(NamedTuple):
    """Where a mode ends: the last value at which it assembles, how far from it the limit may be, and on which
    side the mode assembles (1: below)."""

    mode: int
    value: float
    error: float
    side: float


def _limits(functions: Sequence[LoadFunction], branches: Branches) -> list[_Limit]:
    """The ends of all modes in the range, also at its ends."""
    found = []
    low, high = branches.low, branches.high
    beyond = np.array([low - branches.slack, high + branches.slack])
    values = np.array([beyond[0], *branches.values, beyond[1]])
    first, last = branches.assemble(beyond).T
    for n, function in enumerate(functions):
        whole = np.array([first[n], *branches.whole[n], last[n]])
        for k in np.flatnonzero(whole[1:] != whole[:-1]).tolist():
            inside, outside = (k, k + 1) if whole[k] else (k + 1, k)
            value = _last(function, float(values[inside]), float(values[outside]))
            side = 1.0 if inside < outside else -1.0
            error = _reach(function, value, side, branches.slack)
            if low - error <= value <= high + error:
                found.append(_Limit(n, min(max(value, low), high), error, side))
    return found


def _reach(function: LoadFunction, value: float, side: float, most: float) -> float:
    """So far on either side of a limit it is certain that a mode assembles, and that it does not."""
    reach = math.ulp(value)
    while reach < most:
        about = np.array([value - side * reach, value + side * reach])
        margins = enclose(function.record, function.margins, function.enclosed(Interval(about, about)))
        ends = [(np.ravel(margin.low)[0], np.ravel(margin.high)[-1]) for margin in margins]
        if all(inside > 0.0 for inside, _ in ends) and any(outside < 0.0 for _, outside in ends):
            break
        reach *= 2.0
    return reach


def _last(function: LoadFunction, inside: float, outside: float) -> float:
    """The last double at which a mode assembles, between one at which it does and one at which not."""
    code = Code(function.record, function.margins)
    while True:
        middle = 0.5 * (inside + outside)
        if middle in (inside, outside):
            return inside
        whole = all(float(np.ravel(m)[0]) > 0.0 for m in code.run(function.given(np.array(middle)), 1))
        inside, outside = (middle, outside) if whole else (inside, middle)


def _at_limits(
    functions: Sequence[LoadFunction],
    branches: Branches,
    kept: frozenset[int] | None,
    limits: Sequence[_Limit],
) -> list[Rest]:
    """Rests at limits of the free datum: there two modes meet, and the load changes its sign from one
    to the other along the motion that the mechanism has."""
    found = []
    for k, one in enumerate(limits):
        for other in limits[k + 1 :]:
            near = abs(one.value - other.value) <= branches.slack
            if not near or one.side != other.side or one.mode == other.mode:
                continue
            on = {branches.on(limit.mode, limit.value) for limit in (one, other)}
            if kept is None or on & kept:
                found += _between(functions[one.mode], functions[other.mode], one)
    return found


def _between(one: LoadFunction, two: LoadFunction, limit: _Limit) -> list[Rest]:
    """The position between two modes that meet at a limit, where the load changes its sign there."""
    step = 1e-7 * max(1.0, abs(limit.value))
    here = limit.value - limit.side * step
    try:
        a, b = solve_scene(scene_at(one, here), rates=True), solve_scene(scene_at(two, here), rates=True)
        size = max((abs(c) for at in a.points.values() for c in at), default=1.0)
        if any(math.dist(at, b.points[name]) > 0.02 * size for name, at in a.points.items()):
            return []
        link = _fastest(a, one.links)  # of the motion there: the link that is led stands still
        last = limit.value - limit.side * 4.0 * limit.error
        p, q = _probe(one, last, link), _probe(two, last, link)
        if (p > 0.0) == (q > 0.0) and p != 0.0 and q != 0.0:
            return []
        far, away = _probe(one, here, link), _probe(two, here, link)
        way = _swing(one, two, link, here)
    except SceneError:
        return []
    rises = (away - far) * way
    stability = "stable" if rises > 0.0 else "unstable" if rises < 0.0 else "neutral"
    value = plain_within(limit.value, limit.error)
    error = limit.error + abs(value - limit.value)
    try:
        return [_rest(one, value, error, stability, None, AT_LIMIT)]
    except SceneError:
        return [_rest(one, value, error, stability, None, AT_LIMIT, last)]


def _fastest(answer: Answer, links: Sequence[str]) -> str:
    """The link that turns fastest in a solved scene."""
    rates = {link: rate for link, rate in (answer.rates or {}).items() if isinstance(rate, float)}
    return max(links, key=lambda link: abs(rates.get(link, 0.0)))


def _swing(one: LoadFunction, two: LoadFunction, link: str, value: float) -> float:
    """The sense in which a link turns from one mode to the other through the limit."""
    carried = [p for p in one.case.carries[link] if p in one.places]
    first, second = solve_scene(scene_at(one, value)).points, solve_scene(scene_at(two, value)).points
    a, b = max(
        ((p, q) for p in carried for q in carried if p != q),
        key=lambda pair: math.dist(first[pair[0]], first[pair[1]]),
        default=("", ""),
    )
    if not a:
        return 0.0
    (ax, ay), (bx, by) = first[a], first[b]
    (cx, cy), (dx, dy) = second[a], second[b]
    return (bx - ax) * (dy - cy) - (by - ay) * (dx - cx)


def _distinct(found: Sequence[Rest]) -> list[Rest]:
    """Rests by rising value, those that two modes share once."""
    kept: list[Rest] = []
    widest = 8.0 * max((rest.error for rest in found), default=0.0)
    for one in found:
        first = bisect_left(kept, one.value - widest, key=lambda rest: rest.value)
        if not any(_same(one, other) for other in kept[first:]):
            kept.append(one)
    return kept


def _same(one: Rest, other: Rest) -> bool:
    if abs(one.value - other.value) > 4.0 * (one.error + other.error):
        return False
    if one.stiffness is not None and other.stiffness is not None:  # of two branches, at a change point
        off = 4.0 * ((one.stiffness.error or 0.0) + (other.stiffness.error or 0.0))
        if abs(one.stiffness.value - other.stiffness.value) > off + APART * abs(one.stiffness.value):
            return False
    size = max((abs(c) for at in one.answer.points.values() for c in at), default=1.0)
    theirs = other.answer.points
    return all(math.dist(at, theirs[name]) <= APART * size for name, at in one.answer.points.items())


def _nearest(functions: Sequence[LoadFunction], stretches: Sequence[Stretch]) -> float | None:
    """Where the generalised load is smallest: sampled, then closed in on."""
    best: tuple[float, float] | None = None
    for (n, function), (branches, kept) in product(enumerate(functions), stretches):
        code = Code(function.record, [function.power, function.rate])
        values = np.array([v for v in branches.assembling(n) if kept is None or branches.on(n, v) in kept])
        if not values.size:
            continue
        step = float(values[1] - values[0]) if values.size > 1 else 0.0
        for _ in range(14):
            power, rate = code.run(function.given(values), len(values))
            with np.errstate(all="ignore"):
                load = np.abs(power / rate) / (function.force_scale * function.compiled.scene.frame.scale)
            load = np.broadcast_to(load, values.shape)  # one number where the position does not matter
            k = int(np.nanargmin(load))
            if best is None or float(load[k]) < best[0]:
                best = (float(load[k]), float(values[k]))
            values = np.linspace(float(values[k]) - step, float(values[k]) + step, 33)
            values = values[(values >= branches.low) & (values <= branches.high)]
            step /= 8.0
    return None if best is None else best[1]


__all__ = [
    "Rest",
    "Search",
    "described",
    "find_positions",
    "scene_at",
    "search_modes",
    "whole_range",
]
