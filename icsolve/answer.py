"""The answer of a scene: frozen values, and the object that ``--json`` prints."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, NamedTuple

from icsolve.case import Case, Pair


class Found(NamedTuple):
    """The value of an unknown load, in case units.

    ``sense`` is in words (``ccw``, ``at 210 deg``, ``pull``; empty for a zero). ``error`` bounds
    the absolute rounding error; None where no bound is proven, and ``why`` says so.
    """

    value: float
    unit: str
    sense: str
    error: float | None = None
    why: str = ""


class Centre(NamedTuple):
    """A relative instant centre.

    ``kind`` is ``at`` (``place`` has x and y in case units), ``toward`` (at infinity; ``place`` has
    the direction in degrees, in [0, 180)), ``undefined`` or ``undetermined`` (``why`` says why).
    ``by`` is how it was found: ``inspection`` (a joint), ``given``, ``construction`` (Kennedy, by the
    two ``lines``) or ``loop equations``. Each line is named by the centres it joins, or by the
    joint whose common normal it is (one pair).
    """

    pair: Pair
    kind: str
    place: tuple[float, ...] = ()
    by: str = ""
    lines: tuple[tuple[Pair, ...], ...] = ()
    why: str = ""
    error: float | None = None


class Term(NamedTuple):
    """One term of the power equation, for the motion in which the equation is printed.

    ``factor`` is power per unit of the load (its velocity or angular velocity ratio), in case
    units; ``value`` the load (None for the unknown before it was found); ``power`` their product.
    ``words`` names link, point and what the factor is.
    """

    load: str
    link: str
    value: float
    unit: str
    factor: float
    power: float
    unknown: bool
    words: str


@dataclass(frozen=True, eq=False)
class Answer:
    """All that was found of one case.

    ``points`` are in case units; ``rates`` in rad/s (or scaled, see the format) and ``velocities``
    in length units a second, both None unless asked; a string in them says why it is undetermined.
    ``notes`` are sentences for the reader; ``skipped`` what was not examined; ``steps`` names the
    steps of the plan that ran.
    """

    case: Case
    answers: dict[str, Found] = field(default_factory=dict)
    centres: dict[Pair, Centre] = field(default_factory=dict)
    rates: dict[str, float | str] | None = None
    velocities: dict[tuple[str, str], tuple[float, float] | str] | None = None
    points: dict[str, tuple[float, float]] = field(default_factory=dict)
    terms: tuple[Term, ...] = ()
    advantage: float | None = None
    """unknown / known where there is one of each: the mechanical advantage (or its like)"""
    mobility: int | None = None
    notes: tuple[str, ...] = ()
    skipped: tuple[str, ...] = ()
    steps: tuple[str, ...] = ()
    errors: dict[str, dict[str, float]] = field(default_factory=dict)
    """bounds on the errors of ``rates`` by link; those of centres stand with them"""
    status: str = "ok"

    def to_dict(self) -> dict[str, Any]:
        """The JSON object of the format (``icsolve/solve/1``)."""
        from icsolve.result import to_dict

        return to_dict(self)
