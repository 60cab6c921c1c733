"""What varied numbers do: they move the mechanism, reshape it, or change a load.

A number that only poses the figure becomes a condition on where the links are. Of the other data that
pose it, as many are held as the mechanism has freedoms left.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from icsolve.assembly.data import data_of, number_of
from icsolve.assembly.workspace import Workspace
from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.numbers.arithmetic import FLOATS
from icsolve.sweep.constraints import Constraint, Immovable, Rows, Turning
from icsolve.sweep.mechanism import Mechanism
from icsolve.sweep.poses import Still
from icsolve.sweep.posing import KINDS, Pose, condition, pose_of, posing, value_of
from icsolve.sweep.smallest import Matrix, bases_of, jacobian, matrix, rank
from icsolve.wording.sentences import listed, plural

NOISE = 1e-9
"""A part of a unit motion that is none (rounding)."""


class Drive(NamedTuple):
    """Which of the varied paths move the mechanism, and which data are held while it moves."""

    moving: tuple[str, ...]
    held: tuple[Pose, ...]
    locked: tuple[int, ...]
    """bodies that only spin, which are kept from it"""


def drive_of(mechanism: Mechanism, paths: Sequence[str], links: Sequence[str]) -> Drive:
    """Which varied paths move the mechanism, and what is held.

    Raises SceneError where a link cannot be turned, or all is rigid.
    """
    case = mechanism.case
    bodies = [body for body in mechanism.spots if body != mechanism.top.ground]
    rows = jacobian(mechanism, bodies, mechanism.constraints)
    left = 3 * len(bodies) - rank(rows)
    for link in links:
        body = mechanism.top.body_of[link]
        rows, taken = _added(mechanism, bodies, rows, Turning(((body, 1.0),)))
        if not taken:
            still = next((c for c in mechanism.constraints if isinstance(c, Immovable)), None)
            if still is not None and not left:
                raise still.refusal
            raise _cannot_turn(case, link, left, body == mechanism.top.ground)
        left -= 1
    moving: list[str] = []
    before, freedoms = rows, left
    for path in paths:
        pose = pose_of(mechanism, path)
        if pose is None:
            continue
        rows, taken = _added(mechanism, bodies, rows, condition(mechanism, pose, value_of(case, pose.datum)))
        if taken:
            moving.append(path)
            left -= 1
        elif links:
            raise _too_many(path, freedoms + len(links), links)
        elif moving or freedoms == 0:
            moving, rows, left = [], before, freedoms
            break
    if not moving and not links:
        return Drive((), (), ())
    held, rows, left = _held(mechanism, bodies, rows, left, moving)
    return Drive(tuple(moving), held, _spinning(mechanism, bodies, rows, left))


def _added(
    mechanism: Mechanism, bodies: Sequence[int], rows: Matrix, constraint: Constraint
) -> tuple[Matrix, bool]:
    """The equations with one more, if it takes a freedom."""
    still = Rows(
        mechanism.shape,
        Still(mechanism.shape),
        bases_of(mechanism, bodies),
        Workspace(mechanism.case, mechanism.frame, FLOATS),
    )
    more = np.vstack([rows, matrix(bodies, [still.of(constraint)])])
    return (more, True) if rank(more) > rank(rows) else (rows, False)


def _held(
    mechanism: Mechanism, bodies: Sequence[int], rows: Matrix, left: int, moving: Sequence[str]
) -> tuple[tuple[Pose, ...], Matrix, int]:
    """The other data that pose the figure, as many as there are freedoms."""
    held = []
    for datum in data_of(mechanism.case):
        if not left:
            break
        if datum.kind not in KINDS or number_of(mechanism.case, datum).path in moving:
            continue
        pose = posing(mechanism, datum)
        if pose is None:
            continue
        held_at = condition(mechanism, pose, value_of(mechanism.case, datum))
        rows, taken = _added(mechanism, bodies, rows, held_at)
        if taken:
            held.append(pose)
            left -= 1
    return tuple(held), rows, left


def _spinning(mechanism: Mechanism, bodies: Sequence[int], rows: Matrix, left: int) -> tuple[int, ...]:
    """Bodies that are free to spin while all others stand."""
    if not left:
        return ()
    free = np.linalg.svd(rows)[2][rows.shape[1] - left :]
    locked: list[int] = []
    for n, body in enumerate(bodies):
        others = np.delete(free, [3 * n, 3 * n + 1, 3 * n + 2], axis=1)
        others[np.abs(others) < NOISE] = 0.0
        if rank(others) < left - len(locked):
            locked.append(body)
    return tuple(locked)


def _too_many(path: str, freedoms: int, links: Sequence[str]) -> SceneError:
    return SceneError(
        Status.MOBILITY,
        f"{path} and the turning of {'link' if len(links) == 1 else 'links'} {listed(links)} cannot both be "
        f"given: the mechanism has {plural(freedoms, 'degree')} of freedom. Leave one out.",
    )


def _cannot_turn(case: Case, link: str, left: int, ground: bool) -> SceneError:
    why = f"link {link} is the frame" if ground else f"link {link} does not turn, or not by itself"
    if not left and not ground:
        why = "no freedom is left for it"
    return SceneError(
        Status.MOBILITY,
        f"link {link} cannot be the driving link: {why}. Turn another link, or vary an angle, a length or a "
        "coordinate that poses the figure.",
    )
