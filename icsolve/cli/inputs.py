"""Which files a command line means: files, folders, globs and standard input."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING

from icsolve.files import files_of, is_plain, note, reading
from icsolve.tuples import NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping

    from icsolve.case import Case

STDIN = "<stdin>"
YAML = (".yaml", ".yml")
_LARGEST = 1 << 23
"""Bytes that are read of a stream; the reader refuses far fewer as too large for a case."""


class InputSource(NamedTuple):
    """One file: its name as the user gave or would write it, and the folder in which it was found."""

    path: str
    folder: str | None = None

    def read(self, settings: Mapping[str, str] | None) -> Case:
        """The case; raises `CaseError`, and `NotACase` where it does not say ``icsolve:``."""
        from icsolve.read import read_file, read_text

        if self.path == STDIN:
            if sys.stdin is None:
                from icsolve.errors import CaseError, Problem

                raise CaseError([Problem(STDIN, 1, 1, "standard input is closed")])
            note(0)
            text = sys.stdin.buffer.read(_LARGEST).decode("utf-8-sig", "surrogateescape")
            return read_text(text, STDIN, settings)
        return read_file(self.path, settings)

    def may_be_a_case(self) -> bool:
        """Whether the word ``icsolve`` stands in it (or it can't be opened, which the reader explains)."""
        try:
            with reading(self.path) as file:
                return b"icsolve" in file.read(_LARGEST).replace(b"\0", b"")
        except OSError:
            return True


def sources(argument: str) -> Iterator[InputSource]:
    """The files that one argument means, remembered as read; of a folder its YAML files and those of the
    folders in it."""
    for source in _sources(argument):
        note(source.path)
        yield source


def _sources(argument: str) -> Iterator[InputSource]:
    if argument == "-":
        yield InputSource(STDIN)
    elif os.path.isdir(argument):
        yield from (InputSource(path, argument) for path in files_of(argument, YAML))
    elif os.path.lexists(argument) or not set("*?[") & set(argument):
        yield InputSource(argument)
    else:
        for path in sorted(set(_matches(argument))):
            if is_plain(path) or os.path.isdir(path):
                yield from _sources(path)


def _matches(pattern: str) -> Iterator[str]:
    """What a glob matches; ``**`` stands for a folder and all below it, each once though links lead round."""
    from glob import escape, glob

    parts = pattern.split("/")
    if "**" not in parts:
        yield from glob(pattern)
        return
    at = parts.index("**")
    above, below = "/".join(parts[:at]), "/".join(parts[at + 1 :])
    for top in glob(above) if above else ["/" if at else ""]:
        if not below:
            yield top or "."
            continue
        for folder in _folders(top or "."):
            inside = os.path.relpath(folder) if not top else folder
            yield from _matches(below if inside == "." else f"{escape(inside.rstrip('/'))}/{below}")


def _folders(top: str) -> Iterator[str]:
    """A folder and those below it, through links too, each once; hidden ones are passed over."""
    seen: set[tuple[int, int]] = set()
    for here, folders, _ in os.walk(top, followlinks=True):
        found = os.stat(here)
        if (found.st_dev, found.st_ino) in seen:
            folders.clear()
            continue
        seen.add((found.st_dev, found.st_ino))
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        yield here
