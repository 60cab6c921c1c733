"""Which files a command line means: files, folders, globs and standard input; one verb on many of them, each
read and worked on apart: the worst outcome is the exit status; and what it puts out, on standard output or in
a file that `icsolve.files` writes."""

from __future__ import annotations

import os
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, nullcontext
from typing import TYPE_CHECKING, Any

import click

from icsolve.cli import BUG, bug_report
from icsolve.errors import CaseError, NotACase, Problem, SceneError, overflow
from icsolve.files import (
    KeptError,
    can_fork,
    files_of,
    folder_of,
    is_plain,
    note,
    reading,
    started,
    whole_file,
)
from icsolve.tuples import NamedTuple, TypeVar

if TYPE_CHECKING:
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


# --- one verb on all of them -----------------------------------------------------------------------------


DONE = 0
NO_ANSWER = 1
UNREADABLE = 2

T = TypeVar("T")
Work = Callable[["Case", str], T]
"""What a verb does with a case and the path under which the user knows it. Where it runs in several processes
it shows nothing, but returns what is to be shown; else it may, and returns an exit status."""
Refuse = Callable[["Case", str, SceneError], None]
"""How a verb shows a case that has no answer."""


def complain(message: str) -> None:
    """A line that is no result."""
    click.echo(message, err=True)


def refusing(verb: str, work: Callable[[], int]) -> int:
    """The exit status of work on files of a class; what can't be used is told, not raised."""
    try:
        return work()
    except CaseError as error:
        complain(str(error))
    except BrokenPipeError:
        raise
    except (KeptError, ValueError) as error:
        complain(f"icsolve {verb}: {error}")
    except OSError as error:
        complain(f"icsolve {verb}: {error.filename or ''}: {error.strerror or error}".replace(" : ", " "))
    return UNREADABLE


def on_stderr(case: Case, path: str, error: SceneError) -> None:
    """The way in which a refusal is shown to people."""
    complain(f"{path}: {error.status}: {error.message}")


def json_text(entry: Mapping[str, Any]) -> str:
    """One object on one line. Raises SceneError (``unsupported``) for a number beyond the range of doubles,
    which JSON can't hold."""
    import json

    try:
        return json.dumps(entry, allow_nan=False)
    except ValueError:
        raise overflow("a number of the answer") from None


def print_json(entry: Mapping[str, Any]) -> None:
    """One object on one line."""
    click.echo(json_text(entry))


def in_json(schema: str, **more: Any) -> Refuse:
    """The way in which a refusal is shown to programs, as an object of a schema with what else that needs."""

    def refuse(case: Case, path: str, error: SceneError) -> None:
        from icsolve.answer.as_json import refusal_dict

        print_json({**refusal_dict(case.name, error, schema), **more})

    return refuse


def for_each(
    arguments: Iterable[str],
    work: Work[T],
    refuse: Refuse = on_stderr,
    settings: Mapping[str, str] | None = None,
    *,
    show: Callable[[T], int] = lambda found: found,  # type: ignore[assignment,return-value]
    jobs: int | None = 1,
) -> int:
    """Work on every file that the arguments mean; one that fails leaves the others alone.

    In so many processes (None: as many as there are cores, for many files); ``show`` prints, in order, what
    the work found of a case, and returns its exit status.
    """
    worst = DONE
    passed: Counter[str] = Counter()
    for argument in arguments:
        found = False
        for kind, what in _outcomes(argument, work, settings, jobs):
            found = True
            if kind == "failed":
                raise what
            if kind == "passed":
                passed[what] += 1
            elif kind == "said":
                complain(what[0])
                worst = max(worst, what[1])
            elif kind == "refused":
                refuse(*what)
                worst = max(worst, NO_ANSWER)
            else:
                worst = max(worst, show(what))
        if not found:
            complain(f"{argument}:1:1: there is no YAML file here")
            worst = max(worst, UNREADABLE)
    for folder, count in passed.items():
        files = "1 YAML file" if count == 1 else f"{count} YAML files"
        complain(f"{folder}: {files} without `icsolve:` passed over")
    return worst


Outcome = tuple[str, Any]
"""What came of a file: ``found`` with what the work returned, ``refused`` with what shows it, ``said`` with a
line and an exit status, ``passed`` with its folder, or ``failed`` with the error that ends all."""
MANY = 64
"""Files from which several processes pay."""


def _outcomes(
    argument: str, work: Work[T], settings: Mapping[str, str] | None, jobs: int | None
) -> Iterator[Outcome]:
    """What came of each file that an argument means, in order."""
    if jobs == 1:
        yield from (outcome(source, work, settings) for source in sources(argument))
        return
    every = list(sources(argument))
    if jobs is None:
        jobs = (os.cpu_count() or 1) if len(every) >= MANY and can_fork() else 1
    count = min(jobs, len(every))
    if count < 2:
        yield from (outcome(source, work, settings) for source in every)
        return

    def share(some: list[InputSource]) -> list[Outcome]:
        return [outcome(source, work, settings) for source in some]

    with started([(share, (every[k::count],)) for k in range(1, count)]) as others:
        shares = [share(every[::count]), *others()]
    yield from (shares[n % count][n // count] for n in range(len(every)))


def outcome(source: InputSource, work: Work[T], settings: Mapping[str, str] | None = None) -> Outcome:
    """What comes of one file."""
    try:
        case = _case(source, settings)
        if case is None:
            return "passed", source.folder or ""
        try:
            return "found", work(case, source.path)
        except SceneError as error:
            return "refused", (case, source.path, error)
    except CaseError as error:
        return "said", (str(error), UNREADABLE)
    except OSError as error:
        return "failed", error
    except Exception as error:
        return "said", (bug_report(source.path, error), BUG)


def _case(source: InputSource, settings: Mapping[str, str] | None) -> Case | None:
    """The case of a file; None for a file of a folder that is none."""
    if source.folder is None:
        return source.read(settings)
    if not source.may_be_a_case():
        return None
    try:
        return source.read(settings)
    except NotACase:
        return None


# --- what a verb puts out --------------------------------------------------------------------------------


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
