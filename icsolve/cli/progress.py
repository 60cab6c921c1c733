"""A progress bar on standard error for work that turns out long."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterable
from contextlib import AbstractContextManager, nullcontext
from types import TracebackType
from typing import Any, TypeVar

import click

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
