"""Which mistake: the likely wrong answers of a case, each with its cause."""

from icsolve.grade.mistakes.codes import CODES, Wrong, message
from icsolve.grade.mistakes.engine import Wrongs, wrong_answers

__all__ = ["CODES", "Wrong", "Wrongs", "message", "wrong_answers"]
