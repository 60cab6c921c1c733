"""Gradescope's export of an assignment: a folder a submission, and the metadata that says whose."""

from __future__ import annotations

import os
from collections.abc import Iterator

from icsolve.read.document import Mapping, Node, Scalar, Sequence, parse
from icsolve.read.problems import Problems, Stop

METADATA = "submission_metadata.yml"
_ANSWERS = (".csv", ".tsv", ".txt")


def exported(folder: str) -> Iterator[tuple[str, str]]:
    """The files of answers in an export, each with its student (the SID, else the email).

    Of a student without such a file the folder is given.

    Raises ValueError, with a sentence, where the metadata can't be read; OSError.
    """
    with open(os.path.join(folder, METADATA), encoding="utf-8") as file:
        text = file.read()
    problems = Problems(METADATA)
    try:
        root = parse(text, problems)
    except Stop:
        root = None
    if type(root) is not Mapping:
        raise ValueError(
            f"{METADATA} can't be read: {problems.found[0] if problems.found else 'it is empty'}"
        )
    for name, about in sorted(root.items.items()):
        path = os.path.join(folder, name)
        names = sorted(os.listdir(path)) if os.path.isdir(path) else []
        files = [file_name for file_name in names if file_name.lower().endswith(_ANSWERS)]
        for file_name in files:
            yield os.path.join(path, file_name), _student(about) or name
        if not files:
            yield path, _student(about) or name


def _student(about: Node) -> str:
    """Of ``:submitters: [{:name, :sid, :email}]``; Ruby's symbols start with a colon."""
    submitters = _item(about, "submitters")
    first = submitters.items[0] if type(submitters) is Sequence and submitters.items else None
    for key in ("sid", "email", "name"):
        value = _item(first, key)
        if type(value) is Scalar and value.text:
            return value.text
    return ""


def _item(node: Node | None, key: str) -> Node | None:
    if type(node) is not Mapping:
        return None
    return node.items.get(f":{key}") or node.items.get(key)
