"""Shapes of YAML values as JSON Schema (draft-07) writes them."""

from __future__ import annotations

from typing import Any

Schema = dict[str, Any]


def ref(name: str) -> Schema:
    """One of the definitions."""
    return {"$ref": f"#/definitions/{name}"}


def pattern(text: str) -> Schema:
    """A text of that pattern."""
    return {"type": "string", "pattern": text}


def list_of(items: Schema, least: int, most: int | None = None) -> Schema:
    """A list of so many."""
    limits = {"minItems": least} if most is None else {"minItems": least, "maxItems": most}
    return {"type": "array", "items": items, **limits}


def links(most: int | None) -> Schema:
    """Two or more different names."""
    return {**list_of(ref("name"), 2, most), "uniqueItems": True}


def mapping(properties: Schema, required: list[str] | None = None) -> Schema:
    """A mapping with these keys and no others."""
    needs = {"required": required} if required else {}
    return {"type": "object", "properties": properties, "additionalProperties": False, **needs}
