"""The rows of a sweep as a table: CSV, JSON Lines, or numpy's npz, part by part."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np

from icsolve.numbers.replay import Array
from icsolve.sweep.second import WORDS
from icsolve.sweep.swept import Sweep

PART = 8192
"""Rows that are written at once."""


def columns(sweep: Sweep) -> dict[str, Array]:
    """Every array of numbers of a sweep as columns of its table, by name, (n,) each."""
    table: dict[str, Array] = dict(sweep.vary)
    for kind, arrays in sweep.kinds.items():
        bounds = sweep.errors.get(kind, {})
        for name, array in arrays.items():
            table |= _parted(kind, name, array)
            if name in bounds:
                table |= {f"error {n}": bound for n, bound in _parted(kind, name, bounds[name]).items()}
    for name, array in sweep.holds.items():
        table |= {f"{name} from": array[:, 0], f"{name} to": array[:, 1]}
    return table


def _parted(kind: str, name: str, array: Array) -> dict[str, Array]:
    """The columns of one array."""
    if kind == "points":
        return {f"{name}.x": array[:, 0], f"{name}.y": array[:, 1]}
    if kind == "centres":
        return {f"I{name}.{axis}": array[:, k] for k, axis in enumerate("xyw")}
    return {name if kind == "answers" else f"w{name}": array}


def as_csv(sweep: Sweep) -> Iterator[bytes]:
    """A header and a line a row; what is not a number stands empty beside its status."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([*columns(sweep), "status"])
    for part in _parts(sweep, lambda value: "" if math.isnan(value) else repr(value + 0.0)):
        writer.writerows(zip(*part.values(), strict=True))
        yield out.getvalue().encode("utf-8")
        out.seek(0)
        out.truncate()


def as_jsonl(sweep: Sweep) -> Iterator[bytes]:
    """An object a row; what is not a number is null."""
    for part in _parts(sweep, lambda value: None if math.isnan(value) else value + 0.0):
        rows = zip(*part.values(), strict=True)
        yield "".join(json.dumps(dict(zip(part, row, strict=True))) + "\n" for row in rows).encode("utf-8")


def as_npz(sweep: Sweep) -> Iterator[bytes]:
    """The arrays of the sweep in one npz, under the names of the columns."""
    out = io.BytesIO()
    arrays: Mapping[str, Any] = {**columns(sweep), "status": sweep.status}
    np.savez(out, **arrays)
    yield out.getvalue()


FORMATS: dict[str, Callable[[Sweep], Iterator[bytes]]] = {
    ".csv": as_csv,
    ".jsonl": as_jsonl,
    ".npz": as_npz,
}


def _parts(sweep: Sweep, shown: Callable[[float], object]) -> Iterator[dict[str, list[Any]]]:
    """The columns of so many rows after another, as lists; the status in words last."""
    table = columns(sweep)
    for start in range(0, len(sweep), PART):
        rows = slice(start, start + PART)
        part = {name: [shown(value) for value in column[rows].tolist()] for name, column in table.items()}
        yield {**part, "status": [WORDS[code] for code in sweep.codes[rows].tolist()]}
