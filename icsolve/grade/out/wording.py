"""A case as a question in words: what is given, and what is asked."""

from __future__ import annotations

from icsolve.case import (
    Case,
    Coordinates,
    Corner,
    Direction,
    Force,
    ForceVector,
    Like,
    Load,
    LoadIs,
    Number,
    Slope,
    Spring,
    Target,
    Torque,
    Toward,
    Weight,
)
from icsolve.grade.keys import Key, PlaceKey


def figure(case: Case) -> str:
    """The case drawn without its answer, as SVG."""
    from icsolve.construction import known_of
    from icsolve.draw import Drawing, draw

    return draw(case, Drawing(centres="none"), known_of(case)._replace(answer=None))


def asked(key: Key | PlaceKey, target: Target) -> str:
    """The question's sentence: what to find, in which unit, with which sign."""
    what = key.question.partition(":")[2]
    name = target.load if isinstance(target, LoadIs) else what
    unit = f" in {key.unit_name}" if key.unit_name else ""
    if isinstance(key, PlaceKey):
        return f"Where is the centre {name}? Give x and y{unit}."
    sign = ""
    if key.senses.turn:
        sign = f" ({'counterclockwise' if key.senses.turn > 0 else 'clockwise'} positive)"
    elif key.senses.heading is not None:
        sign = f" (positive at {key.senses.heading % 360.0:.6g} deg from +x)"
    return f"Find {name}{unit}{sign}."


def given(case: Case) -> list[tuple[str, str]]:
    """What the figure and its loads give, as pairs of a name and a value."""
    units = case.units
    rows = [(name, f"({_coordinate(p.x)}, {_coordinate(p.y)}) {units.length}") for name, p in _places(case)]
    rows += [(length.a + length.b, f"{_shown(length.value)} {units.length}") for length in case.lengths]
    rows += [_angle(angle) for angle in case.angles]
    return rows + [(load.name, _load(load, case)) for load in case.loads if _known(load)]


def _angle(angle: Direction | Corner) -> tuple[str, str]:
    if isinstance(angle, Corner):
        return f"angle {angle.a}{angle.at}{angle.b}", f"{_shown(angle.value)} deg, counterclockwise"
    return f"direction {angle.a}{angle.b}", f"{_shown(angle.value)} deg from +x"


def _places(case: Case) -> list[tuple[str, Coordinates]]:
    return [(n, p) for n, p in case.points.items() if isinstance(p, Coordinates) and not n.startswith("@")]


def _coordinate(number: Number | None) -> str:
    return "unknown" if number is None else _shown(number)


def _shown(number: Number) -> str:
    """In case units, as it is written where it stands in them."""
    return number.digits if number.factor == 1.0 else f"{number.value:.10g}"


def _known(load: Load) -> bool:
    return isinstance(load, ForceVector) or load.value is not None


def _load(load: Load, case: Case) -> str:
    """A load in words: ``100 lbf on link 4 at E, at 180 deg``."""
    from icsolve.sense import unit_of

    on = f"on link {load.link}"
    at = getattr(load, "at", "@")
    where = on if at.startswith("@") else f"{on} at {at}"
    if isinstance(load, ForceVector):
        return f"({_shown(load.x)}, {_shown(load.y)}) {case.units.force} {where}"
    if isinstance(load.value, Like):
        times = f"{_shown(load.value.times)} times " if load.value.times is not None else ""
        return f"{times}{load.value.load}, {where}"
    assert load.value is not None
    size = f"{_shown(load.value)} {unit_of(load, case)}"
    match load:
        case Torque():
            return f"{size} {'counterclockwise' if load.turns == 'ccw' else 'clockwise'} {on}"
        case Weight():
            return f"{size}, {'mass' if load.mass else 'weight'} {where}"
        case Spring():
            free = f"free length {_shown(load.free)} {case.units.length}"
            return f"stiffness {size}, {free}, {load.at} to {load.to}"
        case Force():
            return f"{size} {where}, {_heading(load)}"


def _heading(load: Force) -> str:
    match load.heading:
        case Toward(point, away):
            return f"{'away from' if away else 'toward'} {point}"
        case Slope(run, rise):
            return f"along the slope {_shown(run)} : {_shown(rise)}"
        case Number():
            return f"at {_shown(load.heading)} deg"
