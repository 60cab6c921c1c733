"""How large the laws run: seeded samples in every run, and in full by hand with ``ICSOLVE_FULL=1``."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Mapping, Sequence
from itertools import product
from typing import Any
from zlib import crc32

import pytest

FULL = os.environ.get("ICSOLVE_FULL") == "1"
MORE = 20 if FULL else 1
"""So many times as many random scenes."""


def crossed(*kinds: Sequence[Any]) -> list[tuple[Any, ...]]:
    """Each of one kind with each of the others in a full run; else so many that every one of each occurs."""
    if FULL:
        return list(product(*kinds))
    return [tuple(of[n % len(of)] for of in kinds) for n in range(max(map(len, kinds)))]


def few(full: int, one_in: int = 3) -> int:
    """So many trials of one law, each of which asserts the same, in a full run; else one in so many."""
    return full if FULL else -(-full // one_in)


def sampled(one_in: int, *every: str) -> pytest.MarkDecorator:
    """A law of which a run takes one in so many of its trials, and a full run all.

    Every value of the parameters that are named occurs; of the path of a case, every folder.
    """
    return pytest.mark.sampled(one_in, *every)


def left_out(items: Iterable[pytest.Item]) -> set[pytest.Item]:
    """The trials of laws that are `sampled` which a run does not take."""
    laws: dict[str, dict[str, pytest.Item]] = {}
    for item in items:
        if not FULL and item.get_closest_marker("sampled") is not None:
            laws.setdefault(item.nodeid.partition("[")[0], {})[item.nodeid] = item
    kept = {name for law in laws.values() for name in _sample(law)}
    return {item for law in laws.values() for name, item in law.items() if name not in kept}


def _sample(law: Mapping[str, pytest.Item]) -> set[str]:
    mark = next(iter(law.values())).get_closest_marker("sampled")
    assert mark is not None
    one_in, *every = mark.args
    params = {name: item.callspec.params for name, item in law.items()}  # type: ignore[attr-defined]
    return taken({name: _kinds(values, every) for name, values in params.items()}, one_in)


def taken(trials: Mapping[str, Collection[Any]], one_in: int) -> set[str]:
    """One in so many of the trials of a law, and as many more as it takes to meet every kind: others for
    every law, and the same on every run, whatever runs beside."""
    left = sorted(trials, key=lambda name: crc32(name.encode()))
    unmet = {kind for kinds in trials.values() for kind in kinds}
    found: set[str] = set()
    while left and (unmet or len(found) * one_in < len(trials)):
        most = max(left, key=lambda name: len(unmet.intersection(trials[name])))  # of equals the first
        left.remove(most)
        found.add(most)
        unmet.difference_update(trials[most])
    return found


def _kinds(values: Mapping[str, Any], every: Sequence[str]) -> set[tuple[str, Any]]:
    return {(name, _kind(values[name])) for name in every}


def _kind(value: Any) -> Any:
    """Itself where it is a word; of a case of the library its folder."""
    return value.rpartition("/")[0] or value if isinstance(value, str) else repr(value)
