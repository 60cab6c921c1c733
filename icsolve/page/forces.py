"""Free bodies through the positions of a page that is solved beforehand: what acts on every link in each of
them, as a figure of free bodies draws it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from contextlib import suppress
from typing import Any

from icsolve.answer import Answer, by_load
from icsolve.draw.bodies import DrawnPush, pushes_on
from icsolve.draw.marks import plain_text
from icsolve.draw.scene import Scene
from icsolve.draw.words import unit_word
from icsolve.errors import SceneError
from icsolve.page.columns import exact
from icsolve.page.motion import PageMotion
from icsolve.report.derivation.known import Known, known_at
from icsolve.scene import solve_scene
from icsolve.screws.plane import Triple
from icsolve.sweep import Sweep

MOST = 200
"""In more positions than these forces are not solved for: each is a scene of its own."""
SIZES = 6
"""Significant digits of a force."""
NOISE = 1e-12
"""Below this fraction a force is rounding."""


def forces_data(scene: Scene, motion: PageMotion | None) -> dict[str, Any]:
    """For every link its places as written, its twist, and the forces and couples on it in every position;
    empty where they are known in none.

    A force has its place in picture units and its components in case units, y up; a twist is (X, Y, W) in
    case lengths.
    """
    known = scene.known
    if known.answer is None or not known.answer.reactions or known.case.space is not None:
        return {}
    rows = 1 if motion is None else motion.last + 1 - motion.first
    if rows > MOST:
        return {}
    poses = [known] if motion is None else [_in_row(known, motion, motion.first + n) for n in range(rows)]
    data: dict[str, Any] = {}
    places = known.points.values()
    reach = max(math.dist(p, q) for p in places for q in places)
    for link in known.case.links:
        spots = [scene.at[p] for p in known.case.carries.get(link, ()) if p in scene.at]
        if link == known.case.ground or not spots:
            continue
        some = [dict(_named(scene, pose, link)) for pose in poses]
        every = dict.fromkeys(name for one in some for name in one)
        most = max((math.hypot(*push.force) for one in some for push in one.values()), default=0.0)
        twists = [_nothing if pose is None else _twists(pose).get(link, _nothing) for pose in poses]
        data[link] = {
            "spots": [[round(x, 5), round(y, 5)] for x, y in spots],
            "names": [p for p in known.case.carries.get(link, ()) if p in scene.at],
            "twist": [exact(column, SIZES) for column in zip(*twists, strict=True)],
            "pushes": [_through([one.get(name) for one in some], most, reach) for name in every],
        }
    units = known.case.units
    words = [unit_word(unit) for unit in (units.force, units.torque, units.length)]
    return {"links": data, "units": words}


_nothing = (math.nan, math.nan, math.nan)


def _twists(pose: Known) -> Mapping[str, Triple]:
    with suppress(SceneError):  # too close to a dead centre to be told
        return pose.twists or ({} if pose.scene is None else pose.scene.twists)
    return {}


def _in_row(known: Known, motion: PageMotion, row: int) -> Known | None:
    """The scene of a row with its reactions; None where it has none."""
    if row == motion.zero:
        return known
    for bound in (False, True):
        with suppress(SceneError, ValueError, ArithmeticError):
            case = motion.found.case_of(row)
            answer = solve_scene(case, reactions=True, dynamic=case.dynamic, alone=True, bound=bound)
            if bound or _agrees(answer, motion.found, row):
                return known_at(known, answer) if answer.reactions else None
    return None


def _agrees(answer: Answer, found: Sweep, row: int) -> bool:
    """Whether floats have the answers of a row to more digits than a force has: its bodies need no others."""
    swept = {name: float(array[row]) for name, array in found.answers.items()}
    told = {name: one.value for name, one in by_load(answer.answers).items() if name in swept}
    close = (abs(told[name] - value) <= 10.0 ** (-SIZES - 3) * abs(value) for name, value in swept.items())
    return bool(swept) and told.keys() == swept.keys() and all(close)


def _named(scene: Scene, here: Known | None, link: str) -> Iterable[tuple[str, DrawnPush]]:
    """What acts on a link in a position, by name."""
    if here is not None:
        places = {name: scene.view.at(p) for name, p in here.points.items()}
        for push in pushes_on(scene._replace(known=here, at=places), link):
            yield push.name, push


def _through(pushes: list[DrawnPush | None], most: float, reach: float) -> dict[str, Any]:
    """One force or couple in all positions; what is rounding beside the largest force, and the figure's size
    [case length], is nothing."""
    one = next(push for push in pushes if push is not None)
    label = plain_text(one.words)
    nothing = (math.nan,) * 5
    rows = [nothing if p is None else (*p.at, p.force[0], -p.force[1], p.couple) for p in pushes]
    sizes = zip(("x", "y", "u", "v", "couple"), (1.0, 1.0, most, most, most * reach), strict=True)
    told: dict[str, Any] = {
        part: exact([0.0 if abs(v) <= NOISE * size else v for v in column], SIZES)
        for (part, size), column in zip(sizes, zip(*rows, strict=True), strict=True)
    }
    told |= {"open": True} if label.endswith("= ?") else {}
    told |= {"touches": True} if any(p is not None and p.circle is not None for p in pushes) else {}
    return {"name": label.partition(" = ")[0], "known": one.kind != "reaction", **told}
