"""A group of links that Newton's method places: the smallest that only all its conditions determine.

The equations and their derivatives are expressions of a guess; what solves them enters the record as
inputs of their own, on which all that follows hangs.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

import numpy as np
import numpy.typing as npt

from icsolve.assembly.driven.constraints import ConditionRow, ConditionRows, Constraint
from icsolve.assembly.driven.mechanism import Mechanism
from icsolve.assembly.driven.order import AssemblyOrder, AssurGroup, touching
from icsolve.assembly.driven.poses import Moved, Places, Rotation, Spot, plus, rotated
from icsolve.assembly.workspace import Workspace
from icsolve.errors import SceneError, Status
from icsolve.numbers import FLOATS, RADIAN, Scalar
from icsolve.numbers.linear import Row, eliminate
from icsolve.numbers.record import Implicit, Op, Record, Traced
from icsolve.numbers.replay import BLOCK, Array, Code
from icsolve.screws import Point
from icsolve.structure.plan import determined, matched
from icsolve.tuples import NamedTuple, cached_property
from icsolve.wording import listed

DEPENDENT = 1e-10
"""What is left of an equation below this fraction of its terms is zero (normalised frame)."""


def bases_of(mechanism: Mechanism, bodies: Iterable[int]) -> dict[int, Spot]:
    """For each body the spot that its place is told by: a pin where it has one."""
    pins = mechanism.shape.joined
    return {
        body: next((spot for spot in mechanism.spots[body] if spot in pins), mechanism.spots[body][0])
        for body in bodies
    }


def equations(
    mechanism: Mechanism,
    rows: ConditionRows,
    constraints: Iterable[Constraint],
    known: Moved | None = None,
) -> Iterator[ConditionRow]:
    """The equations of the bodies of ``rows``: their conditions and their pins.

    ``known`` has the spots that are located; without it the other bodies stand as written.
    """
    for c in constraints:
        yield rows.of(c)
    for one, spots in pins_of(mechanism).items():
        own = [spot for spot in spots if spot[0] in rows.bases]
        fixed = _fixed(one, spots, rows, known)
        first = own[:1] if fixed is None else []
        for spot in own[len(first) :]:
            yield from rows.pinned(spot, first[0]) if fixed is None else rows.held(spot, fixed)


def pins_of(mechanism: Mechanism) -> dict[Spot, list[Spot]]:
    """By the spot that stands for a pin, the spots of all its bodies."""
    found: dict[Spot, list[Spot]] = {}
    for spot, one in mechanism.shape.joined.items():
        found.setdefault(one, []).append(spot)
    return found


def _fixed(one: Spot, spots: list[Spot], rows: ConditionRows, known: Moved | None) -> Point | None:
    """Where a pin is known to be."""
    if known is not None:
        return known.located.get(one)
    others = [spot for spot in spots if spot[0] not in rows.bases]
    return rows.places.place(others[0]) if others else None


def jacobian(mechanism: Mechanism, bodies: Sequence[int], constraints: Iterable[Constraint]) -> list[Row]:
    """Derivatives of all equations of some bodies in the position as written, the others held.

    Returns
    -------
    list of Row
        One an equation, by column: a body has the three x, y of its base [frame] and its angle [rad].
    """
    rows = as_written(mechanism, bodies)
    return [derivatives(bodies, row) for row in equations(mechanism, rows, constraints)]


def as_written(mechanism: Mechanism, bodies: Sequence[int]) -> ConditionRows:
    """The conditions of some bodies where they are written, in doubles."""
    workspace = Workspace(mechanism.case, mechanism.frame, FLOATS)
    return ConditionRows(mechanism.shape, Places(mechanism.shape), bases_of(mechanism, bodies), workspace)


def derivatives(bodies: Sequence[int], row: ConditionRow) -> Row:
    """The derivatives of an equation by the three parts (x, y, angle) of each body, by column."""
    first = {body: 3 * n for n, body in enumerate(bodies)}
    return {first[body] + part: float(value) for (body, part), value in row.by.items() if body in first}


def smallest(mechanism: Mechanism, order: AssemblyOrder, left: Sequence[int]) -> AssurGroup:
    """The smallest set of the bodies that are left whose conditions determine it, as a count of these tells;
    where what they say is less than that, all that are left.

    Raises SceneError where no set is determined.
    """
    rows = list(_ties(mechanism, order, {*left}))
    held: dict[int, list[int]] = {body: [] for body in left}
    for n in range(len(rows)):
        matched(n, rows.__getitem__, held, 3)
    parts = (part.bodies for part in determined(held, rows.__getitem__, 3) if not part.others)
    for bodies in (*sorted(parts, key=len), left):
        group = _group(mechanism, order, sorted(bodies))
        if group is not None:
            return group
    raise _refusal(mechanism, order, left)


def _ties(mechanism: Mechanism, order: AssemblyOrder, left: set[int]) -> Iterator[Collection[int]]:
    """Of every equation of the bodies that are left, those that it binds: of a pin two."""
    yield from (bound for c in order.constraints if (bound := order.ties[id(c)] & left))
    for one, spots in pins_of(mechanism).items():
        own = [body for body, _ in spots if body in left]
        first, others = ([], own) if one in order.located else (own[:1], own[1:])
        yield from ({*first, body} for body in others for _ in "xy")


def _group(mechanism: Mechanism, order: AssemblyOrder, bodies: Sequence[int]) -> AssurGroup | None:
    reach = {*bodies, *order.full}
    constraints = tuple(
        c for c in order.constraints if order.ties[id(c)] <= reach and order.ties[id(c)] & set(bodies)
    )
    rows = equations(mechanism, as_written(mechanism, bodies), constraints, _held(mechanism, order))
    found = eliminate([derivatives(bodies, row) for row in rows], 3 * len(bodies), DEPENDENT)
    return AssurGroup(tuple(bodies), constraints) if not found.free else None


def _held(mechanism: Mechanism, order: AssemblyOrder) -> Moved:
    """The spots that are located, as written."""
    moved = Moved(mechanism.shape)
    for one in order.located:
        moved.located[one] = mechanism.shape.still[one[1]]
    return moved


def _refusal(mechanism: Mechanism, order: AssemblyOrder, left: Sequence[int]) -> SceneError:
    names = [mechanism.top.members[body][0] for body in left]
    plural = "link" if len(names) == 1 else "links"
    if order.nearest is not None:
        return touching(order.nearest)
    return SceneError(
        Status.MOBILITY,
        f"nothing drives {plural} {listed(names)}: the mechanism has more freedoms than numbers that move "
        "it. Vary another angle or length too, or turn another link.",
    )


# --- a group of links that Newton's method places: its equations on a record, and their solution on rows ---


LIMIT_AS_WRITTEN = (
    "the position as written is a limit: the mechanism assembles there, but not beside it. Write the case in "
    "another position."
)
ROUNDS = 25
CLOSE = 1e-9
"""A step that is smaller (normalised, radians) leaves an error below rounding."""
MANY = 256
"""Rows from which one elimination for all of them pays."""
SOLVED = 1e-11
"""The largest residual of a solution (normalised)."""


class Guess(Moved):
    """The bodies of a group where they are supposed to be, wherever that puts their pins, and the others."""

    def __init__(self, moved: Moved, bases: Mapping[int, Spot], q: Mapping[int, tuple[Scalar, ...]]) -> None:
        super().__init__(moved.shape)
        self.located, self.free = moved.located, q
        self.bases = {**moved.bases, **bases}
        self.rotations = {
            **moved.rotations,
            **{body: rotated(moved.shape, state[2]) for body, state in q.items()},
        }

    def place(self, spot: Spot) -> Point:
        """Where a body's point is."""
        body = spot[0]
        if body not in self.free:
            return super().place(spot)
        x, y, _ = self.free[body]
        return plus((x, y), self.vector(body, self.shape.between(self.bases[body], spot)))


class NewtonGroup(NamedTuple):
    """A group on the record: three numbers a body (x, y of its base [frame], degrees).

    Attributes
    ----------
    bodies : n of them
    equations : of 3 n numbers, their derivatives by x and y and by the angle in radians
    bases : by body, the spot whose place is told
    rotations, places : by body, expressions of ``solved``
    """

    bodies: tuple[int, ...]
    equations: Implicit
    bases: dict[int, Spot]
    rotations: dict[int, Rotation]
    places: dict[int, Point]


def settled(mechanism: Mechanism, moved: Moved, step: AssurGroup, number: int) -> NewtonGroup:
    """Write the equations of a group, and solve them in the position in which the record is made."""
    record = mechanism.shape.record
    bases = bases_of(mechanism, step.bodies)
    start = [x for body in step.bodies for x in (*mechanism.shape.still[bases[body][1]], 0.0)]
    guessed = [record.input(f"guess {number} {k}", x) for k, x in enumerate(start)]
    q = dict(zip(step.bodies, _threes(guessed), strict=True))
    workspace = Workspace(mechanism.case, mechanism.frame, record)
    conditions = ConditionRows(mechanism.shape, Guess(moved, bases, q), bases, workspace)
    rows = list(equations(mechanism, conditions, step.constraints, moved))
    columns = [(body, part) for body in step.bodies for part in range(3)]
    system = Implicit(
        tuple(g.index for g in guessed),
        (),
        tuple(row.value for row in rows),
        tuple(tuple(row.by.get(column, 0.0) for column in columns) for row in rows),
    )
    values = _at_record(record, system)
    solved = [record.input(f"state {number} {k}", float(v)) for k, v in enumerate(values)]
    states = dict(zip(step.bodies, _threes(solved), strict=True))
    system = system._replace(solved=tuple(s.index for s in solved))
    record.implicit.append(system)
    return NewtonGroup(
        step.bodies,
        system,
        bases,
        {b: rotated(mechanism.shape, s[2]) for b, s in states.items()},
        {b: (s[0], s[1]) for b, s in states.items()},
    )


def _threes(values: Sequence[Scalar]) -> Iterator[tuple[Scalar, Scalar, Scalar]]:
    """Place and turning (x, y, angle) of body after body."""
    return zip(values[::3], values[1::3], values[2::3], strict=True)


def _at_record(record: Record, equations: Implicit) -> Array:
    """The solution at the values that the record was made with.

    Raises SceneError where there is none: in the position as written, which has one, what is zero by chance
    would be taken as zero in every row.
    """
    solver = Solver(record, equations)
    env = {k: np.array([node.value]) for k, node in enumerate(record.nodes) if node.op == Op.INPUT}
    start = np.array([[record.nodes[k].value for k in equations.guesses]])
    q, good = solver.solve(env, start)
    if not good[0]:
        raise SceneError(Status.CHANGE_POINT, LIMIT_AS_WRITTEN)
    found: Array = q[0]
    return found


class Solver:
    """Newton's method on rows of a group; n is the number of unknowns, three a body."""

    def __init__(self, record: Record, system: Implicit) -> None:
        self.record, self.implicit = record, system
        flat = [value for row in system.derivatives for value in row]
        self.traced = [n for n, value in enumerate(flat) if isinstance(value, Traced)]
        self.still = np.array([0.0 if isinstance(v, Traced) else float(v) for v in flat])
        wanted = [record.lifted(value).index for value in system.residuals]
        self.equations = len(wanted)
        self.code = Code(record, [*wanted, *(flat[n].index for n in self.traced)])
        self.misses = Code(record, wanted)

    def system(self, env: Mapping[int, Array], q: Array, derivatives: bool = True) -> tuple[Array, Array]:
        """Residuals and derivatives at a guess.

        Parameters
        ----------
        env : by node, the other inputs, (rows,) or one number
        q : (rows, n), places [frame] and degrees
        derivatives : whether they are asked for

        Returns
        -------
        tuple[Array, Array]
            (rows, equations) and (rows, equations, n), by angles in radians; of no size where not asked for.
        """
        rows, unknowns = q.shape
        given = {**env, **{k: q[:, n] for n, k in enumerate(self.implicit.guesses)}}
        found = (self.code if derivatives else self.misses).table(given, rows)
        f = np.ascontiguousarray(found[: self.equations].T)
        if not derivatives:
            return f, np.empty((0, 0, 0))
        j = np.empty((rows, len(self.still)))
        j[:] = self.still
        j[:, self.traced] = found[self.equations :].T
        return f, j.reshape(rows, self.equations, unknowns)

    def step(self, f: Array, j: Array) -> Array:
        """The step of Newton's method, (rows, n) [frame, radians], to be subtracted.

        Of least squares where there are more equations than unknowns (Gauss and Newton); with the
        pseudoinverse of all where any is singular.
        """
        if j.shape[1] != j.shape[2]:
            turned = np.swapaxes(j, 1, 2)
            with np.errstate(over="ignore"):
                f, j = (turned @ f[:, :, None])[:, :, 0], turned @ j
        try:
            found = np.linalg.solve(j, f[:, :, None])
        except np.linalg.LinAlgError:
            found = np.linalg.pinv(np.nan_to_num(j)) @ f[:, :, None]
        return np.asarray(found[:, :, 0], dtype=np.float64)

    @cached_property
    def direct(self) -> tuple[Code, Code] | None:
        """The step by one elimination for all rows, and the determinant; None where the system is not square.

        The pivots are those of the position in which the record was made.
        """
        count = len(self.implicit.guesses)
        given = zip(self.implicit.derivatives, self.implicit.residuals, strict=True)
        rows = [{**dict(enumerate(row)), count: 0.0 - f} for row, f in given]
        general = eliminate(rows, count)
        if general.left or general.free or len(general.pivots) != count:
            return None
        steps = [self.record.lifted(general.of(c).get(count, 0.0)).index for c in range(count)]
        product: Scalar = 1.0
        for pivot in general.pivots:
            product = product * pivot
        return Code(self.record, steps), Code(self.record, [self.record.lifted(product).index])

    def determinant(self, env: Mapping[int, Array], q: Array) -> Array:
        """The size of the determinant in each row, (rows,); of more equations than unknowns the root of
        Gram's.

        It vanishes where the group is at a change point or a limit.
        """
        if len(q) < MANY or self.direct is None:
            j = self.system(env, q)[1]
            if j.shape[1] != j.shape[2]:
                return np.asarray(np.sqrt(np.abs(np.linalg.det(np.swapaxes(j, 1, 2) @ j))))
            return np.asarray(np.abs(np.linalg.det(j)))
        parts = []
        for here, some in _blocks(env, q):
            given = {**here, **dict(zip(self.implicit.guesses, some.T, strict=True))}
            parts.append(np.abs(np.broadcast_to(self.direct[1].run(given, len(some))[0], len(some))))
        return np.concatenate(parts)

    def solve(self, env: Mapping[int, Array], start: Array, rounds: int = ROUNDS) -> tuple[Array, Array]:
        """Solutions from a start.

        Parameters
        ----------
        env : by node, the other inputs, (rows,) or one number
        start : (rows, n), places [frame] and degrees
        rounds : steps at most

        Returns
        -------
        tuple[Array, Array]
            (rows, n), and whether each row has a solution (residuals below 1e-11 of the frame), (rows,). Many
            rows are eliminated together, and those that this does not bring there one by one.
        """
        if len(start) < MANY or self.direct is None:
            return self._newton(env, start, rounds, None)
        parts = [self._newton(here, some, rounds, self.direct[0]) for here, some in _blocks(env, start)]
        q, good = (np.concatenate(column) for column in zip(*parts, strict=True))
        late = np.flatnonzero(~good)
        if late.size:
            q[late], good[late] = self._newton(_rows_of(env, late), start[late], rounds, None)
        return q, good

    def _newton(
        self, env: Mapping[int, Array], start: Array, rounds: int, direct: Code | None
    ) -> tuple[Array, Array]:
        q, good = start.copy(), np.zeros(len(start), dtype=bool)
        active = np.arange(len(start))
        for _ in range(rounds):
            here = _rows_of(env, active) if len(active) < len(start) else env
            move, size = self._move(here, q[active], direct)
            q[active] -= move
            good[active] = size < CLOSE
            active = active[~good[active] & np.isfinite(size)]
            if not active.size:
                break
        residual = np.abs(self.system(env, q, derivatives=False)[0]).max(axis=1)
        return q, good & (residual < SOLVED)

    def _move(self, env: Mapping[int, Array], q: Array, direct: Code | None) -> tuple[Array, Array]:
        """The next step of every row, cut to half the figure, and its full size."""
        if direct is None:
            move = self.step(*self.system(env, q))
        else:
            given = {**env, **dict(zip(self.implicit.guesses, q.T, strict=True))}
            move = np.stack([np.broadcast_to(v, len(q)) for v in direct.run(given, len(q))], axis=1)
        size = np.abs(move).max(axis=1)
        with np.errstate(all="ignore"):
            move = move * np.minimum(1.0, 0.5 / size)[:, None]
        move[:, 2::3] /= RADIAN
        return (move if np.isfinite(size).all() else np.nan_to_num(move)), size


def _rows_of(env: Mapping[int, Array], rows: npt.NDArray[np.intp]) -> dict[int, Array]:
    """Some rows of inputs."""
    return {k: v[rows] if v.ndim and len(v) > 1 else v for k, v in env.items()}


def _blocks(env: Mapping[int, Array], q: Array) -> Iterator[tuple[dict[int, Array], Array]]:
    """Inputs and states, so many rows after another."""
    for start in range(0, len(q), BLOCK):
        part = slice(start, start + BLOCK)
        yield {k: v[part] if v.ndim and len(v) > 1 else v for k, v in env.items()}, q[part]
