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

import cmath
import math
from collections.abc import Iterable, Sequence
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
    scale_at,
    slopes,
    vector,
)
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
    """The solutions of the friction equations.

    Attributes
    ----------
    main : continues the frictionless solution, (rubs,) [scaled force]; None: it stops at ``share`` of the
        friction
    others : all other solutions, where ``unique`` is not empty
    unique : how it is known that there are no more; empty where they were too many to count
    share : fraction of full friction to which ``main`` could be followed
    grows : whether its forces grew without bound there
    """

    main: Y | None
    others: tuple[Y, ...]
    unique: str
    share: float = 1.0
    grows: bool = False


def solutions(equations: Lengths) -> Solutions:
    """The solutions of a fixed point y = |v(y)|: one where it contracts, else followed from no friction and
    counted.
    """
    if contraction(equations) is not None:
        return Solutions(contracted(equations), (), CONTRACTS)
    main, share, grows = followed(equations)
    if not can_count(equations):
        return Solutions(main, (), "", share, grows)
    found = all_roots(equations)
    others = tuple(y for y in found if main is None or not near(y, main))
    return Solutions(main, others, COUNTED, share, grows)


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
"""More than these have too many combinations to try."""


def can_count(equations: Lengths) -> bool:
    """Whether all solutions can be found in reasonable time."""
    pins = sum(len(forms) == 2 for forms in equations.vectors)
    return len(equations.vectors) <= MOST_RUBS and pins <= MOST_PINS


def all_roots(equations: Lengths) -> list[tuple[float, ...]]:
    """Every solution with lengths that are not negative and contacts that push, (rubs,) each [scaled force].

    Raises nothing where there are too many to try: ask `can_count` first (the signs are 2 to the number of
    rubs).
    """
    scalars = [k for k, forms in enumerate(equations.vectors) if len(forms) == 1]
    choices = [(1.0,) if equations.touching[k] else (1.0, -1.0) for k in scalars]
    found: list[tuple[float, ...]] = []
    for signs in product(*choices):
        for rough in _with_signs(equations, dict(zip(scalars, signs, strict=True))):
            y = newton(equations, rough)
            if y is not None and is_sound(equations, y) and not any(near(y, other) for other in found):
                found.append(y)
    return found


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
        (solutions, n); a solution at which two paths end may stand there twice, a path that can't be followed
        is left out.
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


def _real(end: Projective | None) -> list[float] | None:
    """A path's end as a real point; None at infinity and off the real space."""
    if end is None or abs(end[0]) < 1e-7 * max(map(abs, end)):
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
        self.gamma = cmath.exp(0.9137j)
        self.patch = [cmath.exp(1j * (0.7 + 1.9 * k)) for k in range(self.n + 1)]

    def follow(self, signs: Sequence[float]) -> Projective | None:
        """From a start (z_k = +-1) to t = 1; None where the path can't be followed to its end."""
        z: Projective = [1.0 + 0.0j, *(complex(s) for s in signs)]
        size = sum(a * b for a, b in zip(self.patch, z, strict=True))
        z = [part / size for part in z]
        t, step = 0.0, LONGEST_STEP
        while t < 1.0:
            ahead = min(1.0, t + step)
            moved = self.corrected(self.predicted(z, t, ahead - t), ahead)
            if moved is None:
                step /= 2.0
                if step < 1e-9:
                    return z if 1.0 - t < 1e-5 else None
                continue
            z, t, step = moved, ahead, min(LONGEST_STEP, 1.5 * step)
        return z

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
