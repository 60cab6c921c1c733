"""Random mechanisms of mobility 1 with all kinds of joints: a base, and group by group what hangs on it.

Every group adds as many freedoms as constraints, so that the one freedom stays; the reference's rank
has the last word.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import permutations
from random import Random
from typing import Any

from chains import BUTTERFLY
from icsolve.case import Belt, Gears
from loading import loaded, sound
from mechanisms import heading, pinned, polar, spot
from reference import carriers
from transcribe import Scene, case


class Growing:
    """A mechanism that is being drawn."""

    def __init__(self, rng: Random) -> None:
        self.rng = rng
        self.points: dict[str, Any] = {}
        self.joints: list[dict[str, Any]] = []
        self.links = [1]

    def link(self) -> int:
        """A new link."""
        self.links.append(self.links[-1] + 1)
        return self.links[-1]

    def point(self, at: list[float] | None = None) -> str:
        """A new point, anywhere if nothing is said."""
        name = f"Q{len(self.points) + 1}"
        self.points[name] = spot(self.rng) if at is None else at
        return name

    def two_links(self) -> list[int]:
        """Two links that are there already."""
        return self.rng.sample(self.links, 2)

    def guide(self, at: str) -> dict[str, Any]:
        """A guide through a point: by direction, by another point of the line, or by both."""
        along = heading(self.rng)
        far = self.point(polar(self.points[at], self.rng.uniform(0.5, 3), along))
        return self.rng.choice([{"along": along}, {"along": [at, far]}, {"along": along, "through": far}])

    def pin(self, i: int, j: int) -> str:
        """A pin anywhere, or now and then one more link on a pin that is there."""
        triple = [q for q in self.joints if "pin" in q and i in q["pin"] and j not in q["pin"]]
        if triple and self.rng.random() < 0.2:
            joint = self.rng.choice(triple)
            joint["pin"].append(j)
        else:
            joint = {"pin": [i, j], "at": self.point()}
            self.joints.append(joint)
        return str(joint["at"])

    def slide(self, i: int, j: int) -> None:
        """A slide, the block being either link."""
        at = self.point()
        self.joints.append({"slide": self.rng.sample([i, j], 2), "at": at} | self.guide(at))

    def half(self, i: int, j: int) -> None:
        """A joint of one constraint: a slot or a contact."""
        at, pair = self.point(), self.rng.sample([i, j], 2)
        if self.rng.random() < 0.5:
            self.joints.append({"slot": pair, "at": at} | self.guide(at))
        else:
            self.joints.append({"contact": pair, "at": at, "normal": heading(self.rng)})

    def full(self, i: int, j: int) -> None:
        """A joint of two constraints, of any kind."""
        kind = self.rng.choice(["pin", "pin", "slide", "roll", "centre", "infinite"])
        if kind == "pin":
            self.pin(i, j)
        elif kind == "slide":
            self.slide(i, j)
        elif kind == "roll":
            self.joints.append({"roll": [i, j], "at": self.point()})
        elif kind == "centre":
            self.joints.append({"centre": [i, j], "at": self.rng.choice([spot(self.rng), self.point()])})
        else:
            self.joints.append({"centre": [i, j], "toward": heading(self.rng)})


# --- groups that hang on a mechanism ---------------------------------------------------------------


def dyad(g: Growing) -> None:
    """Two links between two others by three full joints."""
    i, j = g.two_links()
    a, b = g.link(), g.link()
    g.full(i, a)
    g.full(a, b)
    g.full(b, j)


def pinned_dyad(g: Growing) -> None:
    """Two links and three pins."""
    i, j = g.two_links()
    a, b = g.link(), g.link()
    g.pin(i, a)
    g.pin(a, b)
    g.pin(b, j)


def lever(g: Growing) -> None:
    """One link on another by a full joint, driven by a third by a half joint."""
    i, j = g.two_links()
    a = g.link()
    g.full(i, a)
    g.half(j, a)


def wedged(g: Growing) -> None:
    """One link that three half joints hold between two or three others."""
    i, j = g.two_links()
    a = g.link()
    for other in (i, j, g.rng.choice([i, j])):
        g.half(other, a)


def weld(g: Growing) -> None:
    """A link that moves as one with another."""
    i, a = g.rng.choice(g.links), g.link()
    g.joints.append({"weld": [i, a], "at": g.point()} if g.rng.random() < 0.5 else {"weld": [i, a]})


def wheel(g: Growing) -> None:
    """A gear or pulley on a link that bears another one already."""
    pins = [(joint["at"], joint["pin"]) for joint in g.joints if "pin" in joint]
    choices = [(at, carrier, other) for at, held in pins for carrier, other in permutations(held, 2)]
    if not choices:
        return
    at, carrier, other = g.rng.choice(choices)
    new = g.link()
    pivot = g.point(polar(g.points[at], g.rng.uniform(2, 4), heading(g.rng)))
    g.joints.append({"pin": [carrier, new], "at": pivot})
    pair = g.rng.sample([other, new], 2)
    if g.rng.random() < 0.6:
        teeth = [g.rng.randrange(12, 40), g.rng.choice([1, -1]) * g.rng.randrange(41, 90)]
        mesh: dict[str, Any] = {"gears": pair, "teeth": teeth}
    else:
        mesh = {"belt": pair, "radii": [round(g.rng.uniform(0.2, 0.9), 3) for _ in "ab"]}
        mesh |= {"crossed": True} if g.rng.random() < 0.5 else {}
    g.joints.append(mesh | {"carrier": carrier})


GROUPS: list[Callable[[Growing], None]] = [
    dyad,
    dyad,
    pinned_dyad,
    pinned_dyad,
    lever,
    lever,
    wedged,
    weld,
    wheel,
    wheel,
]


def pendulum(g: Growing) -> None:
    """A link that hangs on another: one more freedom."""
    g.joints.append({"pin": [g.rng.choice(g.links), g.link()], "at": g.point()})


def grown(rng: Random, freedoms: int = 1) -> Scene:
    """A base and one to four groups on it, without loads."""
    g = Growing(rng)
    if rng.random() < 0.1:
        base = pinned(rng, BUTTERFLY)
        g.points, g.joints, g.links = base["points"], base["joints"], list(range(1, 9))
    else:
        rng.choice([g.pin, g.pin, g.slide])(1, g.link())
        if rng.random() < 0.7:
            rng.choice([lever, pinned_dyad])(g)
    for _ in range(freedoms - 1):
        pendulum(g)
    for _ in range(rng.randrange(1, 5)):
        rng.choice(GROUPS)(g)
    return plain_carriers({"points": g.points, "joints": g.joints})


def plain_carriers(base: Scene) -> Scene:
    """The scene without `carrier` where only one link bears both wheels."""
    joints = []
    for joint in base["joints"]:
        bare = {key: value for key, value in joint.items() if key != "carrier"}
        read = case(base | {"joints": [*base["joints"], bare]})
        mesh = read.joints[-1]
        lone = isinstance(mesh, Gears | Belt) and len(carriers(read, mesh)) == 1
        joints.append(bare if lone else joint)
    return base | {"joints": joints}


def random_mechanism(rng: Random, freedoms: int = 1) -> Scene:
    """A sound scene with any joints, loads and as many unknowns as freedoms, where two links or more move."""
    while True:
        base = grown(rng, freedoms)
        if len(case(base).links) > 2 and all("at" not in j or _apart(j, base) for j in base["joints"]):
            trial = loaded(rng, base, freedoms)
            if sound(trial, freedoms):
                return trial


def _apart(joint: dict[str, Any], base: Scene) -> bool:
    """No other point of the scene within a hundredth of this one's joint."""
    here = base["points"].get(joint["at"]) if isinstance(joint["at"], str) else joint["at"]
    return all(
        xy is here or abs(xy[0] - here[0]) + abs(xy[1] - here[1]) > 0.01 for xy in base["points"].values()
    )
