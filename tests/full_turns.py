"""Mechanisms of all kinds of joints whose crank turns all the way round, as scenes by coordinates."""

from __future__ import annotations

from typing import Any

import pytest

from transcribe import Scene


def _pins(*pins: tuple[int, int, str]) -> list[dict[str, Any]]:
    return [{"pin": [i, j], "at": p} for i, j, p in pins]


def _torques(on: int, of: int = 2) -> dict[str, Any]:
    """A known torque on a link, the unknown one on the crank."""
    return {"T": {"torque": 5.0, "link": on}, "U": {"torque": "unknown", "link": of}}


FOUR_BAR: Scene = {
    "points": {"A": [0.0, 0.0], "B": [0.5, 0.866], "C": [3.6, 2.5], "D": [4.0, 0.0]},
    "joints": _pins((1, 2, "A"), (2, 3, "B"), (3, 4, "C"), (4, 1, "D")),
    "loads": _torques(4),
}
"""A crank-rocker."""

SLIDE: Scene = {
    "points": {"A": [0.0, 0.0], "B": [1.0, 1.0], "D": [4.0, 0.5]},
    "joints": [
        *_pins((1, 2, "A"), (2, 3, "B"), (4, 1, "D")),
        {"slide": [3, 4], "at": "B", "along": ["D", "B"]},
    ],
    "loads": _torques(4),
}
"""A block on the crank pin slides along the rocker: a slide between two moving links."""

OFFSET_SLIDE: Scene = {
    "points": {"A": [0.0, 0.0], "B": [1.0, 1.0], "D": [4.0, 0.5], "Q": [3.5, 1.25]},
    "joints": [
        *_pins((1, 2, "A"), (2, 3, "B"), (4, 1, "D")),
        {"slide": [3, 4], "at": "B", "along": ["Q", "B"], "through": "Q"},
    ],
    "loads": _torques(4),
}
"""The same with a guide that passes its pivot at a distance."""

SLOT: Scene = {
    "points": {
        "A": [0.0, 0.0],
        "B": [0.5, 0.866],
        "C": [3.6, 2.5],
        "D": [4.0, 0.0],
        "K": [2.0, 1.7],
        "O": [1.8, 5.0],
    },
    "joints": [
        *_pins((1, 2, "A"), (2, 3, "B"), (3, 4, "C"), (4, 1, "D"), (5, 1, "O")),
        {"slot": [5, 3], "at": "K", "along": 100.0},
    ],
    "loads": _torques(5),
}
"""A slot in the coupler, square to it, that drives a lever's pin: a slot on a moving link."""

GEARED: Scene = {
    "points": {"A": [0.0, 0.0], "B": [0.0, 0.8], "C": [1.6, 3.3], "D": [3.4, 0.8], "E": [3.0, 0.0]},
    "joints": [
        *_pins((1, 2, "A"), (2, 3, "B"), (3, 4, "C"), (4, 5, "D"), (1, 5, "E")),
        {"gears": [2, 5], "teeth": [40, 60]},
    ],
    "loads": _torques(4),
}
"""A five-bar whose cranks are geared 3 : 2."""

PLANET: Scene = {
    "points": {"O": [0.0, 0.0], "P": [0.6, 0.0], "Q": [0.8, 0.2], "R": [5.0, 2.0], "S": [5.0, -1.0]},
    "joints": [
        *_pins((1, 2, "O"), (2, 3, "P"), (3, 4, "Q"), (4, 5, "R"), (5, 1, "S")),
        {"gears": [3, 1], "teeth": [20, 30]},
    ],
    "loads": _torques(5),
}
"""A planet on an arm, in mesh with a gear that is the frame, drives a lever by a crank pin."""

DISK: Scene = {
    "points": {"A": [0.0, 3.0], "B": [0.8, 3.2], "C": [4.0, 1.0], "P": [4.0, 0.0]},
    "joints": [
        *_pins((1, 2, "A"), (2, 3, "B"), (3, 4, "C")),
        {"roll": [4, 1], "at": "P", "radii": [1.0, 0]},
    ],
    "loads": _torques(4),
}
"""A disk that a rod rolls to and fro on the frame."""

DISK_ON_ROUND: Scene = {
    "points": {"A": [0.0, 0.0], "B": [0.8, 0.2], "C": [4.0, 1.0], "P": [4.0, 0.0], "O": [4.0, -3.0]},
    "joints": [
        *_pins((1, 2, "A"), (2, 3, "B"), (3, 4, "C")),
        {"roll": [4, 1], "at": "P", "radii": [1.0, 3]},
    ],
    "links": {1: ["O"]},
    "loads": _torques(4),
}
"""The same on a round hill of the frame."""

DISK_IN_RING: Scene = {
    "points": {"A": [0.0, 1.0], "B": [0.4, 1.1], "C": [4.0, 1.0], "P": [4.0, 0.0], "O": [4.0, 6.0]},
    "joints": [
        *_pins((1, 2, "A"), (2, 3, "B"), (3, 4, "C")),
        {"roll": [4, 1], "at": "P", "radii": [1.0, -6]},
    ],
    "links": {1: ["O"]},
    "loads": _torques(4),
}
"""The same in a hollow of the frame."""

ECCENTRIC: Scene = {
    "points": {"A": [0.0, 3.0], "B": [0.8, 3.2], "C": [4.0, 1.0], "Q": [4.3, 1.4], "P": [4.0, 0.0]},
    "joints": [
        *_pins((1, 2, "A"), (2, 3, "B"), (3, 4, "Q")),
        {"roll": [4, 1], "at": "P", "radii": [1.0, 0]},
    ],
    "links": {4: ["C"]},
    "loads": _torques(4),
}
"""A disk that is pushed at a pin off its centre: no closed form."""

RACK: Scene = {
    "points": {"A": [0.0, 0.0], "P": [0.0, -4.0], "R": [10.0, -6.0]},
    "joints": [
        {"pin": [1, 2], "at": "A"},
        {"roll": [2, 3], "at": "P", "radii": [4.0, 0]},
        {"slide": [3, 1], "at": "R", "along": 0.0},
    ],
    "loads": {
        "T": {"torque": 5.0, "link": 2},
        "U": {"force": "unknown", "link": 3, "at": "R", "angle": 180.0},
    },
}
"""A pinion and a rack that slides: one condition more than is needed."""

_BUTTERFLY = {
    "A": [6.0, 1.0], "B": [-1.0, 3.8], "C": [11.0, -1.0], "D": [4.0, 3.0], "E": [8.0, 3.0],
    "F": [7.0, 9.0], "G": [-1.0, 4.0], "H": [3.0, 6.0], "K": [11.0, 4.0], "L": [9.0, 6.0],
}  # fmt: skip
BUTTERFLY: Scene = {
    "points": _BUTTERFLY,
    "joints": _pins(
        (1, 2, "A"), (1, 5, "B"), (1, 6, "C"), (2, 7, "D"), (2, 8, "E"),
        (3, 4, "F"), (3, 5, "G"), (3, 7, "H"), (4, 6, "K"), (4, 8, "L"),
    ),
    "loads": _torques(6, 5),
}  # fmt: skip
"""A double butterfly with a short crank: eight links, no loop of fewer than five."""

OLDHAM: Scene = {
    "points": {"A": [0.0, 0.0], "D": [2.0, 0.5], "M": [1.7165063509461096, 0.9910254037844386]},
    "joints": [
        *_pins((1, 2, "A"), (4, 1, "D")),
        {"slide": [3, 2], "at": "M", "along": 30.0, "through": "A"},
        {"slide": [3, 4], "at": "M", "along": 120.0, "through": "D"},
    ],
    "loads": _torques(4),
}
"""A coupling of two shafts: slides on two moving links."""

YOKE: Scene = {
    "points": {"A": [0.0, 0.0], "B": [1.0, 0.5], "C": [4.0, 1.0]},
    "joints": [
        {"pin": [1, 2], "at": "A"},
        {"slot": [2, 3], "at": "B", "along": 70.0},
        {"slide": [3, 1], "at": "C", "along": 10.0},
    ],
    "loads": {
        "T": {"force": 5.0, "link": 3, "at": "C", "angle": 30.0},
        "U": {"torque": "unknown", "link": 2},
    },
}
"""A Scotch yoke with a slanting slot."""

WHEELS = (
    ("geared five-bar", GEARED, "2", 1080.0),
    ("planet with a crank pin", PLANET, "2", 720.0),
    ("rolling disk", DISK, "2", 360.0),
    ("disk on a hill", DISK_ON_ROUND, "2", 360.0),
    ("disk in a hollow", DISK_IN_RING, "2", 360.0),
    ("disk, pin off its centre", ECCENTRIC, "2", 360.0),
    ("rack and pinion", RACK, "2", 360.0),
)
LINKAGES = (
    ("crank-rocker", FOUR_BAR, "2", 360.0),
    ("slide between moving links", SLIDE, "2", 360.0),
    ("slide beside its pivot", OFFSET_SLIDE, "2", 360.0),
    ("slot on a moving link", SLOT, "2", 360.0),
    ("double butterfly", BUTTERFLY, "5", 360.0),
    ("Oldham coupling", OLDHAM, "2", 360.0),
    ("Scotch yoke", YOKE, "2", 360.0),
)
ALL = (*LINKAGES, *WHEELS)
"""Name, scene, crank, and degrees after which all is as before."""
EVERY = pytest.mark.parametrize(("name", "scene", "link", "period"), ALL, ids=[m[0] for m in ALL])
