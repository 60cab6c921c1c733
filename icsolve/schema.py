"""JSON Schema (draft-07) of a case, for editors that complete and check YAML while it is written.

It says what the reader says of a file's shape: sections, keys, kinds, which numbers and names may
stand where. What ties one section to another (a link that no joint has) only the reader can tell.
"""

from __future__ import annotations

from typing import Any

from icsolve.read.expect import KEYS as EXPECTED
from icsolve.read.loads import HEADINGS, KEYS

Schema = dict[str, Any]

_LETTER = "0-9A-Za-z\u00aa-\uffff"
_NAME = f"[{_LETTER}][{_LETTER}_']*"
_ATOM = f"[{_LETTER}]'*"
_NUMERAL = r"[-+\u2212]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][-+\u2212]?[0-9]+)?"
_VARIED = r"^.*\$\{?[A-Za-z\u00aa-\uffff].*$"
_QUANTITY = rf"^\s*{_NUMERAL}\s*([^0-9\s.,_].*|1/.*)?$|{_VARIED}"
_BARE = rf"^\s*{_NUMERAL}\s*$|{_VARIED}"
_WITH_UNIT = rf"^\s*{_NUMERAL}\s*[^0-9\s.,_].*$|{_VARIED}"


def schema() -> Schema:
    """The schema of version 1 of the format."""
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "icsolve case, version 1",
        "description": "A planar mechanism as a textbook figure and its caption give it",
        "definitions": _definitions(),
        **_object(_sections(), ["icsolve", "joints"]),
    }


def _ref(name: str) -> Schema:
    return {"$ref": f"#/definitions/{name}"}


def _definitions() -> Schema:
    return {
        "text": {"type": ["string", "number", "boolean", "null"]},
        "name": {"anyOf": [_pattern(f"^{_NAME}$"), {"type": "integer", "minimum": 0}, {"type": "boolean"}]},
        "number": {"anyOf": [{"type": "number"}, _pattern(_BARE)]},
        "quantity": {"anyOf": [{"type": "number"}, _pattern(_QUANTITY)]},
        "pair": _list(_ref("quantity"), 2, 2),
        "links": _links(2),
        "place": {"anyOf": [_ref("name"), _ref("pair")]},
        "unknown": {"const": "unknown"},
        "like": _object({"like": _ref("name"), "times": _ref("number")}, ["like"]),
        "joint": {"oneOf": [_joint(kind, *parts) for kind, parts in _joints().items()]},
        "load": {"oneOf": [_load(kind) for kind in KEYS]},
        "motion": {"oneOf": [_link_motion(), _point_motion()]},
        "published": _published(),
    }


def _pattern(text: str) -> Schema:
    return {"type": "string", "pattern": text}


def _list(items: Schema, least: int, most: int | None = None) -> Schema:
    limits = {"minItems": least} if most is None else {"minItems": least, "maxItems": most}
    return {"type": "array", "items": items, **limits}


def _links(most: int | None) -> Schema:
    return {**_list(_ref("name"), 2, most), "uniqueItems": True}


def _object(properties: Schema, required: list[str] | None = None) -> Schema:
    """A mapping with these keys and no others."""
    needs = {"required": required} if required else {}
    return {"type": "object", "properties": properties, "additionalProperties": False, **needs}


def _named(values: Schema, names: str = f"^{_NAME}$") -> Schema:
    """A section: names to values; it may be empty."""
    return {"type": ["object", "null"], "propertyNames": {"pattern": names}, "additionalProperties": values}


def _sections() -> Schema:
    return {
        "icsolve": {"enum": [1, "1"], "description": "version of the format"},
        "title": _ref("text"),
        "source": {**_ref("text"), "description": "where the problem stands"},
        "reconstructed": {**_ref("text"), "description": "what was not given and had to be reconstructed"},
        "units": _units(),
        "ground": {**_ref("name"), "description": "the frame link; 1 by default"},
        "gravity": {**_ref("quantity"), "description": "9.81 m/s^2 by default"},
        "points": _named({"anyOf": [_coordinates(), _centroid()]}),
        "lengths": _named({"anyOf": [{"type": "number", "minimum": 0}, _pattern(_QUANTITY)]}, _keys("{2}")),
        "angles": _named(_ref("quantity"), _keys("{2,3}")),
        "near": _named(_ref("pair")),
        "links": _named(_list(_ref("name"), 0)),
        "joints": _list(_ref("joint"), 1),
        "loads": _named(_ref("load")),
        "motion": {"anyOf": [_ref("motion"), _list(_ref("motion"), 0), {"type": "null"}]},
        "expect": _named({"anyOf": [_value(), _ref("published")]}, "^.+$"),
        "tolerance": {"anyOf": [_ref("quantity"), _tolerance(), {"type": "null"}]},
        "variables": {**_named(_variable()), "description": "numbers that are others for each student"},
    }


def _tolerance() -> Schema:
    share = _pattern(r"^\s*[0-9.]+ ?%\s*$")
    width, figures = _ref("quantity"), _ref("number")
    keys = {"relative": share, "absolute": width, "figures": figures, "drawing": width}
    return {**_object(keys), "minProperties": 1}


def _variable() -> Schema:
    """Choices, or a range with its step."""
    text: Schema = {"type": ["string", "number", "boolean"]}
    choices = _object({"choices": _list(text, 1)}, ["choices"])
    span = _object({"range": _list(_ref("number"), 2, 2), "step": _ref("number")}, ["range", "step"])
    return {"oneOf": [choices, span]}


def _keys(count: str) -> str:
    """Keys such as AB, A'B, O2-A."""
    more = "{1}" if count == "{2}" else "{1,2}"
    return f"^(({_ATOM}){count}|\\s*{_NAME}\\s*(-\\s*{_NAME}\\s*){more})$"


def _units() -> Schema:
    unit = {"type": "string"}
    return {**_object({"length": unit, "force": unit, "torque": unit}), "type": ["object", "null"]}


def _coordinates() -> Schema:
    return _list({"anyOf": [_ref("quantity"), _ref("unknown")]}, 2, 2)


def _centroid() -> Schema:
    return _object({"centroid": {**_list(_ref("name"), 2), "uniqueItems": True}}, ["centroid"])


def _joints() -> dict[str, tuple[Schema, list[str]]]:
    """Each kind's keys besides its links, and those that it needs."""
    at = {"at": _ref("name")}
    mu = {"mu": _ref("number")}
    guide = {"along": {"anyOf": [_ref("quantity"), _links(2)]}, "through": _ref("name")}
    carrier = {"carrier": _ref("name")}
    tooth = {key: _ref("quantity") for key in ("pressure angle", "diametral pitch", "module")}
    crossed = {"crossed": {"enum": [True, False, "true", "false"]}}
    return {
        "pin": ({**at, **mu, "radius": _ref("quantity")}, ["at"]),
        "slide": ({**at, **guide, **mu, "length": _ref("quantity")}, ["at", "along"]),
        "slot": ({**at, **guide, **mu}, ["at", "along"]),
        "roll": ({**at, "radii": _ref("pair")}, ["at"]),
        "gears": ({"teeth": _list(_ref("number"), 2, 2), **carrier, **tooth}, ["teeth"]),
        "belt": ({"radii": _ref("pair"), **carrier, **crossed}, ["radii"]),
        "contact": ({**at, "normal": _ref("quantity"), **mu}, ["at", "normal"]),
        "centre": ({"at": _ref("place"), "toward": _ref("quantity")}, []),
        "weld": (at, []),
    }


def _joint(kind: str, keys: Schema, needs: list[str]) -> Schema:
    form = _object({kind: _links(None if kind == "pin" else 2), **keys}, [kind, *needs])
    if kind == "pin":
        form["dependencies"] = {"mu": ["radius"]}
    if kind == "centre":
        form["oneOf"] = [{"required": ["at"]}, {"required": ["toward"]}]
    if kind == "gears":
        form["not"] = {"required": ["diametral pitch", "module"]}
    return form


def _load(kind: str) -> Schema:
    number: list[Schema] = [_ref("quantity"), _ref("unknown"), _ref("like")]
    if kind == "mass":
        number[0] = _pattern(_WITH_UNIT)
    if kind == "power":
        number = [_pattern(_WITH_UNIT)]
    if kind == "force":
        number.append(_ref("pair"))
    values = {
        "at": _ref("place"),
        "to": _ref("place"),
        "angle": _ref("quantity"),
        "slope": _list(_ref("number"), 2, 2),
        "free": _ref("quantity"),
        "turns": {"enum": ["ccw", "cw"]},
        "speed": _ref("quantity"),
    }
    needs = [key for key in KEYS[kind] if key in ("link", "at", "to", "free", "speed")]
    keys = {key: values.get(key, _ref("name")) for key in KEYS[kind]}
    form = _object({kind: {"anyOf": number}, **keys}, [kind, *needs])
    if kind == "force":
        form.update(_heading())
    return form


def _heading() -> Schema:
    """One direction; none where the force is given by components."""
    alone = {"required": ["force"], "properties": {"force": {"type": "array"}}}
    without = {"not": {"anyOf": [{"required": [key]} for key in HEADINGS]}}
    directed = [{"required": [key], "properties": {"force": {"not": {"type": "array"}}}} for key in HEADINGS]
    return {"oneOf": [{**alone, **without}, *directed]}


def _link_motion() -> Schema:
    form = _object(
        {"link": _ref("name"), "speed": _ref("quantity"), "turns": {"enum": ["ccw", "cw"]}}, ["link"]
    )
    return {**form, "anyOf": [{"required": ["speed"]}, {"required": ["turns"]}]}


def _point_motion() -> Schema:
    keys = {"point": _ref("name"), "link": _ref("name"), "speed": _ref("quantity"), "angle": _ref("quantity")}
    return _object(keys, list(keys))


def _value() -> Schema:
    """A number with its unit and sense, or the two coordinates of a centre."""
    return {"anyOf": [{"type": "number"}, _pattern(_QUANTITY), _ref("pair")]}


def _published() -> Schema:
    within = {"anyOf": [{"type": "number", "minimum": 0}, _pattern(_QUANTITY)]}
    keys = {"value": _value(), "toward": _ref("quantity"), "within": within, "erratum": _ref("text")}
    form = _object({key: keys[key] for key in EXPECTED})
    return {**form, "oneOf": [{"required": ["value"]}, {"required": ["toward"]}]}
