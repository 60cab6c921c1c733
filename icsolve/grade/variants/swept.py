"""The key of a variant whose answer a sweep gave: nothing is solved until a wrong answer asks for it."""

from __future__ import annotations

from icsolve.answer import Answer
from icsolve.case import Torque
from icsolve.grade.keys import Key, simple_key
from icsolve.grade.malrules import Wrong
from icsolve.grade.questions import unknowns
from icsolve.grade.senses import senses_of
from icsolve.grade.variants.varied import Draw, Varied


def swept_key(varied: Varied, draw: Draw, question: str) -> Key | None:
    """The key of the only unknown, a torque; None where more than its size has to be known."""
    names = unknowns(varied.case)
    value = varied.value(draw) if question == varied.name and len(names) == 1 else None
    load = next((load for load in varied.case.loads if load.name in names), None)
    policy = varied.course.policy_of(question, varied.case.tolerance)
    if value is None or not isinstance(load, Torque) or policy.tolerance.drawing:
        return None

    def wrongs() -> tuple[Wrong, ...]:
        found = varied.task(draw).key(question)
        assert isinstance(found, Key)
        return found.wrongs.all

    senses = senses_of(load, Answer(varied.case))
    return simple_key(question, value, varied.case.units.torque, policy, senses, wrongs)
