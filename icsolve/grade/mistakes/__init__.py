"""Which mistake: the likely wrong answers of a case, each with its cause."""

from icsolve.grade.mistakes.codes import CODES, Wrong, message, together
from icsolve.grade.mistakes.engine import wrong_answers
from icsolve.grade.mistakes.lookup import Wrongs

__all__ = ["CODES", "Wrong", "Wrongs", "message", "together", "wrong_answers"]
