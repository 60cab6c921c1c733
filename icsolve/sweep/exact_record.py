"""One row in high precision: the record of a sweep run in decimals, on the figures of the file.

What a row beside a singular position is decided by: whether its links reach one another, on which side of a
change point it stands, and where its points are, to so many digits that the scene by those coordinates is the
row itself. The varied numbers are the shortest decimals that name their doubles, as a file would have them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from decimal import Context, Decimal, localcontext
from itertools import chain

from icsolve.assembly.steps import PointGroup, place
from icsolve.case import Case, Centroid, Coordinates, Number
from icsolve.errors import SceneError, Status
from icsolve.numbers import Scalar
from icsolve.numbers.balls import Ball, Balls, BelowZero, MoreDigits, is_double, is_long
from icsolve.numbers.decimals import (
    CONTEXT,
    DIGITS,
    angle,
    as_written,
    cos_sin,
    decimal_of,
    decimal_ratio,
    pi,
)
from icsolve.numbers.linear import determinant, solve_square
from icsolve.numbers.record import Implicit, Op, Root, Traced, live, terms_of
from icsolve.numbers.replay import BINARY
from icsolve.numbers.roots import STEP
from icsolve.numbers.units import found_number
from icsolve.statics.load_wrenches import counted_about
from icsolve.sweep.program import CompiledSweep, live_roots, roots_of
from icsolve.sweep.varied_numbers import numbers_of, with_numbers
from icsolve.tuples import cached_property, replace

ADD, SUB, MUL = Op.ADD, Op.SUB, Op.MUL
ZERO = Decimal("1e-40")
"""What is below this fraction of its terms is zero."""
VANISHED = Decimal("1e-60")
"""What is divided by, or under a root, is zero below this fraction of its terms: fewer digits are lost on the
way."""
ROUNDS = 2 * DIGITS + 20
"""Steps of Newton's method: so many bring all digits where each leaves a third of the error (where a straight
part of a rope ends), and half of the digits where it leaves half: where two solutions have become one."""
HALF = Decimal("1e-70")
"""A step this short ends at a double root, and at a threefold one: what is left is as long as the step."""
DOUBLE_ROOT = Decimal("1e-66")
"""Digits that such a root has then: more than a scene decides by."""
MET = Decimal(10) ** (20 - DIGITS)
"""Conditions (normalised) are met where they are off by less."""
ALMOST, IDLE = Decimal("1e-60"), Decimal("1e6")
"""Conditions that are off by less than the first, of which a step is so many times longer than the root of
what is left (at a double root it is half of that), do not tell where along it the solution is: it is at the
guess, which comes from places around it."""
SHORTER = Decimal("1e-9")
"""A step longer than this and than the last leads to no solution near: beyond a fold there is none."""
ARMS = 4.0
"""A margin of squares changes, as a fraction of its terms, by less than so many times what places are off
[frame], where a change point lies as far from other points as the figure is large."""
AGREED = Decimal("1e-9")
"""Conditions that were not needed to place the links are met to this (normalised)."""
FLAT = Decimal(10) ** (60 - DIGITS)
"""A value that bends by less (normalised, over a step) is zero all along: of another way of assembling."""
LEAST = Decimal("1e-145")
"""Places of a row (normalised) are multiples of this."""
SHORT = Context(prec=160)
"""Coordinates of a row have so many digits: more than any scene is decided by."""
APART = "the links do not reach one another in this row."
AGAINST = "an angle that repeats other data is met but for its sense: it points the other way in this row."
ANYWHERE = "change point: two links have come to lie so that a point of them may be anywhere on a circle."

Values = dict[int, Decimal]
Step = tuple[int, int, int, int]
"""A node, its operation and what it is made of."""


class Unreached(ArithmeticError):
    """The links do not assemble there."""


class ExactRecord:
    """A record in high precision, a row at a time.

    ``given`` of its methods are the inputs of the row by their nodes [case units, degrees], exact decimals.
    """

    def __init__(self, compiled: CompiledSweep) -> None:
        self.compiled, self.record = compiled, compiled.record
        self.still = self._placed() if compiled.motion is not None else {}
        self.orders: dict[tuple[int, ...], tuple[list[Step], Values]] = {}
        self.least: Values = {}
        """by divisor, and by what is under a root, what is zero beside its terms"""
        self.constants = self._decimals()
        self.last: tuple[Values, Values] | None = None

    def _decimals(self) -> Values:
        """What the constants of the record are in the file."""
        numbers = numbers_of(self.compiled.setting.case)
        with localcontext(CONTEXT):
            found = {
                traced.index: decimal_of(numbers[name]) if name in numbers else Decimal(value)
                for (value, name), traced in self.record._constants.items()
            }
            return found | {k: decimal_ratio(exact) for k, exact in self.record.ratios.items()}

    def _placed(self) -> Values:
        """The points as written that Newton's method places, in all digits: the record has its last step from
        where doubles settled, and beside a fold the root of what that leaves would count."""
        motion, setting = self.compiled.motion, self.compiled.setting
        groups = (step for step in setting.figure.steps if isinstance(step, PointGroup))
        targets = [name for group in groups for name in group.targets]
        if motion is None or not targets:
            return {}
        try:
            points = place(setting.figure, setting.case, Balls(DIGITS)).points
        except (MoreDigits, BelowZero, ZeroDivisionError):
            return {}
        found: Values = {}
        with localcontext(CONTEXT):
            for name in targets:
                placed = motion.mechanism.shape.ref.get(name, ())  # those that the record has use for
                for node, exact in zip(placed, points[name], strict=False):
                    if isinstance(node, Traced) and not node.row:
                        at = exact.value if isinstance(exact, Ball) else Decimal(float(exact))
                        found |= self._corrected(node, at)
        return found

    def _corrected(self, node: Traced, at: Decimal) -> Values:
        """A coordinate, and the step from the double that led to it: what is turned round has that step."""
        found = {node.index: at}
        one, two = (self.record.nodes[k] for k in (node.a, node.b))
        if node.op == Op.SUB and one.op == Op.CONST:
            found[two.index] = Decimal(one.value) - at
        elif node.op == Op.ADD and Op.CONST in (one.op, two.op):
            start, step = (one, two) if one.op == Op.CONST else (two, one)
            found[step.index] = at - Decimal(start.value)
        return found

    def values(self, wanted: Iterable[Scalar], given: Mapping[int, Decimal]) -> list[Decimal]:
        """Expressions at a row, rounded in the last of their digits; not a number where something is divided
        by what is zero beside its terms.

        Raises
        ------
        Unreached
            Where a group of links has no solution.
        """
        return self.values_at(wanted, self.solved(given))

    def solved(self, given: Mapping[int, Decimal]) -> Values:
        """The inputs with the unknowns of all groups. Raises Unreached where these have no solution."""
        with localcontext(CONTEXT):
            return self._solved(given)

    def values_at(self, wanted: Iterable[Scalar], solved: Values) -> list[Decimal]:
        """Expressions as of `values`, where the groups are solved."""
        wanted = list(wanted)
        with localcontext(CONTEXT):
            indices = [v.index if isinstance(v, Traced) else None for v in wanted]
            found = self._found([k for k in indices if k is not None], solved)
            return [
                Decimal(float(v)) if k is None else found[k] for v, k in zip(wanted, indices, strict=True)
            ]

    def margins(self, roots: Sequence[Root], given: Mapping[int, Decimal]) -> list[Decimal]:
        """The smaller margin of each branch over the size of its terms; what is zero is 0, and not a number
        where nothing says where its place is."""
        if not roots:
            return []
        nodes = [self.record.nodes[n] for root in roots for margin in root.margins for n in margin]
        flat = iter(self.values(nodes, given))
        with localcontext(CONTEXT):
            pairs = [[relative(next(flat), next(flat)) for _ in range(2)] for _ in roots]
        return [Decimal("NaN") if one.is_nan() or two.is_nan() else min(one, two) for one, two in pairs]

    def states(self, given: Mapping[int, Decimal], nodes: Sequence[int]) -> list[Decimal]:
        """Unknowns of the groups, solved. Raises Unreached where they have no solution."""
        solved = self.solved(given)
        return [solved[k] for k in nodes]

    def determinant(self, group: Implicit, given: Values) -> Decimal:
        """That of the derivatives of a group's equations, of which there are as many as unknowns."""
        found = iter(self.values_at(chain.from_iterable(group.derivatives), given))
        with localcontext(CONTEXT):
            return Decimal(determinant([[next(found) for _ in row] for row in group.derivatives]))

    # --- straight on ------------------------------------------------------------------------------

    def _found(self, wanted: Sequence[int], given: Mapping[int, Decimal]) -> Mapping[int, Decimal]:
        key, nodes = tuple(wanted), self.record.nodes
        if key not in self.orders:
            order = [k for k in live(self.record.nodes, wanted) if nodes[k].op != Op.INPUT]
            steps = [(k, nodes[k].op, *_pair(nodes[k])) for k in order]
            judged = [b for _, op, _, b in steps if op in (Op.DIV, Op.SQRT) and b not in self.least]
            self.least |= {b: VANISHED * Decimal(terms_of(nodes, b)) for b in judged}
            needed = {n for *_, a, b in steps for n in (a, b)} | set(wanted)
            still = {k: self._constant(k) for k in needed if not nodes[k].row}
            self.orders[key] = (steps, still)
        steps, still = self.orders[key]
        values = {**still, **given}
        for k, op, a, b in steps:
            if k in values:
                continue
            if op is MUL:
                values[k] = values[a] * values[b]
            elif op is ADD:
                values[k] = values[a] + values[b]
            elif op is SUB:
                values[k] = values[a] - values[b]
            elif op in (Op.DIV, Op.SQRT) and not values[b].is_nan() and abs(values[b]) <= self.least[b]:
                values[k] = Decimal("NaN") if op == Op.DIV else Decimal(0)
            else:
                values[k] = _result(op, values[a], values[b])
        return values

    def _constant(self, k: int) -> Decimal:
        """A value that is the same in every row."""
        stack = [k]
        while stack:
            n = stack[-1]
            missing = [m for m in self.record.nodes[n].of if m not in self.still]
            stack += missing
            if not missing:
                stack.pop()
                if n not in self.still:
                    given = self.record.nodes[n].op == Op.CONST
                    self.still[n] = self._written(n) if given else self._still(n)
        return self.still[k]

    def _still(self, k: int) -> Decimal:
        a, b = _pair(self.record.nodes[k])
        return _result(self.record.nodes[k].op, self.still[a], self.still[b])

    def _written(self, k: int) -> Decimal:
        """A constant of the record, which may have grown."""
        if k not in self.constants:
            self.constants = self._decimals()
        return self.constants[k]

    # --- groups -----------------------------------------------------------------------------------

    def _solved(self, given: Mapping[int, Decimal]) -> Values:
        """The inputs with the groups' unknowns solved, from what they are in floats."""
        values = dict(given)
        groups = self.compiled.record.implicit
        if not groups:
            return values
        if self.last is None or self.last[0] != given:
            for group in groups:
                values |= zip(group.solved, self._newton(group, values), strict=True)
            self.last = (dict(given), values)
        return self.last[1]

    def _newton(self, group: Implicit, given: Values) -> list[Decimal]:
        """Newton's method to the last digit. Where two solutions have become one its steps halve the error,
        and half of the digits are all that there is."""
        q = [given[k] for k in group.solved]
        units = [Decimal(1), Decimal(1), pi(DIGITS) / 180] * (len(q) // 3)
        least, last = Decimal(10) ** (12 - DIGITS), Decimal(1)
        wanted = group.parts
        indices = [v.index for v in wanted if isinstance(v, Traced)]
        still = [None if isinstance(v, Traced) else Decimal(float(v)) for v in wanted]
        for _ in range(ROUNDS):
            found = self._found(indices, {**given, **dict(zip(group.guesses, q, strict=True))})
            varied = iter(indices)
            flat = [found[next(varied)] if value is None else value for value in still]
            f, rest = flat[: len(group.residuals)], flat[len(group.residuals) :]
            j = [rest[n * len(q) : (n + 1) * len(q)] for n in range(len(f))]
            left = max(map(abs, f))
            met = left < MET
            try:
                move = least_squares(j, f)
            except Unreached:
                if not met:
                    raise
                move = [Decimal(1)]
            size = max(map(abs, move))
            if size < least:
                return q
            # where the conditions are met a long step is what is left of them over what vanishes
            idle = met or (left < ALMOST and size > IDLE * left.sqrt())
            if (size < HALF and size > last / 3) or (size > HALF and idle):
                return [x.quantize(DOUBLE_ROOT) for x in q]
            if not size < max(last, SHORTER):
                break
            q = [x - m / unit for x, m, unit in zip(q, move, units, strict=True)]
            last = size
        raise Unreached


EXACT: tuple[str, tuple[int, ...]] = ("in all digits", ())
"""By this a record keeps itself in all digits."""


def exact_record(compiled: CompiledSweep) -> ExactRecord:
    """The record of a compiled sweep in all digits, made once."""
    found: ExactRecord | None = compiled.record.kept.get(EXACT)
    if found is None:
        found = compiled.record.kept[EXACT] = ExactRecord(compiled)
    return found


def open_by(case: Case, scale: float) -> Decimal:
    """What a lowest margin may be off, as a fraction of its terms, where it is zero: places that programs
    write, with all digits of doubles, are those of a figure with a change point to half the spacing of these.
    ``scale`` is that of the frame."""
    sections = {"points.": scale, "lengths.": scale, "angles.": math.radians(1.0)}
    measured = ((sections.get(path[: path.find(".") + 1]), n) for path, n in numbers_of(case).items())
    long = [(per, number) for per, number in measured if per is not None and is_long(number)]
    if not all(is_double(number) for _, number in long):
        return ZERO
    return max(ZERO, Decimal(ARMS * sum(per * math.ulp(number.value) / 2.0 for per, number in long)))


def lowest(
    value: Callable[[Decimal], Decimal], near: float, reach: Decimal = Decimal("1e-3")
) -> Decimal | None:
    """Where on a line a value is lowest: a branch comes nearest to changing where its radicand is.

    Parameters
    ----------
    value : by place of the line; may raise Unreached
    near : a place near it
    reach : so far from there it may lie

    Returns
    -------
    Decimal
        None where it does not lead there.
    """
    at = as_written(near)
    with localcontext(CONTEXT):
        for _ in range(12):
            try:
                low, here, high = (value(at + k * STEP) for k in (-1, 0, 1))
            except Unreached:
                return None
            bend = (high - 2 * here + low) / STEP
            if not bend > FLAT:  # so near to a zero that the value is 0 on both sides
                return at if at != as_written(near) and not (low or here or high) else None
            move = (low - high) / (2 * bend)
            if abs(move) > reach:
                return None
            at += move
            if abs(move) < STEP:
                break
    return at


def _result(op: int, a: Decimal, b: Decimal) -> Decimal:
    """An operation; NaN of what is NaN, and the root of what is less than zero."""
    if a.is_nan() or b.is_nan():
        return Decimal("NaN")
    match op:
        case Op.MUL:
            return a * b
        case Op.ADD:
            return a + b
        case Op.SUB:
            return a - b
        case Op.DIV:
            return a / b if b else Decimal("NaN")
        case Op.NEG:
            return -a
        case Op.SQRT:
            return a.sqrt() if a >= 0 else Decimal("NaN")
        case Op.ANGLE:
            return angle(a, b)
        case Op.NEAREST:
            return a.to_integral_value()
    return cos_sin(a)[0 if op == Op.COS else 1]


def _pair(node: Traced) -> tuple[int, int]:
    """What a node is made of; twice, where that is one."""
    return (node.a, node.b) if node.op in BINARY or node.op == Op.ANGLE else (node.a, node.a)


def relative(value: Decimal, size: Decimal) -> Decimal:
    """A value as a fraction of its terms, whose size may have either sign."""
    return value / abs(size) if size else Decimal("NaN")


# --- rows as scenes --------------------------------------------------------------------------------


def hides(compiled: CompiledSweep, known_loads: bool = True) -> bool:
    """Whether the record does not tell what is asked of the rows, or doubles lose it: known loads (where it
    hangs on them) all but cancel, or something that was taken as zero in every row is none."""
    if compiled.untold:
        return True
    if known_loads and compiled.cancels and any(map(float, _answers(compiled))):
        return True
    if not compiled.spent:
        return False
    kept = compiled.record.kept
    if HIDES not in kept:
        kept[HIDES] = _hides(compiled)
    found: bool = kept[HIDES]
    return found


def _answers(compiled: CompiledSweep) -> list[Scalar]:
    return [value for (kind, _), (value, *_) in compiled.outputs.items() if kind == "answers"]


HIDES: tuple[str, tuple[int, ...]] = ("hides", ())


def _hides(compiled: CompiledSweep) -> bool:
    exact, nodes = exact_record(compiled), compiled.record.nodes
    given = {one.index: Decimal(one.value) for one in compiled.record.inputs.values()}
    try:
        found = exact.values([nodes[k] for k, _ in compiled.spent], given)
    except Unreached:
        return True
    return any(
        value.is_nan() or abs(float(value)) > float(ZERO) * size
        for value, (_, size) in zip(found, compiled.spent, strict=True)
    )


class RowScenes:
    """Rows of a compiled sweep as cases: all points by coordinates, directions as they have turned."""

    def __init__(self, compiled: CompiledSweep) -> None:
        self.compiled, self.exact = compiled, exact_record(compiled)
        self.roots = live_roots(compiled)
        self.scene, record = compiled.scene, compiled.record
        self.points = dict(self.scene.points)
        self.directions = {own.path: (c, s) for own, c, s in record.directions.values()}
        self.numbers = {path: value for path, value in record.vary.items() if path.endswith("@")}
        self.springs = compiled.springs

    @cached_property
    def spare(self) -> frozenset[str]:
        """The points and directions that need a branch which bears on nothing that is asked."""
        record = self.compiled.record
        dead = record.roots.keys() - {root.node for root in self.roots}
        if not dead:
            return frozenset()
        nodes = {
            name: [v.index for v in pair if isinstance(v, Traced) and v.row]
            for name, pair in (*self.points.items(), *self.directions.items())
        }
        return frozenset(
            name for name, of in nodes.items() if not dead.isdisjoint(r.node for r in roots_of(record, of))
        )

    def refuse_apart(self, given: Mapping[int, Decimal]) -> None:
        """Raise SceneError where the links do not reach one another, spare conditions are not met, or two
        loci of a point have become one."""
        compiled, exact = self.compiled, self.exact
        try:
            margins = exact.margins(self.roots, given)
            margins += exact.values([compiled.record.nodes[k] for k in compiled.margins], given)
            if any(m < -ZERO for m in margins if not m.is_nan()):
                raise SceneError(Status.CANNOT_ASSEMBLE, APART)
            senses = exact.values([compiled.record.nodes[k] for k in compiled.senses], given)
            if any(sense < -ZERO for sense in senses if not sense.is_nan()):
                raise SceneError(Status.INCONSISTENT, AGAINST)
            checks = [compiled.record.nodes[k] for k in compiled.motion.checks] if compiled.motion else []
            off = exact.values(checks, given)
        except Unreached:
            raise SceneError(Status.CANNOT_ASSEMBLE, APART) from None
        if any(abs(v) > AGREED for v in off if not v.is_nan()):
            raise SceneError(Status.CANNOT_ASSEMBLE, APART)
        flat = self._flat(without=self.spare)
        if any(v.is_nan() for v in (*margins, *off, *exact.values(flat, given))):
            raise SceneError(Status.CHANGE_POINT, ANYWHERE)

    def case(self, given: Mapping[int, Decimal], values: Mapping[str, Decimal]) -> Case:
        """The case of a row: ``given`` has its inputs by node, ``values`` its varied numbers.

        Raises SceneError where nothing says where a point is. One of no bearing on what is asked is then left
        out, as in a scene, which does not examine it.
        """
        ox, oy, scale = map(Decimal, self.scene.frame)
        try:
            found = iter(self.exact.values(self._flat(), given))
        except Unreached:
            raise SceneError(Status.CANNOT_ASSEMBLE, APART) from None
        placed = {name: (next(found), next(found)) for name, _ in self._pairs()}
        rest = [*found]
        lacking = {name for name, pair in placed.items() if any(v.is_nan() for v in pair)}
        if lacking - self.spare or any(value.is_nan() for value in rest):
            raise SceneError(Status.CHANGE_POINT, ANYWHERE)
        found = iter(rest)
        points: dict[str, Coordinates | Centroid] = {}
        with localcontext(CONTEXT):
            for name in (name for name in self.points if name not in lacking):
                x, y = (_without_dust(v) / scale + o for v, o in zip(placed[name], (ox, oy), strict=True))
                points[name] = Coordinates(_exact(x, f"points.{name}.x"), _exact(y, f"points.{name}.y"))
            pairs = {path: placed[path] for path in self.directions if path not in lacking}
            turned = {path: angle(*pair) for path, pair in pairs.items()}
            lost = {path for path, pair in pairs.items() if max(map(abs, pair)) <= ZERO}
        numbers = {path: _exact(v, path) for path, v in {**values, **turned}.items()}
        numbers |= {path: _exact(next(found), path) for path in self.numbers}
        return self._with(points, numbers, {name: float(next(found)) for name in self.springs}, lost)

    def _pairs(self) -> list[tuple[str, tuple[Scalar, Scalar]]]:
        return [*self.points.items(), *self.directions.items()]

    def _flat(self, without: Collection[str] = ()) -> list[Scalar]:
        pairs = [v for name, pair in self._pairs() if name not in without for v in pair]
        return [*pairs, *self.numbers.values(), *self.springs.values()]

    def _with(
        self,
        points: dict[str, Coordinates | Centroid],
        numbers: Mapping[str, Number],
        angles: Mapping[str, float],
        lost: Collection[str],
    ) -> Case:
        """``lost``: directions of given motions that no row in a change point tells; a scene has its own."""
        case = counted_about(with_numbers(self.scene.case, numbers), angles)
        motion = [
            given._replace(angle=None) if given.angle is not None and given.angle.path in lost else given
            for given in case.motion
        ]
        carries = {
            link: tuple(name for name in names if name in points) for link, names in case.carries.items()
        }
        case = replace(case, lengths=(), angles=(), near={}, expect=(), motion=tuple(motion))
        return replace(case, points=points, carries=carries)


def _without_dust(value: Decimal) -> Decimal:
    """A coordinate [frame] without what is left of it where it is zero."""
    return value if abs(value) > 1 else value.quantize(LEAST)


def _exact(value: Decimal, path: str) -> Number:
    return found_number(SHORT.plus(value), path)


def _normal_equations(
    j: Sequence[Sequence[Decimal]], f: Sequence[Decimal]
) -> tuple[list[list[Decimal]], list[Decimal]]:
    """The square equations of least squares; rows have few numbers that are not zero."""
    count = len(j[0])
    square, right = [[Decimal(0)] * count for _ in range(count)], [Decimal(0)] * count
    for row, known in zip(j, f, strict=True):
        filled = [(n, a) for n, a in enumerate(row) if a]
        for n, a in filled:
            right[n] += a * known
            for m, b in filled:
                square[n][m] += a * b
    return square, right


def least_squares(j: Sequence[Sequence[Decimal]], f: Sequence[Decimal]) -> list[Decimal]:
    """x, (n,), with ``j x = f`` in the sense of least squares.

    Parameters
    ----------
    j : (m, n), m at least n
    f : (m,)

    Raises
    ------
    Unreached
        Where it is singular.
    """
    if len(j) != len(j[0]):
        j, f = _normal_equations(j, f)
    found = solve_square(j, f, lambda pivot, _: not pivot or not pivot.is_finite())
    if found is None:
        raise Unreached
    return found
