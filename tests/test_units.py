"""Units: exact factors, the spellings that people use, and conversion that rounds once."""

from __future__ import annotations

import math
import random
import re
from decimal import Decimal
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from icsolve.numbers.units import (
    DIMENSIONS,
    UNITS,
    UnitError,
    canonical,
    converted,
    factor,
    kind_of,
    parse_unit,
    split_quantity,
)


def value(text: str, target: str) -> float:
    """A quantity in another unit."""
    parts = split_quantity(text)
    assert parts is not None
    return converted(parts[0], parse_unit(parts[1]), parse_unit(target))


# Definitions: NIST SP 811 (2008), appendix B.8; the pound-force from 0.45359237 kg and 9.80665 m/s^2.
DEFINED = [
    ("1 in", "m", 0.0254),
    ("1 ft", "m", 0.3048),
    ("1 yd", "m", 0.9144),
    ("1 km", "cm", 100000.0),
    ("1 lbf", "N", 4.4482216152605),
    ("1 lb", "N", 4.4482216152605),
    ("1 kip", "lbf", 1000.0),
    ("16 ozf", "lbf", 1.0),
    ("1 tonf", "lbf", 2000.0),
    ("1 kgf", "N", 9.80665),
    ("1 MN", "kN", 1000.0),
    ("1 lbm", "kg", 0.45359237),
    ("1 slug", "lbm", 32.17404855643045),
    ("1 t", "kg", 1000.0),
    ("1 g", "kg", 0.001),
    ("180 deg", "rad", math.pi),
    ("1 rev", "deg", 360.0),
    ("1 rad", "deg", 57.29577951308232),
    ("60 rpm", "rad/s", 6.283185307179586),
    ("1 ksi", "psi", 1000.0),
    ("1 hp", "ft*lbf/s", 550.0),
    ("1 hp", "W", 745.6998715822702),
    ("1 kW", "W", 1000.0),
    ("1 h", "min", 60.0),
    ("12 in*lbf", "lbf*ft", 1.0),
    ("9.81 m/s^2", "m/s^2", 9.81),
]


@pytest.mark.parametrize(("text", "target", "expected"), DEFINED, ids=str)
def test_defined_factors_to_the_last_bit(text: str, target: str, expected: float) -> None:
    assert value(text, target) == expected


SPELLINGS = {
    "in": ["inch", "inches", "IN", "In"],
    "ft": ["foot", "feet", "FT"],
    "mm": ["millimetre", "millimeters"],
    "N": ["newton", "newtons", "Newtons"],
    "lbf": ["lb", "lbs", "pounds", "LBF"],
    "deg": ["°", "º", "˚", "degree", "degrees", "DEG"],
    "rad/s": ["rad/sec", "rad s^-1", "rad·s⁻¹", "radians/second", "rad per s"],
    "rpm": ["rev/min", "r/min", "RPM", "revolutions/minute"],
    "N*m": ["N·m", "N⋅m", "Nm", "N-m", "N.m", "N m", "newton-metres"],
    "kN*m": ["kN·m", "kNm", "kN-m"],
    "lbf*ft": ["lbf·ft", "lb-ft", "ft-lb", "ft·lb", "ft-lbs", "ft*lbf", "lbft", "foot-pounds", "lbf ft"],
    "lbf*in": ["in-lb", "inlb", "in·lbf", "lb-in", "in-lbs", "inch-pounds"],
    "kip*ft": ["kip-ft", "ft-kip", "kip·ft"],
    "m/s^2": ["m/s2", "m/s²", "m/s/s", "m/(s*s)", "m/s**2", "m·s^-2"],
    "lbf/in": ["lb/in", "lbs/inch", "lbf per in"],
    "N/mm": ["kN/m"],
    "ft/min": ["feet/minute", "ft / min"],
    "1/in": ["/in", "in^-1", "in⁻¹"],
}


@pytest.mark.parametrize("unit", SPELLINGS)
def test_usual_spellings_are_the_same_unit(unit: str) -> None:
    for spelling in SPELLINGS[unit]:
        assert factor(parse_unit(spelling), parse_unit(unit)) == 1.0, spelling
        assert parse_unit(spelling).dims == parse_unit(unit).dims


WRONG = {
    "furlong": "no unit 'furlong'",
    "inchs": "did you mean 'inches'",
    "kn": "did you mean 'kN'",
    "Mm": "did you mean 'mm'",
    "ton": "'tonf' (2000 lbf) or 't' (1000 kg)",
    "N**m": "not a unit",
    "N^": "a power is one digit",
    "N^12": "a power is one digit",
    "N*": "not a unit",
    "(N*m": "a bracket is not closed",
    "N)m": "nothing fits before ')m'",
    "N+m": "'+' is out of place",
    "m" * 200: "too long",
    "": "not a unit",
}


@pytest.mark.parametrize("text", WRONG)
def test_what_is_no_unit_is_refused_with_the_reason(text: str) -> None:
    with pytest.raises(UnitError) as caught:
        parse_unit(text)
    assert WRONG[text] in str(caught.value)


NUMERALS = {
    "5": (5, 0, ""),
    "-.5": (-5, -1, ""),
    "1e3": (1, 3, ""),
    "1.50E-2 mm": (150, -4, "mm"),
    "30mm": (30, 0, "mm"),
    "−12 rad/s": (-12, 0, "rad/s"),
    "+3.  N": (3, 0, "N"),
    "010": (10, 0, ""),
    "2e": (2, 0, "e"),
}


@pytest.mark.parametrize("text", NUMERALS)
def test_numerals_are_read_as_decimals(text: str) -> None:
    parts = split_quantity(text)
    assert parts is not None
    assert (parts[0].mantissa, parts[0].exponent, parts[1]) == NUMERALS[text]


@pytest.mark.parametrize("text", ["", "N", "e5", "-", ".", "+-3", "x1", "٣"])
def test_text_without_a_numeral_has_none(text: str) -> None:
    assert split_quantity(text) is None


def test_a_numeral_of_five_thousand_digits_is_refused_at_once() -> None:
    with pytest.raises(UnitError, match="too long"):
        split_quantity("1" * 5000)
    with pytest.raises(UnitError, match="too long"):
        split_quantity("1e999999999")


RATIONAL = sorted(name for name, unit in UNITS.items() if unit.dims == DIMENSIONS["length"])


@given(
    st.integers(-(10**20), 10**20), st.integers(-30, 30), st.sampled_from(RATIONAL), st.sampled_from(RATIONAL)
)
def test_a_conversion_is_the_nearest_double_of_the_exact_value(
    mantissa: int, exponent: int, unit: str, target: str
) -> None:
    """Against the exact rational, whose ``float`` Python rounds correctly."""
    parts = split_quantity(f"{mantissa}e{exponent}")
    assert parts is not None
    a, b = UNITS[unit], UNITS[target]
    exact = mantissa * Fraction(10) ** exponent * Fraction(a.num, a.den) / Fraction(b.num, b.den)
    assert converted(parts[0], a, b) == float(exact)


def test_a_unit_to_itself_is_exactly_one() -> None:
    assert {factor(unit, unit) for unit in UNITS.values()} == {1.0}


# In SI units: NIST SP 330 (2019), tables 4 to 6.
SI = {
    "number": "N/N",
    "length": "m",
    "mass": "kg",
    "time": "s",
    "angle": "rad",
    "force": "kg*m/s^2",
    "torque": "N*m",
    "stiffness": "N/m",
    "speed": "m/s",
    "angular speed": "rad/s",
    "acceleration": "m/s^2",
    "power": "N*m/s",
    "pitch": "1/m",
    "pressure": "N/m^2",
    "area": "m^2",
    "torsional stiffness": "N*m/rad",
    "moment of inertia": "kg*m^2",
    "angular acceleration": "rad/s^2",
}


HORSE, MERCURY = 735.49875, 133.322387415
FOREIGN = {
    "N": {"kp": 9.80665, "kilopond": 9.80665, "p": 9.80665e-3, "gf": 9.80665e-3, "dyn": 1e-5, "daN": 10.0,
          "hN": 100.0, "mN": 1e-3, "GN": 1e9},
    "Pa": {"GPa": 1e9, "hPa": 100.0, "mPa": 1e-3, "mbar": 100.0, "at": 98066.5, "kbar": 1e8,
           "psf": 47.88025898, "ksf": 47880.25898, "mmHg": MERCURY, "Torr": MERCURY, "atm": 101325.0},
    "m": {"dm": 0.1, "hm": 100.0, "um": 1e-6, "\u00b5m": 1e-6, "\u03bcm": 1e-6, "nm": 1e-9, "mi": 1609.344,
          "mil": 25.4e-6, "thou": 25.4e-6},
    "kg": {"mg": 1e-6, "Mg": 1000.0, "kt": 1e6, "stone": 6.35029318},
    "W": {"MW": 1e6, "GW": 1e9, "mW": 1e-3, "PS": HORSE, "CV": HORSE, "ch": HORSE},
    "rad": {"mrad": 1e-3, "gon": math.pi / 200, "arcmin": math.pi / 10800},
    "s": {"ms": 1e-3},
}  # fmt: skip
"""Units of other books, in those of SI."""


@pytest.mark.parametrize(("si", "name"), [(si, name) for si, some in FOREIGN.items() for name in some])
def test_a_unit_that_there_is_elsewhere_is_told_with_what_it_is(si: str, name: str) -> None:
    """Who writes what is told in its place has the same quantity: a unit of the same kind stands with its
    ratio, but one that has other capitals alone, which may be what was slipped."""
    with pytest.raises(UnitError) as refusal:
        parse_unit(name)
    _, *told = re.findall(r"'([^']+)'(?: \(1 \S+ is ([-+.e\d]+) \S+\))?", str(refusal.value))
    target = parse_unit(si)
    sizes = {
        unit: float(ratio or 1.0) * factor(parse_unit(unit), target)
        for unit, ratio in told
        if parse_unit(unit).dims == target.dims
    }
    good = {unit for unit, size in sizes.items() if size == pytest.approx(FOREIGN[si][name], rel=1e-5)}
    assert good and all(unit.lower() == name.lower() for unit in sizes if unit not in good)


def test_every_dimension_is_told_by_its_name() -> None:
    assert {kind: kind_of(parse_unit(unit).dims) for kind, unit in SI.items()} == {
        kind: kind for kind in DIMENSIONS
    }
    assert kind_of((9, 9, 9, 9)) is None


def test_spellings_are_shown_by_the_listed_name() -> None:
    shown = {"inches": "in", "lb": "lb", "lbs": "lbf", "newtons": "N", "mm": "mm", "FT": "ft"}
    assert {name: canonical(name) for name in shown} == shown


@pytest.mark.parametrize(
    ("dotted", "plain"),
    [("in.-lb", "in-lb"), ("lb.", "lb"), ("lb/in.", "lb/in"), ("ft. lb.", "ft*lb"), ("ft.lb", "ft*lb")],
)
def test_american_abbreviations_may_end_with_a_full_stop(dotted: str, plain: str) -> None:
    assert parse_unit(dotted) == parse_unit(plain)


@pytest.mark.parametrize("text", ["N.", "in..", "in.-", ".in", "mm."])
def test_a_full_stop_elsewhere_is_no_unit(text: str) -> None:
    with pytest.raises(UnitError):
        parse_unit(text)


NUMERAL = re.compile(r"([-+−]?)(?:(\d+)(?:\.(\d*))?|\.(\d+))(?:[eE]([-+−]?\d+))?", re.ASCII)


def test_a_numeral_is_split_off_as_its_grammar_says() -> None:
    """Signs, points and powers in any order, and digits of other scripts, against a regular expression."""
    draw = random.Random(2026)
    for _ in range(5000):
        text = "".join(draw.choices("10.-+−eEm 3٣²", k=draw.randint(0, 9)))
        found, split = NUMERAL.match(text), split_quantity(text)
        assert (split is None) == (found is None), text
        if found is not None and split is not None:
            numeral = split[0].digits
            assert (numeral, split[1]) == (found[0].replace("−", "-"), text[found.end() :].strip()), text
            assert Decimal(split[0].mantissa).scaleb(split[0].exponent) == Decimal(numeral), text
