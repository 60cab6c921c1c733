"""A case as a question in words: what is asked of it, and its figure."""

from __future__ import annotations

from icsolve.case import Case, LoadIs, Target
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
