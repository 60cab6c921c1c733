"""One verb on many files: each is read and worked on apart, and the worst outcome is the exit status."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, TypeVar

import click

from icsolve.cli import BUG, bug_report
from icsolve.cli.inputs import InputSource, sources
from icsolve.errors import CaseError, NotACase, SceneError
from icsolve.files import KeptError

if TYPE_CHECKING:
    from icsolve.case import Case

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
        yield from (_outcome(source, work, settings) for source in sources(argument))
        return
    every = list(sources(argument))
    count = _processes(len(every)) if jobs is None else min(jobs, len(every))
    if count < 2:
        yield from (_outcome(source, work, settings) for source in every)
        return
    from icsolve.files import started

    def share(some: list[InputSource]) -> list[Outcome]:
        return [_outcome(source, work, settings) for source in some]

    with started([(share, (every[k::count],)) for k in range(1, count)]) as others:
        shares = [share(every[::count]), *others()]
    yield from (shares[n % count][n // count] for n in range(len(every)))


def _processes(files: int) -> int:
    from icsolve.files import can_fork

    return (os.cpu_count() or 1) if files >= MANY and can_fork() else 1


def _outcome(source: InputSource, work: Work[T], settings: Mapping[str, str] | None) -> Outcome:
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
