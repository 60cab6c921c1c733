"""Mechanisms of the textbooks with random dimensions, as mappings in the words of the format.

Each generator takes a `random.Random` and gives a scene without loads whose points all have coordinates.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable
from random import Random
from typing import Any

import reference
from chains import BUTTERFLY, FLIER, STALLED_TEN_BARS, STEPHENSON, WATT
from transcribe import Scene

Generator = Callable[[Random], Scene]


# --- helpers ---------------------------------------------------------------------------------------


def spot(rng: Random, reach: float = 4.0) -> list[float]:
    """A point of a figure, in four decimals."""
    return [round(rng.uniform(-reach, reach), 4) for _ in "xy"]


def polar(centre: list[float], radius: float, degrees: float) -> list[float]:
    """The point at a distance and direction from another."""
    co, s = reference.DOUBLE.turn(degrees)
    return [centre[0] + radius * co, centre[1] + radius * s]


def bearing(a: list[float], b: list[float]) -> float:
    """Direction from a to b in degrees."""
    return math.degrees(math.atan2(b[1] - a[1], b[0] - a[0]))


def heading(rng: Random) -> float:
    """A direction in whole or in decimal degrees."""
    return rng.choice([float(rng.randrange(0, 360, 5)), round(rng.uniform(-180, 180), 3)])


def scene(points: dict[str, Any], joints: Iterable[Any], **more: Any) -> Scene:
    """A mapping of the format."""
    return {"points": points, "joints": list(joints), **more}


def loaded(generator: Generator, rng: Random) -> Scene:
    """A mechanism with a force at its last joint, which an unknown torque on its last link holds."""
    drawn = {"icsolve": 1, **generator(rng)}
    last = drawn["joints"][-1]
    links = [link for joint in drawn["joints"] for link in next(iter(joint.values()))]
    drawn["loads"] = {
        "P": {"force": 10, "link": next(iter(last.values()))[0], "at": last["at"], "angle": 33},
        "U": {"torque": "unknown", "link": max(links)},
    }
    return drawn


# --- pinned chains ---------------------------------------------------------------------------------


def pinned(rng: Random, edges: str) -> Scene:
    """Links pinned in the pattern of a graph (links from 0, written from 1), every pin anywhere."""
    pins = [(int(e[0], 36) + 1, int(e[1], 36) + 1) for e in edges.split()]
    points = {f"P{k}": spot(rng) for k in range(1, len(pins) + 1)}
    return scene(points, ({"pin": list(pair), "at": f"P{k}"} for k, pair in enumerate(pins, 1)))


def four_bar(rng: Random) -> Scene:
    """Frame A-D, crank AB, coupler BC, rocker CD."""
    points = {name: spot(rng) for name in "ABCD"}
    joints = [(1, 2, "A"), (2, 3, "B"), (3, 4, "C"), (4, 1, "D")]
    return scene(points, ({"pin": [i, j], "at": p} for i, j, p in joints))


def five_bar(rng: Random) -> Scene:
    """Mobility 2: cranks AB and ED, two rods that meet at C."""
    points = {name: spot(rng) for name in "ABCDE"}
    joints = [(1, 2, "A"), (2, 3, "B"), (3, 4, "C"), (4, 5, "D"), (5, 1, "E")]
    return scene(points, ({"pin": [i, j], "at": p} for i, j, p in joints))


def watt(rng: Random) -> Scene:
    """Six-bar whose two ternary links are joined."""
    return pinned(rng, WATT)


def stephenson(rng: Random) -> Scene:
    """Six-bar whose two ternary links are not joined."""
    return pinned(rng, STEPHENSON)


def butterfly(rng: Random) -> Scene:
    """Double butterfly: eight links, no loop of fewer than five."""
    return pinned(rng, BUTTERFLY)


def folding(rng: Random) -> Scene:
    """A chain of one to three four-bars, the rocker of each the crank of the next: parallelograms, crossed
    ones, kites and others of whole sides, which fold onto their frames."""
    points, angles = {"A0": [0, 0]}, {"A0-B0": rng.randint(20, 160)}
    lengths, near, joints = {}, {}, [{"pin": [1, 2], "at": "A0"}]
    at, heading, loops = 0.0, math.radians(angles["A0-B0"]), rng.randint(1, 3)
    for k in range(loops):
        one, two = rng.randint(1, 3), rng.randint(2, 5)
        crank, coupler, rocker, base = rng.choice(
            [(one, two, one, two), (one, two, two, one), (one, one, two, two), (one, two, 5 - one, 3)]
        )
        lengths |= {f"A{k}-B{k}": crank, f"B{k}-C{k}": coupler, f"C{k}-A{k + 1}": rocker}
        points[f"A{k + 1}"] = [at + base, 0]
        b = at + cmath.rect(crank, heading)
        to = at + base - b
        x = (coupler**2 - rocker**2 + abs(to) ** 2) / (2.0 * abs(to))
        c = b + to / abs(to) * (x + rng.choice([1j, -1j]) * math.sqrt(max(coupler**2 - x * x, 0.0)))
        near[f"C{k}"] = [round(c.real, 3), round(c.imag, 3)]
        if k:
            angles[f"C{k - 1}-A{k}-B{k}"] = 0
        joints += [
            {"pin": [2 * k + 2, 2 * k + 3], "at": f"B{k}"},
            {"pin": [2 * k + 4, 1], "at": f"A{k + 1}"},
            {"pin": [2 * k + 3, 2 * k + 4], "at": f"C{k}"},
        ]
        at, heading = at + base, cmath.phase(c - at - base)
    return scene(points, joints, lengths=lengths, angles=angles, near=near)


def flier(rng: Random) -> Scene:
    """Single flier: the other eight-bar at which Kennedy's construction stalls."""
    return pinned(rng, FLIER)


def stalled_ten_bar(rng: Random) -> Scene:
    """Any of the ten-bars at which Kennedy's construction stalls."""
    return pinned(rng, rng.choice(STALLED_TEN_BARS))


def three_loops(rng: Random) -> Scene:
    """Three four-bars in series."""
    return chain(3)(rng)


def ten_loops(rng: Random) -> Scene:
    """Ten four-bars in series."""
    return chain(10)(rng)


def chain(loops: int) -> Generator:
    """Four-bars in series: the rocker of one is the crank of the next."""

    def draw(rng: Random) -> Scene:
        points = {"A0": [0.0, 0.0], "B0": [round(rng.uniform(-0.5, 0.5), 4), round(rng.uniform(0.8, 1.6), 4)]}
        joints = [{"pin": [1, 2], "at": "A0"}]
        for k in range(1, loops + 1):
            points[f"A{k}"] = [3.0 * k + round(rng.uniform(-0.4, 0.4), 4), round(rng.uniform(-0.4, 0.4), 4)]
            points[f"B{k}"] = [3.0 * k + round(rng.uniform(-0.6, 0.6), 4), round(rng.uniform(1.0, 2.0), 4)]
            rod, rocker = 2 * k + 1, 2 * k + 2
            joints.append({"pin": [rocker - 2, rod], "at": f"B{k - 1}"})
            joints += [{"pin": [rod, rocker], "at": f"B{k}"}, {"pin": [rocker, 1], "at": f"A{k}"}]
        return scene(points, joints)

    return draw


def triple_pin(rng: Random) -> Scene:
    """A six-bar with three links on one pin."""
    points = {name: spot(rng) for name in "ABCDEF"}
    joints = [([1, 2], "A"), ([2, 3, 5], "B"), ([3, 4], "C"), ([4, 1], "D"), ([5, 6], "E"), ([6, 1], "F")]
    return scene(points, ({"pin": links, "at": p} for links, p in joints))


def welded(rng: Random) -> Scene:
    """A four-bar whose coupler is two parts welded together."""
    base = four_bar(rng)
    base["points"]["W"] = spot(rng)
    base["joints"][2] = {"pin": [5, 4], "at": "C"}
    base["joints"].insert(2, {"weld": [3, 5], "at": "W"} if rng.random() < 0.5 else {"weld": [3, 5]})
    return base


# --- slides and slots ------------------------------------------------------------------------------


def slider_crank(rng: Random) -> Scene:
    """Crank, rod, and a block on a guide of the frame, offset or in line."""
    along = rng.choice([0.0, 90.0, heading(rng)])
    through = rng.choice(["A", "Q"])
    points = {"A": spot(rng, 1), "B": spot(rng, 3), "Q": spot(rng, 2)}
    points["C"] = polar(points[through], rng.choice([-1, 1]) * rng.uniform(3, 7), along)
    pins = ({"pin": [i, j], "at": p} for i, j, p in [(1, 2, "A"), (2, 3, "B"), (3, 4, "C")])
    slide = {"slide": [4, 1], "at": "C", "along": along, "through": through}
    return scene(points, [*pins, slide], links={1: ["Q"]})


def inverted_slider_crank(rng: Random) -> Scene:
    """A block on the crank pin slides along the rocker, whose guide may pass its pivot at a distance."""
    points = {name: spot(rng) for name in "ADE"}
    points["B"] = polar(points["E"], rng.uniform(1, 4), along := heading(rng))
    guide = {"slide": [3, 4], "at": "B", "along": ["E", "B"] if rng.random() < 0.5 else along, "through": "E"}
    pins = ({"pin": [i, j], "at": p} for i, j, p in [(1, 2, "A"), (2, 3, "B"), (4, 1, "D")])
    return scene(points, [*pins, guide], links={4: ["E"]})


def quick_return(rng: Random) -> Scene:
    """A crank pin in the slot of a lever that swings about D."""
    points = {name: spot(rng) for name in "AD"}
    points["B"] = polar(points["D"], rng.uniform(1, 4), along := heading(rng))
    slot = {"slot": [2, 3], "at": "B", "along": ["D", "B"] if rng.random() < 0.5 else along}
    return scene(points, [{"pin": [1, 2], "at": "A"}, slot, {"pin": [3, 1], "at": "D"}])


def coupler_slot(rng: Random) -> Scene:
    """A four-bar with a slot in its coupler that drives a lever's pin."""
    base = four_bar(rng)
    base["points"] |= {"K": spot(rng), "O": spot(rng)}
    base["joints"] += [{"slot": [5, 3], "at": "K", "along": heading(rng)}, {"pin": [5, 1], "at": "O"}]
    return base


def scotch_yoke(rng: Random) -> Scene:
    """A crank pin in the cross slot of a sliding yoke."""
    points = {"A": spot(rng), "B": spot(rng), "C": spot(rng)}
    line = rng.choice([0.0, heading(rng)])
    yoke = {"slot": [2, 3], "at": "B", "along": line + 90}
    return scene(points, [{"pin": [1, 2], "at": "A"}, yoke, {"slide": [3, 1], "at": "C", "along": line}])


def oldham(rng: Random) -> Scene:
    """Two shafts out of line, and a disc that slides on both at right angles."""
    points = {"A": spot(rng), "D": spot(rng), "M": spot(rng)}
    line = heading(rng)
    slides = [{"slide": [3, link], "at": "M", "along": line + turn} for link, turn in ((2, 0), (4, 90))]
    return scene(points, [{"pin": [1, 2], "at": "A"}, *slides, {"pin": [4, 1], "at": "D"}])


def trammel(rng: Random) -> Scene:
    """A rod on two blocks that slide on the frame."""
    points = {"A": spot(rng), "B": spot(rng), "C": spot(rng)}
    first = rng.choice([0.0, heading(rng)])
    lines = {2: first, 4: first + rng.choice([90.0, round(rng.uniform(40, 140), 2)])}
    slides = [{"slide": [k, 1], "at": p, "along": lines[k]} for k, p in ((2, "A"), (4, "B"))]
    return scene(
        points,
        [slides[0], {"pin": [2, 3], "at": "A"}, {"pin": [3, 4], "at": "B"}, slides[1]],
        links={3: ["C"]},
    )


# --- wheels ----------------------------------------------------------------------------------------


def gear_pair(rng: Random) -> Scene:
    """Two gears of the frame, of which the second drives a slider-crank."""
    rest = slider_crank(rng)
    rest["points"]["O"] = spot(rng)
    teeth = [rng.randrange(12, 60), rng.choice([1, -1]) * rng.randrange(61, 120)]
    rest["joints"] += [{"pin": [5, 1], "at": "O"}, {"gears": [5, 2], "teeth": teeth}]
    return rest


def epicyclic(rng: Random) -> Scene:
    """Arm 2, sun 3, planet 4; the annulus is the frame, or a link 5 that is welded to it."""
    sun, planet = rng.randrange(12, 40), rng.randrange(12, 40)
    points = {"O": spot(rng), "P": spot(rng)}
    axle = {"pin": [1, 2, 3], "at": "O"}
    joints = [axle, {"pin": [2, 4], "at": "P"}, {"gears": [3, 4], "teeth": [sun, planet]}]
    ring = -(sun + 2 * planet)
    if rng.random() < 0.5:
        joints.append({"gears": [4, 1], "teeth": [planet, ring]})
    else:
        axle["pin"] = [1, 2, 3, 5]
        joints += [{"gears": [4, 5], "teeth": [planet, ring]}, {"weld": [5, 1]}]
    return scene(points, joints)


def planetary(rng: Random) -> Scene:
    """A sun, an arm, a stepped planet and an annulus, all free: mobility 2."""
    points = {"O": spot(rng), "P": spot(rng)}
    sun, small, large = (rng.randrange(12, 50) for _ in range(3))
    joints = [
        {"pin": [1, 2], "at": "O"},
        {"pin": [1, 3], "at": "O"},
        {"pin": [1, 5], "at": "O"},
        {"pin": [2, 4], "at": "P"},
    ]
    meshes = [
        {"gears": [3, 4], "teeth": [sun, small]},
        {"gears": [4, 5], "teeth": [large, -(sun + small + large)]},
    ]
    return scene(points, joints + meshes)


def belt(rng: Random) -> Scene:
    """Two pulleys, open or crossed belt; the second is the crank of a four-bar."""
    base = four_bar(rng)
    a = base["points"]["A"]
    base["points"]["O"] = polar(a, rng.uniform(3, 6), heading(rng))
    drive = {"belt": [5, 2], "radii": [round(rng.uniform(0.3, 1.4), 3) for _ in "ab"]}
    base["joints"] += [{"pin": [1, 5], "at": "O"}, drive | ({"crossed": True} if rng.random() < 0.5 else {})]
    return base


def rolling_disk(rng: Random) -> Scene:
    """A disk that rolls on the frame, pushed by a rod from a crank."""
    points = {name: spot(rng) for name in "ABCP"}
    pins = [{"pin": [1, 2], "at": "A"}, {"pin": [2, 3], "at": "B"}, {"pin": [3, 4], "at": "C"}]
    return scene(points, [*pins, {"roll": [4, 1], "at": "P"}])


def rack(rng: Random) -> Scene:
    """A pinion on the frame and a rack that slides: one of its constraints is redundant."""
    radius, line = round(rng.uniform(0.5, 3), 3), rng.choice([0.0, 90.0, heading(rng)])
    points = {"O": spot(rng), "Q": spot(rng)}
    points["P"] = polar(points["O"], radius, line + 90)
    slide = {"slide": [3, 1], "at": "Q", "along": line}
    return scene(points, [{"pin": [1, 2], "at": "O"}, {"roll": [2, 3], "at": "P"}, slide])


def cam(rng: Random) -> Scene:
    """A cam that pushes a lever, or a follower in a guide."""
    points = {"A": spot(rng), "D": spot(rng), "K": spot(rng)}
    held = (
        {"pin": [3, 1], "at": "D"}
        if rng.random() < 0.5
        else {"slide": [3, 1], "at": "D", "along": heading(rng)}
    )
    return scene(
        points, [{"pin": [1, 2], "at": "A"}, {"contact": [2, 3], "at": "K", "normal": heading(rng)}, held]
    )


# --- known centres ---------------------------------------------------------------------------------


def black_box(rng: Random) -> Scene:
    """Four links of which only four centres are known, one of them perhaps at infinity."""
    pairs = [(1, 2), (2, 3), (3, 4), (4, 1)]
    joints: list[dict[str, Any]] = [{"centre": list(pair), "at": spot(rng)} for pair in pairs]
    if rng.random() < 0.5:
        joints[rng.randrange(1, 4)] = {"centre": list(pairs[3]), "toward": heading(rng)}
        joints = [j for j in joints if "toward" in j or j["centre"] != [4, 1]]
        if len(joints) < 4:
            joints.append({"centre": [4, 1], "at": spot(rng)})
    return scene({}, joints)


def three_centres(rng: Random) -> Scene:
    """Three links of which the three centres are given, on one line as they must be: one is redundant."""
    start, line = spot(rng), heading(rng)
    places = [polar(start, s, line) for s in (0.0, rng.uniform(1, 3), rng.uniform(4, 6))]
    return scene(
        {}, ({"centre": pair, "at": p} for pair, p in zip(([1, 2], [2, 3], [1, 3]), places, strict=True))
    )


ALL: tuple[Generator, ...] = (
    four_bar, watt, stephenson, butterfly, flier, stalled_ten_bar, three_loops, triple_pin, welded,
    slider_crank, inverted_slider_crank, quick_return, coupler_slot, scotch_yoke, oldham, trammel,
    gear_pair, epicyclic, belt, rolling_disk, rack, cam, black_box, three_centres,
)  # fmt: skip
"""Every kind here with one freedom."""
