"""Every way in which a figure assembles: none missing, none twice, each picked by its `near`."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from random import Random

import numpy as np
import pytest
from click.testing import CliRunner

from figure_drafts import Draft, Place, framework, sequence
from icsolve import solve
from icsolve.assembly import case_point, exclusion, newton, solve_figure, walk
from icsolve.assembly.conditions import residual
from icsolve.assembly.steps import PointGroup
from icsolve.assembly.ways import Ways, ways_of
from icsolve.assembly.workspace import Workspace, data_in
from icsolve.bench.promises import scissors
from icsolve.case import Case
from icsolve.cli.commands import icsolve
from icsolve.errors import SceneError, Status
from icsolve.read import load
from library import FILES, sample
from shell import exit_status
from sizes import FULL, MORE, sampled
from test_figure import BUTTERFLY, FOUR_BAR, LOOP, PINS, butterfly
from test_figure import case as figure_case


def apart(one: dict[str, Place], two: dict[str, Place]) -> float:
    return max(math.dist(one[p], two[p]) for p in one)


def assert_picked(case: Case, found: Ways) -> None:
    """The `near` of each way gives that way, and no two ways are one."""
    for k, way in enumerate(found.ways):
        figure = solve_figure(replace(case, near=way.near))
        places = {p: case_point(figure.frame, at) for p, at in figure.points.items()}
        assert apart(places, way.points) < 1e-7
        assert not figure.notes or "near" not in " ".join(figure.notes)
        assert all(apart(way.points, other.points) > 1e-7 for other in found.ways[:k])


def test_a_four_bar_assembles_open_and_crossed() -> None:
    case = figure_case(FOUR_BAR + LOOP)
    found = ways_of(case)
    assert found.complete
    assert [way.near["C"] for way in found.ways] == [(3.61106, 2.46956), (2.50433, -2.00324)]
    assert_picked(case, found)
    assert ways_of(figure_case(FOUR_BAR + "near: {C: [3.5, 2.4]}\n" + LOOP)).ways == found.ways


def test_a_passive_dyad_counts_though_no_load_needs_it() -> None:
    text = FOUR_BAR.replace("CD: 2.5", "CD: 2.5, BE: 2, CE: 2.5") + LOOP + "links: {3: [E]}\n"
    found = ways_of(figure_case(text))
    assert len(found.ways) == 4 and found.complete
    assert all("E" in way.points and "E" in way.near for way in found.ways)


def test_a_way_where_two_coincide_is_one() -> None:
    text = "points: {A: [0, 0], C: [0.3, 0]}\nlengths: {AB: 0.1, BC: 0.2}\n" + PINS
    (way,) = ways_of(figure_case(text)).ways
    assert way.points["B"] == pytest.approx((0.1, 0.0), abs=1e-15)
    assert way.near == {}


def test_a_point_that_nothing_needs_may_be_anywhere() -> None:
    text = FOUR_BAR.replace("CD: 2.5", "CD: 2.5, BE: 2") + LOOP + "links: {3: [E]}\n"
    found = ways_of(figure_case(text))
    assert len(found.ways) == 2
    assert "E" in " ".join(found.notes)


def test_every_dyad_of_a_chain_has_two_ways() -> None:
    """Rods long enough for both: 2, 4, 8, 16 ways."""
    for count in range(1, 5):
        points = {f"G{k}": (2.0 * k, 0.0) for k in range(count + 1)}
        ground = ", ".join(f"{p}: [{x}, {y}]" for p, (x, y) in points.items())
        bars = ", ".join(f"P{k}-P{k + 1}: 3, G{k + 1}-P{k + 1}: 2.5" for k in range(count))
        text = f"points: {{{ground}}}\nlengths: {{G0-P0: 1, {bars}}}\nangles: {{G0-P0: 80}}\n"
        joints = "".join(f"  - {{pin: [1, {k + 2}], at: G{k}}}\n" for k in range(count + 1))
        case = load(f"icsolve: 1\n{text}joints:\n{joints}")
        found = ways_of(case)
        assert len(found.ways) == 2**count and found.complete
        assert_picked(case, found)


def roots(draft: Draft, starts: int) -> list[dict[str, Place]]:
    """Figures of the same rods found by Newton's method from random starts, apart from icsolve."""
    rng = np.random.default_rng(len(draft.lengths))
    free = [p for p in draft.names if p not in draft.points]
    column = {p: k for k, p in enumerate(free)}
    fixed = {p: complex(*draft.at[p]) for p in draft.points}
    rods = [(r.a, r.b, r.value.value) for r in draft.lengths if {r.a, r.b} & set(free)]
    found: list[dict[str, Place]] = []
    for _ in range(starts):
        z = rng.uniform(-4, 4, len(free)) + 1j * rng.uniform(-4, 4, len(free))
        for _ in range(60):
            f, jacobian = np.zeros(len(rods)), np.zeros((len(rods), 2 * len(free)))
            for i, (a, b, length) in enumerate(rods):
                d = (z[column[b]] if b in column else fixed[b]) - (z[column[a]] if a in column else fixed[a])
                f[i] = (abs(d) ** 2 - length**2) / 2
                for p, sign in ((a, -1), (b, 1)):
                    if p in column:
                        jacobian[i, 2 * column[p] : 2 * column[p] + 2] = sign * d.real, sign * d.imag
            step = np.linalg.lstsq(jacobian, f, rcond=None)[0]
            step *= min(1.0, 1.0 / max(1e-30, np.abs(step).max()))
            z = z - (step[::2] + 1j * step[1::2])
        place = {p: (float(z[k].real), float(z[k].imag)) for p, k in column.items()}
        if np.abs(f).max() < 1e-11 and all(apart(place, other) > 1e-5 for other in found):
            found.append(place)
    return found


@sampled(2)
@pytest.mark.parametrize("points", [5, 6, 7])
def test_no_way_of_a_framework_is_missing(points: int) -> None:
    """Rods that need no order of construction: every figure that random starts reach is among the ways."""
    for seed in range(80 if FULL else 1):
        draft = framework(500 * points + seed, points, 0.8, 0.0)
        case = draft.case()
        found = ways_of(case)
        assert found.complete
        assert min(apart({p: draft.at[p] for p in draft.names}, way.points) for way in found.ways) < 1e-6
        for place in roots(draft, 60):
            assert min(apart(place, way.points) for way in found.ways) < 1e-6
        for rod in draft.lengths:
            for way in found.ways:
                length = math.dist(way.points[rod.a], way.points[rod.b])
                assert length == pytest.approx(rod.value.value, abs=1e-9)
        assert_picked(case, found._replace(ways=found.ways[:6]))


def test_the_double_butterfly_has_eighteen_ways() -> None:
    case = figure_case(butterfly(""))
    found = ways_of(case)
    assert found.complete
    assert len(found.ways) == 18
    assert min(max(math.dist(way.points[p], BUTTERFLY[p]) for p in BUTTERFLY) for way in found.ways) < 1e-12
    assert_picked(case, found)


@pytest.mark.parametrize("count", [5, 8])
def test_figures_of_every_kind_of_datum_are_among_their_ways(count: int) -> None:
    for seed in range(30 * MORE):
        draft = sequence(3000 + seed, count)
        try:
            found = ways_of(draft.case())
        except SceneError as refused:
            if "these coincide" in refused.message:
                continue
            raise
        assert min(apart(dict(draft.at), way.points) for way in found.ways) < 1e-5, seed
        assert not found.notes


def run(text: str, *options: str) -> tuple[int, str]:
    words = ["ways", "-", *options]
    ran = CliRunner().invoke(icsolve, words, input="icsolve: 1\n" + text, standalone_mode=False)
    return int(ran.return_value), ran.output


def test_the_command_prints_the_format() -> None:
    code, out = run(FOUR_BAR + LOOP, "--json")
    entry = json.loads(out)
    assert code == 0
    assert entry["complete"] is True
    assert [way["near"] for way in entry["ways"]] == [{"C": [3.61106, 2.46956]}, {"C": [2.50433, -2.00324]}]
    assert set(entry["ways"][0]["points"]) == {"A", "B", "C", "D"}
    code, out = run(FOUR_BAR + LOOP)
    assert code == 0 and "2 ways" in out and "near: {C: [3.61106, 2.46956]}" in out


def test_a_figure_without_a_way_says_so() -> None:
    code, out = run(FOUR_BAR.replace("BC: 3.5", "BC: 0.5") + LOOP, "--json")
    entry = json.loads(out)
    assert code == 1
    assert entry["status"] == Status.CANNOT_ASSEMBLE
    assert entry["ways"] == []
    assert "C" in entry["message"]


def test_a_platform_on_three_legs_has_as_many_ways_as_its_plates_turned_over(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Three rods on a plate given by its sides: at most six for either face; what the search itself finds
    meets the data to rounding."""
    rng = Random(3)
    search, searched = exclusion.every_solution, []

    def kept(group: PointGroup, workspace: Workspace, most: int) -> exclusion.FigureSolutions:
        found = search(group, workspace, most)
        for places in found.places:
            workspace.points.update(places)
            searched.append(max(abs(residual(workspace, datum)[0]) for datum in data_in(group)))
        return found

    monkeypatch.setattr(exclusion, "every_solution", kept)
    for _ in range(4 * MORE):
        feet = [(rng.uniform(-3, 3), rng.uniform(-3, 3)) for _ in range(3)]
        plate = [(rng.uniform(-1, 1), rng.uniform(-1, 1)) for _ in range(3)]
        ground = ", ".join(f"{p}: [{x!r}, {y!r}]" for p, (x, y) in zip("ABC", feet, strict=True))
        at = dict(zip("ABCDEF", [*feet, *plate], strict=True))
        pairs = ("DE", "EF", "DF", "AD", "BE", "CF")
        rods = ", ".join(f"{p}{q}: {math.dist(at[p], at[q])!r}" for p, q in pairs)
        joints = "".join(f"  - {{pin: [1, {k}], at: {p}}}\n" for k, p in ((2, "A"), (3, "B"), (4, "C")))
        case = load(f"icsolve: 1\npoints: {{{ground}}}\nlengths: {{{rods}}}\njoints:\n{joints}")
        found = ways_of(case)
        faces = [0, 0]
        for way in found.ways:
            (dx, dy), (ex, ey), (fx, fy) = (way.points[p] for p in "DEF")
            faces[(ex - dx) * (fy - dy) > (ey - dy) * (fx - dx)] += 1
        assert found.complete
        assert all(face % 2 == 0 and face <= 6 for face in faces)
        assert_picked(case, found)
    assert searched and max(searched) < 1e-14


def test_a_plate_on_three_guides_has_all_its_ways() -> None:
    """No length leads to the frame: two guides that cross hold the plate between them."""
    feet = [(-2.0, 0.0, 80.0), (2.0, 0.0, 110.0), (0.0, 3.0, 15.0)]
    at = [(x + 0.8 * math.cos(math.radians(t)), y + 0.8 * math.sin(math.radians(t))) for x, y, t in feet]
    ground = ", ".join(f"{p}: [{x}, {y}]" for p, (x, y, _) in zip("ABC", feet, strict=True))
    plate = dict(zip("DEF", at, strict=True))
    sides = ", ".join(f"{p}{q}: {math.dist(plate[p], plate[q])!r}" for p, q in ("DE", "EF", "DF"))
    guides = "".join(
        f"  - {{slot: [2, 1], at: {p}, along: {t}, through: {q}}}\n"
        for p, q, (_, _, t) in zip("DEF", "ABC", feet, strict=True)
    )
    case = load(f"icsolve: 1\npoints: {{{ground}}}\nlengths: {{{sides}}}\njoints:\n{guides}")
    found = ways_of(case)
    assert found.complete
    assert min(max(math.dist(way.points[p], plate[p]) for p in plate) for way in found.ways) < 1e-9
    assert len(found.ways) % 2 == 0
    assert_picked(case, found)


def test_a_plate_by_its_angles_has_the_ways_that_it_has_by_its_sides() -> None:
    """On three guides, without a length that leads to F; both ways are of one face."""
    text = """icsolve: 1
points: {A: [-2, 0], B: [2, 0], C: [0, 3]}
lengths: {DE: 3, %s}
%sjoints:
  - {slot: [2, 1], at: D, along: 80, through: A}
  - {slot: [2, 1], at: E, along: 110, through: B}
  - {slot: [2, 1], at: F, along: 15, through: C}
"""
    sides = ways_of(load(text % ("DF: 3.5, EF: 2.5", "")))
    cosines = (9 + 12.25 - 6.25) / 21, (9 + 6.25 - 12.25) / 15
    at_d, at_e = (math.degrees(math.acos(c)) for c in cosines)
    angles = ways_of(load(text.replace(", %s", "%s") % ("", f"angles: {{FDE: {at_d!r}, DEF: {at_e!r}}}\n")))
    assert sides.complete and len(angles.ways) == len(sides.ways) == 2
    for way in angles.ways:
        assert min(apart({p: way.points[p] for p in "DEF"}, one.points) for one in sides.ways) < 1e-7


PLATE = """icsolve: 1
points: {{A: {a}, B: {b}, C: {c}}}
lengths: {{{lengths}}}
{more}joints: [{{pin: [1, 2], at: A}}, {{pin: [1, 3], at: B}}, {{pin: [1, 4], at: C}}]
"""


@pytest.mark.parametrize("sign", [1, -1])
def test_a_way_whose_legs_lie_along_the_axes_is_among_them(sign: int) -> None:
    """The pins of the plate lie on the very edges of where their legs let them be."""
    plate = {"D": (0.0, 0.0), "E": (1.0, 0.5), "F": (0.25, 1.5)}
    feet = {"A": (1.0 * sign, 0.0), "B": (1.0, 0.5 + 0.75 * sign), "C": (0.25 + 0.3, 1.5 + 0.4)}
    at = plate | feet
    pairs = ("DE", "EF", "DF", "AD", "BE", "CF")
    lengths = ", ".join(f"{p}{q}: {math.dist(at[p], at[q])!r}" for p, q in pairs)
    a, b, c = map(list, feet.values())
    found = ways_of(load(PLATE.format(a=a, b=b, c=c, lengths=lengths, more="")))
    assert found.complete
    assert min(apart(plate, {p: way.points[p] for p in plate}) for way in found.ways) < 1e-9


def test_a_point_whose_data_tell_the_same_is_anywhere_along_a_curve(monkeypatch: pytest.MonkeyPatch) -> None:
    """B is on the ray of AB, and where ABG is a straight angle: on the same line, all of it double."""
    monkeypatch.setattr(newton, "MOST_BOXES", 50_000)
    pivot = "joints: [{pin: [1, 2], at: A}]\nlinks: {2: [B, G]}\n"
    text = "points: {A: [0, 0]}\nlengths: {AG: 4}\nangles: {AB: 20, ABG: 180, AG: 20}\n" + pivot
    with pytest.raises(SceneError, match="B may lie anywhere along a curve") as refusal:
        ways_of(figure_case(text))
    assert refusal.value.status == Status.UNDERDETERMINED


@sampled(3)
@pytest.mark.parametrize("name", sample(FILES, 2, "digits of ways"))
def test_a_way_has_the_points_of_the_scene_digit_by_digit(name: str) -> None:
    """Each coordinate rounded once, as `solve` tells it: a zero is no rounding of one. Points of which
    nothing but a profile says where they are have notes."""
    case = load(FILES[name])
    try:
        answer, found = solve(case), ways_of(case)
    except SceneError:
        return
    open_ = {p for p in answer.points if f"nothing says where {p} may be" in found.notes}
    own = [(p, at) for p, at in answer.points.items() if p not in open_]
    told = [way for way in found.ways if all(way.points[p] == at for p, at in own)]
    assert len(told) == 1 or not answer.points


def test_a_case_of_given_centres_has_one_way_though_it_has_no_points(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "box.yaml"
    path.write_text(
        "icsolve: 1\ntitle: Black box\njoints:\n  - {centre: [1, 2], at: [0, 0]}\n"
        "  - {centre: [1, 3], toward: 90}\n  - {centre: [2, 3], at: [2, 3]}\nloads: {}\n"
    )
    assert exit_status("ways", str(path)) == 0
    assert capsys.readouterr().out.startswith("Black box: one way of assembling")


def test_no_more_ways_are_placed_than_can_be_listed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Scissors of twenty stages have a million ways of sixty steps: a note says that there are more than
    those told."""
    monkeypatch.setattr(walk, "MOST_PLACED", 20 * 18)
    found = ways_of(load(scissors(6)(Random(1))))
    assert not found.complete and 0 < len(found.ways) <= 21
    assert "there are more ways" in found.notes[0]


@pytest.mark.parametrize("triple", [(3, 4, 5), (5, 12, 13), (8, 15, 17), (20, 21, 29)])
@pytest.mark.parametrize("guided", [False, True])
def test_a_way_that_leaves_a_point_free_is_no_way_but_told(
    triple: tuple[int, int, int], guided: bool
) -> None:
    """Of the two places of C one has the same circles about it as D, or puts the slot of BC on E's guide:
    E may be anywhere there, and has its places with the other C."""
    a, b, c = triple
    far = c + a + b / 7
    circles = (
        f"points: {{A: [0, 0], B: [{2 * a}, 0], D: [{a}, {b}]}}\n"
        f"lengths: {{AC: {c}, BC: {c}, CE: {far}, DE: {far}}}\n"
    )
    lines = f"points: {{A: [{c + a}, {b}], B: [0, 0], E: [unknown, 0]}}\nlengths: {{AC: {c}, BC: {c}}}\n"
    pins = "joints:\n  - {pin: [1, 2], at: A}\n  - {pin: [2, 3], at: C}\n  - {pin: [1, 3], at: B}\n"
    text = (
        lines + pins + "  - {slot: [4, 3], at: E, along: [B, C]}\n  - {slide: [4, 1], at: E, along: 0}\n"
        if guided
        else circles + pins + "  - {pin: [3, 4], at: C}\n  - {pin: [4, 5], at: E}\n  - {pin: [5, 1], at: D}\n"
    )
    found = ways_of(figure_case(text))
    assert len(found.ways) == (1 if guided else 2) and not found.complete
    (note,) = found.notes
    assert "not shown to be all" in note and "E may lie anywhere" in note
