"""The program of a sweep: a case and what is varied become one record, made once for any number of rows.

First the position as written, then the drivers and the order in which the links assemble, then statics,
rates and centres: each with the kernels that one scene has.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from contextlib import suppress

from icsolve.assembly import Figure, Placement, place, placed_figure
from icsolve.assembly.conditions import ahead
from icsolve.assembly.driven.constraints import Constraint, Turning
from icsolve.assembly.driven.groups import LIMIT_AS_WRITTEN
from icsolve.assembly.driven.mechanism import Mechanism, mechanism, placed_late
from icsolve.assembly.driven.motion import DrivenMotion, closing_of, set_moving
from icsolve.assembly.steps import Meet, Polar, spare_data
from icsolve.assembly.wheels import refuse_misfit, wheel_margins
from icsolve.assembly.workspace import CORNER, RAY, PlacedCase, data_in, datum_at, number_of
from icsolve.case import Case, Pair, TorsionSpring, is_angle, pair_name, spot_name
from icsolve.errors import SceneError, Status
from icsolve.kinematics.motion import by_loops
from icsolve.kinematics.speeds import speed_of
from icsolve.numbers import FLOATS, Scalar
from icsolve.numbers.adjoint import BoundedRecord
from icsolve.numbers.record import Record, Root, Traced, live, varies
from icsolve.scene import refusals
from icsolve.scene.needed_part import by_needed_part
from icsolve.screws import Point
from icsolve.screws.ropes import part_rooms
from icsolve.statics.load_wrenches import counted_about, moving_links, points_of, spring_angle
from icsolve.statics.power import has_friction
from icsolve.structure import Topology, topology
from icsolve.sweep.drivers import (
    Drive,
    Pose,
    ahead_on,
    closed_drive,
    condition,
    drive_of,
    pose_of,
    turning,
    turns_links,
)
from icsolve.sweep.friction_rows import FrictionRows, rubbing
from icsolve.sweep.recorded_scene import (
    RecordedScene,
    RecordedStatics,
    RestingContact,
    centres,
    link_accelerations,
    motion_fits,
    moved_scene,
    point_accelerations,
    pressing,
    rates,
    rested,
    statics,
    unit_powers,
    velocities,
)
from icsolve.sweep.varied_numbers import find_number, number_at, with_numbers
from icsolve.tuples import NamedTuple
from icsolve.wording import listed

Signs = tuple[tuple[str, float], ...]
"""Branches whose sign is an input, with their sign as written."""


class RowRequest(NamedTuple):
    """What is asked of every row."""

    answers: bool = True
    points: tuple[str, ...] = ()
    centres: tuple[Pair, ...] = ()
    rates: bool = False
    velocities: bool = False
    accelerations: bool = False
    dynamic: bool = False
    contacts: tuple[RestingContact, ...] = ()
    terms: bool = False
    """the power of a unit of every load, where the mechanism has one freedom or the case one unknown"""
    reactions: bool = False
    """forces in joints and pulls of ropes, which each row's scene tells"""

    @property
    def in_motion(self) -> bool:
        """Whether it asks for the motion of a row, and not for ratios alone."""
        return self.velocities or self.dynamic


class Setting(NamedTuple):
    """A case whose position as written is solved, and what is varied: paths of numbers, and links that
    are turned. ``first`` may have the mechanism on a record, on which the first program that is compiled
    goes on."""

    case: Case
    top: Topology
    figure: Figure
    paths: tuple[str, ...]
    links: tuple[str, ...]
    drive: Drive
    first: list[Mechanism] | None = None
    left_out: str = ""
    """the note on links that neither the answer nor what is varied needs, and that are not in the case"""

    @property
    def moves(self) -> bool:
        """Whether the mechanism moves, rather than being another in each row."""
        return bool(self.drive.moving or self.links)


class CompiledSweep(NamedTuple):
    """The record of a sweep.

    Attributes
    ----------
    inputs : by path (or link), nodes [case units, degrees]; by name also the signs of branches that
        change, and contacts that are told row by row
    outputs : by what they are, expressions in case units: ``("answers", "T12")`` has one part, ``("points",
        "C")`` two, ``("centres", "2-4")`` three (x, y, w), ``("rates", "4")`` one
    motion : the mechanism driven by the inputs; None where nothing moves
    scene : the case on the record
    springs : the angles that torsion springs follow, by load [degrees]: their turns are counted whatever is
        asked of the rows
    refusal : why no row has an answer; None else
    """

    setting: Setting
    record: Record
    inputs: dict[str, int]
    outputs: dict[tuple[str, str], tuple[Scalar, ...]]
    motion: DrivenMotion | None
    scene: RecordedScene
    springs: dict[str, Scalar]
    refusal: SceneError | None
    margins: tuple[int, ...] = ()
    """of the figure as written, where it is another in each row, and of ropes: none may be negative"""
    fits: tuple[int, ...] = ()
    """of the teeth of a pitch that vary, or whose pivots do, of angles that repeat other data, of given
    motions, and the pulls of ropes: where one is negative they may not fit"""
    senses: tuple[int, ...] = ()
    """those of angles: where one is negative its arm points the other way"""
    delicate: bool = False
    """whether the mechanism moves only because its data are exact, or nearly so"""
    idle: bool = False
    """whether the known loads do no work in any row, so that a scene has to tell what the unknown one does"""
    rubbing: FrictionRows | None = None
    """of a case with friction whose unknown loads can be had in all rows at once"""
    rests: bool = False
    """whether contacts are told row by row"""
    cancels: bool = False
    """whether the powers of the known loads all but cancel where the record is made"""
    spent: tuple[tuple[int, float], ...] = ()
    """what was taken as zero in the sums of power, though doubles do not show it, and beside what size"""
    dynamic: bool = False
    """whether inertia forces are among the loads"""
    taut: bool = False
    """whether the rows tell that every rope pulls"""
    loaded: tuple[int, ...] = ()
    """where the links are that loads act on, where a link is turned: they have to be somewhere"""
    untold: bool = False
    """whether they are asked for, and only a scene of its own tells them, or what is asked beside"""


def live_roots(compiled: CompiledSweep) -> list[Root]:
    """The branches that bear on what is asked, in order: those behind the links' checks too, which hold on
    the branches of the motion only."""
    record, stack = compiled.record, _asked(compiled)
    if compiled.motion is not None and compiled.motion.checks:
        stack += living_checks(compiled, live(record.nodes, stack))
    key = ("live roots", tuple(stack))
    if key not in record.kept:
        record.kept[key] = roots_of(record, stack)
    found: list[Root] = record.kept[key]
    return found


def _asked(compiled: CompiledSweep) -> list[int]:
    """The nodes of what is asked."""
    stack = [
        v.index for values in compiled.outputs.values() for v in values if isinstance(v, Traced) and v.row
    ]
    stack += compiled.rubbing.nodes if compiled.rubbing is not None else ()
    stack += compiled.loaded
    return stack


def living_checks(compiled: CompiledSweep, behind: Sequence[int]) -> list[int]:
    """The checks of links that bear on what is asked: they share more with what is behind it than a varied
    number, such as a place that a group found."""
    checks = compiled.motion.checks if compiled.motion is not None else ()
    if not checks:
        return []
    known = {*behind} - {*compiled.inputs.values()}
    return [k for k in checks if known.intersection(live(compiled.record.nodes, [k]))]


def roots_of(record: Record, stack: list[int]) -> list[Root]:
    """The branches that bear on nodes, in order."""
    alive: set[int] = set()
    while stack:
        alive.update(live(record.nodes, stack))
        parts = [v for group in record.implicit if alive.intersection(group.solved) for v in group.parts]
        stack = [v.index for v in parts if isinstance(v, Traced) and v.row and v.index not in alive]
    return [record.roots[k] for k in sorted(alive) if k in record.roots]


def setting_of(case: Case, paths: Sequence[str], links: Sequence[str], *, posing: bool = False) -> Setting:
    """Solve the position as written and find out what the varied numbers do, unless all are known to pose
    the figure.

    Raises CaseError for a path that the case does not have, SceneError where the case as written has
    no figure, or cannot be moved so.
    """
    own = tuple(find_number(case, path).path for path in paths)
    setting, left_out = by_needed_part(case, lambda part: _as_written(part, own, links, posing), own, links)
    return setting._replace(left_out=left_out) if left_out else setting


def _as_written(case: Case, own: tuple[str, ...], links: Sequence[str], posing: bool) -> Setting:
    """The setting of a case of which every link has its place."""
    top = topology(case)
    refusals.refuse_loose(case)
    figure = placed_figure(case, *wanted_points(case))
    refuse_misfit(case, figure.points, figure.frame.scale)
    refusals.refuse_no_direction(refusals.directions_of_joints(case), figure.points, FLOATS)
    setting = Setting(case, top, figure, own, tuple(links), Drive((), (), ()))
    if links or any(path.split(".")[0] in ("points", "lengths", "angles") for path in own):
        counted = counted_about(case, _springs_as_written(case, figure))
        driven = _driven(setting._replace(case=counted), posing=posing)
        setting = driven if driven.moves else driven._replace(case=case)
    if setting.moves:
        _refuse_misdirected(setting)
    return setting


def _springs_as_written(case: Case, figure: Figure) -> dict[str, float]:
    """The angles of the torsion springs as written, from which a motion counts their turns."""
    springs = [load for load in case.loads if isinstance(load, TorsionSpring)]
    return {load.name: float(spring_angle(load, figure.points, FLOATS)) for load in springs}


def _refuse_misdirected(setting: Setting) -> None:
    """Refuse a motion whose direction the position as written, from which it goes on, does not allow."""
    if not any(given.angle is not None for given in setting.case.motion):
        return
    place = PlacedCase(setting.case, setting.figure.frame, setting.figure.points, FLOATS)
    try:
        speed_of(place, by_loops(place).twists)
    except SceneError as refusal:
        if refusal.status == Status.INCONSISTENT:
            raise


def wanted_points(case: Case) -> tuple[list[str], list[str]]:
    """Every point that a joint, a link or a load has, and those that are given; and which of them joints,
    loads and motions need."""
    carried = [p for points in case.carries.values() for p in points]
    used = [joint.at for joint in case.joints if joint.at is not None]
    loads = [getattr(getattr(load, "heading", None), "point", None) for load in case.loads]
    ends = [rope.points[-1] for rope in case.ropes]
    named = dict.fromkeys((*carried, *used, *case.points, *ends, *loads))
    wanted = [p for p in named if p and p not in case.left_out]
    guides = [joint.guide for joint in case.joints if joint.guide is not None]
    needed = {*used, *(p for guide in guides for p in (*(guide.ends or ()), guide.through))}
    needed |= {p for load in case.loads for p in points_of(load)} | {m.point for m in case.motion}
    needed |= {p for rope in case.ropes for p in rope.points}
    return wanted, [p for p in wanted if p in needed]


def _driven(setting: Setting, *, posing: bool) -> Setting:
    """The setting with what moves, found on a record: where it is not that of the program, thrown away."""
    case, figure, paths, links = setting.case, setting.figure, setting.paths, setting.links
    record = BoundedRecord()
    held = mechanism(case, figure.frame, record, figure.points, placed_late(figure, case, record))
    poses = [path for path in paths if posing or _poses(case, figure, held, path)]
    drive = closed_drive(held, poses, links)
    if drive is not None:
        return setting._replace(drive=drive, first=[held] if drive.moving == paths else None)
    scratch = mechanism(case, figure.frame, BoundedRecord(), figure.points)
    return setting._replace(drive=drive_of(scratch, poses, links))


def _written(figure: Figure, placed: Placement) -> dict[str, Point]:
    """The points of a figure, placed in another arithmetic."""
    return {name: placed.points[name] for name in figure.points}


def _poses(case: Case, figure: Figure, scratch: Mechanism, path: str) -> bool:
    """Whether a number of the figure places a joint, and not only points that links carry besides (but for
    those of a wheel or a lever, which it turns); numbers that are only compared with the figure may."""
    held = {joint.at for joint in case.joints}
    held |= {p for rope in case.ropes for p, _ in zip(rope.points, rope.links, strict=False)}
    own = datum_at(case, path)
    if any(isinstance(s, (Polar, Meet)) and s.target in held and own in data_in(s) for s in figure.steps):
        return True
    written = number_at(case, path).value
    before, after = place(figure, case).points, {}
    for nudge in NUDGES:
        changed = with_numbers(case, {path: written + (abs(written) or 1.0) * nudge})
        with suppress(ZeroDivisionError):  # two loci fall together there
            after = place(figure, changed).points
            break
    moved = {name for name, p in before.items() if p != after.get(name)}
    if not moved or held & moved:
        return True
    return turns_links(scratch, path, moved, written)


# --- the record -----------------------------------------------------------------------------------

NUDGES = (2.0**-9, -(2.0**-9), 2.0**-14, -(2.0**-14), 2.0**-6, -(2.0**-6))
"""Where the record is made: this far (of half a turn, of the figure's size) from the position as written,
so that nothing in it is zero by chance."""
CLOSER = (2.0**-21, -(2.0**-21))
"""Else so far: between the limits of a link that all but stands still."""


def _apart(nudge: float, inputs: Collection[object]) -> float:
    """How far the next input is nudged: each otherwise than those before, so that nothing is equal by chance
    either (of a parallelogram whose sides are all varied)."""
    return nudge * (1.0 - 0.5 * (0.6180339887 * len(inputs) % 1.0))


YIELDS_HERE = (
    "the links move in the position as written alone, for an instant: beside it they form a structure, which "
    "no sweep can turn. Vary loads in this position, or take out a joint or a link that binds."
)


def compile_sweep(
    setting: Setting, asked: RowRequest, signs: Signs = (), away: float | None = None
) -> CompiledSweep:
    """The record of a sweep; the branches in ``signs`` have theirs as inputs. It is made beside the position
    as written, or ``away`` from there, in the measure of `NUDGES`."""
    refusal: SceneError | None = None
    for nudge in NUDGES + CLOSER if away is None else (away,):
        try:
            compiled = _compiled(setting, asked, nudge, signs)
        except (SceneError, ZeroDivisionError) as error:
            refusal = error if isinstance(error, SceneError) and nudge in NUDGES else refusal
            continue
        if all(compiled.record.nodes[root.radicand].value > 0.0 for root in compiled.record.roots.values()):
            return compiled
    if refusal is not None and refusal.status == Status.STRUCTURE and setting.moves:
        raise SceneError(Status.STRUCTURE, YIELDS_HERE) from refusal
    raise refusal or SceneError(Status.CHANGE_POINT, LIMIT_AS_WRITTEN)


def _compiled(setting: Setting, asked: RowRequest, nudge: float, signs: Signs) -> CompiledSweep:
    case, frame = setting.case, setting.figure.frame
    inputs: dict[str, int] = {}
    margins: tuple[int, ...] = ()
    fits: tuple[int, ...] = ()
    senses: tuple[int, ...] = ()
    motion: DrivenMotion | None = None
    if setting.first and setting.drive.closing is not None:
        motion = _motion(setting, setting.first.pop(), nudge, inputs, signs)
    else:
        record = BoundedRecord()
        record.follows = setting.moves
        placed = _placed(setting, record, nudge, inputs)
        if inputs:
            margins = tuple(m.index for step in placed.margins.values() for m in step if varies(m))
        names = _written(setting.figure, placed)
        if inputs:
            lines = refusals.direction_margins(refusals.directions_of_joints(case), names)
            rolled = asked.dynamic or asked.accelerations or has_friction(case)
            wheels = wheel_margins(case, names, frame.scale, record, rolled)
            angles = [d for d in spare_data(setting.figure, case) if d.kind in (RAY, CORNER)]
            senses = tuple(m.index for m in (ahead(placed.workspace, d) for d in angles) if varies(m))
            hung = refusals.hanging_margins(case, names, frame.scale, record)
            fits = (*(m.index for m in (*wheels, *lines, *hung) if varies(m)), *senses)
        if setting.moves:
            motion = _motion(setting, mechanism(case, frame, record, names), nudge, inputs, signs)
        else:
            scene = RecordedScene(case, setting.top, frame, record, names)
    if motion is not None:
        scene = moved_scene(motion)
        margins += motion.margins
    if case.ropes:
        every = (part_rooms(rope, scene.points, frame.scale, scene.record) for rope in scene.case.ropes)
        rooms = tuple(room.index for rope in every for room in rope if varies(room))
        margins, fits = (margins + rooms, fits) if motion is not None else (margins, fits + rooms)
    scene = rested(scene, asked.contacts, inputs)
    outputs, found = _outputs(scene, asked)
    compiled = CompiledSweep(
        setting,
        scene.record,
        inputs,
        outputs,
        motion,
        scene,
        spring_angles(scene),
        None,
        margins,
        fits,
        senses,
        rests=bool(asked.contacts),
        loaded=_loaded(case, motion) if motion is not None and setting.links and asked.answers else (),
    )
    return compiled if found is None else _with_statics(compiled, asked, found)


def _loaded(case: Case, motion: DrivenMotion) -> tuple[int, ...]:
    """The nodes that tell where the links are that loads act on: their turning, and what places them."""
    held, moved = motion.mechanism, motion.moved
    bodies = {held.top.body_of[link] for link in moving_links(case) if link in held.top.body_of}
    turned = [moved.rotations[body].z for body in bodies if body in moved.rotations]
    spots = (held.shape.one(spot) for body in bodies for spot in held.spots[body])
    placed = [moved.located[spot] for spot in spots if spot in moved.located]
    return tuple(v.index for at in (*turned, *placed) for v in at if isinstance(v, Traced) and v.row)


def _with_statics(compiled: CompiledSweep, asked: RowRequest, found: RecordedStatics) -> CompiledSweep:
    """What the statics of the rows tells of how they are to be run."""
    scene, case, moves = compiled.scene, compiled.setting.case, compiled.setting.moves
    rubs = asked.answers and refusals.rubs(case)
    pulls = pressing(scene, found).pulls if case.ropes and found.answers and not rubs else None
    given = motion_fits(scene, found, compiled.setting.paths, sense=asked.rates and not moves)
    rows = rubbing(scene, found.motions, found.balance) if rubs and not found.refusal else None
    return compiled._replace(
        refusal=None if rubs else found.refusal,
        fits=(*compiled.fits, *given, *(pull.index for pull in pulls or () if varies(pull))),
        delicate=found.delicate,
        idle=found.idle,
        rubbing=rows,
        cancels=found.cancels,
        spent=found.spent,
        dynamic=asked.dynamic and found.moves is not None,
        taut=pulls is not None and all(varies(pull) or float(pull) > 0.0 for pull in pulls),
        untold=asked.dynamic and (found.moves is None or asked.terms or rubs),
    )


def _placed(setting: Setting, record: Record, nudge: float, inputs: dict[str, int]) -> Placement:
    """The figure as written, of numbers that vary where another is asked for in each row."""
    for path in setting.paths:
        if path not in setting.drive.moving:
            value = number_at(setting.case, path).value
            node = record.input(path, value + (abs(value) or 1.0) * _apart(nudge, inputs))
            record.vary[path], inputs[path] = node, node.index
    return place(setting.figure, setting.case, record)


def spring_angles(scene: RecordedScene) -> dict[str, Scalar]:
    """The angles that the torsion springs of a scene follow, by load [degrees]."""
    springs = [load for load in scene.case.loads if isinstance(load, TorsionSpring)]
    return {load.name: spring_angle(load, scene.points, scene.record) for load in springs}


def _motion(
    setting: Setting, held: Mechanism, nudge: float, inputs: dict[str, int], signs: Signs
) -> DrivenMotion:
    """The mechanism driven by the inputs."""
    case, drive = setting.case, setting.drive
    record = held.shape.record
    known = drive.poses if drive.moving == setting.paths else {}
    drivers: list[Constraint] = []
    posed: list[tuple[Pose, Scalar]] = []
    for link in setting.links:
        node = record.input(link, 180.0 * _apart(nudge, inputs))
        inputs[link] = node.index
        drivers.append(turning(held, link, node))
    for path in drive.moving:
        size = 180.0 if is_angle(path) else 1.0 / setting.figure.frame.scale
        node = record.input(path, number_at(case, path).value + size * _apart(nudge, inputs))
        record.vary[path], inputs[path] = node, node.index
        pose = known.get(path) or pose_of(held, path)
        if pose is None:
            raise _not_together(path, setting.paths)
        posed.append((pose, node))
    posed += [(pose, record.given(number_of(case, pose.datum))) for pose in drive.held]
    drivers += [condition(held, pose, value) for pose, value in posed]
    drivers += [Turning(((body, 1.0),), 0.0) for body in drive.locked]
    turns = {name: record.input(name, sign) for name, sign in signs}
    inputs |= {name: node.index for name, node in turns.items()}
    motion = set_moving(held, closing_of(held, drivers, drive.closing), turns)
    ways = (ahead_on(held, pose, value, motion.moved) for pose, value in posed)
    return motion._replace(margins=(*motion.margins, *(way.index for way in ways if varies(way))))


def _not_together(path: str, paths: Sequence[str]) -> SceneError:
    """A number that poses the figure as written, but not where the others have changed."""
    others = listed(other for other in paths if other != path)
    only = f"{path} moves the mechanism only as long as {others} stay as written"
    return SceneError(Status.UNSUPPORTED, f"{only}: vary one at a time.")


def _in_motion(
    scene: RecordedScene, asked: RowRequest, found: RecordedStatics
) -> dict[tuple[str, str], tuple[Scalar, ...]]:
    """Rates, velocities and accelerations, where they are asked for."""
    out: dict[tuple[str, str], tuple[Scalar, ...]] = {}
    if asked.rates:
        out |= {("rates", link): (rate,) for link, rate in rates(scene, found.motions).items()}
    if asked.velocities:
        out |= {("velocities", spot_name(spot)): v for spot, v in velocities(scene, found.motions)}
    if asked.accelerations and found.moves is not None:
        told = point_accelerations(scene, found.moves)
        out |= {("accelerations", spot_name(spot)): a for spot, a in told}
        turning = link_accelerations(scene, found.moves)
        out |= {("angular_accelerations", link): (rate,) for link, rate in turning}
    return out


def _outputs(
    scene: RecordedScene, asked: RowRequest
) -> tuple[dict[tuple[str, str], tuple[Scalar, ...]], RecordedStatics | None]:
    """Expressions of all that is asked, in case units; the statics by which they were found."""
    ox, oy, scale = scene.frame
    out: dict[tuple[str, str], tuple[Scalar, ...]] = {}
    for name in asked.points:
        if name in scene.points:
            x, y = scene.points[name]
            out["points", name] = (x / scale + ox, y / scale + oy)
    if not (asked.answers or asked.rates or asked.centres or asked.in_motion):
        return out, None
    rubs = asked.answers and refusals.rubs(scene.case)
    everything = asked.rates or asked.terms or bool(asked.centres) or rubs or asked.in_motion
    found = statics(scene, everything, asked.dynamic)
    for name, value in found.answers.items():
        if asked.answers and not rubs:
            out["answers", name] = (value,)
    if asked.terms:
        out |= {("terms", load): (factor,) for load, factor in unit_powers(scene, found)}
    out |= _in_motion(scene, asked, found)
    if asked.centres:
        there = [pair for pair in asked.centres if {*pair} <= {*scene.case.links}]
        told = centres(scene, found.motions, there)
        out |= {("centres", pair_name(scene.case, pair)): triple for pair, triple in told}
    if asked.contacts and found.answers:
        normals = pressing(scene, found, asked.contacts).contacts
        out |= {("contact", at): (force,) for at, force in normals.items()}
    return out, found
