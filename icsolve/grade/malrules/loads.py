"""Wrong answers of loads: missed, reversed, taken whole where a component does work, sine for cosine."""

from __future__ import annotations

import math
from collections.abc import Iterator

from icsolve.answer import Answer
from icsolve.case import Case, Load
from icsolve.grade.malrules.changed import (
    Resolve,
    known_loads,
    same_kind,
    scaled,
    turned,
    with_load,
)
from icsolve.grade.malrules.messages import Wrong

_NOTHING = 1e-9
"""A component below this part of the other is rounding."""


def load_wrongs(answer: Answer, resolve: Resolve) -> Iterator[tuple[str, Wrong]]:
    """Wrong answers by unknown, for every load that is given and for the unknown's own direction."""
    right = {name: found.value for name, found in answer.answers.items()}
    loads = list(known_loads(answer.case))
    for load in loads:
        alone = len(loads) == 1
        base = dict.fromkeys(right, 0.0) if alone else resolve(with_load(answer.case, scaled(load, 0.0)))
        yield from _missed(load, len(loads), base)
        if len(loads) > 1:
            yield from _named("load-sense", resolve(with_load(answer.case, scaled(load, -1.0))), load.name)
        if len(right) > 1:
            yield from _upside_down(load, answer.case, right, base)
        quarter = turned(load, answer)
        if quarter is not None:
            yield from _component(load, right, base, resolve(with_load(answer.case, quarter)))
    yield from _own_direction(answer, right, resolve)


def _missed(load: Load, count: int, base: dict[str, float]) -> Iterator[tuple[str, Wrong]]:
    """Without the load; of a single one nothing would be left."""
    if count > 1:
        yield from _named("missed-load", base, load.name)


def _upside_down(
    load: Load, case: Case, right: dict[str, float], base: dict[str, float]
) -> Iterator[tuple[str, Wrong]]:
    """The ratio of a load to what it asks of an unknown of its kind, the wrong way round.

    Of a single unknown `icsolve.grade.malrules.centres` makes these, by its links' rates too.
    """
    number = getattr(getattr(load, "value", None), "value", 0.0)
    for own in case.loads:
        part = right.get(own.name, 0.0) - base.get(own.name, 0.0)
        if number and part and same_kind(load, own):
            wrong = right[own.name] + part * ((number / part) ** 2 - 1.0)
            yield own.name, Wrong("inverse-ratio", wrong, f"{own.name} and {load.name}")


def _named(code: str, values: dict[str, float], where: str) -> Iterator[tuple[str, Wrong]]:
    for name, value in values.items():
        yield name, Wrong(code, value, where)


def _component(
    load: Load, right: dict[str, float], base: dict[str, float], quarter: dict[str, float]
) -> Iterator[tuple[str, Wrong]]:
    """The load's share with its whole velocity, and with the component square to it.

    The answer is ``base + share * cos``: with the load a quarter turn on it is ``base - share * sin``, so
    that the share of the whole velocity is the hypotenuse of the two.
    """
    for name, value in right.items():
        if name not in base or name not in quarter:
            continue
        along, across = value - base[name], quarter[name] - base[name]
        if abs(across) <= _NOTHING * abs(along):
            continue  # along its velocity: nothing to leave out, and sine for cosine leaves the load out
        yield name, Wrong("no-cos", base[name] + math.copysign(math.hypot(along, across), along), load.name)
        yield name, Wrong("sin-cos", base[name] + math.copysign(across, along), load.name)
        yield name, Wrong("sin-cos", base[name] - math.copysign(across, along), load.name)


def _own_direction(answer: Answer, right: dict[str, float], resolve: Resolve) -> Iterator[tuple[str, Wrong]]:
    """The same for an unknown force: its velocity stands below the line."""
    if len(right) != 1:
        return
    ((name, value),) = right.items()
    unknown = next(load for load in answer.case.loads if load.name == name)
    quarter = turned(unknown, answer)
    across = resolve(with_load(answer.case, quarter)).get(name) if quarter is not None else None
    if not across or not value:
        return
    yield name, Wrong("no-cos", math.copysign(1.0 / math.hypot(1.0 / value, 1.0 / across), value), name)
    yield name, Wrong("sin-cos", math.copysign(across, value), name)
