"""The centres: those that a joint shows at once, then each by the lines on which it must lie; and the
ratios of speeds that follow from their distances."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence

from icsolve.answer import Centre
from icsolve.case import Pair, is_named, pair_name, told_links
from icsolve.explain.document import Block, Inline, Items, Section, formula, words
from icsolve.explain.formula import Expr, Name, Num, Of, Quotient, Spanned, Sum, minus, product
from icsolve.explain.ropes import rope_ratio, screw_ratio
from icsolve.explain.worked import Worked, rate_name
from icsolve.report.derivation.known import Known
from icsolve.report.derivation.ratios import Ratio, Ratios, Step, ratios_of
from icsolve.wording import link_words
from icsolve.wording.joints import centre_words, joint_of_normal, normal_name


def centre_sections(work: Worked, steps: Sequence[Step]) -> list[Section]:
    """Centres by inspection, and by construction in order."""
    first = [step.centre for step in steps if step.number == 0]
    later = [step for step in steps if step.number]
    sections = []
    entries: tuple[tuple[Inline, ...], ...]
    if first:
        told = ((c, f" {_is_at(work, c)}: {_why(work.known, c)}") for c in first)
        entries = tuple((work.centre_name(centre.pair), words) for centre, words in told)
        sections.append(Section("Centres by inspection", (_count(work.known, len(steps)), Items(entries))))
    if later:
        entries = tuple(tuple(_constructed(work, step.centre)) for step in later)
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


def _is_at(work: Worked, centre: Centre) -> str:
    place = work.centre_words(centre)
    return f"= {place}" if centre.kind == "at" else f"is {place}"


def _why(known: Known, centre: Centre) -> str:
    """Which joint shows a centre."""
    if centre.by == "given":
        return "given"
    for joint in known.case.joints:
        if set(centre.pair) <= set(joint.links):
            return centre_words(joint)
    return "the links that they are welded to show it"


def _constructed(work: Worked, centre: Centre) -> Iterable[Inline]:
    yield work.centre_name(centre.pair)
    yield f" {_is_at(work, centre)}"
    if not centre.lines:
        yield ", from the loop equations of the whole mechanism"
        return
    lines = ordered_lines(work.known, centre)
    if len(lines) == 1 and len(lines[0]) > 1:
        one, other = map(work.centre_name, lines[0])
        yield from (": ", one, " and ", other, " lie in one place, and it does with them")
        return
    for n, line in enumerate(lines):
        yield ": on " if n == 0 else ", and on "
        if len(line) == 1:
            yield f"the {normal_name(joint_of_normal(work.case, lines, n))}"
        yield from _line(work, centre, line)


def ordered_lines(known: Known, centre: Centre) -> list[tuple[Pair, ...]]:
    """The lines of a centre with their ends by name, that through the frame's centres first."""
    lines = [tuple(sorted(line, key=lambda pair: pair_name(known.case, pair))) for line in centre.lines]
    return sorted(lines, key=lambda line: (len(line) < 2, [pair_name(known.case, pair) for pair in line]))


def _line(work: Worked, centre: Centre, line: tuple[Pair, ...]) -> Iterable[Inline]:
    if len(line) == 1:
        (roller,) = {*line[0]} - {*centre.pair} or {""}
        if roller:  # a passive one
            yield ", on which "
            yield work.centre_name(work.known.pair(roller, centre.pair[0]))
            yield " and "
            yield work.centre_name(work.known.pair(roller, centre.pair[1]))
            yield f" lie (roller {roller} turns freely)"
        return
    links = sorted({link for pair in (*line, centre.pair) for link in pair}, key=work.case.links.index)
    yield "the line "
    yield work.centre_name(line[0])
    yield " "
    yield work.centre_name(line[1])
    yield f" (links {', '.join(links)})"


# --- ratios of speeds ------------------------------------------------------------------------------------


RATIOS = "Ratios of the speeds"


def ratio_section(work: Worked, ratios: Ratios) -> Iterable[Section]:
    """How the other links move beside the reference, where anything follows."""
    blocks = [block for ratio in ratios.ratios for block in _blocks(work, ratios, ratio)]
    blocks += _carried(work, ratios)
    if blocks:
        yield Section(RATIOS, tuple(blocks))


def _blocks(work: Worked, ratios: Ratios, ratio: Ratio) -> Iterable[Block]:
    if ratio.rope is not None:
        yield from rope_ratio(work, ratios, ratio)
        return
    if ratio.screw is not None:
        yield from screw_ratio(work, ratio)
        return
    own, other, common = (work.centre_name(pair) for pair in ratio.pairs)
    left = Quotient(work.motion_name(ratio.link), work.motion_name(ratio.of))
    value = work.number(ratio.value)
    match ratio.kind:
        case "one":
            yield words(f"Links {ratio.of} and {ratio.link} are welded: they move as one.")
        case "alike":
            yield words(common, f" is at infinity: links {ratio.of} and {ratio.link} turn alike.")
            yield formula(left, value)
        case "turns":
            yield words(
                common,
                f" is a point of links {ratio.of} and {ratio.link}, with one velocity; {_sense(ratio)}.",
            )
            yield from _distances(work, (own, common, other), ratio)
            numbers = Quotient(*(_measured(work, ratio, n) for n in (0, 1)))
            yield formula(left, _by_distances(work, ratio), _signed(numbers, ratio), value)
        case "slides":
            yield words(
                f"Link {ratio.link} slides, so all of it moves as ",
                common,
                f" does: {_heading(work, ratios, ratio.link)}.",
            )
            yield from _distances(work, (own, common), ratio)
            yield formula(left, _by_distances(work, ratio), work.distance(ratio.value))
        case "drives":
            both = [link_words(link) for link in (ratio.link, ratio.of)]
            yield words(common, f" of {both[0]} moves as {both[1]}: {_heading(work, ratios, ratio.of)}.")
            yield from _distances(work, (other, common), ratio)
            numbers = Quotient(Num("1"), _measured(work, ratio, 1))
            yield formula(left, _by_distances(work, ratio), _signed(numbers, ratio), value)
        case "glides":
            yield from _gliding(work, ratios, ratio, left)


def _measured(work: Worked, ratio: Ratio, n: int) -> Num:
    """The distance of the common centre from that of the other link (0) or of the link (1) with the frame."""
    return work.number(math.dist(work.place(ratio.pairs[n]), work.place(ratio.pairs[2])))


def _sense(ratio: Ratio) -> str:
    if ratio.value > 0.0:
        return "it lies outside the other two centres, so both turn in one sense"
    return "it lies between the other two centres, so they turn in opposite senses"


def _heading(work: Worked, ratios: Ratios, link: str) -> str:
    heading = work.show(ratios.headings[link])
    return f"at {heading} deg where the speed of {link_words(ratios.reference)} is positive"


def _signed(expression: Expr, ratio: Ratio) -> Expr:
    return minus(expression) if ratio.value < 0.0 else expression


def _distances(work: Worked, names: tuple[Name, ...], ratio: Ratio) -> Iterable[Block]:
    """The distance of the common centre from each of the others, from the coordinates."""
    pairs = dict(zip((work.centre_name(pair) for pair in ratio.pairs), ratio.pairs, strict=True))
    common = names[1]
    for end in (names[0], *names[2:]):
        a, b = work.place(pairs[end]), work.place(pairs[common])
        yield formula(Spanned(end, common), distance(work, a, b), work.distance(math.dist(a, b)))


def distance(work: Worked, a: tuple[float, float], b: tuple[float, float]) -> Expr:
    """The root of the squares of the differences."""
    squares = tuple((1, Of("square", work.difference(q, p))) for p, q in zip(a, b, strict=True))
    return Of("sqrt", Sum(squares))


def _gliding(work: Worked, ratios: Ratios, ratio: Ratio, left: Expr) -> Iterable[Block]:
    """Two translations: their parts across the direction in which one slides on the other are equal."""
    centre = work.known.centre(*ratio.pairs[2])
    assert centre is not None
    along = (centre.place[0] + 90.0) % 180.0
    headings = [ratios.headings[link] for link in (ratio.of, ratio.link)]
    yield words(
        f"Link {ratio.of} slides at {work.show(headings[0])} deg, link {ratio.link} at "
        f"{work.show(headings[1])} deg, and each on the other along "
        f"{work.show(along)} deg: "
        "across that direction they move alike."
    )
    sines = [Of("sin", Sum(((1, work.number(h)), (-1, work.number(along))))) for h in headings]
    yield formula(left, Quotient(sines[0], sines[1]), work.number(ratio.value))


def _carried(work: Worked, ratios: Ratios) -> Iterable[Block]:
    """Ratios to the reference where they follow in several steps."""
    values: Mapping[str, Ratio] = {ratio.link: ratio for ratio in ratios.ratios}
    for ratio in ratios.ratios:
        if ratio.of == ratios.reference or values[ratio.of].kind == "one":
            continue
        yield words(
            f"So where {link_words(ratios.reference)} has 1, {link_words(ratio.link)} has "
            f"{work.show(ratios.rates[ratio.of])} x {work.show(ratio.value)} = "
            f"{work.show(ratios.rates[ratio.link])}."
        )


def worked_speeds(work: Worked) -> Iterable[Section]:
    """The speeds from centre to centre where the case gives one: ratios, rates, v = w r of every point."""
    whole, case = work.known.whole, work.case
    given = next((motion.link for motion in case.motion if motion.speed is not None), None)
    if whole is None or whole.rates is None or whole.mobility != 1 or given is None:
        return
    moving = [link for link in told_links(case) if link != case.ground and not work.known.rests(link)]
    ratios = ratios_of(work.known, sorted(moving, key=lambda link: link != given))
    if ratios is None:
        return
    yield from ratio_section(work, ratios)
    reference = ratios.reference
    x, y, w = work.known.twists[reference]
    speed = w if work.known.turns(reference) else math.hypot(x, y)
    own = work.motion_name(reference)
    blocks: list[Block] = [words("So with ", own, " = ", _speed(work, reference, speed), ":")]
    for ratio in ratios.ratios:
        before = ratios.rates[ratio.of] * speed
        numbers = product(work.number(before), work.number(ratio.value))
        result = _speed(work, ratio.link, ratio.value * before)
        symbols = product(work.motion_name(ratio.of), _by_distances(work, ratio))
        blocks.append(formula(work.motion_name(ratio.link), symbols, numbers, result))
    blocks += _of_points(work)
    yield Section("Speeds by centres", tuple(blocks))


def _by_distances(work: Worked, ratio: Ratio) -> Expr:
    """A ratio of speeds by the distances of its centres."""
    tied = ratio.rope is not None or ratio.screw is not None
    if tied or (ratio.kind not in ("turns", "slides", "drives") and ratio.value != 1.0):
        return Quotient(work.motion_name(ratio.link), work.motion_name(ratio.of))
    own, other, common = (work.centre_name(pair) for pair in ratio.pairs)
    match ratio.kind:
        case "turns":
            return _signed(Quotient(Spanned(own, common), Spanned(other, common)), ratio)
        case "slides":
            return _signed(Spanned(own, common), ratio)
        case "drives":
            return _signed(Quotient(Num("1"), Spanned(other, common)), ratio)
    return Num("1")


def _speed(work: Worked, link: str, value: float) -> Expr:
    unit = "rad/s" if work.known.turns(link) else f"{work.units.length}/s"
    return work.quantity(value, unit)


def _of_points(work: Worked) -> Iterable[Block]:
    """The speed of every point of a link that turns: its rate times the distance from its centre."""
    said: set[str] = set()
    for link in told_links(work.case):
        pair = work.own_centre(link)
        centre = work.known.centre(*pair) if link in work.known.twists and work.known.turns(link) else None
        if centre is None or centre.kind != "at":
            continue
        own, rate = work.place(pair), abs(work.known.twists[link][2])
        for point in work.case.carries.get(link, ()):
            gap = math.dist(work.known.points[point], own) if point in work.known.points else 0.0
            if not is_named(point) or point in said or gap <= 1e-9 * work.known.size:
                continue
            said.add(point)
            arm = Spanned(work.centre_name(pair), Name(point))
            numbers = product(work.number(rate), work.number(gap))
            speed = work.quantity(rate * gap, f"{work.units.length}/s")
            yield formula(Name("v", point), product(rate_name(link), arm), numbers, speed)
