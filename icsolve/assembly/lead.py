"""Which steps lead to which points."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING

from icsolve.assembly.board import Key
from icsolve.assembly.given import Given

if TYPE_CHECKING:
    from icsolve.assembly.step import Step


def leading_to(goal: Collection[Key], steps: Sequence[Step]) -> tuple[Step, ...]:
    """Only the steps that lead to some points."""
    needed: set[Key] = set(goal)
    kept: list[Step] = []
    for step in reversed(steps):
        targets = tuple(key for key in step.targets if key in needed)
        if targets:
            needed.update(step.needs())
            kept.append(Given(targets) if isinstance(step, Given) else step)
    return tuple(reversed(kept))


def points_of(steps: Sequence[Step]) -> tuple[str, ...]:
    """The points that steps place on the ground."""
    return tuple(key for step in steps for key in step.targets if isinstance(key, str))
