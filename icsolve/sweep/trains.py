"""Trains of wheels whose ratios only together tell how far a link turns."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import NamedTuple

from icsolve.numbers.arithmetic import Scalar
from icsolve.sweep.constraints import Turning

GONE = 1e-12
"""A factor that elimination leaves below this fraction of its parts is zero."""


class _Row(NamedTuple):
    """A sum of ratios: factors by body, degrees, and the ratio that it stands instead of."""

    factors: dict[int, Scalar]
    degrees: Scalar
    source: Turning


def together(
    ratios: Sequence[Turning], known: Collection[int]
) -> tuple[int, Turning, Turning] | None:
    """A body, the ratio of its rotation to known ones, and which of the given ratios that stands instead of.

    Elimination without division, so that whole numbers of teeth stay whole; None where no rotation
    follows from the known ones.
    """
    rows = [_row(ratio) for ratio in ratios]
    done: list[tuple[int, _Row]] = []
    while rows:
        body, row = max(
            ((b, r) for r in rows for b in _open(r, known)),
            key=lambda pair: abs(float(pair[1].factors[pair[0]])) / _size(pair[1]),
            default=(-1, rows[0]),
        )
        if body < 0:
            break
        rows = [_without(other, row, body) for other in rows if other is not row]
        done = [(b, _without(other, row, body)) for b, other in done]
        done.append((body, row))
    for body, row in done:
        if _open(row, known) == [body]:
            return body, Turning(tuple(row.factors.items()), row.degrees), row.source
    return None


def _row(ratio: Turning) -> _Row:
    factors: dict[int, Scalar] = {}
    for body, factor in ratio.terms:
        factors[body] = factors[body] + factor if body in factors else factor
    return _Row(factors, ratio.degrees, ratio)


def _open(row: _Row, known: Collection[int]) -> list[int]:
    """The bodies of a sum whose rotation is not known."""
    return [body for body in row.factors if body not in known]


def _size(row: _Row) -> float:
    return max(abs(float(factor)) for factor in row.factors.values())


def _without(row: _Row, pivot: _Row, body: int) -> _Row:
    """A sum less so many times another that a body is no longer in it."""
    if body not in row.factors:
        return row
    own, its = row.factors[body], pivot.factors[body]
    factors: dict[int, Scalar] = {}
    for other in dict.fromkeys((*row.factors, *pivot.factors)):
        a, b = row.factors.get(other, 0.0) * its, pivot.factors.get(other, 0.0) * own
        if other != body and abs(float(a - b)) > GONE * (abs(float(a)) + abs(float(b))):
            factors[other] = a - b
    return _Row(factors, row.degrees * its - pivot.degrees * own, row.source)
