"""Property tests draw the same examples on every run, and no test asserts a time."""

from __future__ import annotations

import sys
from collections.abc import Iterator

import pytest
from hypothesis import HealthCheck, settings

from browser import REQUIRED, Browser, NoBrowserError, browser, required

settings.register_profile(
    "seeded", derandomize=True, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("seeded")


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


@pytest.fixture(scope="module", autouse=True)
def forgotten() -> Iterator[None]:
    """No module's compiled sweeps, with their buffers, are kept for the next."""
    yield
    if "icsolve.sweep.start" in sys.modules:
        sys.modules["icsolve.sweep.start"].runner.cache_clear()


@pytest.fixture
def window(chromium: Browser) -> Browser:
    """Its window as a reader has it at first: a desk's size, light, with motion."""
    chromium.size(1280, 900)
    chromium.media(prefers_color_scheme="light", prefers_reduced_motion="no-preference")
    return chromium
