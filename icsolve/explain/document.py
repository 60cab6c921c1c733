"""A worked solution as a document: sections of paragraphs, formulas, lists and tables; as plain text and as
Markdown with LaTeX."""

from __future__ import annotations

import re
import textwrap
from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from itertools import pairwise

from icsolve.explain.formula import LATEX, PLAIN, Expr, Notation, Quantity
from icsolve.report.text import table
from icsolve.tuples import NamedTuple

Inline = str | Expr
"""A piece of a paragraph: words, or a symbol or short formula."""


class Words(NamedTuple):
    """A paragraph."""

    parts: tuple[Inline, ...]


class Formula(NamedTuple):
    """A displayed formula: expressions that are equal."""

    sides: tuple[Expr, ...]


class Items(NamedTuple):
    """A list; with ``numbered`` its entries are counted."""

    entries: tuple[tuple[Inline, ...], ...]
    numbered: bool = False


class ShownTable(NamedTuple):
    """Rows of cells under a heading."""

    heading: tuple[str, ...]
    rows: tuple[tuple[tuple[Inline, ...], ...], ...]


Block = Words | Formula | Items | ShownTable


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
    return Formula((*kept, sides[-1]))


def _repeats(after: Expr, before: Expr) -> bool:
    return after == before or (isinstance(after, Quantity) and after.number == before)


def dotted(text: str) -> str:
    """Units of a text with a dot between: ``lbf·in``."""
    return re.sub(r"(?<=[A-Za-z])\*(?=[A-Za-z])", "·", text)


# --- how a document is set --------------------------------------------------------------------------


class Layout(ABC):
    """A way of setting documents; the formulas are in its `Notation`."""

    notation: Notation

    @abstractmethod
    def whole(self, document: Document) -> str:
        """A document by itself."""

    @abstractmethod
    def text(self, text: str) -> str:
        """Words, whatever a case says."""

    @abstractmethod
    def symbol(self, expression: Expr) -> str:
        """A formula in a line of words."""

    def inline(self, parts: Sequence[Inline]) -> str:
        """Words and symbols on one line."""
        return "".join(self.text(p) if isinstance(p, str) else self.symbol(p) for p in parts)

    def cells(self, table: ShownTable) -> list[list[str]]:
        """The heading and the rows of a table."""
        rows = [[self.inline(cell) for cell in row] for row in table.rows]
        return [[self.text(cell) for cell in table.heading], *rows]


class AsText(Layout):
    """Sections under underlined titles, formulas indented."""

    notation = PLAIN
    width = 100

    def text(self, text: str) -> str:
        return text

    def symbol(self, expression: Expr) -> str:
        return self.notation.expression(expression)

    def whole(self, document: Document) -> str:
        lines = [document.title, "=" * len(document.title), *document.lead]
        for section in document.sections:
            lines += ["", section.title, "-" * len(section.title)]
            lines += [line for block in section.blocks for line in self._block(block)]
        return "\n".join(lines) + "\n"

    def _block(self, block: Block) -> Iterable[str]:
        match block:
            case Words():
                yield from textwrap.wrap(self.inline(block.parts), self.width)
            case Formula():
                yield f"    {self.notation.equation(block.sides)}"
            case Items():
                for n, entry in enumerate(block.entries, 1):
                    mark = f"  {n}. " if block.numbered else "  - "
                    yield from textwrap.wrap(
                        self.inline(entry), self.width, initial_indent=mark, subsequent_indent="     "
                    )
            case ShownTable():
                yield from table(self.cells(block))


class AsMarkdown(Layout):
    """Headings, paragraphs, lists, tables and displayed formulas; words stay words: no markup, no HTML."""

    notation = LATEX
    special = re.compile(r"([\\`*_{}\[\]<>()#+!|~$&-])")

    def text(self, text: str) -> str:
        return self.plain(dotted(text))

    def plain(self, text: str) -> str:
        """Words as they stand, without a look for units in them."""
        text = "".join(c if c.isprintable() else " " for c in text)
        text = self.special.sub(r"\\\1", text)
        return re.sub(r"^(\s*\d+)([.)])", r"\1\\\2", text)

    def symbol(self, expression: Expr) -> str:
        return f"${self.notation.expression(expression)}$"

    def whole(self, document: Document) -> str:
        parts = [f"# {self.plain(document.title)}", *(f"*{self.plain(text)}*" for text in document.lead)]
        for section in document.sections:
            parts += [f"## {self.plain(section.title)}", *map(self._block, section.blocks)]
        return "\n\n".join(parts) + "\n"

    def _block(self, block: Block) -> str:
        match block:
            case Words():
                return self.inline(block.parts)
            case Formula():
                return f"$$ {self.notation.equation(block.sides)} $$"
            case Items():
                marks = (f"{n}." if block.numbered else "-" for n in range(1, len(block.entries) + 1))
                entries = zip(marks, block.entries, strict=True)
                return "\n".join(f"{mark} {self.inline(entry)}" for mark, entry in entries)
            case ShownTable():
                heading, *rows = self.cells(block)
                rows = [heading, ["---"] * len(heading), *rows]
                return "\n".join(f"| {' | '.join(row)} |" for row in rows)
