"""Where every link of a mechanism is in every row of a sweep: a point of it, and how far it has turned."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from icsolve.case import Slide
from icsolve.construction import Known
from icsolve.sweep import Sweep

Array = np.ndarray


class Pose(NamedTuple):
    """Where a link is in every row: the place of one of its points, and its angle from the position as
    written, degrees counterclockwise."""

    point: str
    x: Array
    y: Array
    angle: Array


def poses_of(known: Known, driver: str, degrees: Array, zero: int, found: Sweep) -> dict[str, Pose]:
    """The pose of every link that carries a point."""
    case = known.case
    poses: dict[str, Pose] = {}
    waiting = [link for link in case.links if link != case.ground]
    for attempt in (_by_points, _by_guide, _by_rate):
        for link in list(waiting):
            pose = attempt(known, link, driver, degrees, zero, found, poses)
            if pose is not None:
                poses[link] = pose
                waiting.remove(link)
    return poses


def _carried(known: Known, link: str, found: Sweep) -> list[str]:
    return [p for p in known.case.carries.get(link, ()) if p in found.points]


def _by_points(
    known: Known, link: str, driver: str, degrees: Array, zero: int, found: Sweep, poses: Mapping[str, Pose]
) -> Pose | None:
    """By two points of the link that lie apart."""
    names = _carried(known, link, found)
    if len(names) < 2:
        return None
    a, b = max(
        ((p, q) for p in names for q in names), key=lambda two: math.dist(*(known.points[p] for p in two))
    )
    if math.dist(known.points[a], known.points[b]) <= 1e-9 * known.size:
        return None
    p, q = found.points[a], found.points[b]
    angle = np.degrees(np.arctan2(q[:, 1] - p[:, 1], q[:, 0] - p[:, 0]))
    return Pose(a, p[:, 0], p[:, 1], _from(angle, zero))


def _from(angle: Array, zero: int) -> Array:
    """Angles from that of the position as written, without jumps of a turn."""
    turned = angle - angle[zero]
    return np.asarray((turned + 180.0) % 360.0 - 180.0)


def _by_guide(
    known: Known, link: str, driver: str, degrees: Array, zero: int, found: Sweep, poses: Mapping[str, Pose]
) -> Pose | None:
    """As the link turns on which it slides."""
    names = _carried(known, link, found)
    for joint in known.case.joints:
        if isinstance(joint, Slide) and link in joint.links and names:
            other = joint.links[1 - joint.links.index(link)]
            place = found.points[names[0]]
            if other == known.case.ground:
                return Pose(names[0], place[:, 0], place[:, 1], np.zeros(len(degrees)))
            if other in poses:
                return Pose(names[0], place[:, 0], place[:, 1], poses[other].angle)
    return None


def _by_rate(
    known: Known, link: str, driver: str, degrees: Array, zero: int, found: Sweep, poses: Mapping[str, Pose]
) -> Pose | None:
    """By its rate beside the driver's, summed from row to row (a gear of which nothing else shows)."""
    names = _carried(known, link, found)
    if not names:
        return None
    ratio = np.zeros(len(degrees))
    if link in found.rates and driver in found.rates:
        with np.errstate(all="ignore"):
            ratio = np.nan_to_num(found.rates[link] / found.rates[driver], posinf=0.0, neginf=0.0)
    steps = 0.5 * (ratio[1:] + ratio[:-1]) * np.diff(degrees)
    total = np.concatenate(([0.0], np.cumsum(steps)))
    place = found.points[names[0]]
    return Pose(names[0], place[:, 0], place[:, 1], total - total[zero])


def moved(pose: Pose, start: tuple[float, float], p: tuple[float, float]) -> tuple[Array, Array]:
    """Where a point of a link is in every row; ``start`` is the place of the pose's point as written."""
    turn = np.radians(pose.angle)
    dx, dy = p[0] - start[0], p[1] - start[1]
    co, si = np.cos(turn), np.sin(turn)
    return pose.x + co * dx - si * dy, pose.y + si * dx + co * dy
