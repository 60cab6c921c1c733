"""What could not be graded, matched or read, by reason, each with its lines: nobody is dropped in silence."""

from __future__ import annotations

from array import array
from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

LISTED = 40
"""Ranges of lines that a reason shows before it says how many more there are."""


MOST = 500
"""Reasons that are told one by one."""
OTHERS = "these rows were not graded either, each for the reason that stands in its line of the results"
OTHER_NOTES = "a note like those above, which were the first"


class Issue(NamedTuple):
    """One reason with its lines; ``serious`` where an answer was not graded for it."""

    path: str
    reason: str
    lines: tuple[int, ...]
    serious: bool

    def __str__(self) -> str:
        first = f"{self.path}:{self.lines[0]}: " if self.lines and self.lines[0] else f"{self.path}: "
        more = f" (and {ranges(self.lines[1:])})" if len(self.lines) > 1 else ""
        return f"{first}{self.reason}{more}"


class Issues:
    """Reasons in the order in which they were met."""

    def __init__(self) -> None:
        self._lines: dict[tuple[str, str, bool], array[int]] = {}

    def note(self, path: str, line: int, reason: str, serious: bool = False) -> None:
        """A line of a file and what is wrong there; line 0 for the file itself."""
        key = (path, _on_one_line(reason), serious)
        if key not in self._lines and len(self._lines) >= MOST:
            key = (path, OTHERS if serious else OTHER_NOTES, serious)
        self._lines.setdefault(key, array("q")).append(line)

    def entries(self) -> Iterator[Issue]:
        """Every reason, those of the earliest lines first."""
        found = [
            Issue(path, reason, tuple(sorted(set(at))), s) for (path, reason, s), at in self._lines.items()
        ]
        yield from sorted(found, key=lambda entry: (entry.path, entry.lines[:1], entry.reason))

    @property
    def serious(self) -> bool:
        """Whether any answer could not be graded."""
        return any(serious for _, _, serious in self._lines)


def ranges(lines: tuple[int, ...]) -> str:
    """``lines 3, 5-9``."""
    runs: list[list[int]] = [[lines[0], lines[0]]]
    for before, line in pairwise(lines):
        if line == before + 1:
            runs[-1][1] = line
        else:
            runs.append([line, line])
    shown = ", ".join(f"{a}-{b}" if b > a else str(a) for a, b in runs[:LISTED])
    more = sum(b - a + 1 for a, b in runs[LISTED:])
    word = "line" if len(lines) == 1 else "lines"
    return f"{word} {shown}" + (f" and {more} more" if more else "")


def _on_one_line(text: str) -> str:
    """Without what could break or colour a terminal."""
    return "".join(c if c.isprintable() else " " for c in text[:600])
