"""Which files a command line means: files, folders, globs and standard input."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping

    from icsolve.case import Case

STDIN = "<stdin>"
_LARGEST = 1 << 23
"""Bytes that are read of a stream; the reader refuses far fewer as too large for a case."""


class Source(NamedTuple):
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
            text = sys.stdin.buffer.read(_LARGEST).decode("utf-8-sig", "surrogateescape")
            return read_text(text, STDIN, settings)
        return read_file(self.path, settings)

    def may_be_a_case(self) -> bool:
        """Whether the word ``icsolve`` stands in it (or it can't be opened, which the reader explains)."""
        try:
            with open(self.path, "rb") as file:
                return b"icsolve" in file.read(_LARGEST).replace(b"\0", b"")
        except OSError:
            return True


def sources(argument: str) -> Iterator[Source]:
    """The files that one argument means; of a folder its YAML files and those of the folders in it."""
    if argument == "-":
        yield Source(STDIN)
    elif os.path.isdir(argument):
        yield from (Source(path, argument) for path in _yaml_files(argument))
    elif os.path.lexists(argument) or not set("*?[") & set(argument):
        yield Source(argument)
    else:
        from glob import glob

        for path in sorted(glob(argument, recursive=True)):
            yield from sources(path)


def _yaml_files(folder: str) -> Iterator[str]:
    for here, folders, files in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        for name in sorted(files):
            if name.lower().endswith((".yaml", ".yml")):
                yield os.path.join(here, name)
