"""What a verb puts out: on standard output, or in a file that `icsolve.files` writes."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import nullcontext

import click

from icsolve.cli.inputs import sources
from icsolve.cli.run import DONE, UNREADABLE, complain
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
        complain(f"icsolve {verb}: {error.filename or path} can't be written: {error.strerror or error}")
        return UNREADABLE
    return DONE
