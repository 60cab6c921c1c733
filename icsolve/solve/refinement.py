"""One position of equilibrium: closed in on to the last digit, at a change point, and what is told of it."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from decimal import Decimal, localcontext

import numpy as np

from icsolve.answer import Answer
from icsolve.answer.equilibrium import Stiffness
from icsolve.case import Case, Force, Torque, is_angle
from icsolve.errors import SceneError
from icsolve.numbers import DEGREE
from icsolve.numbers.adjoint import gradient
from icsolve.numbers.decimals import CONTEXT, as_written, decimal_ratio
from icsolve.numbers.intervals import Interval, enclose
from icsolve.numbers.record import terms_within
from icsolve.numbers.replay import Array, Code
from icsolve.numbers.roots import MOST_ORDER, last_that_holds, zeros_between
from icsolve.numbers.units import found_number
from icsolve.scene import solve_by_power, solve_scene
from icsolve.solve.driven_search import rate_of
from icsolve.solve.load_function import LoadFunction, given_at
from icsolve.solve.rest_position import AT_LIMIT, PROBE, RestPosition, held
from icsolve.statics.load_wrenches import counted_about
from icsolve.sweep.exact_record import ZERO, RowScenes, exact_record
from icsolve.sweep.program import CompiledSweep
from icsolve.tuples import replace

STEPS = 64
JUMP = 1e-5
"""Beside a zero, even one at which the load rises as steeply as a root, it is smaller than this fraction."""
SPREAD = (255.0 * 2.0**-46, 618.0 * 2.0**-46)
"""What becomes of the rounding of loads at eight steps, 64 units each: of the value and slope one step on."""
DEGREES = 180.0 / math.pi
MOST_STEPS = 12
FASTER = 8
"""Newton's method closes in on a plain zero: each step is this many times shorter than the last, or more."""
NEAR = Decimal("1e-40")
"""Zeros of a higher order are told so near."""
CLOSED = Decimal("1e-90")
"""A step of Newton's method after which no digit of a double changes."""
APART = 1e-6
"""Points of two ways of assembling differ by more than this fraction of the figure's size."""


def refined(
    function: LoadFunction, bracket: tuple[float, float], span: tuple[float, float], turns: bool
) -> RestPosition | None:
    """The position in a bracket, to the last digit: rounded once where Newton's method finds it in all
    digits, else between two doubles the power changes its sign."""
    start = _closed_in(function, *bracket)
    exact = _zero(function, as_written(start), *map(as_written, bracket))
    closest = rounded(exact) if exact is not None else _to_the_last_digit(function, start, bracket)
    return in_range(function, closest, span, turns)


def vanishing(
    function: LoadFunction, bracket: tuple[float, float], span: tuple[float, float], turns: bool
) -> RestPosition | None:
    """The same where the power, which changes its sign, is shown to be 0, and does not jump."""
    exact = _zero(function, as_written(_closed_in(function, *bracket)), *map(as_written, bracket))
    return in_range(function, rounded(exact), span, turns) if exact is not None else None


def _values(function: LoadFunction, at: Decimal, nodes: Sequence[int]) -> list[Decimal]:
    """Nodes of a function at a decimal of its free number [case units, degrees], in all digits."""
    record, exact = function.record, exact_record(function.compiled)
    given = {k: Decimal(float(v)) for k, v in function.given(np.array(float(at))).items()}
    return exact.values([record.nodes[k] for k in nodes], {**given, function.input: at})


def _least(function: LoadFunction, node: int) -> Decimal:
    """What is zero beside the terms of a node."""
    return CONTEXT.multiply(ZERO, Decimal(terms_within(function.record.nodes, node)))


def _zero(function: LoadFunction, start: Decimal, low: Decimal, high: Decimal) -> Decimal | None:
    """The zero of the power between two values by Newton's method in all digits; None where it leaves them or
    does not close in fast: at zeros of higher order, at jumps, where a root begins."""
    at, last = start, Decimal("Infinity")
    with localcontext(CONTEXT):
        for _ in range(MOST_STEPS):
            power, slope = _values(function, at, [function.power, function.slope])
            move = power / slope if slope else Decimal("NaN")
            if not abs(move) <= last / FASTER:
                return None
            at, last = at - move, abs(move)
            if not low - CLOSED <= at <= high + CLOSED:
                return None
            if last <= CLOSED:
                return at if abs(at) > CLOSED else Decimal(0)
    return None


def rounded(exact: Decimal) -> tuple[float, float]:
    """The nearest double and a bound of its error."""
    value = float(exact)
    off = CONTEXT.subtract(exact, Decimal(value))
    return value, 0.0 if off.copy_abs() <= CLOSED else math.ulp(value)


def in_range(
    function: LoadFunction, closest: tuple[float, float] | None, span: tuple[float, float], turns: bool
) -> RestPosition | None:
    """A value and its error as a position; None where it is beyond the range."""
    if closest is None:
        return None
    value, error = closest
    low, high = span
    if turns and is_angle(function.path):
        value = within_a_turn(value, error)
    elif not low <= value <= high:
        end = low if abs(value - low) < abs(value - high) else high
        if abs(value - end) > 4.0 * error:
            return None
        value = end
    return described(function, value, error)


def within_a_turn(value: float, error: float) -> float:
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
    load jumps from one sign to the other. 0 is asked first: about it doubles lie closer than the answers
    tell apart."""
    if bracket[0] <= 0.0 <= bracket[1] and balancing_torque(function, 0.0) == 0.0:
        return 0.0, 0.0
    step = math.ulp(start) or 5e-324
    here = balancing_torque(function, start)
    if here == 0.0:
        return _met(start)
    side = balancing_torque(function, bracket[1])
    toward = 1.0 if (side > 0.0) != (here > 0.0) else -1.0
    low, at_low, reach = start, here, step
    while True:
        high = start + toward * reach
        if not bracket[0] <= high <= bracket[1]:
            high = bracket[1] if toward > 0.0 else bracket[0]
        at_high = balancing_torque(function, high)
        if at_high == 0.0:
            return _met(high)
        if (at_high > 0.0) != (at_low > 0.0) or high in bracket:
            break
        low, at_low, reach = high, at_high, 4.0 * reach
    while True:
        middle = 0.5 * (low + high)
        if middle in (low, high):
            best = low if abs(at_low) <= abs(at_high) else high
            jumps = min(abs(at_low), abs(at_high)) > JUMP * max(abs(here), abs(side))
            return None if jumps else (best, abs(high - low))
        at_middle = balancing_torque(function, middle)
        if at_middle == 0.0:
            return _met(middle)
        if (at_middle > 0.0) == (at_low > 0.0):
            low, at_low = middle, at_middle
        else:
            high, at_high = middle, at_middle


def _met(value: float) -> tuple[float, float]:
    """A value at which the loads balance in all digits, and a bound of its error: none where its double is
    the decimal that names it."""
    return value, 0.0 if Decimal(value) == as_written(value) else math.ulp(value)


def scene_at(function: LoadFunction, value: float | Decimal) -> Case:
    """The case with the free datum at a value, in the mode of the function; of a mechanism that moves, the
    row of its sweep."""
    given = function.given(np.array(float(value)))
    return scene_in(function.compiled, given, {function.path: value}, function.places, function.springs)


def scene_in(
    compiled: CompiledSweep,
    given: Mapping[int, Array],
    values: Mapping[str, float | Decimal],
    places: Mapping[str, tuple[int, int]],
    springs: Mapping[str, int],
) -> Case:
    """The case of a recorded mode where free numbers have values.

    Parameters
    ----------
    given : all inputs of the record by node, single numbers
    values : the free data by path, or the turning of a link [case units, degrees]; decimals to all digits
    places, springs : nodes of the points that are named, and of the angles that torsion springs follow
    """
    case = compiled.setting.case
    if compiled.setting.moves:
        exact = {k: Decimal(float(v)) for k, v in given.items()}
        exact |= {compiled.inputs[path]: at for path, at in values.items() if isinstance(at, Decimal)}
        own = {path: exact[compiled.inputs[path]] for path in values if path not in case.links}
        return replace(RowScenes(compiled).case(exact, own), near={}, motion=(), expect=())
    ox, oy, scale = compiled.scene.frame
    nodes = [k for pair in places.values() for k in pair]
    found = Code(compiled.record, [*nodes, *springs.values()]).run(given, 1)
    flat = [float(np.ravel(v)[0]) for v in found]
    pairs = zip(places, zip(flat[::2], flat[1::2], strict=False), strict=False)
    near = {name: (x / scale + ox, y / scale + oy) for name, (x, y) in pairs if math.isfinite(x + y)}
    free = {name: at for name, at in near.items() if name not in case.given_places}
    case = counted_about(case, dict(zip(springs, flat[len(nodes) :], strict=True)))
    for path, value in values.items():
        case = given_at(case, path, found_number(value, path) if isinstance(value, Decimal) else value)
    return replace(case, near=free, motion=(), expect=())


def balancing_torque(function: LoadFunction, value: float, by: Torque | Force | None = None) -> float:
    """The torque on a link, or where none turns the force on a point, that would balance the loads, as
    `icsolve.solve` finds it by power; ``by`` this unknown load, where it is given."""
    case = scene_at(function, value)
    if by is not None:
        answer: Answer | None = solve_by_power(replace(case, loads=(*case.loads, by)))
    else:
        answer = held(case, function.links, solve=solve_by_power)
    assert answer is not None
    torque: float = answer.answers[PROBE].value
    return torque


def described(function: LoadFunction, value: float, error: float) -> RestPosition:
    """A position with its stiffness: rounded once where the zero is known in all digits, else enclosed about
    the value by the record. Of no error the value is meant as it stands, as a file writes it."""
    at = as_written(value)
    beside = Decimal(2.0 * error)
    low, high = CONTEXT.subtract(at, beside), CONTEXT.add(at, beside)
    exact = _zero(function, at, low, high) if error else at
    stiffness = None if exact is None else _stiffness(function, exact)
    if stiffness is not None:
        return told(function, value, error, _kind(stiffness), stiffness, "", exact if error else None)
    return _enclosed(function, value, error)


def _stiffness(function: LoadFunction, at: Decimal) -> Stiffness | None:
    """Minus the derivative of the generalised load at a decimal of the free number, rounded once; None at a
    limit, where the number stands still."""
    power, slope, rate = _values(function, at, [function.power, function.slope, function.rate])
    if any(map(Decimal.is_nan, (power, slope, rate))) or rate.copy_abs() <= _least(function, function.rate):
        return None
    node = function.slope
    if abs(power) > _least(function, function.power):
        node = _changing(function)
        (slope,) = _values(function, at, [node])
    factor, unit = units_of(function)
    least = _least(function, node)
    with localcontext(CONTEXT):
        if abs(slope) <= least:
            return Stiffness(0.0, unit, float(least / abs(rate) * factor))
        value = float(-slope / rate * factor)
    return Stiffness(value, unit, math.ulp(value)) if math.isfinite(value) else None


def _changing(function: LoadFunction) -> int:
    """The node of the derivative of the generalised load times the rate: where the loads do not balance it
    counts, too, that the rate of the free number changes along the motion."""
    record = function.record
    motion = record.nodes[function.rate]
    load = record.nodes[function.power] / motion
    return record.lifted(gradient(record, load, (function.input,))[function.input] * motion).index


def _kind(stiffness: Stiffness) -> str:
    """``neutral`` where the bound of the stiffness holds zero."""
    if abs(stiffness.value) <= (stiffness.error or 0.0):
        return "neutral"
    return "stable" if stiffness.value > 0.0 else "unstable"


def _enclosed(function: LoadFunction, value: float, error: float) -> RestPosition:
    """A position whose stiffness is enclosed over what its error leaves open."""
    cells = function.enclosed(Interval(np.array([value - error]), np.array([value + error])))
    record, nodes = function.record, [function.slope, function.rate, function.power]
    slope, rate, power = enclose(record, nodes, cells)
    if float(power.low.flat[0]) > 0.0 or float(power.high.flat[0]) < 0.0:
        (slope,) = enclose(record, [_changing(function)], cells)
    exact, unit = units_of(function)
    factor = float(exact)
    stiffness, why = None, ""
    with np.errstate(all="ignore"):
        pairs = [(float(s.flat[0]), float(r.flat[0])) for s in slope for r in rate] if _has_sign(rate) else []
    ends = [-s / r * factor for s, r in pairs]
    if ends and all(map(math.isfinite, ends)):
        low, high = min(ends), max(ends)
        middle = 0.5 * (low + high)
        stiffness = Stiffness(middle, unit, 0.5 * (high - low) + 4.0 * math.ulp(middle))
    else:
        why = AT_LIMIT
    return told(function, value, error, _kind(stiffness) if stiffness else "neutral", stiffness, why)


def told(
    function: LoadFunction,
    value: float,
    error: float,
    stability: str,
    stiffness: Stiffness | None,
    why: str,
    at: float | Decimal | None = None,
) -> RestPosition:
    """A position with its scene; ``at`` is the value in all digits, or one beside it that assembles."""
    case = scene_at(function, value if at is None else at)
    size = function.case.units.torque_per_force_length / (
        function.force_scale * function.compiled.scene.frame.scale
    )
    answer = solve_scene(case, rates=True)
    return RestPosition(value, error, stability, stiffness, why, answer, case, function.links, size)


def _has_sign(rate: Interval) -> bool:
    return bool((rate.low.flat[0] > 0.0) or (rate.high.flat[0] < 0.0))


def units_of(function: LoadFunction) -> tuple[Decimal, str]:
    """What brings minus slope over rate into the unit of a stiffness, and that unit."""
    units, scale = function.case.units, function.compiled.scene.frame.scale
    with localcontext(CONTEXT):
        per_load = 1 / (Decimal(function.force_scale) * Decimal(scale))
        if not function.turns_links:
            return per_load, f"{units.force}/{units.length}"
        per_torque = per_load * decimal_ratio(units.exact_torque)
        return per_torque / decimal_ratio(DEGREE) ** 2, f"{units.torque}/rad"


def in_open_cells(function: LoadFunction, cluster: tuple[float, float]) -> list[tuple[float, float]]:
    """The positions in cells that stayed open: zeros of higher order, at which the stiffness vanishes too, or
    zeros that intervals do not tell apart, but digits do."""
    low, high = cluster
    width = max(high - low, 4.0 * math.ulp(abs(low) + abs(high)))
    low, high = low - width, high + width
    with localcontext(CONTEXT):
        ends = as_written(low), as_written(high)
        zeros = zeros_between(lambda at: _values(function, at, [function.power])[0], *ends, MOST_ORDER)
        found = [rounded(at if abs(at) > NEAR else Decimal(0)) for at in sorted(zeros)]
    if found:
        return found
    closest = _by_scenes(function, low, high)
    return [closest] if closest is not None else []


def _by_scenes(function: LoadFunction, low: float, high: float) -> tuple[float, float] | None:
    """The position between two values by the scenes there, where there is one."""
    try:
        at_low, at_high = balancing_torque(function, low), balancing_torque(function, high)
        if (at_low > 0.0) != (at_high > 0.0):
            return _to_the_last_digit(function, 0.5 * (low + high), (low, high))
        beside = max(abs(at_low), abs(at_high))
        turning = _turning_point(function, low, high)
        if turning is None:
            return None
        value, error = turning
        plain = plain_within(value, error)
        if balancing_torque(function, plain) == 0.0:
            return _met(plain)
        least = abs(balancing_torque(function, value))
    except SceneError:
        return None
    # beside the place the load rises as the square of the distance: so much is left where that is zero,
    # and two zeros may lie on either side of it
    return (value, 2.5 * error) if least <= 8.0 * beside * (error / (high - low)) ** 2 else None


def plain_within(value: float, error: float) -> float:
    """The number with the fewest decimals that is as near as an error bound."""
    return next((v for d in range(13) if abs((v := round(value, d)) - value) <= error), value)


def modes_meet(function: LoadFunction, cluster: tuple[float, float]) -> bool:
    """Whether two modes meet in some cells."""
    width = max(cluster[1] - cluster[0], 4.0 * math.ulp(abs(cluster[0]) + abs(cluster[1])))
    here = Interval(np.array([cluster[0] - width]), np.array([cluster[1] + width]))
    margins = enclose(function.record, function.margins, function.enclosed(here))
    return any(not float(margin.low.flat[0]) > 0.0 for margin in margins)


def at_change_point(
    function: LoadFunction, cluster: tuple[float, float], step: float, span: tuple[float, float]
) -> list[RestPosition]:
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
    known = Stiffness(-slope * per, units_of(function)[1], off_slope * abs(per))
    kind = "neutral" if abs(slope) <= off_slope else "stable" if known.value > 0.0 else "unstable"
    return [here._replace(value=value, error=error, stability=kind, stiffness=known)]


def _generalised(function: LoadFunction, value: float) -> float:
    """The generalised load of the free datum [case units], of the torque that would balance it."""
    answer = held(scene_at(function, value), function.links, solve=solve_by_power, rates=True)
    assert answer is not None
    probe, units = answer.case.loads[-1], function.case.units
    if not isinstance(probe, Torque):
        return 0.0
    ratio = float((answer.rates or {})[probe.link]) / rate_of(answer, function.path)
    torque: float = answer.answers[PROBE].value
    return -torque * ratio * (1.0 if function.turns_links else 1.0 / units.torque_per_force_length)


def _scenes_near(function: LoadFunction, value: float, step: float) -> Iterator[RestPosition]:
    """The scene at a change point, or as near to it as it has an answer."""
    for part in (0.0, 1e-9, 1e-6, 1e-3):
        with suppress(SceneError):
            yield told(function, value, 0.0, "", None, "", value + part * step)


def _turning_point(function: LoadFunction, low: float, high: float) -> tuple[float, float] | None:
    """Where the power's derivative changes its sign, as far as its enclosure tells; None where nowhere."""

    def sign(value: float) -> int:
        here = np.array([value])
        (slope,) = enclose(function.record, [function.slope], function.enclosed(Interval(here, here)))
        return int(float(slope.low.flat[0]) > 0.0) - int(float(slope.high.flat[0]) < 0.0)

    first, last = sign(low), sign(high)
    if not first or not last or first == last:
        return None
    _, start = last_that_holds(lambda value: sign(value) == first, low, high)
    _, stop = last_that_holds(lambda value: sign(value) == last, high, low)
    middle = 0.5 * (start + stop)
    return middle, 0.5 * abs(stop - start) + math.ulp(middle)


def distinct(found: Sequence[RestPosition]) -> list[RestPosition]:
    """Rests by rising value, those that two modes share once."""
    kept: list[RestPosition] = []
    widest = 8.0 * max((rest.error for rest in found), default=0.0)
    for one in found:
        first = bisect_left(kept, one.value - widest, key=lambda rest: rest.value)
        if not any(_same(one, other) for other in kept[first:]):
            kept.append(one)
    return kept


def _same(one: RestPosition, other: RestPosition) -> bool:
    if abs(one.value - other.value) > 4.0 * (one.error + other.error):
        return False
    if one.stiffness is not None and other.stiffness is not None:  # of two branches, at a change point
        off = 4.0 * ((one.stiffness.error or 0.0) + (other.stiffness.error or 0.0))
        if abs(one.stiffness.value - other.stiffness.value) > off + APART * abs(one.stiffness.value):
            return False
    size = max((abs(c) for at in one.answer.points.values() for c in at), default=1.0)
    theirs = other.answer.points
    return all(math.dist(at, theirs[name]) <= APART * size for name, at in one.answer.points.items())
