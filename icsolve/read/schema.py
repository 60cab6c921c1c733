"""JSON Schema (draft-07) of a case, for editors that complete and check YAML while it is written.

It is written from the table of keys by which the reader reads. What ties one section to another (a link that
no joint has) only the reader can tell.
"""

from __future__ import annotations

from typing import Any

from icsolve.read import keys
from icsolve.read.joints import JOINTS
from icsolve.read.keys import EntryKind, Key, Rule
from icsolve.read.profiles import ARC, PROFILES

Schema = dict[str, Any]
ID = "icsolve.schema.json"
"""The name by which files refer to it: `icsolve new -o` puts it beside the case."""

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
        "$id": ID,
        "title": "icsolve case, version 1",
        "description": "A planar mechanism as a textbook figure and its caption give it",
        "definitions": _definitions(),
        **_keyed(keys.SECTIONS),
    }


def _ref(name: str) -> Schema:
    return {"$ref": f"#/definitions/{name}"}


def _pattern(text: str) -> Schema:
    return {"type": "string", "pattern": text}


def _any(*forms: Schema) -> Schema:
    return {"anyOf": list(forms)}


def _list(items: Schema, least: int, most: int | None = None, **more: Any) -> Schema:
    limits = {"minItems": least} if most is None else {"minItems": least, "maxItems": most}
    return {"type": "array", "items": items, **limits, **more}


def _names(least: int, most: int | None = None) -> Schema:
    """Different names."""
    return _list(_ref("name"), least, most, uniqueItems=True)


def _section(values: Schema, names: str = f"^{_NAME}$") -> Schema:
    """Names to values; it may be empty."""
    return {"type": ["object", "null"], "propertyNames": {"pattern": names}, "additionalProperties": values}


def _points_key(more: str) -> str:
    """Keys such as AB, A'B, O2-A: ``more`` points after the first."""
    count = {"{1}": "{2}", "{1,2}": "{2,3}"}[more]
    return f"^(({_ATOM}){count}|\\s*{_NAME}\\s*(-\\s*{_NAME}\\s*){more})$"


def _keyed(table: dict[str, Key], *needed: str) -> Schema:
    """A mapping with the keys of a table and no others; each has its description."""
    properties = {name: {**FORMS[key.form], "description": key.says} for name, key in table.items()}
    required = [*needed, *(name for name, key in table.items() if key.needed and name not in needed)]
    form = {"type": "object", "properties": properties, "additionalProperties": False}
    return {**form, "required": required} if required else form


def _of_kind(name: str, kind: EntryKind) -> Schema:
    """A mapping of one kind of joint, load or profile, with what ties its keys."""
    own = kind.key or name
    return {**_keyed({own: kind.own, **kind.keys}), **_tied(kind.ties, own), "description": kind.says}


def _tied(ties: tuple[Rule, ...], own: str = "") -> Schema:
    """What ties keys of a mapping to one another."""
    conditions = [_tie(tie, own) for tie in ties]
    return conditions[0] if len(conditions) == 1 else {"allOf": conditions} if conditions else {}


def _tie(tie: Rule, own: str) -> Schema:
    match tie.kind:
        case "needs":
            return {"dependencies": {tie.keys[0]: list(tie.keys[1:])}}
        case "direction":
            alone = {"required": [own], "properties": {own: {"type": "array"}}}
            without = {"not": {"anyOf": [{"required": [key]} for key in tie.keys]}}
            size = {"properties": {own: {"not": {"type": "array"}}}}
            return {"oneOf": [{**alone, **without}, *({"required": [key], **size} for key in tie.keys)]}
        case "any":
            return {"anyOf": [{"required": [name]} for name in tie.keys]}
        case "one":
            return {"oneOf": [{"required": [name]} for name in tie.keys]}
    none = {"not": {"anyOf": [{"required": [name]} for name in tie.keys]}}
    return {"oneOf": [none, *({"required": [name]} for name in tie.keys)]}


def _one(table: dict[str, EntryKind]) -> list[Schema]:
    """The kinds of a table."""
    return [_of_kind(name, kind) for name, kind in table.items()]


_LOAD = (_ref("quantity"), _ref("unknown"), _ref("like"))
_SENSE: Schema = {"enum": ["ccw", "cw"]}
_TEXT: Schema = {"type": ["string", "number", "boolean"]}
_PUBLISHED = _any({"type": "number"}, _pattern(_QUANTITY), _ref("pair"))
_UNKNOWN = (_ref("unknown"), _ref("unknown datum"))
_COORDINATES = _list(_any(_ref("quantity"), *_UNKNOWN), 2, 2)
FORMS: dict[str, Schema] = {
    "version": {"enum": [1, "1"]},
    "text": _ref("text"),
    "unit": {"type": "string"},
    "name": _ref("name"),
    "link": _ref("name"),
    "links": _names(2),
    "two links": _names(2, 2),
    "several": _names(2),
    "quantity": _ref("quantity"),
    "number": _ref("number"),
    "with unit": _ref("with unit"),
    "with unit or 0": _any({"const": 0}, _ref("with unit")),
    "power": _ref("with unit"),
    "percent": _pattern(r"^\s*[0-9.]+ ?(%|per ?cent)\s*$"),
    "width": _any({"type": "number", "minimum": 0}, _pattern(_QUANTITY)),
    "pair": _ref("pair"),
    "slope": _list(_ref("number"), 2, 2),
    "counts": _list(_ref("number"), 2, 2),
    "count or counts": _any(_ref("number"), _list(_ref("number"), 2, 2)),
    "range": _list(_ref("number"), 2, 2),
    "choices": _list(_TEXT, 1),
    "truth": {"enum": [True, False, "yes", "no", "true", "false"]},
    "sense": _SENSE,
    "hand": {"enum": ["right", "left"]},
    "place": _any(_ref("name"), _ref("pair")),
    "spot": _any(_ref("name"), _ref("triple")),
    "line": _any(_ref("quantity"), _names(2, 2)),
    "end": _any(_ref("name"), _ref("quantity"), _ref("pair")),
    "axis": _ref("axis"),
    "axis or point": _any(_ref("name"), _ref("axis")),
    "centres": _any(_ref("name"), _list(_ref("name"), 1, 2)),
    "load": _any(*_LOAD),
    "load with unit": _any(_ref("with unit"), *_LOAD[1:]),
    "load or vector": _any(*_LOAD, _ref("pair"), _list(_ref("unknown"), 2, 2)),
    "corner": _pattern(_points_key("{1,2}")),
    "load or pair": _any(*_LOAD, _ref("pair")),
    "load or triple": _any(*_LOAD, _ref("triple")),
    "corners": _list(_any(_ref("name"), _ref("pair")), 3),
    "arcs": _list(_ref("arc"), 1),
    "table": {
        "type": "object",
        "additionalProperties": _ref("quantity"),
        "propertyNames": {"pattern": _QUANTITY},
    },
    "published": _PUBLISHED,
    "ends": _list(_any({"type": "number"}, _pattern(_QUANTITY), {"type": "null"}), 2, 2),
    "stability": {"enum": ["stable", "unstable", "neutral"]},
    "units": _ref("units"),
    "gravity": _any(_ref("quantity"), _ref("triple"), _ref("gravity in space")),
    "points": _section(_any(_COORDINATES, _ref("triple"), _ref("centroid"))),
    "lengths": _section(
        _any({"type": "number", "minimum": 0}, _pattern(_QUANTITY), *_UNKNOWN), _points_key("{1}")
    ),
    "angles": _section(_any(_ref("quantity"), *_UNKNOWN), _points_key("{1,2}")),
    "near": _section(_ref("pair")),
    "points of a rope": _list(_ref("name"), 2),
    "links of a rope": _list(_ref("name"), 1),
    "sizes": _section(_ref("quantity")),
    "senses": _section(_SENSE),
    "numbers": _section(_ref("number")),
    "points of a link": _list(_ref("name"), 0),
    "links section": _section(_any(_list(_ref("name"), 0), _ref("masses"))),
    "joints": _list(_any(_ref("joint"), _ref("joint in space")), 1),
    "loads": _section(_any(_ref("load"), _ref("load in space"))),
    "profile": _section(_ref("profile")),
    "motion": _any(_ref("motion"), _list(_ref("motion"), 0), {"type": "null"}),
    "expect": _section(_any(_PUBLISHED, _ref("published")), "^.+$"),
    "tolerance": _any(_ref("quantity"), _ref("tolerance"), {"type": "null"}),
    "variables": _section(_ref("variable")),
}
"""What each form of the table of keys is in JSON."""


def _definitions() -> Schema:
    return {
        "text": {"type": ["string", "number", "boolean", "null"]},
        "name": _any(
            _pattern(f"^{_NAME}$"), {"type": "integer", "minimum": 0}, {"type": ["boolean", "null"]}
        ),
        "number": _any({"type": "number"}, _pattern(_BARE)),
        "quantity": _any({"type": "number"}, _pattern(_QUANTITY)),
        "with unit": _pattern(_WITH_UNIT),
        "pair": _list(_ref("quantity"), 2, 2),
        "triple": _list(_ref("quantity"), 3, 3),
        "axis": _any(_pattern(r"^\s*[-+]?[xyzXYZ]\s*$"), _ref("triple"), _names(2, 2)),
        "unknown": {"const": "unknown"},
        "unknown datum": _keyed(keys.UNKNOWN),
        "like": _keyed(keys.LIKE),
        "units": {**_keyed(keys.UNITS), "type": ["object", "null"]},
        "masses": {**_keyed(keys.MASSES), **_tied(keys.MASSES_TIES)},
        "centroid": _keyed(keys.CENTROID),
        "gravity in space": _keyed(keys.GRAVITY),
        "joint": {"oneOf": _one(JOINTS)},
        "joint in space": _any(*_one(keys.SPACE_JOINTS)),
        "load": {"oneOf": [*_one(keys.LOADS), *_one(keys.PULLS)]},
        "load in space": _any(*_one(keys.SPACE_LOADS)),
        "profile": _any(*_one(PROFILES)),
        "arc": _keyed(ARC),
        "motion": {"oneOf": [_of_kind("link", keys.MOTION_OF_LINK), _of_kind("link", keys.MOTION_OF_POINT)]},
        "published": {**_keyed(keys.EXPECTED), **_tied(keys.EXPECTED_TIES)},
        "tolerance": {**_keyed(keys.TOLERANCE), "minProperties": 1},
        "variable": {
            "oneOf": [
                {**_keyed({key: keys.VARIABLE[key] for key in some}), "required": list(some)}
                for some in (("choices",), ("range", "step"))
            ]
        },
    }
