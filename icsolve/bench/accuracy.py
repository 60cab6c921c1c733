"""Error and time of every method on every family of scenes."""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Iterator
from random import Random
from statistics import median
from typing import NamedTuple

from icsolve.bench.families import Family
from icsolve.bench.methods import Method
from icsolve.bench.reference import Truth, truth
from icsolve.bench.rivals import Drawn, Failed, OtherData, drawn
from icsolve.errors import SceneError
from icsolve.read import load

WRONG = 0.1
"""A relative error above this is no answer."""


class Score(NamedTuple):
    """A method on a family.

    ``error`` and ``per_unit`` (the error over (kappa + 1) u) are the worst where there is an answer,
    ``micros`` the median time of a scene (where all are lost: until that shows); ``failed`` counts
    scenes without an answer or with a wrong one, ``refused`` those refused with a cause, of ``scenes``.
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
    """Run a method on the scenes of a family; where it is made for other data it has no scenes."""
    errors, units, times, lost = [], [], [], []
    refused = 0
    for scene, true in known:
        try:
            tried = _tried(method, scene)
        except OtherData:
            continue
        error = true.error(tried.value) if math.isfinite(tried.value) else math.inf
        if error > WRONG:
            refused += tried.refused
            lost.append(tried.seconds)
            continue
        times.append(tried.seconds)
        errors.append(error)
        units.append(true.per_unit(error))
    worst, unit = max(errors, default=math.nan), max(units, default=math.nan)
    micros = 1e6 * median(times or lost or [math.nan])
    count = len(times) + len(lost)
    return Score(method.name, family.name, worst, unit, micros, len(lost) - refused, refused, count)


class Tried(NamedTuple):
    """A value (nan without one), its seconds, and whether the scene was refused with a cause."""

    value: float
    seconds: float
    refused: bool


def _tried(method: Method, scene: Drawn) -> Tried:
    """The better time of two runs, of this thread alone (matrix routines may wake others that wait);
    one that ends without an answer takes time too.

    Raises OtherData where the method is made for figures given in another way.
    """
    best, value, refused = math.inf, math.nan, False
    for _ in range(2):
        start = time.thread_time()
        try:
            value = float(method.run(scene))
        except SceneError:
            refused = True
        except (Failed, ArithmeticError, ValueError, TypeError, StopIteration):
            pass
        best = min(best, time.thread_time() - start)
    return Tried(value, best, refused)
