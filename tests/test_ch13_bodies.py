"""The free-body, cam and friction problems of the source document, against values recomputed by other routes.

Waldron, Kinzel and Agrawal, chapter 13: 13.1 and 13.2 with all forces, 13.4, 13.16 to 13.20. Tolerance: half
a unit of the last digit of the recomputed value.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest

from icsolve import Answer, load
from icsolve.answer.bodies import Reaction
from icsolve.solve import solve

CHAPTER = Path(__file__).parent.parent / "cases" / "ch13"


def solved(name: str) -> Answer:
    (path,) = CHAPTER.glob(f"{name}*.yaml")
    return solve(load(path), reactions=True)


def digits(text: str) -> Any:
    decimals = len(text.partition(".")[2])
    return pytest.approx(float(text), rel=0, abs=0.5 * 10.0**-decimals)


def force(answer: Answer, name: str) -> Reaction:
    assert answer.reactions is not None
    return answer.reactions[name]


def sizes(answer: Answer, **published: str) -> None:
    for name, text in published.items():
        assert force(answer, name).magnitude == digits(text), name


def test_13_01_all_forces() -> None:
    answer = solved("13_01")
    sizes(answer, F32="903.2", F34="903.2", F54="472.2", F14="466.0", F16="164.9")
    assert (force(answer, "F16").x, force(answer, "F16").moment) == (0.0, 0.0)


def test_13_02_eight_components_and_the_torque() -> None:
    answer = solved("13_02")
    published = {"F14": (115.0, -308.8), "F34": (58.16, 208.8), "F23": (158.2, 208.8), "F12": (158.2, 208.8)}
    for name, (x, y) in published.items():
        assert (force(answer, name).x, force(answer, name).y) == (digits(str(x)), digits(str(y)))
    assert answer.answers["T12"].value == digits("-835.2")
    (witness,) = answer.witnesses
    assert witness.bodies == pytest.approx(witness.power, rel=1e-14)


def test_13_04_cam_with_friction_and_the_forces_that_are_asked() -> None:
    answer = solved("13_04")
    assert answer.answers["T12"].value == digits("82.451")
    assert dict(force(answer, "F23").parts)["normal"] == digits("30.091")
    assert dict(force(answer, "F23").parts)["friction"] == digits("3.912")
    assert (force(answer, "F21").x, force(answer, "F21").y) == (digits("3.91"), digits("-46.19"))
    assert (force(answer, "F31").x, force(answer, "F31").y) == (digits("-3.91"), digits("-2.11"))


def arm(answer: Answer) -> float:
    """T12 over F32, the arm that the document measures."""
    return answer.answers["T12"].value / (force(answer, "F32").magnitude or math.nan)


@pytest.mark.parametrize(
    ("name", "f32", "h", "t12"),
    [
        ("13_16_slider_crank_without_friction", "213.000", "2.7600", "587.89"),
        ("13_16_slider_crank_with_friction", "192.681", "2.3606", "454.85"),
        ("13_17", "287.000", "3.8600", "1107.82"),
        ("13_18", "205.000", "1.3600", "278.80"),
        ("13_20_slider_crank_without_friction", "21.610", "1.7640", "38.120"),
        ("13_20_slider_crank_with_friction", "23.630", "1.7640", "41.683"),
    ],
)
def test_13_16_to_13_20_slider_cranks_with_friction(name: str, f32: str, h: str, t12: str) -> None:
    answer = solved(name)
    assert force(answer, "F32").magnitude == digits(f32)
    assert arm(answer) == digits(h)
    assert answer.answers["T12"].value == pytest.approx(float(t12), rel=0, abs=0.011)
    if answer.friction is not None:
        assert answer.friction.residual < 1e-14
        assert "Banach" in answer.friction.unique


def test_13_19_force_on_the_crank() -> None:
    answer = solved("13_19")
    sizes(answer, F32="140.000", F34="140.000")
    assert answer.answers["F"].value == digits("438.00")


@pytest.mark.parametrize(("name", "free"), [("13_17", "895.24"), ("13_18", "211.06")])
def test_13_17_and_13_18_without_their_friction(name: str, free: str) -> None:
    (path,) = CHAPTER.glob(f"{name}*.yaml")
    text = path.read_text().replace("mu: 0.", "mu: 0.0000000000000")
    assert solve(load(text)).answers["T12"].value == pytest.approx(float(free), abs=0.011)


def test_13_16_as_printed_has_the_slider_friction_along_its_slip() -> None:
    """By hand, with the circles of radius 0.12: F cos(b) - mu |F sin(b)| = P with the slip turned."""
    answer = solved("13_16_slider_crank_with_friction")
    b, c = answer.points["B"], answer.points["C"]
    beta = math.atan2(c[1] - b[1], c[0] - b[0])
    beta -= math.asin(2 * 0.12 / math.dist(b, c))
    size = 193.8228 / (math.cos(beta) - 0.2 * math.sin(beta))
    assert size == digits("228")
