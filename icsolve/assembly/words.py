"""How points, data, loci and steps of a construction are named to a reader."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from icsolve.assembly.data import CORNER, GUIDE, LENGTH, LINE, MEAN, RAY, ROPE, Datum
from icsolve.assembly.loci import ArcLocus, Axis, CircleLocus, Shifted, Tether, is_round

if TYPE_CHECKING:
    from icsolve.assembly.groups import Group
    from icsolve.assembly.loci import Locus
    from icsolve.assembly.steps import Base, Mean, Meet, Polar, Step, Transfer, Turned
    from icsolve.assembly.workspace import Key, LineDirection, Span


def plain(key: Key) -> str:
    """A point's name."""
    name = key if isinstance(key, str) else key[1]
    return name.lstrip("@")


def joined(*points: str) -> str:
    """Points written together as the format writes pairs and triples: ``AB``, ``O2-A``."""
    names = [plain(point) for point in points]
    return "".join(names) if all(len(name) == 1 for name in names) else "-".join(names)


def datum_words(datum: Datum) -> str:
    """A datum by its name: ``length AB``, ``angle ABC``, ``the guide of C``."""
    if datum.kind == LENGTH:
        return f"length {joined(*datum.points)}"
    if datum.kind == ROPE:
        return f"length of the rope {'-'.join(map(plain, datum.points))}"
    if datum.kind in (RAY, CORNER):
        return f"angle {joined(*datum.points)}"
    if datum.kind in (GUIDE, LINE):
        return f"the guide of {plain(datum.points[0])}"
    if datum.kind == MEAN:
        return f"the centroid {plain(datum.points[0])}"
    return f"{datum.kind} of {plain(datum.points[0])}"


def span_words(span: Span) -> str:
    """A length by its ends."""
    return joined(*span.points) if isinstance(span, Datum) else joined(plain(span.a), plain(span.b))


def direction_words(direction: LineDirection) -> str:
    """A direction by its data."""
    root = direction.root
    if isinstance(root, Datum):
        start = datum_words(root)
    else:
        start = f"the line {joined(plain(root.a), plain(root.b))}"
    turns = "".join(f", turned by angle {joined(*datum.points)}" for datum, _ in direction.turns)
    return f"{'the reverse of ' if direction.flip else ''}{start}{turns}"


def locus_words(locus: Locus) -> str:
    """A locus by what makes it."""
    if isinstance(locus, CircleLocus):
        return f"the circle about {plain(locus.centre)} of radius {span_words(locus.radius)}"
    if isinstance(locus, Tether):
        return f"the circle about {plain(locus.centre)} that the {datum_words(locus.rope)} leaves"
    if isinstance(locus, ArcLocus):
        return f"the circle of {datum_words(locus.corner)}"
    if isinstance(locus, Axis):
        return f"the line of its given {locus.datum.kind}"
    if isinstance(locus, Shifted):
        return f"{locus_words(locus.base)}, moved by {span_words(locus.span)}"
    what = "ray" if locus.ray else "line"
    return f"the {what} from {plain(locus.through)} along {direction_words(locus.direction)}"


def step_words(step: Step) -> str:
    """A step of a construction as a sentence."""
    names = ", ".join(map(plain, step.targets))
    return f"{names}: {SENTENCES[type(step).__name__](step)}"


def _given(step: Step) -> str:
    return "by coordinates"


def _mean(step: Mean) -> str:
    of = ", ".join(map(plain, step.datum.points[1:]))
    return (
        f"centroid of {of}" if step.centroid is None else f"from {plain(step.centroid)}, the centroid of {of}"
    )


def _polar(step: Polar) -> str:
    return f"from {plain(step.base)} by {span_words(step.span)} along {direction_words(step.direction)}"


def _meet(step: Meet) -> str:
    words = f"where {locus_words(step.first)} meets {locus_words(step.second)}"
    if step.sign == 0:
        return f"{words} (touching)" if is_round(step.second) else words
    side = ("left", "right") if is_round(step.first) else ("farther", "nearer")
    return f"{words} ({side[step.sign < 0]})"


def _base(step: Base) -> str:
    return f"{span_words(step.span)} apart, a shape still to be placed"


def _transfer(step: Transfer) -> str:
    p, q = map(plain, step.pose)
    return f"carried by the shape that {p} and {q} hold"


def _turned(step: Turned) -> str:
    return f"carried by the shape that {plain(step.base)} and {direction_words(step.direction)} hold"


def _group(step: Group) -> str:
    return f"together, by Newton's method on their {len(step.equations)} data"


SENTENCES: dict[str, Callable[[Any], str]] = {
    "Given": _given, "Mean": _mean, "Polar": _polar, "Meet": _meet,
    "Base": _base, "Transfer": _transfer, "Turned": _turned, "Group": _group,
}  # fmt: skip
