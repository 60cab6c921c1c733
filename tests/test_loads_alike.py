"""A load that is so many times another that is to find has an answer as that one has: whatever tells of the
one tells of the other, and as many times as much."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import icsolve
from icsolve.grade.one import Task
from icsolve.statics.power import loads_to_find
from shell import Shell

TIMES = -0.25
CRANK = """\
icsolve: 1
points: {{A: [0, 0], C: [unknown, 0.5]}}
lengths: {{AB: 2, BC: 6}}
angles: {{AB: 60}}
near: {{C: [7, 0.5]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [2, 3], at: B}}
  - {{pin: [3, 4], at: C}}
  - {{slide: [4, 1], at: C, along: 0{mu}}}
loads:
  P: {{force: 100, link: 4, at: C, angle: 180}}
  T: {{torque: unknown, link: 2}}
  U: {{torque: {{like: T, times: -0.25}}, link: 3}}
{motion}
"""
CASES = {
    "on the record": CRANK.format(mu="", motion=""),
    "with friction in a motion": CRANK.format(mu=", mu: 0.2", motion="motion: {link: 2, turns: cw}"),
    "where friction holds it": CRANK.format(mu=", mu: 0.2", motion=""),
    "row by row": CRANK.format(mu=", mu: 0.2, length: 0.5", motion="motion: {link: 2, turns: cw}"),
}
VALUES = [50.0, 75.0, 100.0]


def numbers(text: str) -> tuple[np.ndarray, np.ndarray]:
    """The numbers of T and of U that `solve` tells in the rows: answers, or ends of ranges."""
    found = [icsolve.solve(icsolve.load(text, {"loads.P": value})).answers for value in VALUES]
    both = [[one[name].holds or one[name].value for one in found] for name in "TU"]
    return np.array(both[0], dtype=float), np.array(both[1], dtype=float)


def alike(one: np.ndarray, other: np.ndarray) -> bool:
    return np.allclose(np.sort(TIMES * one), np.sort(other), rtol=1e-12, atol=0.0)


@pytest.mark.parametrize("name", CASES)
def test_rows_tell_of_it_as_scenes_do(name: str) -> None:
    case, (first, second) = icsolve.load(CASES[name]), numbers(CASES[name])
    assert alike(first, second)
    rows = icsolve.sweep(case, vary={"loads.P": VALUES})
    told = rows.holds or rows.answers
    assert {*rows.answers} == {"T", "U"} == {*loads_to_find(case)}
    assert np.allclose(told["T"], first, rtol=1e-9) and np.allclose(told["U"], second, rtol=1e-9)


def test_columns_do_not_hang_on_the_rows() -> None:
    """Of a sweep in which no row assembles too."""
    case = icsolve.load(CASES["on the record"])
    assert {*icsolve.sweep(case, vary={"lengths.BC": [0.1, 0.2]}).answers} == {"T", "U"}
    slow = icsolve.load(CASES["row by row"])
    assert {*icsolve.evaluator(slow, ("lengths.BC",))(np.array([0.1])).answers} == {"T", "U"}


@pytest.mark.parametrize("name", [name for name in CASES if "holds" not in name])
def test_where_it_takes_a_value_is_found(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file, (first, _) = tmp_path / "crank.yaml", numbers(CASES[name])
    file.write_text(CASES[name])
    places = []
    for query in (f"T={first[1]}", f"U={TIMES * first[1]}"):
        ran = Shell(capsys)("sweep", file, "--vary", "loads.P=50:100:25", "--find", query, "--json")
        (found,) = ran.objects()[0]["found"]
        places.append(found["at"]["loads.P"])
        assert [*found["answers"]] == [query[0]]
    assert places == pytest.approx([75.0, 75.0], rel=1e-9)


@pytest.mark.parametrize("name", CASES)
def test_it_can_be_asked_of_students(name: str, tmp_path: Path) -> None:
    file, second = tmp_path / "crank.yaml", np.sort(np.atleast_1d(numbers(CASES[name])[1][-1]))
    file.write_text(CASES[name])
    task = Task(file)
    assert task.grade("U", " to ".join(f"{value:.4g}" for value in second))["verdict"] == "right"
    assert task.grade("U", task.right("U"))["verdict"] == "right"
    assert task.grade("U", " to ".join(f"{1.1 * value:.4g}" for value in second))["verdict"] == "wrong"
    with pytest.raises(ValueError, match="P is given in the case"):
        task.right("P")
