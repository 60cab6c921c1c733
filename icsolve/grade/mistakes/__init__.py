"""Which mistake: the likely wrong answers of a case, each with its cause."""

from icsolve.grade.mistakes.engine import WrongAnswers, solved_for
from icsolve.grade.mistakes.lookup import CODES, Wrong, Wrongs, message, together

__all__ = ["CODES", "Wrong", "WrongAnswers", "Wrongs", "message", "solved_for", "together"]
