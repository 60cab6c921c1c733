"""What the profiles of a case give, in words."""

from __future__ import annotations

from collections.abc import Iterator

from icsolve.case import Case, Number
from icsolve.case.profiles import Arc, Arcs, Circle, Flat, Follower, Knife, Polygon, Radii, Roller, Shape


def outlines(case: Case) -> Iterator[tuple[str, str]]:
    """A row for each link with a profile."""
    if case.profiles is None:
        return
    for link, shape in case.profiles.shapes.items():
        yield f"profile of link {link}", _in_words(shape, case.units.length)
    for touch in case.profiles.touches:
        if touch.friction is not None:
            yield f"friction {'-'.join(touch.links)}", f"mu = {touch.friction.mu.digits}"


def _in_words(shape: Shape | Follower, unit: str) -> str:
    match shape:
        case Polygon(corners):
            return f"polygon {'-'.join(corners)}"
        case Circle(centre, radius):
            return f"circle about {centre}, radius {_number(radius)} {unit}"
        case Arcs(arcs):
            return "; ".join(_arc(arc, unit) for arc in arcs)
        case Radii():
            return _table(shape, unit)
        case Flat(at, along):
            return f"flat face through {at}, along {_line(along)}"
        case Roller(at, radius):
            return f"roller about {at}, radius {_number(radius)} {unit}"
        case Knife(at):
            return f"knife edge at {at}"


def _arc(arc: Arc, unit: str) -> str:
    radius = f", radius {_number(arc.radius)} {unit}" if arc.radius is not None else ""
    turns = "clockwise" if arc.turns == "cw" else "counterclockwise"
    return f"arc about {arc.centre}{radius}, from {_way(arc.start)} to {_way(arc.stop)} {turns}"


def _table(shape: Radii, unit: str) -> str:
    turns = "clockwise" if shape.turns == "cw" else "counterclockwise"
    rows = ", ".join(f"{_number(angle)} deg: {_number(radius)}" for angle, radius in shape.table)
    return f"radii about {shape.about} in {unit}, {turns} from {_line(shape.zero)}: {rows}"


def _line(line: Number | tuple[str, str]) -> str:
    return f"{_number(line)} deg" if isinstance(line, Number) else "-".join(line)


def _way(direction: Number | str) -> str:
    return f"{_number(direction)} deg" if isinstance(direction, Number) else direction


def _number(number: Number) -> str:
    return number.digits if number.factor == 1.0 else f"{number.value:.10g}"
