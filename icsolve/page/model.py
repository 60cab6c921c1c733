"""What the script of a page reads: all positions as columns in few bytes, the loads, the steps, the answers.

Whole numbers stand as differences of differences where the picture needs no more, plain numbers else.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from itertools import groupby, takewhile
from typing import Any

import numpy as np

from icsolve.answer import Centre, Found
from icsolve.answer.bodies import Reaction
from icsolve.case import (
    Force,
    ForceVector,
    Load,
    Pair,
    Spring,
    Stretch,
    TorsionSpring,
    Toward,
    Weight,
    is_link,
    is_named,
    pair_name,
)
from icsolve.case.loads import name_of_inertia
from icsolve.draw.loads import axle, intensities
from icsolve.draw.marks import Point, View
from icsolve.draw.ropes import RopeCourse
from icsolve.draw.scene import Scene
from icsolve.draw.svg import identifier
from icsolve.draw.words import centre_runs, datum_name, datum_unit, figure_number, name_runs, unit_word
from icsolve.errors import Status
from icsolve.page.live import Live
from icsolve.page.motion import PageMotion
from icsolve.page.pictures import PageFigure
from icsolve.page.poses import FINE, Array, compact, exact, followed, moved, moves
from icsolve.report.derivation.known import Acting, Known, acting_loads, resting
from icsolve.report.derivation.ratios import Step
from icsolve.wording import held, holding, sense_of, spelt, unit_of

# --- loads through a motion ------------------------------------------------------------------------------


def place_rows(known: Known, motion: PageMotion, link: str, p: Point) -> tuple[Array, Array]:
    """Where a place of a link is in every row: x and y, (rows,) each [case lengths]."""
    pose = motion.poses.get(link)
    if pose is None:
        return np.full(len(motion.degrees), p[0]), np.full(len(motion.degrees), p[1])
    return moved(pose, known.points[pose.point], p)


def heading_rows(known: Known, motion: PageMotion, acting: Acting) -> Array:
    """Direction of the positive force in every row, (rows,) [degrees]."""
    load = acting.load
    written = math.degrees(math.atan2(acting.direction[1], acting.direction[0]))
    level = np.full(len(motion.degrees), written)
    target = None if acting.at is None else _target(known, motion, acting)
    if acting.at is not None and target is not None:
        x, y = place_rows(known, motion, acting.link, acting.at)
        a, b = target
        now = np.degrees(np.arctan2(b - y, a - x))
        return np.asarray(written + now - now[motion.zero])
    inertia = inertia_rows(known, motion, load)
    if inertia is not None and acting.at is not None:
        return np.asarray(np.degrees(np.arctan2(inertia[:, 1], inertia[:, 0])))
    turner = str(getattr(load, "turns_with", None))
    return level + motion.poses[turner].angle if turner in motion.poses else level


def inertia_rows(known: Known, motion: PageMotion, load: Load) -> Array | None:
    """The force (n, 2) or couple (n,) of a link's inertia in every row, case units; None of another load, and
    where no row has any.
    """
    if not name_of_inertia(load.name) or not motion.found.angular_accelerations:
        return None
    units, inertia = known.case.units, known.case.inertia[load.link]
    if isinstance(load, ForceVector):
        assert inertia.mass is not None
        per = inertia.mass.value * units.force_per_newton / units.length_per_metre
        return -per * motion.found.accelerations[f"{inertia.centre} on {load.link}"]
    assert inertia.moment is not None
    per = inertia.moment.value * units.force_per_newton * units.length_per_metre
    return -per * units.torque_per_force_length * motion.found.angular_accelerations[load.link]


def _target(known: Known, motion: PageMotion, acting: Acting) -> tuple[Array, Array] | None:
    """Where that is in every row toward which a load acts: a point, or a spring's end on its other link."""
    load = acting.load
    if isinstance(load, Spring):
        return place_rows(known, motion, acting.against, known.points[load.to])
    heading = getattr(load, "heading", None)
    if not isinstance(heading, Toward) or heading.point not in known.points:
        return None
    if heading.point in motion.found.points:
        return motion.found.points[heading.point][:, 0], motion.found.points[heading.point][:, 1]
    return place_rows(known, motion, acting.against, known.points[heading.point])


def senses(known: Known, motion: PageMotion, acting: Acting, values: Array) -> list[str]:
    """The sense of the load's ``values`` (rows,), in words; '' where it has none."""
    rows = zip(
        np.nan_to_num(values).tolist(),
        gain_rows(known, motion, acting).tolist(),
        heading_rows(known, motion, acting).tolist(),
        strict=True,
    )
    return [spelt(sense_of(acting.load, *row), figure_number) for row in rows]


def gain_rows(known: Known, motion: PageMotion, acting: Acting) -> Array:
    """The force or torque that one unit of a load exerts, (rows,): a mass g, a spring its stretch."""
    load = acting.load
    if isinstance(load, Spring) and acting.at is not None:
        x, y = place_rows(known, motion, acting.link, acting.at)
        a, b = place_rows(known, motion, acting.against, known.points[load.to])
        return np.asarray(np.hypot(a - x, b - y) - load.free.value)
    if isinstance(load, TorsionSpring):
        return _slack_rows(known, motion, acting, load)
    counts = isinstance(load, Weight) or (isinstance(load, Force) and load.over is not None)
    return np.full(len(motion.degrees), acting.gain if counts else 1.0)


def _slack_rows(known: Known, motion: PageMotion, acting: Acting, load: TorsionSpring) -> Array:
    """By how much a torsion spring is turned in every row, rad; turns count from the position as written."""
    *arm, at, end = load.corner
    x, y = place_rows(known, motion, acting.link, known.points[at])
    u, v = place_rows(known, motion, acting.link, known.points[end])
    angle = followed(np.arctan2(v - y, u - x))
    if arm:
        x, y = place_rows(known, motion, acting.against, known.points[at])
        u, v = place_rows(known, motion, acting.against, known.points[arm[0]])
        angle = angle - followed(np.arctan2(v - y, u - x))
    written = acting.gain * known.case.units.torque_per_force_length
    return np.asarray(written - (angle - angle[motion.zero]))


def load_data(scene: Scene, motion: PageMotion | None, acting: Acting) -> dict[str, Any]:
    """What the script of the page reads of a load: its place on its link and how its arrow turns."""
    load = acting.load
    along = isinstance(getattr(load, "over", None), Stretch)  # it may be a couple, and is drawn as forces
    place = axle(scene, acting.link) if acting.at is None else scene.view.at(acting.at)
    if not is_link(acting.link):  # the free end of a rope, as it is drawn
        place = scene.at.get(str(getattr(load, "at", "")), place)
    x, y = place or (0.0, 0.0)
    found: dict[str, Any] = {
        "on": [acting.link, round(x, 1), round(y, 1)],
        "torque": acting.at is None and not along,
    }
    found |= _number_shown(acting)
    if isinstance(load, Spring):
        a, b = scene.at[load.at], scene.at[load.to]
        found["span"] = [
            [acting.link, round(a[0], 1), round(a[1], 1)],
            [acting.against, round(b[0], 1), round(b[1], 1)],
        ]
        return found
    if acting.unknown and acting.value is not None and load.name.rpartition(".")[0] in scene.case.directed:
        column = [acting.value] if motion is None else motion.found.answers[load.name][motion.rows].tolist()
        found |= {"values": exact(column), **_named(load.name), "unit": unit_word(acting.unit)}
    if motion is None:
        return found
    rows = motion.rows
    inertia = inertia_rows(scene.known, motion, load)
    if inertia is not None:
        size = inertia if acting.at is None else np.hypot(inertia[:, 0], inertia[:, 1])
        found |= {"values": exact(size[rows]), **_named(load.name), "unit": unit_word(acting.unit)}
    if acting.at is not None or along:
        way = heading_rows(scene.known, motion, acting)
        way = (way - way[motion.zero])[rows]
        if moves(way, FINE["deg"]):
            found["way"] = compact(way, FINE["deg"])
    return found


# --- what the script reads -------------------------------------------------------------------------------


INFINITE = 1e9
"""Picture units: what is farther than this is a direction to the page."""
BEYOND = 1e7
"""So many sizes of the figure away a centre is at infinity."""
HINTS = {
    Status.DEAD_CENTRE: "Dead centre: the link of the unknown load stands still here.",
    Status.NO_VALUE: "No value: the unknown load does no work here, the known loads do.",
    Status.ANY_VALUE: "Any value: neither the unknown load nor the known ones do work here.",
    Status.CHANGE_POINT: "Change point: from here the mechanism can go on in more than one way.",
    Status.NEAR_SINGULAR: "Too close to a singular position for a number that could be trusted.",
    Status.SLACK: "A rope would have to push here: it is slack.",
    Status.JAM: "It jams: with this friction no value keeps up the motion.",
    Status.CANNOT_ASSEMBLE: "The links do not meet here.",
    Status.UNBALANCED: "The loads do not balance here.",
    Status.INCONSISTENT: "No single motion fits this position.",
    Status.STRUCTURE: "Nothing moves: the links hold each other.",
    Status.MOBILITY: "The unknown loads are not as many as the freedoms.",
    Status.AMBIGUOUS: "The figure assembles in several ways, and nothing picks one.",
    Status.UNDERDETERMINED: "The figure leaves a point free.",
    Status.CONTRADICTORY: "No motion has all of the given centres.",
    Status.UNSUPPORTED: "This page cannot tell that: copy the case and solve it.",
}
"""What a position without an answer says."""


def model_of(
    known: Known,
    steps: Sequence[Step],
    figure: PageFigure,
    motion: PageMotion | None,
    live: Live | None,
) -> dict[str, Any]:
    """The data of a page, ready to be written as JSON."""
    view = figure.scene.view
    loads = acting_loads(known)
    window = [round(v, 1) for v in figure.window]
    data: dict[str, Any] = {
        "window": window,
        "scale": float(format(view.scale, ".6g")),
        "view": [view.scale, *view.origin],
        "length": unit_word(known.case.units.length),
        "steps": max((step.number for step in steps), default=0),
        "centres": _centres(known, steps, view, motion),
        "loads": {a.load.name: load_data(figure.scene, motion, a) for a in loads},
        "ropes": {course.rope.name: _circles(figure.scene, course) for course in figure.ropes},
        "anchors": _anchors(known, steps, figure, live),
        "answers": _answers(known, motion, loads),
    }
    if motion is not None:
        told = live is None or live.data["moves"]  # by which velocities are told
        data["motion"] = motion_data(known, view, motion, FINE["told"] if told else FINE["px"])
    if live is not None:
        data["live"] = live.data
        data["statuses"] = HINTS
    return data


def motion_data(known: Known, view: View, motion: PageMotion, fine: float) -> dict[str, Any]:
    """Degrees, poses of links and places of points (in steps of 1 / ``fine``) in the rows that assemble."""
    rows = motion.rows
    degrees = motion.degrees
    step = float(degrees[1] - degrees[0])
    return {
        "driver": motion.driver,
        "verb": motion.by.verb,
        "unit": motion.by.unit,
        "senses": motion.by.senses,
        "first": _round(degrees[motion.first]),
        "step": _round(step),
        "rows": motion.positions,
        "zero": motion.zero - motion.first,
        "low": _round(degrees[0]),
        "high": _round(degrees[-1]),
        "turns": motion.whole_turn,
        "dead": motion.dead,
        "hints": _hints(motion),
        "ends": motion.ends,
        "links": _links(known, view, motion),
        "points": {
            name: _place(view, column[rows, 0], column[rows, 1], fine)
            for name, column in {**motion.found.points, **_contacts(known, motion)}.items()
            if moves(column[rows, 0] * view.scale, FINE["px"])
            or moves(column[rows, 1] * view.scale, FINE["px"])
        },
    }


def _contacts(known: Known, motion: PageMotion) -> dict[str, Array]:
    """Where profiles touch in every row, by the hidden point that the figure has there."""
    found = {}
    for pair, places in motion.found.touching.items():
        names = [name for name in known.points if name.startswith(f"@{pair}.")]
        if len(names) == 1 and np.isfinite(places[motion.rows]).all():
            found[names[0]] = places
    return found


def _round(value: float) -> float:
    return float(format(value, ".9g"))


def _hints(motion: PageMotion) -> list[list[Any]]:
    """First row, last row, sentence and status of every stretch that has no answer."""
    status = motion.status[motion.rows]
    found: list[list[Any]] = []
    for word, rows in groupby(range(len(status)), key=lambda n: status[n]):
        some = list(rows)
        if word != Status.OK:
            found.append([some[0], some[-1], HINTS.get(word, f"No answer here ({word})."), word])
    return found


def _links(known: Known, view: View, motion: PageMotion) -> dict[str, Any]:
    """The poses of the links that move, and the place of their point as written."""
    found = {}
    for link, pose in motion.poses.items():
        x, y, angle = (column[motion.rows] for column in (pose.x, pose.y, pose.angle))
        still = not any((moves(x * view.scale, FINE["px"]), moves(y * view.scale, FINE["px"])))
        if still and not moves(angle, FINE["deg"]):
            continue
        start = view.at(known.points[pose.point])
        turned = np.degrees(followed(np.radians(angle)))
        own = {"from": [round(start[0], 1), round(start[1], 1)], "a": compact(turned, FINE["deg"])}
        found[link] = {**own, **_place(view, x, y)}
    return found


def _place(view: View, x: Array, y: Array, fine: float = FINE["px"]) -> dict[str, Any]:
    across = (x - view.origin[0]) * view.scale
    down = (view.origin[1] - y) * view.scale
    return {"x": compact(across, fine), "y": compact(down, fine)}


def _circles(scene: Scene, course: RopeCourse) -> list[list[Any]]:
    """What a rope goes round, in order: point, place as written, radius (positive: clockwise), and where
    that is a number of the case its path."""
    paths = ("" if given is None else given.path for given in course.rope.radii)
    ends = zip(course.rope.points, course.radii, paths, strict=True)
    return [[p, *(round(c, 1) for c in scene.at[p]), round(radius, 2), path] for p, radius, path in ends]


def _anchors(
    known: Known, steps: Sequence[Step], figure: PageFigure, live: Live | None
) -> dict[str, list[float]]:
    """The points that lines of centres start from (common normals), as written; of a page without a scene of
    its own, which would have them, all points: loads follow them where they rest, too."""
    single = [line[0] for step in steps for line in step.centre.lines if len(line) == 1]
    names = {_joint(known, pair) for pair in single}
    names |= set() if live is not None else {*filter(is_named, figure.scene.at)}
    return {n: [round(c, 1) for c in figure.scene.at[n]] for n in sorted(names) if n in figure.scene.at}


def _joint(known: Known, pair: Pair) -> str:
    """The point of the joint of two links."""
    joints = (j for j in known.case.joints if set(pair) == set(getattr(j, "links", ())))
    return next((at for j in joints if (at := getattr(j, "at", None))), "")


def _centres(
    known: Known, steps: Sequence[Step], view: View, motion: PageMotion | None
) -> list[dict[str, Any]]:
    numbers = {step.centre.pair: n for n, step in enumerate(steps)}
    return [_centre(known, step, view, motion, numbers) for step in steps]


def _centre(
    known: Known, step: Step, view: View, motion: PageMotion | None, numbers: Mapping[Pair, int]
) -> dict[str, Any]:
    centre = step.centre
    name = pair_name(known.case, centre.pair)
    lines: list[list[Any]] = []
    for line in centre.lines:
        if len(line) == 1:
            lines.append([_joint(known, line[0])])
        else:
            lines.append([numbers[end] for end in line if end in numbers])
    x, y = _places(centre, name, view, motion)
    fine = FINE["far"] if (np.hypot(x, y)[np.isfinite(x)] >= INFINITE).all() else FINE["px"]
    return {
        "id": identifier(f"centre-{name}"),
        "name": name,
        "low": centre_runs(*centre.pair)[1].text,
        "step": step.number,
        "primary": centre.by in ("inspection", "given"),
        "lines": lines,
        "x": compact(x, fine),
        "y": compact(y, fine),
    }


def _places(centre: Centre, name: str, view: View, motion: PageMotion | None) -> tuple[Array, Array]:
    """Picture units in every row; beyond INFINITE a direction; not a number where there is none."""
    if motion is not None and name in motion.found.centres:
        rows = motion.found.centres[name][motion.rows]
    else:
        rows = _written_centre(centre, motion)
    x, y, w = rows.T
    reach = np.hypot(x, y)
    far = np.abs(w) * BEYOND * 1000.0 / view.scale <= reach
    with np.errstate(all="ignore"):
        side = np.where((y < 0.0) | ((y == 0.0) & (x < 0.0)), -1.0, 1.0) * INFINITE * 2.0 / reach
        across = np.where(far, x * side, (x / w - view.origin[0]) * view.scale)
        down = np.where(far, -y * side, (view.origin[1] - y / w) * view.scale)
    return across, down


def _written_centre(centre: Centre, motion: PageMotion | None) -> Array:
    """A centre as written; of a motion in which the sweep does not know it, in that one row."""
    if centre.kind == "at":
        row = [centre.place[0], centre.place[1], 1.0]
    else:
        angle = np.radians(centre.place[0])
        row = [np.cos(angle), np.sin(angle), 0.0]
    if motion is None:
        return np.array([row])
    rows = np.full((motion.positions, 3), np.nan)
    rows[motion.zero - motion.first] = row
    return rows


def _number_shown(acting: Acting) -> dict[str, Any]:
    """How the number beside a load is told in the figure; of a known one, which may be typed, itself."""
    load = acting.load
    told: dict[str, Any] = {"k": True} if isinstance(load, Spring | TorsionSpring) else {}
    if acting.unknown or acting.value is None or name_of_inertia(load.name) or intensities(load):
        return told
    clockwise = acting.at is None and sense_of(load, 1.0, acting.gain, 0.0) == "cw"
    told |= {"known": acting.value, **_named(load.name), "unit": unit_word(acting.unit)}
    return told | ({"cw": True} if clockwise else {})


def _answers(known: Known, motion: PageMotion | None, loads: Sequence[Acting]) -> list[dict[str, Any]]:
    """Each unknown load: name, unit, values and senses of all positions, or its range in words."""
    if known.answer is None:
        return []
    found = []
    acting = {a.load.name: a for a in loads}
    for name, value in known.answer.answers.items():
        one: dict[str, Any] = {"name": name, **_named(name), "unit": unit_word(value.unit)}
        if motion is not None and name in motion.found.answers:
            _through(known, motion, one, name, acting[name])
        elif motion is not None and f"{name}.x" in motion.found.answers:
            _of_any_direction(motion, one, name, acting[f"{name}.x"].load)
        else:
            one["holds"] = [_holding(value)] if value.holds is not None else None
            one["values"] = exact([value.value])
            one["senses"], one["sense"] = _indexed([spelt(value.sense, figure_number)])
        found.append(one)
    found += [
        {**_named(name), "name": name, "joint": _joint_of(known, name, force), "sense": compact(ZERO, 1)}
        | {"values": exact([size]), "senses": [sense], "unit": unit_word(known.case.units.force)}
        for name, force, size, sense in forces_in_joints(known)
    ]
    return found + _asked(known, 1 if motion is None else motion.positions)


ZERO = np.zeros(1)


def forces_in_joints(known: Known) -> Iterable[tuple[str, Reaction, float, str]]:
    """Of a structure what its joints carry: name, force, size and direction in words."""
    for name, force in known.answer.reactions.items() if known.answer and known.answer.reactions else ():
        if known.structure and isinstance(force, Reaction) and force.magnitude is not None:
            way = "" if force.direction is None else f"at {figure_number(force.direction)}\N{DEGREE SIGN}"
            yield name, force, force.magnitude, way


def _joint_of(known: Known, name: str, force: Reaction) -> list[Any]:
    """Where a reaction acts: its links, the point, how many joints of theirs stand there before its own."""
    own = (force.by, force.on, force.where)
    reactions = known.answer.reactions if known.answer else None
    before = takewhile(lambda item: item[0] != name, (reactions or {}).items())
    alike = [one for _, one in before if isinstance(one, Reaction) and (one.by, one.on, one.where) == own]
    return [*own, len(alike)]


def _asked(known: Known, rows: int) -> list[dict[str, Any]]:
    """The data of the figure that are asked for: the position that is shown, the same in all rows."""
    here = resting(known)
    if here is None or not all(isinstance(value, float) for value in here.at.values()):
        return []
    senses, sense = _indexed([here.stability or ""] * rows)
    told = {"low": "", "senses": senses, "sense": sense, "asked": True}
    return [
        {"name": path, "base": datum_name(path), "unit": datum_unit(known, path), **told}
        | {"values": exact([float(value)] * rows)}
        for path, value in here.at.items()
        if isinstance(value, float)
    ]


def _named(name: str) -> dict[str, str]:
    """The letters of a load's name, and what stands low behind them."""
    runs = name_runs(name)
    return {"base": runs[0].text, "low": runs[1].text if len(runs) > 1 else ""}


def _through(known: Known, motion: PageMotion, one: dict[str, Any], name: str, acting: Acting) -> None:
    """The columns of an unknown load."""
    rows = motion.rows
    values = motion.found.answers[name]
    one["values"] = exact(values[rows].tolist())
    one["senses"], one["sense"] = _indexed(senses(known, motion, acting, values)[rows])
    if name in motion.found.holds:
        unit = unit_word(unit_of(acting.load, known.case))
        ranges = zip(motion.found.holds[name][rows].tolist(), motion.found.locks[name][rows], strict=True)
        some = [_held(ends, bool(locks), unit) for ends, locks in ranges]
        one["holds"] = ["" if found is None else _holding(found) for found in some]
        one["reach"] = ["" if found is None else held(found, figure_number) for found in some]


def _of_any_direction(motion: PageMotion, one: dict[str, Any], name: str, load: Load) -> None:
    """The columns of an unknown force of unknown direction, from those of its components."""
    x, y = (motion.found.answers[f"{name}.{axis}"][motion.rows] for axis in "xy")
    sizes, degrees = np.hypot(x, y), np.nan_to_num(np.degrees(np.arctan2(y, x)))
    one["values"] = exact(sizes.tolist())
    rows = zip(np.nan_to_num(sizes).tolist(), degrees.tolist(), strict=True)
    one["senses"], one["sense"] = _indexed(
        [spelt(sense_of(load, size, 1.0, at), figure_number) for size, at in rows]
    )


def _held(ends: list[float], locks: bool, unit: str) -> Found | None:
    """What is found where an unknown load holds over a range; None where there is none."""
    low, high = ends
    none = math.isnan(low) or math.isnan(high)
    return None if none else Found(math.nan, unit, "", holds=(low, high), self_locking=locks)


def _holding(found: Found) -> str:
    """The range in the words of the answer, with its digits."""
    return holding(found, lambda end: figure_number(end, 6))


def _indexed(words: Sequence[str]) -> tuple[list[str], dict[str, Any]]:
    """Texts as a list of the different ones and a column of their numbers."""
    different = list(dict.fromkeys(words))
    where = {word: n for n, word in enumerate(different)}
    return different, compact(np.array([float(where[word]) for word in words]), 1)
