"""Wrong answers of a single step: a ratio taken as 1, a stage forgotten, one component of an arm, one
angle.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from icsolve.answer import Answer
from icsolve.case import Belt, Case, Corner, Direction, Force, Gears, Load, Number, Torque
from icsolve.case.names import pair_name
from icsolve.grade.mistakes.changed import Place, as_radians, heading_of, known_loads, place_of, same_kind

_SAME = 1e-9
"""Rates and arms that differ less are the same."""


def ratio_steps(
    answer: Answer, load: Load, own: Load, factors: tuple[float, float]
) -> Iterator[tuple[str, float, str]]:
    """Code, factor of the load's share and place: the ratio of two links taken as 1, or one of its stages.

    w4/w2 is (w4/w3) (w3/w2): without one of the two, the other stands for all of it. ``factors`` are those of
    the load and of the unknown in the sum of power.
    """
    rates = answer.rates or {}
    first, second = rates.get(load.link), rates.get(own.link)
    where = f"links {own.link} and {load.link}"
    if isinstance(first, float) and isinstance(second, float) and first and second and load.link != own.link:
        yield "ratio-one", second / first, where
        yield "ratio-one", -second / first, where
        for link, rate in rates.items():
            if link in (load.link, own.link, answer.case.ground) or not isinstance(rate, float) or not rate:
                continue
            for stage in (rate / first, second / rate):
                if min(abs(abs(stage) - 1.0), abs(stage - second / first)) > _SAME:
                    yield "missed-stage", stage, f"link {link}"
                    yield "missed-stage", -stage, f"link {link}"
    mine, its = factors
    if same_kind(load, own) and mine and its:
        yield "ratio-one", its / mine, f"{own.name} and {load.name}"
        yield "ratio-one", -its / mine, f"{own.name} and {load.name}"


def one_component(answer: Answer, load: Load, centre: Place | None) -> Iterator[float]:
    """By what the moment of a force about a centre changes where only one of its components is taken."""
    at, heading = place_of(getattr(load, "at", ""), answer), heading_of(load, answer)
    if isinstance(load, Torque) or at is None or heading is None or centre is None:
        return
    angle = math.radians(heading)
    by_y = (at[0] - centre[0]) * math.sin(angle)
    by_x = -(at[1] - centre[1]) * math.cos(angle)
    size = abs(by_x) + abs(by_y)
    if min(abs(by_x), abs(by_y), abs(by_x + by_y)) > 1e-6 * size:
        yield by_x / (by_x + by_y)
        yield by_y / (by_x + by_y)


def one_arm(common: Place | None, first: Place | None, second: Place | None) -> Iterator[float]:
    """By what a ratio of two distances changes where one of them alone is taken, in the case's own unit."""
    if common is None or first is None or second is None:
        return
    above, below = math.dist(common, first), math.dist(common, second)
    if above and below:
        yield below
        yield 1.0 / above


def changed_angles(case: Case) -> Iterator[tuple[str, Case, str]]:
    """Code, case and place: one given angle fed in radians, its sine taken for its cosine, or turned
    round.
    """
    for n, angle in enumerate(case.angles):
        name = angle.a + angle.at + angle.b if isinstance(angle, Corner) else angle.a + angle.b
        for code, value in _misread(angle.value, len(case.angles) > 1):
            other: Direction | Corner = angle._replace(value=value)
            yield (
                code,
                replace(case, angles=(*case.angles[:n], other, *case.angles[n + 1 :])),
                f"angle {name}",
            )
    for load in known_loads(case):
        if isinstance(load, Force) and isinstance(load.heading, Number):
            for code, value in _misread(load.heading, True):
                changed = load._replace(heading=value)
                loads = tuple(changed if one.name == load.name else one for one in case.loads)
                yield code, replace(case, loads=loads), f"angle of {load.name}"


def _misread(angle: Number, alone: bool) -> Iterator[tuple[str, Number]]:
    """An angle that is misread; of multiples of 90 degrees nothing is misread but their sense."""
    degrees = angle.value % 360.0
    if degrees % 90.0:
        if alone:
            yield "deg-rad", as_radians(angle)
        if degrees % 45.0:
            yield "sin-cos", angle._replace(value=90.0 - angle.value)
    if degrees % 180.0:
        yield "angle-sense", angle._replace(value=-angle.value)


def without_stages(case: Case) -> Iterator[tuple[Case, str]]:
    """The case with the ratio of one mesh or belt left out."""
    for n, joint in enumerate(case.joints):
        if not isinstance(joint, Gears | Belt):
            continue
        first, second = joint.teeth if isinstance(joint, Gears) else joint.radii
        if abs(first.value) != abs(second.value):
            alike = second._replace(value=math.copysign(first.value, second.value * first.value))
            both = (first, alike)
            other = joint._replace(teeth=both) if isinstance(joint, Gears) else joint._replace(radii=both)
            links = pair_name(case, (joint.links[0], joint.links[1]))
            yield replace(case, joints=(*case.joints[:n], other, *case.joints[n + 1 :])), links
