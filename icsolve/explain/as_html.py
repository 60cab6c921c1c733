"""A worked solution as one HTML file: MathML for the formulas, the figure as inline SVG, nothing to load."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from icsolve.draw.svg import escaped
from icsolve.explain.document import Block, Document, Formula, Inline, Items, Section, Table, Words, dotted
from icsolve.explain.mathml import mathml, mathml_equation

STYLE = """
:root{color-scheme:light dark;--ink:#1b1f24;--paper:#fff;--line:#d0d7de}
@media screen and (prefers-color-scheme:dark){:root{--ink:#e6e9ed;--paper:#14181d;--line:#3d444d}}
body{font:1rem/1.55 'Helvetica Neue',Helvetica,Arial,'Liberation Sans',sans-serif;color:var(--ink);
background:var(--paper);max-width:46rem;margin:2rem auto;padding:0 1rem}
h1{font-size:1.5rem;line-height:1.25}h2{font-size:1.15rem;margin-top:1.8em}
.lead{font-style:italic}math[display=block]{margin:.5em 0;overflow-x:auto;overflow-y:hidden}
table{border-collapse:collapse;display:block;overflow-x:auto}
th,td{text-align:left;padding:.2em .8em .2em 0;border-bottom:1px solid var(--line)}
figure{margin:1rem 0}svg{max-width:100%;height:auto}
"""


def html_of(document: Document, figure: str = "") -> str:
    """A whole page; ``figure`` is an SVG drawing."""
    lead = "".join(f'<p class="lead">{escaped(text)}</p>\n' for text in document.lead)
    picture = f"<figure>{figure}</figure>\n" if figure else ""
    body = sections_html(document)
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width,initial-scale=1">\n'
        f"<title>{escaped(document.title)}</title>\n<style>{STYLE}</style></head>\n<body><main>\n"
        f"<h1>{escaped(document.title)}</h1>\n{lead}{picture}{body}</main></body></html>\n"
    )


def sections_html(document: Document) -> str:
    """The sections alone, to stand in another page."""
    return "".join(part for section in document.sections for part in _section(section))


def _section(section: Section) -> Iterable[str]:
    yield f"<section><h2>{escaped(section.title)}</h2>\n"
    for block in section.blocks:
        yield _block(block)
    yield "</section>\n"


def _block(block: Block) -> str:
    match block:
        case Words():
            return f"<p>{inline(block.parts)}</p>\n"
        case Formula():
            return f"{mathml_equation(block.equation)}\n"
        case Items():
            tag = "ol" if block.numbered else "ul"
            return f"<{tag}>{''.join(f'<li>{inline(entry)}</li>' for entry in block.entries)}</{tag}>\n"
        case Table():
            head = "".join(f"<th>{escaped(dotted(cell))}</th>" for cell in block.heading)
            rows = "".join(f"<tr>{''.join(f'<td>{inline(c)}</td>' for c in row)}</tr>" for row in block.rows)
            return f"<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>\n"


def inline(parts: Sequence[Inline]) -> str:
    """Words and symbols on one line."""
    return "".join(escaped(dotted(p)) if isinstance(p, str) else f"<math>{mathml(p)}</math>" for p in parts)
