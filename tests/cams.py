"""Cam mechanisms as cases, for the tests of profiles."""

from __future__ import annotations

from collections.abc import Sequence

from icsolve.case import Case
from icsolve.read import load

HEAD = "icsolve: 1\nunits: {length: mm, force: N, torque: N*mm}\n"


def sliding(
    cam: str, follower: str, *, degrees: float = 40.0, offset: float = 0.0, e: float = 20.0, more: str = ""
) -> Case:
    """A cam about A with a point C at ``e``, under a follower B that slides upright at x = ``offset``.

    A force P of 100 presses the follower down; T12 holds the cam. ``more`` goes into the contact.
    """
    return load(
        f"{HEAD}points: {{A: [0, 0], B: [{offset!r}, unknown]}}\n"
        f"lengths: {{AC: {e!r}}}\nangles: {{AC: {degrees!r}}}\nnear: {{B: [{offset!r}, 60]}}\n"
        f"profile:\n  2: {cam}\n  3: {follower}\n"
        "joints:\n  - {pin: [1, 2], at: A}\n"
        f"  - {{contact: [2, 3]{more}}}\n"
        "  - {slide: [3, 1], at: B, along: 90}\n"
        "links: {2: [C]}\n"
        "loads:\n  P: {force: 100, link: 3, at: B, angle: -90}\n  T12: {torque: unknown, link: 2}\n"
    )


def swinging(cam: str, follower: str, *, degrees: float = 40.0, d: float = 120.0, e: float = 20.0) -> Case:
    """A cam about A with a point C at ``e``, under an arm DE about D at (``d``, 0) on which M of 100 acts."""
    return load(
        f"{HEAD}points: {{A: [0, 0], D: [{d!r}, 0]}}\n"
        f"lengths: {{AC: {e!r}, DE: 100}}\nangles: {{AC: {degrees!r}}}\nnear: {{E: [40, 60]}}\n"
        f"profile:\n  2: {cam}\n  3: {follower}\n"
        "joints:\n  - {pin: [1, 2], at: A}\n  - {contact: [2, 3]}\n  - {pin: [3, 1], at: D}\n"
        "links: {2: [C], 3: [E]}\n"
        "loads:\n  M: {torque: 100, link: 3}\n  T12: {torque: unknown, link: 2}\n"
    )


def table(pairs: Sequence[tuple[float, float]]) -> str:
    """A profile by its radii about A, from the direction of C."""
    radii = ", ".join(f"{angle!r}: {radius!r}" for angle, radius in pairs)
    return f"{{about: A, zero: [A, C], radii: {{{radii}}}}}"
