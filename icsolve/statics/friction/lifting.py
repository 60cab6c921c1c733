"""Contacts that push by friction alone: loads that grow from nothing lift them off.

Without friction the loads balance where one for each freedom gives way: a load, or a force at the place of
one, as its inertia would make (whatever the weights, least squares lie between such choices: A. Ben-Tal and
M. Teboulle, 1990). What pushes in none of these and would have to pull in some, friction holds only where it
was pressed together before: it is a jam.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations, islice

from icsolve.numbers import FLOATS, largest_of
from icsolve.numbers.linear import Row, eliminate
from icsolve.statics.equilibrium import Statics, equilibrium, value_of
from icsolve.statics.friction import place_of
from icsolve.statics.friction.limits import ROUNDED
from icsolve.statics.load_wrenches import Wrench, number_of
from icsolve.statics.load_wrenches import place_of as place_of_load
from icsolve.statics.power import Balance, force_scale
from icsolve.statics.reaction_basis import Position, slipping, ties_of
from icsolve.statics.reactions import can_share
from icsolve.wording import listed

MOST_CHOICES = 2000
"""Of the loads that may give way so many choices are looked at at most."""
LIFTED = (
    "it holds as a jam: the contact {} pushes by friction alone, and would have to pull without it. Loads "
    "that grow from nothing lift it off; it holds where it was pressed together before."
)


FAR = 2.0**30
"""So many times the known loads an unknown one is as good as infinite."""


def jammed(position: Position, balance: Balance, root: str = "", ends: Sequence[float] = (0.0,)) -> str:
    """The sentence on contacts that push by friction alone; empty where none does.

    Parameters
    ----------
    position, balance : the scene
    root, ends : the unknown load, if any, and from where to where it holds [case units]
    """
    if not any(joint.only_pushes for joint in position.case.joints):
        return ""
    far = FAR / force_scale(balance)
    still = slipping(position, ((0.0,) * (len(rope.parts) - 1) for rope in position.ropes))
    given, more = list[Wrench](), list[Wrench]()
    for w in balance.wrenches:
        gain = w.gain if w.root == root else float(w.gain) * number_of(w, FLOATS)
        given.append(w._replace(gain=gain, number=None))
        for unit in X_AND_Y if place_of_load(w.load, still.points) else ():
            named = w.load._replace(name=f"{w.load.name} {unit}")
            more.append(Wrench(named, w.against, unit, 1.0, named.name, 1.0, 1.0, None, 1.0))
    statics = equilibrium(still, ties_of(still), balance._replace(wrenches=(*given, *more)))
    loads = {**dict.fromkeys(statics.roots, 1.0), **{w.root: 0.0 for w in more}}
    signs: dict[str, set[int]] = {}
    for end in ends:
        own = {root: max(-far, min(end, far))} if root else {}
        for balanced in islice(_balanced(statics, {**loads, **own}), MOST_CHOICES):
            alone, shared = _signs(statics, balanced)
            for contact, sign in (alone | shared).items():
                signs.setdefault(contact, set()).add(sign)
            if all(1 in found for found in signs.values()):
                return ""
    lifted = [contact for contact, found in signs.items() if -1 in found and 1 not in found]
    return LIFTED.format(listed(lifted)) if lifted else ""


X_AND_Y = ((0.0, 1.0, 0.0), (-1.0, 0.0, 0.0))
"""Forces of 1 along x and along y, as wrenches."""


def _balanced(statics: Statics, loads: Mapping[str, float]) -> Iterator[dict[str, float]]:
    """The loads, those changed that give way, one for each freedom, until all balance without friction."""
    count, of = len(statics.roots), statics.root
    rows = [*statics.general.solved.values(), *statics.general.left]
    sizes = [largest_of([row.get(of(n), 0.0) for row in rows]) for n in range(count)]
    powers = [
        {n: a for n, size in enumerate(sizes) if abs(a := row.get(of(n), 0.0)) > ROUNDED * size}
        for row in statics.general.left
    ]
    given = [loads[root] for root in statics.roots]
    freedoms = len(eliminate(powers, count).solved)
    working = [n for n in range(count) if any(n in row for row in powers)]
    for giving in combinations(working, freedoms):
        others = [n for n in range(count) if n not in giving]
        place = {n: k for k, n in enumerate((*giving, *others))}
        solved = eliminate([{place[n]: a for n, a in row.items()} for row in powers], freedoms).solved
        if len(solved) == freedoms:
            known = {place[n]: given[n] for n in others}
            found = {n: value_of(solved[k], known) for k, n in enumerate(giving)}
            yield {root: found.get(n, given[n]) for n, root in enumerate(statics.roots)}


def pulling(statics: Statics, unknowns: Mapping[str, float]) -> list[str]:
    """The contacts of which each by itself would have to pull without friction."""
    return [contact for contact, sign in _signs(statics, unknowns)[0].items() if sign < 0]


def _signs(statics: Statics, unknowns: Mapping[str, float]) -> tuple[dict[str, int], dict[str, int]]:
    """Of each contact whether it pushes (1) or would have to pull (-1) without friction, and of those that
    share a load: they pull where they can in no way share it so that all push."""
    parameters, free = statics.parameters(unknowns), set(statics.general.free)
    found, shared = dict[str, int](), dict[str, Row]()
    for tie, column in zip(statics.ties, statics.first, strict=True):
        if tie.joint.only_pushes:
            row, name = statics.general.of(column), f"of links {tie.by} and {tie.on}{place_of(tie)}"
            value, terms = value_of(row, parameters), [a * parameters.get(c, 0.0) for c, a in row.items()]
            least = ROUNDED * largest_of(terms)
            if row.keys() & free:
                shared[name] = row
            else:
                found[name] = (value > least) - (value < -least)
    push = can_share(statics, parameters, list(shared.values()), FLOATS)
    return found, dict.fromkeys(shared, 1 if push else -1)
