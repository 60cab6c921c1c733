"""What cases, answers and sweeps show in a notebook, which asks for `_repr_svg_` and `_repr_markdown_`.

A notebook prefers Markdown to SVG where a value has both: an answer shows its worked solution, a case its
figure, a sweep its curve.
"""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import icsolve
from pictures import parsed
from shell import exit_status
from sizes import sampled
from test_draw import DEAD_CENTRE, FOUR_BAR

ROOT = Path(__file__).parent.parent
FILE = ROOT / "cases" / "ch13" / "13_08_four_bar.yaml"


def printed(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    """What a command prints."""
    exit_status(*words)
    return capsys.readouterr().out


def test_a_case_shows_its_figure(capsys: pytest.CaptureFixture[str]) -> None:
    assert icsolve.load(FILE)._repr_svg_() == printed(capsys, "draw", str(FILE))


def test_an_answer_shows_its_worked_solution_and_its_figure(capsys: pytest.CaptureFixture[str]) -> None:
    answer = icsolve.solve(icsolve.load(FILE))
    assert answer._repr_markdown_() == printed(capsys, "explain", str(FILE), "--format", "md")
    assert answer._repr_svg_() == printed(capsys, "draw", str(FILE))


@sampled(2)
@pytest.mark.parametrize("name", ["hoist_starting", "slider_crank_piston"])
def test_an_answer_with_inertia_forces_is_shown_as_the_commands_show_it(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """The case of such an answer has its inertia forces among its loads; they are found, not given."""
    file = ROOT / "cases" / "dynamics" / f"{name}.yaml"
    case = icsolve.load(file)
    worked, figure = (
        printed(capsys, "explain", str(file), "--format", "md"),
        printed(capsys, "draw", str(file)),
    )
    for answer in (icsolve.solve(case), icsolve.solve(replace(case, dynamic=False), dynamic=True)):
        assert answer._repr_markdown_() == worked
        assert answer._repr_svg_() == figure


@pytest.mark.parametrize("text", [FOUR_BAR.format(title="too long", crank=20), DEAD_CENTRE])
def test_a_case_without_an_answer_shows_the_reason(text: str) -> None:
    picture = parsed(icsolve.load(text)._repr_svg_())
    assert picture.texts("t-reason")[0].startswith("No answer (")


def test_a_case_in_space_shows_its_figure() -> None:
    (path,) = (ROOT / "cases" / "ch13").glob("13_21*.yaml")
    assert parsed(icsolve.load(path)._repr_svg_()).texts("t-point")


def test_a_sweep_of_one_number_shows_its_curve() -> None:
    found = icsolve.sweep(icsolve.load(FILE), {}, drive={"2": np.arange(0.0, 360.0, 10.0)})
    assert found._repr_markdown_() is None
    svg = found._repr_svg_()
    assert svg is not None and "curve-T12" in parsed(svg).ids
    assert repr(found) == "<Sweep 13_08_four_bar: 36 rows of 2: 36 ok>"


def test_a_sweep_of_several_numbers_shows_a_table() -> None:
    case = icsolve.load(FOUR_BAR.format(title="two", crank=1))
    vary = {"angles.AB": np.array([30.0, 60.0]), "loads.P": np.array([50.0, 100.0])}
    found = icsolve.sweep(case, vary)
    assert found._repr_svg_() is None
    table = found._repr_markdown_()
    assert table is not None
    assert table.startswith("2 rows of angles.AB, loads.P: 2 ok.\n")
    low, high = sorted(found.answers["T12"])
    assert f"| `T12` | {low:.6g} | {high:.6g} | N·m |".replace("-", "−") in table


def test_nothing_is_imported_before_a_notebook_asks() -> None:
    """Start-up is a measured feature: a scene that is solved needs no drawing, no shapely, no numpy."""
    script = (
        f"import sys, icsolve; answer = icsolve.solve(icsolve.load({str(FILE)!r}))\n"
        "rooms = ('icsolve.draw', 'icsolve.explain', 'shapely', 'numpy')\n"
        "print([room for room in rooms if room in sys.modules])\n"
        "print(answer._repr_svg_()[:4], 'shapely' in sys.modules)"
    )
    ran = subprocess.run([sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, check=True)
    assert ran.stdout.splitlines() == ["[]", "<svg True"]


def test_formulas_are_set_as_a_notebook_reads_them() -> None:
    """Displayed formulas stand between `$$`, those in a line between `$`, in pairs."""
    text = icsolve.solve(icsolve.load(FILE))._repr_markdown_()
    assert text.count("$$") % 2 == 0 and text.count("$") % 2 == 0
    assert r"\omega" in text
    ElementTree.fromstring(icsolve.load(FILE)._repr_svg_())
