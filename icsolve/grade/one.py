"""One task in a program of one's own: its values, what is asked, and the marks for an answer."""

from __future__ import annotations

import os
from typing import Any

from icsolve.grade.case_store import CaseStore
from icsolve.grade.course import Course
from icsolve.grade.judge import feedback, judge_answer
from icsolve.grade.keys import AnyKey
from icsolve.grade.platforms.questions import asked, figure, right_in_words
from icsolve.grade.written.answer import Reader
from icsolve.read import case_name
from icsolve.wording.statement import Statement


class Task:
    """A case as one student's task.

    Parameters
    ----------
    path : the case's file
    student : picks the values of its variables
    course : policies and tolerances; the default ones without

    Attributes
    ----------
    values : the variables' values as texts, by name
    given : what the case gives, as pairs of a name and a value in words

    Raises ValueError where the case can't be read or has no answer.
    """

    def __init__(self, path: str | os.PathLike[str], student: str = "", course: Course | None = None) -> None:
        """Raises ValueError where the case can't be read or has no answer."""
        self._course = course or Course()
        self._case_store = CaseStore(path, self._course)
        self._name = case_name(os.fspath(path))
        self._solved = self._case_store.solved(self._name, student)
        varied = self._case_store.variation(self._name)
        self.values: dict[str, str] = dict(varied.draw(student).values) if varied is not None else {}
        self._case = varied.read(self.values) if varied is not None else self._solved.case
        self.given = Statement(self._case).rows()

    def figure(self) -> str:
        """The figure without its answer, as SVG."""
        return figure(self._case)

    def asked(self, what: str = "") -> str:
        """The sentence that asks for ``w4/w2``, or for the unknown ('')."""
        key = self._key(what)
        return asked(key, self._solved.target(key.question))

    def right(self, what: str = "") -> str:
        """The right answer as text, which is right when it is handed in."""
        return right_in_words(self._key(what))

    def grade(self, what: str, answer: str | float | None) -> dict[str, Any]:
        """The marks for an answer.

        Parameters
        ----------
        what : what is asked (``w4/w2``); '' the unknown
        answer : as it was written, with unit and direction; a number too, or None, as forms hand them over

        Returns
        -------
        dict[str, Any]
            ``verdict``, ``score`` from 0 to 1, ``code`` and ``feedback``, which speaks to the student as no
            person will look at it.
        """
        key = self._key(what)
        judged, _ = judge_answer(key, Reader(self._course.decimal), "" if answer is None else str(answer))
        told = feedback(key, judged, self._course.reveal, by_person=False)
        return {"verdict": judged.verdict, "score": judged.share, "code": judged.code, "feedback": told}

    def _key(self, what: str) -> AnyKey:
        return self._solved.key(f"{self._name}:{what}" if what else self._name)
