"""Files that a verb writes: whole or not at all, and never over what it read."""

from __future__ import annotations

import os
from collections.abc import Iterable

import click

from icsolve.cli.inputs import sources
from icsolve.cli.run import DONE, UNREADABLE, complain

OUTPUT = click.option("-o", "--output", metavar="FILE", help="Write here instead of standard output.")


def one_source(verb: str, argument: str) -> bool:
    """Whether an argument means one file; says so where it means several."""
    if len([source.path for source in sources(argument)]) <= 1:
        return True
    complain(f"icsolve {verb}: {argument} means several files, and the result is one: name one case")
    return False


def is_input(path: str, inputs: Iterable[str]) -> bool:
    """Whether a path is one of the files that were read."""
    files = [source.path for argument in inputs for source in sources(argument)]
    return any(_same(path, file) for file in files)


def _same(a: str, b: str) -> bool:
    try:
        return os.path.samefile(a, b)
    except OSError:
        return os.path.realpath(a) == os.path.realpath(b)


def write_output(
    verb: str, text: str | bytes | Iterable[bytes], path: str | None, inputs: Iterable[str] = ()
) -> int:
    """Write to a file, or to standard output for None and ``-``; returns the exit status.

    The file appears whole or not at all, also where the content comes in parts; an input is refused, and
    what can't be written is said.
    """
    parts = [text] if isinstance(text, str | bytes) else text
    if path is None or path == "-":
        for part in parts:
            click.echo(part, nl=False)
        return DONE
    if is_input(path, inputs):
        complain(f"icsolve {verb}: {path} is the case itself, and is left as it is; choose another name")
        return UNREADABLE
    try:
        _replace(parts, path)
    except OSError as error:
        complain(f"icsolve {verb}: {path} can't be written: {error.strerror or error}")
        return UNREADABLE
    return DONE


def _replace(parts: Iterable[str | bytes], path: str) -> None:
    """Put a whole file in place of what is there; a device or pipe is written to."""
    content = (part.encode("utf-8") if isinstance(part, str) else part for part in parts)
    real = os.path.realpath(path)
    if os.path.lexists(real) and not os.path.isfile(real):
        with open(real, "wb") as file:
            file.writelines(content)
        return
    draft = f"{real}.{os.getpid()}.part"
    try:
        with open(draft, "xb") as file:
            file.writelines(content)
        os.replace(draft, real)
    except BaseException:
        if os.path.exists(draft):
            os.unlink(draft)
        raise
