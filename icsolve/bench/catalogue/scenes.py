"""Scenes that several entries share, as case texts. Links are numbered from the frame, 0."""

from __future__ import annotations

FOUR_PINS = """\
joints:
  - {pin: [0, 1], at: A0}
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 0], at: B0}
"""


def scene(body: str, loads: str = "") -> str:
    """A case with the frame 0."""
    return f"icsolve: 1\nground: 0\n{body}" + (f"loads: {{{loads}}}\n" if loads else "")


def four_bar(a: str, b: str, b0: str, loads: str) -> str:
    """Crank 1 from the origin to A, coupler 2, rocker 3 from B0 to B."""
    points = f"points: {{A0: [0, 0], A: [{a}], B: [{b}], B0: [{b0}]}}\n"
    return scene(points + FOUR_PINS, loads)


def known(link: int) -> str:
    """A torque of 1 on a link."""
    return f"M{link}: {{torque: 1, link: {link}}}"


def unknown(link: int) -> str:
    """The torque to find, on a link."""
    return f"M{link}: {{torque: unknown, link: {link}}}"


def torques(on: int, to_find: int) -> str:
    """One known torque and one unknown."""
    return f"{known(on)}, {unknown(to_find)}"
