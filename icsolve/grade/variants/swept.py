"""The key of a variant whose answer a sweep gave: nothing is solved until a wrong answer asks for it."""

from __future__ import annotations

from icsolve.answer import Answer
from icsolve.case import Force, Load, Number, Torque
from icsolve.grade.keys import Key, simple_key
from icsolve.grade.malrules import Wrong
from icsolve.grade.questions import unknowns
from icsolve.grade.senses import Places, Senses, senses_of
from icsolve.grade.variants.varied import Draw, Varied
from icsolve.sense import unit_of


def swept_key(varied: Varied, draw: Draw, question: str) -> Key | None:
    """The key of the only unknown; None where more than its size has to be known."""
    names = unknowns(varied.case)
    value = varied.value(draw) if question == varied.name and len(names) == 1 else None
    load = next((load for load in varied.case.loads if load.name in names), None)
    policy = varied.course.policy_of(question, varied.case.tolerance)
    if value is None or load is None or not _same_sense(varied, load) or policy.tolerance.drawing:
        return None

    def wrongs() -> tuple[Wrong, ...]:
        found = varied.task(draw).key(question)
        assert isinstance(found, Key)
        return found.wrongs.all

    senses = _senses(varied, draw, load)
    return simple_key(question, value, unit_of(load, varied.case), policy, senses, wrongs)


def _same_sense(varied: Varied, load: Load) -> bool:
    """Whether its direction is the same in all variants: a torque, or a force at a number of degrees."""
    if isinstance(load, Force) and isinstance(load.heading, Number):
        return varied.is_fixed(load.heading.path)
    return isinstance(load, Torque)


def _senses(varied: Varied, draw: Draw, load: Load) -> Senses:
    """Its senses; the variant is solved when words ask where its points are."""

    def places() -> Places:
        return senses_of(load, varied.task(draw).answer).places()

    return senses_of(load, Answer(varied.case))._replace(places=places)
