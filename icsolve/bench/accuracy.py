"""Error and time of every method on every family of scenes."""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Iterator
from random import Random
from statistics import median
from typing import NamedTuple

from icsolve.bench.families import Family
from icsolve.bench.laws import LOST
from icsolve.bench.methods import Method
from icsolve.bench.reference import Truth, truth
from icsolve.bench.rivals import Drawn, Failed, OtherData, drawn
from icsolve.errors import SceneError
from icsolve.read import load

WRONG = 0.1
"""A relative error above this is no answer."""


class Score(NamedTuple):
    """A method on a family.

    ``error`` and ``per_unit`` (the error over (kappa + 1) u) are the worst, ``micros`` the median time
    of a scene; ``failed`` counts scenes without an answer or with a wrong one, of ``scenes``.
    """

    method: str
    family: str
    error: float
    per_unit: float
    micros: float
    failed: int
    refused: int
    scenes: int


class Known(NamedTuple):
    """A scene and what is true of it."""

    scene: Drawn
    truth: Truth


def scenes(family: Family, count: int) -> Iterator[Known]:
    """Scenes of a family that have an answer in exact arithmetic."""
    for k in range(count):
        case = load(family.draw(Random(f"{family.name} {k}")))
        try:
            known = Known(drawn(case), truth(case))
        except SceneError:
            continue
        if known.truth.value != 0:
            yield known


def scored(method: Method, family: Family, known: Iterable[Known]) -> Score:
    """Run a method on the scenes of a family."""
    errors, units, times = [], [], []
    failed = refused = count = 0
    for scene, true in known:
        count += 1
        try:
            value, seconds = _timed(method, scene)
        except SceneError:
            refused += 1
            continue
        except OtherData:
            continue
        except (Failed, ArithmeticError, ValueError, TypeError, StopIteration):
            failed += 1
            continue
        error = true.error(value) if math.isfinite(value) else math.inf
        if true.kappa * 2.0**-53 > LOST:
            continue
        times.append(seconds)
        if error > WRONG:
            failed += 1
            continue
        errors.append(error)
        units.append(true.per_unit(error))
    worst, unit = max(errors, default=math.nan), max(units, default=math.nan)
    micros = 1e6 * median(times) if times else math.nan
    return Score(method.name, family.name, worst, unit, micros, failed, refused, count)


def _timed(method: Method, scene: Drawn) -> tuple[float, float]:
    """The value, and the better time of two runs."""
    best = math.inf
    for _ in range(2):
        start = time.perf_counter()
        value = method.run(scene)
        best = min(best, time.perf_counter() - start)
    return float(value), best
