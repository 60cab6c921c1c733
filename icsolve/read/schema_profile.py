"""The schema's part on profiles of cams and their followers."""

from __future__ import annotations

from icsolve.read.schema_shapes import Schema, links, list_of, mapping, ref


def profiles(quantity: str) -> list[Schema]:
    """The forms of a profile; ``quantity`` is the pattern of a number with its unit."""
    place = {"anyOf": [ref("name"), ref("pair")]}
    line = {"anyOf": [ref("quantity"), links(2)]}
    radius, turns = {"radius": ref("quantity")}, {"turns": {"enum": ["ccw", "cw"]}}
    end = {"anyOf": [ref("name"), ref("quantity"), ref("pair")]}
    arc = mapping({"centre": place, **radius, "from": end, "to": end, **turns}, ["centre", "from", "to"])
    angles = {"propertyNames": {"pattern": quantity}}
    table: Schema = {"type": "object", "additionalProperties": ref("quantity"), **angles}
    return [
        mapping({"polygon": list_of(place, 3)}, ["polygon"]),
        mapping({"arcs": list_of(arc, 1)}, ["arcs"]),
        mapping({"circle": place, **radius}, ["circle", "radius"]),
        mapping({"about": place, "zero": line, "radii": table, **turns}, ["about", "zero", "radii"]),
        mapping({"flat": place, "along": line}, ["flat", "along"]),
        mapping({"roller": place, **radius}, ["roller", "radius"]),
        mapping({"knife": place}, ["knife"]),
    ]
