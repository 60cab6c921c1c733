"""Property tests draw the same examples on every run, and no test asserts a time."""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator
from functools import cache
from importlib import import_module

import pytest
from hypothesis import HealthCheck, settings

from browser import REQUIRED, Browser, NoBrowserError, browser, required
from sizes import FULL, few, left_out

settings.register_profile(
    "seeded",
    max_examples=few(100),
    derandomize=True,
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("seeded")


KEPT = type(cache(len))


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line(
        "markers", "sampled(one_in, *every): a law of which a run takes a part of the trials"
    )


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """A run takes some trials of the laws that are sampled; one that is asked for by its name is run."""
    out = left_out(items)
    if out and not any("[" in word for word in config.args):
        items[:] = [item for item in items if item not in out]
        config.hook.pytest_deselected(items=[*out])


def pytest_collection_finish() -> None:
    """What was imported and collected stays to the end: the garbage collector need not look through it, and
    looks as seldom as in the command's own process."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(100_000, 50, 50)


@pytest.fixture(scope="session")
def chromium() -> Iterator[Browser]:
    """One headless Chromium for all tests of pages."""
    try:
        with browser() as session:
            yield session
    except NoBrowserError as missing:
        if required():
            pytest.fail(f"{REQUIRED}=required, and {missing}")
        pytest.skip(f"no browser: {missing}")


@pytest.fixture
def wide_ranges(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ranges that friction alone holds are looked for at fewer values, where all are wide."""
    if not FULL:
        monkeypatch.setattr(import_module("icsolve.solve.friction_ranges"), "SAMPLES", 40)


@pytest.fixture(scope="module", autouse=True)
def forgotten(request: pytest.FixtureRequest) -> Iterator[None]:
    """What one module and the package keep of cases that it solved is not kept for the next."""
    yield
    rooms = [vars(room) for name, room in sys.modules.items() if name.startswith("icsolve.")]
    for kept in [value for room in (*rooms, vars(request.module)) for value in room.values()]:
        if isinstance(kept, KEPT) and kept.__module__ != "library":  # which is for all modules
            kept.cache_clear()


@pytest.fixture
def window(chromium: Browser) -> Browser:
    """Its window as a reader has it at first: a desk's size, light, with motion."""
    chromium.size(1280, 900)
    chromium.media(prefers_color_scheme="light", prefers_reduced_motion="no-preference")
    return chromium
