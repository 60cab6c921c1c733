"""Friction as equations between lengths: l_k(y) = |v_k(y)| for every rub k, all of them affine in y.

l_k is the size of the normal force (or of a pin's force) that friction was computed with, v_k that
force itself. Where y are the lengths themselves this is a fixed point y = |v(y)|.

Statics with friction, reduced to the equations of the rubs alone.

Every joint force is affine in the unknown loads and the frictions; the equations in which no joint is
left (the sums of power) give the unknown loads. With the sense of each rub given, what remains are as
many equations as rubs.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from operator import mul

from icsolve.numbers import largest_of
from icsolve.numbers.linear import Row, inverse, solve_square
from icsolve.statics.equilibrium import Statics
from icsolve.statics.witness import independent
from icsolve.tuples import NamedTuple

Form = tuple[float, ...]
"""An affine form: the constant, then the coefficients of y."""
Y = tuple[float, ...]
"""Lengths, (rubs,) [scaled force]."""


class Lengths(NamedTuple):
    """The equations ``l_k(y) = |v_k(y)|`` of n rubs.

    Attributes
    ----------
    lengths : n forms l_k, (1 + n,) each [scaled force]
    vectors : of each rub the one or two components of v_k, forms too
    touching : whether v_k (of one component) is a contact's normal force, which only pushes
    """

    lengths: tuple[Form, ...]
    vectors: tuple[tuple[Form, ...], ...]
    touching: tuple[bool, ...]

    @property
    def is_fixed_point(self) -> bool:
        """Whether y are the lengths themselves."""
        n = len(self.lengths)
        return all(form == own_length(k, n) for k, form in enumerate(self.lengths))

    def scaled(self, share: float) -> Lengths:
        """The equations with friction reduced to a share of it."""
        if not self.is_fixed_point:  # the coordinates tell frictions and forces as they are
            vectors = tuple(tuple(tuple(share * a for a in form) for form in forms) for forms in self.vectors)
        else:
            vectors = tuple(
                tuple((form[0], *(share * a for a in form[1:])) for form in forms) for forms in self.vectors
            )
        return self._replace(vectors=vectors)


def own_length(k: int, n: int) -> Form:
    """The form that is y_k itself, (1 + n,)."""
    return tuple(float(j == k + 1) for j in range(n + 1))


def fixed_point(vectors: Sequence[tuple[Form, ...]], touching: Sequence[bool]) -> Lengths:
    """The equations y = |v(y)|."""
    n = len(vectors)
    return Lengths(tuple(own_length(k, n) for k in range(n)), tuple(vectors), tuple(touching))


def at(form: Form, y: Sequence[float]) -> float:
    """Value of an affine form, (1 + n,), at y, (n,)."""
    found: float = form[0] + sum(map(mul, form[1:], y))
    return found


def vector(forms: Sequence[Form], y: Sequence[float]) -> tuple[float, ...]:
    """Value of v_k."""
    return tuple([at(form, y) for form in forms])


def misfits(equations: Lengths, y: Sequence[float]) -> list[float]:
    """l_k - |v_k|."""
    both = zip(equations.lengths, equations.vectors, strict=True)
    return [at(form, y) - math.hypot(*vector(forms, y)) for form, forms in both]


def slopes(equations: Lengths, y: Sequence[float]) -> list[list[float]]:
    """Derivatives of l_k - |v_k|; where v_k vanishes, of one side of the kink."""
    rows = []
    for form, forms in zip(equations.lengths, equations.vectors, strict=True):
        v = vector(forms, y)
        size = math.hypot(*v)
        unit = [part / size for part in v] if size else [1.0, 0.0][: len(v)]
        rows.append(
            [p - sum(u * f[j + 1] for u, f in zip(unit, forms, strict=True)) for j, p in enumerate(form[1:])]
        )
    return rows


MOST_STEPS = 60
ROUNDING = 2.0**-52


def newton(equations: Lengths, start: Sequence[float], most: int = MOST_STEPS) -> tuple[float, ...] | None:
    """Newton's method on the piecewise smooth equations.

    Parameters
    ----------
    start : (n,) [scaled force]
    most : steps

    Returns
    -------
    tuple[float, ...] | None
        (n,), a zero of l_k - |v_k|, whose lengths may be negative (`is_sound`); None where it does not
        settle.
    """
    y = list(start)
    before = math.inf
    for _ in range(most):
        g = misfits(equations, y)
        size, scale = largest_of(g), scale_at(equations, y)
        if size <= 4.0 * ROUNDING * scale or (size < 1e-12 * scale and size >= before):
            return tuple(y)
        step = solve_square(slopes(equations, y), g)
        if step is None or not all(map(math.isfinite, step)):
            return None
        y = [a - b for a, b in zip(y, step, strict=True)]
        before = size
    return None


def scale_at(equations: Lengths, y: Sequence[float]) -> float:
    """The largest term in any of the forms: what rounding is measured by."""
    forms = [*equations.lengths, *(form for forms in equations.vectors for form in forms)]
    return max([_size(form, y) for form in forms], default=0.0) or 1.0


def _size(form: Form, y: Sequence[float]) -> float:
    found: float = abs(form[0]) + sum(map(abs, map(mul, form[1:], y)))
    return found


def contraction(equations: Lengths) -> list[list[float]] | None:
    """(I - L)^-1, (n, n), where y -> |v(y)| contracts; None where that is not sure.

    L has the lengths of the derivatives of v. Where L w < w for some w > 0 the spectral radius of L is below
    1 (Berman and Plemmons, Nonnegative Matrices, 1994, ch. 6), and Banach's theorem gives one solution, no
    more and no less. If any w does, the sums of the rows of the inverse do.
    """
    if not equations.is_fixed_point:
        return None
    n = len(equations.lengths)
    factors = [
        [math.hypot(*(form[j + 1] for form in forms)) for j in range(n)] for forms in equations.vectors
    ]
    found = inverse([[float(k == j) - factors[k][j] for j in range(n)] for k in range(n)])
    if found is None or any(a > 1e6 for row in found for a in row):
        return None
    sums = [sum(row) for row in found]
    shrunk = (sum(a * w for a, w in zip(row, sums, strict=True)) for row in factors)
    return found if all(0.0 <= less < w for less, w in zip(shrunk, sums, strict=True)) else None


def error_of(equations: Lengths, y: Sequence[float]) -> float:
    """Bound on the relative error of a solution, from what is left of its equations.

    With a contraction (I - L)^-1 times the misfits bounds the error; else it is twice the Newton step.
    """
    rest = [abs(g) + ROUNDING * scale_at(equations, y) for g in misfits(equations, y)]
    spread = contraction(equations)
    twice = 1.0
    if spread is None:
        spread, twice = inverse(slopes(equations, y)), 2.0
    if spread is None:
        return math.inf
    size = largest_of(y) or 1.0
    return (
        twice
        * max((sum(abs(a) * r for a, r in zip(row, rest, strict=True)) for row in spread), default=0.0)
        / size
    )


def is_sound(equations: Lengths, y: Sequence[float]) -> bool:
    """Whether no length is negative and every contact pushes (but for the rounding of its own terms)."""
    for length, forms, only in zip(equations.lengths, equations.vectors, equations.touching, strict=True):
        least = -1e-13 * max(_size(form, y) for form in (length, *forms))
        if at(length, y) < least or (only and at(forms[0], y) < least):
            return False
    return True


OPEN = 1e-9
"""A share of a force in what the joints leave open that is below this is none (rounding)."""
NOTHING = 1e-13
"""A force of the known loads below this fraction of the largest in any joint is none (rounding)."""


class Reduced(NamedTuple):
    """The equations of the rubs for given senses, and what turns their solution into loads.

    Attributes
    ----------
    equations : of the sizes y of the forces that press [scaled force]
    loads : of each unknown load an affine form in y [scaled]
    gains : of each rub its friction over the size of its force: the negative sense times the coefficient
    smooth : forms of the normal forces of contacts without friction, those that equilibrium determines
    """

    equations: Lengths
    loads: tuple[Form, ...]
    gains: tuple[float, ...]
    smooth: tuple[Form, ...] = ()

    def scaled(self, share: float) -> Reduced:
        """The same with friction reduced to a share of it, but for the loads."""
        smooth = self.smooth
        if self.equations.is_fixed_point:
            smooth = tuple((form[0], *(share * a for a in form[1:])) for form in smooth)
        return self._replace(equations=self.equations.scaled(share), smooth=smooth)

    def least_push(self, y: Sequence[float]) -> float:
        """The normal force of the contact that pushes least, over its terms; 1.0 where there is none, 0.0 of
        one that is none beside the others."""
        touching = zip(self.equations.vectors, self.equations.touching, strict=True)
        normals = (*(forms[0] for forms, only in touching if only), *self.smooth)
        least, pushes = NOTHING * scale_at(self.equations, y), ((at(form, y), form) for form in normals)
        return min((n / _size(form, y) if abs(n) > least else 0.0 for n, form in pushes), default=1.0)

    def sizes(self, y: Sequence[float]) -> tuple[float, ...]:
        """Sizes of the forces that press."""
        return tuple(at(form, y) for form in self.equations.lengths)

    def friction(self, y: Sequence[float]) -> tuple[float, ...]:
        """Friction at every rub, on the tie's second link; a size below zero is rounding of zero."""
        return tuple(gain * max(size, 0.0) for gain, size in zip(self.gains, self.sizes(y), strict=True))

    def load(self, y: Sequence[float]) -> tuple[float, ...]:
        """Unknown loads, scaled."""
        return tuple(at(form, y) for form in self.loads)


def forces_of(statics: Statics) -> tuple[tuple[Row, ...], ...]:
    """The vector that bounds each rub, as combinations of the parameters.

    Raises
    ------
    LookupError
        With the tie's number, where equilibrium does not determine it.
    """
    return tuple(tuple(_force(statics, rub.tie, row) for row in rub.normal) for rub in statics.rubs)


def combined(statics: Statics, tie: int, shares: Sequence[float]) -> Row:
    """A combination of what a tie transmits, by the parameters and what equilibrium leaves open."""
    total: Row = {}
    for n, share in enumerate(shares):
        for c, a in statics.general.of(statics.first[tie] + n).items():
            total[c] = total.get(c, 0.0) + share * a
    return total


def _force(statics: Statics, tie: int, shares: Sequence[float]) -> Row:
    total = combined(statics, tie, shares)
    largest = largest_of(total.values())
    if any(abs(a) > OPEN * max(largest, 1.0) for c, a in total.items() if c < statics.known):
        raise LookupError(tie)
    return total


def loads_from_power(statics: Statics) -> list[Row] | None:
    """Each unknown load by the known loads and the frictions; None where power does not say."""
    count = len(statics.roots)
    columns = [statics.root(n) for n in range(count)]
    others = [statics.known, *(statics.rub(k) for k in range(len(statics.rubs)))]
    rows = [[left.get(c, 0.0) for c in (*columns, *others)] for left in statics.general.left]
    chosen = independent(rows, count)
    by_row = inverse([row[:count] for row in chosen]) if len(chosen) == count else None
    if by_row is None:
        return None
    return [
        {
            c: -sum(a * row[count + n] for a, row in zip(weights, chosen, strict=True))
            for n, c in enumerate(others)
        }
        for weights in by_row
    ]


def reduced(statics: Statics, senses: Sequence[float]) -> Reduced | None:
    """The fixed point of the rubs: y are the sizes of the forces; None where power does not give the loads.

    Parameters
    ----------
    statics : with friction as parameters
    senses : (rubs,), those of the rubbing motions of the second links: 1, -1, or 0 for no friction
        (Coulomb: the friction on the second link is ``- sense * limit * y``)

    Raises
    ------
    LookupError
        As `forces_of`.
    """
    loads = loads_from_power(statics)
    if loads is None:
        return None
    gains = [-sense * rub.limit for sense, rub in zip(senses, statics.rubs, strict=True)]
    roots = {statics.root(n): row for n, row in enumerate(loads)}

    def form(row: Mapping[int, float], least: float = 0.0) -> Form:
        whole = _without(row, roots)
        known = whole.get(statics.known, 0.0)
        friction = (g * whole.get(statics.rub(k), 0.0) for k, g in enumerate(gains))
        return (known if abs(known) > least else 0.0, *friction)

    least = NOTHING * largest_of([form(row)[0] for row in statics.general.solved.values()])
    vectors = [tuple(form(row, least) for row in rows) for rows in forces_of(statics)]
    smooth = tuple(form(row, least) for row in smooth_normals(statics))
    return Reduced(fixed_point(vectors, touching_of(statics)), tuple(map(form, loads)), tuple(gains), smooth)


def _without(row: Mapping[int, float], roots: Mapping[int, Row]) -> Row:
    """A combination with the unknown loads put in."""
    whole: Row = {}
    for c, a in row.items():
        for d, b in roots.get(c, {c: 1.0}).items():
            whole[d] = whole.get(d, 0.0) + a * b
    return whole


def _alone(k: int, n: int, gain: float) -> Form:
    return tuple(gain if j == k + 1 else 0.0 for j in range(n + 1))


def touching_of(statics: Statics) -> tuple[bool, ...]:
    """Of each rub whether it is a contact, which only pushes."""
    return tuple([statics.ties[rub.tie].joint.only_pushes for rub in statics.rubs])


def smooth_normals(statics: Statics) -> Iterator[Row]:
    """The normal forces of contacts without friction, as combinations of the parameters; those that
    equilibrium determines."""
    for t in _smooth_contacts(statics):
        with suppress(LookupError):
            yield _force(statics, t, (1.0,))


def shared_normals(statics: Statics) -> list[Row]:
    """The same of those contacts of which equilibrium leaves open how they share the load, as combinations of
    the parameters and of what is open."""
    found = []
    for t in _smooth_contacts(statics):
        try:
            _force(statics, t, (1.0,))
        except LookupError:
            found.append(combined(statics, t, (1.0,)))
    return found


def _smooth_contacts(statics: Statics) -> Iterator[int]:
    rough = {rub.tie for rub in statics.rubs}
    return (t for t, tie in enumerate(statics.ties) if tie.joint.only_pushes and t not in rough)


def reduced_workless(statics: Statics, senses: Sequence[float]) -> Reduced | None:
    """The equations where the one unknown load does no work, or next to none: the frictions alone balance the
    known loads.

    y are the sizes of the forces, but for the one whose friction counts most: it follows from the sum of
    power, and the unknown load (scaled) stands in its place. None where no friction does work.
    """
    (left,) = statics.general.left
    gains = [-sense * rub.limit for sense, rub in zip(senses, statics.rubs, strict=True)]
    powers = [left.get(statics.rub(k), 0.0) * gain for k, gain in enumerate(gains)]
    most = max(range(len(powers)), key=lambda k: abs(powers[k]))
    if not powers[most]:
        return None
    powers[most], largest = left.get(statics.root(0), 0.0), powers[most]
    others = tuple(-p / largest for p in powers)
    length: Form = (-left.get(statics.known, 0.0) / largest, *others)
    n = len(gains)
    lengths = tuple(length if k == most else _alone(k, n, 1.0) for k in range(n))
    frictions = tuple(tuple(gain * a for a in form) for form, gain in zip(lengths, gains, strict=True))

    def form(row: Mapping[int, float]) -> Form:
        total = [row.get(statics.known, 0.0)] + [0.0] * n
        total[most + 1] = row.get(statics.root(0), 0.0)
        for k, friction in enumerate(frictions):
            total = [t + row.get(statics.rub(k), 0.0) * a for t, a in zip(total, friction, strict=True)]
        return tuple(total)

    vectors = tuple(tuple(form(row) for row in rows) for rows in forces_of(statics))
    return Reduced(Lengths(lengths, vectors, touching_of(statics)), (_alone(most, n, 1.0),), tuple(gains))


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
