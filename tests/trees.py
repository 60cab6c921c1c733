"""Trees of a case file: to YAML text again, and to the values that a YAML 1.2 editor checks by a schema."""

from __future__ import annotations

import json
import pickle
import re
from functools import lru_cache
from typing import Any

from icsolve.read.document import Mapping, Node, Scalar, Sequence, parse
from icsolve.read.names import Problems

_PLAIN = re.compile(r"[A-Za-z0-9_.'@/+%^ -]*[A-Za-z0-9'%]|[-+]?\.[0-9]+")
_NUMBER = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")


def tree(text: str) -> Mapping:
    """The tree of a text that is YAML, which may be changed."""
    root: Mapping = pickle.loads(_packed(text))
    return root


@lru_cache(maxsize=8)
def _packed(text: str) -> bytes:
    """To take it out again takes a tenth of the time to parse it."""
    root = parse(text, Problems("<text>"))
    assert isinstance(root, Mapping)
    return pickle.dumps(root)


def dump(node: Node) -> str:
    """Flow YAML of a tree."""
    if isinstance(node, Scalar):
        return _scalar(node.text, node.plain)
    if isinstance(node, Sequence):
        return "[" + ", ".join(map(dump, node.items)) + "]"
    return "{" + ", ".join(f"{_scalar(key, True)}: {dump(value)}" for key, value in node.items.items()) + "}"


def document(root: Mapping) -> str:
    """A file with one line a section."""
    return "".join(f"{_scalar(key, True)}: {dump(value)}\n" for key, value in root.items.items())


def _scalar(text: str, plain: bool) -> str:
    if plain and not text:
        return "~"
    quoted = not plain or not _PLAIN.fullmatch(text) or (text[0] in "@'%-" and not _NUMBER.fullmatch(text))
    return json.dumps(text) if quoted else text


def typed(node: Node) -> Any:
    """The value of a tree by the core schema of YAML 1.2; keys are text."""
    if isinstance(node, Sequence):
        return [typed(item) for item in node.items]
    if isinstance(node, Mapping):
        return {key: typed(value) for key, value in node.items.items()}
    if not node.plain:
        return node.text
    if node.text in ("", "~", "null", "Null", "NULL"):
        return None
    if node.text.lower() in ("true", "false"):
        return node.text.lower() == "true"
    if _NUMBER.fullmatch(node.text):
        return float(node.text)
    return node.text
