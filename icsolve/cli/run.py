"""One verb on many files: each is read and worked on apart, and the worst outcome is the exit status."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING

import click

from icsolve.cli import BUG
from icsolve.cli.faults import bug_report
from icsolve.cli.inputs import PassedOver, Source, sources
from icsolve.errors import CaseError, SceneError

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
    for argument in arguments:
        for item in sources(argument):
            worst = max(worst, _outcome(item, work, refuse, settings))
    return worst


def _outcome(
    item: Source | PassedOver | CaseError, work: Work, refuse: Refuse, settings: Mapping[str, str] | None
) -> int:
    if isinstance(item, PassedOver):
        return _passed_over(item)
    if isinstance(item, CaseError):
        complain(str(item))
        return UNREADABLE
    try:
        return _one(item, work, refuse, settings)
    except CaseError as error:
        complain(str(error))
        return UNREADABLE
    except OSError:
        raise
    except Exception as error:
        complain(bug_report(item.path, error))
        return BUG


def _one(source: Source, work: Work, refuse: Refuse, settings: Mapping[str, str] | None) -> int:
    from icsolve.read import read_text

    case = read_text(source.data, source.path, settings)
    try:
        return work(case, source.path)
    except SceneError as error:
        refuse(case, source.path, error)
        return NO_ANSWER


def _passed_over(item: PassedOver) -> int:
    if item.skipped:
        complain(f"{item.folder}: {_count(item.skipped, 'YAML file')} without `icsolve:` passed over")
    if item.cases:
        return DONE
    complain(f"{item.folder}:1:1: there is no case in this folder")
    return UNREADABLE


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" + ("" if number == 1 else "s")
