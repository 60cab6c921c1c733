"""YAML text to a Case; every refusal has its line and column, and one run finds them all."""

from __future__ import annotations

import os
from collections.abc import Mapping as Named

from icsolve.case import Case
from icsolve.errors import CaseError, NotACase, refuse_other
from icsolve.read.build import NO_CASE, build, check_version, is_in_space
from icsolve.read.document import Mapping, Node, checked, parse, take_in, take_out, text_of
from icsolve.read.keys import SECTIONS
from icsolve.read.names import Problems, Stop
from icsolve.read.reading import read_units
from icsolve.tuples import replace

Settings = Named[str, str | float]
"""Values by path: ``{"angles.AB": "30", "loads.P": "500 lbf"}``."""


def load(path_or_text: str | os.PathLike[str], settings: Settings | None = None) -> Case:
    """A case from a file, or from a text: one with a line break or with ``icsolve:`` in it.

    Parameters
    ----------
    path_or_text : file, or YAML text
    settings : values in the place of those that the case gives, by path: ``{"angles.AB": "30"}``; a number
        without a unit is in the units of the case

    Raises
    ------
    CaseError
        With all that is wrong, each with its line and column; so for a file that is missing or not UTF-8.
        ``NotACase`` where there is no ``icsolve:``.
    """
    refuse_other(path_or_text, (str, os.PathLike), 'load takes a path or a text, as load("press.yaml")')
    refuse_other(settings or {}, Named, 'settings are values by path, as settings={"angles.AB": 30}')
    for path in settings or {}:
        refuse_other(path, str, "a path is a text, as 'angles.AB'")
    if isinstance(path_or_text, str) and ("\n" in path_or_text or "icsolve:" in path_or_text):
        return read_text(path_or_text, settings=settings)
    return read_file(path_or_text, settings)


def read_file(path: str | os.PathLike[str], settings: Settings | None = None) -> Case:
    """The case of a file; its name is the file's, without endings.

    Raises
    ------
    CaseError
        Also for a file that is missing, a folder, a binary, or not UTF-8.
    """
    shown = os.fspath(path)
    problems = Problems(shown)
    try:
        text = text_of(path, problems)
    except Stop:
        raise CaseError(problems.found) from None
    return read_text(text, shown, settings)


def read_text(text: str, path: str = "<text>", settings: Settings | None = None) -> Case:
    """The case of a text; ``path`` stands in its messages.

    Raises
    ------
    CaseError
        As ``load``.
    """
    problems = Problems(path)
    root, case = None, None
    try:
        text = checked(text, problems)
        root = _root(parse(text, problems), problems)
        if "icsolve" not in root.items and not {"joints", "points"} & set(root.items):
            raise problems.stop(root.mark, NO_CASE)
        case = _case(root, settings or {}, problems, case_name(path))
    except Stop:
        pass
    if case is None or problems.found:
        ours = "icsolve" in root.items if root is not None else claims(text)
        raise (CaseError if ours else NotACase)(problems.found)
    return case


def _case(root: Mapping, settings: Settings, problems: Problems, name: str) -> Case:
    """The case of a tree with its settings, and with values for its variables."""
    if "variables" not in root.items:
        _set(root, settings, problems)
        return _built(root, problems, name)
    from icsolve.read.variables import read_variables, substitute

    variables = read_variables(root, problems)
    given = {path[10:]: str(value) for path, value in settings.items() if path.startswith("variables.")}
    substitute(root, variables, given, problems)
    _set(root, {p: v for p, v in settings.items() if not p.startswith("variables.")}, problems)
    return replace(_built(root, problems, name), variables=variables)


def _set(root: Mapping, settings: Settings, problems: Problems) -> None:
    """Put the settings into the tree, if there are any."""
    if settings:
        from icsolve.read.settings import apply

        apply(root, settings, problems)


def _built(root: Mapping, problems: Problems, name: str) -> Case:
    """The case of a tree, planar or in space; whether it may be used, the problems tell."""
    check_version(root, problems)
    take_in(root, root.items.keys() - SECTIONS.keys(), problems)
    take_out(root, SECTIONS, problems)
    units = read_units(root.items.get("units"), problems)
    if not is_in_space(root):
        return build(root, problems, name, units)
    from icsolve.read.space import build_space

    return build_space(root, problems, name, units)


def _root(node: Node | None, problems: Problems) -> Mapping:
    """The top of a document as a mapping."""
    if type(node) is Mapping:
        return node
    if node is None:
        raise problems.stop((1, 1), "there is nothing in it; a case starts with 'icsolve: 1'")
    raise problems.stop(node.mark, "this is not an icsolve case, which starts with 'icsolve: 1'")


def claims(text: str) -> bool:
    """Whether a text that is not YAML was meant as a case: ``icsolve:`` starts one of its lines."""
    return any(line.lstrip("{ \"'").startswith("icsolve") for line in text.splitlines())


def case_name(path: str) -> str:
    """``press`` of ``press.yaml`` and of ``dir/press.icsolve.yaml``, its accents as `checked` has them."""
    if path.startswith("<") and path.endswith(">"):
        return "case"
    stem, _ = os.path.splitext(os.path.basename(path))
    if not stem.isascii():
        from unicodedata import normalize

        stem = normalize("NFC", stem)
    return stem.removesuffix(".icsolve") or "case"


__all__ = ["Settings", "case_name", "claims", "load", "read_file", "read_text"]
