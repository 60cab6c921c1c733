"""A worked solution as a document: sections of paragraphs, formulas, lists and tables; as plain text, as
Markdown with LaTeX, as one HTML file with MathML and SVG, which has nothing to load, as LaTeX with TikZ."""

from __future__ import annotations

import re
import textwrap
from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from itertools import pairwise

from icsolve.draw import tikz
from icsolve.draw.marks import Mark, kinds_of
from icsolve.explain.formula import LATEX, MATHML, PLAIN, Expr, Notation, Quantity
from icsolve.report import table
from icsolve.tuples import NamedTuple
from icsolve.wording import escaped

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
            parts += [f"## {self.text(section.title)}", *map(self._block, section.blocks)]
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


STYLE = """
:root{color-scheme:light dark;--ink:#1b1f24;--paper:#fff;--line:#d0d7de}
@media screen and (prefers-color-scheme:dark){:root{--ink:#e6e9ed;--paper:#14181d;--line:#3d444d}}
body{font:1rem/1.55 'Helvetica Neue',Helvetica,Arial,'Liberation Sans',sans-serif;color:var(--ink);
background:var(--paper);max-width:46rem;margin:2rem auto;padding:0 1rem}
h1{font-size:1.5rem;line-height:1.25}h2{font-size:1.15rem;margin-top:1.8em}
.lead{font-style:italic}math[display=block]{margin:.5em 0}
section{overflow-x:auto;overflow-y:hidden}table{border-collapse:collapse}
th,td{text-align:left;padding:.2em .8em .2em 0;border-bottom:1px solid var(--line)}
figure{margin:1rem 0}svg{max-width:100%;height:auto}
"""


def html_page(title: str, style: str, body: str) -> str:
    """A whole page under its title."""
    title = escaped(title)
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width,initial-scale=1">\n'
        f"<title>{title}</title>\n<style>{style}</style></head>\n<body><main>\n"
        f"<h1>{title}</h1>\n{body}</main></body></html>\n"
    )


class AsHtml(Layout):
    """A whole page; ``figure`` is an SVG drawing."""

    notation = MATHML

    def __init__(self, figure: str = "") -> None:
        self.figure = figure

    def text(self, text: str) -> str:
        return escaped(dotted(text))

    def symbol(self, expression: Expr) -> str:
        return f"<math>{self.notation.expression(expression)}</math>"

    def whole(self, document: Document) -> str:
        lead = "".join(f'<p class="lead">{escaped(text)}</p>\n' for text in document.lead)
        picture = f"<figure>{self.figure}</figure>\n" if self.figure else ""
        return html_page(document.title, STYLE, f"{lead}{picture}{self.sections(document)}")

    def sections(self, document: Document) -> str:
        """The sections alone, to stand in another page; where a formula is wider than the window its section
        scrolls, by the keyboard too."""
        return "".join(
            f'<section tabindex="0" role="group" aria-label="{self.text(section.title)}">'
            f"<h2>{self.text(section.title)}</h2>\n{''.join(map(self._block, section.blocks))}"
            "</section>\n"
            for section in document.sections
        )

    def _block(self, block: Block) -> str:
        match block:
            case Words():
                return f"<p>{self.inline(block.parts)}</p>\n"
            case Formula():
                return f'<math display="block">{self.notation.equation(block.sides)}</math>\n'
            case Items():
                tag = "ol" if block.numbered else "ul"
                entries = "".join(f"<li>{self.inline(entry)}</li>" for entry in block.entries)
                return f"<{tag}>{entries}</{tag}>\n"
            case ShownTable():
                heading, *rows = self.cells(block)
                head = "".join(f'<th scope="col">{cell}</th>' for cell in heading)
                body = "".join(f"<tr>{''.join(f'<td>{cell}</td>' for cell in row)}</tr>" for row in rows)
                return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>\n"


LONG = 24
"""A table of more rows goes on over pages in LaTeX."""


FITTED = r"""\newsavebox{\icfigure}
\newcommand{\icfitted}[1]{%
  \ifdim\wd\icfigure>\linewidth
    \sbox{\icfigure}{\resizebox{\linewidth}{!}{\usebox{\icfigure}}}\fi
  \ifdim\dimexpr\ht\icfigure+\dp\icfigure\relax>#1\textheight
    \sbox{\icfigure}{\resizebox*{!}{#1\textheight}{\usebox{\icfigure}}}\fi
  \usebox{\icfigure}}
\newcommand{\icside}[1]{\sbox{\icfigure}{$\displaystyle #1$}%
  \ifdim\wd\icfigure>0.85\linewidth
    \parbox[b]{0.85\linewidth}{\raggedright$\displaystyle #1$}\else\usebox{\icfigure}\fi}
"""
"""The box of a drawing, and what shrinks it to the width of the text and to a part of a page; by what TikZ
itself loads, as small installations of LaTeX have no more. Of an equation the side that is too long for a
line has several."""


TIGHT = "\\setlength{\\itemsep}{0pt}\\setlength{\\parskip}{0pt}"
"""No room between the lines of a list, which are short."""


class AsTex(Layout):
    """A whole LaTeX document; ``figure`` are the marks of a drawing, which stand in it as TikZ."""

    notation = LATEX
    packages = "\\usepackage{amsmath}\n\\usepackage{tikz}\n\\usepackage{longtable}\n"
    page = "\\usepackage[margin=2.2cm]{geometry}\n\\allowdisplaybreaks\n" + FITTED

    def __init__(self, figure: Sequence[Mark] = ()) -> None:
        self.figure = tuple(figure)

    def text(self, text: str) -> str:
        return re.sub(r"(?<![\w)$-])-(?=\d)", "$-$", tikz.escaped(dotted(text)))

    def symbol(self, expression: Expr) -> str:
        return f"${tikz.escaped_in_math(self.notation.expression(expression))}$"

    def whole(self, document: Document) -> str:
        lead = "".join(f"\\emph{{{self.text(text)}}}\\par\n" for text in document.lead)
        return (
            f"\\documentclass[11pt]{{article}}\n{tikz.PREAMBLE}{self.packages}{self.page}"
            f"{tikz.styles(kinds_of(self.figure))}\\begin{{document}}\n"
            f"\\section*{{{self.text(document.title)}}}\n{lead}{picture_tex(self.figure)}"
            f"{self.sections(document)}\\end{{document}}\n"
        )

    def sections(self, document: Document) -> str:
        """The sections alone, to stand in another document."""
        return "".join(
            f"\\subsection*{{{self.text(section.title)}}}\n{''.join(map(self.block, section.blocks))}"
            for section in document.sections
        )

    def block(self, block: Block) -> str:
        """One block of a section."""
        match block:
            case Words():
                return f"\\noindent {self.inline(block.parts)}\\par\n"
            case Formula():
                texts = (tikz.escaped_in_math(self.notation.side(side)) for side in block.sides)
                sides = [f"\\icside{{{text}}}" for text in texts]
                lines = (f"{sides[0]} & = {sides[1]}", *sides[2:]) if sides[1:] else sides
                broken = " \\\\\n& = ".join(lines)
                return f"\\begin{{align*}}\n{broken}\n\\end{{align*}}\n"
            case Items():
                kind = "enumerate" if block.numbered else "itemize"
                entries = "".join(f"\\item {self.inline(entry)}\n" for entry in block.entries)
                return f"\\begin{{{kind}}}{TIGHT}\n{entries}\\end{{{kind}}}\n"
            case ShownTable():
                heading, *rows = (" & ".join(row) + " \\\\\n" for row in self.cells(block))
                columns = "l" * len(block.heading)
                body = f"{heading}\\hline\n{''.join(rows)}"
                if len(rows) > LONG:
                    return f"\\begin{{longtable}}[l]{{{columns}}}\n{body}\\end{{longtable}}\n"
                table = f"\\begin{{tabular}}{{{columns}}}\n{body}\\end{{tabular}}"
                return f"\\par\\medskip\\noindent {table}\\par\\medskip\n"


def picture_tex(marks: Sequence[Mark], height: float = 0.5) -> str:
    """A drawing as TikZ, no wider than the text and no higher than a part of a page; '' of no marks."""
    if not marks:
        return ""
    return (
        "\\begin{center}\n\\begin{lrbox}{\\icfigure}%\n"
        f"{tikz.picture(marks)}\\end{{lrbox}}\\icfitted{{{height}}}\n\\end{{center}}\n"
    )
