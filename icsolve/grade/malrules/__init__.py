"""Which mistake: the likely wrong answers of a case, each with its cause."""

from icsolve.grade.malrules.gather import Wrongs, wrong_answers
from icsolve.grade.malrules.messages import CODES, Wrong, message

__all__ = ["CODES", "Wrong", "Wrongs", "message", "wrong_answers"]
