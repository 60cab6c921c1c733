"""`icsolve sweep --plot`: the answers over the range, with its dead centres and its gaps, read back from the
picture."""

from __future__ import annotations

import math
import os
import re
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import icsolve
from icsolve.draw.plot import PlottedCurve, Shade, asymptotes, limits, plot_svg, sweep_svg
from pictures import SVG, Picture, coordinates, outside, overlaps, parsed
from shell import exit_status
from test_draw import HOSTILE

ROOT = Path(__file__).parent.parent
LIBRARY = ROOT / "cases"
YOKE = LIBRARY / "sliders" / "scotch_yoke.yaml"
DEGREES = [float(k) for k in range(0, 361, 2)]


def strokes(picture: Picture, kinds: Sequence[str]) -> list[list[tuple[float, float]]]:
    """The points of every line or shade of these classes; samples of the legend stand in no group."""
    groups = picture.root.iter(f"{SVG}g")
    paths = [e for g in groups for e in g if e.tag == f"{SVG}path" and e.get("class") in kinds]
    return [list(coordinates(e)) for e in paths]


def curves(picture: Picture) -> list[list[tuple[float, float]]]:
    return strokes(picture, ("plot", "plot-2", "plot-3"))


def swept(name: str, values: Sequence[float], **drive: str) -> Picture:
    case = icsolve.load(LIBRARY / name)
    link = drive.get("link", "2")
    picture = parsed(sweep_svg(icsolve.sweep(case, {}, drive={link: np.array(values)})))
    assert overlaps(picture) == [] and outside(picture) == []
    return picture


@pytest.mark.parametrize("step", [1.0, 2.5, 7.0, 15.0])
def test_a_dead_centre_is_an_asymptote_and_no_line_through_infinity(step: float) -> None:
    """Scotch yoke: F = T / (r cos(turn - 60 deg)), whether a row falls on the dead centres or beside them."""
    picture = swept("sliders/scotch_yoke.yaml", np.arange(0.0, 360.5, step))
    lines = strokes(picture, ("asymptote",))
    assert len(lines) == 2
    assert "dead centre at 150, 330" in picture.texts("t-axis")
    for (x, _), _ in lines:
        assert not [c for c in curves(picture) if min(p[0] for p in c) < x < max(p[0] for p in c)]
    assert len(curves(picture)) == 3


def test_poles_are_placed_between_the_rows() -> None:
    x = [3.0 + 7.0 * k for k in range(52)]
    found = asymptotes(x, [1.0 / math.sin(math.radians(a - 40.0)) for a in x])
    assert found == pytest.approx([40.0, 220.0], abs=0.1)


def test_a_zero_is_no_dead_centre() -> None:
    """However steep: the curve shrinks toward it."""
    assert asymptotes(DEGREES, [math.sin(math.radians(a)) for a in DEGREES]) == []
    assert asymptotes(DEGREES, [math.tanh(3.0 * (a - 181.0)) for a in DEGREES]) == []
    assert asymptotes(DEGREES, [(a - 179.0) ** 3 for a in DEGREES]) == []


def test_a_jump_beside_a_gap_is_no_dead_centre() -> None:
    values = [math.nan if 100.0 < a < 200.0 else (5.0 if a < 150.0 else -5.0) for a in DEGREES]
    assert asymptotes(DEGREES, values) == []


def test_where_the_links_do_not_meet_is_a_shade_and_a_gap() -> None:
    """Four-bar driven by its rocker: it turns from -10 to 153 degrees only, with a dead centre at 55.7."""
    picture = swept("linkages/four_bar.yaml", range(-180, 181), link="4")
    bands = [(min(p[0] for p in s), max(p[0] for p in s)) for s in strokes(picture, ("shade",))]
    assert len(bands) == 2
    for left, right in bands:
        assert not [p for c in curves(picture) for p in c if left < p[0] < right]
    assert "the links do not meet" in picture.texts("t-axis")
    assert "dead centre at 55.66" in picture.texts("t-axis")


def test_the_axis_shows_what_can_be_seen_beside_an_asymptote() -> None:
    values = [1.0 / math.sin(math.radians(a - 40.001)) for a in DEGREES]
    low, high = limits([PlottedCurve("F", values, "N")], DEGREES)
    assert -20.0 < low < -4.0 and 4.0 < high < 20.0
    peak = [1.0 / (1.0 + (a - 180.0) ** 2) for a in DEGREES]
    assert limits([PlottedCurve("F", peak, "N")], DEGREES)[1] > 1.0, "a peak without asymptote is shown whole"


def test_answers_of_one_unit_share_an_axis_and_others_have_their_own() -> None:
    picture = swept("linkages/five_bar.yaml", range(361))
    assert {"curve-T12", "curve-T15"} <= set(picture.ids)
    assert [t for t in picture.texts("t-axis") if t.startswith("T1")] == ["T12, N·m", "T15, N·m"]
    axis = "link 2, degrees from the position as written"
    assert picture.texts("t-axis").count(axis) == 1
    two = parsed(
        plot_svg([0.0, 1.0], [PlottedCurve("F", [1, 2], "N"), PlottedCurve("T", [3, 4], "N*m")], "a", "")
    )
    assert overlaps(two) == [] and two.texts("t-axis").count("a") == 2


FRICTION = """
icsolve: 1
points: {A: [0, 0], B: [1, 1], C: [3, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0, mu: 0.2}
loads:
  P: {force: 100, link: 4, at: C, angle: 180}
  T12: {torque: unknown, link: 2}
"""


def test_what_holds_over_a_range_is_drawn_as_its_two_ends() -> None:
    found = icsolve.sweep(icsolve.load(FRICTION), {"loads.P": np.array([50.0, 100.0, 150.0])})
    picture = parsed(sweep_svg(found))
    assert overlaps(picture) == []
    names = [t for t in picture.texts("t-axis") if t.startswith("T12")]
    assert names == ["T12, least that holds, N·m", "T12, most that holds, N·m"]
    assert len(curves(picture)) == 2


@pytest.mark.parametrize(
    "values",
    [
        [5.0, 5.0, 5.0], [100.0, 100.0 + 1e-12, 100.0 - 1e-12], [0.0, 0.0, 0.0], [math.nan] * 3,
        [1e-300, 2e-300, 3e-300], [1e150, -1e150, 2e150], [math.nan, 7.0, math.nan],
    ],
)  # fmt: skip
def test_values_of_any_size_have_axes_that_can_be_read(values: list[float]) -> None:
    picture = parsed(plot_svg([0.0, 1.0, 2.0], [PlottedCurve("T12", values, "N*m")], "loads.P", "title"))
    assert overlaps(picture) == [] and outside(picture) == []
    ticks = [t for t in picture.texts("t-axis") if re.fullmatch("[−0-9.×⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+", t)]
    assert len(ticks) >= 6
    assert bool(curves(picture)) == any(map(math.isfinite, values))


def test_one_row_is_a_point() -> None:
    assert len(curves(parsed(plot_svg([3.0], [PlottedCurve("P", [1.0], "N")], "angles.AB", "")))) == 1


@pytest.mark.parametrize("text", HOSTILE)
def test_text_stays_text(text: str) -> None:
    words = text.strip('"')
    dead = [float(k) for k in range(9)]
    svg = plot_svg(
        DEGREES,
        [PlottedCurve(words[:80], DEGREES, words[:20], dead), PlottedCurve("B", DEGREES, "N")],
        words[:60],
        words,
        [Shade(10.0, 20.0, words[:70])],
    )
    picture = parsed(svg)
    assert overlaps(picture) == [] and outside(picture) == []
    assert {e.tag.removeprefix(SVG) for e in picture.root.iter()} <= {
        "svg", "title", "desc", "style", "rect", "g", "path", "text", "tspan",
    }  # fmt: skip


# --- the command -------------------------------------------------------------------------------------


def test_plot_alone_writes_no_table_and_with_o_both(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    plot, table = tmp_path / "turn.svg", tmp_path / "turn.csv"
    words = (str(YOKE), "--drive", "2=0:360:10", "--plot", str(plot))
    assert exit_status("sweep", *words) == 0
    assert capsys.readouterr().out == "" and not table.exists()
    ElementTree.parse(plot)
    assert exit_status("sweep", *words, "-o", str(table)) == 0
    assert len(table.read_text().splitlines()) == 38


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--drive", "2=0:90:10", "--vary", "loads.T=1,2", "--plot", "x.svg"), "over one range"),
        (("--drive", "2=0:90:10", "--plot", "x.png"), "should end in .svg"),
        (("--drive", "2=0:90:10", "--plot", "missing/x.svg"), "can't be written"),
    ],
)
def test_plots_that_cannot_be_are_refused(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    words: tuple[str, ...],
    said: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert exit_status("sweep", str(YOKE), *words) == 2
    assert said in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_the_case_itself_is_never_written_over(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    case = tmp_path / "case.svg"
    case.write_text(YOKE.read_text())
    assert exit_status("sweep", str(case), "--drive", "2=0:90:10", "--plot", str(case)) == 2
    assert "is one of the files read here" in capsys.readouterr().err
    assert case.read_text() == YOKE.read_text()


def test_the_same_bytes_every_run(tmp_path: Path) -> None:
    """Whatever order sets and dictionaries of another process have."""
    made = []
    for seed in "12":
        path = tmp_path / f"{seed}.svg"
        words = ["sweep", "cases/linkages/five_bar.yaml", "--drive", "2=0:360:5", "--plot", str(path)]
        environment = {**os.environ, "PYTHONHASHSEED": seed}
        subprocess.run([sys.executable, "-m", "icsolve", *words], cwd=ROOT, env=environment, check=True)
        made.append(path.read_bytes())
    assert made[0] == made[1]
