"""What a varied number does: it moves the mechanism, or makes another of it in each row, or changes a load.

../shared/case-format.md, A sweep and The library.
"""

from __future__ import annotations

import numpy as np
import pytest

import icsolve

CRANK = """icsolve: 1
points: {A: [0, 0], C: [unknown, 20]}
lengths: {AB: 50, BC: 160}
angles: {AB: 40}
near: {C: [195, 20]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0}
loads:
  P: {force: 2000, link: 4, at: C, angle: 180}
  T: {torque: unknown, link: 2}
"""
CYLINDER = """icsolve: 1
points: {A: [0, 0], D: [2, -1]}
lengths: {AB: 2.5, BD: 2.4, AG: 4}
angles: {BAG: 10}
near: {B: [2, 1.4]}
joints: [{pin: [1, 2], at: A}]
loads:
  W: {weight: 600, link: 2, at: G}
  F: {force: unknown, link: 2, at: B, away: D}
"""
LEVER = """icsolve: 1
points: {A: [0, 0], D: [4, 0], E: [2.5, 3]}
lengths: {AB: 1, BC: 3.5, CD: 2.5}
angles: {AB: 60}
near: {C: [3.5, 2.4]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]
loads:
  P: {force: 100, link: 3, at: E, angle: 180}
  T: {torque: unknown, link: 2}
"""


def as_if_written(text: str, settings: dict[str, float]) -> icsolve.Answer:
    """The case solved with numbers replaced."""
    return icsolve.solve(icsolve.load(text, settings={path: repr(v) for path, v in settings.items()}))


DISCS = """icsolve: 1
points: {A: [0, 0], C: [unknown, 20], F: [3, 5]}
lengths: {AB: 50, BC: 160, BG: 20, CG: 150, AE: 20}
angles: {AB: 40, BAE: 25}
near: {C: [195, 20], G: [60, 40]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0}
  - {pin: [3, 5], at: G}
  - {pin: [2, 6], at: E}
  - {pin: [1, 7], at: F}
loads:
  P: {force: 2000, link: 4, at: C, angle: 180}
  T: {torque: unknown, link: 2}
"""
"""The crank with three discs on pins that nothing turns, one of them on the frame."""


@pytest.mark.parametrize(
    ("text", "path", "values"),
    [
        (DISCS, "angles.AB", [40.0, 133.0]),
        (CRANK, "angles.AB", [0.0, 40.0, 133.0, 290.0]),
        (CRANK, "lengths.AB", [30.0, 50.0, 70.0]),
        (CRANK, "lengths.CB", [150.0, 160.0, 300.0]),
        (CRANK, "points.C.y", [-20.0, 0.0, 20.0]),
        (CRANK, "points.A.x", [-5.0, 3.0]),
        (CRANK, "joints.C.along", [-5.0, 0.0, 5.0]),
        (CRANK, "loads.P", [-1.0, 0.0, 5000.0]),
        (CRANK, "loads.P.angle", [0.0, 90.0, 180.0]),
        (CYLINDER, "lengths.BD", [2.0, 2.4, 3.1]),
        (CYLINDER, "lengths.DB", [2.0, 2.4, 3.1]),
        (CYLINDER, "angles.BAG", [-20.0, 10.0, 20.0]),
    ],
)
def test_a_row_is_the_case_with_the_number_replaced(text: str, path: str, values: list[float]) -> None:
    """Where nothing but lengths and angles of links, and what is given of the frame, make the figure."""
    sweep = icsolve.sweep(icsolve.load(text), {path: values}, ("answers", "points", "error"))
    own = "lengths.BC" if path == "lengths.CB" else "lengths.BD" if path == "lengths.DB" else path
    for k, value in enumerate(values):
        answer = as_if_written(text, {own: value})
        for name, found in answer.answers.items():
            assert found.error is not None
            assert abs(found.value - sweep.answers[name][k]) <= found.error + sweep.error[name][k]
        for name, place in answer.points.items():
            assert sweep.points[name][k] == pytest.approx(place, abs=1e-11)


def test_points_by_coordinates_on_a_moving_link_are_carried() -> None:
    """E is given by coordinates on the coupler: it keeps its place there, not in the frame."""
    degrees = np.arange(0.0, 360.0, 30.0)
    sweep = icsolve.sweep(icsolve.load(LEVER), {"angles.AB": degrees}, ("points",))
    b = np.stack([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))], axis=1)
    apart = [np.hypot(*(sweep.points["E"] - p).T) for p in (b, sweep.points["C"])]
    written = icsolve.solve(icsolve.load(LEVER), examine=True).points
    for name, distances in zip("BC", apart, strict=True):
        assert distances == pytest.approx(np.hypot(*np.subtract(written["E"], written[name])), abs=1e-12)


def test_a_slider_that_poses_moves_and_one_that_reshapes_does_not() -> None:
    """The block's coordinate along its guide moves it; square to the guide it shifts the guide; and where
    all points are given by coordinates, one of them alone makes other links."""
    text = CRANK.replace("angles: {AB: 40}\n", "").replace("[unknown, 20]", "[200, 20]")
    text = text.replace("near: {C: [195, 20]}", "near: {B: [40, 30]}")
    moved = icsolve.sweep(icsolve.load(text), {"points.C.x": [190.0, 200.0]}, ("points",))
    assert np.hypot(*moved.points["B"].T) == pytest.approx(50.0)
    assert np.hypot(*(moved.points["C"] - moved.points["B"]).T) == pytest.approx(160.0)
    bars = icsolve.load(
        "icsolve: 1\npoints: {A: [0, 0], B: [1, 1], C: [4, 2], D: [5, 0]}\n"
        "joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]\n"
    )
    other = icsolve.sweep(bars, {"points.B.x": [1.0, 1.2]}, ("points",))
    assert other.points["B"].tolist() == [[1.0, 1.0], [1.2, 1.0]]
    assert other.points["C"].tolist() == [[4.0, 2.0], [4.0, 2.0]]


def test_a_load_keeps_its_direction_unless_it_turns_with_a_link() -> None:
    """A force on the crank pin, absolute or turning with the crank: then its moment is the same all round."""
    text = CRANK.replace(
        "P: {force: 2000, link: 4, at: C, angle: 180}", "P: {force: 10, link: 2, at: B, angle: 130}"
    )
    turning = text.replace("angle: 130}", "angle: 130, turns_with: 2}")
    degrees = np.arange(0.0, 360.0, 15.0)
    fixed = icsolve.sweep(icsolve.load(text), {"angles.AB": degrees})
    assert fixed.answers["T"] == pytest.approx(-500.0 * np.cos(np.radians(degrees - 40.0)), abs=1e-10)
    turned = icsolve.sweep(icsolve.load(turning), {"angles.AB": degrees})
    assert turned.answers["T"] == pytest.approx(-500.0, rel=1e-12)
    for key, form in (("[-6.427876096865393, 7.660444431189781]", "force"), ("slope", "slope")):
        other = (
            turning.replace("force: 10", f"force: {key}").replace("angle: 130, ", "")
            if form == "force"
            else None
        )
        other = other or turning.replace("angle: 130", "slope: [-6.427876096865393, 7.660444431189781]")
        assert icsolve.sweep(icsolve.load(other), {"angles.AB": degrees}).answers["T"] == pytest.approx(
            -500.0
        )


def test_a_cylinder_between_two_moving_links() -> None:
    """Its length moves them, its force acts along it in every row."""
    text = """icsolve: 1
points: {A: [0, 0], D: [5, 0]}
lengths: {AB: 3, BC: 4, CD: 3.5, AP: 2, DQ: 2, PQ: 4.2}
angles: {BAP: 0, CDQ: 0}
near: {B: [1, 2.8], C: [4.8, 3.5]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]
loads:
  W: {weight: 100, link: 3, at: C}
  F: {force: unknown, link: 2, at: P, toward: Q, against: 4}
links: {2: [P], 4: [Q]}
"""
    case = icsolve.load(text)
    lengths = np.linspace(4.1, 4.4, 7)
    sweep = icsolve.sweep(case, {"lengths.PQ": lengths}, ("answers", "points", "status"))
    assert (sweep.status == "ok").all()
    apart = np.hypot(*(sweep.points["P"] - sweep.points["Q"]).T)
    assert apart == pytest.approx(lengths, abs=1e-12)
    for k in range(7):
        assert sweep.answers["F"][k] == pytest.approx(
            icsolve.solve(sweep.case_of(k)).answers["F"].value, rel=1e-11
        )


def test_moving_and_reshaping_numbers_together() -> None:
    """Each length of the rod is a mechanism of its own, which the crank angle then moves."""
    ab, bc = (
        a.ravel() for a in np.meshgrid(np.arange(0.0, 360.0, 40.0), [120.0, 160.0, 200.0], indexing="ij")
    )
    sweep = icsolve.sweep(icsolve.load(CRANK), {"angles.AB": ab, "lengths.BC": bc})
    for k in range(0, len(ab), 5):
        one = as_if_written(CRANK, {"angles.AB": float(ab[k]), "lengths.BC": float(bc[k])})
        assert sweep.answers["T"][k] == pytest.approx(one.answers["T"].value, rel=1e-12, abs=1e-9)


def test_a_family_whose_figure_has_no_construction() -> None:
    """Points that only all data together place are solved row by row, near to the row before."""
    text = """icsolve: 1
points: {A: [0, 0], D: [4, 0], G: [2, 5]}
lengths: {AB: 2, DC: 2, GH: 2, BC: 2.5, CH: 3, BH: 3}
angles: {AB: 80}
near: {C: [3.5, 2.2], H: [1.6, 3.2]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: B}, {pin: [3, 4], at: C}, {pin: [4, 1], at: D}]
links: {3: [H]}
loads: {P: {force: 10, link: 3, at: H, angle: 0}, T: {torque: unknown, link: 2}}
"""
    case = icsolve.load(text.replace("GH: 2, ", "").replace(", G: [2, 5]", ""))
    values = np.linspace(2.3, 2.7, 5)
    sweep = icsolve.sweep(case, {"lengths.BC": values})
    assert (sweep.status == "ok").all()
    for k, value in enumerate(values):
        one = as_if_written(
            text.replace("GH: 2, ", "").replace(", G: [2, 5]", ""), {"lengths.BC": float(value)}
        )
        assert sweep.answers["T"][k] == pytest.approx(one.answers["T"].value, rel=1e-11)


def test_friction_is_solved_row_by_row() -> None:
    text = CRANK.replace("along: 0}", "along: 0, mu: 0.1}") + "motion: {link: 2, turns: ccw}\n"
    sweep = icsolve.sweep(icsolve.load(text), {"angles.AB": [30.0, 60.0, 200.0]})
    for k, value in enumerate((30.0, 60.0, 200.0)):
        one = as_if_written(text, {"angles.AB": value})
        assert sweep.answers["T"][k] == pytest.approx(one.answers["T"].value, rel=1e-11)
    mu = icsolve.sweep(icsolve.load(text), {"joints.C.mu": [0.0, 0.1, 0.2]})
    for k, value in enumerate((0.0, 0.1, 0.2)):
        one = as_if_written(text, {"joints.C.mu": value})
        assert mu.answers["T"][k] == pytest.approx(one.answers["T"].value, rel=1e-11)


def test_friction_without_a_motion_gives_ranges() -> None:
    text = CRANK.replace("along: 0}", "along: 0, mu: 0.1}")
    sweep = icsolve.sweep(icsolve.load(text), {"angles.AB": [30.0, 60.0]})
    assert sweep.status.tolist() == ["holds", "holds"]
    assert np.isnan(sweep.answers["T"]).all()
    one = as_if_written(text, {"angles.AB": 30.0}).answers["T"].holds
    assert sweep.holds["T"][0] == pytest.approx(one, rel=1e-11)


def test_each_of_a_family_of_figures_that_friction_holds_keeps_its_range() -> None:
    """Points that only all data together place; each length of the coupler is a mechanism that is turned."""
    text = """icsolve: 1
points: {A: [0, 0], D: [4, 0], G: [2, 5]}
lengths: {AB: 2, DC: 2, GH: 2, BC: 2.5, CH: 3, BH: 3}
near: {B: [0.35, 1.97], C: [3.5, 2.2], H: [1.6, 3.2]}
joints:
  - {pin: [1, 2], at: A, mu: 0.3, radius: 0.2}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}
links: {3: [H]}
loads: {P: {force: 10, link: 3, at: H, angle: 0}, T: {torque: unknown, link: 2}}
"""
    turned, coupler = {"2": [0.0, 5.0, 0.0, 5.0]}, {"lengths.BC": [2.4, 2.4, 2.5, 2.5]}
    sweep = icsolve.sweep(icsolve.load(text), coupler, drive=turned)
    assert (sweep.status == "holds").all()
    for row, held in enumerate(sweep.holds["T"]):
        assert held == pytest.approx(icsolve.solve(sweep.case_of(row)).answers["T"].holds, rel=1e-9)


# --- what can't be asked ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("path", "said"),
    [
        ("angles.AC", "did you mean 'angles.AB'"),
        ("angles.BA", "angles.AB, which is another angle"),
        ("lengths.AZ", "no number there"),
        ("loads.T", "T is the unknown"),
        ("loads.Q", "no number there"),
        ("crank", "a path is like angles.AB"),
        ("points.C.x", "no number there"),
    ],
)
def test_a_path_that_the_case_does_not_have(path: str, said: str) -> None:
    with pytest.raises(icsolve.CaseError, match=r"<text>:\d+:\d+: cannot vary") as refusal:
        icsolve.sweep(icsolve.load(CRANK), {path: [1.0]})
    assert said in str(refusal.value)


@pytest.mark.parametrize(
    ("vary", "want", "said"),
    [
        ({}, ("answers",), "nothing is varied"),
        ({"angles.AB": []}, ("answers",), "no values"),
        ({"angles.AB": [float("nan")]}, ("answers",), "not all finite"),
        ({"angles.AB": [1.0 + 2.0j]}, ("answers",), "should be numbers"),
        ({"angles.AB": [[1.0]]}, ("answers",), "one row of numbers"),
        (
            {"angles.AB": [1.0, 2.0], "loads.P": [1.0, 2.0, 3.0]},
            ("answers",),
            "has 2 values where another has 3",
        ),
        ({"lengths.AB": [1.0], "lengths.BA": [1.0]}, ("answers",), "the same number"),
        ({"angles.AB": [1.0]}, ("answer",), "did you mean 'answers'"),
        ({"angles.AB": [1.0]}, ("points.Z",), "no point 'Z'"),
        ({"angles.AB": [1.0]}, ("centres.2-9",), "not a pair of links"),
    ],
)
def test_columns_that_make_no_table(vary: dict[str, list[float]], want: tuple[str, ...], said: str) -> None:
    with pytest.raises(ValueError, match=said):
        icsolve.sweep(icsolve.load(CRANK), vary, want)


def test_driving_links_that_cannot() -> None:
    case = icsolve.load(CRANK)
    with pytest.raises(ValueError, match="no link '9'"):
        icsolve.sweep(case, drive={"9": [1.0]})
    for link, said in (("1", "the frame"), ("4", "does not turn")):
        with pytest.raises(icsolve.SceneError, match=said):
            icsolve.sweep(case, drive={link: [1.0]})
    with pytest.raises(icsolve.SceneError, match="1 degree of freedom"):
        icsolve.sweep(case, {"angles.AB": [1.0]}, drive={"3": [1.0]})


def test_arrays_are_only_made_for_what_is_wanted() -> None:
    sweep = icsolve.sweep(
        icsolve.load(CRANK), {"angles.AB": [0.0, 1.0]}, ("answers", "points.C", "centres.42")
    )
    assert list(sweep.points) == ["C"]
    assert list(sweep.centres) == ["2-4"]
    assert (sweep.rates, sweep.error, sweep.holds) == ({}, {}, {})


def test_centres_are_those_of_one_scene() -> None:
    """Homogeneous, in case units; at infinity for the slide."""
    sweep = icsolve.sweep(icsolve.load(CRANK), {"angles.AB": [25.0, 70.0]}, ("centres",))
    for k, value in enumerate((25.0, 70.0)):
        case = icsolve.load(CRANK, settings={"angles.AB": repr(value)})
        for pair, centre in icsolve.solve(case, all_centres=True).centres.items():
            x, y, w = sweep.centres["-".join(pair)][k]
            if centre.kind == "at":
                assert (x / w, y / w) == pytest.approx(centre.place, abs=1e-9)
            else:
                assert w == 0.0
                assert np.degrees(np.arctan2(y, x)) % 180.0 == pytest.approx(centre.place[0])


TEETH = """icsolve: 1
units: {length: mm, force: N}
points: {A: [0, 0], B: [60, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: B}
  - {gears: [2, 3], teeth: [20, 40], normal pressure angle: 20, helix angle: 25, %s}
loads:
  M: {torque: 3, link: 3}
  T: {torque: unknown, link: 2}
"""
SECTIONS = {  # 60 teeth on 60 mm: a module of 2 in the plane of the wheels, of 2 cos 25 square to the teeth
    "normal module": 1.8126155740733,
    "transverse module": 2.0,
    "normal diametral pitch": 0.55168896,
    "transverse diametral pitch": 0.5,
}


@pytest.mark.parametrize("size", SECTIONS)
def test_the_size_of_helical_teeth_is_that_of_their_section_in_every_row(size: str) -> None:
    """Varied itself, and with the helix angle, which turns one section into the other: a row has the status
    of the case as if written so."""
    text = TEETH % f"{size}: {SECTIONS[size]}"
    for path, values in (
        (f"joints.2-3.{size}", [1.0 / 1.8126155740733, 0.5, SECTIONS[size], 2.0, 1.79]),
        ("joints.2-3.helix angle", [0.0, 24.9, 25.0, 26.0]),
    ):
        found = icsolve.sweep(icsolve.load(text), {path: np.array(values)})
        for value, status in zip(values, found.status.tolist(), strict=True):
            try:
                as_if_written(text, {path: value})
                expected = "ok"
            except icsolve.SceneError as refused:
                expected = str(refused.status)
            assert status == expected, (path, value)
