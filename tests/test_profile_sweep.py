"""Sweeps of cams: followers that the profile moves, against closed forms, single scenes and differences."""

from __future__ import annotations

import math
from dataclasses import replace
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from cams import HEAD, sliding, swinging, table
from icsolve.case import Case, Inertia, Motion
from icsolve.errors import SceneError, Status
from icsolve.read import load
from icsolve.solve import solve
from icsolve.sweep import cam_sweep, sweep
from icsolve.sweep.cam_sweep import SAID
from icsolve.sweep.varied_numbers import with_numbers
from made import number
from sizes import FULL, sampled

E, R, ROLLER = 20.0, 40.0, 10.0
CIRCLE = "{circle: C, radius: 40}"
TURN = np.arange(0.0, 361.0, 30.0)


def lobes(degrees: float) -> float:
    """Three lobes with hollows between them."""
    return 40.0 + 8.0 * math.cos(3.0 * math.radians(degrees))


LOBES = table([(10.0 * k, lobes(10.0 * k)) for k in range(36)])
SQUARE = "{polygon: [[35, 35], [-35, 35], [-35, -35], [35, -35]]}"
CAMS = {
    "flat on a circle": sliding(CIRCLE, "{flat: B, along: 0}"),
    "slanted face on a circle": sliding(CIRCLE, "{flat: B, along: 12}"),
    "roller on a circle": sliding(CIRCLE, "{roller: B, radius: 10}", offset=6.0),
    "knife edge on a circle": sliding(CIRCLE, "{knife: B}", offset=-4.0),
    "roller on a square": sliding(SQUARE, "{roller: B, radius: 10}", degrees=45.0, offset=7.0),
    "knife edge on a square": sliding(SQUARE, "{knife: B}", offset=7.0),
    "roller on lobes": sliding(LOBES, "{roller: B, radius: 6}", offset=3.0),
    "face on an arm": swinging(CIRCLE, "{flat: D, along: [D, E]}"),
    "roller on an arm": swinging(CIRCLE, "{roller: E, radius: 10}"),
    "roller on an arm on lobes": swinging(LOBES, "{roller: E, radius: 10}"),
}


def point_of(name: str) -> str:
    """The follower's point: on an arm its end."""
    return "E" if "arm" in name else "B"


# --- closed forms ---------------------------------------------------------------------------------


def test_flat_follower_of_an_eccentric_circle_through_a_turn() -> None:
    """s = r + e sin(theta), T = P e cos(theta) (Norton, sect. 8.1)."""
    found = sweep(CAMS["flat on a circle"], drive={"2": TURN}, want=("answers", "points", "status"))
    theta = np.radians(40.0 + TURN)
    assert (found.status == "ok").all()
    np.testing.assert_allclose(found.points["B"][:, 1], R + E * np.sin(theta), atol=1e-11)
    np.testing.assert_allclose(found.answers["T12"], 100.0 * E * np.cos(theta), atol=1e-9)


def test_offset_roller_follower_of_an_eccentric_circle_through_a_turn() -> None:
    found = sweep(CAMS["roller on a circle"], drive={"2": TURN}, want=("answers", "points"))
    theta = np.radians(40.0 + TURN)
    across = E * np.cos(theta) - 6.0
    root = np.sqrt((R + ROLLER) ** 2 - across**2)
    np.testing.assert_allclose(found.points["B"][:, 1], E * np.sin(theta) + root, atol=1e-10)
    rate = E * np.cos(theta) + across * E * np.sin(theta) / root
    np.testing.assert_allclose(found.answers["T12"], 100.0 * rate, atol=1e-8)


def test_widest_pressure_angle_is_said() -> None:
    """sin(phi) = e / (r + rr) at its most, where the cam's centre is level with its axis."""
    case = sliding(CIRCLE, "{roller: B, radius: 10}", degrees=0.0)
    notes = sweep(case, drive={"2": np.arange(0.0, 91.0, 15.0)}).notes
    widest = math.degrees(math.asin(E / (R + ROLLER)))
    assert f"the pressure angle of links 2 and 3 is {widest:.4g} deg at most, at 2 = 0." in notes
    assert notes[0] == SAID


def test_first_meeting_from_outside_skips_the_hollows() -> None:
    """A knife edge beside the axis of a cam with hollows rests on the highest of the places where its line
    meets the cam; brute force over the profile's points, to their spacing."""
    angles = np.linspace(0.0, 360.0, 40001)
    star = table([(4.0 * k, 40.0 + 18.0 * math.cos(4.0 * math.radians(4.0 * k))) for k in range(90)])
    case = sliding(star, "{knife: B}", offset=28.0, degrees=10.0)
    turn = np.arange(0.0, 90.0, 7.5)
    found = sweep(case, drive={"2": turn}, want=("points",))
    for row, by in enumerate(turn):
        way = np.radians(angles + 10.0 + by)
        radius = 40.0 + 18.0 * np.cos(4.0 * np.radians(angles))
        x, y = radius * np.cos(way), radius * np.sin(way)
        crossing = np.flatnonzero((x[:-1] - 28.0) * (x[1:] - 28.0) <= 0.0)
        assert found.points["B"][row, 1] == pytest.approx(y[crossing].max(), abs=2e-2)


# --- single scenes --------------------------------------------------------------------------------


@sampled(3)
@pytest.mark.parametrize("name", CAMS)
def test_rows_are_the_scenes_as_if_written_so(name: str) -> None:
    """Each row against `solve` of the case with the cam's angle written, and of the row's own case."""
    case = CAMS[name]
    found = sweep(case, drive={"2": TURN[:-1]}, want=("answers", "points", "rates", "status"))
    assert (found.status == "ok").all()
    start = next(a.value for a in case.angles)
    first, step = (0, 1) if FULL else (len(name) % 2, 2)
    for row, by in list(enumerate(TURN[:-1]))[first::step]:
        own = solve(found.case_of(row), rates=True)
        alone = [own]
        if "square" not in name:  # its corners are written for one position
            written = with_numbers(case, {"angles.AC": start.value + float(by)})
            x, y = found.points[point_of(name)][row].tolist()
            alone.append(solve(replace(written, near={point_of(name): (x, y)}), rates=True))
        for answer in alone:
            assert answer.rates is not None
            assert found.answers["T12"][row] == pytest.approx(answer.answers["T12"].value, abs=2e-7)
            assert found.rates["3"][row] == pytest.approx(answer.rates["3"], abs=1e-9)
            for point, place in answer.points.items():
                assert found.points[point][row] == pytest.approx(place, abs=1e-9)


@pytest.mark.parametrize("name", [name for name in CAMS if "square" not in name])
def test_differences_of_the_swept_follower_are_its_rates(name: str) -> None:
    """Central differences over a thousandth of a degree, good to 1e-6 of the size."""
    case, h = CAMS[name], 1e-3
    middle = TURN[:-1] + 1.7
    both = np.concatenate([middle - h, middle, middle + h])
    found = sweep(case, drive={"2": both}, want=("points", "answers", "rates"))
    n, step = len(middle), 2.0 * math.radians(h)
    point = found.points[point_of(name)]
    moved = (point[2 * n :] - point[:n]) / step
    torque = found.answers["T12"][n : 2 * n]
    if "arm" in name:
        d = found.points["D"][n : 2 * n]
        arm = point[n : 2 * n] - d
        turning = (arm[:, 0] * moved[:, 1] - arm[:, 1] * moved[:, 0]) / (arm**2).sum(axis=1)
        np.testing.assert_allclose(found.rates["3"][n : 2 * n], turning, atol=1e-5)
        np.testing.assert_allclose(torque, -100.0 * turning, atol=1e-3)
    else:
        np.testing.assert_allclose(torque, 100.0 * moved[:, 1], atol=5e-3)


VALVE = (
    f"{HEAD}points: {{A: [0, 0], D: [-60, 90], V: [-120, unknown]}}\n"
    "lengths: {AC: 20, DB: 85, DF: 60, FV: 40}\nangles: {AC: 40, BDF: 180}\n"
    "near: {B: [0, 70], V: [-120, 60]}\n"
    "profile:\n  2: {circle: C, radius: 40}\n  3: {roller: B, radius: 10}\n"
    "joints:\n  - {pin: [1, 2], at: A}\n  - {contact: [2, 3]}\n  - {pin: [3, 1], at: D}\n"
    "  - {pin: [3, 4], at: F}\n  - {pin: [4, 5], at: V}\n  - {slide: [5, 1], at: V, along: 90}\n"
    "loads:\n  P: {force: 100, link: 5, at: V, angle: 90}\n  T12: {torque: unknown, link: 2}\n"
)


def test_what_hangs_on_the_follower_moves_with_it() -> None:
    """A valve train: cam, rocker, rod, valve. By power T = -P dV/dtheta, by differences."""
    case, h = load(VALVE), 1e-3
    middle = TURN[:-1]
    both = np.concatenate([middle - h, middle, middle + h])
    found = sweep(case, drive={"2": both}, want=("points", "answers", "status"))
    assert (found.status == "ok").all()
    n = len(middle)
    lifted = (found.points["V"][2 * n :, 1] - found.points["V"][:n, 1]) / (2.0 * math.radians(h))
    np.testing.assert_allclose(found.answers["T12"][n : 2 * n], -100.0 * lifted, atol=1e-3)
    for row in range(n, 2 * n):
        answer = solve(found.case_of(row))
        assert found.answers["T12"][row] == pytest.approx(answer.answers["T12"].value, abs=1e-7)


def test_two_cams_on_one_shaft_move_two_followers() -> None:
    """Each follower is that of its cam alone; the torques add up."""
    text = (
        f"{HEAD}points: {{A: [0, 0], B: [0, unknown], G: [unknown, 0]}}\nlengths: {{AC: 20}}\n"
        "angles: {AC: 40}\nnear: {B: [0, 60], G: [60, 0]}\n"
        "profile:\n  2: {circle: C, radius: 40}\n  3: {roller: B, radius: 10}\n  4: {flat: G, along: 90}\n"
        "joints:\n  - {pin: [1, 2], at: A}\n  - {contact: [2, 3]}\n  - {slide: [3, 1], at: B, along: 90}\n"
        "  - {contact: [2, 4]}\n  - {slide: [4, 1], at: G, along: 0}\n"
        "loads:\n  P: {force: 100, link: 3, at: B, angle: -90}\n\n"
        "  Q: {force: 50, link: 4, at: G, angle: 180}\n  T12: {torque: unknown, link: 2}\n"
    )
    found = sweep(load(text), drive={"2": TURN}, want=("answers", "points"))
    alone = sweep(sliding(CIRCLE, "{roller: B, radius: 10}"), drive={"2": TURN}, want=("answers",))
    theta = np.radians(40.0 + TURN)
    np.testing.assert_allclose(found.points["G"][:, 0], R + E * np.cos(theta), atol=1e-11)
    second = -50.0 * E * np.sin(theta)
    np.testing.assert_allclose(found.answers["T12"], alone.answers["T12"] + second, atol=1e-8)


# --- varied numbers, statuses ---------------------------------------------------------------------


def test_the_cams_angle_moves_it_as_its_turning_does() -> None:
    case = CAMS["roller on a circle"]
    by_angle = sweep(case, {"angles.AC": 40.0 + TURN}, ("answers", "points"))
    by_link = sweep(case, drive={"2": TURN}, want=("answers", "points"))
    np.testing.assert_allclose(by_angle.answers["T12"], by_link.answers["T12"], atol=1e-8)
    np.testing.assert_allclose(by_angle.points["B"], by_link.points["B"], atol=1e-10)


def test_numbers_of_a_profile_and_loads_are_varied_with_the_motion() -> None:
    case = CAMS["flat on a circle"]
    radii, forces, turn = np.array([30.0, 40.0, 30.0]), np.array([1.0, 2.0, 3.0]), np.array([0.0, 20.0, 50.0])
    vary = {"profile.2.radius": radii, "loads.P": forces}
    found = sweep(case, vary, ("answers", "points"), drive={"2": turn})
    theta = np.radians(40.0 + turn)
    np.testing.assert_allclose(found.points["B"][:, 1], radii + E * np.sin(theta), atol=1e-11)
    np.testing.assert_allclose(found.answers["T12"], forces * E * np.cos(theta), atol=1e-9)


def test_family_of_cams_without_motion() -> None:
    radii = np.array([25.0, 30.0, 60.0])
    found = sweep(CAMS["flat on a circle"], {"profile.2.radius": radii}, ("points", "answers"))
    np.testing.assert_allclose(found.points["B"][:, 1], radii + E * math.sin(math.radians(40.0)), atol=1e-11)


def test_rows_in_which_the_follower_never_meets_the_cam_have_their_status() -> None:
    """A knife edge at 50 beside a disk whose centre goes 20 to each side of the axis."""
    case = sliding(CIRCLE, "{knife: B}", offset=50.0, degrees=0.0)
    turn = TURN + 1.0
    found = sweep(case, drive={"2": turn}, want=("answers", "status", "points"))
    reached = E * np.cos(np.radians(turn)) > 10.0
    assert ((found.status == "ok") == reached).all()
    assert (found.status[~reached] == Status.CANNOT_ASSEMBLE).all()
    assert np.isnan(found.answers["T12"][~reached]).all() and np.isnan(found.points["B"][~reached]).all()


def test_lost_contact_is_said_in_a_sweep() -> None:
    """A force that lifts the follower loses the contact in every row."""
    case = sliding(CIRCLE, "{flat: B, along: 0}", degrees=0.0)
    lifting = with_numbers(case, {"loads.P.angle": 90.0})
    notes = sweep(lifting, drive={"2": np.array([0.0, 30.0])}).notes
    assert any("is lost in 2 rows, first at 2 = 0" in note for note in notes)


def test_bounds_are_those_of_the_scenes() -> None:
    """At most two units of the last place, and what the closed form gives lies within."""
    found = sweep(CAMS["flat on a circle"], drive={"2": TURN}, want=("answers", "error"))
    error, value = found.error["T12"], found.answers["T12"]
    assert (error <= 2.0 * np.spacing(np.abs(value))).all()
    expected = [100.0 * E * math.cos(math.radians(40.0 + by)) for by in TURN]
    np.testing.assert_allclose(value, expected, rtol=1e-14, atol=3e-13)


def test_friction_of_a_contact_is_solved_in_every_row() -> None:
    """T = P (e cos(theta) + mu (r + e sin(theta))): the face rubs against the top of the disk."""
    case = sliding(CIRCLE, "{flat: B, along: 0}", more=", mu: 0.1")
    moving = replace(case, motion=(Motion("2", turns="ccw"),))
    found = sweep(moving, drive={"2": TURN})
    theta = np.radians(40.0 + TURN)
    expected = 100.0 * (E * np.cos(theta) + 0.1 * (R + E * np.sin(theta)))
    np.testing.assert_allclose(found.answers["T12"], expected, atol=1e-9)


@pytest.mark.parametrize("links", ["2, 3", "3, 2"])
@pytest.mark.parametrize("path", ["joints.2-3.mu", "joints.3-2.mu"])
def test_friction_of_a_contact_is_varied_alone_and_with_the_motion(path: str, links: str) -> None:
    """By its links in either order, as `--set` changes it; it moves nothing."""
    text = (
        f"{HEAD}motion: {{link: 2, turns: ccw}}\npoints: {{A: [0, 0], B: [4, unknown]}}\n"
        "lengths: {AC: 20}\nangles: {AC: 40}\nnear: {B: [4, 60]}\n"
        f"profile:\n  2: {CIRCLE}\n  3: {{roller: B, radius: 10}}\n"
        f"joints:\n  - {{pin: [1, 2], at: A}}\n  - {{contact: [{links}], mu: 0.1}}\n"
        "  - {slide: [3, 1], at: B, along: 90}\n"
        "loads:\n  P: {force: 100, link: 3, at: B, angle: -90}\n  T12: {torque: unknown, link: 2}\n"
    )
    rubs, by = np.array([0.05, 0.1, 0.3]), np.array([40.0, 40.0, 75.0])
    alone, moved = sweep(load(text), {path: rubs}), sweep(load(text), {path: rubs, "angles.AC": by})
    for k, mu in enumerate(rubs.tolist()):
        one = solve(load(text, settings={path: repr(mu)}))
        assert float(alone.answers["T12"][k]) == pytest.approx(one.answers["T12"].value, rel=1e-14)
        both = solve(load(text, settings={path: repr(mu), "angles.AC": repr(by.tolist()[k])}))
        assert float(moved.answers["T12"][k]) == pytest.approx(both.answers["T12"].value, rel=1e-12)


def refused(case: Case, **drive: float) -> SceneError:
    with pytest.raises(SceneError) as found:
        sweep(case, drive={link[1:]: np.array([by]) for link, by in drive.items()})
    return found.value


def test_follower_cannot_be_the_driving_link() -> None:
    error = refused(CAMS["flat on a circle"], _3=1.0)
    assert error.status == Status.MOBILITY and "drive link 2, and the profile moves it" in error.message


def test_contact_without_a_profile_stays_refused_by_name() -> None:
    text = (
        f"{HEAD}points: {{A: [0, 0], C: [10, 0], B: [0, 50], K: [10, 50]}}\nlinks: {{2: [C]}}\n"
        "joints:\n  - {pin: [1, 2], at: A}\n  - {contact: [2, 3], at: K, normal: 90}\n"
        "  - {slide: [3, 1], at: B, along: 90}\n"
        "loads:\n  P: {force: 100, link: 3, at: B, angle: -90}\n  T12: {torque: unknown, link: 2}\n"
    )
    error = refused(load(text), _2=1.0)
    assert error.status == Status.UNSUPPORTED
    assert "the contact of links 2 and 3 at K cannot be moved" in error.message


def test_follower_that_the_frame_does_not_guide_is_refused_by_name() -> None:
    text = (
        f"{HEAD}points: {{A: [0, 0], D: [80, 0], B: [0, unknown]}}\nlengths: {{AC: 20, AD: 80}}\n"
        "angles: {AC: 40}\nnear: {B: [0, 60]}\n"
        "profile:\n  2: {circle: C, radius: 40}\n  3: {roller: B, radius: 10}\n"
        "joints:\n  - {pin: [1, 2], at: A}\n  - {contact: [2, 3]}\n  - {slide: [3, 4], at: B, along: 90}\n"
        "  - {pin: [4, 1], at: A}\n"
        "loads:\n  P: {force: 100, link: 3, at: B, angle: -90}\n  T12: {torque: unknown, link: 2}\n"
        "  T14: {torque: unknown, link: 4}\n"
    )
    error = refused(load(text), _2=1.0)
    assert error.status == Status.UNSUPPORTED and "guided by the frame" in error.message


def test_a_sweep_says_where_the_profiles_touch() -> None:
    """A roller of 10 on a circle of 40: the contact is 40 from the circle's centre, 10 from the roller's."""
    found = sweep(CAMS["roller on a circle"], drive={"2": TURN}, want=("points", "status"))
    (places,) = found.touching.values()
    assert (found.status == "ok").all()
    np.testing.assert_allclose(np.linalg.norm(places - found.points["C"], axis=1), R, atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(places - found.points["B"], axis=1), ROLLER, atol=1e-9)
    assert sweep(CAMS["roller on a circle"], drive={"2": TURN}).touching == {}


def test_progress_is_told_every_row() -> None:
    told: list[int] = []
    sweep(CAMS["flat on a circle"], drive={"2": TURN}, progress=told.append)
    assert sum(told) == len(TURN)


# --- all rows at once -----------------------------------------------------------------------------

PULLED = sliding(CIRCLE, "{flat: B, along: 0}")
PULLED = replace(
    PULLED, loads=tuple(q._replace(turns_with="2") if q.name == "P" else q for q in PULLED.loads)
)
LIBRARY = Path(__file__).parent.parent / "cases" / "cams"
DWELLS, SPINS = (load(str(LIBRARY / f"{name}.yaml")) for name in ("tangent_cam", "offset_roller_follower"))
ROWS = {**CAMS, "a dwell": DWELLS, "a roller that spins": SPINS, "a load that lifts the follower": PULLED}


@sampled(3)
@pytest.mark.parametrize("name", ROWS)
def test_rows_at_once_are_the_scenes_one_by_one(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    """Values, statuses, contacts, and what is said of pressure angles and of lost contacts; to rounding."""
    turn, want = np.arange(-175.0, 180.0, 39.5), ("answers", "points", "rates", "centres", "status")
    together = sweep(ROWS[name], drive={"2": turn}, want=want)
    monkeypatch.setattr(cam_sweep, "_together", lambda _, part, *__: np.zeros(len(part.rows), dtype=bool))
    alone = sweep(ROWS[name], drive={"2": turn}, want=want)
    assert together.notes == alone.notes
    assert (together.status == alone.status).all()
    for kind in ("answers", "points", "rates"):
        for key, array in alone.kinds[kind].items():
            np.testing.assert_allclose(together.kinds[kind][key], array, rtol=1e-11, atol=1e-9)
    for key, array in alone.touching.items():
        np.testing.assert_allclose(together.touching[key], array, atol=1e-9)
    for key, array in alone.centres.items():
        across = np.cross(together.centres[key], array)
        np.testing.assert_allclose(across, 0.0, atol=1e-9 * np.abs(array).max() ** 2)


@pytest.fixture
def solved(monkeypatch: pytest.MonkeyPatch) -> list[object]:
    """The rows that were solved as scenes."""
    every: list[object] = []
    scenes, one = (
        import_module("icsolve.sweep.rows_by_scenes"),
        import_module("icsolve.sweep.rows_by_scenes")._one,
    )
    monkeypatch.setattr(scenes, "_one", lambda *all: (every.append(all), one(*all))[1])
    return every


@sampled(3)
@pytest.mark.parametrize("name", ROWS)
def test_a_turn_of_a_cam_is_on_the_record(solved: list[object], name: str) -> None:
    """Scenes are those rows alone in which a follower turns round, or in a dwell: at most 5 of 142."""
    sweep(ROWS[name], drive={"2": np.arange(-175.0, 180.0, 2.5)})
    assert len(solved) <= 5


@sampled(4)
@pytest.mark.parametrize("name", ROWS)
def test_a_turn_of_a_cam_with_inertia_forces_is_on_the_record(
    monkeypatch: pytest.MonkeyPatch, solved: list[object], name: str
) -> None:
    """By the curvature of the cam in each row: velocities, accelerations and answers are those of the scenes,
    to rounding."""
    follower = "3" if "B" in ROWS[name].carries["3"] or "arm" in name else "4"
    given = Motion("2", number("30"), acceleration=number("7"))
    mass = Inertia(number("2"), point_of(name), number("0.01"))
    case = replace(ROWS[name], motion=(given,), inertia={follower: mass}, expect=())
    turn, want = np.arange(-175.0, 180.0, 39.5), ("answers", "velocities", "accelerations", "status")
    together = sweep(case, drive={"2": turn}, want=want, dynamic=True)
    assert len(solved) <= 5
    monkeypatch.setattr(cam_sweep, "_together", lambda _, part, *__: np.zeros(len(part.rows), dtype=bool))
    alone = sweep(case, drive={"2": turn}, want=want, dynamic=True)
    assert len(solved) >= len(turn)
    assert (together.status == alone.status).all() and together.notes == alone.notes
    for kind in ("answers", "velocities", "accelerations", "angular_accelerations"):
        assert together.kinds[kind].keys() == alone.kinds[kind].keys()
        largest = max(np.abs(array).max() for array in alone.kinds[kind].values())
        for key, array in alone.kinds[kind].items():
            np.testing.assert_allclose(together.kinds[kind][key], array, rtol=1e-11, atol=1e-12 * largest)


def test_rows_of_a_dwell_with_friction_have_their_answers() -> None:
    """A cam whose follower rubs on its guide: no row is ``ok`` without a value, in a dwell least of all."""
    text = (LIBRARY / "tangent_cam.yaml").read_text().partition("expect:")[0]
    text = text.replace("along: 90}", "along: 90, mu: 0.1}") + "motion: {link: 2, turns: ccw}\n"
    found = sweep(load(text), drive={"2": np.arange(0.0, 360.0, 45.0)})
    assert (found.status == "ok").all()
    assert np.isfinite(found.answers["T12"]).all()
    assert not found.answers["T12"][3:7].any()
