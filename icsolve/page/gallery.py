"""A gallery of cases: for each its figure, answer and page, and an index of all with what is wrong with those
that have no answer."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType
from urllib.parse import quote

from icsolve.case import Case, Spring
from icsolve.case.joints import Guided, Mesh, Rolling
from icsolve.draw.figure import ASKED, Drawing, draw
from icsolve.draw.words import description, found_sentences
from icsolve.explain.document import html_page
from icsolve.explain.given import asked_without_unknown, position_asked
from icsolve.page import page_html
from icsolve.report.derivation.known import Known, known_of
from icsolve.statics.power import is_unknown
from icsolve.tuples import NamedTuple
from icsolve.wording import escaped, listed, plural
from icsolve.wording.sentences import provenance

FIGURE, PAGE = ".svg", ".html"
ENDINGS = (FIGURE, PAGE)
"""What the files of one case end in."""
BARE = Drawing(captions=False)
"""Title and answer stand on the card around a figure."""
KINDS = (
    "Four-bar linkages",
    "Linkages of more bars",
    "Sliders and slots",
    "Gears, belts and rolling wheels",
    "Cams",
    "Ropes and pulleys",
    "Screws",
    "Inertia forces",
    "Friction",
    "Springs",
    "Given centres",
    "Structures",
    "In space",
    "Others",
)
"""What cases are told by, in the order of the index."""


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
    kind: str = KINDS[-1]
    provenance: tuple[str, ...] = ()
    """what of the figure is reconstructed, as a sentence"""
    moves: bool = False
    paged: bool = True
    """whether there is a page with the answer"""


def exhibit(case: Case, name: str, source: str, *, exercise: bool = False) -> Exhibit:
    """A case with its files; one without an answer is shown as far as it is known, with the reason.

    As an ``exercise`` its figure asks for the unknown, and there is no page that would tell it.
    """
    known = known_of(case, reactions=True)
    refusal = known.refusal
    status, reason = ("ok", "") if refusal is None else (refusal.status, refusal.message)
    kind = kind_of(known)
    if exercise:
        bare = known.as_asked
        files = {FIGURE: draw(case, ASKED, bare)}
        return Exhibit(
            name,
            source,
            known.title,
            status,
            asked(known),
            reason,
            description(bare),
            files,
            kind,
            provenance(case),
            paged=False,
        )
    page = page_html(known)
    files = {FIGURE: draw(case, BARE, known), PAGE: page}
    moves = 'id="turn"' in page
    told = _answers(known)
    alt, lead = description(known), provenance(case)
    return Exhibit(name, source, known.title, status, told, reason, alt, files, kind, lead, moves)


def kind_of(known: Known) -> str:
    """What a mechanism is in the first place."""
    case = known.case
    joints = case.joints
    pinned = len(case.pivots()) == len(joints)
    tests = (
        ("In space", case.space is not None),
        ("Structures", known.structure),
        ("Given centres", any(joint.stands_in for joint in joints)),
        ("Cams", bool(case.profiles) or any(joint.only_pushes for joint in joints)),
        ("Ropes and pulleys", bool(case.ropes)),
        ("Screws", bool(case.screws)),
        ("Inertia forces", case.dynamic),
        ("Friction", any(joint.friction is not None for joint in joints)),
        ("Springs", any(isinstance(load, Spring) for load in case.loads)),
        ("Gears, belts and rolling wheels", any(isinstance(joint, Mesh | Rolling) for joint in joints)),
        ("Sliders and slots", any(isinstance(joint, Guided) for joint in joints)),
        ("Four-bar linkages", bool(joints) and pinned and len(case.links) == 4),
        ("Linkages of more bars", len(case.links) > 4),
    )
    return next((kind for kind, is_so in tests if is_so), KINDS[-1])


def asked(known: Known) -> tuple[str, ...]:
    """What an exercise asks for."""
    names = [load.name for load in known.case.loads if is_unknown(load)]
    if known.posed:
        return (position_asked(known),)
    return (f"Find {listed(names)}.",) if names else _answers(known.as_asked)


def unreadable(name: str, source: str, reason: str) -> Exhibit:
    """A file that can't be read as a case."""
    return Exhibit(name, source, source, "unreadable", (), reason)


def _answers(known: Known) -> tuple[str, ...]:
    """What is found; of a case that asks for nothing but its motion or its forces, that."""
    found = tuple(found_sentences(known))
    if found or known.refusal is not None:
        return found
    asked = asked_without_unknown(known)
    return (f"Asked: {asked[0].lower()}{asked[1:].rstrip('.')}",)


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
.cards{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(19rem,100%),1fr));gap:1rem;padding:0}
.card{border:1px solid var(--line);border-radius:6px;padding:.9rem;display:flex;flex-direction:column}
.card img{width:100%;height:14rem;object-fit:contain;margin:.5rem 0}
.kinds{display:flex;flex-wrap:wrap;gap:.4em 1.2em;padding:0;list-style:none}
iframe{width:100%;height:54rem;border:1px solid var(--line);border-radius:6px}
.answer{font-weight:600}.bad{color:var(--bad);font-weight:600}.soft{color:var(--soft);font-size:.9rem}
.links{margin-top:auto;padding-top:.4em}.problem{white-space:pre-wrap}
@media print{.card{break-inside:avoid}}
"""


def index_html(exhibits: Sequence[Exhibit], title: str) -> str:
    """The page of a gallery, as one HTML file that loads its pictures and a page that moves, no more."""
    shown = [one for one in exhibits if one.status != "unreadable"]
    broken = [one for one in exhibits if one.status != "ok"]
    body = "".join((*_landing(shown), *_contents(broken), *_kinds(shown)))
    return html_page(title, STYLE, f"<p>{escaped(_count(exhibits))}</p>\n{body}")


def _count(exhibits: Sequence[Exhibit]) -> str:
    unread = sum(one.status == "unreadable" for one in exhibits)
    refused = sum(one.status != "ok" for one in exhibits) - unread
    words = [plural(len(exhibits), "case")]
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


def _landing(shown: Sequence[Exhibit]) -> Iterable[str]:
    """What this is, one figure that moves, and the kinds to choose from."""
    yield f"<p>{INTRODUCTION}</p>\n"
    moving = next((one for one in shown if one.moves), None)
    if moving is not None:
        title = escaped(moving.title)
        yield f'<iframe src="{_address(moving.name + PAGE)}" title="{title}, which can be moved"></iframe>\n'
    kinds = [kind for kind in KINDS if any(one.kind == kind for one in shown)]
    if len(kinds) > 1:
        links = "".join(f'<a href="#{_slug(kind)}">{kind}</a>\n' for kind in kinds)
        yield f'<nav class="kinds" aria-label="Kinds">\n{links}</nav>\n'


INTRODUCTION = (
    "Mechanisms with the force or torque that holds each in equilibrium, found by instant centres and the "
    "sum of power."
)


def _kinds(shown: Sequence[Exhibit]) -> Iterable[str]:
    """Cards by kinds of mechanisms."""
    for kind in KINDS:
        some = [one for one in shown if one.kind == kind]
        if some:
            yield f'<section id="{_slug(kind)}"><h2>{kind}</h2>\n<div class="cards">\n'
            yield from map(_card, some)
            yield "</div></section>\n"


def _slug(kind: str) -> str:
    return "kind-" + "-".join(kind.lower().replace(",", "").split())


def _card(one: Exhibit) -> str:
    figure = _address(one.name + FIGURE)
    page = _address(one.name + PAGE) if one.paged else figure
    links = f'<a href="{page}">Page and solution</a> · ' if one.paged else ""
    answers = "".join(f'<p class="answer">{escaped(sentence)}</p>\n' for sentence in one.answers)
    reason = f'<p class="bad">No answer ({one.status}): {escaped(one.reason)}</p>\n' if one.reason else ""
    lead = "".join(f'<p class="soft">{escaped(told)}</p>\n' for told in one.provenance)
    return (
        f'<article class="card" id="{_anchor(one)}"><h3>{escaped(one.title)}</h3>\n'
        f'<a href="{page}"><img src="{figure}" alt="{escaped(one.alt)}" loading="lazy"/></a>\n'
        f"{answers}{reason}{lead}"
        f'<p class="links">{links}<a href="{figure}">figure</a></p>\n'
        f'<p class="soft">{escaped(one.source)}</p></article>\n'
    )


def _address(path: str) -> str:
    """A path as an address, whatever bytes its name has."""
    return quote(os.fsencode(path))


def _anchor(one: Exhibit) -> str:
    """The id of a card."""
    return "case-" + quote(os.fsencode(one.name), safe="").replace("%", "_")
