"""The cases of the library for the tests: by name, and sampled where a law over all of them takes long.

What costs most of a test is kept: a case is paged once, whatever number of laws read its page.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from pathlib import Path
from zlib import crc32

import icsolve
from icsolve.page import page_html
from icsolve.page.motion import PageMotion, motion_of
from icsolve.report.derivation.known import Known, known_of
from icsolve.report.derivation.ratios import needed_steps
from sizes import FULL

LIBRARY = Path(__file__).parent.parent / "cases"
FILES = {path.relative_to(LIBRARY).as_posix(): path for path in sorted(LIBRARY.rglob("*.yaml"))}


def sample(names: Iterable[str], one_in: int, law: str) -> list[str]:
    """One in so many of the names, others for every law and the same on every run; all for a full run."""
    return [name for name in names if FULL or crc32(f"{law} {name}".encode()) % one_in == 0]


PAGED = sample(FILES, 8, "pages")
"""The cases whose pages every law of pages reads."""


@cache
def known(name: str) -> Known:
    return known_of(icsolve.load(FILES[name]))


@cache
def page_of(name: str) -> str:
    return page_html(icsolve.load(FILES[name]))


@cache
def motion(name: str) -> PageMotion:
    found = motion_of(known(name), [step.centre.pair for step in needed_steps(known(name))])
    assert found is not None
    return found
