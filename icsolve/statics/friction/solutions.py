"""The solution that grows out of that without friction, where the equations do not contract: friction is
brought in little by little from none, and the solution followed; and whether there are others.

All solutions of the friction equations, where one is not proven to be the only one: as many quadrics as
unknowns, whose zeros are found by exclusion in a box that holds them all.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import product

from icsolve.numbers import largest_of
from icsolve.numbers.linear import null_space, solve_square
from icsolve.statics.friction.equations import (
    Form,
    Lengths,
    Y,
    at,
    is_sound,
    newton,
    own_length,
    scale_at,
    slopes,
    vector,
)
from icsolve.structure.plan import strongly_connected
from icsolve.tuples import NamedTuple

LONGEST = 0.125
FINE = 1e-6
"""How closely, of it, the share of friction is found at which forces grow without bound."""
SHORTEST, LEAST = 1e-7, 1e-14
"""The shortest step, of the share that friction has; beside a dead centre the least share decides."""
STEPS = 8
"""A good prediction needs fewer of Newton's steps."""
NEAR = 0.05
"""A prediction that is corrected by more was too far, of all forces;"""
FARTHEST = 0.2
"""and so was a step by which they change by more: it may lead to another solution."""


def near(y: Sequence[float], other: Sequence[float], error: float = 0.0) -> bool:
    """Whether two solutions are one; ``error`` is that of one, where it is known."""
    size = largest_of((*y, *other))
    return largest_of([a - b for a, b in zip(y, other, strict=True)]) <= max(SAME, error) * size


def followed(equations: Lengths) -> tuple[Y | None, float, bool]:
    """The frictionless solution followed to full friction, by predictor and corrector: l(y) = share |v(y)|.

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
    lengths = equations.lengths
    begin = solve_square([[*form[1:]] for form in lengths], [-form[0] for form in lengths])
    if begin is None:  # nothing balances without friction
        return None, 0.0, False
    first = largest_of([*begin, *(part for forms in equations.vectors for part in vector(forms, begin))])
    if not first:
        return tuple(begin), 1.0, False
    whole = _homogeneous(equations, first)
    z = _normed((*(part / first for part in begin), 1.0))
    share, step = 0.0, LONGEST
    change = _tangent(whole, z, share)
    while share < 1.0:
        ahead = min(1.0, share + step)
        moved = _moved(whole, z, change, ahead - share, ahead)
        if moved is not None and moved[-1] <= 0.0:
            if step < FINE * max(share, LEAST):
                return None, share, True
            moved = None
        if moved is None:
            step /= 2.0
            if step < SHORTEST * max(share, LEAST):
                return None, share, False
            continue
        z, share, step = moved, ahead, min(LONGEST, 2.0 * step)
        less = math.hypot(*(part for forms in whole.vectors for part in vector(forms, z))) / z[-1]
        if 0.0 < less < 1.0:  # forces that fall far below the first would be lost beside w
            first, z = less * first, _normed((*z[:-1], less * z[-1]))
            whole = _homogeneous(equations, first)
        change = _tangent(whole, z, share)
    return tuple(part * first / z[-1] for part in z[:-1]), 1.0, False


def _moved(whole: Lengths, z: Y, change: Sequence[float] | None, step: float, ahead: float) -> Y | None:
    """The solution a step on: predicted along the tangent, corrected; None where the step was too long."""
    start = z if change is None else tuple([a + step * b for a, b in zip(z, change, strict=True)])
    system = _with(whole, z, ahead)
    found = newton(system, start, STEPS)
    if found is not None:
        found = _on_its_side(system, found, z)
    if found is None or min((at(form, found) for form in whole.lengths), default=0.0) < -1e-10:
        return None
    here, far, before = (_pressing(whole, one) for one in (found, start, z))
    near_enough = math.dist(here, far) <= NEAR and math.dist(here, before) <= FARTHEST
    return _normed(found) if near_enough else None


def _on_its_side(system: Lengths, found: Y, before: Y) -> Y:
    """A solution, or the one beyond where a force vanishes beside it, if that is on the side it came from."""
    for kink in _kinks(system, found, ASIDE):
        other = newton(system, kink.beyond(found), STEPS)
        if other is not None:
            one, two, last = (vector(system.vectors[kink.rub], y) for y in (found, other, before))
            found = other if math.dist(two, last) < math.dist(one, last) else found
    return found


def _pressing(whole: Lengths, z: Y) -> Y:
    """The forces at (z, w), and w, as parts of all of them."""
    return _normed([*(part for forms in whole.vectors for part in vector(forms, z)), z[-1]])


def _homogeneous(equations: Lengths, first: float) -> Lengths:
    """l(z, w) = |v(z, w)|: the constants times w, over the size of y."""

    def form(affine: Form) -> Form:
        return (0.0, *affine[1:], affine[0] / first)

    vectors = tuple(tuple(map(form, forms)) for forms in equations.vectors)
    return Lengths(tuple(map(form, equations.lengths)), vectors, equations.touching)


def _with(whole: Lengths, z: Y, share: float) -> Lengths:
    """l = share |v|, and to fix the scale the next (z, w) is as long in the direction of this one."""
    vectors = tuple(tuple(tuple(share * a for a in form) for form in forms) for forms in whole.vectors)
    return Lengths((*whole.lengths, (-1.0, *z)), (*vectors, ()), (*whole.touching, False))


def _normed(z: Sequence[float]) -> Y:
    size = math.hypot(*z) or 1.0
    return tuple(a / size for a in z)


def _tangent(whole: Lengths, z: Y, share: float) -> list[float] | None:
    """Derivative of the solution by the share of friction."""
    sizes = [math.hypot(*vector(forms, z)) for forms in whole.vectors]
    return solve_square(slopes(_with(whole, z, share), z), [*sizes, 0.0])


MOST_RUBS = 6
"""More than these, found together, take too many boxes."""
MOST_BOXES = 100_000
"""A second or two of search."""
BEGUN = 250
"""What a search of few boxes takes in time, in boxes."""
ASIDE = 1e-2
"""A force below this part of the largest may vanish beside a solution, and there is another beyond;"""
SAME = 1e-7
"""below this part of it the two are taken for one."""
AT_INFINITY = 1e-9
"""Share of w in the coordinates of a solution below which it is one at infinity."""
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
        None where they are too many to try, or the search for them too long.
    """
    distinct, places = of_distinct(equations)
    parts = in_order(distinct)
    if len(distinct.vectors) > MOST_PARTS or max(map(len, parts), default=0) > MOST_RUBS:
        return None
    partial: list[dict[int, float]] = [{}]
    left = MOST_BOXES
    for part in parts:
        further: list[dict[int, float]] = []
        for known in partial:
            found, boxes = together(_part(distinct, part, known), left)
            left -= boxes + BEGUN
            if found is None or left < 0:
                return None
            further += [{**known, **dict(zip(part, y, strict=True))} for y in found]
        partial = further
    return _sound(equations, ([rough[place] for place in places] for rough in partial))


def _sound(equations: Lengths, rough: Iterable[Sequence[float]]) -> list[Y]:
    """The solutions that Newton's method finds from rough ones, each once, and those about as far beyond
    where a force vanishes beside them: there sizes are all but the same, and the forces are not.
    """
    found: list[tuple[Y, Y]] = []
    starts = list(rough)
    while starts:
        y = newton(equations, starts.pop(0))
        if y is None or not is_sound(equations, y):
            continue
        forces = (*y, *(part for forms in equations.vectors for part in vector(forms, y)))
        if not any(near(forces, other) for _, other in found):
            found.append((y, forces))
            starts += [kink.beyond(y) for kink in _kinks(equations, y, ASIDE)]
    return [y for y, _ in found]


class Kink(NamedTuple):
    """Where one force that rubs vanishes, beside a solution or at it.

    Attributes
    ----------
    rub : whose force that is
    along : (rubs,), how the unknowns change along the line that the other equations leave them
    at : where on it, from the solution
    grows, rubs : how fast the unknown of that force grows along it, and the force itself
    """

    rub: int
    along: tuple[float, ...]
    at: float
    grows: float
    rubs: float

    def beyond(self, y: Sequence[float]) -> Y:
        """As far on the other side."""
        return tuple([a + 2.0 * self.at * b for a, b in zip(y, self.along, strict=True)])

    @property
    def folds(self) -> bool:
        """Whether two solutions meet there, or none is beside it: on both sides friction grows faster."""
        return self.grows < self.rubs


def _kinks(equations: Lengths, y: Y, within: float) -> Iterator[Kink]:
    """Those that are no farther than this part of all unknowns."""
    sizes = [math.hypot(*vector(forms, y)) for forms in equations.vectors]
    least = within * largest_of((*y, *sizes))
    rows = slopes(equations, y) if any(size <= least for size in sizes) else []
    for k, (size, forms) in enumerate(zip(sizes, equations.vectors, strict=True)):
        if size > least or not forms:
            continue
        others = [_of_size_one(row) for j, row in enumerate(rows) if j != k]
        space = null_space(others, len(rows), EQUAL)
        if len(space.basis) != 1:
            continue
        (along,) = space.basis
        grows, *turns = (
            sum(a * b for a, b in zip(form[1:], along, strict=True))
            for form in (equations.lengths[k], *forms)
        )
        if not (rubs := math.hypot(*turns)):
            continue
        at = -sum(a * b for a, b in zip(vector(forms, y), turns, strict=True)) / rubs**2
        if abs(at) * largest_of(along) <= least:
            yield Kink(k, tuple(along), at, abs(grows), rubs)


def _of_size_one(row: Sequence[float]) -> list[float]:
    size = largest_of(row) or 1.0
    return [a / size for a in row]


def folds(equations: Lengths, y: Y) -> bool:
    """Whether a solution is two that meet where a force vanishes: on both sides of it the mechanism locks.

    Where several vanish, whether there is a solution beside them whatever else presses there a little: there
    is where these are odd in number, as the degree of a mapping is (L. Kronecker, 1869).
    """
    distinct, places = of_distinct(equations)
    own = [0.0] * len(distinct.lengths)
    for place, size in zip(places, y, strict=True):
        own[place] = size
    sizes = [math.hypot(*vector(forms, own)) for forms in distinct.vectors]
    least = SAME * largest_of((*own, *sizes))
    lost = [k for k, size in enumerate(sizes) if size <= least and distinct.vectors[k]]
    if len(lost) < 2:
        return any(kink.folds for kink in _kinks(distinct, tuple(own), SAME))
    rows = slopes(distinct, own)
    space = null_space([_of_size_one(row) for k, row in enumerate(rows) if k not in lost], len(rows), EQUAL)
    if len(space.basis) != len(lost):
        return False

    def beside(form: Form, constant: float = 0.0) -> Form:
        along = (sum(a * b for a, b in zip(form[1:], one, strict=True)) for one in space.basis)
        return (constant, *along)

    lengths = tuple(beside(distinct.lengths[k], -math.sqrt(n + 2.0)) for n, k in enumerate(lost))
    vectors = tuple(tuple(map(beside, distinct.vectors[k])) for k in lost)
    found = all_roots(Lengths(lengths, vectors, (False,) * len(lost)))
    return found is not None and len(found) % 2 == 0


def _part(equations: Lengths, part: Sequence[int], known: Mapping[int, float]) -> Lengths:
    """The equations of some of the unknowns, others known."""

    def left(form: Form) -> Form:
        constant = form[0] + sum(form[1 + j] * value for j, value in known.items())
        return (constant, *(form[1 + j] for j in part))

    lengths = tuple(left(equations.lengths[k]) for k in part)
    vectors = tuple(tuple(map(left, equations.vectors[k])) for k in part)
    return Lengths(lengths, vectors, tuple(equations.touching[k] for k in part))


def together(equations: Lengths, most: int) -> tuple[list[Y] | None, int]:
    """As `all_roots`, of equations taken as a whole and by so many boxes at most; and how many it took.

    In homogeneous coordinates u = (w, z) with y = z / w they are quadrics l(u)^2 = |v(u)|^2; the lengths are
    not negative, so their sum is made 1 and all solutions lie in a box, those at infinity too. An unknown
    that is no length but a load has either sign.
    """
    n, scale = len(equations.lengths), scale_at(equations, [0.0] * len(equations.lengths))
    if n == 1:
        return _sound(equations, [[scale * y] for y in _of_one(equations, scale)]), 0
    if (rough := _of_lines(equations, scale)) is not None:
        return _sound(equations, rough), 0

    import numpy as np

    from icsolve.numbers.quadratics import Quadratics, every_zero

    matrices = [np.array(_matrix(both)) for both in zip(equations.lengths, equations.vectors, strict=True)]
    for matrix in matrices:
        matrix[0] /= scale
        matrix[:, 0] /= scale
    least = EQUAL * max(float(np.abs(matrix).max()) for matrix in matrices)
    signed = [k for k, form in enumerate(equations.lengths) if form != own_length(k, n)]
    rough, boxes = [], 0
    for signs, senses in product(product((1.0, -1.0), repeat=len(signed)), product(*_senses(equations))):
        turn = np.ones(n + 1)
        turn[[1 + k for k in signed]] = signs
        hessian = np.zeros((n + 1, n + 1, n + 1))
        constant, gradient = np.zeros(n + 1), np.zeros((n + 1, n + 1))
        constant[n], gradient[n] = -1.0, 1.0
        for k, matrix in enumerate(matrices):
            if (largest := float(np.abs(matrix).max())) <= least:
                gradient[k, 1 + k] = 1.0  # nothing presses, whatever the load is: none
            elif senses[k]:
                row = np.array(_line(equations, k, senses[k], scale)) * turn
                gradient[k] = row / (float(np.abs(row).max()) or 1.0)
            else:
                hessian[k] = matrix * np.outer(turn, turn) / largest
        zeros = every_zero(
            Quadratics(constant, gradient, hessian), np.zeros(n + 1), np.ones(n + 1), most - boxes
        )
        boxes += zeros.boxes
        if zeros.spent or zeros.movable:
            return None, boxes
        rough += [scale * turn[1:] * u[1:] / u[0] for u in zeros.found if u[0] > AT_INFINITY]
    return _sound(equations, [[float(part) for part in y] for y in rough]), boxes


def _senses(equations: Lengths) -> list[tuple[float, ...]]:
    """Of each rub in which senses its force may press: of a contact one, of a guide two; none of a pin."""
    both = zip(equations.vectors, equations.touching, strict=True)
    return [(0.0,) if len(forms) != 1 else (1.0,) if only else (1.0, -1.0) for forms, only in both]


def _line(equations: Lengths, k: int, sense: float, scale: float) -> list[float]:
    """l - sense v, which is zero where a force along a line presses that way, in w and z."""
    (form,) = equations.vectors[k]
    row = [a - sense * b for a, b in zip(equations.lengths[k], form, strict=True)]
    return [row[0] / scale, *row[1:]]


def _of_lines(equations: Lengths, scale: float) -> list[list[float]] | None:
    """The finite solutions where all forces that press act along lines of their own, as of contacts and on
    guides: l = v or l = -v, linear equations for each choice of senses. None where there is a pin, or where
    they have more than one solution for one choice.
    """
    if any(len(forms) != 1 for forms in equations.vectors):
        return None
    rough = []
    for senses in product(*_senses(equations)):
        rows = [_line(equations, k, sense, scale) for k, sense in enumerate(senses)]
        space = null_space(rows, len(rows) + 1, EQUAL)
        if len(space.basis) > 1:
            return None
        ((w, *z),) = space.basis
        if abs(w) > AT_INFINITY * sum(map(abs, (w, *z))):
            rough.append([scale * a / w + 0.0 for a in z])  # no zero is -0.0
    return rough


def _of_one(equations: Lengths, scale: float) -> list[float]:
    """The finite roots of a quadric in one unknown, over the scale."""
    (c, b), (_, a) = _matrix((equations.lengths[0], equations.vectors[0]))
    c, b = c / scale / scale, b / scale
    if not max(abs(a), abs(b), abs(c)):
        return [0.0]  # nothing presses, whatever the load is
    rest = b * b - a * c
    if abs(rest) <= EQUAL * (b * b + abs(a * c)):
        rest = 0.0
    if rest < 0.0:
        return []
    whole = -b - math.copysign(math.sqrt(rest), b)
    ratios = [(whole, a), (c, whole)] if whole else [(0.0, a)]
    return [y / w for y, w in ratios if abs(w) > AT_INFINITY * (abs(y) + abs(w))]


def _matrix(quadric: tuple[Form, tuple[Form, ...]]) -> list[list[float]]:
    """The symmetric matrix of a quadric l(u)^2 - |v(u)|^2."""
    length, forms = quadric
    count = range(len(length))
    return [[length[i] * length[j] - sum(form[i] * form[j] for form in forms) for j in count] for i in count]
