"""A worked solution as a document: sections of paragraphs, formulas, lists and tables."""

from __future__ import annotations

import re
from itertools import pairwise
from typing import NamedTuple

from icsolve.explain.formula import Equation, Expr, Quantity

Inline = str | Expr
"""A piece of a paragraph: words, or a symbol or short formula."""


class Words(NamedTuple):
    """A paragraph."""

    parts: tuple[Inline, ...]


class Formula(NamedTuple):
    """A displayed formula."""

    equation: Equation


class Items(NamedTuple):
    """A list; with ``numbered`` its entries are counted."""

    entries: tuple[tuple[Inline, ...], ...]
    numbered: bool = False


class Table(NamedTuple):
    """Rows of cells under a heading."""

    heading: tuple[str, ...]
    rows: tuple[tuple[tuple[Inline, ...], ...], ...]


Block = Words | Formula | Items | Table


class Section(NamedTuple):
    """Blocks under a title."""

    title: str
    blocks: tuple[Block, ...]


class Document(NamedTuple):
    """A worked solution; ``lead`` stands under the title (source, reconstructed)."""

    title: str
    lead: tuple[str, ...]
    sections: tuple[Section, ...]


def words(*parts: Inline) -> Words:
    """A paragraph."""
    return Words(parts)


def formula(*sides: Expr) -> Formula:
    """A displayed formula; a side that the next one only repeats is left out."""
    kept = [one for one, after in pairwise(sides) if not _repeats(after, one)]
    return Formula(Equation((*kept, sides[-1])))


def _repeats(after: Expr, before: Expr) -> bool:
    return after == before or (isinstance(after, Quantity) and after.number == before)


def dotted(text: str) -> str:
    """Units of a text with a dot between: ``lbf·in``."""
    return re.sub(r"(?<=[A-Za-z])\*(?=[A-Za-z])", "·", text)
