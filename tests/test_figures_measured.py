"""Figures that are measured rather than drawn, beyond dyads of pins: the points and the answer of the truth.

Each scene is drawn with coordinates, measured as a textbook would give it, and solved from the measures.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from random import Random
from typing import Any

import pytest

import mechanisms
import reference
import transcribe
import witness
from figures import from_lengths, without_order
from loading import drawn, loaded, sound
from mechanisms import bearing, heading, polar, scene, spot
from sizes import MORE, sampled
from solving import LAW, solved, told
from transcribe import Scene

Measures = dict[str, Any]
Drawing = tuple[Scene, Measures, list[float]]
"""A scene by coordinates without loads, the sections that replace its points, and for each point that is
searched the sine of the angle at which its two loci cross."""


def rough(rng: Random, xy: list[float]) -> list[float]:
    """A place near a point, as read off a figure."""
    return [round(x + rng.uniform(-0.1, 0.1), 2) for x in xy]


def crossing(first: float, second: float) -> float:
    """Sine of the angle between two directions in degrees."""
    return abs(math.sin(math.radians(first - second)))


def distance(points: dict[str, Any], a: str, b: str) -> float:
    """Between two points of a scene."""
    return math.dist(points[a], points[b])


def lever_of_a_quick_return(rng: Random) -> Drawing:
    """E on the slotted lever beyond the crank pin (angle 0 at D), a rod from E to a ram on a guide by Q."""
    p: dict[str, Any] = {"A": spot(rng), "D": spot(rng, 2), "Q": spot(rng)}
    p["B"] = polar(p["A"], rng.uniform(0.5, 1.5), crank := heading(rng))
    p["E"] = polar(p["D"], rng.uniform(2, 4), bearing(p["D"], p["B"]))
    p["F"] = polar(p["Q"], rng.uniform(2, 5), along := heading(rng))
    pins = ([1, 2], "A"), ([3, 1], "D"), ([3, 4], "E"), ([4, 5], "F")
    slot = {"slot": [2, 3], "at": "B", "along": ["D", "E"]}
    ram = {"slide": [5, 1], "at": "F", "along": along, "through": "Q"}
    drawn = scene(p, [*({"pin": links, "at": at} for links, at in pins), slot, ram])
    lengths = {pair: distance(p, *pair) for pair in ("AB", "DE", "EF")}
    measures = {"lengths": lengths, "angles": {"AB": crank, "BDE": 0}, "near": {"F": rough(rng, p["F"])}}
    return (
        drawn,
        {"points": {k: p[k] for k in "ADQ"}} | measures,
        [crossing(bearing(p["E"], p["F"]), along + 90)],
    )


def pin_in_the_coupler_slot(rng: Random) -> Drawing:
    """A four-bar by lengths; a lever's pin K in the slot BC of the coupler, at its own length from O."""
    base = mechanisms.four_bar(rng)
    p = base["points"]
    p["O"] = spot(rng)
    p["K"] = polar(p["B"], rng.uniform(0.2, 0.9) * distance(p, "B", "C"), bearing(p["B"], p["C"]))
    base["joints"] += [{"slot": [5, 3], "at": "K", "along": ["B", "C"]}, {"pin": [5, 1], "at": "O"}]
    lengths = {pair: distance(p, *pair) for pair in ("AB", "BC", "CD", "OK")}
    near = {k: rough(rng, p[k]) for k in "CK"}
    measures = {"lengths": lengths, "angles": {"AB": bearing(p["A"], p["B"])}, "near": near}
    crossings = [
        crossing(bearing(p["B"], p["C"]), bearing(p["D"], p["C"])),
        crossing(bearing(p["O"], p["K"]), bearing(p["B"], p["C"]) + 90),
    ]
    return base, {"points": {k: p[k] for k in "ADO"}} | measures, crossings


def ram_at_a_given_height(rng: Random) -> Drawing:
    """A slider-crank whose piston pin has one coordinate unknown."""
    p: dict[str, Any] = {"A": spot(rng), "B": spot(rng), "C": spot(rng)}
    pins = ([1, 2], "A"), ([2, 3], "B"), ([3, 4], "C")
    slide = {"slide": [4, 1], "at": "C", "along": 0}
    drawn = scene(p, [*({"pin": links, "at": at} for links, at in pins), slide])
    measures = {"lengths": {"BC": distance(p, "B", "C")}, "near": {"C": rough(rng, p["C"])}}
    given = {"A": p["A"], "B": p["B"], "C": ["unknown", p["C"][1]]}
    return drawn, {"points": given} | measures, [crossing(bearing(p["B"], p["C"]), 90)]


def weight_at_the_centroid(rng: Random) -> Drawing:
    """A four-bar by lengths, G the centroid of the coupler triangle B, C, P; P by an angle at B."""
    base = mechanisms.four_bar(rng)
    p = base["points"]
    p["P"] = spot(rng)
    p["G"] = [sum(p[q][k] for q in "BCP") / 3 for k in (0, 1)]
    base["links"] = {3: ["P", "G"]}
    base["loads"] = {"W": {"weight": 40, "link": 3, "at": "G"}}
    lengths = {pair: distance(p, *pair) for pair in ("AB", "BC", "CD", "BP")}
    angles = {"AB": bearing(p["A"], p["B"]), "CBP": bearing(p["B"], p["P"]) - bearing(p["B"], p["C"])}
    given = {"A": p["A"], "D": p["D"], "G": {"centroid": ["B", "C", "P"]}}
    measures = {"lengths": lengths, "angles": angles, "near": {"C": rough(rng, p["C"])}}
    return base, {"points": given} | measures, [crossing(bearing(p["B"], p["C"]), bearing(p["D"], p["C"]))]


def block_on_a_turning_guide(rng: Random) -> Drawing:
    """An inverted slider-crank by lengths: the guide of the rocker passes D at the distance DE."""
    p: dict[str, Any] = {"A": spot(rng), "B": spot(rng)}
    p["D"] = polar(p["B"], rng.uniform(3, 5), heading(rng))
    offset = rng.uniform(0.2, 1.0)
    tilt = math.degrees(math.asin(offset / distance(p, "D", "B")))
    p["E"] = polar(p["D"], offset, bearing(p["D"], p["B"]) + 90 - tilt)
    pins = ([1, 2], "A"), ([2, 3], "B"), ([4, 1], "D")
    slide = {"slide": [3, 4], "at": "B", "along": ["E", "B"]}
    drawn = scene(p, [*({"pin": links, "at": at} for links, at in pins), slide], links={4: ["E"]})
    measures = {
        "lengths": {"AB": distance(p, "A", "B"), "DE": offset},
        "angles": {"AB": bearing(p["A"], p["B"]), "DEB": bearing(p["E"], p["B"]) - bearing(p["E"], p["D"])},
        "near": {"E": rough(rng, p["E"])},
    }
    return drawn, {"points": {k: p[k] for k in "AD"}} | measures, [math.cos(math.radians(tilt))]


FIGURES: list[Callable[[Random], Drawing]] = [
    lever_of_a_quick_return,
    pin_in_the_coupler_slot,
    ram_at_a_given_height,
    weight_at_the_centroid,
    block_on_a_turning_guide,
]


def firm(rng: Random, figure: Callable[[Random], Drawing]) -> tuple[Scene, Scene]:
    """A sound drawing with loads, no two points close and none nearly stretched, and its measured form."""
    while True:
        base, measures, crossings = figure(rng)
        truth = loaded(rng, base)
        truth["loads"] = base.get("loads", {}) | truth["loads"]
        places = list(base["points"].values())
        apart = all(math.dist(a, b) > 0.3 for k, a in enumerate(places) for b in places[:k])
        if apart and min(crossings) > 0.2 and sound(truth):
            return truth, measures | {k: v for k, v in truth.items() if k != "points"}


@sampled(2)
@pytest.mark.parametrize("figure", FIGURES, ids=lambda f: f.__name__)
def test_the_measured_figure_is_the_drawn_one(figure: Callable[[Random], Drawing]) -> None:
    for seed in range(6 * MORE):
        truth, measured = firm(Random(f"{figure.__name__} {seed}"), figure)
        answer = solved(measured)
        for name, xy in answer.points.items():
            assert xy == pytest.approx(truth["points"][name], abs=1e-10), name + told(measured)
        found = reference.motions(transcribe.case(truth), digits=reference.MANY)
        assert answer.answers["U"].value == pytest.approx(witness.answers(found)["U"], rel=1e-9), told(
            measured
        )


# --- by the order of construction, and without one ---

DYADIC = [
    mechanisms.four_bar,
    mechanisms.watt,
    mechanisms.stephenson,
    mechanisms.three_loops,
    mechanisms.triple_pin,
    mechanisms.welded,
    mechanisms.slider_crank,
]


def check_figure(scene: Scene, measured: Scene, close: float) -> None:
    """Points where they were measured, and the answer of the scene by coordinates."""
    answer = solved(measured)
    assert set(answer.points) <= set(scene["points"]) | {p for p in answer.points if p.startswith("@")}
    for name, xy in answer.points.items():
        if name in scene["points"]:
            assert xy == pytest.approx(scene["points"][name], abs=close), name + told(measured)
    found = reference.motions(transcribe.case(scene), digits=reference.MANY)
    assert answer.answers["U"].value == pytest.approx(witness.answers(found)["U"], rel=LAW), told(measured)


@sampled(2)
@pytest.mark.parametrize("generator", DYADIC, ids=lambda g: g.__name__)
def test_lengths_and_angles_give_back_the_figure(generator: mechanisms.Generator) -> None:
    done = 0
    for seed in range(12 * MORE):
        scene = drawn(300 + seed, generator)
        measured = from_lengths(scene, Random(seed))
        if measured is not None:
            done += 1
            check_figure(scene, measured, 1e-11)
    assert done > 1


def test_the_double_butterfly_by_its_side_lengths() -> None:
    """No order of construction: the group is solved as a whole, from `near`."""
    done = 0
    for seed in range(8 * MORE):
        scene = drawn(400 + seed, mechanisms.butterfly)
        measured = without_order(scene, Random(seed))
        if measured is not None:
            done += 1
            check_figure(scene, measured, 1e-10)
    assert done > 1
