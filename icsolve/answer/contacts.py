"""What an answer says of contacts by profiles: frozen values."""

from __future__ import annotations

from icsolve.tuples import NamedTuple


class Touching(NamedTuple):
    """Where two links touch: the point, and the normal in degrees from the first link into the second.

    ``on`` says which part of the profile; ``pressure_angle`` is in degrees, None where the follower is not
    guided by the frame; ``note`` is a sentence about what an interpolated profile leaves open. ``force`` is
    the normal force, None where it is not determined; the contact is ``lost`` where it would have to pull.
    """

    links: tuple[str, str]
    at: tuple[float, float]
    normal: float
    on: str
    pressure_angle: float | None
    note: str = ""
    force: float | None = None
    lost: bool = False
