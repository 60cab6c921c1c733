"""The rows of a sweep as a table: CSV, JSON Lines, or numpy's npz."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Callable, Iterator

import numpy as np

from icsolve.turn.swept import Sweep

Column = np.ndarray


def columns(sweep: Sweep) -> dict[str, Column]:
    """Every array of a sweep as columns of its table, by name, (n,) each."""
    table: dict[str, Column] = dict(sweep.vary)
    table |= sweep.answers
    table |= {f"error {name}": array for name, array in sweep.error.items()}
    for name, array in sweep.points.items():
        table |= {f"{name}.x": array[:, 0], f"{name}.y": array[:, 1]}
    for name, array in sweep.centres.items():
        table |= {f"I{name}.{axis}": array[:, k] for k, axis in enumerate("xyw")}
    table |= {f"w{name}": array for name, array in sweep.rates.items()}
    for name, array in sweep.holds.items():
        table |= {f"{name} from": array[:, 0], f"{name} to": array[:, 1]}
    table["status"] = sweep.status
    return table


def as_csv(sweep: Sweep) -> str:
    """A header and a line a row; what is not a number stands empty beside its status."""
    table = columns(sweep)
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(table)
    writer.writerows(zip(*(_cells(column) for column in table.values()), strict=True))
    return out.getvalue()


def as_jsonl(sweep: Sweep) -> str:
    """An object a row; what is not a number is null."""
    table = columns(sweep)
    rows = zip(*(_values(column) for column in table.values()), strict=True)
    return "".join(json.dumps(dict(zip(table, row, strict=True))) + "\n" for row in rows)


def as_npz(sweep: Sweep) -> bytes:
    """The arrays of the sweep in one npz, under the names of the columns."""
    out = io.BytesIO()
    np.savez(out, **columns(sweep))  # type: ignore[arg-type]
    return out.getvalue()


FORMATS: dict[str, Callable[[Sweep], str | bytes]] = {".csv": as_csv, ".jsonl": as_jsonl, ".npz": as_npz}


def _cells(column: Column) -> Iterator[str]:
    if column.dtype.kind != "f":
        return iter(column.tolist())
    return ("" if math.isnan(value) else repr(value + 0.0) for value in column.tolist())


def _values(column: Column) -> Iterator[float | str | None]:
    if column.dtype.kind != "f":
        return iter(column.tolist())
    return (None if math.isnan(value) else value + 0.0 for value in column.tolist())
