"""The command line: the only room that prints or exits."""

from __future__ import annotations

import errno
import gc
import io
import os
import sys
from contextlib import suppress
from types import FrameType
from typing import TYPE_CHECKING, NoReturn

from icsolve.files import clear_away, one_call

if TYPE_CHECKING:
    import signal
else:  # what is written in C of it: the rest makes enumerations that nothing here needs, at every start
    import _signal as signal

INTERRUPTED = 130
CLOSED_PIPE = 141
BUG = 3
UNWRITABLE = 2
ONE_CORE = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS")
"""Told to numpy before it is imported: the small matrices of a scene gain nothing from threads, and threads
that wait for work take a third of the time of its import."""


def main(arguments: list[str] | None = None) -> NoReturn:
    """Run the command line on ``arguments`` (default: those of the process) and raise SystemExit.

    Exit status: 0 done; 1 a case has no answer, or a published value disagrees; 2 a file or an option
    can't be read; 3 a fault of icsolve itself; 130 interrupted; 141 the reader of the output went away.
    """
    _plain_streams()
    try:
        with one_call():
            code = _run(arguments)
        sys.stdout.flush()
    except BrokenPipeError:
        # not even what the interpreter flushes at its end goes to a closed pipe
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        code = CLOSED_PIPE
    except OSError as error:
        code = _cannot_write(error)
    sys.exit(code)


def entry() -> NoReturn:
    """The command itself: `main` as the whole of a process.

    Start-up is a measured feature. Imports make hardly any garbage, so the collector looks for it less
    often; and a process that has flushed its output leaves at once, since taking down a hundred modules
    one by one costs as much as solving a case.
    """
    gc.set_threshold(100_000, 50, 50)
    for name in ONE_CORE:
        os.environ.setdefault(name, "1")
    for name in ("SIGINT", "SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, _leave)
    try:
        main()
    except SystemExit as left:
        os._exit(left.code if isinstance(left.code, int) else BUG)


def _leave(number: int, frame: FrameType | None) -> NoReturn:
    """End at once on Ctrl-C or a signal to end, with nothing half done left behind.

    No exception is raised for it: one that comes while a package of C loads, or in a callback, is lost or
    becomes another. Processes split off are ended first; each clears away its own.
    """
    processes = sys.modules.get("multiprocessing")  # perhaps while it loads: then there are none
    for child in getattr(processes, "active_children", tuple)():
        child.terminate()
        child.join(2.0)
    clear_away()
    if number != signal.SIGINT:
        signal.signal(number, signal.SIG_DFL)
        os.kill(os.getpid(), number)
    if processes is None or processes.parent_process() is None:
        with suppress(OSError):
            os.write(2, b"icsolve: interrupted\n")
    os._exit(INTERRUPTED)


def _run(arguments: list[str] | None) -> int:
    import click

    from icsolve.cli.commands import icsolve

    if os.environ.get("_ICSOLVE_COMPLETE"):
        icsolve.main(prog_name="icsolve")
    try:
        with icsolve.make_context(
            "icsolve", list(sys.argv[1:] if arguments is None else arguments)
        ) as context:
            return int(icsolve.invoke(context) or 0)
    except click.exceptions.Exit as left:
        return left.exit_code
    except click.ClickException as error:
        error.show()
        return error.exit_code
    except (click.Abort, KeyboardInterrupt):
        click.echo("icsolve: interrupted", err=True)
        return INTERRUPTED
    except OSError:
        raise
    except Exception as error:
        click.echo(bug_report("", error), err=True)
        return BUG


def bug_report(path: str, error: Exception) -> str:
    """One line that asks to report a fault of icsolve; with ``ICSOLVE_DEBUG`` set, the traceback as well."""
    where = f"{path}: " if path else ""
    said = " ".join(str(error).split())[:200]
    line = (
        f"{where}icsolve failed on this ({type(error).__name__}: {said}). This is a fault of icsolve,"
        " not yours: please report it with the file. ICSOLVE_DEBUG=1 shows where it happened."
    )
    if not os.environ.get("ICSOLVE_DEBUG"):
        return line
    import traceback

    return f"{line}\n{''.join(traceback.format_exception(error))}"


def _plain_streams() -> None:
    """The same bytes on every system: UTF-8, newline as it is, and no name that can't be printed.

    A standard output that is closed takes nothing: results that would go there are a failure, not a success.
    """
    if sys.stdout is None:
        sys.stdout = io.TextIOWrapper(io.BufferedWriter(_Closed()))
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)
        if reconfigure is not None:
            reconfigure(encoding="utf-8", errors="backslashreplace", newline="\n")


class _Closed(io.RawIOBase):
    """Where results went if standard output was closed."""

    def writable(self) -> bool:
        return True

    def write(self, data: object) -> int:
        raise OSError(errno.EBADF, "standard output is closed: the results can't be written")


def _cannot_write(error: OSError) -> int:
    """A full disk; it may be that of the messages too."""
    with suppress(OSError):
        print(f"icsolve: {error.strerror or error}", file=sys.stderr)  # noqa: T201
    return UNWRITABLE
