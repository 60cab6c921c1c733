"""What a verb puts out: on standard output, or in a file that `icsolve.files` writes."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager, nullcontext
from typing import Any

import click

from icsolve.cli.run import DONE, UNREADABLE, complain, sources
from icsolve.files import KeptError, folder_of, whole_file
from icsolve.tuples import TypeVar

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
Told = Callable[[str, float], None]
"""Told what is being done, and how much of it is, from 0 to 1."""

PATIENCE = 1.0
"""Seconds of work before a bar is shown."""
_STEPS = 1000


@contextmanager
def progress(quiet: bool = False) -> Iterator[Told]:
    """What is told of work, as a bar on standard error where someone sees it, once the work takes long."""
    if quiet or sys.stderr is None or not sys.stderr.isatty():
        yield lambda what, share: None
        return
    start = time.monotonic()
    bars: dict[str, Any] = {}

    def told(what: str, share: float) -> None:
        if time.monotonic() - start < PATIENCE:
            return
        if what not in bars:
            bars[what] = shown.enter_context(click.progressbar(length=_STEPS, label=what, file=sys.stderr))
        bars[what].update(round(_STEPS * min(share, 1.0)) - bars[what].pos)

    with ExitStack() as shown:
        yield told


def watched(items: Iterable[T], count: int, label: str, quiet: bool = False) -> Iterator[T]:
    """The items, with a bar of how many are done."""
    with progress(quiet) as told:
        for n, item in enumerate(items, 1):
            yield item
            told(label, n / count)
