"""A record replayed on arrays: straight-line code on a few buffers that stay in the cache.

Only what leads to the wanted nodes is run. A buffer is free again after the last use of its value.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from threading import get_ident
from typing import Any

import numpy as np
import numpy.typing as npt

from icsolve.numbers.record import Op, Record, live
from icsolve.numbers.source import PYTHON, straight_line
from icsolve.tuples import cached_property

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]
BLOCK = 4096
"""Rows that run at once: some thirty buffers of them fit the second-level cache."""
FEW = 256
LEAST = 8
MOST_SIZES = 24
SCRATCH = 4
SOON = 64
"""So many runs of one row take as long as it takes to write them as Python."""

Step = tuple[Callable[..., Any], tuple[Any, ...]]

BINARY = {Op.ADD: np.add, Op.SUB: np.subtract, Op.MUL: np.multiply, Op.DIV: np.divide}
TURNS = (Op.COS, Op.SIN)
"""What is found together, and reads its angle after it has written."""


class Code:
    """Straight-line code from the inputs to the wanted nodes.

    Parameters
    ----------
    record : the record, which may grow afterwards
    wanted : indices of the nodes whose values are asked for
    keep : whether every value is kept, for a pass backwards
    """

    def __init__(self, record: Record, wanted: Sequence[int], keep: bool = False) -> None:
        self.nodes, self.keep = record.nodes, keep
        self.wanted = tuple(wanted)
        found, nodes = live(record.nodes, wanted), record.nodes
        self.given = tuple([k for k in found if nodes[k].op == Op.INPUT])
        self.order = [k for k in found if nodes[k].op != Op.INPUT]
        self.place, self.buffers = self._allocated()
        self._bound: dict[tuple[int, int], tuple[list[Step], Array]] = {}
        self.singles = 0
        """runs of one row so far"""
        self._columns = [self.place.get(k, 0) for k in self.wanted]
        self._still = [n for n, k in enumerate(self.wanted) if k not in self.place]
        self._constants = np.array([[nodes[self.wanted[n]].value] for n in self._still]).reshape(-1, 1)

    def _allocated(self) -> tuple[dict[int, int], int]:
        """The buffer of every node, and how many there are."""
        nodes = [self.nodes[k] for k in self.order]
        last = {n: at for at, node in enumerate(nodes) for n in node.of}
        keep = {*self.wanted, *self.given, *(self.order if self.keep else ())}
        place = {k: at for at, k in enumerate(self.given)}
        free: list[int] = []
        count = len(place)
        for at, node in enumerate(nodes):
            own, gone = node.index, []
            for n in node.of:
                if last[n] == at and n not in keep and n in place and place[n] not in gone:
                    gone.append(place[n])
            in_place = node.op not in TURNS
            if in_place:
                free += gone
            if free:
                place[own] = free.pop()
            else:
                place[own] = count
                count += 1
            if not in_place:
                free += gone
        return place, count

    def bound(self, rows: int) -> tuple[list[Step], Array]:
        """The steps and their buffers, (buffers + SCRATCH, room), for so many rows.

        ``room`` is ``rows``, or for few rows the next power of two; there is one set a thread.
        """
        room = rows if rows > FEW else max(LEAST, 1 << (rows - 1).bit_length())
        key = (room, get_ident())
        if key not in self._bound:
            if len(self._bound) > MOST_SIZES:
                self._bound.clear()
            buffers = np.zeros((self.buffers + SCRATCH, room))
            self._bound[key] = (list(self._steps(buffers)), buffers)
        return self._bound[key]

    def _steps(self, buffers: Array) -> Iterable[Step]:
        nodes, rows = self.nodes, list(buffers)
        held = {k: rows[place] for k, place in self.place.items()}
        for n in (n for k in self.order for n in nodes[k].of if n not in held):
            held[n] = np.array(nodes[n].value)
        sines = {nodes[k].b: k for k in self.order if nodes[k].op == Op.SIN}
        done: set[int] = set()
        for k in self.order:
            node, out = nodes[k], held[k]
            operation = BINARY.get(node.op)
            if operation is not None:
                yield operation, (held[node.a], held[node.b], out)
            elif k in done:
                continue
            elif node.op == Op.NEG:
                yield np.negative, (held[node.a], out)
            elif node.op == Op.SQRT:
                yield partial(np.maximum, out=out), (held[node.a], 0.0)  # but for rounding
                yield np.sqrt, (out, out)
            elif node.op == Op.ANGLE:
                yield np.arctan2, (held[node.b], held[node.a], out)
                yield np.degrees, (out, out)
            elif node.op == Op.NEAREST:
                yield np.rint, (held[node.a], out)
            else:
                sine = k if node.op == Op.SIN else sines.get(k)
                cosine = k if node.op == Op.COS else None
                done.update(() if sine is None else (sine,))
                outs = [None if n is None else held[n] for n in (cosine, sine)]
                yield turn, (held[node.a], *outs, *rows[-SCRATCH:])

    def held(self, k: int, buffers: Array) -> Array:
        """The whole buffer of a node, (room,), among those of `bound`; () where it does not vary."""
        found: Array = buffers[self.place[k]] if k in self.place else np.array(self.nodes[k].value)
        return found

    def run(self, given: Mapping[int, Array], rows: int) -> list[Array]:
        """The wanted nodes for the given ones.

        Parameters
        ----------
        given : by node, an array (rows,) or one number for all rows; inputs that lead to no wanted node may
            fail
        rows : how many rows, 1 at least

        Returns
        -------
        list[Array]
            For each wanted node (rows,), or () where it is the same in every row. They are views of the
            code's own buffers: they hold until the next run in this thread. Angles are in degrees.

        Raises
        ------
        KeyError
            Where an input that leads to a wanted node is not given. Numbers raise nothing: what does not
            exist is nan or inf, but a root of what is negative is 0.
        """
        buffers = self.fill(given, rows)
        return [self._cut(k, buffers, rows) for k in self.wanted]

    def table(self, given: Mapping[int, Array], rows: int) -> Array:
        """As `run`, in one array of its own: (wanted, rows). One row is run as Python, once it pays."""
        if rows == 1:
            self.singles += 1
            if self.singles > SOON:
                with suppress(ArithmeticError, ValueError):  # of what is not finite
                    return np.array([self._one(*(np.asarray(given[k]).item() for k in self.given))]).T
        buffers = self.fill(given, rows)
        found: Array = buffers[self._columns, :rows]
        found[self._still] = self._constants
        return found

    @cached_property
    def _one(self) -> Callable[..., tuple[float, ...]]:
        """The wanted nodes of one row of floats, by the same operations; it raises what is not finite."""
        names = {k: f"x{n}" for n, k in enumerate(self.given)}
        text = straight_line(self.nodes, self.wanted, names, PYTHON)
        lines = [*text.lines, f"return ({''.join(f'{value},' for value in text.wanted)})"]
        source = f"def one({', '.join(names.values())}):\n" + "".join(f"    {line}\n" for line in lines)
        scope: dict[str, Any] = {"turn": _turned, "root": _root, "atan2": np.arctan2, "degrees": _degrees}
        exec(compile(source, "<record>", "exec"), scope)
        one: Callable[..., tuple[float, ...]] = scope["one"]
        return one

    def fill(self, given: Mapping[int, Array], rows: int) -> Array:
        """As `run`, for values that are then asked for one by one: the buffers, (buffers + SCRATCH, room)."""
        steps, buffers = self.bound(rows)
        for k in self.given:
            np.copyto(buffers[self.place[k], :rows], given[k])
        with np.errstate(all="ignore"):
            for function, arguments in steps:
                function(*arguments)
        return buffers

    def _cut(self, k: int, buffers: Array, rows: int) -> Array:
        value = self.held(k, buffers)
        return value[:rows] if value.ndim else value

    def value(self, k: int, rows: int) -> Array:
        """A node's value in the last run of so many rows, (rows,), or () where it does not vary.

        Only of wanted and given nodes, or of any where all are kept: the buffer of another may hold something
        else by now.
        """
        return self._cut(k, self.bound(rows)[1], rows)


def turn(
    degrees: Array, cosine: Array | None, sine: Array | None, a: Array, b: Array, c: Array, s: Array
) -> None:
    """Cosine and sine of angles, exact at multiples of 90 degrees.

    As `arithmetic.turn_of`: reduced exactly to r within 45 degrees of an axis before pi is met.
    With m quarter turns (-2 to 2) the cosine is ``cos r (1 - |m|) + sin r m (|m| - 2)``, and cos r is
    the root of ``1 - sin^2 r``, at least 1/2, which loses nothing.

    Parameters
    ----------
    degrees : (n,) [degrees]
    cosine, sine : (n,), written to; None where it is not asked for
    a, b, c, s : (n,), scratch
    """
    quarters = np.rint(np.multiply(degrees, 1.0 / 90.0, a), a)
    np.subtract(degrees, np.multiply(quarters, 90.0, b), s)
    np.sin(np.multiply(s, np.pi / 180.0, s), s)
    np.sqrt(np.subtract(1.0, np.multiply(s, s, c), c), c)
    quarters -= np.multiply(np.rint(np.multiply(quarters, 0.25, b), b), 4.0, b)
    across = np.subtract(np.abs(quarters, b), 2.0, b)
    quarters *= across
    along = np.subtract(-1.0, across, b)
    if cosine is not None:
        np.multiply(c, along, cosine)
    if sine is not None:
        np.multiply(s, along, sine)
        np.subtract(sine, np.multiply(c, quarters, c), sine)
    if cosine is not None:
        np.add(cosine, np.multiply(s, quarters, s), cosine)


def _turned(degrees: float) -> tuple[float, float]:
    """As `turn`, of one angle: the same operations in the same order."""
    quarters = math.copysign(round(degrees * (1.0 / 90.0)), degrees)
    s = float(np.sin((degrees - quarters * 90.0) * (np.pi / 180.0)))
    c = math.sqrt(1.0 - s * s)
    quarters -= math.copysign(round(quarters * 0.25), quarters) * 4.0
    across = abs(quarters) - 2.0
    quarters *= across
    along = -1.0 - across
    return c * along + s * quarters, s * along - c * quarters


def _root(value: float) -> float:
    return 0.0 if value <= 0.0 else math.sqrt(value)


def _degrees(radians: np.float64) -> float:
    return float(np.degrees(radians))


def code_of(record: Record, wanted: Sequence[int]) -> Code:
    """The code of these nodes, kept with the record. Others may run it: copy what has to last."""
    key = ("code", tuple(wanted))
    if key not in record.kept:
        record.kept[key] = Code(record, wanted)
    found: Code = record.kept[key]
    return found
