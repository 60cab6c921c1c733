"""Files that appear whole or not at all, and never over another one unless asked."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import IO


class ExistsError(OSError):
    """The file is there already; the message says how to write over it."""


def check_free(path: str, force: bool) -> None:
    """Raises ExistsError where a file would be overwritten that may not."""
    if not force and os.path.lexists(path):
        raise ExistsError(f"{path} is there already, and is left as it is; --force writes over it")


@contextmanager
def whole_file(path: str, force: bool, binary: bool = False) -> Iterator[IO[str] | IO[bytes]]:
    """A file to write; it takes its name only when all is written."""
    check_free(path, force)
    folder = os.path.dirname(os.path.abspath(path))
    os.makedirs(folder, exist_ok=True)
    temporary = os.path.join(folder, f".{os.path.basename(path)}.{os.getpid()}.part")
    try:
        mode = "wb" if binary else "w"
        encoding, newline = (None, None) if binary else ("utf-8", "")
        with open(temporary, mode, encoding=encoding, newline=newline) as file:
            yield file
        check_free(path, force)
        os.replace(temporary, path)
    except BaseException:
        if os.path.exists(temporary):
            os.unlink(temporary)
        raise


def write_whole(path: str, data: str | bytes, force: bool) -> None:
    """Write a file at once."""
    with whole_file(path, force, binary=isinstance(data, bytes)) as file:
        file.write(data)  # type: ignore[arg-type]
