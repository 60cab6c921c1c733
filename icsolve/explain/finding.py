"""The centres: those that a joint shows at once, then each by the lines on which it must lie."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from icsolve.answer import Centre
from icsolve.case import Belt, Contact, Gears, Joint, KnownCentre, Pair, Pin, Roll, Slide, Slot
from icsolve.case.names import pair_name
from icsolve.construction import Known, Step
from icsolve.explain.document import Block, Inline, Items, Section, words
from icsolve.explain.numbers import Figures, centre_name, place_words


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
    these = "all of them are" if needed == total else f"the answer needs {needed}, which are"
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
            return _reason(joint)
    return "the links that they are welded to show it"


def _reason(joint: Joint) -> str:
    at = getattr(joint, "at", None)
    match joint:
        case Pin():
            return f"the pin {at}"
        case Slide():
            return f"square to the guide at {at}"
        case Roll():
            return f"rolling contact at {at}"
        case Gears():
            teeth = " : ".join(n.digits.lstrip("-") for n in joint.teeth)
            return f"the pitch point, which divides the line of the pivots as {teeth}"
        case Belt():
            radii = " : ".join(r.digits for r in joint.radii)
            return f"where the belt cuts the line of the pivots, divided as {radii}"
        case KnownCentre():
            return "given"
    return "a joint"


def _constructed(known: Known, figures: Figures, centre: Centre) -> Iterable[Inline]:
    yield centre_name(known, centre.pair)
    yield f" {_is_at(figures, centre)}"
    if not centre.lines:
        yield ", from the loop equations: no two lines of known centres meet there"
        return
    for n, line in enumerate(ordered_lines(known, centre)):
        yield ": on " if n == 0 else ", and on "
        yield from _line(known, centre, line)


def ordered_lines(known: Known, centre: Centre) -> list[tuple[Pair, ...]]:
    """The lines of a centre with their ends by name, that through the frame's centres first."""
    lines = [tuple(sorted(line, key=lambda pair: pair_name(known.case, pair))) for line in centre.lines]
    return sorted(lines, key=lambda line: (len(line) < 2, [pair_name(known.case, pair) for pair in line]))


def _line(known: Known, centre: Centre, line: tuple[Pair, ...]) -> Iterable[Inline]:
    if len(line) == 1:
        yield f"the {_normal(known, line[0])}"
        return
    links = sorted({link for pair in (*line, centre.pair) for link in pair}, key=known.case.links.index)
    yield "the line "
    yield centre_name(known, line[0])
    yield " "
    yield centre_name(known, line[1])
    yield f" (links {', '.join(links)})"


def _normal(known: Known, pair: Pair) -> str:
    for joint in known.case.joints:
        if set(pair) <= set(joint.links) and isinstance(joint, Slot | Contact):
            what = "normal of the slot" if isinstance(joint, Slot) else "common normal"
            hidden = joint.at.startswith("@")
            return f"{what} of links {' and '.join(joint.links)}" if hidden else f"{what} at {joint.at}"
    return "common normal of the joint"
