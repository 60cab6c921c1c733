"""An exercise sheet as a LaTeX document: figures and questions, and the key behind them."""

from __future__ import annotations

from collections.abc import Sequence

from icsolve.draw import tikz
from icsolve.draw.figure import ASKED, drawn
from icsolve.draw.marks import Mark, kinds_of
from icsolve.draw.words import answer_sentences, position_sentences, reaction_sentences
from icsolve.explain.document import Block, Inline, words
from icsolve.explain.given import asked_section, figures_of, given_section, load_name
from icsolve.explain.typeset import AsTex, picture_tex
from icsolve.report.derivation.known import Known
from icsolve.tuples import NamedTuple
from icsolve.wording.sentences import provenance

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
    figures = figures_of(known, DIGITS)
    found = answer_sentences(known)
    if known.case.space is not None:
        from icsolve.explain.space import asked_in_space, given_in_space

        sections = (given_in_space(asked, figures), asked_in_space(asked, figures))
    elif known.structure:
        sections = (given_section(asked, figures), asked_section(known, figures))
        found = reaction_sentences(known)
    else:
        sections = (given_section(asked, figures), asked_section(asked, figures))
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
