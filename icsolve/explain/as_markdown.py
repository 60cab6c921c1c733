"""A worked solution as Markdown, its formulas as LaTeX between dollars."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from icsolve.explain.document import Block, Document, Formula, Inline, Items, Section, Table, Words, dotted
from icsolve.explain.latex import latex, latex_equation

_SPECIAL = re.compile(r"([\\`*_{}\[\]<>()#+!|~$&-])")


def escaped(text: str) -> str:
    """Words that Markdown leaves alone, whatever a case says: no markup, no HTML, no formula."""
    text = "".join(c if c.isprintable() else " " for c in text)
    text = _SPECIAL.sub(r"\\\1", text)
    return re.sub(r"^(\s*\d+)([.)])", r"\1\\\2", text)


def markdown_of(document: Document) -> str:
    """Headings, paragraphs, lists, tables and displayed formulas."""
    parts = [f"# {escaped(document.title)}", *(f"*{escaped(text)}*" for text in document.lead)]
    parts += [part for section in document.sections for part in _section(section)]
    return "\n\n".join(parts) + "\n"


def _section(section: Section) -> Iterable[str]:
    yield f"## {escaped(section.title)}"
    for block in section.blocks:
        yield _block(block)


def _block(block: Block) -> str:
    match block:
        case Words():
            return inline(block.parts)
        case Formula():
            return f"$$ {latex_equation(block.equation)} $$"
        case Items():
            marks = (f"{n}." if block.numbered else "-" for n in range(1, len(block.entries) + 1))
            return "\n".join(
                f"{mark} {inline(entry)}" for mark, entry in zip(marks, block.entries, strict=True)
            )
        case Table():
            rows = [[escaped(dotted(cell)) for cell in block.heading], ["---"] * len(block.heading)]
            rows += [[inline(cell) for cell in row] for row in block.rows]
            return "\n".join(f"| {' | '.join(row)} |" for row in rows)


def inline(parts: Sequence[Inline]) -> str:
    """Words and symbols on one line."""
    return "".join(escaped(dotted(p)) if isinstance(p, str) else f"${latex(p)}$" for p in parts)
