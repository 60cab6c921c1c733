"""Positions of equilibrium of a mechanism with two freedoms: two data of its figure are what is asked.

The powers of the loads in both motions vanish together. Newton's method runs from a grid over both ranges and
from the cells of a finer one in which both change their signs, all starts at once; what was searched is said,
since no enclosure shows that nothing was missed.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from icsolve.answer.equilibrium import EquilibriumPosition, Stiffness
from icsolve.assembly.modes import ways_of
from icsolve.case import Case, Load, TorsionSpring, is_angle, is_named
from icsolve.errors import SceneError, Status
from icsolve.numbers.adjoint import gradient
from icsolve.numbers.intervals import Interval, enclose
from icsolve.numbers.replay import Array, Code
from icsolve.scene import solve_scene
from icsolve.screws.plane import velocity
from icsolve.solve.branches import nearest
from icsolve.solve.load_function import (
    PARTS,
    RecordedMode,
    bearers,
    clearance,
    figure_in,
    given_at,
    modes_of,
    moved,
    order_of_all,
    places_on,
    read_anew,
    refuse_together,
)
from icsolve.solve.positions import refuse_ropes, refuse_unwritten, whole_range
from icsolve.solve.rest import held, with_scene
from icsolve.solve.settled import DEGREES, scene_in, within_a_turn
from icsolve.statics import load_wrenches, power
from icsolve.sweep.program import CompiledSweep, setting_of
from icsolve.sweep.recorded_scene import motions_of
from icsolve.tuples import NamedTuple, replace

GRID = 48
FINE = 257
BLOCK = 4096
STEPS = 40
SAME = 1e-7
NUDGE = 1e-6
"""Derivatives are differences over this fraction of a range."""

Span = tuple[float, float]


class Surface(NamedTuple):
    """One mode on a record with two inputs: nodes of the powers (2), of their derivatives by the inputs
    (2, 2), of each coordinate's derivatives by the inputs (2) and speeds in the motions (2), of the margins,
    and of the points."""

    compiled: CompiledSweep
    inputs: tuple[int, int]
    powers: list[int]
    slopes: list[int]
    velocities: list[int]
    margins: list[int]
    places: dict[str, tuple[int, int]]
    force_scale: float
    links: list[str]
    """those that turn"""


class FoundPairs(NamedTuple):
    """Positions by rising values of the first datum, and what was searched."""

    positions: tuple[EquilibriumPosition, ...]
    notes: tuple[str, ...]


def find_pairs(
    case: Case,
    paths: Sequence[str],
    spans: Sequence[Span | None],
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
        surfaces = [surfaces[nearest(case, [_distance(surface, case, limits) for surface in surfaces])]]
    turning = [span is None and is_angle(path) for span, path in zip(spans, paths, strict=True)]
    found: list[EquilibriumPosition] = []
    for surface in surfaces:
        for values in _zeros(surface, limits, turning):
            position = _described(surface, paths, values, limits, turning, asked)
            if position is not None and not any(_same(position, other) for other in found):
                found.append(position)
    found.sort(key=lambda one: [float(one.at[path]) for path in paths])  # type: ignore[arg-type]
    where = " and ".join(f"{p} from {a:g} to {b:g}" for p, (a, b) in zip(paths, limits, strict=True))
    note = (
        f"{where} were searched by Newton's method from {GRID} x {GRID} starts in each way of assembling, "
        f"and from the cells of {FINE - 1} x {FINE - 1} in which both loads change their signs."
    )
    return FoundPairs(tuple(found), (note,))


def _surfaces(
    case: Case, paths: Sequence[str], limits: Sequence[Span], starts: Sequence[float]
) -> list[Surface]:
    """The modes of the figure: each read anew at all values, or moved from where the figure is written."""
    if starts:
        written = _at(case, paths, starts)
        ways = [replace(written, near=way.near) for way in ways_of(written).ways]
        return [_surface(moved(setting_of(way, paths, (), posing=True)), paths) for way in ways]
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
                surfaces.append(_surface(read_anew(written, paths, figure, order), paths))
            except (SceneError, ZeroDivisionError, ValueError) as error:
                refusal = error if isinstance(error, SceneError) else refusal
                if refusal is not None and refusal.status == Status.MOBILITY:
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


def _surface(mode: RecordedMode, paths: Sequence[str]) -> Surface:
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
    balance = power.balance(load_wrenches.wrenches(scene.place, vectors=True), motions.twists, 2)
    totals = [power.known_power(balance, m, record) for m in (0, 1)]
    slopes = [v for total in totals for v in gradient(record, total, inputs).values()]
    velocities = []
    for name, (link, *_) in bearers(case).items():
        if name in scene.points and is_named(name):
            for axis in (0, 1):
                velocities += list(gradient(record, scene.points[name][axis], inputs).values())
                velocities += [velocity(motions.twists[link][m], scene.points[name])[axis] for m in (0, 1)]
    powers, by_data, rates = ([record.lifted(v).index for v in some] for some in (totals, slopes, velocities))
    links = [link for link, ts in motions.twists.items() if any(float(t[2]) for t in ts)]
    scale = power.force_scale(balance)
    places = places_on(compiled)
    return Surface(compiled, inputs, powers, by_data, rates, mode.margins, places, scale, links)


def _distance(surface: Surface, case: Case, limits: Sequence[Span]) -> float:
    """How near a mode passes to `near` over the grid."""
    x, y = _grid(limits)
    names = [name for name in case.near if name in surface.places]
    nodes = [k for name in names for k in surface.places[name]]
    ox, oy, scale = surface.compiled.scene.frame
    found = Code(surface.compiled.record, [*nodes, *surface.margins]).run(
        dict(zip(surface.inputs, (x, y), strict=True)), x.size
    )
    off = np.zeros(x.size)
    for n, name in enumerate(names):
        px, py = found[2 * n] / scale + ox, found[2 * n + 1] / scale + oy
        off = off + (px - case.near[name][0]) ** 2 + (py - case.near[name][1]) ** 2
    for margin in found[len(nodes) :]:
        off = np.where(margin > 0.0, off, np.inf)
    return float(off.min())


def _grid(limits: Sequence[Span]) -> tuple[Array, Array]:
    axes = [np.linspace(a, b, GRID) + (b - a) / GRID * 0.013 for a, b in limits]
    x, y = np.meshgrid(*axes, indexing="ij")
    return x.ravel(), y.ravel()


def _starts(surface: Surface, limits: Sequence[Span]) -> tuple[Array, Array]:
    """Where Newton's method starts: a grid over both ranges, and the cells of a finer one in which both
    powers change their signs, or the figure ceases to assemble."""
    code = Code(surface.compiled.record, [*surface.powers, *surface.margins])
    axes = np.meshgrid(*(np.linspace(*ends, FINE) for ends in limits), indexing="ij")
    x, y = (axis.ravel() for axis in axes)
    blocks = []
    for k in range(0, x.size, BLOCK):
        given = dict(zip(surface.inputs, (x[k : k + BLOCK], y[k : k + BLOCK]), strict=True))
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


def _zeros(surface: Surface, limits: Sequence[Span], turning: Sequence[bool]) -> list[tuple[float, float]]:
    """Newton's method from every start of the grid at once; ``turning``: which are searched over a turn."""
    code = Code(surface.compiled.record, [*surface.powers, *surface.slopes, *surface.margins])
    x, y = _starts(surface, limits)
    size = np.array([b - a for a, b in limits])
    with np.errstate(all="ignore"):
        for _ in range(STEPS):
            f, g, fx, fy, gx, gy, *_ = code.run(dict(zip(surface.inputs, (x, y), strict=True)), x.size)
            det = fx * gy - fy * gx
            dx, dy = (f * gy - g * fy) / det, (g * fx - f * gx) / det
            short = np.minimum(1.0, 0.1 / np.maximum(np.abs(dx) / size[0], np.abs(dy) / size[1]))
            step = np.nan_to_num(np.stack([dx * short, dy * short]))
            x, y = x - step[0], y - step[1]
        f, g, fx, fy, gx, gy, *margins = (
            np.array(np.broadcast_to(v, x.size))
            for v in code.run(dict(zip(surface.inputs, (x, y), strict=True)), x.size)
        )
        fine = (np.abs(step[0]) <= 1e-11 * size[0]) & (np.abs(step[1]) <= 1e-11 * size[1])
        fine &= np.isfinite(f + g) & (np.abs(fx * gy - fy * gx) > 0.0)
        for margin in margins:
            fine &= margin > 0.0
    found: list[tuple[float, float]] = []
    for pair in zip(x[fine].tolist(), y[fine].tolist(), strict=True):
        values = [v % 360.0 if turns else v for v, turns in zip(pair, turning, strict=True)]
        inside = all(
            a - 1e-9 * s <= v <= b + 1e-9 * s for v, (a, b), s in zip(values, limits, size, strict=True)
        )
        if inside and not any(
            max(abs(p - q) for p, q in zip(values, other, strict=True)) <= SAME for other in found
        ):
            found.append((values[0], values[1]))
    return found


def _described(
    surface: Surface,
    paths: Sequence[str],
    values: tuple[float, float],
    limits: Sequence[Span],
    turning: Sequence[bool],
    asked: Mapping[str, bool],
) -> EquilibriumPosition | None:
    """A position to the last digits, with its stiffness matrix and stability; None where it turns out to lie
    beyond the limits."""
    found, off = _to_the_last_digits(surface, paths, values, limits)
    x, y = (within_a_turn(v, e) if turns else v for v, e, turns in zip(found, off, turning, strict=True))
    if any(not a - e <= v <= b + e for v, e, (a, b) in zip((x, y), off, limits, strict=True)):
        return None
    x, y = (min(max(v, a), b) for v, (a, b) in zip((x, y), limits, strict=True))
    values = (x, y)
    loads, spread = _derivatives(surface, values, off)
    case, frame = surface.compiled.setting.case, surface.compiled.scene.frame
    turns = [is_angle(path) for path in paths]
    rows = np.array([DEGREES * case.units.torque_per_force_length if turn else 1.0 for turn in turns])
    scales = np.outer(rows, [DEGREES if turn else 1.0 for turn in turns]) / (
        surface.force_scale * frame.scale
    )
    matrix, errors = -scales * loads, scales * spread
    units = case.units
    names = [
        [f"{units.torque if turns[i] else units.force}/{'rad' if turns[j] else units.length}" for j in (0, 1)]
        for i in (0, 1)
    ]
    least = float(np.linalg.eigvalsh(0.5 * (matrix + matrix.T))[0])
    error = float(np.linalg.norm(errors))
    kind = "unstable" if least < -error else "stable" if least > error else "neutral"
    stiffness = Stiffness(matrix.tolist(), names, float(errors.max()))
    scene = solve_scene(_scene(surface, paths, values))
    shown = with_scene(scene, surface.links, 2, **asked)
    at, error_of = (dict(zip(paths, pair, strict=True)) for pair in (values, off))
    return EquilibriumPosition(at, error_of, kind, stiffness, "", shown)


def _derivatives(surface: Surface, values: Sequence[float], off: Sequence[float]) -> tuple[Any, Any]:
    """Derivatives of the generalised loads by the data (2, 2) in the record's scale, and bounds of their
    errors to first order, from enclosures over all that the position may be."""
    boxes = {
        k: Interval(np.array([v - e]), np.array([v + e]))
        for k, v, e in zip(surface.inputs, values, off, strict=True)
    }
    ends = enclose(surface.compiled.record, [*surface.slopes, *surface.velocities], boxes)
    low, high = (np.array([float(np.ravel(end)[0]) for end in side]) for side in zip(*ends, strict=True))
    middle, wide = 0.5 * (low + high), 0.5 * (high - low)
    slopes, off_slopes = (flat[:4].reshape(2, 2) for flat in (middle, wide))  # (motion, datum)
    rows, off_rows = (flat[4:].reshape(-1, 4) for flat in (middle, wide))  # by both data, in both motions
    by_speed = np.linalg.pinv(rows[:, :2])
    rates = (by_speed @ rows[:, 2:]).T  # of the data (motion, datum)
    off_rates = (np.abs(by_speed) @ (off_rows[:, 2:] + off_rows[:, :2] @ np.abs(rates.T))).T
    inverse = np.linalg.inv(rates)
    loads = inverse @ slopes
    return loads, 2.0 * np.abs(inverse) @ (off_slopes + off_rates @ np.abs(loads))


def _scene(surface: Surface, paths: Sequence[str], values: Sequence[float]) -> Case:
    given = {k: np.array(v) for k, v in zip(surface.inputs, values, strict=True)}
    return scene_in(surface.compiled, given, dict(zip(paths, values, strict=True)), surface.places, {})


def _to_the_last_digits(
    surface: Surface, paths: Sequence[str], values: tuple[float, float], limits: Sequence[Span]
) -> tuple[tuple[float, float], tuple[float, float]]:
    """The place at which two loads that would hold the mechanism vanish, and bounds of its errors: last steps
    of Newton's method on their values, as `icsolve.solve` finds these to the last digit."""
    probes: list[Load] = []

    def holding(x: float, y: float) -> tuple[Any, Any]:
        case = _scene(surface, paths, (x, y))
        if not probes:
            answer = held(case, surface.links, 2)
            assert answer is not None
            probes.extend(answer.case.loads[len(case.loads) :])
        found = solve_scene(replace(case, loads=(*case.loads, *probes))).answers.values()
        return np.array([a.value for a in found]), np.array([a.error or 0.0 for a in found])

    x, y = values
    here, _ = holding(x, y)

    def change(dx: float, dy: float) -> Any:
        try:
            return holding(x + dx, y + dy)[0] - here
        except SceneError:  # beyond a limit of the figure
            return here - holding(x - dx, y - dy)[0]

    h, k = (NUDGE * (high - low) for low, high in limits)
    inverse = np.linalg.inv(np.stack([change(h, 0.0) / h, change(0.0, k) / k], axis=1))
    for _ in range(4):
        dx, dy = (inverse @ here).tolist()
        x, y = x - dx, y - dy
        here, off = holding(x, y)
        if not here.any():
            break
    least = [math.ulp(high - low) for low, high in limits]
    plain = [0.0 if abs(v) <= e else v for v, e in zip((x, y), least, strict=True)]
    if plain != [x, y]:  # near 0 doubles are closer than digits tell apart
        there, spread = holding(*plain)
        if (np.abs(there) <= np.abs(here) + off).all():
            (x, y), here, off = plain, there, spread
    reach = 2.0 * np.abs(inverse) @ (np.abs(here) + off)
    return (x, y), (float(reach[0]) + math.ulp(x), float(reach[1]) + math.ulp(y))


def _same(one: EquilibriumPosition, other: EquilibriumPosition) -> bool:
    """Whether two modes share a position."""
    near = all(abs(float(one.at[p]) - float(other.at[p])) <= SAME for p in one.at)  # type: ignore[arg-type]
    theirs = other.answer.points
    return near and all(math.dist(at, theirs[name]) <= SAME for name, at in one.answer.points.items())
