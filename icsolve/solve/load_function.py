"""The power of all loads in the motion of a mechanism, as a function of one number of its figure.

A figure may assemble in several ways at each value of the number: of one order of construction each choice
of the places where two loci meet is a mode, and has a function of its own. Positions of equilibrium are where
that power vanishes: the principle of virtual work.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from functools import partial

import numpy as np

from icsolve.assembly import Figure, Placement, place, solve_figure
from icsolve.assembly.conditions import CONDITIONS, ahead, parts_of, scale_of, size_of
from icsolve.assembly.loci import is_round
from icsolve.assembly.order import Order, order_of
from icsolve.assembly.refusals import OF_SIZE, allowance, compare
from icsolve.assembly.steps import Meet, PointGroup, Step
from icsolve.assembly.ways import order_that_assembles
from icsolve.assembly.workspace import Datum, Workspace, frame_of
from icsolve.case import Case, Coordinates, Number, TorsionSpring, is_angle, is_named
from icsolve.errors import SceneError, Status
from icsolve.numbers import FLOATS, Arithmetic, Scalar
from icsolve.numbers.adjoint import gradient
from icsolve.numbers.intervals import Interval
from icsolve.numbers.record import Record, varies
from icsolve.numbers.replay import Array, Code, Mask
from icsolve.numbers.roots import below_zero, last_that_holds
from icsolve.scene import refusals
from icsolve.screws import velocity
from icsolve.statics import load_wrenches, power
from icsolve.structure import topology
from icsolve.sweep.branches import may_vanish
from icsolve.sweep.drivers import Drive
from icsolve.sweep.program import (
    CLOSER,
    CompiledSweep,
    RowRequest,
    Setting,
    Signs,
    compile_sweep,
    setting_of,
    spring_angles,
    wanted_points,
)
from icsolve.sweep.record_runner import AGREED
from icsolve.sweep.recorded_scene import RecordedScene, motions_of
from icsolve.sweep.varied_numbers import number_at, points_of, with_numbers
from icsolve.tuples import NamedTuple, replace
from icsolve.wording import sentences
from icsolve.wording.joints import why_not_moved

Steps = tuple[Step, ...]

MOST_MODES = 256
MOST_EXCHANGED = 32
"""Modes of a figure that is posed by another datum than the unknown one."""
SAMPLES = 181
COARSE = 10
"""One in so many of them is tried first."""
ELSEWHERE = 40
"""Values at which another way is tried that is none where the figure is written."""
COUNTED = 1441
PARTS = (0.498, 0.13, 0.87, 0.31, 0.69, 0.05, 0.95, 0.22, 0.78, 0.41, 0.59, 0.01, 0.99)
"""Where in the range an order of construction is looked for."""
TOGETHER = "points of this figure can only all together be placed: one unknown datum alone is searched there."
APART = 1e-6
"""A point's path by the free number and by the motion agree to this fraction of its speed."""
SAME_PLACE = 1e-7
"""Two modes whose points are no farther apart (normalised) are one."""


class TogetherError(SceneError):
    """Points of a figure can only all together be placed: no function is written of them."""


class StillError(SceneError):
    """A number moves nothing in the position as written."""


class LoadFunction(NamedTuple):
    """One mode of a figure and its power on a record whose input is the free number.

    Nodes of ``record``: ``power`` (over the power of the first number's largest load, in the record's own
    scale of the motion) and its derivative by the free number, ``rate`` of the free number in that motion,
    ``margins``, none of which may be negative, ``checks``, which have to vanish, and the places of the
    points that assemble in two places.
    """

    case: Case
    path: str
    compiled: CompiledSweep
    input: int
    power: int
    slope: int
    rate: int
    margins: tuple[int, ...]
    checks: tuple[int, ...]
    places: dict[str, tuple[int, int]]
    links: list[str]
    """those that turn, the fastest first where the record was made"""
    force_scale: float
    """by what the loads were multiplied"""
    poses: bool
    """whether the motion is one along the free number, and does not leave that as it is"""
    springs: dict[str, int]
    """the angles of the torsion springs"""
    turns: tuple[Array, dict[int, Array]]
    """values of the free number, in order, and there the other inputs, by node: the angles about which turns
    are counted, and the signs of branches"""

    @property
    def turns_links(self) -> bool:
        """Whether the free number is an angle."""
        return is_angle(self.path) or self.path in self.case.links

    def given(self, values: Array) -> dict[int, Array]:
        """The inputs, by node, for values (n,) of the free datum; turns go on from the record's own."""
        at, turns = self.turns
        return {
            **{guess: np.interp(values, at, angles) for guess, angles in turns.items()},
            self.input: values,
        }

    def enclosed(self, cells: Interval) -> dict[int, Interval]:
        """The inputs, by node, over whole cells (n,) of the free datum [case units, degrees]."""
        about = self.given(0.5 * (cells.low + cells.high))
        return {k: Interval(at, at) for k, at in about.items()} | {self.input: cells}

    def meets(self, other: LoadFunction, value: float) -> bool:
        """Whether another mode has its points in the same places at a value."""
        names = [name for name in self.places if name in other.places]
        one, two = (f.told([k for p in names for k in f.places[p]], value) for f in (self, other))
        return bool(np.allclose(one, two, rtol=0.0, atol=SAME_PLACE))

    def joined(self, value: float) -> bool:
        """Whether the links that only repeat what others hold reach at a value, and data that do agree."""
        return bool(self.agrees(np.array([value]))[0])

    def may_be_read(self, between: tuple[float, float]) -> bool:
        """Whether a figure that is read anew agrees with its data about a value; of one that moves others may
        reach where these do not."""
        return self.compiled.motion is not None or self.joined(0.5 * (between[0] + between[1]))

    def agrees(self, values: Array) -> Mask:
        """The same at values, (n,)."""
        found = Code(self.record, self.checks).run(self.given(values), len(values)) if self.checks else ()
        agreed = [np.broadcast_to(np.abs(off) <= AGREED, len(values)) for off in found]
        return np.logical_and.reduce(agreed) if agreed else np.ones(len(values), dtype=bool)

    def told(self, nodes: Sequence[int], value: float) -> Array:
        """Nodes (n,) at one value."""
        found = Code(self.record, list(nodes)).run(self.given(np.array([value])), 1)
        return np.array([float(np.ravel(v)[0]) for v in found])

    @property
    def record(self) -> Record:
        """The record of the mode."""
        return self.compiled.record


def load_functions(
    case: Case, path: str, low: float, high: float, whole: bool = False
) -> tuple[list[LoadFunction], bool]:
    """The functions of all modes that assemble somewhere between two values of the number at ``path``;
    whether every mode is among them.

    Raises SceneError where no value gives a figure, or the mechanism has not one freedom; TogetherError,
    where it is to be ``whole``, for more modes than are looked at.
    """
    refusals.refuse_loose(case)
    values = [low + (high - low) * (k + 0.37) / SAMPLES for k in range(SAMPLES)]
    refused: list[SceneError] = []
    found: list[LoadFunction] = []
    order = order_of_all(given_at(case, path, low + part * (high - low)) for part in PARTS)
    refuse_together(order)
    if whole and 1 << len(_forks(order.steps)) > MOST_EXCHANGED:
        raise TogetherError(Status.UNSUPPORTED, TOGETHER)
    count = 0
    counts = any(isinstance(load, TorsionSpring) for load in case.loads)
    span = (low, high)
    middle = 0.5 * (low + high)
    for steps in modes_of(order.steps):
        count += 1
        if count > MOST_MODES:
            return found, False
        samples = _assembling(case, path, order, steps, values, every=counts)
        if counts:  # a torsion spring's angle is counted from the middle of the range
            samples.sort(key=lambda value: abs(value - middle))
        for value in (*samples[:3], *samples[3::16]):  # somewhere else than where a load has no direction
            written = given_at(case, path, value)
            try:
                found.append(_function(written, path, figure_in(written, order, steps), order, span))
            except (SceneError, ZeroDivisionError) as error:
                refused += [error] if isinstance(error, SceneError) else []
                continue
            break
    if not found and refused:  # last for points that coincide, as in a mode that nobody means
        raise min(refused, key=lambda error: error.status == Status.INCONSISTENT)
    if not found:
        raise SceneError(
            Status.CANNOT_ASSEMBLE,
            f"the figure assembles for no value of {path} between {low:g} and {high:g}.",
        )
    return found, True


def order_of_all(cases: Iterable[Case]) -> Order:
    """The order of construction of all points, or where some may be anywhere, of those that are needed: in
    the first of some positions in which the figure assembles, else in the first of all.
    """
    first, *others = (replace(case, near={}) for case in cases)

    for case in (first, *others):
        with suppress(SceneError):
            return _order_of_all(case, order_that_assembles)
    return _order_of_all(first, order_of)


def _order_of_all(case: Case, order: Callable[[Case, list[str]], Order]) -> Order:
    wanted, needed = wanted_points(case)
    try:
        return order(case, wanted)
    except SceneError as error:
        if error.status != Status.UNDERDETERMINED:
            raise
        return order(case, needed)


EVEN = 0.99
"""Two branches whose distances from `near` have at least this ratio are about equally near."""


def nearest(case: Case, off: Sequence[float], rough: float = 0.0) -> int:
    """Which of some branches, so far from `near` each [case units], is meant; within ``rough`` of it all are
    equally near.

    Raises SceneError where two are about equally near.
    """
    order = sorted(range(len(off)), key=lambda n: off[n])
    if len(order) > 1 and max(off[order[0]], rough) >= EVEN * max(off[order[1]], rough):
        more = ", or give near for more points of one position" if rough else ""
        raise SceneError(
            Status.AMBIGUOUS,
            f"two branches of the figure pass about equally near to near ({off[order[0]]:.4g} and "
            f"{off[order[1]]:.4g} {case.units.length} from it): move near toward the one that is meant"
            f"{more}.",
        )
    return order[0]


def given_at(case: Case, path: str, value: float | Number) -> Case:
    """The case with its free datum at a value, as if written so."""
    section, name, *part = path.split(".")
    at = case.points.get(name)
    if section != "points" or not isinstance(at, Coordinates):
        return with_numbers(case, {path: value})
    number = value if isinstance(value, Number) else Number(value, 0.0, path, repr(value))
    placed = at._replace(x=number) if part == ["x"] else at._replace(y=number)
    return replace(case, points={**case.points, name: placed})


def refuse_together(order: Order) -> None:
    """Refuse points that have places only all together."""
    if any(isinstance(step, PointGroup) for step in order.steps):
        raise TogetherError(Status.UNSUPPORTED, TOGETHER)


def _forks(steps: Steps) -> list[int]:
    """The steps at which two loci meet in two places."""
    meets = ((k, step) for k, step in enumerate(steps) if isinstance(step, Meet) and is_round(step.second))
    return [k for k, step in meets if not step.stays_flat]


def modes_of(steps: Steps) -> Iterator[Steps]:
    """The steps with every choice of the places where two loci meet."""
    forks = _forks(steps)
    for signs in itertools.product((1, -1), repeat=len(forks)):
        mode = list(steps)
        for k, sign in zip(forks, signs, strict=True):
            step = mode[k]
            assert isinstance(step, Meet)
            mode[k] = step._replace(sign=sign)
        yield tuple(mode)


def _assembling(
    case: Case, path: str, order: Order, steps: Steps, values: list[float], *, every: bool
) -> list[float]:
    """Of the sampled values at which a mode assembles, those farthest from its limits first: of few, or of
    ``every`` one, as where it assembles at none of the few; where at none at all, some of a stretch between
    them over which it does, where it comes nearest to it."""

    def short(value: float) -> float:
        return -clearance(given_at(case, path, value), order, steps)

    off: list[float] = []
    for some in (values,) if every else (values[COARSE // 2 :: COARSE], values):
        off = [short(value) for value in some]
        if found := [value for least, value in sorted(zip(off, some, strict=True)) if least < 0.0]:
            return found
    near = [k for k in range(1, len(off) - 1) if off[k - 1] > off[k] <= off[k + 1]]
    for k in near:
        value = below_zero(short, values[k - 1], values[k + 1])
        if value is not None:
            a, b = (last_that_holds(lambda x: short(x) < 0.0, value, values[n])[0] for n in (k - 1, k + 1))
            return [a + part * (b - a) for part in PARTS]
    return []


def clearance(case: Case, order: Order, steps: Steps) -> float:
    """How far a mode is from its limits [frame]; zero or less where it does not assemble, or not so that the
    points meet the data that no step needed."""
    figure = Figure(frame_of(case), {}, steps)
    try:
        placed, margins = placed_with_margins(figure, order, case)
    except (ZeroDivisionError, ValueError, SceneError):
        return 0.0
    least = min((float(margin) for margin in margins), default=1.0)
    spare = _unneeded(order, placed.points)
    if least > 0.0 and spare:
        workspace = Workspace(case, figure.frame, FLOATS)
        workspace.points.update(placed.points)
        miss, _ = compare(workspace, steps, spare, size_of(workspace, order.points))
        return 0.0 if miss else least
    return least


def placed_with_margins(
    figure: Figure, order: Order, case: Case, arithmetic: Arithmetic = FLOATS
) -> tuple[Placement, list[Scalar]]:
    """The points of a mode, and what must not be negative: the gaps of its loci, and how far the arms of
    angles of which no step takes the sense point the right way [frame]."""
    placed = place(figure, case, arithmetic)
    workspace = Workspace(case, figure.frame, arithmetic)
    workspace.points.update(placed.points)
    senses = [ahead(workspace, datum) for datum in order.either_sense()]
    return placed, [*(margin for step in placed.margins.values() for margin in step), *senses]


def figure_in(case: Case, order: Order, steps: Steps) -> Figure:
    """The figure of a case in a mode in which it assembles."""
    figure = Figure(frame_of(case), {}, steps)
    placed, _ = placed_with_margins(figure, order, case)
    return figure._replace(points={p: placed.points[p] for p in order.points})


class RecordedMode(NamedTuple):
    """One mode of a figure on a record by its free numbers, the nodes that must not be negative, and those
    that are small (`AGREED`) where the figure meets the data that no step needed."""

    compiled: CompiledSweep
    margins: list[int]
    checks: tuple[int, ...]

    @property
    def assembles(self) -> bool:
        """Whether it does where the record was made."""
        return all(self.compiled.record.nodes[margin].value > 0.0 for margin in self.margins)


def read_anew(case: Case, paths: Sequence[str], figure: Figure, order: Order) -> RecordedMode:
    """A mode of a figure that is read anew at all values of some numbers; recorded where it assembles, also
    where it does so over a narrow stretch alone."""
    setting = Setting(case, topology(case), figure, tuple(paths), (), Drive((), (), ()))
    usual = _recorded(setting, order)
    closer = (_recorded(setting, order, away) for away in CLOSER)
    return next((mode for mode in itertools.chain([usual], closer) if mode.assembles), usual)


def _recorded(setting: Setting, order: Order, away: float | None = None) -> RecordedMode:
    case, figure = setting.case, setting.figure
    compiled = compile_sweep(setting, RowRequest(answers=False), away=away)
    placed, margins = placed_with_margins(figure, order, case, compiled.record)
    nodes = [compiled.record.lifted(margin).index for margin in margins if varies(margin)]
    return RecordedMode(compiled, nodes, tuple(_spare(figure, order, case, placed, compiled.record)))


def _unneeded(order: Order, points: Collection[object]) -> list[Datum]:
    """The data of some points that no step of their construction needs."""
    return [d for d in order.facts.data if d not in order.used and all(p in points for p in d.points)]


def _spare(figure: Figure, order: Order, case: Case, placed: Placement, record: Record) -> Iterator[int]:
    """By how much the data that no step needed are missed, over what their last digits allow."""
    here, on_record = (Workspace(case, figure.frame, arithmetic) for arithmetic in (FLOATS, record))
    here.points.update(figure.points)
    on_record.points.update(placed.points)
    for datum in _unneeded(order, here.points):
        size, _ = scale_of(here, datum)
        room = min(allowance(here, figure.steps, datum), OF_SIZE * size_of(here, order.points))
        for part in parts_of(datum):
            off = CONDITIONS[datum.kind](on_record, datum, part).value
            if varies(off):
                yield record.lifted(off * (AGREED / (max(room, AGREED) * (size or 1.0)))).index


def moved(setting: Setting, signs: Signs = (), away: float | None = None) -> RecordedMode:
    """A mode in which the mechanism moves from the position as written, with the signs of some branches;
    ``away`` as of `compile_sweep`.

    Raises TogetherError where points only all together have places.
    """
    compiled = compile_sweep(setting, RowRequest(answers=False), signs, away)
    if compiled.motion is not None and compiled.motion.groups:
        raise TogetherError(Status.UNSUPPORTED, TOGETHER)
    margins = [n for root in compiled.record.roots.values() for n, _ in root.margins]
    return RecordedMode(compiled, margins, compiled.motion.checks if compiled.motion is not None else ())


def moving_function(
    case: Case, path: str = "", link: str = "", span: tuple[float, float] | None = None, posing: bool = False
) -> LoadFunction:
    """The function of a mechanism that moves from the position as written, by a datum or by turning a link
    (its input is then in degrees from that position); ``span`` has the values that will be asked for,
    ``posing`` says that the datum is known to pose the figure.

    Raises SceneError where it cannot be moved so, or has not one freedom.
    """
    setting = setting_of(case, (path,) if path else (), (link,) if link else (), posing=posing)
    if path and not setting.moves:
        try:
            motions_of(moved(setting).compiled.scene)
        except SceneError as error:
            if error.status == Status.STRUCTURE:  # tells which joints hold all
                raise StillError(error.status, error.message, error.more) from None
        held = next((joint for joint in case.joints if not joint.stays_known), None)
        moves_nothing = sentences.poses_nothing(path)
        raise StillError(Status.UNSUPPORTED, why_not_moved(held) if held is not None else moves_nothing)
    return _on_record(moved(setting), path or link, span)


def with_other_ways(function: LoadFunction, span: tuple[float, float]) -> list[LoadFunction]:
    """The function of a mechanism that moves, and those of the other ways in which its links assemble that it
    may come to over a range: through change points, or at its limits."""
    found: list[tuple[LoadFunction, Signs]] = [(function, ())]
    values = np.linspace(*span, COUNTED)
    for one, signs in found:  # which grows
        motion = one.compiled.motion
        assert motion is not None
        roots = [root for root in one.record.roots.values() if root.node in motion.branches]
        radicands = Code(one.record, [root.radicand for root in roots]).run(one.given(values), len(values))
        for root, radicand in zip(roots, radicands, strict=True):
            name = motion.branches[root.node]
            others = {**dict(signs), name: -dict(signs).get(name, motion.written[name])}
            beyond = tuple(sorted(pair for pair in others.items() if pair[1] != motion.written[pair[0]]))
            met = may_vanish(radicand) and beyond not in (known for _, known in found)
            if met and len(found) < MOST_MODES:
                other = _other_way(one, beyond, span)
                found += [(other, beyond)] if other is not None else []
    return [one for one, _ in found]


def _other_way(function: LoadFunction, signs: Signs, span: tuple[float, float]) -> LoadFunction | None:
    """The function of another way; None where there is none. Links that repeat what others hold may meet in
    it beyond the change point only: its record is then made there."""
    compiled = function.compiled
    values = np.linspace(*span, ELSEWHERE) if not compiled.record.counted else ()
    size = 180.0 if function.turns_links else 1.0 / compiled.setting.figure.frame.scale
    written = 0.0 if function.path in function.case.links else number_at(function.case, function.path).value
    for away in (None, *((float(value) - written) / size for value in values)):
        with suppress(SceneError):  # a load may have no direction in it
            return _on_record(moved(compiled.setting, signs, away), function.path, span)
    return None


def written_function(case: Case, path: str, span: tuple[float, float] | None) -> LoadFunction:
    """The function of a case as it is written, each value read anew, in the mode in which it is."""
    figure = solve_figure(case, wanted_points(case)[1])
    order = replace(order_of(case, figure.points), steps=figure.steps)
    return _function(case, path, figure, order, span)


def _function(
    case: Case, path: str, figure: Figure, order: Order, span: tuple[float, float] | None
) -> LoadFunction:
    return _on_record(read_anew(case, (path,), figure, order), path, span)


def _on_record(mode: RecordedMode, path: str, span: tuple[float, float] | None) -> LoadFunction:
    """The power of the loads on a record that has the figure, by its one input."""
    compiled, margins, checks = mode
    record, scene, given = compiled.record, compiled.scene, compiled.inputs[path]
    record.follows = True  # also where each position is read anew: turns count from one of them
    recorded = {p: (record.lifted(x).value, record.lifted(y).value) for p, (x, y) in scene.points.items()}
    refusals.refuse_no_direction(refusals.directions(compiled.setting.case), recorded, FLOATS)
    motions = motions_of(scene)
    if motions.mobility != 1:
        raise SceneError(
            Status.MOBILITY,
            f"the mechanism has {motions.mobility} degrees of freedom, and one datum is unknown: "
            f"write 'unknown' for {motions.mobility - 1} more of its angles or lengths.",
        )
    wrenches = load_wrenches.wrenches(scene.place, vectors=True)
    balance = power.balance(wrenches, motions.twists, 1)
    total = power.known_power(balance, 0, record)
    if path in scene.case.links:  # turned by degrees, whether a point moves with it or none
        rate, poses = math.degrees(1.0) * motions.twists[path][0][2], True
    else:
        rate, poses = _rate(scene, motions.twists, given)
    slope = gradient(record, total, (given,))[given]
    return LoadFunction(
        compiled.setting.case,
        path,
        compiled,
        given,
        record.lifted(total).index,
        record.lifted(slope).index,
        record.lifted(rate).index,
        tuple(margins),
        checks,
        places_on(compiled),
        _turning(motions.twists),
        power.force_scale(balance),
        poses,
        {name: record.lifted(angle).index for name, angle in spring_angles(scene).items()},
        _turns(record, given, set(compiled.inputs.values()) - {given}, span),
    )


def places_on(compiled: CompiledSweep) -> dict[str, tuple[int, int]]:
    """The nodes of the points of a figure that are named."""
    record, scene = compiled.record, compiled.scene
    named = {p: scene.points[p] for p in compiled.setting.figure.points if is_named(p)}
    return {p: (record.lifted(x).index, record.lifted(y).index) for p, (x, y) in named.items()}


def _turns(
    record: Record, given: int, others: Iterable[int], span: tuple[float, float] | None
) -> tuple[Array, dict[int, Array]]:
    """The counted angles over a range of the free number, going on from where it was recorded; other inputs
    as they were recorded."""
    written = record.nodes[given].value
    low, high = span or (written, written)
    values = np.union1d(np.linspace(min(low, written), max(high, written), COUNTED), [written])
    own = int(np.searchsorted(values, written))
    found = {node: np.full(values.shape, record.nodes[node].value) for node in others}
    for angle, (guess, _) in record.counted.items():
        (here,) = Code(record, [angle]).run({**found, given: values}, len(values))
        turned = np.unwrap(np.broadcast_to(here, values.shape), period=360.0)
        found[guess.index] = turned + (guess.value - turned[own])
    return values, found


@contextmanager
def naming_uncarried(case: Case, paths: Sequence[str]) -> Iterator[None]:
    """Refusals of data that pose nothing say which of their points are of no link."""
    try:
        yield
    except SceneError as refusal:
        figure = (path for path in paths if path.startswith(("angles.", "lengths.", "points.")))
        points = dict.fromkeys(point for path in figure for point in points_of(path))
        said = sentences.uncarried(case, points)
        if not said or refusal.status not in (Status.UNSUPPORTED, Status.UNDERDETERMINED):
            raise
        message = f"{refusal.message.rstrip('.')}. {said[0].upper()}{said[1:]}"
        raise SceneError(refusal.status, message, refusal.more) from None


def refuse_unposed(function: LoadFunction, sought: bool = True) -> None:
    """Refuse a number that the motion of the mechanism does not change; ``sought``: its value is to find."""
    if not function.poses:
        said = sentences.poses_nothing(function.path, moves=True, sought=sought)
        raise SceneError(Status.UNSUPPORTED, said)


def _turning(twists: Mapping[str, tuple[tuple[Scalar, Scalar, Scalar], ...]]) -> list[str]:
    rates = {link: abs(ts[0][2]) for link, ts in twists.items()}
    return sorted((link for link, rate in rates.items() if rate > 0.0), key=lambda link: -rates[link])


def bearers(case: Case) -> dict[str, list[str]]:
    """The links with which every point goes: those of its joints, and not one on whose guide it runs."""
    carriers: dict[str, list[str]] = {}
    for link in case.links:
        for name in case.carries.get(link, ()):
            carriers.setdefault(name, []).append(link)
    own: dict[str, list[str]] = {}
    for joint in case.joints:
        pairs = joint.carried[:1] if joint.guide is not None else joint.carried
        for link, name in pairs:
            own.setdefault(name, []).append(link)
    return carriers | own


def _rate(
    scene: RecordedScene, twists: Mapping[str, tuple[tuple[Scalar, Scalar, Scalar], ...]], given: int
) -> tuple[Scalar, bool]:
    """The rate of the free number in the motion: that with which the points go along their paths, over how
    far they go along them for each unit of the number; and whether all points go along such paths.

    All of them count, each by the square of that: one alone may stand still in some position.
    """
    case, record = scene.case, scene.record
    best: tuple[float, float] = (0.0, 0.0)
    ways: list[tuple[tuple[Scalar, Scalar], list[tuple[Scalar, Scalar]]]] = []
    for name, links in bearers(case).items():
        if name not in scene.points or not is_named(name):
            continue
        x, y = scene.points[name]
        dx, dy = gradient(record, x, (given,))[given], gradient(record, y, (given,))[given]
        on = [velocity(twists[link][0], (x, y)) for link in links]
        ways.append(((dx, dy), on))
        square = float(dx * dx + dy * dy)
        if square > 4.0 * best[0]:
            # where links roll or slip on one another a point goes with neither, or with one of them
            vx, vy = min(on, key=lambda v: abs(float(v[0] * dy - v[1] * dx)))
            best = (square, float(vx * dx + vy * dy) / square)

    def off(way: tuple[Scalar, Scalar], v: tuple[Scalar, Scalar]) -> float:
        return math.hypot(float(v[0] - best[1] * way[0]), float(v[1] - best[1] * way[1]))

    fastest = max((abs(float(c)) for _, on in ways for v in on for c in v), default=0.0)
    speed: Scalar = 0.0
    squares: Scalar = 0.0
    poses = True
    for way, on in ways:
        going = min(on, key=partial(off, way))
        if off(way, going) > APART * fastest:
            poses = False
        else:
            speed = speed + going[0] * way[0] + going[1] * way[1]
            squares = squares + way[0] * way[0] + way[1] * way[1]
    return (speed / squares if float(squares) else 0.0), poses


__all__ = ["LoadFunction", "load_functions"]
