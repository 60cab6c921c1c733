"""The page as one HTML document: its equation of power, its script and style sheet, and the policy that
lets nothing else run or load."""

from __future__ import annotations

import base64
import os
import re
from collections.abc import Iterable
from functools import cache
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from icsolve.case import is_link, is_named, told_links
from icsolve.draw.words import (
    answer_sentences,
    datum_name,
    datum_unit,
    figure_number,
    name_runs,
    position_sentences,
    step_sentence,
    unit_word,
)
from icsolve.explain.document import AsHtml, Document, Formula, formula
from icsolve.explain.formula import MATHML, OMEGA, Expr, Name, Num, Quotient, Sum, product
from icsolve.explain.worked import gain_names, load_name
from icsolve.page.fields import section
from icsolve.page.live import Live, why_presolved
from icsolve.page.model import forces_in_joints, gain_rows
from icsolve.page.motion import PageMotion
from icsolve.page.pictures import track_svg
from icsolve.page.poses import Array, exact, script_json
from icsolve.report.derivation.known import Acting, Known, acting_loads, resting
from icsolve.report.derivation.ratios import Step
from icsolve.tuples import NamedTuple
from icsolve.wording import escaped

if TYPE_CHECKING:
    from hashlib import sha256
else:  # what is written in C of it: the rest loads all of OpenSSL
    try:
        from _sha2 import sha256
    except ImportError:
        try:
            from _sha256 import sha256
        except ImportError:
            from hashlib import sha256


class PageEquation(NamedTuple):
    """The equation in MathML, its rows as names and units, and the columns behind them.

    ``rows``: for each known load what it exerts, its ratio of speeds (MathML both), the unit of that and of
    what it exerts; ``root`` is what the unknown load exerts, with its unit. Each of ``data`` has the force
    or torque that a load exerts, the ratio of its speed to that of the unknown, and the ``sign`` in front of
    it, in every position; ``gain`` is what a unit of the unknown exerts.
    """

    symbols: str
    ratio: str
    rows: tuple[tuple[str, str, str, str], ...]
    root: tuple[str, str]
    data: list[dict[str, Any]]
    sign: int
    gain: dict[str, Any]


def equation_of(known: Known, motion: PageMotion | None) -> PageEquation | None:
    """The equation of one unknown load and the known ones; None where it has no such simple form."""
    acting = acting_loads(known)
    unknown = [a for a in acting if a.unknown]
    others = [a for a in acting if not a.unknown]
    if motion is None or known.case.dynamic or len(unknown) != 1:
        return None
    if set(motion.shares) != {a.load.name for a in others}:
        return None
    root = unknown[0]
    signed = [(a.sign, product(exerted(a), speed_of(known, a))) for a in (*others, root)]
    symbols = _displayed(formula(Sum(tuple(signed)), Num("0")))
    over = [Quotient(speed_of(known, a), speed_of(known, root)) for a in others]
    solved: list[tuple[int, Expr]] = [
        (-a.sign * root.sign, product(exerted(a), ratio)) for a, ratio in zip(others, over, strict=True)
    ]
    ratio = _displayed(formula(exerted(root), Sum(tuple(solved)))) if solved else ""
    rows = motion.rows
    gain = root.sign * gain_rows(known, motion, root)[rows]
    data = [_term(known, motion, a, rows, gain) for a in others]
    shown = tuple(
        (_math(exerted(a)), _math(q), ratio_unit(known, root, a), unit_exerted(known, a))
        for a, q in zip(others, over, strict=True)
    )
    own = (_math(exerted(root)), unit_exerted(known, root))
    exerts = exact((root.sign * gain).tolist())
    return PageEquation(symbols, ratio, shown, own, data, root.sign, exerts)


def _term(known: Known, motion: PageMotion, acting: Acting, rows: slice, root: Array) -> dict[str, Any]:
    """A known load in every position: what it exerts, and its speed over that of the unknown.

    ``shares`` are in units of the loads themselves, ``root`` is what a unit of the unknown exerts, signed.
    """
    gain, sign = gain_rows(known, motion, acting)[rows], acting.sign
    with np.errstate(all="ignore"):
        ratio = motion.shares[acting.load.name][rows] * root / (sign * gain)
    size = exact((gain * (acting.value or 0.0)).tolist())
    return {"name": acting.load.name, "sign": sign, "size": size, "ratio": exact(ratio.tolist())}


def exerted(acting: Acting) -> Expr:
    """The force or torque of a load: of a mass its weight, of a spring its pull."""
    return product(load_name(acting.load.name), *gain_names(acting.load))


def unit_exerted(known: Known, acting: Acting) -> str:
    """Its unit."""
    return known.case.units.torque if acting.at is None else known.case.units.force


def _displayed(block: Formula) -> str:
    return f'<math display="block">{MATHML.equation(block.sides)}</math>'


def _math(expression: Expr) -> str:
    return f'<math displaystyle="true">{MATHML.expression(expression)}</math>'


def speed_of(known: Known, acting: Acting) -> Name:
    """The speed that a load works at: the rate of its link, or the speed of its point along it."""
    if acting.at is not None:
        return Name("v", acting.load.name)
    low = acting.link if acting.against == known.case.ground else f"{acting.link}/{acting.against}"
    return Name(OMEGA, low)


def ratio_unit(known: Known, root: Acting, of: Acting) -> str:
    """The unit of the ratio of speeds, in which the unit of a known load, times it, is the root's."""
    own, theirs = unit_exerted(known, root), unit_exerted(known, of)
    if own == theirs:
        return ""
    for one, other, form in ((own, theirs, "{}"), (theirs, own, "1/{}")):
        parts = one.split("*")
        if other in parts and len(parts) == 2:
            parts.remove(other)
            return form.format(parts[0])
    return f"{own}/{theirs}" if "*" not in theirs and "/" not in theirs else f"{own}/({theirs})"


# --- script, style sheet and policy ----------------------------------------------------------------------


def _file(*names: str) -> str:
    """A file of this room."""
    with open(os.path.join(os.path.dirname(__file__), *names), encoding="utf-8") as file:
        return file.read()


NAMES = "data digits scene rest live moving centres labels words position construction turn fields see"
PARTS = NAMES.split()
"""The parts of the script, in the order in which they run: each uses those before it."""
SIGNS = "=> === !== && || <= >= += ** = * < > : + - / ? %".split()
CLOSED = (
    (", ", ","),
    ("; ", ";"),
    ("{ ", "{"),
    (" }", "}"),
    (") {", "){"),
    (" : ", ":"),
    (": ", ":"),
    (") return", ")return"),
    ("const [", "const["),
    ("const {", "const{"),
    ("if (", "if("),
    ("for (", "for("),
    *((f" {sign} ", sign) for sign in SIGNS),
)
"""What a script is as well without."""
OPEN_ENDS = ("{", ";", ",")
"""After these no line need end."""


@cache
def _parts() -> str:
    """What is the same in the script of every page, without its comments and indents, and without spaces
    about signs outside of strings, in lines that have no templates or expressions of their own; nor have
    these ends where they need none, and the last statement of a block no semicolon."""
    text = re.sub(r"\s+// .*", "", "".join(_file("script", f"{part}.js") for part in PARTS))
    lines = re.sub(r"^\s*/\*.*?\*/\s*|^\s+", "", text, flags=re.MULTILINE | re.DOTALL).split("\n")
    plain = [n for n, s in enumerate(lines) if not any(c in s.replace(" / ", "") for c in "'`/\\")]
    pieces = "\n".join([lines[n] for n in plain]).split('"')
    for k in range(0, len(pieces), 2):
        for spaced, closed in CLOSED:
            pieces[k] = pieces[k].replace(spaced, closed)
    for n, line in zip(plain, '"'.join(pieces).split("\n"), strict=True):
        lines[n] = line
    last = {n for n, (line, after) in enumerate(pairwise(lines)) if line.endswith(";") and after[:1] == "}"}
    pieces = [line if line.endswith(OPEN_ENDS) else f"{line}\n" for line in lines]
    return "".join(line[:-1] if n in last else line for n, line in enumerate(pieces))


def script(live: Live | None) -> str:
    """The script of a page, with the program of its scene where it has one."""
    program = "" if live is None else live.source
    return f'"use strict";\n(() => {{\n{program}{_parts()}}})();\n'


@cache
def style() -> str:
    """The style sheet of the page around the pictures."""
    return _file("page.css")


def policy(styles: str, scripts: str) -> str:
    """A Content-Security-Policy: this script and these styles, no network, no frames, no forms."""
    return (
        f"default-src 'none'; script-src '{_hash(scripts)}'; style-src '{_hash(styles)}'; "
        "base-uri 'none'; form-action 'none'"
    )


def _hash(text: str) -> str:
    return "sha256-" + base64.b64encode(sha256(text.encode()).digest()).decode()


# --- the document ----------------------------------------------------------------------------------------


FEW = 4
"""With so many steps at most there is room for the equation of power beside the figure."""


class PageParts(NamedTuple):
    """All that a page shows; ``still`` says why nothing moves ('' where it does)."""

    known: Known
    steps: tuple[Step, ...]
    figure: str
    circle: str
    plots: tuple[tuple[str, str], ...]
    equation: PageEquation | None
    solution: Document
    still: str
    model: dict[str, Any]
    sheet: str
    live: Live | None = None


def html_of(parts: PageParts) -> str:
    """The whole document."""
    styles = style() + parts.sheet
    title = escaped(parts.known.title)
    body = "\n".join(part for part in _body(parts) if part)
    scripts = script(parts.live)
    allowed = policy(styles, scripts)
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f"<!-- For a server that sends its own policy: {allowed} -->\n"
        f'<meta http-equiv="Content-Security-Policy" content="{escaped(allowed)}">\n'
        '<meta name="viewport" content="width=device-width,initial-scale=1">\n'
        f"<title>{title}</title>\n<style>{styles}</style>\n</head>\n<body>\n<main>\n{body}\n</main>\n"
        f'<script type="application/json" id="data">{script_json(parts.model)}</script>\n'
        f"<script>{scripts}</script>\n</body>\n</html>\n"
    )


def _body(parts: PageParts) -> Iterable[str]:
    known, case = parts.known, parts.known.case
    yield f"<header><h1>{escaped(known.title)}</h1>"
    if case.source:
        yield f'<p class="source">{escaped(case.source)}</p>'
    if case.reconstructed:
        yield f'<p class="remark"><strong>Reconstructed:</strong> {escaped(case.reconstructed)}</p>'
    if known.refusal is not None:
        status, message = escaped(known.refusal.status), escaped(known.refusal.message)
        yield f'<p class="remark"><strong>No answer ({status}):</strong> {message}</p>'
    yield '<noscript><p class="remark">Without JavaScript the figure stands still.</p></noscript>'
    yield '</header>\n<div class="panels">'
    construction, power = _construction(parts), _power(parts)
    short = bool(construction) and _count(parts) <= FEW
    beside = (section(known) if parts.live is not None else "") + construction
    yield '<div class="column">' if beside else '<div class="column wide">'
    yield _stage(parts)
    yield _see(parts)
    yield "" if short else power
    yield "</div>"
    yield f'<div class="column">{beside}{power if short else ""}</div>' if beside else ""
    yield _plots(parts)
    yield _solution(parts)
    yield "</div>"


def _stage(parts: PageParts) -> str:
    """The figure, the answer, and the slider."""
    return "\n".join(
        part
        for part in (
            '<section aria-label="Figure">',
            parts.figure,
            _answers(parts),
            _controls(parts) if "motion" in parts.model else "",
            f'<p class="hint still">{escaped(parts.still)}</p>' if parts.still else "",
            "" if parts.live is not None else f'<p class="hint presolved">{why_presolved(parts.known)}</p>',
            _step_buttons(parts),
            "</section>",
        )
        if part
    )


def _see(parts: PageParts) -> str:
    """What can be shown in the figure besides, each by a box to tick."""
    case, live = parts.known.case, parts.live is not None
    links = [link for link in told_links(case) if link != case.ground and is_link(link)]
    links = links if live else list(parts.model.get("forces", {}).get("links", ()))
    seen = bool(links) and not parts.known.structure
    moving = [name for name in parts.model.get("motion", {"points": ()})["points"] if is_named(name)]

    def boxes(what: str, kind: str, names: Iterable[str]) -> str:
        some = (f'<label><input type="checkbox" data-{kind}="{n}">{n}</label>' for n in map(escaped, names))
        return f'<span class="what">{what}</span> {" ".join(some)}'

    rows = [
        '<label><input type="checkbox" id="see-velocities">velocities of the points</label>' if seen else "",
        boxes("rotation about its centre of link", "rotation", links) if seen else "",
        boxes("path of point", "curve", moving) if seen and moving else "",
        boxes("centrodes of link", "centrode", links) if seen and moving else "",
        '<label for="see-body" class="what">forces on link</label> <select id="see-body"><option value="">'
        f"none</option>{''.join(f'<option>{escaped(n)}</option>' for n in links)}</select>"
        if links
        else "",
    ]
    if not any(rows):
        return ""
    items = "".join(f"<li>{row}</li>" for row in rows if row)
    return (
        f'<section aria-label="Show" id="see"><h2>Show</h2><ul class="lines boxes">{items}</ul>\n'
        '<p class="hint" id="see-hint"></p>\n'
        '<div id="body-panel" hidden><svg class="ic" id="body-figure" viewBox="0 40 600 220" role="img" '
        'aria-label="Free body and force polygon"></svg>\n<p id="body-said" aria-live="polite"></p></div>'
        "</section>"
    )


def _answers(parts: PageParts) -> str:
    """Each unknown load with its value, kept up to date by the script."""
    if parts.known.answer is None:
        return ""
    known, answer = parts.known, parts.known.answer
    told: list[tuple[str, str, str, float | None]] = [
        (name, _name(name), sentence.removeprefix(name), answer.answers[name].value)
        for name, sentence in zip(answer.answers, answer_sentences(known), strict=True)
    ]
    here = resting(known)
    for path, value in {} if here is None else here.at.items():
        ends = (value,) if isinstance(value, float) else value
        said = " to ".join(f"{figure_number(end)}{datum_unit(known, path)}" for end in ends)
        said += f", {here.stability}" if here is not None and here.stability else ""
        told.append((path, datum_name(path), f" = {said}", ends[0] if len(ends) == 1 else None))
    for name, _, size, way in forces_in_joints(known):
        said = f" = {figure_number(size)} {unit_word(known.case.units.force)}" + (f", {way}" if way else "")
        told.append((name, _name(name), said, size))
    items = "".join(
        f'<li id="answer-{escaped(name)}" data-answer="{escaped(name)}" '
        f'data-value="{"" if value is None else repr(value)}" '
        f'data-status="{answer.status}"><span>{shown}</span><span>{escaped(sentence)}</span></li>'
        for name, shown, sentence, value in told
    )
    every = position_sentences(known)
    more = f'<p class="hint">As written it rests where {escaped("; ".join(every))}.</p>' if every[1:] else ""
    return f'<ul class="answers" id="answers" aria-live="polite">{items}</ul>{more}'


def _name(name: str) -> str:
    runs = ((escaped(run.text), run.low) for run in name_runs(name))
    return "".join(f"<sub>{text}</sub>" if low else text for text, low in runs)


def _controls(parts: PageParts) -> str:
    motion = parts.model["motion"]
    driver = escaped(motion["driver"])
    last = motion["first"] + motion["step"] * (motion["rows"] - 0.5)
    endless = "" if motion["verb"] == "turned" else '<p class="hint">The case gives the guides no ends.</p>\n'
    gap = motion["low"] < motion["first"] or motion["high"] > last
    keys = '<span class="k-dead">dead centre</span>' if motion["dead"] else ""
    keys += f'<span class="k-gap">{motion["ends"]}</span>' if gap else ""
    return (
        f'<p class="turn"><label for="turn">Link {driver} {motion["verb"]}:</label> '
        '<output id="angle" for="turn">as written</output></p>\n'
        f'<div class="slider"><input type="range" id="turn" min="{motion["low"]}" max="{motion["high"]}"'
        f' step="{motion["step"]}" value="0" autocomplete="off">{track_svg(motion)}</div>\n'
        + (f'<p class="key">{keys}</p>\n' if keys else "")
        + endless
        + '<p class="hint" id="hint" role="status"></p>\n<div id="inputs" class="row"></div>\n'
        '<div class="row"><button type="button" id="play">Play</button>'
        '<button type="button" id="written">As written</button></div>'
    )


def _step_buttons(parts: PageParts) -> str:
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


def _count(parts: PageParts) -> int:
    """How many centres are found by construction."""
    return max((step.number for step in parts.steps), default=0)


def _construction(parts: PageParts) -> str:
    """The circle diagram, and all steps as buttons."""
    if not parts.steps:
        return ""
    items = "".join(
        f'<li><button type="button" data-step="{n}">{escaped(_sentence(parts, n))}</button></li>'
        for n in range(_count(parts) + 1)
    )
    return (
        '<section aria-label="Order of finding"><h2>Order of finding</h2>\n'
        f'<div class="circle">{parts.circle}</div>\n<ol class="steps">{items}</ol></section>'
    )


def _sentence(parts: PageParts, n: int) -> str:
    if n:
        return _unbroken(step_sentence(parts.known, parts.steps, n))
    first = [step.centre.pair for step in parts.steps if step.number == 0]
    names = ", ".join(f"I{a}-{b}" for a, b in first)
    return _unbroken(f"By inspection: {names}.") if names else "No centre is found by inspection."


def _unbroken(sentence: str) -> str:
    """A sentence in which no name of a centre breaks over two lines."""
    return re.sub(r"(?<=\w)-(?=\w)", "\N{NON-BREAKING HYPHEN}", sentence)


def _power(parts: PageParts) -> str:
    """The equation of power, and a table of its terms."""
    equation, known = parts.equation, parts.known
    if known.answer is None:
        return ""
    if equation is None:
        return _power_of_motions(parts)
    rows = ""
    unit_of_all = escaped(unit_word(equation.root[1]))
    for n, (symbol, ratio, unit, own) in enumerate(equation.rows):
        rows += (
            f'<tr><td>{symbol}</td><td><span id="size-{n}"></span> {escaped(unit_word(own))}</td>'
            f'<td>{ratio} = <span id="ratio-{n}"></span> {escaped(unit_word(unit))}</td>'
            f'<td><span id="product-{n}"></span> {unit_of_all}</td></tr>'
        )
    total = f'<span id="root-product"></span> {unit_of_all}'
    less = "minus their sum" if equation.sign > 0 else "their sum"
    heads = "".join(f'<th scope="col">{word}</th>' for word in ("Load", "Size", "Ratio of speeds", "Product"))
    return (
        '<section aria-label="Power"><h2>The sum of the powers is zero</h2>\n'
        f"{equation.symbols}\n{equation.ratio}\n"
        f'<div class="scroll"><table><thead><tr>{heads}</tr></thead><tbody>{rows}'
        f'<tr class="sum"><td>{equation.root[0]}</td><td></td><td>{less}</td><td>{total}</td></tr>'
        "</tbody></table></div></section>"
    )


def _power_of_motions(parts: PageParts) -> str:
    """The equation of power of each motion of a live case with several freedoms, which the script writes."""
    drivers = parts.model["live"]["drivers"] if parts.live is not None else []
    items = ""
    for n, driver in enumerate(drivers):
        held = escaped(" and ".join(f"link {other}" for other in drivers if other != driver))
        items += (
            f"<h3>Motion {n + 1}: link {escaped(driver)} turns at 1 rad/s counterclockwise, {held} held"
            f'</h3><p class="scroll" id="motion-{n}"></p>'
        )
    return f'<section aria-label="Power"><h2>The sum of the powers is zero</h2>{items}</section>' * bool(
        items
    )


def _plots(parts: PageParts) -> str:
    if not parts.plots:
        return ""
    items = "".join(
        f'<div class="plot"><h2>{escaped(heading)}</h2>{picture}</div>' for heading, picture in parts.plots
    )
    return f'<section class="wide" aria-label="Plots"><div class="pair">{items}</div></section>'


def _solution(parts: PageParts) -> str:
    """The worked solution of the position as written."""
    opened = "" if "motion" in parts.model else " open"
    return (
        f'<details class="wide"{opened}><summary>The worked solution, in the position as written</summary>\n'
        f"{AsHtml().sections(parts.solution)}</details>"
    )
