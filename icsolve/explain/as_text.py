"""A worked solution as plain text."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence

from icsolve.explain.document import Block, Document, Formula, Inline, Items, Section, Table, Words
from icsolve.explain.formula import plain, plain_equation

WIDTH = 100


def text_of(document: Document) -> str:
    """Sections under underlined titles, formulas indented."""
    head = [document.title, "=" * len(document.title), *document.lead]
    return "\n".join([*head, *(line for section in document.sections for line in _section(section))]) + "\n"


def _section(section: Section) -> Iterable[str]:
    yield from ("", section.title, "-" * len(section.title))
    for block in section.blocks:
        yield from _block(block)


def _block(block: Block) -> Iterable[str]:
    match block:
        case Words():
            yield from textwrap.wrap(inline(block.parts), WIDTH)
        case Formula():
            yield f"    {plain_equation(block.equation)}"
        case Items():
            for n, entry in enumerate(block.entries, 1):
                mark = f"{n}. " if block.numbered else "- "
                yield from textwrap.wrap(
                    inline(entry), WIDTH, initial_indent=f"  {mark}", subsequent_indent="     "
                )
        case Table():
            yield from _table([block.heading, *([inline(cell) for cell in row] for row in block.rows)])


def inline(parts: Sequence[Inline]) -> str:
    """Words and symbols on one line."""
    return "".join(part if isinstance(part, str) else plain(part) for part in parts)


def _table(rows: Sequence[Sequence[str]]) -> Iterable[str]:
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    for row in rows:
        yield "  " + "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
