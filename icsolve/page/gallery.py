"""A gallery of cases: for each its figure, answer and page, and an index of all with what is wrong with those
that have no answer."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from itertools import groupby
from types import MappingProxyType
from typing import NamedTuple
from urllib.parse import quote

from icsolve.case import Case
from icsolve.derivation import Known, known_of
from icsolve.draw import Drawing, draw
from icsolve.draw.svg import escaped
from icsolve.draw.words import answer_sentences, description
from icsolve.page import page_html

FIGURE, PAGE = ".svg", ".html"
ENDINGS = (FIGURE, PAGE)
"""What the files of one case end in."""
BARE = Drawing(captions=False)
"""Title and answer stand on the card around a figure."""


class Exhibit(NamedTuple):
    """A case on show. ``name`` is what its files are called, with the folders that it stands in and without
    their endings; ``source`` is the file that it was read from.

    ``answers`` are sentences; ``reason`` says why there is no answer or no case, ``status`` in the stable
    word (``unreadable`` for no case, which has no ``files`` either). ``alt`` is the figure in words.
    """

    name: str
    source: str
    title: str
    status: str = "ok"
    answers: tuple[str, ...] = ()
    reason: str = ""
    alt: str = ""
    files: Mapping[str, str] = MappingProxyType({})
    """content by ending"""


def exhibit(case: Case, name: str, source: str) -> Exhibit:
    """A case with its files; one without an answer is shown as far as it is known, with the reason."""
    known = known_of(case, reactions=True)
    files = {FIGURE: draw(case, BARE, known), PAGE: page_html(known)}
    refusal = known.refusal
    status, reason = ("ok", "") if refusal is None else (refusal.status, refusal.message)
    return Exhibit(name, source, known.title, status, _answers(known), reason, description(known), files)


def unreadable(name: str, source: str, reason: str) -> Exhibit:
    """A file that can't be read as a case."""
    return Exhibit(name, source, source, "unreadable", (), reason)


def _answers(known: Known) -> tuple[str, ...]:
    """The unknown loads; of a case that asks for none what it does ask for."""
    found = tuple(answer_sentences(known))
    if found or known.refusal is not None:
        return found
    return ("Asked: the reactions of the joints",) if known.case.space else ("Asked: centres and velocities",)


# --- the index -------------------------------------------------------------------------------------------


STYLE = """
:root{color-scheme:light dark;--ink:#1b1f24;--paper:#fff;--soft:#57606a;--line:#d0d7de;--link:#0b5cad;
--bad:#b3261e}
@media screen and (prefers-color-scheme:dark){:root{--ink:#e6e9ed;--paper:#14181d;--soft:#9aa4af;
--line:#3d444d;--link:#6cb6ff;--bad:#ff8a80}}
body{font:1rem/1.5 'Helvetica Neue',Helvetica,Arial,'Liberation Sans',sans-serif;color:var(--ink);
background:var(--paper);max-width:84rem;margin:2rem auto;padding:0 1rem;overflow-wrap:anywhere}
h1{font-size:1.6rem;line-height:1.25;margin-bottom:.2em}h2{font-size:1.2rem;margin:2em 0 .8em}
h3{font-size:1rem;line-height:1.3;margin:0}a{color:var(--link)}p{margin:.35em 0}
.cards{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(20rem,100%),1fr));gap:1rem;padding:0}
.card{border:1px solid var(--line);border-radius:6px;padding:.9rem;display:flex;flex-direction:column}
.card img{width:100%;height:15rem;object-fit:contain;margin:.5rem 0}
.answer{font-weight:600}.bad{color:var(--bad);font-weight:600}.soft{color:var(--soft);font-size:.9rem}
.links{margin-top:auto;padding-top:.4em}.problem{white-space:pre-wrap}
@media print{.card{break-inside:avoid}}
"""


def index_html(exhibits: Sequence[Exhibit], title: str) -> str:
    """The page of a gallery, as one HTML file that loads its pictures and nothing else."""
    shown = [one for one in exhibits if one.status != "unreadable"]
    broken = [one for one in exhibits if one.status != "ok"]
    body = "".join((*_contents(broken), *_folders(shown)))
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width,initial-scale=1">\n'
        f"<title>{escaped(title)}</title>\n<style>{STYLE}</style></head>\n<body><main>\n"
        f"<h1>{escaped(title)}</h1>\n<p>{escaped(_count(exhibits))}</p>\n{body}</main></body></html>\n"
    )


def _count(exhibits: Sequence[Exhibit]) -> str:
    unread = sum(one.status == "unreadable" for one in exhibits)
    refused = sum(one.status != "ok" for one in exhibits) - unread
    words = ["1 case" if len(exhibits) == 1 else f"{len(exhibits)} cases"]
    words += [f"{refused} without an answer"] if refused else []
    words += [f"{unread} that can't be read"] if unread else []
    return ", ".join(words) + "."


def _contents(broken: Sequence[Exhibit]) -> Iterable[str]:
    """Those without an answer, first, each with its reason."""
    if not broken:
        return
    yield "<section><h2>Without an answer</h2>\n<ul>\n"
    for one in broken:
        where = escaped(one.title)
        link = where if one.status == "unreadable" else f'<a href="#{_anchor(one)}">{where}</a>'
        yield f'<li>{link}: <span class="bad">{one.status}</span>'
        yield f'<p class="problem">{escaped(one.reason)}</p></li>\n'
    yield "</ul></section>\n"


def _folders(shown: Sequence[Exhibit]) -> Iterable[str]:
    """Cards by the folder that the cases stand in."""
    for folder, some in groupby(shown, key=lambda one: one.name.rpartition("/")[0]):
        yield f"<section><h2>{escaped(folder)}</h2>\n" if folder else "<section>\n"
        yield '<div class="cards">\n'
        yield from map(_card, some)
        yield "</div></section>\n"


def _card(one: Exhibit) -> str:
    figure, page = (_address(one.name + ending) for ending in (FIGURE, PAGE))
    answers = "".join(f'<p class="answer">{escaped(sentence)}</p>\n' for sentence in one.answers)
    reason = f'<p class="bad">No answer ({one.status}): {escaped(one.reason)}</p>\n' if one.reason else ""
    return (
        f'<article class="card" id="{_anchor(one)}"><h3>{escaped(one.title)}</h3>\n'
        f'<a href="{page}"><img src="{figure}" alt="{escaped(one.alt)}" loading="lazy"/></a>\n'
        f"{answers}{reason}"
        f'<p class="links"><a href="{page}">Page and solution</a> · <a href="{figure}">figure</a></p>\n'
        f'<p class="soft">{escaped(one.source)}</p></article>\n'
    )


def _address(path: str) -> str:
    """A path as an address, whatever bytes its name has."""
    return quote(os.fsencode(path))


def _anchor(one: Exhibit) -> str:
    """The id of a card."""
    return "case-" + quote(os.fsencode(one.name), safe="").replace("%", "_")
