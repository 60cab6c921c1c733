"""How points, data, loci and lengths are named to a reader."""

from __future__ import annotations

from typing import TYPE_CHECKING

from icsolve.figure.data import CORNER, GUIDE, LENGTH, LINE, MEAN, RAY, Datum

if TYPE_CHECKING:
    from icsolve.figure.board import Heading, Key, Span
    from icsolve.figure.loci import Locus


def plain(key: Key) -> str:
    """A point's name."""
    name = key if isinstance(key, str) else key[1]
    return name.lstrip("@")


def joined(*points: str) -> str:
    """Points written together as the format writes pairs and triples: ``AB``, ``O2-A``."""
    names = [plain(point) for point in points]
    return "".join(names) if all(len(name) == 1 for name in names) else "-".join(names)


def listed(names: list[str]) -> str:
    """``A``, ``A and B``, ``A, B and C``."""
    if len(names) < 2:
        return "".join(names)
    return f"{', '.join(names[:-1])} and {names[-1]}"


def datum_words(datum: Datum) -> str:
    """A datum by its name: ``length AB``, ``angle ABC``, ``the guide of C``."""
    if datum.kind == LENGTH:
        return f"length {joined(*datum.points)}"
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


def heading_words(heading: Heading) -> str:
    """A direction by its data."""
    root = heading.root
    if isinstance(root, Datum):
        start = datum_words(root)
    else:
        start = f"the line {joined(plain(root.a), plain(root.b))}"
    turns = "".join(f", turned by angle {joined(*datum.points)}" for datum, _ in heading.turns)
    return f"{'the reverse of ' if heading.flip else ''}{start}{turns}"


def locus_words(locus: Locus) -> str:
    """A locus by what makes it."""
    kind = type(locus).__name__
    if kind == "Circle":
        return f"the circle about {plain(locus.centre)} of radius {span_words(locus.radius)}"  # type: ignore[union-attr]
    if kind == "Arc":
        return f"the circle of {datum_words(locus.corner)}"  # type: ignore[union-attr]
    if kind == "Axis":
        return f"the line of its given {locus.datum.kind}"  # type: ignore[union-attr]
    if kind == "Shifted":
        return f"{locus_words(locus.base)}, moved by {span_words(locus.span)}"  # type: ignore[union-attr]
    what = "ray" if locus.ray else "line"  # type: ignore[union-attr]
    return f"the {what} from {plain(locus.through)} along {heading_words(locus.heading)}"  # type: ignore[union-attr]
