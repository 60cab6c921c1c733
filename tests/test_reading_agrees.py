"""Two readings of the same text, the solver's and the witnesses', give the same case."""

from __future__ import annotations

from random import Random

import pytest

import icsolve
import mechanisms
import transcribe
from growth import random_mechanism
from icsolve import case as c
from loading import drawn


def bare(value: object) -> object:
    """A value of a case without how its numbers were written."""
    if isinstance(value, c.Number):
        return value.value
    if isinstance(value, tuple):
        return (type(value).__name__, *(bare(v) for v in value))
    return value


def hidden_as_places(case: c.Case, value: object) -> object:
    """Hidden points (`@...`) by where they are, as their names are the reader's own affair."""
    if isinstance(value, str) and value.startswith("@"):
        return bare(case.points[value])
    if isinstance(value, tuple):
        return tuple(hidden_as_places(case, v) for v in value)
    return value


def same(scene: transcribe.Scene) -> None:
    read, plain = icsolve.load(transcribe.text(scene)), transcribe.case(scene)
    for part in ("links", "joints", "loads", "motion", "ground"):
        seen, meant = (hidden_as_places(case, bare(getattr(case, part))) for case in (read, plain))
        assert seen == meant, part
    visible = {name: bare(p) for name, p in plain.points.items() if not name.startswith("@")}
    assert {name: bare(p) for name, p in read.points.items() if not name.startswith("@")} == visible


@pytest.mark.parametrize("generator", mechanisms.ALL, ids=lambda g: g.__name__)
def test_kinds_read_alike(generator: mechanisms.Generator) -> None:
    same(drawn(5, generator))


def test_random_mechanisms_read_alike() -> None:
    for seed in range(40):
        same(random_mechanism(Random(seed)))
