"""The figure as driven against the figure as written: an order of construction of links that keep their
shapes, and one of points by their data, on mechanisms of random dimensions.
"""

from __future__ import annotations

import math
from contextlib import suppress
from itertools import combinations
from random import Random

import numpy as np
import pytest

import icsolve
from icsolve.assembly import case_point, placed_figure, solve_figure
from icsolve.assembly.driven.groups import Solver
from icsolve.assembly.driven.mechanism import mechanism
from icsolve.numbers.record import Record
from icsolve.structure import topology
from icsolve.sweep.drivers import closed_drive, drive_of
from icsolve.sweep.program import RowRequest, compile_sweep, setting_of, wanted_points
from icsolve.sweep.varied_numbers import numbers_of, with_numbers
from icsolve.tuples import replace
from library import FILES
from mechanisms import Generator, butterfly, four_bar, stephenson, three_loops, triple_pin, watt
from transcribe import Scene, text


def by_shapes(scene: Scene) -> icsolve.Case:
    """A pinned mechanism by the shapes of its links alone: lengths between the pins of each, the pins of the
    frame, the direction of a link on it; what is left open is as the coordinates have it."""
    at = scene["points"]
    pins: dict[int, dict[str, None]] = {}
    for joint in scene["joints"]:
        for link in joint["pin"]:
            pins.setdefault(link, {})[joint["at"]] = None
    given = {name: at[name] for name in pins[1]}
    first, crank = next((p, link) for link, own in pins.items() for p in own if link != 1 and p in given)
    arm = next(name for name in pins[crank] if name not in given)
    lengths = {
        f"{a}-{b}": math.dist(at[a], at[b])
        for link, own in pins.items()
        for a, b in combinations(own, 2)
        if link != 1
    }
    turned = math.degrees(math.atan2(at[arm][1] - at[first][1], at[arm][0] - at[first][0]))
    near = {name: place for name, place in at.items() if name not in given}
    figure = {"points": given, "lengths": lengths, "angles": {f"{first}-{arm}": turned}, "near": near}
    return icsolve.load(text({"joints": scene["joints"], **figure}))


@pytest.mark.parametrize(
    "generator", [four_bar, watt, stephenson, triple_pin, three_loops, butterfly], ids=lambda g: g.__name__
)
def test_the_figure_as_driven_is_the_figure_as_if_written_so(generator: Generator) -> None:
    """Two orders of construction, one of links that keep their shapes and one of points by their data: where
    the data are the shapes, they place every pin alike, in closed form or by Newton's method."""
    rng, met = Random(2026), 0
    while met < 3:
        written = by_shapes(generator(rng))
        angle = written.angles[0].value
        path, values = angle.path, angle.value + np.array([0.0, 0.5, -0.5])
        with suppress(icsolve.SceneError):  # a random figure may be next to a dead centre
            driven = icsolve.sweep(written, {path: values}, ("points", "status"))
            for row in np.flatnonzero(driven.status == "ok"):
                places = {p: tuple(map(float, at[row])) for p, at in driven.points.items()}
                near = {p: places[p] for p in written.near}
                again = solve_figure(replace(with_numbers(written, {path: float(values[row])}), near=near))
                for name, place in again.points.items():
                    # rounding of both, over the sine of the angle under which circles meet
                    assert case_point(again.frame, place) == pytest.approx(places[name], abs=1e-9)
                met += 1


def side_by_side(scenes: list[Scene]) -> Scene:
    """Mechanisms on one frame and one driven link, which is pinned where that of the first is."""
    joints, points, links = list(scenes[0]["joints"]), dict(scenes[0]["points"]), 8
    ox, oy = points["P1"]
    for n, scene in enumerate(scenes[1:]):
        px, py = scene["points"]["P1"]
        points |= {f"{name}q{n}": [x - px + ox, y - py + oy] for name, (x, y) in scene["points"].items()}
        for joint in scene["joints"][1:]:
            pair = [link if link < 3 else link + links for link in joint["pin"]]
            joints.append({"pin": pair, "at": f"{joint['at']}q{n}"})
        links += 6
    return {"points": points, "joints": joints}


def test_groups_that_know_nothing_of_each_other_are_placed_apart() -> None:
    """Three double butterflies on one link: six links each that only all their conditions place."""
    rng = Random(5)
    several = icsolve.load(text(side_by_side([butterfly(rng) for _ in range(3)])))
    motion = compile_sweep(setting_of(several, [], ["2"]), RowRequest(answers=False)).motion
    assert motion is not None
    assert [len(group.bodies) for group in motion.groups] == [6, 6, 6]


@pytest.mark.parametrize("source", ["library", "random"])
def test_a_drive_whose_links_close_is_that_of_the_derivatives(source: str) -> None:
    """Where the links close step by step with some numbers and links as drivers and nothing to spare, the
    derivatives of all conditions say the same of what moves, what is held and what is locked."""
    rng, met = Random(7), 0
    loaded = [icsolve.load(path) for path in FILES.values()] if source == "library" else []
    scenes = [make(rng) for make in (four_bar, watt, stephenson, triple_pin, three_loops, butterfly) * 2]
    for case in loaded or map(by_shapes, scenes):
        with suppress(icsolve.SceneError):
            topology(case)
            figure = placed_figure(case, *wanted_points(case))
            held = mechanism(case, figure.frame, Record(), figure.points)
            turns = [((), (link,)) for link in case.links]
            paths = [path for path in numbers_of(case) if path.startswith(("lengths.", "angles."))]
            for drivers in [
                *turns,
                *(((path,), ()) for path in paths),
                *(((p,), (case.links[-1],)) for p in paths),
            ]:
                closed = closed_drive(held, *drivers)
                if closed is not None:
                    met += 1
                    assert closed._replace(closing=None, poses={}) == drive_of(held, *drivers)
    assert met > 20


CLOSED = {
    "a wheel that rolls on the frame": """
points: {C: [0, 1], P: [0, 0], F: [3, 0]}
joints: [{roll: [2, 1], at: P, radii: [1, 0]}, {pin: [2, 3], at: C}, {slide: [3, 1], at: F, along: 0}]
""",
    "a rope over pulleys on the frame": """
points: {A: [0, 0], B: [1, 0.5], C: [1, 4], D: [3, 4], G: [3, 1]}
joints: [{pin: [1, 2], at: A}, {rope: [B, C, D, G], on: [2, 1, 1, 3]}, {slide: [3, 1], at: G, along: 90}]
""",
    "a rope between two levers": """
points: {A: [0, 0], B: [1, 0.5], G: [3, 1], E: [4, 0]}
joints: [{pin: [1, 2], at: A}, {rope: [B, G], on: [2, 3]}, {pin: [3, 1], at: E}]
""",
}


@pytest.mark.parametrize("name", CLOSED)
def test_what_a_turned_link_draws_is_placed_in_closed_form(name: str) -> None:
    """No group is left to Newton's method."""
    setting = setting_of(icsolve.load("icsolve: 1" + CLOSED[name]), [], ["2"])
    motion = compile_sweep(setting, RowRequest(answers=False)).motion
    assert motion is not None and not motion.groups


@pytest.mark.parametrize("radii", [(2.0, 3.0), (-8.0, 3.0)], ids=["outside", "inside"])
def test_wheels_that_roll_on_each_other_keep_their_ratio_whichever_link_is_turned(
    radii: tuple[float, float],
) -> None:
    """Of a five-bar whose cranks are such wheels, driven by a rod, so that only all conditions together place
    it: what one wheel turns the other turns by the ratio of the radii, to 1e-12 of a turn."""
    case = icsolve.load(f"""
icsolve: 1
points: {{A: [0, 0], D: [5, 0], P: [{abs(radii[0])}, 0]}}
lengths: {{AB: 1.5, BC: 4, CE: 4.2, DE: 2}}
angles: {{AB: 60, DE: 100}}
near: {{C: [2.5, 5]}}
joints:
  - {{pin: [1, 2], at: A}}
  - {{pin: [1, 3], at: D}}
  - {{roll: [2, 3], at: P, radii: [{radii[0]}, {radii[1]}]}}
  - {{pin: [2, 4], at: B}}
  - {{pin: [3, 5], at: E}}
  - {{pin: [4, 5], at: C}}
loads: {{T: {{torque: 10, link: 2}}, U: {{torque: unknown, link: 3}}}}
""")
    found = icsolve.sweep(case, drive={"4": np.linspace(-8.0, 0.5, 18)}, want=("points", "status"))
    one = np.degrees(np.unwrap(np.arctan2(*found.points["B"].T[::-1])))
    x, y = found.points["E"].T
    two = np.degrees(np.unwrap(np.arctan2(y, x - 5.0)))
    assert set(found.status.tolist()) == {"ok"} and np.ptp(one) > 5.0
    assert np.abs(radii[0] * (one - 60.0) + radii[1] * (two - 100.0)).max() < 360.0 * 1e-12 * abs(radii[0])


def test_the_determinant_of_more_equations_than_unknowns_is_the_root_of_grams() -> None:
    """As the product of the singular values, of square systems too."""
    rng = np.random.default_rng(1)
    for equations in (4, 6):
        j = rng.normal(size=(5, equations, 4))

        class Few:
            """What stands for a solver of few rows."""

            direct = None

            def system(self, _env: object, _q: object, j: np.ndarray = j) -> tuple[None, np.ndarray]:
                return None, j

        found = Solver.determinant(Few(), {}, np.zeros((5, 4)))  # type: ignore[arg-type]
        assert found == pytest.approx(np.prod(np.linalg.svd(j)[1], axis=1), rel=1e-9)


@pytest.mark.parametrize("stages", [1, 4, 9, 14])
def test_either_end_of_a_reduction_drives_it_however_long_it_is(stages: int) -> None:
    """20 to 1 a stage, to 1.6e18 in all: neither end counts as still beside the other. The torques have that
    ratio, and so have the turns of the first wheel, in numbers of a few units in the last place."""
    points = ", ".join(f"A{k}: [{3 * k}, 0]" for k in range(stages + 1))
    pins = ", ".join(f"{{pin: [1, {k + 2}], at: A{k}}}" for k in range(stages + 1))
    gears = ", ".join(f"{{gears: [{k + 2}, {k + 3}], teeth: [10, 200]}}" for k in range(stages))
    loads = f"loads: {{K: {{torque: 7, link: {stages + 2}}}, U: {{torque: unknown, link: 2}}}}"
    case = icsolve.load(f"icsolve: 1\npoints: {{{points}}}\njoints: [{pins}, {gears}]\n{loads}\n")
    for link in ("2", str(stages + 2)):
        found = icsolve.sweep(case, drive={link: [0.0, 1.0, 30.0]}, want=("answers", "status"))
        assert found.status.tolist() == ["ok"] * 3
        assert found.answers["U"] == pytest.approx(-7.0 * (-1 / 20) ** stages, rel=1e-15 * 4)
