"""What a verb puts out: on standard output, or in a file that `icsolve.files` writes."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterable
from contextlib import AbstractContextManager, nullcontext
from types import TracebackType
from typing import Any, TypeVar

import click

from icsolve.cli.run import DONE, UNREADABLE, complain, sources
from icsolve.files import KeptError, folder_of, whole_file

OUTPUT = click.option("-o", "--output", metavar="FILE", help="Write here instead of standard output.")


def one_source(verb: str, argument: str) -> bool:
    """Whether an argument means one file; says so where it means several."""
    if len([source.path for source in sources(argument)]) <= 1:
        return True
    complain(f"icsolve {verb}: {argument} means several files, and the result is one: name one case")
    return False


def write_output(
    verb: str, text: str | bytes | Iterable[bytes], path: str | None, folders: bool = False
) -> int:
    """Write to a file, or to standard output for None and ``-``; returns the exit status.

    The file appears whole or not at all, also where the content comes in parts; an input is refused, and
    what can't be written is said. With ``folders`` those that the file needs are made.
    """
    parts = [text] if isinstance(text, str | bytes) else text
    if path is None or path == "-":
        for part in parts:
            click.echo(part, nl=False)
        return DONE
    try:
        with folder_of(path) if folders else nullcontext(), whole_file(path, binary=True) as file:
            for part in parts:
                file.write(part.encode("utf-8") if isinstance(part, str) else part)
    except KeptError as error:
        complain(f"icsolve {verb}: {error}")
        return UNREADABLE
    except BrokenPipeError:
        raise
    except OSError as error:
        return unwritten(verb, path, error)
    return DONE


def unwritten(verb: str, path: str, error: OSError) -> int:
    """Say that a file can't be written, and why; returns the exit status."""
    complain(f"icsolve {verb}: {error.filename or path} can't be written: {error.strerror or error}")
    return UNREADABLE


# --- a progress bar for work that turns out long --------------------------------------------------------


T = TypeVar("T")

PATIENCE = 1.0
"""Seconds of work before a bar is shown."""


def watched(
    items: Iterable[T], count: int, label: str, quiet: bool = False
) -> AbstractContextManager[Iterable[T]]:
    """The items, with a bar on standard error where someone sees it."""
    if quiet or sys.stderr is None or not sys.stderr.isatty():
        return nullcontext(items)
    return click.progressbar(items, length=count, label=label, file=sys.stderr)


class Progress:
    """Told how much is done; shows a bar on a terminal once the work takes long, and ends it as a context.

    ``told`` is None where nobody would see the bar.
    """

    def __init__(self, total: int, label: str = "rows") -> None:
        self.total, self.label = total, label
        self.done = self.shown = 0
        self.start = time.monotonic()
        self.bar: Any = None
        seen = sys.stderr is not None and sys.stderr.isatty()
        self.told: Callable[[int], None] | None = self._told if seen else None

    def _told(self, count: int) -> None:
        self.done = min(self.done + count, self.total)
        if self.bar is None:
            if time.monotonic() - self.start < PATIENCE:
                return
            self.bar = click.progressbar(length=self.total, label=self.label, file=sys.stderr)
            self.bar.__enter__()
        self.bar.update(self.done - self.shown)
        self.shown = self.done

    def __enter__(self) -> Progress:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self.bar is not None:
            self.bar.__exit__(kind, error, trace)
