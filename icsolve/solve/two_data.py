"""Positions of equilibrium of a mechanism with two freedoms: two data of its figure are what is asked.

The generalised loads of both data vanish together. Newton's method runs from a grid over both ranges and
from the cells of a finer one in which both change their signs, all starts at once in floats, and from where
these end in all digits: a position is rounded once. What was searched is said, since no enclosure shows that
nothing was missed.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from decimal import Decimal, localcontext

import numpy as np

from icsolve.answer.equilibrium import EquilibriumPosition, Stiffness
from icsolve.assembly.ways import ways_of
from icsolve.case import Case, TorsionSpring, is_angle, is_named
from icsolve.errors import SceneError, Status
from icsolve.numbers import DEGREE, Scalar
from icsolve.numbers.adjoint import gradient
from icsolve.numbers.decimals import CONTEXT, as_written, decimal_ratio
from icsolve.numbers.intervals import Ends
from icsolve.numbers.record import varies
from icsolve.numbers.replay import Array, Code, Mask
from icsolve.scene import solve_scene
from icsolve.screws import velocity
from icsolve.solve.load_function import (
    PARTS,
    RecordedMode,
    bearers,
    clearance,
    figure_in,
    given_at,
    modes_of,
    moved,
    nearest,
    order_of_all,
    places_on,
    read_anew,
    refuse_together,
)
from icsolve.solve.positions import refuse_ropes, refuse_unwritten, whole_range
from icsolve.solve.refinement import CLOSED, NEAR, rounded, scene_in, within_a_turn
from icsolve.solve.rest_position import why_slack, with_scene
from icsolve.statics import load_wrenches, power
from icsolve.sweep.exact_record import VANISHED, exact_record
from icsolve.sweep.program import CompiledSweep, setting_of, spring_angles
from icsolve.sweep.recorded_scene import motions_of
from icsolve.tuples import NamedTuple, replace
from icsolve.wording import sentences
from icsolve.wording.sentences import left_out

GRID = 48
FINE = 257
BLOCK = 4096
STEPS = 40
TURNING = 97
"""Values of each datum at which turns of torsion springs are counted."""
BESIDE = 0.371
VALLEYS = 12
"""So many of the places of a grid that are nearer to `near` than all beside them are closed in on,"""
ROUNDS, AROUND, CLOSER = 9, 9, 3.0
"""in so many rounds, each so many times closer."""
ROUGH = 1e-2
"""Of the figure's size: nearer than this two modes pass equally near to `near`. With two freedoms a point may
come to a place in both."""
SAME = 1e-7
FLAT = 1e-13
"""Both powers change in one direction alone where the determinant of their slopes is this small."""
ALMOST, LOOSE = 1e-11, 1e-4
"""A plain zero moves by less than the first part of the ranges in the last step, one at which the slopes have
no inverse by less than the second;"""
WIDE = 1e-3
"""such ones are told apart where they lie farther from one another than this part of the ranges."""
MOST_TRIED = 48
"""So many of them are closed in on, and"""
MOST_FLAT = 8
"""more zeros than these are some of whole lines of them."""
NOTHING = Decimal("1e-30")
"""A determinant is zero below this fraction of its terms."""
CLOSE = Decimal("1e-25")
"""After a step as short as this the next would be as short as its square."""
MOST_STEPS = 300
SLOWEST = Decimal("0.9")
"""Steps of Newton's method in all digits become shorter by this at least, also at a zero of higher order."""

Pair = tuple[Decimal, Decimal]


class Zero(NamedTuple):
    """Where both loads vanish, a place next to it, and whether they change in one direction alone there."""

    at: Pair
    beside: Pair
    lies_flat: bool


Turns = tuple[tuple[Array, Array], dict[int, Array]]
"""Two axes, and by the node of a guess how far an angle has turned on their grid [degrees]."""


class Surface(NamedTuple):
    """One mode on a record with two inputs: nodes of the generalised loads of both data (2) [record's power
    a unit of the datum], of their derivatives by the data (2, 2), of the margins, and of the points."""

    compiled: CompiledSweep
    inputs: tuple[int, int]
    loads: list[int]
    slopes: list[int]
    margins: list[int]
    places: dict[str, tuple[int, int]]
    force_scale: float
    links: list[str]
    """those that turn"""
    springs: dict[str, int]
    """the angles that torsion springs follow, by load"""
    turns: Turns

    def given(self, x: Array, y: Array) -> dict[int, Array]:
        """All inputs of the record at places (n,) by node [case units, degrees]."""
        axes, counted = self.turns
        i, j = (
            np.clip(np.rint((v - axis[0]) / (axis[1] - axis[0])), 0, TURNING - 1).astype(int)
            for v, axis in zip((x, y), axes, strict=True)
        )
        return {**dict(zip(self.inputs, (x, y), strict=True)), **{k: t[i, j] for k, t in counted.items()}}


class FoundPairs(NamedTuple):
    """Positions by rising values of the first datum, and what was searched."""

    positions: tuple[EquilibriumPosition, ...]
    notes: tuple[str, ...]


def find_pairs(
    case: Case,
    paths: Sequence[str],
    spans: Sequence[Ends | None],
    starts: Sequence[float],
    asked: Mapping[str, bool],
) -> FoundPairs:
    """Every combination of two data at which the loads balance, as far as Newton's method finds them.

    Parameters
    ----------
    case : all of its loads known, of two freedoms
    paths, spans : the data, and the values of each that are searched; None: all that there are
    starts : where the figure is written, from which it then moves; none: each position is read anew
    asked : what each position shows of its scene, as of `icsolve.solve`

    Raises SceneError where the mechanism has not two freedoms, the figure assembles for no start, or `near`
    does not tell its ways apart.
    """
    limits = [span or whole_range(case, path) for path, span in zip(paths, spans, strict=True)]
    turned = any(b - a > 360.0 for path, (a, b) in zip(paths, limits, strict=True) if is_angle(path))
    if turned and any(isinstance(load, TorsionSpring) for load in case.loads):
        said = "two unknown angles with torsion springs are searched over one turn: shorten the ranges."
        raise SceneError(Status.UNSUPPORTED, said)
    surfaces = _surfaces(case, paths, limits, starts)
    if not starts:
        for path, span in zip(paths, spans, strict=True):
            refuse_unwritten(case, path, surfaces[0].links, span is not None)
    if case.near:
        distances = [_distance(surface, case, limits) for surface in surfaces]
        rough = ROUGH / surfaces[0].compiled.scene.frame.scale
        surfaces = [surfaces[nearest(case, distances, rough)]]
    turning = [span is None and is_angle(path) for span, path in zip(spans, paths, strict=True)]
    found: list[EquilibriumPosition] = []
    slack: list[str] = []
    lines: list[Zero] = []
    for surface in surfaces:
        zeros, flat = _zeros(surface, limits, turning)
        lines += flat
        for zero in zeros:
            position = _described(surface, paths, zero, limits, turning, asked)
            if isinstance(position, str):
                slack.append(position)
            elif position is not None and not any(_same(position, other) for other in found):
                found.append(position)
    found.sort(key=lambda one: [float(one.at[path]) for path in paths])  # type: ignore[arg-type]
    where = " and ".join(f"{p} from {a:g} to {b:g}" for p, (a, b) in zip(paths, limits, strict=True))
    note = (
        f"{where} were searched by Newton's method from {GRID} x {GRID} starts in each way of assembling, "
        f"and from the cells of {FINE - 1} x {FINE - 1} in which both loads change their signs."
    )
    if not lines:
        return FoundPairs(tuple(found), (note, *dict.fromkeys(slack)))
    there = " and ".join(f"{p} = {float(v):.6g}" for p, v in zip(paths, lines[0].at, strict=True))
    said = f"the loads balance in more positions than can be listed, at {there} for one, and beside it"
    if not found:
        raise SceneError(
            Status.ANY_VALUE, f"{said}: a freedom of the mechanism is left to itself.", {"positions": []}
        )
    return FoundPairs(tuple(found), (note, *dict.fromkeys(slack), f"{said}; of these none is listed."))


def _surfaces(
    case: Case, paths: Sequence[str], limits: Sequence[Ends], starts: Sequence[float]
) -> list[Surface]:
    """The modes of the figure: each read anew at all values, or moved from where the figure is written."""
    if starts:
        written = _at(case, paths, starts)
        ways = [replace(written, near=way.near) for way in ways_of(written).ways]
        return [_surface(moved(setting_of(way, paths, (), posing=True)), paths, limits) for way in ways]
    refuse_ropes(case, " and ".join(paths))
    order = order_of_all(_at(case, paths, [a + part * (b - a) for a, b in limits]) for part in (0.37, *PARTS))
    refuse_together(order)
    surfaces: list[Surface] = []
    refusal: SceneError | None = None
    draw = np.random.default_rng(11)
    tried = [[0.5 * (a + b) for a, b in limits]]  # where the turns of torsion springs count from
    tried += [[float(draw.uniform(a, b)) for a, b in limits] for _ in range(200)]
    for steps in modes_of(order.steps):
        for values in tried:
            written = _at(case, paths, values)
            if not clearance(written, order, steps) > 0.0:
                continue
            figure = figure_in(written, order, steps)
            try:
                surfaces.append(_surface(read_anew(written, paths, figure, order), paths, limits))
            except (SceneError, ZeroDivisionError, ValueError) as error:
                refusal = error if isinstance(error, SceneError) else refusal
                if refusal is not None and refusal.status in (Status.MOBILITY, Status.UNSUPPORTED):
                    raise refusal from None
                continue
            break
    if not surfaces:
        names = " and ".join(paths)
        raise refusal or SceneError(Status.CANNOT_ASSEMBLE, f"the figure assembles for no {names} searched.")
    return surfaces


def _at(case: Case, paths: Sequence[str], values: Sequence[float]) -> Case:
    for path, value in zip(paths, values, strict=True):
        case = given_at(case, path, value)
    return case


def _surface(mode: RecordedMode, paths: Sequence[str], limits: Sequence[Ends]) -> Surface:
    compiled = mode.compiled
    case, record, scene = compiled.scene.case, compiled.record, compiled.scene
    motions = motions_of(scene)
    if motions.mobility != 2:
        raise SceneError(
            Status.MOBILITY,
            f"two data of the figure are unknown, {' and '.join(paths)}, and the mechanism has mobility "
            f"{motions.mobility}: "
            + ("give one of them a number." if motions.mobility < 2 else "write 'unknown' for more data."),
        )
    inputs = (compiled.inputs[paths[0]], compiled.inputs[paths[1]])
    record.follows = True  # also where each position is read anew: turns count from one of them
    balance = power.balance(load_wrenches.wrenches(scene.place, vectors=True), motions.twists, 2)
    totals = (power.known_power(balance, 0, record), power.known_power(balance, 1, record))
    changes = []
    for name, (link, *_) in bearers(case).items():
        if name in scene.points and is_named(name):
            at, (one, other) = scene.points[name], motions.twists[link]
            for axis in (0, 1):
                by_x, by_y = gradient(record, at[axis], inputs).values()
                changes.append((by_x, by_y, velocity(one, at)[axis], velocity(other, at)[axis]))
    for k, path in enumerate(paths):
        if not any(varies(change[k]) or change[k] for change in changes):
            raise SceneError(Status.UNSUPPORTED, sentences.poses_nothing(path))
    loads = _generalised(changes, totals)
    slopes = [v for load in loads for v in gradient(record, load, inputs).values()]
    nodes, by_data = ([record.lifted(v).index for v in some] for some in (loads, slopes))
    links = [link for link, ts in motions.twists.items() if any(float(t[2]) for t in ts)]
    scale = power.force_scale(balance)
    springs = {name: record.lifted(angle).index for name, angle in spring_angles(scene).items()}
    turns = _turns(compiled, inputs, mode.margins, limits)
    places = places_on(compiled)
    return Surface(compiled, inputs, nodes, by_data, mode.margins, places, scale, links, springs, turns)


def _turns(
    compiled: CompiledSweep, inputs: tuple[int, int], margins: Sequence[int], limits: Sequence[Ends]
) -> Turns:
    """How far the angles of torsion springs have turned from where the record was made, from each place of a
    grid to those beside it; first through places in which the mode assembles, and then on through all."""
    record = compiled.record
    axes = (np.linspace(*limits[0], TURNING), np.linspace(*limits[1], TURNING))
    found: dict[int, Array] = {}
    if not record.counted:
        return axes, found
    x, y = (axis.ravel() for axis in np.meshgrid(*axes, indexing="ij"))
    own = tuple(
        int(np.argmin(np.abs(axis - record.nodes[k].value))) for axis, k in zip(axes, inputs, strict=True)
    )
    wide = (TURNING, TURNING)
    for angle, (guess, _) in record.counted.items():
        given = dict(zip(inputs, (x, y), strict=True))
        here, *gaps = (
            np.array(np.broadcast_to(v, x.size)).reshape(wide)
            for v in Code(record, [angle, *margins]).run(given, x.size)
        )
        whole = np.isfinite(here)
        for gap in gaps:
            whole &= gap > 0.0
        here = np.where(np.isfinite(here), here, np.nan)
        turned = np.full(wide, np.nan)
        turned[own] = guess.value
        for through in (whole, np.ones(wide, dtype=bool)):
            turned = _spread(turned, here, through)
        found[guess.index] = turned
    return axes, found


def _spread(turned: Array, here: Array, through: Mask) -> Array:
    """Turned angles (n, n) told from each place of a grid to those beside it, where these are gone through;
    ``here`` are the angles within half a turn, and where there is none that of the place beside counts."""
    while True:
        before = np.isnan(turned)
        for axis, way in ((0, 1), (0, -1), (1, 1), (1, -1)):
            beside = np.roll(turned, way, axis)
            edge = 0 if way > 0 else -1
            beside[(edge, slice(None)) if axis == 0 else (slice(None), edge)] = np.nan
            on = np.where(np.isnan(here), beside, here + 360.0 * np.rint((beside - here) / 360.0))
            turned = np.where(np.isnan(turned) & through, on, turned)
        if np.array_equal(before, np.isnan(turned)):
            return turned


def _generalised(
    changes: Sequence[tuple[Scalar, Scalar, Scalar, Scalar]], powers: tuple[Scalar, Scalar]
) -> tuple[Scalar, Scalar]:
    """The generalised loads of two data, of the powers in two motions.

    Each power is the loads times the rates of the data in its motion. Where both motions become one, as where
    a link that bears no load comes to lie along the one that pushes it, the powers tell less than the loads:
    loads that balance may have powers there.

    Parameters
    ----------
    changes : of every coordinate its derivatives by both data, and its speeds in both motions: by least
        squares these are the rates of the data
    """
    x, y, u, v = range(4)

    def of(i: int, j: int) -> Scalar:
        total: Scalar = 0.0
        for change in changes:
            total = total + change[i] * change[j]
        return total

    xx, xy, yy = of(x, x), of(x, y), of(y, y)
    det = xx * yy - xy * xy
    xm, xn = (of(x, m) * yy - of(y, m) * xy for m in (u, v))  # rates of the data, times the determinant
    ym, yn = (of(y, m) * xx - of(x, m) * xy for m in (u, v))
    of_all = det / (xm * yn - xn * ym)
    one, other = powers
    return (yn * one - ym * other) * of_all, (xm * other - xn * one) * of_all


def _distance(surface: Surface, case: Case, limits: Sequence[Ends]) -> float:
    """How near a mode passes to `near` [case units]: from the best place of a grid the search closes in."""
    names = [name for name in case.near if name in surface.places]
    nodes = [k for name in names for k in surface.places[name]]
    ox, oy, scale = surface.compiled.scene.frame
    code = Code(surface.compiled.record, [*nodes, *surface.margins])

    def off(x: Array, y: Array) -> Array:
        found = code.run(dict(zip(surface.inputs, (x, y), strict=True)), x.size)
        squares = np.zeros(x.size)
        for n, name in enumerate(names):
            px, py = found[2 * n] / scale + ox, found[2 * n + 1] / scale + oy
            squares = squares + (px - case.near[name][0]) ** 2 + (py - case.near[name][1]) ** 2
        for margin in found[len(nodes) :]:
            squares = np.where(margin > 0.0, squares, np.inf)
        return np.sqrt(np.nan_to_num(squares, nan=np.inf))

    x, y = _grid(limits)
    squared = np.pad(off(x, y).reshape(GRID, GRID), 1, constant_values=np.inf)
    beside = [squared[1 + i : GRID + 1 + i, 1 + j : GRID + 1 + j] for i in (-1, 0, 1) for j in (-1, 0, 1)]
    low = np.argsort(np.where(beside[4] <= np.min(beside, axis=0), beside[4], np.inf).ravel())[:VALLEYS]
    best = np.stack([x[low], y[low]])
    around = np.stack([axis.ravel() for axis in np.meshgrid(*[np.linspace(-1.0, 1.0, AROUND)] * 2)])
    for k in range(ROUNDS):
        steps = np.array([(b - a) / GRID / CLOSER**k for a, b in limits])
        tried = best[:, :, None] + (steps[:, None] * around)[:, None, :]  # (datum, valley, place)
        tried = np.clip(tried, *(np.array(ends)[:, None, None] for ends in zip(*limits, strict=True)))
        distances = off(tried[0].ravel(), tried[1].ravel()).reshape(tried.shape[1:])
        nearest_one = distances.argmin(axis=1)
        best = np.take_along_axis(tried, nearest_one[None, :, None], axis=2)[:, :, 0]
    return float(distances.min())


def _grid(limits: Sequence[Ends]) -> tuple[Array, Array]:
    axes = [np.linspace(a, b, GRID) + (b - a) / GRID * 0.013 for a, b in limits]
    x, y = np.meshgrid(*axes, indexing="ij")
    return x.ravel(), y.ravel()


def _fine(low: float, high: float) -> Array:
    """A finer axis, a little beyond both ends and beside round numbers: on a line on which a load vanishes
    throughout it does not change its sign."""
    wide = (high - low) / (FINE - 2)
    return np.linspace(low - BESIDE * wide, high + (1.0 - BESIDE) * wide, FINE)


def _starts(surface: Surface, limits: Sequence[Ends]) -> tuple[Array, Array]:
    """Where Newton's method starts: a grid over both ranges, and the cells of a finer one in which both
    powers change their signs, or the figure ceases to assemble."""
    code = Code(surface.compiled.record, [*surface.loads, *surface.margins])
    axes = np.meshgrid(*(_fine(*ends) for ends in limits), indexing="ij")
    x, y = (axis.ravel() for axis in axes)
    blocks = []
    for k in range(0, x.size, BLOCK):
        given = surface.given(x[k : k + BLOCK], y[k : k + BLOCK])
        rows = min(BLOCK, x.size - k)
        blocks.append(np.array([np.broadcast_to(v, rows) for v in code.run(given, rows)]))
    values = np.concatenate(blocks, axis=1)
    whole = np.isfinite(values[:2]).all(axis=0) & (values[2:] > 0.0).all(axis=0)
    first = np.arange(FINE * (FINE - 1)).reshape(-1, FINE)[:, :-1].ravel()
    corners = first + np.array([[0], [1], [FINE], [FINE + 1]])
    signs = np.where(whole, np.sign(values[:2]), 0.0)[:, corners]
    mixed = ((signs.max(axis=1) > 0.0) & (signs.min(axis=1) < 0.0)).all(axis=0)
    some = whole[corners].sum(axis=0)
    cells = corners[:, mixed | ((some > 0) & (some < 4))]
    inside = whole[cells] / whole[cells].sum(axis=0)
    cx, cy = ((at[cells] * inside).sum(axis=0) for at in (x, y))
    gx, gy = _grid(limits)
    return np.concatenate([gx, cx]), np.concatenate([gy, cy])


def _converged(surface: Surface, limits: Sequence[Ends]) -> tuple[Array, Array]:
    """Where Newton's method ends from all starts at once, in floats: places (n, 2) [case units, degrees] that
    assemble, those of plain zeros first, and how far their last steps were, as parts of the ranges (n,)."""
    code = Code(surface.compiled.record, [*surface.loads, *surface.slopes, *surface.margins])
    x, y = _starts(surface, limits)
    size = np.array([b - a for a, b in limits])
    with np.errstate(all="ignore"):
        for _ in range(STEPS):
            values = code.run(surface.given(x, y), x.size)
            f, g, fx, fy, gx, gy = (np.array(np.broadcast_to(v, x.size)) for v in values[:6])
            fx, gx, fy, gy = fx * size[0], gx * size[0], fy * size[1], gy * size[1]
            det, square = fx * gy - fy * gx, fx * fx + fy * fy + gx * gx + gy * gy
            # where both loads change in one direction alone the shortest step leads to where they vanish
            flat = np.abs(det) <= FLAT * square
            whole, square = np.where(flat, 1.0, det), np.where(square > 0.0, square, 1.0)
            dx = np.where(flat, (fx * f + gx * g) / square, (f * gy - g * fy) / whole)
            dy = np.where(flat, (fy * f + gy * g) / square, (g * fx - f * gx) / whole)
            long = np.maximum(np.abs(dx), np.abs(dy))
            short = np.minimum(1.0, 0.1 / np.where(long > 0.0, long, 1.0))
            step = np.nan_to_num(np.stack([dx * short, dy * short]))
            x, y = x - step[0] * size[0], y - step[1] * size[1]
        f, g, *margins = (
            np.array(np.broadcast_to(v, x.size))
            for v in Code(surface.compiled.record, [*surface.loads, *surface.margins]).run(
                surface.given(x, y), x.size
            )
        )
        last = np.abs(step).max(axis=0)
        last = np.where(flat, np.maximum(last, 2.0 * ALMOST), last)
        kept = (last <= LOOSE) & np.isfinite(f + g)
        for margin in margins:
            kept &= margin > 0.0
    order = np.argsort(last[kept] > ALMOST, kind="stable")
    return np.stack([x[kept], y[kept]], axis=1)[order], last[kept][order]


def _zeros(
    surface: Surface, limits: Sequence[Ends], turning: Sequence[bool]
) -> tuple[list[Zero], list[Zero]]:
    """The zeros of a mode in all digits: those that stand alone, and some of those that fill whole lines.

    ``turning`` : which data are searched over a turn.
    """
    alone: list[Zero] = []
    flat: list[Zero] = []
    seen: list[tuple[float, float]] = []
    tried = 0
    size = [b - a for a, b in limits]

    def beside(one: Sequence[float], other: Sequence[float], reach: Sequence[float]) -> bool:
        away = (abs(p - q) for p, q in zip(one, other, strict=True))
        return all(
            min(d, abs(d - 360.0)) <= r if turns else d <= r
            for d, r, turns in zip(away, reach, turning, strict=True)
        )

    for pair, last in zip(*(each.tolist() for each in _converged(surface, limits)), strict=True):
        start = [v % 360.0 if turns else v for v, turns in zip(pair, turning, strict=True)]
        reach = [max(SAME, (WIDE if last > ALMOST else 0.0) * s) for s in size]
        if not all(a - r <= v <= b + r for v, (a, b), r in zip(start, limits, reach, strict=True)):
            continue
        if any(beside(start, other, reach) for other in seen):
            continue
        if last > ALMOST or len(flat) > MOST_FLAT:
            tried += 1
            if tried > MOST_TRIED:
                continue
        seen.append((start[0], start[1]))
        zero = _in_all_digits(surface, start, size)
        if zero is None:
            continue
        at = [float(v) for v in zero.at]
        if not any(beside(at, [float(v) for v in other.at], (SAME, SAME)) for other in (*alone, *flat)):
            (flat if zero.lies_flat else alone).append(zero)
            seen.append((at[0], at[1]))
    return (alone + flat, []) if len(flat) <= MOST_FLAT else (alone, flat)


def _values(surface: Surface, at: Pair, nodes: Sequence[int]) -> list[Decimal]:
    """Nodes of a mode at decimals of both data [case units, degrees], in all digits."""
    record = surface.compiled.record
    there = surface.given(*(np.array(float(v)) for v in at))
    given = {k: Decimal(float(v)) for k, v in there.items()} | dict(zip(surface.inputs, at, strict=True))
    return exact_record(surface.compiled).values([record.nodes[k] for k in nodes], given)


def _in_all_digits(surface: Surface, start: Sequence[float], size: Sequence[float]) -> Zero | None:
    """The zero of both loads beside a place by Newton's method in all digits, with a place so near to it that
    all that is told of it can be told of that, and whether the loads change in one direction alone there, if
    at all; None where it does not close in. (In the zero itself the record may divide by what vanishes.)"""
    x, y = beside = (as_written(start[0]), as_written(start[1]))
    sx, sy = map(Decimal, size)
    before, lies_flat = Decimal("Infinity"), False
    with localcontext(CONTEXT):
        for _ in range(MOST_STEPS):
            f, g, *slopes = _values(surface, (x, y), [*surface.loads, *surface.slopes])
            if any(v.is_nan() for v in (f, g, *slopes)):
                return Zero((x, y), beside, lies_flat) if before <= CLOSE else None
            fx, fy, gx, gy = (v * s for v, s in zip(slopes, (sx, sy, sx, sy), strict=True))
            det, square = fx * gy - fy * gx, fx * fx + fy * fy + gx * gx + gy * gy
            lies_flat = abs(det) <= NOTHING * square
            if abs(det) > VANISHED * square:
                dx, dy = (f * gy - g * fy) / det, (g * fx - f * gx) / det
            else:
                square = square or Decimal(1)
                dx, dy = (fx * f + gx * g) / square, (fy * f + gy * g) / square
            move = max(abs(dx), abs(dy))
            if not move <= before * SLOWEST:
                return None
            beside = (x, y)
            x, y, before = x - dx * sx, y - dy * sy, move
            if move <= (NEAR if lies_flat else CLOSED):
                if abs(f) + abs(g) > NOTHING:  # nothing leads on to where they vanish
                    return None
                x, y = (v if abs(v) > NEAR * s else Decimal(0) for v, s in ((x, sx), (y, sy)))
                return Zero((x, y), beside, lies_flat)
    return None


def _described(
    surface: Surface,
    paths: Sequence[str],
    zero: Zero,
    limits: Sequence[Ends],
    turning: Sequence[bool],
    asked: Mapping[str, bool],
) -> EquilibriumPosition | str | None:
    """A zero in all digits as a position, with its stiffness matrix and stability; None where it lies beyond
    the limits, a sentence where a rope would have to push."""
    (x, dx), (y, dy) = map(rounded, zero.at)
    off = (dx, dy)
    x, y = (within_a_turn(v, e) if turns else v for v, e, turns in zip((x, y), off, turning, strict=True))
    if any(not a - e <= v <= b + e for v, e, (a, b) in zip((x, y), off, limits, strict=True)):
        return None
    x, y = (min(max(v, a), b) for v, (a, b) in zip((x, y), limits, strict=True))
    slopes = _values(surface, zero.beside, surface.slopes)
    exact = (v if e and float(v) == own else own for v, e, own in zip(zero.at, off, (x, y), strict=True))
    scene = solve_scene(_scene(surface, paths, [*exact]))
    if slack := why_slack(scene.case, surface.links, 2):
        there = " and ".join(f"{p} = {v:.6g}" for p, v in zip(paths, (x, y), strict=True))
        return left_out(there, slack)
    shown = with_scene(scene, surface.links, 2, **asked)
    at, error_of = (dict(zip(paths, pair, strict=True)) for pair in ((x, y), off))
    stiffness = _stiffness(surface, paths, slopes)
    return EquilibriumPosition(at, error_of, _stability(slopes), stiffness, "", shown)


def _stiffness(surface: Surface, paths: Sequence[str], slopes: Sequence[Decimal]) -> Stiffness:
    """Minus the derivatives of the generalised loads by the data (2, 2), rounded once."""
    units, frame = surface.compiled.scene.case.units, surface.compiled.scene.frame
    turns = [is_angle(path) for path in paths]
    with localcontext(CONTEXT):
        per_load = 1 / (Decimal(surface.force_scale) * Decimal(frame.scale))
        per_degree = 1 / decimal_ratio(DEGREE)
        per_torque = per_load * decimal_ratio(units.exact_torque) * per_degree
        rows = [per_torque if turn else per_load for turn in turns]
        columns = [per_degree if turn else Decimal(1) for turn in turns]
        factors = [row * column for row in rows for column in columns]
        aa, ab, ba, bb = (
            float(-v * factor) if abs(v) > NEAR else 0.0 for v, factor in zip(slopes, factors, strict=True)
        )
        least = [float(NEAR * factor) for factor in factors]
    error = max(math.ulp(v) if v else small for v, small in zip((aa, ab, ba, bb), least, strict=True))
    names = [
        [f"{units.torque if turns[i] else units.force}/{'rad' if turns[j] else units.length}" for j in (0, 1)]
        for i in (0, 1)
    ]
    return Stiffness([[aa, ab], [ba, bb]], names, error)


def _stability(slopes: Sequence[Decimal]) -> str:
    """By the eigenvalues of the symmetric part of the stiffness in the record's measure, in which rows and
    columns count alike: their signs are the same in every such measure."""
    with localcontext(CONTEXT):
        a, b, c, d = (-v if abs(v) > NEAR else Decimal(0) for v in slopes)
        square = (b + c) * (b + c) / 4
        det, least = a * d - square, NOTHING * (abs(a * d) + square)
        if a < 0 or d < 0 or det < -least:
            return "unstable"
        return "stable" if det > least else "neutral"


def _scene(surface: Surface, paths: Sequence[str], values: Sequence[float | Decimal]) -> Case:
    given = surface.given(*(np.array(float(v)) for v in values))
    at = dict(zip(paths, values, strict=True))
    return scene_in(surface.compiled, given, at, surface.places, surface.springs)


def _same(one: EquilibriumPosition, other: EquilibriumPosition) -> bool:
    """Whether two modes share a position."""
    near = all(abs(float(one.at[p]) - float(other.at[p])) <= SAME for p in one.at)  # type: ignore[arg-type]
    theirs = other.answer.points
    return near and all(math.dist(at, theirs[name]) <= SAME for name, at in one.answer.points.items())
