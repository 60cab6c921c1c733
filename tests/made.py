"""Answers made by hand, for the tests of the rooms that only show or compare them."""

from __future__ import annotations

from typing import Any

from icsolve.answer import Answer, Centre, Found, Term
from icsolve.case import Case, Coordinates, Force, Number, Pin, Slope, Torque, Units
from icsolve.case.expected import Expected, Target


def number(text: str, path: str = "") -> Number:
    """A number as a file would give it: half a unit of its last decimal is its half width."""
    decimals = len(text.partition(".")[2])
    return Number(float(text), 0.5 * 10.0**-decimals, path, text)


def at(x: str, y: str) -> Coordinates:
    return Coordinates(number(x), number(y))


def published(key: str, target: Target, *values: str, **more: Any) -> Expected:
    """An entry of ``expect``."""
    return Expected(key, target, tuple(number(value) for value in values), **more)


def four_bar_case(**changes: Any) -> Case:
    """Problem 13.8: A(0,0) B(-.30782,.84572) C(2.2,2.60424) D(2.9444,0), 100 lb on link 4 at E."""
    fields: dict[str, Any] = {
        "name": "13_08",
        "path": "13_08.yaml",
        "title": "Four-bar, P = 100 lb",
        "units": Units("in", "lbf", "lbf*in"),
        "links": ("1", "2", "3", "4"),
        "points": {
            "A": at("0", "0"),
            "B": at("-0.30782", "0.84572"),
            "C": at("2.2", "2.60424"),
            "D": at("2.9444", "0"),
            "E": at("3.4489", "0.87382"),
        },
        "joints": (
            Pin(("1", "2"), "A"),
            Pin(("2", "3"), "B"),
            Pin(("3", "4"), "C"),
            Pin(("4", "1"), "D"),
        ),
        "loads": (
            Force("P", "4", "E", number("100"), Slope(number("1"), number("0"))),
            Torque("T12", "2", None),
        ),
    }
    return Case(**{**fields, **changes})


def four_bar_answer(case: Case | None = None, **changes: Any) -> Answer:
    """What the solver would say of `four_bar_case`."""
    fields: dict[str, Any] = {
        "case": four_bar_case() if case is None else case,
        "answers": {"T12": Found(29.67219, "lbf*in", "ccw", 2.1e-14)},
        "centres": {
            ("1", "2"): Centre(("1", "2"), "at", (0.0, -0.0), "inspection"),
            ("2", "4"): Centre(
                ("2", "4"),
                "at",
                (-1.5139, 0.0),
                "construction",
                ((("2", "3"), ("3", "4")), (("1", "2"), ("1", "4"))),
                error=3e-16,
            ),
        },
        "points": {
            "A": (0.0, 0.0),
            "B": (-0.30782, 0.84572),
            "C": (2.2, 2.60424),
            "D": (2.9444, 0.0),
            "E": (3.4489, 0.87382),
        },
        "terms": (
            Term("P", "4", 100.0, "lbf", -0.2967219, -29.67219, False, "P on link 4 at E"),
            Term("T12", "2", 29.67219, "lbf*in", 1.0, 29.67219, True, "T12 on link 2"),
        ),
        "advantage": 0.2967219,
        "mobility": 1,
    }
    return Answer(**{**fields, **changes})
