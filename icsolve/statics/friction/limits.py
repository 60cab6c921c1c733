"""Friction in a given motion, where every rub is at its limit, against the motion.

The senses come from the rates that the twists (the centres) give; they are checked after solving, and no rub
may give power.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

from icsolve.errors import SceneError, Status
from icsolve.statics.equilibrium import Statics
from icsolve.statics.friction import place_of
from icsolve.statics.friction.equations import (
    Lengths,
    Reduced,
    Y,
    contracted,
    contraction,
    error_of,
    reduced,
    reduced_workless,
    without_friction,
)
from icsolve.tuples import LateModule, NamedTuple
from icsolve.wording import listed

if TYPE_CHECKING:
    from icsolve.statics.friction import conditioning as coordinates
    from icsolve.statics.friction import solutions as every
else:  # where one is not proven to be the only one
    coordinates = LateModule("icsolve.statics.friction.conditioning")
    every = LateModule("icsolve.statics.friction.solutions")

ROUNDED = 2.0**-48
"""A force is zero below this fraction of its terms."""
CONTRACTS = "the friction equations contract: Banach's theorem gives one solution and no other"
COUNTED = "all solutions were counted"


class Solutions(NamedTuple):
    """The solution of the friction equations that grows out of none.

    Attributes
    ----------
    main : (rubs,) [scaled force]; None: it stops at ``share`` of the friction
    unique : how it is known that there are no others; empty where that is not known
    share : fraction of full friction to which ``main`` could be followed
    grows : whether its forces grew without bound there
    """

    main: Y | None
    unique: str
    share: float = 1.0
    grows: bool = False


def solutions(equations: Lengths) -> Solutions:
    """That of a fixed point y = |v(y)|: the one where it contracts, else followed from no friction."""
    if contraction(equations) is not None:
        return Solutions(contracted(equations), CONTRACTS)
    main, share, grows = every.followed(equations)
    return Solutions(main, "", share, grows)


class Slid(NamedTuple):
    """The solution while the mechanism moves.

    Attributes
    ----------
    unknowns : by load [case units]
    friction : (rubs,), on the ties' second links [scaled]
    error : bound of the relative error of the forces that press, from what is left of their equations
    unique : how it is known that there is no other solution; empty where it is not
    others : the values of the first unknown load in all other solutions [case units]
    """

    unknowns: dict[str, float]
    friction: tuple[float, ...]
    error: float
    unique: str
    others: tuple[float, ...]


def slid(statics: Statics, senses: Sequence[float], workless: bool, alone: bool = False) -> Slid:
    """Solve the friction of given senses.

    Parameters
    ----------
    statics : with friction as parameters
    senses : (rubs,), 1, -1 or 0: those of the rubbing motions of the second links
    workless : whether the unknown load does no work, so that the frictions alone balance the known ones
    alone : whether other solutions beside the one that grows out of no friction are not looked for

    Raises
    ------
    SceneError
        Where no value of the unknown load keeps up the motion (it jams), or several do without one to prefer.
    """
    equations = None if workless else reduced(statics, senses)
    if equations is None:
        if not statics.rubs:  # what could draw a rope that slips does not
            raise SceneError(Status.NO_VALUE, _draws_nothing(statics))
        return _workless(statics, senses)
    by = well_told(statics, senses, equations)
    found = solutions(by.equations)
    if found.main is not None and (found.unique or alone):
        return _of(statics, by, found.main, (), found.unique)
    roots = every.all_roots(by.equations)
    unique = "" if roots is None else COUNTED
    main = found.main
    off = 0.0 if main is None else min(error_of(by.equations, main), MOST_OFF)
    others = [y for y in roots or () if main is None or not every.near(y, main, off)]
    if main is not None:
        loads = tuple(by.load(other)[0] / statics.scale for other in others if by.loads)
        return _of(statics, by, main, loads, unique)
    if len(others) == 1:
        return _of(statics, by, others[0], (), unique)
    if others:
        raise SceneError(Status.AMBIGUOUS, _several(statics, sorted(by.load(y)[0] for y in others)))
    parts = None if found.grows else parting(equations.equations, found.share)
    raise SceneError(
        Status.JAM, _jam(statics, found, unique) if parts is None else _tips(statics, found, parts)
    )


def parting(equations: Lengths, share: float) -> int | None:
    """The contact that ceases to push, with which the equilibrium ends at a share of the friction: next to
    nothing is left of what it pushes with without friction."""
    last = every.followed(equations.scaled(SHORT * share))[0] or without_friction(equations)
    threes = zip(last, without_friction(equations), equations.touching, strict=True)
    return next((k for k, (left, smooth, only) in enumerate(threes) if only and left < 0.01 * smooth), None)


MOST_OFF = 0.25
"""Two solutions that differ by more are two, however near to a jam they are found."""


SHORT = 0.999
"""So far before its end an equilibrium is looked at."""


LARGE = 100.0
"""Where a coefficient is larger other coordinates are worth their time."""


def well_told(statics: Statics, senses: Sequence[float], equations: Reduced) -> Reduced:
    """The equations; beside a singular position in other coordinates, with the digits that it takes: rounding
    beside large coefficients loses solutions, and makes some that are none."""
    forms = (*equations.loads, *(form for forms in equations.equations.vectors for form in forms))
    if all(abs(a) <= LARGE for form in forms for a in form[1:]):
        return equations
    if statics.asks is not None:
        with suppress(SceneError):  # no digits settle it
            other: Reduced | None = statics.asks(lambda exact: coordinates.conditioned(exact, senses))
            return other or equations
    alone = len(statics.roots) == len(statics.general.left) == 1
    return (reduced_workless(statics, senses) if alone else None) or equations


def _of(
    statics: Statics, equations: Reduced, y: Sequence[float], others: tuple[float, ...], unique: str
) -> Slid:
    loads = [value / statics.scale for value in equations.load(y)]
    error = error_of(equations.equations, y)
    return Slid(dict(zip(statics.roots, loads, strict=True)), equations.friction(y), error, unique, others)


def _several(statics: Statics, scaled: Sequence[float]) -> str:
    shown = listed(f"{value / statics.scale:.6g}" for value in scaled)
    return (
        f"with this friction the motion is in equilibrium at {len(scaled)} values of {statics.roots[0]}: "
        f"{shown}. None of them grows out of the equilibrium without friction: reduce `mu`, or take another "
        "position."
    )


def jams_at_last(statics: Statics) -> str:
    """That the forces grow without bound with the whole of the friction."""
    return _jam(statics, Solutions(None, "", 1.0, True), CONTRACTS)


def _jam(statics: Statics, found: Solutions, unique: str) -> str:
    way = "the forces grow without bound" if found.grows else "its equilibrium ends"
    sure = "" if unique else " (more solutions than could be counted were not looked for)"
    return (
        f"the mechanism jams: no value of {listed(statics.roots)} keeps up the given motion. As friction is "
        f"brought in, {way} at {100.0 * found.share:.4g} % of the given coefficients{sure}. Reduce `mu`, or "
        "drive another link."
    )


def _tips(statics: Statics, found: Solutions, contact: int) -> str:
    tie = statics.ties[statics.rubs[contact].tie]
    return (
        f"no value of {listed(statics.roots)} keeps up the given motion: as friction is brought in, the "
        f"contact of links {tie.by} and {tie.on}{place_of(tie)} ceases to push at {100.0 * found.share:.4g} "
        "% of the given coefficients. The links part there, and tip or lift off before they slide. Reduce "
        "`mu`, or put the unknown elsewhere."
    )


def _workless(statics: Statics, senses: Sequence[float]) -> Slid:
    """The unknown load does no work: it presses, and the frictions balance the known loads."""
    equations = reduced_workless(statics, senses)
    if equations is None:
        raise SceneError(Status.NO_VALUE, nothing_rubs(statics))
    found = every.all_roots(equations.equations)
    if found is None:
        raise SceneError(Status.UNSUPPORTED, too_many(statics))
    if not found:
        raise SceneError(Status.NO_VALUE, _nothing_balances(statics))
    if len(found) > 1:
        found.sort(key=lambda y: abs(equations.load(y)[0]))
    loads = tuple(equations.load(other)[0] / statics.scale for other in found[1:])
    return _of(statics, equations, found[0], loads, COUNTED)


def _draws_nothing(statics: Statics) -> str:
    return (
        f"no value of {statics.roots[0]} balances: it does no work, and draws no rope that slips. Put the "
        "unknown where it moves its link or draws the rope."
    )


def nothing_rubs(statics: Statics) -> str:
    """What is said where neither the unknown load nor any friction does work."""
    return (
        f"no value of {statics.roots[0]} balances: it does no work, and no friction does. Put the unknown on "
        "a link that moves, or give `mu` where links rub."
    )


def _nothing_balances(statics: Statics) -> str:
    return (
        f"no value of {statics.roots[0]} keeps up the given motion: it does no work itself, and the friction "
        "that it makes does not balance the known loads. Turn the motion round, or put the unknown elsewhere."
    )


def too_many(statics: Statics) -> str:
    return (
        f"{statics.roots[0]} does no work, and {len(statics.rubs)} places rub: more than can be solved where "
        "only friction balances the loads. Take out `mu` where it matters least."
    )
