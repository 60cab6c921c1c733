"""The centres: those that a joint shows at once, then each by the lines on which it must lie; and the
ratios of speeds that follow from their distances."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence

from icsolve.answer import Centre
from icsolve.case import Joint, Pair, is_named, pair_name
from icsolve.explain.document import Block, Inline, Items, Section, formula, words
from icsolve.explain.formula import (
    Expr,
    Name,
    Num,
    Quotient,
    RootOf,
    Spanned,
    Square,
    Sum,
    Trig,
    minus,
    product,
)
from icsolve.explain.given import Figures, centre_name, place_words, rate_name
from icsolve.explain.levers import difference, motion_name, place
from icsolve.explain.ropes import rope_ratio, screw_ratio
from icsolve.report.derivation.known import Known, joint_of_normal
from icsolve.report.derivation.ratios import Ratio, Ratios, Step, ratios_of
from icsolve.wording.joints import centre_words, normal_words
from icsolve.wording.sentences import link_words


def centre_sections(known: Known, figures: Figures, steps: Sequence[Step]) -> list[Section]:
    """Centres by inspection, and by construction in order."""
    first = [step.centre for step in steps if step.number == 0]
    later = [step for step in steps if step.number]
    sections = []
    if first:
        entries = tuple(tuple(_inspected(known, figures, centre)) for centre in first)
        sections.append(Section("Centres by inspection", (_count(known, len(steps)), Items(entries))))
    if later:
        entries = tuple(tuple(_constructed(known, figures, step.centre)) for step in later)
        said = words(
            "Three links have their three centres on one line (Aronhold and Kennedy). "
            "A centre lies where two such lines meet."
        )
        sections.append(Section("Centres by construction", (said, Items(entries, numbered=True))))
    return sections


def _count(known: Known, needed: int) -> Block:
    n = len(known.case.links)
    total = n * (n - 1) // 2
    these = (
        "all of them are"
        if needed == total
        else f"the answer needs {needed}, which {'is' if needed == 1 else 'are'}"
    )
    if total == 1:
        return words(f"The {n} links have 1 centre.")
    return words(f"The {n} links have {n}({n} - 1)/2 = {total} centres; {these} found here.")


def _inspected(known: Known, figures: Figures, centre: Centre) -> Iterable[Inline]:
    yield centre_name(known, centre.pair)
    yield f" {_is_at(figures, centre)}: {_why(known, centre)}"


def _is_at(figures: Figures, centre: Centre) -> str:
    place = place_words(figures, centre)
    return f"= {place}" if centre.kind == "at" else f"is {place}"


def _why(known: Known, centre: Centre) -> str:
    """Which joint shows a centre."""
    if centre.by == "given":
        return "given"
    for joint in known.case.joints:
        if set(centre.pair) <= set(joint.links):
            return centre_words(joint)
    return "the links that they are welded to show it"


def _constructed(known: Known, figures: Figures, centre: Centre) -> Iterable[Inline]:
    yield centre_name(known, centre.pair)
    yield f" {_is_at(figures, centre)}"
    if not centre.lines:
        yield ", from the loop equations of the whole mechanism"
        return
    lines = ordered_lines(known, centre)
    for n, line in enumerate(lines):
        yield ": on " if n == 0 else ", and on "
        if len(line) == 1:
            yield f"the {_normal(joint_of_normal(known.case.joints, lines, n))}"
        yield from _line(known, centre, line)


def ordered_lines(known: Known, centre: Centre) -> list[tuple[Pair, ...]]:
    """The lines of a centre with their ends by name, that through the frame's centres first."""
    lines = [tuple(sorted(line, key=lambda pair: pair_name(known.case, pair))) for line in centre.lines]
    return sorted(lines, key=lambda line: (len(line) < 2, [pair_name(known.case, pair) for pair in line]))


def _line(known: Known, centre: Centre, line: tuple[Pair, ...]) -> Iterable[Inline]:
    if len(line) == 1:
        (roller,) = {*line[0]} - {*centre.pair} or {""}
        if roller:  # a passive one
            yield ", on which "
            yield centre_name(known, known.pair(roller, centre.pair[0]))
            yield " and "
            yield centre_name(known, known.pair(roller, centre.pair[1]))
            yield f" lie (roller {roller} turns freely)"
        return
    links = sorted({link for pair in (*line, centre.pair) for link in pair}, key=known.case.links.index)
    yield "the line "
    yield centre_name(known, line[0])
    yield " "
    yield centre_name(known, line[1])
    yield f" (links {', '.join(links)})"


def _normal(joint: Joint | None) -> str:
    if joint is None or joint.at is None:
        return "common normal of the joint"
    what = normal_words(joint)
    hidden = not is_named(joint.at)
    return f"{what} of links {' and '.join(joint.links)}" if hidden else f"{what} at {joint.at}"


# --- ratios of speeds ------------------------------------------------------------------------------------


def ratio_section(known: Known, figures: Figures, ratios: Ratios) -> Iterable[Section]:
    """How the other links move beside the reference, where anything follows."""
    blocks = [block for ratio in ratios.ratios for block in _blocks(known, figures, ratios, ratio)]
    blocks += _carried(figures, ratios)
    if blocks:
        yield Section("Ratios of the speeds", tuple(blocks))


def _blocks(known: Known, figures: Figures, ratios: Ratios, ratio: Ratio) -> Iterable[Block]:
    if ratio.rope is not None:
        yield from rope_ratio(known, figures, ratios, ratio)
        return
    if ratio.screw is not None:
        yield from screw_ratio(known, figures, ratio)
        return
    own, other, common = (centre_name(known, pair) for pair in ratio.pairs)
    left = Quotient(motion_name(known, ratio.link), motion_name(known, ratio.of))
    value = figures.number(ratio.value)
    match ratio.kind:
        case "one":
            yield words(f"Links {ratio.of} and {ratio.link} are welded: they move as one.")
        case "alike":
            yield words("", common, f" is at infinity: links {ratio.of} and {ratio.link} turn alike.")
            yield formula(left, value)
        case "turns":
            yield words(
                "",
                common,
                f" is a point of links {ratio.of} and {ratio.link}, with one velocity; {_sense(ratio)}.",
            )
            yield from _distances(known, figures, (own, common, other), ratio)
            numbers = Quotient(*(_measured(known, figures, ratio, n) for n in (0, 1)))
            yield formula(left, _by_distances(known, ratio), _signed(numbers, ratio), value)
        case "slides":
            yield words(
                f"Link {ratio.link} slides, so all of it moves as ",
                common,
                f" does: {_heading(figures, ratios, ratio.link)}.",
            )
            yield from _distances(known, figures, (own, common), ratio)
            yield formula(left, _by_distances(known, ratio), figures.distance(ratio.value))
        case "drives":
            yield words(
                "",
                common,
                f" of link {ratio.link} moves as link {ratio.of}: {_heading(figures, ratios, ratio.of)}.",
            )
            yield from _distances(known, figures, (other, common), ratio)
            numbers = Quotient(Num("1"), _measured(known, figures, ratio, 1))
            yield formula(left, _by_distances(known, ratio), _signed(numbers, ratio), value)
        case "glides":
            yield from _gliding(known, figures, ratios, ratio, left)


def _measured(known: Known, figures: Figures, ratio: Ratio, n: int) -> Num:
    """The distance of the common centre from that of the other link (0) or of the link (1) with the frame."""
    return figures.number(math.dist(place(known, ratio.pairs[n]), place(known, ratio.pairs[2])))


def _sense(ratio: Ratio) -> str:
    if ratio.value > 0.0:
        return "it lies outside the other two centres, so both turn in one sense"
    return "it lies between the other two centres, so they turn in opposite senses"


def _heading(figures: Figures, ratios: Ratios, link: str) -> str:
    heading = figures.number(ratios.headings[link]).digits
    return f"at {heading} deg where the speed of link {ratios.reference} is positive"


def _signed(expression: Expr, ratio: Ratio) -> Expr:
    return minus(expression) if ratio.value < 0.0 else expression


def _distances(known: Known, figures: Figures, names: tuple[Name, ...], ratio: Ratio) -> Iterable[Block]:
    """The distance of the common centre from each of the others, from the coordinates."""
    pairs = dict(zip((centre_name(known, pair) for pair in ratio.pairs), ratio.pairs, strict=True))
    common = names[1]
    for end in (names[0], *names[2:]):
        a, b = place(known, pairs[end]), place(known, pairs[common])
        yield formula(Spanned(end, common), distance(figures, a, b), figures.distance(math.dist(a, b)))


def distance(figures: Figures, a: tuple[float, float], b: tuple[float, float]) -> Expr:
    """The root of the squares of the differences."""
    squares = tuple((1, Square(difference(figures, q, p))) for p, q in zip(a, b, strict=True))
    return RootOf(Sum(squares))


def _gliding(known: Known, figures: Figures, ratios: Ratios, ratio: Ratio, left: Expr) -> Iterable[Block]:
    """Two translations: their parts across the direction in which one slides on the other are equal."""
    centre = known.centre(*ratio.pairs[2])
    assert centre is not None
    along = (centre.place[0] + 90.0) % 180.0
    headings = [ratios.headings[link] for link in (ratio.of, ratio.link)]
    yield words(
        f"Link {ratio.of} slides at {figures.number(headings[0]).digits} deg, link {ratio.link} at "
        f"{figures.number(headings[1]).digits} deg, and each on the other along "
        f"{figures.number(along).digits} deg: "
        "across that direction they move alike."
    )
    sines = [Trig("sin", Sum(((1, figures.number(h)), (-1, figures.number(along))))) for h in headings]
    yield formula(left, Quotient(sines[0], sines[1]), figures.number(ratio.value))


def _carried(figures: Figures, ratios: Ratios) -> Iterable[Block]:
    """Ratios to the reference where they follow in several steps."""
    values: Mapping[str, Ratio] = {ratio.link: ratio for ratio in ratios.ratios}
    for ratio in ratios.ratios:
        if ratio.of == ratios.reference or values[ratio.of].kind == "one":
            continue
        yield words(
            f"So where {link_words(ratios.reference)} has 1, {link_words(ratio.link)} has "
            f"{figures.number(ratios.rates[ratio.of]).digits} x {figures.number(ratio.value).digits} = "
            f"{figures.number(ratios.rates[ratio.link]).digits}."
        )


def worked_speeds(known: Known, figures: Figures) -> Iterable[Section]:
    """The speeds from centre to centre where the case gives one: ratios, rates, v = w r of every point."""
    whole, case = known.whole, known.case
    given = next((motion.link for motion in case.motion if motion.speed is not None), None)
    if whole is None or whole.rates is None or whole.mobility != 1 or given is None:
        return
    moving = [link for link in case.links if link != case.ground and not known.rests(link)]
    ratios = ratios_of(known, sorted(moving, key=lambda link: link != given))
    if ratios is None:
        return
    yield from ratio_section(known, figures, ratios)
    reference = ratios.reference
    x, y, w = known.twists[reference]
    speed = w if known.turns(reference) else math.hypot(x, y)
    own = motion_name(known, reference)
    blocks: list[Block] = [words("So with ", own, " = ", _speed(known, figures, reference, speed), ":")]
    for ratio in ratios.ratios:
        before = ratios.rates[ratio.of] * speed
        numbers = product(figures.number(before), figures.number(ratio.value))
        result = _speed(known, figures, ratio.link, ratio.value * before)
        symbols = product(motion_name(known, ratio.of), _by_distances(known, ratio))
        blocks.append(formula(motion_name(known, ratio.link), symbols, numbers, result))
    blocks += _of_points(known, figures)
    yield Section("Speeds by centres", tuple(blocks))


def _by_distances(known: Known, ratio: Ratio) -> Expr:
    """A ratio of speeds by the distances of its centres."""
    tied = ratio.rope is not None or ratio.screw is not None
    if tied or (ratio.kind not in ("turns", "slides", "drives") and ratio.value != 1.0):
        return Quotient(motion_name(known, ratio.link), motion_name(known, ratio.of))
    own, other, common = (centre_name(known, pair) for pair in ratio.pairs)
    match ratio.kind:
        case "turns":
            return _signed(Quotient(Spanned(own, common), Spanned(other, common)), ratio)
        case "slides":
            return _signed(Spanned(own, common), ratio)
        case "drives":
            return _signed(Quotient(Num("1"), Spanned(other, common)), ratio)
    return Num("1")


def _speed(known: Known, figures: Figures, link: str, value: float) -> Expr:
    unit = "rad/s" if known.turns(link) else f"{known.case.units.length}/s"
    return figures.quantity(value, unit)


def _of_points(known: Known, figures: Figures) -> Iterable[Block]:
    """The speed of every point of a link that turns: its rate times the distance from its centre."""
    said: set[str] = set()
    for link in known.case.links:
        pair = known.pair(link, known.case.ground)
        centre = known.centre(*pair) if link in known.twists and known.turns(link) else None
        if centre is None or centre.kind != "at":
            continue
        own, rate = place(known, pair), abs(known.twists[link][2])
        for point in known.case.carries.get(link, ()):
            gap = math.dist(known.points[point], own) if point in known.points else 0.0
            if not is_named(point) or point in said or gap <= 1e-9 * known.size:
                continue
            said.add(point)
            arm = Spanned(centre_name(known, pair), Name(point))
            numbers = product(figures.number(rate), figures.number(gap))
            speed = figures.quantity(rate * gap, f"{known.case.units.length}/s")
            yield formula(Name("v", point), product(rate_name(link), arm), numbers, speed)
