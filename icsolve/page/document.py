"""The page as one HTML document."""

from __future__ import annotations

import re
from collections.abc import Iterable
from html import escape
from typing import Any, NamedTuple

from icsolve.construction import Known, Step
from icsolve.draw.captions import answer_sentences, step_sentence
from icsolve.draw.words import figure_number, name_runs, unit_word
from icsolve.explain.as_html import sections_html
from icsolve.explain.document import Document
from icsolve.page.columns import script_json
from icsolve.page.equation import Equation
from icsolve.page.pictures import track_svg
from icsolve.page.sheets import policy, script, style
from icsolve.wording.senses import unit_of

FEW = 4
"""With so many steps at most there is room for the equation of power beside the figure."""


class Parts(NamedTuple):
    """All that a page shows; ``still`` says why nothing moves ('' where it does)."""

    known: Known
    steps: tuple[Step, ...]
    figure: str
    circle: str
    plots: tuple[tuple[str, str], ...]
    equation: Equation | None
    solution: Document
    still: str
    model: dict[str, Any]
    sheet: str


def html_of(parts: Parts) -> str:
    """The whole document."""
    styles = style() + parts.sheet
    title = escape(_clean(parts.known.title))
    body = "\n".join(part for part in _body(parts) if part)
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{escape(policy(styles))}">\n'
        '<meta name="viewport" content="width=device-width,initial-scale=1">\n'
        f"<title>{title}</title>\n<style>{styles}</style>\n</head>\n<body>\n<main>\n{body}\n</main>\n"
        f'<script type="application/json" id="data">{script_json(parts.model)}</script>\n'
        f"<script>{script()}</script>\n</body>\n</html>\n"
    )


def _clean(text: str) -> str:
    """A text without characters that HTML has no way to write."""
    return "".join(c if c.isprintable() or c in "\t\n" else "\N{REPLACEMENT CHARACTER}" for c in text)


def _text(text: str) -> str:
    return escape(_clean(text))


def _body(parts: Parts) -> Iterable[str]:
    known, case = parts.known, parts.known.case
    yield f"<header><h1>{_text(known.title)}</h1>"
    if case.source:
        yield f'<p class="source">{_text(case.source)}</p>'
    if case.reconstructed:
        yield f'<p class="remark"><strong>Reconstructed:</strong> {_text(case.reconstructed)}</p>'
    if known.refusal is not None:
        status, message = _text(known.refusal.status), _text(known.refusal.message)
        yield f'<p class="remark"><strong>No answer ({status}):</strong> {message}</p>'
    yield '<noscript><p class="remark">Without JavaScript the figure stands still.</p></noscript>'
    yield '</header>\n<div class="panels">'
    construction, power = _construction(parts), _power(parts)
    short = bool(construction) and _count(parts) <= FEW
    yield '<div class="column">' if construction else '<div class="column wide">'
    yield _stage(parts)
    yield "" if short else power
    yield "</div>"
    yield f'<div class="column">{construction}{power if short else ""}</div>' if construction else ""
    yield _plots(parts)
    yield _solution(parts)
    yield "</div>"


def _stage(parts: Parts) -> str:
    """The figure, the answer, and the slider."""
    return "\n".join(
        part
        for part in (
            '<section aria-label="Figure">',
            parts.figure,
            _answers(parts),
            _controls(parts) if "motion" in parts.model else "",
            f'<p class="hint still">{_text(parts.still)}</p>' if parts.still else "",
            _step_buttons(parts),
            "</section>",
        )
        if part
    )


def _answers(parts: Parts) -> str:
    """Each unknown load with its value, kept up to date by the script."""
    if parts.known.answer is None:
        return ""
    sentences = answer_sentences(parts.known)
    names = list(parts.known.answer.answers)
    items = "".join(
        f'<li data-answer="{_text(name)}"><span>{_name(name)}</span>'
        f"<span>{_text(sentence.removeprefix(name))}</span></li>"
        for name, sentence in zip(names, sentences, strict=True)
    )
    return f'<ul class="answers" id="answers" aria-live="polite">{items}</ul>'


def _name(name: str) -> str:
    return "".join(f"<sub>{_text(run.text)}</sub>" if run.low else _text(run.text) for run in name_runs(name))


def _controls(parts: Parts) -> str:
    motion = parts.model["motion"]
    driver = _text(motion["driver"])
    last = motion["first"] + motion["step"] * (motion["rows"] - 0.5)
    endless = "" if motion["verb"] == "turned" else '<p class="hint">The case gives the guides no ends.</p>\n'
    gap = motion["low"] < motion["first"] or motion["high"] > last
    keys = '<span class="k-dead">dead centre</span>' if motion["dead"] else ""
    keys += '<span class="k-gap">the links do not meet</span>' if gap else ""
    return (
        f'<label class="turn" for="turn">Link {driver} {motion["verb"]}: '
        '<output id="angle">as written</output></label>\n'
        f'<div class="slider"><input type="range" id="turn" min="{motion["low"]}" max="{motion["high"]}"'
        f' step="{motion["step"]}" value="0" autocomplete="off">{track_svg(motion)}</div>\n'
        + (f'<p class="key">{keys}</p>\n' if keys else "")
        + endless
        + '<p class="hint" id="hint" role="status"></p>\n'
        '<div class="row"><button type="button" id="play">Play</button>'
        '<button type="button" id="written">As written</button></div>'
    )


def _step_buttons(parts: Parts) -> str:
    """The construction a step at a time, beside the figure; the script says which step it is."""
    if not _count(parts):
        return ""
    buttons = (("from-start", "First"), ("back", "Back"), ("next", "Next"), ("whole", "All"))
    row = "".join(f'<button type="button" id="{name}">{word}</button>' for name, word in buttons)
    return (
        '<h2 class="part">Construction</h2>\n'
        f'<div class="row" role="group" aria-label="Steps of the construction">{row}</div>\n'
        '<p class="said" id="said" aria-live="polite">All centres that the answer needs.</p>'
    )


def _count(parts: Parts) -> int:
    """How many centres are found by construction."""
    return max((step.number for step in parts.steps), default=0)


def _construction(parts: Parts) -> str:
    """The circle diagram, and all steps as buttons."""
    if not parts.steps:
        return ""
    items = "".join(
        f'<li><button type="button" data-step="{n}">{_text(_sentence(parts, n))}</button></li>'
        for n in range(_count(parts) + 1)
    )
    return (
        '<section aria-label="Order of finding"><h2>Order of finding</h2>\n'
        f'<div class="circle">{parts.circle}</div>\n<ol class="steps">{items}</ol></section>'
    )


def _sentence(parts: Parts, n: int) -> str:
    if n:
        return _unbroken(step_sentence(parts.known, parts.steps, n))
    first = [step.centre.pair for step in parts.steps if step.number == 0]
    names = ", ".join(f"I{a}-{b}" for a, b in first)
    return _unbroken(f"By inspection: {names}.") if names else "No centre is found by inspection."


def _unbroken(sentence: str) -> str:
    """A sentence in which no name of a centre breaks over two lines."""
    return re.sub(r"(?<=\w)-(?=\w)", "\N{NON-BREAKING HYPHEN}", sentence)


def _power(parts: Parts) -> str:
    """The equation of power, and a table of its terms."""
    equation, known = parts.equation, parts.known
    if equation is None or known.answer is None:
        return ""
    (name,) = known.answer.answers
    units = {load.name: _text(unit_word(unit_of(load, known.case))) for load in known.case.loads}
    rows = ""
    for n, ((symbol, ratio, unit), term) in enumerate(zip(equation.rows, equation.data, strict=True)):
        size = f"{figure_number(float(term['value']), 6)} {units[term['name']]}"
        rows += (
            f'<tr><td>{symbol}</td><td>{size}</td><td>{ratio} = <span id="ratio-{n}"></span> '
            f'{_text(unit_word(unit))}</td><td><span id="product-{n}"></span> {units[name]}</td></tr>'
        )
    total = f'<span id="root-product"></span> {units[name]}'
    heads = "".join(f"<th>{word}</th>" for word in ("Load", "Size", "Ratio of speeds", "Product"))
    return (
        '<section aria-label="Power"><h2>The sum of the powers is zero</h2>\n'
        f"{equation.symbols}\n{equation.ratio}\n"
        f'<div class="scroll"><table><thead><tr>{heads}</tr></thead><tbody>{rows}'
        f'<tr class="sum"><td>{_name(name)}</td><td></td><td>minus their sum</td><td>{total}</td></tr>'
        "</tbody></table></div></section>"
    )


def _plots(parts: Parts) -> str:
    if not parts.plots:
        return ""
    items = "".join(
        f'<div class="plot"><h2>{_text(heading)}</h2>{picture}</div>' for heading, picture in parts.plots
    )
    return f'<section class="wide" aria-label="Plots"><div class="pair">{items}</div></section>'


def _solution(parts: Parts) -> str:
    """The worked solution of the position as written."""
    opened = "" if "motion" in parts.model else " open"
    return (
        f'<details class="wide"{opened}><summary>The worked solution, in the position as written</summary>\n'
        f"{sections_html(parts.solution)}</details>"
    )
