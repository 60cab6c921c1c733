"""All that is wrong with a file, collected in one run."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import islice

from icsolve.case import Mark
from icsolve.errors import Problem

_MOST_OPTIONS = 300
MOST = 100
"""After so many problems a file is not read further."""


class Stop(Exception):
    """Reading cannot go on; what is wrong is in the problems."""


class Problems:
    """Notes problems of one file."""

    def __init__(self, path: str) -> None:
        self.path = path
        self.found: list[Problem] = []

    def refuse(self, mark: Mark, message: str) -> None:
        """Note a problem; stops at the hundredth."""
        problem = Problem(printable(self.path), mark[0], mark[1], printable(message))
        if problem not in self.found:
            self.found.append(problem)
        if len(self.found) == MOST:
            self.found.append(problem._replace(message="and perhaps more: reading stopped here"))
            raise Stop

    def stop(self, mark: Mark, message: str) -> Stop:
        """Note a problem after which nothing can be read; to be raised."""
        self.refuse(mark, message)
        return Stop()


def printable(message: str) -> str:
    """A message on one line: what a file holds can neither break nor colour the terminal."""
    if message.isprintable() and len(message) < 1000:
        return message
    cut = message if len(message) < 1000 else message[:600] + " ... " + message[-200:]
    return "".join(c if c.isprintable() else " " if c in "\n\r\t" else repr(c)[1:-1] for c in cut)


def shown(text: str) -> str:
    """A value as a message quotes it: in quotes, cut where it is long."""
    return f"'{text}'" if len(text) <= 60 else f"'{text[:40]}...'"


def suggestion(name: str, options: Iterable[str]) -> str:
    """``; did you mean ...?`` for the nearest option, else nothing."""
    from difflib import get_close_matches

    known = list(islice(options, _MOST_OPTIONS))
    lower = [option for option in known if option.lower() == name.lower()]
    near = lower or get_close_matches(name[:60], known, 1, 0.6)
    return f"; did you mean '{near[0]}'?" if near else ""
