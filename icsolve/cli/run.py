"""One verb on many files: each is read and worked on apart, and the worst outcome is the exit status."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING

import click

from icsolve.cli import BUG
from icsolve.cli.faults import bug_report
from icsolve.cli.inputs import Source, sources
from icsolve.errors import CaseError, NotACase, SceneError

if TYPE_CHECKING:
    from icsolve.case import Case

DONE = 0
NO_ANSWER = 1
UNREADABLE = 2

Work = Callable[["Case", str], int]
"""What a verb does with a case and the path under which the user knows it; returns an exit status."""
Refuse = Callable[["Case", str, SceneError], None]
"""How a verb shows a case that has no answer."""


def complain(message: str) -> None:
    """A line that is no result."""
    click.echo(message, err=True)


def on_stderr(case: Case, path: str, error: SceneError) -> None:
    """The way in which a refusal is shown to people."""
    complain(f"{path}: {error.status}: {error.message}")


def for_each(
    arguments: Iterable[str],
    work: Work,
    refuse: Refuse = on_stderr,
    settings: Mapping[str, str] | None = None,
) -> int:
    """Work on every file that the arguments mean; one that fails leaves the others alone."""
    worst = DONE
    passed: Counter[str] = Counter()
    for argument in arguments:
        found = False
        for source in sources(argument):
            found = True
            worst = max(worst, _outcome(source, work, refuse, settings, passed))
        if not found:
            complain(f"{argument}:1:1: there is no YAML file here")
            worst = max(worst, UNREADABLE)
    for folder, count in passed.items():
        files = "1 YAML file" if count == 1 else f"{count} YAML files"
        complain(f"{folder}: {files} without `icsolve:` passed over")
    return worst


def _outcome(
    source: Source, work: Work, refuse: Refuse, settings: Mapping[str, str] | None, passed: Counter[str]
) -> int:
    try:
        return _one(source, work, refuse, settings, passed)
    except CaseError as error:
        complain(str(error))
        return UNREADABLE
    except OSError:
        raise
    except Exception as error:
        complain(bug_report(source.path, error))
        return BUG


def _one(
    source: Source, work: Work, refuse: Refuse, settings: Mapping[str, str] | None, passed: Counter[str]
) -> int:
    case = _case(source, settings)
    if case is None:
        passed[source.folder or ""] += 1
        return DONE
    try:
        return work(case, source.path)
    except SceneError as error:
        refuse(case, source.path, error)
        return NO_ANSWER


def _case(source: Source, settings: Mapping[str, str] | None) -> Case | None:
    """The case of a file; None for a file of a folder that is none."""
    if source.folder is None:
        return source.read(settings)
    if not source.may_be_a_case():
        return None
    try:
        return source.read(settings)
    except NotACase:
        return None
