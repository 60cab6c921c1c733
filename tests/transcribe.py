"""A mapping in the words of the format, as YAML text, and (for the reference) as a Case.

The reading here is apart from the solver's reader and covers what generators write: bare numbers in
m and N.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from icsolve import case as c

Scene = dict[str, Any]


# --- as text ---------------------------------------------------------------------------------------


def text(scene: Scene) -> str:
    """A case file: one line for each joint, point and load."""
    lines = ["icsolve: 1"]
    for key, value in scene.items():
        if not value:
            continue
        if isinstance(value, dict) and key in ("points", "loads", "near"):
            lines += [f"{key}:", *(f"  {name}: {_flow(entry)}" for name, entry in value.items())]
        elif isinstance(value, list) and key == "joints":
            lines += [f"{key}:", *(f"  - {_flow(joint)}" for joint in value)]
        else:
            lines.append(f"{key}: {_flow(value)}")
    return "\n".join(lines) + "\n"


def _flow(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{k}: {_flow(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(_flow(v) for v in value) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(value) if isinstance(value, float) else str(value)


# --- as a Case -------------------------------------------------------------------------------------


def case(scene: Scene) -> c.Case:
    """The frozen values of a scene; lengths, angles and `near` are left to the solver's reader."""
    given = scene.get("points", {}).items()
    points = {name: c.Coordinates(*map(number, xy)) for name, xy in given if _is_place(xy)}
    centroids = {name: c.Centroid(tuple(p["centroid"])) for name, p in given if isinstance(p, dict)}
    hidden: dict[str, c.Coordinates] = {}
    joints = tuple(_joint(j, hidden) for j in scene["joints"])
    loads = tuple(_load(name, entry, hidden) for name, entry in scene.get("loads", {}).items())
    motion = scene.get("motion", [])
    return c.Case(
        points={**points, **centroids, **hidden},
        joints=joints,
        loads=loads,
        ground=str(scene.get("ground", 1)),
        links=tuple(dict.fromkeys(link for j in joints for link in j.links)),
        motion=tuple(_motion(m) for m in (motion if isinstance(motion, list) else [motion])),
        gravity=number(9.81),
    )


def number(value: float) -> c.Number:
    """A bare number of the scene."""
    return c.Number(float(value), 0.0, "", repr(value))


def _two(values: Any) -> tuple[c.Number, c.Number]:
    first, second = map(number, values)
    return first, second


def _is_place(value: Any) -> bool:
    return isinstance(value, list | tuple) and not any(isinstance(v, str) for v in value)


def _place(value: Any, hidden: dict[str, c.Coordinates]) -> str:
    """A point's name, or a hidden one for coordinates."""
    if not _is_place(value):
        return str(value)
    name = f"@{len(hidden) + 1}"
    hidden[name] = c.Coordinates(number(value[0]), number(value[1]))
    return name


def _guide(entry: Mapping[str, Any]) -> c.Guide:
    line = entry["along"]
    through = str(entry["through"]) if "through" in entry else None
    if isinstance(line, list | tuple):
        return c.Guide(None, (str(line[0]), str(line[1])), through)
    return c.Guide(number(line), None, through)


def _joint(entry: Mapping[str, Any], hidden: dict[str, c.Coordinates]) -> c.Joint:
    kind = next(iter(entry))
    links: Any = tuple(str(n) for n in entry[kind])
    at = _place(entry["at"], hidden) if "at" in entry else None
    carrier = str(entry["carrier"]) if "carrier" in entry else None
    match kind:
        case "gears":
            return c.Gears(links, _two(entry["teeth"]), carrier)
        case "belt":
            return c.Belt(links, _two(entry["radii"]), entry.get("crossed", False), carrier)
        case "centre":
            return c.KnownCentre(links, at, number(entry["toward"]) if at is None else None)
        case "weld":
            return c.Weld(links, at)
    assert at is not None
    match kind:
        case "pin":
            return c.Pin(links, at)
        case "roll":
            return c.Roll(links, at)
        case "contact":
            return c.Contact(links, at, number(entry["normal"]))
        case "slide":
            return c.Slide(links, at, _guide(entry))
        case "slot":
            return c.Slot(links, at, _guide(entry))
    raise KeyError(kind)


def _magnitude(value: Any) -> c.Magnitude:
    if value == "unknown":
        return None
    if isinstance(value, Mapping):
        return c.Like(str(value["like"]), number(value["times"]) if "times" in value else None)
    return number(value)


def _heading(entry: Mapping[str, Any]) -> c.Heading:
    if "angle" in entry:
        return number(entry["angle"])
    if "slope" in entry:
        return c.Slope(*map(number, entry["slope"]))
    return c.Toward(str(entry.get("toward", entry.get("away"))), "away" in entry)


def _load(name: str, entry: Mapping[str, Any], hidden: dict[str, c.Coordinates]) -> c.Load:
    kind = next(iter(entry))
    link = str(entry["link"])
    against = str(entry["against"]) if "against" in entry else None
    at = _place(entry.get("at", "?"), hidden)
    if kind == "torque":
        return c.Torque(name, link, _magnitude(entry[kind]), entry.get("turns", "ccw"), against)
    if kind in ("weight", "mass"):
        value = entry[kind].removesuffix(" kg") if isinstance(entry[kind], str) else entry[kind]
        known = _magnitude(value if value == "unknown" else float(value))
        return c.Weight(name, link, at, known, kind == "mass")
    if kind == "spring":
        free = number(entry["free"])
        return c.Spring(name, link, at, str(entry["to"]), _magnitude(entry[kind]), free, against)
    assert kind == "force"
    if _is_place(entry[kind]):
        return c.ForceVector(name, link, at, *_two(entry[kind]), against)
    return c.Force(name, link, at, _magnitude(entry[kind]), _heading(entry), against)


def _motion(entry: Mapping[str, Any]) -> c.Motion:
    given = {k: number(entry[k]) for k in ("speed", "angle") if k in entry}
    link, turns, point = str(entry["link"]), entry.get("turns"), entry.get("point")
    return c.Motion(link, given.get("speed"), turns, point, given.get("angle"))
