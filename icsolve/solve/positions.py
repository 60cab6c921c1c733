"""Positions of equilibrium: every value of a free datum of the figure at which the loads balance."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import product
from operator import itemgetter

import numpy as np

from icsolve.assembly.ways import ways_of
from icsolve.case import Case, Coordinates, TorsionSpring, is_angle, is_named
from icsolve.case.joints import Mesh, Rolling
from icsolve.errors import SceneError, Status
from icsolve.numbers.replay import Code
from icsolve.solve.branches import CONTRARY, Branches, isolate
from icsolve.solve.driven_search import (
    NOT_ALL,
    DrivenMechanism,
    converted,
    driven_mechanisms,
    exchanged,
    nearest_of,
)
from icsolve.solve.load_function import (
    LoadFunction,
    StillError,
    TogetherError,
    given_at,
    load_functions,
    moving_function,
    naming_uncarried,
    refuse_unposed,
    with_other_ways,
    written_function,
)
from icsolve.solve.mode_limits import at_limits, limits_of
from icsolve.solve.refinement import (
    at_change_point,
    balancing_torque,
    described,
    distinct,
    in_open_cells,
    in_range,
    modes_meet,
    refined,
    vanishing,
    within_a_turn,
)
from icsolve.solve.rest_position import RestPosition, taut
from icsolve.structure import topology, welded
from icsolve.structure.torn_points import torn_points
from icsolve.sweep.varied_numbers import find_number, points_of
from icsolve.tuples import NamedTuple, replace

BESIDE = 5e-4
"""Beside a change point a branch is looked at in steps of this fraction of the range."""
ESTIMATED = (
    "{path} = {value:g} is a change point, where no scene has an answer: the position there is found from "
    "the loads beside it, and its errors are estimates."
)
ISLANDS = (
    "where no motion leads from the position as written, the branch of that position was searched along "
    "{along}, as rows of a sweep keep it there."
)
STRETCHES = 4
"""So many times the range of a length or a coordinate is made ten times longer."""


class Search(NamedTuple):
    """What was found over a range: positions by rising value, sentences, and where the loads come nearest."""

    path: str
    positions: tuple[RestPosition, ...]
    notes: tuple[str, ...]
    any_value: bool
    nearest: float | None


def find_positions(case: Case, path: str, span: tuple[float, float] | None, start: float | None) -> Search:
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
        found = _find_in_modes(case, path, span, start)
    except TogetherError:
        found = _find_followed(case, path, span or whole_range(case, path), start, span is None)
    rests, slack = taut(found.positions, path)
    least = found.positions[0].value if found.positions and not rests else found.nearest
    return found._replace(positions=tuple(rests), notes=(*found.notes, *slack), nearest=least)


def _find_in_modes(
    case: Case, path: str, span: tuple[float, float] | None, start: float | None = None, whole: bool = False
) -> Search:
    """The positions in all modes of a figure whose points have places one by one; raises TogetherError where
    it is to be ``whole`` and has too many."""
    low, high = span or whole_range(case, path)
    notes: list[str] = []
    functions, complete, branches, kept = modes_and_branches(
        case, path, (low, high), start, span is not None, notes, whole
    )
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
    if span is None and not is_angle(path):
        stretches += _beyond(*stretches[0])
        notes += _unbounded(path, stretches)
    found = [
        rest
        for part, meant_there in stretches
        for _, rest in search_modes(functions, part, meant_there, span is None, notes)
    ]
    if not complete:
        notes.append(f"the figure has more than {len(functions)} ways of assembling: not all were searched.")
    refusals = [state for state in states.values() if isinstance(state, SceneError)]
    if not found and refusals and len(refusals) == len(states):
        raise refusals[0]
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


def modes_and_branches(
    case: Case,
    path: str,
    span: tuple[float, float],
    start: float | None,
    bounded: bool,
    notes: list[str],
    whole: bool = False,
) -> tuple[list[LoadFunction], bool, Branches, frozenset[int] | None]:
    """The modes of the figure, whether these are all, the branches that they are on, and which of these are
    meant (None: all): with ``start`` those on which the figure as written there is, or that `near` picks of
    them, and where no motion leads from there those of the same modes, as ``notes`` then say."""
    if start is not None:
        functions, complete, own = _moving_from(case, path, start, span)
    else:
        refuse_ropes(case, path)
        functions, complete = load_functions(case, path, *span, whole)
        ends = {*points_of(path)}
        if path.startswith("lengths.") and any(ends <= {*points} for points in case.carries.values()):
            refuse_unposed(functions[0])  # of one link, which it shapes, wherever that is written
        refuse_unwritten(case, path, functions[0].links, bounded)
        refuse_unposed(functions[0])
    branches = Branches(functions, *span)
    if start is None:
        return functions, complete, branches, branches.nearest(case) if case.near else None
    led, beyond = _through(branches, own, start)
    if case.near:
        return functions, complete, branches, branches.nearest(case, led or beyond or None)
    notes += [ISLANDS.format(along=path)] if beyond else []
    return functions, complete, branches, led | beyond or None


def _through(branches: Branches, own: Sequence[int], start: float) -> tuple[frozenset[int], frozenset[int]]:
    """The branches on which some modes are at a value, which may lie outside of the range, and those on which
    they are where no motion leads from there."""
    low, high = branches.low, branches.high
    inside = low <= start <= high
    wide = branches if inside else Branches(branches.functions, min(low, start), max(high, start))
    at = {(m, wide.on(m, start)) for m in own}
    led = frozenset(branch for _, branch in at) - {-1}
    beyond = frozenset[int]().union(*(wide.islands(m, branch) for m, branch in at if branch >= 0)) - led
    if inside:
        return led, beyond
    some = {
        branch: branches.samples(branch) for branch in np.unique(branches.ids[branches.ids >= 0]).tolist()
    }
    on = {branch: wide.on(*pairs[len(pairs) // 2]) for branch, pairs in some.items()}
    return (
        frozenset(branch for branch, there in on.items() if there in led),
        frozenset(branch for branch, there in on.items() if there in beyond),
    )


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
    known = found.positions if found is not None else ()
    driven, complete = driven_mechanisms(case, path, span, start, known)
    if start is None:
        refuse_unwritten(case, path, driven[0].links, not whole)
    left = [one for one in driven if not one.balances_everywhere()]
    if not left:
        return Search(path, (), (), True, None)
    notes = [] if len(left) == len(driven) else [_balanced(len(driven) - len(left), len(driven))]
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


def _settled_turns(rests: Sequence[RestPosition], path: str, whole: bool) -> list[RestPosition]:
    """Positions by rising value, each once; angles of a whole turn within it."""
    if whole and is_angle(path):
        rests = [rest._replace(value=within_a_turn(rest.value, rest.error)) for rest in rests]
    return distinct(sorted(rests, key=lambda rest: rest.value))


def _balanced(some: int, of: int) -> str:
    return (
        f"in {some} of the {of} ways in which the figure assembles the loads balance in every position; the "
        "positions of the others are listed."
    )


def find_along(case: Case, along: str, low: float, high: float) -> tuple[list[RestPosition], list[str]]:
    """The positions of equilibrium along a sweep of an ordinary case, by a datum that poses it or by turning
    a link from the position as written (degrees); and sentences on those that were left out.

    Raises SceneError (``any-value``) where the loads balance in all of them.
    """
    with naming_uncarried(case, () if along in case.links else (along,)):
        rests, notes = _along(case, along, low, high)
    found, slack = taut(distinct(sorted(rests, key=lambda rest: rest.value)), along)
    return found, [*dict.fromkeys(notes), *slack]


def _along(case: Case, along: str, low: float, high: float) -> tuple[list[RestPosition], list[str]]:
    bare = replace(case, motion=(), expect=())
    own, value = _as_written(bare, along)
    wide = (min(low, value), max(high, value))
    try:
        function = moved_by(bare, along, wide)
    except TogetherError:
        driven = DrivenMechanism(bare, own, (low, high))
        if driven.balances_everywhere():
            raise any_value(own) from None
        return driven.rests(), []
    functions = with_other_ways(function, wide) if function.compiled.setting.moves else [function]
    branches = Branches(functions, *wide)
    branch = branches.on(0, value)
    if _balances_everywhere(functions, branches.samples(branch)) is True:
        raise any_value(own)
    kept = frozenset({branch}) | branches.islands(0, branch)
    notes = [ISLANDS.format(along=along)] if len(kept) > 1 else []
    found = (rest for _, rest in search_modes(functions, branches, kept, False, notes))
    return [rest for rest in found if low <= rest.value <= high], notes


def any_value(along: str) -> SceneError:
    """The refusal of a case whose loads balance everywhere along a datum, or as a link turns."""
    which = f"any value of {along}" if "." in along else f"any turn of link {along}"
    said = f"the loads balance in every position: {which} will do."
    return SceneError(Status.ANY_VALUE, said, {"positions": []})


def _as_written(case: Case, along: str) -> tuple[str, float]:
    """The path of a datum and its value; a link, which is turned from where it is."""
    if along in case.links:
        return along, 0.0
    number = find_number(case, along)
    return number.path, number.value


def rest_of(case: Case, along: str) -> RestPosition:
    """The position as written, by a datum or a link; raises as `moved_by`."""
    try:
        return described(moved_by(case, along), _as_written(case, along)[1], 0.0)
    except TogetherError:
        if along in case.links:
            raise
        return driven_rest(case, along)


def driven_rest(case: Case, along: str) -> RestPosition:
    """The same where points only together have places."""
    own, value = _as_written(case, along)
    return DrivenMechanism(case, own, (value, value)).described(value, 0.0)


def refuse_motion(case: Case) -> None:
    """Refuse what has the inertia forces of a motion."""
    if case.dynamic:
        said = "with the inertia forces of its motion a mechanism does not rest: leave `dynamic` out."
        raise SceneError(Status.UNSUPPORTED, said)


def refuse_profiles(case: Case) -> None:
    """Refuse contacts that profiles give: no mode of their figure is known over a range."""
    if case.touches:
        raise SceneError(
            Status.UNSUPPORTED,
            "positions of equilibrium and their stability are not found where profiles give a contact. Write "
            "the figure in one position, with an unknown torque on the cam: where none is needed a sweep "
            "tells, as `icsolve sweep CASE --drive 2=0:360:5 --find T=0`.",
        )


def moved_by(case: Case, along: str, span: tuple[float, float] | None = None) -> LoadFunction:
    """The mechanism as it moves by a datum, or by a link that is turned.

    Raises CaseError for what is neither, SceneError where it can't be moved so.
    """
    refuse_motion(case)
    refuse_profiles(case)
    if along in case.links:
        if along in welded(case, case.ground):
            raise SceneError(Status.STRUCTURE, f"link {along} is the frame: it does not move.")
        return moving_function(case, link=along, span=span)
    path = find_number(case, along).path
    try:
        function = moving_function(case, path, span=span)
    except SceneError as error:
        if error.status != Status.UNSUPPORTED or isinstance(error, TogetherError):
            raise
        function = written_function(case, path, span)
    refuse_unposed(function, sought=span is not None)
    return function


def _moving_from(
    case: Case, path: str, start: float, span: tuple[float, float]
) -> tuple[list[LoadFunction], bool, list[int]]:
    """The mechanism moved from each way in which it assembles where it is written, and the further ways to
    which that leads; whether these are all, and which modes are the ways as written. A way in which nothing
    moves is no branch: it is refused where `near` means it, or there is no other; so is one without an
    answer that `near` does not mean."""
    written, wide = given_at(case, path, start), (min(span[0], start), max(span[1], start))
    found = ways_of(written)
    functions, own = list[LoadFunction](), list[int]()
    moving, refused = [math.inf], [(math.inf, SceneError(Status.CANNOT_ASSEMBLE, ""))]
    for way in found.ways:
        off = math.hypot(
            *(a - b for name in case.near for a, b in zip(way.points[name], case.near[name], strict=True))
        )
        try:
            function = moving_function(replace(written, near=way.near), path, span=span, posing=True)
        except SceneError as why:
            if isinstance(why, TogetherError) or not (case.near or isinstance(why, StillError)):
                raise
            refused.append((off, why))
            continue
        moving.append(off)
        same = next((n for n, one in enumerate(functions) if one.meets(function, start)), None)
        own.append(len(functions) if same is None else same)
        functions += with_other_ways(function, wide) if same is None else ()
    least, refusal = min(refused, key=itemgetter(0))
    if least < min(moving):
        raise refusal
    return functions, found.complete, own


def refuse_unwritten(case: Case, path: str, links: Sequence[str], bounded: bool) -> None:
    """Refuse what counts from a position as written, on links that turn, where none is written; and a torsion
    spring whose turns nothing counts from, not even the middle of a range."""
    turning = set(links)
    for what, link in _history(case):
        if link in turning:
            raise SceneError(
                Status.UNDERDETERMINED,
                f"{what} counts from the position as written, and link {link} turns: say at which "
                f"{path} the figure is written, as in {_written_at(path)}.",
            )
    for load in case.loads if not bounded else ():
        if isinstance(load, TorsionSpring) and {load.link, load.against} & turning:
            raise SceneError(
                Status.UNDERDETERMINED,
                f"the torsion spring {load.name} turns, and nothing says from where its angle counts: give "
                f"{path} a range or a start, as in {{unknown: [0, 180], from: 30}}.",
            )


def _written_at(path: str) -> str:
    """An example of how it is said where in its range an unknown datum is written."""
    return "{unknown: [0, 360], from: 30}" if is_angle(path) else "{unknown: [0.2, 0.5], from: 0.3}"


def refuse_ropes(case: Case, path: str) -> None:
    """Refuse ropes that are fixed at both ends, and of which nothing says how long they are."""
    for rope in case.ropes:
        if not rope.is_free and rope.length is None:
            raise SceneError(
                Status.UNDERDETERMINED,
                f"the rope {rope.name} keeps the length that it has in the position as written: say at which "
                f"{path} the figure is written, as in {_written_at(path)}, or give its `length`.",
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
    yield from _history_of_loads(case)
    frame = {*welded(case, case.ground)}
    for name in case.given_places:
        carriers = [link for link, names in case.carries.items() if name in names]
        if frame.isdisjoint(carriers):
            yield from ((f"point {name} by coordinates", link) for link in carriers)


def _history_of_loads(case: Case) -> Iterator[tuple[str, str]]:
    """Of loads what counts from there, with the link on which it does."""
    for load in case.loads:
        if getattr(load, "turns_with", None):
            yield f"load {load.name}, which turns with a link,", str(getattr(load, "turns_with", ""))
        other = getattr(load, "against", None) or case.ground
        for at, link in ((getattr(load, "at", ""), load.link), (getattr(load, "to", ""), other)):
            if not is_named(at) and getattr(load, "over", None) is None:
                yield f"load {load.name} at coordinates", link
    for torn in torn_points(case, topology(case)):
        goes = f"goes with link {torn.owner}" if torn.owner else "rolls on"
        if torn.load is not None:
            yield f"load {torn.load} at {torn.point}, which {goes},", torn.link


def search_modes(
    functions: Sequence[LoadFunction],
    branches: Branches,
    kept: frozenset[int] | None,
    whole: bool,
    notes: list[str] | None = None,
) -> list[tuple[int, RestPosition]]:
    """The positions of all modes, each with its mode; ``kept`` has the branches that are meant (None: all),
    and ``notes`` takes sentences on what stays open."""
    found: list[tuple[int, RestPosition]] = []
    low, high = branches.low, branches.high
    path = functions[0].path
    limits = limits_of(functions, branches)
    doubt = f"{path} was searched from {low:g} to {high:g}, but not proven to have no other position."
    every = frozenset(branches.ids[branches.ids >= 0].tolist())
    left_out = frozenset({CONTRARY} if kept is None else {CONTRARY, *(every - kept)})
    modes = [n for n in range(len(functions)) if kept is None or kept & set(branches.ids[n].tolist())]
    for n, part in [(mode, part) for mode in modes for part in branches.parts(mode, left_out)]:
        function = functions[n]
        search = isolate(function, *part)
        if not search.complete and notes is not None:
            notes.append(doubt)
        brackets = filter(function.may_be_read, search.brackets)
        places = [refined(function, bracket, (low, high), whole) for bracket in brackets]
        places += [vanishing(function, bracket, (low, high), whole) for bracket in search.changes]
        for position in places:
            if position is not None and (kept is None or branches.on(n, position.value) in kept):
                found.append((n, position))
        for cluster in search.open_cells if search.complete else ():
            ends = [limit.value for limit in limits if limit.mode == n]
            if any(cluster[0] - branches.slack <= value <= cluster[1] + branches.slack for value in ends):
                continue
            if not modes_meet(function, cluster):
                within = in_open_cells(function, cluster)
                there = [in_range(function, place, (low, high), whole) for place in within]
                on = (one for one in there if one and (kept is None or branches.on(n, one.value) in kept))
                found += [(n, one) for one in on]
                continue
            for step in (-BESIDE * (high - low), BESIDE * (high - low)):
                beside = branches.on(n, 0.5 * (cluster[0] + cluster[1]) + 8.0 * step)
                if beside >= 0 and (kept is None or beside in kept):
                    met = at_change_point(function, cluster, step, (low, high))
                    found += [(n, one) for one in met]
                    if notes is not None:
                        notes += [ESTIMATED.format(path=path, value=one.value) for one in met]
    joined = [(n, position) for n, position in found if functions[n].joined(position.value)]
    if len(joined) < len(found) and notes is not None:  # others may do where links that repeat them do not
        notes.append(doubt)
    return joined + [(-1, position) for position in at_limits(functions, branches, kept, limits)]


def whole_range(case: Case, path: str) -> tuple[float, float]:
    """A whole turn; of a length or a coordinate all that the sizes of the figure allow."""
    if is_angle(path):
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
            loads.append(balancing_torque(functions[mode], value))
        except SceneError as error:
            refusal = error
    if not loads and refusal is not None:
        return refusal
    return bool(loads) and refusal is None and not any(loads)


NEARER = 1.0 - 2.0**-48
"""A load is smaller than another by more than their rounding: an end of the range is told as written."""


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
            if best is None or float(load[k]) < best[0] * NEARER:
                best = (float(load[k]), float(values[k]))
            values = np.linspace(float(values[k]) - step, float(values[k]) + step, 33)
            values = values[(values >= branches.low) & (values <= branches.high)]
            step /= 8.0
    return None if best is None else best[1]
