"""The cases of the library for the tests: by name, and sampled where a law over all of them takes long.

What costs most of a test is kept: a case is paged once, whatever number of laws read its page.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from pathlib import Path
from zlib import crc32

import pytest

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


PAGED = sample(FILES, 16, "pages")
"""The cases whose pages every law of pages reads."""


@cache
def known(name: str) -> Known:
    """What is known of a case, with its reactions, as its page takes it."""
    return known_of(icsolve.load(FILES[name]), reactions=True)


@cache
def turned(name: str) -> PageMotion | None:
    """The motion of a case with the centres of its page."""
    steps = needed_steps(known(name)) if known(name).whole is not None else ()
    return motion_of(known(name), [step.centre.pair for step in steps])


@cache
def page_of(name: str) -> str:
    """Its page; one in the plane asks for the motion once."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr("icsolve.page.motion_of", lambda *_: turned(name))
        return page_html(known(name))


def motion(name: str) -> PageMotion:
    """Its motion, which it has."""
    found = turned(name)
    assert found is not None
    return found
