"""Friction with a given motion: every rub at its limit, against the motion.

The senses come from the rates that the twists (the centres) give; they are checked after solving, and
no rub may give power.
"""

from __future__ import annotations

from collections.abc import Sequence

from icsolve.errors import SceneError, Status
from icsolve.statics.equilibrium import Statics
from icsolve.statics.friction_equations import Reduced, error_of, is_sound, reduced, reduced_workless
from icsolve.statics.homotopy import COUNTED, Solutions, all_roots, can_count, solutions
from icsolve.tuples import NamedTuple
from icsolve.wording.sentences import listed


class Slid(NamedTuple):
    """The solution while the mechanism moves.

    Attributes
    ----------
    unknowns : by load [case units]
    friction : (rubs,), on the ties' second links [scaled]
    limits : (rubs,), its sizes
    error : bound of the relative error of the forces that press, from what is left of their equations
    unique : how it is known that there is no other solution; empty where it is not
    others : the values of the first unknown load in all other solutions [case units]
    """

    unknowns: dict[str, float]
    friction: tuple[float, ...]
    limits: tuple[float, ...]
    error: float
    unique: str
    others: tuple[float, ...]


def slid(statics: Statics, senses: Sequence[float], workless: bool) -> Slid:
    """Solve the friction of given senses.

    Parameters
    ----------
    statics : with friction as parameters
    senses : (rubs,), 1, -1 or 0: those of the rubbing motions of the second links
    workless : whether the unknown load does no work, so that the frictions alone balance the known ones

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
    found = solutions(equations.equations)
    if found.main is None:
        return _unconnected(statics, equations, found)
    return _of(statics, equations, found.main, found.others, found.unique)


def _of(
    statics: Statics, equations: Reduced, y: Sequence[float], others: Sequence[Sequence[float]], unique: str
) -> Slid:
    loads = [value / statics.scale for value in equations.load(y)]
    friction = equations.friction(y)
    limits = tuple(abs(f) for f in friction)
    error = error_of(equations.equations, y)
    values = tuple(equations.load(other)[0] / statics.scale for other in others if equations.loads)
    return Slid(dict(zip(statics.roots, loads, strict=True)), friction, limits, error, unique, values)


def _unconnected(statics: Statics, equations: Reduced, found: Solutions) -> Slid:
    """Where friction stops the solution that grows out of none: another one, if there is just one."""
    if found.unique and len(found.others) == 1:
        return _of(statics, equations, found.others[0], (), found.unique)
    if found.others:
        values = sorted(equations.load(y)[0] / statics.scale for y in found.others)
        raise SceneError(Status.AMBIGUOUS, _several(statics, values))
    raise SceneError(Status.JAM, _jam(statics, found))


def _several(statics: Statics, values: Sequence[float]) -> str:
    shown = listed(f"{value:.6g}" for value in values)
    return (
        f"with this friction the motion is in equilibrium at {len(values)} values of {statics.roots[0]}: "
        f"{shown}. None of them grows out of the equilibrium without friction: reduce `mu`, or take another "
        "position."
    )


def _jam(statics: Statics, found: Solutions) -> str:
    way = "the forces grow without bound" if found.grows else "its equilibrium ends"
    sure = "" if found.unique else " (more solutions than could be counted were not looked for)"
    return (
        f"the mechanism jams: no value of {listed(statics.roots)} keeps up the given motion. As friction is "
        f"brought in, {way} at {100.0 * found.share:.4g} % of the given coefficients{sure}. Reduce `mu`, or "
        "drive another link."
    )


def _workless(statics: Statics, senses: Sequence[float]) -> Slid:
    """The unknown load does no work: it presses, and the frictions balance the known loads."""
    equations = reduced_workless(statics, senses)
    if equations is None:
        raise SceneError(Status.NO_VALUE, _nothing_rubs(statics))
    if not can_count(equations.equations):
        raise SceneError(Status.UNSUPPORTED, _too_many(statics))
    found = [y for y in all_roots(equations.equations) if is_sound(equations.equations, y)]
    if not found:
        raise SceneError(Status.NO_VALUE, _nothing_balances(statics))
    if len(found) > 1:
        found.sort(key=lambda y: abs(equations.load(y)[0]))
    return _of(statics, equations, found[0], found[1:], COUNTED)


def _draws_nothing(statics: Statics) -> str:
    return (
        f"no value of {statics.roots[0]} balances: it does no work, and draws no rope that slips. Put the "
        "unknown where it moves its link or draws the rope."
    )


def _nothing_rubs(statics: Statics) -> str:
    return (
        f"no value of {statics.roots[0]} balances: it does no work, and no friction does. Put the unknown on "
        "a link that moves, or give `mu` where links rub."
    )


def _nothing_balances(statics: Statics) -> str:
    return (
        f"no value of {statics.roots[0]} keeps up the given motion: it does no work itself, and the friction "
        "that it makes does not balance the known loads. Turn the motion round, or put the unknown elsewhere."
    )


def _too_many(statics: Statics) -> str:
    return (
        f"{statics.roots[0]} does no work, and {len(statics.rubs)} places rub: more than can be solved where "
        "only friction balances the loads. Take out `mu` where it matters least."
    )
