"""JSON Schema (draft-07) of a case, for editors that complete and check YAML while it is written.

It says what the reader says of a file's shape: sections, keys, kinds, which numbers and names may
stand where. What ties one section to another (a link that no joint has) only the reader can tell.
"""

from __future__ import annotations

from icsolve.read.expect import KEYS as EXPECTED
from icsolve.read.joints import HELICAL
from icsolve.read.loads import HEADINGS, KEYS
from icsolve.read.schema_profile import profiles
from icsolve.read.schema_shapes import Schema, links, list_of, mapping, pattern, ref
from icsolve.read.schema_space import definitions as definitions_of_space
from icsolve.read.schema_space import directed

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
        **mapping(_sections(), ["icsolve", "joints"]),
    }


def _definitions() -> Schema:
    return {
        "text": {"type": ["string", "number", "boolean", "null"]},
        "name": {"anyOf": [pattern(f"^{_NAME}$"), {"type": "integer", "minimum": 0}, {"type": "boolean"}]},
        "number": {"anyOf": [{"type": "number"}, pattern(_BARE)]},
        "quantity": {"anyOf": [{"type": "number"}, pattern(_QUANTITY)]},
        "pair": list_of(ref("quantity"), 2, 2),
        "links": links(2),
        "place": {"anyOf": [ref("name"), ref("pair")]},
        "with unit": pattern(_WITH_UNIT),
        "unknown": {"const": "unknown"},
        "like": mapping({"like": ref("name"), "times": ref("number")}, ["like"]),
        "joint": {"oneOf": [_joint(kind, *parts) for kind, parts in _joints().items()]},
        "load": {"oneOf": [_load(kind) for kind in KEYS]},
        "motion": {"oneOf": [_link_motion(), _point_motion()]},
        "published": _published(),
        **definitions_of_space(),
    }


def _named(values: Schema, names: str = f"^{_NAME}$") -> Schema:
    """A section: names to values; it may be empty."""
    return {"type": ["object", "null"], "propertyNames": {"pattern": names}, "additionalProperties": values}


def _sections() -> Schema:
    return {
        "icsolve": {"enum": [1, "1"], "description": "version of the format"},
        "title": ref("text"),
        "source": {**ref("text"), "description": "where the problem stands"},
        "reconstructed": {**ref("text"), "description": "what was not given and had to be reconstructed"},
        "units": _units(),
        "ground": {**ref("name"), "description": "the frame link; 1 by default"},
        "gravity": {**_gravity(), "description": "9.81 m/s^2 by default"},
        "points": _named({"anyOf": [_coordinates(), _centroid()]}),
        "lengths": _named({"anyOf": [{"type": "number", "minimum": 0}, pattern(_QUANTITY)]}, _keys("{2}")),
        "angles": _named(ref("quantity"), _keys("{2,3}")),
        "near": _named(ref("pair")),
        "links": _named({"anyOf": [list_of(ref("name"), 0), _masses()]}),
        "joints": list_of({"anyOf": [ref("joint"), ref("joint in space")]}, 1),
        "loads": _named({"anyOf": [ref("load"), ref("load in space")]}),
        "profile": {
            **_named({"anyOf": profiles(_QUANTITY)}),
            "description": "shapes of cams and of their followers",
        },
        "motion": {"anyOf": [ref("motion"), list_of(ref("motion"), 0), {"type": "null"}]},
        "dynamic": {
            "enum": [True, False, "yes", "no", "true", "false"],
            "description": "whether the inertia forces of the motion are among the loads",
        },
        "expect": _named({"anyOf": [_value(), ref("published")]}, "^.+$"),
        "tolerance": {"anyOf": [ref("quantity"), _tolerance(), {"type": "null"}]},
        "variables": {**_named(_variable()), "description": "numbers that are others for each student"},
    }


def _masses() -> Schema:
    """What a link has besides its joints: further points, a mass."""
    unit = ref("with unit")
    keys = {"points": list_of(ref("name"), 0), "mass": unit, "centre": ref("name"), "inertia": unit}
    return {**mapping(keys), "dependencies": {"mass": ["centre"]}}


def _tolerance() -> Schema:
    share = pattern(r"^\s*[0-9.]+ ?%\s*$")
    width, figures = ref("quantity"), ref("number")
    keys = {"relative": share, "absolute": width, "figures": figures, "drawing": width}
    return {**mapping(keys), "minProperties": 1}


def _variable() -> Schema:
    """Choices, or a range with its step."""
    text: Schema = {"type": ["string", "number", "boolean"]}
    choices = mapping({"choices": list_of(text, 1)}, ["choices"])
    span = mapping({"range": list_of(ref("number"), 2, 2), "step": ref("number")}, ["range", "step"])
    return {"oneOf": [choices, span]}


def _keys(count: str) -> str:
    """Keys such as AB, A'B, O2-A."""
    more = "{1}" if count == "{2}" else "{1,2}"
    return f"^(({_ATOM}){count}|\\s*{_NAME}\\s*(-\\s*{_NAME}\\s*){more})$"


def _units() -> Schema:
    unit = {"type": "string"}
    return {**mapping({"length": unit, "force": unit, "torque": unit}), "type": ["object", "null"]}


def _coordinates() -> Schema:
    """Two coordinates, of which one may be unknown; three in space."""
    return {"anyOf": [list_of({"anyOf": [ref("quantity"), ref("unknown")]}, 2, 2), ref("triple")]}


def _gravity() -> Schema:
    """Its size; in space also its components, or where it pulls to."""
    return {"anyOf": [ref("quantity"), ref("triple"), ref("gravity in space")]}


def _centroid() -> Schema:
    return mapping({"centroid": {**list_of(ref("name"), 2), "uniqueItems": True}}, ["centroid"])


def _joints() -> dict[str, tuple[Schema, list[str]]]:
    """Each kind's keys besides its links, and those that it needs."""
    at = {"at": ref("name")}
    mu = {"mu": ref("number")}
    guide = {"along": {"anyOf": [ref("quantity"), links(2)]}, "through": ref("name")}
    carrier = {"carrier": ref("name")}
    tooth = {key: ref("quantity") for key in ("pressure angle", "diametral pitch", "module", *HELICAL)}
    tooth["hand"] = {"enum": ["right", "left"]}
    crossed = {"crossed": {"enum": [True, False, "true", "false"]}}
    return {
        "pin": ({**at, **mu, "radius": ref("quantity")}, ["at"]),
        "slide": ({**at, **guide, **mu, "length": ref("quantity")}, ["at", "along"]),
        "slot": ({**at, **guide, **mu}, ["at", "along"]),
        "roll": ({**at, "radii": ref("pair"), "pressure angle": ref("quantity")}, ["at"]),
        "gears": ({"teeth": list_of(ref("number"), 2, 2), **carrier, **tooth}, ["teeth"]),
        "belt": ({"radii": ref("pair"), **carrier, **crossed}, ["radii"]),
        "contact": ({**at, "normal": ref("quantity"), **mu}, []),
        "centre": ({"at": ref("place"), "toward": ref("quantity")}, []),
        "weld": (at, []),
    }


def _joint(kind: str, keys: Schema, needs: list[str]) -> Schema:
    form = mapping({kind: links(None if kind == "pin" else 2), **keys}, [kind, *needs])
    if kind == "pin":
        form["dependencies"] = {"mu": ["radius"]}
    if kind == "centre":
        form["oneOf"] = [{"required": ["at"]}, {"required": ["toward"]}]
    if kind == "gears":
        form["not"] = {"required": ["diametral pitch", "module"]}
    return form


def _load(kind: str) -> Schema:
    number: list[Schema] = [ref("quantity"), ref("unknown"), ref("like")]
    if kind == "mass":
        number[0] = ref("with unit")
    if kind == "power":
        number = [ref("with unit")]
    if kind == "force":
        number.append(ref("pair"))
    values = {
        "at": ref("place"),
        "to": ref("place"),
        "angle": ref("quantity"),
        "slope": list_of(ref("number"), 2, 2),
        "free": ref("quantity"),
        "turns": {"enum": ["ccw", "cw"]},
        "speed": ref("quantity"),
    }
    needs = [key for key in KEYS[kind] if key in ("link", "at", "to", "free", "speed")]
    keys = {key: values.get(key, ref("name")) for key in KEYS[kind]}
    form = mapping({kind: {"anyOf": number}, **keys}, [kind, *needs])
    if kind == "force":
        form.update(directed("force", HEADINGS))
    return form


def _link_motion() -> Schema:
    form = mapping(
        {
            "link": ref("name"), "speed": ref("quantity"), "turns": {"enum": ["ccw", "cw"]},
            "acceleration": ref("quantity"),
        },
        ["link"],
    )
    return {**form, "anyOf": [{"required": ["speed"]}, {"required": ["turns"]}]}


def _point_motion() -> Schema:
    keys = {"point": ref("name"), "link": ref("name"), "speed": ref("quantity"), "angle": ref("quantity")}
    return mapping({**keys, "acceleration": ref("quantity")}, list(keys))


def _value() -> Schema:
    """A number with its unit and sense, or the two coordinates of a centre."""
    return {"anyOf": [{"type": "number"}, pattern(_QUANTITY), ref("pair")]}


def _published() -> Schema:
    within = {"anyOf": [{"type": "number", "minimum": 0}, pattern(_QUANTITY)]}
    keys = {"value": _value(), "toward": ref("quantity"), "within": within, "erratum": ref("text")}
    form = mapping({key: keys[key] for key in EXPECTED})
    return {**form, "oneOf": [{"required": ["value"]}, {"required": ["toward"]}]}
