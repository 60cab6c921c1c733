"""Markdown tables."""

from __future__ import annotations

from collections.abc import Iterable, Sequence


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(table_row(line) for line in lines)


def table_row(cells: Sequence[str]) -> str:
    """One row of it."""
    return "| " + " | ".join(cells) + " |"
