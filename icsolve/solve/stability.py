"""Whether a position in equilibrium is stable, and the values of a load at which it ceases to be."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from functools import cache
from itertools import groupby, islice, pairwise
from typing import TYPE_CHECKING

from icsolve.answer import Answer
from icsolve.answer.equilibrium import Stiffness
from icsolve.case import Case
from icsolve.errors import CaseError, Problem, SceneError, Status
from icsolve.kinematics.speeds import joint_order
from icsolve.numbers.roots import zero_between
from icsolve.read.names import shown
from icsolve.scene import solve_scene
from icsolve.scene.needed_part import by_needed_part
from icsolve.solve.positions import driven_rest, find_along, moved_by, refuse_motion, refuse_profiles, rest_of
from icsolve.solve.rest_position import RestPosition, balances, holding
from icsolve.statics.power import has_friction, smooth
from icsolve.sweep.varied_numbers import find_number, refuse_space, with_numbers
from icsolve.tuples import NamedTuple, replace

if TYPE_CHECKING:
    from icsolve.solve.known_loads import Held

CUTS = 32
MovingLoads = Callable[[float], "Held"]
"""Those of `loads_along`."""


def with_stability(case: Case, answer: Answer, of: str) -> Answer:
    """The answer with the stability of the position as written, its found loads held as they are.

    ``of`` is a datum that poses the figure (``angles.AB``) or a link's name. Raises CaseError for what is
    neither, SceneError where the mechanism can't be moved by it.
    """
    refuse_space(case)
    own = [unknown.path for unknown in case.unknowns]
    if answer.positions is not None and of in own:
        return answer
    _refuse_unknown(case, of)
    if answer.positions is not None:
        if "." in of and find_number(case, of).path in own:
            return answer
        asked = " and ".join(own)
        said = (
            f"each position of equilibrium has its own stability, by {asked}: leave out --stability {of}, or "
            f"give {asked} a number for that of one position."
        )
        raise SceneError(Status.UNSUPPORTED, said)
    paths, links = ((of,), ()) if "." in of else ((), (of,))
    rest, left_out = by_needed_part(
        case, lambda part: rest_as_written(holding(part, answer), of), paths, links, bodies=True
    )
    rested = replace(answer, stability=rest.stability, stiffness=rest.stiffness, why_no_stiffness=rest.why)
    told = not left_out or left_out in answer.notes
    return rested if told else replace(rested, notes=(*answer.notes, left_out))


def _refuse_unknown(case: Case, of: str) -> None:
    """Refuse what is neither a link nor a number of the case, by the names that would do."""
    if of in case.links:
        return
    if "." in of:
        find_number(case, of, "no stability by")
        return
    movable = [link for link in case.links if link != case.ground]
    links = f"name a link that moves ({', '.join(movable)})"
    said = f"no stability by {shown(of)}: {links}, or a datum that poses the figure, as angles.AB"
    raise CaseError([Problem(case.path, 1, 1, said)])


def rest_as_written(case: Case, of: str) -> RestPosition:
    """The position as written of a case whose loads are all known and balance."""
    refuse_motion(case)
    refuse_profiles(case)
    if has_friction(case):
        said = "with friction a position is one of a range, and has no stability: leave out the friction."
        raise SceneError(Status.UNSUPPORTED, said)
    freedoms = solve_scene(replace(case, loads=()), bound=False).mobility or 0
    if freedoms > 1 and of in case.links:
        raise SceneError(
            Status.MOBILITY,
            f"the mechanism has {freedoms} degrees of freedom: how stiff it is by link {of} alone says "
            "nothing of the others. Let as many data of its figure be `unknown` as it has.",
        )
    try:
        return rest_of(case, of)
    except SceneError as refusal:
        if refusal.status not in (Status.UNSUPPORTED, Status.MOBILITY) or of not in case.links:
            raise
        return _by_another(case, of, refusal)


def _by_another(case: Case, link: str, refusal: SceneError) -> RestPosition:
    """The position for a link that the search can't drive (a coupler, a block that slides), by one that it
    can.

    Where the loads balance, the second derivative of their work by one coordinate is that by another times
    the square of the ratio of their rates; where they do not, or none can be driven alone, the link is driven
    with all the others. Raises ``refusal`` where it stands still.
    """
    try:
        other = _driven(case)
    except SceneError:
        return driven_rest(case, link)
    rest = rest_as_written(case, other)
    rates, velocities = rest.answer.rates or {}, rest.answer.velocities or {}
    own, by = rates.get(link), rates.get(other)
    slides = own == 0.0
    if slides:
        speeds = (v for (_, on), v in velocities.items() if on == link and isinstance(v, tuple))
        own = next((math.hypot(*v) for v in speeds), 0.0)
    if not isinstance(own, float) or not isinstance(by, float) or not own:
        raise refusal
    if not balances(rest):  # the second derivative by another coordinate is not that by this one
        return driven_rest(case, link)
    if rest.stiffness is None:
        return rest
    ratio, unit = (by / own) ** 2, rest.stiffness.unit
    if slides:
        ratio, unit = ratio / case.units.torque_per_force_length, f"{case.units.force}/{case.units.length}"
    value = rest.stiffness.value * ratio
    error = None
    if rest.stiffness.error is not None:
        error = rest.stiffness.error * ratio + 8.0 * math.ulp(value)
    return rest._replace(stiffness=Stiffness(value, unit, error))


class TurningPower(NamedTuple):
    """A value at which something ceases to be one thing and becomes another."""

    value: float
    error: float
    before: str
    after: str


def neutral_values(case: Case, path: str, low: float, high: float) -> list[TurningPower]:
    """The values of a load's number at which the position as written changes its stability.

    The case has to be in equilibrium as written for all of them. One cut beyond each end is looked at too,
    so that a change at the very end is seen.
    """
    own = find_number(case, path).path
    link = _driven(case)

    def stiffness(value: float) -> Stiffness:
        rest = rest_as_written(with_numbers(case, {own: value}), link)
        if rest.stiffness is None:
            raise SceneError(Status.DEAD_CENTRE, f"link {link} stands still as written.")
        if not balances(rest):
            raise SceneError(
                Status.UNBALANCED,
                f"the loads do not balance as written where {path} is {value:g}, so no stability is lost "
                "there. Write the figure in a position of equilibrium, or let a datum of it be `unknown`.",
            )
        return rest.stiffness

    both: list[tuple[float, Stiffness]] = []
    for n in range(-1, CUTS + 2):
        value = low + (high - low) * n / CUTS
        try:
            both.append((value, stiffness(value)))
        except SceneError:
            if low <= value <= high:
                raise
    known = [(value, k) for value, k in both if abs(k.value) > (k.error or 0.0)]
    found = []
    for (a, at_a), (b, at_b) in pairwise(known):
        if (at_a.value > 0.0) != (at_b.value > 0.0):
            one = _neutral_between(stiffness, (a, at_a), (b, at_b))
            if low - one.error <= one.value <= high + one.error:
                found.append(one._replace(value=min(max(one.value, low), high)))
    return found


def _neutral_between(
    stiffness: Callable[[float], Stiffness], one: tuple[float, Stiffness], two: tuple[float, Stiffness]
) -> TurningPower:
    """Where the stiffness vanishes between two values: at once where it is linear in the number (a force, a
    mass, a spring's own), else by going on so."""
    words = ("stable", "unstable") if one[1].value > 0.0 else ("unstable", "stable")
    while True:
        (a, at_a), (b, at_b) = one, two
        slope = (at_b.value - at_a.value) / (b - a)
        value = a - at_a.value / slope
        here = stiffness(value)
        error = (here.error or 0.0) / abs(slope) + 2.0 * math.ulp(value)
        if abs(here.value) <= 2.0 * error * abs(slope) or not min(a, b) < value < max(a, b):
            return TurningPower(value - here.value / slope, error, *words)
        middle = 0.5 * (a + b)  # cut so often that no side stands still
        for at, k in ((value, here), (middle, stiffness(middle))):
            if one[0] < at < two[0]:
                one, two = ((at, k), two) if (k.value > 0.0) == (one[1].value > 0.0) else (one, (at, k))


def _driven(case: Case) -> str:
    """A link by which the mechanism can be turned.

    Raises SceneError where there is none.
    """
    refusal = SceneError(Status.STRUCTURE, "nothing turns in this case, so it has no stability.")
    for link in joint_order(case):
        try:
            if link != case.ground and link in moved_by(replace(case, expect=(), motion=()), link).links:
                return link
        except SceneError as error:
            refusal = error
    raise refusal


def loads_along(case: Case, path: str) -> MovingLoads:
    """What loads more would move a mechanism under known loads, by the value of a number; what was sampled is
    asked again where it is closed in on."""
    from icsolve.solve.known_loads import moving_loads

    own = find_number(case, path).path

    @cache
    def loads(value: float) -> Held:
        return moving_loads(with_numbers(case, {own: value}), own)

    return loads


def holding_values(
    case: Case, path: str, low: float, high: float, loads: MovingLoads | None = None
) -> list[TurningPower]:
    """The values of a number at which a mechanism under known loads begins or ceases to hold still; ``loads``
    are those of `loads_along`, where they are asked elsewhere too."""
    from icsolve.solve.friction_ranges import edge_of_rest
    from icsolve.solve.known_loads import Spare, held_along, spare_friction

    own, loads = find_number(case, path).path, loads or loads_along(case, path)

    def spare(value: float) -> Spare:
        return spare_friction(loads(value))

    def middle(value: float) -> float:
        both = loads(value).low + loads(value).high
        return both if math.isfinite(both) else 0.0

    values = _places(low, high)
    known = [(max(a, low), min(b, high)) for a, b in held_along(case, own)]

    def turned(a: float, b: float) -> bool:
        """Whether it slips in either sense of the load that is asked at both."""
        one, other = loads(a), loads(b)
        slips = max(spare(a)[0], spare(b)[0]) < 0.0
        return slips and one.load == other.load and middle(a) * middle(b) < 0.0

    def beside(a: float, b: float) -> Iterator[float]:
        """A value toward another, at which another load is asked, that shows whether it slips so."""
        if max(spare(a)[0], spare(b)[0]) < 0.0 and loads(a).load != loads(b).load:
            near = (b + (a - b) * 2.0 ** (-4 * n) for n in range(1, 7))
            yield from islice((c for c in near if turned(a, c)), 1)

    values = sorted({*values, *(0.5 * (a + b) for a, b in known if a < b), *_rests(case, own, low, high)})
    pairs = tuple(pairwise(values))  # at a dead centre another load is asked than next to it
    values = sorted({*values, *(c for a, b in pairs for c in (*beside(a, b), *beside(b, a)))})
    for a, b in pairwise(tuple(values)):  # between two at which it slips in either sense it may hold
        if turned(a, b):
            values.append(zero_between(middle, a, b, middle(a), middle(b)))
    values.sort()
    found = []
    for (a, holds), (b, held) in pairwise([(value, spare(value)[0] >= 0.0) for value in values]):
        if holds != held:
            words = ("holds", "slips") if holds else ("slips", "holds")
            found.append(TurningPower(*edge_of_rest(spare, *((a, b) if holds else (b, a))), *words))
    return found


def _rests(case: Case, path: str, low: float, high: float) -> list[float]:
    """The values of a number at which a mechanism under known loads rests without friction, and so holds
    still with it; none of one that does not pose the figure."""
    if not path.startswith(("angles.", "lengths.", "points.")):
        return []
    try:
        return [rest.value for rest in find_along(smooth(case), path, low, high)[0]]
    except (CaseError, SceneError):
        return []


def _places(low: float, high: float) -> list[float]:
    """Where it is looked, evenly."""
    return [low + (high - low) * k / CUTS for k in range(CUTS + 1)]


def is_still(case: Case, path: str, value: float, loads: MovingLoads | None = None) -> bool:
    """Whether a mechanism under known loads holds still at a value of a number."""
    from icsolve.solve.known_loads import spare_friction

    return spare_friction((loads or loads_along(case, path))(value))[0] >= 0.0


def left_along(
    low: float, high: float, changes: Iterable[TurningPower], loads: MovingLoads
) -> list[tuple[float, float]]:
    """From which to which of the places that are looked at, those beside these changes too, a mechanism that
    is said to slip may still hold, as friction was left."""
    places = _places(low, high)
    for one in changes:
        step = 4.0 * one.error + BESIDE * abs(one.value)
        places.append(one.value + (step if one.after == "slips" else -step))
    asked = [(at, loads(at).left(0.0)) for at in sorted(places)]
    stretches = [[at for at, _ in stretch] for left, stretch in groupby(asked, lambda one: one[1]) if left]
    return [(stretch[0], stretch[-1]) for stretch in stretches]


BESIDE = 1e-9
"""So far beside a value, of its size, no rounding decides what is so there."""

__all__ = [
    "TurningPower",
    "holding_values",
    "is_still",
    "left_along",
    "loads_along",
    "neutral_values",
    "rest_as_written",
    "with_stability",
]
