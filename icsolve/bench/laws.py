"""Laws held on random scenes: the forward error and the error bound against sixty digits, and that a
scale of a power of two changes no bit."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from random import Random
from statistics import median
from typing import NamedTuple

from icsolve.bench.families import ALL_JOINTS, BOUNDED, SIX_BARS, Family
from icsolve.bench.pinned import Draw
from icsolve.bench.reference import AsWritten, truth
from icsolve.bench.scaled import scaled
from icsolve.case import Case
from icsolve.errors import SceneError
from icsolve.read import load
from icsolve.solve import solve
from icsolve.solve.program import Want, evaluate, prepare

FORWARD = 4.0
"""Forward error over (kappa + 1) u that no scene may exceed."""
PESSIMISM = 100.0
"""Bound over error that a median may have."""
SCALES = (-37, 11)
"""Powers of two for lengths and for loads."""
SCENES_A_JOB = 50


class Law(NamedTuple):
    """A law on a family: how many scenes were held to it, how many broke it, median and worst.

    For the forward error median and worst are of error / ((kappa + 1) u); for the bound, of bound / error.
    """

    family: str
    scenes: int
    broken: int
    median: float
    worst: float


Measure = Callable[[Case], float]
"""What a law says of a scene: the number that is tabled; negative where the law is broken."""


def forward_error(case: Case) -> float:
    """Forward error on the doubles as read, in units of (kappa + 1) u."""
    true = truth(case)
    value = solve(case, bound=False).answers["U"].value
    ratio = true.per_unit(true.error(value))
    return ratio if ratio <= FORWARD else -ratio


def bound_over_error(case: Case) -> float:
    """Error bound over the true error (half a unit of the value at least) against the file's decimals."""
    found = solve(case).answers["U"]
    program = prepare(case, Want())
    _, exact = evaluate(program, AsWritten())
    true = abs(found.value - next(iter(exact.solution.values.values())))
    assert found.error is not None
    ratio = found.error / max(float(true), abs(found.value) * 2.0**-53, math.ulp(0.0))
    return ratio if true <= found.error else -ratio


def bits_kept(case: Case) -> float:
    """1 where lengths and loads times powers of two give the same bits of the value; else -1."""
    value = solve(case, bound=False).answers["U"].value
    try:
        other = solve(scaled(case, *SCALES), bound=False).answers["U"].value
    except SceneError:
        return -1.0
    return 1.0 if other == math.ldexp(value, SCALES[1]) else -1.0


FORWARD_FAMILIES = (*SIX_BARS, ALL_JOINTS)
HELD = (*FORWARD_FAMILIES, *BOUNDED)


def held(measure: Measure, families: Iterable[Family], scenes: int, jobs: int = 1) -> list[Law]:
    """Hold a law on families, in so many processes."""
    return [_table(family.name, _all(measure, family, scenes // family.weight, jobs)) for family in families]


def _table(name: str, values: list[float]) -> Law:
    sizes = [abs(value) for value in values]
    broken = sum(value < 0.0 for value in values)
    return Law(name, len(values), broken, median(sizes or [math.nan]), max(sizes, default=math.nan))


def _all(measure: Measure, family: Family, scenes: int, jobs: int) -> list[float]:
    firsts = range(0, scenes, SCENES_A_JOB)
    if jobs == 1 or family not in HELD:
        return [value for k in firsts for value in _block(measure, family, k, scenes)]
    from multiprocessing import Pool

    blocks = [(measure, HELD.index(family), k, scenes) for k in firsts]
    with Pool(jobs) as pool:
        return [value for values in pool.starmap(_job, blocks) for value in values]


def _job(measure: Measure, place: int, first: int, scenes: int) -> list[float]:
    """A block in a process of its own, which finds the family by its place."""
    return _block(measure, HELD[place], first, scenes)


def _block(measure: Measure, family: Family, first: int, scenes: int) -> list[float]:
    seeds = range(first, min(first + SCENES_A_JOB, scenes))
    return list(_measured(measure, family.name, family.draw, seeds))


def _measured(measure: Measure, name: str, draw: Draw, seeds: Iterable[int]) -> Iterator[float]:
    """The scenes that have an answer; refusals are counted elsewhere."""
    for seed in seeds:
        try:
            yield measure(load(draw(Random(f"{name} {seed}"))))
        except SceneError:
            continue


def forward(scenes: int, jobs: int = 1) -> list[Law]:
    """The forward error on random six-bars."""
    return held(forward_error, FORWARD_FAMILIES, scenes, jobs)


def bounds(scenes: int, jobs: int = 1) -> list[Law]:
    """The error bound on random scenes of all joint kinds."""
    return held(bound_over_error, BOUNDED, scenes, jobs)


def bits(scenes: int, jobs: int = 1) -> list[Law]:
    """Powers of two, on scenes of all joint kinds and on figures from lengths."""
    return held(bits_kept, BOUNDED, scenes, jobs)
