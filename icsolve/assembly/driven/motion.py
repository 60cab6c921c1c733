"""A mechanism in motion on a record: its steps run in order, each place an expression of the drivers."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from icsolve.assembly.driven.constraints import (
    ConditionRows,
    Constraint,
    Immovable,
    Pointed,
    Roped,
    Spinning,
    Turning,
    spun,
)
from icsolve.assembly.driven.groups import NewtonGroup, settled, smallest
from icsolve.assembly.driven.mechanism import Mechanism
from icsolve.assembly.driven.order import (
    TOUCHING,
    AssemblyOrder,
    AssemblyStep,
    AssurGroup,
    By,
    Closing,
    PlaceAtIntersection,
    PlaceByPoint,
    PlaceByTwoPoints,
    RotateToLine,
    RotateWith,
    Through,
    ThroughTurned,
    locus,
    reference,
    rotation_to_line,
)
from icsolve.assembly.driven.poses import Arm, Moved, Rotation, Spot, dot, minus, rotated, square
from icsolve.assembly.loci import PlacedCircle, PlacedLocus, crossing_sine, intersection, side
from icsolve.assembly.workspace import Workspace
from icsolve.numbers import Scalar
from icsolve.numbers.record import Traced, varies
from icsolve.screws import Point, Triple, velocity
from icsolve.tuples import NamedTuple


class DrivenMotion(NamedTuple):
    """A mechanism whose places are expressions on a record.

    Attributes
    ----------
    moved : places and rotations of the bodies
    steps : the steps of its assembly in their order
    branches : for each root of the record the name by which its sign is set
    written : by that name, the sign in the position as written
    groups : those that Newton's method solves row by row
    checks : nodes that vanish where the conditions that were not needed to place the links are met
    driver : the first of what drives it, as a condition
    """

    mechanism: Mechanism
    moved: Moved
    steps: tuple[AssemblyStep, ...]
    branches: dict[int, str]
    written: dict[str, float]
    groups: tuple[NewtonGroup, ...]
    checks: tuple[int, ...]
    """what the conditions leave that were not needed: it is to vanish"""
    margins: tuple[int, ...]
    """what ropes leave for their last parts [frame]: it is not to be negative"""
    driver: Constraint


def closing_of(mechanism: Mechanism, drivers: list[Constraint], known: Closing | None = None) -> Closing:
    """How the mechanism closes; as is known, if it is, of the same drivers and conditions.

    Raises SceneError where a joint cannot be moved, links stay loose, or the position as written is singular.
    """
    constraints = [*drivers, *mechanism.constraints]
    if known is not None:
        return _again(known, constraints)
    for constraint in constraints:
        if isinstance(constraint, Immovable):
            raise constraint.refusal
    order = AssemblyOrder(mechanism.shape, mechanism.spots, constraints, near_of(mechanism))
    while True:
        while order.advance():
            pass
        left = tuple(body for body in mechanism.spots if body not in order.full)
        if not left:
            return order.closing
        order.take(smallest(mechanism, order, left))


def near_of(mechanism: Mechanism) -> dict[str, Point]:
    """Where `near` has points [frame]."""
    ox, oy, scale = mechanism.frame
    return {name: ((x - ox) * scale, (y - oy) * scale) for name, (x, y) in mechanism.case.near.items()}


def _again(closing: Closing, constraints: list[Constraint]) -> Closing:
    """The same steps of the same mechanism on other conditions of the same kinds, in the same order."""
    now: dict[int, Any] = {id(was): c for was, c in zip(closing.constraints, constraints, strict=True)}

    def met(by: By) -> By:
        return by._replace(by=now[id(by.by)]) if isinstance(by, ThroughTurned) else by

    def renewed(step: AssemblyStep) -> AssemblyStep:
        match step:
            case RotateWith(_, by, instead):
                return step._replace(by=now.get(id(by), by), instead=now.get(id(instead)))
            case PlaceAtIntersection(_, (one, two)):
                return step._replace(loci=(met(one), met(two)))
            case RotateToLine():
                return step._replace(by=now[id(step.by)])
            case AssurGroup():
                return step._replace(constraints=tuple([now[id(c)] for c in step.constraints]))
        return step

    used = {id(now[k]) for k in closing.used if k in now}
    return Closing(tuple([renewed(step) for step in closing.steps]), constraints, used)


def set_moving(mechanism: Mechanism, closing: Closing, signs: Mapping[str, Scalar]) -> DrivenMotion:
    """Run the steps; ``signs`` has those of branches that change on the way, by name."""
    run = _Placing(mechanism, signs)
    for step in closing.steps:
        run.take(step)
    return DrivenMotion(
        mechanism,
        run.moved,
        closing.steps,
        run.branches,
        run.written,
        tuple(run.groups),
        tuple(run.checked(c for c in closing.constraints if id(c) not in closing.used)),
        tuple(left.index for left in run.left if varies(left)),
        closing.constraints[0],
    )


def pace(
    mechanism: Mechanism, rows: ConditionRows, driver: Constraint, twists: Mapping[str, tuple[Triple, ...]]
) -> Scalar:
    """How fast what a driver asks changes in the one motion of the links, where ``rows`` has their places."""
    total: Scalar = 0.0
    for (body, part), share in rows.of(driver).by.items():
        twist = twists[mechanism.top.members[body][0]][0]
        base = rows.places.place(rows.bases[body])
        total = total + share * (*velocity(twist, base), twist[2])[part]
    return total


class _Placing:
    """The steps on a record."""

    def __init__(self, mechanism: Mechanism, signs: Mapping[str, Scalar]) -> None:
        self.mechanism, self.shape, self.signs = mechanism, mechanism.shape, signs
        self.record = mechanism.shape.record
        self.moved = Moved(self.shape)
        self.branches: dict[int, str] = {}
        self.written: dict[str, float] = {}
        self.groups: list[NewtonGroup] = []
        self.spare: list[Scalar] = []
        self.spanned: set[frozenset[Spot]] = set()
        """pairs of a body's spots of which one was placed at its distance from the other"""
        self.left: list[Scalar] = []
        ground = self.shape.ground
        self._locate((ground, name) for _, name in mechanism.spots[ground])

    def _locate(self, spots: Iterable[Spot]) -> None:
        """Spots on one pin with a body that is placed are where that has them."""
        for spot in spots:
            self.moved.located.setdefault(self.shape.one(spot), self.moved.place(spot))

    def take(self, step: AssemblyStep) -> None:
        """Run one step."""
        match step:
            case RotateWith(body, by):
                self.moved.rotations[body] = self._rotation(body, by)
            case PlaceByPoint(body, spot):
                self._placed(body, spot, (spot,))
            case PlaceByTwoPoints(body, (p, q)):
                z = minus(self.moved.place(q), self.moved.place(p))
                self.moved.rotations[body] = Rotation(z, Arm(p, q))
                if frozenset((p, q)) not in self.spanned:
                    self.spare.append(dot(z, z) - self.shape.span(p, q) * self.shape.span(p, q))
                self._placed(body, p, (p, q))
            case PlaceAtIntersection():
                self._meet(step)
            case RotateToLine():
                self._rotate_to_line(step)
            case AssurGroup():
                self._newton(step)

    def _placed(self, body: int, base: Spot, used: tuple[Spot, ...]) -> None:
        """A body is placed by spots; its other pins are, too, or have to agree with where they are."""
        moved, shape = self.moved, self.shape
        moved.bases[body] = base
        for spot in self.mechanism.spots[body]:
            if spot not in shape.joined:
                continue
            known = moved.located.get(shape.one(spot))
            if known is None:
                self._locate((spot,))
            elif spot not in used:
                self.spare += minus(moved.point(body, shape.ref[spot[1]]), known)

    def checked(self, left: Iterable[Constraint]) -> Iterator[int]:
        """Nodes that vanish where the conditions that were not needed are met."""
        workspace = Workspace(self.mechanism.case, self.mechanism.frame, self.record)
        rows = ConditionRows(self.shape, self.moved, {}, workspace)
        for value in (*self.spare, *(rows.of(c).value for c in left)):
            if isinstance(value, Traced) and value.row:
                yield value.index

    # --- rotations --------------------------------------------------------------------------------

    def _rotation(self, body: int, by: Spinning | Pointed) -> Rotation:
        """That of a driver, of a body that turns alike, or what a sum of angles leaves to a body."""
        if isinstance(by, Pointed):
            return by.rotation(self.record)
        if isinstance(by, Turning) and by.alike:
            (other,) = (other for other, _ in by.terms if other != body)
            return self.moved.rotations[other]._replace(unit=None)
        first, *more = (factor for other, factor in by.terms if other == body)
        rest = by.rest(self.shape, self.moved, self.record.turns) + spun(by.terms, self.moved, but=body)
        return rotated(self.shape, -rest / sum(more, first))

    # --- closed forms -----------------------------------------------------------------------------

    def _meet(self, step: PlaceAtIntersection) -> None:
        one, two = (locus(self.shape, self.moved, by) for by in step.loci)
        self.spanned.update(frozenset((by.spot, by.pivot)) for by in step.loci if isinstance(by, Through))
        for by, there in zip(step.loci, (one, two), strict=True):
            if isinstance(by, ThroughTurned) and isinstance(by.by, Roped):
                assert isinstance(there, PlacedCircle)
                self.left.append(there.radius)
        first, second = (reference(self.shape, by) for by in step.loci)
        written = side(first, second, self._written(step.spot[1], first, second))
        name = f"branch {step.spot[0]} {step.spot[1]}"
        found = intersection(one, two)
        place = found.middle
        if found.factors is not None:
            place = found.at(self.signs.get(name, written) * self.record.root(*found.factors))
        self._branch(name, written)
        self.moved.located[self.shape.one(step.spot)] = place

    def _written(self, name: str, first: PlacedLocus, second: PlacedLocus) -> Point:
        """Where a spot is as written; where its loci only touch there, where `near` would have it."""
        at = self.shape.still[name]
        touches = crossing_sine(first, second, at) <= TOUCHING
        return near_of(self.mechanism).get(name, at) if touches else at

    def _rotate_to_line(self, step: RotateToLine) -> None:
        line, c, moved = step.by.line, step.by, self.moved
        name = f"swing {step.bodies[0]} {c.spot[1]}"
        e = minus(moved.place(step.aim), moved.place(step.pivot))
        normal = square(line.along)
        h = c.offset + dot(normal, minus(line.through, self.shape.ref[step.pivot[1]]))
        if len(step.bodies) > 1:
            h = h - dot(normal, minus(self.shape.ref[c.spot[1]], self.shape.ref[step.aim[1]]))
        written = minus(self.shape.still[step.aim[1]], self.shape.still[step.pivot[1]])
        sign = 1.0 if float(dot(line.along, written)) >= 0.0 else -1.0
        rotation = Rotation(rotation_to_line(self.record, e, line.along, h, self.signs.get(name, sign)))
        self._branch(name, sign)
        for body in step.bodies:
            moved.rotations[body] = rotation

    def _branch(self, name: str, written: float) -> None:
        """The roots that were new belong to the branch of this name."""
        self.written[name] = written
        for node in self.record.roots:
            self.branches.setdefault(node, name)

    def _newton(self, step: AssurGroup) -> None:
        group = settled(self.mechanism, self.moved, step, len(self.groups))
        self.groups.append(group)
        for body, rotation in group.rotations.items():
            self.moved.rotations[body] = rotation
            base = group.bases[body]
            self.moved.bases[body] = base
            self.moved.located.setdefault(self.shape.one(base), group.places[body])
        for body in step.bodies:
            self._placed(body, group.bases[body], tuple(self.mechanism.spots[body]))
