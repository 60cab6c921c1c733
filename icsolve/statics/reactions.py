"""The force of each link on each other at every joint, in case units, under the names of the format.

Sentences about reactions that a reader should know: what is not unique, and contacts that would part.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from icsolve.answer.bodies import Reaction, Reactions, Tension, names_of
from icsolve.case import Case, Rope, is_link, ordered_pair
from icsolve.case.joints import Mesh, Sliding
from icsolve.errors import SceneError, Status, refuse_overflow
from icsolve.numbers import Scalar, Showing, all_vanish, largest_of, size_of, zero_of
from icsolve.numbers.linear import Row
from icsolve.screws import velocity
from icsolve.statics.equilibrium import Equilibrium, Statics, T, Transmits, value_of
from icsolve.statics.reaction_basis import Position, Tie, axial_shares, tangent_and_separating
from icsolve.tuples import LateModule
from icsolve.wording import listed, plural

if TYPE_CHECKING:
    from icsolve.numbers import inequalities
else:  # where several joints share what presses them
    inequalities = LateModule("icsolve.numbers.inequalities")


def reactions_of(
    position: Position, statics: Statics, parameters: Mapping[int, Scalar], a: Showing
) -> Reactions:
    """Every joint's reaction, by the names of the format (``F34``, ``F3-4@B``).

    Parameters
    ----------
    statics : the general solution
    parameters : by column, the known loads, the unknown ones and the friction [scaled]
    a : arithmetic of all of it

    Returns
    -------
    Reactions
        Forces in case force units, couples in case torque units; what equilibrium does not determine is None.
    """
    combined = [statics.transmitted(t) for t in range(len(statics.ties))]
    sizes = statics.open_sizes()
    values = [tuple(value_of(row, parameters) for row in rows) for rows in combined]
    zero = _zeros(values, a)
    names = names_by_tie(position.case, statics.ties)
    found = Reactions()
    for tie, rows, forces, name in zip(statics.ties, combined, values, names, strict=True):
        if not is_link(tie.on):  # the free end of a rope, which is no link
            continue
        unique = [statics.determines(row, sizes) for row in rows]
        kept = [zero(f, n) if u else None for n, (f, u) in enumerate(zip(forces, unique, strict=True))]
        parts = _parts(position, tie, kept, a)
        if isinstance(tie.joint, Mesh) and tie.joint.pulls and tie.pivots:
            parts = [("net pull", _net_pull(position, tie.joint, tie, forces, a))]
        shares = tuple(
            (n, a.rounded(share if n in DEGREES else share / statics.scale)[0]) for n, share in parts
        )
        own = found[name] = _reaction(position, tie, kept, statics.scale, a)._replace(parts=shares)
        refuse_overflow(name, own.x, own.y, own.moment, own.magnitude, *dict(shares).values())
    return found


DEGREES = ("pressure angle",)
"""Parts of a reaction that are no forces."""


def tensions_of(
    statics: Statics, parameters: Mapping[int, Scalar], a: Showing, unit: str
) -> tuple[Tension, ...]:
    """The pull of every rope [``unit``]; None, with the reason, where equilibrium does not determine it.

    Raises
    ------
    SceneError
        ``slack`` where one would have to push.
    """
    sizes = statics.open_sizes()
    largest = largest_of([statics.value(c, parameters) for c in range(statics.known)])
    found = []
    pulls = [statics.general.of(statics.tension(n)) for n in range(len(statics.ropes))]
    if not can_share(statics, parameters, pulls, a):
        ropes = zip(statics.ropes, pulls, strict=True)
        raise SceneError(
            Status.SLACK, _slack_of([t.rope.name for t, row in ropes if not statics.determines(row, sizes)])
        )
    for n, tie in enumerate(statics.ropes):
        row = pulls[n]
        if not statics.determines(row, sizes):
            found.append(Tension(tie.rope.name, None, why=SHARED))
            continue
        value = value_of(row, parameters)
        value = zero_of(value) if a.vanishes(value, largest) else value
        pull, error = a.rounded(value / statics.scale)
        if pull < 0.0:
            raise SceneError(Status.SLACK, _slack(tie.rope, pull, unit))
        slips = any(mu is not None for mu in tie.rope.mu)
        parts = tuple(a.rounded(value * r / statics.scale)[0] for r in tie.ratios) if slips else ()
        found.append(Tension(tie.rope.name, pull, parts, error=error if math.isfinite(error) else None))
    return tuple(found)


def can_share(statics: Statics, parameters: Mapping[int, Scalar], rows: Sequence[Row], a: Showing) -> bool:
    """Whether what equilibrium leaves open can be such that none of these combinations that hang on it is
    less than zero."""
    sizes = statics.open_sizes()
    largest = largest_of([statics.value(c, parameters) for c in range(statics.known)])
    forms = []
    for row in rows:
        shares = [0.0 if statics.determines(row, {c: size}) else float(row[c]) for c, size in sizes.items()]
        if any(shares):
            value = value_of(row, parameters)
            form = (0.0 if a.vanishes(value, largest) else float(value), *shares)
            forms.append(tuple([part / largest_of(form) for part in form]))
    return not forms or inequalities.deepest(forms).depth >= -inequalities.NOTHING


SHARED = "the joints share the load in a way that equilibrium alone does not determine"


def _slack(rope: Rope, value: float, unit: str) -> str:
    return (
        f"the rope {rope.name} would have to push ({-value:.6g} {unit}): it goes slack, and the links do "
        "not hold so. Turn the load round that pulls it, see that the rope names its points and links in the "
        "order in which it runs past them, or put a link in its place."
    )


def _slack_of(names: Sequence[str]) -> str:
    return (
        f"however the ropes {listed(names)} share the load, one of them would have to push: they go slack, "
        "and the links do not hold so. Turn the load round that pulls them, see that each rope names its "
        "points and links in the order in which it runs past them, or put a link in the place of one."
    )


def _net_pull(position: Position, belt: Mesh, tie: Tie, force: tuple[Scalar, ...], a: Showing) -> Scalar:
    """What the tight strand pulls more than the slack one: the torque on the second pulley over its radius.

    The part of the force that is left open lies along the line of the pivots and makes no torque.
    """
    (_, _), (px, py) = (position.points[p] for p in tie.pivots)
    torque = force[2] + (tie.at[0] - px) * force[1] - (tie.at[1] - py) * force[0]
    return size_of(torque / (a.given(belt.sizes[1]) * position.scale))


def names_by_tie(case: Case, ties: Sequence[Transmits]) -> list[str]:
    """``F34``, ``F3-14``, ``Fcrank-rod``; with the place where a pair has several joints: ``F3-4@B``."""
    pairs = [ordered_pair(case, tie.by, tie.on) for tie in ties]
    shared = Counter(pairs)
    names: list[str] = []
    counts: Counter[str] = Counter()
    for tie, (by, on) in zip(ties, pairs, strict=True):
        options = names_of(by, on, tie.where or tie.joint_kind)
        name = options[0] if shared[by, on] == 1 else options[-1]
        counts[name] += 1
        names.append(name if counts[name] == 1 else f"{name} {tie.joint_kind} {counts[name]}")
    return names


def _zeros(values: Sequence[tuple[Scalar, ...]], a: Showing) -> Callable[[Scalar, int], Scalar]:
    """What makes a force, or a couple (2), that is nothing beside the largest of all a zero."""
    force = largest_of([v for three in values for v in three[:2]])
    sizes = (force, force, max(force, largest_of([three[2] for three in values])))
    return lambda value, n: zero_of(value) if a.vanishes(value, sizes[n]) else value


def _reaction(position: Position, tie: Tie, kept: list[Scalar | None], scale: float, a: Showing) -> Reaction:
    """The numbers of a reaction, each rounded once."""
    case, frame = position.case, position.frame
    ordered = ordered_pair(case, tie.by, tie.on) == (tie.by, tie.on)
    own = [None if f is None else f if ordered else 0.0 - f for f in kept]
    x, y, couple = (None if f is None else f / scale for f in own)
    if couple is not None:
        couple = couple / frame.scale * a.ratio(case.units.exact_torque)
    (px, _), (py, _) = (
        a.rounded(p / frame.scale + o, 1.0 / frame.scale + abs(o))
        for p, o in zip(tie.at, frame, strict=False)
    )
    exact = {"x": x, "y": y, "moment": couple, **_polar(own[0], own[1], scale, a)}
    both = {name: a.rounded(value) for name, value in exact.items() if value is not None}
    shown = {name: value for name, (value, _) in both.items()}
    errors = {name: error for name, (_, error) in both.items() if math.isfinite(error) and name != "opposite"}
    toward, back = (shown[n] % 360.0 if n in shown else None for n in ("direction", "opposite"))
    by, on = (tie.by, tie.on) if ordered else (tie.on, tie.by)
    force = (shown.get("x"), shown.get("y"), shown.get("moment"), _why(tie, kept))
    size = shown.get("magnitude")
    return Reaction(by, on, tie.kind, tie.where, (px, py), *force, (), size, toward, back, errors)


def _polar(x: Scalar | None, y: Scalar | None, scale: float, a: Showing) -> dict[str, Scalar | None]:
    """Size [over ``scale``] and direction of a force, whose squares doubles hold, and the direction of its
    opposite, from 0 to 360 degrees."""
    found: dict[str, Scalar | None] = dict.fromkeys(("magnitude", "direction", "opposite"))
    if x is None or y is None:
        return found
    if float(x) == float(y) == 0.0:
        return {**found, "magnitude": (x if isinstance(y, float) else y) / scale}
    toward = a.angle(x, y)
    return {
        "magnitude": a.sqrt(x * x + y * y) / scale,
        "direction": toward if float(toward) >= 0.0 else toward + 360.0,
        "opposite": toward + 180.0,
    }


def _parts(
    position: Position, tie: Tie, kept: Sequence[Scalar | None], a: Showing
) -> list[tuple[str, Scalar]]:
    """Shares of a force in the directions that the joint is about."""
    x, y, _ = kept
    if x is None or y is None:
        return []
    if tie.joint.pressure_angle is not None or (isinstance(tie.joint, Mesh) and not tie.joint.pulls):
        (tx, ty), (sx, sy) = tangent_and_separating(position, tie)
        tangential = size_of(x * tx + y * ty)
        shares = [("tangential", tangential), ("separating", x * sx + y * sy)]
        return [*shares, *axial_shares(position, tie, tangential)]
    if isinstance(tie.joint, Sliding):
        nx, ny = next((u[0], u[1]) for u in tie.units if not u[2])
        normal = x * nx + y * ny
        parts = [("normal", normal if tie.joint.only_pushes else size_of(normal))]
        parts += [("friction", size_of(x * ny - y * nx))] if tie.joint.friction else []
        angle = pressure_angle(position, tie, a) if tie.joint.only_pushes else None
        return [*parts, (DEGREES[0], angle)] if angle is not None else parts
    return []


def pressure_angle(position: Position, tie: Tie, a: Showing) -> Scalar | None:
    """Degrees between the normal of a contact and the velocity of its second link there.

    None where that link is at rest there, or has more than one motion.
    """
    motions = [
        velocity(position.relative(position.case.ground, tie.on, m), tie.at) for m in range(position.mobility)
    ]
    fastest = largest_of([x for ts in position.twists.values() for t in ts for x in t])
    moving = [v for v in motions if not all_vanish(a, ((part, fastest) for part in v))]
    if not moving:
        return None
    (u, v), (nx, ny) = moving[0], tie.units[0][:2]
    if not all(a.vanishes(u * y - v * x, fastest * fastest) for x, y in moving[1:]):
        return None
    return a.angle(size_of(u * nx + v * ny), size_of(u * ny - v * nx))


def _why(tie: Tie, kept: list[Scalar | None]) -> str:
    if None not in kept:
        boxed = tie.joint.stands_in
        return "a given centre stands for joints that the case does not show" if boxed else ""
    if not isinstance(tie.joint, Mesh):
        return SHARED
    if not tie.pivots:
        return "its links are fixed to each other: what it carries hangs on how it was fitted"
    if tie.joint.pulls:
        return "the pull of the slack strand is not given: only the difference of the two pulls is determined"
    if tie.joint.pressure_angle is None:
        return "the part that pushes the gears apart needs `pressure angle`"
    return SHARED


def notes_of(
    statics: Statics,
    reactions: Reactions,
    names: Sequence[str],
    parameters: Mapping[int, Scalar],
    a: Showing,
) -> tuple[str, ...]:
    """All sentences, in the order of the joints; without reactions those that need none."""
    if not reactions:
        return tuple(_black_boxes(statics.ties))
    ties = [tie for tie in statics.ties if is_link(tie.on)]
    names = [name for name in names if name in reactions]
    shown = [reactions[name] for name in names]
    both = zip(ties, shown, strict=True)
    touching = [sentence for tie, reaction in both for sentence in _touching(tie, reaction)]
    touching += _lost_together(statics, parameters, a)
    said = _open_parts(dict(zip(names, shown, strict=True)))
    open_ = [left_open(statics, said, _remedy(statics.ties))] if said else []
    return (*open_, *touching, *_black_boxes(statics.ties))


def left_open(statics: Equilibrium[T], said: Iterable[str], remedy: str) -> str:
    """The sentence on reactions that equilibrium does not determine."""
    parts = plural(len(statics.general.free), "part")
    return f"equilibrium leaves {parts} of the reactions open; not determined: {', '.join(said)}. {remedy}"


def _open_parts(shown: Mapping[str, Reaction]) -> list[str]:
    """The forces that are open, those of which only one component is, and further couples."""
    kinds: dict[tuple[bool, bool], list[str]] = {}
    for name, r in shown.items():
        kinds.setdefault((r.x is None, r.y is None), []).append(name)
    ends = {(True, True): "", (True, False): " along x", (False, True): " along y"}
    said = [f"{listed(kinds[kind])}{end}" for kind, end in ends.items() if kind in kinds]
    whole = kinds.get((True, True), [])
    couples = [name for name, r in shown.items() if r.moment is None and name not in whole]
    return [*said, f"the couples of {listed(couples)}"] if couples else said


def _remedy(ties: Sequence[Tie]) -> str:
    meshed = [tie.joint for tie in ties if tie.pivots]
    if any(not joint.pulls and joint.pressure_angle is None for joint in meshed):
        return "Give the gears their `pressure angle` for the loads on their bearings."
    if any(joint.pulls for joint in meshed):
        return (
            "The bearing loads depend on the belt's initial tension: in place of the belt put its two pulls "
            "on the pulleys as loads."
        )
    return REDUNDANT


REDUNDANT = "The joints are redundant: how they share the load depends on their fit and stiffness."


def _touching(tie: Tie, reaction: Reaction) -> Iterable[str]:
    """A contact that would have to pull."""
    if not tie.joint.only_pushes:
        return
    force = dict(reaction.parts).get("normal")
    place = f"the contact of links {tie.by} and {tie.on}" + (f" at {tie.where}" if tie.where else "")
    if force is not None and force < 0.0:
        yield f"{place} is lost: its normal force would have to pull ({force:.6g}). The links part there."


def _lost_together(statics: Statics, parameters: Mapping[int, Scalar], a: Showing) -> Iterable[str]:
    """Contacts of which one would have to pull however they, and the ropes, share the load."""
    sizes = statics.open_sizes()
    firsts = zip(statics.ties, statics.first, strict=True)
    normals = [(tie, statics.general.of(first)) for tie, first in firsts if tie.joint.only_pushes]
    pulls = [statics.general.of(statics.tension(n)) for n in range(len(statics.ropes))]
    if can_share(statics, parameters, [*(row for _, row in normals), *pulls], a):
        return
    open_ones = [tie for tie, row in normals if not statics.determines(row, sizes)]
    places = listed(f"{tie.by} and {tie.on}" + (f" at {tie.where}" if tie.where else "") for tie in open_ones)
    yield (
        f"however the contacts of links {places} share the load, the normal force of one would have to pull: "
        "it is lost, and the links part there."
    )


def _black_boxes(ties: Sequence[Tie]) -> Iterable[str]:
    pairs = [f"{tie.by}-{tie.on}" for tie in ties if tie.joint.stands_in]
    if pairs:
        yield (
            f"the force at a given centre ({listed(pairs)}) is what a pin there would carry: it stands for "
            "joints that the case does not show."
        )
