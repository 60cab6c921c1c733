"""A sweep's record run in sixty digits, on the decimals of the case: what its bounds are held against."""

from __future__ import annotations

from typing import Any

import numpy as np
from mpmath import mp, mpf

import icsolve
from icsolve.case import Case
from icsolve.numbers.record import Implicit, Op, Traced
from icsolve.sweep.program import CompiledSweep
from icsolve.sweep.varied_numbers import numbers_of

mp.dps = 60
RADIAN = mp.pi / 180


class InSixtyDigits:
    """The values of a sheet's nodes for one row; groups are solved by Newton's method from the row's own."""

    def __init__(self, compiled: CompiledSweep, row: dict[int, Any]) -> None:
        self.compiled, self.record = compiled, compiled.record
        self.constants = self._decimals(compiled.setting.case)
        self.values: dict[int, Any] = {k: mpf(v) for k, v in row.items()}
        for group in compiled.record.implicit:
            self._solve(group)

    def _decimals(self, case: Case) -> dict[int, Any]:
        """What the constants of the record are in the file."""
        numbers = numbers_of(case)
        found = {}
        for (value, name), traced in self.record._constants.items():
            plain = name in numbers and numbers[name].factor == 1.0
            found[traced.index] = mpf(numbers[name].digits) if plain else mpf(value)
        return {**found, self.record.radian.index: mp.pi / 180}

    def of(self, k: int) -> Any:
        """The value of a node."""
        stack = [k]
        while stack:
            n = stack[-1]
            node = self.record.nodes[n]
            need = [] if node.op in (Op.INPUT, Op.CONST) else [node.a]
            need += [node.b] if node.op in (Op.ADD, Op.SUB, Op.MUL, Op.DIV, Op.ANGLE) else []
            missing = [m for m in need if m not in self.values]
            if missing:
                stack += missing
                continue
            stack.pop()
            if n not in self.values:
                self.values[n] = self._value(n)
        return self.values[k]

    def _value(self, n: int) -> Any:
        node = self.record.nodes[n]
        a, b = self.values.get(node.a), self.values.get(node.b)
        match node.op:
            case Op.CONST:
                return self.constants[n]
            case Op.ADD:
                return a + b
            case Op.SUB:
                return a - b
            case Op.MUL:
                return a * b
            case Op.DIV:
                return a / b
            case Op.NEG:
                return -a
            case Op.SQRT:
                return mp.sqrt(max(a, mpf(0)))
            case Op.COS:
                return mp.cos(a * RADIAN)
            case Op.SIN:
                return mp.sin(a * RADIAN)
            case Op.ANGLE:
                return mp.atan2(b, a) / RADIAN
            case Op.NEAREST:
                return mp.nint(a)
        raise AssertionError(node)

    def _solve(self, group: Implicit) -> None:
        """Newton's method to the last digit; the unknowns of a body are x, y and degrees."""
        guess = [self.values[k] for k in group.solved]
        for _ in range(8):
            self.values = {k: v for k, v in self.values.items() if self.record.nodes[k].op == Op.INPUT}
            self.values.update(zip(group.guesses, guess, strict=True))
            f = np.array([self.or_float(v) for v in group.residuals])
            j = np.array([[self.or_float(v) for v in row] for row in group.derivatives])
            move, units = least_squares(j, f), (1, 1, RADIAN)
            guess = [g - m / units[n % 3] for n, (g, m) in enumerate(zip(guess, move, strict=True))]
            if max(map(abs, move)) < mpf(10) ** (5 - mp.dps):  # its square is beyond all digits
                break
        self.values = {k: v for k, v in self.values.items() if self.record.nodes[k].op == Op.INPUT}
        self.values.update(zip(group.solved, guess, strict=True))

    def or_float(self, value: Any) -> Any:
        return self.of(value.index) if isinstance(value, Traced) else mpf(float(value))


def least_squares(j: Any, f: Any) -> list[Any]:
    """x with ``j x = f``, (m, n) and (m,) of objects, by elimination with partial pivoting."""
    if j.shape[0] > j.shape[1]:
        j, f = j.T @ j, j.T @ f
    a, n = np.column_stack([j, f]), len(f)
    for c in range(n):
        r = c + int(np.argmax(np.abs(a[c:, c])))
        a[[c, r]] = a[[r, c]]
        a[c + 1 :, c:] -= np.outer(a[c + 1 :, c] / a[c, c], a[c, c:])
    x: list[Any] = [mpf(0)] * n
    for c in reversed(range(n)):
        x[c] = (a[c, n] - sum(a[c, k] * x[k] for k in range(c + 1, n))) / a[c, c]
    return x


def is_recorded(sweep: icsolve.Sweep) -> bool:
    """Whether its rows stand on a record; else each is a scene of its own."""
    return hasattr(sweep._case_of, "__self__")


def truths(sweep: icsolve.Sweep, row: int) -> dict[tuple[str, str], list[Any]]:
    """All of a row in sixty digits, by kind and name, on the decimals of the case and of what varies."""
    work = sweep._case_of.__self__  # type: ignore[union-attr]
    part = next(p for p in work.done if row in p.rows)
    one = part.some(np.flatnonzero(part.rows == row))
    given: dict[int, Any] = {k: float(np.ravel(v)[0]) for k, v in work.parts.given(one)[0].items()}
    compiled, arrays = part.runner.compiled, work.columns.arrays
    given |= {k: repr(float(arrays[name][row])) for name, k in compiled.inputs.items() if name in arrays}
    exact = InSixtyDigits(compiled, given)
    return {key: [exact.or_float(value) for value in values] for key, values in compiled.outputs.items()}
