"""One row of a sweep as a case of its own: all points by coordinates, directions as they have turned."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from icsolve.case import Case, Centroid, Coordinates, Number
from icsolve.numbers.arithmetic import Scalar
from icsolve.numbers.record import Record, Traced
from icsolve.numbers.replay import Array, Code
from icsolve.sweep.numbers import with_numbers
from icsolve.sweep.program import Sheet


class RowCases:
    """Cases of single rows; ``sheet`` has any outputs, its scene has every point."""

    def __init__(self, sheet: Sheet) -> None:
        self.sheet, record = sheet, sheet.record
        self.scene = sheet.scene
        self.points = dict(self.scene.points)
        self.directions = {own.path: (c, s) for own, c, s in record.directions.values()}
        self.numbers = {path: value for path, value in record.vary.items() if path.endswith("@")}
        pairs = (*self.points.values(), *self.directions.values())
        self.flat = [*(v for pair in pairs for v in pair), *self.numbers.values()]
        self.code = Code(record, [_index(record, v) for v in self.flat])

    def at(self, given: Mapping[int, Array], values: Mapping[str, float]) -> Case:
        """The case of a row: ``given`` has its inputs (arrays of one), ``values`` its varied numbers."""
        if not self.sheet.setting.moves:
            return with_numbers(self.sheet.setting.case, values)
        found = iter([float(v) for v in (np.ravel(x)[0] for x in self.code.run(given, 1))])
        ox, oy, scale = self.scene.frame
        points = {name: (next(found) / scale + ox, next(found) / scale + oy) for name in self.points}
        turned = {path: _degrees(next(found), next(found)) for path in self.directions}
        stood = {path: next(found) for path in self.numbers}
        return self._case(points, {**values, **turned, **stood})

    def _case(self, points: Mapping[str, tuple[float, float]], values: Mapping[str, float]) -> Case:
        case = with_numbers(self.scene.case, values)
        placed: dict[str, Coordinates | Centroid] = {n: _coordinates(n, *at) for n, at in points.items()}
        motion = tuple(m._replace(angle=None) if m.point else m for m in case.motion)
        case = replace(case, lengths=(), angles=(), near={}, motion=motion, expect=())
        return replace(case, points=placed, carries=self._carried())

    def _carried(self) -> dict[str, tuple[str, ...]]:
        return {
            link: tuple(name for name in names if name in self.points)
            for link, names in self.scene.case.carries.items()
        }


def _index(record: Record, value: Scalar) -> int:
    return value.index if isinstance(value, Traced) else record.lifted(value).index


def _coordinates(name: str, x: float, y: float) -> Coordinates:
    return Coordinates(_exact(x, f"points.{name}.x"), _exact(y, f"points.{name}.y"))


def _exact(value: float, path: str) -> Number:
    return Number(value, 0.0, path, repr(value))


def _degrees(c: float, s: float) -> float:
    return math.degrees(math.atan2(s, c))
