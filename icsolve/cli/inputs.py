"""Which files a command line means: files, folders, globs and standard input."""

from __future__ import annotations

import glob
import os
import re
import sys
from collections.abc import Iterator
from typing import NamedTuple

from icsolve.errors import CaseError, Problem

STDIN = "<stdin>"
LARGEST = 1 << 20
"""Bytes that are read of a file: more is no case, and is refused by the reader as too large."""

_MARKED = re.compile(rb"(?:(?:^|[\n\r])(?:\xef\xbb\xbf)?|[{,]\s*)[\"']?icsolve[\"']?\s*:")
"""How a case says that it is one: a key of the top level, in block or in flow style."""


class Source(NamedTuple):
    """One file: its name as the user gave or would write it, and its first bytes."""

    path: str
    data: bytes


class PassedOver(NamedTuple):
    """YAML files of a folder that do not say ``icsolve:``, and how many do."""

    folder: str
    skipped: int
    cases: int


Item = Source | PassedOver | CaseError


def sources(argument: str) -> Iterator[Item]:
    """What one argument means, file by file; what can't be opened comes as the error to show."""
    if argument == "-":
        yield Source(STDIN, sys.stdin.buffer.read(LARGEST + 1))
    elif os.path.isdir(argument):
        yield from _folder(argument)
    elif os.path.lexists(argument) or not glob.has_magic(argument):
        yield _file(argument)
    else:
        yield from _glob(argument)


def _file(path: str) -> Source | CaseError:
    try:
        with open(path, "rb") as file:
            return Source(path, file.read(LARGEST + 1))
    except FileNotFoundError:
        return _unreadable(path, "there is no such file (nor such a command: `icsolve --help` lists them)")
    except (OSError, ValueError) as error:
        return _unreadable(path, f"the file can't be opened: {getattr(error, 'strerror', error)}")


def _unreadable(path: str, why: str) -> CaseError:
    return CaseError([Problem(path, 1, 1, why)])


def _glob(pattern: str) -> Iterator[Item]:
    paths = sorted(glob.glob(pattern, recursive=True))
    if not paths:
        yield _unreadable(pattern, "no file matches this pattern")
    for path in paths:
        yield from sources(path)


def _folder(folder: str) -> Iterator[Item]:
    """The cases of a folder and of those in it, by name, and how many YAML files are none."""
    cases = skipped = 0
    for path in _yaml_files(folder):
        source = _file(path)
        if isinstance(source, CaseError) or _MARKED.search(source.data.replace(b"\0", b"")):
            cases += 1
            yield source
        else:
            skipped += 1
    yield PassedOver(folder, skipped, cases)


def _yaml_files(folder: str) -> Iterator[str]:
    for here, folders, files in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        for name in sorted(files):
            if name.lower().endswith((".yaml", ".yml")):
                yield os.path.join(here, name)
