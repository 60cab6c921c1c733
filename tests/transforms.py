"""Changes of a scene that leave its mechanics alone, and what each does to the results.

Each change gives a new scene and an `Effect`: how answers, places, directions and rates must have
changed. Scenes are mappings as in `mechanisms`; only what these use is carried over.
"""

from __future__ import annotations

import copy
from collections.abc import Callable
from decimal import Context, Decimal
from typing import Any, NamedTuple

from reference import DOUBLE
from transcribe import Scene, case

Entry = dict[str, Any]
Place = list[float]


GRAVITY = 9.81


class Effect(NamedTuple):
    """What becomes of results: factors of unknown loads by kind, places, directions (degrees), links."""

    place: Callable[[Place], Place]
    direction: Callable[[float], float]
    link: Callable[[str], str]
    factor: dict[str, float]
    """of an unknown force, torque, weight, mass, spring stiffness; 1 where it is not named"""
    speed: float = 1.0


def _same(x: Any) -> Any:
    return x


NO_EFFECT = Effect(_same, _same, _same, {})


# --- the plane moves or is mirrored or scaled ------------------------------------------------------


def _moved(scene: Scene, place: Callable[[Place], Place], direction: Callable[[float], float]) -> Scene:
    """All places and directions of a scene replaced; weights must have become forces before."""
    new = copy.deepcopy(scene)
    for name, entry in new.get("points", {}).items():
        if isinstance(entry, list):
            new["points"][name] = place(entry)
    new["near"] = {name: place(xy) for name, xy in new.get("near", {}).items()}
    for key, value in new.get("angles", {}).items():
        if key.count("-") == 1:
            new["angles"][key] = direction(value)
    motion = new.get("motion", [])
    for entry in [
        *new["joints"],
        *new.get("loads", {}).values(),
        *(motion if isinstance(motion, list) else [motion]),
    ]:
        _move_entry(entry, place, direction)
    return {key: value for key, value in new.items() if value}


def _move_entry(entry: Entry, place: Callable[[Place], Place], direction: Callable[[float], float]) -> None:
    for key in ("angle", "along", "normal", "toward"):
        if isinstance(entry.get(key), int | float):
            entry[key] = direction(entry[key])
    if isinstance(entry.get("at"), list):
        entry["at"] = place(entry["at"])
    origin = place([0.0, 0.0])
    for key in ("slope", "force"):
        if isinstance(entry.get(key), list):
            entry[key] = [a - o for a, o in zip(place(entry[key]), origin, strict=True)]


def heavy_to_forces(scene: Scene) -> Scene:
    """Weights and masses as forces along -y, so that the plane may be turned."""
    new = copy.deepcopy(scene)
    for name, load in new.get("loads", {}).items():
        kind = next(iter(load))
        if kind in ("weight", "mass"):
            value = load.pop(kind)
            if isinstance(value, str) and value.endswith("kg"):
                value = float(value.removesuffix(" kg")) * GRAVITY
            new["loads"][name] = {"force": value} | load | {"angle": -90.0}
    return new


def rigid_motion(scene: Scene, degrees: float, shift: Place) -> tuple[Scene, Effect]:
    """The plane turned about the origin, then shifted. Loads and rates stay."""
    co, s = DOUBLE.turn(degrees)

    def place(p: Place) -> Place:
        return [co * p[0] - s * p[1] + shift[0], s * p[0] + co * p[1] + shift[1]]

    def direction(angle: float) -> float:
        return angle + degrees

    effect = NO_EFFECT._replace(place=place, direction=direction, factor={"mass": GRAVITY})
    return _moved(heavy_to_forces(scene), place, direction), effect


def mirror(scene: Scene) -> tuple[Scene, Effect]:
    """The plane mirrored in the y axis: torques change sense, corners too, weights stay."""

    def place(p: Place) -> Place:
        return [-p[0], p[1]]

    def direction(angle: float) -> float:
        return 180 - angle

    new = _moved(scene, place, direction)
    if "angles" in new:
        new["angles"] = {k: v if k.count("-") == 1 else -v for k, v in new["angles"].items()}
    for load in new.get("loads", {}).values():
        if isinstance(load.get("torque"), int | float):
            load["torque"] = -load["torque"]
    motion = new.get("motion", {})
    for given in motion if isinstance(motion, list) else [motion]:
        if "point" not in given and "speed" in given:
            given["speed"] = -given["speed"]
    return new, NO_EFFECT._replace(place=place, direction=direction, factor={"torque": -1.0})


class Written(float):
    """A number that is written with all its decimals: a case is what its decimals say, not their doubles."""

    digits: str

    def __repr__(self) -> str:
        return self.digits


def _times(value: float, factor: float) -> float:
    """A number as it is written times a power of two, exactly."""
    exact = Context(prec=400).multiply(Decimal(repr(value)), Decimal(factor))
    found = Written(exact)
    found.digits = str(exact)
    return found


def scaled(scene: Scene, power: int) -> tuple[Scene, Effect]:
    """Every length times 2^power, forces as before: nothing may change but by powers of two."""
    factor = 2.0**power

    def place(p: Place) -> Place:
        return [_times(a, factor) for a in p]

    new = _moved(scene, place, _same)
    if "lengths" in new:
        new["lengths"] = {pair: _times(value, factor) for pair, value in new["lengths"].items()}
    for joint in new["joints"]:
        if "radii" in joint:
            joint["radii"] = place(joint["radii"])
    for name, load in new.get("loads", {}).items():
        _scale_load(load, scene["loads"][name], factor)
    return new, NO_EFFECT._replace(place=place, factor={"torque": factor, "spring": 1 / factor}, speed=factor)


def _scale_load(load: Entry, was: Entry, factor: float) -> None:
    for key, by in (("torque", factor), ("spring", 1 / factor), ("free", factor)):
        if isinstance(load.get(key), int | float):
            load[key] = _times(load[key], by)
    for key in ("slope", "force"):  # not lengths, though `_moved` took them for such
        if isinstance(load.get(key), list):
            load[key] = was[key]


# --- other names, another order, another frame -----------------------------------------------------


def relabelled(scene: Scene, names: dict[str, str]) -> tuple[Scene, Effect]:
    """Links by other names."""
    new = copy.deepcopy(scene)

    def link(name: Any) -> str:
        return names.get(str(name), str(name))

    for joint in new["joints"]:
        kind = next(iter(joint))
        joint[kind] = [link(n) for n in joint[kind]]
        if "carrier" in joint:
            joint["carrier"] = link(joint["carrier"])
    motion = new.get("motion", [])
    for entry in [*new.get("loads", {}).values(), *(motion if isinstance(motion, list) else [motion])]:
        entry.update({key: link(entry[key]) for key in ("link", "against") if key in entry})
    if "links" in new:
        new["links"] = {link(n): points for n, points in new["links"].items()}
    return new | {"ground": link(scene.get("ground", 1))}, NO_EFFECT._replace(link=link)


def reordered(scene: Scene, order: list[int]) -> tuple[Scene, Effect]:
    """Joints in another order, loads too; each pin's links backwards."""
    new = copy.deepcopy(scene)
    new["joints"] = [new["joints"][k] for k in order]
    for joint in new["joints"]:
        if "pin" in joint:
            joint["pin"].reverse()
    if "loads" in new:
        new["loads"] = dict(reversed(new["loads"].items()))
    return new, NO_EFFECT


def on_another_frame(scene: Scene, frame: str) -> tuple[Scene, Effect]:
    """Another link held still; what reacted on the old frame still does, so unknown loads stay."""
    new = heavy_to_forces(scene)
    old = str(scene.get("ground", 1))
    for load in new.get("loads", {}).values():
        load["against"] = str(load.get("against", old))
        if load["against"] == frame:
            del load["against"]
    return new | {"ground": frame}, NO_EFFECT


def moved_to(scene: Scene, link: str) -> Scene:
    """The unknown `U` as a torque on another link."""
    return scene | {"loads": scene["loads"] | {"U": {"torque": "unknown", "link": link}}}


def reversed_roles(scene: Scene, known: str, found: float) -> Scene:
    """The unknown given the value that was found, and a known load made the unknown."""
    new = copy.deepcopy(scene)
    for name, value in (("U", found), (known, "unknown")):
        kind = next(iter(new["loads"][name]))
        new["loads"][name][kind] = f"{value} kg" if kind == "mass" and value != "unknown" else value
    return new


def link_names(scene: Scene) -> tuple[str, ...]:
    """Links in the order in which the joints name them."""
    return case(scene).links
