"""What a gallery shows of one case."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from icsolve.case import Case
from icsolve.construction import Known, known_of
from icsolve.draw import Drawing, draw
from icsolve.draw.captions import answer_sentences, description
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
