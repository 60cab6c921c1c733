"""A worked solution with its figure: one HTML file with MathML and SVG, which has nothing to load, or a LaTeX
document with TikZ; and an exercise sheet for LaTeX, figures and questions with the key behind them."""

from __future__ import annotations

import re
from collections.abc import Sequence

from icsolve.draw import tikz
from icsolve.draw.figure import ASKED, drawn
from icsolve.draw.marks import Mark, kinds_of
from icsolve.draw.svg import escaped
from icsolve.draw.words import answer_sentences, position_sentences, reaction_sentences
from icsolve.explain.document import (
    Block,
    Document,
    Formula,
    Inline,
    Items,
    Layout,
    ShownTable,
    Words,
    dotted,
    words,
)
from icsolve.explain.formula import LATEX, MATHML, Expr
from icsolve.explain.given import asked_section, given_section
from icsolve.explain.worked import load_name, worked
from icsolve.report.derivation.known import Known
from icsolve.tuples import NamedTuple
from icsolve.wording.sentences import provenance

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
        title = escaped(document.title)
        lead = "".join(f'<p class="lead">{escaped(text)}</p>\n' for text in document.lead)
        picture = f"<figure>{self.figure}</figure>\n" if self.figure else ""
        return (
            '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">\n'
            '<meta name="viewport" content="width=device-width,initial-scale=1">\n'
            f"<title>{title}</title>\n<style>{STYLE}</style></head>\n<body><main>\n"
            f"<h1>{title}</h1>\n{lead}{picture}{self.sections(document)}</main></body></html>\n"
        )

    def sections(self, document: Document) -> str:
        """The sections alone, to stand in another page; where a formula is wider than the window its section
        scrolls, by the keyboard too."""
        return "".join(
            f'<section tabindex="0" role="group" aria-label="{escaped(section.title)}">'
            f"<h2>{escaped(section.title)}</h2>\n{''.join(map(self._block, section.blocks))}"
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


class AsTex(Layout):
    """A whole LaTeX document; ``figure`` are the marks of a drawing, which stand in it as TikZ."""

    notation = LATEX
    packages = "\\usepackage{amsmath}\n\\usepackage{tikz}\n\\usepackage{longtable}\n"
    page = "\\usepackage[margin=2.2cm]{geometry}\n\\usepackage{adjustbox}\n\\allowdisplaybreaks\n"

    def __init__(self, figure: Sequence[Mark] = ()) -> None:
        self.figure = tuple(figure)

    def text(self, text: str) -> str:
        return re.sub(r"(?<![\w)$-])-(?=\d)", "$-$", tikz.escaped(dotted(text)))

    def symbol(self, expression: Expr) -> str:
        return f"${self.notation.expression(expression)}$"

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
                sides = [self.notation.side(side) for side in block.sides]
                lines = (f"{sides[0]} & = {sides[1]}", *sides[2:]) if sides[1:] else sides
                broken = " \\\\\n& = ".join(lines)
                return f"\\begin{{align*}}\n{broken}\n\\end{{align*}}\n"
            case Items():
                kind = "enumerate" if block.numbered else "itemize"
                entries = "".join(f"\\item {self.inline(entry)}\n" for entry in block.entries)
                return f"\\begin{{{kind}}}\n{entries}\\end{{{kind}}}\n"
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
        "\\begin{center}\n"
        f"\\begin{{adjustbox}}{{max width=\\linewidth,max totalheight={height}\\textheight}}\n"
        f"{tikz.picture(marks)}\\end{{adjustbox}}\n\\end{{center}}\n"
    )


# --- exercises -------------------------------------------------------------------------------------------


DIGITS = 6


class Exercise(NamedTuple):
    """A case as it is asked: its title, figure and text, and what the key says."""

    title: str
    figure: tuple[Mark, ...]
    blocks: tuple[Block, ...]
    key: tuple[Inline, ...]


def exercise(known: Known) -> Exercise:
    """A case as an exercise: its figure has neither answer nor centres."""
    asked = known.as_asked
    work = worked(known, DIGITS)
    own = work._replace(known=asked)
    found = reaction_sentences(known) if known.structure else answer_sentences(known)
    sections = (given_section(own), asked_section(work if known.structure else own))
    answers = ((sentence.split(" ", 1)[0], sentence) for sentence in found)
    key: tuple[Inline, ...] = tuple(
        part for name, told in answers for part in (load_name(name), f"{told.removeprefix(name)}. ")
    )
    if known.posed:
        key = (f"{'; '.join(position_sentences(known))}.",)
    if known.refusal is not None:
        key = (f"No answer ({known.refusal.status}): {known.refusal.message}",)
    blocks = tuple(block for section in sections for block in section.blocks)
    lead = tuple(words(told) for told in provenance(known.case))
    key = key or ("See the worked solution.",)
    return Exercise(known.title, tuple(drawn(asked, ASKED)), (*lead, *blocks), key)


def sheet_tex(title: str, sheets: Sequence[tuple[str, Sequence[Exercise]]]) -> str:
    """A document with the exercises of every student, each on pages of their own, and all keys behind."""
    layout = AsTex()
    used = kinds_of(mark for _, some in sheets for one in some for mark in one.figure)
    questions, keys = [], []
    for who, some in sheets:
        heading = layout.text(title) + (f" \\hfill {layout.text(who)}" if who else "")
        questions.append(f"\\section*{{{heading}}}\n")
        questions += [_question(layout, n, one) for n, one in enumerate(some, 1)]
        questions.append("\\clearpage\n")
        name = f"Key {layout.text(who)}".rstrip()
        items = "".join(f"\\item {layout.inline(one.key)}\n" for one in some)
        keys.append(f"\\section*{{{name}}}\n\\begin{{enumerate}}\n{items}\\end{{enumerate}}\n")
    return (
        f"\\documentclass[11pt]{{article}}\n{tikz.PREAMBLE}{layout.packages}{layout.page}"
        f"{tikz.styles(used)}\\begin{{document}}\n{''.join((*questions, *keys))}\\end{{document}}\n"
    )


def _question(layout: AsTex, n: int, one: Exercise) -> str:
    """An exercise, on one page where it has room there."""
    body = "".join(map(layout.block, one.blocks))
    figure = picture_tex(one.figure, 0.34)
    return f"\\filbreak\n\\subsection*{{{n}. {layout.text(one.title)}}}\n{figure}{body}"
