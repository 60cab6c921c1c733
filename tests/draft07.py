"""A validator of the part of JSON Schema draft-07 that the schema of a case uses; any other word is an error.

The words are those of https://json-schema.org/draft-07/json-schema-validation (section 6).
"""

from __future__ import annotations

import re
from typing import Any

_TYPES: dict[str, Any] = {
    "object": dict,
    "array": list,
    "string": str,
    "boolean": bool,
    "null": type(None),
}
_SAID = {"$schema", "$id", "title", "description", "definitions"}


def valid(value: Any, schema: dict[str, Any], root: dict[str, Any] | None = None) -> bool:
    """Whether a value fits a schema."""
    root = root or schema
    if "$ref" in schema:  # its neighbours are not read in draft-07, but `description` alone stands there
        *_, name = schema["$ref"].split("/")
        return valid(value, root["definitions"][name], root)
    return all(_WORDS[word](value, said, schema, root) for word, said in schema.items() if word not in _SAID)


def _type(value: Any, said: Any, *_: Any) -> bool:
    return any(_is(value, name) for name in ([said] if isinstance(said, str) else said))


def _is(value: Any, name: str) -> bool:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if name == "number":
        return number
    if name == "integer":
        return number and float(value).is_integer()
    return isinstance(value, _TYPES[name])


def _numeric(value: Any) -> bool:
    return _is(value, "number")


def _properties(value: Any, said: Any, _: Any, root: Any) -> bool:
    return not isinstance(value, dict) or all(valid(v, said[k], root) for k, v in value.items() if k in said)


def _additional(value: Any, said: Any, schema: Any, root: Any) -> bool:
    if not isinstance(value, dict):
        return True
    rest = [v for k, v in value.items() if k not in schema.get("properties", {})]
    return not rest if said is False else all(valid(v, said, root) for v in rest)


def _unique(value: Any, said: bool, *_: Any) -> bool:
    return not isinstance(value, list) or len({repr(item) for item in value}) == len(value)


def _dependencies(value: Any, said: Any, *_: Any) -> bool:
    return not isinstance(value, dict) or all(
        set(needs) <= set(value) for key, needs in said.items() if key in value
    )


_WORDS: dict[str, Any] = {
    "type": _type,
    "enum": lambda v, said, *_: any(
        v == one and isinstance(v, bool) == isinstance(one, bool) for one in said
    ),
    "const": lambda v, said, *_: v == said,
    "minimum": lambda v, said, *_: not _numeric(v) or v >= said,
    "pattern": lambda v, said, *_: not isinstance(v, str) or re.search(said, v) is not None,
    "items": lambda v, said, _, root: not isinstance(v, list) or all(valid(item, said, root) for item in v),
    "minItems": lambda v, said, *_: not isinstance(v, list) or len(v) >= said,
    "maxItems": lambda v, said, *_: not isinstance(v, list) or len(v) <= said,
    "uniqueItems": _unique,
    "required": lambda v, said, *_: not isinstance(v, dict) or set(said) <= set(v),
    "properties": _properties,
    "additionalProperties": _additional,
    "propertyNames": lambda v, said, _, root: (
        not isinstance(v, dict) or all(valid(key, said, root) for key in v)
    ),
    "dependencies": _dependencies,
    "allOf": lambda v, said, _, root: all(valid(v, one, root) for one in said),
    "anyOf": lambda v, said, _, root: any(valid(v, one, root) for one in said),
    "oneOf": lambda v, said, _, root: sum(valid(v, one, root) for one in said) == 1,
    "not": lambda v, said, _, root: not valid(v, said, root),
}
