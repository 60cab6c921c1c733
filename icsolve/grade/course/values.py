"""What a course asks for: marks, tolerances, how strict about units and directions."""

from __future__ import annotations

from typing import Any, NamedTuple

from icsolve.case import Tolerance
from icsolve.grade.tolerance import DEFAULT

ATTEMPTS = ("last", "first", "best")
DECIMALS = ("either", "point", "comma")
UNITS = ("assumed", "required", "ignored")
DIRECTIONS = ("signed", "required", "ignored")


class Credit(NamedTuple):
    """Shares of the mark for a right number, unit and direction; they add up to 1."""

    number: float
    unit: float
    direction: float


class Policy(NamedTuple):
    """How one question is judged.

    ``unit``: an answer without one is taken in the question's unit (``assumed``), is wrong in its unit
    (``required``), or units are not looked at (``ignored``). ``direction``: a sign will do
    (``signed``), words must stand there (``required``), or neither counts (``ignored``). ``credit`` is None
    where only a wholly right answer earns marks. ``mistakes`` has the share earned by a wrong answer
    whose cause is known. ``figures`` is the least number of written significant figures.
    """

    points: float = 1.0
    tolerance: Tolerance = DEFAULT
    unit: str = "assumed"
    strict_case: bool = False
    direction: str = "signed"
    within: float = 45.0
    credit: Credit | None = None
    mistakes: tuple[tuple[str, float], ...] = ()
    figures: int = 0


class Course(NamedTuple):
    """A course: the policy for all questions, what single questions have of their own, and the rest."""

    title: str = ""
    policy: Policy = Policy()
    own: tuple[tuple[str, tuple[tuple[str, Any], ...]], ...] = ()
    attempt: str = "last"
    decimal: str = "either"
    seed: str = "0"
    columns: tuple[tuple[str, str], ...] = ()
    reveal: bool = False
    """Whether the accepted range is told with a wrong answer too."""

    @property
    def questions(self) -> tuple[str, ...]:
        """The questions that the course names: each student owes an answer to each."""
        return tuple(question for question, _ in self.own)

    def policy_of(self, question: str, tolerance: Tolerance | None = None) -> Policy:
        """The policy of ``case`` or ``case:what``; ``tolerance`` is that of the case file."""
        case = question.partition(":")[0]
        own = dict(self.own)
        fields: dict[str, Any] = {} if tolerance is None else {"tolerance": tolerance}
        fields |= dict(own.get(case, ())) | dict(own.get(question, ()))
        return self.policy._replace(**fields)
