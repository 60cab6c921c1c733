"""A random case as it is written: points by coordinates in four decimals, joints, links from 1, the frame."""

from __future__ import annotations

from random import Random

REACH = 4.0
"""Points of a random figure lie in a square of twice this side."""
Spot = tuple[float, float]


class Sheet:
    """A case that is being written; links from 1, the frame."""

    def __init__(self, rng: Random) -> None:
        self.rng = rng
        self.points: list[str] = []
        self.joints: list[str] = []
        self.links = 1

    def link(self) -> int:
        """A new link."""
        self.links += 1
        return self.links

    def spot(self) -> Spot:
        """Anywhere, in four decimals."""
        return (round(self.rng.uniform(-REACH, REACH), 4), round(self.rng.uniform(-REACH, REACH), 4))

    def point(self, at: Spot | None = None) -> str:
        """A new point."""
        x, y = at or self.spot()
        self.points.append(f"  P{len(self.points) + 1}: [{x!r}, {y!r}]")
        return f"P{len(self.points)}"

    def pin(self, i: int, j: int, at: Spot | None = None) -> str:
        """A pin, anywhere if nothing is said."""
        point = self.point(at)
        self.joints.append(f"  - {{pin: [{i}, {j}], at: {point}}}")
        return point

    def angle(self) -> float:
        """A direction in whole or decimal degrees."""
        return self.rng.choice([float(self.rng.randrange(0, 180, 5)), round(self.rng.uniform(0, 180), 3)])

    def text(self, loads: str) -> str:
        """The case."""
        points, joints = "\n".join(self.points), "\n".join(self.joints)
        return f"icsolve: 1\npoints:\n{points}\njoints:\n{joints}\nloads: {{{loads}}}\n"


def torques(on: int, to_find: int) -> str:
    """A known torque and the one to find."""
    return f"K: {{torque: 7.5, link: {on}}}, U: {{torque: unknown, link: {to_find}}}"
