"""Sweeps of mechanisms of all kinds of joints: every row is looked at in three independent ways.

The links keep their shapes and stay on their own guides; centres and rates are those by which the points
go from row to row; and each row, as a scene by coordinates, has the answer of the sweep. CI draws a few
random mechanisms, `ICSOLVE_FULL=1` twenty times as many.
"""

from __future__ import annotations

from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest

import full_turns
import icsolve
import mechanisms
import transcribe
from growth import random_mechanism
from icsolve.answer import Answer
from icsolve.scene.sensitivity import influences
from loading import drawn, sound
from sizes import FULL, MORE, sampled
from transcribe import Scene
from turned import Array, Turned, traced

SHAPE = 1e-12
"""Of a link's points and guides, in figures of size ten: rounding, with room for links that are far off."""
FAR = 1e3
CASES = Path(__file__).parent.parent / "cases"
ALL = ("answers", "status", "points", "centres", "rates")
BOUNDED = ("answers", "status", "error", "centres", "rates")


def swept(scene: Scene, link: str, degrees: Array, seed: int = 1) -> Turned:
    """A sweep of a scene, its driving link turned, with two more points on every link."""
    scene = traced(scene, Random(seed))
    case = icsolve.load(transcribe.text(scene))
    return Turned(scene, icsolve.sweep(case, want=ALL, drive={link: degrees}))


def check_rows(turned: Turned, rows: range) -> None:
    """Rows of the sweep agree with the solver on scenes given by their points alone, within both bounds."""
    ((link, degrees),) = turned.sweep.vary.items()
    case = icsolve.load(transcribe.text(turned.scene))
    sweep = icsolve.sweep(case, want=BOUNDED, drive={link: degrees[rows.start : rows.stop : rows.step]})
    assert sweep.status.tolist() == turned.sweep.status[rows.start : rows.stop : rows.step].tolist()
    for k, place in enumerate(rows):
        placed = all(np.isfinite(turned.sweep.points[name][place]).all() for name in turned.written)
        if sweep.status[k] != "ok" or not placed:  # a part that the answer does not need may not assemble
            continue
        row = icsolve.load(transcribe.text(turned.row(place)))
        answer = icsolve.solve(row, rates=True, all_centres=True)
        for name, found in answer.answers.items():
            assert found.error is not None
            moved = sum(abs(i.per_unit) for i in influences(answer, name) if i.path.endswith((".x", ".y")))
            room = (
                found.error + sweep.error[name][k] + moved * 2.0**-49
            )  # of points below 8 that were moved in doubles
            assert abs(found.value - sweep.answers[name][k]) <= room, transcribe.text(turned.row(place))
        check_rates(sweep, k, answer)
        check_centres(sweep, k, answer)


def check_rates(sweep: icsolve.Sweep, k: int, answer: Answer) -> None:
    """Rates of a row within both bounds."""
    bounds = answer.errors.get("rates", {})
    for link, bound in bounds.items():
        if link in sweep.rates:
            room = bound + sweep.errors["rates"][link][k]
            assert abs(answer.rates[link] - sweep.rates[link][k]) <= room, (link, k)


def check_centres(sweep: icsolve.Sweep, k: int, answer: Answer) -> None:
    """Places of centres within both bounds. Not those a hundred figures away: there the guides' directions,
    which a scene made of the row's points has to round once more, decide."""
    for (i, j), centre in answer.centres.items():
        name = f"{i}-{j}"
        if centre.kind != "at" or centre.error is None or name not in sweep.centres:
            continue
        (x, y, w), (ex, ey, ew) = sweep.centres[name][k], sweep.errors["centres"][name][k]
        if abs(w) <= ew or np.hypot(x, y) > FAR * abs(w):
            continue
        for value, own, error in ((x, centre.place[0], ex), (y, centre.place[1], ey)):
            place = value / w
            room = centre.error + (error + abs(place) * ew) / (abs(w) - ew) + 2.0**-50  # of the row's points
            assert abs(place - own) <= room, (name, k)


# --- full turns ------------------------------------------------------------------------------------


@sampled(3)
@full_turns.EVERY
def test_a_full_turn_keeps_every_link_and_joint(name: str, scene: Scene, link: str, period: float) -> None:
    """Steps of half a degree: differences of fourth order are good to 1e-4 where links move fastest."""
    degrees = np.linspace(0.0, period, int(2 * period) + 1)
    turned = swept(scene, link, degrees)
    assert (turned.sweep.status == "ok").all()
    assert turned.shapes() < SHAPE
    assert turned.guides() < SHAPE
    assert turned.wheels() < 1e-10
    assert turned.speeds(degrees) < 1e-4
    assert turned.slips(degrees) < 1e-4
    check_rows(turned, range(0, len(degrees), len(degrees) // 12))


@sampled(3)
@full_turns.EVERY
def test_after_a_period_all_is_as_it_was(name: str, scene: Scene, link: str, period: float) -> None:
    """Also where wheels carry their rotation on: three turns of a 40-tooth crank are two of a 60-tooth one.
    A rack does not come back."""
    if scene is full_turns.RACK:
        return
    case = icsolve.load(transcribe.text(scene))
    sweep = icsolve.sweep(case, want=ALL, drive={link: np.array([0.0, 90.0, 180.0, 270.0, period])})
    for table in (sweep.answers, sweep.points, sweep.rates):
        for key, array in table.items():
            assert array[-1] == pytest.approx(array[0], rel=1e-9, abs=1e-9), key


def test_two_gears_turn_in_the_ratio_of_their_teeth() -> None:
    """The driven crank is at -2/3 of the first's turning, whole turns too, from the position as written."""
    degrees = np.linspace(-720.0, 1440.0, 721)
    turned = swept(full_turns.GEARED, "2", degrees)
    assert turned.angle("5") - turned.angle("5")[240] == pytest.approx(-degrees * 2 / 3, abs=1e-9)


@pytest.mark.parametrize("link", ["2", "3"])
def test_a_ring_turns_the_way_of_the_wheel_inside_it(link: str) -> None:
    """In the ratio of the teeth, whichever of the two is driven; its crank pin goes round its pivot, and the
    torque on the wheel holds the force on the pin at that ratio."""
    case = icsolve.load("""icsolve: 1
points: {A: [1, 0], B: [0, 0], P: [0, 3]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: B}
  - {gears: [2, 3], teeth: [20, -60]}
loads:
  F: {force: 10, link: 3, at: P, angle: 0}
  T: {torque: unknown, link: 2}
""")
    ring = np.linspace(-130.0, 500.0, 43)
    found = icsolve.sweep(
        case, drive={link: ring * (3.0 if link == "2" else 1.0)}, want=("answers", "points")
    )
    turned = np.radians(ring)
    assert found.points["P"] == pytest.approx(np.c_[-3.0 * np.sin(turned), 3.0 * np.cos(turned)], abs=1e-12)
    assert found.answers["T"] == pytest.approx(10.0 * np.cos(turned), abs=1e-11)


def test_a_rolling_disk_turns_by_its_way_over_its_radius() -> None:
    degrees = np.linspace(0.0, 360.0, 361)
    turned = swept(full_turns.DISK, "2", degrees)
    way = turned.point("C") - turned.point("C")[0]
    assert np.abs(way.imag).max() < 1e-13
    assert np.radians(turned.angle("4") - turned.angle("4")[0]) == pytest.approx(-way.real, abs=1e-12)
    assert np.abs(turned.point("P") - (turned.point("C") - 1j)).max() < 1e-13


def test_order_of_rows_and_other_rows_do_not_matter() -> None:
    """A row is the same whichever rows are asked with it, and in whatever order."""
    for _, scene, link, period in full_turns.ALL:
        case = icsolve.load(transcribe.text(scene))
        degrees = np.linspace(0.0, period, 97)
        whole = icsolve.sweep(case, want=ALL, drive={link: degrees})
        shuffled = np.random.default_rng(1).permutation(97)
        some = icsolve.sweep(case, want=ALL, drive={link: degrees[shuffled][:30]})
        assert (some.status == whole.status[shuffled][:30]).all()
        for name, array in some.answers.items():
            assert array == pytest.approx(whole.answers[name][shuffled][:30], rel=1e-9)


# --- random mechanisms ------------------------------------------------------------------------------


def plain(scene: Scene, seed: int) -> Scene | None:
    """The scene with joints that can be moved in the place of contacts, given centres and bare rolling."""
    points, joints = dict(scene["points"]), []
    for n, joint in enumerate(scene["joints"]):
        joints.append(_plain(joint, n, points, seed))
    changed = scene | {"points": points, "joints": joints}
    return changed if sound(changed) else None


def _plain(joint: dict[str, Any], n: int, points: dict[str, Any], seed: int) -> dict[str, Any]:
    if "contact" in joint:
        return {"slot": joint["contact"], "at": joint["at"], "along": joint["normal"] + 90}
    if "roll" in joint:
        return {"pin": joint["roll"], "at": joint["at"]}
    if "centre" not in joint:
        return joint
    at = joint.get("at", mechanisms.spot(Random(n + seed)))
    if not isinstance(at, str):
        points[f"Z{n}"] = at
        at = f"Z{n}"
    if "toward" in joint:
        return {"slide": joint["centre"], "at": at, "along": joint["toward"] + 90}
    return {"pin": joint["centre"], "at": at}


def check_short_sweep(scene: Scene, seed: int) -> bool:
    """A few degrees to both sides; False where no link can drive."""
    degrees = np.arange(-2.0, 2.01, 0.05)
    for link in [k for k in transcribe.case(scene).links if k != "1"]:
        try:
            turned = swept(scene, link, degrees, seed)
        except icsolve.SceneError:
            continue
        if not turned.ok.any():
            continue
        assert set(turned.sweep.status) <= {"ok", "cannot-assemble"}
        assert turned.shapes() < 1e-10, transcribe.text(scene)
        assert turned.guides() < 1e-10, transcribe.text(scene)
        assert turned.wheels() < 1e-9, transcribe.text(scene)
        check_rows(turned, range(0, len(degrees), 27))
        return True
    return False


STILL = ("cam", "black_box", "three_centres", "rolling_disk", "rack")
"""Kinds that are known in one position only: contacts, given centres, rolling without radii."""


@sampled(4)
@pytest.mark.parametrize("generator", [g for g in mechanisms.ALL if g.__name__ not in STILL])
def test_named_mechanisms_with_random_dimensions(generator: mechanisms.Generator) -> None:
    for seed in range(MORE):
        assert check_short_sweep(drawn(seed, generator), seed)


def test_random_mechanisms_of_all_kinds_of_joints() -> None:
    done = 0
    for seed in range(240 if FULL else 3):
        scene = plain(random_mechanism(Random(seed)), seed)
        done += scene is not None and check_short_sweep(scene, seed)
    assert done >= (180 if FULL else 2)


@pytest.mark.parametrize(
    "name", ["ch13/13_07_slider_crank", "cams/offset_roller_follower", "tools/bolt_cutter"]
)
def test_the_power_of_all_loads_is_nothing_in_every_row(name: str) -> None:
    """The terms times the numbers of their loads, by record and by scenes; to 1e-12 of the largest."""
    case = icsolve.load(CASES / f"{name}.yaml")
    link = next(load.link for load in case.loads if load.name in icsolve.solve(case).answers)
    found = icsolve.sweep(case, want=("answers", "terms"), drive={link: np.arange(-6.0, 7.0, 2.0)})
    numbers = {load.name: getattr(getattr(load, "value", None), "value", None) for load in case.loads}
    power = [term * found.answers.get(name, numbers[name]) for name, term in found.terms.items()]
    assert len(power) > 1
    assert np.isfinite(power).any()
    assert np.nanmax(abs(np.sum(power, axis=0))) <= 1e-12 * np.nanmax(np.abs(power))
