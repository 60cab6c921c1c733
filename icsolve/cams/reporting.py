"""The pressure angles of a cam for `solve --report`: now, and over a turn."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from icsolve.answer import Answer
from icsolve.case import Case, Pin
from icsolve.errors import SceneError
from icsolve.wording.sentences import listed

STEP = 2.0
"""Degrees between the positions of a turn that are looked at."""


class Pressure(NamedTuple):
    """The pressure angle of a contact, degrees: now, and its least and greatest over a turn of ``cam``.

    ``over`` is None where the cam does not turn fully with its follower on it.
    """

    links: tuple[str, str]
    on: str
    now: float | None
    cam: str
    over: tuple[float, float] | None = None

    def text(self, digits: int) -> str:
        """A line for people."""
        if self.now is None:
            return f"  contact of links {listed(self.links)}: its follower has no guide on the frame"
        said = f"  contact of links {listed(self.links)}: pressure angle {self.now + 0.0:.{digits}g} deg"
        if self.over is None:
            return said
        least, greatest = self.over
        return f"{said}, from {least:.4g} to {greatest:.4g} over a turn of link {self.cam} by {STEP:g} deg"


def pressures(answer: Answer) -> tuple[Pressure, ...]:
    """The pressure angles of an answer, in the order of the contacts."""
    case, found = answer.case, []
    for one in answer.touching:
        cam = _cam(case, one.links)
        over = _over_a_turn(case, cam) if one.pressure_angle is not None else {}
        found.append(Pressure(one.links, one.on, one.pressure_angle, cam, over.get(one.links)))
    return tuple(found)


def _cam(case: Case, links: tuple[str, str]) -> str:
    """The link of a contact that has the profile."""
    from icsolve.case.profiles import Flat, Knife, Roller

    assert case.profiles is not None
    a, b = links
    return b if isinstance(case.profiles.shapes[a], Flat | Roller | Knife) else a


def _over_a_turn(case: Case, cam: str) -> Mapping[tuple[str, str], tuple[float, float]]:
    """Least and greatest pressure angle of every contact that the whole turn of a cam keeps."""
    if not any(isinstance(j, Pin) and {cam, case.ground} <= {*j.links} for j in case.joints):
        return {}
    import numpy as np

    from icsolve.cams.course import Course, Rows
    from icsolve.sweep.ask import Columns

    try:
        rows = Rows(Course(case), Columns({}, {cam: np.arange(0.0, 360.0, STEP)}, {cam: cam}))
        if rows.codes.any():
            return {}
        seen: dict[tuple[str, str], list[float]] = {}
        for row in range(rows.columns.rows):
            for one in rows.touching(row):
                if one.pressure_angle is not None:
                    seen.setdefault(one.links, []).append(one.pressure_angle)
    except SceneError:
        return {}
    return {links: (min(angles), max(angles)) for links, angles in seen.items()}
