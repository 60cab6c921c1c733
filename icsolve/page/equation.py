"""The equation of power of a page: in symbols, and what its live numbers are."""

from __future__ import annotations

from typing import Any, NamedTuple

from icsolve.case import Torque
from icsolve.construction import Acting, Known, acting_loads
from icsolve.draw.svg import runs_of
from icsolve.explain.document import formula
from icsolve.explain.formula import Expr, Name, Num, Quotient, Sum, product
from icsolve.explain.mathml import mathml, mathml_equation
from icsolve.explain.numbers import load_name
from icsolve.page.columns import exact
from icsolve.page.motion import Motion
from icsolve.wording.senses import unit_of

__all__ = ["Equation", "equation_of", "runs_of"]


class Equation(NamedTuple):
    """The equation in MathML, its rows as names and units, and the columns behind them.

    ``rows``: for each known load its name, its ratio of speeds (MathML both), the unit of that.
    """

    symbols: str
    ratio: str
    rows: tuple[tuple[str, str, str], ...]
    data: list[dict[str, Any]]


def equation_of(known: Known, motion: Motion | None) -> Equation | None:
    """The equation of one unknown load and the known ones; None where it has no such simple form."""
    acting = acting_loads(known)
    unknown = [a for a in acting if a.unknown]
    others = [a for a in acting if not a.unknown]
    if motion is None or len(unknown) != 1 or set(motion.shares) != {a.load.name for a in others}:
        return None
    root = unknown[0]
    terms: list[tuple[int, Expr]] = [(1, product(load_name(a.load.name), speed_of(known, a))) for a in others]
    terms.append((1, product(load_name(root.load.name), speed_of(known, root))))
    symbols = mathml_equation(formula(Sum(tuple(terms)), Num("0")).equation)
    over = [Quotient(speed_of(known, a), speed_of(known, root)) for a in others]
    solved: list[tuple[int, Expr]] = [
        (-1, product(load_name(a.load.name), ratio)) for a, ratio in zip(others, over, strict=True)
    ]
    ratio = mathml_equation(formula(load_name(root.load.name), Sum(tuple(solved))).equation) if solved else ""
    rows = slice(motion.first, motion.last + 1)
    data = [
        {"name": a.load.name, "value": a.value, "ratio": exact(motion.shares[a.load.name][rows].tolist())}
        for a in others
    ]
    shown = tuple(
        (_math(load_name(a.load.name)), _math(q), ratio_unit(known, root, a))
        for a, q in zip(others, over, strict=True)
    )
    return Equation(symbols, ratio, shown, data)


def _math(expression: Expr) -> str:
    return f'<math displaystyle="true">{mathml(expression)}</math>'


def speed_of(known: Known, acting: Acting) -> Name:
    """The speed that a load works at: the rate of its link, or the speed of its point along it."""
    if not isinstance(acting.load, Torque):
        return Name("v", acting.load.name)
    low = acting.link if acting.against == known.case.ground else f"{acting.link}/{acting.against}"
    return Name("w", low)


def ratio_unit(known: Known, root: Acting, of: Acting) -> str:
    """The unit of the ratio of speeds, in which the unit of a known load, times it, is the root's."""
    own, theirs = unit_of(root.load, known.case), unit_of(of.load, known.case)
    if own == theirs:
        return ""
    for one, other, form in ((own, theirs, "{}"), (theirs, own, "1/{}")):
        parts = one.split("*")
        if other in parts and len(parts) == 2:
            parts.remove(other)
            return form.format(parts[0])
    return f"{own}/{theirs}" if "*" not in theirs and "/" not in theirs else f"{own}/({theirs})"
