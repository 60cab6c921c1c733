"""The schema's part on cases in space: points of three coordinates, their joints and loads."""

from __future__ import annotations

from icsolve.read.schema_shapes import Schema, links, list_of, mapping, pattern, ref
from icsolve.read.space_loads import HEADINGS, KEYS
from icsolve.read.teeth import ANGLES, MODULES, PITCHES


def definitions() -> Schema:
    """What the definitions of a case need besides those of the plane."""
    return {
        "triple": list_of(ref("quantity"), 3, 3),
        "axis": {"anyOf": [pattern(r"^\s*[-+]?[xyzXYZ]\s*$"), ref("triple"), links(2)]},
        "gravity in space": mapping({"size": ref("quantity"), "along": ref("axis")}, ["along"]),
        "joint in space": {"anyOf": [_joint(kind, *parts) for kind, parts in _joints().items()]},
        "load in space": {"anyOf": [_load(kind) for kind in KEYS]},
    }


def _joints() -> dict[str, tuple[Schema, list[str]]]:
    """Each kind's keys besides its links, and those that it needs."""
    at, axis = {"at": ref("name")}, {"axis": ref("axis")}
    bearing: tuple[Schema, list[str]] = ({**at, **axis}, ["at", "axis"])
    return {
        "ball": (at, ["at"]),
        "radial": bearing,
        "thrust": bearing,
        "hinge": bearing,
        "weld": (at, ["at"]),
        "gears": ({**_mesh(), **axis}, ["teeth", "at", "axis"]),
    }


def _mesh() -> Schema:
    form = {key: ref("quantity") for key in (*ANGLES, *PITCHES, *MODULES, "helix angle")}
    return {
        "teeth": {"anyOf": [ref("number"), list_of(ref("number"), 2, 2)]},
        "at": {"anyOf": [ref("name"), list_of(ref("name"), 1, 2)]},
        "toward": {"anyOf": [ref("name"), ref("axis")]},
        "hand": {"enum": ["right", "left"]},
        **form,
    }


def _joint(kind: str, keys: Schema, needs: list[str]) -> Schema:
    return mapping({kind: links(2), **keys}, [kind, *needs])


def _load(kind: str) -> Schema:
    number: list[Schema] = [ref("quantity"), ref("unknown"), ref("like")]
    if kind == "mass":
        number[0] = ref("with unit")
    if kind == "power":
        number = [ref("with unit")]
    if kind in ("force", "torque"):
        number.append(ref("triple"))
    values = {
        "at": {"anyOf": [ref("name"), ref("triple")]},
        "to": {"anyOf": [ref("name"), ref("triple")]},
        "along": ref("axis"),
        "free": ref("quantity"),
        "speed": ref("quantity"),
    }
    needs = [key for key in KEYS[kind] if key in ("link", "at", "to", "free", "speed")]
    keys = {key: values.get(key, ref("name")) for key in KEYS[kind]}
    form = mapping({kind: {"anyOf": number}, **keys}, [kind, *needs])
    return {**form, **directed(kind, HEADINGS)} if kind == "force" else form


def directed(kind: str, headings: tuple[str, ...]) -> Schema:
    """One direction; none where the load is given by components."""
    alone = {"required": [kind], "properties": {kind: {"type": "array"}}}
    without = {"not": {"anyOf": [{"required": [key]} for key in headings]}}
    others = [{"required": [key], "properties": {kind: {"not": {"type": "array"}}}} for key in headings]
    return {"oneOf": [{**alone, **without}, *others]}
