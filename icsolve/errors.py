"""What can go wrong, in the user's words: files that can't be read, scenes that have no answer."""

from __future__ import annotations

import math
from typing import Any

from icsolve.tuples import NamedTuple


class IcsolveError(Exception):
    """Any refusal of icsolve."""


class ArgumentError(IcsolveError, TypeError):
    """What a function was given is of another kind than it takes: the message says what to write."""


def refuse_other(given: object, kinds: type | tuple[type, ...], wanted: str) -> None:
    """Refuse an argument that is of none of these kinds; ``wanted`` is what to write instead."""
    if not isinstance(given, kinds):
        raise ArgumentError(f"{wanted}; this is of the type {type(given).__name__}")


class Problem(NamedTuple):
    """One thing wrong with a file: line and column from 1."""

    path: str
    line: int
    column: int
    message: str

    def __str__(self) -> str:
        return f"{self.path}:{self.line}:{self.column}: {self.message}"


class CaseError(IcsolveError):
    """A file that can't be read as a case; ``problems`` has all that is wrong with it."""

    def __init__(self, problems: list[Problem]) -> None:
        self.problems = sorted(problems, key=lambda p: (p.line, p.column))
        super().__init__("\n".join(str(p) for p in self.problems))

    def __reduce__(self) -> tuple[type[CaseError], tuple[list[Problem]]]:
        """Across processes it goes with its problems."""
        return type(self), (self.problems,)

    @property
    def path(self) -> str:
        """The file."""
        return self.problems[0].path

    @property
    def line(self) -> int:
        """Line of the first problem, from 1."""
        return self.problems[0].line

    @property
    def column(self) -> int:
        """Column of the first problem, from 1."""
        return self.problems[0].column


class NotACase(CaseError):
    """A YAML file without ``icsolve:`` at its top: a folder passes such files over."""


class SceneError(IcsolveError):
    """A case that was read but has no answer: ``status`` is a stable word, ``message`` a sentence.

    ``more`` has what the JSON object of the refusal shows besides.
    """

    def __init__(self, status: str, message: str, more: dict[str, Any] | None = None) -> None:
        self.status = status
        self.message = message
        self.more = more or {}
        super().__init__(message)

    def __reduce__(self) -> tuple[type[SceneError], tuple[str, str, dict[str, Any]]]:
        """Across processes it goes with its status."""
        return type(self), (self.status, self.message, self.more)


class Status:
    """The words that a result's ``status`` can be; the manual explains each (`icsolve manual statuses`)."""

    OK = "ok"
    UNDERDETERMINED = "underdetermined"  # the figure leaves points free
    INCONSISTENT = "inconsistent"  # the figure's data contradict each other
    CANNOT_ASSEMBLE = "cannot-assemble"
    AMBIGUOUS = "ambiguous"  # assembles in several ways and nothing picks one
    LOOSE = "loose-link"
    STRUCTURE = "structure"
    MOBILITY = "mobility"  # freedoms do not match the unknowns
    DEAD_CENTRE = "dead-centre"
    CHANGE_POINT = "change-point"
    NO_VALUE = "no-value"  # the unknown does no work, the known loads do
    ANY_VALUE = "any-value"  # the unknown does no work, nor do the known loads
    SLACK = "slack"  # a rope would have to push
    JAM = "jam"  # friction: no value of the unknown keeps up the given motion
    UNBALANCED = "unbalanced"  # reactions of known loads that hold no equilibrium
    CONTRADICTORY = "contradictory-centres"
    NEAR_SINGULAR = "near-singular"
    UNSUPPORTED = "unsupported"


def overflow(what: str) -> SceneError:
    """The refusal (``unsupported``) of a number beyond the range of doubles."""
    return SceneError(
        Status.UNSUPPORTED,
        f"{what} is larger than the largest double in these units: give the case in other `units`.",
    )


def refuse_overflow(what: str, *numbers: float | None) -> None:
    """Raise that refusal where one of the numbers that there are is not finite."""
    if not all(math.isfinite(number) for number in numbers if number is not None):
        raise overflow(what)
