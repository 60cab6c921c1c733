"""`variables` and `tolerance` in a case: small arithmetic without eval, and what is wrong with it."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

import icsolve
from icsolve import CaseError
from icsolve.case.expected import Tolerance, Variable
from icsolve.read.variables import FormulaError, count, decimal, replaced, value_at

VALUES = {"P": "250", "a": "1.5", "b_2": "-0.1"}
LEVER = """\
icsolve: 1
title: Lever with $P N
variables: {P: {range: [100, 500], step: 10}, a: {choices: [1.5, 2]}}
points: {A: [0, 0], B: [$a, 0]}
joints:
  - {pin: [1, 2], at: A}
loads:
  P: {force: 2*$P - 100 N, link: 2, at: B, angle: -90}
  T: {torque: unknown, link: 2}
"""


@pytest.mark.parametrize(
    ("text", "result"),
    [
        ("$P", "250"),
        ("${P}", "250"),
        ("$P N", "250 N"),
        ("2*$P + 10 N", "510 N"),
        ("($a - 1)/4 in", "0.125 in"),
        ("-$a", "-1.5"),
        ("$P/3", "83.33333333333333"),
        ("$a*$b_2", "-0.15"),
        ("1 + $a/2 m", "1.75 m"),
        ("$P lbf*ft", "250 lbf*ft"),
        ("2 * ($P + 50) / 3", "200"),
        ("1e2*$a", "150"),
        (".5*$a mm", "0.75 mm"),
    ],
)
def test_arithmetic_in_a_quantity(text: str, result: str) -> None:
    assert replaced(text, VALUES)[0] == result


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("$P*", "out of place"),
        ("$P/0", "division by zero"),
        ("($P", "a bracket is not closed"),
        ("$P + ", "out of place"),
        ("$P**2", "out of place"),
        ("__import__('os')*$P", "a number or a $name"),
        ("(" * 60 + "$P", "too many brackets"),
        ("$P" + "+1" * 400, "characters of arithmetic"),
        ("$P 2", "out of place"),
    ],
)
def test_what_is_no_arithmetic_is_refused(text: str, said: str) -> None:
    with pytest.raises(FormulaError, match=said.replace("$", r"\$").replace("(", r"\(")):
        replaced(text, VALUES)


@given(st.integers(-9, 9), st.integers(1, 9), st.integers(-9, 9), st.sampled_from("+-*"))
def test_arithmetic_agrees_with_fractions(a: int, b: int, c: int, sign: str) -> None:
    text, exact = replaced(f"($x {sign} {c})/{b} + $x", {"x": str(a)})
    inner = {"+": a + c, "-": a - c, "*": a * c}[sign]
    assert Fraction(text) == pytest.approx(Fraction(inner, b) + a, rel=1e-15, abs=1e-15)
    assert (Fraction(text) if exact is None else exact) == Fraction(inner, b) + a


@given(st.decimals(allow_nan=False, allow_infinity=False, places=6, min_value=-(10**6), max_value=10**6))
def test_a_decimal_of_few_places_stays_what_it_is(value: Fraction) -> None:
    assert Fraction(decimal(Fraction(value))) == Fraction(value)


def test_the_values_of_a_range_are_exact() -> None:
    tenths = Variable("x", start="0", stop="1", step="0.1")
    assert [value_at(tenths, n) for n in range(count(tenths))] == [
        "0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9", "1",
    ]  # fmt: skip
    assert count(Variable("x", start="100", stop="505", step="10")) == 41


def test_a_case_is_solved_with_the_first_values_and_says_so() -> None:
    case = icsolve.load(LEVER)
    assert case.title == "Lever with 100 N (P = 100, a = 1.5)"
    assert icsolve.solve(case).answers["T"].value == pytest.approx(150.0)


def test_values_are_set_by_name() -> None:
    case = icsolve.load(LEVER, {"variables.P": "200", "variables.a": "3"})
    assert icsolve.solve(case).answers["T"].value == pytest.approx(900.0)
    assert [variable.name for variable in case.variables] == ["P", "a"]


@pytest.mark.parametrize(
    ("old", "new", "place", "said"),
    [
        ("[$a, 0]", "[$b, 0]", "4:25", "there is no variable $b"),
        ("[$a, 0]", "[2, 0]", "3:1", "the variable a is used nowhere"),
        ("step: 10", "step: -1", "3:16", "in steps above zero"),
        ("range: [100, 500], step: 10", "range: [100, 500]", "3:16", "'choices: [...]', or 'range"),
        ("[100, 500]", "[100 N, 500]", "3:16", "'100 N' is not a number"),
        ("[1.5, 2]", "[]", "3:50", "there is nothing to choose"),
        ("2*$P - 100 N", "2*$P - N", "8:14", "out of place"),
        ("2*$P - 100 N", "2*$P in", "8:14", "a force is wanted"),
        ("step: 10", "step: 0.0001", "3:16", "more than 1000000 values"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(old: str, new: str, place: str, said: str) -> None:
    with pytest.raises(CaseError) as caught:
        icsolve.load(LEVER.replace(old, new))
    assert f"{place}: " in str(caught.value)
    assert said in str(caught.value)


@pytest.mark.parametrize(
    ("text", "tolerance"),
    [
        ("1%", Tolerance(relative=0.01)),
        ("0.5 %", Tolerance(relative=0.005)),
        ("3 sf", Tolerance(figures=3)),
        ("0.5 N*m", Tolerance(absolute=0.5, unit="N*m")),
        ("0.5", Tolerance(absolute=0.5)),
        ("{drawing: 0.02 in}", Tolerance(drawing="0.02 in")),
        ("{relative: 1%, absolute: 0.5 N*m}", Tolerance(relative=0.01, absolute=0.5, unit="N*m")),
        ("{figures: 4}", Tolerance(figures=4)),
    ],
)
def test_a_tolerance_of_the_case(text: str, tolerance: Tolerance) -> None:
    assert icsolve.load(f"{LEVER}tolerance: {text}\n").tolerance == tolerance


@pytest.mark.parametrize(
    "text",
    [
        "100%",
        "0%",
        "many",
        "{drawing: 0.02 N}",
        "{relative: 5}",
        "{width: 1}",
        "[1]",
        "-1%",
        "0 sf",
        "99 sf",
        "3 s",
    ],
)
def test_what_is_no_tolerance(text: str) -> None:
    with pytest.raises(CaseError, match="'tolerance'"):
        icsolve.load(f"{LEVER}tolerance: {text}\n")


def test_arithmetic_is_exact_in_the_answer_s_digits_too() -> None:
    """A third is a third: its first sixteen digits are only what is shown."""
    case = icsolve.load(CASE_WITH_A_THIRD)
    (load,) = (each for each in case.loads if each.name == "P")
    assert load.value.exact == (100, 3, 0)
    assert load.value.value == 100 / 3
    num, den, power = case.lengths[0].value.exact
    assert (Fraction(num, den), power) == (Fraction(127, 5000 * 3), 0)


CASE_WITH_A_THIRD = """
icsolve: 1
units: {length: m, force: N}
variables: {P: {choices: [100]}}
points: {A: [0, 0], B: [unknown, 0]}
lengths: {AB: $P/300 in}
near: {B: [1, 0]}
joints: [{pin: [1, 2], at: A}]
loads: {P: {force: $P/3, link: 2, at: B, angle: 90}, T: {torque: unknown, link: 2}}
"""


@pytest.mark.parametrize("force", ["$P/1e400", "$P/1e300/1e300 lbf", "-$P/1e999"])
def test_arithmetic_that_underflows_is_refused_and_no_zero(force: str) -> None:
    with pytest.raises(icsolve.CaseError, match="too small"):
        icsolve.load(CASE_WITH_A_THIRD.replace("$P/3,", f"{force},"))


def test_a_variable_that_a_sweep_should_vary_is_told_where_to_look() -> None:
    """It is put in before the case is read: what is varied is the number in which it stands."""
    text = (
        "icsolve: 1\nvariables: {W: {choices: [3, 4]}}\npoints: {A: [0, 0], B: [1, 0]}\n"
        "joints: [{pin: [1, 2], at: A}]\n"
        "loads: {P: {weight: $W, link: 2, at: B}, T: {torque: unknown, link: 2}}\n"
    )
    case = icsolve.load(text)
    with pytest.raises(icsolve.CaseError, match=r"vary a number in which \$W stands, as loads\.P"):
        icsolve.sweep(case, vary={"variables.W": [3.0, 4.0]})
    swept = icsolve.sweep(case, vary={"loads.P": [3.0, 4.0]})
    assert swept.answers["T"].tolist() == [3.0, 4.0]
