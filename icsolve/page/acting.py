"""Loads through a motion: where they act, which way they point, and the sense of their value in words."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from icsolve.case import Force, Spring, Torque, Toward
from icsolve.construction import Acting, Known
from icsolve.construction.words import sense_words
from icsolve.draw.loads import axle
from icsolve.draw.marks import Point
from icsolve.draw.scene import Scene
from icsolve.draw.words import figure_number
from icsolve.page.columns import FINE, compact, moves
from icsolve.page.motion import Motion
from icsolve.page.poses import Array, moved


def place_rows(known: Known, motion: Motion, link: str, p: Point) -> tuple[Array, Array]:
    """Where a place of a link is in every row, case units."""
    pose = motion.poses.get(link)
    if pose is None:
        return np.full(len(motion.degrees), p[0]), np.full(len(motion.degrees), p[1])
    return moved(pose, known.points[pose.point], p)


def heading_rows(known: Known, motion: Motion, acting: Acting) -> Array:
    """Direction of the positive force in every row, degrees."""
    load = acting.load
    written = math.degrees(math.atan2(acting.direction[1], acting.direction[0]))
    level = np.full(len(motion.degrees), written)
    if acting.at is None:
        return level
    target = load.to if isinstance(load, Spring) else None
    if isinstance(load, Force) and isinstance(load.heading, Toward):
        target = load.heading.point
    if target is not None and target in known.points:
        x, y = place_rows(known, motion, acting.link, acting.at)
        a, b = _target(known, motion, acting, target)
        now = np.degrees(np.arctan2(b - y, a - x))
        return np.asarray(written + now - now[motion.zero])
    turner = str(getattr(load, "turns_with", None))
    return level + motion.poses[turner].angle if turner in motion.poses else level


def _target(known: Known, motion: Motion, acting: Acting, name: str) -> tuple[Array, Array]:
    if name in motion.found.points:
        return motion.found.points[name][:, 0], motion.found.points[name][:, 1]
    return place_rows(known, motion, acting.against, known.points[name])


def senses(known: Known, motion: Motion, acting: Acting, values: Array) -> list[str]:
    """The sense of the load's value in every row, in words; '' where it has none."""
    headings = heading_rows(known, motion, acting)
    signs = np.sign(np.nan_to_num(values))
    if isinstance(acting.load, Spring):
        signs = signs * np.sign(_stretch(known, motion, acting, acting.load))
    return [_sense(acting, s, h) if s else "" for s, h in zip(signs.tolist(), headings.tolist(), strict=True)]


def _stretch(known: Known, motion: Motion, acting: Acting, load: Spring) -> Array:
    assert acting.at is not None
    x, y = place_rows(known, motion, acting.link, acting.at)
    a, b = _target(known, motion, acting, load.to)
    return np.asarray(np.hypot(a - x, b - y) - load.free.value)


def _sense(acting: Acting, sign: float, heading: float) -> str:
    load = acting.load
    if isinstance(load, Torque):
        word = "ccw" if (sign > 0) == (load.turns == "ccw") else "cw"
    elif isinstance(load, Spring):
        word = "pull" if sign > 0 else "push"
    else:
        word = f"at {round(heading + (0.0 if sign > 0 else 180.0), 6) % 360.0:.6g} deg"
        if isinstance(load, Force) and isinstance(load.heading, Toward):
            nearer = (sign > 0) != load.heading.away
            if load.against is not None:
                word = "pull" if nearer else "push"
            elif nearer:
                word = f"toward {load.heading.point}"
    return sense_words(word, figure_number)


def load_data(scene: Scene, motion: Motion | None, acting: Acting) -> dict[str, Any]:
    """What the script of the page reads of a load: its place on its link and how its arrow turns."""
    load = acting.load
    place = axle(scene, acting.link) if acting.at is None else scene.view.at(acting.at)
    x, y = place or (0.0, 0.0)
    found: dict[str, Any] = {"on": [acting.link, round(x, 1), round(y, 1)], "torque": acting.at is None}
    if isinstance(load, Spring):
        a, b = scene.at[load.at], scene.at[load.to]
        found["span"] = [
            [acting.link, round(a[0], 1), round(a[1], 1)],
            [acting.against, round(b[0], 1), round(b[1], 1)],
        ]
    elif motion is not None and acting.at is not None:
        rows = slice(motion.first, motion.last + 1)
        way = heading_rows(scene.known, motion, acting)
        way = (way - way[motion.zero])[rows]
        if moves(way, FINE["deg"]):
            found["way"] = compact(way, FINE["deg"])
    return found
