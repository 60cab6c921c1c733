"""A position in which the loads balance, as the searches find it, and unknown loads that would show how far
from it another is, or how far friction is from slipping."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import suppress
from itertools import combinations

from icsolve.answer import Answer, Found
from icsolve.answer.equilibrium import Stiffness
from icsolve.case import Case, Force, Load, Number, Torque
from icsolve.case.joints import without_friction
from icsolve.errors import SceneError
from icsolve.kinematics.speeds import joint_order
from icsolve.scene import solve_scene
from icsolve.tuples import NamedTuple, replace
from icsolve.wording.senses import sense_of

PROBE = "@equilibrium"
"""The name of the unknown load by which `icsolve.solve` tells how far a position is from equilibrium."""
AT_LIMIT = "at a limit of the unknown the other links' rates per unit of it grow without bound."
MOST_TRIES = 28
"""Loads that might hold a mechanism of several freedoms are tried so many times."""
NEAR = 1e-6
"""Loads balance where the torque that would balance them is this small beside the largest times the size."""


class Rest(NamedTuple):
    """One position of equilibrium of a mode.

    ``answer`` is the solved scene in it and ``case`` that scene, ``links`` those that turn, the
    fastest first, ``size`` the torque of the largest load at the size of the figure [case units].
    """

    value: float
    error: float
    stability: str
    stiffness: Stiffness | None
    why: str
    answer: Answer
    case: Case
    links: list[str]
    size: float


def with_scene(
    answer: Answer,
    links: Sequence[str],
    freedoms: int = 1,
    *,
    all_centres: bool = False,
    rates: bool = False,
    reactions: bool = False,
) -> Answer:
    """The scene in a position with what is asked of it; reactions are those of loads that balance."""
    if not (all_centres or rates or reactions):
        return replace(answer, rates=None, velocities=None, centres={})
    asked = {"all_centres": all_centres, "rates": rates}
    found = held(answer.case, links, freedoms, **asked, reactions=True) if reactions else None
    found = found or solve_scene(answer.case, **asked)
    found = found if rates else replace(found, rates=None, velocities=None)
    shown = found.centres if all_centres else {}
    return replace(found, case=answer.case, answers={}, witnesses=(), centres=shown)


def balances(rest: Rest) -> bool:
    """Whether the loads balance there, to what a figure written in decimals can tell."""
    answer = held(rest.case, rest.links)
    return answer is None or abs(answer.answers[PROBE].value) <= NEAR * rest.size


def held(case: Case, links: Sequence[str], freedoms: int = 1, **asked: bool) -> Answer | None:
    """The scene with the first unknown loads, one a freedom, that do work in its motions; None where it has
    none to try. Of several freedoms those of the first loads that hold it with the least: in a position of
    equilibrium others may all but do no work in one motion, and are then as large as may be.

    Raises SceneError where none do.
    """
    refusal: SceneError | None = None
    best: tuple[float, Case] | None = None
    tries = combinations(probes(case, links, freedoms), freedoms)
    for n, some in enumerate(tries):
        if best is not None and n >= MOST_TRIES:
            break
        named = (load._replace(name=f"{PROBE}{k or ''}") for k, load in enumerate(some))
        loaded = replace(case, loads=(*case.loads, *named))
        try:
            answer = solve_scene(loaded, **(asked if freedoms == 1 else {}))
        except SceneError as error:
            refusal = error
            continue
        if freedoms == 1:
            return answer
        most = max(abs(answer.answers[load.name].value) for load in loaded.loads[len(case.loads) :])
        if best is None or most < best[0]:
            best = (most, loaded)
    if best is not None:
        return solve_scene(best[1], **asked)
    if refusal is not None:
        raise refusal
    return None


def probes(case: Case, links: Sequence[str], freedoms: int) -> Iterator[Torque | Force]:
    """Unknown loads, one after the other, each of which might hold the mechanism: torques on ``links``; where
    these are too few, forces on points."""
    for link in links:
        yield Torque(PROBE, link, None)
    if links and freedoms == 1:
        return
    for link, names in case.carries.items():
        for name in names if link != case.ground else ():
            for degrees in ("0", "90"):
                along = Number(float(degrees), 0.0, f"loads.{PROBE}.angle", degrees)
                yield Force(PROBE, link, name, None, along)


class OneMore(NamedTuple):
    """A load more, on a mechanism whose loads are known, and what its value is: with friction at rest the
    range in which it holds still."""

    load: Torque | Force
    found: Found

    def __str__(self) -> str:
        """Its value, where that is one, in words."""
        return self.said(self.found.value)

    def said(self, value: float) -> str:
        """A value of it, with its sense."""
        heading = getattr(self.load, "heading", None)
        sense = sense_of(self.load, value, 1.0, heading.value if heading else 0.0)
        return f"{abs(value):.6g} {self.found.unit} {sense} on link {self.load.link}"


def one_more(case: Case) -> OneMore | None:
    """The first load on a link, as the joints name them, that would do work; a torque where one does. None
    where none does, and where it has no value."""
    links = [link for link in joint_order(case) if link != case.ground]
    for load in (
        *probes(case, links, 1),
        *probes(case, [], 1),
    ):  # where nothing turns a force on a point holds it
        if not _works(case, load):
            continue
        with suppress(SceneError):
            loaded = replace(case, loads=(*case.loads, load), expect=())
            return OneMore(load, solve_scene(loaded).answers[PROBE])
    return None


def spare_friction(case: Case) -> float:
    """How far a mechanism under known loads is from slipping as written: the least load in either sense
    that would move it [case units], negative where it slips; infinite where none or any would."""
    low, high = moving_loads(case)
    return min(high, -low)


def moving_loads(case: Case) -> tuple[float, float]:
    """From what load to what load more on a link a mechanism under known loads holds still as written [case
    units]: infinite where none would move it, or where any does (turned about)."""
    more = one_more(replace(case, motion=()))
    if more is None:
        return math.inf, -math.inf
    return more.found.holds or (more.found.value, more.found.value)


def _works(case: Case, load: Load) -> bool:
    """Whether an unknown load does work: one that does none holds by the friction alone that it makes."""
    try:
        solve_scene(smooth(replace(case, loads=(*case.loads, load), expect=())))
    except SceneError:
        return False
    return True


def smooth(case: Case) -> Case:
    """The case without friction."""
    ropes = tuple(rope._replace(mu=(None,) * len(rope.mu)) for rope in case.ropes)
    return replace(case, joints=tuple(map(without_friction, case.joints)), ropes=ropes)


def judged_with_friction(answer: Answer, case: Case) -> Answer:
    """The answer of a case whose loads are all known, with whether these hold it still, or keep up the given
    motion, friction counted: by the load that it would take besides."""
    if answer.mobility != 1:
        return replace(answer, notes=(*answer.notes, OPEN.format(answer.mobility)))
    more = one_more(case)
    if more is None:
        return replace(answer, notes=(*answer.notes, OPEN.format(1)))
    if case.motion:
        keeps = abs(more.found.value) <= (more.found.error or 0.0)
        said = KEEPS if keeps else f"{KEEPS_NOT} {more} besides would."
        return replace(answer, notes=(*answer.notes, said))
    low, high = more.found.holds or (more.found.value, more.found.value)
    holds = low <= 0.0 <= high
    ends = [more.said(end) for end in (low, high) if math.isfinite(end)]
    if holds:
        said = f"{HOLDS} {' or '.join(ends)} besides would move it." if ends else HOLDS
    else:
        said = f"{SLIPS} {' to '.join(ends)} besides would hold it." if len(ends) > 1 else SLIPS
    return replace(answer, notes=(*answer.notes, said), holds_still=holds)


OPEN = "whether friction is enough for the known loads is open (mobility {})."
HOLDS = "friction is enough: under the known loads the mechanism holds still."
SLIPS = "friction is not enough: under the known loads the mechanism moves."
KEEPS = "with friction the known loads just keep up this motion."
KEEPS_NOT = "the known loads do not keep up this motion against friction:"
