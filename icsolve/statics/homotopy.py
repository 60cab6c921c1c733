"""The solution that grows out of that without friction, and whether there are others.

Where the equations contract there is exactly one. Else friction is brought in little by little from
none, the solution followed, and all solutions are counted.

All solutions of the friction equations, where one is not proven to be the only one.

The signs of the scalar forces are tried one by one, which makes their equations linear. What remains,
the pins, are as many quadrics as unknowns: one is solved in closed form, several by following every
path of a homotopy from a system whose solutions are known (A. J. Sommese and C. W. Wampler, The
Numerical Solution of Systems of Polynomials, 2005, ch. 8: total degree, on a random path in the complex
projective space, so that solutions at infinity are points like others).

Real solutions of quadrics l(z)^2 = |v(z)|^2, as many as unknowns: in closed form, or along paths.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from itertools import product
from operator import mul

from icsolve.numbers.linear import solve_square
from icsolve.numbers.sparse import eliminate
from icsolve.statics.friction_equations import (
    Form,
    Lengths,
    at,
    contraction,
    is_sound,
    newton,
    own_length,
    scale_at,
    slopes,
    vector,
)
from icsolve.structure.plan import strongly_connected
from icsolve.tuples import NamedTuple

Y = tuple[float, ...]

CONTRACTS = "the friction equations contract: Banach's theorem gives one solution and no other"
COUNTED = "all solutions were counted"
LONGEST = 0.125
FINE = 1e-6
"""How closely the share of friction is found at which forces grow without bound."""
SHORTEST = 1e-7
STEPS = 8
"""A good prediction needs fewer of Newton's steps."""
NEAR = 0.05
"""A prediction that is corrected by more was too far, of the sum of the sizes."""


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
    main, share, grows = followed(equations)
    return Solutions(main, "", share, grows)


def near(y: Sequence[float], other: Sequence[float]) -> bool:
    """Whether two solutions are one."""
    size = max(map(abs, (*y, *other)), default=0.0) or 1.0
    return max((abs(a - b) for a, b in zip(y, other, strict=True)), default=0.0) <= 1e-7 * size


def contracted(equations: Lengths) -> Y:
    """The fixed point of a contraction, (rubs,) [scaled force]: Newton's method, from plain iteration where
    that does not settle.
    """
    y = without_friction(equations)
    for _ in range(200):
        found = newton(equations, y)
        if found is not None and min(found, default=0.0) >= -1e-12 * scale_at(equations, found):
            return found
        for _ in range(20):
            y = tuple(math.hypot(*vector(forms, y)) for forms in equations.vectors)
    return y


def without_friction(equations: Lengths) -> Y:
    """Sizes of the forces where nothing rubs."""
    return tuple(math.hypot(*(form[0] for form in forms)) for forms in equations.vectors)


def followed(equations: Lengths) -> tuple[Y | None, float, bool]:
    """The frictionless solution followed to full friction, by predictor and corrector.

    In homogeneous coordinates (z, w) with y = z / w, so that forces without bound are a point like others:
    there w passes through zero.

    Returns
    -------
    tuple[Y | None, float, bool]
        Its end, (rubs,) [scaled force], or None; how far it came, as a share of full friction; whether its
        forces grew without bound there (the mechanism jams).
    """
    distinct, places = of_distinct(equations)
    end, share, grows = _followed(distinct)
    return None if end is None else tuple(end[place] for place in places), share, grows


def _followed(equations: Lengths) -> tuple[Y | None, float, bool]:
    first = max(without_friction(equations), default=0.0)
    if not first:
        return without_friction(equations), 1.0, False
    z: Y = (*(size / first for size in without_friction(equations)), 1.0)
    share, step = 0.0, LONGEST
    while share < 1.0:
        ahead = min(1.0, share + step)
        moved = _moved(equations, first, z, share, ahead)
        if moved is not None and moved[-1] <= 0.0:
            if step < FINE:
                return None, share, True
            moved = None
        if moved is None:
            step /= 2.0
            if step < SHORTEST:
                return None, share, False
            continue
        z, share, step = moved, ahead, min(LONGEST, 2.0 * step)
    return tuple(part * first / z[-1] for part in z[:-1]), 1.0, False


def _moved(equations: Lengths, first: float, z: Y, share: float, ahead: float) -> Y | None:
    """The solution a step on: predicted along the tangent, corrected; None where the step was too long."""
    change = _tangent(equations, first, z, share)
    start = z if change is None else tuple(a + (ahead - share) * b for a, b in zip(z, change, strict=True))
    found = newton(_homogeneous(equations, first, ahead), start, STEPS)
    if found is None or min(found[:-1], default=0.0) < -1e-10:
        return None
    off = max(abs(a - b) for a, b in zip(found, start, strict=True))
    return found if off <= NEAR else None


def _homogeneous(equations: Lengths, first: float, share: float) -> Lengths:
    """z_k = |w a_k / first + share B_k z| and, to fix the scale, sum of z + w = sum of the first ones + 1."""
    n = len(equations.vectors)
    vectors = tuple(
        tuple((0.0, *(share * a for a in form[1:]), form[0] / first) for form in forms)
        for forms in equations.vectors
    )
    lengths = tuple(tuple(float(j == k + 1) for j in range(n + 2)) for k in range(n))
    whole = 1.0 + sum(without_friction(equations)) / first
    return Lengths((*lengths, (-whole, *[1.0] * (n + 1))), (*vectors, ()), (*equations.touching, False))


def _tangent(equations: Lengths, first: float, z: Y, share: float) -> list[float] | None:
    """Derivative of the solution by the share of friction."""
    here = _homogeneous(equations, first, share)
    right = []
    for now, forms in zip(here.vectors, equations.vectors, strict=False):
        v = vector(now, z)
        size = math.hypot(*v) or 1.0
        slope = [sum(a * x for a, x in zip(form[1:], z, strict=False)) for form in forms]
        right.append(sum(a * b for a, b in zip(v, slope, strict=True)) / size)
    return solve_square(slopes(here, z), [*right, 0.0])


MOST_RUBS = 6
MOST_PINS = 4
"""More than these, found together, have too many combinations to try."""
MOST_PARTS = 12
"""More than these have too many, one after another."""
EQUAL = 1e-12
"""What differs by less, of the largest, is equal but for rounding."""


def of_distinct(equations: Lengths) -> tuple[Lengths, tuple[int, ...]]:
    """The equations with one unknown for pins whose forces are of one size whatever friction does, and of
    each rub the number of its unknown: a link that bears no load passes the force of one pin on to another.
    """
    kept: list[int] = []
    places = []
    for k in range(len(equations.lengths)):
        place = next((i for i, j in enumerate(kept) if _of_one_size(equations, j, k)), len(kept))
        places.append(place)
        if place == len(kept):
            kept.append(k)

    def gathered(form: Form) -> Form:
        sums = [form[0], *[0.0] * len(kept)]
        for place, a in zip(places, form[1:], strict=True):
            sums[1 + place] += a
        return tuple(sums)

    lengths = tuple(gathered(equations.lengths[k]) for k in kept)
    vectors = tuple(tuple(map(gathered, equations.vectors[k])) for k in kept)
    return Lengths(lengths, vectors, tuple(equations.touching[k] for k in kept)), tuple(places)


def _of_one_size(equations: Lengths, j: int, k: int) -> bool:
    """Whether the forces of two pins are of one size: as quadrics, in whatever directions they are told."""
    n = len(equations.lengths)
    if any(len(equations.vectors[i]) != 2 or equations.lengths[i] != own_length(i, n) for i in (j, k)):
        return False
    one, other = (
        [a for row in _matrix(((0.0,) * (n + 1), equations.vectors[i])) for a in row] for i in (j, k)
    )
    apart = max(abs(a - b) for a, b in zip(one, other, strict=True))
    return apart <= EQUAL * max(map(abs, one))


def in_order(equations: Lengths) -> list[list[int]]:
    """The unknowns in parts that are found together, each after those that it needs."""
    rows = [[*form[1:]] for form in equations.lengths]
    for row, forms in zip(rows, equations.vectors, strict=True):
        row[:] = (max(abs(a), *(abs(form[1 + j]) for form in forms)) for j, a in enumerate(row))
    least = EQUAL * max(map(max, rows), default=0.0)
    return strongly_connected({k: [j for j, a in enumerate(row) if a > least] for k, row in enumerate(rows)})


def all_roots(equations: Lengths) -> list[Y] | None:
    """Every solution with lengths that are not negative and contacts that push, (rubs,) each [scaled force].

    Equal forces are one unknown, and what friction elsewhere does not change is found first.

    Returns
    -------
    list[Y] | None
        None where they are too many to try, or their paths too long to follow.
    """
    distinct, places = of_distinct(equations)
    parts = in_order(distinct)
    if len(distinct.vectors) > MOST_PARTS or max(map(len, parts), default=0) > MOST_RUBS:
        return None
    partial: list[dict[int, float]] = [{}]
    for part in parts:
        further = [(known, together(_part(distinct, part, known))) for known in partial]
        partial = []
        for known, found in further:
            if found is None:
                return None
            partial += [{**known, **dict(zip(part, y, strict=True))} for y in found]
    return _sound(equations, ([rough[place] for place in places] for rough in partial))


def _sound(equations: Lengths, rough: Iterable[Sequence[float]]) -> list[Y]:
    """The solutions that Newton's method finds from rough ones, each once."""
    found: list[Y] = []
    for start in rough:
        y = newton(equations, start)
        if y is not None and is_sound(equations, y) and not any(near(y, other) for other in found):
            found.append(y)
    return found


def _part(equations: Lengths, part: Sequence[int], known: Mapping[int, float]) -> Lengths:
    """The equations of some of the unknowns, others known."""

    def left(form: Form) -> Form:
        constant = form[0] + sum(form[1 + j] * value for j, value in known.items())
        return (constant, *(form[1 + j] for j in part))

    lengths = tuple(left(equations.lengths[k]) for k in part)
    vectors = tuple(tuple(map(left, equations.vectors[k])) for k in part)
    return Lengths(lengths, vectors, tuple(equations.touching[k] for k in part))


def together(equations: Lengths) -> list[Y] | None:
    """As `all_roots`, of equations taken as a whole: the signs are 2 to the number of scalar forces."""
    pins = [k for k, forms in enumerate(equations.vectors) if len(forms) > 1]
    scalars = [k for k in range(len(equations.vectors)) if k not in pins]
    choices = [(1.0,) if equations.touching[k] else (1.0, -1.0) for k in scalars]
    if len(pins) > MOST_PINS:
        return None
    try:
        rough = [
            y
            for signs in product(*choices)
            for y in _with_signs(equations, dict(zip(scalars, signs, strict=True)))
        ]
    except PathTooLong:
        return None
    return _sound(equations, rough)


def _with_signs(equations: Lengths, signs: dict[int, float]) -> Iterable[Sequence[float]]:
    """Rough solutions in which the scalar forces have these signs: then only the pins are not linear."""
    n = len(equations.lengths)
    both = ((sign, equations.lengths[k], equations.vectors[k][0]) for k, sign in signs.items())
    linear = [[a - sign * b for a, b in zip(length, force, strict=True)] for sign, length, force in both]
    general = eliminate([{n: row[0], **dict(enumerate(row[1:]))} for row in linear], n, 1e-12)
    if general.left:
        return
    columns = [general.of(c) for c in range(n)]
    space = [[row.get(q, 0.0) for row in columns] for q in (n, *general.free)]
    quadrics = [
        (_on(equations.lengths[k], space), tuple(_on(form, space) for form in equations.vectors[k]))
        for k in range(n)
        if k not in signs
    ]
    for z in quadric_roots(quadrics, scale_at(equations, space[0])):
        weights = (1.0, *z)
        y = [
            sum(w * part for w, part in zip(weights, parts, strict=True))
            for parts in zip(*space, strict=True)
        ]
        least = -1e-6 * scale_at(equations, y)
        if all(sign * at(equations.vectors[k][0], y) >= least for k, sign in signs.items()):
            yield y


def _on(form: Form, space: Sequence[Sequence[float]]) -> Form:
    """An affine form in the coordinates of an affine space (origin, then directions)."""
    return (
        at(form, space[0]),
        *(sum(a * d for a, d in zip(form[1:], direction, strict=True)) for direction in space[1:]),
    )


class PathTooLong(ArithmeticError):
    """A path of a homotopy takes more than `MOST_ON_PATH` steps: its end is not known."""


MOST_ON_PATH = 400
LONGEST_STEP = 0.1
"""The longest step along a path; longer ones can cross to a neighbour."""
NEAR_PATH = 1e-3
"""A prediction that the first correction moves by more, of its size, was too far."""

Quadric = tuple[Form, tuple[Form, ...]]
Projective = list[complex]


def quadric_roots(quadrics: Sequence[Quadric], scale: float) -> list[list[float]]:
    """The real solutions z of quadrics l(z)^2 = |v(z)|^2, as many as unknowns (rough ones too).

    Parameters
    ----------
    quadrics : n pairs of the form l and the components of v, forms (1 + n,) each
    scale : size of the forms' constants

    Returns
    -------
    list[list[float]]
        (solutions, n); a solution at which two paths end may stand there twice.

    Raises
    ------
    PathTooLong
        Where the end of one is not known.
    """
    if not quadrics:
        return [[]]
    if len(quadrics) == 1:
        return [[z] for z in _one(quadrics[0])]
    paths = _Paths([_normalised(quadric, scale) for quadric in quadrics])
    ends = [paths.follow(signs) for signs in product((1.0, -1.0), repeat=len(quadrics))]
    return [[part * scale for part in z] for z in map(_real, ends) if z is not None]


def _one(quadric: Quadric) -> list[float]:
    """Solutions of one quadratic a z^2 + 2 b z + c = 0, without cancellation."""
    length, forms = quadric
    a = length[1] ** 2 - sum(f[1] ** 2 for f in forms)
    b = length[0] * length[1] - sum(f[0] * f[1] for f in forms)
    c = length[0] ** 2 - sum(f[0] ** 2 for f in forms)
    inside = b * b - a * c
    if inside < 0.0:
        return [-b / a] if inside > -1e-12 * (b * b + abs(a * c)) and a else []
    q = -(b + math.copysign(math.sqrt(inside), b))
    return [x for x in (q / a if a else math.inf, c / q if q else math.inf) if math.isfinite(x)] or [0.0]


def _normalised(quadric: Quadric, scale: float) -> Quadric:
    length, forms = quadric
    return _scaled(length, scale), tuple(_scaled(form, scale) for form in forms)


def _scaled(form: Form, scale: float) -> Form:
    return (form[0] / scale, *form[1:])


def _real(end: Projective) -> list[float] | None:
    """A path's end as a real point; None at infinity and off the real space."""
    if abs(end[0]) < 1e-7 * max(map(abs, end)):
        return None
    z = [part / end[0] for part in end[1:]]
    size = max(1.0, *map(abs, z))
    if any(abs(part.imag) > 1e-5 * size for part in z):
        return None
    return [part.real for part in z]


class _Paths:
    """H(z, t) = (1 - t) gamma (z_k^2 - z_0^2) + t F_k(z), homogeneous in z_0, ..., z_n, on a random patch."""

    def __init__(self, quadrics: Sequence[Quadric]) -> None:
        self.matrices = [_matrix(quadric) for quadric in quadrics]
        self.n = len(quadrics)
        self.gamma = _unit(0.9137)
        self.patch = [_unit(0.7 + 1.9 * k) for k in range(self.n + 1)]

    def follow(self, signs: Sequence[float]) -> Projective:
        """From a start (z_k = +-1) to t = 1, or to a singular point just before it."""
        z: Projective = [1.0 + 0.0j, *(complex(s) for s in signs)]
        size = sum(a * b for a, b in zip(self.patch, z, strict=True))
        z = [part / size for part in z]
        t, step = 0.0, LONGEST_STEP
        for _ in range(MOST_ON_PATH):
            ahead = min(1.0, t + step)
            moved = self.corrected(self.predicted(z, t, ahead - t), ahead)
            if moved is not None:
                z, t, step = moved, ahead, min(LONGEST_STEP, 1.5 * step)
            else:
                step /= 2.0
            if t == 1.0 or (step < 1e-9 and 1.0 - t < 1e-5):
                return z
        raise PathTooLong

    def predicted(self, z: Projective, t: float, dt: float) -> Projective:
        """A step along the tangent, of second order (midpoint)."""
        first = self.tangent(z, t)
        half = [a + 0.5 * dt * b for a, b in zip(z, first, strict=True)] if first else z
        second = self.tangent(half, t + 0.5 * dt)
        return [a + dt * b for a, b in zip(z, second, strict=True)] if second else half

    def tangent(self, z: Projective, t: float) -> Projective | None:
        starts, targets, rows = self.system(z, t)
        change = [start - target for start, target in zip(starts, targets, strict=True)]
        return solve_square(rows, [*change, 0.0j])

    def corrected(self, z: Projective, t: float) -> Projective | None:
        """Newton's method at fixed t; None where three steps do not nearly reach the path."""
        for attempt in range(4):
            starts, targets, rows = self.system(z, t)
            values = [(1 - t) * a + t * b for a, b in zip(starts, targets, strict=True)]
            values.append(sum(map(mul, self.patch, z)) - 1.0)
            step = solve_square(rows, values)
            if step is None:
                return None
            z = [a - b for a, b in zip(z, step, strict=True)]
            size = max(map(abs, z))
            moved = max(map(abs, step))
            if moved <= 1e-10 * size:
                return z
            if attempt == 0 and moved > NEAR_PATH * size:
                return None
        return None

    def system(self, z: Projective, t: float) -> tuple[Projective, Projective, list[Projective]]:
        """The start system, the target system, and the derivatives of their sum at t (with the patch)."""
        starts, targets, rows = [], [], []
        twice, rest = 2.0 * t, 2.0 * (1.0 - t) * self.gamma
        first = z[0]
        for k, matrix in enumerate(self.matrices, start=1):
            half = [sum(map(mul, row, z)) for row in matrix]  # half the gradient of the form
            starts.append(self.gamma * (z[k] * z[k] - first * first))
            targets.append(sum(map(mul, half, z)))
            derivatives = [twice * part for part in half]
            derivatives[k] += rest * z[k]
            derivatives[0] -= rest * first
            rows.append(derivatives)
        rows.append(list(self.patch))
        return starts, targets, rows


def _matrix(quadric: Quadric) -> list[list[float]]:
    """The symmetric matrix of a quadric l(z)^2 - |v(z)|^2."""
    length, forms = quadric
    count = range(len(length))
    return [[length[i] * length[j] - sum(form[i] * form[j] for form in forms) for j in count] for i in count]


def _unit(angle: float) -> complex:
    """A complex number of size 1 at an angle [rad]."""
    return complex(math.cos(angle), math.sin(angle))
